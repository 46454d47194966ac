#!/bin/bash
# Fixes, computes and commands that sum over atoms, change the box or remove atoms: the same bits on any ranks and threads and for
# every neighbor method.
set -eu
# shellcheck source=tests/mpi/bits.sh
. "$PROJECT_ROOT/tests/mpi/bits.sh"

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
fix h two ave/histo 2 3 10 0 12 7 c_p[1] c_c vx mode vector ave running error yes
fix w all ave/histo/weight 2 2 10 0 12 7 x c_k mode vector
D
    system read 20 'c_q v_s v_h[3] v_e f_h[3] f_h[2][2]' 'v_q' <<D
$(fluid block 0 6 0 5 0 4)
neigh_modify every 5 delay 0 check no
print 3 file set.txt
print "480 3" append set.txt
print "17 -2" append set.txt
print "250 1.5" append set.txt
print 1 append set.txt
print "480 2" append set.txt
variable q atomfile set.txt
variable p atom v_q*(vx+x)
compute q all reduce sum v_p
compute r all rdf 8
compute m all msd
fix m all vector 2 c_m[4]
variable g vector c_r[2]*2+random(0,1,34)
variable h vector (v_g-1)*c_r[1]^2
variable s equal sum(v_h)
variable e equal slope(f_m)
fix 1 all nve
fix h all ave/histo 2 2 10 0 4 7 v_g mode vector
run 10
next q
D
    system vessels 30 'v_ves_in v_ves_out c_t c_v f_w' 'vx' <<D
$(fluid block 0 6 0 5 0 5)
neigh_modify every 5 delay 0 check no
variable ves_d equal 0.02*step
variable ves_r equal 3.5-0.02*step
variable ves_turn equal 0.1*step
region ball sphere v_ves_r 4 4 v_ves_r units box move v_ves_d NULL NULL
region brick block 1 5 2 4 1 4 rotate v_ves_turn 3 2.5 2.5 1 2 1
region both union 2 ball brick
region stone sphere -3 4 4 2 units box side out move v_ves_d NULL NULL
variable ves_in equal count(all,both)
variable ves_out equal xcm(all,x,brick)
compute t all temp/region ball
compute v all reduce/region brick sum vx
group d dynamic all region both every 3
fix 1 all nve
fix 2 d addforce 0.3 0 0
fix 3 all addforce 0 0.2 0 region ball
fix 4 all heat 5 1.0 region brick
fix w all wall/region stone lj93 1.0 1.0 2.5
D
    system shared 20 'c_e c_y c_s[1] c_s[2] c_l[2]' 'c_p[1] c_p[2] c_g' <<D
lattice fcc 0.7
region box block 0 6 0 5 0 5
region corner block 0 2 0 2 0 2
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.3 77
delete_atoms region corner compress no
reset_atom_ids
mass * 1.0
velocity all create 1.5 12345
pair_style hybrid/overlay lj/cut 2.5 yukawa 1.2 2.2
pair_coeff * * lj/cut 1 1
pair_coeff * * yukawa 0.4
pair_coeff 1 2 yukawa -0.4
neigh_modify every 5 delay 0 check no
group two type 2
compute e all pair lj/cut
compute y all pair yukawa
compute near two cluster/atom 1.3
compute drops two chunk/atom c_near compress yes
compute size all property/chunk drops count
compute move two vcm/chunk drops
compute p all chunk/spread/atom drops c_size c_move[1]
compute s all reduce sum c_p[*]
compute kind all property/atom type
compute r all rdf 20
variable twice vector c_r[2]*2
compute g all global/atom c_kind v_twice
compute l all slice 9 20 4 v_twice
fix 1 all nve
D
    system polar 20 'c_p c_p[1] f_f[1][2] f_f[2][4]' 'mux' <<D
