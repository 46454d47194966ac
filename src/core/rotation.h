/** Rotation of a body of point masses. */
#ifndef HS_CORE_ROTATION_H
#define HS_CORE_ROTATION_H

/** Angular velocity omega of a body from I omega = L, with the moments of inertia I (mass distance^2, symmetric) and
 *  the angular momentum L about its center of mass. Masses on one line, or one alone, have no moment along it, and then
 *  no velocity about it. */
void hs_rotation_velocity(const double inertia[3][3], const double momentum[3], double omega[3]);

#endif
