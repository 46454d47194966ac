#!/bin/bash
# OpenMP may give fewer threads than are asked for (OMP_THREAD_LIMIT, OMP_DYNAMIC on a busy machine): no pair may be lost with them.
set -eu
unset OMP_NUM_THREADS OMP_DYNAMIC OMP_THREAD_LIMIT OMP_MAX_ACTIVE_LEVELS
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
cat >deck.in <<'DECK'
units lj
lattice fcc 0.8442
region b block 0 7 0 7 0 7
create_box 1 b
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
fix 1 all nve
compute r all rdf 50
fix r all ave/time 5 2 10 c_r[*] mode vector file rdf.dat
run 20
write_dump all custom end.dump id x y z modify sort id format float %.17g
DECK
for method in cluster verlet cell linked nsq; do
    "$HALFSHELL" deck.in -log none -neigh $method -threads 1 >out
    cat rdf.dat end.dump >wanted
    for setting in OMP_DYNAMIC=true OMP_THREAD_LIMIT=1 OMP_THREAD_LIMIT=2 OMP_MAX_ACTIVE_LEVELS=0; do
        env $setting "$HALFSHELL" deck.in -log none -neigh $method -threads 3 >out
        cat rdf.dat end.dump | cmp - wanted || { echo "$method: $setting changes the results"; exit 1; }
        case $setting in
        *LIMIT=*) grep -q "threads\?, not the 3 of -threads" out || { echo "$setting: nobody is told"; exit 1; } ;;
        esac
    done
done
# A small run on one thread leaves the threads of the environment to those that follow.
{ sed 's/0 7/0 3/g' deck.in; echo clear; cat deck.in; } >small_first.in
OMP_NUM_THREADS=2 "$HALFSHELL" small_first.in -log none >out
[ "$(grep -o '[0-9]* OpenMP threads' out | tr -dc '0-9\n' | xargs)" = "1 2" ] || { grep OpenMP out; exit 1; }
