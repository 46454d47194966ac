/* The words of fix nvt, npt and nph. */
#include <string.h>

#include "base/memory.h"
#include "style/nose_hoover.h"

#define COMMON_KEYWORDS                                                                                                \
    {"tchain", 1, "<N>", "thermostats in the chain (default: 3; nvt/sllod: 1)"},                                       \
        {"tloop", 1, "<M>", "parts into which a step of the chain is cut (default: 1)"},                               \
        {"drag", 1, "<Df>", "damps oscillations of the chains; 0: not at all (default)"},                              \
        {"mtk", 1, "yes|no", "pressures with the terms that make the ensemble right (default: yes)"},

#define TEMPERATURE_KEYWORDS                                                                                           \
    {"temp", 3, "<Tstart> <Tstop> <Tdamp>", "temperature at the start and end of a run, and damping time"},

/* LAMMPS's keywords for pressures that change tilts are known, so that the refusal can say why. */
#define PRESSURE_KEYWORDS                                                                                              \
    {"iso", 3, "<Pstart> <Pstop> <Pdamp>", "one pressure for the whole box, whose shape stays"},                       \
        {"aniso", 3, "<Pstart> <Pstop> <Pdamp>", "the same pressure for each axis, which change on their own"},        \
        {"x", 3, "<Pstart> <Pstop> <Pdamp>", "pressure along x"},                                                      \
        {"y", 3, "<Pstart> <Pstop> <Pdamp>", "pressure along y"},                                                      \
        {"z", 3, "<Pstart> <Pstop> <Pdamp>", "pressure along z"},                                                      \
        {"couple", 1, "none|xyz|xy|yz|xz", "axes that share the mean of their pressures"},                             \
        {"pchain", 1, "<N>", "thermostats in the chain of the barostat; 0: none (default: 3)"},                        \
        {"ploop", 1, "<M>", "parts into which a step of that chain is cut (default: 1)"},                              \
        {"nreset", 1, "<steps>", "set the reference box of unequal pressures anew so often; 0: never (default)"},      \
        {"ptemp", 1, "<T>", "temperature that sets the masses of the barostat (default: that of temp, or the first)"}, \
        {"dilate", 1, "<group-ID>", "atoms that follow the box (default: all)"},                                       \
        {"fixedpoint", 3, "<x> <y> <z>",                                                                               \
         "place that stays where it is (default: the box's center when the fix is defined)"},                          \
        {"scalexy", 1, "yes|no", "the tilt xy keeps its ratio to the length in y (default: yes)"},                     \
        {"scalexz", 1, "yes|no", "xz that to the length in z"},                                                        \
        {"scaleyz", 1, "yes|no", "yz that to the length in z"},                                                        \
        {"tri", 3, "<Pstart> <Pstop> <Pdamp>", "refused: no pressure changes tilts"},                                  \
        {"xy", 3, "<Pstart> <Pstop> <Pdamp>", "refused"}, {"xz", 3, "<Pstart> <Pstop> <Pdamp>", "refused"},            \
        {"yz", 3, "<Pstart> <Pstop> <Pdamp>", "refused"},                                                              \
    {                                                                                                                  \
        "flip", 1, "yes|no", "refused"                                                                                 \
    }

const hs_keyword hs_nose_hoover_nvt_keywords[] = {TEMPERATURE_KEYWORDS COMMON_KEYWORDS{NULL, 0, NULL, NULL}};
const hs_keyword hs_nose_hoover_sllod_keywords[] = {
    TEMPERATURE_KEYWORDS COMMON_KEYWORDS{"psllod", 1, "yes|no", "the variant p-SLLOD (default: no)"},
    {NULL, 0, NULL, NULL}};
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

/** Pressures of the axes first, ..., last. */
static hs_status read_pressure(hs_nose_hoover *nh, const hs_args *args, int i, int first, int last, hs_error *err)
{
    double damping, start, stop;
    HS_TRY(hs_arg_double(args, i + 1, &start, err));
    HS_TRY(hs_arg_double(args, i + 2, &stop, err));
    HS_TRY(hs_arg_positive(args, i + 3, &damping, err));
    for (int axis = first; axis <= last; ++axis) {
        nh->axis[axis] = true;
        nh->p_start[axis] = start;
        nh->p_stop[axis] = stop;
        nh->p_rate[axis] = 1.0 / damping;
    }
    return HS_OK;
}

static hs_status refuse_shear(const hs_args *args, int i, hs_error *err)
{
    static const char *const words[] = {"tri", "xy", "xz", "yz", "flip", NULL};
    for (int k = 0; words[k] != NULL; ++k)
        if (strcmp(args->word[i], words[k]) == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: '%s' is about pressures that change the tilts of the box, which this version does not "
                           "have; iso, aniso, x, y and z change its lengths, and tilts in proportion",
                           args->command, words[k]);
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
    ((hs_nose_hoover *)fix->state)->dilate = hs_group_mask(group);
    return HS_OK;
}

static hs_status read_fixed_point(hs_nose_hoover *nh, const hs_args *args, int i, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + 1 + axis, &nh->fixed_point[axis], err));
    return HS_OK;
}

