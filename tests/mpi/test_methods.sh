#!/bin/bash
# All neighbor methods, threads and ranks together: the same thermo table as on one rank with the default method, to the
# rounding of a dozen steps.
set -eu
# shellcheck source=tests/mpi/ranks.sh
. "$PROJECT_ROOT/tests/mpi/ranks.sh"
liquids

compare melt "2 3" -threads 2
for method in nsq linked incremental hash cell verlet; do compare melt 4 -neigh "$method"; done
compare mixture 3 -neigh cell -threads 2
compare mixture 2 -neigh hash
compare plane 2 -neigh cell
compare plane 3 -neigh linked
compare wrapped 4 -neigh cell
compare wrapped 3 -neigh incremental
compare thin 6 -neigh nsq
compare thin 5 -neigh verlet

# Mixed precision beside double: forces with errors of 7e-7, and a dozen steps.
# shellcheck disable=SC2034
tolerance=2e-5
for method in cluster cell verlet; do compare mixture 3 -neigh "$method" -precision mixed; done
compare melt 2 -neigh cluster -precision mixed -threads 2
