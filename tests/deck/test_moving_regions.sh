#!/bin/bash
# Regions that move are brought to the step by each who asks them for atoms: what fixes do must not hang on whether something else,
# such as a column of thermo output, has asked at the same step.
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"

# deck STEPS-BETWEEN-ROWS COLUMN
deck() {
    cat <<D
units lj
lattice fcc 0.4
region box block 0 8 0 4 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.5 4711
mass * 1.0
velocity all create 1.0 4711
pair_style lj/cut 2.5
pair_coeff * * 1 1
variable x equal 0.3*step
$(for user in swap widom force heat group going; do
    echo "region $user block 0 2 INF INF INF INF move v_x NULL NULL"
    echo "variable n_$user equal count(all,$user)"
done)
compute_modify thermo_temp dynamic/dof yes
group inside dynamic all region group every 2
fix 1 all nve
fix s all atom/swap 1 50 77 1 types 1 2 region swap
fix w all widom 4 100 1 77 1 region widom
fix a all addforce 0.5 0 0 region force
fix h all heat 3 0.5 region heat
fix i inside addforce 0 0.3 0
fix e all evaporate 7 3 going 4711
fix p all print 7 "\$(f_s[2]) \$(f_w[2]:%.17g) \$(f_w[3]:%.17g) \$(f_e)" file p.txt screen no
thermo_style custom step temp $2
thermo $1
run 23
write_dump all custom end.dump id type x vx vy modify format float %.17g
D
}

for rows in often seldom; do
    mkdir "$rows"
    if [ "$rows" = often ]; then deck 1 "v_n_swap v_n_widom v_n_force v_n_heat v_n_group v_n_going" >"$rows/in"; else deck 100 "" >"$rows/in"; fi
    (cd "$rows" && "$HALFSHELL" in -log none >out 2>&1) || fail "$rows: $(tail -1 "$rows/out")"
done
cmp often/end.dump seldom/end.dump || fail "the same fixes move atoms otherwise when the region is shown"
cmp often/p.txt seldom/p.txt || fail "the same fixes count otherwise when the region is shown"
# The region is a quarter of the box; 100 random places tell this to a few hundredths.
awk 'NR > 2 && ($3 < 0.15 * V || $3 > 0.35 * V) { print "volume " $3; bad = 1 } END { exit bad }' V=1280 often/p.txt ||
    fail "the region's volume"
