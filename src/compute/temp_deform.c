/* Temperature of a fluid that flows with a box which changes: without the velocity of the place where each atom is.
 * Source: D. J. Evans, G. P. Morriss, Phys. Rev. A 30, 1528 (1984), doi:10.1103/PhysRevA.30.1528. */
#include "style/box_flow.h"
#include "style/temperature.h"

typedef struct deform_temperature {
    hs_temperature temperature;
    hs_box_flow_map map;
    uint64_t map_at; /**< revision of the map; 0: none */
} deform_temperature;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    return hs_temperature_create(compute, HS_ALL_AXES, err);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    const hs_box_flow *flow = compute->env->box_flow;
    if (flow == NULL)
        hs_warn(compute->env->out, "%s: no fix deform changes the box, so nothing is taken off",
                hs_compute_who(compute).text);
    else if (flow->moves_places != 0)
        hs_warn(compute->env->out,
                "%s: fix deform moves the atoms with the box (remap x), which gives them no velocity that could be "
                "taken off; 'remap v' or 'none' is right with this temperature",
                hs_compute_who(compute).text);
    return hs_temperature_init(compute, err);
}

/** Keep the map of this revision: one for all atoms. */
static void look_at_flow(const hs_compute *compute)
{
    deform_temperature *state = compute->state;
    state->map = hs_box_flow_now(compute->env);
    state->map_at = compute->env->revision;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    look_at_flow(compute);
    return hs_temperature_scalar(compute, value, err);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    look_at_flow(compute);
    return hs_temperature_vector(compute, err);
}

static void bias(const hs_compute *compute, int i, double v[3])
{
    const deform_temperature *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const double x = atoms->x[0][i], y = atoms->x[1][i], z = atoms->x[2][i];
    if (state->map_at == compute->env->revision) {
        hs_box_flow_at(&state->map, x, y, z, v);
        return;
    }
    const hs_box_flow_map map = hs_box_flow_now(compute->env);
    hs_box_flow_at(&map, x, y, z, v);
}

const hs_compute_style hs_compute_style_temp_deform = {
    .about = {.name = "temp/deform",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0, .keywords = NULL},
              .summary = "temperature without the velocity of a box that changes",
              .details = "In a box that fix deform shears or stretches, each place moves with the box: at the lower "
                         "face of y with the velocity of that face, at the upper one with that of the other, between "
                         "them linearly. This velocity is taken off that of the atom there. The scalar `c_ID` is the "
                         "temperature of what is left, with dim N - dim degrees of freedom; the vector is its "
                         "kinetic-energy tensor as in compute temp. Thermostats that use this temperature (`fix_modify "
                         "... temp ID`) leave the flow as it is; `fix nvt/sllod` makes one of its own.\n\n"
                         "It is right when the atoms do flow with the box. compute temp/profile, which measures the "
                         "profile, tells whether they do.",
              .reference = "D. J. Evans, G. P. Morriss, Phys. Rev. A 30, 1528 (1984), doi:10.1103/PhysRevA.30.1528",
              .example = "fix 2 all deform 1 xy erate 0.1 remap v\ncompute t all temp/deform\nthermo_modify temp t"},
    .state_size = sizeof(deform_temperature),
    .create = create,
    .destroy = hs_temperature_destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .modify = hs_temperature_modify,
    .bias = bias,
    .is_vector_extensive = true,
    .is_temperature = true,
};
