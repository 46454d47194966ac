/* Coordination number of each atom: neighbors within a distance. */
#include <string.h>

#include "base/memory.h"
#include "style/compute.h"
#include "style/pair_scan.h"

typedef struct coord_state {
    double cutoff;
    int group;       /**< of the neighbors */
    int (*range)[2]; /**< owned [n]: types of the neighbors that a column counts */
    int n;
} coord_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    static const char *const modes[] = {"cutoff", NULL};
    coord_state *state = compute->state;
    int mode, first = 2;
    HS_TRY(hs_arg_choice(args, 0, modes, &mode, err));
    HS_TRY(hs_arg_positive(args, 1, &state->cutoff, err));
    if (args->n > 2 && strcmp(args->word[2], "group") == 0) {
        HS_TRY(hs_arg_need(args, 3, "the neighbors' group", err));
        HS_TRY(hs_groups_get(compute->env->groups, args->word[3], &state->group, err));
        compute->other_groups = hs_group_mask(state->group);
        first = 4;
    }
    const int n_types = compute->env->atoms->n_types, n = args->n - first;
    HS_TRY(HS_ALLOC(state->range, (size_t)(n > 0 ? n : 1), err));
    for (state->n = 0; state->n < n; ++state->n)
        HS_TRY(
            hs_arg_range(args, first + state->n, n_types, &state->range[state->n][0], &state->range[state->n][1], err));
    if (n == 0) state->range[state->n++][1] = INT32_MAX;
    compute->n_atom_columns = state->n > 1 ? state->n : 0;
    return HS_OK;
}

static void destroy(hs_compute *compute) { HS_FREE(((coord_state *)compute->state)->range); }

typedef struct count_context {
    hs_pair_scan *scan;
    const coord_state *state;
    uint32_t mask;
    int first; /**< column */
} count_context;

static bool is_counted(const count_context *c, int column, int j)
{
    const int type = hs_pair_scan_type(c->scan, j);
    return c->scan->mask[j] & c->mask && type >= c->state->range[column][0] && type <= c->state->range[column][1];
}

static void count(void *context, int thread, const hs_pair_batch *batch)
{
    const count_context *c = context;
    (void)thread;
    for (int k = 0; k < 3 && c->first + k < c->state->n; ++k) {
        double *n = c->scan->atoms.f[k];
        for (int p = 0; p < batch->n; ++p) {
            const int i = batch->i[p], j = batch->j[p];
            n[i] += is_counted(c, c->first + k, j);
            n[j] += is_counted(c, c->first + k, i);
        }
    }
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const coord_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const size_t n = (size_t)atoms->n_local;
    hs_pair_scan scan = {0};
    count_context context = {.scan = &scan, .state = state, .mask = hs_group_mask(state->group)};
    hs_status status = hs_pair_scan_begin(&scan, compute->env, state->cutoff, err);
    for (; context.first < state->n && status == HS_OK; context.first += 3) {
        for (int k = 0; k < 3; ++k) memset(scan.atoms.f[k], 0, (size_t)scan.n_all * sizeof(double));
        hs_pair_scan_visit(&scan, count, &context);
        hs_pair_scan_reverse(&scan);
        for (int k = 0; k < 3 && context.first + k < state->n; ++k)
            for (size_t i = 0; i < n; ++i)
                compute->atoms[(size_t)(context.first + k) * n + i] =
                    atoms->mask[i] & compute->mask ? scan.atoms.f[k][i] : 0.0;
    }
    hs_pair_scan_end(&scan);
    return status;
}

const hs_compute_style hs_compute_style_coord_atom = {
    .about = {.name = "coord/atom",
              .syntax = {.usage = "cutoff <distance> [group <group-ID>] [<types> ...]", .n_min = 2, .n_max = -1},
              .summary = "number of neighbors of each atom",
              .details = "The value per atom is the number of atoms closer than the distance; of those of a group only "
                         "with `group`. Types are single ones or ranges as in pair_coeff (`2*4`); with several, "
                         "`c_ID[1]` and so on count the neighbors of each. Any distance will do: pairs are found anew "
                         "for each evaluation. Atoms outside the compute's group have 0.",
              .example = "compute n all coord/atom cutoff 1.5\ncompute nn all coord/atom cutoff 1.5 1 2"},
    .state_size = sizeof(coord_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
};
