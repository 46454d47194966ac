/* Changes the lengths of the box during a run. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/lattice.h"
#include "style/box_change.h"
#include "style/fix.h"

typedef enum { NOT, FINAL, DELTA, SCALE, VELOCITY, RATE, TRUE_RATE, VOLUME, WIGGLE, VARIABLE } deform_style;
static const char *const style_names[] = {"final", "delta",  "scale",  "vel",      "erate",
                                          "trate", "volume", "wiggle", "variable", NULL};

/** What happens to one axis. */
typedef struct deform_axis {
    deform_style style;
    double number[2]; /**< of the style; lengths in distance */
    char *variable;   /**< owned; equal-style variable: change of the length, distance */
    double first[2];  /**< bounds when the fix was defined, */
    double start[2];  /**< and when the run (or series of runs) began */
} deform_axis;

typedef struct deform_state {
    int64_t every;
    deform_axis axis[3];
    bool moves_atoms;
} deform_state;

static const hs_keyword keywords[] = {
    {"x", -1, "final|delta|scale|vel|erate|trate|volume|wiggle|variable <numbers>", "what the length in x does"},
    {"y", -1, "final|delta|scale|vel|erate|trate|volume|wiggle|variable <numbers>", "in y"},
    {"z", -1, "final|delta|scale|vel|erate|trate|volume|wiggle|variable <numbers>", "in z"},
    {"remap", 1, "x|v|none", "whether atoms of the group go along (x, the default) or stay where they are (none)"},
    {"units", 1, "lattice|box", "lengths are in lattice spacings (default) or in distance units"},
    {"xy", -1, "<words>", "refused: boxes are not tilted"},
    {"xz", -1, "<words>", "refused"},
    {"yz", -1, "<words>", "refused"},
    {"flip", 1, "yes|no", "refused"},
    {NULL, 0, NULL, NULL},
};

static hs_status check_axis(const hs_fix *fix, const hs_args *args, int axis, hs_error *err)
{
    const hs_box *box = fix->env->box;
    if (axis >= box->dimension)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d box keeps its length in z", args->command);
    for (int side = 0; side < 2; ++side)
        if (box->boundary[axis][side] == HS_BOUNDARY_SHRINK || box->boundary[axis][side] == HS_BOUNDARY_SHRINK_MIN)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the faces in %c follow the atoms (boundary s or m), so their "
                           "length cannot be prescribed",
                           args->command, "xyz"[axis]);
    return HS_OK;
}

/** An axis and what follows it, from word i on; *n_used words. */
static hs_status read_axis(hs_fix *fix, const hs_args *args, int i, double unit, int *n_used, hs_error *err)
{
    static const int n_numbers[] = {0, 2, 2, 1, 1, 1, 1, 0, 2, 2};
    deform_state *state = fix->state;
    deform_axis *a = &state->axis[args->word[i][0] - 'x'];
    int style;
    HS_TRY(check_axis(fix, args, args->word[i][0] - 'x', err));
    HS_TRY(hs_arg_choice(args, i + 1, style_names, &style, err));
    a->style = (deform_style)(style + 1);
    const int n = n_numbers[a->style];
    *n_used = 2 + n;
    HS_TRY(hs_arg_need(args, i + 1 + n, "a number", err));
    if (a->style == VARIABLE) { /* the second variable, a rate, is for remap v, which there is not */
        if (strncmp(args->word[i + 2], "v_", 2) != 0)
            return hs_arg_refuse(args, i + 2, "an equal-style variable (v_name)", NULL, err);
        HS_FREE(a->variable);
        return hs_memory_strdup(&a->variable, args->word[i + 2] + 2, err);
    }
    for (int k = 0; k < n; ++k) {
        const bool is_length =
            a->style == FINAL || a->style == DELTA || a->style == VELOCITY || (a->style == WIGGLE && k == 0);
        HS_TRY(hs_arg_double(args, i + 2 + k, &a->number[k], err));
        if (is_length) a->number[k] *= unit;
    }
    if (a->style == SCALE && !(a->number[0] > 0.0)) return hs_arg_refuse(args, i + 2, "a factor above 0", NULL, err);
    if (a->style == WIGGLE && !(a->number[1] > 0.0)) return hs_arg_refuse(args, i + 3, "a period above 0", NULL, err);
    return HS_OK;
}

