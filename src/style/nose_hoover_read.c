/* The words of fix nvt, npt and nph. */
#include <string.h>

#include "base/memory.h"
#include "style/box_shape.h"
#include "style/nose_hoover_internal.h"

#define COMMON_KEYWORDS                                                                                                \
    {"tchain", 1, "<N>", "thermostats in the chain (default: 3; nvt/sllod: 1)"},                                       \
        {"tloop", 1, "<M>", "parts into which a step of the chain is cut (default: 1)"},                               \
        {"drag", 1, "<Df>", "damps oscillations of the chains; 0: not at all (default)"},                              \
        {"mtk", 1, "yes|no", "pressures with the terms that make the ensemble right (default: yes)"},

#define TEMPERATURE_KEYWORDS                                                                                           \
    {"temp", 3, "<Tstart> <Tstop> <Tdamp>", "temperature at the start and end of a run, and damping time"},

#define PRESSURE_KEYWORDS                                                                                              \
    {"iso", 3, "<Pstart> <Pstop> <Pdamp>", "one pressure for the whole box, whose shape stays"},                       \
        {"aniso", 3, "<Pstart> <Pstop> <Pdamp>", "the same pressure for each axis, which change on their own"},        \
        {"tri", 3, "<Pstart> <Pstop> <Pdamp>", "the same, and the tilts change until there is no shear stress"},       \
        {"x", 3, "<Pstart> <Pstop> <Pdamp>", "pressure along x"},                                                      \
        {"y", 3, "<Pstart> <Pstop> <Pdamp>", "pressure along y"},                                                      \
        {"z", 3, "<Pstart> <Pstop> <Pdamp>", "pressure along z"},                                                      \
        {"xy", 3, "<Pstart> <Pstop> <Pdamp>", "component xy of the pressure, which the tilt xy follows"},              \
        {"xz", 3, "<Pstart> <Pstop> <Pdamp>", "xz"}, {"yz", 3, "<Pstart> <Pstop> <Pdamp>", "yz"},                      \
        {"couple", 1, "none|xyz|xy|yz|xz", "axes that share the mean of their pressures"},                             \
        {"pchain", 1, "<N>", "thermostats in the chain of the barostat; 0: none (default: 3)"},                        \
        {"ploop", 1, "<M>", "parts into which a step of that chain is cut (default: 1)"},                              \
        {"nreset", 1, "<steps>", "set the reference box of unequal pressures anew so often; 0: never (default)"},      \
        {"ptemp", 1, "<T>", "temperature that sets the masses of the barostat (default: that of temp, or the first)"}, \
        {"dilate", 1, "<group-ID>", "atoms that follow the box (default: all)"},                                       \
        {"fixedpoint", 3, "<x> <y> <z>",                                                                               \
         "place that stays where it is (default: the box's center when the fix is defined)"},                          \
        {"scalexy", 1, "yes|no",                                                                                       \
         "the tilt xy keeps its ratio to the length in y (default: yes, unless xy has a target)"},                     \
        {"scalexz", 1, "yes|no", "xz that to the length in z"},                                                        \
        {"scaleyz", 1, "yes|no", "yz that to the length in z"},                                                        \
    {                                                                                                                  \
        "flip", 1, "yes|no", "a tilt beyond 0.6 of the edge gives way to an equivalent one (default: yes)"             \
    }

const hs_keyword hs_nose_hoover_nvt_keywords[] = {TEMPERATURE_KEYWORDS COMMON_KEYWORDS{NULL, 0, NULL, NULL}};
const hs_keyword hs_nose_hoover_sllod_keywords[] = {
    TEMPERATURE_KEYWORDS COMMON_KEYWORDS{"psllod", 1, "yes|no", "the variant p-SLLOD (default: no)"},
    {NULL, 0, NULL, NULL}};
const hs_keyword hs_nose_hoover_nvt_sphere_keywords[] = {TEMPERATURE_KEYWORDS COMMON_KEYWORDS HS_SPHERES_KEYWORDS,
                                                         {NULL, 0, NULL, NULL}};
const hs_keyword hs_nose_hoover_npt_sphere_keywords[] = {
    TEMPERATURE_KEYWORDS COMMON_KEYWORDS PRESSURE_KEYWORDS, HS_SPHERES_KEYWORDS, {NULL, 0, NULL, NULL}};
const hs_keyword hs_nose_hoover_npt_keywords[] = {TEMPERATURE_KEYWORDS COMMON_KEYWORDS PRESSURE_KEYWORDS,
                                                  {NULL, 0, NULL, NULL}};

