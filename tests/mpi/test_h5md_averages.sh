#!/bin/bash
# Averages as H5MD observables: what the text files of the same run say, on one rank and on two, and each step once when a run
# goes on from a checkpoint of some frames ago.
set -eu
. "$PROJECT_ROOT/tests/support/h5py.sh"
. "$PROJECT_ROOT/tests/mpi/ranks.sh"

cat >run.in <<END
units lj
lattice fcc 0.8442
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
fix 1 all nve
group none empty
compute g all rdf 12
fix t all ave/time 2 5 10 c_thermo_temp c_thermo_press error yes ave running format " %.17g" file t.txt
fix g all ave/time 2 5 10 c_g[*] mode vector error yes ave running format " %.17g" file g.txt
fix p all ave/time 2 5 10 c_thermo_press[*] format " %.17g" file p.txt
checkpoint every 30 steps keep 9
dump a none h5md 10 averages.h5 f_t f_g f_p c_g c_thermo_temp
run 100
END
cat >look.py <<END
import h5py, numpy as np, sys
o = h5py.File('averages.h5', 'r')['observables']
n = 11
assert list(o['f_t/step'][:]) == list(range(0, 101, 10)), list(o['f_t/step'][:])
assert {k: o[k + '/value'].shape for k in o} == {'f_t': (n, 6), 'f_g': (n, 12, 9), 'f_p': (n, 6), 'c_g': (n, 12, 3),
                                                 'c_thermo_temp': (n,)}
def rows(name):
    return [list(map(float, line.split())) for line in open(name) if not line.startswith('#')]
def equal(a, b): # %.17g is exact
    a, b = np.array(a), np.array(b)
    assert a.shape == b.shape and ((a == b) | np.isnan(a) & np.isnan(b)).all(), (a, b)
equal(o['f_t/value'][1:], [row[1:] for row in rows('t.txt')])
equal(o['f_p/value'][1:], [row[1:] for row in rows('p.txt')])
lines = rows('g.txt')
for k in range(1, n):
    head, *body = lines[13 * (k - 1):13 * k]
    assert head[0] == 10 * k
    equal(o['f_g/value'][k], [row[1:] for row in body])
assert abs(o['c_thermo_temp/value'][0] - 1.44) < 1e-12
assert abs(o['f_g/value'][1:, :, 0] - o['c_g/value'][1:, :, 0]).max() < 1e-14 # middles of the bins, but for a mean's rounding
assert o['f_t/step'] == o['f_g/step']
END
for n in 0 1 2; do
    mkdir $n
    cd $n
    ranks $n ../run.in -log none >out || fail "$n ranks"
    "$python" ../look.py || fail "$n ranks: not what the text files say"
    cp averages.h5 whole.h5
    cp checkpoint.30.h5 first.h5 # the later ones of the next run replace it
    ranks $n resume first.h5 >out || fail "$n ranks: resume"
    "$python" ../look.py || fail "$n ranks: resumed"
    cd ..
done
for n in 1 2; do
    "$python" - 0/averages.h5 $n/averages.h5 <<END || fail "$n ranks: other numbers than without"
import h5py, sys
a, b = (h5py.File(name, 'r')['observables'] for name in sys.argv[1:])
for name in a: # reproducible runs: the same bits; one sample alone has NaN for its error
    assert (a[name + '/value'][2:] == b[name + '/value'][2:]).all(), name
END
done

# A file whose observables are others, or have another length, is not added to.
cat >add.in <<END
units lj
lattice fcc 0.8442
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 2.5
pair_coeff * * 1.0 1.0
reset_timestep 200
group none empty
compute g all rdf 13
dump a none h5md 10 0/averages.h5 c_g
dump_modify a append yes
run 0
END
"$HALFSHELL" add.in -log none >/dev/null 2>err && fail "another length was taken"
grep -q "observable 'c_g' has another length" err || fail "$(cat err)"
