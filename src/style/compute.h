/** Interface of computes: quantities measured on demand. One compute style is one file in src/compute/. */
#ifndef HS_STYLE_COMPUTE_H
#define HS_STYLE_COMPUTE_H

#include "style/args.h"
#include "style/env.h"
#include "style/local_rows.h"
#include "style/state.h"

struct hs_compute;

/** Descriptor of a compute style. Evaluations are collective; results are the same on all ranks. */
typedef struct hs_compute_style {
    hs_description about;
    size_t state_size; /**< bytes of private state, allocated zeroed before create, freed after destroy */
    HS_MUST_USE hs_status (*create)(struct hs_compute *compute, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_compute *compute);                              /**< free what create allocated */
    HS_MUST_USE hs_status (*init)(struct hs_compute *compute, hs_error *err); /**< before each run */
    /** After all forces of a run's set-up, before fixes measure: what is found once and kept. NULL: nothing is. */
    HS_MUST_USE hs_status (*setup)(struct hs_compute *compute, hs_error *err);
    HS_MUST_USE hs_status (*scalar)(struct hs_compute *compute, double *value,
                                    hs_error *err); /**< NULL: has no scalar */
    /** Fill compute->vector[n_vector]; NULL: has no vector. */
    HS_MUST_USE hs_status (*vector)(struct hs_compute *compute, hs_error *err);
    /** Fill compute->array[n_rows * n_columns], row by row; NULL: has no array. */
    HS_MUST_USE hs_status (*array)(struct hs_compute *compute, hs_error *err);
    /** Fill compute->atoms for the local atoms: column k of atom i is atoms[k * n_local + i]; room for n_atom_columns
     *  (at least one) columns is made before the call. Atoms outside the group get 0. NULL: has no values per atom. */
    HS_MUST_USE hs_status (*per_atom)(struct hs_compute *compute, hs_error *err);
    /** Fill compute->local (hs_local_rows_reserve) with this rank's rows of n_local_columns columns (at least one), in the order
     *  that local_rows.h asks for; they are numbered after the call. NULL: has no local values. */
    HS_MUST_USE hs_status (*local)(struct hs_compute *compute, hs_error *err);
    /** Before the forces of a step at whose end it will be asked for (hs_value_announce): leave word in the env for
     *  what can be measured on the way. Nothing may depend on it: whatever was not done is done when asked for. NULL:
     *  nothing can. */
    void (*announce)(struct hs_compute *compute);
    /** A keyword of compute_modify and what follows it; *n_used = words taken, 0 when it is not the style's. */
    HS_MUST_USE hs_status (*modify)(struct hs_compute *compute, const hs_args *args, int *n_used, hs_error *err);
    /** Take the temperature from another compute (thermo_modify temp, fix_modify temp); NULL: uses none. */
    HS_MUST_USE hs_status (*set_temperature)(struct hs_compute *compute, const char *id, hs_error *err);
    /** Global values that outlive a step (a history), moved into a checkpoint or back (collective). Reading comes after
     *  create and init. NULL: there are none. */
    HS_MUST_USE hs_status (*keep_state)(struct hs_compute *compute, hs_state *state, hs_error *err);
    /** Temperatures: the part of local atom i's velocity that is not thermal, distance/time; thermostats leave it as it
     *  is. Holds for the present revision once the scalar was evaluated. NULL: everything is thermal. */
    void (*bias)(const struct hs_compute *compute, int i, double bias[3]);
    /** Temperatures: whether local atom i of the group counts; NULL: all do. */
    bool (*counts)(const struct hs_compute *compute, int i);
    bool needs_energy;        /**< the pair energy or virial must have been computed on the step it is asked for */
    bool is_extensive;        /**< scalar grows with the number of atoms: divided by N under thermo_modify norm yes */
    bool is_vector_extensive; /**< the same for the elements of the vector; both are copied to the compute */
    bool needs_fixed_group;   /**< remembers places or velocities of its members: refuses dynamic groups */
    bool is_temperature, is_pressure; /**< may serve fix_modify temp / press */
} hs_compute_style;

/** One compute of a simulation. Results are remembered until atoms change (env->revision): hs_compute_scalar and the
 *  others evaluate at most once. */
