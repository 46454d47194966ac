/* Adds atoms while a simulation runs, one at a time at random places of a region: growth of a film, a gas that enters.
 * The places are those that LAMMPS draws from the same seed. */
#include <math.h>
#include <string.h>

#include "core/lattice.h"
#include "core/random.h"
#include "style/fix.h"
#include "style/nearest_image.h"
#include "style/region.h"

enum { N_WARM_UP = 30, N_TRIES = 1000000 };

typedef struct deposit_state {
    int64_t n_wanted, every, n_attempts;
    int type;
    hs_where where;
    double near;    /**< no atom may be nearer to a new one, distance */
    double v[3][2]; /**< range of each component of velocities, distance/time */
    bool counts_on; /**< IDs go on from the last one given, though atoms were removed meanwhile */
    int64_t n_added, last_id;
    int64_t first, next; /**< steps: of the first atom by the schedule, and of the next one; -1: no more */
    hs_park park;
} deposit_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "where atoms are put; needed, and bounded"},
    {"id", 1, "max|next",
     "the new atom's ID: one more than the largest there is (default), or than the largest there was"},
    {"near", 1, "<distance>", "only where no atom is nearer than this (default: 0)"},
    {"attempt", 1, "<N>", "places that are tried for an atom before it is left for the next time (default: 10)"},
    {"vx", 2, "<lo> <hi>", "range of the x component of the velocity (default: 0 0)"},
    {"vy", 2, "<lo> <hi>", "range of the y component"},
    {"vz", 2, "<lo> <hi>", "range of the z component"},
    {"units", 1, "lattice|box", "near and velocities in lattice spacings (default) or in distance units"},
    {NULL, 0, NULL, NULL},
};

static hs_status find_region(const hs_fix *fix, hs_error *err)
{
    deposit_state *state = fix->state;
    HS_TRY(hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err));
    const hs_region *region = state->where.region;
    if (region->is_varying)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the region '%s' follows variables; atoms are put into regions that stay",
                       hs_fix_who(fix).text, region->id);
    if (!region->has_extent)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the region '%s' has no bounds, so that no places can be drawn in it",
                       hs_fix_who(fix).text, region->id);
    return HS_OK;
}

