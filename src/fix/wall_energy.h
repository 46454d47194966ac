/** Energies of walls with a particle at distance r < cutoff, 0 at the cutoff, and the force away from the wall. epsilon is an energy
 *  (harmonic: energy/distance^2), sigma a distance. */
#ifndef HS_FIX_WALL_ENERGY_H
#define HS_FIX_WALL_ENERGY_H

#include <math.h>

typedef double (*wall_energy)(double epsilon, double sigma, double cutoff, double r, double *force);

/** Before it is shifted to 0 at the cutoff. */
static inline double wall_lj93_unshifted(double epsilon, double sigma, double r, double *force)
{
    const double s = sigma / r, s3 = s * s * s;
    *force = epsilon * (1.2 * s3 * s3 * s3 - 3.0 * s3) / r;
    return epsilon * (2.0 / 15.0 * s3 * s3 * s3 - s3);
}

/** A half space of Lennard-Jones particles: epsilon (2/15 (sigma/r)^9 - (sigma/r)^3). */
static inline double wall_lj93(double epsilon, double sigma, double cutoff, double r, double *force)
{
    double unused;
    return wall_lj93_unshifted(epsilon, sigma, r, force) - wall_lj93_unshifted(epsilon, sigma, cutoff, &unused);
}

static inline double wall_lj126_unshifted(double epsilon, double sigma, double r, double *force)
{
    const double s = sigma / r, s6 = s * s * s * s * s * s;
    *force = 24.0 * epsilon * (2.0 * s6 * s6 - s6) / r;
    return 4.0 * epsilon * (s6 * s6 - s6);
}

/** 4 epsilon ((sigma/r)^12 - (sigma/r)^6). */
static inline double wall_lj126(double epsilon, double sigma, double cutoff, double r, double *force)
{
    double unused;
    return wall_lj126_unshifted(epsilon, sigma, r, force) - wall_lj126_unshifted(epsilon, sigma, cutoff, &unused);
}

static inline double wall_lj1043_unshifted(double epsilon, double sigma, double r, double *force)
{
    const double root2 = sqrt(2.0), scale = 2.0 * acos(-1.0) * epsilon, inner = r + 0.61 / root2 * sigma;
    const double s = sigma / r, s2 = s * s, s4 = s2 * s2, s10 = s4 * s4 * s2, t = sigma / inner;
    *force = scale * ((4.0 * s10 - 4.0 * s4) / r - root2 * t * t * t / inner);
    return scale * (0.4 * s10 - s4 - root2 / 3.0 * t * t * t);
}

/** Layers of Lennard-Jones particles, the first of them seen as a plane:
 *  2 pi epsilon (2/5 (sigma/r)^10 - (sigma/r)^4 - sqrt(2)/3 (sigma/(r + 0.61/sqrt(2) sigma))^3). */
static inline double wall_lj1043(double epsilon, double sigma, double cutoff, double r, double *force)
{
    double unused;
    return wall_lj1043_unshifted(epsilon, sigma, r, force) - wall_lj1043_unshifted(epsilon, sigma, cutoff, &unused);
}

/** Soft: epsilon (r - cutoff)^2. */
static inline double wall_harmonic(double epsilon, double sigma, double cutoff, double r, double *force)
{
    const double depth = cutoff - r;
    (void)sigma;
    *force = 2.0 * epsilon * depth;
    return epsilon * depth * depth;
}

#endif
