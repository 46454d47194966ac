#!/bin/bash
# `halfshell check -ranks` predicts from geometry what a run then has: atoms and halo atoms of a rank, and the grid of bricks.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

# atoms at random places, so that they are spread evenly but for the fluctuations of some thousand
cat >in.gas <<'D'
region box block 0 20 0 17 0 13
create_box 1 box
create_atoms 1 random 8000 1234 NULL
mass 1 1.0
pair_style zero 2.5
pair_coeff 1 1
neighbor 0.3 bin
fix 1 all nve
run 0
D
sed 's/block 0 20 0 17 0 13/prism 0 20 0 17 0 13 9 -8 7/' in.gas >in.tilted
for run in "2 gas" "8 gas" "4 tilted"; do
    read -r n deck <<<"$run"
    ranks 0 check -ranks "$n" "in.$deck" >predicted
    ranks "$n" "in.$deck" -log log -screen none
    read -r _ grid local halo _ < <(grep -A99 '^Prediction' predicted | grep "^ *$n ")
    grep -q "  ${grid//x/ by } MPI processor grid" log || fail "$n ranks: $grid bricks predicted, not those of the log"
    [ "$local" = $((8000 / n)) ] || fail "$n ranks: $local atoms predicted"
    # images of the same atoms count several times, so fluctuations are some two per cent for each of few ranks
    awk -v halo="$halo" '/^Nghost:/ { seen = 1; if ($2 < 0.94 * halo || $2 > 1.06 * halo) bad = $2 }
        END { if (!seen || bad) { print "halo atoms: " bad ", predicted " halo; exit 1 } }' log >&2 || fail "$n ranks"
done
ranks 0 check -ranks 1000000 in.gas | grep -q '^ *1000000 .*x' || fail "a million ranks"
if ranks 0 check -ranks 8 -latency 0 in.gas 2>said; then fail "-latency 0 was accepted"; fi
grep -q "^halfshell: error: -latency: '0' is not a number above 0" said || fail "$(cat said)"
efficiency() { ranks 0 check -ranks 64 "$@" in.gas | awk '/^Prediction/ { on = 1 } on && $1 == 64 { print $NF }'; }
awk -v slow="$(efficiency -latency 50 -bandwidth 1)" -v fast="$(efficiency)" \
    'BEGIN { exit !(slow > 0 && slow < fast && fast < 100) }' || fail "a slower network is no slower"
if ranks 0 check -ranks 0 in.gas 2>said; then fail "-ranks 0 was accepted"; fi
grep -q "^halfshell: error: -ranks: '0' is not a whole number" said || fail "$(cat said)"
