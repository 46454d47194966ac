/* Chemical potential by test particles (B. Widom, J. Chem. Phys. 39, 2808 (1963), doi:10.1063/1.1734110):
 *   mu_ex = -k T ln <V exp(-u / k T)> / <V>,  u the energy of an atom put at a random place. */
#include <math.h>
#include <string.h>

#include "io/average.h"
#include "style/local_energy.h"
#include "style/region.h"

enum { BLOCK = 64, N_TRIES = 1 << 16 };

typedef struct widom_state {
    int64_t every, n_tests; /**< steps; test particles at each such step */
    int64_t type;
    double kt; /**< energy */
    double temperature;
    hs_noise noise;
    hs_where where;
    int64_t first, next;
    double factor, volume; /**< of the latest step: mean of exp(-u / kT), volume of box or region */
    /** Random places so far, and those in the region; of the latest step, if the region changes. */
    int64_t n_places, n_hits;
    hs_series_set series; /**< owned; V exp(-u / kT), with the weights V */
} widom_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "test particles in the region alone"},
    {"full_energy", 0, "", "accepted: energies are always whole"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    widom_state *state = fix->state;
    int64_t seed;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 1, 1, INT32_MAX, &state->n_tests, err));
    HS_TRY(hs_arg_type(args, 2, fix->env->atoms->n_types, &state->type, err));
    HS_TRY(hs_arg_int(args, 3, 1, INT32_MAX, &seed, err));
    HS_TRY(hs_arg_positive(args, 4, &state->temperature, err));
    for (int i = 5; i < args->n; ++i)
        if (strcmp(args->word[i], "region") == 0) HS_TRY(hs_where_set(&state->where, args->word[++i], err));
    HS_TRY(hs_fix_noise(fix, seed, &state->noise, err));
    state->series.n_series = 1;
    state->first = state->next = fix->env->step + 1;
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

static void destroy(hs_fix *fix)
{
    widom_state *state = fix->state;
    hs_where_fini(&state->where);
    hs_series_set_fini(&state->series);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    widom_state *state = fix->state;
    state->kt = fix->env->units->boltz * state->temperature;
    state->next = state->first + (fix->env->step - state->first + state->every) / state->every * state->every;
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

/** Where places are drawn: the box, or in an orthogonal one what the region's bounds leave of it. */
static void find_bounds(const hs_fix *fix, hs_box *bounds)
{
    const hs_region *region = ((const widom_state *)fix->state)->where.region;
    *bounds = *fix->env->box;
    for (int axis = 0; axis < bounds->dimension; ++axis) {
        if (region == NULL || !region->has_extent || bounds->is_tilted) return;
        bounds->lo[axis] = fmin(fmax(bounds->lo[axis], region->extent[axis][0]), bounds->hi[axis]);
        bounds->hi[axis] = fmax(fmin(bounds->hi[axis], region->extent[axis][1]), bounds->lo[axis]);
    }
}

static void draw_place(const hs_fix *fix, const hs_box *bounds, const uint32_t word[HS_NOISE_NUMBERS], double x[3])
{
    double fraction[3];
    for (int axis = 0; axis < 3; ++axis) fraction[axis] = ((double)word[axis] + 0.5) * 0x1p-32;
    hs_box_place(bounds, fraction, x);
    if (bounds->dimension == 2) x[2] = 0.0;
    for (int axis = 0; axis < 3; ++axis) x[axis] = hs_moved(0.0, x[axis], fix->env->position_magic);
}

/** The place of a test particle, the same on all ranks; *n_places random places were tried. */
static hs_status find_place(const hs_fix *fix, const hs_box *bounds, int64_t test, double x[3], int64_t *n_places,
                            hs_error *err)
{
    const widom_state *state = fix->state;
    for (int n = 0; n < N_TRIES; ++n) {
        uint32_t word[HS_NOISE_NUMBERS];
        hs_noise_words(state->noise, hs_fix_clock(fix), n % HS_NOISE_DRAWS,
                       test + ((int64_t)(n / HS_NOISE_DRAWS) << 32), word);
        draw_place(fix, bounds, word, x);
        ++*n_places;
        if (state->where.region == NULL || hs_region_contains(state->where.region, x)) return HS_OK;
    }
    return hs_fail(err, HS_ERROR_RUN, "%s: %d random places are not in the region '%s': it has hardly any volume",
                   hs_fix_who(fix).text, N_TRIES, state->where.id);
}

/** Sum of exp(-u / kT) over n test particles from number @p test on (collective). */
static double measure_block(const hs_fix *fix, const hs_local_energy *local, int n, const double (*x)[3])
{
    const widom_state *state = fix->state;
    const int type = (int)state->type;
    const int64_t left_out[2] = {0, 0};
    hs_exact_sum sums[BLOCK];
    int64_t n_overlaps[BLOCK];
    double energy[BLOCK], sum = 0.0;
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < n; ++k) {
        hs_exact_clear(&sums[k]);
        n_overlaps[k] = 0;
        hs_local_energy_add(local, x[k], 0, &type, 1, left_out, &sums[k], &n_overlaps[k]);
    }
    hs_local_energy_total(local, sums, n, energy, n_overlaps);
    const double tail = hs_local_energy_tail(local, type);
    for (int k = 0; k < n; ++k)
        if (n_overlaps[k] == 0) sum += exp(-(energy[k] + tail) / state->kt);
    return sum;
}

