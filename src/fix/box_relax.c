/* Relaxes the box when the energy is minimised.
 *
 * The coordinates of the box are strains e, counted from the box in which the minimisation began: lengths L = L1 (1 +
 * e), tilts xy = xy1 + e lx1 (xz likewise, yz with ly1). What is minimised is U + P (V - V0) + strain energy
 * (style/strain_energy.h), with the mean target pressure P of the axes. As in LAMMPS the forces along the strains
 * leave out what the off-diagonal stress adds to them in a tilted box, so that it is each component of the stress by
 * itself that ends at its target.
 * Source: M. Parrinello, A. Rahman, J. Appl. Phys. 52, 7182 (1981), doi:10.1063/1.328693. */
#include <string.h>

#include "style/barometer.h"
#include "style/box_shape.h"
#include "style/strain_energy.h"

enum { X, Y, Z, XY, XZ, YZ };
static const char *const names[] = {"x", "y", "z", "xy", "xz", "yz", NULL};

typedef struct relax_state {
    hs_barometer barometer; /**< iso: one coordinate, the first, for all axes */
    bool moves[HS_BOX_COORDINATES];
    double target[HS_BOX_COORDINATES]; /**< pressure */
    double p_mean;                     /**< of the axes that move */
    bool has_stress;                   /**< targets differ, or are of tilts: S may be other than 0 */
    bool scales_tilt[3];               /**< xy, xz, yz keep their ratio to the length along their second axis */
    double farthest;                   /**< vmax */
    int64_t reset_every;               /**< iterations; 0: never */
    double fixed_point[3];
    uint32_t dilate;

    bool has_begun;
    int64_t first_step;                                          /**< of the minimisation */
    hs_box first;                                                /**< the box that strains are counted from */
    double strain[HS_BOX_COORDINATES], kept[HS_BOX_COORDINATES]; /**< at present; where the line began */
    hs_strain_energy reference;
    double unit[3]; /**< lengths of the reference box, whose strains forces are along; moves are of the first's */
} relax_state;

/* ---- Words ---- */

static const hs_keyword keywords[] = {
    {"iso", 1, "<P>", "target pressure; all lengths change alike, by the scalar pressure"},
    {"aniso", 1, "<P>", "target pressure; each length changes by the pressure along it"},
    {"tri", 1, "<P>", "the same, and the tilts change until there is no shear stress"},
    {"x", 1, "<P>", "the length in x changes until this is the pressure along x"},
    {"y", 1, "<P>", "y"},
    {"z", 1, "<P>", "z"},
    {"xy", 1, "<P>", "the tilt xy changes until this is the component xy of the pressure"},
    {"xz", 1, "<P>", "xz"},
    {"yz", 1, "<P>", "yz"},
    {"couple", 1, "none|xyz|xy|yz|xz", "axes whose lengths change alike, by the mean of their pressures"},
    {"nreset", 1, "<iterations>", "the reference box is set anew after so many (default: 0, never)"},
    {"vmax", 1, "<fraction>", "largest change of a length in one iteration, as a part of it (default: 0.0001)"},
    {"dilate", 1, "all|partial", "partial: only atoms of the fix's group follow the box (default: all)"},
    {"scalexy", 1, "yes|no", "the tilt xy keeps its ratio to the length in y (default: yes, unless xy has a target)"},
    {"scalexz", 1, "yes|no", "xz that to the length in z"},
    {"scaleyz", 1, "yes|no", "yz that to the length in z"},
    {"fixedpoint", 3, "<x> <y> <z>", "place that stays where it is (default: the center of the box now)"},
    {NULL, 0, NULL, NULL},
};

