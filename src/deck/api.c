/* The public API, include/halfshell/halfshell.h: a deck interpreter behind an opaque handle. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "deck/api_internal.h"
#include "parallel/limits.h"
#include "sim/thermo.h"

const char *hs_version(void) { return HALFSHELL_VERSION; }

/** Set the calling thread's locale and threads aside. */
static void enter(hs_simulation *simulation)
{
    hs_api_caller *caller = &simulation->caller;
    caller->threads = hs_threads_save();
    caller->own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (caller->own != (locale_t)0) caller->before = uselocale(caller->own);
}

/** Put them back. */
static void leave(hs_simulation *simulation)
{
    hs_api_caller *caller = &simulation->caller;
    hs_threads_restore(caller->threads);
    if (caller->own == (locale_t)0) return;
    (void)uselocale(caller->before);
    freelocale(caller->own);
}

hs_status hs_api_begin(hs_simulation *simulation)
{
    if (simulation == NULL) return HS_ERROR_MEMORY; /* so it came from hs_simulation_create */
    enter(simulation);
    hs_error_clear(&simulation->error);
    simulation->message[0] = '\0';
    if (simulation->deck != NULL) return HS_OK;
    return hs_fail(&simulation->error, HS_ERROR_INPUT, "this simulation could not be created: destroy it");
}

hs_code hs_api_finish(hs_simulation *simulation, hs_status status)
{
    if (simulation == NULL) return (hs_code)hs_exit_code(status);
    leave(simulation);
    if (status == HS_OK) return HS_CODE_OK;
    const hs_error *error = &simulation->error;
    char line[32] = "";
    if (error->line > 0) snprintf(line, sizeof line, ":%ld", error->line);
    snprintf(simulation->message, sizeof simulation->message, "%s%s%s%s%s", error->file, line,
             error->file[0] != '\0' ? ": " : "", status == HS_INTERRUPTED ? "" : "error: ", error->text);
    return (hs_code)hs_exit_code(status);
}

static hs_status create(hs_simulation *simulation, const hs_simulation_options *given)
{
    hs_error *err = &simulation->error;
    hs_simulation_options settings = HS_SIMULATION_OPTIONS_INIT;
    if (given != NULL) {
        if (given->size == 0 || given->size > sizeof settings)
            return hs_fail(err, HS_ERROR_INPUT,
                           "hs_simulation_options: size is %zu, this library knows up to %zu; set it with "
                           "HS_SIMULATION_OPTIONS_INIT",
                           given->size, sizeof settings);
        memcpy(&settings, given, given->size);
    }
    hs_options options = {.n_threads = settings.n_threads};
    if (settings.n_threads < 0 || settings.n_threads > HS_THREADS_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "hs_simulation_options: n_threads is %d; it must be from 0 to %d",
                       settings.n_threads, HS_THREADS_MAX);
    const char *method = settings.neighbor_method != NULL ? settings.neighbor_method : "";
    const char *isa = settings.instruction_set != NULL ? settings.instruction_set : "";
    if (strlen(method) >= sizeof options.neighbor_method || strlen(isa) >= sizeof options.isa)
        return hs_fail(err, HS_ERROR_INPUT, "hs_simulation_options: unknown neighbor method or instruction set");
    strcpy(options.neighbor_method, method);
    strcpy(options.isa, isa);
    simulation->out = (hs_sink){.screen = settings.screen, .log = settings.log};
    HS_TRY(hs_deck_create(&simulation->deck, &options, &simulation->out, err));
    simulation->deck->echo_screen = false;
    simulation->deck->echo_log = true;
    return HS_OK;
}

hs_code hs_simulation_create(hs_simulation **simulation, const hs_simulation_options *options)
{
    hs_error err = {0};
    *simulation = NULL;
    if (HS_ALLOC(*simulation, 1, &err) != HS_OK) return (hs_code)hs_exit_code(err.status);
    enter(*simulation);
    return hs_api_finish(*simulation, create(*simulation, options));
}

void hs_simulation_destroy(hs_simulation **simulation)
{
    if (simulation == NULL || *simulation == NULL) return;
    enter(*simulation); /* what is still to be written has numbers in it */
    hs_deck_destroy(&(*simulation)->deck);
    leave(*simulation);
    HS_FREE(*simulation);
}

const char *hs_simulation_error(const hs_simulation *simulation)
{
    return simulation != NULL ? simulation->message : "out of memory";
}

hs_code hs_simulation_set_variable(hs_simulation *simulation, const char *name, int n, const char *const *values)
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = hs_deck_set_variable(simulation->deck, name, n, values, &simulation->error);
    return hs_api_finish(simulation, status);
}

