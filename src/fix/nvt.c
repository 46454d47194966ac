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
                  "thermostats: averages are those of the canonical ensemble. `temp` gives the temperature at the "
                  "start and at the end of a run (or of `run start` to `stop`) and the time Tdamp in which it relaxes: "
                  "some hundred timesteps are usual; much less makes the temperature swing.\n\n"
                  "The fix makes the compute `ID_temp`, the temperature of its group; `fix_modify temp` takes another "
                  "one, of which only the thermal part of the velocities is scaled.\n\n"
                  "The scalar `f_ID` is the energy of the chain: it and the energy of the atoms together are constant "
                  "(`econserve` in thermo output). The vector has, for each of the N thermostats, their places "
                  "`f_ID[1]` ..., then their rates, then potential, then kinetic energies.",
              .reference = HS_NOSE_HOOVER_REFERENCE,
              .example = "fix 1 all nvt temp 1.0 1.0 0.5\nfix 2 beads nvt temp 300.0 350.0 100.0 tchain 5"},
    HS_NOSE_HOOVER_HOOKS,
    .init = hs_nose_hoover_init,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
