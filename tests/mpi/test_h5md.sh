#!/bin/bash
# The trajectory of several ranks holds what that of one rank holds, row by row.
set -eu
. "$PROJECT_ROOT/tests/support/h5py.sh"
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

cat >run.in <<END
units lj
lattice fcc 0.8442
region box block 0 6 0 6 0 6
create_box 2 box
create_atoms 1 box
set group all type/fraction 2 0.3 4711
mass 1 1.0
mass 2 2.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
group two type 2
dump t all h5md 10 all.\${ranks}.h5 position velocity force image
dump u two h5md 10 two.\${ranks}.h5 velocity species c_thermo_temp
run 20
run 10
END
for n in 0 2 4; do ranks $n run.in -var ranks $n -log none >out.$n || fail "$n ranks"; done
cat >look.py <<END
import h5py, sys
one = h5py.File(sys.argv[1], 'r')
names = []
one.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
assert len(names) > 12
for other in sys.argv[2:]:
    several = h5py.File(other, 'r')
    for name in names:
        a, b = one[name], several[name]
        assert a.shape == b.shape and a.dtype == b.dtype, name
        # sums of forces differ in rounding, which 30 steps of a liquid enlarge by less than a thousand
        if a.dtype.kind == 'f' and a.shape: assert abs(a[:] - b[:]).max() < 1e-9, name
        elif a.shape: assert (a[:] == b[:]).all(), name
END
"$python" look.py all.0.h5 all.2.h5 all.4.h5
"$python" look.py two.0.h5 two.2.h5 two.4.h5
