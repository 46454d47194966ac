#!/bin/bash
# Steps at which files are written: dumps that follow a variable, restart files of both kinds at once; resumed, too. The line "Loop
# time of" ends every table, and names of LAMMPS's variants mean the styles themselves; shell mkdir.
set -u
. "$PROJECT_ROOT/tests/support/folder.sh"

is() { # WHAT GIVEN EXPECTED
    [ "$2" = "$3" ] || fail "$1: '$2' instead of '$3'"
}

cat >in.steps <<'D'
units lj
shell mkdir -p res
shell mkdir res
lattice fcc 0.8442
region box block 0 3 0 3 0 3
create_box 1 box
create_atoms 1 box
mass 1 1.0
pair_style lj/cut/opt 2.5
pair_coeff 1 1 1.0 1.0
neighbor 0.3 multi
neigh_modify delay 0 every 1 check yes binsize 1.5 collection/interval 2 1.0 2.6 once no
comm_modify mode multi reduce/multi cutoff/multi 1 3.0 vel yes
velocity all create 1.44 87287 loop geom
fix 1 all nve/kk
fix 2 all momentum 10 linear 1 1 1
compute k all ke/atom/omp
checkpoint every 70 steps file c.*.h5 keep 100
restart 100 res/a.restart res/b.restart
restart 50 res/r.*.restart
thermo 50
variable f equal stride(0,100000,60)
variable g equal logfreq(10,3,10)
dump 1 all custom 1000 frames/all/d.dump id x y z
dump_modify 1 sort id every v_f
shell mkdir frames/all/
dump 2 all custom 10 e.dump id x y z c_k
dump_modify 2 sort id every v_g first yes
run 100
dump_modify 2 every 30
run 150
run 10 post no
run 10 pre no post no
D

steps() { # of a dump
    grep -A1 TIMESTEP "$1" | grep '^[0-9]' | paste -s -d ' '
}

# What LAMMPS of 29 Sep 2021 gives.
mkdir first && cd first || exit 1
"$HALFSHELL" -in ../in.steps -log log >out 2>&1 || fail "$(tail -1 out)"
is "steps of stride" "$(steps frames/all/d.dump)" "60 120 180 240"
is "steps of logfreq, then every 30" "$(steps e.dump)" "0 10 20 30 100 120 150 180 210 240 270"
is "restart files" "$(echo res/*.restart | tr ' ' '\n' | sort | tr '\n' ' ')" \
    "res/a.restart res/b.restart res/r.100.restart res/r.150.restart res/r.200.restart res/r.250.restart res/r.50.restart "
is "tables and their ends" "$(grep -c '^Step' log) $(grep -c '^Loop time of' log)" "4 4"
cd ..

for from in 70 140 210; do
    cp -r first again && cd again || exit 1
    "$HALFSHELL" resume c.$from.h5 -log log >out 2>&1 || fail "from step $from: $(tail -1 out)"
    cmp frames/all/d.dump ../first/frames/all/d.dump >&2 || fail "stride, from step $from"
    cmp e.dump ../first/e.dump >&2 || fail "logfreq, from step $from"
    cd .. && rm -r again
done

# A file in the way; halfshell check makes nothing.
mkdir bad && cd bad || exit 1
"$HALFSHELL" check ../in.steps >out 2>&1 || fail "check: $(tail -1 out)"
[ ! -e frames ] || fail "check has made a folder"
touch frames
"$HALFSHELL" -in ../in.steps -log none >out 2>&1 && fail "a file is no folder"
is "message" "$(tail -1 out)" "../in.steps:26: error: shell mkdir: the folder 'frames/all/' cannot be made: Not a directory"
