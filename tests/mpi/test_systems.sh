#!/bin/bash
# The same system on one rank and on several gives the same thermo table. Sums of forces are added in another order, so
# numbers agree to rounding only, which grows with the chaos of the liquid: some ten steps keep it near 1e-9.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"
liquids
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

compare melt "1 2 3 4 6 8"
compare mixture "2 4"
compare plane "3 4"
compare droplet "2 8"
compare balanced "2 8"
compare slab "2 6"
compare wrapped "2 3"
compare small "2 3"
compare thin "8"
