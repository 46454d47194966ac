/** Text: a growable string, words, and the nearest of a list of words. */
#ifndef HS_BASE_TEXT_H
#define HS_BASE_TEXT_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/** Growable string; always terminated once something was added. Zero it before first use; free with hs_text_fini. */
typedef struct hs_text {
    char *data;    /**< owned; NULL while empty */
    size_t length; /**< bytes without the terminator */
    size_t capacity;
} hs_text;

/** Room for n more bytes and the terminator. */
HS_MUST_USE hs_status hs_text_reserve(hs_text *text, size_t n_more, hs_error *err);
HS_MUST_USE hs_status hs_text_append(hs_text *text, const char *bytes, size_t n, hs_error *err);
HS_MUST_USE hs_status hs_text_printf(hs_text *text, hs_error *err, const char *fmt, ...) HS_PRINTF(3, 4);
void hs_text_clear(hs_text *text);
void hs_text_fini(hs_text *text);
/** The string itself, "" while empty; borrowed until the next change. */
const char *hs_text_get(const hs_text *text);

/** Strict numbers: the whole word must be a number; "1e999", "nan", "inf", "0x1", "--3" and "" are refused (false). */
bool hs_text_to_double(const char *word, double *value);
bool hs_text_to_int64(const char *word, int64_t *value);

/** The nearest of @p n words by edit distance, of equally near ones one with the same first letter; else the longest one that stands
 *  before a slash in @p word; NULL when none is near enough to be meant. Borrowed from @p words. */
const char *hs_text_nearest(const char *word, const char *const *words, size_t n);

/** Whether a word of the deck names a style: by its name, or by that of one of its variants in LAMMPS's accelerators, such as nve/omp, of
 *  which Halfshell has none. */
bool hs_text_is_style(const char *word, const char *name);

/** `pattern` with `*` and `?` matches all of `word`. */
bool hs_text_glob(const char *pattern, const char *word);

#endif
