/** Energy of a box under a stress that is not the same along all axes, relative to a reference box:
 *
 *      E = 1/2 tr(sigma h^T h),      sigma = V0 h0^-1 S h0^-T
 *
 *  with the edges of the box as columns of h (h0, V0: reference box). Source: M. Parrinello, A. Rahman, J. Appl. Phys.
 *  52, 7182 (1981), doi:10.1063/1.328693. (LAMMPS adds up h h^T: in tilted boxes that is no energy of the forces h
 *  sigma, and line searches end early.) */
#ifndef HS_STYLE_STRAIN_ENERGY_H
#define HS_STYLE_STRAIN_ENERGY_H

#include "core/box.h"

typedef struct hs_strain_energy {
    double volume;      /**< of the reference box */
    double sigma[3][3]; /**< pressure times volume over squared length */
} hs_strain_energy;

/** Make @p box the reference, with the stress S, of the components xx yy zz xy xz yz: where it acts against the strain
 *  rates of the box (h' = w h), as in fix npt, it comes to S in the reference shape. */
void hs_strain_energy_set(hs_strain_energy *strain, const hs_box *box, const double s[6]);
/** The same, for boxes moved by forces on their edges. Where the forces of its pressure are V P diag(h)^-1, as in fix box/relax, it comes to
 *  rest in its reference shape at the stress P = S h0^-T diag(h0): S is chosen so that the components on and above the
 *  diagonal are those of @p stress (xx yy zz xy xz yz; pressure). */
void hs_strain_energy_set_at_rest(hs_strain_energy *strain, const hs_box *box, const double stress[6]);
/** Pressure times volume. */
double hs_strain_energy_of(const hs_strain_energy *strain, const hs_box *box);
/** Derivatives of it by the lengths and tilts x y z xy xz yz: h sigma, pressure times area. */
void hs_strain_energy_forces(const hs_strain_energy *strain, const hs_box *box, double force[6]);

/** Derivatives of it by the strains xx yy zz xy xz yz: h sigma h^T, pressure times volume. */
void hs_strain_energy_stress(const hs_strain_energy *strain, const hs_box *box, double stress[6]);

#endif
