/* Changes the lengths and tilts of the box during a run. */
#include <math.h>
#include <string.h>

#include "core/lattice.h"
#include "style/box_change.h"
#include "style/box_shape.h"
#include "style/deform_aim.h"
#include "style/fix.h"

/** The words of the fix: of the paths, in their order, and the others. */
static const char *const words[] = {"x", "y", "z", "xy", "xz", "yz", "remap", "flip", "units", NULL};

typedef struct deform_state {
    hs_box_flow flow; /**< env->box_flow, as long as this fix lives */
    hs_deformation plan;
    double first[3][2], first_tilt[3]; /**< bounds and tilts when the fix was defined, distance */
    bool has_flips;
    int64_t flips
        [3]; /**< since the run began: b is flips[0] a, c flips[1] a + flips[2] b more than the paths say, b as they say */
    int64_t flip_at;     /**< step whose lists are made in a box with other edges; -1: none */
    int64_t flip_now[3]; /**< which: see hs_box_flip */
} deform_state;

static const hs_keyword keywords[] = {
    {"x", -1, "final|delta|scale|vel|erate|trate|volume|wiggle|variable <numbers>", "what the length in x does"},
    {"y", -1, "final|delta|scale|vel|erate|trate|volume|wiggle|variable <numbers>", "in y"},
    {"z", -1, "final|delta|scale|vel|erate|trate|volume|wiggle|variable <numbers>", "in z"},
    {"xy", -1, "final|delta|vel|erate|trate|wiggle|variable <numbers>", "what the tilt of y along x does"},
    {"xz", -1, "final|delta|vel|erate|trate|wiggle|variable <numbers>", "of z along x"},
    {"yz", -1, "final|delta|vel|erate|trate|wiggle|variable <numbers>", "of z along y"},
    {"remap", 1, "x|v|none",
     "atoms of the group go along (x, the default), stay where they are (none), or take another velocity with the "
     "image (v)"},
    {"flip", 1, "yes|no", "a tilt beyond half of the edge gives way to an equivalent one (default: yes)"},
    {"units", 1, "lattice|box", "lengths are in lattice spacings (default) or in distance units"},
    {NULL, 0, NULL, NULL},
};

static hs_status check_axis(const hs_fix *fix, const hs_args *args, int axis, hs_error *err)
{
    const hs_box *box = fix->env->box;
    if (axis >= box->dimension)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d box keeps its length in z", args->command);
    for (int side = 0; side < 2; ++side)
        if (box->boundary[axis][side] == HS_BOUNDARY_SHRINK || box->boundary[axis][side] == HS_BOUNDARY_SHRINK_MIN)
            return hs_fail(
                err, HS_ERROR_INPUT,
                "%s: the faces in %c follow the atoms (boundary s or m), so their length cannot be prescribed",
                args->command, "xyz"[axis]);
    return HS_OK;
}

