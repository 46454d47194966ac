#!/bin/bash
# The trajectory of dump h5md as h5py, h5dump and MDAnalysis see it: equal to the text dump of the same steps.
set -eu
. "$PROJECT_ROOT/tests/support/h5py.sh"
. "$PROJECT_ROOT/tests/support/folder.sh"

cat >run.in <<END
units lj
lattice fcc 0.8442
region box block -1 2 0 3 0 4
create_box 2 box
create_atoms 1 box
set group all type/fraction 2 0.3 4711
mass 1 1.0
mass 2 2.0
velocity all create 3.0 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
variable T equal temp
group two type 2
dump t all h5md 10 run.h5md position velocity force image v_T c_thermo_press
dump u two h5md 20 two.h5md velocity species
dump_modify u compress 5
dump s all custom 10 run.dump id type x y z vx vy vz fx fy fz ix iy iz
dump_modify s format float %.17g
run 50
write_dump two h5md one.h5md
dump_modify t every 5
run 10
write_data last.data
END
"$HALFSHELL" run.in -log none >/dev/null
[ -z "$(find . -name '*.halfshell-part-*')" ] || { echo "parts of files were left" >&2; exit 1; }

cat >add.in <<END
units lj
lattice fcc 0.8442
region box block -1 2 0 3 0 4
create_box 2 box
create_atoms 1 box
mass * 1.0
pair_style zero 2.5
pair_coeff * *
variable T equal temp
reset_timestep 60
dump t all h5md 1 run.h5md position velocity force image v_T c_thermo_press
dump_modify t append yes
fix 1 all nve
run 1
END
"$HALFSHELL" add.in -log none >/dev/null
sed 's/reset_timestep 60/reset_timestep 3/' add.in >back.in
if "$HALFSHELL" back.in -log none >/dev/null 2>back.err; then echo "frames of later steps were overwritten" >&2; exit 1; fi
grep -q 'run.h5md.*up to step 61' back.err

cat >look.py <<END
import h5py, numpy as np
frames = {}
lines = open('run.dump').read().split('ITEM: TIMESTEP\n')[1:]
for text in lines:
    rows = text.split('\n')
    frames[int(rows[0])] = np.array([[float(w) for w in row.split()] for row in rows[8:] if row])
f = h5py.File('run.h5md', 'r')
p = f['particles/all']
steps = list(p['position/step'][:])
assert steps == [0, 10, 20, 30, 40, 50, 55, 60, 61], steps
assert abs(p['position/time'][:7] - 0.005 * np.array(steps[:7])).max() < 1e-12 # rounding of products
assert (p['id'][:] == np.arange(1, 145)).all()
for k, step in enumerate(steps[:7]):
    if step not in frames: continue
    t = frames[step]
    assert (p['species'][:] == t[:, 1]).all() and (p['mass'][:] == t[:, 1]).all()
    edges, lo = p['box/edges/value'][k], p['box/offset/value'][k]
    x, image = p['position/value'][k], p['image/value'][k]
    assert ((x >= lo) & (x < lo + np.diag(edges))).all(), 'positions are not in the box'
    # unwrapped positions are the same; a wrap is one rounded addition
    assert abs(x + image @ edges - (t[:, 2:5] + t[:, 11:14] @ edges)).max() < 1e-14 * 8 * abs(image).max() + 1e-14
    assert (p['velocity/value'][k] == t[:, 5:8]).all() and (p['force/value'][k] == t[:, 8:11]).all()
assert p['box'].attrs['dimension'] == 3 and list(p['box'].attrs['boundary']) == [b'periodic'] * 3
assert list(f['h5md'].attrs['version']) == [1, 1] and f['h5md/creator'].attrs['name'] == b'Halfshell'
assert 'unit' not in p['position/value'].attrs and 'unit' not in p['position/time'].attrs
# step and time of box, elements and observables are one dataset, hard-linked
for other in [p['box/edges'], p['velocity'], p['image'], f['observables/v_T']]:
    for name in ['step', 'time']:
        assert other[name] == p['position'][name], other
assert f['observables/v_T/value'].shape == (9,) and abs(f['observables/v_T/value'][0] - 3.0) < 1e-12
assert f['parameters/halfshell/deck'][()].decode() == open('run.in').read()
assert f['parameters/halfshell/version'][()].decode()

# A group: rows are its atoms in the order of ids; species as an element that changes with time.
u = h5py.File('two.h5md', 'r')['particles/all']
t = frames[20]
two = t[:, 1] == 2
assert (u['id'][:] == t[two, 0]).all() and (u['velocity/value'][1] == t[two, 5:8]).all()
assert (u['species/value'][:] == 2).all() and u['velocity/value'].compression == 'gzip'
one = h5py.File('one.h5md', 'r')['particles/all']
assert one['position/value'].shape == (1, two.sum(), 3)
END
"$python" look.py

# Atoms that leave and atoms that come: fill values where a frame has not an atom, new rows at the end.
cat >gas.in <<END
boundary f f f
region box block 0 8 0 8 0 8
lattice sc 0.3
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 9.0 4711
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
thermo_style custom step atoms
thermo_modify lost ignore
thermo 20
dump g all h5md 20 gas.h5md position velocity image
run 60
create_atoms 1 single 0.1 0.1 0.1 units box
create_atoms 1 single 7.9 7.9 7.9 units box
dump_modify g every 4
run 4
write_data gas.data
END
"$HALFSHELL" gas.in -log gas.log >/dev/null
cat >gas.py <<END
import h5py, numpy as np
counts = {}
for words in map(str.split, open('gas.log')): # step 60 has a row before and one after atoms come
    if len(words) == 2 and words[0].isdigit() and words[1].isdigit(): counts.setdefault(int(words[0]), int(words[1]))
