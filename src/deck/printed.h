/** Files that the commands `print` and `pair_write` write to: how long they were, so that a resumed run does not print its lines
 *  twice. */
#ifndef HS_DECK_PRINTED_H
#define HS_DECK_PRINTED_H

#include <stdint.h>

#include "base/error.h"

/** Note the present size of a file. @p list: owned text of lines "SIZE NAME", NULL while there are none. */
HS_MUST_USE hs_status hs_printed_note(char **list, const char *file, int64_t size, hs_error *err);
/** Note a file that will be added to, unless it is noted already: what it holds now, nothing if it is not there yet. */
HS_MUST_USE hs_status hs_printed_expect(char **list, const char *file, hs_error *err);
/** Cut the files that have grown since back to the noted sizes. Shorter and missing ones stay as they are. */
HS_MUST_USE hs_status hs_printed_cut(const char *list, hs_error *err);

#endif
