/** What can be said about a `variable` command before any value is known. */
#include <string.h>

#include "deck/variables.h"

/** LAMMPS's other styles, each followed by why it is refused; ended by NULL. */
static const char *const refused_styles[] = {
    "python", "decks cannot run Python", "timer", "Halfshell times its phases itself; see the timing table of the log",
    NULL,
};

/** In the first pass a word with `$` may become anything; when the command runs it is what it is. */
static bool is_open(const char *word, bool first_pass) { return first_pass && strchr(word, '$') != NULL; }

static hs_status check_style(const hs_args *args, hs_error *err)
{
    const char *word = args->word[1];
    for (int i = 0; refused_styles[i] != NULL; i += 2)
        if (strcmp(word, refused_styles[i]) == 0)
            return hs_fail(err, HS_ERROR_INPUT, "variable: LAMMPS's style '%s' is not supported: %s", word,
                           refused_styles[i + 1]);
    int style;
    return hs_arg_choice(args, 1, hs_variable_styles, &style, err);
}

static hs_status check_count(const hs_args *args, int n_min, int n_max, const char *usage, hs_error *err)
{
    if (args->n - 2 >= n_min && (n_max < 0 || args->n - 2 <= n_max)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "variable: expected: variable <name> %s (a formula or text with blanks needs quotes)", usage);
}

/** world: LAMMPS gives each partition of the processors a value of its own. */
static hs_status check_world(const hs_args *args, hs_error *err)
{
    HS_TRY(check_count(args, 1, -1, "world <value>", err));
    if (args->n == 3) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "variable: world takes one value for each partition of the processors, and Halfshell has one: run "
                   "it once for each value, with 'variable %.80s index ...' and the option -var",
                   args->word[0]);
}

static hs_status check_uloop(const hs_args *args, hs_error *err)
{
    if (args->n == 3 || (args->n == 4 && strcmp(args->word[3], "pad") == 0)) return HS_OK;
    return check_count(args, 999, 0, "uloop <N> [pad]", err);
}

static hs_status check_loop(const hs_args *args, bool first_pass, hs_error *err)
{
    int n = args->n - 2;
    if (n > 0 && strcmp(args->word[args->n - 1], "pad") == 0) --n;
    if (n < 1 || n > 2) return check_count(args, 999, 0, "loop <N> [pad], or loop <N1> <N2> [pad]", err);
    int64_t first = 1, last = 0;
    for (int i = 0; i < n; ++i) {
        if (is_open(args->word[2 + i], first_pass)) return HS_OK;
        HS_TRY(hs_arg_int(args, 2 + i, 0, INT32_MAX, i == n - 1 ? &last : &first, err));
    }
    if (first <= last) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "variable: a loop from %lld to %lld has no values", (long long)first,
                   (long long)last);
}

static hs_status check_formula(const hs_args *args, hs_value_shape shape, bool first_pass, hs_error *err)
{
    static const char *const usage[] = {"equal <formula>", "vector <formula>", "atom <formula>"};
    HS_TRY(check_count(args, 1, 1, usage[shape], err));
    if (is_open(args->word[2], first_pass)) return HS_OK;
    hs_formula *formula = NULL;
    hs_status status = hs_formula_parse(&formula, args->word[2], shape, err);
    hs_formula_destroy(&formula);
    return status;
}

static hs_status check_format(const hs_args *args, bool first_pass, hs_error *err)
{
    HS_TRY(check_count(args, 2, 2, "format <variable> <format>", err));
    if (is_open(args->word[3], first_pass) || hs_format_is_for_double(args->word[3])) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "variable: the format '%.80s' must hold one conversion for a number, such as %%10.4f, %%.3e or %%g",
                   args->word[3]);
}

hs_status hs_variables_check(const hs_args *args, bool first_pass, hs_error *err)
{
    HS_TRY(hs_arg_need(args, 0, "the variable's name", err));
    HS_TRY(hs_arg_need(args, 1, "the variable's style", err));
    const char *name = args->word[0], *style = args->word[1];
    if (is_open(name, first_pass)) return HS_OK;
    HS_TRY(hs_name_check("variable", "name", name, err));
    if (is_open(style, first_pass)) return HS_OK;
    if (strcmp(style, "delete") == 0) return check_count(args, 0, 0, "delete", err);
    HS_TRY(check_style(args, err));
    /* An open word may become several words: nothing after it has a certain place. */
    for (int i = 2; i < args->n - 1; ++i)
        if (is_open(args->word[i], first_pass)) return HS_OK;
    if (args->n > 2 && is_open(args->word[2], first_pass) && args->n > 3) return HS_OK;
    if (strcmp(style, "index") == 0) return check_count(args, 1, -1, "index <value> ...", err);
    if (strcmp(style, "universe") == 0) return check_count(args, 1, -1, "universe <value> ...", err);
    if (strcmp(style, "world") == 0) return check_world(args, err);
    if (strcmp(style, "uloop") == 0) HS_TRY(check_uloop(args, err));
    if (strcmp(style, "loop") == 0 || strcmp(style, "uloop") == 0) return check_loop(args, first_pass, err);
    if (strcmp(style, "string") == 0) return check_count(args, 1, 1, "string <text>", err);
    if (strcmp(style, "getenv") == 0) return check_count(args, 1, 1, "getenv <environment variable>", err);
    if (strcmp(style, "file") == 0) return check_count(args, 1, 1, "file <file>", err);
    if (strcmp(style, "atomfile") == 0) return check_count(args, 1, 1, "atomfile <file>", err);
    if (strcmp(style, "internal") == 0) return check_count(args, 1, 1, "internal <number>", err);
    if (strcmp(style, "format") == 0) return check_format(args, first_pass, err);
    const hs_value_shape shape = strcmp(style, "atom") == 0     ? HS_VALUE_ATOMS
                                 : strcmp(style, "vector") == 0 ? HS_VALUE_VECTOR
                                                                : HS_VALUE_NUMBER;
    return check_formula(args, shape, first_pass, err);
}
