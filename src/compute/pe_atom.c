/* Potential energy of each atom: half of that of each of its pairs. */
#include <string.h>

#include "style/compute.h"
#include "style/pair_shares.h"

typedef struct pe_state {
    bool has_pair;
} pe_state;

static const hs_keyword keywords[] = {
    {"pair", 0, "", "energy of the pair style"},     {"bond", 0, "", "energy of bonds: 0, this version has none"},
    {"angle", 0, "", "energy of angles: 0"},         {"dihedral", 0, "", "energy of dihedrals: 0"},
    {"improper", 0, "", "energy of impropers: 0"},   {"kspace", 0, "", "long-range Coulomb energy: 0"},
    {"fix", 0, "", "energies per atom of fixes: 0"}, {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    pe_state *state = compute->state;
    (void)err;
    compute->may_need_energy = true;
    state->has_pair = args->n == 0;
    for (int i = 0; i < args->n; ++i) state->has_pair |= strcmp(args->word[i], "pair") == 0;
    if (state->has_pair) hs_pair_shares_want(compute->env->pair_shares, false);
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    if (((pe_state *)compute->state)->has_pair) hs_pair_shares_release(compute->env->pair_shares, false);
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const hs_atoms *atoms = compute->env->atoms;
    const double *energy = NULL, *virial;
    if (((pe_state *)compute->state)->has_pair) HS_TRY(hs_pair_shares_get(compute->env, false, &energy, &virial, err));
    for (int i = 0; i < atoms->n_local; ++i)
        compute->atoms[i] = energy != NULL && atoms->mask[i] & compute->mask ? energy[i] : 0.0;
    return HS_OK;
}

const hs_compute_style hs_compute_style_pe_atom = {
    .about =
        {.name = "pe/atom",
         .syntax =
             {.usage = "[pair bond angle dihedral improper kspace fix]", .n_min = 0, .n_max = 0, .keywords = keywords},
         .summary = "potential energy of each atom",
         .details =
             "The value per atom `c_ID` is half of the energy of each pair that the atom is part of (energy units); "
             "atoms outside the group have 0. Their sum is the energy of compute pe, but for the long-range "
             "correction of `pair_modify tail yes`. Without keywords everything counts; with keywords only the "
             "parts they name. The pairs are found once for all computes pe/atom and stress/atom of a step, "
             "which takes some timesteps' time.",
         .example = "compute u all pe/atom\ncompute sum all reduce sum c_u"},
    .state_size = sizeof(pe_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
};
