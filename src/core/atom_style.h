/** Atom styles: what atoms have besides id, type, place and velocity. */
#ifndef HS_CORE_ATOM_STYLE_H
#define HS_CORE_ATOM_STYLE_H

#include <math.h>

#include "core/atoms.h"

/** The style of the deck command atom_style, e.g. `hybrid dipole sphere`: {.is_hybrid = true, .n_parts = 2, ...}. */
enum { HS_ATOM_STYLE_NAME_SIZE = 64 };

/** Names of the parts, by hs_atom_part, ended by NULL. */
extern const char *const hs_atom_part_names[];

bool hs_atom_style_has(const hs_atom_style *style, hs_atom_part part);
/** The words of atom_style. */
void hs_atom_style_name(const hs_atom_style *style, char name[HS_ATOM_STYLE_NAME_SIZE]);
/** Give atoms the fields of a style, and take those of the style before; there may be no atoms yet. */
HS_MUST_USE hs_status hs_atoms_set_style(hs_atoms *atoms, const hs_atom_style *style, hs_error *err);

/** Mass of a local atom: its own where atoms have one, else that of its type. */
static inline double hs_atom_mass(const hs_atoms *atoms, int i)
{
    return atoms->rmass != NULL ? atoms->rmass[i] : atoms->mass[atoms->type[i]];
}

/** Volume of a ball; a radius of 0 is a point, whose "density" is its mass. Volumes are those of balls in two
 *  dimensions, too. */
static inline double hs_ball_volume(double radius)
{
    return radius > 0.0 ? 4.0 * M_PI / 3.0 * radius * radius * radius : 1.0;
}

/** Set the dipole moment of a local atom. */
static inline void hs_atom_set_dipole(hs_atoms *atoms, int i, const double mu[3])
{
    for (int axis = 0; axis < 3; ++axis) atoms->mu[axis][i] = mu[axis];
    atoms->mu_length[i] = sqrt(mu[0] * mu[0] + mu[1] * mu[1] + mu[2] * mu[2]);
}

#endif
