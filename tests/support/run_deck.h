/** Run a deck given as text and get its log. */
#ifndef HS_TESTS_RUN_DECK_H
#define HS_TESTS_RUN_DECK_H

#include "deck/deck.h"

/** Carry out the lines of @p deck one by one in a new simulation; what goes to the log is returned (the caller frees it
 *  with free), up to the first error, which is in @p err. */
char *hs_test_run_deck(const char *deck, hs_error *err);
/** The same with options of the command line; @p at_end, unless NULL, sees the deck after its last line. */
char *hs_test_run_deck_with(const char *deck, const hs_options *options, void (*at_end)(hs_deck *deck, void *context),
                            void *context, hs_error *err);

/** Options of the command line: that many threads, a neighbor method, an instruction set. */
hs_options hs_test_options(int n_threads, const char *method, hs_isa isa);

/** A new simulation without any output, for commands one by one; the caller destroys it. */
hs_deck *hs_test_new_deck(void);
/** Carry out one line, which must succeed. */
void hs_test_command(hs_deck *deck, const char *line);

/** The file as a string, zero-terminated; the caller frees it with free; NULL when there is none. */
char *hs_test_read_file(const char *path);
void hs_test_write_file(const char *path, const char *text);

/** Cases of a file, each a line "== name" and lines after it; the first one's lines (@p start) are what all begin with.
 *  Calls @p run for each of the others, which may change the text, and returns how many there are. */
int hs_test_each_case(const char *path, void (*run)(const char *start, const char *name, char *text));

#endif
