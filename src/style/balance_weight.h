/** What atoms cost, for the load balance: keyword `weight` of `balance` and `fix balance`. */
#ifndef HS_STYLE_BALANCE_WEIGHT_H
#define HS_STYLE_BALANCE_WEIGHT_H

#include "style/args.h"
#include "style/env.h"

typedef enum {
    HS_WEIGHT_GROUP,
    HS_WEIGHT_VARIABLE,
    HS_WEIGHT_TIME,
    HS_WEIGHT_NEIGHBORS,
    HS_WEIGHT_STORE
} hs_weight_kind;

/** One `weight`; costs are the products of all. */
typedef struct hs_weight_part {
    hs_weight_kind kind;
    char *name;    /**< owned; of a group, an atom-style variable, or a value of atoms (d_name); else NULL */
    double factor; /**< of the group's atoms; or of the range of times or numbers of neighbors */
} hs_weight_part;

/** Zero it before; free with hs_balance_weight_fini. */
typedef struct hs_balance_weight {
    hs_weight_part *part; /**< owned [n_parts]; without any, all atoms cost the same */
    int n_parts;
    bool has_warned; /**< that there are no lists whose pairs could be counted */
} hs_balance_weight;

#define HS_BALANCE_WEIGHTS                                                                                             \
    "[weight group <n> <group-ID> <factor> ... | var <name> | time <factor> | neigh <factor> | store <name>] ..."
#define HS_BALANCE_WEIGHT_DETAILS                                                                                      \
    "`weight` says what atoms cost; without it all cost the same, and several are multiplied. `group <n>` is "         \
    "followed "                                                                                                        \
    "by n groups, each with the factor of its atoms; `var` by an atom-style variable, whose values must be above 0; "  \
    "`time` by a factor: atoms cost what the pair forces of their rank have taken for each of its atoms, and the "     \
    "ratio of the largest to the smallest is multiplied by the factor (1: as measured); `neigh` does the same with "   \
    "the pairs in the neighbor lists of the rank for each of its atoms, which are the same in every run (before the "  \
    "first run, and with methods that keep no lists, all atoms count alike, which is said). `store` keeps the costs "  \
    "that the weights before it give, in the atoms' value `d_<name>` of fix property/atom."

/** Read what follows the keyword `weight`, from word *i on; *i is then the last word that was used. Names are looked up
 *  later. */
HS_MUST_USE hs_status hs_balance_weight_read(hs_balance_weight *weight, const hs_args *args, int *i, hs_error *err);
void hs_balance_weight_fini(hs_balance_weight *weight);
/** Fail when what a weight names does not exist, now. */
HS_MUST_USE hs_status hs_balance_weight_check(const hs_balance_weight *weight, const hs_env *env, const char *command,
                                              hs_error *err);
/** Costs of the local atoms, *costs[n_local], the caller's (HS_FREE); NULL when all are the same. @p spent_s: what this
 *  rank's pair forces have taken. Collective, errors agreed. */
HS_MUST_USE hs_status hs_balance_weight_eval(hs_balance_weight *weight, const hs_env *env, double spent_s,
                                             const char *command, double **costs, hs_error *err);
/** The load of this rank. */
double hs_balance_weight_load(const hs_env *env, const double *costs);

#endif
