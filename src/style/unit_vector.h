/** Directions, which decks give as vectors of any length. */
#ifndef HS_STYLE_UNIT_VECTOR_H
#define HS_STYLE_UNIT_VECTOR_H

#include <stdbool.h>

#include "style/args.h"

/** Make a vector of finite numbers, of any length, one of length 1. False, and the vector as it was, when its length is 0. */
HS_MUST_USE bool hs_make_unit(double vector[3]);
/** Words i to i + 2: a vector of which only the direction counts; that of length 0 is refused. */
HS_MUST_USE hs_status hs_arg_direction(const hs_args *args, int i, double direction[3], hs_error *err);

#endif
