/* Temperature of the atoms in chunks, and temperature and kinetic energy of each chunk. */
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/per_chunk.h"

typedef enum { COLUMN_TEMP, COLUMN_KECOM, COLUMN_INTERNAL } column_kind;

typedef struct temp_chunk_state {
    hs_per_chunk base; /**< first */
    column_kind column[3];
    bool is_com;   /**< velocities are relative to that of the chunk's center of mass */
    bool has_adof; /**< else the dimension of the box */
    double dof_per_atom, dof_per_chunk;
    char *bias_id;           /**< owned; NULL: none */
    hs_compute *bias;        /**< borrowed during an evaluation */
    bool is_asking;          /**< the bias is being evaluated */
    double *motion;          /**< owned [n][4]: velocity of the center of mass, and mass */
    double *count, *kinetic; /**< owned [n] */
    size_t capacity;
    uint64_t motion_at; /**< env->revision of these; 0: none */
    double n_atoms;     /**< in all chunks, as of then */
    /** What was taken off each atom's velocity at the latest evaluation; thermostats use it later. */
    hs_atom_vector bias_of;
} temp_chunk_state;

static const char *const columns[] = {"temp", "kecom", "internal", NULL};
static const hs_keyword keywords[] = {
    {"com", 1, "yes|no", "take off the velocity of each chunk's center of mass (default: no)"},
    {"bias", 1, "<compute-ID>", "first take off what this temperature compute takes off (default: nothing)"},
    {"adof", 1, "<number>", "degrees of freedom of an atom (default: dimensions of the box)"},
    {"cdof", 1, "<number>", "degrees of freedom of a chunk beside those (default: 0)"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(temp_chunk_state *state, const hs_args *args, int first, hs_error *err)
{
    for (int i = first; i + 1 < args->n; i += 2) {
        if (strcmp(args->word[i], "com") == 0) {
            HS_TRY(hs_arg_bool(args, i + 1, &state->is_com, err));
        } else if (strcmp(args->word[i], "bias") == 0) {
            HS_TRY(hs_memory_replace(&state->bias_id, args->word[i + 1], err));
        } else if (strcmp(args->word[i], "adof") == 0) {
            state->has_adof = true;
            HS_TRY(hs_arg_double(args, i + 1, &state->dof_per_atom, err));
        } else {
            HS_TRY(hs_arg_double(args, i + 1, &state->dof_per_chunk, err));
        }
    }
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    temp_chunk_state *state = compute->state;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    const int end = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    for (int i = 1; i < end; ++i) {
        int kind;
        HS_TRY(hs_arg_choice(args, i, columns, &kind, err));
        if (i > 3)
            return hs_arg_refuse(args, i, "expected: each of temp, kecom and internal is named once at most", NULL,
                                 err);
        state->column[i - 1] = (column_kind)kind;
    }
    HS_TRY(hs_per_chunk_create(compute, args, end > 1 ? end - 1 : 1, true, err));
    HS_TRY(read_keywords(state, args, end, err));
    HS_TRY(hs_atom_vector_add(compute->env->atoms, &state->bias_of, "compute", compute->id, "bias", err));
    compute->has_vector = true;
    compute->n_vector = 6;
    return HS_ALLOC(compute->vector, 6, err);
}

static void destroy(hs_compute *compute)
{
    temp_chunk_state *state = compute->state;
    hs_atom_vector_remove(compute->env->atoms, &state->bias_of);
    HS_FREE(state->bias_id);
    HS_FREE(state->motion);
    HS_FREE(state->count);
    HS_FREE(state->kinetic);
    hs_per_chunk_destroy(compute);
}

static hs_status find_bias(hs_compute *compute, hs_error *err)
{
    temp_chunk_state *state = compute->state;
    if (state->bias_id == NULL) return HS_OK;
    state->bias = compute->env->find_compute(compute->env, state->bias_id);
    if (state->bias == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: bias: there is no compute '%s'", hs_compute_who(compute).text,
                       state->bias_id);
    if (state->bias->style->is_temperature && state->bias->style->bias != NULL && state->bias != compute) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: bias: %s is no temperature that takes something off velocities; temp/profile, "
                   "temp/ramp and temp/com are",
                   hs_compute_who(compute).text, hs_compute_who(state->bias).text);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    HS_TRY(find_bias(compute, err));
    return hs_per_chunk_init(compute, err);
}

/** Velocity of an atom without the bias. */
static void find_velocity(const hs_compute *compute, int i, double v[3])
{
    const temp_chunk_state *state = compute->state;
    double bias[3] = {0.0, 0.0, 0.0};
    if (state->bias != NULL) state->bias->style->bias(state->bias, i, bias);
    for (int axis = 0; axis < 3; ++axis) v[axis] = compute->env->atoms->v[axis][i] - bias[axis];
}

/** The same relative to the center of mass of the atom's chunk c. */
static void find_relative(const hs_compute *compute, int i, int64_t c, double v[3])
{
    const temp_chunk_state *state = compute->state;
    find_velocity(compute, i, v);
    for (int axis = 0; axis < 3; ++axis) v[axis] -= state->motion[4 * c + axis];
}

/** Momentum along an axis; mass (3); 1 (4). */
static double moment(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const int k = *(const int *)context;
    double v[3] = {0.0};
    (void)c;
    if (k == 4) return 1.0;
    if (k < 3) find_velocity(compute, i, v);
    return hs_atom_mass(compute->env->atoms, i) * (k < 3 ? v[k] : 1.0);
}

/** m v^2; relative to the center of mass where the context says so. */
static double kinetic(const hs_compute *compute, int i, int64_t c, const void *is_relative)
{
    double v[3];
    if (*(const bool *)is_relative)
        find_relative(compute, i, c, v);
    else
        find_velocity(compute, i, v);
    return hs_atom_mass(compute->env->atoms, i) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static hs_status reserve(temp_chunk_state *state, hs_error *err)
{
    const size_t n = (size_t)state->base.n;
    if (n <= state->capacity && state->motion != NULL) return HS_OK;
    HS_TRY(HS_GROW(state->motion, 0, 4 * n + 4, err));
    HS_TRY(HS_GROW(state->count, 0, n + 1, err));
    HS_TRY(HS_GROW(state->kinetic, 0, n + 1, err));
    state->capacity = n;
    return HS_OK;
}

/** What is taken off the velocity of each atom. */
static void keep_bias(hs_compute *compute)
{
    temp_chunk_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        const int64_t c = hs_per_chunk_of(compute, i);
        double v[3];
        if (c >= 0 && state->is_com)
            find_relative(compute, i, c, v);
        else
            find_velocity(compute, i, v);
        for (int axis = 0; axis < 3; ++axis) state->bias_of.of[axis][i] = atoms->v[axis][i] - v[axis];
    }
}

/** Bring the bias up to date (collective). */
static hs_status update_bias(hs_compute *compute, hs_error *err)
{
    temp_chunk_state *state = compute->state;
    double t;
    HS_TRY(find_bias(compute, err));
    if (state->bias == NULL) return HS_OK;
    if (state->is_asking)
        return hs_fail(err, HS_ERROR_INPUT, "%s: its bias '%s' takes off what it takes off itself",
                       hs_compute_who(compute).text, state->bias_id);
    state->is_asking = true;
    const hs_status status = hs_compute_scalar(state->bias, &t, err);
    state->is_asking = false;
    return status;
}

/** Number the atoms; how chunks move and how many atoms they have (collective). */
static hs_status find_motion(hs_compute *compute, hs_error *err)
{
    temp_chunk_state *state = compute->state;
    if (state->motion_at == compute->env->revision) return HS_OK;
    HS_TRY(update_bias(compute, err));
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(reserve(state, err));
    for (int k = 0; k < 4; ++k) HS_TRY(hs_per_chunk_add_up(compute, moment, &k, state->motion + k, 4, err));
    HS_TRY(hs_per_chunk_add_up(compute, moment, &(int){4}, state->count, 1, err));
    state->n_atoms = 0.0;
    for (int64_t c = 0; c < state->base.n; ++c) {
        double *motion = state->motion + 4 * c;
        for (int axis = 0; axis < 3; ++axis) motion[axis] = motion[3] > 0.0 ? motion[axis] / motion[3] : 0.0;
        state->n_atoms += state->count[c];
    }
    if (!state->has_adof) state->dof_per_atom = compute->env->box->dimension;
    keep_bias(compute);
    state->motion_at = compute->env->revision;
    return HS_OK;
}

/** m v_a v_b of the thermal velocities: xx yy zz xy xz yz. */
static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    static const int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const hs_compute *compute = context;
    const bool is_com = ((const temp_chunk_state *)compute->state)->is_com;
    for (int i = begin; i < end; ++i) {
        const int64_t c = hs_per_chunk_of(compute, i);
        double v[3];
        if (c < 0) continue;
        if (is_com)
            find_relative(compute, i, c, v);
        else
            find_velocity(compute, i, v);
        for (int k = 0; k < 6; ++k) hs_exact_add(&sums[k], hs_atom_mass(atoms, i) * v[axes[k][0]] * v[axes[k][1]]);
    }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    HS_TRY(find_motion(compute, err));
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 6, compute->vector);
    for (int k = 0; k < 6; ++k) compute->vector[k] *= env->units->mvv2e;
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const temp_chunk_state *state = compute->state;
    HS_TRY(hs_compute_eval_vector(compute, err));
    HS_TRY(find_motion(compute, err));
    compute->n_dof = state->dof_per_atom * state->n_atoms + state->dof_per_chunk * (double)state->base.n;
    const double sum = compute->vector[0] + compute->vector[1] + compute->vector[2];
    *value = compute->n_dof > 0.0 ? sum / (compute->n_dof * compute->env->units->boltz) : 0.0;
    return HS_OK;
}

