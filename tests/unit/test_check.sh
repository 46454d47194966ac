#!/bin/bash
# `halfshell check` goes through a whole deck, says what it would do, and writes no file; a mistake is still found.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"
cat >deck.in <<'END'
units lj
lattice fcc 0.8
region b block 0 3 0 3 0 3
create_box 1 b
create_atoms 1 box
mass 1 1
pair_style lj/cut 2.0
pair_coeff 1 1 1 1
fix 1 all nve
dump 1 all atom 1 a.dump
dump 2 all xyz 1 b.*.xyz
dump 3 all custom 1 c.dump.gz id x
write_dump all atom d.dump
log second.log
print "hello" file hello.txt
write_data out.data
run 5
write_data out.*.data
END
"$HALFSHELL" check deck.in >out 2>err || { cat out err >&2; exit 1; }
[ "$(ls)" = $'deck.in\nerr\nout' ] || { echo "check wrote files:" * >&2; exit 1; }
for part in "Run of 5 steps" "108 atoms" "no errors found"; do
    grep -q "$part" out || { echo "check does not say '$part'" >&2; cat out >&2; exit 1; }
done

# A table that the deck writes and reads is not there yet.
sed 's/^run 5$/pair_write 1 1 50 r 0.8 2.5 new.table LJ\npair_style table linear 100\npair_coeff * * new.table LJ\nrun 5/' deck.in >table.in
"$HALFSHELL" check table.in >out 2>err || { cat out err >&2; exit 1; }
[ ! -e new.table ] && grep -q "'new.table' is not there; unless" out

# So are data files and checkpoints, of which all else would depend; but only where the deck writes any.
{ cat deck.in; printf 'write_data new.data\nclear\nread_data new.data\n'; } >data.in
"$HALFSHELL" check data.in >out 2>err || { cat out err >&2; exit 1; }
[ ! -e new.data ] && grep -q "read_data: 'new.data' is not there; unless the deck itself" out
{ cat deck.in; printf 'write_restart new.chk\nclear\nread_restart new.chk\nrun 10\n'; } >restart.in
"$HALFSHELL" check restart.in >out 2>err || { cat out err >&2; exit 1; }
[ ! -e new.chk ] && grep -q "read_restart: 'new.chk' is not there; unless the deck itself" out
{ sed '/^write/d' deck.in; printf 'clear\nread_data new.data\n'; } >data.in
code=0
"$HALFSHELL" check data.in >out 2>err || code=$?
[ "$code" -eq 1 ] && grep -q "new.data' cannot be read" err

# What only values can tell is found too, at its line, with exit code 1.
sed 's/^mass 1 1$//' deck.in >bad.in
code=0
"$HALFSHELL" check bad.in >out 2>err || code=$?
if [ "$code" -ne 1 ] || ! grep -q '^bad.in:[0-9]*: error: .*mass' err; then cat out err >&2; exit 1; fi

# A refused deck leaves the log of the last run in place; a signal ends a run with exit code 3.
echo "last run" >log.halfshell
echo "unitz lj" >worse.in
code=0
"$HALFSHELL" worse.in >out 2>err || code=$?
[ "$code" -eq 1 ] && [ "$(cat log.halfshell)" = "last run" ] && grep -q "'units'" err
sed 's/^run 5/run 100000000/; /^dump/d; /^log/d; /^write/d; /^print/d' deck.in >long.in
"$HALFSHELL" long.in -log none >out 2>err &
run=$!
sleep 1
kill -INT "$run"
code=0
wait "$run" || code=$?
[ "$code" -eq 3 ] || { echo "after SIGINT the exit code is $code" >&2; exit 1; }

# What set-ups ask for: functions of time, samples of steps that were passed over.
cat >times.in <<'END'
lattice sc 1
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 box
mass 1 1
pair_style none
variable d equal swiggle(0,1,0.3)+ramp(0,1)
region r sphere 2 2 2 1.5 move v_d NULL NULL
group g dynamic all region r every 2
compute t all temp/region r
fix 1 all nve
fix q all ave/histo 2 2 10 -5 5 5 x mode vector
thermo_style custom step c_t
run 2
run 18
run 0
END
"$HALFSHELL" check times.in >out 2>err || { cat out err >&2; exit 1; }
grep -q "no errors found" out
