/** What atoms cost, for the load balance: keyword `weight` of `balance` and `fix balance`. */
#ifndef HS_STYLE_BALANCE_WEIGHT_H
#define HS_STYLE_BALANCE_WEIGHT_H

#include "style/args.h"
#include "style/env.h"

/** One `weight`; costs are the products of all. */
typedef struct hs_weight_part {
    char *name;    /**< owned; of a group or an atom-style variable; NULL: by time */
    bool is_group; /**< else a variable */
    double factor; /**< of the group's atoms; or of the range of times */
} hs_weight_part;

/** Zero it before; free with hs_balance_weight_fini. */
typedef struct hs_balance_weight {
    hs_weight_part *part; /**< owned [n_parts]; without any, all atoms cost the same */
    int n_parts;
} hs_balance_weight;

#define HS_BALANCE_WEIGHTS "[weight group <n> <group-ID> <factor> ... | var <name> | time <factor>] ..."
#define HS_BALANCE_WEIGHT_DETAILS                                                                                      \
    "`weight` says what atoms cost; without it all cost the same, and several are multiplied. `group <n>` is "         \
    "followed "                                                                                                        \
    "by n groups, each with the factor of its atoms; `var` by an atom-style variable, whose values must be above 0; "  \
    "`time` by a factor: atoms cost what the pair forces of their rank have taken for each of its atoms, and the "     \
    "ratio of the largest to the smallest is multiplied by the factor (1: as measured)."

/** Read what follows the keyword `weight`, from word *i on; *i is then the last word that was used. Names are looked up later. */
HS_MUST_USE hs_status hs_balance_weight_read(hs_balance_weight *weight, const hs_args *args, int *i, hs_error *err);
void hs_balance_weight_fini(hs_balance_weight *weight);
/** Costs of the local atoms, *costs[n_local], the caller's (HS_FREE); NULL when all are the same. @p spent_s: what this rank's pair
 *  forces have taken. Collective, errors agreed. */
HS_MUST_USE hs_status hs_balance_weight_eval(const hs_balance_weight *weight, const hs_env *env, double spent_s,
                                             const char *command, double **costs, hs_error *err);
/** The load of this rank. */
double hs_balance_weight_load(const hs_env *env, const double *costs);

#endif
