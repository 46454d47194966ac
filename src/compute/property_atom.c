/* Attributes of atoms as values per atom. */
#include "base/memory.h"
#include "style/attribute.h"
#include "style/compute.h"

typedef struct property_state {
    int *attribute; /**< owned [n] */
    int n;
} property_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    property_state *state = compute->state;
    HS_TRY(HS_ALLOC(state->attribute, (size_t)args->n, err));
    for (; state->n < args->n; ++state->n) {
        HS_TRY(hs_arg_choice(args, state->n, hs_attributes, &state->attribute[state->n], err));
        if (state->attribute[state->n] == HS_ATTR_ELEMENT)
            return hs_arg_refuse(args, state->n, "a number of each atom; type is one", NULL, err);
        HS_TRY(hs_attribute_check((hs_attribute)state->attribute[state->n], compute->env->atoms, err));
    }
    compute->n_atom_columns = args->n == 1 ? 0 : args->n;
    return HS_OK;
}

static void destroy(hs_compute *compute) { HS_FREE(((property_state *)compute->state)->attribute); }

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const property_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const int n = atoms->n_local;
    (void)err;
    for (int k = 0; k < state->n; ++k) {
        double *values = compute->atoms + (size_t)k * (size_t)n;
        const hs_attribute attribute = (hs_attribute)state->attribute[k];
#pragma omp parallel for schedule(static)
        for (int i = 0; i < n; ++i)
            values[i] = atoms->mask[i] & compute->mask ? hs_attribute_value(compute->env, attribute, false, i) : 0.0;
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_property_atom = {
    .about =
        {.name = "property/atom",
         .syntax = {.usage = "<attribute> ...", .n_min = 1, .n_max = -1},
         .summary = "attributes of atoms as values per atom",
         .details =
             "The values per atom are the attributes of the atoms: `id`, `type`, `mass`, `proc`, `procp1`; positions "
             "`x y z` (distance), scaled `xs ys zs`, unwrapped `xu yu zu`, unwrapped and scaled `xsu ysu zsu`; "
             "images `ix iy iz`; velocities `vx vy vz` (distance/time); forces `fx fy fz` (energy/distance); dipoles "
             "`mux muy muz` and their length `mu` (atom_style dipole); `radius`, `diameter` (distance) and angular "
             "velocities `omegax omegay omegaz` (atom_style sphere). With one "
             "attribute it is `c_ID`, with several `c_ID[1]` and so on. Atoms outside the group have 0.",
         .example = "compute p all property/atom xu yu zu"},
    .state_size = sizeof(property_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
};
