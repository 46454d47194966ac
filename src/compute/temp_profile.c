/* Temperature after the mean velocity of each bin of the box is taken off: for flows whose profile is not known
 * beforehand.
 * Source: D. J. Evans, G. P. Morriss, Phys. Rev. Lett. 56, 2172 (1986), doi:10.1103/PhysRevLett.56.2172. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "core/atom_style.h"
#include "style/chunks.h"
#include "style/temperature.h"

enum { BINS_MAX = 10000000 };

typedef struct profile_state {
    hs_temperature temperature;
    bool is_taken_off[3]; /**< which components of the mean velocity */
    int64_t n[3];         /**< bins along each axis */
    int64_t n_bins;
    double *mean[3];  /**< owned [n_bins]: the bins' mean velocities, distance/time */
    double *sum;      /**< owned [n_bins] */
    uint64_t mean_at; /**< revision they are of; 0: none */
    double *bin;      /**< atom field: bin of each local atom, from 1, that the means were made with; 0: none yet */
    char *field;      /**< owned; name of that field */
    double *value;    /**< owned [capacity_value]: of each local atom while sums are made */
    size_t capacity_value;
} profile_state;

static const hs_keyword keywords[] = {
    {"out", 1, "tensor|bin", "the vector (default), or for each bin its atoms and temperature"},
    {NULL, 0, NULL, NULL},
};

/** Axes of the bins, and how many bins along each. */
static hs_status read_bins(hs_compute *compute, const hs_args *args, int *next, hs_error *err)
{
    static const char *const styles[] = {"x", "y", "z", "xy", "yz", "xz", "xyz", NULL};
    profile_state *state = compute->state;
    int style;
    HS_TRY(hs_arg_choice(args, 3, styles, &style, err));
    state->n_bins = 1;
    *next = 4;
    for (int axis = 0; axis < 3; ++axis) {
        state->n[axis] = 1;
        if (strchr(styles[style], "xyz"[axis]) == NULL) continue;
        if (axis == 2 && compute->env->box->dimension == 2)
            return hs_arg_refuse(args, 3, "a choice of axes of the plane", NULL, err);
        HS_TRY(hs_arg_need(args, *next, "the number of bins along each axis", err));
        HS_TRY(hs_arg_int(args, *next, 1, BINS_MAX, &state->n[axis], err));
        if (state->n_bins * state->n[axis] > BINS_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "%s: more than %d bins", args->command, BINS_MAX);
        state->n_bins *= state->n[axis];
        ++*next;
    }
    return HS_OK;
}

static void count_taken_off(hs_compute *compute)
{
    profile_state *state = compute->state;
    state->temperature.n_bias = (double)compute->env->box->dimension * (double)state->n_bins;
}

