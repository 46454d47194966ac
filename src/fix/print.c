/* Prints a line of text every so many steps. */
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "style/varying.h"

typedef struct print_state {
    int64_t every;
    char *every_variable; /**< owned; variable that gives the next step; NULL: every steps */
    int64_t next;
    char *words; /**< owned; the text, its variables not replaced yet */
    bool to_screen;
    hs_average_file file;
} print_state;

static const hs_keyword keywords[] = {
    {"file", 1, "<output-file>", "write the lines to this file, too"},
    {"append", 1, "<output-file>", "the same, added to what is there"},
    {"screen", 1, "yes|no", "whether screen and log show the lines (default: yes)"},
    {"title", 1, "<text>", "first line of the file (default: '# Fix print output for fix ID')"},
    {NULL, 0, NULL, NULL},
};

static hs_status set_text(char **text, const char *word, hs_error *err)
{
    HS_FREE(*text);
    return hs_memory_strdup(text, word, err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    print_state *state = fix->state;
    state->to_screen = true;
    if (strncmp(args->word[0], "v_", 2) == 0)
        HS_TRY(set_text(&state->every_variable, args->word[0] + 2, err));
    else
        HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    if (state->every > INT64_MAX / 4) state->every = INT64_MAX / 4; /* never: the step after next must be a number */
    HS_TRY(set_text(&state->words, args->word[1], err));
    for (int i = 2; i + 1 < args->n; i += 2) {
        const char *keyword = args->word[i], *value = args->word[i + 1];
        if (strcmp(keyword, "screen") == 0) {
            HS_TRY(hs_arg_bool(args, i + 1, &state->to_screen, err));
        } else if (strcmp(keyword, "title") == 0) {
            HS_TRY(set_text(&state->file.title[0], value, err));
        } else {
            state->file.mode = keyword[0] == 'a' ? HS_WRITE_APPEND : HS_WRITE_REPLACE;
            HS_TRY(set_text(&state->file.name, value, err));
        }
    }
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    print_state *state = fix->state;
    HS_FREE(state->every_variable);
    HS_FREE(state->words);
    hs_average_file_fini(&state->file);
}

/** Ask the variable for the next step. */
static hs_status find_next(hs_fix *fix, hs_error *err)
{
    print_state *state = fix->state;
    const hs_env *env = fix->env;
    if (state->every_variable == NULL) {
        state->next = env->step + state->every - env->step % state->every;
        return HS_OK;
    }
    return hs_next_step(env, state->every_variable, hs_fix_who(fix).text, "line", &state->next, err);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    print_state *state = fix->state;
    const hs_env *env = fix->env;
    char title[160];
    if (env->substitute == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no deck whose variables it could print",
                       hs_fix_who(fix).text);
    if (state->every_variable != NULL) HS_TRY(hs_fix_need_equal_style(fix, state->every_variable, err));
    if (state->every_variable == NULL && env->step % state->every == 0)
        state->next = env->step;
    else
        HS_TRY(find_next(fix, err));
    snprintf(title, sizeof title, "# Fix print output for fix %.100s", fix->id);
    const char *const head[3] = {title, NULL, NULL};
    return hs_average_file_open(&state->file, env, head, err);
}

/** Whether the step is one of a line; a run without set-up (`pre no`) begins behind one. */
static bool is_due(const print_state *state, int64_t step)
{
    return state->every_variable != NULL ? step == state->next : step % state->every == 0;
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const print_state *state = fix->state;
    return is_due(state, step) && strchr(state->words, '$') != NULL;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    print_state *state = fix->state;
    const hs_env *env = fix->env;
    if (!is_due(state, env->step)) return HS_OK;
    hs_text line = {0};
    hs_status status = hs_text_append(&line, state->words, strlen(state->words), err);
    if (status == HS_OK) status = env->substitute(env->deck, &line, err);
    if (status == HS_OK && state->to_screen) {
        hs_progress_wipe(env->out);
        hs_say(env->out, "%s\n", hs_text_get(&line));
    }
    if (status == HS_OK && hs_average_file_is_open(&state->file))
        status = hs_text_printf(&state->file.text, err, "%s\n", hs_text_get(&line));
    hs_text_fini(&line);
    HS_TRY(status);
    HS_TRY(hs_average_file_commit(&state->file, env, err));
    return find_next(fix, err);
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    print_state *state = fix->state;
    HS_TRY(hs_state_int64(kept, "next line", &state->next, 1, err));
    return hs_average_file_keep(&state->file, fix->env, kept, err);
}

const hs_fix_style hs_fix_style_print = {
    .about =
        {.name = "print",
         .syntax = {.usage = "<N> \"<text>\" [keyword value ...]", .n_min = 2, .n_max = 2, .keywords = keywords},
         .summary = "print a line of text every N steps",
         .details = "At steps that are multiples of N, and at the start of a run if that is one, the text is printed "
                    "with its variables replaced: `$x`, `${name}`, `$(formula)` and `$(formula:%format)` have their "
                    "values of that step. Quotes keep them from being replaced when the deck is read. In the place of "
                    "N, `v_name` is an equal-style variable that gives the next step to print at, for example "
                    "`stride(100,1000,50)` or `logfreq(10,3,10)`. The group has no meaning.",
         .example =
             "variable t equal temp\nfix say all print 100 \"T = $t, pressure $(press:%.4f)\" file said.txt screen no"},
    .state_size = sizeof(print_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .measure_at_setup = end_of_step,
    .end_of_step = end_of_step,
    .needs_energy = needs_energy,
    .keep_state = keep_state,
    .is_time_dependent = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
