#!/bin/bash
# A disk that fills up: exit code 2, one message that names the file and the cause, what was written before stays whole, and the
# run goes on where it was as soon as there is room, to the bits of the run that was never held up. On a file system of 20 MB where
# one can be mounted (as root), and always by a library that says "no space left" in write(2).
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"
mounted=
trap '[ -z "$mounted" ] || umount "$folder/small"; rm -rf "$folder"' EXIT
mkdir small

cat >head.in <<'END'
units lj
lattice fcc 0.8442
region box block 0 8 0 8 0 8
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
fix 1 all nve
fix 2 all ave/time 1 5 10 c_thermo_temp file ave.txt
thermo_style custom step temp pe press
thermo_modify format float %.15g
thermo 2
END
# deck NAME DUMP...: one deck for each way of writing
deck() { { cat head.in; echo "$2"; echo "$3"; printf 'run 40\nwrite_data end.data\n'; } >"$1.in"; }
deck text 'dump d all custom 2 small/run.dump id x y z vx vy vz' 'dump_modify d format float %.17g'
deck gzip 'dump d all custom 2 small/run.dump.gz id x y z vx vy vz' 'dump_modify d format float %.17g'
deck h5md 'dump d all h5md 2 small/run.h5 position velocity force image' ''
deck dcd 'dump d all dcd 2 small/run.dcd' ''
deck files 'dump d all custom 2 small/run.*.dump id x y z vx vy vz' 'dump_modify d format float %.17g'
rows() { table "$1" | sort -n | uniq; }

# The runs that nothing holds up.
for kind in text gzip h5md dcd files; do
    mkdir "whole_$kind"
    rm -rf small/*
    "$HALFSHELL" "$kind.in" -log log >/dev/null
    mv end.data ave.txt log small/* "whole_$kind/"
done

# held_up KIND WORDS...: the run fails as it should, with the words before the program's; then there is room, and it goes on
held_up() {
    local kind=$1 code=0 file
    shift
    rm -f checkpoint.* end.data ave.txt
    "$@" "$HALFSHELL" "$kind.in" -log log >out 2>err || code=$?
    [ "$code" = 2 ] || fail "$kind: exit code $code: $(cat err)"
    [ "$(wc -l <err)" = 1 ] && grep -q "'small/run.*No space left on device" err || fail "$kind: $(cat err)"
    file=$(sed -n "s/.*'halfshell resume \([^']*\)' goes on from there/\1/p" err)
    [ -s "$file" ] || fail "$kind: no checkpoint: $(cat err)"
    [ -z "$(ls small/*halfshell-part-* 2>/dev/null)" ] || fail "$kind: parts of files were left"
    if [ "$kind" = text ] && [ -s small/run.dump ]; then
        [ "$(tail -c 1 small/run.dump | od -An -tx1)" = " 0a" ] && [ $((($(wc -l <small/run.dump)) % 2057)) = 0 ] ||
            fail "text: not a whole number of frames: $(wc -l <small/run.dump) lines"
    fi
    rm -f small/filler
    "$HALFSHELL" resume "$file" >out 2>err || fail "$kind: resume: $(cat err)"
    for file in end.data ave.txt; do cmp "$file" "whole_$kind/$file" >&2 || fail "$kind: $file"; done
    cmp <(rows log) <(rows "whole_$kind/log") >&2 || fail "$kind: rows of the table"
    for file in "whole_$kind"/run*; do
        file=${file##*/}
        case $kind in
        h5md) if command -v h5diff >/dev/null; then h5diff "small/$file" "whole_$kind/$file" >&2 || fail "$kind: $file"; fi ;;
        gzip) cmp <(zcat "small/$file") <(zcat "whole_$kind/$file") >&2 || fail "$kind: $file" ;;
        *) cmp "small/$file" "whole_$kind/$file" >&2 || fail "$kind: $file" ;;
        esac
    done
    rm -f small/*
}

if [ -z "$(ldd "$HALFSHELL" | grep -E 'asan|ubsan' || true)" ] &&
    "${CC:-cc}" -shared -fPIC -O1 -o full.so "$PROJECT_ROOT/tests/fault/preload/full_disk.c" -ldl; then
    for kind in text gzip h5md; do
        held_up "$kind" env LD_PRELOAD="$folder/full.so" FULL_NAME=small/run FULL_BYTES=1500000
    done
    held_up dcd env LD_PRELOAD="$folder/full.so" FULL_NAME=small/run FULL_BYTES=300000 # 12 of 21 frames
    # The very first snapshot of a run, too.
    for kind in text gzip; do
        held_up "$kind" env LD_PRELOAD="$folder/full.so" FULL_NAME=small/run FULL_BYTES=1000
    done
else
    echo "no preloaded library here"
fi
if mount -t tmpfs -o size=20m halfshell-test small 2>/dev/null; then
    mounted=yes
    for kind in text gzip h5md dcd files; do
        rm -rf small/*
        head -c "$(if [ "$kind" = dcd ]; then echo 20700000; else echo 19000000; fi)" /dev/zero >small/filler
        held_up "$kind" env
    done
    # The checkpoint's own disk: the one before stays whole, and is told.
    head -c 18500000 /dev/zero >small/filler
    sed 's/^thermo 2/&\ncheckpoint every 4 steps keep 100 file small\/c.*.h5/; /^dump/d' text.in >own.in
    code=0
    "$HALFSHELL" own.in -log none >out 2>err || code=$?
    if [ "$code" = 0 ]; then fail "checkpoints of own.in fitted: make the disk smaller"; fi
    [ "$code" = 2 ] && grep -q "No space left on device" err || fail "own.in: exit code $code: $(cat err)"
    file=$(sed -n "s/.*'halfshell resume \([^']*\)' goes on from there/\1/p" err)
    [ -s "$file" ] || fail "own.in: $(cat err)"
    [ -z "$(ls small/*halfshell-part-* 2>/dev/null)" ] || fail "own.in: parts of files were left"
    mv "$file" last.h5 && rm small/*
    "$HALFSHELL" resume last.h5 >out 2>err || fail "own.in: resume: $(cat err)"
    cmp end.data whole_text/end.data || fail "own.in: other bits"
else
    echo "no file system can be mounted here: the part with 20 MB is left out"
fi
