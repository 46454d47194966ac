/** Carrying out a deck: line by line, in the order of LAMMPS: echo, comment, variables, words, command. */
#include <string.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/frames.h"
#include "deck/interpreter.h"
#include "deck/lexer.h"
#include "deck/outputs.h"
#include "deck/source.h"
#include "deck/substitute.h"
#include "deck/unwritten.h"
#include "deck/variables.h"
#include "sim/saving.h"

/** Commands within commands (if within if, run every): deeper ones would only end in the stack's overflow. */
enum { DEPTH_MAX = 32 };

static hs_status variable_value(void *deck, const char *name, double *value, hs_error *err)
{
    return hs_variables_number(deck, name, value, err);
}

static hs_status variable_atoms(void *deck, const char *name, double *values, hs_error *err)
{
    return hs_variables_atoms(deck, name, values, err);
}

static hs_status set_variable(void *deck, const char *name, double value, hs_error *err)
{
    return hs_variables_set_internal(((hs_deck *)deck)->variables, name, value, err);
}

static hs_variable_kind variable_kind(void *deck, const char *name)
{
    const hs_variable *variable = hs_variables_find(((hs_deck *)deck)->variables, name);
    if (variable == NULL) return HS_NO_VARIABLE;
    return hs_variable_is_per_atom(variable)       ? HS_ATOM_VARIABLE
           : variable->style == HS_VARIABLE_VECTOR ? HS_VECTOR_VARIABLE
                                                   : HS_NUMBER_VARIABLE;
}

static hs_status variable_length(void *deck, const char *name, bool refresh, int *length, bool *varies, hs_error *err)
{
    return hs_variables_length(deck, name, refresh, length, varies, err);
}

static hs_status variable_vector(void *deck, const char *name, int length, double *values, hs_error *err)
{
    return hs_variables_vector(deck, name, length, values, err);
}

static hs_status substitute(void *deck, hs_text *text, hs_error *err) { return hs_substitute(deck, text, false, err); }

static const char *deck_text(void *deck)
{
    const hs_source *source = ((hs_deck *)deck)->source;
    while (source != NULL && source->below != NULL) source = source->below;
    return source != NULL ? hs_text_get(&source->text) : NULL;
}

static void connect(hs_deck *deck)
{
    deck->sim->env.deck = deck;
    deck->sim->env.variable_value = variable_value;
    deck->sim->env.variable_atoms = variable_atoms;
    deck->sim->env.set_variable = set_variable;
    deck->sim->env.variable_length = variable_length;
    deck->sim->env.variable_vector = variable_vector;
    deck->sim->env.variable_kind = variable_kind;
    deck->sim->env.substitute = substitute;
    deck->sim->env.deck_text = deck_text;
    deck->sim->saving->write = hs_deck_save;
}

hs_status hs_deck_create(hs_deck **deck, const hs_options *options, hs_sink *out, hs_error *err)
{
    HS_TRY(HS_ALLOC(*deck, 1, err));
    (*deck)->options = *options;
    (*deck)->out = out;
    (*deck)->echo_log = true;
    hs_status status = hs_variables_create(&(*deck)->variables, err);
    if (status == HS_OK) status = hs_sim_create(&(*deck)->sim, options, out, err);
    if (status == HS_OK) connect(*deck);
    if (status != HS_OK) hs_deck_destroy(deck);
    return status;
}

hs_status hs_deck_clear(hs_deck *deck, hs_error *err)
{
    hs_sim *fresh = NULL;
    HS_TRY(hs_sim_create(&fresh, &deck->options, deck->out, err));
    fresh->stop_requested = deck->sim->stop_requested;
    hs_saving_inherit(fresh->saving, deck->sim->saving);
    hs_text_clear(&deck->done);
    if (!deck->sim->env.is_resuming) hs_variables_leave_atoms(deck->variables);
    hs_sim_destroy(&deck->sim);
    deck->sim = fresh;
    connect(deck);
    return HS_OK;
}

