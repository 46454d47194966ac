#!/bin/bash
# All neighbor methods, threads and ranks together: the same thermo table as on one rank with the default method, to the
# rounding of a dozen steps.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

# head and tail of all decks; what stands between makes the system
common='thermo_style custom step atoms temp epair etotal press pxx pyy pzz pxy pxz pyz
thermo_modify format float %.12g lost error
'
deck() { # NAME STEPS, the system on standard input
    { cat; printf '%sthermo 4\nrun %s\n' "$common" "$2"; } >"in.$1"
}

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
compare() { # SYSTEM "RANKS..." WORDS...: words of the runs on several ranks
    local name=$1 counts=$2 n
    shift 2
    ranks 0 "in.$name" -log "log.$name.0" -screen none
    table "log.$name.0" >"$name.0"
    for n in $counts; do
        ranks "$n" "in.$name" -log "log.$name.$n" -screen none "$@" || fail "$name on $n ranks: exit code $?"
        table "log.$name.$n" >"$name.$n"
        same_numbers "$name.0" "$name.$n" 1e-8
    done
}

compare melt "2 3" -threads 2
for method in nsq linked incremental hash cell verlet; do compare melt 4 -neigh "$method"; done
compare mixture 3 -neigh cell -threads 2
compare mixture 2 -neigh hash
compare plane 2 -neigh cell
compare plane 3 -neigh linked
compare wrapped 4 -neigh cell
compare wrapped 3 -neigh incremental
compare thin 6 -neigh nsq
compare thin 5 -neigh verlet
