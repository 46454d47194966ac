/** Fixes and commands that change the box, and bring atoms along. */
#ifndef HS_STYLE_BOX_CHANGE_H
#define HS_STYLE_BOX_CHANGE_H

#include "style/env.h"

/** Give the box new bounds. Atoms with a group bit of @p mask keep their fractions of the box (0: all atoms stay where they
 *  are). In reproducible runs bounds and displacements are rounded to the position grid, and an atom that follows moves alike in
 *  all its periodic images. One that stays does so in the image it is in, as in LAMMPS. Not collective; the same on all ranks. */
void hs_box_change(hs_env *env, const double lo[3], const double hi[3], uint32_t mask);

#endif
