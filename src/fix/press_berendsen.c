/* Weak coupling to a bath of constant pressure: at each step the lengths of the box, and the atoms' places in it, are
 * scaled by
 *     (1 - (dt/Pdamp) (P_wanted - P) / modulus)^(1/3).
 * Source: H. J. C. Berendsen et al., J. Chem. Phys. 81, 3684 (1984), doi:10.1063/1.448118, eq. (21), with the bulk
 * modulus in the place of 1/compressibility. */
#include <math.h>
#include <string.h>

#include "style/barometer.h"
#include "style/box_change.h"
#include "style/box_flow.h"
#include "style/upright.h"

typedef struct press_state {
    hs_barometer barometer;
    bool moves[3];
    double start[3], stop[3], damping[3]; /**< pressure, pressure, time */
    double modulus;                       /**< pressure */
    uint32_t dilate;                      /**< group bits of the atoms that follow the box */
} press_state;

static const hs_keyword keywords[] = {
    {"iso", 3, "<Pstart> <Pstop> <Pdamp>", "all lengths change alike, by the scalar pressure"},
    {"aniso", 3, "<Pstart> <Pstop> <Pdamp>", "each length changes by the pressure along it"},
    {"x", 3, "<Pstart> <Pstop> <Pdamp>", "the length in x changes by the pressure along x"},
    {"y", 3, "<Pstart> <Pstop> <Pdamp>", "y"},
    {"z", 3, "<Pstart> <Pstop> <Pdamp>", "z"},
    {"couple", 1, "none|xyz|xy|yz|xz", "axes whose lengths change alike, by the mean of their pressures"},
    {"modulus", 1, "<pressure>", "the bulk modulus of the system, about (default: 10)"},
    {"dilate", 1, "all|partial", "partial: only atoms of the fix's group follow the box (default: all)"},
    {NULL, 0, NULL, NULL},
};

/* ---- Words ---- */

static hs_status read_axis(hs_fix *fix, const hs_args *args, int i, int axis, hs_error *err)
{
    press_state *state = fix->state;
    const hs_box *box = fix->env->box;
    if (axis >= box->dimension)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d system has no pressure along z", args->command);
    if (!box->periodic[axis])
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: the box is not periodic in %c, so its length cannot follow a pressure ('boundary' makes it periodic)",
            args->command, "xyz"[axis]);
    state->moves[axis] = true;
    HS_TRY(hs_arg_double(args, i + 1, &state->start[axis], err));
    HS_TRY(hs_arg_double(args, i + 2, &state->stop[axis], err));
    return hs_arg_positive(args, i + 3, &state->damping[axis], err);
}

/** A keyword and what follows it; *n_used words. */
static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, int *n_used, hs_error *err)
{
    press_state *state = fix->state;
    const char *word = args->word[i];
    int choice;
    *n_used = 2;
    if (strcmp(word, "modulus") == 0) return hs_arg_positive(args, i + 1, &state->modulus, err);
    if (strcmp(word, "dilate") == 0) {
        state->dilate = strcmp(args->word[i + 1], "all") == 0 ? hs_group_mask(0) : fix->mask;
        return HS_OK;
    }
    if (strcmp(word, "couple") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, hs_couplings, &choice, err));
        hs_barometer_couple(&state->barometer, choice);
        return HS_OK;
    }
    *n_used = 4;
    if (word[1] == '\0') return read_axis(fix, args, i, word[0] - 'x', err);
    hs_barometer_couple(&state->barometer, word[0] == 'i');
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) HS_TRY(read_axis(fix, args, i, axis, err));
    return HS_OK;
}

static hs_status check_axes(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    const press_state *s = fix->state;
    int first = -1;
    if (!s->moves[0] && !s->moves[1] && !s->moves[2])
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: a pressure is missing: 'iso <Pstart> <Pstop> <Pdamp>', aniso, x, y or z", args->command);
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        if (!s->barometer.is_coupled[axis]) continue;
        if (first < 0) first = axis;
        if (!s->moves[axis])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the coupled axis %c has no pressure; '%c <Pstart> <Pstop> <Pdamp>' gives it one",
                           args->command, "xyz"[axis], "xyz"[axis]);
        if (s->start[axis] != s->start[first] || s->stop[axis] != s->stop[first] ||
            s->damping[axis] != s->damping[first])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: coupled axes must have the same pressures and damping times, and %c and %c have not",
                           args->command, "xyz"[first], "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    press_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    state->modulus = 10.0;
    state->dilate = hs_group_mask(0);
    for (int i = 0, n_used; i < args->n; i += n_used) HS_TRY(read_keyword(fix, args, i, &n_used, err));
    HS_TRY(check_axes(fix, args, err));
    const bool *is_coupled = state->barometer.is_coupled;
    state->barometer.is_iso = is_coupled[0] && is_coupled[1] && (is_coupled[2] || fix->env->box->dimension == 2);
    return hs_barometer_create(fix, "temp", false, err);
}

