#include "style/fix.h"

#include "base/memory.h"
#include "style/atom_sum.h"

hs_status hs_fix_noise(const hs_fix *fix, int64_t seed, hs_noise *noise, hs_error *err)
{
    hs_text name = {0};
    const hs_status status = hs_text_printf(&name, err, "%s %s", fix->style->about.name, fix->id);
    *noise = hs_noise_open(seed, hs_text_get(&name));
    hs_text_fini(&name);
    return status;
}

hs_status hs_fix_vector_add(const hs_fix *fix, hs_fix_vector *vector, const char *what, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_text name = {0};
        HS_TRY(hs_text_printf(&name, err, "fix %s %s %c", fix->id, what, "xyz"[axis]));
        vector->name[axis] = name.data;
        HS_TRY(hs_atoms_add_field(fix->env->atoms, vector->name[axis], (void **)&vector->of[axis], sizeof(double),
                                  false, err));
    }
    return HS_OK;
}

void hs_fix_vector_remove(const hs_fix *fix, hs_fix_vector *vector)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_atoms_remove_field(fix->env->atoms, (void **)&vector->of[axis]);
        HS_FREE(vector->name[axis]);
    }
}

typedef struct virial_context {
    const hs_fix *fix;
    hs_fix_force force;
} virial_context;

static void add_virial(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const virial_context *virial = context;
    const hs_box *box = virial->fix->env->box;
    for (int i = begin; i < end; ++i) {
        double f[3] = {0.0}, r[3];
        if (!(atoms->mask[i] & virial->fix->mask) || !virial->force(virial->fix, i, f)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            r[axis] = atoms->x[axis][i] + atoms->image[axis][i] * hs_box_length(box, axis);
            hs_exact_add(&sums[axis], r[axis] * f[axis]);
        }
        hs_exact_add(&sums[3], r[0] * f[1]);
        hs_exact_add(&sums[4], r[0] * f[2]);
        hs_exact_add(&sums[5], r[1] * f[2]);
    }
}

void hs_fix_sum_virial(hs_fix *fix, hs_fix_force force)
{
    const virial_context context = {.fix = fix, .force = force};
    hs_atom_sum(fix->env->atoms, fix->env->parallel, add_virial, &context, 6, fix->virial);
}