/** When the fix is defined the region is within the box, whose faces may move past it later. */
static hs_status check_extent(const hs_fix *fix, hs_error *err)
{
    const hs_box *box = fix->env->box;
    const hs_region *region = ((const deposit_state *)fix->state)->where.region;
    double lo[3], hi[3];
    hs_box_bounds(box, lo, hi);
    for (int axis = 0; axis < box->dimension; ++axis) {
        const double slack = 1e-12 * hs_box_length(box, axis); /* runs round the box's faces */
        if (region->extent[axis][0] < lo[axis] - slack || region->extent[axis][1] > hi[axis] + slack)
            return hs_fail(err, HS_ERROR_INPUT, "%s: the region '%s' reaches out of the box along %c",
                           hs_fix_who(fix).text, region->id, "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status read_range(const hs_args *args, int i, double range[2], hs_error *err)
{
    HS_TRY(hs_arg_double(args, i, &range[0], err));
    HS_TRY(hs_arg_double(args, i + 1, &range[1], err));
    return range[1] >= range[0] ? HS_OK : hs_arg_refuse(args, i + 1, "at least as much as the lower bound", NULL, err);
}

static hs_status read_keywords(hs_fix *fix, const hs_args *args, bool *is_box, hs_error *err)
{
    deposit_state *state = fix->state;
    for (int i = 4; i + 1 < args->n; i += 2) {
        const char *keyword = args->word[i], *word = args->word[i + 1];
        if (strcmp(keyword, "region") == 0) {
            HS_TRY(hs_where_set(&state->where, word, err));
        } else if (strcmp(keyword, "id") == 0) {
            state->counts_on = strcmp(word, "next") == 0;
        } else if (strcmp(keyword, "near") == 0) {
            HS_TRY(hs_arg_not_negative(args, i + 1, &state->near, err));
        } else if (strcmp(keyword, "attempt") == 0) {
            HS_TRY(hs_arg_int(args, i + 1, 1, N_TRIES, &state->n_attempts, err));
        } else if (strcmp(keyword, "units") == 0) {
            *is_box = strcmp(word, "box") == 0;
        } else {
            HS_TRY(read_range(args, i + 1, state->v[keyword[1] - 'x'], err));
            ++i;
        }
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    deposit_state *state = fix->state;
    const hs_env *env = fix->env;
    int64_t type, seed;
    bool is_box = false;
    state->n_attempts = 10;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->n_wanted, err));
    HS_TRY(hs_arg_type(args, 1, env->atoms->n_types, &type, err));
    HS_TRY(hs_arg_int(args, 2, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 3, 1, INT32_MAX - 1, &seed, err));
    HS_TRY(read_keywords(fix, args, &is_box, err));
    state->type = (int)type;
    if (state->where.id == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "fix deposit: 'region <region-ID>' must say where atoms are put");
    if (!is_box) {
        state->near *= env->lattice->spacing[0];
        for (int axis = 0; axis < 3; ++axis)
            for (int end = 0; end < 2; ++end) state->v[axis][end] *= env->lattice->spacing[axis];
    }
    hs_park_init(&state->park, (int)seed);
    for (int n = 0; n < N_WARM_UP; ++n) (void)hs_park_uniform(&state->park);
    state->last_id = hs_atoms_max_id(env->atoms);
    hs_parallel_max_int64(env->parallel, &state->last_id, 1);
    state->first = state->next = env->step + 1;
    HS_TRY(find_region(fix, err));
    return env->is_resuming ? HS_OK : check_extent(fix, err);
}

static void destroy(hs_fix *fix) { hs_where_fini(&((deposit_state *)fix->state)->where); }

/** The schedule counts from the step after the fix was defined; a run that begins leaves out what is past. */
static hs_status init(hs_fix *fix, hs_error *err)
{
    deposit_state *state = fix->state;
    state->next = -1;
    if (state->n_added < state->n_wanted)
        state->next = state->first + (fix->env->step - state->first + state->every) / state->every * state->every;
    return find_region(fix, err);
}

static int64_t next_exchange(const hs_fix *fix) { return ((const deposit_state *)fix->state)->next; }

/** A random place in the region, the same on all ranks. */
static hs_status draw_place(hs_fix *fix, double x[3], hs_error *err)
{
    deposit_state *state = fix->state;
    const hs_region *region = state->where.region;
    const double magic = fix->env->position_magic;
    for (int n = 0; n < N_TRIES; ++n) {
        for (int axis = 0; axis < 3; ++axis)
            x[axis] = region->extent[axis][0] +
                      hs_park_uniform(&state->park) * (region->extent[axis][1] - region->extent[axis][0]);
        if (fix->env->box->dimension == 2) x[2] = 0.0;
        if (!hs_region_contains(region, x)) continue;
        for (int axis = 0; axis < 3; ++axis) x[axis] = hs_moved(0.0, x[axis], magic);
        return HS_OK;
    }
    return hs_fail(err, HS_ERROR_RUN, "%s: %d random places are not in the region '%s': it has hardly any volume",
                   hs_fix_who(fix).text, N_TRIES, region->id);
}

/** Whether an atom of any rank is too near to a place (collective). */
static bool is_occupied(const hs_fix *fix, const double x[3])
{
    const deposit_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_box *box = env->box;
    const hs_atoms *atoms = env->atoms;
    const double near2 = state->near * state->near;
    int64_t is_near = 0;
#pragma omp parallel for schedule(static) reduction(| : is_near)
    for (int i = 0; i < atoms->n_local; ++i) {
        double d[3] = {x[0] - atoms->x[0][i], x[1] - atoms->x[1][i], x[2] - atoms->x[2][i]};
        hs_nearest_image(box, d);
        is_near |= d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < near2;
    }
    hs_parallel_max_int64(env->parallel, &is_near, 1);
    return is_near != 0;
}

/** A new atom; one rank has it, and the exchange that follows brings it to the rank that owns its place. */
static hs_status add_atom(hs_fix *fix, const double x[3], const double v[3], hs_error *err)
{
    deposit_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    int64_t max_id = hs_atoms_max_id(atoms);
    hs_parallel_max_int64(fix->env->parallel, &max_id, 1);
    state->last_id = (state->counts_on && state->last_id > max_id ? state->last_id : max_id) + 1;
    if (fix->env->parallel->rank == 0) {
        HS_UNLESS_FAILED(err, hs_atoms_add(atoms, state->last_id, state->type, x, err));
        if (err->status == HS_OK) {
            atoms->mask[atoms->n_local - 1] |= fix->mask;
            for (int axis = 0; axis < 3; ++axis) atoms->v[axis][atoms->n_local - 1] = v[axis];
        }
    }
    HS_TRY(hs_parallel_agree(fix->env->parallel, err));
    ++atoms->n_all;
    hs_env_changed(fix->env);
    return HS_OK;
}

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    deposit_state *state = fix->state;
    bool is_placed = false;
    if (fix->env->step != state->next) return HS_OK;
    for (int64_t n = 0; n < state->n_attempts && !is_placed; ++n) {
        double x[3], v[3];
        HS_TRY(draw_place(fix, x, err));
        if (is_occupied(fix, x)) continue;
        for (int axis = 0; axis < 3; ++axis)
            v[axis] = state->v[axis][0] + hs_park_uniform(&state->park) * (state->v[axis][1] - state->v[axis][0]);
        HS_TRY(add_atom(fix, x, v, err));
        is_placed = true;
    }
    if (is_placed)
        ++state->n_added;
    else
        hs_warn(fix->env->out, "%s: at step %lld no free place was found in %lld attempts", hs_fix_who(fix).text,
                (long long)fix->env->step, (long long)state->n_attempts);
    state->next = state->n_added < state->n_wanted ? state->next + state->every : -1;
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = (double)((const deposit_state *)fix->state)->n_added;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    deposit_state *state = fix->state;
    HS_TRY(hs_state_int64(kept, "added", &state->n_added, 1, err));
    HS_TRY(hs_state_int64(kept, "last id", &state->last_id, 1, err));
    HS_TRY(hs_state_int64(kept, "first", &state->first, 1, err));
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    return hs_state_int(kept, "seed", &state->park.seed, err);
}

const hs_fix_style hs_fix_style_deposit = {
    .about =
        {.name = "deposit",
         .syntax = {.usage = "<N> <type> <M> <seed> region <region-ID> [keyword values ...]",
                    .n_min = 4,
                    .n_max = 4,
                    .keywords = keywords},
         .summary = "add atoms one by one at random places of a region",
         .details =
             "Every M steps an atom of the type is put at a random place in the region, until N have been added. It "
             "belongs to group all and to the fix's group, so that other fixes of that group act on it. A place is "
             "taken when no atom is nearer than `near`; after `attempt` places in vain (a warning says so) the next "
             "try is M steps later. Velocities are even between the bounds of `vx`, `vy` and `vz`. The first atom "
             "comes at the step that follows the fix's definition, if that is one of the next run. Random numbers, and "
             "so places and velocities, are those of LAMMPS with the same seed, whatever the number of ranks.\n\n"
             "The scalar `f_ID` is the number of atoms added. Temperatures of groups that grow need `compute_modify "
             "dynamic/dof yes`.",
         .example = "fix 4 adatoms deposit 100 2 100 12345 region slab near 1.0 vz -1.0 -1.0"},
    .state_size = sizeof(deposit_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .keep_state = keep_state,
    .scalar = scalar,
    .is_time_dependent = true,
};
