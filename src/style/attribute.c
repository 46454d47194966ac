#include "style/attribute.h"

#include <string.h>

const char *const hs_attributes[] = {
    "id", "type", "element", "mass", "proc", "procp1", "x",  "y",  "z",  "xs", "ys", "zs", "xu", "yu",
    "zu", "xsu",  "ysu",     "zsu",  "ix",   "iy",     "iz", "vx", "vy", "vz", "fx", "fy", "fz", NULL,
};

int hs_attribute_find(const char *name)
{
    for (int k = 0; k < HS_N_ATTRIBUTES; ++k)
        if (strcmp(hs_attributes[k], name) == 0) return k;
    return -1;
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
        return atoms->mass[atoms->type[i]];
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
