#!/bin/bash
# Whatever goes wrong, on whichever rank: one message, the right exit code, and within seconds no rank is left (the limits
# below leave room for a busy machine).
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

# expect CODE MESSAGE COMMAND...: the exit code, and the message once among what the ranks say.
expect() {
    local code=0 wanted=$1 message=$2
    shift 2
    SECONDS=0
    "$@" >said 2>&1 || code=$?
    [ "$SECONDS" -le 120 ] || fail "$*: took $SECONDS s"
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

{ cat in.good; echo 'piar_coeff 1 1 1.0'; } >in.word
expect 1 "in.word:14: error: unknown command 'piar_coeff'" ranks 3 in.word -log none

{ cat in.good; echo 'variable x atom "1/(x-x[1])"'; echo 'group g variable x'; } >in.lone
expect 1 "division by zero" ranks 3 in.lone -log none

{ cat in.good; echo 'create_atoms 1 single 3.001 3.001 3.001'; echo 'run 100'; } >in.overlap
expect 2 "atom" ranks 2 in.overlap -log none

{ cat in.good; echo 'dump 1 all atom 2 no/such/folder/dump'; echo 'run 4'; } >in.folder
expect 2 "no/such/folder" ranks 2 in.folder -log none

{ cat in.good; echo 'dump 1 all atom 2 /dev/full'; echo 'run 4'; } >in.full
expect 2 "/dev/full" ranks 3 in.full -log none

# a file beyond the shell's limit is no different
few_blocks() { (ulimit -f 8 && ranks 0 "$@"); } # MPI needs files of its own
{ cat in.good; echo 'dump 1 all custom 1 long.dump id x y z'; echo 'run 4'; } >in.long
expect 2 "long.dump" few_blocks in.long -log none

{ cat in.good; echo 'write_data /dev/full'; } >in.data
expect 2 "/dev/full" ranks 2 in.data -log none

printf 'title\n2 atoms\n1 atom types\n0 5 xlo xhi\n0 5 ylo yhi\n0 5 zlo zhi\n\nAtoms\n\n1 1 1 1 1\n1 1 4 4 4\n' >twice.data
echo 'read_data twice.data' >in.twice
expect 1 "twice.data:11: error: atom id 1 was given on line 10 already" ranks 2 in.twice -log none

printf 'title\n2 atoms\n1 atom types\n0 5 xlo xhi\n0 5 ylo yhi\n0 5 zlo zhi\n\nAtoms\n\n1 1 1 1 1\n2 1 4 4 4\n\nVelocities\n\n1 0 0 0\n3 0 0 0\n' >none.data
echo 'read_data none.data' >in.none
expect 1 "none.data:16: error: the section Atoms has no atom with id 3" ranks 3 in.none -log none

# One rank is out of memory. Where so little memory is too little for MPI itself there is nothing to see.
cat >limited <<'S'
#!/bin/bash
ulimit -v 300000
exec "$@"
S
chmod +x limited
both() { # the second rank with little memory
    timeout -k 5 "$patience_s" mpirun --oversubscribe -np 1 "$HALFSHELL" "$@" : -np 1 ./limited "$HALFSHELL" "$@"
}
if both in.run -log none >said 2>&1; then
    expect 2 "out of memory" both in.run -var n 70 -log none
else
    echo "300 MB are too little for a rank here: not tested"
fi

# A rank is killed in mid-run: its parent, mpirun, sees it and ends the others.
mkdir killed
(cd killed && exec timeout -k 5 "$patience_s" mpirun --oversubscribe -np 3 "$HALFSHELL" ../in.run -var steps 1000000 -log log >said 2>&1) &
launcher=$!
for _ in $(seq 100); do
    sleep 0.1
    grep -q '^ *10 ' killed/log 2>/dev/null && break
done
children_of() { ps -o pid= --ppid "$1" | tr "\n" " "; }
read -r mpirun < <(children_of "$launcher") || true # there is no newline at its end
read -ra children < <(children_of "$mpirun") || true
[ "${#children[@]}" -eq 3 ] || { cat killed/said >&2; fail "${#children[@]} ranks run, not 3"; }
kill -KILL "${children[1]}"
SECONDS=0
code=0
wait "$launcher" || code=$?
[ "$SECONDS" -le 20 ] || fail "killed: the others went on for $SECONDS s"
[ "$code" -ne 0 ] || fail "killed: exit code 0"
for child in "${children[@]}"; do
    while kill -0 "$child" 2>/dev/null; do
        [ "$SECONDS" -le 20 ] || fail "killed: rank with process $child is left"
        sleep 0.1
    done
done
