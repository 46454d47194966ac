/** Places of the local atoms with the box they are in: now, or when the latest forces were computed.
 *
 *  Energies and virials belong to the forces. Where a fix changes the box at the end of a step (fix deform), those of the
 *  step, and what is to add up to them (compute pe/atom, stress/atom, energies of fixes), are of the places before; all that
 *  is measured otherwise is of the places after, as in LAMMPS. */
#ifndef HS_STYLE_PLACES_H
#define HS_STYLE_PLACES_H

#include "style/env.h"

typedef struct hs_places {
    const double *x[3]; /**< [n_local], distance; borrowed */
    const hs_box *box;  /**< borrowed */
} hs_places;

static inline hs_places hs_places_now(const hs_env *env)
{
    const hs_atoms *atoms = env->atoms;
    return (hs_places){.x = {atoms->x[0], atoms->x[1], atoms->x[2]}, .box = env->box};
}

/** Those of the latest forces, of the present step. Valid like env->pair_energy, until atoms or box change. */
static inline hs_places hs_places_of_forces(const hs_env *env)
{
    return env->force_places != NULL ? *env->force_places : hs_places_now(env);
}

/** Unwrapped place of a local atom along an axis, distance. */
static inline double hs_places_unwrapped(const hs_places *places, const hs_atoms *atoms, int axis, int i)
{
    const hs_box *box = places->box;
    double unwrapped = places->x[axis][i] + atoms->image[axis][i] * hs_box_length(box, axis);
    for (int edge = axis + 1; edge < 3 && box->is_tilted; ++edge)
        unwrapped += atoms->image[edge][i] * box->tilt[axis + edge - 1];
    return unwrapped;
}

/** The same for the place now. */
static inline double hs_unwrapped(const hs_env *env, int axis, int i)
{
    const hs_places now = hs_places_now(env);
    return hs_places_unwrapped(&now, env->atoms, axis, i);
}

/** All of it. */
static inline void hs_unwrapped_place(const hs_env *env, int i, double r[3])
{
    for (int axis = 0; axis < 3; ++axis) r[axis] = hs_unwrapped(env, axis, i);
}

/** Along an axis for the atoms [begin, end). */
static inline void hs_unwrapped_run(const hs_env *env, int axis, int begin, int end, double *unwrapped)
{
    const hs_box *box = env->box;
    const double *x = env->atoms->x[axis] + begin, length = hs_box_length(box, axis);
    const int32_t *image = env->atoms->image[axis] + begin;
    for (int k = 0; k < end - begin; ++k) unwrapped[k] = x[k] + image[k] * length;
    for (int edge = axis + 1; edge < 3 && box->is_tilted; ++edge) {
        const double tilt = box->tilt[axis + edge - 1];
        const int32_t *crossed = env->atoms->image[edge] + begin;
        for (int k = 0; k < end - begin; ++k) unwrapped[k] += crossed[k] * tilt;
    }
}

#endif