static hs_status insert(hs_fix *fix, const hs_local_energy *local, double *sum, hs_error *err)
{
    widom_state *state = fix->state;
    double x[BLOCK][3];
    hs_box bounds;
    find_bounds(fix, &bounds);
    for (int64_t test = 0; test < state->n_tests; test += BLOCK) {
        const int n = state->n_tests - test < BLOCK ? (int)(state->n_tests - test) : BLOCK;
        for (int k = 0; k < n; ++k) HS_TRY(find_place(fix, &bounds, test + k, x[k], &state->n_places, err));
        state->n_hits += n;
        *sum += measure_block(fix, local, n, (const double(*)[3])x);
    }
    return HS_OK;
}

/** Of the box, or of the region as far as random places tell. */
static double find_volume(const hs_fix *fix)
{
    const widom_state *state = fix->state;
    hs_box bounds;
    find_bounds(fix, &bounds);
    return hs_box_volume(&bounds) * (double)state->n_hits / (double)state->n_places;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    widom_state *state = fix->state;
    hs_local_energy local = {0};
    double sum = 0.0;
    if (fix->env->step != state->next) return HS_OK;
    state->next += state->every;
    HS_TRY(hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err));
    HS_TRY(hs_where_update(&state->where, err));
    if (state->where.region != NULL && state->where.region->is_varying) state->n_places = state->n_hits = 0;
    hs_status status = hs_local_energy_begin(&local, fix, 1e12 * state->kt, err);
    if (status == HS_OK) status = insert(fix, &local, &sum, err);
    hs_local_energy_end(&local);
    if (status != HS_OK) return status;
    state->factor = sum / (double)state->n_tests;
    state->volume = find_volume(fix);
    const double weight = hs_box_volume(fix->env->box), value = weight * state->factor;
    return hs_series_set_add(&state->series, &value, &weight, err);
}

/** Mean of the factor over the steps so far; error 0 for fewer than two. */
static hs_estimate estimate(const widom_state *state)
{
    return state->series.n_levels > 0 ? hs_series_set_estimate(&state->series, 0) : (hs_estimate){.n = 0};
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const widom_state *state = fix->state;
    const hs_estimate e = estimate(state);
    const double none = 0.0;
    (void)err;
    const double values[] = {e.n > 0 ? -state->kt * log(state->factor) : none, state->factor, state->volume,
                             e.n > 0 ? -state->kt * log(e.mean) : none,
                             e.n > 1 && e.mean > 0.0 ? state->kt * e.error / e.mean : none};
    *value = values[i];
    return HS_OK;
}

static void say_results(const hs_fix *fix)
{
    const widom_state *state = fix->state;
    hs_estimate e = estimate(state);
    char title[160];
    if (e.n < 2 || !(e.mean > 0.0)) return;
    snprintf(title, sizeof title, "Test particles of type %lld at %lld steps, fix %.80s", (long long)state->type,
             (long long)e.n, fix->id);
    hs_average_say_head(fix->env->out, title);
    e.error *= state->kt / e.mean;
    e.mean = -state->kt * log(e.mean);
    hs_average_say_row(fix->env->out, "mu_ex", &e);
    hs_average_say_foot(fix->env->out, !e.is_converged);
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    widom_state *state = fix->state;
    HS_TRY(hs_state_int64(kept, "first", &state->first, 1, err));
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    HS_TRY(hs_state_int64(kept, "places", &state->n_places, 1, err));
    HS_TRY(hs_state_int64(kept, "hits", &state->n_hits, 1, err));
    HS_TRY(hs_state_double(kept, "factor", &state->factor, 1, err));
    HS_TRY(hs_state_double(kept, "volume", &state->volume, 1, err));
    return hs_series_set_keep(&state->series, kept, "series", err);
}

const hs_fix_style hs_fix_style_widom = {
    .about = {.name = "widom",
              .syntax = {.usage = "<N> <M> <type> <seed> <T> [keyword values ...]",
                         .n_min = 5,
                         .n_max = 5,
                         .keywords = keywords},
              .summary = "chemical potential by test particles, with its error",
              .details =
                  "Every N steps M atoms of the type are put at random places, one at a time, and taken away again; "
                  "their energies u with the atoms give the excess chemical potential mu_ex = -k T ln <exp(-u / k T)> "
                  "(energy; of box volumes that change, -k T ln (<V exp(-u / k T)> / <V>)). The full one is k T "
                  "ln(Lambda^d n) + mu_ex at the number density n. T is the temperature of the atoms. The first test "
                  "comes at the step after the fix was defined. With `region` test particles are put in the region "
                  "alone, and mu_ex is the local one.\n\n"
                  "The vector: `f_ID[1]` mu_ex of the latest tests alone, `f_ID[2]` the mean of exp(-u / k T) of "
                  "these, `f_ID[3]` the volume of box or region (of the latter by the random places that were in it, "
                  "of the latest tests if the region moves). Beyond LAMMPS: `f_ID[4]` mu_ex from all tests of the fix, "
                  "and `f_ID[5]` its standard error, by blocking; after a run both are printed. Trust them where the "
                  "fluid is not dense: the mean rests on places that are free by chance.\n\n"
                  "Energies include long-range corrections (`pair_modify tail`). The box must be thicker than the "
                  "cutoff where it is periodic, and the pair style must not go by diameters. Results are the same on "
                  "any ranks and threads.",
              .reference = "B. Widom, J. Chem. Phys. 39, 2808 (1963), doi:10.1063/1.1734110",
              .example = "fix w all widom 10 1000 1 29494 1.2\nthermo_style custom step temp f_w[4] f_w[5]"},
    .state_size = sizeof(widom_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .say_results = say_results,
    .vector = vector,
    .keep_state = keep_state,
    .n_vector = 5,
    .is_time_dependent = true,
    .allows_dynamic_group = true,
};
