/* A cutoff without forces: neighbors are known, nothing is felt. */
#include "base/memory.h"
#include "style/pair.h"

typedef struct zero_state {
    double cutoff_global;
    double *cutoff; /**< owned, by hs_pair_index */
} zero_state;

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    zero_state *zero = pair->state;
    HS_TRY(hs_arg_positive(args, 0, &zero->cutoff_global, err));
    if (zero->cutoff != NULL) return HS_OK;
    return HS_ALLOC(zero->cutoff, (size_t)((pair->n_types + 1) * (pair->n_types + 1)), err);
}

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    zero_state *zero = pair->state;
    double cutoff = zero->cutoff_global;
    if (args->n > 0) HS_TRY(hs_arg_not_negative(args, 0, &cutoff, err));
    zero->cutoff[hs_pair_index(pair, i, j)] = cutoff;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    zero_state *zero = pair->state;
    (void)err;
    zero->cutoff[hs_pair_index(pair, i, j)] = hs_pair_mix_distance(pair->mix, zero->cutoff[hs_pair_index(pair, i, i)],
                                                                   zero->cutoff[hs_pair_index(pair, j, j)]);
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    (void)p;
    *cutoff = ((zero_state *)pair->state)->cutoff[hs_pair_index(pair, i, j)];
}

static void destroy(hs_pair *pair) { HS_FREE(((zero_state *)pair->state)->cutoff); }

const hs_pair_style hs_pair_style_zero = {
    .about = {.name = "zero",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "a cutoff without forces",
              .details = "Pairs within the cutoff are searched, but exert no force and have no energy. "
                         "`pair_coeff I J [<cutoff>]`.",
              .example = "pair_style zero 2.5\npair_coeff * *"},
    .coeff_syntax = {.usage = "[<cutoff>]", .n_min = 0, .n_max = 1},
    .state_size = sizeof(zero_state),
    .settings = settings,
    .destroy = destroy,
    .coeff = coeff,
    .mix = mix,
    .params = params,
};
