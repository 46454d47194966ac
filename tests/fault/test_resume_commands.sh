#!/bin/bash
# Runs that are resumed after commands that make the simulation in other ways than create_box: clear, read_restart, read_data with
# coefficients, masses and groups. From the checkpoint of a run that was itself resumed it goes on as well.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >first.in <<'END'
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.3 12
mass * 1.0
mass 2 2.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
pair_coeff 2 2 1.1 1.05
region half block 0 2 INF INF INF INF
group half region half
fix 1 all nve
run 10
write_restart first.h5
write_data first.data pair ij
END
settings='thermo_style custom step temp pe press c_t
thermo_modify format float %.17g
thermo 10'
printf 'compute t half temp\ncheckpoint every 20 steps keep 9 file restart.*.chk\n%s\nfix 1 all nve\nfix a half ave/time 5 2 10 c_t file restart.ave\nrun 100\n' "$settings" >rest.in
{ echo "read_restart first.h5"; cat rest.in; } >restart.in
{ cat first.in; echo "clear"; echo "read_restart first.h5"; sed 's/restart[.]/clear./' rest.in; } >clear.in
{
    echo "pair_style lj/cut 2.5"
    echo "read_data first.data group half"
    sed 's/restart[.]/data./' rest.in
} >data.in
{ cat first.in; echo "clear"; sed 's/file data[.]/file both./' data.in; } >both.in

"$HALFSHELL" first.in -log none >/dev/null 2>err || fail "$(cat err)"
for deck in restart clear data both; do
    "$HALFSHELL" "$deck.in" -log whole.log >/dev/null 2>err || fail "$deck: $(cat err)"
    mapfile -t saved < <(printf '%s\n' "$deck".*.chk | sort -t . -k 2n)
    [ "${#saved[@]}" -ge 5 ] || fail "$deck: checkpoints ${saved[*]}"
    cp "$deck.ave" whole.ave
    table whole.log | tail -1 >expected
    # the second one is written anew by the run that goes on from the first
    rm "${saved[1]}"
    for from in "${saved[0]}" "${saved[1]}" "${saved[3]}"; do
        "$HALFSHELL" resume "$from" -log again.log >/dev/null 2>err || fail "$deck from $from: $(cat err)"
        table again.log | tail -1 | cmp -s - expected || fail "$deck from $from: $(tail -1 again.log), not $(cat expected)"
        cmp "$deck.ave" whole.ave >&2 || fail "$deck from $from: the file of averages is another one"
        rm -f again.log
    done
done
