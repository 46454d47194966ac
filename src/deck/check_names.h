/** Names the first pass knows: variables set to literal words, files read and written. */
#ifndef HS_DECK_CHECK_NAMES_H
#define HS_DECK_CHECK_NAMES_H

#include "deck/name_list.h"
#include "deck/variables.h"
#include "style/args.h"

/** A variable and the literal values it may have. */
typedef struct hs_known_variable {
    char *name; /**< owned */
    hs_name_list values;
    bool is_fixed; /**< by -var: the deck does not change it */
    bool is_open;  /**< it may have other values too */
} hs_known_variable;

typedef struct hs_check_names {
    hs_name_list visited;        /**< files that were checked */
    hs_name_list written;        /**< files that the deck itself writes */
    hs_known_variable *variable; /**< owned [n_variables] */
    int n_variables;
    size_t capacity;
} hs_check_names;

/** Start with the index variables of the command line. */
HS_MUST_USE hs_status hs_check_names_init(hs_check_names *names, const hs_variables *given, hs_error *err);
void hs_check_names_fini(hs_check_names *names);
/** Learn from a `variable` command. */
HS_MUST_USE hs_status hs_check_names_define(hs_check_names *names, const hs_args *args, hs_error *err);
/** All words that @p word may become, as far as its variables are known; none when one is not. */
HS_MUST_USE hs_status hs_check_names_expand(const hs_check_names *names, const char *word, hs_name_list *expanded,
                                            hs_error *err);

#endif
