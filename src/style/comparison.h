/** Comparisons of two numbers that a deck asks for by name. */
#ifndef HS_STYLE_COMPARISON_H
#define HS_STYLE_COMPARISON_H

#include "style/args.h"

/** < > <= >= == != |^; the last one holds when one of them is 0 and the other is not. */
typedef enum { HS_LESS, HS_GREATER, HS_NOT_GREATER, HS_NOT_LESS, HS_EQUAL, HS_UNEQUAL, HS_EITHER } hs_comparison;

/** Word i, one of those. */
HS_MUST_USE hs_status hs_arg_comparison(const hs_args *args, int i, hs_comparison *how, hs_error *err);
bool hs_compares(double a, hs_comparison how, double b);

#endif
