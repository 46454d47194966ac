#!/bin/bash
# fix ave/correlate/long: the numbers of ave/correlate/fft with levels, lags as times, and only those that have samples; a file that
# grows or is overwritten; the same after a run was resumed.
set -u
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >in.long <<'D'
units lj
lattice fcc 0.8442
region box block 0 3 0 3 0 3
create_box 1 box
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
velocity all create 1.44 87287 loop geom
timestep 0.004
variable p equal pxy
variable q equal pxz
fix 1 all nve
fix L all ave/correlate/long 2 60 v_p v_q type full nlen 8 ncorr 3 ncount 2 file long.txt overwrite
fix G all ave/correlate/long 2 60 v_p v_q type full nlen 8 ncorr 3 file grown.txt
fix D all ave/correlate/long 2 60 v_p file default.txt
fix F all ave/correlate/fft 2 8 60 v_p v_q type full levels 3 file fft.txt
checkpoint every 35 steps file c.*.h5 keep 9
run 120
D
"$HALFSHELL" -in in.long -log none >out 2>&1 || fail "$(tail -1 out)"
awk '/^#/ {next} NF > 2 && $3 > 0 {printf "%.10g", $2 * 0.004; for (k = 4; k <= NF; ++k) printf " %s", $k; print ""}' fft.txt >expected
grep -v '^#' long.txt >given
cmp expected given >&2 || fail "not the numbers of ave/correlate/fft"
[ "$(wc -l <given)" = 16 ] || fail "$(wc -l <given) lags"
[ "$(sed -n 2p long.txt)" = "# Time v_p*v_p v_p*v_q v_q*v_p v_q*v_q" ] || fail "$(sed -n 2p long.txt)"
[ "$(grep Timestep grown.txt | tr '\n' ' ')" = "# Timestep: 0 # Timestep: 60 # Timestep: 120 " ] || fail "$(grep Timestep grown.txt)"
[ "$(grep Timestep long.txt)" = "# Timestep: 120" ] || fail "not overwritten"
[ "$(grep -vc '^#' default.txt)" -gt 30 ] || fail "defaults"
mkdir whole && cp ./*.txt whole
"$HALFSHELL" resume c.35.h5 >out 2>&1 || fail "resume: $(tail -1 out)"
for file in long grown default; do
    cmp "$file.txt" "whole/$file.txt" >&2 || fail "$file, resumed"
done
