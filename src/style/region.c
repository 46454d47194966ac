#include "style/region.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "core/lattice.h"

/** Keywords common to all region styles. */
static const hs_keyword common_keywords[] = {
    {"side", 1, "in|out", "the region is the inside of the shape (default) or everything outside of it"},
    {"units", 1, "lattice|box", "lengths are in lattice spacings (default) or in the distance units of the run"},
    {"move", 3, "<v_x> <v_y> <v_z>",
     "the region is displaced by equal-style variables, distance; NULL: not along this axis"},
    {"rotate", 7, "<v_angle> <Px> <Py> <Pz> <Rx> <Ry> <Rz>",
     "it is turned by the variable's angle, radians, about the axis R through the place P, before it is displaced"},
    {NULL, 0, NULL, NULL},
};

hs_status hs_where_set(hs_where *where, const char *id, hs_error *err)
{
    return hs_memory_replace(&where->id, id, err);
}

void hs_where_fini(hs_where *where)
{
    HS_FREE(where->id);
    where->region = NULL;
}

hs_status hs_where_find(hs_where *where, hs_env *env, const char *who, hs_error *err)
{
    if (where->id == NULL) return HS_OK;
    where->region = env->find_region(env, where->id);
    if (where->region == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s: there is no region '%s'", who, where->id);
    return where->region->is_varying ? hs_region_check_variables(where->region, who, err) : HS_OK;
}

void hs_region_touch(const double d[3], double cutoff, hs_contact *contact, int *n)
{
    const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(r < cutoff)) return;
    for (int axis = 0; axis < 3; ++axis) contact[*n].away[axis] = r > 0.0 ? d[axis] / r : 0.0;
    contact[(*n)++].r = r;
}

bool hs_region_uses(const hs_region *region, const hs_region *other)
{
    return region->style->uses != NULL && region->style->uses(region, other);
}

/** The region style of that name, or NULL. */
static const hs_region_style *find_style(const char *name)
{
    for (int k = 0; hs_region_styles[k] != NULL; ++k)
        if (strcmp(hs_region_styles[k]->about.name, name) == 0) return hs_region_styles[k];
    return NULL;
}

/** Refuse an unknown style. */
static hs_status refuse_style(const char *command, const char *style, hs_error *err)
{
    const char *names[64];
    size_t n = 0;
    for (int k = 0; hs_region_styles[k] != NULL && n < 64; ++k) names[n++] = hs_region_styles[k]->about.name;
    const char *nearest = hs_text_nearest(style, names, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: unknown region style '%s'; did you mean '%s'?", command, style,
                       nearest);
    return hs_fail(
        err, HS_ERROR_INPUT,
        "%s: unknown region style '%s'; expected block, cone, cylinder, plane, prism, sphere, union or intersect",
        command, style);
}

static bool is_common_keyword(const char *word)
{
    for (const hs_keyword *keyword = common_keywords; keyword->name != NULL; ++keyword)
        if (strcmp(keyword->name, word) == 0) return true;
    return false;
}

/** Number of the style's own words: fixed, or up to the first common keyword. */
static int count_own(const hs_region_style *style, const hs_args *args)
{
    const hs_syntax *syntax = &style->about.syntax;
    int n = syntax->n_min;
    if (syntax->n_max != syntax->n_min)
        while (n < args->n && !is_common_keyword(args->word[n])) ++n;
    return n < args->n ? n : args->n;
}

/** Check the common keywords in args (nothing else may be there). */
static hs_status check_keywords(const hs_region_style *style, const hs_args *args, bool has_variables, hs_error *err)
{
    for (int i = 0; i < args->n; ++i)
        if (strcmp(args->word[i], "open") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the keyword 'open' is not supported: regions have no open faces; a face at INF is no "
                           "wall; the keywords are side, units, move and rotate",
                           args->command);
    const hs_syntax syntax = {style->about.syntax.usage, 0, 0, common_keywords};
    return hs_syntax_check(&syntax, args, has_variables, err);
}

/** Check the words after the style's name. */
static hs_status check_words(const hs_region_style *style, const hs_args *args, bool has_variables, hs_error *err)
{
    const int n_own = count_own(style, args);
    const hs_args own = {.command = args->command, .n = n_own, .word = args->word};
    HS_TRY(hs_syntax_check(&style->about.syntax, &own, has_variables, err));
    const hs_args rest = hs_args_from(args, n_own, NULL);
    return check_keywords(style, &rest, has_variables, err);
}

static bool has_dollar(const hs_args *args)
{
    for (int i = 0; i < args->n; ++i)
        if (strchr(args->word[i], '$') != NULL) return true;
    return false;
}

