#!/bin/bash
# The decks of the package lammps-examples on Brownian and active particles, unmodified: mean-square displacements within three standard
# errors of theory. Left out (77) where they are not installed.
set -eu
examples=/usr/share/lammps/examples/PACKAGES/brownian
[ -d "$examples" ] || { echo "the package lammps-examples is not installed"; exit 77; }
. "$PROJECT_ROOT/tests/support/folder.sh"

# msd DECK: runs it, and prints the last row's c_msd[4] (column 7: after the step, two energies or so, and c_msd[1..3]) and the atoms.
msd() {
    "$HALFSHELL" -in "$examples/$1" -log log -screen none || fail "$1: exit code $?"
    awk '/^Step /{for (k = 1; k <= NF; ++k) if ($k == "c_msd[4]") column = k} /^ *[0-9]+ /{last = $column} /^Loop/{n = $(NF - 1)}
         END {print last, n}' log
}

# near DECK THEORY DIMENSION: the squared length of d normal displacements has the relative standard deviation sqrt(2 / d). (Persistent
# motion adds little to it: at these times noise is most of the displacement.)
near() {
    msd "$1" >"out"
    awk -v deck="$1" -v theory="$2" -v d="$3" '
        { error = theory * sqrt(2 / (d * $2)); off = ($1 - theory) / error
          printf "%s: %g, theory %g, %.2f standard errors\n", deck, $1, theory, off
          exit !(off > -3 && off < 3) }' out || fail "$1"
}

# 2 d D t: D = k T / gamma_t = 5, t = 0.03
near point/in2d.point 0.6 2
near point/in3d.point 0.9 3
# 2 d D t + 2 v^2 tau^2 (t / tau - 1 + exp(-t / tau)): D = 1/3, v = 4/3, tau = 1 / (2 D_r) = 1/2, t = 0.12
near spherical_ABP/in3d.ideal_abp "$(awk 'BEGIN { t = 0.12; v = 4 / 3; tau = 0.5
    print 6 * t / 3 + 2 * v * v * tau * tau * (t / tau - 1 + exp(-t / tau)) }')" 3
# Discs that push each other: slower than free ones, D = 1, v = 4, tau = 1, t = 0.2, and not stuck; the pressure of the repulsion is positive.
msd spherical_ABP/in2d.abp >out
awk '{ t = 0.2; free = 4 * t + 2 * 16 * (t - 1 + exp(-t)); exit !($1 > 0.4 * free && $1 < free) }' out || fail "in2d.abp: $(cat out)"
awk '/^Step /{for (k = 1; k <= NF; ++k) if ($k == "c_press") column = k} /^ *[0-9]+ /{last = $column} END {exit !(last > 0)}' log ||
    fail "in2d.abp: the pressure is not positive"
