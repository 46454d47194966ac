/** The first pass: what can be said about a deck before anything runs. */
#include <string.h>

#include "base/memory.h"
#include "deck/boolean.h"
#include "deck/branches.h"
#include "deck/check_names.h"
#include "deck/command.h"
#include "deck/formula.h"
#include "deck/interpreter.h"
#include "deck/lexer.h"
#include "deck/outputs.h"
#include "deck/printed.h"
#include "deck/source.h"
#include "deck/substitute.h"
#include "io/files.h"

enum { NESTING_MAX = 32 };

/** A file that is being checked. */
typedef struct file {
    const char *name;
    const hs_text *text;
    const struct file *above; /**< the file that includes it; NULL for the deck */
    bool is_certain;          /**< every include down to this file is outside of `if` */
    bool may_end;             /**< a jump or a quit may keep an include from being reached again */
    bool is_dead;             /**< behind a `quit` that is always met: nothing up to the next label can run */
} file;

/** A file that a line will write. */
typedef struct output {
    hs_name_list names; /**< owned; its possible names, none: not known yet */
    char *command;      /**< owned */
    char *place;        /**< owned; the file that the line is in */
    long line;
} output;

typedef struct checker {
    hs_deck *deck;
    hs_check_names names;
    output *output; /**< owned [n_outputs] */
    int n_outputs;
    size_t capacity;
    int depth;   /**< files within files */
    int nesting; /**< commands within commands */
    long line;   /**< of the present file */
    hs_error *err;
} checker;

static hs_status check_line(checker *c, file *f, const char *text);
static hs_status check_file(checker *c, const char *name, const file *above, bool is_certain);

static bool is_open(const char *word) { return strchr(word, '$') != NULL; }

static bool any_open(const hs_args *args)
{
    for (int i = 0; i < args->n; ++i)
        if (is_open(args->word[i])) return true;
    return false;
}

/** Check the `$` expressions of a line, and make the blanks in $(a + b) dashes, so that each stays one word. */
static hs_status check_dollars(checker *c, char *line)
{
    for (const char *at = hs_dollar_find(line); at != NULL; at = hs_dollar_find(at)) {
        hs_dollar dollar;
        HS_TRY(hs_dollar_read(at, &dollar, c->err));
        if (dollar.kind == HS_DOLLAR_FORMULA) {
            char *text = NULL, *format = NULL;
            hs_formula *formula = NULL;
            HS_TRY(hs_dollar_formula(&dollar, &text, &format, c->err));
            hs_status status = hs_formula_parse(&formula, text, HS_VALUE_NUMBER, c->err);
            hs_formula_destroy(&formula);
            HS_FREE(text);
            HS_FREE(format);
            HS_TRY(status);
            for (size_t i = 0; i < dollar.length; ++i) {
                char *byte = line + (at - line) + i;
                if (strchr(" \t\v\f\r\n'\"", *byte) != NULL) *byte = '-';
            }
        }
        at += dollar.length;
    }
    return HS_OK;
}

/* ---- Files ---- */

/** Files that a word may name. One name only: it must be there. */
static hs_status check_files(checker *c, const file *f, const char *word, bool is_certain, const char *label)
{
    hs_name_list files = {0};
    hs_status status = hs_check_names_expand(&c->names, word, &files, c->err);
    for (int i = 0; i < files.n && status == HS_OK; ++i) {
        const char *name = files.name[i];
        const bool is_there = hs_file_is_readable(&c->deck->sim->parallel, name);
        if (!is_there && (files.n > 1 || !is_certain || hs_name_list_has(&c->names.written, name))) continue;
        bool may_end = false;
        for (const file *above = f; above != NULL; above = above->above) may_end = may_end || above->may_end;
        for (const file *above = f; above != NULL && status == HS_OK && is_certain && label == NULL;
             above = above->above)
            if (strcmp(above->name, name) == 0 && !may_end)
                status = hs_fail(c->err, HS_ERROR_INPUT, "include: '%.400s' includes itself without an end", name);
        if (status == HS_OK) status = check_file(c, name, f, is_certain && label == NULL);
        hs_text text = {0};
        if (status == HS_OK && label != NULL && label[0] != '\0') {
            status = hs_source_read(c->deck, name, &text, c->err);
            if (status == HS_OK && !hs_source_has_label(text.data, text.length, label))
                status = hs_fail(c->err, HS_ERROR_INPUT, "jump: there is no 'label %s' in %.400s", label, name);
        }
        hs_text_fini(&text);
    }
    hs_name_list_fini(&files);
    return status;
}

