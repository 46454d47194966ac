/** Cubic splines: the smoothest curve through given points whose slopes at both ends are given, too. */
#ifndef HS_CORE_CUBIC_SPLINE_H
#define HS_CORE_CUBIC_SPLINE_H

#include "base/error.h"

/** A spline. Zero it before hs_spline_fit; give it back with hs_spline_fini. */
typedef struct hs_spline {
    int n;           /**< knots */
    const double *x; /**< [n], borrowed from the caller, rising */
    const double *y; /**< [n], borrowed from the caller */
    double *bend;    /**< [n], owned: second derivatives at the knots */
} hs_spline;

/** Put a spline through n >= 2 points, with the slopes at the first and the last. x and y are borrowed for as long as the
 *  spline is used. */
HS_MUST_USE hs_status hs_spline_fit(hs_spline *spline, int n, const double *x, const double *y, double slope_first,
                                    double slope_last, hs_error *err);
/** Its value at any x; beyond the ends that of the last piece. */
double hs_spline_at(const hs_spline *spline, double x);
/** Of the piece between knots k and k + 1: c[0] + c[1] t + c[2] t^2 + c[3] t^3, where t goes from 0 to 1. */
void hs_spline_piece(const hs_spline *spline, int k, double c[4]);
void hs_spline_fini(hs_spline *spline);

#endif
