/** Replacing $x, ${name} and $(formula) in a line. */
#ifndef HS_DECK_SUBSTITUTE_H
#define HS_DECK_SUBSTITUTE_H

#include "deck/deck.h"

/** Replace every variable of @p line that is not within quotes; what is put in is not looked at again. $x: the
 *  variable of that one letter; ${name}: of that name; $(formula) its value as %.20g; $(formula:%fmt) as %fmt. A
 *  name or formula cannot hold a `$` itself.
 *  @param[in,out] line  replaced by the result
 *  @param echo          show the line after each replacement, as deck->echo_screen and echo_log say
 *  Collective (formulas). Errors: unknown variables, formulas that fail, lines longer than 1 MiB. */
HS_MUST_USE hs_status hs_substitute(hs_deck *deck, hs_text *line, bool echo, hs_error *err);

/** A `$` expression at @p at (which is a '$'): length of the whole, and its inside. */
typedef struct hs_dollar {
    enum { HS_DOLLAR_NAME, HS_DOLLAR_FORMULA } kind;
    size_t length;      /**< of "$x", "${name}", "$(formula)" */
    const char *inside; /**< name or formula; points into the line */
    size_t n_inside;
} hs_dollar;

HS_MUST_USE hs_status hs_dollar_read(const char *at, hs_dollar *dollar, hs_error *err);
/** Cut "formula:%fmt" into its parts; *format is "%.20g" without one. The caller frees @p formula and @p format
 *  with HS_FREE. */
HS_MUST_USE hs_status hs_dollar_formula(const hs_dollar *dollar, char **formula, char **format, hs_error *err);

/** The next `$` outside of quotes at or after @p at; NULL when there is none. */
const char *hs_dollar_find(const char *at);

#endif
