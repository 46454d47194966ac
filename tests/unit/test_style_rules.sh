#!/bin/bash
# Rules of the sources that a compiler does not check; of the shell scripts, what shellcheck warns of (where it is installed).
set -eu
cd "$PROJECT_ROOT"
wrong=$(
    # Only main.c ends the process.
    grep -rnE '\b(exit|_exit|_Exit|quick_exit|abort)[[:space:]]*\(' --include='*.[ch]' src include |
        grep -vE '^src/main\.c:|hs_[a-z_]*(exit|abort)|MPI_Abort|^[^:]*:[0-9]*:[[:space:]]*(/?\*|//)' |
        sed 's/^/ends the process outside main.c: /' || true
    # A file longer than 500 lines states its reason in its first 15 lines: "Length: ...".
    find src include -name '*.[ch]' | while read -r file; do
        lines=$(wc -l <"$file")
        if [ "$lines" -gt 500 ] && ! head -15 "$file" | grep -q 'Length: '; then
            echo "$file has $lines lines and no reason (a comment 'Length: ...' at its head)"
        fi
    done
    grep -rnE '\b(TODO|FIXME|XXX|HACK)\b' --include='*.[ch]' --include='*.cmake' src include tests cmake script |
        sed 's/^/unfinished: /' || true
    grep -rnP '\t| +$' --include='*.[ch]' src include | sed 's/^/tab or trailing blank: /' || true
    if command -v shellcheck >/dev/null; then
        { find tests -name '*.sh'; grep -lrE '^#!/bin/(ba)?sh' .ci script tests benchmarks; } | sort -u | xargs shellcheck -S warning || true
    fi
)
[ -z "$wrong" ] || { echo "$wrong" >&2; exit 1; }