static hs_status check_jump(checker *c, const file *f, const hs_args *args, bool is_certain)
{
    const char *label = args->n > 1 ? args->word[1] : "";
    if (is_open(label)) label = "";
    if (strcmp(args->word[0], "SELF") != 0) return check_files(c, f, args->word[0], is_certain, label);
    if (label[0] == '\0' || hs_source_has_label(f->text->data, f->text->length, label)) return HS_OK;
    return hs_fail(c->err, HS_ERROR_INPUT, "jump: there is no 'label %s' in %s", label, f->name);
}

/* ---- Commands within commands ---- */

static hs_status check_nested(checker *c, file *f, const hs_args *args, int first, int end)
{
    if (c->nesting >= NESTING_MAX)
        return hs_fail(c->err, HS_ERROR_INPUT, "more than %d commands within one another (if, run every)", NESTING_MAX);
    hs_status status = HS_OK;
    ++c->nesting;
    for (int i = first; i < end && status == HS_OK; ++i) status = check_line(c, f, args->word[i]);
    --c->nesting;
    return status;
}

static hs_status check_if(checker *c, file *f, const hs_args *args)
{
    hs_branch branch;
    bool found = true;
    for (int at = 0; found;) {
        hs_error unsure = {0};
        const bool is_unsure = any_open(args);
        hs_status status = hs_branches_next(args, &at, &branch, &found, is_unsure ? &unsure : c->err);
        if (status != HS_OK) return is_unsure ? HS_OK : status;
        if (!found) return HS_OK;
        bool holds;
        if (branch.condition != NULL && !is_open(branch.condition))
            HS_TRY(hs_boolean_eval(branch.condition, &holds, c->err));
        HS_TRY(check_nested(c, f, args, branch.first, branch.end));
    }
    return HS_OK;
}

/** The commands of `run N every M "command" ...`. */
static hs_status check_run(checker *c, file *f, const hs_args *args)
{
    for (int i = 0; i < args->n; ++i)
        if (strcmp(args->word[i], "every") == 0 && i + 2 < args->n && strcmp(args->word[i + 2], "NULL") != 0)
            return check_nested(c, f, args, i + 2, args->n);
    return HS_OK;
}

/** What the file holds that `print` adds to is noted: a run that is killed after its first line there, and before its
 *  next checkpoint, can then be resumed without that line twice. */
static hs_status check_print(checker *c, const hs_args *args)
{
    if (c->deck->sim->parallel.rank != 0) return HS_OK;
    for (int i = 1; i + 1 < args->n; i += 2)
        if (strcmp(args->word[i], "append") == 0 && !is_open(args->word[i + 1]))
            HS_TRY(hs_printed_expect(&c->deck->printed, args->word[i + 1], c->err));
    return HS_OK;
}

/** Keep the name of a file that will be written for when all folders are known that the deck makes. Lines that may never be
 *  met, and names that are not known yet, are looked at when their turn has come. */