static hs_status read_temperature(hs_nose_hoover *nh, const hs_args *args, int i, hs_error *err)
{
    double damping;
    HS_TRY(hs_arg_positive(args, i + 1, &nh->t_start, err));
    HS_TRY(hs_arg_positive(args, i + 2, &nh->t_stop, err));
    HS_TRY(hs_arg_positive(args, i + 3, &damping, err));
    nh->t_rate = 1.0 / damping;
    return HS_OK;
}

/** Pressures of the components first, ..., last; @p is_shear: 0 and its damping time alone. */
static hs_status read_pressure(hs_nose_hoover *nh, const hs_args *args, int i, int first, int last, bool is_shear,
                               hs_error *err)
{
    double damping, start, stop;
    HS_TRY(hs_arg_double(args, i + 1, &start, err));
    HS_TRY(hs_arg_double(args, i + 2, &stop, err));
    HS_TRY(hs_arg_positive(args, i + 3, &damping, err));
    for (int k = first; k <= last; ++k) {
        nh->moves[k] = true;
        nh->p_start[k] = is_shear ? 0.0 : start;
        nh->p_stop[k] = is_shear ? 0.0 : stop;
        nh->p_rate[k] = 1.0 / damping;
    }
    return HS_OK;
}

static hs_status read_count(const hs_args *args, int i, int64_t min, int *count, hs_error *err)
{
    int64_t value;
    HS_TRY(hs_arg_int(args, i + 1, min, 1000000, &value, err));
    *count = (int)value;
    return HS_OK;
}

static hs_status read_group(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    int group;
    HS_TRY(hs_groups_get(fix->env->groups, args->word[i + 1], &group, err));
    ((hs_nose_hoover *)fix->state)->dilate = fix->other_groups = hs_group_mask(group);
    return HS_OK;
}

static hs_status read_fixed_point(hs_nose_hoover *nh, const hs_args *args, int i, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + 1 + axis, &nh->fixed_point[axis], err));
    return HS_OK;
}

/** iso, aniso, tri, or a single component. */
static hs_status read_target(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    static const char *const names[] = {"x", "y", "z", "xy", "xz", "yz", NULL};
    hs_nose_hoover *nh = fix->state;
    const char *word = args->word[i];
    const int dimension = fix->env->box->dimension;
    for (int k = 0; names[k] != NULL; ++k) {
        if (strcmp(word, names[k]) != 0) continue;
        nh->has_strain_energy = true;
        return read_pressure(nh, args, i, k, k, false, err);
    }
    hs_barometer_couple(&nh->barometer, word[0] == 'i');
    HS_TRY(read_pressure(nh, args, i, 0, dimension - 1, false, err));
    if (word[0] != 't') return HS_OK;
    return read_pressure(nh, args, i, HS_NH_XY, dimension == 3 ? HS_NH_COMPONENTS - 1 : HS_NH_XY, true, err);
}

/** A keyword and what follows it; *n_used = words. is_scaled[k] is -1 where the deck says nothing. */
static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, int is_scaled[3], int *n_used, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const char *word = args->word[i];
    int coupling;
    HS_TRY(hs_spheres_read(&nh->spheres, fix, args, i, n_used, err));
    if (*n_used > 0) return HS_OK;
    *n_used = 2;
    if (strcmp(word, "tchain") == 0) return read_count(args, i, 1, &nh->chain.n, err);
    if (strcmp(word, "tloop") == 0) return read_count(args, i, 1, &nh->chain.n_loops, err);
    if (strcmp(word, "pchain") == 0) return read_count(args, i, 0, &nh->barostat_chain.n, err);
    if (strcmp(word, "ploop") == 0) return read_count(args, i, 1, &nh->barostat_chain.n_loops, err);
    if (strcmp(word, "drag") == 0) return hs_arg_not_negative(args, i + 1, &nh->drag, err);
    if (strcmp(word, "psllod") == 0) return hs_arg_bool(args, i + 1, &nh->is_p_sllod, err);
    if (strcmp(word, "mtk") == 0) return hs_arg_bool(args, i + 1, &nh->is_mtk, err);
    if (strcmp(word, "flip") == 0) return hs_arg_bool(args, i + 1, &nh->has_flips, err);
    if (strcmp(word, "nreset") == 0) return hs_arg_int(args, i + 1, 0, INT64_MAX, &nh->reset_every, err);
    if (strcmp(word, "ptemp") == 0) return hs_arg_positive(args, i + 1, &nh->t_fixed, err);
    if (strcmp(word, "dilate") == 0) return read_group(fix, args, i, err);
    for (int k = 0; k < 3; ++k) {
        bool value;
        if (strncmp(word, "scale", 5) != 0 || strcmp(word + 5, hs_tilt_names[k]) != 0) continue;
        HS_TRY(hs_arg_bool(args, i + 1, &value, err));
        is_scaled[k] = value;
        return HS_OK;
    }
    if (strcmp(word, "couple") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, hs_couplings, &coupling, err));
        hs_barometer_couple(&nh->barometer, coupling);
        return HS_OK;
    }
    *n_used = 4;
    if (strcmp(word, "fixedpoint") == 0) return read_fixed_point(nh, args, i, err);
    if (strcmp(word, "temp") != 0) return read_target(fix, args, i, err);
    nh->t_start = -1.0; /* given, whatever it is */
    return read_temperature(nh, args, i, err);
}

