/** A Nose-Hoover chain of thermostats: each keeps the one before it at a temperature, the first what it acts on. */
#ifndef HS_STYLE_NH_CHAIN_H
#define HS_STYLE_NH_CHAIN_H

#include "style/state.h"

typedef struct hs_nh_chain {
    int n;         /**< links; 0: none */
    int n_loops;   /**< parts of a timestep */
    double *place; /**< owned [n]: eta, 1 */
    double *rate;  /**< owned [n + 1]: eta', 1/time; the last is 0 */
    double *force; /**< owned [n]: eta'', 1/time^2 */
    double *mass;  /**< owned [n]: energy time^2 */
    double drag;   /**< factor on the rates at each part of a step */
} hs_nh_chain;

/** Room for chain->n links, at rest. */
HS_MUST_USE hs_status hs_nh_chain_create(hs_nh_chain *chain, hs_error *err);
void hs_nh_chain_destroy(hs_nh_chain *chain);
/** Forces on all links but the first: each keeps the one before it at @p kt. */
void hs_nh_chain_force(hs_nh_chain *chain, double kt);
/** Half a timestep of a chain that keeps @p kinetic (twice a kinetic energy) at @p target. Returns the factor by which
 *  the velocities of what it acts on are to be scaled. G. J. Martyna et al., Mol. Phys. 87, 1117 (1996),
 *  doi:10.1080/00268979600100761, section 2.3. */
HS_MUST_USE double hs_nh_chain_advance(hs_nh_chain *chain, double kt, double target, double kinetic, double dt);
/** Potential and kinetic energy of link k, and of all. */
double hs_nh_chain_potential(const hs_nh_chain *chain, int k, double kt, double target);
double hs_nh_chain_kinetic(const hs_nh_chain *chain, int k);
double hs_nh_chain_energy(const hs_nh_chain *chain, double kt, double target);
/** For keep_state; @p names of place, rate, force and mass. */
HS_MUST_USE hs_status hs_nh_chain_keep(hs_nh_chain *chain, hs_state *kept, const char *const names[4], hs_error *err);

#endif