/** Before anything that may run threads or steps: both belong to this simulation now. */
static void take_over(hs_simulation *simulation)
{
    simulation->stop_requested = 0;
    simulation->deck->sim->stop_requested = &simulation->stop_requested;
    hs_threads_set(simulation->deck->options.n_threads);
}

hs_code hs_simulation_get_variable(hs_simulation *simulation, const char *name, double *value)
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) {
        take_over(simulation);
        hs_env *env = &simulation->deck->sim->env;
        status = env->variable_value(env->deck, name, value, &simulation->error);
    }
    return hs_api_finish(simulation, status);
}

static hs_status run_deck(hs_simulation *simulation, const char *path)
{
    hs_error *err = &simulation->error;
    take_over(simulation);
    HS_TRY(hs_deck_check(simulation->deck, path, err));
    return hs_deck_run(simulation->deck, path, err);
}

hs_code hs_simulation_deck_file(hs_simulation *simulation, const char *path)
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = run_deck(simulation, path);
    return hs_api_finish(simulation, status);
}

/** The interpreter keeps standard input in memory for its two passes: the text takes that place. */
static hs_status run_text(hs_simulation *simulation, const char *text)
{
    hs_deck *deck = simulation->deck;
    hs_text_clear(&deck->input);
    hs_status status = hs_text_append(&deck->input, text, strlen(text), &simulation->error);
    deck->input_is_read = true;
    if (status == HS_OK) status = run_deck(simulation, "-");
    hs_text_clear(&deck->input);
    deck->input_is_read = false;
    return status;
}

hs_code hs_simulation_deck_text(hs_simulation *simulation, const char *text)
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = run_text(simulation, text);
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_command(hs_simulation *simulation, const char *line)
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) {
        take_over(simulation);
        status = hs_deck_command(simulation->deck, line, &simulation->error);
    }
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_run(hs_simulation *simulation, int64_t n_steps)
{
    char line[48];
    snprintf(line, sizeof line, "run %lld", (long long)n_steps);
    return hs_simulation_command(simulation, line);
}

void hs_simulation_stop(hs_simulation *simulation)
{
    if (simulation != NULL) simulation->stop_requested = 1;
}

int64_t hs_simulation_step(const hs_simulation *simulation)
{
    return simulation != NULL && simulation->deck != NULL ? simulation->deck->sim->env.step : 0;
}

int64_t hs_simulation_n_atoms(const hs_simulation *simulation)
{
    return simulation != NULL && simulation->deck != NULL ? simulation->deck->sim->atoms.n_all : 0;
}

int hs_simulation_n_types(const hs_simulation *simulation)
{
    return simulation != NULL && simulation->deck != NULL ? simulation->deck->sim->atoms.n_types : 0;
}

hs_status hs_api_need_forces(hs_simulation *simulation)
{
    hs_sim *sim = simulation->deck->sim;
    take_over(simulation);
    if (sim->is_initialized && sim->env.energy_step == sim->env.step) return HS_OK;
    return hs_sim_setup(sim, &simulation->error);
}

hs_code hs_simulation_thermo(hs_simulation *simulation, const char *keyword, double *value)
{
    hs_status status = hs_api_begin(simulation);
    bool found = false;
    if (status == HS_OK) status = hs_api_need_forces(simulation);
    if (status == HS_OK)
        status = hs_thermo_keyword(simulation->deck->sim->thermo, keyword, value, &found, &simulation->error);
    if (status == HS_OK && !found) {
        const char *nearest = hs_thermo_nearest(keyword);
        status = hs_fail(&simulation->error, HS_ERROR_INPUT, "'%s' is not a thermo keyword%s%s%s", keyword,
                         nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                         nearest != NULL ? "'?" : "");
    }
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_box(hs_simulation *simulation, double lo[3], double hi[3], int periodic[3])
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = hs_sim_need_box(simulation->deck->sim, "hs_simulation_box", &simulation->error);
    for (int axis = 0; status == HS_OK && axis < 3; ++axis) {
        const hs_box *box = &simulation->deck->sim->box;
        if (lo != NULL) lo[axis] = box->lo[axis];
        if (hi != NULL) hi[axis] = box->hi[axis];
        if (periodic != NULL) periodic[axis] = box->periodic[axis];
    }
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_tilt(hs_simulation *simulation, double tilt[3])
{
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = hs_sim_need_box(simulation->deck->sim, "hs_simulation_tilt", &simulation->error);
    if (status == HS_OK) memcpy(tilt, simulation->deck->sim->box.tilt, 3 * sizeof *tilt);
    return hs_api_finish(simulation, status);
}