static hs_status add_field(hs_compute *compute, hs_error *err)
{
    profile_state *state = compute->state;
    hs_text name = {0};
    hs_status status = hs_text_printf(&name, err, "compute %s bin", compute->id);
    if (status == HS_OK) status = hs_memory_strdup(&state->field, hs_text_get(&name), err);
    hs_text_fini(&name);
    HS_TRY(status);
    return hs_atoms_add_field(compute->env->atoms, state->field, (void **)&state->bin, sizeof *state->bin, false, err);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    profile_state *state = compute->state;
    int next;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    for (int axis = 0; axis < 3; ++axis) {
        int64_t flag;
        HS_TRY(hs_arg_int(args, axis, 0, 1, &flag, err));
        if (flag == 1 && axis == 2 && compute->env->box->dimension == 2)
            return hs_arg_refuse(args, 2, "0: a plane has no z", NULL, err);
        state->is_taken_off[axis] = flag == 1;
    }
    HS_TRY(read_bins(compute, args, &next, err));
    compute->has_array =
        next < args->n && strcmp(args->word[next], "out") == 0 && strcmp(args->word[next + 1], "bin") == 0;
    compute->has_vector = !compute->has_array;
    if (next < args->n && strcmp(args->word[next], "out") != 0)
        return hs_arg_refuse(args, next, "expected: there are more numbers than axes", NULL, err);
    HS_TRY(hs_temperature_create(compute, HS_ALL_AXES, err));
    count_taken_off(compute);
    HS_TRY(add_field(compute, err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(HS_ALLOC(state->mean[axis], (size_t)state->n_bins, err));
    HS_TRY(HS_ALLOC(state->sum, (size_t)state->n_bins, err));
    if (!compute->has_array) return HS_OK;
    compute->n_rows = (int)state->n_bins;
    compute->n_columns = 2;
    return HS_ALLOC(compute->array, 2 * (size_t)state->n_bins, err);
}

static void destroy(hs_compute *compute)
{
    profile_state *state = compute->state;
    for (int axis = 0; axis < 3; ++axis) HS_FREE(state->mean[axis]);
    HS_FREE(state->sum);
    if (state->bin != NULL) hs_atoms_remove_field(compute->env->atoms, (void **)&state->bin);
    HS_FREE(state->field);
    HS_FREE(state->value);
    HS_FREE(compute->array);
    hs_temperature_destroy(compute);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    count_taken_off(compute); /* `dimension` may have come later */
    return hs_temperature_init(compute, err);
}

/** Bin of local atom i, from 0. */
static size_t bin_of(const hs_compute *compute, int i)
{
    const profile_state *state = compute->state;
    const hs_box *box = compute->env->box;
    const hs_atoms *atoms = compute->env->atoms;
    int64_t bin = 0;
    for (int axis = 2; axis >= 0; --axis) {
        const int64_t n = state->n[axis];
        const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        double place = (hs_box_upright(box, x, axis) - box->lo[axis]) / hs_box_length(box, axis);
        if (box->periodic[axis]) place -= floor(place);
        const int64_t k = (int64_t)(fmin(fmax(place, 0.0), 1.0) * (double)n);
        bin = bin * n + (k < n ? k : n - 1);
    }
    return (size_t)bin;
}

/** An atom belongs to the bin that it was in when the means were made, even if it, or the box, has moved since. */
static void bias(const hs_compute *compute, int i, double v[3])
{
    const profile_state *state = compute->state;
    const double made_with = state->bin[i]; /* perhaps read from the file of another deck, with other bins */
    const bool is_known = made_with >= 1.0 && made_with <= (double)state->n_bins;
    const size_t bin = is_known ? (size_t)made_with - 1 : bin_of(compute, i);
    for (int axis = 0; axis < 3; ++axis) v[axis] = state->is_taken_off[axis] ? state->mean[axis][bin] : 0.0;
}

/** Room for the local atoms, and the bin of each, from 1 (collective). */
static hs_status sort_into_bins(hs_compute *compute, hs_error *err)
{
    profile_state *state = compute->state;
    const size_t n = (size_t)compute->env->atoms->n_local;
    hs_status status = HS_RESERVE(state->value, state->capacity_value, n, err);
    if (hs_parallel_agree(compute->env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; ++i) state->bin[i] = (double)(bin_of(compute, (int)i) + 1);
    return HS_OK;
}

/** Sums of the atoms' values by bin. */
static hs_status sum_by_bin(hs_compute *compute, double *sums, hs_error *err)
{
    const profile_state *state = compute->state;
    return hs_bins_sum(compute->env, compute->mask, state->bin, (size_t)state->n_bins, state->value, sums, err);
}

static hs_status find_means(hs_compute *compute, hs_error *err)
{
    profile_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    if (state->mean_at == compute->env->revision) return HS_OK;
    HS_TRY(sort_into_bins(compute, err));
    for (int i = 0; i < atoms->n_local; ++i) state->value[i] = hs_atom_mass(atoms, i);
    HS_TRY(sum_by_bin(compute, state->sum, err));
    for (int axis = 0; axis < 3; ++axis) {
        if (!state->is_taken_off[axis]) continue;
        for (int i = 0; i < atoms->n_local; ++i) state->value[i] = hs_atom_mass(atoms, i) * atoms->v[axis][i];
        HS_TRY(sum_by_bin(compute, state->mean[axis], err));
        for (int64_t k = 0; k < state->n_bins; ++k)
            if (state->sum[k] > 0.0) state->mean[axis][k] /= state->sum[k];
    }
    state->mean_at = compute->env->revision;
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(find_means(compute, err));
    return hs_temperature_scalar(compute, value, err);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    HS_TRY(find_means(compute, err));
    return hs_temperature_vector(compute, err);
}

/** Atoms and temperature of each bin. */
static hs_status array(hs_compute *compute, hs_error *err)
{
    profile_state *state = compute->state;
    const hs_env *env = compute->env;
    const hs_atoms *atoms = env->atoms;
    HS_TRY(find_means(compute, err));
    HS_TRY(sort_into_bins(compute, err));
    for (int i = 0; i < atoms->n_local; ++i) state->value[i] = 1.0;
    HS_TRY(sum_by_bin(compute, state->sum, err));
    for (int64_t k = 0; k < state->n_bins; ++k) compute->array[2 * k] = state->sum[k];
    for (int i = 0; i < atoms->n_local; ++i) {
        double v[3];
        bias(compute, i, v);
        for (int axis = 0; axis < 3; ++axis) v[axis] = atoms->v[axis][i] - v[axis];
        state->value[i] = hs_atom_mass(atoms, i) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    HS_TRY(sum_by_bin(compute, state->sum, err));
    for (int64_t k = 0; k < state->n_bins; ++k) {
        const double n_dof = (double)env->box->dimension * (compute->array[2 * k] - 1.0);
        compute->array[2 * k + 1] =
            n_dof > 0.0 ? state->sum[k] * (env->units->mvv2e / (n_dof * env->units->boltz)) : 0.0;
    }
    return HS_OK;
}

/** A thermostat takes off the means of the latest evaluation, which was in the step before. */
static hs_status keep_state(hs_compute *compute, hs_state *kept, hs_error *err)
{
    profile_state *state = compute->state;
    static const char *const names[] = {"mean vx", "mean vy", "mean vz"};
    for (int axis = 0; axis < 3; ++axis)
        HS_TRY(hs_state_double(kept, names[axis], state->mean[axis], state->n_bins, err));
    return HS_OK;
}

const hs_compute_style hs_compute_style_temp_profile = {
    .about =
        {.name = "temp/profile",
         .syntax = {.usage = "<0|1> <0|1> <0|1> <x|y|z|xy|yz|xz|xyz> <N> ... [out tensor|bin]",
                    .n_min = 5,
                    .n_max = 7,
                    .keywords = keywords},
         .summary = "temperature without the mean velocity of each part of the box",
         .details =
             "The box is cut into bins along the axes named, as many along each as the numbers say. From the velocity "
             "of each atom of the group the mean velocity of the group's atoms in its bin (that of their center of "
             "mass) is taken off, in the components whose flag is 1. The scalar `c_ID` is the temperature of what is "
             "left, with dim N - dim (bins) - dim degrees of freedom (`compute_modify extra` changes the last number; "
             "the number of bins counts whatever the flags are, as in LAMMPS of 29 Sep 2021). Thermostats that use "
             "this temperature leave the flow as it is: `fix_modify ... temp ID`.\n\n"
             "With `out tensor` the vector is the kinetic-energy tensor as in compute temp. With `out bin` the array "
             "has a row for each bin, x changing fastest: the number of its atoms n, and their temperature with dim (n "
             "- 1) degrees of freedom.",
         .reference = "D. J. Evans, G. P. Morriss, Phys. Rev. Lett. 56, 2172 (1986), doi:10.1103/PhysRevLett.56.2172",
         .example = "compute t all temp/profile 1 0 0 y 20\nfix 1 all nvt temp 1.0 1.0 0.5\nfix_modify 1 temp t"},
    .state_size = sizeof(profile_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .array = array,
    .modify = hs_temperature_modify,
    .bias = bias,
    .keep_state = keep_state,
    .is_vector_extensive = true,
    .is_temperature = true,
};
