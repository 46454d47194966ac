#include "style/unit_vector.h"

#include <math.h>

bool hs_make_unit(double vector[3])
{
    const double largest = fmax(fabs(vector[0]), fmax(fabs(vector[1]), fabs(vector[2])));
    double length2 = 0.0;
    int exponent;
    if (!(largest > 0.0)) return false;
    frexp(largest, &exponent); /* squares are those of numbers near 1: neither too large nor lost */
    for (int axis = 0; axis < 3; ++axis) {
        vector[axis] = ldexp(vector[axis], -exponent);
        length2 += vector[axis] * vector[axis];
    }
    const double length = sqrt(length2);
    for (int axis = 0; axis < 3; ++axis) vector[axis] /= length;
    return true;
}

hs_status hs_arg_direction(const hs_args *args, int i, double direction[3], hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + axis, &direction[axis], err));
    if (hs_make_unit(direction)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the vector %s %s %s has no direction", args->command, args->word[i],
                   args->word[i + 1], args->word[i + 2]);
}
