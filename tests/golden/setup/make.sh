#!/bin/sh
# Makes the .values files beside this script again from LAMMPS: box bounds (3 lines lo hi), then one line an atom by ID:
# id type x y z vx vy vz ix iy iz. Made with Debian's lmp, 29 Sep 2021; numbers are printed with 17 digits, so that they
# stand for their exact bits. Usage: sh make.sh [lmp]
set -e
lmp=${1:-lmp}
cd "$(dirname "$0")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for deck in *.deck; do
    name=${deck%.deck}
    cp "$deck" "$scratch/in"
    echo "write_dump all custom out id type x y z vx vy vz ix iy iz modify format float %.17g sort id" >> "$scratch/in"
    (cd "$scratch" && "$lmp" -in in -log none -screen none)
    awk '/BOX BOUNDS/ {b = 3; next} b > 0 {print; b--; next} /ITEM: ATOMS/ {a = 1; next} a {print}' "$scratch/out" > "$name.values"
done
