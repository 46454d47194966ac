/** Interface of fixes: what acts on atoms at fixed points of the timestep. One fix style is one file in src/fix/. */
#ifndef HS_STYLE_FIX_H
#define HS_STYLE_FIX_H

#include "base/text.h"
#include "core/noise.h"
#include "style/args.h"
#include "style/box_freedom.h"
#include "style/env.h"
#include "style/state.h"

struct hs_fix;

/** A section of data files with a line for each atom: its id and values of the fix. */
typedef struct hs_fix_data {
    int (*n_values)(const struct hs_fix *fix);
    /** Their names, separated by spaces: a comment beside the section's name. */
    HS_MUST_USE hs_status (*names)(const struct hs_fix *fix, hs_text *text, hs_error *err);
    /** Append the values of local atom i, each after a space. */
    HS_MUST_USE hs_status (*format)(const struct hs_fix *fix, int i, hs_text *row, hs_error *err);
    /** Give local atom i the values that these words are; i = -1: only refuse words that are none. */
    HS_MUST_USE hs_status (*parse)(struct hs_fix *fix, int i, const char *const *word, hs_error *err);
} hs_fix_data;

/** Descriptor of a fix style. Hooks that a style does not use are NULL. Hooks run on every rank, outside of parallel
 *  regions, in the order in which the deck defined the fixes. */
typedef struct hs_fix_style {
    hs_description about;
    size_t state_size; /**< bytes of private state, allocated zeroed by hs_sim before create, freed after destroy */

    HS_MUST_USE hs_status (*create)(struct hs_fix *fix, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_fix *fix);                               /**< free what create allocated */
    HS_MUST_USE hs_status (*init)(struct hs_fix *fix, hs_error *err);  /**< before each run: check, read dt */
    HS_MUST_USE hs_status (*setup)(struct hs_fix *fix, hs_error *err); /**< after the run's first pair forces */
    HS_MUST_USE hs_status (*initial_integrate)(struct hs_fix *fix, hs_error *err); /**< half kick and drift */
    HS_MUST_USE hs_status (*post_integrate)(struct hs_fix *fix, hs_error *err); /**< after all drifts: walls, shifts */
    /** After all moves, before lists and forces: change what these depend on, such as coefficients
     *  (env->pairs_changed). Also before the first forces of a run (@p is_setup). */
    HS_MUST_USE hs_status (*pre_force)(struct hs_fix *fix, bool is_setup, hs_error *err);
    /** First step, from the present one on, at which this fix wants lists made anew whatever the schedule; NULL:
     *  never. */
    int64_t (*next_exchange)(const struct hs_fix *fix);
    /** Before atoms are brought back into the box and go to the ranks that own their places, whenever lists are due:
     *  add or remove atoms, move the ranks' borders, tilt the box otherwise. */
    HS_MUST_USE hs_status (*pre_exchange)(struct hs_fix *fix, hs_error *err);
    /** Add to, or constrain, forces; called after the set-up's forces too, following setup. */
    HS_MUST_USE hs_status (*post_force)(struct hs_fix *fix, hs_error *err);
    /** After all forces of a set-up, those of fixes included: what measures every so many steps does so at the first
     *  step, too. */
    HS_MUST_USE hs_status (*measure_at_setup)(struct hs_fix *fix, hs_error *err);
    HS_MUST_USE hs_status (*final_integrate)(struct hs_fix *fix, hs_error *err); /**< half kick */
    /** final_integrate of one step and initial_integrate of the next, with the same bits, in one pass over the atoms; for steps
     *  between which nobody looks. NULL: it takes two. */
    HS_MUST_USE hs_status (*join_integrate)(struct hs_fix *fix, hs_error *err);
    HS_MUST_USE hs_status (*end_of_step)(struct hs_fix *fix, hs_error *err);
    /** The same in a minimisation, whose forces are those of the iteration's last evaluation. */
    HS_MUST_USE hs_status (*end_of_iteration)(struct hs_fix *fix, hs_error *err);
    HS_MUST_USE hs_status (*end_of_run)(struct hs_fix *fix, hs_error *err); /**< after the last step and its output */
    /** The timestep has changed within a run: compute anew what depends on env->dt. NULL: nothing is remembered of
     *  it. */
    HS_MUST_USE hs_status (*dt_changed)(struct hs_fix *fix, hs_error *err);
    /** Global values that decide the future, moved into a checkpoint or back (collective). Reading comes after create
     *  and init; setup is not called then, for the run goes on in its midst. NULL: the words of the fix say
     *  everything. */
    HS_MUST_USE hs_status (*keep_state)(struct hs_fix *fix, hs_state *state, hs_error *err);
    /** After a run: tell people what was found. NULL: nothing is told. */
    void (*say_results)(const struct hs_fix *fix);
    /** f_ID and f_ID[i] in formulas and thermo output; NULL when the style has no such value. */
    HS_MUST_USE hs_status (*scalar)(struct hs_fix *fix, double *value, hs_error *err);
    HS_MUST_USE hs_status (*vector)(struct hs_fix *fix, int i, double *value, hs_error *err); /**< i from 0 */
    /** f_ID[i][j]: row i, column j, from 0. */
    HS_MUST_USE hs_status (*array)(struct hs_fix *fix, int i, int j, double *value, hs_error *err);
    /** One column (from 0) of the values per atom: values[n_local]. */
    HS_MUST_USE hs_status (*per_atom)(struct hs_fix *fix, int column, double *values, hs_error *err);
    int n_vector;                           /**< copied to fix->n_vector; create may set that to another number */
    bool is_extensive, is_vector_extensive; /**< as for computes; copied to the fix */
    /** Whether end_of_step of that step will ask for a pair energy or virial; NULL: never. */
    bool (*needs_energy)(const struct hs_fix *fix, int64_t step);
    /** Announce the values that end_of_step of that step will ask for (hs_value_announce); NULL: the computes do
     *  without. */
    void (*announce)(const struct hs_fix *fix, int64_t step);
    /** fix_modify temp, press: take the temperature or pressure from this compute, which there is and which computes
     *  one. NULL: the style uses none. */
    HS_MUST_USE hs_status (*set_temperature)(struct hs_fix *fix, const char *id, hs_error *err);
    HS_MUST_USE hs_status (*set_pressure)(struct hs_fix *fix, const char *id, hs_error *err);
    bool needs_no_box;       /**< may be defined before there is a box */
    const hs_fix_data *data; /**< what write_data writes and read_data can read; NULL: nothing */
    /** The box moves with the atoms when the energy is minimised; NULL: it stays. */
    const hs_box_freedom *box_freedom;
    bool allows_dynamic_group; /**< keeps nothing of the group's members from step to step */
    bool is_time_dependent;    /**< counts steps: reset_timestep is refused while there is one */
    bool acts_in_minimize;     /**< setup and post_force are called when the energy is minimised, too */
    bool is_integrator;        /**< moves its atoms: two of them on one atom are warned about */
    bool has_energy;           /**< `fix_modify energy yes` adds the scalar to the potential energy */
    bool has_virial;           /**< `fix_modify virial yes` adds virial[] to the pressure */
    bool is_coupling;  /**< the scalar is the energy that a thermostat or barostat has given away (ecouple); copied
                                 to the fix */
    bool moves_at_end; /**< end_of_step moves atoms or the box */
    bool changes_box;  /**< the lengths of the box may change at every step */
    bool keeps_plane;  /**< in two dimensions: z, v_z and f_z that are +0 stay so; see env->is_planar */
} hs_fix_style;