/** Fail unless coordinate @p k of this box can move. */
static hs_status check_coordinate(const hs_fix *fix, const hs_args *args, int k, hs_error *err)
{
    const hs_box *box = fix->env->box;
    const int second = k < XY ? k : hs_tilt_second(k - XY);
    if (second >= box->dimension)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d box has x, y and xy to relax, not %s", args->command, names[k]);
    if (!box->periodic[second])
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: the box is not periodic in %c, so %s cannot follow a pressure ('boundary' makes it periodic)",
            args->command, "xyz"[second], names[k]);
    if (k >= XY && !box->is_tilted)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the tilt %s of an orthogonal box cannot change; 'change_box all triclinic' makes the box "
                       "one that can be tilted, as does a region of style prism in create_box",
                       args->command, names[k]);
    return HS_OK;
}

static hs_status set_target(hs_fix *fix, const hs_args *args, int k, double target, hs_error *err)
{
    relax_state *state = fix->state;
    HS_TRY(check_coordinate(fix, args, k, err));
    state->moves[k] = true;
    state->target[k] = target;
    return HS_OK;
}

static hs_status read_target(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    const char *word = args->word[i];
    const int dimension = fix->env->box->dimension;
    double target;
    int k = 0;
    HS_TRY(hs_arg_double(args, i + 1, &target, err));
    while (names[k] != NULL && strcmp(names[k], word) != 0) ++k;
    if (names[k] != NULL) return set_target(fix, args, k, target, err);
    hs_barometer_couple(&((relax_state *)fix->state)->barometer, word[0] == 'i');
    for (k = X; k < dimension; ++k) HS_TRY(set_target(fix, args, k, target, err));
    for (k = XY; k < (dimension == 3 ? HS_BOX_COORDINATES : XZ) && word[0] == 't'; ++k)
        HS_TRY(set_target(fix, args, k, 0.0, err));
    return HS_OK;
}

/** A keyword that is no target, and what follows it; is_scaled[k] is -1 where the deck says nothing. */
static hs_status read_setting(hs_fix *fix, const hs_args *args, int i, int is_scaled[3], hs_error *err)
{
    static const char *const groups[] = {"all", "partial", NULL};
    relax_state *state = fix->state;
    const char *word = args->word[i];
    int choice;
    if (strcmp(word, "couple") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, hs_couplings, &choice, err));
        hs_barometer_couple(&state->barometer, choice);
    } else if (strcmp(word, "nreset") == 0) {
        return hs_arg_int(args, i + 1, 0, INT64_MAX, &state->reset_every, err);
    } else if (strcmp(word, "vmax") == 0) {
        return hs_arg_positive(args, i + 1, &state->farthest, err);
    } else if (strcmp(word, "dilate") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, groups, &choice, err));
        state->dilate = choice == 0 ? hs_group_mask(0) : fix->mask;
    } else if (strcmp(word, "fixedpoint") == 0) {
        for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + 1 + axis, &state->fixed_point[axis], err));
    } else {
        bool value;
        int k = 0;
        while (strcmp(hs_tilt_names[k], word + strlen("scale")) != 0) ++k;
        HS_TRY(hs_arg_bool(args, i + 1, &value, err));
        is_scaled[k] = value;
    }
    return HS_OK;
}

static hs_status check_coupling(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    const relax_state *state = fix->state;
    int first = -1;
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        if (!state->barometer.is_coupled[axis]) continue;
        if (!state->moves[axis])
            return hs_fail(err, HS_ERROR_INPUT, "%s: the coupled axis %s has no target; '%s <P>' gives it one",
                           args->command, names[axis], names[axis]);
        if (first < 0) first = axis;
        if (state->target[axis] != state->target[first])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: coupled axes must have the same target, and %s (%g) and %s (%g) have not",
                           args->command, names[first], state->target[first], names[axis], state->target[axis]);
    }
    return HS_OK;
}

static hs_status check_scaling(relax_state *state, const hs_args *args, const int is_scaled[3], hs_error *err)
{
    for (int k = 0; k < 3; ++k) {
        state->scales_tilt[k] = is_scaled[k] != 0 && !state->moves[XY + k];
        if (is_scaled[k] == 1 && state->moves[XY + k])
            return hs_fail(
                err, HS_ERROR_INPUT,
                "%s: the tilt %s has a target of its own, so it cannot keep its ratio to a length, too ('scale%s no')",
                args->command, names[XY + k], names[XY + k]);
    }
    return HS_OK;
}

