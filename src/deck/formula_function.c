/** Math functions of formulas. */
#include <math.h>

#include "deck/formula_nodes.h"
#include "deck/variables.h"

static const double pi = 3.14159265358979323846;
/** "No further step", as LAMMPS has it. */
static const double never = 0x1p63;

hs_status hs_formula_whole(const char *what, double value, int64_t *whole, hs_error *err)
{
    if (!(fabs(value) <= 0x1p53))
        return hs_fail(err, HS_ERROR_INPUT, "%s: %g is too large for a whole number", what, value);
    *whole = (int64_t)value;
    return HS_OK;
}

/** Refuse the function's argument; `usage` tells what would be right. */
static hs_status refuse(const hs_call *call, const char *why, double value, hs_error *err)
{
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s (got %.15g)", call->function->usage, why, value);
}

#define PLAIN(name, expression)                                                                                        \
    static hs_status do_##name(const hs_call *call, double *value, hs_error *err)                                      \
    {                                                                                                                  \
        (void)err;                                                                                                     \
        const double x = call->arg[0];                                                                                 \
        *value = (expression);                                                                                         \
        return HS_OK;                                                                                                  \
    }
#define GUARDED(name, condition, why, expression)                                                                      \
    static hs_status do_##name(const hs_call *call, double *value, hs_error *err)                                      \
    {                                                                                                                  \
        const double x = call->arg[0];                                                                                 \
        if (!(condition)) return refuse(call, why, x, err);                                                            \
        *value = (expression);                                                                                         \
        return HS_OK;                                                                                                  \
    }

PLAIN(exp, exp(x))
PLAIN(abs, fabs(x))
PLAIN(sin, sin(x))
PLAIN(cos, cos(x))
PLAIN(tan, tan(x))
PLAIN(atan, atan(x))
PLAIN(atan2, atan2(x, call->arg[1]))
PLAIN(ceil, ceil(x))
PLAIN(floor, floor(x))
/* Halves go up, also below 0, as in LAMMPS. */
PLAIN(round, x - floor(x) >= 0.5 ? ceil(x) : floor(x))
GUARDED(sqrt, x >= 0.0, "the square root of a negative number does not exist", sqrt(x))
GUARDED(ln, x > 0.0, "the logarithm exists for positive numbers only", log(x))
GUARDED(log, x > 0.0, "the logarithm exists for positive numbers only", log10(x))
GUARDED(asin, x >= -1.0 && x <= 1.0, "the argument must be from -1 to 1", asin(x))
GUARDED(acos, x >= -1.0 && x <= 1.0, "the argument must be from -1 to 1", acos(x))

/** Equal-style: the generator, seeded at its first use only. Per atom: the number drawn for the atom, or during runs,
 *  when the order of atoms is nobody's, the hash of seed, atom and draw. */
static hs_status draw(const hs_call *call, double *number, hs_error *err)
{
    const bool is_normal = call->function->draws == HS_DRAWS_NORMAL;
    int seed;
    HS_TRY(hs_random_seed(call->function, call->arg[2], &seed, err));
    if (call->drawn != NULL) {
        *number = *call->drawn;
        return HS_OK;
    }
    if (call->atom != 0) {
        const uint64_t stream = is_normal ? 1 : 0;
        const double u = hs_hashed_uniform((uint64_t)seed, (uint64_t)call->atom, (uint64_t)call->draw, stream);
        const double w = hs_hashed_uniform((uint64_t)seed, (uint64_t)call->atom, (uint64_t)call->draw, 2);
        *number = is_normal ? sqrt(-2.0 * log(u)) * cos(2.0 * pi * w) : u;
        return HS_OK;
    }
    hs_marsaglia *generator = &call->deck->variables->generator;
    if (!generator->is_seeded) hs_marsaglia_init(generator, seed);
    *number = is_normal ? hs_marsaglia_gaussian(generator) : hs_marsaglia_uniform(generator);
    return HS_OK;
}

static hs_status do_random(const hs_call *call, double *value, hs_error *err)
{
    double u;
    HS_TRY(draw(call, &u, err));
    *value = u * (call->arg[1] - call->arg[0]) + call->arg[0];
    return HS_OK;
}

static hs_status do_normal(const hs_call *call, double *value, hs_error *err)
{
    if (call->arg[1] < 0.0) return refuse(call, "the width must not be negative", call->arg[1], err);
    double g;
    HS_TRY(draw(call, &g, err));
    *value = call->arg[0] + call->arg[1] * g;
    return HS_OK;
}

static hs_status need_run(const hs_call *call, hs_error *err)
{
    if (call->deck->is_running) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: has a value only during a run, since it depends on the run's first step",
                   call->function->usage);
}

static hs_status do_ramp(const hs_call *call, double *value, hs_error *err)
{
    HS_TRY(need_run(call, err));
    const hs_env *env = &call->deck->sim->env;
    double delta = (double)(env->step - env->ramp_start);
    if (delta != 0.0) delta /= (double)(env->ramp_stop - env->ramp_start);
    *value = call->arg[0] + delta * (call->arg[1] - call->arg[0]);
    return HS_OK;
}