enum { HS_FIX_OWN_MAX = 2 };

/** One fix of a simulation. */
typedef struct hs_fix {
    const hs_fix_style *style;
    char *id;                      /**< owned by hs_sim */
    int group;                     /**< bit number */
    uint32_t mask;                 /**< acts on atoms with (atoms->mask[i] & mask) */
    uint32_t other_groups;         /**< masks of further groups that its words name; set by create */
    hs_env *env;                   /**< borrowed */
    void *state;                   /**< style's own */
    bool adds_energy, adds_virial; /**< fix_modify energy, virial */
    double virial[6];              /**< sum of r_a F_b over all atoms: xx yy zz xy xz yz; energy. Set by
                                        post_force when hs_fix_needs_virial. */
    /** Computes that the fix has made for itself, c_<ID>_temp and the like; owned, freed after destroy. */
    struct hs_compute *own[HS_FIX_OWN_MAX];
    int n_vector;
    int n_rows, n_columns; /**< of the array */
    int n_atom_columns;    /**< 0: one value per atom, f_ID; n: f_ID[1] ... f_ID[n] */
    bool is_extensive, is_vector_extensive, is_array_extensive, is_coupling;
    /** Borrowed [n_vector] from the style's state, where elements differ; NULL: all are alike. */
    const bool *is_element_extensive;
    bool has_variable_length; /**< the array gets more rows while it runs; rows beyond are 0. Set by create */
    /** What there is: at first what the style has functions for; create may clear some. */
    bool has_scalar, has_vector, has_array, has_atoms;
} hs_fix;

/** Whether post_force must fill fix->virial at this step. */
static inline bool hs_fix_needs_virial(const hs_fix *fix) { return fix->adds_virial && fix->env->with_energy; }

hs_who hs_fix_who(const hs_fix *fix);
/** Fail when the step of the next sample has passed without one, which only a rerun of snapshots at other steps brings
 *  about. */
HS_MUST_USE hs_status hs_fix_need_sample(const hs_fix *fix, int64_t next, hs_error *err);
/** Make own[k]: a compute of that style with the ID <fix ID>_<suffix>, which the deck can use like any other. The fix
 *  calls its init. */
HS_MUST_USE hs_status hs_fix_own_compute(hs_fix *fix, int k, const char *style, const char *suffix, int group,
                                         const hs_args *args, hs_error *err);
/** The fix's own stream of noise: another for each style, ID and seed. */
HS_MUST_USE hs_status hs_fix_noise(const hs_fix *fix, int64_t seed, hs_noise *noise, hs_error *err);
/** Step number for noise: it counts on where reset_timestep sets the step back, so that noise never repeats. */
static inline int64_t hs_fix_clock(const hs_fix *fix) { return fix->env->step + fix->env->clock_ahead; }
/** Add to w the virial r_a f_b of the fix's force f on local atom i of its group: xx yy zz xy xz yz. */
typedef void (*hs_fix_virial)(const hs_fix *fix, int i, double w[6]);
/** w += r_a f_b. */
void hs_fix_add_virial(const double r[3], const double f[3], double w[6]);
/** fix->virial from the atoms' parts (collective), which env->virial_of_fixes keeps where it is wanted. */
void hs_fix_sum_virial(hs_fix *fix, hs_fix_virial virial);

/** A compute wants the virial that fixes give each atom: env->virial_of_fixes is there until as many have given it up, and is filled
 *  from the next forces with energy on. */
HS_MUST_USE hs_status hs_virial_of_fixes_want(hs_env *env, hs_error *err);
void hs_virial_of_fixes_release(hs_env *env);

/** All fix styles, ended by NULL; made by the build from the files in src/fix/. */
extern const hs_fix_style *const hs_fix_styles[];

#endif
