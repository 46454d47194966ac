/** Words of one command, and the descriptions by which they are checked, parsed and explained.
 *
 *  One hs_syntax serves four readers: the first pass over the deck (before anything runs), the command itself,
 *  `halfshell help`, and the reference manual. */
#ifndef HS_STYLE_ARGS_H
#define HS_STYLE_ARGS_H

#include <stdint.h>

#include "base/error.h"

enum { HS_NAME_MAX = 128 }; /**< letters of an ID, or of a variable's name */

/** A keyword of a command and what follows it. */
typedef struct hs_keyword {
    const char *name;   /**< "d_<name>": every longer word that begins with "d_" */
    int n_values;       /**< words after the keyword; -1: one (whatever it is) and any more up to the next keyword */
    const char *values; /**< what they are: "yes|no" lists the only words allowed (for n_values = 1);
                                otherwise names for people, "<steps>" or "<lo> <hi>", and "<output-file>" */
    const char *help;   /**< one line for the manual */
} hs_keyword;

/** Shape of the words after a command's (or a style's) name. A file that will be written is called <output-file> in it,
 *  where it has a place of its own, alone after a keyword, or as one of the positional words. */
typedef struct hs_syntax {
    const char *usage;          /**< e.g. "<group-ID> create <T> <seed> [keyword value ...]" */
    int n_min, n_max;           /**< positional words before the first keyword; n_max = -1: any number */
    const hs_keyword *keywords; /**< ended by a NULL name; NULL when there are none */
} hs_syntax;

/** Words of one command, without its name. Borrowed for the call only: copy what is kept. */
typedef struct hs_args {
    const char *command; /**< for messages: "pair_style lj/cut", "fix nve", "velocity" */
    int n;
    const char *const *word; /**< [n] */
} hs_args;

/** The words from index @p first on. */
hs_args hs_args_from(const hs_args *args, int first, const char *command);

/** Check counts and keywords. A word that still holds an unexpanded `$` matches anything; in the first pass
 *  (@p has_variables) a line with such words is only checked as far as its meaning is certain. */
HS_MUST_USE hs_status hs_syntax_check(const hs_syntax *syntax, const hs_args *args, bool has_variables, hs_error *err);

/** Index of the first keyword at or after the positional words, args->n when there is none. */
int hs_syntax_first_keyword(const hs_syntax *syntax, const hs_args *args);

/** Index of the first word at or after @p from that is an <output-file>, args->n when there is none. A word that holds an
 *  unexpanded `$` counts as one. */
int hs_syntax_next_output(const hs_syntax *syntax, const hs_args *args, int from);

/* Strict parsing of word i; every message names the command, the word, what was expected, and the nearest word where it
 * helps. A word that is missing is an error, too. */

/** A finite number. */
HS_MUST_USE hs_status hs_arg_double(const hs_args *args, int i, double *value, hs_error *err);
HS_MUST_USE hs_status hs_arg_positive(const hs_args *args, int i, double *value, hs_error *err);     /**< > 0 */
HS_MUST_USE hs_status hs_arg_not_negative(const hs_args *args, int i, double *value, hs_error *err); /**< >= 0 */
/** A whole number from min to max. */
HS_MUST_USE hs_status hs_arg_int(const hs_args *args, int i, int64_t min, int64_t max, int64_t *value, hs_error *err);
HS_MUST_USE hs_status hs_arg_bool(const hs_args *args, int i, bool *value,
                                  hs_error *err); /**< yes|no (on|off, true|false too) */
/** Index of the word in a NULL-ended list of allowed words. */
HS_MUST_USE hs_status hs_arg_choice(const hs_args *args, int i, const char *const *choices, int *choice, hs_error *err);
/** An atom type, from 1 to n_types. */
HS_MUST_USE hs_status hs_arg_type(const hs_args *args, int i, int n_types, int64_t *type, hs_error *err);
/** A type range as in `pair_coeff * 2*4 ...`: n, *, n*, *n, m*n; within [1, n_types]. */
HS_MUST_USE hs_status hs_arg_range(const hs_args *args, int i, int n_types, int *lo, int *hi, hs_error *err);
/** Fail unless word i exists. */
HS_MUST_USE hs_status hs_arg_need(const hs_args *args, int i, const char *what, hs_error *err);
/** Refuse a name that has other characters than letters, digits and underscores, or more than HS_NAME_MAX of them (names
 *  within checkpoints and figures are made of it): "<command>: the <what> '<name>' ...". */
HS_MUST_USE hs_status hs_name_check(const char *command, const char *what, const char *name, hs_error *err);
/** Refuse word i: "<command>: '<word>' is not <expected>; did you mean '<nearest>'?" (choices may be NULL). */
HS_MUST_USE hs_status hs_arg_refuse(const hs_args *args, int i, const char *expected, const char *const *choices,
                                    hs_error *err);

/** "fix 'ID' (style)" or "compute 'ID' (style)": how messages name one that is there already (hs_fix_who, hs_compute_who, hs_dump_who). */
typedef struct hs_who {
    char text[192];
} hs_who;

/** What every style and command tells about itself; read by the deck parser, `halfshell help`, the manual, the man
 *  page, shell completion and the tests. */
typedef struct hs_description {
    const char *name;      /**< as written in a deck: "lj/cut" */
    hs_syntax syntax;      /**< words after the style's name */
    const char *summary;   /**< one line */
    const char *details;   /**< paragraphs in Markdown: meaning of every word, units, defaults, restrictions */
    const char *reference; /**< source of the formula with DOI, or NULL */
    const char *example;   /**< one or more deck lines */
} hs_description;

#endif
