/** Energy and virial of pairs, half of each pair's for each of its two atoms: what compute pe/atom and stress/atom are made of.
 *
 *  They are found together, once for a revision, for all who want them: finding the pairs takes most of the time. */
#ifndef HS_STYLE_PAIR_SHARES_H
#define HS_STYLE_PAIR_SHARES_H

#include "style/env.h"

/** Zero it before use. Kept in hs_env. */
typedef struct hs_pair_shares {
    int n_energy_users, n_virial_users;
    uint64_t made_at; /**< env->revision of the values; 0: none */
    bool has_virial;  /**< they have energies, and virials if this is set; else energies alone */
    double *value;    /**< owned [7][n_local]: energy, virial xx yy zz xy xz yz; energy units */
    size_t capacity;
} hs_pair_shares;

/** Someone will ask for energies or virials, and stops doing so. */
void hs_pair_shares_want(hs_pair_shares *shares, bool virial);
void hs_pair_shares_release(hs_pair_shares *shares, bool virial);

/** The shares of the local atoms at the latest forces; energy[n_local] and virial[6 * n_local] (by component) are borrowed until atoms
 *  change. Of who wants energies alone virial is NULL. The same bits for any threads and ranks in reproducible runs (collective,
 *  errors agreed). */
HS_MUST_USE hs_status hs_pair_shares_get(hs_env *env, bool wants_virial, const double **energy, const double **virial,
                                         hs_error *err);

#endif