static hs_status refuse(const hs_args *args, int i, hs_error *err)
{
    if (strcmp(args->word[i], "remap") == 0 && strcmp(args->word[i + 1], "v") == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: 'remap v' belongs to fix nvt/sllod, which this version does not have; 'remap x' moves the "
                       "atoms with the box",
                       args->command);
    if (strcmp(args->word[i], "remap") == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: '%s' is about tilted boxes, which this version does not have; x, y and z change the lengths of "
                   "the box",
                   args->command, args->word[i]);
}

static hs_status check_volumes(const deform_state *state, const hs_args *args, hs_error *err)
{
    int n_volumes = 0, n_others = 0;
    for (int axis = 0; axis < 3; ++axis) {
        n_volumes += state->axis[axis].style == VOLUME;
        n_others += state->axis[axis].style != NOT && state->axis[axis].style != VOLUME;
    }
    if (n_volumes + n_others == 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: what changes? 'x', 'y' or 'z' must follow", args->command);
    if (n_volumes == 0 || n_others > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: 'volume' needs another axis whose change it makes up for", args->command);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    deform_state *state = fix->state;
    bool is_box = false;
    state->moves_atoms = true;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    for (int i = 1; i + 1 < args->n; ++i)
        if (strcmp(args->word[i], "units") == 0) is_box = strcmp(args->word[i + 1], "box") == 0;
    for (int i = 1, n_used; i < args->n; i += n_used) {
        const char *word = args->word[i];
        n_used = 2;
        if (strlen(word) == 1) {
            const int axis = word[0] - 'x';
            HS_TRY(read_axis(fix, args, i, is_box ? 1.0 : fix->env->lattice->spacing[axis], &n_used, err));
        } else if (strcmp(word, "units") != 0) {
            HS_TRY(refuse(args, i, err));
            state->moves_atoms = strcmp(args->word[i + 1], "x") == 0;
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        state->axis[axis].first[0] = fix->env->box->lo[axis];
        state->axis[axis].first[1] = fix->env->box->hi[axis];
    }
    return check_volumes(state, args, err);
}

static void destroy(hs_fix *fix)
{
    for (int axis = 0; axis < 3; ++axis) HS_FREE(((deform_state *)fix->state)->axis[axis].variable);
}

/** A run starts from the present box; a series of runs (`run start`) from that when the fix was defined. */
static hs_status init(hs_fix *fix, hs_error *err)
{
    deform_state *state = fix->state;
    const hs_env *env = fix->env;
    for (int axis = 0; axis < 3; ++axis) {
        deform_axis *a = &state->axis[axis];
        const bool is_single = env->first_step == env->ramp_start;
        a->start[0] = is_single ? env->box->lo[axis] : a->first[0];
        a->start[1] = is_single ? env->box->hi[axis] : a->first[1];
        if (a->variable != NULL && (env->variable_kind == NULL || env->variable_kind(env->deck, a->variable) != 1))
            return hs_fail(err, HS_ERROR_INPUT, "fix '%s' (deform): there is no equal-style variable '%s'", fix->id,
                           a->variable);
    }
    return HS_OK;
}

/** How much longer an axis is than at the start, the same at both ends; 0 for final and delta, which have ends of their own. */
static hs_status growth_of(const hs_env *env, const deform_axis *a, double *growth, hs_error *err)
{
    const double length = a->start[1] - a->start[0], time = (double)(env->step - env->ramp_start) * env->dt;
    switch (a->style) {
    case SCALE:
        *growth = hs_env_ramp(env) * (a->number[0] - 1.0) * length;
        return HS_OK;
    case VELOCITY:
        *growth = time * a->number[0];
        return HS_OK;
    case RATE:
        *growth = time * a->number[0] * length;
        return HS_OK;
    case TRUE_RATE:
        *growth = length * (exp(a->number[0] * time) - 1.0);
        return HS_OK;
    case WIGGLE:
        *growth = a->number[0] * sin(2.0 * M_PI * time / a->number[1]);
        return HS_OK;
    case VARIABLE:
        return env->variable_value(env->deck, a->variable, growth, err);
    default:
        *growth = 0.0;
        return HS_OK;
    }
}

/** Bounds of an axis at the present step; not of those that keep the volume. */
static hs_status bounds_of(const hs_env *env, const deform_axis *a, double *lo, double *hi, hs_error *err)
{
    const double done = hs_env_ramp(env);
    double growth, end[2];
    HS_TRY(growth_of(env, a, &growth, err));
    for (int side = 0; side < 2; ++side) {
        end[side] = a->start[side] + (side == 0 ? -0.5 : 0.5) * growth;
        if (a->style == FINAL) end[side] = a->start[side] + done * (a->number[side] - a->start[side]);
        if (a->style == DELTA) end[side] = a->start[side] + done * a->number[side];
    }
    *lo = end[0];
    *hi = end[1];
    return HS_OK;
}

/** The axes that keep the volume make up for the others; two of them share that. */
static void keep_volume(const deform_state *state, double lo[3], double hi[3])
{
    double ratio = 1.0; /* volume at the start over that which the other axes would give */
    int n_volumes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const deform_axis *a = &state->axis[axis];
        n_volumes += a->style == VOLUME;
        if (a->style != VOLUME) ratio *= (a->start[1] - a->start[0]) / (hi[axis] - lo[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const deform_axis *a = &state->axis[axis];
        if (a->style != VOLUME) continue;
        const double middle = 0.5 * (a->start[0] + a->start[1]),
                     half = 0.5 * (a->start[1] - a->start[0]) * (n_volumes == 2 ? sqrt(ratio) : ratio);
        lo[axis] = middle - half;
        hi[axis] = middle + half;
    }
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const deform_state *state = fix->state;
    hs_env *env = fix->env;
    double lo[3], hi[3];
    if (env->step % state->every != 0) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = env->box->lo[axis];
        hi[axis] = env->box->hi[axis];
        if (state->axis[axis].style != NOT) HS_TRY(bounds_of(env, &state->axis[axis], &lo[axis], &hi[axis], err));
        if (!(hi[axis] > lo[axis]))
            return hs_fail(err, HS_ERROR_RUN, "fix '%s' (deform): at step %lld the box would reach from %g to %g in %c",
                           fix->id, (long long)env->step, lo[axis], hi[axis], "xyz"[axis]);
    }
    keep_volume(state, lo, hi);
    hs_box_change(env, lo, hi, NULL, state->moves_atoms ? fix->mask : 0);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    static const char *const first[] = {"first x", "first y", "first z"}, *const start[] = {"start x", "start y",
                                                                                            "start z"};
    deform_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_state_double(kept, first[axis], state->axis[axis].first, 2, err));
        HS_TRY(hs_state_double(kept, start[axis], state->axis[axis].start, 2, err));
    }
    return HS_OK;
}

const hs_fix_style hs_fix_style_deform = {
    .about =
        {.name = "deform",
         .syntax = {.usage = "<N> <x|y|z> <style> <numbers> [<x|y|z> ...] [keyword value ...]",
                    .n_min = 1,
                    .n_max = 1,
                    .keywords = keywords},
         .summary = "change the lengths of the box during a run",
         .details =
             "At multiples of N steps the box gets the lengths that the styles of its axes give; axes that are not "
             "named "
             "keep theirs. Over the run (or from `run start` to `stop`) `final <lo> <hi>` brings the bounds to these "
             "places, `delta <dlo> <dhi>` moves them by so much, `scale <factor>` multiplies the length. At constant "
             "velocity `vel <V>` makes the box longer by V a unit of time; `erate <R>` by R times the first length, "
             "`trate <R>` by R times the present length; `wiggle <A> <Tp>` by A sin(2 pi t/Tp); `variable v_name "
             "v_rate` by "
             "the value of an equal-style variable (distance units; the second is not used). `volume` makes up for the "
             "others, so that the volume stays; two such axes share that. All but final and delta keep the middle of "
             "the box.\n\n"
             "With `remap x` the atoms of the group go along, each keeping its fractions of the box: velocities stay. "
             "With "
             "`remap none` they stay, and new pairs come about at periodic faces. The fix moves nothing else: use it "
             "with "
             "`fix nve` or another integrator, and do not let fix npt change the same axis. Tilted boxes are not "
             "supported.",
         .example = "fix 2 all deform 1 x erate 0.001 y volume z volume\nfix 3 all deform 10 z scale 0.5 units box"},
    .state_size = sizeof(deform_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .is_time_dependent = true,
    .changes_box = true,
};
