/* Potential energy of each atom: half of that of each of its pairs. */
#include <string.h>

#include "style/compute.h"
#include "style/pair_scan.h"

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
    return HS_OK;
}

typedef struct energy_context {
    const hs_pair_scan *scan;
    hs_pair_view view;
} energy_context;

static void share(void *context, const hs_pair_batch *batch, double (*values)[HS_PAIR_BATCH])
{
    const energy_context *c = context;
    for (int p = 0; p < batch->n; ++p) {
        double force_over_r, energy;
        hs_pair_scan_eval(c->scan, &c->view, batch->i[p], batch->j[p], batch->r2[p], &force_over_r, &energy);
        values[0][p] = 0.5 * energy;
    }
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    hs_env *env = compute->env;
    const int n = env->atoms->n_local;
    hs_pair_scan scan = {0};
    energy_context context = {.scan = &scan};
    memset(compute->atoms, 0, (size_t)n * sizeof *compute->atoms);
    env->view_pairs(env, &context.view);
    if (context.view.pair == NULL || !((pe_state *)compute->state)->has_pair) return HS_OK;
    hs_status status = hs_pair_scan_begin_at_forces(&scan, env, context.view.cutoff_max, err);
    if (status == HS_OK) status = hs_pair_scan_share(&scan, env, 1, false, share, &context, compute->atoms, err);
    hs_pair_scan_end(&scan);
    for (int i = 0; i < n; ++i)
        if (!(env->atoms->mask[i] & compute->mask)) compute->atoms[i] = 0.0;
    return status;
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
             "parts they name. The pairs are found anew for each evaluation, which takes some timesteps' time.",
         .example = "compute u all pe/atom\ncompute sum all reduce sum c_u"},
    .state_size = sizeof(pe_state),
    .create = create,
    .per_atom = per_atom,
};
