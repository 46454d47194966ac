/** gnuplot, found on the PATH when it is needed. */
#ifndef HS_IO_GNUPLOT_H
#define HS_IO_GNUPLOT_H

#include "base/text.h"

/** Let gnuplot carry out a script; what it writes to its standard output is added to @p output. No shell is involved,
 *  and the user's own start-up file is not read. Not collective. */
HS_MUST_USE hs_status hs_gnuplot_run(const hs_text *script, hs_text *output, hs_error *err);

#endif
