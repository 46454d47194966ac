#!/bin/bash
# Files that all ranks write together are the same bytes for any number of ranks, as long as the numbers are: at step 0 all
# are; after some steps positions agree to rounding.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

cat >in.make <<'D'
lattice fcc 0.8442
region box block 0 5 0 6 0 4
region half block 0 2.5 0 6 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 77
mass 1 1.0
mass 2 1.5
group low id 1:100
velocity all create 3.0 87287 loop local
velocity low set 0.1 NULL NULL sum yes
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
variable r2 atom "x*x + y*y"
dump a all atom 4 a.dump
dump b all custom 4 b.*.dump.gz id type mass x y z vx vy vz v_r2
dump_modify b sort -7 thresh z > 1.5
dump c low xyz 4 c.xyz
dump_modify c element Ar Kr
dump d all custom 4 d.dump id x
dump_modify d sort off region half
dump e all dcd 2 e.dcd
dump f low dcd 4 f.dcd
dump_modify f unwrap yes
dump g all cfg 4 g.*.cfg mass type xsu ysu zsu id v_r2
dump_modify g element Ar Kr
neigh_modify every 2 delay 0 check no
run 0
fix p all property/atom i_n d_w
set type 1 i_n 3
variable w atom x*0.3
set group all d_w v_w
write_data start.data
write_data pure.data nofix
write_data packed.data.gz pair ij
print "atoms $(count(all)) low $(count(low)) left $(bound(all,xmin):%.12g) mass $(mass(all))" file said
run 4
write_data end.data
D

cat >in.read <<'D'
pair_style lj/cut 2.5
fix p all property/atom i_n d_w
read_data ../0/start.data extra/atom/types 1 fix p NULL p
pair_coeff * * 1.0 1.0
mass 3 1.0
group old id 1:480
read_data ../0/pure.data add append shift 0 0 9 group new nocoeff
group count_new subtract new old
print "$(count(all)) $(count(new)) $(count(old))" file said.2
write_data twice.data nocoeff
D

for n in 0 2 3; do
    mkdir "$n"
    cd "$n"
    ranks "$n" ../in.make -log none -screen none || fail "make on $n ranks: exit code $?"
    ranks "$n" ../in.read -log none -screen none || fail "read on $n ranks: exit code $?"
    gunzip -f ./*.gz
    cd ..
done

# first N.dump: the snapshot of step 0
first() { awk '/ITEM: TIMESTEP/ && ++n == 2 {exit} {print}' "$1"; }

for n in 2 3; do
    for file in start.data packed.data b.0.dump e.dcd f.dcd g.0.cfg said said.2 twice.data; do
        cmp "0/$file" "$n/$file" || fail "$file of $n ranks"
    done
    cmp <(first 0/a.dump) <(first "$n/a.dump") || fail "a.dump of $n ranks at step 0"
    cmp <(sed -n 1,102p 0/c.xyz) <(sed -n 1,102p "$n/c.xyz") || fail "c.xyz of $n ranks at step 0"
    cmp <(first 0/d.dump | sort) <(first "$n/d.dump" | sort) || fail "d.dump of $n ranks at step 0"
    # rounding of the forces, grown over four steps
    for file in a.dump c.xyz end.data b.4.dump; do same_numbers "0/$file" "$n/$file" 1e-9; done
done
[ "$(cat 0/said.2)" = "960 480 480" ] || fail "read twice: $(cat 0/said.2)"
