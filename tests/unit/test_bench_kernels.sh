#!/bin/bash
# bench kernels: every form of an instruction set is in the table and in the CSV, with numbers that can be; bad options are refused.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

"$HALFSHELL" bench kernels -size 4 -repeat 1 -isa portable -out csv >out 2>err || fail "$(cat err)"
[ "$(grep -c '^portable ' out)" = 6 ] || fail "not six lines: $(cat out)"
# columns from the end: share of peak, lanes used, lanes an atom, million pairs/s, ns an atom
tail -n +2 csv/kernels.csv | awk -F, '
    { n = NF; if ($n <= 0 || $(n-1) <= 0 || $(n-1) > 1 || $(n-2) < 27 || $(n-3) <= 0 || $(n-4) <= 0) exit 1 }
    END { exit NR != 6 }' || fail "$(cat csv/kernels.csv)"

refused() { # refused WORDS OPTIONS...
    local words=$1 code=0
    shift
    "$HALFSHELL" bench kernels "$@" >out 2>err || code=$?
    [ "$code" = 1 ] || fail "$*: exit code $code"
    grep -q -- "$words" err || fail "$*: $(cat err)"
}
refused "not a whole number from 1 to 1000" -size 0
refused "not for 'halfshell bench kernels'" -threads 2
refused "-repeat needs N after it" -repeat
