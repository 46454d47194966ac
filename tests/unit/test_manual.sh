#!/bin/bash
# The committed manual, man page and completion are what the descriptors say today; else: run script/manual and commit.
set -eu
fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
"$PROJECT_ROOT/script/manual" "$fresh"
failed=0
for part in reference halfshell.1 completion; do
    diff -r "$PROJECT_ROOT/docs/$part" "$fresh/$part" || failed=1
done
[ "$failed" -eq 0 ] || { echo "stale: run script/manual and commit docs/" >&2; exit 1; }

# Every committed page must be complete: a syntax line under every entry's heading.
for page in "$fresh"/reference/*.md; do
    [ "$(wc -c <"$page")" -gt 200 ] || { echo "$page is nearly empty" >&2; exit 1; }
done

bash -n "$fresh/completion/halfshell.bash"
# What bash offers after "halfshell check -" and after "halfshell -echo l".
offers() {
    bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _halfshell; echo "${COMPREPLY[*]}"' \
        offers "$fresh/completion/halfshell.bash" "$@"
}
[[ " $(offers halfshell check -) " == *" -neigh "* ]]
[[ " $(offers halfshell check -) " != *" -log "* ]]
[[ " $(offers halfshell -echo l) " == *" log "* ]]
[ "$(offers halfshell run -precision '')" = "double mixed" ]
[ "$(offers halfshell plot -style p)" = points ]
[[ " $(offers halfshell check -isa '') " == *" portable "* ]]
(cd "$fresh" && touch 'a deck.in' && [ "$(offers halfshell run 'a d')" = "a deck.in" ])
[ "$(bash -c 'cd "$2"; source "$1"; COMP_WORDS=(halfshell run a); COMP_CWORD=2; _halfshell; echo "${#COMPREPLY[@]}"' offers \
    "$fresh/completion/halfshell.bash" "$fresh")" = 1 ]
[[ " $(offers halfshell help lj) " == *" lj/cut "* ]]
[[ " $(offers halfshell be) " == *" bench "* ]]

# Every subcommand explains itself, and `help` knows it.
for subcommand in run resume check bench plot report help; do
    page=$("$HALFSHELL" "$subcommand" --help)
    [[ $page == "Usage: halfshell $subcommand "* ]] || { echo "$subcommand --help: $page" >&2; exit 1; }
    [[ $("$HALFSHELL" help "$subcommand") == *"$page" ]] || { echo "help $subcommand lacks its options" >&2; exit 1; }
done

# The man page is well-formed where a formatter is installed.
if command -v man >/dev/null 2>&1 && command -v groff >/dev/null 2>&1; then
    warnings=$(groff -man -Tascii -ww -z "$fresh/halfshell.1" 2>&1)
    [ -z "$warnings" ] || { echo "$warnings" >&2; exit 1; }
fi
