#!/bin/bash
# The trajectory of dump dcd as MDAnalysis reads it: equal to the text dump of the same steps, with tilted boxes; and the bytes
# that MDAnalysis itself writes for the same frames.
set -eu
for python in /usr/bin/python3 python3; do
    if "$python" -W ignore -c 'import MDAnalysis' 2>/dev/null; then break; fi
    python=
done
[ -n "$python" ] || { echo "skipped: no Python with MDAnalysis"; exit 77; }
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >run.in <<END
units lj
lattice fcc 0.8442
region box prism -1 2 0 3 0 4 0.7 -0.6 0.5
create_box 2 box
create_atoms 1 box
set group all type/fraction 2 0.3 4711
mass * 1.0
velocity all create 3.0 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all npt temp 3 3 0.5 tri 1 1 1
group two type 2
reset_timestep 100
dump a all dcd 10 all.dcd
dump b two dcd 20 two.dcd
dump_modify b unwrap yes first yes
dump c all custom 10 all.dump id x y z
dump d two custom 20 two.dump id xu yu zu
dump_modify c format float %.17g
dump_modify d format float %.17g
dump e all dcd 10 wrapped.dcd
dump_modify e pbc yes
dump f all custom 10 wrapped.dump id x y z
dump_modify f pbc yes format float %.17g
thermo 10
thermo_style custom step lx ly lz xy xz yz cella cellb cellc cellalpha cellbeta cellgamma
thermo_modify format float %.15g
run 200
END
"$HALFSHELL" run.in -log log >/dev/null
# Frames of other steps than the head tells are said once.
{
    sed '/^dump/d; /^thermo_style/d; /^thermo_modify/d; s/^run .*/run 15/; s/^reset_timestep.*//' run.in
    echo "reset_timestep 0
run 20"
} | sed 's/^thermo 10/dump a all dcd 10 odd.dcd/' >odd.in
"$HALFSHELL" odd.in -log none >odd.out
[ "$(grep -c "WARNING: dump 'a' (dcd): frame 3 of 'odd.dcd' is of step 0, and readers of dcd files take it for one of step 20" odd.out)" -eq 1 ]
[ "$(grep -c "WARNING: dump 'a'" odd.out)" -eq 1 ]
cat >look.py <<END
import numpy as np, os
from MDAnalysis import Universe
from MDAnalysis.lib.formats.libdcd import DCDFile
rows = np.array([list(map(float, w)) for w in map(str.split, open('log')) if len(w) == 13 and w[0].isdigit()])
assert len(rows) == 21 and abs(rows[-1][4] - rows[0][4]) > 0.01, 'the box should have changed'
def text(name):
    for item in open(name).read().split('ITEM: TIMESTEP')[1:]:
        yield np.array([list(map(float, line.split())) for line in item.split('ATOMS')[2].splitlines()[1:]])
for name, first, every in [('all', 100, 10), ('wrapped', 100, 10), ('two', 100, 20)]:
    frames = list(text(name + '.dump'))
    n = len(frames[0])
    with DCDFile(name + '.dcd') as f:
        head = f.header
        assert (head['natoms'], head['istart'], head['nsavc'], head['is_periodic']) == (n, first, every, 1), head
        assert abs(head['delta'] - 0.005) < 1e-9 and len(f) == len(frames) == 200 // every + 1
        read = f.readframes()
    for k, t in enumerate(frames):
        assert (read.xyz[k] == t[:, 1:].astype(np.float32)).all(), (name, k)
    u = Universe.empty(n)
    u.load_new(name + '.dcd', format='LAMMPS', lengthunit='A', timeunit='fs')
    for k, ts in enumerate(u.trajectory):
        # single precision
        assert abs(ts.dimensions - rows[k * every // 10][7:]).max() < 2e-5, (name, k, ts.dimensions)
    # the same frames written by MDAnalysis: all but the head's text and its last step, which it does not keep
    with DCDFile('again.dcd', 'w') as w:
        w.write_header(remarks=head['remarks'], natoms=n, istart=first, nsavc=every, delta=head['delta'], is_periodic=1)
        for k in range(len(frames)): w.write(xyz=read.xyz[k], box=read.unitcell[k])
    ours, theirs = open(name + '.dcd', 'rb').read(), open('again.dcd', 'rb').read()
    head_end = 92 + 172 + 12
    assert ours[264:head_end] == theirs[-len(ours) + 264:-len(ours) + head_end], 'number of atoms'
    assert ours[:8] == theirs[:8] and ours[12:20] == theirs[12:20] and ours[24:92] == theirs[24:92], 'head'
    assert ours[head_end:] == theirs[-(len(ours) - head_end):], 'frames'
# what a kill may leave: a frame that is not whole, or not counted, is no matter to readers
data = open('all.dcd', 'rb').read()
n, size = 21, (len(data) - 276) // 21
for cut in [1, size // 2, size - 1]:
    open('cut.dcd', 'wb').write(data[:len(data) - cut])
    with DCDFile('cut.dcd') as f: assert len(f) == n - 1 and len(f.readframes().xyz) == n - 1
open('late.dcd', 'wb').write(data[:8] + (20).to_bytes(4, 'little') + data[12:])
with DCDFile('late.dcd') as f: assert len(f) == n
END
"$python" -W ignore look.py 2>look.err || { cat look.err >&2; exit 1; }
