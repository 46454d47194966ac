#!/bin/bash
# Steps between which nobody looks do the halves of velocity Verlet in one pass: the same bits as with a fix at every step's end, with
# rows, commands and restart files between, with two masses and a group, and for who looks at the velocities within a step.
# shellcheck disable=SC2086
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"
cat >begin.in <<'DECK'
units lj
lattice fcc 0.8442
region box block 0 5 0 5 0 5
create_box 2 box
create_atoms 1 box
mass 1 1.0
mass 2 2.5
DECK
cat >types.in <<'DECK'
set group all type/fraction 2 0.3 4711
group some type 2
DECK
cat >rest.in <<'DECK'
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
neigh_modify every 1 delay 0 check yes
thermo 100
thermo_style custom step ke
thermo_modify norm no format float %.10g
variable e equal ke
variable k format e %.10g
DECK
echo 'write_dump all custom end.dump id x y z vx vy vz modify sort id format float %.17g' >end.in

# state NAME: what a run that does what standard input says leaves of the atoms, in NAME.dump
state() {
    { cat begin.in $types rest.in - end.in; } >"$1.in"
    "$HALFSHELL" -in "$1.in" -log none $options >"$1.out" 2>&1 || fail "$1: $(cat "$1.out")"
    mv end.dump "$1.dump"
}
# alike NAME...: the states are the same in every bit
alike() { for other in "$@"; do cmp "$1.dump" "$other.dump" || fail "$1 and $other differ ($options $types)"; done; }

for types in "" types.in; do
    for options in "-reproducible on" "-reproducible off" "-precision mixed"; do
        fix="fix 1 $([ -n "$types" ] && echo some || echo all) nve"
        state joined <<<"$fix
run 100"
        state watched <<<"$fix
fix look all print 1 'ke \${k}'
run 100"
        state rows <<<"$fix
thermo 1
run 100"
        state commands <<<"$fix
run 100 every 3 'print \$(ke)'"
        state commands_watched <<<"$fix
fix look all print 1 'step'
run 100 every 3 'print \$(ke)'"
        state pushed <<<"$fix
fix 2 all viscous 0.5
run 100"
        state pushed_watched <<<"$fix
fix 2 all viscous 0.5
fix look all print 1 'step'
run 100"
        alike joined watched rows
        diff <(sed -n 's/^ke //p' watched.out) <(awk '$1 ~ /^[0-9]+$/ && NF == 2 { print $2 }' rows.out) ||
            fail "energies at the end of steps are not those of the rows"
        alike commands commands_watched
        [ "$(grep -c '^[0-9.]*$' commands.out)" -ge 33 ] || fail "no energies between the steps"
        cmp <(grep '^[0-9.]*$' commands.out) <(grep '^[0-9.]*$' commands_watched.out) || fail "energies between the steps differ"
        alike pushed pushed_watched
        if cmp -s joined.dump pushed.dump; then fail "fix viscous changed nothing"; fi
    done
done

# Restart files and checkpoints between rows have velocities of the end of the step.
types="" options="-reproducible on"
state joined <<<"fix 1 all nve
restart 37 at.*.h5
run 100"
cat >going_on.in <<'DECK'
read_restart at.37.h5
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
run 0
write_dump all custom at_37.dump id vx vy vz modify sort id format float %.17g
DECK
"$HALFSHELL" -in going_on.in -log none >out 2>&1 || fail "read_restart: $(cat out)"
state until_37 <<<"fix 1 all nve
run 37
write_dump all custom wanted.dump id vx vy vz modify sort id format float %.17g"
cmp at_37.dump wanted.dump || fail "velocities in a restart file are not those of the end of its step"
