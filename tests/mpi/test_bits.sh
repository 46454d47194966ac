#!/bin/bash
# Reproducible runs, the default in double precision: every bit of the thermo table and of positions, images, velocities and forces is
# the same on any number of ranks and threads and for every neighbor method. Many systems stand in one deck, for starting ranks
# takes longer than running them.
set -eu
# shellcheck source=tests/mpi/bits.sh
. "$PROJECT_ROOT/tests/mpi/bits.sh"

{
    system melt 30 'f_v[1] c_m c_l c_q[4][2] f_F[2][4] f_S[3][3] f_S[3][4] c_r[20][2] f_R[20][2]' <<D
lattice fcc 0.8442
region box block 0 5 0 6 0 7
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287
$liquid
neighbor 0.1 bin
neigh_modify every 12 delay 0 check no
fix 1 all nve
compute k all ke/atom
compute m all reduce sum c_k
compute l all reduce ave vx
fix v all ave/time 1 5 5 c_m c_thermo_temp
compute q all sq 2.5 5
fix F all ave/isf 10 2 10 2.5 5
fix S all ave/self 5 3 10 msd isf 5.0
compute r all rdf 20
fix R all ave/time 9 1 9 c_r[*] mode vector
D
    system mixture 20 'c_g c_g[1] c_s c_o[1][3] c_i[2][4] c_t[2][1] c_d[2][4]' <<D
lattice fcc 0.8
region box block 0 6 0 5 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/ratio 2 0.3 4711
mass 1 1.0
mass 2 2.5
velocity all create 1.5 12345 dist gaussian rot yes
$liquid
pair_coeff 2 2 0.5 1.1 1.8
neigh_modify every 5 delay 0 check yes
fix 1 all nve
group heavy type 2
compute g heavy group/group all
compute y all centro/atom fcc
compute s all reduce sum c_y
compute kinds all chunk/atom type
compute o heavy omega/chunk kinds
compute i all inertia/chunk kinds
compute t all torque/chunk kinds
compute d all msd/chunk kinds
D
    system fluid 40 <<D
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
fix 2 all enforce2d
D
    for boundary in "p p p" "s s s" "p m s"; do
        system "droplet-${boundary// /}" 20 <<D
boundary $boundary
lattice fcc 0.8
region box block 0 12 0 12 0 12
region drop sphere 4 5 6 2.6
create_box 1 box
create_atoms 1 region drop
mass 1 1.0
velocity all create 0.7 4
$liquid
neigh_modify every 4 delay 0 check no
fix 1 all nve
fix even all balance 7 1.0 shift zyx 10 1.0
D
    done
    system slab 20 'f_a f_b' <<D
boundary p p f
lattice fcc 0.8
region box block 0 5 0 5 0 10
region slab block 0 5 0 5 0.4 4.4
create_box 1 box
create_atoms 1 region slab
mass 1 1.0
velocity all create 2.0 4 mom yes
$liquid
fix 1 all nve
fix a all wall/lj93 zlo EDGE 1.0 1.0 2.5 units box
fix b all wall/harmonic zhi 12.34567 30.0 1.0 1.1 units box
fix r all wall/reflect zhi 13.1234567 units box
fix g all gravity 0.1 vector 0 0.3 -1
D
    system skew 20 'c_c[1] c_m[1] c_m[2]' <<D
lattice fcc 0.8
region box prism 0 5 0 4 0 5 2 -2 2
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287
$liquid
neigh_modify every 6 delay 0 check no
fix 1 all nve
fix even all balance 7 1.0 shift zyx 10 1.0
compute c all com
compute m all msd
D
    system rhombus 20 <<D
dimension 2
lattice hex 0.8
region box prism 0 14 0 8 -0.5 0.5 -7 0 0
create_box 2 box
create_atoms 1 box
set type 1 type/ratio 2 0.3 4711
mass 1 1.0
mass 2 2.5
velocity all create 3.0 87287
$liquid
pair_coeff 2 2 0.5 1.1 1.8
neigh_modify every 4 delay 0 check yes
fix 1 all nve
fix 2 all enforce2d
D
} >in.bits
{
    system cylinder 20 'f_w f_s' <<D
boundary p p f
lattice fcc 0.7
region box block 0 8 0 8 0 5
region tube cylinder z 4.1 4.2 3.0 0 5
region hull cylinder z 7.3 7.4 6.2 -1 9.5 units box
create_box 1 box
create_atoms 1 region tube
mass 1 1.0
velocity all create 1.0 4 mom yes
$liquid
fix 1 all nve/limit 0.05
fix w all wall/region hull harmonic 20.0 1.0 1.1
group some id 1:300:7
fix s some spring/self 3.3
fix r all wall/reflect zlo EDGE zhi EDGE
D
    system active 20 '' 'mux muy muz' <<D
dimension 2
atom_style hybrid dipole sphere
lattice sq 0.75
region box block 0 15 0 13 -0.5 0.5
create_box 1 box
create_atoms 1 box
set type 1 dipole/random 77 1.0
pair_style wca
pair_coeff 1 1 24.0 1.0
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
fix 1 all brownian/sphere 1.0 20110 gamma_t 1.0 gamma_r 0.3333333
fix 2 all propel/self dipole 24.0
fix 3 all enforce2d
timestep 0.00002
D
    system grains 20 'c_u' <<D
dimension 2
atom_style sphere
lattice sq2 1.0
region box block 0 14 0 11 -0.5 0.5
create_box 1 box
create_atoms 1 box
variable d atom 0.3+1.5*(((id*61)%101)/100)^3
set group all diameter v_d
set group all mass 1.0
velocity all create 1.0 99 loop geom
pair_style harmonic/sphere
pair_coeff 1 1 100.0
neighbor 0.3 bin
neigh_modify every 4 delay 0 check no
fix 1 all nve
compute e all pe/atom
compute u all reduce sum c_e
D
    system langevin 20 'f_2' <<D
lattice fcc 0.5
region box block 0 5 0 5 0 5
create_box 1 box
create_atoms 1 box
mass 1 1.3
velocity all create 1.0 11 dist gaussian
pair_style lj/cut 1.8
pair_coeff 1 1 1.0 1.0
fix 1 all nve
fix 2 all langevin 1.0 1.7 0.5 48279 tally yes zero yes
D
    system pairs 20 'c_s[1] c_s[2] c_o[1] c_o[2] f_h[1] f_h[3] f_h[4][2] f_w[5][2]' <<D
lattice fcc 0.8
region box block 0 3 0 4 0 3
create_box 2 box
create_atoms 1 box
set type 1 type/ratio 2 0.3 4711
mass * 1.0
velocity all create 2.0 4
pair_style lj/cut 3.0
pair_coeff * * 1.0 1.0
pair_coeff 1 2 0.5 1.1 1.8
neighbor 0.3 bin
neigh_modify every 6 delay 0 check no
fix 1 all nve
compute p all pair/local dist eng dx dy dz fx fy fz
compute q all property/local patom1 patom2 ptype1 ptype2
compute l all property/local natom1 natom2
compute s all reduce sum c_p[2] c_l[1]
compute o all reduce max c_p[2] c_q[1] replace 2 1
dump pairs all local 5 pairs.rows index c_q[*] c_p[*]
dump listed all local 10 listed.rows index c_l[*]
dump_modify pairs format float %.17g
dump far all local 20 far.rows index c_p[1] c_q[1]
dump_modify far sort -2
fix h all ave/histo 2 5 10 0.8 2.5 10 c_p[1] mode vector
fix w all ave/histo/weight 5 2 10 0.8 2.5 10 c_p[1] c_p[2] mode vector
D
    system momentum 20 'c_c[1] c_v' <<D
lattice fcc 0.6
region box block 0 5 0 4 0 5
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.0 11
velocity all set 0.3 0.1 NULL sum yes
$liquid
fix 1 all nve
fix 2 all momentum 3 linear 1 1 0 angular rescale
fix 3 all recenter INIT 0.4 NULL units fraction
compute c all com
compute v all gyration
D
    system leaning 20 'xlo xhi' <<D
boundary s p p
lattice fcc 0.8
region box prism 0 4 0 4 0 4 -2 1 1
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 4
$liquid
neigh_modify every 4 delay 0 check no
fix 1 all nve
D
    # edges b and c flip on the way
    system flowing 40 'c_f_temp xy xz yz c_m[1]' 'ix iy iz' <<D
lattice fcc 0.8
region box prism 0 4 0 4 0 4 1 0 -1.8
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 4
$liquid
neigh_modify every 1 delay 0 check yes
fix f all nvt/sllod temp 1.5 1.5 0.2
fix d all deform 1 xy erate 1.5 yz erate -0.8 remap v
compute m all msd
D
    system strained 20 'lx xy xz' <<D
lattice fcc 0.8
region box prism 0 4 0 4 0 4 1.8 0 -1
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 4
$liquid
neigh_modify every 5 delay 0 check no
fix 1 all nve
fix d all deform 2 xy erate 2.0 xz vel -3 x trate 0.05 remap x
fix w all property/atom d_cost
fix b all balance 10 1.0 shift xyz 10 1.0 weight neigh 0.8 weight store cost
D
    system swelling 20 'lx xy xz yz c_q[4][2]' <<D
lattice fcc 0.8
region box prism 0 4 0 4 0 4 -2 1 2
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 4
$liquid
neigh_modify every 4 delay 0 check yes
fix 1 all npt temp 1.5 1.5 0.2 aniso 5.0 5.0 0.5
compute q all sq 3.0 5
D
} >in.more
{
    system valley 10 'f_s' <<D
lattice fcc 0.8
region box block 0 6 0 5 0 4
region hole cylinder z 3 2.5 0.9 0 4 side out
create_box 2 box
create_atoms 1 region hole
set type 1 type/ratio 2 0.3 4711
mass * 1.0
$liquid
pair_coeff 2 2 1.0 0.9
pair_modify shift yes
velocity all create 0.1 5
fix s all spring/self 0.5
fix_modify s energy yes
thermo_modify norm no format float %.17g
thermo 5
minimize 0 0 25 1000
min_style fire
minimize 0 0 25 1000
fix 1 all nve
D
} >in.minimize

