#!/bin/bash
# fix numdiff: differences of energies are the forces of the pair style, also where fix deform has changed the box at the step's end; the
# values are there at its steps, for its group.
set -u
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >in <<'D'
units lj
lattice fcc 0.8442
region box block 0 3 0 3 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
displace_atoms all random 0.1 0.1 0.1 4711
velocity all create 1.44 87287 loop geom
pair_style lj/smooth/linear 2.5
pair_coeff * * 1 1
group few id 1:50
fix 1 all nve
fix n few numdiff 5 1e-5
fix d all deform 1 x erate 0.1
variable wrong atom abs(f_n[1]-fx)+abs(f_n[2]-fy)+abs(f_n[3]-fz)
variable right atom abs(fx)
compute in few reduce max v_wrong
compute out all reduce max v_wrong
compute f few reduce max v_right
thermo_style custom step c_in c_out c_f
thermo 5
run 10
print "$(c_in)"
run 1
D
"$HALFSHELL" in -log none >out 2>&1 && fail "step 11 is no step of the fix"
grep -q "fix 'n' (numdiff): there are forces at multiples of 5 steps, and step 11 is none" out || fail "$(tail -1 out)"
# Three forces of up to some 100, with errors of the order of delta^2 times third derivatives of some 1e5, and of rounding over delta
awk '/^Step/ {on = 1; next} /^Loop/ {on = 0} on && $1 ~ /^[0-9]+$/ {++n; if ($2 > 1e-5 || $2 == 0 || $3 < 0.1 || $4 < 1) bad = 1} END {exit bad || n < 3}' out ||
    fail "$(grep -A4 '^Step' out)"
