#!/bin/bash
# dump image: the same bytes on one rank and on several, each of which draws only its own atoms.
source "$PROJECT_ROOT/tests/mpi/ranks.sh"

cat >deck.in <<'END'
units lj
lattice fcc 0.8
region b block 0 5 0 5 0 5
create_box 1 b
create_atoms 1 box
mass 1 1
velocity all create 1.4 8728
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
fix 1 all nve
dump a all image 100 ${n}.type.*.png type type adiam 1.1 size 200 160
dump b all image 100 ${n}.speed.*.ppm speed type view 20 70 size 120 200 box no 0.1
dump c all image 100 ${n}.place.*.png x type zoom 2 center d 0.2 0.3 0.4
dump_modify c amap 0 max viridis
run 0
END
for n in 0 2 4; do ranks $n -in deck.in -var n $n -log none -screen none || fail "$n ranks"; done
for picture in type.0.png speed.0.ppm place.0.png; do
    [ -s "0.$picture" ] || fail "no $picture"
    for n in 2 4; do cmp "0.$picture" "$n.$picture" >&2 || fail "$picture on $n ranks"; done
done
