/* Writing a checkpoint: the deck's part of it. What is stored, and why this way: the commands that made the simulation,
 * with their variables replaced, as they were carried out; the values of variables; and the place in the deck.
 * Repeating the commands makes all styles anew without each of them having to describe itself, while decisions (if,
 * jump, loops) are not taken again: they may have depended on what happened in between. What the commands did to atoms,
 * and what the steps did, comes from the stored values, which replace whatever the repeated commands have made. */
#include <stdio.h>
#include <string.h>

#include "deck/frames.h"
#include "deck/saved.h"
#include "deck/source.h"
#include "deck/variables.h"
#include "io/checkpoint.h"
#include "sim/restored.h"
#include "sim/saving.h"

void hs_frame_push(hs_deck *deck, hs_frame *frame)
{
    frame->source_depth = deck->source != NULL ? deck->source->depth : 0;
    frame->below = deck->frame;
    deck->frame = frame;
}

void hs_frame_pop(hs_deck *deck) { deck->frame = deck->frame->below; }

/** Append a command (NULL: none) and its words, with separators between. */
static hs_status join_words(hs_text *text, const char *command, const hs_args *args, hs_error *err)
{
    if (command != NULL) HS_TRY(hs_text_append(text, command, strlen(command), err));
    for (int i = 0; i < args->n; ++i) {
        const char mark = HS_SAVED_WORD;
        if (i > 0 || command != NULL) HS_TRY(hs_text_append(text, &mark, 1, err));
        HS_TRY(hs_text_append(text, args->word[i], strlen(args->word[i]), err));
    }
    return HS_OK;
}

/** The words of `region`, with the places that EDGE stood for: when they are repeated, the box may be another one. */
static hs_status join_region(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const hs_region *region = hs_sim_find_region(deck->sim, args->word[0]);
    int n_edges = 0;
    HS_TRY(hs_text_printf(&deck->done, err, "%s", args->command));
    for (int i = 0; i < args->n; ++i) {
        const bool is_edge =
            i > 1 && region != NULL && strncmp(args->word[i], "EDGE", 4) == 0 && n_edges < region->n_edges;
        if (is_edge)
            HS_TRY(hs_text_printf(&deck->done, err, "%cEDGE=%.17g", HS_SAVED_WORD, region->edge[n_edges++]));
        else
            HS_TRY(hs_text_printf(&deck->done, err, "%c%s", HS_SAVED_WORD, args->word[i]));
    }
    return HS_OK;
}

hs_status hs_deck_remember(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const char mark = HS_SAVED_COMMAND;
    const bool is_region = strcmp(args->command, "region") == 0;
    HS_TRY(is_region ? join_region(deck, args, err) : join_words(&deck->done, args->command, args, err));
    return hs_text_append(&deck->done, &mark, 1, err);
}

/** Write a state as the section KIND/ID. */
static hs_status put_section(hs_checkpoint *checkpoint, const char *kind, const char *id, const hs_state *state,
                             hs_error *err)
{
    hs_text section = {0};
    hs_status status = hs_text_printf(&section, err, "%s/%s", kind, id);
    if (status == HS_OK) status = hs_checkpoint_put(checkpoint, hs_text_get(&section), state, err);
    hs_text_fini(&section);
    return status;
}

hs_status hs_saved_get(hs_checkpoint *checkpoint, const char *kind, const char *id, hs_state *state, hs_error *err)
{
    hs_text section = {0};
    hs_status status = hs_text_printf(&section, err, "%s/%s", kind, id);
    if (status == HS_OK) status = hs_checkpoint_get(checkpoint, hs_text_get(&section), state, err);
    hs_text_fini(&section);
    return status;
}

/* ---- Variables ---- */

static hs_status keep_generator(hs_marsaglia *generator, const char *prefix, hs_state *state, hs_error *err)
{
    char name[40];
#define NAMED(what) (snprintf(name, sizeof name, "%s %s", prefix, what), name)
    HS_TRY(hs_state_double(state, NAMED("u"), generator->u, 97, err));
    HS_TRY(hs_state_double(state, NAMED("c"), &generator->c, 1, err));
    HS_TRY(hs_state_int(state, NAMED("i"), &generator->i, err));
    HS_TRY(hs_state_int(state, NAMED("j"), &generator->j, err));
    HS_TRY(hs_state_bool(state, NAMED("is seeded"), &generator->is_seeded, err));
    HS_TRY(hs_state_bool(state, NAMED("has second"), &generator->have_second, err));
    return hs_state_double(state, NAMED("second"), &generator->second, 1, err);
#undef NAMED
}

