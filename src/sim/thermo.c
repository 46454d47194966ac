/* Thermodynamic output: settings, and the rows of the table. */
#include "sim/thermo.h"

#include "base/memory.h"
#include "base/text.h"
#include "sim/thermo_internal.h"
#include "style/varying.h"

/** thermo_modify's settings as they are after thermo_style. */
static void reset_modify(hs_thermo *thermo)
{
    thermo->is_modified = false;
    thermo->lost = HS_LOST_ERROR;
    thermo->lost_warned = false;
    thermo->norm = -1;
    thermo->flush = false;
    thermo->has_means = false;
    thermo->is_multi_line = thermo->style == HS_THERMO_STYLE_MULTI;
    HS_FREE(thermo->format_line);
    HS_FREE(thermo->format_int);
    HS_FREE(thermo->format_float);
    HS_FREE(thermo->temp_id);
    HS_FREE(thermo->press_id);
}

hs_status hs_thermo_create(hs_thermo **thermo, hs_sim *sim, hs_error *err)
{
    HS_TRY(HS_ALLOC(*thermo, 1, err));
    (*thermo)->sim = sim;
    reset_modify(*thermo);
    return hs_thermo_set_standard_columns(*thermo, err);
}

void hs_thermo_destroy(hs_thermo **thermo)
{
    if (*thermo == NULL) return;
    reset_modify(*thermo);
    hs_thermo_clear_columns(*thermo);
    hs_thermo_means_fini(*thermo);
    HS_FREE((*thermo)->column);
    HS_FREE((*thermo)->every_variable);
    HS_FREE((*thermo)->neighbor_info);
    HS_FREE(*thermo);
}

void hs_thermo_set_every(hs_thermo *thermo, int64_t every)
{
    thermo->every = every;
    HS_FREE(thermo->every_variable);
}

hs_status hs_thermo_set_every_variable(hs_thermo *thermo, const char *name, hs_error *err)
{
    hs_thermo_set_every(thermo, 0);
    return hs_memory_strdup(&thermo->every_variable, name, err);
}

hs_thermo_lost_mode hs_thermo_lost(const hs_thermo *thermo) { return thermo->lost; }

hs_status hs_thermo_set_style(hs_thermo *thermo, const char *style, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"one", "multi", "custom", NULL};
    const hs_args word = {.command = "thermo_style", .n = 1, .word = &style};
    int which;
    HS_TRY(hs_arg_choice(&word, 0, styles, &which, err));
    if (which != HS_THERMO_STYLE_CUSTOM && args->n > 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "thermo_style %s: unexpected word '%s'; only custom takes a list of keywords", style,
                       args->word[0]);
    if (which == HS_THERMO_STYLE_CUSTOM && args->n == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "thermo_style custom: at least one keyword must follow, for example: thermo_style custom step "
                       "temp pe press");
    if (thermo->is_modified)
        hs_warn(thermo->sim->env.out, "thermo_style sets everything back that thermo_modify has set before");
    thermo->style = which;
    reset_modify(thermo);
    if (which == HS_THERMO_STYLE_CUSTOM) return hs_thermo_set_columns(thermo, args, err);
    hs_thermo_clear_columns(thermo);
    return hs_thermo_set_standard_columns(thermo, err);
}

hs_status hs_thermo_find_computes(hs_thermo *thermo, hs_error *err)
{
    const char *temp_id = thermo->temp_id != NULL ? thermo->temp_id : "thermo_temp";
    const char *press_id = thermo->press_id != NULL ? thermo->press_id : "thermo_press";
    hs_env *env = &thermo->sim->env;
    HS_TRY(hs_compute_get(env, temp_id, HS_TEMPERATURE, "thermo output", &thermo->temp, err));
    HS_TRY(hs_compute_get(env, press_id, HS_PRESSURE, "thermo output", &thermo->press, err));
    thermo->pe = hs_sim_find_compute(thermo->sim, "thermo_pe"); /* which cannot be removed */
    thermo->is_norm = thermo->norm >= 0 ? thermo->norm != 0 : thermo->sim->env.units->energy_per_atom != 0;
    thermo->n_atoms = thermo->sim->atoms.n_all;
    return HS_OK;
}

/** Ask the variable of `thermo v_name` for the step of the next row. */
static hs_status find_next_due(hs_thermo *thermo, hs_error *err)
{
    const hs_env *env = &thermo->sim->env;
    if (thermo->every_variable == NULL) return HS_OK;
    HS_TRY(hs_next_step(env, thermo->every_variable, "thermo", "row", &thermo->next_due, err));
    /* As in LAMMPS, the last step has a row if another step between it and the first one has. */
    if (env->step != env->first_step && thermo->next_due > env->last_step) thermo->next_due = env->last_step;
    return HS_OK;
}

hs_status hs_thermo_init(hs_thermo *thermo, hs_error *err)
{
    if (thermo->style != HS_THERMO_STYLE_CUSTOM) HS_TRY(hs_thermo_set_standard_columns(thermo, err));
    HS_TRY(hs_thermo_find_computes(thermo, err));
    HS_TRY(hs_thermo_resolve_columns(thermo, err));
    HS_TRY(hs_thermo_make_formats(thermo, err));
    thermo->last_tpcpu_s = thermo->last_spcpu_s = 0.0;
    thermo->next_due = -1;
    return hs_thermo_means_begin(thermo, err);
}

