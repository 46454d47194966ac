/* Moves the cut planes between the ranks' bricks now and then, so that all ranks have equal work. */
#include <string.h>

#include "comm/balance.h"
#include "style/fix.h"

typedef struct balance_state {
    int64_t every;
    double threshold; /**< planes are moved when the load exceeds the mean by this factor */
    hs_balance plan;
    bool by_time;
    double pair_s; /**< time of pair forces when the load was last measured, seconds */
    double before, factor, largest;
    int n_iterations;
} balance_state;

static const hs_keyword keywords[] = {
    {"weight", 2, "time <factor>", "atoms cost what the pair forces of their rank have taken; 1: as measured"},
    {"out", 1, "<file>", "LAMMPS writes the bricks to a file; refused"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(hs_fix *fix, const hs_args *args, hs_error *err)
{
    balance_state *state = fix->state;
    double power;
    for (int i = 6; i < args->n; ++i) {
        static const char *const weights[] = {"time", NULL};
        if (strcmp(args->word[i], "out") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the keyword 'out' is not supported; dump custom with the attribute "
                           "proc shows who owns which atoms",
                           args->command);
        if (strcmp(args->word[++i], "time") != 0)
            return hs_arg_refuse(args, i, "a supported weight (time)", weights, err);
        HS_TRY(hs_arg_positive(args, ++i, &power, err));
        if (power != 1.0) return hs_arg_refuse(args, i, "1: time is taken as measured", NULL, err);
        state->by_time = true;
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"shift", NULL};
    balance_state *state = fix->state;
    int64_t n;
    int which;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    if (fix->group != 0) return hs_fail(err, HS_ERROR_INPUT, "%s: the group must be all", args->command);
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_double(args, 1, &state->threshold, err));
    if (state->threshold < 1.0) return hs_arg_refuse(args, 1, "a factor of 1 or more", NULL, err);
    if (strcmp(args->word[2], "rcb") == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the style 'rcb' needs parts that are not in rows; bricks are: use 'shift'", args->command);
    HS_TRY(hs_arg_choice(args, 2, styles, &which, err));
    HS_TRY(hs_balance_read_axes(&state->plan, args->word[3], fix->env->box->dimension, args->command, err));
    HS_TRY(hs_arg_int(args, 4, 1, 1000, &n, err));
    state->plan.n_iterations = (int)n;
    HS_TRY(hs_arg_double(args, 5, &state->plan.stop_factor, err));
    if (state->plan.stop_factor < 1.0) return hs_arg_refuse(args, 5, "a factor of 1 or more", NULL, err);
    state->factor = state->before = 1.0;
    return read_keywords(fix, args, err);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    balance_state *state = fix->state;
    (void)err;
    state->pair_s = fix->env->timer->phase_s[HS_PHASE_PAIR];
    return HS_OK;
}

static int64_t next_exchange(const hs_fix *fix)
{
    const balance_state *state = fix->state;
    return (fix->env->step + state->every - 1) / state->every * state->every;
}

/** What an atom of this rank costs. */
static double weigh(balance_state *state, const hs_env *env)
{
    const double now_s = env->timer->phase_s[HS_PHASE_PAIR];
    const double spent_s = now_s >= state->pair_s ? now_s - state->pair_s : now_s; /* timers begin anew with a run */
    double least_s = spent_s;
    state->pair_s = now_s;
    hs_parallel_max_double(env->parallel, &least_s, 1);
    if (!state->by_time || !(least_s > 0.0) || env->atoms->n_local == 0) return 1.0;
    return spent_s / env->atoms->n_local;
}

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    balance_state *state = fix->state;
    const hs_env *env = fix->env;
    if (env->step % state->every != 0 || env->step == env->first_step) return HS_OK;
    const double weight = weigh(state, env);
    double load = weight * env->atoms->n_local;
    hs_balance_measure(env->parallel, load, &state->largest, &state->before);
    state->factor = state->before;
    state->n_iterations = 0;
    if (state->before <= state->threshold || env->parallel->n_ranks <= 1) return HS_OK;
    state->plan.least_width = 0.5 * env->reach;
    HS_TRY(hs_balance_shift(&state->plan, env->domain, env->box, env->atoms, weight, env->parallel,
                            &state->n_iterations, err));
    HS_TRY(hs_balance_predict(env->domain, env->box, env->atoms, weight, env->parallel, &load, err));
    hs_balance_measure(env->parallel, load, &state->largest, &state->factor);
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((const balance_state *)fix->state)->factor;
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const balance_state *state = fix->state;
    (void)err;
    *value = i == 0 ? state->largest : i == 1 ? state->n_iterations : state->before;
    return HS_OK;
}

const hs_fix_style hs_fix_style_balance = {
    .about =
        {.name = "balance",
         .syntax = {.usage = "<N> <threshold> shift <axes> <iterations> <stop factor> [weight time 1]",
                    .n_min = 6,
                    .n_max = 6,
                    .keywords = keywords},
         .summary = "move the borders between the ranks' parts of the box, so that all have equal work",
         .details =
             "At every N-th step new lists are made, as in LAMMPS; if the largest load of a rank then exceeds the mean "
             "by "
             "more than the threshold (1.1: ten per cent), the planes that cut the box are moved along the axes named "
             "(`x`, `xy`, `zyx`, ...) until the slabs between them hold equal loads. The load of a rank is its number "
             "of "
             "atoms, or with `weight time 1` the time that its pair forces took. Each iteration finds the places 16 "
             "times "
             "more exactly; an axis is done when its slabs are within the stop factor. No brick becomes thinner than "
             "half "
             "the reach of the forces.\n\n"
             "`f_ID` is the imbalance after the last measurement (1 is perfect), `f_ID[1]` the largest load, `f_ID[2]` "
             "the "
             "iterations, `f_ID[3]` the imbalance before. Results do not depend on where the planes are. On one rank "
             "only "
             "the lists are made. LAMMPS's style `rcb` and its other weights are refused.",
         .example = "fix even all balance 1000 1.05 shift xyz 10 1.02\nfix even all balance 500 1.1 shift z 5 1.05 "
                    "weight time 1"},
    .state_size = sizeof(balance_state),
    .create = create,
    .init = init,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .scalar = scalar,
    .vector = vector,
    .n_vector = 3,
};