typedef struct hs_compute {
    const hs_compute_style *style;
    char *id;              /**< owned */
    int group;             /**< bit number */
    uint32_t mask;         /**< measures atoms with (atoms->mask[i] & mask) */
    uint32_t other_groups; /**< masks of further groups that its words name; set by create */
    hs_env *env;           /**< borrowed */
    void *state;           /**< style's own */
    double scalar;
    double *vector; /**< [n_vector], allocated by create, freed by destroy of the style */
    int n_vector;
    double *array; /**< [n_rows * n_columns], the same */
    int n_rows, n_columns;
    double *atoms;      /**< values per atom, by columns; owned by the interface, made and freed for the style */
    int n_atom_columns; /**< 0: one value per atom, c_ID; n: c_ID[1] ... c_ID[n]; set by create */
    size_t capacity_atoms;
    hs_local_rows local; /**< local values; owned by the interface */
    int n_local_columns; /**< 0: one value a row, c_ID; n: c_ID[1] ... c_ID[n]; set by create */
    uint64_t scalar_at, vector_at, array_at, atoms_at, local_at; /**< revision of the results; 0: not evaluated yet */
    bool is_extensive, is_vector_extensive;
    /** What there is: at first what the style has functions for; create may clear some. */
    bool has_scalar, has_vector, has_array, has_atoms, has_local;
    /** Vector or rows of the array: as many as the latest evaluation found; elements beyond are 0. Set by create. */
    bool has_variable_length;
    /** Set by create: the compute chunk/atom whose chunks the vector or the rows are of; borrowed from the style. NULL: none. */
    const char *chunk_id;
    /** Set by create: made from other values that may need the pair energy or virial, or measured at the places of the
     *  forces (style/places.h), which steps remember that compute these. */
    bool may_need_energy;
    double n_dof; /**< temperature computes: degrees of freedom */
} hs_compute;

/** A new compute, ID copied. The caller keeps it, calls its init before each run, and gives it to hs_compute_destroy:
 *  the simulation for those of the deck, a fix for one of its own. */
HS_MUST_USE hs_status hs_compute_create(hs_compute **compute, hs_env *env, const hs_compute_style *style,
                                        const char *id, int group, const hs_args *args, hs_error *err);
/** Free a compute and clear the pointer; NULL is fine. */
void hs_compute_destroy(hs_compute **compute);
/** The compute style of that name, or NULL. */
const hs_compute_style *hs_compute_style_find(const char *name);

hs_who hs_compute_who(const hs_compute *compute);

/** What a compute that another style or command uses must be one of. */
typedef enum { HS_TEMPERATURE, HS_PRESSURE } hs_measure;
/** The compute of that ID, which must be there and measure that. Whoever keeps an ID looks it up before each use: another compute may
 *  have taken its place. @p who begins the message. Borrowed. */
HS_MUST_USE hs_status hs_compute_get(hs_env *env, const char *id, hs_measure what, const char *who,
                                     hs_compute **compute, hs_error *err);

/** Evaluate if needed (collective); an error when the style has none, or needs an energy that this step did not
 *  compute. */
HS_MUST_USE hs_status hs_compute_scalar(hs_compute *compute, double *value, hs_error *err);
/** Element i (from 0) of the vector. */
HS_MUST_USE hs_status hs_compute_vector(hs_compute *compute, int i, double *value, hs_error *err);
/** Bring the whole vector, array, values per atom, or local values up to date: then compute->vector, ->array, ->atoms, ->local hold
 *  them. */
HS_MUST_USE hs_status hs_compute_eval_vector(hs_compute *compute, hs_error *err);
HS_MUST_USE hs_status hs_compute_eval_array(hs_compute *compute, hs_error *err);
HS_MUST_USE hs_status hs_compute_eval_atoms(hs_compute *compute, hs_error *err);
HS_MUST_USE hs_status hs_compute_eval_local(hs_compute *compute, hs_error *err);
/** Forget remembered results (positions or velocities were changed between steps). */
void hs_compute_invalidate(hs_compute *compute);

/** All compute styles, ended by NULL; made by the build. */
extern const hs_compute_style *const hs_compute_styles[];

#endif