static hs_status note_output(checker *c, const file *f, const char *command, const char *word)
{
    bool is_certain = f->is_certain && c->nesting == 0;
    for (const file *at = f; at != NULL; at = at->above) is_certain = is_certain && !at->may_end;
    if (!is_certain) return HS_OK;
    HS_TRY(HS_EXTEND(c->output, c->n_outputs, c->capacity, c->err));
    output *new = &c->output[c->n_outputs];
    *new = (output){.line = c->line};
    hs_status status = hs_check_names_expand(&c->names, word, &new->names, c->err);
    if (status == HS_OK) status = hs_memory_strdup(&new->command, command, c->err);
    if (status == HS_OK) status = hs_memory_strdup(&new->place, f->name, c->err);
    ++c->n_outputs;
    return status;
}

/** Files that cannot be written, whichever of its values a variable has. */
static hs_status check_folders(checker *c)
{
    for (int k = 0; k < c->n_outputs; ++k) {
        const output *at = &c->output[k];
        hs_error first = {0}, other = {0};
        hs_status status = HS_OK;
        for (int i = 0; i < at->names.n && (i == 0 || status != HS_OK); ++i) {
            hs_error_clear(&other);
            status = hs_outputs_check(c->deck, at->command, at->names.name[i], i == 0 ? &first : &other);
        }
        if (status == HS_OK) continue;
        *c->err = first;
        hs_error_locate(c->err, at->place, at->line);
        return status;
    }
    return HS_OK;
}

static void fini_outputs(checker *c)
{
    for (int k = 0; k < c->n_outputs; ++k) {
        hs_name_list_fini(&c->output[k].names);
        HS_FREE(c->output[k].command);
        HS_FREE(c->output[k].place);
    }
    HS_FREE(c->output);
}

/** The folders of `shell mkdir`. One whose name is not known yet may be any. */
static hs_status note_folders(checker *c, const hs_args *args)
{
    for (int i = 1; i < args->n; ++i) {
        hs_name_list names = {0};
        hs_status status = hs_check_names_expand(&c->names, args->word[i], &names, c->err);
        if (status == HS_OK && names.n == 0) status = hs_outputs_note_folder(c->deck, args->word[i], c->err);
        for (int k = 0; k < names.n && status == HS_OK; ++k)
            status = hs_outputs_note_folder(c->deck, names.name[k], c->err);
        hs_name_list_fini(&names);
        HS_TRY(status);
    }
    return HS_OK;
}

/** Take note of the files that a line will write: none may be the deck, or a file that includes this line. */
static hs_status check_outputs(checker *c, const file *f, const hs_command *command, const hs_args *args)
{
    for (int i = -1; (i = hs_outputs_next(command, args, i + 1)) < args->n;) {
        const char *name = args->word[i];
        HS_TRY(note_output(c, f, args->command, name));
        if (is_open(name)) continue;
        HS_TRY(hs_name_list_add(&c->names.written, name, c->err));
        for (const file *above = f; above != NULL; above = above->above)
            if (hs_file_is_same(&c->deck->sim->parallel, name, above->name))
                return hs_fail(c->err, HS_ERROR_INPUT, "%s: '%.400s' is the deck itself, which would be overwritten",
                               args->command, name);
    }
    return HS_OK;
}

/** What a command tells about others: variables, files, labels, commands within it. */
static hs_status check_meaning(checker *c, file *f, const hs_command *command, const hs_args *args)
{
    const bool is_certain = f->is_certain && c->nesting == 0;
    HS_TRY(check_outputs(c, f, command, args));
    if (strcmp(args->command, "jump") == 0 || strcmp(args->command, "quit") == 0) f->may_end = true;
    if (strcmp(args->command, "if") == 0) return check_if(c, f, args);
    if (strcmp(args->command, "run") == 0) return check_run(c, f, args);
    if (strcmp(args->command, "variable") == 0) return hs_check_names_define(&c->names, args, c->err);
    if (strcmp(args->command, "include") == 0) return check_files(c, f, args->word[0], is_certain, NULL);
    if (strcmp(args->command, "jump") == 0) return check_jump(c, f, args, is_certain);
    if (strcmp(args->command, "quit") == 0 && c->nesting == 0) f->is_dead = true;
    if (strcmp(args->command, "shell") == 0) return note_folders(c, args);
    return strcmp(args->command, "print") == 0 ? check_print(c, args) : HS_OK;
}

