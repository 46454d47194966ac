/* Commands that steer the script: echo, log, print, include, jump, label, next, if, quit, clear. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "deck/boolean.h"
#include "deck/branches.h"
#include "deck/command.h"
#include "deck/frames.h"
#include "deck/interpreter.h"
#include "deck/printed.h"
#include "deck/source.h"
#include "deck/substitute.h"
#include "deck/unwritten.h"
#include "deck/variables.h"

/* ---- echo, log ---- */

static hs_status echo_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const choices[] = {"none", "screen", "log", "both", NULL};
    int choice;
    if (has_variables) return HS_OK;
    return hs_arg_choice(args, 0, choices, &choice, err);
}

static hs_status echo_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)err;
    deck->echo_screen = strcmp(args->word[0], "screen") == 0 || strcmp(args->word[0], "both") == 0;
    deck->echo_log = strcmp(args->word[0], "log") == 0 || strcmp(args->word[0], "both") == 0;
    return HS_OK;
}

static hs_status log_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const choices[] = {"append", NULL};
    if (has_variables || args->n < 2) return HS_OK;
    return strcmp(args->word[1], "append") == 0 ? HS_OK : hs_arg_refuse(args, 1, "the word append", choices, err);
}

static hs_status log_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    if (deck->options.dry_run) return HS_OK;
    const hs_parallel *parallel = &deck->sim->parallel;
    const bool is_append = args->n == 2;
    if (!hs_deck_close_log(deck))
        (void)hs_fail(err, HS_ERROR_IO, "log: the log file before could not be written in full; is the disk full?");
    deck->out->log = NULL;
    HS_TRY(hs_parallel_agree(parallel, err));
    HS_FREE(deck->log_name);
    if (strcmp(args->word[0], "none") == 0) return HS_OK;
    HS_TRY(hs_memory_strdup(&deck->log_name, args->word[0], err));
    if (parallel->rank == 0) {
        deck->log_opened = fopen(args->word[0], is_append ? "a" : "w");
        if (deck->log_opened == NULL)
            (void)hs_fail(err, HS_ERROR_IO, "log: the file '%.400s' cannot be written: %s", args->word[0],
                          strerror(errno));
        deck->out->log = deck->log_opened;
    }
    return hs_parallel_agree(parallel, err);
}

/* ---- print ---- */

typedef struct print_plan {
    const char *file; /**< NULL: to no file */
    bool is_append;
    bool to_screen, to_universe;
} print_plan;

static hs_status read_print(const hs_args *args, print_plan *plan, hs_error *err)
{
    *plan = (print_plan){.to_screen = true};
    for (int i = 1; i + 1 < args->n; i += 2) {
        const char *keyword = args->word[i];
        if (strcmp(keyword, "screen") == 0) {
            HS_TRY(hs_arg_bool(args, i + 1, &plan->to_screen, err));
        } else if (strcmp(keyword, "universe") == 0) {
            HS_TRY(hs_arg_bool(args, i + 1, &plan->to_universe, err));
        } else {
            plan->file = args->word[i + 1];
            plan->is_append = strcmp(keyword, "append") == 0;
        }
    }
    return HS_OK;
}

static hs_status print_to_file(hs_deck *deck, const print_plan *plan, const char *text, hs_error *err)
{
    FILE *stream = fopen(plan->file, plan->is_append ? "a" : "w");
    if (stream == NULL)
        return hs_fail(err, HS_ERROR_IO, "print: the file '%.400s' cannot be written: %s", plan->file, strerror(errno));
    const bool is_written = fprintf(stream, "%s\n", text) >= 0;
    const int64_t size = ftello(stream); /* -1 for a pipe */
    if (fclose(stream) == 0 && is_written)
        return size < 0 ? HS_OK : hs_printed_note(&deck->printed, plan->file, size, err);
    return hs_fail(err, HS_ERROR_IO, "print: the file '%.400s' could not be written in full: %s", plan->file,
                   strerror(errno));
}

