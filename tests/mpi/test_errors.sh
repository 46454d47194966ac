#!/bin/bash
# Whatever goes wrong, on whichever rank: one message, the right exit code, and within five seconds no rank is left.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

most_ms=5000
good_ms=()
now_ms() { echo $((${EPOCHREALTIME/[.,]/} / 1000)); }

# is_left: whether a process of the program is left that works here
is_left() {
    local process
    for process in /proc/[0-9]*; do
        [ "$(readlink "$process/cwd" 2>/dev/null)" != "$folder" ] ||
            [ "$(readlink "$process/exe" 2>/dev/null)" != "$(readlink -f "$HALFSHELL")" ] || return 0
    done
    return 1
}

# gone: wait until none is. What has been killed may take a moment to go after mpirun has returned.
gone() {
    for _ in $(seq 500); do
        is_left || return 0
        sleep 0.01
    done
    return 1
}

# What starting and ending ranks takes on this machine at this moment is not counted: a deck that runs to its end on as many ranks
# shows it. A machine that gets busy meanwhile has three tries.
# expect CODE MESSAGE N COMMAND...: the exit code, the message once among what the N ranks say, and the time
expect() {
    local code start took=0 wanted=$1 message=$2 n=$3
    shift 3
    for _ in 1 2 3; do
        if [ -z "${good_ms[n]:-}" ]; then
            start=$(now_ms)
            ranks "$n" in.run -log none >said 2>&1 || { cat said >&2; fail "the good deck"; }
            good_ms[n]=$(($(now_ms) - start))
        fi
        code=0
        start=$(now_ms)
        "$@" >said 2>&1 || code=$?
        gone || { cat said >&2; fail "$*: a rank is left"; }
        took=$(($(now_ms) - start - good_ms[n]))
        [ "$took" -gt "$most_ms" ] || break
        unset "good_ms[n]"
    done
    echo "$message: $n ranks gone after $took ms more than a good run takes"
    [ "$took" -le "$most_ms" ] || fail "$*: took $took ms"
    [ "$code" -eq "$wanted" ] || { cat said >&2; fail "$*: exit code $code, not $wanted"; }
    [ "$(grep -c "error:" said)" -eq 1 ] || { cat said >&2; fail "$*: not one message"; }
    grep -q -- "$message" said || { cat said >&2; fail "$*: no message '$message'"; }
}

cat >in.good <<'D'
variable n index 6
variable steps index 4
lattice fcc 0.8442
region box block 0 $n 0 $n 0 $n
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.0 87287
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
fix 1 all nve
thermo_modify flush yes
thermo 10
D
{ cat in.good; echo "run \${steps}"; } >in.run

# A deck error before the first step, met by all ranks, and by the one that has a certain atom.
{ cat in.good; echo 'piar_coeff 1 1 1.0'; } >in.word
expect 1 "in.word:14: error: unknown command 'piar_coeff'" 4 ranks 4 in.word -log none
{ cat in.good; echo 'variable x atom "1/(x-x[1])"'; echo 'group g variable x'; } >in.lone
expect 1 "in.lone:15: error: .*division by zero" 3 ranks 3 in.lone -log none

# A formula that has no value in mid-run, on all ranks, and on one.
{ cat in.good; printf 'variable v equal 1/(step-20)\nthermo_style custom step v_v\nrun 40\n'; } >in.thermo
expect 1 "in.thermo:16: error: .*division by zero" 2 ranks 2 in.thermo -log none
{ cat in.good; printf 'variable f atom 1/((id-17)^2+(step-20)^2)\nfix f all addforce v_f 0 0\nrun 40\n'; } >in.force
expect 1 "in.force:16: error: .*division by zero" 4 ranks 4 in.force -log none

# Atoms that overlap, that are lost, that are thrown out of all numbers.
{ cat in.good; echo 'create_atoms 1 single 3.001 3.001 3.001'; echo 'run 100'; } >in.overlap
expect 2 "in.overlap:15: error: .*atom" 2 ranks 2 in.overlap -log none
{ echo 'boundary p p f'; sed 's/^lattice.*/& origin 0.25 0.25 0.25/' in.good; printf 'group g id 99\nvelocity g set 0 0 90 units box\nrun 100\n'; } >in.lost
expect 2 "in.lost:17: error: at step .* atom 99 at .* has left the box" 4 ranks 4 in.lost -log none
grep -q "The atoms of step 0, before it happened, are in 'failed.10.dump'" said || { cat said >&2; fail "no picture"; }
[ "$(grep -A1 TIMESTEP failed.10.dump | grep -c -x -E '0|10')" -eq 2 ] || fail "failed.10.dump: $(grep -A1 TIMESTEP failed.10.dump)"
awk '/^ITEM: TIME/ { ++frame } $1 == 99 && NF == 8 { z[frame] = $5 } END { exit !(z[1] > 0 && z[1] < 10 && (z[2] < 0 || z[2] > 10)) }' failed.10.dump ||
    fail "failed.10.dump: atom 99"
mv failed.10.dump failed.ranks
ranks 0 in.lost -log none >said 2>&1 || true
cmp failed.10.dump failed.ranks >&2 || fail "failed.10.dump of one rank and of four differ"
{ cat in.good; printf 'group g id 17\nfix f g addforce 1e300 0 0\nrun 40\n'; } >in.thrown
expect 2 "in.thrown:16: error: at step 1 atom 17" 4 ranks 4 in.thrown -log none

