/* Attributes of atoms as values per atom. */
#include "base/memory.h"
#include "style/attribute.h"
#include "style/compute.h"
#include "style/custom_atom.h"
#include "style/value.h"

typedef struct property_state {
    int *attribute;   /**< owned [n]; HS_ATTR_VARIABLE: the value */
    hs_value **value; /**< owned [n]; NULL: an attribute */
    int n;
} property_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    property_state *state = compute->state;
    HS_TRY(HS_ALLOC(state->attribute, (size_t)args->n, err));
    HS_TRY(HS_ALLOC(state->value, (size_t)args->n, err));
    for (; state->n < args->n; ++state->n) {
        if (hs_custom_atom_is_name(args->word[state->n])) {
            int n;
            state->attribute[state->n] = HS_ATTR_VARIABLE;
            HS_TRY(hs_values_create(&state->value[state->n], &n, compute->env, args, state->n, 1, HS_VALUE_ATOMS, err));
            continue;
        }
        HS_TRY(hs_arg_choice(args, state->n, hs_attributes, &state->attribute[state->n], err));
        if (state->attribute[state->n] == HS_ATTR_ELEMENT)
            return hs_arg_refuse(args, state->n, "a number of each atom; type is one", NULL, err);
        HS_TRY(hs_attribute_check((hs_attribute)state->attribute[state->n], compute->env->atoms, err));
    }
    compute->n_atom_columns = args->n == 1 ? 0 : args->n;
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    property_state *state = compute->state;
    for (int k = 0; k < state->n; ++k)
        if (state->value[k] != NULL) hs_values_destroy(&state->value[k], 1);
    HS_FREE(state->value);
    HS_FREE(state->attribute);
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const property_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const int n = atoms->n_local;
    for (int k = 0; k < state->n; ++k) {
        double *values = compute->atoms + (size_t)k * (size_t)n;
        const hs_attribute attribute = (hs_attribute)state->attribute[k];
        if (state->value[k] != NULL) {
            HS_TRY(hs_value_atoms(compute->env, state->value[k], values, err));
            for (int i = 0; i < n; ++i)
                if (!(atoms->mask[i] & compute->mask)) values[i] = 0.0;
            continue;
        }
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
             "`x y z` (distance), scaled `xs ys zs`, unwrapped `xu yu zu`, unwrapped and scaled `xsu ysu zsu`; images "
             "`ix iy iz`; velocities `vx vy vz` (distance/time); forces `fx fy fz` (energy/distance); dipoles `mux muy "
             "muz` and their length `mu` (atom_style dipole); `radius`, `diameter` (distance) and angular velocities "
             "`omegax omegay omegaz` (atom_style sphere); `i_<name>` and `d_<name>` of fix property/atom. With one "
             "attribute it is `c_ID`, with several `c_ID[1]` and so on. Atoms outside the group have 0.",
         .example = "compute p all property/atom xu yu zu"},
    .state_size = sizeof(property_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
};