static hs_status check_volumes(const deform_state *state, const hs_args *args, hs_error *err)
{
    int n_volumes = 0, n_others = 0, n_tilts = 0;
    for (int axis = 0; axis < 3; ++axis) {
        n_volumes += state->plan.path[axis].style == HS_DEFORM_VOLUME;
        n_others += state->plan.path[axis].style != HS_DEFORM_NOT && state->plan.path[axis].style != HS_DEFORM_VOLUME;
        n_tilts += state->plan.path[3 + axis].style != HS_DEFORM_NOT;
    }
    if (n_volumes + n_others + n_tilts == 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: what changes? 'x', 'y', 'z', 'xy', 'xz' or 'yz' must follow",
                       args->command);
    if (n_volumes == 0 || n_others > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: 'volume' needs another axis whose change it makes up for", args->command);
}

/** A length or tilt and what follows it, from word i on; *n_used words. */
static hs_status read_path(hs_fix *fix, const hs_args *args, int i, bool is_box, int *n_used, hs_error *err)
{
    deform_state *state = fix->state;
    int k;
    HS_TRY(hs_arg_choice(args, i, words, &k, err)); /* one of the paths: the caller knows the others */
    const bool is_tilt = k >= 3;
    const int axis = is_tilt ? hs_tilt_first(k - 3) : k;
    HS_TRY(is_tilt ? hs_box_check_tilt_changes(fix->env->box, k - 3, args->command, err)
                   : check_axis(fix, args, k, err));
    HS_TRY(hs_deform_path_read(&state->plan.path[k], args, i + 1, is_tilt,
                               is_box ? 1.0 : fix->env->lattice->spacing[axis], n_used, err));
    ++*n_used;
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const remaps[] = {"x", "v", "none", NULL};
    deform_state *state = fix->state;
    const hs_box *box = fix->env->box;
    bool is_box = false;
    state->plan.who = hs_fix_who(fix);
    state->has_flips = true;
    state->flip_at = -1;
    state->flow.moves_places = fix->mask;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->plan.every, err));
    for (int i = 1; i + 1 < args->n; ++i)
        if (strcmp(args->word[i], "units") == 0) is_box = strcmp(args->word[i + 1], "box") == 0;
    for (int i = 1, n_used; i < args->n; i += n_used) {
        const char *word = args->word[i];
        int remap;
        n_used = 2;
        if (strcmp(word, "remap") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, remaps, &remap, err));
            state->flow.moves_places = remap == 0 ? fix->mask : 0;
            state->flow.moves_velocities = remap == 1 ? fix->mask : 0;
        } else if (strcmp(word, "flip") == 0) {
            HS_TRY(hs_arg_bool(args, i + 1, &state->has_flips, err));
        } else if (strcmp(word, "units") != 0) {
            HS_TRY(read_path(fix, args, i, is_box, &n_used, err));
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        state->first[axis][0] = box->lo[axis];
        state->first[axis][1] = box->hi[axis];
        state->first_tilt[axis] = box->tilt[axis];
        state->flow.sets_length[axis] = state->plan.path[axis].style != HS_DEFORM_NOT;
        state->flow.sets_tilt[axis] = state->plan.path[3 + axis].style != HS_DEFORM_NOT;
    }
    HS_TRY(check_volumes(state, args, err));
    fix->env->box_flow = &state->flow;
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    deform_state *state = fix->state;
    for (int k = 0; k < HS_DEFORM_PATHS; ++k) hs_deform_path_fini(&state->plan.path[k]);
    if (fix->env->box_flow == &state->flow) fix->env->box_flow = NULL;
}

static hs_status check_start(const hs_fix *fix, hs_error *err)
{
    const deform_state *state = fix->state;
    if (fix->env->box_flow == NULL) fix->env->box_flow = &state->flow; /* another one has gone */
    if (fix->env->box_flow != &state->flow)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: another fix deform changes the box, too; one fix can change all lengths and tilts",
                       hs_fix_who(fix).text);
    for (int k = 0; k < HS_DEFORM_PATHS; ++k) HS_TRY(hs_deform_path_check(&state->plan.path[k], fix, err));
    for (int tilt = 0; tilt < 3; ++tilt)
        if (state->plan.path[3 + tilt].style == HS_DEFORM_TRUE_RATE && state->plan.start_tilt[tilt] == 0.0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: '%s trate' multiplies the tilt, which is 0; 'erate' makes it grow from there",
                           hs_fix_who(fix).text, hs_tilt_names[tilt]);
    return HS_OK;
}

/** Atoms that have crossed a face since the lists of the run before were made take the velocity of their image. */
static hs_status pre_force(hs_fix *fix, bool is_setup, hs_error *err)
{
    deform_state *state = fix->state;
    (void)err;
    if (is_setup && state->flow.moves_velocities != 0)
        hs_box_wrap_flowing(fix->env, state->flow.edge, state->flow.moves_velocities);
    return HS_OK;
}

/** The tilts that the paths give, in terms of the edges that the box has after its flips. */
static void add_flips(const deform_state *state, const hs_box *box, hs_deform_aim *to)
{
    const double lx = to->hi[0] - to->lo[0], ly = to->hi[1] - to->lo[1], xy = to->tilt[0];
    const double flipped[3] = {to->tilt[0] + (double)state->flips[0] * lx,
                               to->tilt[1] + (double)state->flips[1] * lx + (double)state->flips[2] * xy,
                               to->tilt[2] + (double)state->flips[2] * ly};
    for (int tilt = 0; tilt < 3; ++tilt)
        to->tilt[tilt] = state->plan.path[3 + tilt].style == HS_DEFORM_NOT ? box->tilt[tilt] : flipped[tilt];
}