hs_status hs_thermo_keep(hs_thermo *thermo, hs_state *state, hs_error *err)
{
    static const char name[] = "next row";
    HS_TRY(hs_thermo_means_keep(thermo, state, err));
    if (thermo->every_variable == NULL || (state->is_reading && hs_state_find(state, name) == NULL)) return HS_OK;
    return hs_state_int64(state, name, &thermo->next_due, 1, err);
}

void hs_thermo_want_row(hs_thermo *thermo) { thermo->next_due = thermo->sim->env.step; }

bool hs_thermo_is_due(const hs_thermo *thermo, int64_t step)
{
    const hs_env *env = &thermo->sim->env;
    if (step == env->first_step) return true;
    /* A variable decides about the last step too: see find_next_due. */
    if (thermo->every_variable != NULL) return step == thermo->next_due;
    if (step == env->last_step && !env->is_cut_short) return true;
    return thermo->every > 0 && step % thermo->every == 0;
}

void hs_thermo_header(hs_thermo *thermo)
{
    if (thermo->is_multi_line) return;
    for (int k = 0; k < thermo->n_columns; ++k) hs_say(thermo->sim->env.out, "%s ", thermo->column[k].header);
    hs_say(thermo->sim->env.out, "\n");
}

/** Count the atoms of all ranks and compare with how many there should be (thermo_modify lost). */
static hs_status check_lost(hs_thermo *thermo, hs_error *err)
{
    hs_sim *sim = thermo->sim;
    const int64_t n_expected = sim->atoms.n_all;
    int64_t n = sim->atoms.n_local;
    hs_parallel_sum_int64(&sim->parallel, &n, 1);
    thermo->n_atoms = n;
    if (n == n_expected) return HS_OK;
    if (thermo->lost == HS_LOST_ERROR)
        return hs_fail(err, HS_ERROR_ATOMS,
                       "Lost atoms: original %lld current %lld, at step %lld. They left the box through a face that is "
                       "not periodic, or moved too far in one step: use a shorter timestep, periodic or shrink-wrapped "
                       "boundaries, or walls; 'thermo_modify lost ignore' goes on without them",
                       (long long)n_expected, (long long)n, (long long)sim->env.step);
    sim->atoms.n_all = n;
    if (thermo->lost == HS_LOST_IGNORE || thermo->lost_warned) return HS_OK;
    hs_warn(sim->env.out, "Lost atoms: original %lld current %lld", (long long)n_expected, (long long)n);
    thermo->lost_warned = true;
    return HS_OK;
}

static hs_status append_value(hs_thermo *thermo, int k, hs_text *line, hs_error *err)
{
    const hs_thermo_column *column = &thermo->column[k];
    double value;
    HS_TRY(hs_thermo_column_value(thermo, column, &value, err));
    hs_thermo_means_note(thermo, k, value);
    if (thermo->is_multi_line) {
        HS_TRY(hs_text_printf(line, err, "%s%-8s = ", k % 3 == 0 ? "\n" : "", column->header));
    }
    if (hs_thermo_is_int(column))
        HS_TRY(hs_text_printf(line, err, column->format, (long long)value));
    else
        HS_TRY(hs_text_printf(line, err, column->format, value));
    return hs_text_append(line, " ", 1, err);
}

static hs_status make_row(hs_thermo *thermo, hs_text *line, hs_error *err)
{
    if (thermo->is_multi_line) {
        const hs_env *env = &thermo->sim->env;
        const double cpu_s = env->step == env->first_step ? 0.0 : hs_time_now_s() - thermo->sim->timer.start_s;
        HS_TRY(hs_text_printf(line, err, "---------------- Step %8lld ----- CPU = %11.4f (sec) ----------------",
                              (long long)env->step, cpu_s));
    }
    for (int k = 0; k < thermo->n_columns; ++k) HS_TRY(append_value(thermo, k, line, err));
    return HS_OK;
}

/** A full disk is told at the row that meets it, not when the run is over. Collective. */
static hs_status check_written(const hs_thermo *thermo, hs_error *err)
{
    const hs_sink *out = thermo->sim->env.out;
    const char *what = out->log != NULL && ferror(out->log)         ? "log file"
                       : out->screen != NULL && ferror(out->screen) ? "screen output"
                                                                    : NULL;
    if (what != NULL)
        (void)hs_fail(err, HS_ERROR_IO,
                      "the %s could not be written in full: is the disk full, or the program gone that reads it?",
                      what);
    return hs_parallel_agree(&thermo->sim->parallel, err);
}

hs_status hs_thermo_row(hs_thermo *thermo, hs_error *err)
{
    hs_text line = {0};
    hs_sink *out = thermo->sim->env.out;
    HS_TRY(check_lost(thermo, err));
    if (thermo->sim->env.step == thermo->sim->env.first_step) {
        thermo->last_spcpu_step = thermo->sim->env.step;
        bool found;
        HS_TRY(hs_thermo_keyword(thermo, "time", &thermo->last_tpcpu_time, &found, err));
    }
    hs_status status = make_row(thermo, &line, err);
    if (status == HS_OK) hs_say(out, "%s\n", hs_text_get(&line));
    hs_text_fini(&line);
    HS_TRY(status);
    HS_TRY(hs_thermo_means_row(thermo, err));
    if (thermo->flush && out->log != NULL) fflush(out->log);
    if (thermo->flush && out->screen != NULL) fflush(out->screen);
    HS_TRY(check_written(thermo, err));
    return find_next_due(thermo, err);
}
