#!/bin/bash
# Coefficients and diameters that change, order parameters, walls that throw atoms back at random, temperatures of flows, a
# controller: the same bits on any ranks and threads and for every neighbor method.
set -eu
# shellcheck source=tests/mpi/bits.sh
. "$PROJECT_ROOT/tests/mpi/bits.sh"

{
    system pushed 20 '' <<D
region box block 0 7 0 6 0 5
create_box 2 box
create_atoms 1 random 120 4711 box
create_atoms 2 random 40 815 box
mass * 1.0
neighbor 0.5 bin
neigh_modify every 2 delay 0 check yes
pair_style hybrid/overlay soft 1.1 wca
pair_coeff * * soft 1.0
pair_coeff 2 2 wca 0.01 0.3
variable push equal ramp(0,40)
variable s equal 0.3+0.02*step
fix 1 all nve/limit 0.05
fix a all adapt 2 pair soft a * * v_push pair wca sigma 2 2 v_s
D
    system grown 30 'c_r' <<D
dimension 2
atom_style sphere
lattice sq 1.0
region box block 0 12 0 9 -0.5 0.5
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 4711
set group all diameter 0.7
group two type 2
velocity all create 0.3 4711 loop geom
pair_style harmonic/sphere
pair_coeff * * 50.0
compute p all property/atom radius
compute r all reduce sum c_p
fix 1 all nve
fix 2 all enforce2d
variable d equal ramp(1.0,2.6)
fix g two adapt 3 atom diameter v_d scale yes
D
    system ordered 20 'c_r[1] c_r[2] c_r[3]' 'c_q[1] c_q[6] c_q[15] c_b[3] c_b[9]' <<D
lattice fcc 0.9
region box block 0 4 0 3 0 5
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 2.0 12345
$liquid
group some id <= 200
compute q all orientorder/atom wl yes wl/hat yes
compute b some orientorder/atom degrees 2 3 6 nnn NULL cutoff 1.6 components 3
compute r all reduce sum c_q[1] c_q[2] c_q[11]
fix 1 all nve
D
    system walled 60 '' <<D
boundary p f f
lattice sc 0.3
region box block 0 5 0 4 0 5
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 4.0 12345
$liquid
fix 1 all nve
fix w all wall/reflect/stochastic ccl 4711 ylo EDGE 1 0.5 0 0 0.2 0.4 0.6 yhi EDGE 2 0 0 0 1 1 1
fix x all wall/reflect/stochastic maxwell 4711 zlo EDGE 1 0.5 0 0 0.5 zhi EDGE 2 0 0.1 0 1
D
    system flowing 20 'c_t f_c[1] f_c[2] f_c[3]' <<D
lattice fcc 0.8
region box block 0 4 0 5 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 4711
mass 1 1.0
mass 2 3.0
velocity all create 1.0 12345
velocity all ramp vx -1 1 y 0 5 sum yes
$liquid
compute t all temp/profile 1 0 1 xy 2 5
compute e all temp/profile 1 1 1 z 4 out bin
variable wanted internal 1.0
fix 1 all nvt temp 1.0 1.0 0.2
fix_modify 1 temp t
fix l all langevin v_wanted 1.0 1.0 4711
fix c all controller 2 2.0 1.0 0.5 0.1 c_e[2][2] 1.3 wanted
D
    system damped 20 'dt f_d f_t' <<D
lattice fcc 0.8
region box block 0 5 0 4 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 4711
mass * 1.0
velocity all create 3.0 12345
$liquid
group two type 2
variable w atom 1+x/5
fix 1 all nve
fix t two temp/berendsen 1.0 2.0 0.1
fix f all viscous 0.3 scale 2 2.0
fix d all dt/reset 3 NULL 0.01 0.02
fix b two balance 4 1.0 rcb weight group 1 two 3.0 weight var w weight time 0.7
D
} >in.adapt

bits adapt 0 1
[ "$(wc -l <adapt/thermo)" -ge 15 ] || fail "$(wc -l <adapt/thermo) rows"
bits adapt 0 3 -neigh cell
bits adapt 2 2 -neigh verlet
bits adapt 3 1
