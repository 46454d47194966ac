/** What commands and files that make or change a box share: which tilts it may have, and how it is told. */
#ifndef HS_STYLE_BOX_SHAPE_H
#define HS_STYLE_BOX_SHAPE_H

#include "base/message.h"
#include "core/box.h"

/** The tilts' names in the order of hs_box.tilt, ended by NULL. */
extern const char *const hs_tilt_names[];
/** A tilt moves the end of the edge along its second axis (y in xy) along its first. */
static inline int hs_tilt_first(int tilt) { return tilt == 2 ? 1 : 0; }
static inline int hs_tilt_second(int tilt) { return tilt == 0 ? 1 : 2; }

/** Write `<before>orthogonal box = (...) to (...)` or `<before>triclinic box = ... with tilt (...)` and a newline. */
void hs_box_say(hs_sink *out, const char *before, const hs_box *box);
/** Refuse tilts that the box cannot have (hs_box_check_tilt) and, unless the command `box tilt large` allowed it, those
 *  of more than half of the edge along the first axis, where that is periodic; with the command they are worth a
 *  warning. */
HS_MUST_USE hs_status hs_box_check_shape(const hs_box *box, bool may_be_skewed, hs_sink *out, const char *command,
                                         hs_error *err);
/** Refuse, naming @p command, that a tilt changes while atoms move: the box must be tilted, and periodic along the tilt's
 *  second axis. */
HS_MUST_USE hs_status hs_box_check_tilt_changes(const hs_box *box, int tilt, const char *command, hs_error *err);

#endif
