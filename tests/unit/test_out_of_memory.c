/* Memory that runs out at any allocation of a run: an error, after which the simulation can be run. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <halfshell/halfshell.h>
#include <stdlib.h>

#include "support/harness.h"

#ifndef __SANITIZE_ADDRESS__        /* it has its own */
static long n_allocations, failing; /**< failing: the allocation that is refused, 0: none */

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    static int (*real)(void **, size_t, size_t);
    if (real == NULL) *(void **)&real = dlsym(RTLD_NEXT, "posix_memalign");
    if (failing > 0 && ++n_allocations == failing) return ENOMEM;
    return real(memory, alignment, size);
}
#else
static long n_allocations, failing;
#endif

static const char deck[] =
    "units lj\nlattice fcc 0.8442\nregion b block 0 3 0 3 0 3\ncreate_box 1 b\ncreate_atoms 1 box\n"
    "mass * 1.0\nvelocity all create 1.0 87287\npair_style lj/cut 2.5\npair_coeff * * 1.0 1.0\n"
    "fix 1 all nve\nfix 2 all ave/time 1 1 1 c_thermo_temp\n";

START_TEST(test_every_allocation)
{
    const char *const methods[] = {"cluster", "verlet", "cell", "linked", "hash", "nsq"};
    long k = 0;
    hs_code code = HS_CODE_FAILED;
    while (code != HS_CODE_OK) {
        hs_simulation_options options = HS_SIMULATION_OPTIONS_INIT;
        hs_simulation *simulation;
        options.n_threads = 1;
        options.neighbor_method = methods[_i];
        ck_assert_int_eq(hs_simulation_create(&simulation, &options), HS_CODE_OK);
        ck_assert_int_eq(hs_simulation_deck_text(simulation, deck), HS_CODE_OK);
        n_allocations = 0;
        failing = ++k;
        code = hs_simulation_run(simulation, 12);
        failing = 0;
        ck_assert_msg(code == HS_CODE_OK || code == HS_CODE_FAILED, "%ld: %s", k, hs_simulation_error(simulation));
        const hs_code again = hs_simulation_run(simulation, 12);
        ck_assert_msg(again == HS_CODE_OK, "%ld: %s", k, hs_simulation_error(simulation));
        hs_simulation_destroy(&simulation);
    }
}
END_TEST

HS_LOOP_TEST_MAIN("out_of_memory", {test_every_allocation, 6})