static double value_of(const hs_compute *compute, column_kind column, int64_t c)
{
    const temp_chunk_state *state = compute->state;
    const hs_units *units = compute->env->units;
    const double *v = state->motion + 4 * c, n_dof = state->dof_per_chunk + state->dof_per_atom * state->count[c];
    if (!(state->count[c] > 0.0)) return 0.0;
    if (column == COLUMN_KECOM) return 0.5 * units->mvv2e * v[3] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (column == COLUMN_INTERNAL) return 0.5 * units->mvv2e * state->kinetic[c];
    return n_dof > 0.0 ? units->mvv2e * state->kinetic[c] / (n_dof * units->boltz) : 0.0;
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    temp_chunk_state *state = compute->state;
    HS_TRY(find_motion(compute, err));
    for (int k = 0; k < compute->n_columns; ++k) {
        const bool is_relative = state->column[k] == COLUMN_INTERNAL || state->is_com;
        if (state->column[k] != COLUMN_KECOM)
            HS_TRY(hs_per_chunk_add_up(compute, kinetic, &is_relative, state->kinetic, 1, err));
        for (int64_t c = 0; c < state->base.n; ++c)
            *hs_per_chunk_at(compute, c, k) = value_of(compute, state->column[k], c);
    }
    return HS_OK;
}

