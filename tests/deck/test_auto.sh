#!/bin/bash
# Method `auto` tries its candidates in the run, says what it chose and why, and changes no bit of the result.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"
cat >in.deck <<'DECK'
units lj
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neigh_modify every 1 delay 0 check yes
fix 1 all nve
thermo_modify format float %.17g
thermo 400
run 1200
DECK
rows() { "$HALFSHELL" -in in.deck -log "$1.log" -neigh "$1" >/dev/null && table "$1.log"; }
for method in auto cluster verlet; do rows "$method" >"$method.rows"; done
[ "$(wc -l <auto.rows)" -eq 4 ]
cmp auto.rows cluster.rows
cmp auto.rows verlet.rows
grep -Eq '^Neighbor method auto: (cluster|verlet) \(per atom and step: cluster [0-9.]+ ns, verlet [0-9.]+ ns\)$' auto.log
if grep -q "Neighbor method auto" cluster.log; then exit 1; fi
# too short to try
sed -i 's/^run .*/run 100/' in.deck
rows auto >short.rows
if grep -q "^Neighbor method auto: .*per atom" auto.log; then exit 1; fi
