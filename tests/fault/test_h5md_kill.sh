#!/bin/bash
# An H5MD file opens, with every frame whole, whatever moment the run is killed at: killed at single writes (some of the
# file's making and first frames, and all about the moment when the index of frames grows a level), and by the clock.
set -eu
. "$PROJECT_ROOT/tests/support/h5py.sh"
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >run.in <<END
units lj
lattice fcc 0.8442
region box block 0 2 0 2 0 2
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 1.5
pair_coeff 1 1 1.0 1.0
fix 1 all nve
variable T equal temp
dump t all h5md 1 run.h5md position velocity image v_T
dump_modify t compress \${level}
thermo 1000
run \${steps}
END
cat >look.py <<END
import h5py, numpy, os, sys
# One file, or those of many kills: prints the number of frames of each.
for name in sys.argv[1:]:
    with h5py.File(name, 'r') as f:
        p = f['particles/all']
        n = p['position/value'].shape[0]
        assert p['position/step'].shape[0] >= n and p['position/time'].shape[0] >= n, 'steps'
        assert (p['position/step'][:n] == numpy.arange(n)).all(), 'steps do not count up'
        assert n == 0 or (p['id'][:] == numpy.arange(1, 33)).all(), 'ids'
        for element in ['position/value', 'velocity/value', 'box/edges/value']:
            assert numpy.isfinite(p[element][:n]).all(), element
        assert p['image/value'].shape[0] >= n, 'images'
        for i in range(0, n, 17):
            assert len(numpy.unique(p['position/value'][i], axis=0)) == 32, 'two atoms at one place in frame %d' % i
        print(n)
END

# Killed at single writes.
if [ -z "$(ldd "$HALFSHELL" | grep -E 'asan|ubsan' || true)" ] &&
    "${CC:-cc}" -shared -fPIC -O1 -o die.so "$PROJECT_ROOT/tests/fault/preload/die_at_write.c" -ldl; then
    n_frames=258 # the index has 256 entries a node: it splits here, in the last 140 writes
    LD_PRELOAD=$folder/die.so COUNT_WRITES=$folder/total "$HALFSHELL" run.in -var level 0 -var steps $n_frames -log none >/dev/null
    total=$(cat total)
    rm -f run.h5md
    kill_at() {
        (
            mkdir "at$1" && cd "at$1"
            LD_PRELOAD=$folder/die.so DIE_AT_WRITE=$1 "$HALFSHELL" ../run.in -var level 0 -var steps $n_frames -log none
        ) >/dev/null 2>&1 || true
    }
    { for at in $(seq 1 9 90) $(seq $((total - 140)) $((total - 2))); do kill_at "$at"; done; } 2>/dev/null # not one line for each
    "$python" look.py at*/run.h5md >frames || { echo "killed at a single write: the file is not readable" >&2; exit 1; }
    [ "$(sort -n frames | tail -1)" -ge $((n_frames - 1)) ] || { echo "kills did not come late enough" >&2; exit 1; }
fi

# Killed by the clock, after 0.05 to 0.4 seconds as the round says.
most=0
for round in $(seq 1 6); do
    delay=$(awk -v r="$round" 'BEGIN { printf "%.4f", 0.05 + 0.35 * ((r * 0.6180339887) % 1) }')
    rm -f run.h5md*
    "$HALFSHELL" run.in -var level $((round % 4 == 0)) -var steps 1000000 -log none >/dev/null &
    pid=$!
    sleep "$delay"
    { kill -9 "$pid" && wait "$pid"; } 2>/dev/null || true
    [ -e run.h5md ] || continue # killed before the file was made: there is none at all
    n=$("$python" look.py run.h5md) || { echo "round $round (killed after $delay s): the file is not readable" >&2; exit 1; }
    if [ "$n" -gt "$most" ]; then most=$n; fi
done
[ "$most" -gt 20 ] || { echo "at most $most frames were written: the kills came too early to say anything" >&2; exit 1; }
