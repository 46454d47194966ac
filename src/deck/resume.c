/* Going on from a checkpoint; save.c says what is in it. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/interpreter.h"
#include "deck/printed.h"
#include "deck/saved.h"
#include "deck/source.h"
#include "io/checkpoint.h"
#include "io/part_file.h"
#include "sim/saving.h"

/* ---- Variables ---- */

static hs_status get_variable(hs_checkpoint *checkpoint, hs_deck *deck, const char *name, hs_error *err)
{
    hs_state state;
    hs_variable *variable;
    char *values = NULL, *formula = NULL;
    hs_args words = {0};
    int n_values = 0;
    HS_TRY(hs_saved_get(checkpoint, "variables", name, &state, err));
    hs_status status = hs_variables_restore(deck->variables, name, &variable, err);
    if (status == HS_OK) status = hs_saved_keep_variable(variable, &state, err);
    if (status == HS_OK) status = hs_state_text(&state, "values", &values, err);
    if (status == HS_OK) status = hs_state_text(&state, "formula", &formula, err);
    if (status == HS_OK) status = hs_state_int(&state, "value count", &n_values, err);
    if (status == HS_OK && values != NULL) status = hs_saved_cut_words(values, &words, err);
    if (status == HS_OK && (words.n != n_values && n_values > 0))
        status = hs_fail(err, HS_ERROR_INPUT, "the variable '%s' has %d values; there should be %d", name, words.n,
                         n_values);
    if (status == HS_OK) status = hs_variables_refill(variable, n_values, words.word, formula, err);
    hs_memory_free((void *)(uintptr_t)words.word);
    HS_FREE(values);
    HS_FREE(formula);
    hs_state_fini(&state);
    return status;
}

static hs_status get_variables(hs_checkpoint *checkpoint, hs_deck *deck, hs_error *err)
{
    hs_state state;
    char *names = NULL, *rest = NULL;
    HS_TRY(hs_checkpoint_get(checkpoint, "variables", &state, err));
    hs_status status = hs_saved_keep_generators(deck->variables, &state, err);
    if (status == HS_OK) status = hs_state_text(&state, "names", &names, err);
    for (char *name = names != NULL ? strtok_r(names, " ", &rest) : NULL; name != NULL && status == HS_OK;
         name = strtok_r(NULL, " ", &rest))
        status = get_variable(checkpoint, deck, name, err);
    HS_FREE(names);
    hs_state_fini(&state);
    return status;
}

/* ---- The simulation ---- */

static hs_status get_dumps(hs_checkpoint *checkpoint, hs_sim *sim, hs_error *err)
{
    for (int k = 0; k < sim->n_dumps; ++k) {
        hs_state state;
        HS_TRY(hs_saved_get(checkpoint, "dump", sim->dump[k]->id, &state, err));
        const hs_status status = hs_saved_keep_dump(sim->dump[k], &state, err);
        hs_state_fini(&state);
        HS_TRY(status);
        sim->dump[k]->is_resumed = sim->dump[k]->append = true;
    }
    return HS_OK;
}

static hs_status get_styles(hs_checkpoint *checkpoint, hs_sim *sim, hs_error *err)
{
    for (int k = 0; k < sim->n_fixes + sim->n_computes; ++k) {
        hs_fix *fix = k < sim->n_fixes ? sim->fix[k] : NULL;
        hs_compute *compute = fix == NULL ? sim->compute[k - sim->n_fixes] : NULL;
        if (fix == NULL && compute->style->keep_state == NULL) continue;
        hs_state state;
        HS_TRY(hs_saved_get(checkpoint, fix != NULL ? "fix" : "compute", fix != NULL ? fix->id : compute->id, &state,
                            err));
        const hs_status status =
            fix != NULL ? hs_saved_keep_fix(fix, &state, err) : compute->style->keep_state(compute, &state, err);
        hs_state_fini(&state);
        HS_TRY(status);
    }
    return HS_OK;
}

