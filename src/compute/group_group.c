/* Energy and force between two groups of atoms. */
#include <string.h>

#include "base/memory.h"
#include "core/exact_sum.h"
#include "style/compute.h"
#include "style/pair_scan.h"

enum { N_SUMS = 4 }; /* energy, force along x, y, z */

typedef struct group_state {
    uint32_t other; /**< bit of the second group */
    bool has_pair;
    double value[N_SUMS];
    uint64_t value_at; /**< env->revision of value[]; 0: none */
} group_state;

static const hs_keyword keywords[] = {
    {"pair", 1, "yes|no", "count what the pair style does (default: yes)"},
    {"kspace", 1, "no", "there is no long-range solver that could be counted (default: no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    static const char *const only_no[] = {"no", NULL};
    group_state *state = compute->state;
    int group, choice;
    HS_TRY(hs_groups_get(compute->env->groups, args->word[0], &group, err));
    state->other = compute->other_groups = hs_group_mask(group);
    state->has_pair = true;
    for (int i = 1; i < args->n; i += 2) {
        if (strcmp(args->word[i], "pair") == 0)
            HS_TRY(hs_arg_bool(args, i + 1, &state->has_pair, err));
        else
            HS_TRY(hs_arg_choice(args, i + 1, only_no, &choice, err));
    }
    compute->may_need_energy = true;
    compute->n_vector = 3;
    return HS_ALLOC(compute->vector, 3, err);
}

static void destroy(hs_compute *compute) { HS_FREE(compute->vector); }

typedef struct sum_context {
    const hs_compute *compute;
    const hs_pair_scan *scan;
    hs_pair_view view;
    hs_exact_sum (*sums)[N_SUMS]; /**< [threads] */
} sum_context;

static void add_batch(void *context, int thread, const hs_pair_batch *batch)
{
    const sum_context *c = context;
    const uint32_t one = c->compute->mask, other = ((const group_state *)c->compute->state)->other;
    hs_exact_sum *sums = c->sums[thread];
    for (int p = 0; p < batch->n; ++p) {
        const uint32_t mask_i = c->scan->mask[batch->i[p]], mask_j = c->scan->mask[batch->j[p]];
        const bool is_first = mask_i & one && mask_j & other, is_second = mask_j & one && mask_i & other;
        double force_over_r, energy;
        if (!is_first && !is_second) continue;
        hs_pair_scan_eval(c->scan, &c->view, batch->i[p], batch->j[p], batch->r2[p], &force_over_r, &energy);
        hs_exact_add(&sums[0], energy);
        if (is_first == is_second) continue; /* both atoms are in both groups: their forces cancel */
        for (int axis = 0; axis < 3; ++axis)
            hs_exact_add(&sums[1 + axis], force_over_r * (is_first ? -batch->dx[axis][p] : batch->dx[axis][p]));
    }
}

static hs_status sum_pairs(hs_compute *compute, sum_context *context, hs_error *err)
{
    group_state *state = compute->state;
    const hs_env *env = compute->env;
    const int n_threads = hs_threads_get();
    hs_pair_scan scan = {0};
    const hs_status status = HS_ALLOC(context->sums, (size_t)n_threads, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    context->scan = &scan;
    const hs_status begun = hs_pair_scan_begin_at_forces(&scan, compute->env, context->view.cutoff_max, err);
    if (begun == HS_OK) {
        hs_pair_scan_visit(&scan, add_batch, context);
        for (int t = 1; t < n_threads; ++t)
            for (int k = 0; k < N_SUMS; ++k) hs_exact_merge(&context->sums[0][k], &context->sums[t][k]);
        hs_exact_total(context->sums[0], N_SUMS, env->parallel, state->value);
    }
    hs_pair_scan_end(&scan);
    return begun;
}

static hs_status evaluate(hs_compute *compute, hs_error *err)
{
    group_state *state = compute->state;
    sum_context context = {.compute = compute};
    hs_status status = HS_OK;
    if (state->value_at == compute->env->revision) return HS_OK;
    memset(state->value, 0, sizeof state->value);
    compute->env->view_pairs(compute->env, &context.view);
    if (state->has_pair && context.view.pair != NULL && context.view.cutoff_max > 0.0)
        status = sum_pairs(compute, &context, err);
    HS_FREE(context.sums);
    if (status == HS_OK) state->value_at = compute->env->revision;
    return status;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(evaluate(compute, err));
    *value = ((const group_state *)compute->state)->value[0];
    return HS_OK;
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    HS_TRY(evaluate(compute, err));
    memcpy(compute->vector, ((const group_state *)compute->state)->value + 1, 3 * sizeof(double));
    return HS_OK;
}

const hs_compute_style hs_compute_style_group_group = {
    .about = {.name = "group/group",
              .syntax =
                  {.usage = "<other group-ID> [pair yes|no] [kspace no]", .n_min = 1, .n_max = 1, .keywords = keywords},
              .summary = "energy and force between two groups",
              .details = "The scalar `c_ID` is the energy of all pairs with one atom in the compute's group and one in "
                         "the other group (energy), the vector `c_ID[1]` ... `c_ID[3]` the sum of the forces that "
                         "atoms of the other group exert on atoms of the compute's group. A pair whose atoms are both "
                         "in both groups counts once in the energy, and its forces cancel; so a group with itself has "
                         "its inner energy. Long-range corrections (pair_modify tail) are left out. The pairs are "
                         "found anew for each evaluation, which takes some timesteps' time.",
              .example = "compute pull solute group/group solvent\nthermo_style custom step temp c_pull c_pull[1]"},
    .state_size = sizeof(group_state),
    .create = create,
    .destroy = destroy,
    .scalar = scalar,
    .vector = vector,
    .is_extensive = true,
    .is_vector_extensive = true,
};
