/* Moves the cut planes between the ranks' bricks now and then, so that all ranks have equal work. */

#include "comm/balance.h"
#include "base/memory.h"
#include "style/balance_weight.h"
#include "style/fix.h"

typedef struct balance_state {
    int64_t every;
    double threshold; /**< planes are moved when the load exceeds the mean by this factor */
    hs_balance plan;
    hs_balance_weight weight;
    double pair_s; /**< time of pair forces when the load was last measured, seconds */
    double before, factor, largest;
    int n_iterations;
} balance_state;

static const hs_keyword keywords[] = {
    {"weight", -1, "group <n> <group-ID> <factor> ... | var <name> | time <factor> | neigh <factor> | store <name>",
     "what atoms cost; may be repeated"},
    {"out", 1, "<file>", "LAMMPS writes the bricks to a file; refused"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(hs_fix *fix, const hs_args *args, int first, hs_error *err)
{
    static const char *const names[] = {"weight", "out", NULL};
    balance_state *state = fix->state;
    for (int i = first; i < args->n; ++i) {
        int which;
        HS_TRY(hs_arg_choice(args, i, names, &which, err));
        if (which == 1)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the keyword 'out' is not supported; dump custom with the attribute proc shows who owns "
                           "which atoms",
                           args->command);
        ++i;
        HS_TRY(hs_balance_weight_read(&state->weight, args, &i, err));
    }
    return HS_OK;
}

/** Words of `shift` from word 3 on. */
static hs_status read_shift(hs_fix *fix, const hs_args *args, hs_error *err)
{
    balance_state *state = fix->state;
    int64_t n;
    HS_TRY(hs_arg_need(args, 5, "shift: the axes, the iterations and the stop factor", err));
    HS_TRY(hs_balance_read_axes(&state->plan, args->word[3], fix->env->box->dimension, args->command, err));
    HS_TRY(hs_arg_int(args, 4, 1, 1000, &n, err));
    state->plan.n_iterations = (int)n;
    HS_TRY(hs_arg_double(args, 5, &state->plan.stop_factor, err));
    if (state->plan.stop_factor < 1.0) return hs_arg_refuse(args, 5, "a factor of 1 or more", NULL, err);
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"shift", "rcb", NULL};
    balance_state *state = fix->state;
    int which;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_positive(args, 1, &state->threshold, err));
    HS_TRY(hs_arg_choice(args, 2, styles, &which, err));
    if (which == 0) HS_TRY(read_shift(fix, args, err));
    if (which == 1) hs_balance_take_rcb(&state->plan, fix->env->box->dimension);
    if (which == 1)
        hs_say(fix->env->out, "%s: bricks stay in rows; for 'rcb' their planes are moved along all axes\n",
               args->command);
    state->factor = state->before = 1.0;
    return read_keywords(fix, args, which == 0 ? 6 : 3, err);
}

static void destroy(hs_fix *fix) { hs_balance_weight_fini(&((balance_state *)fix->state)->weight); }

static hs_status init(hs_fix *fix, hs_error *err)
{
    balance_state *state = fix->state;
    state->pair_s = fix->env->timer->phase_s[HS_PHASE_PAIR];
    return hs_balance_weight_check(&state->weight, fix->env, "fix balance", err);
}

static int64_t next_exchange(const hs_fix *fix)
{
    const balance_state *state = fix->state;
    return (fix->env->step + state->every - 1) / state->every * state->every;
}

/** Time of this rank's pair forces since the load was measured last. */
static double spent_time(balance_state *state, const hs_env *env)
{
    const double now_s = env->timer->phase_s[HS_PHASE_PAIR];
    const double spent_s = now_s >= state->pair_s ? now_s - state->pair_s : now_s; /* timers begin anew with a run */
    state->pair_s = now_s;
    return spent_s;
}

/** Move the planes, atoms having these costs. */
static hs_status shift(hs_fix *fix, const double *costs, hs_error *err)
{
    balance_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_balance_work work = {env->parallel, env->box, env->atoms, costs};
    double load;
    state->plan.least_width = 0.5 * env->reach;
    HS_TRY(hs_balance_shift(&state->plan, env->domain, &work, &state->n_iterations, err));
    HS_TRY(hs_balance_predict(env->domain, &work, &load, err));
    hs_balance_measure(env->parallel, load, &state->largest, &state->factor);
    return HS_OK;
}

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    balance_state *state = fix->state;
    const hs_env *env = fix->env;
    double *costs = NULL;
    if (env->step % state->every != 0 || env->step == env->first_step) return HS_OK;
    HS_TRY(hs_balance_weight_eval(&state->weight, env, spent_time(state, env), "fix balance", &costs, err));
    hs_balance_measure(env->parallel, hs_balance_weight_load(env, costs), &state->largest, &state->before);
    state->factor = state->before;
    state->n_iterations = 0;
    hs_status status = HS_OK;
    if (state->before > state->threshold && env->parallel->n_ranks > 1) status = shift(fix, costs, err);
    HS_FREE(costs);
    return status;
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
    .about = {.name = "balance",
              .syntax = {.usage = "<N> <threshold> shift <axes> <iterations> <stop factor> | rcb " HS_BALANCE_WEIGHTS,
                         .n_min = 3,
                         .n_max = 6,
                         .keywords = keywords},
              .summary = "move the borders between the ranks' parts of the box, so that all have equal work",
              .details =
                  "At every N-th step new lists are made, as in LAMMPS; if the largest load of a rank then exceeds the "
                  "mean by more than the threshold (1.1: ten per cent), the planes that cut the box are moved along "
                  "the axes named (`x`, `xy`, `zyx`, ...) until the slabs between them hold equal loads. The load of a "
                  "rank is the sum of its atoms' costs. Each iteration finds the places 16 times more exactly; an axis "
                  "is done when its slabs are within the stop factor. No brick becomes thinner than half the reach of "
                  "the forces. `rcb`, which in LAMMPS cuts the box into parts that are not in rows, moves the planes "
                  "along all axes here.\n\n" HS_BALANCE_WEIGHT_DETAILS "\n\n"
                  "`f_ID` is the imbalance after the last measurement (1 is perfect), `f_ID[1]` the largest load, "
                  "`f_ID[2]` the iterations, `f_ID[3]` the imbalance before. Results do not depend on where the planes "
                  "are. On one rank only the lists are made. The group has no meaning.",
              .example = "fix even all balance 1000 1.05 shift xyz 10 1.02\nfix even all balance 500 1.1 shift z 5 "
                         "1.05 weight time 1"},
    .state_size = sizeof(balance_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .scalar = scalar,
    .vector = vector,
    .n_vector = 3,
    .changes_box = true, /* it does not, but in LAMMPS, too, the default thermo output has the volume with it */
    .keeps_plane = true,
};
