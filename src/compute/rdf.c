/* Radial distribution function g(r), and the mean number of neighbors up to r. */
#include <math.h>

#include "base/memory.h"
#include "kernel/pair_histogram.h"
#include "style/atom_sum.h"
#include "style/compute.h"
#include "style/pair_scan.h"

/** One pair of (ranges of) types. */
typedef struct rdf_pair {
    int i_lo, i_hi, j_lo, j_hi;
    double n_i, n_j, n_both; /**< atoms of the group with these types, and with either */
} rdf_pair;

typedef struct rdf_state {
    int n_bins;
    double cutoff; /**< 0: that of the pair style */
    double r_max;
    rdf_pair *pair; /**< owned [n_pairs] */
    int n_pairs;
    bool has_types;  /**< pairs of types were given */
    int64_t *counts; /**< owned [n_pairs][n_bins]: ordered pairs of atoms by distance, on this rank, then on all */
    hs_pair_counter counter; /**< where the list of the forces can be used */
} rdf_state;

static const hs_keyword keywords[] = {
    {"cutoff", 1, "<distance>", "range of the histogram (default: the pair style's cutoff)"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_pairs(rdf_state *state, const hs_args *args, int n_words, int n_types, hs_error *err)
{
    if (n_words % 2 != 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: types come in pairs: the type of '%s' is alone", args->command,
                       args->word[n_words]);
    state->has_types = n_words > 0;
    HS_TRY(HS_ALLOC(state->pair, (size_t)(n_words > 0 ? n_words / 2 : 1), err));
    state->n_pairs = n_words > 0 ? n_words / 2 : 1;
    state->pair[0] = (rdf_pair){1, n_types, 1, n_types, 0.0, 0.0, 0.0};
    for (int k = 0; k < n_words / 2; ++k) {
        rdf_pair *pair = &state->pair[k];
        HS_TRY(hs_arg_range(args, 1 + 2 * k, n_types, &pair->i_lo, &pair->i_hi, err));
        HS_TRY(hs_arg_range(args, 2 + 2 * k, n_types, &pair->j_lo, &pair->j_hi, err));
    }
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    rdf_state *state = compute->state;
    int64_t n_bins;
    const int end = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    HS_TRY(hs_arg_int(args, 0, 1, 10000000, &n_bins, err));
    state->n_bins = (int)n_bins;
    HS_TRY(read_pairs(state, args, end - 1, compute->env->atoms->n_types, err));
    if (end < args->n) HS_TRY(hs_arg_positive(args, end + 1, &state->cutoff, err));
    compute->n_rows = state->n_bins;
    compute->n_columns = 1 + 2 * state->n_pairs;
    HS_TRY(HS_ALLOC(state->counts, (size_t)state->n_pairs * (size_t)n_bins, err));
    return HS_ALLOC(compute->array, (size_t)compute->n_rows * (size_t)compute->n_columns, err);
}

static void destroy(hs_compute *compute)
{
    rdf_state *state = compute->state;
    HS_FREE(state->pair);
    HS_FREE(state->counts);
    hs_pair_counter_fini(&state->counter);
    HS_FREE(compute->array);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    rdf_state *state = compute->state;
    hs_pair_view view;
    compute->env->view_pairs(compute->env, &view);
    state->r_max = state->cutoff > 0.0 ? state->cutoff : view.cutoff_max;
    state->counter.r_max = state->r_max;
    state->counter.n_bins = state->n_bins;
    if (state->r_max > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: the pair style has no cutoff to count up to; the keyword 'cutoff <distance>' gives one",
                   hs_compute_who(compute).text);
}

/** Atoms of each pair of types. */
static void count_atoms(const hs_compute *compute)
{
    const rdf_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    for (int k = 0; k < state->n_pairs; ++k) {
        rdf_pair *pair = &state->pair[k];
        if (!state->has_types) {
            pair->n_i = pair->n_j = pair->n_both = (double)hs_atom_count(atoms, compute->env->parallel, compute->mask);
            continue;
        }
        int64_t n[3] = {0, 0, 0};
        for (int i = 0; i < atoms->n_local; ++i) {
            if (!(atoms->mask[i] & compute->mask)) continue;
            const bool is_i = atoms->type[i] >= pair->i_lo && atoms->type[i] <= pair->i_hi;
            const bool is_j = atoms->type[i] >= pair->j_lo && atoms->type[i] <= pair->j_hi;
            n[0] += is_i;
            n[1] += is_j;
            n[2] += is_i && is_j;
        }
        hs_parallel_sum_int64(compute->env->parallel, n, 3);
        pair->n_i = (double)n[0];
        pair->n_j = (double)n[1];
        pair->n_both = (double)n[2];
    }
}

typedef struct count_context {
    const hs_compute *compute;
    const hs_pair_scan *scan;
    /** Distance^2: pairs that were nearer when the lists were made count, where scan->x_listed is there. */
    double listed_r2;
    int64_t *counts; /**< [threads][n_pairs][n_bins] */
} count_context;

/** r^2 of a pair, rounded as in kernel/tally.h, so that no bin depends on how the pairs were found. */
static inline double distance2(const hs_pair_batch *batch, int p, bool is_fused)
{
    const double dx = batch->dx[0][p], dy = batch->dx[1][p], dz = batch->dx[2][p];
    return is_fused ? fma(dz, dz, fma(dy, dy, dx * dx)) : batch->r2[p];
}

static void count_batch(void *context, int thread, const hs_pair_batch *batch)
{
    const count_context *c = context;
    const rdf_state *state = c->compute->state;
    const double inv_width = state->n_bins / state->r_max, scale = inv_width * inv_width;
    const double n_fine = (double)state->n_bins * (double)state->n_bins;
    const bool is_fused = c->compute->env->isa >= HS_ISA_AVX2;
    int64_t *counts = c->counts + (size_t)thread * (size_t)state->n_pairs * (size_t)state->n_bins;
    for (int p = 0; p < batch->n; ++p) {
        const int i = batch->i[p], j = batch->j[p];
        if (!(c->scan->mask[i] & c->scan->mask[j] & c->compute->mask)) continue;
        const double fine = distance2(batch, p, is_fused) * scale;
        if (!(fine < n_fine)) continue;
        if (c->scan->x_listed[0] != NULL && !(hs_pair_scan_listed_r2(c->scan, i, j) < c->listed_r2)) continue;
        const int bin = (int)sqrt(floor(fine));
        const int type_i = hs_pair_scan_type(c->scan, i), type_j = hs_pair_scan_type(c->scan, j);
        for (int k = 0; k < state->n_pairs; ++k) {
            const rdf_pair *pair = &state->pair[k];
            int64_t *count = &counts[(size_t)k * (size_t)state->n_bins + (size_t)bin];
            *count += type_i >= pair->i_lo && type_i <= pair->i_hi && type_j >= pair->j_lo && type_j <= pair->j_hi;
            *count += type_j >= pair->i_lo && type_j <= pair->i_hi && type_i >= pair->j_lo && type_i <= pair->j_hi;
        }
    }
}

/** Where no `cutoff` was given pairs are those that forces count, as in LAMMPS: of lists that come late, those that were listed. */
static hs_status begin_scan(hs_compute *compute, count_context *context, hs_pair_scan *scan, hs_error *err)
{
    const rdf_state *state = compute->state;
    hs_pair_view view;
    compute->env->view_pairs(compute->env, &view);
    const double reach = view.cutoff_max + view.skin;
    context->listed_r2 = nextafter(reach * reach, INFINITY); /* as in the pair tables */
    return state->cutoff > 0.0 ? hs_pair_scan_begin(scan, compute->env, state->r_max, err)
                               : hs_pair_scan_begin_with_lists(scan, compute->env, state->r_max, err);
}

static hs_status count_by_scan(hs_compute *compute, hs_error *err)
{
    const rdf_state *state = compute->state;
    const size_t n = (size_t)state->n_pairs * (size_t)state->n_bins, n_threads = (size_t)hs_threads_get();
    hs_pair_scan scan = {0};
    count_context context = {.compute = compute, .scan = &scan};
    HS_TRY(HS_ALLOC(context.counts, n * n_threads, err));
    hs_status status = begin_scan(compute, &context, &scan, err);
    if (status == HS_OK) hs_pair_scan_visit(&scan, count_batch, &context);
    hs_pair_scan_end(&scan);
    for (size_t k = 0; k < n; ++k) {
        state->counts[k] = 0;
        for (size_t t = 0; t < n_threads; ++t) state->counts[k] += context.counts[t * n + k];
    }
    HS_FREE(context.counts);
    return status;
}

/** Whether the forces' own pairs are those that are wanted, and nothing but distances matters. Whether lists will come late at the
 *  next step nobody knows now. */
static bool can_use_forces(const hs_compute *compute, const hs_pair_view *view, bool is_now)
{
    const rdf_state *state = compute->state;
    if (state->cutoff > 0.0 && (!is_now || view->listed_only)) return false;
    return !state->has_types && compute->group == 0 && view->is_uniform && state->r_max <= view->cutoff_max &&
           state->n_bins <= HS_HISTOGRAM_BINS_MAX;
}

/** One compute can have its pairs counted with the forces; others of the same step pass over the list. */
static void announce(hs_compute *compute)
{
    rdf_state *state = compute->state;
    hs_pair_view view;
    compute->env->view_pairs(compute->env, &view);
    if (compute->env->pair_counter == NULL && can_use_forces(compute, &view, false))
        compute->env->pair_counter = &state->counter;
}

/** Counts of this rank that were, or can be, made from the forces' own pairs; *is_done tells. */
static hs_status count_listed(hs_compute *compute, bool *is_done, hs_error *err)
{
    rdf_state *state = compute->state;
    const hs_env *env = compute->env;
    hs_pair_view view;
    env->view_pairs(compute->env, &view);
    const bool is_counted = state->counter.held == env->revision;
    *is_done = is_counted || (view.list != NULL && can_use_forces(compute, &view, true));
    if (!*is_done) return HS_OK;
    if (!is_counted)
        HS_TRY(hs_pair_counter_list(&state->counter, view.list, view.clusters, env->atoms->x, env->isa, err));
    hs_pair_counter_get(&state->counter, state->counts);
    for (int bin = 0; bin < state->n_bins; ++bin) state->counts[bin] *= 2;
    return HS_OK;
}

static hs_status count_pairs(hs_compute *compute, hs_error *err)
{
    rdf_state *state = compute->state;
    bool is_done;
    HS_TRY(count_listed(compute, &is_done, err));
    if (!is_done) HS_TRY(count_by_scan(compute, err));
    hs_parallel_sum_int64(compute->env->parallel, state->counts, state->n_pairs * state->n_bins);
    return HS_OK;
}

/** g(r) and neighbors up to r of one pair of types. */
static void normalize(hs_compute *compute, int k)
{
    const rdf_state *state = compute->state;
    const hs_box *box = compute->env->box;
    const rdf_pair *pair = &state->pair[k];
    const double width = state->r_max / state->n_bins;
    /* partners of an atom: an atom is no partner of its own */
    const double n_partners = pair->n_i > 0.0 ? pair->n_j - pair->n_both / pair->n_i : 0.0;
    const double unit = box->dimension == 3 ? 4.0 * M_PI / (3.0 * hs_box_volume(box)) : M_PI / hs_box_volume(box);
    double n_up_to = 0.0;
    for (int bin = 0; bin < state->n_bins; ++bin) {
        const double lower = bin * width, upper = (bin + 1) * width;
        const double fraction = unit * (box->dimension == 3 ? upper * upper * upper - lower * lower * lower
                                                            : upper * upper - lower * lower);
        const double count = (double)state->counts[(size_t)k * (size_t)state->n_bins + (size_t)bin];
        const double expected = fraction * n_partners * pair->n_i;
        const double g = expected != 0.0 ? count / expected : 0.0;
        if (pair->n_i > 0.0) n_up_to += g * fraction * n_partners;
        double *row = compute->array + (size_t)bin * (size_t)compute->n_columns;
        row[0] = (bin + 0.5) * width;
        row[1 + 2 * k] = g;
        row[2 + 2 * k] = n_up_to;
    }
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    const rdf_state *state = compute->state;
    count_atoms(compute);
    HS_TRY(count_pairs(compute, err));
    for (int k = 0; k < state->n_pairs; ++k) normalize(compute, k);
    return HS_OK;
}

const hs_compute_style hs_compute_style_rdf = {
    .about =
        {.name = "rdf",
         .syntax = {.usage = "<Nbin> [<type i> <type j> ...] [cutoff <distance>]",
                    .n_min = 1,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "radial distribution function",
         .details =
             "The array `c_ID` has Nbin rows: the middle of the bin (distance), g(r), and the mean number of neighbors "
             "up to the bin's end; with several pairs of types, two more columns for each. Types are single ones or "
             "ranges as in pair_coeff; without any, all atoms count. Only atoms of the group count.\n\n"
             "Without `cutoff` the pairs are those whose forces count, up to the pair style's cutoff; where "
             "`neigh_modify` lets lists come late, some of them may be missing, as in LAMMPS. With `cutoff` they are "
             "all that are there.\n\n"
             "Without `cutoff`, with one kind of pairs, method `cluster`, and at most 256 bins, the force kernel "
             "counts the pairs on its way where `fix ave/time` asks for them (double precision, steps without "
             "energies), else the pairs of its list are counted, at a fraction of a timestep's cost. In all other "
             "cases, as for a `cutoff` of any length, beyond half the box too, the pairs are found anew, which takes "
             "some timesteps' time. `fix ave/time ... c_ID[*] mode vector` averages and writes it.",
         .reference = "M. P. Allen, D. J. Tildesley, Computer Simulation of Liquids, 2nd ed. (2017), section 8.2",
         .example = "compute myRDF all rdf 50\nfix 2 all ave/time 100 10 1000 c_myRDF[*] file tmp.rdf mode vector"},
    .state_size = sizeof(rdf_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .announce = announce,
    .array = array,
};
