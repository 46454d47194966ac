/** Velocities of groups outside of a run: momentum, rotation, temperature. Sums go through the local atoms by ID, one
 *  after the other, so that on one rank they are LAMMPS's to the last bit. */
#ifndef HS_DECK_VELOCITY_H
#define HS_DECK_VELOCITY_H

#include "sim/sim.h"

/** Atoms a velocity command works on. */
typedef struct hs_velocity_group {
    hs_sim *sim;     /**< borrowed */
    int32_t *member; /**< owned [n]: local indices of the group's atoms by ascending ID */
    int n;
    int64_t n_all; /**< on all ranks */
} hs_velocity_group;

/** Collective. The caller calls hs_velocity_group_fini. */
HS_MUST_USE hs_status hs_velocity_group_init(hs_velocity_group *group, hs_sim *sim, int bit, hs_error *err);
void hs_velocity_group_fini(hs_velocity_group *group);

/** Temperature, with dim * N - dim degrees of freedom; 0 when there are none (collective). */
double hs_velocity_temperature(const hs_velocity_group *group);
/** Take the velocity of the center of mass away (collective). An error for an empty group. */
HS_MUST_USE hs_status hs_velocity_zero_momentum(const hs_velocity_group *group, hs_error *err);
/** Take the rotation about the center of mass away (collective): omega = I^-1 L of the unwrapped positions. An error
 *  for an empty group. */
HS_MUST_USE hs_status hs_velocity_zero_rotation(const hs_velocity_group *group, hs_error *err);
/** Multiply velocities by sqrt(wanted / present). An error when present is 0. */
HS_MUST_USE hs_status hs_velocity_rescale(const hs_velocity_group *group, double present, double wanted, hs_error *err);

#endif