hs_status hs_saved_keep_generators(hs_variables *variables, hs_state *state, hs_error *err)
{
    HS_TRY(keep_generator(&variables->generator, "generator", state, err));
    HS_TRY(keep_generator(&variables->atom_generator, "atom generator", state, err));
    return hs_state_int64(state, "draws", &variables->n_draws, 1, err);
}

hs_status hs_saved_keep_variable(hs_variable *variable, hs_state *state, hs_error *err)
{
    int style = (int)variable->style;
    int64_t numbers[4] = {variable->which, variable->first, variable->last, variable->width};
    HS_TRY(hs_state_int(state, "style", &style, err));
    HS_TRY(hs_state_int64(state, "numbers", numbers, 4, err));
    HS_TRY(hs_state_double(state, "number", &variable->number, 1, err));
    variable->style = (hs_variable_style)style;
    variable->which = numbers[0];
    variable->first = numbers[1];
    variable->last = numbers[2];
    variable->width = (int)numbers[3];
    return HS_OK;
}

static hs_status put_variable(hs_checkpoint *checkpoint, hs_variable *variable, hs_error *err)
{
    hs_state state = {0};
    hs_text values = {0};
    const hs_args words = {.n = variable->n_values, .word = (const char *const *)variable->value};
    char *formula = variable->formula != NULL ? (char *)(uintptr_t)hs_formula_text(variable->formula) : NULL;
    hs_status status = hs_saved_keep_variable(variable, &state, err);
    if (status == HS_OK) status = join_words(&values, NULL, &words, err);
    char *joined = values.data;
    if (status == HS_OK && variable->n_values > 0) status = hs_state_text(&state, "values", &joined, err);
    if (status == HS_OK) status = hs_state_int(&state, "value count", &variable->n_values, err);
    if (status == HS_OK) status = hs_state_text(&state, "formula", &formula, err);
    if (status == HS_OK) status = put_section(checkpoint, "variables", variable->name, &state, err);
    hs_text_fini(&values);
    hs_state_fini(&state);
    return status;
}

static hs_status put_variables(hs_checkpoint *checkpoint, hs_deck *deck, hs_error *err)
{
    hs_variables *variables = deck->variables;
    hs_state state = {0};
    hs_text names = {0};
    hs_status status = hs_saved_keep_generators(variables, &state, err);
    for (int i = 0; i < variables->n && status == HS_OK; ++i)
        status = hs_text_printf(&names, err, "%s%s", i > 0 ? " " : "", variables->variable[i]->name);
    if (status == HS_OK) status = hs_state_text(&state, "names", &names.data, err);
    if (status == HS_OK) status = hs_checkpoint_put(checkpoint, "variables", &state, err);
    for (int i = 0; i < variables->n && status == HS_OK; ++i)
        status = put_variable(checkpoint, variables->variable[i], err);
    hs_text_fini(&names);
    hs_state_fini(&state);
    return status;
}

/* ---- The place in the deck ---- */

static hs_status put_place(hs_checkpoint *checkpoint, int k, hs_state *state, hs_error *err)
{
    char section[64];
    snprintf(section, sizeof section, "place/%d", k);
    const hs_status status = hs_checkpoint_put(checkpoint, section, state, err);
    hs_state_fini(state);
    return status;
}

static hs_status put_source(hs_checkpoint *checkpoint, int k, hs_source *source, hs_error *err)
{
    hs_state state = {0};
    int64_t numbers[3] = {(int64_t)source->cursor.at, source->cursor.n_lines_read, source->line};
    int kind = HS_SAVED_FILE;
    HS_TRY(hs_state_int(&state, "kind", &kind, err));
    HS_TRY(hs_state_int64(&state, "cursor", numbers, 3, err));
    HS_TRY(hs_state_text(&state, "name", &source->name, err));
    HS_TRY(hs_state_text(&state, "text", &source->text.data, err));
    return put_place(checkpoint, k, &state, err);
}

static hs_status put_frame(hs_checkpoint *checkpoint, int k, hs_frame *frame, hs_error *err)
{
    hs_state state = {0};
    hs_text words = {0};
    int kind = frame->kind;
    HS_TRY(join_words(&words, NULL, &frame->words, err));
    HS_TRY(hs_state_int(&state, "kind", &kind, err));
    HS_TRY(hs_saved_keep_frame(frame, &state, err));
    HS_TRY(hs_state_text(&state, "words", &words.data, err));
    hs_text_fini(&words);
    return put_place(checkpoint, k, &state, err);
}