static bool moves_tilts(const relax_state *state) { return state->moves[XY] || state->moves[XZ] || state->moves[YZ]; }

/** The mean target of the axes, and whether any differs from it. */
static hs_status find_mean(relax_state *state, const hs_args *args, hs_error *err)
{
    double sum = 0.0, first = 0.0;
    int n = 0;
    for (int axis = X; axis <= Z; ++axis) {
        if (!state->moves[axis]) continue;
        if (n == 0) first = state->target[axis];
        state->has_stress |= state->target[axis] != first;
        sum += state->target[axis];
        ++n;
    }
    for (int k = XY; k <= YZ; ++k) state->has_stress |= state->target[k] != 0.0;
    state->p_mean = n == 0 ? 0.0 : state->has_stress ? sum / n : first; /* without rounding where all are one */
    if (n > 0 || moves_tilts(state)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: what relaxes? 'iso <P>', aniso, tri, x, y, z, xy, xz or yz with a target must follow",
                   args->command);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    relax_state *state = fix->state;
    const hs_box *box = fix->env->box;
    int is_scaled[3] = {-1, -1, -1};
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    state->farthest = 1e-4;
    state->dilate = hs_group_mask(0);
    for (int axis = 0; axis < 3; ++axis) state->fixed_point[axis] = 0.5 * (box->lo[axis] + box->hi[axis]);
    for (int i = 0; i < args->n; i += strcmp(args->word[i], "fixedpoint") == 0 ? 4 : 2) {
        const char *word = args->word[i];
        const bool is_target = strchr("xyz", word[0]) != NULL || strcmp(word, "iso") == 0 ||
                               strcmp(word, "aniso") == 0 || strcmp(word, "tri") == 0;
        HS_TRY(is_target ? read_target(fix, args, i, err) : read_setting(fix, args, i, is_scaled, err));
    }
    HS_TRY(find_mean(state, args, err));
    HS_TRY(check_coupling(fix, args, err));
    HS_TRY(check_scaling(state, args, is_scaled, err));
    const bool *is_coupled = state->barometer.is_coupled;
    state->barometer.is_iso =
        is_coupled[X] && is_coupled[Y] && (is_coupled[Z] || box->dimension == 2) && !moves_tilts(state);
    return hs_barometer_create(fix, "temp", true, err);
}

static void destroy(hs_fix *fix) { hs_barometer_fini(&((relax_state *)fix->state)->barometer); }

static hs_status set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    return hs_barometer_set_temperature(fix, &((relax_state *)fix->state)->barometer, id, err);
}

static hs_status set_pressure(hs_fix *fix, const char *id, hs_error *err)
{
    return hs_barometer_set_pressure(&((relax_state *)fix->state)->barometer, id, err);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_barometer_init(fix, &((relax_state *)fix->state)->barometer, err);
}

/* ---- Energy and forces ---- */

/** The present box becomes the reference. */
static void set_reference(hs_fix *fix)
{
    relax_state *state = fix->state;
    double stress[HS_BOX_COORDINATES];
    for (int k = 0; k < HS_BOX_COORDINATES; ++k)
        stress[k] = state->moves[k] && k < XY ? state->target[k] - state->p_mean : state->target[k];
    for (int axis = 0; axis < 3; ++axis) state->unit[axis] = hs_box_length(fix->env->box, axis);
    hs_strain_energy_set_at_rest(&state->reference, fix->env->box, stress);
}

static double energy_of(const hs_fix *fix)
{
    const relax_state *state = fix->state;
    const hs_box *box = fix->env->box;
    const double work = state->p_mean * (hs_box_volume(box) - state->reference.volume),
                 strain = state->has_stress ? hs_strain_energy_of(&state->reference, box) : 0.0;
    return (work + strain) / fix->env->units->nktv2p;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((relax_state *)fix->state)->has_begun ? energy_of(fix) : 0.0;
    return HS_OK;
}

