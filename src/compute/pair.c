/* Energy of the pair style, or of one of the styles that a hybrid one is made of. */
#include <string.h>

#include "base/memory.h"
#include "core/exact_sum.h"
#include "style/compute.h"
#include "style/pair_scan.h"

typedef struct pair_state {
    char *name;      /**< owned; of the pair style or part */
    int64_t number;  /**< which of the parts of that name, from 1; 0: the only one */
    bool is_coulomb; /**< ecoul: no style here has such a part */
    bool is_whole;
    int part; /**< number of the part */
} pair_state;

/** Parts of a hybrid style with the name; *last is the number-th of them, or the last. */
static int count_parts(const hs_pair *pair, const char *name, int64_t number, int *last)
{
    int n = 0;
    for (int k = 0; k < pair->n_parts; ++k) {
        if (strcmp(pair->part[k]->style->about.name, name) != 0) continue;
        if (++n <= number || number == 0) *last = k;
    }
    return n;
}

/** Find the style as it is now. */
static hs_status find(hs_compute *compute, hs_error *err)
{
    pair_state *state = compute->state;
    const hs_pair *pair = compute->env->pair(compute->env);
    const hs_who who = hs_compute_who(compute);
    if (pair == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no pair style yet; pair_style sets one", who.text);
    state->is_whole = strcmp(pair->style->about.name, state->name) == 0;
    if (state->is_whole && state->number <= 1) return HS_OK;
    const int n = pair->style->is_hybrid ? count_parts(pair, state->name, state->number, &state->part) : 0;
    if (n == 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the pair style is '%s'%s", who.text, pair->style->about.name,
                       pair->style->is_hybrid ? ", and it has no sub-style of that name" : "");
    if (n > 1 && state->number == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the pair style has %d sub-styles '%s': a number from 1 to %d says which", who.text, n,
                       state->name, n);
    if (state->number <= n) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the pair style has %d of '%s', and %lld is asked for", who.text, n,
                   state->name, (long long)state->number);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    static const char *const energies[] = {"epair", "evdwl", "ecoul", NULL};
    pair_state *state = compute->state;
    int next = 1, energy = 0;
    HS_TRY(hs_memory_strdup(&state->name, args->word[0], err));
    if (next < args->n && strspn(args->word[next], "0123456789") == strlen(args->word[next])) {
        HS_TRY(hs_arg_int(args, next, 1, INT32_MAX, &state->number, err));
        ++next;
    }
    if (next < args->n) HS_TRY(hs_arg_choice(args, next++, energies, &energy, err));
    if (next < args->n) return hs_arg_refuse(args, next, "expected after these words", NULL, err);
    state->is_coulomb = energy == 2;
    return find(compute, err);
}

static void destroy(hs_compute *compute) { HS_FREE(((pair_state *)compute->state)->name); }

typedef struct sum_context {
    const hs_pair_scan *scan;
    hs_pair_view view;
    int part;
    hs_exact_sum *sums; /**< owned [threads] */
} sum_context;

static void add_batch(void *context, int thread, const hs_pair_batch *batch)
{
    const sum_context *c = context;
    for (int p = 0; p < batch->n; ++p) {
        double force_over_r, energy;
        if (hs_pair_scan_eval_part(c->scan, &c->view, c->part, batch->i[p], batch->j[p], batch->r2[p], &force_over_r,
                                   &energy))
            hs_exact_add(&c->sums[thread], energy);
    }
}

/** Energy of one part: the forces' pairs, once more. */
static hs_status sum_part(hs_compute *compute, sum_context *context, double *value, hs_error *err)
{
    const hs_parallel *parallel = compute->env->parallel;
    hs_pair_scan scan = {0};
    HS_UNLESS_FAILED(err, HS_ALLOC(context->sums, (size_t)hs_threads_get(), err));
    HS_TRY(hs_parallel_agree(parallel, err));
    context->scan = &scan;
    const hs_status status = hs_pair_scan_begin_at_forces(&scan, compute->env, context->view.cutoff_max, err);
    if (status == HS_OK) {
        hs_pair_scan_visit(&scan, add_batch, context);
        for (int t = 1; t < hs_threads_get(); ++t) hs_exact_merge(&context->sums[0], &context->sums[t]);
        hs_exact_total(context->sums, 1, parallel, value);
    }
    hs_pair_scan_end(&scan);
    return status;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const pair_state *state = compute->state;
    sum_context context = {.part = state->part};
    *value = 0.0;
    if (state->is_coulomb) return HS_OK;
    if (state->is_whole) {
        *value = compute->env->pair_energy;
        return HS_OK;
    }
    compute->env->view_pairs(compute->env, &context.view);
    if (!(context.view.cutoff_max > 0.0)) return HS_OK;
    const hs_status status = sum_part(compute, &context, value, err);
    HS_FREE(context.sums);
    return status;
}

const hs_compute_style hs_compute_style_pair = {
    .about = {.name = "pair",
              .syntax = {.usage = "<pair style> [<number>] [epair|evdwl|ecoul]", .n_min = 1, .n_max = 3},
              .summary = "energy of the pair style, or of a sub-style of a hybrid one",
              .details = "The scalar `c_ID` is the energy of all pairs, without the long-range corrections of "
                         "`pair_modify tail`, that the pair style of this name has given at the present step; when "
                         "the pair style is hybrid, of its sub-style of this name, with a number where there are "
                         "several. `epair` (default) and `evdwl` are the same, `ecoul` is 0: there are no charges. The "
                         "group has no meaning. For a sub-style the pairs are found anew, which takes some timesteps' "
                         "time.",
              .example = "compute attraction all pair yukawa\ncompute second all pair lj/cut 2"},
    .state_size = sizeof(pair_state),
    .create = create,
    .destroy = destroy,
    .init = find,
    .scalar = scalar,
    .needs_energy = true,
    .is_extensive = true,
};
