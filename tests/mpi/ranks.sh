#!/bin/bash
# Shared by the tests in this folder: run a deck on several ranks, and compare tables of numbers.
# Sourced with $HALFSHELL set; works in a directory of its own, which goes at the end.

command -v mpirun >/dev/null 2>&1 || { echo "no mpirun here"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
work=$(mktemp -d)
# Nothing that was started stays behind: neither a launcher in the background, nor one that hangs (see ranks).
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cd "$work" || exit 1

fail() { echo "FAILED: $*" >&2; exit 1; }

# ranks N WORDS...: the program on N ranks; N = 0 is one rank without mpirun.
ranks() {
    local n=$1
    shift
    if [ "$n" -eq 0 ]; then
        timeout -k 5 60 "$HALFSHELL" "$@"
    else
        timeout -k 5 60 mpirun --oversubscribe -np "$n" "$HALFSHELL" "$@"
    fi
}

# A build without MPI cannot run these.
if ranks 2 --version 2>&1 | grep -q 'built without MPI'; then echo "built without MPI"; exit 77; fi

# table LOG: the rows of all thermo tables of a log.
table() { awk '/^ *Step /{on=1;next} /^Loop time/{on=0} on && /^ *[0-9]/' "$1"; }

# same_numbers A B TOLERANCE: tables of as many rows, and numbers that differ by no more than the tolerance times
# (1 + their size); words that are no numbers must be equal.
same_numbers() {
    [ -s "$1" ] || fail "$1 is empty"
    [ "$(wc -l <"$1")" = "$(wc -l <"$2")" ] || fail "$1 has $(wc -l <"$1") rows, $2 has $(wc -l <"$2")"
    paste -d' ' "$1" "$2" | awk -v tolerance="$3" -v a="$1" -v b="$2" '
        function size(v) { return v < 0 ? -v : v }
        { if (NF % 2) { print a " and " b ": row " NR ": unlike numbers of columns"; bad = 1; exit }
          n = NF / 2
          for (k = 1; k <= n; ++k) {
              x = $k; y = $(k + n)
              is_number = x ~ /^[-+0-9.eE]+$/ && y ~ /^[-+0-9.eE]+$/
              if (is_number ? size(x - y) > tolerance * (1 + size(x)) : x != y) {
                  print a " and " b ": row " NR ", column " k ": " x " and " y; bad = 1; exit
              }
          } }
        END { exit bad }' >&2 || fail "$1 and $2 differ"
}
