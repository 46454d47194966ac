/* Forces as differences of energies: -(U(x + d) - U(x - d)) / (2 d), to compare those of the pair style with. */
#include <string.h>

#include "base/memory.h"
#include "style/fix.h"
#include "style/pair_scan.h"

typedef struct numdiff_state {
    int64_t every;
    double delta;  /**< distance */
    double *force; /**< owned [3 * n_local]: component k of atom i at k * n_local + i; energy/distance */
    size_t capacity;
    uint64_t found_at; /**< env->revision of these; 0: none */
} numdiff_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    numdiff_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_positive(args, 1, &state->delta, err));
    fix->n_atom_columns = 3;
    return HS_OK;
}

static void destroy(hs_fix *fix) { HS_FREE(((numdiff_state *)fix->state)->force); }

typedef struct difference {
    const hs_pair_scan *scan;
    hs_pair_view view;
    double delta;
} difference;

/** Force on atom i of each pair: its energy with the atom moved by delta either way. That of atom j is the opposite. */
static void share(void *context, const hs_pair_batch *batch, double (*values)[HS_PAIR_BATCH])
{
    const difference *c = context;
    const double delta = c->delta;
    for (int p = 0; p < batch->n; ++p)
        for (int axis = 0; axis < 3; ++axis) {
            const double step = 2.0 * delta * batch->dx[axis][p], r2 = batch->r2[p] + delta * delta;
            double unused, ahead, back;
            hs_pair_scan_eval(c->scan, &c->view, batch->i[p], batch->j[p], r2 - step, &unused, &ahead);
            hs_pair_scan_eval(c->scan, &c->view, batch->i[p], batch->j[p], r2 + step, &unused, &back);
            values[axis][p] = -(ahead - back) / (2.0 * delta);
        }
}

static hs_status find_forces(hs_fix *fix, hs_error *err)
{
    numdiff_state *state = fix->state;
    hs_env *env = fix->env;
    const size_t n = 3 * (size_t)env->atoms->n_local;
    hs_pair_scan scan = {0};
    difference context = {.scan = &scan, .delta = state->delta};
    HS_TRY(HS_RESERVE(state->force, state->capacity, n, err));
    if (n > 0) memset(state->force, 0, n * sizeof *state->force);
    env->view_pairs(env, &context.view);
    if (context.view.pair == NULL) return HS_OK;
    const hs_pair_sharing sharing = {.n = 3, .is_odd = true, .share = share, .context = &context};
    hs_status status = hs_pair_scan_begin_at_forces(&scan, env, context.view.cutoff_max + state->delta, err);
    if (status == HS_OK) status = hs_pair_scan_share(&scan, env, &sharing, state->force, err);
    hs_pair_scan_end(&scan);
    return status;
}

static hs_status per_atom(hs_fix *fix, int column, double *values, hs_error *err)
{
    numdiff_state *state = fix->state;
    const hs_env *env = fix->env;
    const size_t n = (size_t)env->atoms->n_local;
    if (env->step % state->every != 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there are forces at multiples of %lld steps, and step %lld is none",
                       hs_fix_who(fix).text, (long long)state->every, (long long)env->step);
    if (state->found_at != env->revision) {
        HS_TRY(find_forces(fix, err));
        state->found_at = env->revision;
    }
    for (size_t i = 0; i < n; ++i)
        values[i] = env->atoms->mask[i] & fix->mask ? state->force[(size_t)column * n + i] : 0.0;
    return HS_OK;
}

const hs_fix_style hs_fix_style_numdiff = {
    .about =
        {.name = "numdiff",
         .syntax = {.usage = "<N> <delta>", .n_min = 2, .n_max = 2},
         .summary = "forces as differences of energies",
         .details =
             "The values per atom `f_ID[1]`, `f_ID[2]`, `f_ID[3]` are the forces that the pair style's energy gives: "
             "minus its change, as the atom is moved by delta (distance units) forward and back along an axis, over 2 "
             "delta. Compared with fx, fy and fz they show whether a potential's forces are those of its energy. They "
             "are there at multiples of N steps, for atoms of the group; others have 0. What fixes add to forces is "
             "not in them.\n\n"
             "delta should be some 1e-4 to 1e-5 of the distance of atoms: smaller ones leave rounding errors of the "
             "energy over delta, larger ones errors of the order of delta^2. Where the energy jumps at the cutoff "
             "(`pair_modify shift no`) a pair that delta takes across it shows as a force of the jump over 2 delta.",
         .example = "fix n all numdiff 100 1e-5\nvariable d atom abs(f_n[1]-fx)\ncompute d all reduce max v_d"},
    .state_size = sizeof(numdiff_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
};
