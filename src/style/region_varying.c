/** Regions whose place, direction or size follow variables of the deck. Evaluated by hs_region_update only: what asks for
 *  atoms may be a loop of threads. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "style/region.h"
#include "style/unit_vector.h"

/** Where x was before the region moved: in the region's own coordinates. */
static void own_place(const hs_region_motion *motion, const double x[3], double own[3])
{
    for (int a = 0; a < 3; ++a) own[a] = x[a] - motion->d[a];
    if (motion->angle == NULL) return;
    const double r[3] = {own[0] - motion->point[0], own[1] - motion->point[1], own[2] - motion->point[2]};
    for (int a = 0; a < 3; ++a)
        own[a] = motion->point[a] + motion->turn[0][a] * r[0] + motion->turn[1][a] * r[1] + motion->turn[2][a] * r[2];
}

bool hs_region_contains(const hs_region *region, const double x[3])
{
    double own[3];
    if (region->motion != NULL) own_place(region->motion, x, own);
    return region->style->inside(region, region->motion != NULL ? own : x) != region->is_outside;
}

int hs_region_surfaces(const hs_region *region, const double x[3], double cutoff, hs_contact *contact)
{
    const hs_region_motion *motion = region->motion;
    double own[3];
    if (motion == NULL) return region->style->surfaces(region, x, cutoff, contact);
    own_place(motion, x, own);
    const int n = region->style->surfaces(region, own, cutoff, contact);
    for (int k = 0; k < n && motion->angle != NULL; ++k) {
        const double away[3] = {contact[k].away[0], contact[k].away[1], contact[k].away[2]};
        for (int a = 0; a < 3; ++a)
            contact[k].away[a] =
                motion->turn[a][0] * away[0] + motion->turn[a][1] * away[1] + motion->turn[a][2] * away[2];
    }
    return n;
}

/** The rotation by an angle about the axis (Rodrigues). */
static void set_turn(hs_region_motion *motion, double angle)
{
    const double c = cos(angle), s = sin(angle), *u = motion->axis;
    const double cross[3][3] = {{0.0, -u[2], u[1]}, {u[2], 0.0, -u[0]}, {-u[1], u[0], 0.0}};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) motion->turn[a][b] = (a == b ? c : 0.0) + s * cross[a][b] + (1.0 - c) * u[a] * u[b];
}

static hs_status check_variable(const hs_region *region, const char *name, const char *who, hs_error *err)
{
    if (name == NULL || hs_env_variable_kind(region->env, name) == HS_NUMBER_VARIABLE) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the region '%s' follows v_%s, and there is no equal-style variable '%s'",
                   who, region->id, name, name);
}

hs_status hs_region_check_variables(const hs_region *region, const char *who, hs_error *err)
{
    for (int k = 0; k < region->n_sizes; ++k) HS_TRY(check_variable(region, region->size[k].variable, who, err));
    for (int a = 0; a < 3 && region->motion != NULL; ++a)
        HS_TRY(check_variable(region, region->motion->move[a], who, err));
    return region->motion != NULL ? check_variable(region, region->motion->angle, who, err) : HS_OK;
}

static hs_status evaluate(const hs_region *region, const char *name, double *value, hs_error *err)
{
    char who[160];
    snprintf(who, sizeof who, "region '%.100s' (%.40s)", region->id, region->style->about.name);
    HS_TRY(check_variable(region, name, who, err));
    return region->env->variable_value(region->env->deck, name, value, err);
}

hs_status hs_region_update(hs_region *region, hs_error *err)
{
    hs_region_motion *motion = region->motion;
    if (!region->is_varying) return HS_OK;
    if (region->style->update != NULL) HS_TRY(region->style->update(region, err));
    for (int k = 0; k < region->n_sizes; ++k) {
        hs_region_size *size = &region->size[k];
        if (size->variable == NULL) continue;
        HS_TRY(evaluate(region, size->variable, &size->value, err));
        size->value *= size->scale;
    }
    if (region->style->fit != NULL && !region->style->fit(region))
        return hs_fail(err, HS_ERROR_RUN,
                       "region '%s' (%s): at step %lld the variables that it follows make no shape: a radius "
                       "is negative",
                       region->id, region->style->about.name, (long long)region->env->step);
    for (int a = 0; a < 3 && motion != NULL; ++a)
        if (motion->move[a] != NULL) HS_TRY(evaluate(region, motion->move[a], &motion->d[a], err));
    if (motion == NULL || motion->angle == NULL) return HS_OK;
    double angle;
    HS_TRY(evaluate(region, motion->angle, &angle, err));
    set_turn(motion, angle);
    return HS_OK;
}

hs_status hs_region_add_size(hs_region *region, const hs_args *args, int i, int axis, hs_error *err)
{
    hs_region_size *size = &region->size[region->n_sizes++];
    size->scale = region->scale[axis];
    HS_TRY(hs_arg_need(args, i, "a length", err));
    if (strncmp(args->word[i], "v_", 2) != 0) return hs_region_length(region, args, i, axis, &size->value, err);
    region->is_varying = true;
    return hs_memory_strdup(&size->variable, args->word[i] + 2, err);
}

hs_status hs_region_fit(hs_region *region, const hs_args *args, int i, const char *expected, hs_error *err)
{
    const bool is_fine = region->style->fit(region);
    return is_fine || strncmp(args->word[i], "v_", 2) == 0 ? HS_OK : hs_arg_refuse(args, i, expected, NULL, err);
}

static hs_status read_variable(char **name, const hs_args *args, int i, hs_error *err)
{
    if (strncmp(args->word[i], "v_", 2) == 0) return hs_memory_replace(name, args->word[i] + 2, err);
    return hs_arg_refuse(args, i, "v_name, an equal-style variable", NULL, err);
}

hs_status hs_region_read_motion(hs_region *region, const hs_args *args, int i, hs_error *err)
{
    if (region->style->uses != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s is for the regions that this one is made of", args->command,
                       args->word[i]);
    if (region->motion == NULL) HS_TRY(HS_ALLOC(region->motion, 1, err));
    hs_region_motion *motion = region->motion;
    region->is_varying = true;
    for (int a = 0; a < 3; ++a) motion->turn[a][a] = 1.0;
    if (strcmp(args->word[i], "move") == 0) {
        for (int a = 0; a < 3; ++a)
            if (strcmp(args->word[i + 1 + a], "NULL") != 0)
                HS_TRY(read_variable(&motion->move[a], args, i + 1 + a, err));
        return HS_OK;
    }
    HS_TRY(read_variable(&motion->angle, args, i + 1, err));
    for (int a = 0; a < 3; ++a) HS_TRY(hs_region_length(region, args, i + 2 + a, a, &motion->point[a], err));
    return hs_arg_direction(args, i + 5, motion->axis, err);
}

void hs_region_fini_motion(hs_region *region)
{
    for (int k = 0; k < region->n_sizes; ++k) HS_FREE(region->size[k].variable);
    for (int a = 0; a < 3 && region->motion != NULL; ++a) HS_FREE(region->motion->move[a]);
    if (region->motion != NULL) HS_FREE(region->motion->angle);
    HS_FREE(region->motion);
}
