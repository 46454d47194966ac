/** Rotation of a body of point masses, and the axes of its moments. */
#ifndef HS_CORE_ROTATION_H
#define HS_CORE_ROTATION_H

/** Angular velocity omega of a body from I omega = L, with the moments of inertia I (mass distance^2, symmetric) and
 *  the angular momentum L about its center of mass. Masses on one line, or one alone, have no moment along it, and then
 *  no velocity about it. */
void hs_rotation_velocity(const double inertia[3][3], const double momentum[3], double omega[3]);

/** Eigenvalues of a symmetric matrix; the columns of axes are the eigenvectors, as many and in the same order. */
void hs_principal_axes(const double matrix[3][3], double values[3], double axes[3][3]);

#endif