hs_status hs_saved_keep_frame(hs_frame *frame, hs_state *state, hs_error *err)
{
    HS_TRY(hs_state_int64(state, "next", &frame->next, 1, err));
    HS_TRY(hs_state_int64(state, "left", &frame->left, 1, err));
    HS_TRY(hs_state_int64(state, "part", &frame->part, 1, err));
    HS_TRY(hs_state_bool(state, "is first", &frame->is_first, err));
    return hs_state_bool(state, "is in commands", &frame->is_in_commands, err);
}

/** Files and frames, the outermost first. */
static hs_status put_places(hs_checkpoint *checkpoint, hs_deck *deck, int *n, hs_error *err)
{
    const int n_files = deck->source != NULL ? deck->source->depth : 0;
    for (int depth = 0; depth <= n_files; ++depth) {
        hs_source *source = deck->source;
        while (source != NULL && source->depth != depth) source = source->below;
        if (source != NULL) HS_TRY(put_source(checkpoint, (*n)++, source, err));
        int n_here = 0;
        for (hs_frame *frame = deck->frame; frame != NULL; frame = frame->below) n_here += frame->source_depth == depth;
        while (n_here > 0) { /* the stack has the innermost on top */
            hs_frame *frame = deck->frame;
            for (int skip = n_here - 1; frame != NULL; frame = frame->below)
                if (frame->source_depth == depth && skip-- == 0) break;
            HS_TRY(put_frame(checkpoint, (*n)++, frame, err));
            --n_here;
        }
    }
    return HS_OK;
}

/* ---- Styles and settings ---- */

hs_status hs_saved_keep_fix(hs_fix *fix, hs_state *state, hs_error *err)
{
    static const char name[] = "virial of the fix";
    const hs_fix_style *style = fix->style;
    if (style->keep_state != NULL) HS_TRY(style->keep_state(fix, state, err));
    /* where it acts every few steps only, the virial stays in between, as in LAMMPS */
    if (!style->has_virial || (state->is_reading && hs_state_find(state, name) == NULL)) return HS_OK;
    return hs_state_double(state, name, fix->virial, 6, err);
}

static hs_status put_fix(hs_checkpoint *checkpoint, hs_fix *fix, hs_error *err)
{
    hs_state state = {0};
    char *name = (char *)(uintptr_t)fix->style->about.name;
    hs_status status = hs_state_text(&state, "style", &name, err);
    if (status == HS_OK) status = hs_saved_keep_fix(fix, &state, err);
    if (status == HS_OK) status = put_section(checkpoint, "fix", fix->id, &state, err);
    hs_state_fini(&state);
    return status;
}

static hs_status put_compute(hs_checkpoint *checkpoint, hs_compute *compute, hs_error *err)
{
    hs_state state = {0};
    char *name = (char *)(uintptr_t)compute->style->about.name;
    hs_status status = hs_state_text(&state, "style", &name, err);
    if (status == HS_OK && compute->style->keep_state != NULL)
        status = compute->style->keep_state(compute, &state, err);
    if (status == HS_OK) status = put_section(checkpoint, "compute", compute->id, &state, err);
    hs_state_fini(&state);
    return status;
}

static hs_status put_dump(hs_checkpoint *checkpoint, hs_dump *dump, hs_error *err)
{
    hs_state state = {0};
    hs_status status = hs_saved_keep_dump(dump, &state, err);
    if (status == HS_OK) status = put_section(checkpoint, "dump", dump->id, &state, err);
    hs_state_fini(&state);
    return status;
}

static hs_status put_styles(hs_checkpoint *checkpoint, hs_sim *sim, hs_error *err)
{
    for (int k = 0; k < sim->n_fixes; ++k) HS_TRY(put_fix(checkpoint, sim->fix[k], err));
    for (int k = 0; k < sim->n_computes; ++k) HS_TRY(put_compute(checkpoint, sim->compute[k], err));
    for (int k = 0; k < sim->n_dumps; ++k) HS_TRY(put_dump(checkpoint, sim->dump[k], err));
    return HS_OK;
}

hs_status hs_saved_keep_dump(hs_dump *dump, hs_state *state, hs_error *err)
{
    if (!state->is_reading && dump->style->position != NULL) dump->resume_at = dump->style->position(dump);
    HS_TRY(hs_state_int64(state, "last written", &dump->last_written, 1, err));
    if (dump->every_variable != NULL) HS_TRY(hs_state_int64(state, "next snapshot", &dump->next_due, 1, err));
    HS_TRY(hs_state_int64(state, "file size", &dump->resume_at, 1, err));
    return dump->style->keep_state != NULL ? dump->style->keep_state(dump, state, err) : HS_OK;
}

