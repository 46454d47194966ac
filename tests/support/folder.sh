# shellcheck shell=bash
# Shared by the tests in shell: a directory of its own, which goes at the end, and how a test fails. Sourced with $PROJECT_ROOT set; goes
# into the directory, $folder.
# shellcheck disable=SC2034 # who sources it may not need all

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

fail() { echo "FAILED: $*" >&2; exit 1; }

# table LOG: the rows of all thermo tables of a log.
table() { awk '/^ *Step /{on=1;next} /^Loop time/{on=0} on && /^ *[0-9]/' "$1"; }

# wrong WORDS...: say it and go on; n_wrong counts.
n_wrong=0
wrong() {
    echo "$*" >&2
    n_wrong=$((n_wrong + 1))
}