static hs_status get_simulation(hs_checkpoint *checkpoint, hs_deck *deck, char *commands, hs_error *err)
{
    HS_TRY(hs_text_append(&deck->done, commands, strlen(commands), err));
    HS_TRY(hs_saved_repeat(checkpoint, deck, commands, false, err));
    hs_sim *sim = deck->sim;
    HS_TRY(hs_variables_join_atoms(deck->variables, &sim->atoms, err));
    HS_TRY(hs_saved_get_atoms(checkpoint, sim, true, err));
    HS_TRY(hs_saved_get_run(checkpoint, sim, true, err));
    HS_TRY(get_dumps(checkpoint, sim, err));
    const bool is_set_up = sim->is_initialized;
    if (is_set_up) {
        sim->env.is_resuming = true; /* files are there */
        const hs_status status = hs_sim_init_resumed(sim, err);
        sim->env.is_resuming = false;
        HS_TRY(status);
    }
    HS_TRY(get_styles(checkpoint, sim, err));
    if (is_set_up) HS_TRY(hs_sim_setup_resumed(sim, err));
    return hs_saved_get_run(checkpoint, sim, true, err); /* what set-up has changed */
}

/* ---- The place in the deck ---- */

typedef struct places {
    hs_checkpoint *checkpoint;
    int n;
} places;

static hs_status enter(hs_deck *deck, places *where, int k, hs_error *err);

static hs_status enter_file(hs_deck *deck, places *where, int k, hs_state *state, hs_error *err)
{
    char *name = NULL, *text = NULL;
    int64_t numbers[3];
    hs_status status = hs_state_text(state, "name", &name, err);
    if (status == HS_OK) status = hs_state_text(state, "text", &text, err);
    if (status == HS_OK) status = hs_state_int64(state, "cursor", numbers, 3, err);
    if (status == HS_OK)
        status = hs_source_push_text(deck, name != NULL ? name : "", text != NULL ? text : "", (size_t)numbers[0],
                                     (long)numbers[1], (long)numbers[2], err);
    HS_FREE(name);
    HS_FREE(text);
    HS_TRY(status);
    status = enter(deck, where, k + 1, err);
    if (status != HS_OK) hs_error_locate(err, deck->source->name, deck->source->line);
    if (status == HS_OK) status = hs_source_run(deck, err);
    hs_source_pop(deck);
    return status;
}

static hs_status enter_frame(hs_deck *deck, places *where, int k, int kind, hs_state *state, hs_error *err)
{
    hs_frame frame = {0};
    char *text = NULL;
    hs_status status = hs_saved_keep_frame(&frame, state, err);
    frame.kind = kind == HS_FRAME_RUN || kind == HS_FRAME_MINIMIZE ? kind : HS_FRAME_LIST;
    if (status == HS_OK) status = hs_state_text(state, "words", &text, err);
    if (status == HS_OK && text == NULL) status = hs_fail(err, HS_ERROR_INPUT, "a command has no words");
    if (status == HS_OK) status = hs_saved_cut_words(text, &frame.words, err);
    frame.words.command = kind == HS_FRAME_RUN ? "run" : kind == HS_FRAME_MINIMIZE ? "minimize" : "if";
    if (status == HS_OK) {
        hs_frame_push(deck, &frame);
        const bool is_innermost = k + 1 == where->n;
        if (!is_innermost) status = enter(deck, where, k + 1, err);
        hs_frame_pop(deck);
        if (status == HS_OK && kind == HS_FRAME_LIST) status = hs_frame_run_list(deck, &frame, err);
        if (status == HS_OK && kind == HS_FRAME_RUN)
            status = hs_frame_run_run(deck, &frame, is_innermost && !frame.is_in_commands, err);
        if (status == HS_OK && kind == HS_FRAME_MINIMIZE)
            status = hs_frame_run_minimize(deck, &frame, is_innermost, err);
    }
    hs_memory_free((void *)(uintptr_t)frame.words.word);
    HS_FREE(text);
    return status;
}