bool hs_deck_close_log(hs_deck *deck)
{
    if (deck->log_opened == NULL) return true;
    if (deck->out->log == deck->log_opened) deck->out->log = NULL;
    const bool was_written = !ferror(deck->log_opened), is_closed = fclose(deck->log_opened) == 0;
    deck->log_opened = NULL;
    return was_written && is_closed;
}

void hs_deck_destroy(hs_deck **deck)
{
    if (*deck == NULL) return;
    while ((*deck)->source != NULL) hs_source_pop(*deck);
    hs_variables_destroy(&(*deck)->variables); /* some have values of the atoms */
    hs_sim_destroy(&(*deck)->sim);
    (void)hs_deck_close_log(*deck); /* whoever wants to know has flushed it before */
    hs_text_fini(&(*deck)->input);
    hs_text_fini(&(*deck)->pipe);
    hs_unwritten_fini(*deck);
    HS_FREE((*deck)->pipe_name);
    HS_FREE((*deck)->label_wanted);
    HS_FREE((*deck)->log_name);
    HS_FREE((*deck)->printed);
    hs_name_list_fini(&(*deck)->folders);
    hs_text_fini(&(*deck)->done);
    HS_FREE(*deck);
}

hs_status hs_deck_set_variable(hs_deck *deck, const char *name, int n, const char *const *values, hs_error *err)
{
    return hs_variables_set_index(deck->variables, name, n, values, err);
}

void hs_deck_make_printable(char *text)
{
    for (unsigned char *at = (unsigned char *)text; *at != '\0';) {
        size_t n = *at < 0x80 ? 1 : (*at & 0xe0) == 0xc0 ? 2 : (*at & 0xf0) == 0xe0 ? 3 : (*at & 0xf8) == 0xf0 ? 4 : 0;
        bool is_fine = n > 1 || (n == 1 && *at >= ' ' && *at != 0x7f);
        for (size_t i = 1; i < n && is_fine; ++i) is_fine = (at[i] & 0xc0) == 0x80;
        if (!is_fine) *at = '?', n = 1;
        at += n;
    }
}

static hs_status stop_if_asked(hs_deck *deck, hs_error *err)
{
    if (deck->sim->parallel.n_ranks > 1 ? !deck->is_stopping : !hs_sim_is_asked_to_stop(deck->sim)) return HS_OK;
    return hs_sim_stop(deck->sim, "before this command", err);
}

static void echo(hs_deck *deck, const char *line)
{
    if (deck->echo_screen) hs_say_screen(deck->out, "%s\n", line);
    if (deck->echo_log) hs_say_log(deck->out, "%s\n", line);
}

/** A `$` that is left in a word stood in quotes or came out of a variable. Only commands that take texts and
 *  commands have a use for it; all others would take it for a part of a name or number. */
static hs_status refuse_dollars(const hs_args *args, hs_error *err)
{
    static const char *const with_texts[] = {"print", "if", "run", "variable", "fix"};
    for (size_t i = 0; i < sizeof with_texts / sizeof with_texts[0]; ++i)
        if (strcmp(args->command, with_texts[i]) == 0) return HS_OK;
    for (int i = 0; i < args->n; ++i)
        if (strchr(args->word[i], '$') != NULL)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the '$' in '%.80s' is not replaced, because it stands in quotes or came out of a "
                           "variable",
                           args->command, args->word[i]);
    return HS_OK;
}

static hs_status run_words(hs_deck *deck, const hs_words *words, hs_error *err)
{
    const hs_command *command = hs_command_find(words->word[0]);
    if (command == NULL) return hs_command_refuse(words->word[0], err);
    const hs_args args = {.command = words->word[0], .n = words->n - 1, .word = words->word + 1};
    HS_TRY(refuse_dollars(&args, err));
    HS_TRY(hs_syntax_check(&command->about.syntax, &args, false, err));
    if (command->check != NULL) HS_TRY(command->check(&args, false, err));
    for (int i = -1; (i = hs_outputs_next(command, &args, i + 1)) < args.n;)
        HS_TRY(hs_outputs_check(deck, args.command, args.word[i], err));
    HS_TRY(command->run(deck, &args, err));
    return hs_deck_remember(deck, &args, err);
}

