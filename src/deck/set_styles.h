/** Keywords of `set` that only some atom styles have. */
#ifndef HS_DECK_SET_STYLES_H
#define HS_DECK_SET_STYLES_H

#include "sim/sim.h"

/** The entries for set's table of keywords. */
#define HS_SET_STYLE_KEYWORDS                                                                                          \
    {"diameter", 1, "<d>", "diameter of spheres, distance; the mass stays"},                                           \
        {"density", 1, "<rho>", "mass of spheres from their volume; of points, the mass itself"},                      \
        {"density/disc", 1, "<rho>", "mass from the area of a disc of that diameter"},                                 \
        {"mass", 1, "<m>", "own mass of each atom"},                                                                   \
        {"dipole", 3, "<mux> <muy> <muz>", "dipole moment: numbers or atom-style variables"},                          \
        {"dipole/random", 2, "<seed> <length>", "dipole of that length in a random direction (of the plane, in 2d)"},  \
    {                                                                                                                  \
        "omega", 3, "<wx> <wy> <wz>", "angular velocity of spheres, 1/time"                                            \
    }

/** Whether the keyword is one of them, and how many values it takes of each atom. */
bool hs_set_is_style_keyword(const char *keyword);
/** Refuse a keyword that atoms of the present style do not have. */
HS_MUST_USE hs_status hs_set_need_style(const hs_atoms *atoms, const char *keyword, hs_error *err);
/** Set one value, or three, of each flagged local atom; values[k][n_local]. */
HS_MUST_USE hs_status hs_set_style_values(hs_atoms *atoms, const unsigned char *flag, const char *keyword,
                                          double *const values[3], hs_error *err);
/** dipole/random: LAMMPS's directions, drawn from each atom's place. */
HS_MUST_USE hs_status hs_set_random_dipoles(hs_sim *sim, const unsigned char *flag, const hs_args *args, int i,
                                            hs_error *err);

#endif