bits bits 0 1
bits more 0 1
[ "$(cat bits/thermo more/thermo | wc -l)" -eq 62 ] || fail "$(cat bits/thermo more/thermo | wc -l) rows"
bits minimize 0 1
[ "$(wc -l <minimize/thermo)" -eq 14 ] || fail "$(wc -l <minimize/thermo) rows of minimize"
for threads in 1 2; do
    for n in 1 2 3 4 6 8; do bits bits "$n" "$threads"; done
done
bits more 1 2
bits more 2 2
bits more 3 1
bits more 6 1
bits bits 3 1 -neigh cell
bits bits 4 1 -neigh verlet
bits more 2 1 -neigh cell
bits more 2 2 -neigh verlet
bits bits 2 1 -neigh nsq
bits more 0 1 -neigh linked
bits bits 3 1 -neigh incremental
bits more 2 1 -neigh hash
bits minimize 1 3 -neigh verlet
bits minimize 3 1 -neigh cell
bits minimize 4 2

# Without reproducible sums, numbers are the same to rounding: on one rank and on several, and as those above. In 40 steps neighbors
# of a liquid's trajectory part by less than a thousandfold; pressures are sums of 10^4 terms that cancel to a hundredth or so:
# 1e-16 * 1e3 * 1e2 * sqrt(1e4), and a factor of ten.
for run in "1 1" "1 2" "3 1" "4 2" "8 1"; do
    read -r n threads <<<"$run"
    mkdir "rounded-$n-$threads"
    (cd "rounded-$n-$threads" && ranks "$n" ../in.bits -log log -screen none -threads "$threads" -reproducible off) ||
        fail "off, $n ranks: exit code $?"
    table "rounded-$n-$threads/log" >"rounded-$n-$threads/thermo"
    ! cmp -s bits/thermo "rounded-$n-$threads/thermo" || fail "off, $n ranks, $threads threads: sums were reproducible"
    same_numbers bits/thermo "rounded-$n-$threads/thermo" 1e-8
done