static hs_status check_words(checker *c, file *f, const hs_words *words)
{
    if (strcmp(words->word[0], "label") == 0) f->is_dead = false;
    if (f->is_dead || is_open(words->word[0])) return HS_OK;
    const hs_command *command = hs_command_find(words->word[0]);
    if (command == NULL) return hs_command_refuse(words->word[0], c->err);
    const hs_args args = {.command = words->word[0], .n = words->n - 1, .word = words->word + 1};
    const bool has_variables = any_open(&args);
    HS_TRY(hs_syntax_check(&command->about.syntax, &args, has_variables, c->err));
    if (command->check != NULL && (!has_variables || args.n >= command->about.syntax.n_min))
        HS_TRY(command->check(&args, has_variables, c->err));
    return check_meaning(c, f, command, &args);
}

static hs_status check_line(checker *c, file *f, const char *text)
{
    hs_text line = {0};
    hs_words words = {0};
    hs_status status = hs_text_append(&line, text, strlen(text), c->err);
    if (status == HS_OK) {
        hs_lexer_strip_comment(line.data);
        if (!f->is_dead) status = check_dollars(c, line.data);
    }
    if (status == HS_OK) status = hs_words_split(&words, line.data, c->err);
    if (status == HS_OK && words.n > 0) status = check_words(c, f, &words);
    /* Behind a quit there may be anything, notes too. */
    if (status != HS_OK && f->is_dead) {
        hs_error_clear(c->err);
        status = HS_OK;
    }
    hs_words_fini(&words);
    hs_text_fini(&line);
    return status;
}

static hs_status check_text(checker *c, file *f)
{
    hs_cursor cursor = {0};
    hs_text line = {0};
    hs_status status = HS_OK;
    bool found = true;
    while (status == HS_OK) {
        long first;
        status = hs_lexer_line(f->text->data, f->text->length, &cursor, &line, &first, &found, c->err);
        if (status == HS_OK && !found) break;
        c->line = first;
        if (status == HS_OK) status = check_line(c, f, hs_text_get(&line));
        if (status != HS_OK) hs_error_locate(c->err, f->name, first);
    }
    hs_text_fini(&line);
    return status;
}

/** Check a file and what it includes; a file that was checked before is not checked again. */
static hs_status check_file(checker *c, const char *name, const file *above, bool is_certain)
{
    if (hs_name_list_has(&c->names.visited, hs_source_name(name))) return HS_OK;
    if (c->depth >= HS_SOURCES_MAX && above != NULL && is_certain)
        return hs_fail(c->err, HS_ERROR_INPUT,
                       "include: '%.400s' would be file number %d within one another (at most %d)", name, c->depth + 1,
                       HS_SOURCES_MAX);
    if (c->depth >= 2 * HS_SOURCES_MAX) return HS_OK;
    hs_text text = {0};
    hs_status status = hs_source_read(c->deck, name, &text, c->err);
    if (status == HS_OK) status = hs_name_list_add(&c->names.visited, hs_source_name(name), c->err);
    file f = {.name = hs_source_name(name), .text = &text, .above = above, .is_certain = is_certain};
    const int nesting = c->nesting;
    c->nesting = 0;
    ++c->depth;
    if (status == HS_OK) status = check_text(c, &f);
    --c->depth;
    c->nesting = nesting;
    hs_text_fini(&text);
    return status;
}

hs_status hs_deck_check(hs_deck *deck, const char *name, hs_error *err)
{
    checker c = {.deck = deck, .err = err};
    hs_status status = hs_check_names_init(&c.names, deck->variables, err);
    if (status == HS_OK) status = check_file(&c, name, NULL, true);
    if (status == HS_OK) status = check_folders(&c);
    fini_outputs(&c);
    hs_check_names_fini(&c.names);
    hs_deck_make_printable(err->text);
    return status;
}
