/** A deck being read: its files, variables, and the simulation it drives. */
#ifndef HS_DECK_DECK_H
#define HS_DECK_DECK_H

#include "base/message.h"
#include "base/text.h"
#include "deck/name_list.h"
#include "sim/sim.h"

struct hs_variables;
struct hs_source;
struct hs_unwritten;

typedef struct hs_deck {
    hs_sim *sim;                    /**< owned; made anew by `clear` */
    hs_sink *out;                   /**< borrowed */
    hs_options options;             /**< command-line settings, kept over `clear` */
    struct hs_variables *variables; /**< owned; kept over `clear` */
    struct hs_source *source;       /**< owned stack of files being read; deck/interpreter.c */
    bool echo_screen, echo_log;
    FILE *log_opened;       /**< log file opened by -log or the command `log`; owned; NULL: out->log is not ours */
    char *label_wanted;     /**< owned; skipping to this label (jump); NULL: not skipping */
    char *log_name;         /**< owned; name of the log file, for going on with it; NULL: none */
    hs_name_list folders;   /**< owned; those that it makes itself (shell mkdir): deck/outputs.h */
    char *printed;          /**< owned; on rank 0: files that print has written to (deck/printed.h), NULL: none */
    hs_text done;           /**< owned; the commands carried out, for checkpoints: deck/save.c */
    struct hs_frame *frame; /**< innermost `if` or `run every` that is being carried out; borrowed from its stack */
    /** hs_deck_resume calls this when all is as it was, before it goes on: for opening the log. NULL: nothing to do. */
    hs_status (*at_resumed)(struct hs_deck *deck, hs_error *err);
    bool jump_skipped;              /**< `next` has come to its end: the next jump does nothing */
    bool quit;                      /**< the command quit was met */
    struct hs_unwritten *unwritten; /**< owned; halfshell check: files of print; deck/unwritten.h */
    bool is_unwritten; /**< halfshell check: a run of the deck would have written data files or checkpoints by now */
    bool is_stopping;  /**< several ranks: one of them was asked to stop; agreed after every line */
    int exit_code;     /**< given with quit */
    bool is_running;   /**< within hs_sim_run: functions of time since the run's start have a value */
    int depth;         /**< commands within commands (if, run every) being carried out */
    hs_text input;     /**< owned; standard input, read once for both passes */
    bool input_is_read;
    hs_text pipe;    /**< owned; the same for a file that is a pipe */
    char *pipe_name; /**< owned; name of that file, NULL: none was read */
} hs_deck;

/** New deck interpreter with an empty simulation. @p out is borrowed. */
HS_MUST_USE hs_status hs_deck_create(hs_deck **deck, const hs_options *options, hs_sink *out, hs_error *err);
void hs_deck_destroy(hs_deck **deck);

/** Set an index variable from the command line (-var NAME VALUE...); wins over `variable NAME index`. */
HS_MUST_USE hs_status hs_deck_set_variable(hs_deck *deck, const char *name, int n, const char *const *values,
                                           hs_error *err);

/** First pass: read the whole deck, includes and both branches of `if` too, and refuse what can never be right. Runs
 *  nothing. "-" or NULL reads standard input (kept in memory for the second pass). */
HS_MUST_USE hs_status hs_deck_check(hs_deck *deck, const char *file, hs_error *err);
/** Second pass: run the deck. hs_deck_check must have passed. */
HS_MUST_USE hs_status hs_deck_run(hs_deck *deck, const char *file, hs_error *err);
/** Run one command line given as text (public API, `if`, `run every`): substitution, echo, the command. Collective. */
HS_MUST_USE hs_status hs_deck_command(hs_deck *deck, const char *line, hs_error *err);

#endif
