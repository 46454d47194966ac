#include "style/pair_shares.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/pair_scan.h"

enum { N_ENERGIES = 1, N_ALL = 7 };

void hs_pair_shares_want(hs_pair_shares *shares, bool virial)
{
    ++*(virial ? &shares->n_virial_users : &shares->n_energy_users);
}

void hs_pair_shares_release(hs_pair_shares *shares, bool virial)
{
    --*(virial ? &shares->n_virial_users : &shares->n_energy_users);
    if (shares->n_virial_users + shares->n_energy_users > 0) return;
    HS_FREE(shares->value);
    shares->capacity = 0;
    shares->made_at = 0;
}

typedef struct share_context {
    const hs_pair_scan *scan;
    hs_pair_view view;
} share_context;

static void evaluate(const share_context *c, const hs_pair_batch *batch, double *force_over_r, double *energy)
{
    for (int p = 0; p < batch->n; ++p)
        hs_pair_scan_eval(c->scan, &c->view, batch->i[p], batch->j[p], batch->r2[p], &force_over_r[p], &energy[p]);
}

static void share_energies(void *context, const hs_pair_batch *batch, double (*values)[HS_PAIR_BATCH])
{
    double force_over_r[HS_PAIR_BATCH];
    evaluate(context, batch, force_over_r, values[0]);
    for (int p = 0; p < batch->n; ++p) values[0][p] *= 0.5;
}

static void share_all(void *context, const hs_pair_batch *batch, double (*values)[HS_PAIR_BATCH])
{
    static const int axis_a[6] = {0, 1, 2, 0, 0, 1}, axis_b[6] = {0, 1, 2, 1, 2, 2};
    double force_over_r[HS_PAIR_BATCH];
    evaluate(context, batch, force_over_r, values[0]);
    for (int p = 0; p < batch->n; ++p) values[0][p] *= 0.5;
    for (int k = 0; k < 6; ++k)
        for (int p = 0; p < batch->n; ++p)
            values[1 + k][p] = 0.5 * force_over_r[p] * batch->dx[axis_a[k]][p] * batch->dx[axis_b[k]][p];
}

/** A pair's largest energy is known, and of its virials r^2 F/r at most. */
static double largest_value(const hs_env *env, const hs_pair_view *view)
{
    if (env->energy_step != env->step || !(env->peak_force > 0.0)) return 0.0;
    const double most = 0.5 * view->pair->n_parts * fmax(env->peak_energy, env->peak_force * view->cutoff_max);
    return isfinite(most) ? most : 0.0;
}

static hs_status make(hs_env *env, hs_pair_shares *shares, hs_error *err)
{
    const int n = shares->n_virial_users > 0 ? N_ALL : N_ENERGIES;
    const size_t n_values = (size_t)n * (size_t)env->atoms->n_local;
    hs_pair_scan scan = {0};
    share_context context = {.scan = &scan};
    if (n_values > shares->capacity) {
        const size_t capacity = n_values + n_values / 8;
        HS_UNLESS_FAILED(err, HS_GROW(shares->value, 0, capacity, err));
        shares->capacity = err->status == HS_OK ? capacity : 0;
    }
    HS_TRY(hs_parallel_agree(env->parallel, err));
    if (n_values > 0) memset(shares->value, 0, n_values * sizeof *shares->value);
    env->view_pairs(env, &context.view);
    hs_status status = HS_OK;
    if (context.view.pair != NULL) {
        const hs_pair_sharing sharing = {.n = n,
                                         .share = n == N_ALL ? share_all : share_energies,
                                         .context = &context,
                                         .expected = largest_value(env, &context.view)};
        status = hs_pair_scan_begin_at_forces(&scan, env, context.view.cutoff_max, err);
        if (status == HS_OK) status = hs_pair_scan_share(&scan, env, &sharing, shares->value, err);
        hs_pair_scan_end(&scan);
    }
    shares->has_virial = n == N_ALL;
    shares->made_at = status == HS_OK ? env->revision : 0;
    return status;
}

hs_status hs_pair_shares_get(hs_env *env, bool wants_virial, const double **energy, const double **virial,
                             hs_error *err)
{
    hs_pair_shares *shares = env->pair_shares;
    if (shares->made_at != env->revision || (wants_virial && !shares->has_virial)) HS_TRY(make(env, shares, err));
    *energy = shares->value;
    *virial = wants_virial ? shares->value + env->atoms->n_local : NULL;
    return HS_OK;
}
