#!/bin/bash
# The examples of docs/extending.md, built as they stand there with the commands that build their neighbors, and run.
set -eu
export CCACHE_DISABLE=1
[ -f "$BUILD_DIR/build.ninja" ] && command -v ninja >/dev/null 2>&1 || { echo "skipped: not built by ninja"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/fix" "$work/pair"

# A block of C after a line that begins with `src/...`: that file.
awk -v work="$work" '/^`src\// { split($0, part, "`"); file = work substr(part[2], 4) }
    /^```$/ { out = "" } out != "" { print > out } /^```c$/ { out = file }' "$PROJECT_ROOT/docs/extending.md"

# The program's tables of styles, with one more each.
for kind in fix pair; do
    name=$(basename "$work/$kind"/*.c .c)
    sed "s/^    NULL,/    \&hs_${kind}_style_$name,\n    NULL,/; s/^const hs_${kind}_style \*const/extern const hs_${kind}_style hs_${kind}_style_$name;\n&/" \
        "$BUILD_DIR/generated/table_hs_${kind}_styles.c" >"$work/$kind/table.c"
done

ninja -C "$BUILD_DIR" -t commands halfshell >"$work/commands"
# like FILE NEW: the commands that compile FILE, for the new file; without optimization, which takes its time.
like() {
    local n=0
    grep -- " -c .*/src/$1\$" "$work/commands" | while read -r command; do
        n=$((n + 1))
        echo "$command" | sed -E "s|-O3( -g)?|-O0|; s| -M[A-Z]*( [^ -][^ ]*)?||g; s| -o .* -c .*| -o $work/$2.$n.o -c $work/$2.c|"
    done
}
{
    like fix/viscous.c fix/wind
    like fix/viscous.c fix/table
    like pair/soft.c pair/hertz
    like fix/viscous.c pair/table
} >"$work/compile"
cd "$BUILD_DIR"
tr '\n' '\0' <"$work/compile" | xargs -0 -P 2 -n 1 bash -c 'eval "$0" || exit 255'
link=$(tail -1 "$work/commands" | sed "s| -o halfshell | $(echo "$work"/*/*.o) -o $work/halfshell |")
eval "$link"

cd "$work"
"$work/halfshell" help wind | grep -q 'drag by a medium that moves'
# One atom that the wind takes along, v = u (1 - exp(-gamma t)); two that overlap by a half.
cat >in.deck <<'D'
units lj
region box block 0 10 0 10 0 10
create_box 2 box
create_atoms 1 single 5 5 1
create_atoms 2 single 5 5 5
create_atoms 2 single 5 5 5.5
mass * 1.0
pair_style hertz 1.0
pair_coeff * * 100.0
pair_modify shift no
group one type 1
fix 1 one nve
fix w one wind 0.5 1.0 0.0 0.0
timestep 0.001
variable speed equal vcm(one,x)
variable power equal f_w
thermo_style custom step pe v_speed v_power
thermo_modify norm no format float %.10g
run 2000
D
"$work/halfshell" in.deck -log log -screen none
awk '$1 == 2000 && NF == 4 { found = 1
         energy = 100 * 0.5 ^ 2.5; speed = 1 - exp(-1); power = 0.5 * (1 - speed) * speed
         if (($2 - energy) ^ 2 > 1e-16 || ($3 - speed) ^ 2 > 1e-6 || ($4 - power) ^ 2 > 1e-6) { print "unexpected: " $0; exit 1 } }
     END { exit !found }' log || { cat log; exit 1; }