/** Time since the run's first step, or that of its series (run start). */
static double elapsed(const hs_call *call)
{
    const hs_env *env = &call->deck->sim->env;
    return (double)(env->step - env->ramp_start) * env->dt;
}

static hs_status do_vdisplace(const hs_call *call, double *value, hs_error *err)
{
    HS_TRY(need_run(call, err));
    *value = call->arg[0] + call->arg[1] * elapsed(call);
    return HS_OK;
}

static hs_status do_wiggle(const hs_call *call, double *value, hs_error *err)
{
    HS_TRY(need_run(call, err));
    if (call->arg[2] == 0.0) return refuse(call, "the period must not be 0", call->arg[2], err);
    const double phase = 2.0 * pi / call->arg[2] * elapsed(call);
    const bool is_sine = call->function->name[0] == 's';
    *value = call->arg[0] + call->arg[1] * (is_sine ? sin(phase) : 1.0 - cos(phase));
    return HS_OK;
}

/** The arguments as whole numbers; each must be at least @p min. */
static hs_status take_whole(const hs_call *call, int64_t min, int64_t *n, hs_error *err)
{
    for (int i = 0; i < call->function->n_args; ++i) {
        HS_TRY(hs_formula_whole(call->function->usage, call->arg[i], &n[i], err));
        if (n[i] < min)
            return refuse(call,
                          min > 0 ? "the arguments must be whole numbers of 1 or more"
                                  : "the arguments must be whole numbers of 0 or more",
                          call->arg[i], err);
    }
    return HS_OK;
}

static hs_status do_stagger(const hs_call *call, double *value, hs_error *err)
{
    int64_t n[2];
    HS_TRY(take_whole(call, 1, n, err));
    if (n[0] <= n[1]) return refuse(call, "x must be greater than y", call->arg[0], err);
    const int64_t step = call->deck->sim->env.step, lower = step / n[0] * n[0];
    *value = (double)(step - lower < n[1] ? lower + n[1] : lower + n[0]);
    return HS_OK;
}

static hs_status do_logfreq(const hs_call *call, double *value, hs_error *err)
{
    int64_t n[3];
    HS_TRY(take_whole(call, 1, n, err));
    if (n[1] >= n[2]) return refuse(call, "y must be less than z", call->arg[1], err);
    const int64_t step = call->deck->sim->env.step;
    *value = (double)n[0];
    if (step < n[0]) return HS_OK;
    double lower = (double)n[0];
    while ((double)step >= lower * (double)n[2]) lower *= (double)n[2];
    const double multiple = floor((double)step / lower);
    *value = multiple < (double)n[1] ? (multiple + 1.0) * lower : lower * (double)n[2];
    return HS_OK;
}

static hs_status do_logfreq2(const hs_call *call, double *value, hs_error *err)
{
    int64_t n[3];
    HS_TRY(take_whole(call, 1, n, err));
    if (n[2] < 2) return refuse(call, "z must be 2 or more", call->arg[2], err);
    if (n[1] > 1000000) return refuse(call, "y must be at most 1000000", call->arg[1], err);
    const double step = (double)call->deck->sim->env.step;
    double next = (double)n[0], delta = (double)n[0] * ((double)n[2] - 1.0) / (double)n[1];
    for (int64_t count = 1; step >= next; ++count) {
        next += delta;
        if (count % n[1] == 0) delta *= (double)n[2];
    }
    *value = ceil(next);
    return HS_OK;
}

static hs_status do_logfreq3(const hs_call *call, double *value, hs_error *err)
{
    int64_t n[3];
    HS_TRY(take_whole(call, 1, n, err));
    if (n[1] < 2 || n[2] - n[0] + 1 < n[1] || n[1] > 100000000)
        return refuse(call, "y must be from 2 to z-x+1 (and at most 100000000)", call->arg[1], err);
    const int64_t step = call->deck->sim->env.step;
    *value = (double)n[0];
    if (step < n[0]) return HS_OK;
    if (step >= n[2]) {
        *value = never;
        return HS_OK;
    }
    /* y steps in equal ratio; while the ratio gives less than one step, every step counts */
    const double ratio = pow((double)n[2] / (double)n[0], 1.0 / ((double)n[1] - 1.0));
    double logarithmic = (double)n[0], linear = (double)n[0];
    while ((double)step >= *value) {
        logarithmic *= ratio;
        linear += 1.0;
        *value = ceil(logarithmic) > linear ? ceil(logarithmic) : linear;
    }
    if (*value > (double)n[2]) *value = (double)n[2];
    return HS_OK;
}

static hs_status do_stride(const hs_call *call, double *value, hs_error *err)
{
    int64_t n[3];
    HS_TRY(take_whole(call, 0, n, err));
    if (n[2] < 1 || n[0] > n[1]) return refuse(call, "x must be at most y, and z at least 1", call->arg[2], err);
    const int64_t step = call->deck->sim->env.step;
    const int64_t next = step < n[0] ? n[0] : step - (step - n[0]) % n[2] + n[2];
    *value = next <= n[1] ? (double)next : never;
    return HS_OK;
}

