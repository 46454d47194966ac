/** The files of a deck that are being read: a stack, the innermost include on top. */
#ifndef HS_DECK_SOURCE_H
#define HS_DECK_SOURCE_H

#include "deck/deck.h"
#include "deck/lexer.h"

/** Files within files, as in LAMMPS. */
enum { HS_SOURCES_MAX = 16 };

typedef struct hs_source {
    char *name;   /**< owned; as written in the deck or on the command line */
    hs_text text; /**< owned; the whole file */
    hs_cursor cursor;
    long line;       /**< first line of the present command */
    long jump_line;  /**< line of the jump whose label is looked for... */
    char *jump_name; /**< ...and its file; owned */
    struct hs_source *below;
    int depth; /**< 1 for the deck itself */
} hs_source;

/** Read a whole file; "-" or NULL is standard input. Rank 0 reads, all ranks get the text (collective). */
HS_MUST_USE hs_status hs_source_read(hs_deck *deck, const char *file, hs_text *text, hs_error *err);
/** Name for messages: "-" and NULL give "(standard input)". */
const char *hs_source_name(const char *file);

/** Read a file and put it on top of deck->source (collective). */
HS_MUST_USE hs_status hs_source_push(hs_deck *deck, const char *file, hs_error *err);
/** Put a text on top of deck->source, at a place within it. */
HS_MUST_USE hs_status hs_source_push_text(hs_deck *deck, const char *name, const char *text, size_t at,
                                          long n_lines_read, long line, hs_error *err);
/** Continue with another file (or the same one, "SELF") from its start, in place of the top one (collective). */
HS_MUST_USE hs_status hs_source_jump(hs_deck *deck, const char *file, hs_error *err);
void hs_source_pop(hs_deck *deck);
/** Whether the text has `label NAME`. */
bool hs_source_has_label(const char *data, size_t size, const char *label);

/** Carry out the commands of the top source up to its end (interpreter.c); used by `include`. */
HS_MUST_USE hs_status hs_source_run(hs_deck *deck, hs_error *err);

#endif
