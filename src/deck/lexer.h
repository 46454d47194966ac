/** Text of decks: logical lines, comments, words. Knows nothing of variables or commands. */
#ifndef HS_DECK_LEXER_H
#define HS_DECK_LEXER_H

#include <stddef.h>

#include "base/text.h"

/** A place in a deck's text. Zero-initialised it is at the start of line 1. */
typedef struct hs_cursor {
    size_t at;         /**< bytes read */
    long n_lines_read; /**< physical lines read */
} hs_cursor;

/** Read the next logical line: `&` at the end of a physical line (blanks may follow it) joins the next one, and so does
 *  an odd number of triple quotes, which keeps the line break. Both hold inside comments too, as in LAMMPS. A mark of
 *  byte order at the beginning of the text is passed over.
 *  @param[out] line   the line without its end; untouched quotes, comments and variables
 *  @param[out] first  number of its first physical line, from 1
 *  @param[out] found  false at the end of the text
 *  An error, when the text holds a NUL byte (it is no deck) or ends within triple quotes. */
HS_MUST_USE hs_status hs_lexer_line(const char *data, size_t size, hs_cursor *cursor, hs_text *line, long *first,
                                    bool *found, hs_error *err);

/** End @p line before the first `#` that is not within quotes. */
void hs_lexer_strip_comment(char *line);

/** At @p at, is there a quotation? Length of its opening mark (1 or 3), 0 when there is none. */
size_t hs_lexer_quote(const char *at);
/** End (first byte of the closing mark) of the quotation whose text begins at @p text; NULL when it is not closed. */
const char *hs_lexer_quote_end(const char *text, char mark, size_t n_mark);

/** Words of one line. */
typedef struct hs_words {
    char *buffer;      /**< owned; the words point into it */
    const char **word; /**< owned [n] */
    bool *was_quoted;  /**< owned [n] */
    int n;
} hs_words;

/** Split a line (comment and variables already done) into words at blanks. A word that begins with '…', "…" or
 *  """…""" is what stands between the marks; after the closing mark a blank or the end must follow. Signs of print
 *  that look like a keyboard's are refused in other words. Zero @p words first; free with hs_words_fini. */
HS_MUST_USE hs_status hs_words_split(hs_words *words, const char *line, hs_error *err);
void hs_words_fini(hs_words *words);

#endif
