#!/bin/bash
# What dumps remember between snapshots goes on in runs that are resumed: the files that `maxfiles` keeps, the view of pictures.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >run.in <<'END'
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
fix 1 all nve
checkpoint every 7 steps keep 9
dump few all atom 2 few.*.dump
dump_modify few maxfiles 3 pad 4
dump seen all image 4 seen.*.ppm type type size 40 40
dump last all image 4 last.*.ppm type type size 40 40 center d 0.5 0.5 0.5
dump_modify last maxfiles 2
run 5
change_box all x scale 1.3 remap
run 20
END
mkdir whole again
(cd whole && "$HALFSHELL" ../run.in -log none >/dev/null 2>../err) || fail "$(cat err)"
[ "$(cd whole && echo few.*)" = "few.0020.dump few.0022.dump few.0024.dump" ] || fail "maxfiles: $(ls whole)"
for from in 7 14; do
    rm -rf again
    cp -r whole again
    # as it was at that step, of files that are older or newer than those that are kept
    rm again/few.* again/seen.* again/last.*
    case $from in 7) steps="0002 0004 0006" pictures="0 4" ;; *) steps="0010 0012 0014" pictures="8 12" ;; esac
    for step in $steps; do touch "again/few.$step.dump"; done
    for step in $pictures; do touch "again/last.$step.ppm"; done
    checkpoint=$(cd again && echo ./*."$from".h5)
    (cd again && "$HALFSHELL" resume "$checkpoint" -log none >/dev/null 2>../err) || fail "from $from: $(cat err)"
    (cd whole && ls few.* last.*) >expected
    (cd again && ls few.* last.*) | diff expected - >&2 || fail "from $from: other files are left"
    for picture in again/*.ppm again/few.*; do
        cmp "$picture" "whole/${picture#again/}" >&2 || fail "from $from: $picture is another one"
    done
done
cmp -s whole/seen.8.ppm whole/last.24.ppm && fail "the view of the first box is that of the second: the test shows nothing"
exit 0
