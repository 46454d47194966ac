/** Rotation of spheres: what fix nve/sphere, and nvt, npt and nph for spheres, share.
 *
 *      I omega' = torque,  mu' = omega x mu,  I = (2/5) m R^2, for discs (1/2) m R^2
 *
 *  A torque acts from the moment on that something exerts one (hs_torques_want); else spheres turn freely. */
#ifndef HS_STYLE_SPHERES_H
#define HS_STYLE_SPHERES_H

#include "style/fix.h"

/** How dipoles follow the rotation: not at all; by one step of Euler's, brought back to their length; by five rotations about
 *  the axes (A. Dullweber, B. Leimkuhler, R. McLachlan, J. Chem. Phys. 107, 5840 (1997), doi:10.1063/1.474310), which are good
 *  to second order. */
typedef enum { HS_DIPOLES_STAY, HS_DIPOLES_EULER, HS_DIPOLES_DLM } hs_dipole_update;

typedef struct hs_spheres {
    bool has_rotation; /**< the fix turns its atoms */
    bool is_disc;
    hs_dipole_update dipoles;
} hs_spheres;

/** Keywords of such fixes. */
#define HS_SPHERES_KEYWORDS                                                                                            \
    {"update", 1, "dipole|dipole/dlm", "dipoles turn with their atoms: a simple step, or the better one of DLM"},      \
    {                                                                                                                  \
        "disc", 0, "", "moments of inertia of discs, in two dimensions"                                                \
    }

/** Moment of inertia over m R^2 of a sphere. */
#define HS_SPHERE_INERTIA 0.4

/** Somebody exerts torques: env->torque is there until as many have given it up. */
HS_MUST_USE hs_status hs_torques_want(hs_env *env, hs_error *err);
void hs_torques_release(hs_env *env);

/** Moment of inertia of local atom i, a sphere; mass distance^2. */
double hs_sphere_inertia(const hs_atoms *atoms, int i);

/** Read keyword i; *n_used = words, 0 when it is another's. */
HS_MUST_USE hs_status hs_spheres_read(hs_spheres *spheres, const hs_fix *fix, const hs_args *args, int i, int *n_used,
                                      hs_error *err);
/** Fail unless there are spheres, with dipoles where these are to turn; part of create. */
HS_MUST_USE hs_status hs_spheres_check_style(const hs_spheres *spheres, const hs_fix *fix, const hs_args *args,
                                             hs_error *err);
/** Before a run: fail where atoms of the group are points, which nothing can turn (collective). */
HS_MUST_USE hs_status hs_spheres_check(const hs_fix *fix, hs_error *err);
/** Half a step of the group's angular velocities. */
void hs_spheres_kick(const hs_spheres *spheres, const hs_fix *fix, double dt);
/** A step of their dipoles. */
void hs_spheres_turn(const hs_spheres *spheres, const hs_fix *fix, double dt);
/** Angular velocities times a factor. */
void hs_spheres_scale(const hs_fix *fix, double factor);

#endif
