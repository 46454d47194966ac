/** The form of what the deck keeps in checkpoints; shared by save.c and resume.c. */
#ifndef HS_DECK_SAVED_H
#define HS_DECK_SAVED_H

#include "deck/frames.h"
#include "deck/variables.h"

/** ASCII's own separators: they stand between words and behind commands. */
enum { HS_SAVED_WORD = '\x1f', HS_SAVED_COMMAND = '\x1e' };
/** A place that is a file; the others are frames. */
enum { HS_SAVED_FILE = 0 };

HS_MUST_USE hs_status hs_saved_join(hs_text *text, const char *command, const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_generators(hs_variables *variables, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_variable(hs_variable *variable, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_frame(hs_frame *frame, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_dump(hs_dump *dump, hs_state *state, hs_error *err);

#endif
