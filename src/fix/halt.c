/* Ends a run when a condition holds. */
#include <string.h>

#include "base/memory.h"
#include "base/timer.h"
#include "style/comparison.h"
#include "style/varying.h"

typedef enum { HARD, SOFT, CONTINUE } what_then;

typedef struct halt_state {
    int64_t every;
    char *variable; /**< owned; NULL: the wall time of the run, s */
    hs_comparison how;
    double limit;
    what_then then;
    bool is_silent;
    double since_s; /**< when the run began */
} halt_state;

static const hs_keyword keywords[] = {
    {"error", 1, "hard|soft|continue",
     "end with an error, end this run and skip all others (default), or end this run only"},
    {"message", 1, "yes|no", "tell when and why the run ended (default yes)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const choices[] = {"hard", "soft", "continue", NULL};
    halt_state *state = fix->state;
    int choice;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    if (strncmp(args->word[1], "v_", 2) == 0)
        HS_TRY(hs_memory_strdup(&state->variable, args->word[1] + 2, err));
    else if (strcmp(args->word[1], "tlimit") != 0)
        return hs_arg_refuse(args, 1,
                             strcmp(args->word[1], "bondmax") == 0 ? "v_<name> or tlimit: there are no bonds"
                                                                   : "v_<name> or tlimit",
                             NULL, err);
    HS_TRY(hs_arg_comparison(args, 2, &state->how, err));
    HS_TRY(hs_arg_double(args, 3, &state->limit, err));
    state->then = SOFT;
    for (int i = 4; i < args->n; i += 2) {
        if (strcmp(args->word[i], "error") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, choices, &choice, err));
            state->then = (what_then)choice;
        } else {
            bool is_told;
            HS_TRY(hs_arg_bool(args, i + 1, &is_told, err));
            state->is_silent = !is_told;
        }
    }
    return HS_OK;
}

static void destroy(hs_fix *fix) { HS_FREE(((halt_state *)fix->state)->variable); }

static hs_status init(hs_fix *fix, hs_error *err)
{
    halt_state *state = fix->state;
    state->since_s = hs_time_now_s();
    return state->variable != NULL ? hs_fix_need_equal_style(fix, state->variable, err) : HS_OK;
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const halt_state *state = fix->state;
    return state->variable != NULL && step % state->every == 0;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    halt_state *state = fix->state;
    hs_env *env = fix->env;
    double value;
    if (env->step % state->every != 0) return HS_OK;
    if (state->variable != NULL) {
        HS_TRY(env->variable_value(env->deck, state->variable, &value, err));
    } else {
        value = hs_time_now_s() - state->since_s;
        hs_parallel_broadcast(env->parallel, 0, &value, sizeof value); /* clocks differ */
    }
    if (!hs_compares(value, state->how, state->limit)) return HS_OK;
    if (state->then == HARD)
        return hs_fail(err, HS_ERROR_RUN, "%s: the condition was met at step %lld, with the value %.15g",
                       hs_fix_who(fix).text, (long long)env->step, value);
    if (!state->is_silent) {
        hs_progress_wipe(env->out);
        hs_say(env->out, "Fix halt condition for fix-id %s met on step %lld with value %.15g\n", fix->id,
               (long long)env->step, value);
    }
    env->is_cut_short = env->step < env->last_step;
    env->last_step = env->step;
    env->is_halted = state->then == SOFT;
    return HS_OK;
}

const hs_fix_style hs_fix_style_halt = {
    .about =
        {.name = "halt",
         .syntax = {.usage = "<N> v_<name>|tlimit <operator> <value> [keyword value ...]",
                    .n_min = 4,
                    .n_max = 4,
                    .keywords = keywords},
         .summary = "end a run when a condition holds",
         .details = "At steps that are multiples of N, the equal-style variable, or the seconds since the run began "
                    "(`tlimit`), is compared with the value; the operator is one of `<`, `>`, `<=`, `>=`, `==`, `!=`, "
                    "`|^` (one of them is 0, the other is not). When that holds, the run, or the minimisation, ends "
                    "after the step, and the deck goes on after it.\n\n"
                    "With `error soft`, the default, further runs and minimisations of the deck are skipped, while all "
                    "other commands are carried out, such as write_data. With `error continue` they are not: `unfix` "
                    "the fix, or they may end at once, too. `error hard` ends all with an error. `message no` leaves "
                    "out the line that tells of it. There is no row of thermo output at the last step unless one is "
                    "due. The group has no meaning.",
         .example =
             "variable T equal temp\nfix stop all halt 100 v_T < 0.5\nfix hour all halt 10 tlimit > 3600 message no"},
    .state_size = sizeof(halt_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .end_of_iteration = end_of_step,
    .needs_energy = needs_energy,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