static hs_status check_coupling(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    int first = -1;
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        if (!nh->barometer.is_coupled[axis]) continue;
        if (!nh->moves[axis])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the coupled axis %c has no pressure; '%c <Pstart> <Pstop> <Pdamp>' gives it one",
                           args->command, "xyz"[axis], "xyz"[axis]);
        if (first < 0) first = axis;
        if (nh->p_start[axis] != nh->p_start[first] || nh->p_stop[axis] != nh->p_stop[first] ||
            nh->p_rate[axis] != nh->p_rate[first])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: coupled axes must have the same pressures and damping times, and %c and %c have not",
                           args->command, "xyz"[first], "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status check_axis(const hs_fix *fix, const hs_args *args, int axis, hs_error *err)
{
    const hs_box *box = fix->env->box;
    if (axis >= box->dimension)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d system has no pressure along z", args->command);
    if (!box->periodic[axis])
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the box is not periodic in %c, so its length cannot follow a pressure ('boundary' "
                       "makes it periodic)",
                       args->command, "xyz"[axis]);
    return HS_OK;
}

/** What moves, and what that means for coupling and scaling. */
static hs_status check_targets(const hs_fix *fix, const hs_args *args, const int is_scaled[3], hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) {
        if (!nh->moves[k]) continue;
        HS_TRY(k < HS_NH_XY ? check_axis(fix, args, k, err)
                            : hs_box_check_tilt_changes(fix->env->box, k - HS_NH_XY, args->command, err));
        ++nh->n_moves;
        nh->n_axes += k < HS_NH_XY;
        nh->has_tilts |= k >= HS_NH_XY;
    }
    for (int k = 0; k < 3; ++k) {
        const bool has_target = nh->moves[HS_NH_XY + k];
        nh->scales_tilt[k] = is_scaled[k] != 0 && !has_target;
        if (is_scaled[k] == 1 && has_target)
            return hs_fail(
                err, HS_ERROR_INPUT,
                "%s: the tilt %s has a target of its own, so it cannot keep its ratio to a length, too ('scale%s no')",
                args->command, hs_tilt_names[k], hs_tilt_names[k]);
    }
    HS_TRY(check_coupling(fix, args, err));
    const bool *is_coupled = nh->barometer.is_coupled;
    nh->barometer.is_iso =
        is_coupled[0] && is_coupled[1] && (is_coupled[2] || fix->env->box->dimension == 2) && !nh->has_tilts;
    return HS_OK;
}

hs_status hs_nose_hoover_read(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_box *box = fix->env->box;
    int is_scaled[3] = {-1, -1, -1};
    nh->chain.n = nh->is_sllod ? 1 : 3; /* as in LAMMPS: longer chains take long to become steady in a flow */
    nh->barostat_chain.n = 3;
    nh->has_flips = true;
    nh->chain.n_loops = nh->barostat_chain.n_loops = 1;
    nh->is_mtk = true;
    nh->dilate = hs_group_mask(0);
    for (int axis = 0; axis < 3; ++axis) nh->fixed_point[axis] = 0.5 * (box->lo[axis] + box->hi[axis]);
    for (int i = 0, n_used; i < args->n; i += n_used) HS_TRY(read_keyword(fix, args, i, is_scaled, &n_used, err));
    const bool has_temperature = nh->t_start != 0.0;
    if (nh->has_thermostat && !has_temperature)
        return hs_fail(err, HS_ERROR_INPUT, "%s: 'temp <Tstart> <Tstop> <Tdamp>' is missing", args->command);
    if (!nh->has_thermostat && has_temperature)
        return hs_fail(err, HS_ERROR_INPUT, "%s: nph keeps no temperature; fix npt does", args->command);
    HS_TRY(check_targets(fix, args, is_scaled, err));
    if (nh->has_barostat && nh->n_moves == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: a pressure is missing: 'iso <Pstart> <Pstop> <Pdamp>', aniso, tri, x, y, z, xy, xz or yz",
                       args->command);
    return HS_OK;
}