/** While a label is looked for nothing is replaced or run but the command `label` itself: variables of skipped lines
 *  need not exist. */
static bool is_skipped(const hs_deck *deck, const char *line)
{
    if (deck->label_wanted == NULL) return false;
    line += strspn(line, " \t\v\f\r\n");
    return strncmp(line, "label", 5) != 0 || line[5] == '\0' || strchr(" \t\v\f\r\n", line[5]) == NULL;
}

/** One logical line: echo, comment, variables, words, command. */
static hs_status run_line(hs_deck *deck, const char *text, hs_error *err)
{
    if (is_skipped(deck, text)) return HS_OK;
    const bool is_shown = deck->label_wanted == NULL;
    hs_text line = {0};
    hs_words words = {0};
    if (is_shown) echo(deck, text);
    hs_status status = hs_text_append(&line, text, strlen(text), err);
    if (status == HS_OK) {
        hs_lexer_strip_comment(line.data);
        line.length = strlen(line.data);
        status = hs_substitute(deck, &line, is_shown, err);
    }
    if (status == HS_OK) status = hs_words_split(&words, hs_text_get(&line), err);
    if (status == HS_OK && words.n > 0) status = run_words(deck, &words, err);
    hs_words_fini(&words);
    hs_text_fini(&line);
    return status;
}

static hs_status fail_label(hs_deck *deck, hs_error *err)
{
    hs_source *source = deck->source;
    hs_status status =
        hs_fail(err, HS_ERROR_INPUT, "jump: there is no 'label %s' in %s", deck->label_wanted, source->name);
    hs_error_locate(err, source->jump_name, source->jump_line);
    return status;
}

/** After every line all ranks agree whether it went well, and whether to stop. */
static hs_status settle(hs_deck *deck, hs_error *err)
{
    deck->is_stopping = hs_sim_is_asked_to_stop(deck->sim);
    return hs_parallel_settle(&deck->sim->parallel, &deck->is_stopping, err);
}

hs_status hs_source_run(hs_deck *deck, hs_error *err)
{
    hs_text line = {0};
    hs_status status = HS_OK;
    while (status == HS_OK && !deck->quit) {
        hs_source *source = deck->source;
        const hs_cursor before = source->cursor;
        bool found;
        status =
            hs_lexer_line(source->text.data, source->text.length, &source->cursor, &line, &source->line, &found, err);
        if (status == HS_OK && !found) {
            if (deck->label_wanted != NULL) status = fail_label(deck, err);
            break;
        }
        const hs_cursor behind = source->cursor;
        source->cursor = before; /* a checkpoint must find the command that was not carried out */
        if (status == HS_OK) status = stop_if_asked(deck, err);
        source->cursor = behind;
        if (status == HS_OK) status = run_line(deck, hs_text_get(&line), err);
        if (status != HS_OK) hs_error_locate(err, source->name, source->line);
        status = settle(deck, err);
    }
    hs_text_fini(&line);
    return status;
}

hs_status hs_deck_run(hs_deck *deck, const char *file, hs_error *err)
{
    hs_status status = hs_source_push(deck, file, err);
    if (status == HS_OK) {
        status = hs_source_run(deck, err);
        hs_source_pop(deck);
    }
    HS_FREE(deck->label_wanted);
    deck->depth = 0;
    hs_deck_make_printable(err->text);
    return status;
}

hs_status hs_deck_command(hs_deck *deck, const char *line, hs_error *err)
{
    if (deck->depth >= DEPTH_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "more than %d commands within one another (if, run every)", DEPTH_MAX);
    if (deck->quit) return HS_OK;
    ++deck->depth;
    hs_status status = run_line(deck, line, err);
    --deck->depth;
    hs_deck_make_printable(err->text);
    return status;
}
