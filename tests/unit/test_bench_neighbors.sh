#!/bin/bash
# `halfshell bench neighbors`: tables, CSV and pictures of one experiment; memory of `hash` goes by atoms; bad options.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=()
command -v gnuplot >/dev/null 2>&1 && out=(-out "$work/files")
"$HALFSHELL" bench neighbors -only emptiness -repeat 1 "${out[@]}" >"$work/tables"

# Columns of the memory table: volume, linked, hash. The array grows with the volume, the table does not.
awk -F'|' '/^### /{ on = $0 ~ /emptiness-memory/ } on && $2 + 0 > 0 {
        if (!n++) { linked = $3; hash = $4 }
        last_linked = $3; last_hash = $4 }
    END { exit !(n == 5 && last_linked > 100 * linked && last_hash < 1.1 * hash) }' "$work/tables" ||
    { echo "memory of the cells is not as expected:" >&2; cat "$work/tables" >&2; exit 1; }

if [ ${#out[@]} -gt 0 ]; then
    for name in emptiness emptiness-memory; do
        [ "$(head -1 "$work/files/neighbors-$name.csv")" = 'volume,"linked","hash"' ]
        [ "$(wc -l <"$work/files/neighbors-$name.csv")" -eq 6 ]
        [ "$(head -c 4 "$work/files/neighbors-$name.png" | tail -c 3)" = PNG ]
    done
fi

refused() { # MESSAGE ARGUMENTS...: exit code 1 and that message
    local message=$1 code=0
    shift
    "$HALFSHELL" "$@" >/dev/null 2>"$work/message" || code=$?
    [ "$code" -eq 1 ] && grep -qF -- "$message" "$work/message" ||
        { echo "$*: exit code $code and:" >&2; cat "$work/message" >&2; exit 1; }
}
refused "-only: 'cell' is not one of size, density, emptiness, temperature, order, cells; did you mean 'cells'?" \
    bench neighbors -only cell
refused "-repeat: '0' is not a whole number from 1 to 1000" bench neighbors -repeat 0
refused "-threads is for 'halfshell bench'; 'halfshell bench neighbors' knows -out, -only, -repeat, -precision and -isa" \
    bench neighbors -threads 2
refused "-out needs FOLDER after it" bench neighbors -out
refused "-only is for 'halfshell bench neighbors'" bench -only size
