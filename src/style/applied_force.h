/** What the fixes that set or add forces share: a force given by three words (numbers, variables, NULL), and a
 *  region. */
#ifndef HS_STYLE_APPLIED_FORCE_H
#define HS_STYLE_APPLIED_FORCE_H

#include "style/atom_sum.h"
#include "style/fix.h"
#include "style/region.h"
#include "style/shown_sums.h"

/** Zero-initialised; hs_applied_force_fini frees it. */
typedef struct hs_applied_force {
    double value[3];    /**< force; of a variable: at the present step */
    bool is_free[3];    /**< NULL: this component is left alone */
    char *variable[3];  /**< owned; NULL: a constant */
    double *of_atom[3]; /**< owned [capacity]: values of an atom-style variable; NULL: one for all atoms */
    size_t capacity[3];
    hs_where where;
} hs_applied_force;

/** Words 0, 1, 2: a number, v_name, or NULL (with @p may_be_free). Keywords are the caller's. */
HS_MUST_USE hs_status hs_applied_force_create(hs_applied_force *force, const hs_args *args, bool may_be_free,
                                              hs_error *err);
/** The word after the keyword `region` at word i. */
HS_MUST_USE hs_status hs_applied_force_region(hs_applied_force *force, const hs_fix *fix, const hs_args *args, int i,
                                              hs_error *err);
/** Before a run: variables and region must be there; atom-style variables with @p may_be_per_atom only. */
HS_MUST_USE hs_status hs_applied_force_init(hs_applied_force *force, const hs_fix *fix, bool may_be_per_atom,
                                            hs_error *err);
/** Evaluate the variables for the present step (collective). */
HS_MUST_USE hs_status hs_applied_force_update(hs_applied_force *force, const hs_fix *fix, hs_error *err);
void hs_applied_force_fini(hs_applied_force *force);

/** State of the fixes that put a force in the place of the one there was (setforce, aveforce), and their hooks. */
typedef struct hs_replaced_force {
    /** First, for shown_sums.h: sum of the forces before they were replaced, and the number of atoms. */
    hs_late_sums before;
    hs_applied_force force;
} hs_replaced_force;
extern const hs_keyword hs_replaced_force_keywords[];
HS_MUST_USE hs_status hs_replaced_force_create(hs_fix *fix, const hs_args *args, hs_error *err);
void hs_replaced_force_destroy(hs_fix *fix);
/** Add up the forces before on atoms found[n], and n. */
void hs_replaced_force_add(const hs_atoms *atoms, const int32_t *found, int n, hs_exact_sum *sums);
/** All of their hooks but init and post_force. */
#define HS_REPLACED_FORCE_HOOKS                                                                                        \
    .state_size = sizeof(hs_replaced_force), .create = hs_replaced_force_create, .destroy = hs_replaced_force_destroy, \
    .acts_in_minimize = true, .keep_state = hs_shown_keep_state, .vector = hs_shown_vector, .n_vector = 3,             \
    .is_vector_extensive = true, .allows_dynamic_group = true

/** Whether it acts on local atom i. */
static inline bool hs_applied_force_acts(const hs_applied_force *force, const hs_fix *fix, int i)
{
    const hs_atoms *atoms = fix->env->atoms;
    return (atoms->mask[i] & fix->mask) != 0 && hs_where_has(&force->where, atoms, i);
}

/** The atoms of [begin, end), at most HS_EXACT_ARRAY_MAX, on which it acts, and their number. */
int hs_applied_force_find(const hs_applied_force *force, const hs_fix *fix, int begin, int end, int32_t *found);

/** Component of the force on local atom i. */
static inline double hs_applied_force_of(const hs_applied_force *force, int axis, int i)
{
    return force->of_atom[axis] != NULL ? force->of_atom[axis][i] : force->value[axis];
}

#endif
