/** printf formats that come from a deck: checked before they ever reach printf. */
#ifndef HS_IO_USER_FORMAT_H
#define HS_IO_USER_FORMAT_H

#include "base/error.h"

typedef enum {
    HS_FORMAT_INT,   /**< %d, %i: printed with a long long */
    HS_FORMAT_FLOAT, /**< %e, %f, %g, %a and their capitals: printed with a double */
    HS_FORMAT_STRING /**< %s: printed with a const char * */
} hs_format_kind;

/** Make a safe format of @p format in *out (owned by the caller: HS_FREE): exactly one conversion, of the kind asked
 *  for, width and precision at most 99, other text and %% kept; %d becomes %lld. An error names @p what
 *  ("thermo_modify format") and the reason. */
HS_MUST_USE hs_status hs_format_normalize(char **out, const char *format, hs_format_kind kind, const char *what,
                                          hs_error *err);

/** The first conversion of a format decides: 'd' for whole numbers, 'f' for floating point, 's' for text, 0 for
 *  none. */
char hs_format_class(const char *format);

#endif
