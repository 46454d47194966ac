#!/bin/bash
# Sums that fixes put together when they are read: the same at steps without output as where output reads them at every step, read
# once or twice, on any number of threads; and forces on all atoms add up to nothing.
set -u
. "$PROJECT_ROOT/tests/support/folder.sh"

deck() { # EVERY: steps of the output
    cat <<D
units lj
dimension 2
lattice hex 0.7
region box block 0 20 0 20 -0.25 0.25
create_box 1 box
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 1.12246
pair_coeff 1 1 1.0 1.0
region left block INF 10 INF INF INF INF
group left region left
group right subtract all left
velocity all create 1.0 482748
fix move all nve
fix push all addforce 0.5 0.0 0.0
fix ball all indent 10.0 sphere 10 8 0 3
fix a left setforce NULL NULL NULL
fix b right setforce NULL NULL NULL
variable x equal f_push[1]
variable y equal f_push[2]
thermo_style custom step f_push f_ball f_a[1] f_b[2]
thermo $1
run 30 every 7 "print 'read \$(f_push:%.17g) \$(f_ball:%.17g) \$(f_ball[1]:%.17g) \$(f_a[1]:%.17g) \$(f_b[2]:%.17g) \$(f_b[2]:%.17g)'" &
 "print 'zero \$(v_x) \$(v_y)'"
D
}

deck 1000 >in.seldom
deck 1 >in.often
for run in "seldom 1" "seldom 3" "often 1" "often 3"; do
    read -r name threads <<<"$run"
    "$HALFSHELL" -in "in.$name" -log none -threads "$threads" >out 2>&1 || fail "$run: $(tail -1 out)"
    grep '^read' out >"read.$name.$threads"
    grep '^zero' out | awk '{if ($2^2 > 1e-16 || $3^2 > 1e-16) exit 1}' || fail "$run: forces do not add up: $(grep '^zero' out)"
    [ "$(sort -u "read.$name.$threads" | wc -l)" = 5 ] || fail "$run: not five values: $(cat "read.$name.$threads")"
    cmp "read.seldom.1" "read.$name.$threads" >&2 || fail "$run"
done