static void destroy(hs_fix *fix) { hs_barometer_fini(&((press_state *)fix->state)->barometer); }

static hs_status set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    return hs_barometer_set_temperature(fix, &((press_state *)fix->state)->barometer, id, err);
}

static hs_status set_pressure(hs_fix *fix, const char *id, hs_error *err)
{
    return hs_barometer_set_pressure(&((press_state *)fix->state)->barometer, id, err);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const press_state *state = fix->state;
    const hs_env *env = fix->env;
    HS_TRY(hs_need_upright(env, "fix press/berendsen", err));
    for (int axis = 0; axis < 3; ++axis)
        if (state->moves[axis] && env->box_flow != NULL && env->box_flow->sets_length[axis])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the length in %c is what fix deform makes it, and cannot follow a pressure, too",
                           hs_fix_who(fix).text, "xyz"[axis]);
    return hs_barometer_init(fix, &state->barometer, err);
}

/* ---- Steps ---- */

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const press_state *state = fix->state;
    hs_env *env = fix->env;
    double p[6], lo[3], hi[3];
    HS_TRY(hs_barometer_read(fix, &state->barometer, p, err));
    for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = env->box->lo[axis];
        hi[axis] = env->box->hi[axis];
        if (!state->moves[axis]) continue;
        const double wanted = state->start[axis] + hs_env_ramp(env) * (state->stop[axis] - state->start[axis]),
                     growth = 1.0 - env->dt / state->damping[axis] * (wanted - p[axis]) / state->modulus,
                     center = 0.5 * (lo[axis] + hi[axis]);
        if (!(growth > 0.0))
            return hs_fail(err, HS_ERROR_RUN,
                           "%s: at step %lld the pressure along %c, %g, is so far from %g that the box would vanish; a "
                           "longer damping time or a larger modulus is needed",
                           hs_fix_who(fix).text, (long long)env->step, "xyz"[axis], p[axis], wanted);
        lo[axis] = center + cbrt(growth) * (lo[axis] - center);
        hi[axis] = center + cbrt(growth) * (hi[axis] - center);
    }
    hs_box_change(env, lo, hi, NULL, state->dilate);
    return HS_OK;
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    (void)fix;
    (void)step;
    return true;
}

const hs_fix_style hs_fix_style_press_berendsen = {
    .about = {.name = "press/berendsen",
              .syntax = {"<iso|aniso|x|y|z> <Pstart> <Pstop> <Pdamp> [keyword value ...]", 0, 0, keywords},
              .summary = "Berendsen's barostat: let the pressure decay to a wanted one",
              .details =
                  "At the end of every step the lengths of the box are scaled by the third root of 1 - (dt/Pdamp) (P - "
                  "p)/modulus, with the pressure p measured and P wanted (a ramp over the run), and the atoms with "
                  "them, as their fractions of it. `iso` changes all lengths alike, by the scalar pressure; `aniso` "
                  "and `x`, `y`, `z` each by its own; `couple` gives some the mean of theirs. It moves no atoms "
                  "otherwise: fix nve, or another that does, stands beside it. The pressure relaxes in about Pdamp, a "
                  "time, if `modulus` is the bulk modulus of the system; 10 is right for a Lennard-Jones liquid only. "
                  "The fluctuations of the volume are those of no ensemble: for equilibration, not for measuring them "
                  "(fix npt). The box must be orthogonal and periodic along the axes that change.\n\nThe fix makes the "
                  "computes `ID_temp` and `ID_press`, both of all atoms; `fix_modify temp` and `press` take others. "
                  "Energies and virials are computed at every step.",
              .reference = "H. J. C. Berendsen, J. P. M. Postma, W. F. van Gunsteren, A. DiNola, J. R. Haak, J. Chem. "
                           "Phys. 81, 3684 (1984), doi:10.1063/1.448118",
              .example =
                  "fix 1 all nve\nfix 2 all temp/berendsen 1.0 1.0 0.5\nfix 3 all press/berendsen iso 0.5 0.5 5.0"},
    .state_size = sizeof(press_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .set_temperature = set_temperature,
    .set_pressure = set_pressure,
    .needs_energy = needs_energy,
    .changes_box = true,
    .moves_at_end = true,
    .allows_dynamic_group = true,
};
