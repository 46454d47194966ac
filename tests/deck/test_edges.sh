#!/bin/bash
# Corners of decks that LAMMPS does not survive or answers otherwise: chunks of a fix that goes in the midst of its window, chunks that
# become others.
set -u
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >in.base <<'D'
units lj
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 2 box
create_atoms 1 box
mass * 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
D

# A window that ends with its fix holds the chunks no longer: they follow the box that grows, as without that fix.
for first in 'fix a all ave/chunk 1 100 100 c density/number' 'print no'; do
    cat >in.window <<D
include in.base
compute c all chunk/atom bin/1d x lower 1.0
$first
run 50
if "\$(is_defined(fix,a))" then "unfix a"
fix b all ave/chunk 1 10 10 c density/number file chunks.txt
fix d all deform 1 x scale 1.5
run 100
D
    "$HALFSHELL" -in in.window -log none >out 2>&1 || fail "$(tail -1 out)"
    mv chunks.txt "chunks.${first%% *}"
done
cmp chunks.fix chunks.print || fail "a fix ave/chunk that is gone still holds the number of chunks"
[ "$(awk 'NF == 3 && $1 == 150 {print $2}' chunks.fix)" = 6 ] || fail "the chunks do not follow the box"

# Its chunks may have become another compute by then.
cat >in.other <<'D'
include in.base
compute c all chunk/atom bin/1d x lower 1.0
fix a all ave/chunk 1 100 100 c density/number
run 5
uncompute c
compute c all temp
unfix a
uncompute c
compute c all chunk/atom bin/1d x lower 1.0
fix a all ave/chunk 1 10 10 c density/number file chunks.txt
run 15
D
"$HALFSHELL" -in in.other -log none >out 2>&1 || fail "$(tail -1 out)"

# Columns that the chunks do not have any more.
cat >in.columns <<'D'
include in.base
compute c all chunk/atom type compress yes
compute p all property/chunk c id
thermo_style custom step c_p[1]
run 0
uncompute c
compute c all chunk/atom type
run 0
D
"$HALFSHELL" -in in.columns -log none >out 2>&1
[ $? = 1 ] || fail "chunks without numbers: $(tail -1 out)"
grep -q "compute 'p' (property/chunk): the chunks of 'c' have no id any more" out || fail "$(tail -1 out)"

# A vector means the same direction whatever its length.
for length in 1 4.149515568880993e+180 2.409919865102884e-181; do # powers of two: the same bits
    cat >in.vector <<D
lattice fcc 0.8442
region box block 0 3 0 3 0 3
create_box 1 box
create_atoms 1 box
mass 1 1.0
variable turn equal 0.3
region half plane 2 2 2 $length $length 0 units box
region turned block 0 3 0 3 0 3 rotate v_turn 0 0 0 $length $length 0 units box
displace_atoms all rotate 2 2 2 $length 0 $length 30 units box
pair_style zero 1.0
pair_coeff * *
fix g all gravity 1.0 vector $length 0 $length
fix p all planeforce $length 0 $length
fix m all move rotate 2 2 2 $length $length 0 5.0 units box
thermo_modify lost ignore
run 2
print "in \$(count(all,half)) \$(count(all,turned)) \$(xcm(all,x)) \$(bound(all,zmax)) \$(f_g)"
D
    "$HALFSHELL" -in in.vector -log none >out 2>&1 || fail "vectors of length $length: $(tail -1 out)"
    grep "^in " out >"vector.$length"
    cmp -s vector.1 "vector.$length" || fail "vectors of length $length: $(cat "vector.$length"), not $(cat vector.1)"
done

# Lines of fix print in runs that are not set up.
cat >in.lines <<'D'
include in.base
fix p all print 5 "line $(step)" title ""
run 5
run 10 pre no
run 10 pre no
run 5
D
"$HALFSHELL" -in in.lines -log none >out 2>&1 || fail "$(tail -1 out)"
[ "$(grep '^line ' out | tr -d '\n')" = "line 0line 5line 10line 15line 20line 25line 25line 30" ] ||
    fail "lines of runs without set-up: $(grep '^line ' out | tr '\n' ' ')"
