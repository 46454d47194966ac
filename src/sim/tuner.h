/** Method `auto`: the methods that keep lists are tried in the run itself, and the fastest kept.
 *
 *  A trial lasts from one scheduled list build to the next, so that it includes one build; the first of a method is not
 *  counted, since memory is allocated then. All methods find the same pairs, and in reproducible runs sum them to the
 *  same bits, so the choice, which depends on the clock, changes no result beyond rounding. */
#ifndef HS_SIM_TUNER_H
#define HS_SIM_TUNER_H

#include "base/text.h"
#include "neighbor/neighbor.h"

struct hs_sim;

enum { HS_TUNER_CANDIDATES = 2 };

typedef struct hs_tuner {
    hs_neighbor_method method; /**< in use while the deck's method is `auto` */
    bool is_trying;
    int candidate, trial;               /**< under way */
    double best_s[HS_TUNER_CANDIDATES]; /**< seconds a step; 0: not tried */
    double begin_s;                     /**< of pair, neighbor and communication phases, when the trial began */
    int64_t begin_step;
    double n_atoms; /**< on all ranks, for the report */
} hs_tuner;

/** Start of a run with set-up: trials are made if the run is long enough to pay them back; else the method is chosen by
 *  the expected length of lists. */
void hs_tuner_start(struct hs_sim *sim);
/** A scheduled build is about to be made (collective): judge the trial that ends here, and choose the method of the
 *  next. */
void hs_tuner_at_build(struct hs_sim *sim);
/** One line of what was chosen and why; nothing before trials have ended. */
HS_MUST_USE hs_status hs_tuner_describe(const struct hs_sim *sim, hs_text *text, hs_error *err);

#endif
