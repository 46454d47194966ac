/** The functions of kernel/vector_math.h and vector_log.h over arrays, compiled for one instruction set and precision. */
#ifndef HS_TESTS_VECTOR_MATH_ISA_H
#define HS_TESTS_VECTOR_MATH_ISA_H

/** y[k] = f(x[k]) for k = 0 .. n - 1, in the precision of the set; n is a multiple of 16. */
typedef void vector_function(const double *x, double *y, int n);

typedef struct vector_math {
    vector_function *exp, *log, *sinpi, *cospi, *min_one, *max_one;
} vector_math;

#endif
