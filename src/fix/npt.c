/* Constant temperature and pressure: Nose-Hoover chains and the barostat of Martyna, Tobias and Klein. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    return hs_nose_hoover_create(fix, args, true, true, err);
}

const hs_fix_style hs_fix_style_npt = {
    .about =
        {.name = "npt",
         .syntax = {.usage =
                        "temp <Tstart> <Tstop> <Tdamp> <iso|aniso|x|y|z> <Pstart> <Pstop> <Pdamp> [keyword value ...]",
                    .n_min = 0,
                    .n_max = 0,
                    .keywords = hs_nose_hoover_npt_keywords},
         .summary = "integrate at constant temperature and pressure",
         .details =
             "Moves the atoms of the group, in the place of fix nve, keeps their temperature by a chain of thermostats "
             "(see fix nvt) and the pressure by changing the lengths of the box.\n\n"
             "`iso` changes all lengths of the box alike, by the scalar pressure; `aniso` (one target) and `x`, `y`, "
             "`z` (each "
             "its own, and only those axes) let them change on their own; `couple` gives some of those the mean of "
             "their "
             "pressures. The box must be periodic along axes that change. Pdamp is the time in which the pressure "
             "relaxes, usually some thousand timesteps. Atoms of the group `dilate` follow the box as their fractions "
             "of it, around `fixedpoint`.\n\n"
             "Where targets are unequal, the stress that the difference does work against refers to the box at the "
             "start "
             "(Parrinello and Rahman), or to that of the last `nreset`. `mtk no` leaves out two terms of order 1/N. "
             "Tilted "
             "boxes are not supported.\n\n"
             "The fix makes the computes `ID_temp` and `ID_press`, both of all atoms; `fix_modify temp` and `press` "
             "take "
             "others. Energies and virials are computed at every step, which costs some speed.\n\n"
             "The scalar `f_ID` is the energy given to thermostat and barostat: with that of the atoms it is constant "
             "(`econserve` in thermo output). The vector `f_ID[i]` has, in this order: places and rates of the "
             "thermostats (npt), strains and strain rates (one with one pressure for all axes, else three), places and "
             "rates of "
             "the barostat's thermostats; then, in the same order, the potential and kinetic energies of all these, "
             "and with x, y or z the "
             "strain energy.",
         .reference = "G. J. Martyna, D. J. Tobias, M. L. Klein, J. Chem. Phys. 101, 4177 (1994), "
                      "doi:10.1063/1.467468; M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), "
                      "doi:10.1088/0305-4470/39/19/S18",
         .example = "fix 1 all npt temp 1.0 1.0 0.5 iso 0.0 0.0 5.0\nfix 2 all npt temp 300 300 100 x 1.0 1.0 1000 y "
                    "1.0 1.0 1000 couple xy"},
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
    .set_pressure = hs_nose_hoover_set_pressure,
    .needs_energy = hs_nose_hoover_needs_energy,
    .is_extensive = true,
    .is_integrator = true,
    .is_coupling = true,
    .changes_box = true,
};
