#!/bin/bash
# Two dimensions: where nothing can leave the plane z, v_z and f_z are left alone (env->is_planar). A fix that could push along z, but
# does not, forbids that: dumps and rows must have the same bytes. And what pushes along z is seen, from whichever step on.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"
cat >in.deck <<'DECK'
units lj
dimension 2
atom_style hybrid dipole sphere
lattice sq 0.7
region box block 0 24 0 24 -0.5 0.5
create_box 1 box
create_atoms 1 box
set type 1 dipole/random 4711 1.0
set type 1 mass 1.0
velocity all create 1.0 87287 loop geom
pair_style wca
pair_coeff 1 1 1.0 1.0
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
include in.fixes
dump d all custom 50 out.dump id x y z vx vy vz fx fy fz mux muy muz
dump_modify d sort id format float %.17g
thermo_modify format float %.17g
thermo_style custom step temp pe press pxx pyy pzz pxz
thermo 50
include in.runs
DECK
# run NAME WORDS...
run() {
    local name=$1
    shift
    "$HALFSHELL" -in in.deck -log log "$@" >/dev/null
    table log >"$name.rows"
    mv out.dump "$name.dump"
}
same() {
    cmp "$1.dump" "$2.dump"
    cmp "$1.rows" "$2.rows"
}
echo 'run 200' >in.runs
cat >in.active <<'F'
fix m all brownian/sphere 1.0 123 gamma_t 1.0 gamma_r 0.3333
fix s all propel/self dipole 20.0
fix e all enforce2d
timestep 1e-4
F
cat >in.thermal <<'F'
fix m all nve
fix b all langevin 1.0 1.0 1.0 99
timestep 0.003
F
for kind in active thermal; do
    cp "in.$kind" in.fixes
    for method in cluster verlet cell nsq; do
        for threads in 1 2; do run "planar.$method.$threads" -neigh "$method" -threads "$threads"; done
    done
    { cat in.fixes; echo 'fix push all addforce 0.0 0.0 0.0'; } >in.more
    mv in.more in.fixes
    run pushed -neigh verlet -threads 1
    for one in planar.*.dump; do same "${one%.dump}" pushed; done
done

# Commands between steps may push along z: it is seen from then on.
cat >in.runs <<'R'
run 150 every 50 "fix lift all addforce 0.0 0.0 0.5"
R
printf 'fix m all nve\n' >in.fixes
run commands -threads 2
echo 'fix push all addforce 0.0 0.0 0.0' >>in.fixes
run pushed -threads 1
same commands pushed
moved() { awk -v when="$1" '/^ITEM: TIMESTEP/ {getline; step = $1} /^ITEM/ {next} NF > 9 && step == when && $4 > 0 {n++} END {print n + 0}' commands.dump; }
[ "$(moved 50)" -eq 0 ]
[ "$(moved 150)" -eq 576 ]