static hs_status print_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    print_plan plan;
    HS_TRY(read_print(args, &plan, err));
    hs_text text = {0};
    hs_status status = hs_text_append(&text, args->word[0], strlen(args->word[0]), err);
    if (status == HS_OK) status = hs_substitute(deck, &text, false, err);
    if (status == HS_OK) {
        /* One simulation is the whole universe: its lines go where all others go. */
        if (plan.to_screen) hs_say_screen(deck->out, "%s\n", hs_text_get(&text));
        if (plan.to_screen || plan.to_universe) hs_say_log(deck->out, "%s\n", hs_text_get(&text));
        if (plan.file != NULL && deck->options.dry_run)
            HS_UNLESS_FAILED(err, hs_unwritten_add(deck, plan.file, hs_text_get(&text), plan.is_append, err));
        else if (plan.file != NULL && deck->sim->parallel.rank == 0)
            (void)print_to_file(deck, &plan, hs_text_get(&text), err);
        status = hs_parallel_agree(&deck->sim->parallel, err);
    }
    hs_text_fini(&text);
    return status;
}

/* ---- include, jump, label, next ---- */

static hs_status include_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_source_push(deck, args->word[0], err));
    hs_status status = hs_source_run(deck, err);
    hs_source_pop(deck);
    return status;
}

static hs_status jump_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    if (deck->jump_skipped) {
        deck->jump_skipped = false;
        return HS_OK;
    }
    if (deck->source == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "jump: there is no file to jump in: the command did not come from a deck");
    HS_TRY(hs_source_jump(deck, args->word[0], err));
    if (args->n < 2) return HS_OK;
    return hs_memory_replace(&deck->label_wanted, args->word[1], err);
}

static hs_status label_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)err;
    if (deck->label_wanted != NULL && strcmp(deck->label_wanted, args->word[0]) == 0) HS_FREE(deck->label_wanted);
    return HS_OK;
}

static hs_status next_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    bool exhausted;
    HS_TRY(hs_variables_next(deck, args, &exhausted, err));
    if (exhausted) deck->jump_skipped = true;
    return HS_OK;
}

/* ---- if ---- */

static hs_status if_check(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_branch branch;
    bool found = true;
    if (has_variables) return HS_OK;
    for (int at = 0; found;) HS_TRY(hs_branches_next(args, &at, &branch, &found, err));
    return HS_OK;
}

static hs_status decide(hs_deck *deck, const char *condition, bool *holds, hs_error *err)
{
    hs_text text = {0};
    hs_status status = hs_text_append(&text, condition, strlen(condition), err);
    if (status == HS_OK) status = hs_substitute(deck, &text, false, err);
    if (status == HS_OK) status = hs_boolean_eval(hs_text_get(&text), holds, err);
    hs_text_fini(&text);
    return status;
}

static hs_status if_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_branch branch;
    bool found, holds = false;
    HS_TRY(if_check(args, false, err));
    for (int at = 0; !holds;) {
        HS_TRY(hs_branches_next(args, &at, &branch, &found, err));
        if (!found) return HS_OK;
        holds = branch.condition == NULL;
        if (!holds) HS_TRY(decide(deck, branch.condition, &holds, err));
    }
    hs_frame frame = {
        .kind = HS_FRAME_LIST,
        .words = {.command = args->command, .n = branch.end - branch.first, .word = args->word + branch.first}};
    return hs_frame_run_list(deck, &frame, err);
}

hs_status hs_frame_run_list(hs_deck *deck, hs_frame *frame, hs_error *err)
{
    hs_status status = HS_OK;
    hs_frame_push(deck, frame);
    while (frame->next < frame->words.n && status == HS_OK)
        status = hs_deck_command(deck, frame->words.word[frame->next++], err);
    hs_frame_pop(deck);
    return status;
}

/* ---- quit, clear ---- */

static hs_status quit_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int64_t code;
    if (args->n == 0 || has_variables) return HS_OK;
    return hs_arg_int(args, 0, 0, 255, &code, err);
}

static hs_status quit_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    int64_t code = 0;
    if (args->n > 0) HS_TRY(hs_arg_int(args, 0, 0, 255, &code, err));
    deck->exit_code = (int)code;
    deck->quit = true;
    return HS_OK;
}

static hs_status clear_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)args;
    return hs_deck_clear(deck, err);
}

static const hs_keyword print_keywords[] = {
    {"file", 1, "<output-file>", "also write the line to this file, in place of what it held"},
    {"append", 1, "<output-file>", "also add the line to the end of this file"},
    {"screen", 1, "yes|no", "whether the line goes to screen and log (default: yes)"},
    {"universe", 1, "yes|no",
     "whether the line goes to the log even with `screen no`: one simulation is the whole universe"},
    {0},
};

