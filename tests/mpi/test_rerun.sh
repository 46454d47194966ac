#!/bin/bash
# rerun and read_dump: LAMMPS's numbers from text dumps, plain and compressed, scaled and not; the very numbers of the run that
# wrote a trajectory from its H5MD file; atoms that come and go; on one rank and several.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

cat >first.in <<'END'
units lj
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0 2.5
neigh_modify delay 0 every 20 check no
fix 1 all nve
dump 1 all custom 20 run.dump id type x y z vx vy vz
dump 2 all custom 20 scaled.dump.gz type zs ys xs id
run 100
END
cat >again.in <<'END'
units lj
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 3.0
pair_coeff 1 1 1.0 1.0
compute r all rdf 20 cutoff 3.0
fix 1 all ave/time 20 2 40 c_r[2] mode vector file rdf.txt
thermo 40
rerun run.dump first 20 every 20 last 100 dump x y z vx vy vz
unfix 1
rerun scaled.dump.gz skip 2 dump x y z
read_dump run.dump 60 x y z vx vy vz
run 0
END
# What LAMMPS (29 Sep 2021) prints for both decks, the second one after its own first or ours: the dumps' six digits are the same.
cat >lammps <<'END'
20 0.6239063 -5.7330162 0 -4.8008125 0.67920078
40 0.75047291 -5.928022 0 -4.8067099 0.00020784731
80 0.75554715 -5.935881 0 -4.8069874 -0.13515981
100 0.72628044 -5.8916851 0 -4.80652 0.00028201499
0 0.72628044 -6.9361631 0 -5.850998 -5.8987174
40 0.72628044 -5.9280239 0 -4.8428588 -0.020144568
80 0.72628044 -5.9358837 0 -4.8507185 -0.15978202
60 0.77733502 -5.9681775 0 -4.8067297 -0.26706209
END
ranks 0 first.in -log none >out
for n in 0 3; do
    ranks $n again.in -log log.$n >out || fail "again.in on $n ranks: $(cat out)"
    table log.$n | sed 's/  */ /g; s/^ //; s/ $//' >rows
    cmp rows lammps >&2 || fail "rerun on $n ranks: $(cat rows)"
    grep -q '^40 20$' rdf.txt && grep -q '^20 0.971366$' rdf.txt && [ "$(wc -l <rdf.txt)" -eq 45 ] || fail "averages on $n ranks"
done

# From an H5MD file, which has all digits, the bits of the run: with another number of ranks, a box that follows the atoms, and
# velocities.
cat >run.in <<'END'
units lj
boundary p p s
lattice fcc 0.7
region box block 0 4 0 4 0 4
create_box 2 box
create_atoms 1 box
set group all type/fraction 2 0.4 12
mass * 1.0
velocity all create 1.0 4711
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
pair_coeff 2 2 0.7 1.1
fix 1 all nve
neigh_modify every 1 delay 0 check yes
thermo_style custom step temp pe press pxy vol
thermo_modify format float %.17g
END
grep -v '^velocity' run.in >base.in
cat >>run.in <<'END'
dump 1 all h5md 25 run.h5 position velocity image
thermo 25
run 100
write_data end.data
END
cat >>base.in <<'END'
thermo 50
rerun run.h5 dump x y z vx vy vz ix iy iz
write_data again.data
END
ranks 0 run.in -log log -screen none
table log | awk '$1 % 50 == 0 { print $1, $2, $3 }' >rows
for n in 0 3; do
    ranks $n base.in -log log -screen none || fail "rerun of run.h5 on $n ranks"
    table log | awk '{ print $1, $2, $3 }' >again
    same_numbers rows again 1e-8 # energies are rounded to a grid that depends on the forces of the steps before
    cmp <(sed -n '/^Atoms/,/^Velocities/p' end.data) <(sed -n '/^Atoms/,/^Velocities/p' again.data) >&2 || fail "atoms of run.h5 on $n ranks"
done

# Atoms that leave: the file has fill values for them. They come back when they are to be added.
cat >leave.in <<'END'
units lj
boundary f f f
region box block 0 8 0 8 0 8
region inner block 1 7 1 7 1 7
lattice sc 0.3
create_box 1 box
create_atoms 1 region inner
mass 1 1.0
velocity all create 9.0 4711
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
thermo_style custom step atoms ke
thermo_modify lost ignore norm no
END
cp leave.in back.in
cat >>leave.in <<'END'
fix 1 all nve
neigh_modify every 5 delay 0 check no
dump 1 all h5md 50 leave.h5 position velocity
dump 2 all custom 50 leave.dump id type x y z vx vy vz
thermo 50
run 200
END
cat >>back.in <<'END'
thermo 1
rerun leave.h5 first 100 dump x y z vx vy vz purge yes replace no add keep
rerun leave.dump dump x y z vx vy vz trim yes add keep box no
read_dump leave.h5 0 x y z vx vy vz add yes
read_dump leave.h5 200 x y z trim yes replace no
END
ranks 0 leave.in -log log -screen none
table log | awk '{ print $1, $2 }' >rows
[ "$(awk 'NR == 1 { a = $2 } END { print (a - $2 > 5) }' rows)" = 1 ] || fail "no atoms left: $(cat rows)"
for n in 0 3; do
    ranks $n back.in -log back.log -screen none || fail "atoms that left, $n ranks"
    { awk '$1 >= 100' rows; cat rows; } >expected
    table back.log | awk '{ print $1, $2 }' | cmp - expected >&2 || fail "atoms that left, $n ranks: $(table back.log)"
    last=$(tail -1 rows | cut -d' ' -f2) first=$(head -1 rows | cut -d' ' -f2)
    sed -n 's/^  *\([0-9]*\) atoms added/\1/p' back.log | head -1 | grep -qx $((first - last)) || fail "atoms added, $n ranks"
    sed -n 's/^  *\([0-9]*\) atoms trimmed/\1/p' back.log | tail -1 | grep -qx $((first - last)) || fail "atoms trimmed, $n ranks"
done
