/** Interface of fixes: what acts on atoms at fixed points of the timestep. One fix style is one file in src/fix/. */
#ifndef HS_STYLE_FIX_H
#define HS_STYLE_FIX_H

#include "style/args.h"
#include "style/env.h"
#include "style/state.h"

struct hs_fix;

/** Descriptor of a fix style. Hooks that a style does not use are NULL. Hooks run on every rank, outside of parallel
 *  regions, in the order in which the deck defined the fixes. */
typedef struct hs_fix_style {
    hs_description about;
    size_t state_size; /**< bytes of private state, allocated zeroed by hs_sim before create, freed after destroy */

    HS_MUST_USE hs_status (*create)(struct hs_fix *fix, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_fix *fix);                               /**< free what create allocated */
    HS_MUST_USE hs_status (*init)(struct hs_fix *fix, hs_error *err);  /**< before each run: check, read dt */
    HS_MUST_USE hs_status (*setup)(struct hs_fix *fix, hs_error *err); /**< after the run's first forces */
    HS_MUST_USE hs_status (*initial_integrate)(struct hs_fix *fix, hs_error *err); /**< half kick and drift */
    HS_MUST_USE hs_status (*post_force)(struct hs_fix *fix, hs_error *err);        /**< add to, or constrain, forces */
    HS_MUST_USE hs_status (*final_integrate)(struct hs_fix *fix, hs_error *err);   /**< half kick */
    HS_MUST_USE hs_status (*end_of_step)(struct hs_fix *fix, hs_error *err);
    /** Global values that decide the future, moved into a checkpoint or back (collective). Reading comes after create and
     *  init; setup is not called then, for the run goes on in its midst. NULL: the words of the fix say everything. */
    HS_MUST_USE hs_status (*keep_state)(struct hs_fix *fix, hs_state *state, hs_error *err);
    /** f_ID and f_ID[i] in formulas and thermo output; NULL when the style has no such value. */
    HS_MUST_USE hs_status (*scalar)(struct hs_fix *fix, double *value, hs_error *err);
    HS_MUST_USE hs_status (*vector)(struct hs_fix *fix, int i, double *value, hs_error *err); /**< i from 0 */
    int n_vector;
    bool is_integrator; /**< moves its atoms: two of them on one atom are warned about */
} hs_fix_style;

/** One fix of a simulation. */
typedef struct hs_fix {
    const hs_fix_style *style;
    char *id;      /**< owned by hs_sim */
    int group;     /**< bit number */
    uint32_t mask; /**< acts on atoms with (atoms->mask[i] & mask) */
    hs_env *env;   /**< borrowed */
    void *state;   /**< style's own */
} hs_fix;

/** All fix styles, ended by NULL; made by the build from the files in src/fix/. */
extern const hs_fix_style *const hs_fix_styles[];

#endif