atom_style hybrid dipole sphere
lattice fcc 0.7
region box block 0 6 0 5 0 5
create_box 1 box
create_atoms 1 box
set group all dipole/random 777 1.0
set group all diameter 1.0
velocity all create 1.5 12345
$liquid
neigh_modify every 5 delay 0 check no
compute near all cluster/atom 1.2
compute flocks all chunk/atom c_near compress yes
compute p all dipole
compute f all dipole/chunk flocks
fix f all ave/time 10 1 10 c_f[*] mode vector ave one file flocks.txt
fix 1 all brownian/sphere 1.0 777 gamma_t 1.0 gamma_r 1.0
timestep 0.0001
D
    system drying 30 'atoms f_d c_t' 'vx' <<D
$(fluid block 0 6 0 5 0 4)
neigh_modify every 5 delay 0 check no
region r block 1.1 5.1 INF INF INF INF
compute t all temp
compute_modify t dynamic/dof yes
fix 1 all nve
fix d all evaporate 4 7 r 4711
dump l all custom 4 faster.dump id vx
dump_modify l sort id thresh vx > LAST
D
    system changing 30 'c_t c_te f_s f_f[1] c_cm[1]' 'vx' <<D
$(fluid block 0 6 0 5 0 4)
neigh_modify every 5 delay 0 check no
region r block 1.1 3.1 INF INF INF INF
variable fast atom vx*vx>1.0
group d dynamic all region r every 3
group e dynamic all region r var fast
compute t d temp
compute te e temp
compute cm e com
fix 1 all nve
fix 2 d langevin 1.2 1.2 0.5 4711
fix f e addforce 0.1 0 0
fix s d spring tether 0.5 NULL NULL 4.0 0
D
    system dragged 20 'f_d f_d[1] f_r c_h[1] c_h[6]' <<D
$(fluid prism 0 6 0 5 0 4 1 0.5 0)
neigh_modify every 5 delay 0 check no
group few id 1:150
fix 1 all nve
fix d few drag 1 9 2 5.0 0.7
fix r few spring/rg 10.0 NULL
region gate block 2 4 INF INF INF INF
fix o all oneway 3 gate -y
compute g few gyration
compute h all gyration/shape g
D
    system squeezed 30 'f_1' <<D
$(fluid block 0 6 0 5 0 4)
neigh_modify every 5 delay 0 check no
fix 1 all npt temp 1.0 1.0 0.5 x 8.0 8.0 0.2 y 1.0 1.0 0.5 z -1 -1 0.5
D
    system tabulated 20 'c_g[1] c_g[2] c_g[3]' 'c_y' <<D
lattice fcc 0.8442
region box block 0 4 0 5 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.3 77
mass * 1.0
velocity all create 1.5 12345
$liquid
pair_coeff * * 1.0 1.0
print '# tables' file tables
pair_write 1 1 300 r 0.7 2.5 tables LJ
pair_style hybrid/overlay table spline 500 mie/cut 2.0 gauss/cut 1.8 cosine/squared 1.9
pair_coeff * * table tables LJ
pair_coeff 1 2 mie/cut 0.2 1.0 11.5 5.5
pair_coeff 2 2 gauss/cut 0.2 1.3 0.2
pair_coeff 1 1 cosine/squared 0.3 1.0 wca
group two type 2
compute g two msd/nongauss com yes
compute y all cna/atom 1.42
fix 1 all nve
D
    system moved 20 'c_r[*]' 'f_m[1] f_a[1] f_a[2] f_b f_s[1] f_s[2]' <<D
