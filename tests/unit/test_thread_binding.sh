#!/bin/bash
# Threads that OMP_PROC_BIND binds get a core each: the program starts itself anew, and must not hand its own binding on.
set -eu
unset GOMP_SPINCOUNT OMP_WAIT_POLICY OMP_PLACES OMP_NUM_THREADS
allowed=$(nproc)
[ "$allowed" -ge 2 ] || { echo "one core only: nothing to tell apart"; exit 0; }
[ -d /sys/devices/system/cpu ] || { echo "no /sys, where OpenMP finds the cores"; exit 0; }
cd "$(mktemp -d)"
trap 'kill -KILL "$pid"; wait "$pid" || true; rm -rf "$PWD"' EXIT
cat >deck.in <<'DECK'
units lj
lattice fcc 0.8442
region b block 0 6 0 6 0 6
create_box 1 b
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
fix 1 all nve
run 100000000
DECK
OMP_PROC_BIND=true "$HALFSHELL" deck.in -threads 2 -log none >out 2>&1 &
pid=$!
cores() { cat /proc/"$pid"/task/*/status | sed -n 's/^Cpus_allowed_list:\s*//p' | sort; }
# Until its threads are there: two of them, each bound to one core.
for _ in $(seq 300); do
    kill -0 "$pid" || { cat out; exit 1; }
    [ "$(cores | grep -c '^[0-9]*$')" -ge 2 ] && break
    sleep 0.1
done
[ "$(cores | grep '^[0-9]*$' | uniq | wc -l)" -ge 2 ] || { echo "threads are bound to the cores"; cores; exit 1; }