static hs_status do_stride2(const hs_call *call, double *value, hs_error *err)
{
    int64_t n[6];
    HS_TRY(take_whole(call, 0, n, err));
    if (n[2] < 1 || n[5] < 1 || n[0] > n[1] || n[3] > n[4] || n[3] < n[0] || n[4] > n[1])
        return refuse(call, "x <= a <= b <= y must hold, and z and c be at least 1", call->arg[3], err);
    const int64_t step = call->deck->sim->env.step;
    int64_t next;
    if (step < n[0]) {
        *value = (double)n[0];
        return HS_OK;
    }
    if (step >= n[1]) {
        *value = never;
        return HS_OK;
    }
    if (step < n[3] || step > n[4]) {
        next = step - (step - n[0]) % n[2] + n[2];
        if (step < n[3] && next > n[3]) next = n[3];
    } else {
        next = step - (step - n[3]) % n[5] + n[5];
        if (next > n[4]) next = n[4] - (n[4] - n[0]) % n[2] + n[2];
        if (next > n[1]) {
            *value = never;
            return HS_OK;
        }
    }
    *value = (double)next;
    return HS_OK;
}

const hs_function hs_math_functions[] = {
    {"sqrt", 1, do_sqrt, HS_DRAWS_NOTHING, "sqrt(x)", "square root"},
    {"exp", 1, do_exp, HS_DRAWS_NOTHING, "exp(x)", "e to the power x"},
    {"ln", 1, do_ln, HS_DRAWS_NOTHING, "ln(x)", "natural logarithm"},
    {"log", 1, do_log, HS_DRAWS_NOTHING, "log(x)", "logarithm to base 10"},
    {"abs", 1, do_abs, HS_DRAWS_NOTHING, "abs(x)", "absolute value"},
    {"sin", 1, do_sin, HS_DRAWS_NOTHING, "sin(x)", "sine, x in radians"},
    {"cos", 1, do_cos, HS_DRAWS_NOTHING, "cos(x)", "cosine"},
    {"tan", 1, do_tan, HS_DRAWS_NOTHING, "tan(x)", "tangent"},
    {"asin", 1, do_asin, HS_DRAWS_NOTHING, "asin(x)", "arc sine, radians"},
    {"acos", 1, do_acos, HS_DRAWS_NOTHING, "acos(x)", "arc cosine"},
    {"atan", 1, do_atan, HS_DRAWS_NOTHING, "atan(x)", "arc tangent"},
    {"atan2", 2, do_atan2, HS_DRAWS_NOTHING, "atan2(y,x)", "arc tangent of y/x in the right quadrant"},
    {"random", 3, do_random, HS_DRAWS_UNIFORM, "random(lo,hi,seed)",
     "uniform random number from lo to hi; the first call's seed starts the generator, of which there is one for "
     "equal-style and one for atom-style variables. Between runs atoms draw in the order of their IDs; during a run an "
     "atom's numbers follow from seed, ID and count of draws, so that they do not depend on ranks"},
    {"normal", 3, do_normal, HS_DRAWS_NORMAL, "normal(mean,width,seed)", "normal random number"},
    {"ceil", 1, do_ceil, HS_DRAWS_NOTHING, "ceil(x)", "next whole number above"},
    {"floor", 1, do_floor, HS_DRAWS_NOTHING, "floor(x)", "next whole number below"},
    {"round", 1, do_round, HS_DRAWS_NOTHING, "round(x)", "nearest whole number"},
    {"ramp", 2, do_ramp, HS_DRAWS_NOTHING, "ramp(x,y)", "from x at the run's first step to y at its last"},
    {"stagger", 2, do_stagger, HS_DRAWS_NOTHING, "stagger(x,y)", "next step of x, x+y, 2x, 2x+y, ..."},
    {"logfreq", 3, do_logfreq, HS_DRAWS_NOTHING, "logfreq(x,y,z)", "next step of x, 2x, ... yx, then the same from zx"},
    {"logfreq2", 3, do_logfreq2, HS_DRAWS_NOTHING, "logfreq2(x,y,z)",
     "next of y steps at equal distance in each factor z, from x"},
    {"logfreq3", 3, do_logfreq3, HS_DRAWS_NOTHING, "logfreq3(x,y,z)", "next of y steps in equal ratio from x to z"},
    {"stride", 3, do_stride, HS_DRAWS_NOTHING, "stride(x,y,z)", "next step of x, x+z, x+2z, ... up to y"},
    {"stride2", 6, do_stride2, HS_DRAWS_NOTHING, "stride2(x,y,z,a,b,c)",
     "like stride(x,y,z), but every c steps from a to b"},
    {"vdisplace", 2, do_vdisplace, HS_DRAWS_NOTHING, "vdisplace(x,v)",
     "x + v t, with t the time since the run's first step"},
    {"swiggle", 3, do_wiggle, HS_DRAWS_NOTHING, "swiggle(x,A,P)", "x + A sin(2 PI t/P)"},
    {"cwiggle", 3, do_wiggle, HS_DRAWS_NOTHING, "cwiggle(x,A,P)", "x + A (1 - cos(2 PI t/P))"},
    {0},
};