/** A keyword and what follows it; *n_used = words. */
static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, int *n_used, hs_error *err)
{
    static const char *const couplings[] = {"none", "xyz", "xy", "yz", "xz", NULL};
    static const char *const scalings[] = {"scalexy", "scalexz", "scaleyz"};
    hs_nose_hoover *nh = fix->state;
    const char *word = args->word[i];
    int coupling;
    *n_used = 2;
    if (strcmp(word, "tchain") == 0) return read_count(args, i, 1, &nh->chain.n, err);
    if (strcmp(word, "tloop") == 0) return read_count(args, i, 1, &nh->chain.n_loops, err);
    if (strcmp(word, "pchain") == 0) return read_count(args, i, 0, &nh->barostat_chain.n, err);
    if (strcmp(word, "ploop") == 0) return read_count(args, i, 1, &nh->barostat_chain.n_loops, err);
    if (strcmp(word, "drag") == 0) return hs_arg_not_negative(args, i + 1, &nh->drag, err);
    if (strcmp(word, "psllod") == 0) return hs_arg_bool(args, i + 1, &nh->is_p_sllod, err);
    if (strcmp(word, "mtk") == 0) return hs_arg_bool(args, i + 1, &nh->is_mtk, err);
    if (strcmp(word, "nreset") == 0) return hs_arg_int(args, i + 1, 0, INT64_MAX, &nh->reset_every, err);
    if (strcmp(word, "ptemp") == 0) return hs_arg_positive(args, i + 1, &nh->t_fixed, err);
    if (strcmp(word, "dilate") == 0) return read_group(fix, args, i, err);
    for (int k = 0; k < 3; ++k)
        if (strcmp(word, scalings[k]) == 0) return hs_arg_bool(args, i + 1, &nh->scales_tilt[k], err);
    if (strcmp(word, "couple") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, couplings, &coupling, err));
        nh->coupling = (hs_nh_coupling)coupling;
        return HS_OK;
    }
    *n_used = 4;
    if (strcmp(word, "fixedpoint") == 0) return read_fixed_point(nh, args, i, err);
    if (strcmp(word, "temp") == 0) {
        nh->t_start = -1.0; /* given, whatever it is */
        return read_temperature(nh, args, i, err);
    }
    if (strcmp(word, "iso") == 0 || strcmp(word, "aniso") == 0) {
        nh->coupling = word[0] == 'i' ? HS_NH_XYZ : HS_NH_NONE;
        return read_pressure(nh, args, i, 0, fix->env->box->dimension - 1, err);
    }
    nh->has_strain_energy = true;
    return read_pressure(nh, args, i, word[0] - 'x', word[0] - 'x', err);
}

/** Which axes a coupling binds together. */
static void coupled_axes(hs_nh_coupling coupling, bool axis[3])
{
    axis[0] = coupling == HS_NH_XYZ || coupling == HS_NH_XY || coupling == HS_NH_XZ;
    axis[1] = coupling == HS_NH_XYZ || coupling == HS_NH_XY || coupling == HS_NH_YZ;
    axis[2] = coupling == HS_NH_XYZ || coupling == HS_NH_YZ || coupling == HS_NH_XZ;
}

static hs_status check_coupling(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    bool is_coupled[3];
    int first = -1;
    coupled_axes(nh->coupling, is_coupled);
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        if (!is_coupled[axis]) continue;
        if (!nh->axis[axis])
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

static hs_status check_axes(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_box *box = fix->env->box;
    for (int axis = 0; axis < 3; ++axis) {
        if (!nh->axis[axis]) continue;
        ++nh->n_axes;
        if (axis >= box->dimension)
            return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d system has no pressure along z", args->command);
        if (!box->periodic[axis])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the box is not periodic in %c, so its length cannot follow a pressure ('boundary' "
                           "makes it periodic)",
                           args->command, "xyz"[axis]);
    }
    HS_TRY(check_coupling(fix, args, err));
    nh->is_iso = nh->coupling == HS_NH_XYZ || (box->dimension == 2 && nh->coupling == HS_NH_XY);
    return HS_OK;
}

hs_status hs_nose_hoover_read(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_box *box = fix->env->box;
    nh->chain.n = nh->is_sllod ? 1 : 3; /* as in LAMMPS: longer chains take long to become steady in a flow */
    nh->barostat_chain.n = 3;
    nh->scales_tilt[0] = nh->scales_tilt[1] = nh->scales_tilt[2] = true;
    nh->chain.n_loops = nh->barostat_chain.n_loops = 1;
    nh->is_mtk = true;
    nh->dilate = hs_group_mask(0);
    for (int axis = 0; axis < 3; ++axis) nh->fixed_point[axis] = 0.5 * (box->lo[axis] + box->hi[axis]);
    for (int i = 0, n_used; i < args->n; i += n_used) {
        HS_TRY(refuse_shear(args, i, err));
        HS_TRY(read_keyword(fix, args, i, &n_used, err));
    }
    const bool has_temperature = nh->t_start != 0.0;
    if (nh->has_thermostat && !has_temperature)
        return hs_fail(err, HS_ERROR_INPUT, "%s: 'temp <Tstart> <Tstop> <Tdamp>' is missing", args->command);
    if (!nh->has_thermostat && has_temperature)
        return hs_fail(err, HS_ERROR_INPUT, "%s: nph keeps no temperature; fix npt does", args->command);
    HS_TRY(check_axes(fix, args, err));
    if (nh->has_barostat && nh->n_axes == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: a pressure is missing: 'iso <Pstart> <Pstop> <Pdamp>', aniso, x, y or z", args->command);
    return HS_OK;
}
