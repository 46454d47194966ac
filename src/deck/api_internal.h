/** What the files of the public API share. */
#ifndef HS_DECK_API_INTERNAL_H
#define HS_DECK_API_INTERNAL_H

#include <halfshell/halfshell.h>
#include <locale.h>

#include "deck/deck.h"

enum { HS_API_MESSAGE_SIZE = HS_ERROR_TEXT_SIZE + HS_ERROR_FILE_SIZE + 64 };

/** What a call changes for its thread and must put back. */
typedef struct hs_api_caller {
    locale_t own;    /**< the C locale, in which numbers have a point: owned; 0: there was no memory */
    locale_t before; /**< the caller's; borrowed */
    hs_threads threads;
} hs_api_caller;

struct hs_simulation {
    hs_deck *deck; /**< owned; NULL when the simulation could not be made */
    hs_sink out;
    hs_error error;                    /**< of the present or last call */
    char message[HS_API_MESSAGE_SIZE]; /**< the same as one line */
    volatile sig_atomic_t stop_requested;
    hs_api_caller caller; /**< during a call */
};

/** Begin a call: forget the last error. Calls on a simulation that could not be made fail at once. */
HS_MUST_USE hs_status hs_api_begin(hs_simulation *simulation);
/** End a call: put the message together. */
hs_code hs_api_finish(hs_simulation *simulation, hs_status status);
/** Forces, energy and virial of the present positions, unless the last run left them (collective). */
HS_MUST_USE hs_status hs_api_need_forces(hs_simulation *simulation);

#endif
