#include "style/deform_path.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

static const char *const length_styles[] = {"final", "delta",  "scale",  "vel",      "erate",
                                            "trate", "volume", "wiggle", "variable", NULL};
static const char *const tilt_styles[] = {"final", "delta", "vel", "erate", "trate", "wiggle", "variable", NULL};

static hs_status read_style(hs_deform_path *path, const hs_args *args, int i, bool is_tilt, hs_error *err)
{
    static const hs_deform_style styles_of_tilts[] = {HS_DEFORM_FINAL,   HS_DEFORM_DELTA,     HS_DEFORM_VELOCITY,
                                                      HS_DEFORM_RATE,    HS_DEFORM_TRUE_RATE, HS_DEFORM_WIGGLE,
                                                      HS_DEFORM_VARIABLE};
    int which;
    HS_TRY(hs_arg_need(args, i, "how it changes (final, delta, vel, erate, ...)", err));
    HS_TRY(hs_arg_choice(args, i, is_tilt ? tilt_styles : length_styles, &which, err));
    path->style = is_tilt ? styles_of_tilts[which] : (hs_deform_style)(which + 1);
    return HS_OK;
}

static hs_status read_variable(hs_deform_path *path, const hs_args *args, int i, int k, hs_error *err)
{
    const char *word = args->word[i + k];
    if (strncmp(word, "v_", 2) != 0) return hs_arg_refuse(args, i + k, "an equal-style variable (v_name)", NULL, err);
    return hs_memory_replace(&path->variable[k], word + 2, err);
}

hs_status hs_deform_path_read(hs_deform_path *path, const hs_args *args, int i, bool is_tilt, double unit, int *n_used,
                              hs_error *err)
{
    static const int n_numbers[] = {0, 2, 2, 1, 1, 1, 1, 0, 2, 2};
    HS_TRY(read_style(path, args, i, is_tilt, err));
    const bool has_ends = path->style == HS_DEFORM_FINAL || path->style == HS_DEFORM_DELTA;
    const int n = is_tilt && has_ends ? 1 : n_numbers[path->style];
    *n_used = 1 + n;
    HS_TRY(hs_arg_need(args, i + n, "a number", err));
    for (int k = 0; k < n; ++k) {
        if (path->style == HS_DEFORM_VARIABLE) {
            HS_TRY(read_variable(path, args, i + 1, k, err));
            continue;
        }
        const bool is_length =
            has_ends || path->style == HS_DEFORM_VELOCITY || (path->style == HS_DEFORM_WIGGLE && k == 0);
        HS_TRY(hs_arg_double(args, i + 1 + k, &path->number[k], err));
        if (is_length) path->number[k] *= unit;
    }
    if (path->style == HS_DEFORM_FINAL && !is_tilt && !(path->number[0] < path->number[1]))
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: 'final %s %s' leaves no box: the first bound must be less than the second", args->command,
                       args->word[i + 1], args->word[i + 2]);
    if (path->style == HS_DEFORM_SCALE && !(path->number[0] > 0.0))
        return hs_arg_refuse(args, i + 1, "a factor above 0", NULL, err);
    if (path->style == HS_DEFORM_WIGGLE && !(path->number[1] > 0.0))
        return hs_arg_refuse(args, i + 2, "a period above 0", NULL, err);
    return HS_OK;
}

void hs_deform_path_fini(hs_deform_path *path)
{
    for (int k = 0; k < 2; ++k) HS_FREE(path->variable[k]);
}

hs_status hs_deform_path_check(const hs_deform_path *path, const hs_fix *fix, hs_error *err)
{
    for (int k = 0; k < 2; ++k)
        if (path->variable[k] != NULL) HS_TRY(hs_fix_need_equal_style(fix, path->variable[k], err));
    return HS_OK;
}

hs_status hs_deform_growth(const hs_deform_path *path, const hs_env *env, const hs_deform_start *start, double *growth,
                           double *rate, hs_error *err)
{
    const double *number = path->number, time = start->time,
                 whole = (double)(env->ramp_stop - env->ramp_start) * env->dt, done = hs_env_ramp(env);
    double in_all = 0.0; /* growth over the run, of the styles that tell the end */
    *growth = *rate = 0.0;
    switch (path->style) {
    case HS_DEFORM_FINAL:
        in_all = number[start->k] - start->value;
        break;
    case HS_DEFORM_DELTA:
        in_all = number[start->k];
        break;
    case HS_DEFORM_SCALE:
        in_all = (number[0] - 1.0) * start->length;
        break;
    case HS_DEFORM_VELOCITY:
        *growth = time * number[0];
        *rate = number[0];
        return HS_OK;
    case HS_DEFORM_RATE:
        *growth = time * number[0] * start->length;
        *rate = number[0] * start->length;
        return HS_OK;
    case HS_DEFORM_TRUE_RATE:
        *growth = start->length * (exp(number[0] * time) - 1.0);
        *rate = number[0] * start->length * exp(number[0] * (time - (double)start->every * env->dt));
        return HS_OK;
    case HS_DEFORM_WIGGLE:
        *growth = number[0] * sin(2.0 * M_PI * time / number[1]);
        *rate = 2.0 * M_PI / number[1] * number[0] * cos(2.0 * M_PI * time / number[1]);
        return HS_OK;
    case HS_DEFORM_VARIABLE:
        HS_TRY(env->variable_value(env->deck, path->variable[0], growth, err));
        return env->variable_value(env->deck, path->variable[1], rate, err);
    default:
        return HS_OK;
    }
    *growth = done * in_all;
    *rate = whole > 0.0 ? in_all / whole : 0.0;
    return HS_OK;
}