lattice fcc 0.7
region box block 0 5 0 4 0 4
create_box 3 box
create_atoms 1 box
region ball sphere 1.5 2 2 0.9
region slab block 4 4.4 INF INF INF INF
set region ball type 2
set region slab type 3
mass * 1.0
velocity all create 1.5 12345
$liquid
pair_coeff * * 1.0 1.0
neigh_modify every 2 delay 0 check yes
group rest type 1
group ball type 2
group slab type 3
variable d atom 0.02*(1-cos(step*dt))*y
variable v equal 0.2*step*dt
compute e all ke/atom
compute u all property/atom xu
fix 1 rest nve
fix m ball move rotate 1.5 2 2 1 2 3 1.5
fix n slab move variable NULL v_d NULL NULL NULL v_v
fix a all ave/atom 2 3 10 c_e vx
fix b rest ave/atom 3 2 6 x
fix s all store/state 7 xu c_u com yes
compute r all reduce sum f_a[1] f_a[2] f_b f_s[1] f_s[2]
D
    # flips at step 10 or so
    system tilting 30 'xy xz yz f_1' <<D
$(fluid prism 0 5 0 4 0 4 2.3 0 0.5)
neigh_modify every 5 delay 0 check no
fix 1 all npt temp 1.0 1.0 0.5 x 8.0 8.0 0.2 y 1.0 1.0 0.5 xy -15 -15 0.1 yz 3 3 0.3
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
    system overlapping 20 <<D
region box block 0 9 0 8 0 7
create_box 1 box
create_atoms 1 random 400 4711 box
mass 1 1.0
velocity all create 1.0 12345
$liquid
neigh_modify every 10 delay 0 check no
fix 1 all nve/limit 0.03
D
    system indented 10 'f_i f_i[2] c_r c_j[1] c_j[5]' <<D
lattice fcc 0.8442
region box block 0 4 0 4 0 5
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.0 12345
$liquid
fix 1 all nve
variable y equal 1.2+step*0.001
fix i all indent 20 sphere 2 v_y 5.5 1.1
compute k all ke/atom
compute p all pe/atom
compute s all stress/atom NULL virial
compute j all heat/flux k p s
compute r all temp/ramp vx 0 1.5 z 1 5
D
    system marked 20 'c_m[1] c_m[2]' 'i_n d_w v_w' <<D
lattice fcc 0.7
region box block 0 5 0 4 0 4
create_box 2 box
create_atoms 1 box
mass * 1.0
velocity all create 2.5 12345
$liquid
neigh_modify every 2 delay 0 check no
fix p all property/atom i_n d_w ghost yes
variable n atom id-50
set group all i_n v_n d_w v_n
variable w atom d_w*i_n+x
compute m all reduce sum d_w v_w
fix 1 all nve
D
    system flowing 20 'f_g f_g[1] f_g[2] c_m[2]' <<D
$(fluid block 0 5 0 4 0 4)
group half id <= 150
compute m half momentum
fix 1 all nve
fix g half flow/gauss 1 1 0 energy yes
D
    system stretched 30 'c_e c_s[*] c_g f_t c_r[8][2] f_r[8][2]' 'c_p c_v[4] f_n[1]' <<D
$(fluid block 0 5 0 4 0 4)
neigh_modify every 6 delay 0 check no
group half id <= 150
fix 1 all nve
fix 2 half deform 2 x erate 0.5 y volume z wiggle 0.1 0.2
fix t half spring/self 1.0
compute p all pe/atom
compute v half stress/atom NULL
compute e all reduce sum c_p
compute s all reduce sum c_v[1] c_v[4]
compute g half group/group all
compute r all rdf 8
fix r all ave/time 7 1 7 c_r[*] mode vector
fix n half numdiff 5 1e-4
D
    system sheared 30 'xy xz yz c_1_temp f_1' <<D
$(fluid prism 0 5 0 4 0 4 2 -1 0.5)
neigh_modify every 6 delay 0 check no
fix 1 all nvt/sllod temp 1.0 1.0 0.5
fix 2 all deform 1 xy erate 1.0 xz vel -3 yz wiggle 20 1 remap v
D
    system heated 20 'f_h f_l' <<D