/** Enter place k and all within it, and carry it out to its end. */
static hs_status enter(hs_deck *deck, places *where, int k, hs_error *err)
{
    char section[64];
    hs_state state;
    int kind = 0;
    if (k >= where->n) {
        hs_checkpoint_destroy(&where->checkpoint); /* the run may replace the file */
        return HS_OK;
    }
    snprintf(section, sizeof section, "place/%d", k);
    HS_TRY(hs_checkpoint_get(where->checkpoint, section, &state, err));
    hs_status status = hs_state_int(&state, "kind", &kind, err);
    if (status == HS_OK && k + 1 == where->n) hs_checkpoint_destroy(&where->checkpoint);
    if (status == HS_OK)
        status = kind == HS_SAVED_FILE ? enter_file(deck, where, k, &state, err)
                                       : enter_frame(deck, where, k, kind, &state, err);
    hs_state_fini(&state);
    return status;
}

static hs_status get_settings(hs_checkpoint *checkpoint, hs_deck *deck, char **commands, int *n_places, hs_error *err)
{
    hs_state state;
    char *method = NULL, *precision = NULL;
    HS_TRY(hs_checkpoint_get(checkpoint, "deck", &state, err));
    hs_status status = hs_state_int(&state, "places", n_places, err);
    if (status == HS_OK) status = hs_state_text(&state, "commands", commands, err);
    if (status == HS_OK) status = hs_state_text(&state, "neighbor method", &method, err);
    if (status == HS_OK) status = hs_state_text(&state, "precision", &precision, err);
    if (status == HS_OK && deck->log_name == NULL) status = hs_state_text(&state, "log", &deck->log_name, err);
    if (status == HS_OK && hs_state_find(&state, "printed files") != NULL) /* older checkpoints have none */
        status = hs_state_text(&state, "printed files", &deck->printed, err);
    if (status == HS_OK) status = hs_state_bool(&state, "jump is skipped", &deck->jump_skipped, err);
    hs_options *options = &deck->options; /* the present command line wins */
    if (method != NULL && options->neighbor_method[0] == '\0')
        snprintf(options->neighbor_method, sizeof options->neighbor_method, "%s", method);
    if (precision != NULL && options->precision[0] == '\0')
        snprintf(options->precision, sizeof options->precision, "%s", precision);
    HS_FREE(method);
    HS_FREE(precision);
    hs_state_fini(&state);
    if (status == HS_OK && *commands == NULL) status = hs_memory_strdup(commands, "", err);
    return status;
}

static hs_status get_kept_files(hs_checkpoint *checkpoint, hs_deck *deck, const char *path, hs_error *err)
{
    hs_state state;
    HS_TRY(hs_checkpoint_get(checkpoint, "deck", &state, err));
    const hs_status status = hs_saving_get_kept(deck->sim->saving, path, &state, err);
    hs_state_fini(&state);
    return status;
}

hs_status hs_deck_resume(hs_deck *deck, const char *path, hs_error *err)
{
    places where = {0};
    char *commands = NULL;
    HS_TRY(hs_checkpoint_open(&where.checkpoint, path, &deck->sim->parallel, err));
    if (deck->sim->parallel.rank == 0) hs_part_file_sweep(path); /* of the run that was killed */
    hs_status status = get_settings(where.checkpoint, deck, &commands, &where.n, err);
    if (status == HS_OK && deck->printed != NULL && deck->sim->parallel.rank == 0)
        (void)(hs_printed_cut(deck->printed, err) == HS_OK);
    if (status == HS_OK) status = hs_parallel_agree(&deck->sim->parallel, err);
    if (status == HS_OK) status = hs_deck_clear(deck, err); /* with the settings */
    if (status == HS_OK) status = get_variables(where.checkpoint, deck, err);
    if (status == HS_OK) status = get_simulation(where.checkpoint, deck, commands, err);
    if (status == HS_OK) status = get_kept_files(where.checkpoint, deck, path, err);
    if (status == HS_OK && deck->at_resumed != NULL) status = deck->at_resumed(deck, err);
    if (status == HS_OK)
        hs_say(deck->out, "Resumed at step %lld from %s, with %lld atoms\n", (long long)deck->sim->env.step, path,
               (long long)deck->sim->atoms.n_all);
    if (status == HS_OK) status = enter(deck, &where, 0, err);
    HS_FREE(commands);
    hs_checkpoint_destroy(&where.checkpoint);
    hs_error_locate(err, path, 0);
    hs_deck_make_printable(err->text);
    return status;
}
