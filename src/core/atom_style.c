#include "core/atom_style.h"

#include <string.h>

const char *const hs_atom_part_names[] = {"atomic", "sphere", "dipole", NULL};

bool hs_atom_style_has(const hs_atom_style *style, hs_atom_part part)
{
    for (int k = 0; k < style->n_parts; ++k)
        if (style->part[k] == part) return true;
    return false;
}

void hs_atom_style_name(const hs_atom_style *style, char name[HS_ATOM_STYLE_NAME_SIZE])
{
    name[0] = '\0';
    if (style->is_hybrid) strcat(name, "hybrid");
    for (int k = 0; k < style->n_parts; ++k) {
        if (name[0] != '\0') strcat(name, " ");
        strcat(name, hs_atom_part_names[style->part[k]]);
    }
    if (style->n_parts == 0) strcpy(name, hs_atom_part_names[HS_ATOM_ATOMIC]);
}

static void remove_fields(hs_atoms *atoms)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_atoms_remove_field(atoms, (void **)&atoms->mu[axis]);
        hs_atoms_remove_field(atoms, (void **)&atoms->omega[axis]);
    }
    hs_atoms_remove_field(atoms, (void **)&atoms->mu_length);
    hs_atoms_remove_field(atoms, (void **)&atoms->radius);
    hs_atoms_remove_field(atoms, (void **)&atoms->rmass);
}

hs_status hs_atoms_set_style(hs_atoms *atoms, const hs_atom_style *style, hs_error *err)
{
    static const char *const mu_name[3] = {"mux", "muy", "muz"}, *const omega_name[3] = {"omegax", "omegay", "omegaz"};
    remove_fields(atoms);
    atoms->style = *style;
    if (hs_atom_style_has(style, HS_ATOM_SPHERE)) {
        HS_TRY(hs_atoms_add_field(atoms, "radius", (void **)&atoms->radius, sizeof(double), true, err));
        HS_TRY(hs_atoms_add_field(atoms, "rmass", (void **)&atoms->rmass, sizeof(double), false, err));
        for (int axis = 0; axis < 3; ++axis)
            HS_TRY(
                hs_atoms_add_field(atoms, omega_name[axis], (void **)&atoms->omega[axis], sizeof(double), false, err));
    }
    if (hs_atom_style_has(style, HS_ATOM_DIPOLE)) {
        for (int axis = 0; axis < 3; ++axis)
            HS_TRY(hs_atoms_add_field(atoms, mu_name[axis], (void **)&atoms->mu[axis], sizeof(double), false, err));
        HS_TRY(hs_atoms_add_field(atoms, "mu", (void **)&atoms->mu_length, sizeof(double), false, err));
    }
    return HS_OK;
}
