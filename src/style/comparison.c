#include "style/comparison.h"

hs_status hs_arg_comparison(const hs_args *args, int i, hs_comparison *how, hs_error *err)
{
    static const char *const names[] = {"<", ">", "<=", ">=", "==", "!=", "|^", NULL};
    int choice;
    HS_TRY(hs_arg_choice(args, i, names, &choice, err));
    *how = (hs_comparison)choice;
    return HS_OK;
}

bool hs_compares(double a, hs_comparison how, double b)
{
    switch (how) {
    case HS_LESS:
        return a < b;
    case HS_GREATER:
        return a > b;
    case HS_NOT_GREATER:
        return a <= b;
    case HS_NOT_LESS:
        return a >= b;
    case HS_EQUAL:
        return a == b;
    case HS_UNEQUAL:
        return a != b;
    default:
        return (a != 0.0) != (b != 0.0);
    }
}
