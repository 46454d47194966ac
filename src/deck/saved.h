/** The form of what the deck keeps in checkpoints; shared by save.c, repeat.c, resume.c and read_restart.c. */
#ifndef HS_DECK_SAVED_H
#define HS_DECK_SAVED_H

#include "deck/frames.h"
#include "deck/variables.h"
#include "io/checkpoint.h"

/** ASCII's own separators: they stand between words and behind commands. */
enum { HS_SAVED_WORD = '\x1f', HS_SAVED_COMMAND = '\x1e' };
/** A place that is a file; the others are frames. */
enum { HS_SAVED_FILE = 0 };

HS_MUST_USE hs_status hs_saved_keep_generators(hs_variables *variables, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_variable(hs_variable *variable, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_frame(hs_frame *frame, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_fix(hs_fix *fix, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saved_keep_dump(hs_dump *dump, hs_state *state, hs_error *err);

/** The state that is the section KIND/ID ("fix", "compute", "dump", "variables"): deck/save.c. */
HS_MUST_USE hs_status hs_saved_get(hs_checkpoint *checkpoint, const char *kind, const char *id, hs_state *state,
                                   hs_error *err);

/** Words of a joined text: cut in place. The caller frees words->word (the array).  deck/repeat.c, as the next three */
HS_MUST_USE hs_status hs_saved_cut_words(char *text, hs_args *words, hs_error *err);
/** Box, types and atoms, as far as what there is knows of their fields (collective). */
HS_MUST_USE hs_status hs_saved_get_atoms(hs_checkpoint *checkpoint, hs_sim *sim, bool all_fields, hs_error *err);
/** Step, time, energies and settings of the run; @p is_resumed: the same run goes on, with the degrees of freedom that
 *  were counted at its start. */
HS_MUST_USE hs_status hs_saved_get_run(hs_checkpoint *checkpoint, hs_sim *sim, bool is_resumed, hs_error *err);
/** Repeat the commands that made the simulation, without a word to anyone; @p is_restart: only those that read_restart
 *  takes over. @p commands is cut in place (collective). */
HS_MUST_USE hs_status hs_saved_repeat(hs_checkpoint *checkpoint, hs_deck *deck, char *commands, bool is_restart,
                                      hs_error *err);

#endif
