/** Thermodynamic output: the table of the log, its keywords and formats. */
#ifndef HS_SIM_THERMO_H
#define HS_SIM_THERMO_H

#include "sim/sim.h"

typedef struct hs_thermo hs_thermo;

HS_MUST_USE hs_status hs_thermo_create(hs_thermo **thermo, hs_sim *sim, hs_error *err);
void hs_thermo_destroy(hs_thermo **thermo);

/** `thermo N`. */
void hs_thermo_set_every(hs_thermo *thermo, int64_t every);
/** `thermo v_name`: the variable gives the step of the next row, anew at each row. */
HS_MUST_USE hs_status hs_thermo_set_every_variable(hs_thermo *thermo, const char *name, hs_error *err);
/** What to do when atoms are missing: thermo_modify lost. */
typedef enum { HS_LOST_ERROR, HS_LOST_WARN, HS_LOST_IGNORE } hs_thermo_lost_mode;
hs_thermo_lost_mode hs_thermo_lost(const hs_thermo *thermo);
/** `thermo_style style args`; resets thermo_modify as LAMMPS does. */
HS_MUST_USE hs_status hs_thermo_set_style(hs_thermo *thermo, const char *style, const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_thermo_modify(hs_thermo *thermo, const hs_args *args, hs_error *err);
/** Before a run: resolve computes, fixes and variables; an unknown one is an error. */
HS_MUST_USE hs_status hs_thermo_init(hs_thermo *thermo, hs_error *err);
/** For a run that is resumed: means so far, and the step of the next row where a variable gives it. */
HS_MUST_USE hs_status hs_thermo_keep(hs_thermo *thermo, hs_state *state, hs_error *err);
/** The present step has a row even if a variable chooses the steps. */
void hs_thermo_want_row(hs_thermo *thermo);
/** Whether the table has a row at this step: the first and last one of a run always, but for the last where a variable decides or a fix
 *  has ended the run. */
bool hs_thermo_is_due(const hs_thermo *thermo, int64_t step);
void hs_thermo_header(hs_thermo *thermo);
/** Write the row of the present step (collective); also the check for lost atoms (thermo_modify lost). */
HS_MUST_USE hs_status hs_thermo_row(hs_thermo *thermo, hs_error *err);
/** Value of a keyword (`temp`, `pe`, `lx`, ...) as formulas and the API see it (collective). *found = false, and HS_OK,
 *  when there is no such keyword. */
HS_MUST_USE hs_status hs_thermo_keyword(hs_thermo *thermo, const char *keyword, double *value, bool *found,
                                        hs_error *err);
/** A keyword: what thermo_style custom, formulas and the API can ask for. */
typedef struct hs_thermo_entry {
    const char *name;   /**< in decks: "etotal" */
    const char *header; /**< above its column: "TotEng" */
    const char *help;   /**< one line */
    bool is_int;
    HS_MUST_USE hs_status (*eval)(hs_thermo *thermo, double *value, hs_error *err); /**< collective */
} hs_thermo_entry;
/** All keywords, ended by an entry without a name. */
extern const hs_thermo_entry hs_thermo_entries[];
/** The keyword of that name, or NULL. */
const hs_thermo_entry *hs_thermo_find_entry(const char *name);
/** The name that a wrong one may have been meant for, or NULL. */
const char *hs_thermo_nearest(const char *word);
/** Table of means and errors after a run, when thermo_modify means asks for it. */
void hs_thermo_say_means(hs_thermo *thermo);
/** Keywords of thermo_modify: its syntax. */
extern const hs_keyword hs_thermo_modify_keywords[];
/** First-pass check of the words of thermo_style custom: NULL when the word may be a column, else the nearest
 *  keyword or "". */
const char *hs_thermo_check_word(const char *word);

#endif
