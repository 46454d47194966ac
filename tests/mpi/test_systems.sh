#!/bin/bash
# The same system on one rank and on several gives the same thermo table. Sums of forces are added in another order, so
# numbers agree to rounding only, which grows with the chaos of the liquid: some ten steps keep it near 1e-9.
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
deck droplet 12 <<'D'
lattice fcc 0.8
region box block 0 20 0 20 0 20
region drop sphere 4 5 6 2.6
create_box 1 box
create_atoms 1 region drop
mass 1 1.0
velocity all create 0.7 4
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
fix 1 all nve
neighbor 0.5 bin
neigh_modify every 3 delay 0 check no
D
deck balanced 12 <<'D'
lattice fcc 0.8
region box block 0 20 0 20 0 20
region drop sphere 4 5 6 2.6
create_box 1 box
create_atoms 1 region drop
mass 1 1.0
velocity all create 0.7 4
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
fix 1 all nve
fix even all balance 4 1.0 shift zyx 10 1.0
neighbor 0.5 bin
neigh_modify every 3 delay 0 check no
run 0
balance 1.0 shift xyz 5 1.02
D
deck slab 12 <<'D'
boundary p p f
lattice fcc 0.8
region box block 0 5 0 5 0 16
region slab block 0 5 0 5 5.9 10.1
create_box 1 box
create_atoms 1 region slab
mass 1 1.0
velocity all create 0.8 4 mom yes
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
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
deck small 8 <<'D'
lattice sc 0.5
region box block 0 2 0 3 0 1
create_box 1 box
create_atoms 1 box
displace_me
mass 1 1.0
velocity all create 1.0 4
pair_style lj/cut 3.0
pair_coeff 1 1 1.0 1.0
neighbor 0.2 bin
fix 1 all nve
D
sed -i '/displace_me/d' in.small
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

compare() { # SYSTEM "RANKS..." WORDS...
    local name=$1 counts=$2 n
    shift 2
    ranks 0 "in.$name" -log "log.$name.0" -screen none "$@"
    table "log.$name.0" >"$name.0"
    for n in $counts; do
        ranks "$n" "in.$name" -log "log.$name.$n" -screen none "$@" || fail "$name on $n ranks: exit code $?"
        table "log.$name.$n" >"$name.$n"
        same_numbers "$name.0" "$name.$n" 1e-8
    done
}

compare melt "1 2 3 4 6 8"
compare mixture "2 4"
compare plane "3 4"
compare droplet "2 8"
compare balanced "2 8"
compare slab "2 6"
compare wrapped "2 3"
compare small "2 3"
compare thin "8"
