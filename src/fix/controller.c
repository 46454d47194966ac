/* A PID controller: a variable is moved so that a measured value comes to a wanted one. With tau the time between
 * updates and e the measured value minus the wanted one,
 *     c_n = c_(n-1) - alpha (Kp tau e_n + Ki tau^2 sum_(i <= n) e_i + Kd (e_n - e_(n-1)))
 * Source: K. J. Astrom, R. M. Murray, Feedback Systems (2008), ISBN 978-0-691-13576-2, chapter 10. */
#include "base/memory.h"
#include "style/value.h"

enum { PROPORTIONAL, INTEGRAL, DERIVATIVE, N_TERMS };

typedef struct controller_state {
    int64_t every;
    double alpha, gain[N_TERMS];
    hs_value measured;
    double wanted;
    char *variable;       /**< owned; internal-style variable that is moved */
    double error, sum;    /**< e of the latest update, and the sum of all */
    double term[N_TERMS]; /**< of the latest update */
    bool has_error;       /**< there was an update */
} controller_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    controller_state *state = fix->state;
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_double(args, 1, &state->alpha, err));
    for (int k = 0; k < N_TERMS; ++k) HS_TRY(hs_arg_double(args, 2 + k, &state->gain[k], err));
    HS_TRY(hs_value_init(&state->measured, fix->env, args, 5, HS_VALUE_NUMBER, err));
    HS_TRY(hs_arg_double(args, 6, &state->wanted, err));
    return hs_memory_strdup(&state->variable, args->word[7], err);
}

static void destroy(hs_fix *fix)
{
    controller_state *state = fix->state;
    hs_value_fini(&state->measured);
    HS_FREE(state->variable);
}

/** Move the variable by an amount; an error when it is not one that can be moved. */
static hs_status move(const hs_fix *fix, double change, hs_error *err)
{
    const hs_env *env = fix->env;
    const char *name = ((const controller_state *)fix->state)->variable;
    double value;
    if (hs_env_variable_kind(env, name) != HS_NUMBER_VARIABLE)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no variable '%s'; 'variable %s internal <number>' makes one",
                       hs_fix_who(fix).text, name, name);
    HS_TRY(env->variable_value(env->deck, name, &value, err));
    return env->set_variable(env->deck, name, value + change, err);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const controller_state *state = fix->state;
    HS_TRY(hs_value_check(fix->env, &state->measured, HS_VALUE_NUMBER, hs_fix_who(fix).text, err));
    return move(fix, 0.0, err);
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const controller_state *state = fix->state;
    return step % state->every == 0 && hs_value_needs_energy(fix->env, &state->measured);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    controller_state *state = fix->state;
    const double tau = (double)state->every * fix->env->dt;
    double value;
    if (fix->env->step % state->every != 0) return HS_OK;
    HS_TRY(hs_value_number(fix->env, &state->measured, &value, err));
    const double error = value - state->wanted, rise = state->has_error ? error - state->error : 0.0;
    state->error = error;
    state->sum += error;
    state->has_error = true;
    state->term[PROPORTIONAL] = -state->alpha * state->gain[PROPORTIONAL] * tau * error;
    state->term[INTEGRAL] = -state->alpha * state->gain[INTEGRAL] * tau * tau * state->sum;
    state->term[DERIVATIVE] = -state->alpha * state->gain[DERIVATIVE] * rise;
    HS_TRY(move(fix, state->term[PROPORTIONAL] + state->term[INTEGRAL] + state->term[DERIVATIVE], err));
    hs_env_changed(fix->env); /* values that were computed from the variable are void */
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((const controller_state *)fix->state)->term[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    controller_state *state = fix->state;
    HS_TRY(hs_state_double(kept, "error", &state->error, 1, err));
    HS_TRY(hs_state_double(kept, "sum of errors", &state->sum, 1, err));
    HS_TRY(hs_state_double(kept, "terms", state->term, N_TERMS, err));
    return hs_state_bool(kept, "has error", &state->has_error, err);
}

const hs_fix_style hs_fix_style_controller = {
    .about = {.name = "controller",
              .syntax = {.usage = "<N> <alpha> <Kp> <Ki> <Kd> <value> <wanted> <variable>", .n_min = 8, .n_max = 8},
              .summary = "move a variable so that a measured value comes to a wanted one (a PID controller)",
              .details =
                  "The value is a number: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]` or `v_name`. At steps that are "
                  "multiples of N, with e its difference from the wanted number and tau = N dt, the internal-style "
                  "variable (its name alone, without `v_`) is changed by -alpha [Kp tau e + Ki tau^2 (sum of e of all "
                  "updates) + Kd (change of e since the last update)]. The fix does not say what the variable does: "
                  "something else must use it, such as `fix langevin v_T ...` or `fix indent`. The gains have no "
                  "units, alpha has those of the variable over those of the value and of time.\n\n"
                  "`f_ID[1]` to `f_ID[3]` are the three terms of the latest update. The group has no meaning.",
              .reference = "K. J. Astrom, R. M. Murray, Feedback Systems (2008), ISBN 978-0-691-13576-2, chapter 10",
              .example = "variable T internal 1.0\nfix 1 all langevin v_T 1.0 0.5 4711\n"
                         "fix 2 all controller 100 1.0 0.5 0 0 c_thermo_temp 1.5 T"},
    .state_size = sizeof(controller_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .vector = vector,
    .n_vector = N_TERMS,
    .is_vector_extensive = true,
    .needs_energy = needs_energy,
    .keep_state = keep_state,
};