static hs_status measure(hs_fix *fix, double *energy, double force[HS_BOX_COORDINATES], hs_error *err)
{
    const relax_state *state = fix->state;
    const hs_box *box = fix->env->box;
    const double volume = hs_box_volume(box);
    double p[HS_BOX_COORDINATES], against[HS_BOX_COORDINATES] = {0.0};
    hs_env_changed(fix->env);
    HS_TRY(hs_barometer_read(fix, &state->barometer, p, err));
    *energy = energy_of(fix);
    memset(force, 0, HS_BOX_COORDINATES * sizeof *force);
    if (state->barometer.is_iso) {
        force[X] =
            box->dimension * (p[X] - state->p_mean) * volume / (1.0 + state->strain[X]) / fix->env->units->nktv2p;
        return HS_OK;
    }
    if (state->has_stress) hs_strain_energy_forces(&state->reference, box, against);
    for (int k = 0; k < HS_BOX_COORDINATES; ++k) {
        const int row = k < XY ? k : hs_tilt_first(k - XY), column = k < XY ? k : hs_tilt_second(k - XY);
        if (!state->moves[k]) continue;
        const double stress =
            (p[k] - (k < XY ? state->p_mean : 0.0)) * volume / hs_box_length(box, column) - against[k];
        force[k] = stress * state->unit[row] / fix->env->units->nktv2p;
    }
    return HS_OK;
}

/* ---- The box ---- */

static void begin(hs_fix *fix)
{
    relax_state *state = fix->state;
    state->has_begun = true;
    state->first_step = fix->env->step;
    state->first = *fix->env->box;
    memset(state->strain, 0, sizeof state->strain);
    memset(state->kept, 0, sizeof state->kept);
    set_reference(fix);
}

static void place(hs_fix *fix, double alpha, const double direction[HS_BOX_COORDINATES], hs_box *box)
{
    relax_state *state = fix->state;
    const hs_box *first = &state->first;
    *box = *fix->env->box;
    for (int k = 0; k < HS_BOX_COORDINATES; ++k)
        state->strain[k] =
            state->kept[k] + alpha * direction[state->barometer.is_iso && k < fix->env->box->dimension ? X : k];
    for (int axis = 0; axis < 3; ++axis) {
        if (!state->moves[axis]) continue;
        const double growth = 1.0 + state->strain[axis], point = state->fixed_point[axis];
        box->lo[axis] = point + growth * (first->lo[axis] - point);
        box->hi[axis] = point + growth * (first->hi[axis] - point);
        for (int k = 0; k < 3; ++k)
            if (state->scales_tilt[k] && hs_tilt_second(k) == axis) box->tilt[k] = growth * first->tilt[k];
    }
    for (int k = 0; k < 3; ++k)
        if (state->moves[XY + k])
            box->tilt[k] = first->tilt[k] + state->strain[XY + k] * hs_box_length(first, hs_tilt_first(k));
}

static void keep(hs_fix *fix)
{
    relax_state *state = fix->state;
    memcpy(state->kept, state->strain, sizeof state->kept);
}

static double farthest(const hs_fix *fix) { return ((const relax_state *)fix->state)->farthest; }

static bool renew(hs_fix *fix)
{
    const relax_state *state = fix->state;
    const int64_t n_done = fix->env->step - state->first_step;
    /* where all targets are one, the reference is no more than a constant of the energy */
    if (state->reset_every == 0 || !state->has_stress || n_done % state->reset_every != 0) return false;
    set_reference(fix);
    return true;
}

static int count(const hs_fix *fix)
{
    const relax_state *state = fix->state;
    if (state->barometer.is_iso) return 1;
    return moves_tilts(state) ? 6 : 3; /* as LAMMPS counts */
}

