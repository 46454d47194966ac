#!/bin/bash
# A folder of src/ includes only from itself and from folders below it in the order below; MPI and HDF5 have their places.
set -eu
cd "$PROJECT_ROOT/src"

declare -A level=([cli]=13 [deck]=12 [sim]=11 [pair]=10 [fix]=10 [compute]=10 [region]=10 [dump]=10 [io]=9 [style]=8
                  [kernel]=7 [neighbor]=6 [comm]=5 [core]=4 [parallel]=3 [base]=2)

# check PATH INCLUDED-PATH: prints what is wrong with one include, nothing when it is right.
check() {
    local from=${1%%/*} to=${2%%/*}
    [ "$1" = main.c ] && return 0
    [ "$from" = "$to" ] && return 0
    if [ -z "${level[$from]:-}" ]; then echo "src/$1: folder '$from' has no place in the order of folders"; return; fi
    if [ -z "${level[$to]:-}" ]; then echo "src/$1 includes \"$2\", which is in no known folder"; return; fi
    if [ "${level[$to]}" -ge "${level[$from]}" ]; then echo "src/$1 includes \"$2\": $from/ may not include from $to/"; fi
}

# The checker itself must be able to fail.
[ -n "$(check base/text.c sim/sim.h)" ] && [ -n "$(check pair/wca.c fix/nve.h)" ] && [ -n "$(check io/a.c pair/b.h)" ]
[ -z "$(check sim/run.c pair/wca.c)" ] && [ -z "$(check deck/cmd_run.c deck/deck.h)" ]

wrong=$(
    grep -rHoE '^[[:space:]]*#[[:space:]]*include[[:space:]]+"[^"]+"' --include='*.[ch]' . |
        sed -E 's|^\./([^:]+):.*"([^"]+)"|\1 \2|' |
        while read -r file included; do
            case $included in
            */*) check "$file" "$included" ;;
            *) echo "src/$file includes \"$included\": write the folder too" ;;
            esac
        done
    grep -rlE '#[[:space:]]*include[[:space:]]+[<"]halfshell/' --include='*.[ch]' . | grep -vE '^\./(deck/api|neighbor/cell_(list|iterator))' |
        sed 's|^\./\(.*\)|src/\1 includes a public header: deck/api* and neighbor/cell_* implement them|' || true
    grep -rlE '#[[:space:]]*include[[:space:]]+<mpi\.h>' --include='*.[ch]' . | grep -vE '^\./(parallel|comm)/' |
        sed 's|^\./\(.*\)|src/\1 includes <mpi.h>: only parallel/ and comm/ know MPI|' || true
    grep -rlE '#[[:space:]]*include[[:space:]]+<(hdf5|H5[a-zA-Z]*)\.h>' --include='*.[ch]' . | grep -vE '^\./io/' |
        sed 's|^\./\(.*\)|src/\1 includes HDF5: only io/ knows it|' || true
    grep -rlE '#[[:space:]]*include[[:space:]]+<omp\.h>' --include='*.[ch]' . | grep -vE '^\./parallel/' |
        sed 's|^\./\(.*\)|src/\1 includes <omp.h>: ask parallel/parallel.h|' || true
)
[ -z "$wrong" ] || { echo "$wrong" >&2; exit 1; }
