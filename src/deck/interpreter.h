/** What the commands of a script need from the interpreter, beyond deck.h. */
#ifndef HS_DECK_INTERPRETER_H
#define HS_DECK_INTERPRETER_H

#include "deck/deck.h"

/** The command `clear`: a new, empty simulation; variables, log and echo stay (collective). */
HS_MUST_USE hs_status hs_deck_clear(hs_deck *deck, hs_error *err);
/** Close the log file that the deck or -log opened, if there is one; false when not all of it could be written. */
bool hs_deck_close_log(hs_deck *deck);
/** Replace bytes that do no good on a terminal (control characters, broken UTF-8) by '?'. */
void hs_deck_make_printable(char *text);

#endif
