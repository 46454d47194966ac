/** Lattices: the deck command `lattice` and the lattice units of regions and atoms. */
#ifndef HS_CORE_LATTICE_H
#define HS_CORE_LATTICE_H

#include "base/error.h"

/** A lattice: basis atoms in a primitive cell, scaled, rotated and shifted. */
typedef struct hs_lattice {
    bool is_set;            /**< false for style none: lattice units are not available, spacing is 1 */
    double scale;           /**< length of one lattice unit, distance */
    double a[3][3];         /**< primitive vectors a1, a2, a3, lattice units */
    double (*basis)[3];     /**< [n_basis], fractions of a1, a2, a3; owned */
    int n_basis;
    double origin[3];       /**< fractions of the cell, 0 <= o < 1 */
    int orient[3][3];       /**< orthogonal integer vectors that become x, y, z */
    double rotation[3][3];  /**< rows: unit vectors of orient */
    double spacing[3];      /**< extent of the rotated cell in x, y, z, distance: the unit of `units lattice` */
} hs_lattice;

/** Style none with the given scale (1 by default). */
void hs_lattice_init(hs_lattice *lattice);
void hs_lattice_fini(hs_lattice *lattice);
/** Place of site (i, j, k, basis b): distance units.  The order of operations is part of the contract: it decides the
 *  bits of the coordinates, from which `velocity ... loop geom` draws its numbers. */
void hs_lattice_site(const hs_lattice *lattice, int i, int j, int k, int b, double x[3]);
/** Range of cells [lo, hi] per axis that can have sites within the box lo..hi. */
void hs_lattice_range(const hs_lattice *lattice, const double box_lo[3], const double box_hi[3], int lo[3], int hi[3]);

#endif
