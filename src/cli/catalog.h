/** Everything a deck may contain, by family, read from the descriptors: what help, manual, man page and completion
 *  show. */
#ifndef HS_CLI_CATALOG_H
#define HS_CLI_CATALOG_H

#include <stdio.h>

#include "style/args.h"

/** One family of the catalogue. */
typedef struct hs_catalog {
    const char *name;   /**< topic of `halfshell help`, and the page's file name: "pair" */
    const char *title;  /**< "Pair styles" */
    const char *kind;   /**< "pair style" */
    const char *before; /**< deck words before an entry's name, and after it; "" for none; NULL: not deck lines */
    const char *after;
    const char *intro; /**< a paragraph of Markdown */
} hs_catalog;

/** All families, ended by a NULL name. */
extern const hs_catalog hs_catalogs[];

typedef struct hs_catalog_entry {
    const hs_catalog *family;
    hs_description about;   /**< only name and summary where the family has no descriptors */
    const hs_syntax *coeff; /**< pair styles: words of pair_coeff after the types; else NULL */
} hs_catalog_entry;

/** Entries of a family sorted by name; *entries is owned by the caller, its texts are static. */
HS_MUST_USE hs_status hs_catalog_list(const hs_catalog *family, hs_catalog_entry **entries, int *n, hs_error *err);

/** A deck line of the entry: "fix <ID> <group-ID> nve". */
void hs_catalog_syntax(FILE *stream, const hs_catalog_entry *entry);
/** Its pair_coeff line; nothing for other families. */
void hs_catalog_coeff_syntax(FILE *stream, const hs_catalog_entry *entry);

/** Rows of docs/reference/exit-codes: code, meaning, ended by NULL. */
extern const char *const hs_exit_code_meanings[];

/* Pages made from the catalogue. Write errors stay in the stream for the caller to see. */
HS_MUST_USE hs_status hs_manual_write(const char *directory, hs_error *err); /**< docs/reference/ (Markdown) */
HS_MUST_USE hs_status hs_manpage_write(FILE *stream, hs_error *err);         /**< halfshell(1) */
HS_MUST_USE hs_status hs_completion_write(FILE *stream, const char *shell, hs_error *err); /**< bash or zsh */

#endif
