#include "style/atom_vector.h"

#include "base/memory.h"
#include "base/text.h"
#include "style/places.h"

hs_status hs_atom_vector_add(hs_atoms *atoms, hs_atom_vector *vector, const char *kind, const char *id,
                             const char *what, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_text name = {0};
        HS_TRY(hs_text_printf(&name, err, "%s %s %s %c", kind, id, what, "xyz"[axis]));
        vector->name[axis] = name.data;
        HS_TRY(hs_atoms_add_field(atoms, vector->name[axis], (void **)&vector->of[axis], sizeof(double), false, err));
    }
    return HS_OK;
}

void hs_atom_vector_set_places(hs_atom_vector *vector, const hs_env *env, const double origin[3])
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_atoms_mark_place(env->atoms, (void **)&vector->of[axis], axis);
#pragma omp parallel for schedule(static)
        for (int i = 0; i < env->atoms->n_local; ++i) vector->of[axis][i] = hs_unwrapped(env, axis, i) - origin[axis];
    }
}

void hs_atom_vector_remove(hs_atoms *atoms, hs_atom_vector *vector)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_atoms_remove_field(atoms, (void **)&vector->of[axis]);
        HS_FREE(vector->name[axis]);
    }
}
