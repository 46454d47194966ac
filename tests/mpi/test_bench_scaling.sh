#!/bin/bash
# `halfshell bench scaling`: a table whose rows hold together. Times are not judged: they belong to the machine.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"
command -v gnuplot >/dev/null 2>&1 || { echo "no gnuplot here"; exit 77; }
[ "$(nproc)" -ge 2 ] || { echo "one core only"; exit 77; }

bench() { timeout -k 5 100 "$HALFSHELL" bench scaling "$@"; }
bench -size 5 -steps 10 -repeat 2 -ranks 1,2 -threads 1,2 -out out >said || { cat said out/*.txt >&2; fail "exit code $?"; }
[ "$(wc -l <out/scaling.csv)" -ge 13 ] || fail "$(cat out/scaling.csv)" # 3 points of 4 series on two cores, more on more
for picture in strong weak; do [ "$(head -c 4 "out/scaling-$picture.png" | tail -c 3)" = PNG ] || fail "$picture"; done
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) c[$k] = k; next }
    function wrong(what) { print what ": " $0; bad = 1 }
    { n = $c["ranks"] * $c["threads"]; atoms = $c["system"] == "uniform" ? 500 : 480
      if ($c["scaling"] == "weak") atoms *= n
      if ($c["atoms"] < 0.8 * atoms || $c["atoms"] > 1.2 * atoms) wrong("atoms")
      if ($c["system"] == "uniform" && $c["atoms"] != atoms) wrong("atoms")
      if ($c["seconds"] <= 0 || $c["efficiency"] <= 0 || $c["pair_s"] <= 0) wrong("times")
      if (n == 1 && $c["efficiency"] != 1) wrong("efficiency")
      if (($c["ranks"] > 1) != ($c["bytes_forward_per_step"] > 0)) wrong("bytes")
      if ($c["bytes_forward_per_step"] != $c["bytes_back_per_step"]) wrong("sent by all, received by all") }
    END { exit bad }' out/scaling.csv >&2 || fail "the table"

refused() { # MESSAGE WORDS...
    local message=$1
    shift
    if bench "$@" >said 2>&1; then fail "$* was accepted"; fi
    grep -q -- "$message" said || { cat said >&2; fail "$*: no message '$message'"; }
}
refused "-ranks: '0' is not a whole number from 1 to 1000000" -ranks 1,0
refused "-neigh is not for 'halfshell bench scaling', which knows -ranks" -neigh cell
refused "-out needs FOLDER after it" -out
