/** Interface of dumps: snapshots of atoms written to files. One dump style is one file in src/dump/. */
#ifndef HS_STYLE_DUMP_H
#define HS_STYLE_DUMP_H

#include "style/args.h"
#include "style/env.h"
#include "style/state.h"

struct hs_dump;

typedef struct hs_dump_style {
    hs_description about;
    size_t state_size; /**< bytes of private state, allocated zeroed before create, freed after destroy */
    /** Before anything runs: what words without `$` tell beyond the syntax. NULL: nothing. */
    HS_MUST_USE hs_status (*check)(const char *file, const hs_args *args, hs_error *err);
    HS_MUST_USE hs_status (*create)(struct hs_dump *dump, const hs_args *args, hs_error *err);
    /** dump_modify keywords of this style alone; *n_used = words taken, 0 when the keyword is not the style's. */
    HS_MUST_USE hs_status (*modify)(struct hs_dump *dump, const hs_args *args, int *n_used, hs_error *err);
    void (*destroy)(struct hs_dump *dump);
    /** Bytes of a growing file that hold whole snapshots, -1 when there is none; NULL: the file tells itself. */
    int64_t (*position)(const struct hs_dump *dump);
    /** What checkpoints hold of it beside its place in the file, as that of fixes. */
    HS_MUST_USE hs_status (*keep_state)(struct hs_dump *dump, hs_state *state, hs_error *err);
    HS_MUST_USE hs_status (*init)(struct hs_dump *dump, hs_error *err); /**< before each run */
    HS_MUST_USE hs_status (*write)(struct hs_dump *dump,
                                   hs_error *err); /**< one snapshot of the present step (collective) */
} hs_dump_style;

typedef struct hs_dump {
    const hs_dump_style *style;
    char *id;      /**< owned by hs_sim */
    int group;     /**< bit number */
    uint32_t mask; /**< writes atoms with (atoms->mask[i] & mask) */
    hs_env *env;   /**< borrowed */
    void *state;   /**< style's own */
    char *file;    /**< owned by hs_sim; as in the deck; `*` stands for the step, a name ending in .gz is compressed */
    int64_t every; /**< steps between snapshots */
    char *every_variable; /**< owned by hs_sim; gives the step of the next snapshot in place of every; NULL: none */
    int64_t next_due;     /**< by that variable */
    int64_t last_written; /**< step, -1 for never: a step is written once */
    bool write_first, append, flush, wrap; /**< dump_modify first, append, flush, pbc */
    bool is_resumed;   /**< the run goes on from a checkpoint: what was written of later steps is to be dropped */
    int64_t resume_at; /**< of text files then: bytes to be kept, -1: all */
    bool is_single;    /**< write_dump: one snapshot, a file that appears whole */
} hs_dump;

/** dump_modify every <N>|v_<name>: the value is word 1. */
HS_MUST_USE hs_status hs_dump_read_every(hs_dump *dump, const hs_args *args, hs_error *err);

/** How messages name it: dump 'ID' (style). */
hs_who hs_dump_who(const hs_dump *dump);

/** All dump styles, ended by NULL; made by the build. */
extern const hs_dump_style *const hs_dump_styles[];

#endif
