#!/bin/bash
# read_restart in another deck: fixes and computes of the same ID and style go on from their states (starting places of springs and of
# mean squared displacements, running averages, thermostats), to the bits of the run that was not interrupted; what does not fit is told and begins anew.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >fixes.in <<'END'
fix move all nve
fix heat all langevin 1.2 1.0 0.7 4711
fix tie all spring/self 2.0
fix mean all ave/time 2 3 10 c_thermo_temp c_thermo_pe ave running
fix list all vector 20 c_thermo_press
variable sum equal trap(f_list)
fix own all property/atom i_n d_w
variable w atom id*0.5
variable one equal d_w[7]
compute own all reduce sum i_n d_w
group some id 1:200:3
compute far all msd
compute near some msd com yes
compute mean all msd average yes
compute turn all vacf
compute path all displace/atom
compute path_some some displace/atom
compute way all reduce sum c_path[4] c_path_some[4]
thermo_style custom step temp pe f_mean[1] f_mean[2] f_tie v_sum c_far[4] c_near[4] c_mean[4] c_turn[4] v_one c_own[*] c_way[*]
thermo_modify format float %.17g
thermo 10
END
cat >first.in <<'END'
units lj
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
include fixes.in
set group all i_n v_w d_w v_w
run 100
write_restart middle.h5
run 60
END
printf 'read_restart middle.h5\ninclude fixes.in\nrun 60\n' >second.in
rows() { table "$1" | awk '$1 >= 100' | tail -7; }

"$HALFSHELL" first.in -log first.log >/dev/null
"$HALFSHELL" second.in -log second.log >out 2>err || fail "$(cat err)"
rows first.log >expected
[ "$(wc -l <expected)" -eq 7 ] || fail "rows: $(cat expected)"
[ "$(awk 'END { print $12 }' expected)" = 3.5 ] || fail "d_w[7] is not what was set: $(cat expected)"
rows second.log | cmp - expected >&2 || { rows second.log; cat expected; fail "fixes did not go on from their states"; } >&2
[ "$(grep -c 'fix style: .*, fix ID: ' out)" -eq 5 ] || fail "not told: $(cat out)"
for compute in "msd, compute ID: far" "msd, compute ID: near" "vacf, compute ID: turn" \
    "displace/atom, compute ID: path" "displace/atom, compute ID: path_some"; do
    grep -q "compute style: $compute\$" out || fail "not told of $compute: $(cat out)"
done

# Computes of another ID or style begin anew, as in LAMMPS.
sed 's/compute far all msd/compute other all msd/; s/c_far/c_other/; s/compute turn all vacf/compute turn all msd/' fixes.in >anew.in
printf 'read_restart middle.h5\ninclude anew.in\nrun 0\n' >anew_run.in
"$HALFSHELL" anew_run.in -log anew.log >out 2>err || fail "$(cat err)"
awk '/^ *Step/ { on = 1; next } on { exit !($8 == 0 && $11 == 0) }' anew.log || fail "did not begin anew: $(cat anew.log)"

# Another thermostat under the same ID, an average of other length, and no springs.
sed 's/^fix heat.*/fix heat all temp\/rescale 10 1.0 1.0 0.1 0.5/; s/c_thermo_temp c_thermo_pe ave/c_thermo_temp ave/; /^fix tie/d; s/f_mean\[1\] f_mean\[2\] f_tie/f_mean/' \
    fixes.in >other.in
printf 'read_restart middle.h5\ninclude other.in\nrun 20\n' >third.in
"$HALFSHELL" third.in -log none >out 2>err || fail "$(cat err)"
grep -q "fix 'mean' (ave/time): its state in the restart file does not fit" out || fail "no warning: $(cat out)"
grep -q 'fix style: vector, fix ID: list' out || fail "list: $(cat out)"

# Groups come with the atoms, not the regions and variables that chose them.
sed '/^velocity/a region ball sphere 2 2 2 1.5\nregion cube block 0 2 0 2 0 2\nregion both intersect 2 ball cube\ngroup ball region both\nvariable fast atom vx>0.5\ngroup fast variable fast\nvariable fast delete\nprint "$(count(ball)) $(count(fast))" file written.txt' \
    first.in >groups.in
printf 'read_restart middle.h5\nprint "$(count(ball)) $(count(fast))" file read.txt\n' >groups_read.in
"$HALFSHELL" groups.in -log none >out 2>err || fail "$(cat err)"
"$HALFSHELL" groups_read.in -log none >out 2>err || fail "$(cat err)"
cmp written.txt read.txt >&2 || fail "groups: $(cat written.txt read.txt)"
grep -Eq '^[1-9][0-9]* [1-9]' read.txt || fail "empty groups: $(cat read.txt)"

# Dynamic groups come as static ones, as in LAMMPS, and stay such in a run that goes on from a checkpoint.
sed '/^run 60/d; /^velocity/a region half block 0 2 INF INF INF INF\ngroup moving dynamic all region half' first.in >moving.in
printf 'print "$(count(moving))" file written.txt\n' >>moving.in
printf 'read_restart middle.h5\nfix 1 all nve\ncheckpoint every 100 steps file after.*.h5\nrun 200\nprint "$(count(moving))" file read.txt\n' >moving_read.in
"$HALFSHELL" moving.in -log none >out 2>err || fail "$(cat err)"
"$HALFSHELL" moving_read.in -log none >out 2>err || fail "$(cat err)"
cmp written.txt read.txt >&2 || fail "dynamic group: $(cat written.txt read.txt)"
rm read.txt
"$HALFSHELL" resume after.200.h5 -log none >out 2>err || fail "$(cat err)"
cmp written.txt read.txt >&2 || fail "dynamic group of a run that goes on: $(cat written.txt read.txt)"

# A run that fix halt has ended ends no runs of the deck that reads its atoms.
sed '/^run 60/d; /^velocity/a variable late equal step>30\nfix stop all halt 5 v_late == 1 error soft message no' first.in >halted.in
printf 'write_restart halted.h5\nclear\nread_restart halted.h5\nfix move all nve\nrun 20\nprint "$(step)" file read.txt\n' >>halted.in
"$HALFSHELL" halted.in -log none >out 2>err || fail "$(cat err)"
[ "$(cat read.txt)" = 55 ] || fail "runs after fix halt: $(cat read.txt)"