# Files that cannot be written: no folder (which is known before anything runs), a full disk from the first byte on and in mid-run, a limit of the shell.
{ cat in.good; echo 'dump 1 all atom 2 no/such/folder/dump'; echo 'run 4'; } >in.folder
expect 1 "no/such/folder" 2 ranks 2 in.folder -log none
{ cat in.good; echo 'dump 1 all atom 2 /dev/full'; echo 'run 4'; } >in.full
expect 2 "/dev/full" 4 ranks 4 in.full -log none
{ cat in.good; echo 'write_data /dev/full'; } >in.data
expect 2 "/dev/full" 2 ranks 2 in.data -log none
small_disk() { # on four ranks, the first of which finds the disk full in mid-run
    timeout -k 5 "$patience_s" mpirun --oversubscribe -np 1 env LD_PRELOAD=./full.so FULL_NAME="$folder/small" FULL_BYTES=500000 \
        "$HALFSHELL" "$@" : -np 3 "$HALFSHELL" "$@"
}
for format in "custom 2 small id x y z" "h5md 2 small position velocity"; do
    { cat in.good; echo "dump 1 all $format"; echo 'run 400'; } >in.small
    if [ -z "$(ldd "$HALFSHELL" | grep -E 'asan|ubsan' || true)" ] &&
        "${CC:-cc}" -shared -fPIC -O1 -o full.so "$PROJECT_ROOT/tests/fault/preload/full_disk.c" -ldl; then
        expect 2 "small.*No space left on device" 4 small_disk in.small -log none
    fi
    rm -f small checkpoint.*
done
few_blocks() { (ulimit -f 8 && ranks 0 "$@"); } # MPI needs files of its own
{ cat in.good; echo 'dump 1 all custom 1 long.dump id x y z'; echo 'run 4'; } >in.long
expect 2 "long.dump" 0 few_blocks in.long -log none

# Files that cannot be read.
printf 'title\n2 atoms\n1 atom types\n0 5 xlo xhi\n0 5 ylo yhi\n0 5 zlo zhi\n\nAtoms\n\n1 1 1 1 1\n1 1 4 4 4\n' >twice.data
echo 'read_data twice.data' >in.twice
expect 1 "twice.data:11: error: atom id 1 was given on line 10 already" 2 ranks 2 in.twice -log none
printf 'title\n2 atoms\n1 atom types\n0 5 xlo xhi\n0 5 ylo yhi\n0 5 zlo zhi\n\nAtoms\n\n1 1 1 1 1\n2 1 4 4 4\n\nVelocities\n\n1 0 0 0\n3 0 0 0\n' >none.data
echo 'read_data none.data' >in.none
expect 1 "none.data:16: error: the section Atoms has no atom with id 3" 3 ranks 3 in.none -log none

# One rank is out of memory. Where so little memory is too little for MPI itself there is nothing to see.
cat >limited <<'S'
#!/bin/bash
ulimit -v 300000
exec "$@"
S
chmod +x limited
last_limited() { # last_limited N WORDS...: the last of N ranks with little memory
    local n=$(($1 - 1))
    shift
    timeout -k 5 "$patience_s" mpirun --oversubscribe -np "$n" "$HALFSHELL" "$@" : -np 1 ./limited "$HALFSHELL" "$@"
}
{ cat in.good; echo 'run 10'; echo 'replicate 10 10 10'; echo 'run 10'; } >in.grow
if last_limited 2 in.run -log none >said 2>&1; then
    expect 2 "in.run:6: error: out of memory" 2 last_limited 2 in.run -log none -var n 80
    expect 2 "in.grow:15: error: out of memory" 4 last_limited 4 in.grow -log none -var n 10
else
    echo "300 MB are too little for a rank here: not tested"
fi

# A rank is killed in mid-run. Its watcher, which mpirun has started, tells it; mpirun ends the others. When the watcher itself is killed,
# the rank goes with it, and mpirun knows no more than the signal.
children_of() { ps -o pid= --ppid "$1" | xargs; } # there is no newline at its end

# killed N NUMBER WHO CODE: kill the rank or the watcher of that number; `took`: milliseconds until all are gone
killed() {
    local launcher mpirun watchers ranks=() watcher code=0 start
    rm -f log
    (exec timeout -k 5 "$patience_s" mpirun --oversubscribe -np "$1" "$HALFSHELL" in.run -var steps 1000000 -log log >said 2>&1) &
    launcher=$!
    for _ in $(seq 600); do
        grep -q '^ *10 ' log 2>/dev/null && break
        sleep 0.1
    done
    mpirun=$(children_of "$launcher")
    read -ra watchers <<<"$(children_of "$mpirun")"
    for watcher in "${watchers[@]}"; do ranks+=("$(children_of "$watcher")"); done
    [ "${#ranks[@]}" -eq "$1" ] || { cat said >&2; fail "${#ranks[@]} ranks run, not $1"; }
    start=$(now_ms)
    case $3 in
    rank) kill -KILL "${ranks[$2]}" ;;
    watcher) kill -KILL "${watchers[$2]}" ;;
    esac
    wait "$launcher" || code=$?
    gone || fail "killed: a rank is left"
    took=$(($(now_ms) - start))
    echo "$3 $2 of $1 killed: all gone after $took ms, exit code $code"
    [ "$code" -eq "$4" ] || { cat said >&2; fail "killed: exit code $code, not $4"; }
    [ "$took" -le "$most_ms" ]
}
for who in "4 0 rank 2" "2 1 rank 2" "2 0 watcher 137"; do
    # shellcheck disable=SC2086 # four words
    killed $who || killed $who || fail "killed: the others went on for $took ms"
    [ "${who##* }" -ne 2 ] || [ "$(grep -c "error: rank [0-9]* (process [0-9]*) was ended by signal 9" said)" -eq 1 ] ||
        { cat said >&2; fail "killed: not one message"; }
done