hs_status hs_region_check(const hs_args *args, bool has_variables, hs_error *err)
{
    HS_TRY(hs_arg_need(args, 0, "the region style", err));
    if (strchr(args->word[0], '$') != NULL) return HS_OK;
    const hs_region_style *style = find_style(args->word[0]);
    if (style == NULL) return refuse_style(args->command, args->word[0], err);
    char command[96];
    snprintf(command, sizeof command, "%.40s %.40s", args->command, args->word[0]);
    const hs_args words = hs_args_from(args, 1, command);
    /* a variable may stand for several words: then counts mean nothing */
    if (has_variables && has_dollar(&words)) return HS_OK;
    return check_words(style, &words, has_variables, err);
}

static const hs_keyword *find_keyword(const char *word)
{
    const hs_keyword *keyword = common_keywords;
    while (strcmp(keyword->name, word) != 0) ++keyword;
    return keyword;
}

/** Read the common keywords. They were checked. Lengths of motions need the units, wherever these stand. */
static hs_status apply_keywords(hs_region *region, const hs_args *args, hs_error *err)
{
    bool is_lattice = true;
    for (int i = 0; i < args->n; i += 1 + find_keyword(args->word[i])->n_values) {
        if (strcmp(args->word[i], "side") == 0) region->is_outside = strcmp(args->word[i + 1], "out") == 0;
        if (strcmp(args->word[i], "units") == 0) is_lattice = strcmp(args->word[i + 1], "lattice") == 0;
    }
    for (int axis = 0; axis < 3; ++axis) region->scale[axis] = is_lattice ? region->env->lattice->spacing[axis] : 1.0;
    for (int i = 0; i < args->n; i += 1 + find_keyword(args->word[i])->n_values)
        if (strcmp(args->word[i], "move") == 0 || strcmp(args->word[i], "rotate") == 0)
            HS_TRY(hs_region_read_motion(region, args, i, err));
    return HS_OK;
}

static hs_status build(hs_region *region, const hs_args *args, hs_error *err)
{
    const hs_region_style *style = region->style;
    HS_TRY(check_words(style, args, false, err));
    const int n_own = count_own(style, args);
    const hs_args own = {.command = args->command, .n = n_own, .word = args->word};
    const hs_args rest = hs_args_from(args, n_own, NULL);
    HS_TRY(apply_keywords(region, &rest, err));
    if (style->state_size > 0) HS_TRY(hs_memory_alloc(&region->state, 1, style->state_size, err));
    HS_TRY(style->create(region, &own, err));
    if (region->is_outside || region->is_varying) region->has_extent = false;
    return HS_OK;
}

hs_status hs_region_create(hs_region **region, hs_env *env, const char *id, const char *style_name, const hs_args *args,
                           hs_error *err)
{
    *region = NULL;
    const hs_region_style *style = find_style(style_name);
    if (style == NULL) return refuse_style(args->command, style_name, err);
    hs_region *made = NULL;
    HS_TRY(HS_ALLOC(made, 1, err));
    made->style = style;
    made->env = env;
    hs_status status = hs_memory_strdup(&made->id, id, err);
    if (status == HS_OK) status = build(made, args, err);
    if (status == HS_OK)
        *region = made;
    else
        hs_region_destroy(&made);
    return status;
}

void hs_region_destroy(hs_region **region)
{
    if (*region == NULL) return;
    if ((*region)->style->destroy != NULL && (*region)->state != NULL) (*region)->style->destroy(*region);
    hs_region_fini_motion(*region);
    HS_FREE((*region)->state);
    HS_FREE((*region)->id);
    HS_FREE(*region);
}

hs_status hs_region_length(const hs_region *region, const hs_args *args, int i, int axis, double *value, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "a length", err));
    if (strncmp(args->word[i], "v_", 2) == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: '%s': only radii, and centers of spheres and cylinders, can follow a variable during the "
                       "run; ${%s} takes the variable's present value, and the keywords move and rotate move a region",
                       args->command, args->word[i], args->word[i] + 2);
    HS_TRY(hs_arg_double(args, i, value, err));
    *value = region->scale[axis] * *value;
    return HS_OK;
}

hs_status hs_region_bound(hs_region *region, const hs_args *args, int i, int axis, int end, double *value,
                          hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "a bound", err));
    const bool is_inf = strcmp(args->word[i], "INF") == 0, is_edge = strcmp(args->word[i], "EDGE") == 0;
    if (region->env->is_resuming && strncmp(args->word[i], "EDGE=", 5) == 0) { /* a checkpoint keeps the place */
        *value = strtod(args->word[i] + 5, NULL);
        region->edge[region->n_edges++ % 6] = *value;
        return HS_OK;
    }
    if (!is_inf && !is_edge) return hs_region_length(region, args, i, axis, value, err);
    const hs_box *box = region->env->box;
    if (!box->exists)
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s can only be used once the box exists (create_box, read_data)",
                       args->command, args->word[i]);
    double lo[3], hi[3];
    hs_box_bounds(box, lo, hi);
    if (is_inf)
        *value = end == 0 ? -HS_REGION_FAR : HS_REGION_FAR;
    else
        region->edge[region->n_edges++ % 6] = *value = end == 0 ? lo[axis] : hi[axis];
    return HS_OK;
}
