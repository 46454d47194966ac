/** Interface of pair styles: which potential acts between which types. One pair style is one file in src/pair/, which
 *  also holds its evaluator: the potential as a function of r^2, compiled by the build for every instruction set and
 *  precision (kernel/evaluator.h). */
#ifndef HS_STYLE_PAIR_H
#define HS_STYLE_PAIR_H

#include "base/text.h"
#include "kernel/kernel.h"
#include "style/args.h"
#include "style/env.h"

struct hs_pair;

/** A coefficient that fix adapt may change. */
typedef struct hs_pair_adaptable {
    const char *name;
    int index; /**< in hs_pair_coeff.c: see style/pair_coeffs.h */
} hs_pair_adaptable;

typedef struct hs_pair_style {
    hs_description about;               /**< words after pair_style */
    hs_syntax coeff_syntax;             /**< words of pair_coeff after the two types */
    const hs_pair_adaptable *adaptable; /**< ended by a NULL name; the state begins with hs_pair_coeffs. NULL: none */
    size_t state_size;
    HS_MUST_USE hs_status (*settings)(struct hs_pair *pair, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_pair *pair);
    /** Coefficients of one type pair, i <= j, from the words after the types. */
    HS_MUST_USE hs_status (*coeff)(struct hs_pair *pair, int i, int j, const hs_args *args, hs_error *err);
    /** Coefficients of (i, j) from those of (i, i) and (j, j); NULL: all pairs must be given. */
    HS_MUST_USE hs_status (*mix)(struct hs_pair *pair, int i, int j, hs_error *err);
    /** Before a run, and before mix and params: look at the atoms; collective. NULL: no need. */
    HS_MUST_USE hs_status (*init)(struct hs_pair *pair, hs_error *err);
    /** Cutoff (0: the pair does not interact) and the evaluator's parameters of a type pair, i <= j. */
    void (*params)(const struct hs_pair *pair, int i, int j, double *cutoff, double *params);
    /** What the evaluator looks up, in hs_pair_table.shared: valid until the next call of a hook. NULL: nothing. */
    const double *(*shared)(const struct hs_pair *pair);
    /** Long-range integrals for one pair of types per unit of n_i n_j / volume: see pair_modify tail. NULL: none. */
    void (*tail)(const struct hs_pair *pair, int i, int j, double *energy, double *virial);
    /** Words for a data file's "PairIJ Coeffs" line of (i, j), appended to @p words. NULL: not written. */
    HS_MUST_USE hs_status (*write_coeff)(const struct hs_pair *pair, int i, int j, hs_text *words, hs_error *err);
    const hs_evaluator *evaluator; /**< NULL: no forces (none, zero) */
    bool allows_none;              /**< works without any coefficients */
    bool is_hybrid;                /**< the forces are those of its parts; settings makes them: style/pair_hybrid.h */
} hs_pair_style;

typedef enum { HS_MIX_GEOMETRIC, HS_MIX_ARITHMETIC, HS_MIX_SIXTHPOWER } hs_mix_rule;

/** The pair style of a simulation, or one part of a hybrid one. Type tables are [(n_types + 1) * (n_types + 1)],
 *  indexed with hs_pair_index. */
typedef struct hs_pair {
    const hs_pair_style *style;
    hs_env *env;
    void *state; /**< style's own, sized state_size */
    int n_types;
    unsigned char *is_set; /**< by pair_coeff; owned */
    double *cutoff;        /**< distance, 0 where no force acts; the largest of the parts; by hs_pair_complete; owned */
    double cutoff_max;     /**< the largest of all */
    bool shift, tail;      /**< pair_modify */
    bool is_adapted;       /**< coefficients are no longer those of pair_coeff: checkpoints keep them */
    hs_mix_rule mix;
    /** Whose forces are added: the sub-styles of a hybrid style, owned; else only the pair itself. */
    struct hs_pair **part;
    int n_parts;
} hs_pair;

static inline int hs_pair_index(const hs_pair *pair, int i, int j) { return i * (pair->n_types + 1) + j; }

/** Style of that name, NULL when there is none. */
const hs_pair_style *hs_pair_style_find(const char *name);
/** Make a pair of that style, before its settings; a hybrid one without parts. Destroyed with hs_pair_destroy. */
HS_MUST_USE hs_status hs_pair_create(hs_pair **pair, const hs_pair_style *style, hs_env *env, int n_types,
                                     hs_error *err);
void hs_pair_destroy(hs_pair **pair);
/** Take over what pair_modify set in a pair of the same style with the same parts. */
void hs_pair_copy_modified(hs_pair *to, const hs_pair *from);
/** Mix the coefficients of pairs of types that were not given, and fill the cutoffs; an error when neither can be. In a
 *  hybrid style a pair of types is mixed in each part that both its types are given in. */
HS_MUST_USE hs_status hs_pair_complete(hs_pair *pair, hs_error *err);
/** Whether any part exerts forces. */
bool hs_pair_has_forces(const hs_pair *pair);
/** Whether any part (@p all: every part) that exerts forces needs the atoms' radii. */
bool hs_pair_has_radii(const hs_pair *pair, bool all);

/** epsilon and sigma by the chosen rule (same formulas as LAMMPS's pair_modify mix). */
double hs_pair_mix_energy(hs_mix_rule rule, double eps_i, double eps_j, double sigma_i, double sigma_j);
double hs_pair_mix_distance(hs_mix_rule rule, double sigma_i, double sigma_j);

extern const hs_pair_style *const hs_pair_styles[];

#endif
