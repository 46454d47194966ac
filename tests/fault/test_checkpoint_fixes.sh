#!/bin/bash
# Every fix with a history of its own: a run resumed from a checkpoint in its midst ends in the same bits as the run left
# alone, and its files are the same.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

# check NAME [BOX]: lines of the deck on standard input; the checkpoint is made between multiples of what averages and fixes go by.
check() {
    local name=$1
    mkdir "$name" # fails, and ends all, where two have one name
    cd "$name"
    {
        cat <<D
units lj
lattice fcc 0.8442
region box ${2:-block 0 4 0 4 0 4}
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 1234
mass 1 1.0
mass 2 2.0
velocity all create 1.44 87287
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0 2.5
neigh_modify every 7 delay 0 check no
checkpoint every 33 steps keep 9
thermo 10
D
        cat
        cat <<'D'
run 80
write_dump all custom end.dump id x y z vx vy vz fx fy fz modify format float %.17g
D
    } >in
    "$HALFSHELL" in -log none >out 2>&1 || fail "$name: $(tail -3 out)"
    tail -n +1 ./*.dump ./*.txt >../whole 2>/dev/null || true
    [ -s checkpoint.33.h5 ] || fail "$name: no checkpoint"
    "$HALFSHELL" resume checkpoint.33.h5 >out 2>&1 || fail "$name, resumed: $(tail -3 out)"
    tail -n +1 ./*.dump ./*.txt >../resumed 2>/dev/null || true
    cmp ../whole ../resumed || fail "$name does not end in the same bits"
    cd ..
}

check profile 'prism 0 4 0 4 0 4 0.5 0 0' <<'D'
compute bath all temp/profile 1 0 0 y 3
fix 1 all nvt temp 1.0 1.2 0.5
fix_modify 1 temp bath
fix 2 all deform 1 xy delta 0.3 remap v
D

check rows <<'D'
fix 1 all nve
compute p all pair/local dist eng
compute i all property/local patom1 patom2
dump p all local 40 pairs.dump index c_i[*] c_p[*]
dump_modify p format float %.17g
fix h all ave/histo 4 10 40 0.8 2.5 10 c_p[1] mode vector ave running file distances.txt
fix w all ave/histo/weight 10 2 20 0.8 2.5 10 c_p[1] c_p[2] mode vector kind local file energies.txt
D

check read <<'D'
print 2 file set.txt
print "250 3" append set.txt
print "17 -2" append set.txt
print 1 append set.txt
print "100 2" append set.txt
print 1 append set.txt
print "1 2" append set.txt
variable q atomfile set.txt
next q
variable u universe a b
compute m all msd
fix 1 all nve
fix m all vector 3 c_m[4] c_m[1]
variable v vector f_m[1]-f_m[2]+random(0,1,34)
fix 2 all addforce v_q 0 0
fix 3 all print 10 "$(v_q[100]) $(sum(v_v)) $u" file vectors.txt
thermo_style custom step v_v[1]
run 20
next q
next u
run 20
D

check vessels <<'D'
variable d equal 0.005*step
variable r equal 3.5-0.02*step
variable turn equal 0.1*step
region ball sphere v_r 3 3 v_r units box move v_d NULL NULL
region brick block 1 3 EDGE 2 1 3 rotate v_turn 2 2 2 1 2 1
region stone sphere -3 3 3 2 units box side out move v_d NULL NULL
group d dynamic all region ball every 3
fix 1 all nve
fix 2 d addforce 0.3 0 0
fix 3 all heat 5 1.0 region brick
fix w all wall/region stone lj93 1.0 1.0 2.5
dump 1 d custom 10 members.dump id x
D

check changed <<'D'
variable fast atom vx*vx>1.0
fix 1 all nve
dump 1 all custom 10 faster.dump id vx
dump_modify 1 thresh vx > LAST
dump 2 all custom 7 changed.dump id
dump_modify 2 thresh v_fast != LAST thresh x > 1
D

check virials <<'D'
fix 1 all nve
fix 2 all addforce 0.3 0.1 0 every 35
fix_modify 2 virial yes
fix 3 all print 5 "$(press:%.17g)" file pressures.txt
D

check drying <<'D'
region r block 1.1 3.1 INF INF INF INF
fix 1 all nve
fix 2 all evaporate 10 3 r 4711
fix 3 all ave/time 1 1 10 f_2 file gone.txt
D

check changing <<'D'
region r block 1.1 3.1 INF INF INF INF
variable fast atom vx*vx>1.0
group d dynamic all region r every 20
group e dynamic all region r var fast
fix 1 d nvt temp 1.2 1.2 0.5
fix 2 e addforce 0.1 0 0
dump 1 d custom 10 members.dump id x
D

check edges <<'D'
fix 1 all npt temp 1.0 1.2 0.5 iso 5 5 1
region corner block EDGE 2 EDGE 2 2 EDGE
fix 2 all addforce 1 0 0 region corner
D

check centers <<'D'
velocity all set 0.5 NULL 0.1 sum yes
compute bath all temp/com
fix 1 all npt temp 1.0 1.2 0.5 iso 1 1 2
fix_modify 1 temp bath
D

check chunks_as_bath <<'D'
velocity all ramp vx 0 1 y 0 4 sum yes
compute layers all chunk/atom bin/1d y lower 0.3 units reduced
compute bath all temp/chunk layers com yes
fix 1 all nvt temp 1.0 1.2 0.5
fix_modify 1 temp bath
D

check held_chunks <<'D'
fix 1 all nph iso 30 30 0.3
compute layers all chunk/atom bin/1d y upper 0.7 units box
compute flow all vcm/chunk layers
fix c all ave/chunk 2 3 10 layers vy temp ave running file layers.txt
fix t all ave/time 2 3 10 c_flow[*] mode vector ave running file flow.txt
D

check exclusions <<'D'
fix 1 all nve
group few id 1:60
group more type 2
neigh_modify exclude group few few exclude group few more
D

check histograms <<'D'
fix 1 all nve
fix h all ave/histo 2 3 20 -3 3 8 vx vy vz mode vector ave running error yes file h.txt
fix w all ave/histo 5 2 10 0 2 4 c_thermo_temp ave window 3 file w.txt
variable t equal temp
fix p all print 10 "$(step) $t" file p.txt screen no
variable s equal stride(10,1000,15)
fix q all print v_s "$(step) $t" file q.txt screen no
D

check tables <<'D'
fix 1 all nve
print "# tables" file tables.txt
pair_write 1 1 300 rsq 0.6 2.5 tables.txt LJ
pair_style table linear 1000
pair_coeff * * tables.txt LJ
D

check moved <<'D'
group one type 1
group two type 2
variable d equal 0.1*sin(step*dt)
variable q atom vx*vx
fix 1 one nve
fix 2 two move rotate 3 3 3 1 2 3 12.0
fix a all ave/atom 2 3 40 vx z
fix s two store/state 25 xu v_q
compute c all reduce sum f_a[1] f_a[2] f_s[1] f_s[2]
fix p all print 10 "$(c_c[1]) $(c_c[2]) $(c_c[3]) $(c_c[4])" file p.txt screen no
run 20
unfix 2
fix 2 two move variable v_d NULL NULL NULL v_d NULL units box
D

check halted <<'D'
fix 1 all nve
variable s equal step
fix h all halt 7 v_s > 40 error continue
D

check nongauss <<'D'
fix 1 all nve
compute g all msd/nongauss com yes
fix p all print 10 "$(c_g[1]) $(c_g[2]) $(c_g[3])" file p.txt screen no
D

check nvt <<'D'
fix 1 all nvt temp 1.0 1.2 0.5 tchain 2
D

check marked <<'D'
fix 1 all nve
fix p all property/atom i_n d_w ghost yes
fix l all property/atom d_last
variable n atom id-50
variable w atom d_w*0.5+vx
set group all i_n v_n d_w v_n
compute s all reduce sum i_n d_w
thermo_style custom step c_s[*]
dump 1 all custom 40 d.dump id i_n d_w v_w
dump_modify 1 sort id format float %.17g
D

check flowing <<'D'
group one type 1
fix 1 all nve
fix g one flow/gauss 1 1 0 energy yes
compute m one momentum
variable g equal f_g
variable gx equal f_g[1]
variable mx equal c_m[1]
fix p all print 10 "$(step) ${g} ${gx} ${mx}" file p.txt screen no
D

check tilted "prism 0 4 0 4 0 4 2 -1 1" <<'D'
fix 1 all nve
compute d all msd
fix a all ave/time 2 3 10 c_d[4] file a.txt
D

# edges flip before the checkpoint and after it
check flowing_tilted "prism 0 4 0 4 0 4 2 0 -1" <<'D'
fix 1 all nvt/sllod temp 1.5 1.5 0.2
fix d all deform 1 xy erate 1.5 yz erate -1.5 remap v
compute d all msd
variable xy equal xy
variable yz equal yz
fix a all ave/time 2 3 10 c_d[4] v_xy v_yz file a.txt
D

check strained "prism 0 4 0 4 0 4 2 0 -1" <<'D'
fix 1 all nve
fix d all deform 3 xy erate 1.5 yz trate 1.5 remap x
D

# values of the step's forces, after the box has changed: asked for when the run that the checkpoint ends is over
check of_forces "prism 0 4 0 4 0 4 2 0 -1" <<'D'
fix 1 all nve
fix d all deform 3 x erate 0.5 xy erate 1.5
fix s all spring/self 1.0
compute p all pe/atom
compute v all stress/atom NULL
compute s all reduce sum c_p c_v[1]
thermo_style custom step c_s[1]
run 33
print "$(c_s[1]:%.17g) $(c_s[2]:%.17g) $(f_s:%.17g)" append p.txt
D

check tilted_npt "prism 0 4 0 4 0 4 2 -1 1" <<'D'
fix 1 all npt temp 1.0 1.2 0.5 aniso 5.0 0.0 0.7
D

# the box flips before the checkpoint and after it
check tilting "prism 0 4 0 4 0 4 1.95 0 0.5" <<'D'
fix 1 all npt temp 1.0 1.2 0.5 x 1 3 2.0 xy -12 -12 0.1 yz 3 3 0.5
fix p all print 10 "$(lx:%.17g) $(xy:%.17g) $(yz:%.17g) $(f_1:%.17g)" file p.txt screen no
D

check pressed <<'D'
fix 1 all nve
fix 2 all press/berendsen x 1.0 3.0 0.5 y 2.0 1.0 0.5 z 1.0 3.0 0.5 couple xz modulus 20
fix p all print 10 "$(lx:%.17g) $(ly:%.17g) $(c_2_press:%.17g)" file p.txt screen no
D

check springs <<'D'
group one id <= 40
fix 1 all nve
fix 2 one spring couple all 20 1 2 NULL 0.3
fix 3 one lineforce 1 2 3
fix 4 all temp/csvr 1.0 1.5 0.1 4711
fix 5 one spring/rg 30.0 NULL
fix 6 all drag 1 2 3 0.5 1.0
fix p all print 10 "$(f_2:%.17g) $(f_2[1]:%.17g) $(f_5:%.17g) $(f_6:%.17g) $(f_6[2]:%.17g)" file p.txt screen no
D

check npt <<'D'
fix 1 all npt temp 1.0 1.2 0.5 x 1.0 3.0 2.0 y 2.0 1.0 1.5 z -1 0 1 nreset 20
fix p all print 10 "$(lx:%.17g) $(f_1:%.17g) $(f_1[15]:%.17g)" file p.txt screen no
D

check nph <<'D'
fix 1 all nph iso 1.0 3.0 0.3
fix 2 all langevin 1.0 1.0 1.0 4711
fix p all print 10 "$(lx:%.17g) $(f_1:%.17g)" file p.txt screen no
D

check deform <<'D'
fix 1 all nve
fix 2 all deform 2 x erate 0.2 y volume z volume
fix p all print 10 "$(lx:%.17g) $(ly:%.17g)" file p.txt screen no
D

# the box flips before and after the checkpoint
check sheared "prism 0 4 0 4 0 4 1.95 0.5 -0.5" <<'D'
fix 1 all nvt/sllod temp 1.0 1.0 0.5
fix 2 all deform 1 xy wiggle 8 0.6 yz vel -6 x trate 0.3 remap v
fix p all print 10 "$(xy:%.17g) $(xz:%.17g) $(yz:%.17g) $(c_1_temp:%.17g) $(f_1:%.17g)" file p.txt screen no
D

check heat <<'D'
fix 1 all nve
region hot block INF INF INF INF 0 1.5
compute t all temp/region hot
fix 2 all heat 2 5 region hot
fix 3 all langevin 1.0 1.0 0.5 4711 tally yes
fix_modify 3 temp t
fix p all print 10 "$(f_2:%.17g) $(f_3:%.17g)" file p.txt screen no
D

check exchange <<'D'
fix 1 all nve
region hot block INF INF INF INF 0 1.5
compute d all displace/atom
compute s all reduce sum c_d[4]
fix 2 all viscosity 7 x z 4 swap 2
fix 3 all thermal/conductivity 8 y 4 swap 3
fix 4 all ehex 2 5 region hot
fix p all print 10 "$(f_2:%.17g) $(f_3:%.17g) $(f_4:%.17g) $(c_s:%.17g)" file p.txt screen no
D

# the box shrinks onto its atoms, so that the region reaches out of it when the run is resumed
check deposit_above <<'D'
change_box all boundary p p s
region most block 0 4 0 4 0 3.5
region upper block INF INF INF INF 2.2 INF
fix 1 all nve
fix 2 all deposit 30 2 9 4711 region most near 0.6
delete_atoms region upper
D

check deposit <<'D'
region all block 0 4 0 4 0 4
region small block 1 3 1 3 1 3
delete_atoms region small
fix 1 all nve
fix 2 all deposit 30 2 5 4711 region all near 0.6 vx -1 1 id next
variable r atom random(-0.1,0.1,99)
set group all vx v_r
fix p all print 10 "$(atoms) $(f_2)" file p.txt screen no
D

check adapt <<'D'
fix 1 all nve
variable f equal 1.2-0.3*cos(step/11)
variable s equal 1+0.002*step
fix a all adapt 5 pair lj/cut epsilon 1 1 v_f pair lj/cut sigma * * v_s scale yes reset yes
fix b all adapt 3 pair lj/cut epsilon 1 1 v_f
run 7
unfix b
fix p all print 10 "$(pe:%.17g)" file p.txt screen no
D

check controller <<'D'
variable T internal 1.0
fix 1 all nve
fix 2 all langevin v_T 1.0 0.5 4711
fix 3 all controller 7 1.0 0.5 0.2 0.1 c_thermo_temp 1.5 T
fix p all print 10 "$(v_T:%.17g) $(f_3[1]:%.17g) $(f_3[2]:%.17g) $(f_3[3]:%.17g)" file p.txt screen no
D

check adapted_before <<'D'
fix 1 all nve
variable f equal 0.4+0.01*step
fix a all adapt 2 pair lj/cut epsilon 1 2 v_f
run 9
unfix a
D

check diameters <<'D'
clear
units lj
atom_style sphere
lattice sc 1.0
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
set group all diameter 0.8
velocity all create 0.5 4711
pair_style harmonic/sphere
pair_coeff * * 100
checkpoint every 33 steps keep 9
thermo 10
fix 1 all nve
variable d equal 1+0.004*step
fix a all adapt 4 atom diameter v_d scale yes reset yes
D

check damped <<'D'
fix 1 all nve
fix 2 all temp/berendsen 1.0 2.0 0.2
fix 3 all dt/reset 7 NULL 0.01 0.02
fix 4 all viscous 0.2
fix p all print 10 "$(f_2:%.17g) $(f_3) $(time:%.17g) $(dt:%.17g)" file p.txt screen no
D

check turning <<'D'
clear
units lj
atom_style hybrid sphere dipole
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
set group all diameter 0.9
set group all dipole/random 4711 0.5
velocity all create 1.44 87287
set group all omega 0.3 -0.2 1.1
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0 2.5
neigh_modify every 7 delay 0 check no
checkpoint every 33 steps keep 9
thermo 10
fix 1 all nve/sphere update dipole
fix 2 all langevin 1.44 1.44 0.7 4711 omega yes
compute e all erotate/sphere
fix p all ave/time 1 1 10 c_e file e.txt
dump d all custom 10 d.dump id omegax omegay omegaz mux muy muz
dump_modify d format float %.17g
D

# temperatures go on with the degrees of freedom that were counted when the run began, though atoms have been lost since
check leaking <<'D'
clear
units lj
boundary f p p
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
checkpoint every 33 steps keep 9
thermo 10
thermo_modify lost ignore
compute hot all temp
fix 1 all nvt temp 2.0 2.0 0.5
fix p all print 10 "$(atoms) $(temp:%.17g) $(c_hot:%.17g) $(c_1_temp:%.17g)" file p.txt screen no
D

# the step of the checkpoint has been measured: its places are not to count twice in the mean
check averaged <<'D'
compute m all msd average yes
fix 1 all nve
thermo_style custom step c_m[4]
run 33
print "$(c_m[4]:%.17g)" file first.txt
fix p all print 11 "$(c_m[4]:%.17g)" file p.txt screen no
D

# a checkpoint between runs, when the next one is to be set up anew and the pair style's parts are not known yet
check between <<'D'
fix 1 all nve
variable e equal 1+0.004*step
fix a all adapt 4 pair lj/cut epsilon 1 1 v_e scale yes
run 33
displace_atoms all move 0 0 0
write_restart checkpoint.33.h5
D

check swapping <<'D'
fix 1 all nve
fix 2 all atom/swap 10 30 4711 1.4 types 1 2
fix 3 all atom/swap 7 5 4711 1.4 types 1 2 semi-grand yes mu 0.0 0.3
fix 4 all widom 10 50 2 12 1.5
fix p all ave/time 1 1 10 f_2[1] f_2[2] f_3[2] f_4[1] f_4[2] f_4[4] f_4[5] file moves.txt
dump d all custom 10 d.dump id type
D

check exchanging <<'D'
compute_modify thermo_temp dynamic/dof yes
pair_modify tail yes
fix 1 all nve
fix 2 all gcmc 5 30 10 1 4711 5.0 -15.0 0.2
fix p all print 10 "$(atoms) $(etail:%.17g) $(f_2[2]) $(f_2[4]) $(f_2[6]) $(temp:%.17g)" file p.txt screen no
dump d all custom 10 d.dump id x
D

# The table of a resumed run goes on: rows at the steps that a variable gives, and means of all rows of the run.
mkdir table
cd table
cat >in <<'D'
units lj
lattice fcc 0.8442
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0 2.5
checkpoint every 33 steps keep 9
variable s equal stride(0,1000,6)
thermo v_s
thermo_modify means yes
fix 1 all nve
run 80
D
"$HALFSHELL" in -log none >out 2>&1 || fail "table: $(tail -3 out)"
"$HALFSHELL" resume checkpoint.33.h5 -log none >resumed 2>&1 || fail "table, resumed: $(tail -3 resumed)"
for file in out resumed; do
    table $file | awk '$1 > 33' >$file.rows
    sed -n '/^Means of/,/^Drift/p' $file >$file.means
done
[ "$(wc -l <out.rows)" -eq 9 ] || fail "table: $(wc -l <out.rows) rows" # 36, 42, ... 78, and the last step
cmp out.rows resumed.rows || fail "table: rows"
grep -q "^Means of 14 rows" out.means || fail "table: $(head -1 out.means)"
cmp out.means resumed.means || fail "table: means"
cd ..
