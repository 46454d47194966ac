/* Weak coupling to a bath: at each step the temperature moves towards the wanted one as if it decayed to it in the
 * damping time,
 *     T' = T + (dt/Tdamp) (T_wanted - T).
 * Source: H. J. C. Berendsen et al., J. Chem. Phys. 81, 3684 (1984), doi:10.1063/1.448118, eq. (11). */
#include "fix/velocity_scaling.h"

typedef struct berendsen_state {
    velocity_scaling scaling; /* first: velocity_scaling.h takes the state as one */
    double damping;           /**< time */
} berendsen_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_arg_positive(args, 2, &((berendsen_state *)fix->state)->damping, err));
    return scaling_create(fix, args, 0, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const double damping = ((const berendsen_state *)fix->state)->damping;
    hs_compute *temperature;
    double wanted, measured;
    HS_TRY(scaling_measure(fix, &temperature, &wanted, &measured, err));
    if (measured == 0.0) return HS_OK;
    const double next = measured + fix->env->dt / damping * (wanted - measured);
    if (!(next >= 0.0))
        return hs_fail(err, HS_ERROR_RUN,
                       "%s: the damping time %g is too short for the timestep %g: the temperature would become %g",
                       hs_fix_who(fix).text, damping, fix->env->dt, next);
    scaling_apply(fix, temperature, measured, next);
    return HS_OK;
}

const hs_fix_style hs_fix_style_temp_berendsen = {
    .about = {.name = "temp/berendsen",
              .syntax = {.usage = "<Tstart> <Tstop> <Tdamp>", .n_min = 3, .n_max = 3},
              .summary = "Berendsen's thermostat: let the temperature decay to a wanted one",
              .details = "At every step the velocities of the group are scaled so that the temperature comes nearer to "
                         "the wanted one by the fraction dt/Tdamp of the difference; Tdamp is a time. " SCALING_DETAILS,
              .reference = "H. J. C. Berendsen, J. P. M. Postma, W. F. van Gunsteren, A. DiNola, J. R. Haak, J. Chem. "
                           "Phys. 81, 3684 (1984), doi:10.1063/1.448118",
              .example = "fix 1 all nve\nfix 2 all temp/berendsen 1.0 1.5 0.5"},
    .state_size = sizeof(berendsen_state),
    .create = create,
    .end_of_step = end_of_step,
    SCALING_HOOKS,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
