/** Lines of a text file, plain or compressed by gzip, that nobody has checked yet. */
#ifndef HS_IO_LINE_READER_H
#define HS_IO_LINE_READER_H

#include "base/text.h"
#include "parallel/parallel.h"

enum { HS_LINE_WORDS_MAX = 1024, HS_LINE_BYTES_MAX = 65536 };

/** A file being read line by line: the first rank reads, and all ranks get the lines. Zero it before hs_lines_open. */
typedef struct hs_lines {
    const char *path;            /**< borrowed */
    const hs_parallel *parallel; /**< borrowed */
    void *file;                  /**< owned; NULL on other ranks, and for a text */
    char *chunk;                 /**< owned: bytes read and not yet given out */
    size_t n_chunk, chunk_at;
    bool is_whole;    /**< the chunk is a whole text, on all ranks */
    bool is_drained;  /**< there are no bytes after the chunk */
    long number;      /**< of the present line, from 1 */
    bool at_end;      /**< there was no further line */
    bool is_held;     /**< hs_lines_next gives the present line once more */
    hs_text text;     /**< the present line without its comment; the words point into it */
    char comment[64]; /**< first word after #, "" when there is none; cut if longer */
    int n_words;
    const char *word[HS_LINE_WORDS_MAX];
} hs_lines;

/** Open for reading; fails with the reason when it is not a readable file. All functions are collective, and give the
 *  same on all ranks. */
HS_MUST_USE hs_status hs_lines_open(hs_lines *lines, const char *path, const hs_parallel *parallel, hs_error *err);
/** The same for a text, which all ranks have, in the place of a file of that name. It is copied. */
HS_MUST_USE hs_status hs_lines_open_text(hs_lines *lines, const char *path, const hs_text *text,
                                         const hs_parallel *parallel, hs_error *err);
void hs_lines_close(hs_lines *lines);
/** Read and split the next line, blank ones too. At the end of the file at_end is set and n_words is 0. Lines that
 *  are too long, have too many words, or hold bytes that are no text are errors. */
HS_MUST_USE hs_status hs_lines_next(hs_lines *lines, hs_error *err);
/** The next line with words. */
HS_MUST_USE hs_status hs_lines_next_filled(hs_lines *lines, hs_error *err);
/** Give the present line back. */
static inline void hs_lines_hold(hs_lines *lines) { lines->is_held = true; }

#endif
