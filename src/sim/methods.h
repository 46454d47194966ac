/** The neighbor methods as the timestep sees them: one table entry each, and nothing else in sim/ knows which is
 *  which. */
#ifndef HS_SIM_METHODS_H
#define HS_SIM_METHODS_H

#include "sim/sim.h"

/** Words of `neighbor_method` that a method heeds; the others are refused for it. */
enum { HS_METHOD_TAKES_CELL = 1, HS_METHOD_TAKES_ORDER = 2, HS_METHOD_TAKES_STENCIL = 4, HS_METHOD_TAKES_NO_ORDER = 8 };

typedef struct hs_method {
    const char *help; /**< one line */
    unsigned options; /**< HS_METHOD_TAKES_... */
    /** After the exchange, atoms in the box: halo, cells and lists of the present places. Halo and images of atoms stay
     *  as they are until the next exchange, whatever the method: dumps do not tell one from another. */
    HS_MUST_USE hs_status (*renew)(hs_sim *sim, hs_error *err);
    /** At the steps between two exchanges, halo positions being new. NULL: nothing to do. */
    HS_MUST_USE hs_status (*update)(hs_sim *sim, hs_error *err);
    HS_MUST_USE hs_status (*forces)(hs_sim *sim, const hs_force_job *job, hs_force_result *result, hs_error *err);
} hs_method;

/** By hs_neighbor_method. */
extern const hs_method hs_methods[HS_N_METHODS];

/** The method in use: with `auto` the one being tried or chosen. */
hs_neighbor_method hs_sim_method_in_use(const hs_sim *sim);
/** Its entry. */
const hs_method *hs_sim_method(const hs_sim *sim);
/** What the method's cells are like, for the log; nothing when it has none. */
HS_MUST_USE hs_status hs_sim_describe_cells(const hs_sim *sim, hs_text *text, hs_error *err);

#endif