$(fluid block 0 5 0 4 0 4)
region hot block INF INF INF INF 0 1.03
compute t all temp/region hot
fix 1 all nve
fix h all heat 2 20 region hot
fix l all langevin 1.0 1.0 0.5 4711 tally yes zero yes
fix_modify l temp t
D
    system exchanging 20 'f_v f_k f_h' <<D
lattice fcc 0.7
region box block 0 4 0 4 0 5
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.3 77
mass 1 1.0
mass 2 1.8
velocity all create 1.5 12345
$liquid
region hot block INF INF INF INF 0 1.03
fix 1 all nve
fix v all viscosity 3 x z 10 swap 3
fix k all thermal/conductivity 4 y 4 swap 40
fix h all ehex 1 20 region hot
variable r atom random(-0.1,0.1,4711)+normal(0.0,0.01,5)
set group all vx v_r
D
    system turning 30 'c_t c_e f_1' 'omegax omegay omegaz mux muy muz' <<D
atom_style hybrid sphere dipole
lattice fcc 0.7
region box block 0 5 0 4 0 4
create_box 1 box
create_atoms 1 box
set type 1 diameter 0.9
set type 1 dipole/random 4711 0.7
velocity all create 1.5 12345
variable w atom vx-0.3*y
set group all omega v_w 0.2 v_w
$liquid
compute t all temp/sphere
compute e all erotate/sphere
fix 1 all nvt/sphere temp 1.5 1.2 0.3 update dipole/dlm
fix 2 all langevin 1.5 1.2 0.7 4711 omega yes zero yes
D
    system swapping 30 'f_w[*] f_s[*] f_m[*] f_r[*]' <<D
lattice fcc 0.5
region box prism 0 5 0 4 0 4 0.7 -0.5 0.6
create_box 3 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 77
mass 1 1.0
mass 2 1.8
mass 3 0.7
velocity all create 1.5 12345
$liquid
pair_coeff 1 2 1.3 0.95
pair_coeff 3 3 1.0 0.9
pair_modify tail yes
group heavy type 2
neigh_modify exclude group heavy heavy
region r sphere 3 3 3 2
fix 1 all nve
fix w all atom/swap 3 300 4711 1.4 types 1 2
fix s all atom/swap 4 20 4711 1.4 types 1 3 semi-grand yes mu 0.0 0.3 region r ke no
fix m all widom 5 100 3 12 1.5
fix r all widom 5 30 1 12 1.5 region r
D
    system exchanging 30 'f_g[1] f_g[2] f_g[3] f_g[4] f_g[5] f_g[6] f_h[4] f_h[6]' <<D
lattice fcc 0.3
region box block 0 5 0 4 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 77
mass 1 1.0
mass 2 1.8
velocity all create 1.5 12345
$liquid
compute_modify thermo_temp dynamic/dof yes
group light type 1
fix 1 all nve
fix g light gcmc 3 40 10 1 4711 1.5 -2.2 0.4
fix h all gcmc 5 20 0 2 4711 1.5 -3.0 0.0 max 200
D
    system deposited 40 'f_d' <<D
boundary p p f
lattice fcc 0.9
region box block 0 3 0 4 0 9
create_box 2 box
region low block INF INF INF INF INF 2
create_atoms 1 region low
mass * 1.0
$liquid
pair_coeff * * 1.0 1.0
region slab block 0 3 0 4 5 8
group added type 2
fix 1 all nve
fix d added deposit 30 2 3 12345 region slab near 1.0 vz -1.0 -1.0 attempt 3
fix w all wall/reflect zhi EDGE zlo EDGE
D
} >in.fixes

bits fixes 0 1
[ "$(wc -l <fixes/thermo)" -eq "$(awk '/^run / {n += $2 / 10 + 1} END {print n}' in.fixes)" ] || fail "$(wc -l <fixes/thermo) rows"
bits fixes 0 3 -neigh cell
bits fixes 2 2 -neigh verlet
bits fixes 3 1 -neigh linked
bits fixes 6 1
