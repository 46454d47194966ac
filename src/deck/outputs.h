/** Files that a deck's lines will write, known before anything runs: an hour's run must not end for want of a folder. */
#ifndef HS_DECK_OUTPUTS_H
#define HS_DECK_OUTPUTS_H

#include "deck/command.h"

/** Index of the first word at or after @p from that names a file which the line will write; args->n: there is none.
 *  @p args: of the whole line; words of a fix's style count, too. */
int hs_outputs_next(const hs_command *command, const hs_args *args, int from);
/** Note a folder that the deck makes (`shell mkdir`). */
HS_MUST_USE hs_status hs_outputs_note_folder(hs_deck *deck, const char *folder, hs_error *err);
/** Refuse a file that cannot be written for want of its folder, unless the deck makes that (collective). */
HS_MUST_USE hs_status hs_outputs_check(hs_deck *deck, const char *who, const char *file, hs_error *err);

#endif
