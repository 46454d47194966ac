/* Constant temperature: Nose-Hoover chains. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    return hs_nose_hoover_create(fix, args, true, false, err);
}

const hs_fix_style hs_fix_style_nvt = {
    .about = {.name = "nvt",
              .syntax = {.usage = "temp <Tstart> <Tstop> <Tdamp> [keyword value ...]",
                         .n_min = 0,
                         .n_max = 0,
                         .keywords = hs_nose_hoover_nvt_keywords},
              .summary = "integrate at constant temperature with Nose-Hoover chains",
              .details =
                  "Moves the atoms of the group, in the place of fix nve, and keeps their temperature by a chain of "
                  "thermostats: "
                  "averages are those of the canonical ensemble. `temp` gives the temperature at the start and at the "
                  "end of a run (or of `run start` to `stop`) and the time Tdamp in which it relaxes: some hundred "
                  "timesteps are usual; much less makes the temperature swing.\n\n"
                  "The fix makes the compute `ID_temp`, the temperature of its group; `fix_modify temp` takes another "
                  "one, of which only the thermal part of the velocities is scaled.\n\n"
                  "The scalar `f_ID` is the energy of the chain: it and the energy of the atoms together are constant "
                  "(`econserve` in thermo output). The vector has, for each of the N thermostats, their places "
                  "`f_ID[1]` ..., then their rates, then potential, then kinetic energies.",
              .reference = "G. J. Martyna, D. J. Tobias, M. L. Klein, J. Chem. Phys. 101, 4177 (1994), "
                           "doi:10.1063/1.467468; M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), "
                           "doi:10.1088/0305-4470/39/19/S18",
              .example = "fix 1 all nvt temp 1.0 1.0 0.5\nfix 2 beads nvt temp 300.0 350.0 100.0 tchain 5"},
    .state_size = sizeof(hs_nose_hoover),
    .create = create,
    .destroy = hs_nose_hoover_destroy,
    .init = hs_nose_hoover_init,
    .setup = hs_nose_hoover_setup,
    .initial_integrate = hs_nose_hoover_initial_integrate,
    .final_integrate = hs_nose_hoover_final_integrate,
    .keep_state = hs_nose_hoover_keep_state,
    .scalar = hs_nose_hoover_scalar,
    .vector = hs_nose_hoover_vector,
    .set_temperature = hs_nose_hoover_set_temperature,
    .is_extensive = true,
    .is_integrator = true,
    .is_coupling = true,
};
