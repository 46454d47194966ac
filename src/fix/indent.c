/* A stiff sphere, cylinder or plane that pushes atoms away:  F = K (r - R)^2 within the indenter, E = K/3 |r - R|^3. */
#include <math.h>
#include <string.h>

#include "base/wide.h"
#include "core/lattice.h"
#include "style/box_shape.h"
#include "style/nearest_image.h"
#include "style/shown_sums.h"
#include "style/varying.h"

typedef enum { INDENT_SPHERE, INDENT_CYLINDER, INDENT_PLANE } indent_shape;

typedef struct indent_state {
    hs_late_sums sums; /**< first, for shown_sums.h: force on the indenter, and energy */
    double k;          /**< force/distance^2 */
    indent_shape shape;
    bool has_shape, is_inside;   /**< side in: keeps atoms within */
    int axis;                    /**< of the cylinder; normal of the plane */
    int side;                    /**< plane: -1 pushes down what is above, 1 up what is below */
    hs_varying place[3], radius; /**< distance; of the deck's words only the numbers may be in lattice spacings */
} indent_state;

static const hs_keyword keywords[] = {
    {"sphere", 4, "<x> <y> <z> <R>", "a sphere; numbers may be equal-style variables v_name"},
    {"cylinder", 4, "<x|y|z> <c1> <c2> <R>", "a cylinder along an axis, through the place (c1, c2) of the others"},
    {"plane", 3, "<x|y|z> <position> <lo|hi>", "a plane that pushes atoms from the low or the high side"},
    {"side", 1, "in|out", "push atoms out (default), or keep them in"},
    {"units", 1, "lattice|box", "lengths are in lattice spacings (default) or in distance units"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_length(hs_varying *length, const hs_args *args, int i, double scale, hs_error *err)
{
    HS_TRY(hs_varying_read(length, args, i, err));
    if (length->variable == NULL) length->value *= scale;
    return HS_OK;
}

static hs_status read_shape(hs_fix *fix, const hs_args *args, int i, const double scale[3], hs_error *err)
{
    static const char *const axes[] = {"x", "y", "z", NULL}, *const sides[] = {"lo", "hi", NULL};
    indent_state *state = fix->state;
    int side;
    state->has_shape = true;
    if (strcmp(args->word[i], "sphere") == 0) {
        state->shape = INDENT_SPHERE;
        for (int axis = 0; axis < 3; ++axis)
            HS_TRY(read_length(&state->place[axis], args, i + 1 + axis, scale[axis], err));
        return read_length(&state->radius, args, i + 4, scale[0], err);
    }
    HS_TRY(hs_arg_choice(args, i + 1, axes, &state->axis, err));
    if (strcmp(args->word[i], "plane") == 0) {
        state->shape = INDENT_PLANE;
        HS_TRY(hs_arg_choice(args, i + 3, sides, &side, err));
        state->side = side == 0 ? 1 : -1;
        return read_length(&state->place[state->axis], args, i + 2, scale[state->axis], err);
    }
    state->shape = INDENT_CYLINDER;
    const int first = state->axis == 0 ? 1 : 0, second = state->axis == 2 ? 1 : 2;
    HS_TRY(read_length(&state->place[first], args, i + 2, scale[first], err));
    HS_TRY(read_length(&state->place[second], args, i + 3, scale[second], err));
    return read_length(&state->radius, args, i + 4, scale[first], err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    indent_state *state = fix->state;
    double scale[3];
    bool is_box = false;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_double(args, 0, &state->k, err));
    for (int i = 1; i + 1 < args->n; ++i)
        if (strcmp(args->word[i], "units") == 0) is_box = strcmp(args->word[i + 1], "box") == 0;
    for (int axis = 0; axis < 3; ++axis) scale[axis] = is_box ? 1.0 : fix->env->lattice->spacing[axis];
    for (int i = 1; i < args->n;) {
        const char *word = args->word[i];
        const int n = strcmp(word, "plane") == 0 ? 4 : strcmp(word, "side") == 0 || strcmp(word, "units") == 0 ? 2 : 5;
        if (n > 2) HS_TRY(read_shape(fix, args, i, scale, err));
        if (strcmp(word, "side") == 0) state->is_inside = strcmp(args->word[i + 1], "in") == 0;
        i += n;
    }
    if (state->has_shape) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: what pushes? 'sphere', 'cylinder' or 'plane' must follow", args->command);
}

static void destroy(hs_fix *fix)
{
    indent_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis) hs_varying_fini(&state->place[axis]);
    hs_varying_fini(&state->radius);
}

/** An endless cylinder goes on into its own image where it leaves the box: the edge along its axis must not lean. */
static hs_status check_axis(const hs_fix *fix, hs_error *err)
{
    const indent_state *state = fix->state;
    const hs_box *box = fix->env->box;
    for (int k = 0; k < 3 && state->shape == INDENT_CYLINDER; ++k)
        if (hs_tilt_second(k) == state->axis && box->tilt[k] != 0.0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: a cylinder along %c does not meet its own images in a box with the tilt %s (%g); one "
                           "along x always does",
                           hs_fix_who(fix).text, "xyz"[state->axis], hs_tilt_names[k], box -> tilt[k]);
    return HS_OK;
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const indent_state *state = fix->state;
    HS_TRY(check_axis(fix, err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_varying_check(&state->place[axis], fix, err));
    return hs_varying_check(&state->radius, fix, err);
}

/** The indenter at the present step, as the loop over atoms wants it. */
typedef struct indenter {
    const hs_fix *fix;
    const indent_state *state;
    double length[3]; /**< of the box where the nearest image counts along each axis, else INFINITY */
    bool is_tilted;   /**< it counts in a tilted box: */
    hs_box box;       /**< that, seen along the axis of a cylinder */
    bool counts[3];   /**< axes along which distance counts */
    double radius2;
} indenter;

static indenter indenter_now(const hs_fix *fix)
{
    const indent_state *state = fix->state;
    const hs_box *box = fix->env->box;
    indenter now = {.fix = fix, .state = state, .radius2 = state->radius.value * state->radius.value};
    now.is_tilted = box->is_tilted && state->shape != INDENT_PLANE;
    now.box = *box;
    for (int k = 0; k < 3 && state->shape == INDENT_CYLINDER; ++k)
        if (hs_tilt_first(k) == state->axis) now.box.tilt[k] = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_of_axis = axis == state->axis;
        now.counts[axis] = state->shape == INDENT_SPHERE || is_of_axis == (state->shape == INDENT_PLANE);
        now.length[axis] = state->shape != INDENT_PLANE && !box->is_tilted && box->periodic[axis]
                               ? hs_box_length(box, axis)
                               : INFINITY;
    }
    return now;
}

static inline double distance_along(const indenter *now, int axis, double x)
{
    const double d = x - now->state->place[axis].value, period = now->length[axis];
    return fabs(d) > 0.5 * period ? d - copysign(period, d) : d;
}

/** Force on local atom i, and its energy; false: there is none. */
static inline bool force_of(const indenter *now, const hs_atoms *atoms, int i, double f[3], double *energy)
{
    const indent_state *state = now->state;
    double d[3] = {0.0}, r2 = 0.0, depth;
    for (int axis = 0; axis < 3; ++axis)
        if (now->counts[axis]) d[axis] = distance_along(now, axis, atoms->x[axis][i]);
    if (now->is_tilted) hs_nearest_image(&now->box, d);
    for (int axis = 0; axis < 3; ++axis) r2 += d[axis] * d[axis];
    if (state->shape == INDENT_PLANE) {
        depth = state->side * -d[state->axis]; /* how far it is on the wrong side */
        if (depth <= 0.0) return false;
        for (int axis = 0; axis < 3; ++axis) f[axis] = 0.0;
        f[state->axis] = state->side * state->k * depth * depth;
    } else {
        if (r2 == 0.0 || (state->is_inside ? r2 <= now->radius2 : r2 >= now->radius2)) return false;
        const double r = sqrt(r2), sign = state->is_inside ? -1.0 : 1.0;
        depth = sign * (state->radius.value - r);
        for (int axis = 0; axis < 3; ++axis) f[axis] = sign * state->k * depth * depth * d[axis] / r;
    }
    *energy = state->k / 3.0 * depth * depth * depth;
    return true;
}

/** Squared distances of the atoms [begin, end) from the indenter, along the axes that count. */
HS_WIDE static void find_distances(const indenter *now, const hs_atoms *atoms, int begin, int end, double *r2)
{
    memset(r2, 0, (size_t)(end - begin) * sizeof *r2);
    for (int axis = 0; axis < 3; ++axis) {
        const double *x = atoms->x[axis];
        if (!now->counts[axis]) continue;
        for (int i = begin; i < end; ++i) {
            const double d = distance_along(now, axis, x[i]);
            r2[i - begin] += d * d;
        }
    }
}

/** Add the forces, and up what they are: most atoms are far from the indenter and have none. */
static void push(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const indenter *now = context;
    const bool is_inside = now->state->is_inside, is_plane = now->state->shape == INDENT_PLANE;
    const bool takes_all = is_plane || now->is_tilted;
    double r2[HS_EXACT_ARRAY_MAX];
    if (!takes_all) find_distances(now, atoms, begin, end, r2);
    for (int i = begin; i < end; ++i) {
        double f[3], energy;
        const bool is_touched = takes_all || (is_inside ? r2[i - begin] > now->radius2 : r2[i - begin] < now->radius2);
        if (!is_touched || !(atoms->mask[i] & now->fix->mask) || !force_of(now, atoms, i, f, &energy)) continue;
        hs_exact_add(&sums[HS_SHOWN_ENERGY], energy);
        for (int axis = 0; axis < 3; ++axis) {
            hs_exact_add(&sums[axis], -f[axis]);
            atoms->f[axis][i] += f[axis];
        }
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    indent_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_varying_update(&state->place[axis], fix->env, err));
    HS_TRY(hs_varying_update(&state->radius, fix->env, err));
    if (fix->env->box->is_tilted) HS_TRY(check_axis(fix, err)); /* tilts may change */
    const indenter now = indenter_now(fix);
    hs_late_sums_make(&state->sums, fix->env->atoms, push, &now, HS_N_SHOWN);
    return HS_OK;
}

const hs_fix_style hs_fix_style_indent = {
    .about = {.name = "indent",
              .syntax = {.usage = "<K> sphere|cylinder|plane <words> [keyword value ...]",
                         .n_min = 1,
                         .n_max = 1,
                         .keywords = keywords},
              .summary = "a sphere, cylinder or plane that pushes atoms away",
              .details = "An atom that is within the indenter by a depth d feels the force K d^2 away from its center "
                         "(axis, plane); the energy is K d^3/3; K has units of force/distance^2. With `side in` the "
                         "indenter is a container, which pushes atoms inward that are outside of it. `plane <axis> "
                         "<position> hi` pushes atoms above the position down, `lo` atoms below it up. Places and "
                         "radius may be equal-style variables `v_name`, evaluated at each step, so that the indenter "
                         "moves; their values are in distance units. In a tilted box a cylinder is along an edge: "
                         "along x, along y unless there is a tilt xy, along z unless there are xz or yz.\n\n"
                         "The scalar `f_ID` is the energy, the vector `f_ID[1]` to `f_ID[3]` the force on the "
                         "indenter. `fix_modify energy yes` adds the energy to the potential energy.",
              .example = "variable y equal 13.0-0.02*step*dt\nfix 4 all indent 1000.0 sphere 10 v_y 0 5.0\n"
                         "fix 5 all indent 10.0 cylinder z 10 10 8.0 side in units box"},
    .state_size = sizeof(indent_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .post_force = post_force,
    .acts_in_minimize = true,
    HS_SHOWN_HOOKS,
    .allows_dynamic_group = true,
};
