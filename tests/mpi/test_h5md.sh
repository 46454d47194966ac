#!/bin/bash
# The trajectory and the checkpoint of several ranks are those of one rank, byte for byte.
set -eu
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

cat >run.in <<END
units lj
lattice fcc 0.8442
region box block 0 6 0 6 0 6
create_box 2 box
create_atoms 1 box
set group all type/fraction 2 0.3 4711
mass 1 1.0
mass 2 2.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
group two type 2
dump t all h5md 10 all.h5 position velocity force image
dump u two h5md 10 two.h5 velocity species c_thermo_temp
checkpoint every 30 steps file state.h5
run 20
run 10
END
for n in 0 2 4; do
    mkdir "$n"
    (cd "$n" && ranks $n ../run.in -log none >out) || fail "$n ranks"
    sleep 1 # files that held the time of their making, in seconds, would differ
done
for n in 2 4; do
    for file in all.h5 two.h5 state.h5; do cmp "0/$file" "$n/$file" || fail "$file on $n ranks"; done
done
