#!/bin/bash
# Shared by the tests of equal bits: systems in one deck, and runs of it on other ranks, threads and methods.
# Sourced with $HALFSHELL and $PROJECT_ROOT set; works in a directory of its own (ranks.sh).
# shellcheck disable=SC2034

# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

# system NAME STEPS, what makes it on standard input. Pressures and energies are sums over all pairs, temperatures over all atoms.
system() {
    echo "print '== $1'"
    cat
    cat <<D
thermo_style custom step atoms temp ke pe etotal press pxx pyy pzz pxy pxz pyz vol ${3:-}
thermo_modify format float %.17g lost error
thermo 10
dump d all custom $(($2 / 2)) $1.dump id type x y z ix iy iz vx vy vz fx fy fz ${4:-}
dump_modify d format float %.17g sort id
run $2
clear
D
}

liquid='pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0 2.5
neighbor 0.3 bin'

# fluid REGION: atoms of one type in such a box, in motion, and their pair style.
fluid() {
    cat <<D
lattice fcc 0.7
region box $*
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 12345
$liquid
D
}

# bits DECK RANKS THREADS WORDS...: the same bits as on one rank, which runs first and without mpirun.
bits() {
    local deck=$1 n=$2 threads=$3 file
    local name=$deck-$n-ranks-$threads-threads
    shift 3
    mkdir "$name"
    (cd "$name" && ranks "$n" "../in.$deck" -log log -screen none -threads "$threads" "$@") || fail "$name: exit code $?"
    table "$name/log" >"$name/thermo"
    rm "$name/log"
    if [ ! -d "$deck" ]; then
        mv "$name" "$deck"
    else
        for file in "$deck"/*; do cmp "$file" "$name/${file#*/}" >&2 || fail "$name $*: ${file#*/}"; done
        rm -r "$name"
    fi
}