static bool counts(const hs_compute *compute, int i) { return hs_per_chunk_of(compute, i) >= 0; }

static void bias(const hs_compute *compute, int i, double b[3])
{
    const temp_chunk_state *state = compute->state;
    for (int axis = 0; axis < 3; ++axis) b[axis] = state->bias_of.of[axis][i];
}

const hs_compute_style hs_compute_style_temp_chunk = {
    .about =
        {.name = "temp/chunk",
         .syntax = {.usage = "<chunk-ID> [temp] [kecom] [internal]", .n_min = 1, .n_max = 4, .keywords = keywords},
         .summary = "temperature of the atoms in chunks, and of each chunk",
         .details =
             "The scalar `c_ID` is the temperature of those atoms of the group that are in a chunk of the compute "
             "chunk/atom, with adof N + cdof (chunks) degrees of freedom: by default dim for each atom, from which "
             "nothing is taken off. The vector `c_ID[1]` ... `c_ID[6]` is their kinetic-energy tensor xx, yy, zz, xy, "
             "xz, yz: sum m v_a v_b (energy).\n\n"
             "The array has a row for each chunk, and a column for each word, in their order: `temp` (the default) its "
             "temperature, with adof n + cdof degrees of freedom; `kecom` the kinetic energy of the motion of its "
             "center of mass; `internal` the kinetic energy relative to that motion. A chunk without atoms has 0.\n\n"
             "With `com yes` temperatures and the tensor are of velocities relative to the chunk's center of mass; "
             "`cdof -3` then takes its degrees of freedom off. `bias` takes off first what another temperature compute "
             "(temp/ramp, say) takes off. As the temperature of a thermostat (`fix_modify ... temp ID`) only what is "
             "left is changed; in LAMMPS of 29 Sep 2021 such a thermostat does nothing. Where atoms were moved between "
             "runs, the chunks' velocities are those of the atoms that are in them now from the first row on; LAMMPS's "
             "are of before.",
         .example = "compute slabs all chunk/atom bin/1d z lower 0.05 units reduced\n"
                    "compute t all temp/chunk slabs temp com yes cdof -3\n"
                    "fix t all ave/time 10 100 1000 c_t[1] mode vector file slabs.txt"},
    .state_size = sizeof(temp_chunk_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .array = array,
    .counts = counts,
    .bias = bias,
    .is_vector_extensive = true,
    .is_temperature = true,
};
