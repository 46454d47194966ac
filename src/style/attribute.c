#include "style/attribute.h"

#include <string.h>

#include "core/atom_style.h"
#include "style/box_flow.h"

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

/** x, xs, xu, xsu, ix and those of y and z: position and images of atom i. */
static double place_value(const hs_env *env, hs_attribute attribute, int axis, bool is_wrapped, int i)
{
    const hs_atoms *atoms = env->atoms;
    const hs_box *box = env->box;
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]}, fraction[3];
    int32_t image[3] = {atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]};
    if (is_wrapped) hs_box_wrap(box, x, image);
    switch (attribute - axis) {
    case HS_ATTR_X:
        return x[axis];
    case HS_ATTR_XU:
        return hs_box_unwrapped(box, x, image, axis);
    case HS_ATTR_XS:
    case HS_ATTR_XSU:
        if (box->is_tilted)
            hs_box_fractions(box, x, fraction);
        else
            fraction[axis] = (x[axis] - box->lo[axis]) * (1.0 / hs_box_length(box, axis));
        return attribute - axis == HS_ATTR_XS ? fraction[axis] : fraction[axis] + image[axis];
    default:
        return image[axis];
    }
}

/** Velocity of the atom's image in the box, along an axis (remap v of fix deform). */
static double velocity_of_image(const hs_env *env, int axis, int i)
{
    const hs_atoms *atoms = env->atoms;
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]},
           v[3] = {atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]};
    int32_t crossed[3] = {0, 0, 0};
    hs_box_wrap(env->box, x, crossed);
    hs_box_flow_cross(env, atoms->mask[i], crossed, v);
    return v[axis];
}

double hs_attribute_value(const hs_env *env, hs_attribute attribute, bool is_wrapped, int i)
{
    const hs_atoms *atoms = env->atoms;
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
        return is_wrapped ? velocity_of_image(env, axis, i) : atoms->v[axis][i];
    case HS_ATTR_FX:
        return atoms->f[axis][i];
    case HS_ATTR_MUX:
        return atoms->mu[axis][i];
    case HS_ATTR_OMEGAX:
        return atoms->omega[axis][i];
    default:
        break;
    }
    return place_value(env, attribute, axis, is_wrapped, i);
}
