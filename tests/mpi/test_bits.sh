#!/bin/bash
# Reproducible runs, the default in double precision: every bit of the thermo table and of positions, images, velocities and forces is
# the same on any number of ranks and threads and for every neighbor method. Many systems stand in one deck, for starting ranks
# takes longer than running them.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

# system NAME STEPS, what makes it on standard input. Pressures and energies are sums over all pairs, temperatures over all atoms.
system() {
    echo "print '== $1'"
    cat
    cat <<D
thermo_style custom step atoms temp ke pe etotal press pxx pyy pzz pxy pxz pyz vol ${3:-}
thermo_modify format float %.17g lost error
thermo 10
dump d all custom $(($2 / 2)) $1.dump id type x y z ix iy iz vx vy vz fx fy fz ${4:-}
dump_modify d format float %.17g sort id
run $2
clear
D
}

liquid='pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0 2.5
neighbor 0.3 bin'
{
    system melt 30 'f_v[1] c_m c_l c_q[4][2] f_F[2][4] f_S[3][3] f_S[3][4]' <<D
lattice fcc 0.8442
region box block 0 5 0 6 0 7
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287
$liquid
neigh_modify every 12 delay 0 check no
fix 1 all nve
compute k all ke/atom
compute m all reduce sum c_k
compute l all reduce ave vx
fix v all ave/time 1 5 5 c_m c_thermo_temp
compute q all sq 2.5 5
fix F all ave/isf 10 2 10 2.5 5
fix S all ave/self 5 3 10 msd isf 5.0
D
    system mixture 20 <<D
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
variable d atom 0.7+0.8*((id*61)%101)/100
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
} >in.more
{
    system gas 20 'c_s f_h[1] f_h[3] f_h[4] f_w[3][2] f_w[5][2]' 'c_c c_q[1] c_q[2] c_p[1]' <<D
dimension 2
lattice sq2 0.5
region box block 0 14 0 11 -0.5 0.5
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.3 77
mass * 1.0
velocity all create 3.0 99 loop geom
$liquid
neigh_modify every 2 delay 0 check yes
group two type 2
compute c two cluster/atom 1.7
compute s all reduce sum c_c
compute q all hexorder/atom
compute p two hexorder/atom degree 5 nnn NULL cutoff 1.6
compute k all ke/atom
fix 1 all nve
fix 2 all enforce2d
fix h two ave/histo 2 3 10 0 12 7 c_p[1] c_c vx mode vector ave running
fix w all ave/histo/weight 2 2 10 0 12 7 x c_k mode vector
D
    system squeezed 30 'f_1' <<D
lattice fcc 0.7
region box block 0 6 0 5 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 12345
$liquid
neigh_modify every 5 delay 0 check no
fix 1 all npt temp 1.0 1.0 0.5 x 8.0 8.0 0.2 y 1.0 1.0 0.5 z -1 -1 0.5
D
    system warmed 20 'c_1_temp' <<D
lattice fcc 0.8442
region box block 0 4 0 5 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.5 12345
$liquid
fix 1 all nvt temp 1.0 2.0 0.2
D
    system changed 20 '' <<D
lattice fcc 0.8442
region box block 0 3 0 2 0 3
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 1234
mass * 1.0
displace_atoms all random 0.05 0.05 0.05 4711
replicate 2 2 1
region ball sphere 2 2 2 1.2
delete_atoms region ball
region half block 0 3 INF INF INF INF
delete_atoms porosity half 0.1 4711
group two type 2
displace_atoms two rotate 3 3 1 0 0 1 40
delete_atoms overlap 0.85 all all
change_box all x scale 1.02 y volume remap
velocity all create 1.0 12345
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve/limit 0.02
D
} >in.fixes

# bits DECK RANKS THREADS WORDS...: the same bits as on one rank, which runs first and without mpirun.
bits() {
    local deck=$1 n=$2 threads=$3 file
    local name=$deck-$n-ranks-$threads-threads
    shift 3
    mkdir "$name"
    (cd "$name" && ranks "$n" "../in.$deck" -log log -screen none -threads "$threads" "$@") || fail "$name: exit code $?"
    table "$name/log" >"$name/thermo"
    rm "$name/log"
    if [ ! -d "$deck" ]; then
        mv "$name" "$deck"
    else
        for file in "$deck"/*; do cmp "$file" "$name/${file#*/}" >&2 || fail "$name $*: ${file#*/}"; done
        rm -r "$name"
    fi
}

bits bits 0 1
bits more 0 1
[ "$(cat bits/thermo more/thermo | wc -l)" -eq 39 ] || fail "$(cat bits/thermo more/thermo | wc -l) rows"
bits fixes 0 1
[ "$(wc -l <fixes/thermo)" -eq 13 ] || fail "$(wc -l <fixes/thermo) rows of fixes"
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
bits fixes 1 3 -neigh cell
bits fixes 2 2
bits fixes 4 1 -neigh verlet
bits fixes 6 1
bits bits 2 1 -neigh nsq
bits more 0 1 -neigh linked
bits bits 3 1 -neigh incremental
bits more 2 1 -neigh hash
