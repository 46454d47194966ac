#!/bin/bash
# The program itself under bad conditions: files that are no decks, full disks, little memory, wrong options, signals.
# Each ends with its exit code (0 done, 1 deck or command line wrong, 2 failed, 3 interrupted) and a message, in short time.
set -u
work=$(mktemp -d)
trap 'chmod -R u+rwx "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
n_wrong=0

# expect CODE PART COMMAND...: the exit code, and a part of what is on standard error ("" for: nothing is).
expect() {
    local code=$1 part=$2 got=0
    shift 2
    timeout 60 "$@" >out 2>err </dev/null || got=$?
    [ "$got" -eq "$code" ] || { wrong "exit code $got instead of $code" "$@"; return; }
    if [ -z "$part" ]; then
        [ ! -s err ] || wrong "standard error is not empty" "$@"
    else
        grep -qF -- "$part" err || wrong "standard error does not have: $part" "$@"
    fi
}
wrong() {
    echo "$1: ${*:2}" >&2
    head -c 1000 err >&2
    n_wrong=$((n_wrong + 1))
}
limited() { # KIBIBYTES COMMAND...: with so much address space
    (ulimit -v "$1" && shift && exec "$@")
}
export -f limited

cat >good.in <<'END'
units lj
lattice fcc 0.8
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 box
mass 1 1
velocity all create 1.0 4928459
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
fix 1 all nve
variable steps index 20
thermo 5
run ${steps}
END

# Decks that are none.
: >empty.in
printf 'units lj' >no_newline.in
printf '\0\0\0' >nul.in
printf '\377\376u\0n\0i\0t\0s\0' >utf16.in
seq 1 3000 | sha256sum | head -c 32 | gzip -nc >packed.in
head -c 300000 /dev/zero | tr '\0' 'a' >one_word.in
mkdir folder
mkfifo pipe.in
expect 0 "" "$HALFSHELL" empty.in -log none
expect 0 "" "$HALFSHELL" no_newline.in -log none
expect 0 "" "$HALFSHELL" -log none
(printf '\357\273\277'; cat good.in) >marked.in # as some editors write
expect 0 "" "$HALFSHELL" marked.in -log none
expect 1 "nul.in:1: error: line 1 holds a NUL byte" "$HALFSHELL" nul.in
expect 1 "utf16.in:1: error: " "$HALFSHELL" utf16.in
expect 1 "packed.in:1: error: " "$HALFSHELL" packed.in
expect 1 "one_word.in:1: error: " "$HALFSHELL" one_word.in
expect 1 "error: the file 'folder' cannot be read" "$HALFSHELL" folder
expect 1 "error: the file 'nowhere.in' cannot be read: No such file or directory" "$HALFSHELL" nowhere.in
if [ "$(id -u)" -ne 0 ]; then
    cp good.in secret.in
    chmod 000 secret.in
    expect 1 "error: the file 'secret.in' cannot be read: Permission denied" "$HALFSHELL" secret.in
fi
[ ! -e log.halfshell ] || { wrong "a refused deck leaves a log"; rm log.halfshell; }
cat good.in >pipe.in &
expect 0 "" "$HALFSHELL" pipe.in -log none

# The deck itself is not written over.
expect 1 "error: -log: './good.in' is the deck itself" "$HALFSHELL" good.in -log ./good.in
expect 1 "error: -screen: 'good.in' is the deck itself" "$HALFSHELL" good.in -screen good.in
grep -q velocity good.in || wrong "the deck is gone" good.in

# Two integrators of the same atoms.
sed 's/^thermo 5/fix 2 all nvt temp 1 1 0.5\nthermo 5/' good.in >twice.in
expect 0 "" "$HALFSHELL" twice.in -log none
grep -q "WARNING: fix '1' (nve) and fix '2' (nvt) both move atoms, 256 of them the same" out || wrong "no warning" twice.in

# More threads than cores.
n_threads=$(($(nproc) + 1))
expect 0 "" "$HALFSHELL" good.in -log none -threads "$n_threads"
grep -q "WARNING: $n_threads threads take turns on" out || wrong "no warning" -threads "$n_threads"

# Files that cannot be written.
expect 2 "cannot write 'folder'" "$HALFSHELL" good.in -log folder
expect 2 "cannot write 'nowhere/log'" "$HALFSHELL" good.in -log nowhere/log
expect 2 "cannot write 'folder'" "$HALFSHELL" good.in -log none -screen folder
# `log none` is no file, even where no file of that name could be written
mkdir none && { echo "log none"; cat good.in; } >none.in
expect 0 "" "$HALFSHELL" none.in -log none -screen none
rmdir none
if [ -e /dev/full ]; then
    expect 2 "the log file could not be written in full" "$HALFSHELL" good.in -log /dev/full
    expect 2 "the screen output could not be written in full" "$HALFSHELL" good.in -log none -screen /dev/full
    # shellcheck disable=SC2016 # for the inner shell
    expect 2 "the screen output could not be written in full" bash -c '"$HALFSHELL" good.in -log none >/dev/full'
    # a long run does not go on into the void
    expect 2 "the log file could not be written in full" "$HALFSHELL" good.in -log /dev/full -var steps 100000000
    # neither does what is no run
    for words in --help --version help 'help lj/cut' 'check good.in' 'bench -size 3 -steps 5 -repeat 1 -threads 1'; do
        # shellcheck disable=SC2016 # for the inner shell
        expect 2 "the screen output could not be written in full" bash -c '"$HALFSHELL" '"$words"' >/dev/full'
    done
    { cat good.in; echo "log second.log"; } >two_logs.in
    expect 2 "two_logs.in:14: error: log: " "$HALFSHELL" two_logs.in -log /dev/full
