#!/bin/bash
# A run of several ranks that is killed or asked to stop goes on, on other numbers of ranks and threads, to the bits of the run
# left alone on one rank.
# shellcheck disable=SC2012
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

# Noise, averages and a dump that must be cut back; lists on a lax schedule, walls, a box that follows the atoms.
cat >run.in <<'END'
units lj
boundary p s f
lattice fcc 0.7
region box block 0 5 0 5 -1 5.5
region liquid block 0 5 0 5 0 4.9
create_box 2 box
create_atoms 1 region liquid
set group all type/fraction 2 0.3 4711
mass 1 1.0
mass 2 1.7
velocity all create 1.44 87287
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0 2.5
neigh_modify every 9 delay 0 check no
fix 1 all nve
fix 2 all langevin 1.2 1.0 0.7 4711
fix 3 all wall/lj93 zlo EDGE 1.0 1.0 2.5 zhi EDGE 1.0 1.0 2.5
fix 4 all ave/time 2 3 10 c_thermo_temp c_thermo_press ave running error yes file average.txt
compute chunk all chunk/atom bin/1d x lower 0.25 units reduced
fix p all ave/chunk 2 4 20 chunk temp vx error yes file profile.txt
fix w all ave/time 1 4 20 c_thermo_pe ave window 3 file window.txt overwrite
fix c all ave/correlate 5 4 40 c_thermo_temp type auto ave running error yes file correlate.txt
fix l all ave/correlate/fft 1 8 20 c_thermo_temp c_thermo_pe type full levels 3 error yes file long.txt
fix m all ave/self 2 6 20 msd vacf isf 3.0 origins 3 error yes file motion.txt
fix q all ave/spectrum 1 12 20 c_thermo_temp error yes file spectrum.txt
fix v all vector 15 c_thermo_temp
variable v equal trap(f_v)
fix 5 all momentum 7 linear 1 1 0
checkpoint every 40 steps keep 2
dump s all custom 20 s.dump id type x y z vx vy vz fx fy fz
dump_modify s format float %.17g pbc yes
dump b all dcd 20 s.dcd
thermo_style custom step temp pe etotal press pxx pyy pzz vol f_4[1] f_w v_v
thermo_modify format float %.17g flush yes
thermo 20
run 300
run 100
write_data end.data
END

# rows LOG: of the thermo table, each step once: after a resume some come twice, which must be equal.
rows() { table "$1" | sort -n | uniq; }

mkdir whole
(cd whole && ranks 0 ../run.in -log log -screen none) || fail "the run itself"
rows whole/log >whole/thermo
# the second run begins with new lists, which find pairs that the late ones had missed: two rows for step 300
[ "$(wc -l <whole/thermo)" -eq 22 ] || fail "$(wc -l <whole/thermo) rows"

# start N: the run on N ranks in the background, until step 60 has passed; sets $launcher and $child[].
start() {
    mkdir "$folder"
    (cd "$folder" && exec timeout -k 5 60 mpirun --oversubscribe -np "$1" "$HALFSHELL" ../run.in -log log >said 2>&1) &
    launcher=$!
    for _ in $(seq 3000); do
        grep -q '^ *60 ' "$folder/log" 2>/dev/null && break
        sleep 0.01
    done
    read -r mpirun < <(ps -o pid= --ppid "$launcher" | tr '\n' ' ') || true # there is no newline at its end
    read -ra child < <(ps -o pid= --ppid "$mpirun" | tr '\n' ' ') || true
    [ "${#child[@]}" -eq "$1" ] || { cat "$folder/said" >&2; fail "${#child[@]} ranks run, not $1"; }
}

# resumed N WORDS...: going on from the last checkpoint in the folder, on N ranks
resumed() {
    local n=$1 last copy=$folder-$1 file
    shift
    cp -r "$folder" "$copy"
    last=$(cd "$copy" && ls checkpoint.*.h5 | sort -t. -k2 -n | tail -1)
    [ -n "$last" ] || fail "$folder: no checkpoint"
    (cd "$copy" && ranks "$n" resume "$last" "$@" >>said 2>&1) || { cat "$copy/said" >&2; fail "$copy: resume $last"; }
    rows "$copy/log" >"$copy/thermo"
    for file in end.data s.dump s.dcd thermo average.txt profile.txt window.txt correlate.txt long.txt spectrum.txt motion.txt; do
        cmp "whole/$file" "$copy/$file" >&2 || fail "$copy: $file after resume of $last"
    done
}

folder=killed
start 2
kill -KILL "${child[1]}"
wait "$launcher" && fail "killed: exit code 0"
[ ! -e killed/end.data ] || fail "killed: the run had ended already"
resumed 0 -threads 2
resumed 3

folder=stopped
start 2
kill -TERM "${child[1]}"
code=0
wait "$launcher" || code=$?
[ "$code" -eq 3 ] || { cat stopped/said >&2; fail "SIGTERM: exit code $code"; }
[ "$(grep -c 'halfshell resume checkpoint\.[0-9]*\.h5' stopped/said)" -eq 1 ] || { cat stopped/said >&2; fail "SIGTERM: no message"; }
resumed 0
resumed 3 -threads 2
