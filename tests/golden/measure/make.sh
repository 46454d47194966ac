#!/bin/sh
# Makes the .values files beside this script again from LAMMPS (Debian's lmp, 29 Sep 2021): the tables of thermo output, and
# every file that a deck writes, each after a line "== NAME". Usage: sh make.sh [lmp]
set -e
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
            cat "$file"
        done
    } > "$name.values"
    rm -r "$scratch"
done