/** IDs of fixes or computes, and what fields they have of the atoms: for read_restart, which knows none of them yet. */
static hs_status keep_names(const hs_sim *sim, hs_restored_kind kind, hs_state *state, hs_error *err)
{
    static const char *const names[HS_N_RESTORED][2] = {{"fixes", "fields of fixes"},
                                                        {"computes", "fields of computes"}};
    const int n = kind == HS_RESTORED_FIX ? sim->n_fixes : sim->n_computes;
    const size_t n_prefix = strlen(hs_restored_kinds[kind]);
    hs_text ids = {0}, fields = {0};
    hs_status status = HS_OK;
    for (int k = 0; k < n && status == HS_OK; ++k)
        status = hs_text_printf(&ids, err, "%s%c", kind == HS_RESTORED_FIX ? sim->fix[k]->id : sim->compute[k]->id,
                                HS_SAVED_COMMAND);
    for (int k = 0; k < sim->atoms.n_fields && status == HS_OK; ++k) {
        const hs_atom_field *field = &sim->atoms.field[k];
        if (strncmp(field->name, hs_restored_kinds[kind], n_prefix) == 0 && field->name[n_prefix] == ' ')
            status = hs_text_printf(&fields, err, "%zu %s%c", field->size, field->name, HS_SAVED_COMMAND);
    }
    if (status == HS_OK) status = hs_state_text(state, names[kind][0], &ids.data, err);
    if (status == HS_OK) status = hs_state_text(state, names[kind][1], &fields.data, err);
    hs_text_fini(&ids);
    hs_text_fini(&fields);
    return status;
}

static hs_status put_settings(hs_checkpoint *checkpoint, hs_deck *deck, const char *path, int n_places, hs_error *err)
{
    hs_state state = {0};
    char *method = deck->options.neighbor_method, *precision = deck->options.precision;
    hs_status status = hs_state_int(&state, "places", &n_places, err);
    if (status == HS_OK) status = hs_state_text(&state, "commands", &deck->done.data, err);
    if (status == HS_OK) status = hs_state_text(&state, "neighbor method", &method, err);
    if (status == HS_OK) status = hs_state_text(&state, "precision", &precision, err);
    if (status == HS_OK) status = hs_state_text(&state, "log", &deck->log_name, err);
    if (status == HS_OK) status = hs_state_text(&state, "printed files", &deck->printed, err);
    if (status == HS_OK) status = hs_state_bool(&state, "jump is skipped", &deck->jump_skipped, err);
    for (int kind = 0; kind < HS_N_RESTORED && status == HS_OK; ++kind)
        status = keep_names(deck->sim, (hs_restored_kind)kind, &state, err);
    if (status == HS_OK) status = hs_saving_put_kept(deck->sim->saving, path, &state, err);
    if (status == HS_OK) status = hs_checkpoint_put(checkpoint, "deck", &state, err);
    hs_state_fini(&state);
    return status;
}

static hs_status put_simulation(hs_checkpoint *checkpoint, hs_sim *sim, hs_error *err)
{
    hs_state box = {0}, run = {0};
    hs_status status = hs_sim_keep_box(sim, &box, err);
    if (status == HS_OK) status = hs_sim_keep_run(sim, &run, err);
    if (status == HS_OK) status = hs_sim_keep_under_way(sim, &run, err);
    if (status == HS_OK) status = hs_checkpoint_put(checkpoint, "box", &box, err);
    if (status == HS_OK) status = hs_checkpoint_put(checkpoint, "run", &run, err);
    hs_state_fini(&box);
    hs_state_fini(&run);
    if (status == HS_OK) status = put_styles(checkpoint, sim, err);
    return status == HS_OK ? hs_checkpoint_put_atoms(checkpoint, &sim->atoms, err) : status;
}

hs_status hs_deck_save(void *context, const char *path, hs_error *err)
{
    hs_deck *deck = context;
    hs_checkpoint *checkpoint = NULL;
    int n_places = 0;
    hs_restored_forget(deck->sim); /* fixes that were to get it are there now, or are no part of this deck's state */
    HS_TRY(hs_checkpoint_create(&checkpoint, path, &deck->sim->parallel, err));
    hs_status status = put_places(checkpoint, deck, &n_places, err);
    if (status == HS_OK) status = put_settings(checkpoint, deck, path, n_places, err);
    if (status == HS_OK) status = put_variables(checkpoint, deck, err);
    if (status == HS_OK) status = put_simulation(checkpoint, deck->sim, err);
    if (status == HS_OK) return hs_checkpoint_commit(&checkpoint, err);
    hs_checkpoint_destroy(&checkpoint);
    return status;
}
