/** Files that `print` would have written by now: halfshell check, which writes nothing, keeps their text for the commands that read
 *  them (include, jump, variables of style file and atomfile). */
#ifndef HS_DECK_UNWRITTEN_H
#define HS_DECK_UNWRITTEN_H

#include "deck/deck.h"
#include "io/line_reader.h"

/** Add a line to a file, in the place of all that it holds unless @p is_append. Lines behind a file that is on the disk are not kept
 *  (collective). */
HS_MUST_USE hs_status hs_unwritten_add(hs_deck *deck, const char *file, const char *line, bool is_append,
                                       hs_error *err);
/** What such a file holds; NULL: there is none of that name. Borrowed until the next hs_unwritten_add. */
const hs_text *hs_unwritten_find(const hs_deck *deck, const char *file);
/** Open a file for reading, one that would have been written, too (collective). */
HS_MUST_USE hs_status hs_unwritten_open(const hs_deck *deck, hs_lines *lines, const char *file, hs_error *err);
void hs_unwritten_fini(hs_deck *deck);

#endif
