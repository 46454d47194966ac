#!/bin/sh
# Makes the .values files beside this script again from LAMMPS (Debian's lmp, 29 Sep 2021): the tables of thermo output, and
# every file that a deck writes, each after a line "== NAME". Usage: sh make.sh [lmp]
set -e

# rows FILE: a dump local of pairs with the columns index, two ids, two types, any values, in Halfshell's order: lower ids first.
# LAMMPS's follows its lists, and either atom of a pair may be the first. Columns 9 to 11, if there, change their signs with that.
rows() {
    awk '
        /^ITEM: TIMESTEP/ { ++snapshot; line = 0 }
        ++line <= 9 { print snapshot, 0, 0, line "|" $0; next }
        $2 > $3 {
            swap = $2; $2 = $3; $3 = swap
            swap = $4; $4 = $5; $5 = swap
            for (k = 9; k <= 11 && k <= NF; ++k) $k = $k ~ /^-/ ? substr($k, 2) : "-" $k
        }
        { print snapshot, $2, $3, 0 "|" $0 }
    ' "$1" | sort -s -k1,1n -k2,2n -k3,3n | cut -d "|" -f 2- | awk '
        /^ITEM: TIMESTEP/ { line = 0 }
        ++line > 9 { $1 = line - 9 }
        { print }
    '
}

lmp=${1:-lmp}
cd "$(dirname "$0")"
for deck in *.deck; do
    name=${deck%.deck}
    scratch=$(mktemp -d)
    cp "$deck" "$scratch/in"
    (cd "$scratch" && "$lmp" -in in -log log.lammps -screen none)
    {
        echo "== log"
        awk '/^ *Step /{t = 1} /^Loop/{t = 0} t {print}' "$scratch/log.lammps"
        for file in "$scratch"/*; do
            case "$(basename "$file")" in in | log.lammps) continue ;; esac
            echo "== $(basename "$file")"
            case "$file" in *.rows) rows "$file" ;; *) cat "$file" ;; esac
        done
    } > "$name.values"
    rm -r "$scratch"
done