const hs_command hs_commands_script[] = {
    {
        .about =
            {
                .name = "echo",
                .syntax = {"none|screen|log|both", 1, 1, NULL},
                .summary = "Where commands are echoed as they are read",
                .details = "Each command is shown as it stands in the deck; where variables are replaced in it, once "
                           "more after each replacement.\nThe default, `log`, is changed by the option `-echo`.\n",
                .example = "echo both",
            },
        .run = echo_run,
        .check = echo_check,
    },
    {
        .about =
            {
                .name = "log",
                .syntax = {"<output-file>|none [append]", 1, 2, NULL},
                .summary = "Go on with another log file",
                .details = "The present log file is closed. `none` writes no log from here on. `append` adds to the "
                           "end of the file, which else is\nemptied.\n",
                .example = "log log.melt\nlog log.$t append",
            },
        .run = log_run,
        .check = log_check,
    },
    {
        .about =
            {
                .name = "print",
                .syntax = {"\"<text>\" [keyword value ...]", 1, 1, print_keywords},
                .summary = "Print a line to screen, log and files",
                .details =
                    "A text with blanks needs quotes: `'...'`, `\"...\"`, or `\"\"\"...\"\"\"`, which may hold several "
                    "lines. Variables in it are\nreplaced, but not within further quotes inside of the text.\n",
                .example = "print \"T = $T, pressure $(press:%.4f)\" append results.txt screen no",
            },
        .run = print_run,
    },
    {
        .about =
            {
                .name = "include",
                .syntax = {"<file>", 1, 1, NULL},
                .summary = "Carry out the commands of another file, then go on",
                .details = "At most 16 files can be open within one another.\n",
                .example = "include in.potential",
            },
        .run = include_run,
    },
    {
        .about =
            {
                .name = "jump",
                .syntax = {"<file>|SELF [label]", 1, 2, NULL},
                .summary = "Go on reading at the start, or at a label, of a file",
                .details = "`SELF` is the present file. Lines up to `label <label>` are skipped. After `next` has come "
                           "to the end of its variables,\nthe next `jump` does nothing: that is how loops end.\n",
                .example = "variable i loop 10\nlabel loop\nrun 100\nnext i\njump SELF loop",
            },
        .run = jump_run,
    },
    {
        .about =
            {
                .name = "label",
                .syntax = {"<name>", 1, 1, NULL},
                .summary = "A place that jump can go to",
                .details = "Without a jump to it the command does nothing.\n",
                .example = "label loop",
            },
        .run = label_run,
    },
    {
        .about =
            {
                .name = "next",
                .syntax = {"<variable> ...", 1, -1, NULL},
                .summary = "Give variables their next values",
                .details = "All must be of one style: `index`, `loop`, `file`, `atomfile`, or `universe` and `uloop`. "
                           "When one has no further value, all of them are deleted and the\nnext `jump` is skipped.\n",
                .example = "variable T index 0.7 0.8 0.9\nlabel loop\nprint \"T = $T\"\nnext T\njump SELF loop",
            },
        .run = next_run,
    },
    {
        .about =
            {
                .name = "if",
                .syntax = {"<condition> then \"command\" ... [elif <condition> \"command\" ...] [else \"command\" ...]",
                           0, -1, NULL},
                .summary = "Carry out commands only if a condition holds",
                .details =
                    "A condition compares numbers with `== != < <= > >=` and words with `==` and `!=`; `&& || |^ !` "
                    "and parentheses join\ncomparisons. A number alone holds unless it is 0. Arithmetic needs an "
                    "immediate variable: `$(v_a+1)`. Conditions with\nblanks, and commands, are quoted; a command that "
                    "itself holds quotes goes into the other kind. All branches are checked\nbefore anything runs.\n",
                .example = "if \"$(step) > 1000 && ${mode} == fast\" then \"timestep 0.01\" \"run 100\" else \"quit\"",
            },
        .run = if_run,
        .check = if_check,
    },
    {
        .about =
            {
                .name = "quit",
                .syntax = {"[status]", 0, 1, NULL},
                .summary = "End here",
                .details = "The program's exit code is `status`, 0 to 255 (default 0). What stands behind a `quit` "
                           "outside of `if` is not read, up to\nthe next `label`.\n",
                .example = "if \"$(v_error) > 0.1\" then \"quit 1\"",
            },
        .run = quit_run,
        .check = quit_check,
    },
    {
        .about =
            {
                .name = "clear",
                .syntax = {"", 0, 0, NULL},
                .summary = "Forget the simulation and start anew",
                .details = "Atoms, box, styles and settings go back to how they were at the start; variables, the log "
                           "and echo stay.\n",
                .example = "clear",
            },
        .run = clear_run,
    },
    {.about = {.name = NULL}},
};
