#include "deck/set_styles.h"

#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "core/random.h"

static const hs_keyword keywords[] = {HS_SET_STYLE_KEYWORDS, {NULL, 0, NULL, NULL}};

bool hs_set_is_style_keyword(const char *keyword)
{
    for (const hs_keyword *k = keywords; k->name != NULL; ++k)
        if (strcmp(k->name, keyword) == 0) return true;
    return false;
}

hs_status hs_set_need_style(const hs_atoms *atoms, const char *keyword, hs_error *err)
{
    const bool is_dipole = strncmp(keyword, "dipole", 6) == 0;
    if ((is_dipole ? atoms->mu_length : atoms->radius) != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "set: '%s' needs atoms %s: 'atom_style %s' (or 'hybrid dipole sphere')%s",
                   keyword, is_dipole ? "with dipoles" : "that are spheres", is_dipole ? "dipole" : "sphere",
                   strcmp(keyword, "mass") == 0 ? "; the command 'mass' sets masses of types" : "");
}

/** Set one atom; NULL, or what a value must be. */
static const char *set_one(hs_atoms *atoms, int i, const char *keyword, const double value[3])
{
    if (strcmp(keyword, "dipole") == 0) {
        hs_atom_set_dipole(atoms, i, value);
    } else if (strcmp(keyword, "omega") == 0) {
        for (int axis = 0; axis < 3; ++axis) atoms->omega[axis][i] = value[axis];
    } else if (strcmp(keyword, "diameter") == 0) {
        if (!(value[0] >= 0.0)) return "at least 0";
        atoms->radius[i] = 0.5 * value[0];
    } else {
        const double radius = atoms->radius[i];
        if (!(value[0] > 0.0)) return "greater than 0";
        if (strcmp(keyword, "mass") == 0)
            atoms->rmass[i] = value[0];
        else if (strcmp(keyword, "density") == 0)
            atoms->rmass[i] = value[0] * hs_ball_volume(radius);
        else
            atoms->rmass[i] = radius > 0.0 ? value[0] * M_PI * radius * radius : value[0];
    }
    return NULL;
}

hs_status hs_set_style_values(hs_atoms *atoms, const unsigned char *flag, const char *keyword, double *const values[3],
                              hs_error *err)
{
    for (int i = 0; i < atoms->n_local; ++i) {
        double value[3] = {0.0};
        if (!flag[i]) continue;
        for (int k = 0; k < 3; ++k)
            if (values[k] != NULL) value[k] = values[k][i];
        const char *wanted = set_one(atoms, i, keyword, value);
        if (wanted != NULL) return hs_fail(err, HS_ERROR_INPUT, "set: the %s %g is not %s", keyword, value[0], wanted);
    }
    return HS_OK;
}

hs_status hs_set_random_dipoles(hs_sim *sim, const unsigned char *flag, const hs_args *args, int i, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    int64_t seed;
    double length;
    HS_TRY(hs_arg_int(args, i + 1, 1, INT32_MAX - 1, &seed, err));
    HS_TRY(hs_arg_positive(args, i + 2, &length, err));
    for (int k = 0; k < atoms->n_local; ++k) {
        if (!flag[k]) continue;
        const double x[3] = {atoms->x[0][k], atoms->x[1][k], atoms->x[2][k]};
        double mu[3] = {0.0}, sum = 0.0;
        hs_park park;
        hs_park_reset_at(&park, (int)seed, x);
        for (int axis = 0; axis < sim->box.dimension; ++axis) {
            mu[axis] = hs_park_uniform(&park) - 0.5;
            sum += mu[axis] * mu[axis];
        }
        for (int axis = 0; axis < 3; ++axis) mu[axis] *= length / sqrt(sum);
        hs_atom_set_dipole(atoms, k, mu);
    }
    return HS_OK;
}
