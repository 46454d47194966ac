/** Messages to people: the screen and the log file of a run. */
#ifndef HS_BASE_MESSAGE_H
#define HS_BASE_MESSAGE_H

#include <stdio.h>

#include "base/error.h"

/** Where a run writes for people. Streams are borrowed: who opened them closes them. NULL means "not there"
 *  (-screen none, log none, ranks other than 0). */
typedef struct hs_sink {
    FILE *screen;
    FILE *log;
    bool no_progress;    /**< show no progress line, even if the screen seems to be a terminal */
    bool progress_shown; /**< a progress line stands on the terminal and must be wiped before other text */
    long n_warnings;
    long warning_limit; /**< print no more than so many (thermo_modify warn); 0: no limit, < 0: print none */
} hs_sink;

/** Write to screen and log, no newline added. */
void hs_say(hs_sink *sink, const char *fmt, ...) HS_PRINTF(2, 3);
/** Write to one of them only. */
void hs_say_screen(hs_sink *sink, const char *fmt, ...) HS_PRINTF(2, 3);
void hs_say_log(hs_sink *sink, const char *fmt, ...) HS_PRINTF(2, 3);
/** `WARNING: text` and a newline on both. */
void hs_warn(hs_sink *sink, const char *fmt, ...) HS_PRINTF(2, 3);
/** Replace the progress line on the terminal (nothing happens when the screen is not a terminal). */
void hs_progress(hs_sink *sink, const char *fmt, ...) HS_PRINTF(2, 3);
/** Wipe the progress line, if one is shown. */
void hs_progress_wipe(hs_sink *sink);

#endif
