/* Potential energy of all atoms. */
#include <string.h>

#include "style/compute.h"

typedef struct pe_state {
    bool has_pair, has_fix; /**< which energies count: all without keywords */
} pe_state;

static const hs_keyword keywords[] = {
    {"pair", 0, "", "energy of the pair style, with its long-range correction"},
    {"bond", 0, "", "energy of bonds: 0, this version has none"},
    {"angle", 0, "", "energy of angles: 0"},
    {"dihedral", 0, "", "energy of dihedrals: 0"},
    {"improper", 0, "", "energy of impropers: 0"},
    {"kspace", 0, "", "long-range Coulomb energy: 0"},
    {"fix", 0, "", "energy of the fixes that `fix_modify energy yes` was said for"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    pe_state *state = compute->state;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    if (compute->group != 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the group must be all: the energy of a pair belongs to no single group", args->command);
    state->has_pair = state->has_fix = args->n == 0;
    for (int i = 0; i < args->n; ++i) {
        state->has_pair |= strcmp(args->word[i], "pair") == 0;
        state->has_fix |= strcmp(args->word[i], "fix") == 0;
    }
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const pe_state *state = compute->state;
    const hs_env *env = compute->env;
    (void)err;
    *value = state->has_pair ? env->pair_energy + env->tail_energy : 0.0;
    if (state->has_fix) *value += env->fix_energy;
    return HS_OK;
}

const hs_compute_style hs_compute_style_pe = {
    .about = {.name = "pe",
              .syntax = {.usage = "[pair bond angle dihedral improper kspace fix]",
                         .n_min = 0,
                         .n_max = 0,
                         .keywords = keywords},
              .summary = "potential energy",
              .details =
                  "The scalar `c_ID` is the potential energy of all atoms (energy units), with the long-range "
                  "correction of `pair_modify tail yes`. Without keywords everything counts; with keywords only the "
                  "parts they name. The group must be all. It grows with the number of atoms: under `thermo_modify "
                  "norm yes` thermo output divides it by the number of atoms. Every simulation has one of these, "
                  "`thermo_pe`.",
              .example = "compute u all pe"},
    .state_size = sizeof(pe_state),
    .create = create,
    .scalar = scalar,
    .needs_energy = true,
    .is_extensive = true,
};