static uint32_t followers(const hs_fix *fix) { return ((const relax_state *)fix->state)->dilate; }

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    relax_state *state = fix->state;
    HS_TRY(hs_state_bool(kept, "has begun", &state->has_begun, err));
    HS_TRY(hs_state_int64(kept, "first step", &state->first_step, 1, err));
    if (kept->is_reading) state->first = *fix->env->box;
    HS_TRY(hs_state_double(kept, "first lo", state->first.lo, 3, err));
    HS_TRY(hs_state_double(kept, "first hi", state->first.hi, 3, err));
    HS_TRY(hs_state_double(kept, "first tilt", state->first.tilt, 3, err));
    HS_TRY(hs_state_double(kept, "strain", state->strain, HS_BOX_COORDINATES, err));
    HS_TRY(hs_state_double(kept, "fixed point", state->fixed_point, 3, err));
    HS_TRY(hs_state_double(kept, "reference volume", &state->reference.volume, 1, err));
    HS_TRY(hs_state_double(kept, "reference lengths", state->unit, 3, err));
    return hs_state_double(kept, "sigma", state->reference.sigma[0], 9, err);
}

static const hs_box_freedom freedom = {.begin = begin,
                                       .measure = measure,
                                       .place = place,
                                       .keep = keep,
                                       .farthest = farthest,
                                       .renew = renew,
                                       .count = count,
                                       .followers = followers};

const hs_fix_style hs_fix_style_box_relax = {
    .about =
        {.name = "box/relax",
         .syntax = {"<iso|aniso|tri|x|y|z|xy|xz|yz> <P> [keyword value ...]", 0, 0, keywords},
         .summary = "relax the box to a pressure when the energy is minimised",
         .details =
             "Lets the box change while `minimize` moves the atoms, until both are at a minimum and the pressure is "
             "the one asked for. For the styles `cg` and `sd`, which search along lines. In a run the fix does "
             "nothing.\n\n"
             "`iso` changes all lengths alike, by the scalar pressure; `aniso` each by the pressure along it; `tri` "
             "the tilts, too, until no shear stress is left. `x`, `y`, `z`, `xy`, `xz`, `yz` name single lengths and "
             "tilts, each with its target (pressure units; the virial part alone, for atoms do not move in time); what "
             "is not named stays. `couple` changes some lengths alike, by the mean of their pressures. The box must be "
             "periodic along axes that change, and one that can be tilted for its tilts to. Tilts without a target "
             "keep their ratio to the length along their second axis, unless `scalexy no` or the like is said. Atoms "
             "follow the box as their fractions of it, around `fixedpoint`; with `dilate partial` only those of the "
             "fix's group do.\n\n"
             "In one iteration no length changes by more than `vmax` of it (nor atoms move farther than `min_modify "
             "dmax`). Near the minimum the step is chosen by the line search; 0.001 serves most purposes.\n\n"
             "What is minimised is U + P (V - V0) + the strain energy of Parrinello and Rahman, with the mean P of the "
             "targets of the axes. The last term is there where targets are unequal or of tilts. It refers to the box "
             "at the start, so that the stress ends beside its target by as much as the box has changed: `nreset`, or "
             "another `minimize`, sets the reference anew. Energies that `minimize` tells hold these terms, and its "
             "forces those of the box, in energy for a strain of 1; tolerances count both. Atoms first, then `iso`, "
             "then unequal targets, each with a `minimize` of its own, is the way that converges best. A liquid bears "
             "no unequal targets.\n\n"
             "The fix makes the computes `ID_temp` and `ID_press` (the virial part); `fix_modify temp` and `press` "
             "take others. The scalar `f_ID` is the energy of pressure and strain; `pe + f_ID` is what is minimised "
             "(`pe + f_ID/atoms` per atom).\n",
         .reference = "M. Parrinello, A. Rahman, J. Appl. Phys. 52, 7182 (1981), doi:10.1063/1.328693",
         .example = "fix 1 all box/relax iso 0.0 vmax 0.001\nminimize 1e-8 1e-8 1000 10000"},
    .state_size = sizeof(relax_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .keep_state = keep_state,
    .scalar = scalar,
    .set_temperature = set_temperature,
    .set_pressure = set_pressure,
    .box_freedom = &freedom,
    .is_extensive = true,
    .changes_box = true,
};
