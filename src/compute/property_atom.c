/* Attributes of atoms as values per atom. */
#include "style/atom_source.h"
#include "style/custom_atom.h"

typedef struct property_state {
    hs_atom_source *sources; /**< owned [n] */
    int n;
} property_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    property_state *state = compute->state;
    for (int i = 0, which; i < args->n; ++i) /* i_NAME and d_NAME, but no c_ID and the like */
        if (!hs_custom_atom_is_name(args->word[i])) HS_TRY(hs_arg_choice(args, i, hs_attributes, &which, err));
    HS_TRY(hs_atom_sources_read(&state->sources, &state->n, compute->env, args, 0, args->n, hs_attributes, err));
    compute->n_atom_columns = state->n == 1 ? 0 : state->n;
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    property_state *state = compute->state;
    hs_atom_sources_destroy(&state->sources, state->n);
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const property_state *state = compute->state;
    const size_t n_local = (size_t)compute->env->atoms->n_local;
    for (int k = 0; k < state->n; ++k)
        HS_TRY(hs_atom_source_values(compute->env, &state->sources[k], compute->mask,
                                     compute->atoms + (size_t)k * n_local, err));
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
