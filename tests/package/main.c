/* Two simulations in one process, through the installed header and library: prints their temperatures. */
#include <halfshell/halfshell.h>
#include <stdio.h>
#include <stdlib.h>

static const char melt[] = "units lj\n"
                           "lattice fcc 0.8442\n"
                           "region box block 0 4 0 4 0 4\n"
                           "create_box 1 box\n"
                           "create_atoms 1 box\n"
                           "mass 1 1.0\n"
                           "velocity all create ${T} 87287 loop geom\n"
                           "pair_style lj/cut 1.6\n"
                           "pair_coeff 1 1 1.0 1.0\n"
                           "fix 1 all nve\n";

static void need(const hs_simulation *simulation, hs_code code)
{
    if (code == HS_CODE_OK) return;
    fprintf(stderr, "%s\n", hs_simulation_error(simulation));
    exit((int)code);
}

int main(void)
{
    const char *const temperature[2] = {"1.5", "3"};
    hs_simulation *simulation[2];
    for (int i = 0; i < 2; ++i) {
        const hs_code code = hs_simulation_create(&simulation[i], NULL); /* first: arguments go in any order */
        need(simulation[i], code);
        need(simulation[i], hs_simulation_set_variable(simulation[i], "T", 1, &temperature[i]));
        need(simulation[i], hs_simulation_deck_text(simulation[i], melt));
    }
    for (int step = 0; step < 5; ++step)
        for (int i = 0; i < 2; ++i) need(simulation[i], hs_simulation_run(simulation[i], 2));
    for (int i = 0; i < 2; ++i) {
        double energy;
        need(simulation[i], hs_simulation_thermo(simulation[i], "etotal", &energy));
        printf("version %s atoms %lld step %lld etotal %.6g\n", hs_version(),
               (long long)hs_simulation_n_atoms(simulation[i]), (long long)hs_simulation_step(simulation[i]), energy);
        hs_simulation_destroy(&simulation[i]);
    }
    return 0;
}
