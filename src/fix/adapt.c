/* Lets coefficients of the pair style, and diameters, follow variables. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "core/atom_style.h"
#include "style/attribute.h"
#include "style/pair_coeffs.h"
#include "style/varying.h"

/** One `pair` of the words. */
typedef struct target {
    char *style;       /**< owned */
    int64_t number;    /**< which of several sub-styles of that name; 0: not said */
    char *coefficient; /**< owned */
    int i_lo, i_hi, j_lo, j_hi;
    char *variable;   /**< owned */
    hs_pair *part;    /**< borrowed; found before each run, as is the next */
    int index;        /**< of the coefficient */
    double *original; /**< owned [n_original]: coefficients at the beginning of the run, by hs_pair_index */
    int64_t n_original;
} target;

typedef struct adapt_state {
    int64_t every;  /**< 0: before a run only */
    target *target; /**< owned [n_targets] */
    int n_targets;
    char *diameter;   /**< owned; variable of the diameters; NULL: they stay */
    double *radius;   /**< atom field: radii at the beginning of the run; NULL unless `diameter` is set */
    char *field_name; /**< owned; of that field */
    bool is_scale, is_reset;
    bool has_originals;
    int64_t lists_at; /**< step that needs new lists */
} adapt_state;

static const hs_keyword keywords[] = {
    {"pair", 5, "<style> <coefficient> <I> <J> <v_name>",
     "a coefficient of pairs of types takes the values of an equal-style variable; in a hybrid style, style is a "
     "sub-style, style:2 the second one of that name"},
    {"atom", 2, "diameter <v_name>", "the diameters of the group's atoms"},
    {"scale", 1, "yes|no", "the variable multiplies the value at the beginning of the run (default: no)"},
    {"reset", 1, "yes|no", "bring the values back at the end of the run (default: no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_variable(const hs_args *args, int i, char **name, hs_error *err)
{
    if (strncmp(args->word[i], "v_", 2) != 0 || args->word[i][2] == '\0')
        return hs_arg_refuse(args, i, "v_name, an equal-style variable", NULL, err);
    HS_FREE(*name);
    return hs_memory_strdup(name, args->word[i] + 2, err);
}

/** Words from @p i on: style or style:number, coefficient, I, J, v_name. */
static hs_status read_pair(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    adapt_state *state = fix->state;
    const int n_types = fix->env->atoms->n_types;
    HS_TRY(HS_GROW(state->target, (size_t)state->n_targets, (size_t)state->n_targets + 1, err));
    target *t = &state->target[state->n_targets++];
    *t = (target){.part = NULL};
    HS_TRY(hs_memory_strdup(&t->style, args->word[i], err));
    char *const colon = strchr(t->style, ':');
    if (colon != NULL) {
        char *end;
        *colon = '\0';
        t->number = strtol(colon + 1, &end, 10);
        if (end == colon + 1 || *end != '\0' || t->number < 1)
            return hs_arg_refuse(args, i, "a pair style, or the number of one in a hybrid style (lj/cut:2)", NULL, err);
    }
    HS_TRY(hs_memory_strdup(&t->coefficient, args->word[i + 1], err));
    HS_TRY(hs_arg_range(args, i + 2, n_types, &t->i_lo, &t->i_hi, err));
    HS_TRY(hs_arg_range(args, i + 3, n_types, &t->j_lo, &t->j_hi, err));
    if (t->i_lo > t->j_hi) return hs_arg_refuse(args, i + 2, "a type up to the second one (I <= J)", NULL, err);
    return read_variable(args, i + 4, &t->variable, err);
}

static hs_status read_diameter(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    adapt_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    hs_text name = {0};
    if (strcmp(args->word[i], "diameter") != 0)
        return hs_arg_refuse(args, i, "diameter, which is what can change of atoms", NULL, err);
    HS_TRY(hs_attribute_check(HS_ATTR_DIAMETER, atoms, err));
    HS_TRY(read_variable(args, i + 1, &state->diameter, err));
    if (state->radius != NULL) return HS_OK;
    HS_TRY(hs_text_printf(&name, err, "fix %s radius", fix->id));
    state->field_name = name.data;
    return hs_atoms_add_field(atoms, state->field_name, (void **)&state->radius, sizeof(double), false, err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    adapt_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 0, INT64_MAX, &state->every, err));
    state->lists_at = -1;
    for (int i = 1; i < args->n;) {
        const char *word = args->word[i];
        if (strcmp(word, "pair") == 0) {
            HS_TRY(read_pair(fix, args, i + 1, err));
            i += 6;
        } else if (strcmp(word, "atom") == 0) {
            HS_TRY(read_diameter(fix, args, i + 1, err));
            i += 3;
        } else {
            HS_TRY(hs_arg_bool(args, i + 1, strcmp(word, "scale") == 0 ? &state->is_scale : &state->is_reset, err));
            i += 2;
        }
    }
    if (state->n_targets > 0 || state->diameter != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: what changes? 'pair' or 'atom' must follow", args->command);
}

static void destroy(hs_fix *fix)
{
    adapt_state *state = fix->state;
    for (int k = 0; k < state->n_targets; ++k) {
        target *t = &state->target[k];
        HS_FREE(t->style);
        HS_FREE(t->coefficient);
        HS_FREE(t->variable);
        HS_FREE(t->original);
    }
    HS_FREE(state->target);
    HS_FREE(state->diameter);
    hs_atoms_remove_field(fix->env->atoms, (void **)&state->radius);
    HS_FREE(state->field_name);
}

/** Whether the coefficients of (i, j) were given for the part that is adapted; else they are mixed, or of other
 *  parts. */
static bool is_given(const target *t, int i, int j) { return i <= j && t->part->is_set[hs_pair_index(t->part, i, j)]; }

static hs_status find_part(const hs_fix *fix, target *t, hs_error *err)
{
    const hs_pair *pair = fix->env->pair(fix->env);
    int n = 0;
    t->part = NULL;
    for (int k = 0; pair != NULL && k < pair->n_parts; ++k) {
        if (!hs_text_is_style(t->style, pair->part[k]->style->about.name)) continue;
        if (++n == t->number || t->number == 0) t->part = pair->part[k];
    }
    if (n > 0 && t->part == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the pair style has %d sub-style%s '%s', not %lld",
                       hs_fix_who(fix).text, n, n == 1 ? "" : "s", t->style, (long long)t->number);
    if (t->part == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the pair style is '%s', not '%s'", hs_fix_who(fix).text,
                       pair != NULL ? pair->style->about.name : "none", t->style);
    if (n > 1 && t->number == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the pair style has %d sub-styles '%s'; write %s:1 for the first of them",
                       hs_fix_who(fix).text, n, t->style, t->style);
    return HS_OK;
}

static hs_status find_coefficient(const hs_fix *fix, target *t, hs_error *err)
{
    const hs_pair_adaptable *one = t->part->style->adaptable;
    hs_text names = {0};
    hs_status status = HS_OK;
    for (; one != NULL && one->name != NULL; ++one) {
        if (strcmp(one->name, t->coefficient) == 0) {
            t->index = one->index;
            hs_text_fini(&names);
            return HS_OK;
        }
        if (status == HS_OK) status = hs_text_printf(&names, err, "%s%s", names.length > 0 ? ", " : "", one->name);
    }
    if (status == HS_OK)
        status = hs_fail(err, HS_ERROR_INPUT, "%s: pair style '%s' has no coefficient '%s' to change%s%s",
                         hs_fix_who(fix).text, t->style, t->coefficient, names.length > 0 ? "; it has " : "",
                         hs_text_get(&names));
    hs_text_fini(&names);
    return status;
}

static hs_status find_types(const hs_fix *fix, const target *t, hs_error *err)
{
    for (int i = t->i_lo; i <= t->i_hi; ++i)
        for (int j = t->j_lo; j <= t->j_hi; ++j)
            if (is_given(t, i, j)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: no pair_coeff has given the types %d %d coefficients of '%s': those that are mixed follow the "
                   "types they are mixed from",
                   hs_fix_who(fix).text, t->i_lo, t->j_lo, t->style);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    adapt_state *state = fix->state;
    for (int k = 0; k < state->n_targets; ++k) {
        HS_TRY(hs_fix_need_equal_style(fix, state->target[k].variable, err));
        HS_TRY(find_part(fix, &state->target[k], err));
        HS_TRY(find_coefficient(fix, &state->target[k], err));
        HS_TRY(find_types(fix, &state->target[k], err));
    }
    return state->diameter != NULL ? hs_fix_need_equal_style(fix, state->diameter, err) : HS_OK;
}

static double *coefficient_at(const target *t, int k) { return &((hs_pair_coeffs *)t->part->state)->at[k].c[t->index]; }

static hs_status remember_originals(hs_fix *fix, hs_error *err)
{
    adapt_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    for (int k = 0; k < state->n_targets; ++k) {
        target *t = &state->target[k];
        const int n = t->part->n_types + 1;
        t->n_original = (int64_t)n * n;
        HS_TRY(HS_GROW(t->original, 0, (size_t)t->n_original, err));
        for (int ij = 0; ij < n * n; ++ij) t->original[ij] = *coefficient_at(t, ij);
    }
    for (int i = 0; state->radius != NULL && i < atoms->n_local; ++i) state->radius[i] = atoms->radius[i];
    state->has_originals = true;
    return HS_OK;
}

/** Set the coefficients to the value (or that many times the originals). */
static hs_status set_pair(const hs_fix *fix, const target *t, bool is_scale, double value, hs_error *err)
{
    t->part->is_adapted = true;
    for (int i = t->i_lo; i <= t->i_hi; ++i)
        for (int j = t->j_lo; j <= t->j_hi; ++j) {
            const int ij = hs_pair_index(t->part, i, j);
            if (!is_given(t, i, j)) continue;
            const double next = is_scale ? value * t->original[ij] : value;
            if (!isfinite(next) || (next < 0.0 && strcmp(t->coefficient, "sigma") == 0))
                return hs_fail(err, HS_ERROR_RUN, "%s: %s of %s would become %g", hs_fix_who(fix).text, t->coefficient,
                               t->style, next);
            *coefficient_at(t, ij) = next;
        }
    return HS_OK;
}

/** A sphere of another size and the same density. */
static void set_radius(const hs_atoms *atoms, int i, double radius)
{
    atoms->rmass[i] = hs_ball_volume(radius) * (atoms->rmass[i] / hs_ball_volume(atoms->radius[i]));
    atoms->radius[i] = radius;
}

static hs_status set_diameters(const hs_fix *fix, double value, hs_error *err)
{
    const adapt_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    if (!(value > 0.0) || !isfinite(value))
        return hs_fail(err, HS_ERROR_RUN, "%s: the diameter%s %g is not greater than 0", hs_fix_who(fix).text,
                       state->is_scale ? "'s factor" : "", value);
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        set_radius(atoms, i, state->is_scale ? value * state->radius[i] : 0.5 * value);
    }
    return HS_OK;
}

/** Tell the simulation of what was changed; new lists, if they are needed, at step @p lists_at. */
static hs_status tell_changes(hs_fix *fix, int64_t lists_at, hs_error *err)
{
    adapt_state *state = fix->state;
    bool needs_lists = false;
    HS_TRY(fix->env->pairs_changed(fix->env, &needs_lists, err));
    if (needs_lists) state->lists_at = lists_at;
    return HS_OK;
}

static hs_status pre_force(hs_fix *fix, bool is_setup, hs_error *err)
{
    adapt_state *state = fix->state;
    const hs_env *env = fix->env;
    double value;
    if (!is_setup && (state->every == 0 || env->step % state->every != 0)) return HS_OK;
    if (!state->has_originals || (is_setup && env->step == env->first_step)) HS_TRY(remember_originals(fix, err));
    for (int k = 0; k < state->n_targets; ++k) {
        HS_TRY(env->variable_value(env->deck, state->target[k].variable, &value, err));
        HS_TRY(set_pair(fix, &state->target[k], state->is_scale, value, err));
    }
    if (state->diameter != NULL) {
        HS_TRY(env->variable_value(env->deck, state->diameter, &value, err));
        HS_TRY(set_diameters(fix, value, err));
    }
    return tell_changes(fix, env->step, err);
}

static int64_t next_exchange(const hs_fix *fix) { return ((const adapt_state *)fix->state)->lists_at; }

static hs_status end_of_run(hs_fix *fix, hs_error *err)
{
    adapt_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    if (!state->is_reset || !state->has_originals) return HS_OK;
    for (int k = 0; k < state->n_targets; ++k) HS_TRY(set_pair(fix, &state->target[k], true, 1.0, err));
    for (int i = 0; state->radius != NULL && i < atoms->n_local; ++i)
        if (atoms->mask[i] & fix->mask) set_radius(atoms, i, state->radius[i]);
    return tell_changes(fix, fix->env->step + 1, err); /* a run without set-up may follow */
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    adapt_state *state = fix->state;
    HS_TRY(hs_state_bool(kept, "has originals", &state->has_originals, err));
    HS_TRY(hs_state_int64(kept, "lists at", &state->lists_at, 1, err));
    for (int k = 0; k < state->n_targets; ++k) {
        char name[48];
        snprintf(name, sizeof name, "originals %d", k + 1);
        HS_TRY(hs_state_doubles(kept, name, &state->target[k].original, &state->target[k].n_original, err));
        /* before a run's set-up, which takes the coefficients of then, the part is not known */
        if (!kept->is_reading || state->target[k].part == NULL) continue;
        const int n = state->target[k].part->n_types + 1;
        if (state->has_originals && state->target[k].n_original != (int64_t)n * n)
            return hs_fail(err, HS_ERROR_INPUT, "%s: its state is of another number of types", hs_fix_who(fix).text);
    }
    return HS_OK;
}

const hs_fix_style hs_fix_style_adapt = {
    .about = {.name = "adapt",
              .syntax = {.usage = "<N> [pair <style> <coefficient> <I> <J> <v_name>] [atom diameter <v_name>] ...",
                         .n_min = 1,
                         .n_max = 1,
                         .keywords = keywords},
              .summary = "let coefficients of the pair style, or diameters, follow variables during a run",
              .details =
                  "Before a run, and then at every step that is a multiple of N (0: only before the run), each "
                  "variable is evaluated, and what it stands for takes its value, or with `scale yes` its value times "
                  "the one at the beginning of the run. `pair` and `atom` may be repeated. Variables are equal-style "
                  "ones, such as `ramp(0,30)`.\n\n"
                  "`pair`: the coefficients of all pairs of types in the ranges I and J (I <= J) that pair_coeff has "
                  "given; mixed pairs are mixed anew, shifts at the cutoff and long-range parts are computed anew. "
                  "Coefficients that can be changed: `epsilon`, `sigma` of lj/cut, lj/expand (and `delta`), lj/smooth, "
                  "lj/smooth/linear, lj/sf and wca; `a` of soft, gauss and yukawa; `a`, `c`, `d` of born; `a`, `c` of "
                  "buck; `d0`, `alpha`, `r0` of morse; `k` of harmonic/cut, harmonic/repulsion and harmonic/sphere. "
                  "When the cutoff changes with them (wca, lj/expand), new neighbor lists are made.\n\n"
                  "`atom diameter`: the diameters of the group's atoms; their densities stay, so masses change with "
                  "the volume (of balls, in two dimensions, too).\n\n"
                  "After the run the values stay, unless `reset yes` brings those of its beginning back. With `scale "
                  "yes` and without reset a second run therefore scales what the first has left, as in LAMMPS. A "
                  "checkpoint has the values of its moment. The fix does not act in minimisations.",
              .example =
                  "variable push equal ramp(0,60)\nfix 1 all adapt 1 pair soft a * * v_push\n"
                  "variable f equal ramp(0.1,1)\nfix 2 all adapt 10 pair lj/cut epsilon 1 2 v_f scale yes reset yes\n"
                  "variable d equal ramp(0.5,1)\nfix 3 all adapt 100 atom diameter v_d"},
    .state_size = sizeof(adapt_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .pre_force = pre_force,
    .next_exchange = next_exchange,
    .end_of_run = end_of_run,
    .keep_state = keep_state,
};
