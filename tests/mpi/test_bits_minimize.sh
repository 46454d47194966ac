#!/bin/bash
# Minimisations, with boxes that relax, and a box that follows a pressure: the same bits on any ranks and threads and for every neighbor method.
set -eu
# shellcheck source=tests/mpi/bits.sh
. "$PROJECT_ROOT/tests/mpi/bits.sh"

full='thermo_style custom step pe press pxx pyy pzz pxy pxz pyz xlo xhi ylo yhi zlo zhi xy xz yz
thermo_modify format float %.17g lost error'

{
    system relaxed 10 'f_r' <<D
lattice fcc 0.8
region box block 0 5 0 4 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 1234
mass * 1.0
displace_atoms all random 0.1 0.1 0.1 4711
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
pair_coeff 2 2 1.0 0.9
pair_modify shift yes
fix 1 all nve
fix r all box/relax x 1.0 y 2.0 z 1.0 couple xz vmax 0.002 nreset 7
$full
thermo 5
minimize 0 0 60 1000
velocity all create 0.1 4711
D
    system sheared 10 'f_r xy xz yz' <<D
lattice fcc 0.8
region box prism 0 5 0 4 0 4 1 -0.7 0.5
create_box 1 box
create_atoms 1 box
mass 1 1.0
displace_atoms all random 0.1 0.1 0.1 4711
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
pair_modify shift yes
group some id 1:100
fix 1 all nve
fix r all box/relax tri 1.0 vmax 0.005
$full
thermo 5
minimize 0 0 40 1000
unfix r
fix r some box/relax y 1.0 xy 0.1 vmax 0.002 dilate partial fixedpoint 1 2 3
minimize 0 0 20 1000
velocity all create 0.1 4711
D
    system planar 10 'f_r' <<D
dimension 2
lattice sq2 0.8
region box block 0 9 0 8 -0.5 0.5
create_box 1 box
create_atoms 1 box
mass 1 1.0
displace_atoms all random 0.1 0.1 0 4711
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
pair_modify shift yes
fix 1 all nve
fix 2 all enforce2d
fix r all box/relax iso 0.5 vmax 0.002
$full
thermo 5
min_style sd
minimize 0 0 20 1000
min_style cg
minimize 0 0 60 1000
D
    system pressed 30 'lx ly lz f_4 f_4[1] f_6 f_6[2]' <<D
lattice fcc 0.8
region box block 0 5 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.2 4711
$liquid
neigh_modify every 4 delay 0 check no
group some id <= 150
fix 1 all nve
fix 2 all press/berendsen x 0.0 2.0 0.2 y 1.0 1.0 0.5 z 0.0 2.0 0.2 couple xz
fix 3 some planeforce 1 2 3
fix 4 some spring couple all 20 1 NULL 0.5 0.2
fix 5 all temp/csvr 1.0 1.5 0.1 4711
fix 6 all rhok 3 -2 1 4.0 2.0
D
} >in.minimize

bits minimize 0 1
[ "$(wc -l <minimize/thermo)" -gt 40 ] || fail "$(wc -l <minimize/thermo) rows"
bits minimize 0 3 -neigh cell
bits minimize 2 2 -neigh verlet
bits minimize 4 1
bits minimize 3 1 -neigh linked