fi

# Standard streams that are closed: what was meant for them must not get into files that take their numbers.
"$HALFSHELL" -in - -log closed.log <good.in >&- 2>/dev/null || true
[ "$(grep -c '^Halfshell ' closed.log)" = 1 ] || wrong "closed output: the log holds the screen's text, too"

# A place far from the origin, where a length of the box is less than its last digit.
cat >far.data <<'DATA'
far

1 atoms
1 atom types
9007199254740000 9007199254740001 xlo xhi
0 1 ylo yhi
0 1 zlo zhi

Masses

1 1

Atoms

1 1 9007199254740996 0 0
DATA
echo "read_data far.data" >far.in
expect 0 "" timeout 20 "$HALFSHELL" far.in -log none

# The command line.
expect 1 "unknown option '-bogus'" "$HALFSHELL" good.in -bogus
expect 1 "-log needs" "$HALFSHELL" good.in -log
expect 1 "-threads: '0'" "$HALFSHELL" good.in -threads 0
expect 1 "-threads: '1e9'" "$HALFSHELL" good.in -threads 1e9
expect 1 "-neigh" "$HALFSHELL" good.in -neigh sideways
expect 1 "there is no instruction set 'z80'; expected auto" "$HALFSHELL" good.in -isa z80
expect 1 "second.in" "$HALFSHELL" good.in second.in

# What a deck prints into files and reads again, halfshell check knows without writing any; what is left there from before does not count.
cat >prints.in <<'END'
variable n equal 3
print "print 'n is $n'" file part.in
print "jump prints.in there" append part.in
print "7 # comment" file numbers.txt
print "8" append numbers.txt
include part.in
quit
label there
variable f file numbers.txt
next f
print "f is $f"
units lj
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 single 1 1 1
print "1" file set.txt
print "1 2.5" append set.txt
variable q atomfile set.txt
print "q is $(v_q[1])"
if "$f == 8" then "include more.in"
END
echo "nonsense" >numbers.txt
expect 1 "prints.in:20: error: the file 'more.in' cannot be read" "$HALFSHELL" check prints.in
for line in "n is 3" "f is 8" "q is 2.5"; do
    grep -qx "$line" out || wrong "halfshell check does not say: $line" prints.in
done
if [ -e part.in ] || [ -e set.txt ] || [ "$(cat numbers.txt)" != nonsense ]; then
    wrong "halfshell check has written files" prints.in
fi
rm numbers.txt

# More atoms than there can be, and less memory than is needed.
sed 's/block 0 4 0 4 0 4/block 0 1e4 0 1e4 0 1e4/' good.in >huge.in
expect 2 "huge.in:5: error: " "$HALFSHELL" huge.in -log none
sed 's/block 0 4 0 4 0 4/block 0 1e300 0 1 0 1/' good.in >endless.in
expect 1 "endless.in:4: error: " "$HALFSHELL" endless.in -log none
sed 's/block 0 4 0 4 0 4/block 0 60 0 60 0 60/' good.in >large.in
sanitized=$(grep -c '^HALFSHELL_SANITIZE:.*=ON' "$BUILD_DIR/CMakeCache.txt")
if [ "$sanitized" -eq 0 ]; then # sanitizers need terabytes of address space
    # shellcheck disable=SC2016
    expect 2 "out of memory" bash -c 'limited 100000 "$HALFSHELL" large.in -log none -var steps 1'
fi

# Signals: the step is finished and the program ends with 3.
# interrupted SIGNAL COMMAND...
interrupted() {
    local signal=$1 got=0 pid
    shift
    "$@" >out 2>err </dev/null &
    pid=$!
    for _ in $(seq 200); do
        grep -q "^Step" signal.log 2>/dev/null && break
        sleep 0.1
    done
    kill "-$signal" "$pid"
    wait "$pid" || got=$?
    [ "$got" -eq 3 ] || wrong "after $signal the exit code is $got instead of 3" "$@"
    grep -q "stopped by a signal" err || wrong "after $signal no word of it" "$@"
    rm -f signal.log
}
sed 's/^run/thermo_modify flush yes\nrun/' good.in >long.in
interrupted TERM "$HALFSHELL" long.in -log signal.log -var steps 100000000
interrupted INT "$HALFSHELL" long.in -log signal.log -var steps 100000000 -threads 2

[ "$n_wrong" -eq 0 ]