/** Edges by which the tilt must be changed to be at most half of the length along its first axis. */
static int64_t excess(const hs_box *box, int tilt, double value)
{
    const int axis = hs_tilt_first(tilt);
    const double edges = value / hs_box_length(box, axis);
    return box->periodic[axis] && fabs(edges) > 0.5 ? -(int64_t)round(edges) : 0;
}

/** Whether a tilt follows a path: as in LAMMPS a box whose lengths alone change keeps the tilts that it has. */
static bool changes_tilts(const hs_deformation *plan)
{
    for (int tilt = 0; tilt < 3; ++tilt)
        if (plan->path[3 + tilt].style != HS_DEFORM_NOT) return true;
    return false;
}

/** Whether the box has become too skewed: then the next step begins in an equivalent one. As in LAMMPS yz comes first,
 *  for it changes xz. */
static void plan_flip(deform_state *state, const hs_env *env)
{
    const hs_box *box = env->box;
    state->flip_now[2] = excess(box, 2, box->tilt[2]);
    state->flip_now[1] = excess(box, 1, box->tilt[1] + (double)state->flip_now[2] * box->tilt[0]);
    state->flip_now[0] = excess(box, 0, box->tilt[0]);
    const bool is_flipped = state->flip_now[0] != 0 || state->flip_now[1] != 0 || state->flip_now[2] != 0;
    state->flip_at = is_flipped ? env->step + 1 : -1;
}

/** A run starts from the present box; a series of runs (`run start`) from that when the fix was defined. */
static hs_status init(hs_fix *fix, hs_error *err)
{
    deform_state *state = fix->state;
    const hs_env *env = fix->env;
    const bool is_single = env->first_step == env->ramp_start;
    for (int axis = 0; axis < 3; ++axis) {
        state->plan.start[axis][0] = is_single ? env->box->lo[axis] : state->first[axis][0];
        state->plan.start[axis][1] = is_single ? env->box->hi[axis] : state->first[axis][1];
        state->plan.start_tilt[axis] = is_single ? env->box->tilt[axis] : state->first_tilt[axis];
        if (is_single) state->flips[axis] = 0;
    }
    state->plan.start_time = env->time_origin + (double)(env->ramp_start - env->time_origin_step) * env->dt;
    if (state->flip_at == env->step + 1)
        plan_flip(state, env); /* as the last step of the run before has, for the box that there is now */
    else
        state->flip_at = -1;
    HS_TRY(check_start(fix, err));
    return hs_deform_begin_flow(&state->plan, env, &state->flow, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    deform_state *state = fix->state;
    hs_env *env = fix->env;
    hs_deform_aim to;
    if (env->step % state->plan.every != 0) return HS_OK;
    HS_TRY(hs_deform_find_aim(&state->plan, env, &to, err));
    add_flips(state, env->box, &to);
    hs_box_change(env, to.lo, to.hi, to.tilt, state->flow.moves_places);
    hs_deform_set_flow(&state->flow, &to);
    if (env->box->is_tilted && state->has_flips && changes_tilts(&state->plan)) plan_flip(state, env);
    return HS_OK;
}

static int64_t next_exchange(const hs_fix *fix) { return ((const deform_state *)fix->state)->flip_at; }

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    deform_state *state = fix->state;
    const bool is_flip = state->flip_at == fix->env->step;
    (void)err;
    if (is_flip) {
        const int64_t *n = state->flip_now;
        state->flips[1] += n[1] + n[2] * state->flips[0];
        state->flips[0] += n[0];
        state->flips[2] += n[2];
        hs_box_flip(fix->env, (const int32_t[3]){(int32_t)n[0], (int32_t)n[1], (int32_t)n[2]});
        state->flip_at = -1;
    }
    if (is_flip || state->flow.moves_velocities != 0)
        hs_box_wrap_flowing(fix->env, state->flow.edge, state->flow.moves_velocities);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    static const char *const first[] = {"first x", "first y", "first z"}, *const start[] = {"start x", "start y",
                                                                                            "start z"};
    deform_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_state_double(kept, first[axis], state->first[axis], 2, err));
        HS_TRY(hs_state_double(kept, start[axis], state->plan.start[axis], 2, err));
    }
    HS_TRY(hs_state_double(kept, "start time", &state->plan.start_time, 1, err));
    HS_TRY(hs_state_double(kept, "flow", &state->flow.edge[0][0], 9, err));
    HS_TRY(hs_state_double(kept, "flow of the corner", state->flow.corner, 3, err));
    if (!fix->env->box->is_tilted) return HS_OK;
    HS_TRY(hs_state_double(kept, "first tilt", state->first_tilt, 3, err));
    HS_TRY(hs_state_double(kept, "start tilt", state->plan.start_tilt, 3, err));
    HS_TRY(hs_state_int64(kept, "flips", state->flips, 3, err));
    HS_TRY(hs_state_int64(kept, "step of the next flip", &state->flip_at, 1, err));
    return hs_state_int64(kept, "next flip", state->flip_now, 3, err);
}

