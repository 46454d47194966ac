/* Mean squared displacement of a group since the compute was defined. */
#include <string.h>

#include "base/memory.h"
#include "base/wide.h"
#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/compute.h"
#include "style/moments.h"
#include "style/places.h"

typedef struct msd_state {
    hs_atom_vector origin; /**< unwrapped places at the start, with com relative to the center of mass */
    bool has_com, is_average;
    int64_t n_averaged; /**< evaluations that the mean places are made of */
    int64_t kept_at;    /**< step whose result came from a checkpoint: it is part of the mean already; -1: none */
    double center[3];
} msd_state;

static const hs_keyword keywords[] = {
    {"com", 1, "yes|no", "displacements relative to the drift of the center of mass (default: no)"},
    {"average", 1, "yes|no", "relative to the mean places so far, not to those at the start (default: no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    msd_state *state = compute->state;
    const hs_env *env = compute->env;
    for (int i = 0; i + 1 < args->n; i += 2)
        HS_TRY(hs_arg_bool(args, i + 1, strcmp(args->word[i], "com") == 0 ? &state->has_com : &state->is_average, err));
    state->kept_at = -1;
    compute->n_vector = 4;
    HS_TRY(HS_ALLOC(compute->vector, 4, err));
    HS_TRY(hs_atom_vector_add(env->atoms, &state->origin, "compute", compute->id, "origin", err));
    if (state->has_com) hs_center_of_mass(env, compute->mask, state->center, NULL);
    hs_atom_vector_set_places(&state->origin, env, state->center);
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    msd_state *state = compute->state;
    hs_atom_vector_remove(compute->env->atoms, &state->origin);
    HS_FREE(compute->vector);
}

/** A new run asks anew, as in LAMMPS; also one that begins with what read_restart has kept. */
static hs_status begin_run(hs_compute *compute, hs_error *err)
{
    (void)err;
    ((msd_state *)compute->state)->kept_at = -1;
    return HS_OK;
}

static hs_status keep_state(hs_compute *compute, hs_state *kept, hs_error *err)
{
    msd_state *state = compute->state;
    const hs_env *env = compute->env;
    HS_TRY(hs_state_int64(kept, "n_averaged", &state->n_averaged, 1, err));
    if (kept->is_reading && hs_state_find(kept, "measured at") == NULL) return HS_OK; /* an older checkpoint */
    if (!kept->is_reading) state->kept_at = compute->vector_at == env->revision ? env->step : -1;
    HS_TRY(hs_state_int64(kept, "measured at", &state->kept_at, 1, err));
    return hs_state_double(kept, "measured", compute->vector, 4, err);
}

HS_WIDE static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    const msd_state *state = compute->state;
    const uint32_t *mask = atoms->mask + begin, group = compute->mask;
    const int n = end - begin;
    double x[HS_EXACT_ARRAY_MAX], d2[HS_EXACT_ARRAY_MAX];
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, from = axis < 2 ? begin : end;
        HS_FETCH(atoms->x[next] + from, n);
        HS_FETCH(atoms->image[next] + from, n);
        HS_FETCH(state->origin.of[next] + from, n);
        const double *origin = state->origin.of[axis] + begin, center = state->center[axis];
        hs_unwrapped_run(compute->env, axis, begin, end, x);
        for (int i = 0; i < n; ++i) {
            const double d = x[i] - center - origin[i];
            d2[i] = mask[i] & group ? d * d : 0.0;
        }
        hs_exact_add_array(&sums[axis], d2, n);
    }
}

/** Mean places: the present ones join those of the evaluations before. */
static void update_average(hs_compute *compute)
{
    msd_state *state = compute->state;
    const double weight = 1.0 / (double)(++state->n_averaged + 1);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < compute->env->atoms->n_local; ++i) {
            double *mean = &state->origin.of[axis][i];
            *mean += (hs_unwrapped(compute->env, axis, i) - state->center[axis] - *mean) * weight;
        }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    msd_state *state = compute->state;
    const hs_env *env = compute->env;
    (void)err;
    if (state->has_com) hs_center_of_mass(env, compute->mask, state->center, NULL);
    if (state->is_average && state->kept_at == env->step) return HS_OK;
    state->kept_at = -1;
    if (state->is_average) update_average(compute);
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 3, compute->vector);
    compute->vector[3] = compute->vector[0] + compute->vector[1] + compute->vector[2];
    const int64_t n = hs_atom_count(env->atoms, env->parallel, compute->mask);
    for (int k = 0; k < 4; ++k) compute->vector[k] = n > 0 ? compute->vector[k] / (double)n : 0.0;
    return HS_OK;
}

const hs_compute_style hs_compute_style_msd = {
    .about = {.name = "msd",
              .syntax = {.usage = "[com yes|no] [average yes|no]", .n_min = 0, .n_max = 0, .keywords = keywords},
              .summary = "mean squared displacement",
              .details =
                  "The vector `c_ID[1]` ... `c_ID[4]` is the mean over the group's atoms of dx^2, dy^2, dz^2 and of "
                  "their sum (distance^2), with d the displacement from the place where the atom was when the compute "
                  "was defined, crossings of periodic faces included. With `average yes` it is the displacement from "
                  "the mean of that place and those at all steps so far at which the compute was asked for; a step "
                  "counts once, however many ask (in LAMMPS once for each of them). The slope of `c_ID[4]` against "
                  "time is 2 dim D, with D the diffusion coefficient. Starting places travel with the atoms and are "
                  "part of checkpoints; after `read_restart` a compute of the same ID goes on from them.",
              .reference = "A. Einstein, Ann. Phys. 322, 549 (1905), doi:10.1002/andp.19053220806",
              .example =
                  "compute msd all msd com yes\nfix 9 all vector 10 c_msd[4]\nvariable D equal slope(f_9)/6/(10*dt)"},
    .state_size = sizeof(msd_state),
    .create = create,
    .destroy = destroy,
    .init = begin_run,
    .setup = begin_run,
    .keep_state = keep_state,
    .vector = vector,
    .needs_fixed_group = true,
};
