/** Where a deck is, beyond the lines of its files: lists of commands within `if`, and runs cut by `every`. A checkpoint
 *  stores these frames, and `halfshell resume` enters them again. */
#ifndef HS_DECK_FRAMES_H
#define HS_DECK_FRAMES_H

#include "deck/deck.h"

/** A place within a command; lives on the stack of the function that carries the command out. */
typedef struct hs_frame {
    enum { HS_FRAME_LIST = 1, HS_FRAME_RUN = 2, HS_FRAME_MINIMIZE = 3 } kind;
    hs_args words;       /**< list: the commands; run, minimize: their words. Borrowed */
    int64_t next;        /**< the command after the present one */
    int64_t left;        /**< run: steps from the beginning of the present part on; minimize: iterations */
    int64_t part;        /**< run: steps of the present part; minimize: evaluations left */
    bool is_first;       /**< run: the present part is the first */
    bool is_in_commands; /**< run: the part's steps are done, its commands are being carried out */
    int source_depth;    /**< files that were open */
    struct hs_frame *below;
} hs_frame;

void hs_frame_push(hs_deck *deck, hs_frame *frame);
void hs_frame_pop(hs_deck *deck);

/** halfshell check: whether a file is missing which the deck itself may have written before, had this been a run. Then
 *  nothing of what follows can be checked: a warning says so, and the deck ends here (collective). */
bool hs_deck_ends_check(hs_deck *deck, const char *command, const char *path);

/** Carry out a list's commands from frame->next on.  cmd_script.c */
HS_MUST_USE hs_status hs_frame_run_list(hs_deck *deck, hs_frame *frame, hs_error *err);
/** Go on with a run; with @p is_within in the midst of its present part, else with its commands from frame->next on.
 *  cmd_run.c */
HS_MUST_USE hs_status hs_frame_run_run(hs_deck *deck, hs_frame *frame, bool is_within, hs_error *err);

/** Go on with a minimisation.  cmd_minimize.c */
HS_MUST_USE hs_status hs_frame_run_minimize(hs_deck *deck, hs_frame *frame, bool is_within, hs_error *err);

/** Remember a command that was carried out, for making the simulation anew. */
HS_MUST_USE hs_status hs_deck_remember(hs_deck *deck, const hs_args *args, hs_error *err);
/** Write a checkpoint (collective); for hs_saving. */
HS_MUST_USE hs_status hs_deck_save(void *deck, const char *path, hs_error *err);
/** Make the simulation of a checkpoint anew and go on to the end of the deck that wrote it (collective). */
HS_MUST_USE hs_status hs_deck_resume(hs_deck *deck, const char *path, hs_error *err);
/** The command read_restart (collective). */
HS_MUST_USE hs_status hs_deck_read_restart(hs_deck *deck, const char *path, hs_error *err);

#endif