const hs_fix_style hs_fix_style_deform = {
    .about =
        {.name = "deform",
         .syntax = {.usage = "<N> <x|y|z|xy|xz|yz> <style> <numbers> [<x|y|z|xy|xz|yz> ...] [keyword value ...]",
                    .n_min = 1,
                    .n_max = 1,
                    .keywords = keywords},
         .summary = "change the lengths and tilts of the box during a run",
         .details =
             "At multiples of N steps the box gets the lengths and tilts that the styles of its axes give; axes that "
             "are not named keep theirs. Over the run (or from `run start` to `stop`) `final <lo> <hi>` brings the "
             "bounds to these places, `delta <dlo> <dhi>` moves them by so much, `scale <factor>` multiplies the "
             "length. At constant velocity `vel <V>` makes the box longer by V a unit of time; `erate <R>` by R times "
             "the first length, `trate <R>` by R times the present length; `wiggle <A> <Tp>` by A sin(2 pi t/Tp); "
             "`variable v_name v_rate` by the value of an equal-style variable (distance units), the second of which "
             "is its rate. `volume` makes up for the others that the fix changes, so that the volume stays; two such "
             "axes share that. All but final and delta keep the middle of the box.\n\n"
             "Tilts need a tilted (triclinic) box, which may have tilts of 0: of `create_box` with a prism, of "
             "`read_data`, or of `change_box all triclinic`. `xy` has the styles `final <tilt>`, `delta <dtilt>`, `vel "
             "<V>`, `erate <R>` (the tilt grows by R times the box's first length in y a unit of time: R is the shear "
             "rate), `trate <R>` (by R times the tilt), `wiggle` and `variable`; so have `xz` and `yz`. A tilt of more "
             "than half of the length in x (`yz`: in y) gives way to an equivalent one with the next neighbor lists, "
             "unless `flip no` is said.\n\n"
             "With `remap x` the atoms of the group go along, each keeping its fractions of the box: velocities stay. "
             "With `remap v` atoms of the group that cross a periodic face take the velocity of their image: right for "
             "flows, with `fix nvt/sllod` or `compute temp/deform`. With `remap none` nothing happens to them, and new "
             "pairs come about at periodic faces. The fix moves nothing else: use it with `fix nve` or another "
             "integrator; a barostat may act on the axes that it leaves alone. docs/shear-flow.md has an example. A "
             "deck has one fix deform.\n\nThe box changes at the end of a step, when its forces are known: energies "
             "and virials of the step, also those of `pe/atom`, `stress/atom` and fixes, are of the places before, as "
             "in LAMMPS.",
         .example = "fix 2 all deform 1 x erate 0.001 y volume z volume\nfix 3 all deform 10 z scale 0.5 units "
                    "box\nfix 4 all deform 1 xy erate 0.05 remap v"},
    .state_size = sizeof(deform_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .pre_force = pre_force,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .is_time_dependent = true,
    .changes_box = true,
    .moves_at_end = true,
};
