/** Lattices: the deck command `lattice` and the lattice units of regions and atoms. */
#ifndef HS_CORE_LATTICE_H
#define HS_CORE_LATTICE_H

#include <stdint.h>

#include "base/error.h"

/** A lattice: basis atoms in a primitive cell, scaled, rotated and shifted. */
typedef struct hs_lattice {
    bool is_set;        /**< false for style none: there are no sites, spacing is the scale */
    double scale;       /**< length of one lattice unit, distance */
    double a[3][3];     /**< primitive vectors a1, a2, a3, lattice units */
    double (*basis)[3]; /**< [n_basis], fractions of a1, a2, a3; owned */
    int n_basis;
    double origin[3];      /**< fractions of the spacing, 0 <= o < 1 */
    int orient[3][3];      /**< orthogonal integer vectors that become x, y, z */
    double rotation[3][3]; /**< rows: unit vectors of orient */
    double spacing[3];     /**< extent of the rotated cell in x, y, z, distance: the unit of `units lattice` */
} hs_lattice;

/** How the command `lattice` fixes the size: its number, and the run it is for. */
typedef struct hs_lattice_size {
    double value;          /**< > 0: reduced density, or the length of one lattice unit */
    bool is_density;       /**< units lj: value is N sigma^dim / V */
    int dimension;         /**< 2 or 3 */
    const double *spacing; /**< [3] from the keyword `spacing`, lattice units; NULL: the rotated cell's extent */
} hs_lattice_size;

/** Names of the styles, ended by NULL: none, sc, bcc, ..., custom. */
extern const char *const hs_lattice_styles[];

/** Style none with the scale 1. */
void hs_lattice_init(hs_lattice *lattice);
void hs_lattice_fini(hs_lattice *lattice);
/** Begin a lattice of a style: its cell and basis, origin 0, orientation along the axes. Custom lattices begin with the
 *  unit cube and no basis. The style must be one of hs_lattice_styles; @p lattice holds nothing yet. */
HS_MUST_USE hs_status hs_lattice_begin(hs_lattice *lattice, const char *style, hs_error *err);
/** Append a basis atom, fractions of a1, a2, a3. */
HS_MUST_USE hs_status hs_lattice_add_basis(hs_lattice *lattice, const double fraction[3], hs_error *err);
/** Check cell, basis, origin and orientation, and set scale, rotation and spacing. Whether the style
 *  fits the dimension is not checked here. */
HS_MUST_USE hs_status hs_lattice_finish(hs_lattice *lattice, const hs_lattice_size *size, hs_error *err);
/** Whether a style is for that dimension (none and custom are for both). */
bool hs_lattice_fits_dimension(const char *style, int dimension);
/** Place of site (i, j, k, basis b): distance units.  The order of operations is part of the contract: it decides the
 *  bits of the coordinates, from which `velocity ... loop geom` draws its numbers. */
void hs_lattice_site(const hs_lattice *lattice, int i, int j, int k, int b, double x[3]);
/** Sites per volume; in 2D per area. */
double hs_lattice_density(const hs_lattice *lattice, int dimension);
/** Range of cells [lo, hi] per axis that can have sites within the box lo..hi; an error when there are more cells along
 *  an axis than can be counted. */
HS_MUST_USE hs_status hs_lattice_range(const hs_lattice *lattice, const double box_lo[3], const double box_hi[3],
                                       int lo[3], int hi[3], hs_error *err);

#endif
