#include "style/attribute.h"

#include <string.h>

#include "core/atom_style.h"

const char *const hs_attributes[] = {
    "id", "type", "element", "mass", "proc",   "procp1", "x",      "y",  "z",      "xs",       "ys", "zs", "xu",
    "yu", "zu",   "xsu",     "ysu",  "zsu",    "ix",     "iy",     "iz", "vx",     "vy",       "vz", "fx", "fy",
    "fz", "mux",  "muy",     "muz",  "omegax", "omegay", "omegaz", "mu", "radius", "diameter", NULL,
};

int hs_attribute_find(const char *name)
{
    for (int k = 0; k < HS_N_ATTRIBUTES; ++k)
        if (strcmp(hs_attributes[k], name) == 0) return k;
    return -1;
}

hs_status hs_attribute_check(hs_attribute attribute, const hs_atoms *atoms, hs_error *err)
{
    if (attribute < HS_ATTR_MUX || attribute >= HS_N_ATTRIBUTES) return HS_OK;
    const bool is_dipole = attribute <= HS_ATTR_MUZ || attribute == HS_ATTR_MU;
    if ((is_dipole ? atoms->mu_length : atoms->radius) != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "'%s' needs atoms %s: 'atom_style %s'", hs_attributes[attribute],
                   is_dipole ? "with dipoles" : "that are spheres", is_dipole ? "dipole" : "sphere");
}

/** Position along an axis and image. */
static double position(const hs_env *env, bool is_wrapped, int axis, int i, int32_t *image)
{
    const hs_atoms *atoms = env->atoms;
    *image = atoms->image[axis][i];
    if (!is_wrapped) return atoms->x[axis][i];
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    int32_t images[3] = {atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]};
    hs_box_wrap(env->box, x, images);
    *image = images[axis];
    return x[axis];
}

double hs_attribute_value(const hs_env *env, hs_attribute attribute, bool is_wrapped, int i)
{
    const hs_atoms *atoms = env->atoms;
    const hs_box *box = env->box;
    int32_t image;
    switch (attribute) {
    case HS_ATTR_ID:
        return (double)atoms->id[i];
    case HS_ATTR_TYPE:
    case HS_ATTR_ELEMENT:
        return atoms->type[i];
    case HS_ATTR_MASS:
        return hs_atom_mass(atoms, i);
    case HS_ATTR_MU:
        return atoms->mu_length[i];
    case HS_ATTR_RADIUS:
        return atoms->radius[i];
    case HS_ATTR_DIAMETER:
        return 2.0 * atoms->radius[i];
    case HS_ATTR_PROC:
        return env->parallel->rank;
    case HS_ATTR_PROCP1:
        return env->parallel->rank + 1;
    default:
        break;
    }
    const int axis = (attribute - HS_ATTR_X) % 3;
    switch (attribute - axis) {
    case HS_ATTR_VX:
        return atoms->v[axis][i];
    case HS_ATTR_FX:
        return atoms->f[axis][i];
    case HS_ATTR_MUX:
        return atoms->mu[axis][i];
    case HS_ATTR_OMEGAX:
        return atoms->omega[axis][i];
    default:
        break;
    }
    const double x = position(env, is_wrapped, axis, i, &image), length = hs_box_length(box, axis);
    switch (attribute - axis) {
    case HS_ATTR_X:
        return x;
    case HS_ATTR_XS:
        return (x - box->lo[axis]) * (1.0 / length);
    case HS_ATTR_XU:
        return x + image * length;
    case HS_ATTR_XSU:
        return (x - box->lo[axis]) * (1.0 / length) + image;
    default:
        return image;
    }
}
