/** The variables of a deck. */
#ifndef HS_DECK_VARIABLES_H
#define HS_DECK_VARIABLES_H

#include "deck/deck.h"
#include "deck/formula.h"
#include "deck/marsaglia.h"

typedef enum {
    HS_VARIABLE_INDEX,
    HS_VARIABLE_LOOP,
    HS_VARIABLE_STRING,
    HS_VARIABLE_FORMAT,
    HS_VARIABLE_GETENV,
    HS_VARIABLE_EQUAL,
    HS_VARIABLE_ATOM,
    HS_VARIABLE_INTERNAL,
    HS_VARIABLE_FILE,
    HS_VARIABLE_VECTOR,
    HS_VARIABLE_ATOMFILE,
    HS_VARIABLE_WORLD,
    HS_VARIABLE_UNIVERSE,
    HS_VARIABLE_ULOOP,
    HS_N_VARIABLE_STYLES
} hs_variable_style;

/** Names of the styles in that order, ended by NULL. */
extern const char *const hs_variable_styles[];

typedef struct hs_variable {
    char *name; /**< owned */
    hs_variable_style style;
    /** Owned [n_values]: index, universe, file: all values; string, world; format: variable and format; getenv: name;
     *  atomfile: name of the file. */
    char **value;
    int n_values;
    /** Index, universe, file: place of the present value; loop, uloop: the present number; atomfile: sets read. */
    int64_t which;
    int64_t first, last;           /**< loop, uloop */
    int width;                     /**< the same: digits to pad to, 0 without pad */
    double number;                 /**< internal */
    hs_formula *formula;           /**< owned; equal, vector, atom */
    struct hs_atomfile *atom_file; /**< owned; atomfile: values and the open file */
    bool is_evaluating;            /**< guards against formulas that use themselves */
} hs_variable;

typedef struct hs_variables {
    hs_variable **variable; /**< owned [n] */
    int n;
    size_t capacity;
    hs_marsaglia generator;      /**< random() and normal() of equal-style formulas */
    hs_marsaglia atom_generator; /**< the same of atom-style ones, between runs */
    int64_t n_draws;             /**< during runs: evaluations of random functions per atom so far */
    struct hs_atom_draws *draws; /**< borrowed while an atom-style formula is evaluated: its random numbers */
    int depth;                   /**< formulas within formulas being evaluated */
} hs_variables;

HS_MUST_USE hs_status hs_variables_create(hs_variables **variables, hs_error *err);
void hs_variables_destroy(hs_variables **variables);
/** Whether it has a value for each atom. */
static inline bool hs_variable_is_per_atom(const hs_variable *variable)
{
    return variable->style == HS_VARIABLE_ATOM || variable->style == HS_VARIABLE_ATOMFILE;
}
/** NULL when there is none. */
hs_variable *hs_variables_find(const hs_variables *variables, const char *name);
/** Fail with the nearest name. */
HS_MUST_USE hs_status hs_variables_need(const hs_variables *variables, const char *name, hs_variable **variable,
                                        hs_error *err);

/** The command `variable`; the words after it. */
HS_MUST_USE hs_status hs_variables_define(hs_deck *deck, const hs_args *args, hs_error *err);
/** What of it can be checked without values: style, counts, formulas. In the first pass words that hold `$` are not yet
 *  known and pass. */
HS_MUST_USE hs_status hs_variables_check(const hs_args *args, bool first_pass, hs_error *err);
/** For checkpoints: the variable of that name, made if there is none, and its values and formula (NULL: none). */
HS_MUST_USE hs_status hs_variables_restore(hs_variables *variables, const char *name, hs_variable **variable,
                                           hs_error *err);
HS_MUST_USE hs_status hs_variables_refill(hs_variable *variable, int n, const char *const *values, const char *formula,
                                          hs_error *err);
/** Values of a file-style variable, which has none yet: the first words of the lines that have any (collective). */
HS_MUST_USE hs_status hs_variables_read_file(hs_variable *variable, const char *path, const hs_deck *deck,
                                             hs_error *err);
/** Next set of values of an atomfile-style variable, the first one included; *is_there = false at the end of the file
 *  (collective). */
HS_MUST_USE hs_status hs_variable_read_atoms(hs_variable *variable, hs_deck *deck, bool *is_there, hs_error *err);
/** The values it has now: [n_local], borrowed while the order of atoms stays. */
const double *hs_variable_atom_values(const hs_variable *variable);
/** After a checkpoint's commands were repeated, before its atoms are read: give values per atom their place among the
 *  atoms. */
HS_MUST_USE hs_status hs_variables_join_atoms(hs_variables *variables, hs_atoms *atoms, hs_error *err);
/** Before the atoms go (`clear`): atomfile-style variables go with them. */
void hs_variables_leave_atoms(hs_variables *variables);
/** Part of the end of a variable. */
void hs_atomfile_destroy(struct hs_atomfile **file);
/** -var: an index variable that later definitions in the deck do not change. */
HS_MUST_USE hs_status hs_variables_set_index(hs_variables *variables, const char *name, int n,
                                             const char *const *values, hs_error *err);
/** The command `next`: advance them all; at the end all are deleted and *exhausted is true (collective). */
HS_MUST_USE hs_status hs_variables_next(hs_deck *deck, const hs_args *args, bool *exhausted, hs_error *err);
/** The function next(name) of formulas: the variable goes on to its next value, and is deleted when there is none
 *  (collective). */
HS_MUST_USE hs_status hs_variables_go_on(hs_deck *deck, const char *name, hs_error *err);
/** Give an internal variable its number. */
HS_MUST_USE hs_status hs_variables_set_internal(hs_variables *variables, const char *name, double number,
                                                hs_error *err);

/** The text that ${name} becomes (collective for formulas). Replaces what is in @p text. */
HS_MUST_USE hs_status hs_variables_text(hs_deck *deck, const char *name, hs_text *text, hs_error *err);
/** The number of a variable: of a formula in full precision, of the others their text read as a number (collective). */
HS_MUST_USE hs_status hs_variables_number(hs_deck *deck, const char *name, double *value, hs_error *err);
/** The same as formulas see it: a formula's value passes through %.15g, as in LAMMPS. */
HS_MUST_USE hs_status hs_variables_rounded(hs_deck *deck, const char *name, double *value, hs_error *err);
/** Length of a vector-style variable (0 for others) and its elements: see hs_formula_length and hs_formula_vector. */
HS_MUST_USE hs_status hs_variables_length(hs_deck *deck, const char *name, bool refresh, int *length, bool *varies,
                                          hs_error *err);
HS_MUST_USE hs_status hs_variables_vector(hs_deck *deck, const char *name, int length, double *values, hs_error *err);
/** Values of an atom-style variable (or one number for all): values[n_local] (collective). */
HS_MUST_USE hs_status hs_variables_atoms(hs_deck *deck, const char *name, double *values, hs_error *err);
/** The same for one that is part of the atom-style formula being evaluated. */
HS_MUST_USE hs_status hs_variables_atoms_within(hs_deck *deck, const char *name, double *values, hs_error *err);

/** Whether a format has exactly one conversion, for a double: %[flags][width][.precision] and one of e f g E F G a A.
 *  Text around it and %% are allowed. */
bool hs_format_is_for_double(const char *format);

#endif
