#include "style/fix.h"

hs_status hs_fix_noise(const hs_fix *fix, int64_t seed, hs_noise *noise, hs_error *err)
{
    hs_text name = {0};
    const hs_status status = hs_text_printf(&name, err, "%s %s", fix->style->about.name, fix->id);
    *noise = hs_noise_open(seed, hs_text_get(&name));
    hs_text_fini(&name);
    return status;
}

void hs_fix_add_virial(double virial[6], const hs_env *env, int i, const double f[3])
{
    double r[3];
    for (int axis = 0; axis < 3; ++axis)
        r[axis] = env->atoms->x[axis][i] + env->atoms->image[axis][i] * hs_box_length(env->box, axis);
    for (int axis = 0; axis < 3; ++axis) virial[axis] += r[axis] * f[axis];
    virial[3] += r[0] * f[1];
    virial[4] += r[0] * f[2];
    virial[5] += r[1] * f[2];
}
