#!/bin/bash
# Shared by the tests in this folder: run a deck on several ranks, and compare tables of numbers.
# Sourced with $HALFSHELL and $PROJECT_ROOT set; works in a directory of its own, which goes at the end.

command -v mpirun >/dev/null 2>&1 || { echo "no mpirun here"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
# shellcheck source=tests/support/folder.sh
. "$PROJECT_ROOT/tests/support/folder.sh"
# Nothing that was started stays behind: neither a launcher in the background, nor one that hangs (see ranks).
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM

# A run of a second takes minutes when eight ranks share two cores with other programs: the limit ends what hangs.
patience_s=240

# ranks N WORDS...: the program on N ranks; N = 0 is one rank without mpirun.
ranks() {
    local n=$1
    shift
    if [ "$n" -eq 0 ]; then
        timeout -k 5 "$patience_s" "$HALFSHELL" "$@"
    else
        timeout -k 5 "$patience_s" mpirun --oversubscribe -np "$n" "$HALFSHELL" "$@"
    fi
}

# A build without MPI cannot run these.
if ranks 2 --version 2>&1 | grep -q 'built without MPI'; then echo "built without MPI"; exit 77; fi

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

# deck NAME STEPS, the system on standard input: in.NAME, with thermo rows of all sums over atoms and pairs.
deck() {
    {
        cat
        echo 'thermo_style custom step atoms temp epair etotal press pxx pyy pzz pxy pxz pyz'
        printf 'thermo_modify format float %%.12g lost error\nthermo 4\nrun %s\n' "$2"
    } >"in.$1"
}

# compare NAME "RANKS..." WORDS...: in.NAME on so many ranks, with these words, and on one without: the same numbers to the rounding of a
# dozen steps.
compare() {
    local name=$1 counts=$2 n
    shift 2
    ranks 0 "in.$name" -log "log.$name.0" -screen none
    table "log.$name.0" >"$name.0"
    for n in $counts; do
        ranks "$n" "in.$name" -log "log.$name.$n" -screen none "$@" || fail "$name on $n ranks: exit code $?"
        table "log.$name.$n" >"$name.$n"
        same_numbers "$name.0" "$name.$n" "${tolerance:-1e-8}"
    done
}

# liquids: decks of liquids that fill their boxes: a melt, a mixture with exclusions, a plane, one that is shrink-wrapped, and one cut into
# bricks thinner than the cutoff.
liquids() {
deck melt 12 <<'D'
lattice fcc 0.8442
region box block 0 5 0 6 0 7
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neighbor 0.3 bin
neigh_modify every 4 delay 0 check no
fix 1 all nve
D
deck mixture 12 <<'D'
lattice fcc 0.8
region box block 0 6 0 5 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/ratio 2 0.3 4711
mass 1 1.0
mass 2 2.5
velocity all create 1.5 12345 dist gaussian rot yes
group heavy type 2
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
pair_coeff 2 2 0.5 1.1 1.8
neighbor 0.4 bin
neigh_modify every 1 delay 0 check yes exclude group heavy heavy
fix 1 all nve
D
deck plane 16 <<'D'
dimension 2
lattice sq2 0.7
region box block 0 14 0 11 -0.5 0.5
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.0 99 loop geom
pair_style wca
pair_coeff 1 1 1.0 1.0
neighbor 0.3 bin
neigh_modify every 2 delay 0 check yes
fix 1 all nve
D
deck wrapped 16 <<'D'
boundary s p m
lattice fcc 0.7
region box block 0 5 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 2.0 4
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neigh_modify every 4 delay 0 check no
fix 1 all nve
D
deck thin 8 <<'D'
processors * 1 1
lattice fcc 0.8
region box block 0 4 0 3 0 3
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.0 4
pair_style lj/cut 3.2
pair_coeff 1 1 1.0 1.0
fix 1 all nve
D
}