p = h5py.File('gas.h5md', 'r')['particles/all']
x, v, image, ids = p['position/value'][:], p['velocity/value'][:], p['image/value'][:], p['id'][:]
n = [int(np.isfinite(frame[:, 0]).sum()) for frame in x]
assert list(p['position/step'][:]) == [0, 20, 40, 60, 64] and n[:4] == [counts[s] for s in (0, 20, 40, 60)], (n, counts)
assert n[0] > n[3] and n[4] <= n[3] + 2 and len(ids) == n[0] + 2 and len(set(ids)) == len(ids)
assert np.isnan(x[:4, n[0]:]).all() and np.isfinite(x[0, :n[0]]).all()
for k in range(5): # all elements of a frame have the same atoms
    here = np.isfinite(x[k, :, 0])
    assert (np.isfinite(x[k]).all(1) == here).all() and (np.isfinite(v[k]).all(1) == here).all()
    assert ((image[k] == -2**31).all(1) == ~here).all()
try:
    import warnings
    warnings.simplefilter('ignore')
    import MDAnalysis
except ImportError:
    raise SystemExit
u = MDAnalysis.Universe.empty(len(ids), trajectory=True)
u.load_new('gas.h5md', convert_units=False)
for k in range(5):
    u.trajectory[k]
    assert (np.isnan(u.atoms.positions[:, 0]) == np.isnan(x[k, :, 0])).all()
END
"$python" -W ignore gas.py 2>gas.err || { cat gas.err >&2; exit 1; }

if command -v h5dump >/dev/null; then h5dump -d /particles/all/position/step run.h5md | grep -q '0, 10, 20'; fi
if "$python" -c 'import MDAnalysis' 2>/dev/null; then
    cat >mda.py <<END
import warnings
warnings.simplefilter('ignore')
import h5py, numpy as np, MDAnalysis
u = MDAnalysis.Universe('last.data', atom_style='id type x y z')
u.load_new('run.h5md', convert_units=False)
p = h5py.File('run.h5md', 'r')['particles/all']
assert u.trajectory.n_frames == 9 and len(u.atoms) == 144
for k in [0, 3, 7]:
    ts = u.trajectory[k]
    # MDAnalysis keeps single precision
    assert abs(u.atoms.positions - p['position/value'][k]).max() < 2e-6
    assert abs(u.atoms.velocities - p['velocity/value'][k]).max() < 2e-6
    assert abs(ts.dimensions[:3] - np.diag(p['box/edges/value'][k])).max() < 2e-6
    assert abs(ts.time - p['position/time'][k]) < 1e-9
v = MDAnalysis.Universe('last.data', 'run.dump', atom_style='id type x y z', format='LAMMPSDUMP')
assert v.trajectory.n_frames == 7
END
    "$python" -W ignore mda.py 2>mda.err || { cat mda.err >&2; exit 1; }
fi

# a tilted box: edges, angles and fractions as the readers see them
cat >tilted.in <<END
units lj
lattice fcc 0.8442
region box prism -1 2 0 3 0 4 0.5 -1 0.75
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.0 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
fix 2 all deform 1 xy erate 0.5
dump t all h5md 20 tilted.h5md position
dump s all custom 20 tilted.dump id type x y z xs ys zs
dump_modify s sort id format float %.17g
thermo_style custom step lx ly lz xy xz yz cella cellb cellc cellalpha cellbeta cellgamma
thermo_modify format float %.15g
thermo 20
run 40
write_data tilted.data
END
"$HALFSHELL" tilted.in -log tilted.log >/dev/null
cat >tilted.py <<END
import h5py, numpy as np
rows = [list(map(float, w)) for w in map(str.split, open('tilted.log')) if len(w) == 13 and w[0].isdigit()]
p = h5py.File('tilted.h5md', 'r')['particles/all']
items = open('tilted.dump').read().split('ITEM: TIMESTEP')[1:]
assert len(rows) == 3 and len(items) == 3 and rows[2][4] > rows[0][4]
for k in range(3):
    lx, ly, lz, xy, xz, yz = rows[k][1:7]
    edges, offset = p['box/edges/value'][k], p['box/offset/value'][k]
    # 15 digits in the log
    assert abs(edges - [[lx, 0, 0], [xy, ly, 0], [xz, yz, lz]]).max() < 1e-13, edges
    atoms = np.array([list(map(float, line.split())) for line in items[k].split('ATOMS')[2].splitlines()[1:]])
    x = p['position/value'][k]
    # places in the text dump are those of the last wrap, here wrapped again: a whole edge may lie between
    away = np.linalg.solve(edges.T, (x - atoms[:, 2:5]).T)
    assert abs(away - np.rint(away)).max() < 1e-12
    assert abs(atoms[:, 2:5] - (offset + atoms[:, 5:8] @ edges)).max() < 1e-12
try:
    import warnings
    warnings.simplefilter('ignore')
    import MDAnalysis
except ImportError:
    raise SystemExit
data = MDAnalysis.Universe('tilted.data', atom_style='id type x y z')
text = MDAnalysis.Universe('tilted.data', 'tilted.dump', atom_style='id type x y z', format='LAMMPSDUMP')
h5md = MDAnalysis.Universe('tilted.data', atom_style='id type x y z')
h5md.load_new('tilted.h5md', convert_units=False)
for universe in (text, h5md):
    for k in range(3):
        # single precision
        assert abs(universe.trajectory[k].dimensions - rows[k][7:]).max() < 2e-5, universe.trajectory[k].dimensions
assert abs(data.dimensions - rows[2][7:]).max() < 2e-5, data.dimensions
END
"$python" -W ignore tilted.py 2>tilted.err || { cat tilted.err >&2; exit 1; }
