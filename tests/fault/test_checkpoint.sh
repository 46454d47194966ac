#!/bin/bash
# A run that is interrupted or cannot write leaves a checkpoint to go on from; what is damaged is never taken for whole. Runs that
# are killed: test_kills.sh.
# shellcheck disable=SC2012,SC2015,SC2059
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

# Loops, `if` and `run every` around the runs; lists on a lax schedule; a dump that must be cut back.
printf 'one\ntwo\nthree\n' >words.txt
cat >run.in <<'END'
units lj
lattice fcc 0.8442
region box block 0 5 0 5 0 5
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0 2.5
neigh_modify every 20 delay 0 check no
fix 1 all nve
variable i loop 2
variable w file words.txt
variable r equal random(0,1,4711)
checkpoint every 40 steps keep 3
dump s all custom 10 s.dump id type x y z vx vy vz
dump_modify s format float %.17g
thermo 10
label top
if "$i < 5" then "run 115 every 40 'print after-$i-$w-$r append said.txt'" "print done-$i-$w append said.txt"
run 30
next w
next i
jump SELF top
write_data end.data
END
run() { "$HALFSHELL" "$@" >out 2>err; }
run run.in || fail "the run itself: $(cat err)"
[ "$(ls checkpoint.*.h5 | wc -l)" = 3 ] || fail "not the last three checkpoints were kept"
# A resumed run keeps as many in all: those of the run before it are among them.
file=$(ls checkpoint.*.h5 | sort -t. -k2 -n | head -1)
run resume "$file" || fail "resume of $file: $(cat err)"
[ "$(ls checkpoint.*.h5 | wc -l)" = 3 ] || fail "a resumed run left $(ls checkpoint.*.h5)"
# What a killed run leaves of an unfinished file goes when the file, or one of its series, is written again; what a living run is
# writing, and what is not ours, stays.
rm -f checkpoint.*
mine='checkpoint.77.h5.halfshell-part-1 end.data.halfshell-part-99999'
others='checkpoint.5.h5.part-03 checkpoint.h5.halfshell-part-1 checkpoint.40.h5.halfshell-part-x end.data.1.halfshell-part-3'
living=checkpoint.9.h5.halfshell-part-2
# shellcheck disable=SC2086
touch $mine $others $living
exec 9<"$living"
flock -s 9
run run.in || fail "run beside parts of files: $(cat err)"
for file in $mine; do [ ! -e "$file" ] || fail "$file of a dead process was left"; done
for file in $others $living; do [ -e "$file" ] || fail "$file was removed"; done
exec 9<&-
run resume "$(ls checkpoint.*.h5 | tail -1)" || fail "resume beside parts: $(cat err)"
[ ! -e "$living" ] || fail "resume left $living"
# shellcheck disable=SC2086
rm -f $others

# SIGINT and SIGTERM: exit code 3, and a checkpoint that says how to go on.
sed 's/run 115 every 40/run 100000 every 40/' run.in >long.in
for signal in INT TERM HUP; do
    rm -f checkpoint.* out # the last signal's output must not pass for this run's
    "$HALFSHELL" long.in >out 2>err &
    pid=$!
    while ! grep -q "^ *10 " out 2>/dev/null; do sleep 0.02; done
    kill -$signal "$pid"
    code=0
    wait "$pid" || code=$?
    [ "$code" = 3 ] || fail "SIG$signal gave exit code $code"
    file=$(sed -n "s/.*'halfshell resume \([^']*\)'.*/\1/p" err)
    [ -s "$file" ] || fail "SIG$signal left no checkpoint: $(cat err)"
done
# SIGHUP once more: it often comes twice. With nohup it counts for nothing.
rm -f checkpoint.* out
(trap '' HUP && exec "$HALFSHELL" long.in >out 2>err) &
pid=$!
while ! grep -q "^ *10 " out 2>/dev/null; do sleep 0.02; done
kill -HUP "$pid"
sleep 0.5
kill -TERM "$pid" || fail "a run under nohup ended with SIGHUP"
code=0
wait "$pid" || code=$?
[ "$code" = 3 ] || fail "a run under nohup gave exit code $code"

# Who reads the output goes away: nothing is lost.
rm -f checkpoint.*
# shellcheck disable=SC2016 # for the inner shell
bash -c '"$HALFSHELL" long.in -log none 2>err | head -3 >out; exit "${PIPESTATUS[0]}"' && fail "a run without a reader went on"
file=$(sed -n "s/.*'halfshell resume \([^']*\)'.*/\1/p" err)
[ -s "$file" ] || fail "the end of the reader left no checkpoint: $(cat err)"

code=0
run long.in -walltime 2 || code=$?
[ "$code" = 3 ] || fail "-walltime gave exit code $code: $(cat err)"
grep -q 'walltime' err

