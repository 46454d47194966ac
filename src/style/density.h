/** Density modes of a group at the wave vectors of the periodic box: rho(q) = sum over atoms of exp(-i q r), for
 *  structure factors and scattering functions. */
#ifndef HS_STYLE_DENSITY_H
#define HS_STYLE_DENSITY_H

#include "core/fourier.h"
#include "style/env.h"

/** Wave vectors with 0 < |q| <= q_max, of q and -q one: those whose products with the edges of the box are 2 pi n_x, 2
 *  pi n_y and 2 pi n_z, so q = 2 pi (n_x/L_x, n_y/L_y, n_z/L_z) in an orthogonal box. Zero it, set q_max, and free it
 *  with hs_density_fini. */
typedef struct hs_density {
    double q_max;    /**< 1/distance */
    int n_max[3];    /**< of the present modes */
    hs_modes *modes; /**< owned */
} hs_density;

/** Refuse boxes that have no wave vectors of their own; @p command is named. */
HS_MUST_USE hs_status hs_density_check_box(const hs_env *env, const char *command, hs_error *err);
/** Make room for the modes of the present box. */
HS_MUST_USE hs_status hs_density_prepare(hs_density *density, const hs_env *env, const char *command, hs_error *err);
void hs_density_fini(hs_density *density);
/** rho(q) of the atoms with a bit of @p mask, for hs_modes_get. The same bits on any ranks and threads (collective). */
HS_MUST_USE hs_status hs_density_eval(hs_density *density, const hs_env *env, uint32_t mask, hs_error *err);

/** Called for every wave vector: its number k from 0, the mode n, q and its length. */
typedef void (*hs_density_visit)(void *context, int k, const int n[3], const double q[3], double length);
/** Returns how many there are. visit may be NULL. */
int hs_density_each(const hs_density *density, const hs_env *env, hs_density_visit visit, void *context);

#endif