# A deck that asks for no checkpoints has automatic ones, which go at its end.
grep -v '^checkpoint' run.in >auto.in
rm -f said.txt
HALFSHELL_AUTOSAVE=0.0005 run auto.in || fail "automatic checkpoints: $(cat err)"
[ -z "$(ls autosave.* 2>/dev/null)" ] || fail "an automatic checkpoint was left"
mv end.data whole.data
mv said.txt whole.txt
rm -f s.dump
HALFSHELL_AUTOSAVE=0.0005 "$HALFSHELL" auto.in >out 2>err &
pid=$!
while [ -z "$(ls autosave.*.h5 2>/dev/null)" ] && kill -0 "$pid" 2>/dev/null; do sleep 0.01; done
{ kill -9 "$pid" && wait "$pid"; } 2>/dev/null || true
file=$(ls autosave.*.h5 2>/dev/null || true)
if [ -n "$file" ]; then # else the run was quicker
    cp "$file" kept.h5
    run resume "$file" || fail "resume of an automatic checkpoint: $(cat err)"
    cmp end.data whole.data || fail "an automatic checkpoint did not go on to the same bits"
    cmp said.txt whole.txt || fail "what print adds to a file is not the same"
    [ -z "$(ls autosave.* 2>/dev/null)" ] || fail "the automatic checkpoint that a run went on from was left"
    # one that was copied elsewhere is its owner's, whatever beside it has the old name
    cp kept.h5 "$file"
    run resume kept.h5 || fail "resume of a copy: $(cat err)"
    if [ ! -e kept.h5 ] || [ ! -e "$file" ]; then fail "a copy of an automatic checkpoint was removed"; fi
fi
rm -f autosave.* kept.h5

# Damage: a bit, the end, the version; each refused with its reason and exit code 1.
run run.in
good=$(ls checkpoint.*.h5 | tail -1)
refused() { # refused FILE WORDS
    local status=0
    run resume "$1" || status=$?
    [ "$status" = 1 ] || fail "$1: exit code $status"
    grep -q "$2" err || fail "$1: $(cat err)"
}
size=$(stat -c %s "$good")
for at in 600 $((size / 3)) $((size - 5)); do
    cp "$good" flipped.h5
    byte=$(od -An -tu1 -j "$at" -N1 flipped.h5)
    printf "$(printf '\\%03o' $((byte ^ 16)))" | dd of=flipped.h5 bs=1 seek="$at" conv=notrunc status=none
    refused flipped.h5 'checksum is wrong'
done
for n in 0 100 512 5000 $((size - 1)); do
    head -c "$n" "$good" >short.h5
    refused short.h5 'no whole checkpoint'
done
sed '0,/^format [0-9]*$/s//format 9/' "$good" >later.h5
refused later.h5 'format 9'
sed '0,/^format [0-9]*$/s//format 1/' "$good" >earlier.h5
refused earlier.h5 'reads formats from'
refused run.in 'was not written by'
refused missing.h5 'cannot be read'

# A limit on the size of files: exit code 2, the checkpoints before stay. A folder that is not there is told before the run.
cp "$good" kept.h5
code=0
sed 's/checkpoint every 40 steps/& file kept.h5/' run.in >limit.in
(trap '' XFSZ && ulimit -f 64 && "$HALFSHELL" limit.in -log none >out 2>err) || code=$?
[ "$code" = 2 ] || fail "a file-size limit gave exit code $code"
cmp "$good" kept.h5 || fail "the checkpoint before was damaged"
[ -z "$(ls ./*halfshell-part-* 2>/dev/null)" ] || fail "parts of files were left"
code=0
sed 's/keep 3/file nowhere\/a.*.h5/' run.in >nowhere.in
run nowhere.in || code=$?
[ "$code" = 1 ] && grep -q "checkpoint: 'nowhere/a.\*.h5' cannot be written: there is no folder" err || fail "a missing folder gave exit code $code: $(cat err)"

# read_restart in another deck.
cat >next.in <<'END'
read_restart restart.h5
fix 1 all nve
thermo 10
run 10
END
sed 's/^write_data.*/write_restart restart.h5/' run.in >first.in
run first.in && run next.in || fail "read_restart: $(cat err)"
grep -q '^ *290 ' out || fail "read_restart did not go on at step 290"

# A minimisation goes on from its checkpoints to the same bits, and so does the run after it.
cat >min.in <<'END'
lattice fcc 0.9
region box block 0 4 0 4 0 4
region hole sphere 2 2 2 0.9 side out
create_box 2 box
create_atoms 1 region hole
set type 1 type/fraction 2 0.4 17
mass * 1.0
pair_style lj/cut 2.0
pair_coeff * * 1.0 1.0
pair_coeff 2 2 1.0 0.85
pair_modify shift yes
neigh_modify every 3 delay 0 check yes
fix 1 all nve
${box}
min_style ${style}
checkpoint every 7 steps keep 9 file min.*.h5
minimize 0 0 30 1000
run 10
write_data end.data
END
mkdir -p whole
relax='fix r all box/relax x 1.0 y 2.0 z 0.5 vmax 0.002 nreset 5'
for style in cg sd fire quickmin relaxed; do
    rm -f min.*.h5
    case $style in
    relaxed) words=(-var style cg -var box "$relax") ;;
    *) words=(-var style "$style" -var box 'print nothing') ;;
    esac
    run min.in "${words[@]}" || fail "minimize with $style: $(cat err)"
    mv end.data "whole/$style.data"
    for step in 7 28 35; do
        run resume "min.$step.h5" || fail "minimize with $style resumed from step $step: $(cat err)"
        cmp end.data "whole/$style.data" || fail "minimize with $style resumed from step $step ended otherwise"
    done
done
