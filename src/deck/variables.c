#include "deck/variables.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"

const char *const hs_variable_styles[] = {"index",    "loop",  "string",   "format", "getenv",
                                          "equal",    "atom",  "internal", "file",   "vector",
                                          "atomfile", "world", "universe", "uloop",  NULL};

hs_status hs_variables_create(hs_variables **variables, hs_error *err) { return HS_ALLOC(*variables, 1, err); }

static void forget(hs_variable *variable)
{
    for (int i = 0; i < variable->n_values; ++i) HS_FREE(variable->value[i]);
    HS_FREE(variable->value);
    variable->n_values = 0;
    hs_formula_destroy(&variable->formula);
    hs_atomfile_destroy(&variable->atom_file);
}

static void destroy(hs_variable **variable)
{
    if (*variable == NULL) return;
    forget(*variable);
    HS_FREE((*variable)->name);
    HS_FREE(*variable);
}

void hs_variables_destroy(hs_variables **variables)
{
    if (*variables == NULL) return;
    for (int i = 0; i < (*variables)->n; ++i) destroy(&(*variables)->variable[i]);
    HS_FREE((*variables)->variable);
    HS_FREE(*variables);
}

hs_variable *hs_variables_find(const hs_variables *variables, const char *name)
{
    for (int i = 0; i < variables->n; ++i)
        if (strcmp(variables->variable[i]->name, name) == 0) return variables->variable[i];
    return NULL;
}

hs_status hs_variables_need(const hs_variables *variables, const char *name, hs_variable **variable, hs_error *err)
{
    *variable = hs_variables_find(variables, name);
    if (*variable != NULL) return HS_OK;
    enum { MAX = 256 };
    const char *names[MAX];
    size_t n = 0;
    for (int i = 0; i < variables->n && n < MAX; ++i) names[n++] = variables->variable[i]->name;
    const char *nearest = hs_text_nearest(name, names, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "there is no variable '%.80s'; did you mean '%s'?", name, nearest);
    return hs_fail(err, HS_ERROR_INPUT,
                   "there is no variable '%.80s': the command 'variable' or the option -var makes one", name);
}

static hs_status add(hs_variables *variables, const char *name, hs_variable_style style, hs_variable **variable,
                     hs_error *err)
{
    HS_TRY(HS_EXTEND(variables->variable, variables->n, variables->capacity, err));
    *variable = NULL;
    HS_TRY(HS_ALLOC(*variable, 1, err));
    hs_status status = hs_memory_strdup(&(*variable)->name, name, err);
    if (status != HS_OK) {
        HS_FREE(*variable);
        return status;
    }
    (*variable)->style = style;
    variables->variable[variables->n++] = *variable;
    return HS_OK;
}

static void remove_variable(hs_variables *variables, const char *name)
{
    for (int i = 0; i < variables->n; ++i) {
        if (strcmp(variables->variable[i]->name, name) != 0) continue;
        destroy(&variables->variable[i]);
        for (--variables->n; i < variables->n; ++i) variables->variable[i] = variables->variable[i + 1];
        return;
    }
}

static hs_status copy_values(hs_variable *variable, int n, const char *const *values, hs_error *err)
{
    HS_TRY(HS_ALLOC(variable->value, (size_t)n, err));
    for (; variable->n_values < n; ++variable->n_values)
        HS_TRY(hs_memory_strdup(&variable->value[variable->n_values], values[variable->n_values], err));
    return HS_OK;
}

hs_status hs_variables_set_index(hs_variables *variables, const char *name, int n, const char *const *values,
                                 hs_error *err)
{
    hs_variable *variable;
    HS_TRY(hs_name_check("variable", "name", name, err));
    if (n < 1) return hs_fail(err, HS_ERROR_INPUT, "-var %s: a value is missing", name);
    if (hs_variables_find(variables, name) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "-var %s: the variable is given twice", name);
    HS_TRY(add(variables, name, HS_VARIABLE_INDEX, &variable, err));
    return copy_values(variable, n, values, err);
}

hs_status hs_variables_restore(hs_variables *variables, const char *name, hs_variable **variable, hs_error *err)
{
    HS_TRY(hs_name_check("variable", "name", name, err));
    *variable = hs_variables_find(variables, name);
    return *variable != NULL ? HS_OK : add(variables, name, HS_VARIABLE_INTERNAL, variable, err);
}

/** What the formula of a variable is to give. */
static hs_value_shape shape_of(hs_variable_style style)
{
    return style == HS_VARIABLE_VECTOR ? HS_VALUE_VECTOR : style == HS_VARIABLE_ATOM ? HS_VALUE_ATOMS : HS_VALUE_NUMBER;
}

hs_status hs_variables_refill(hs_variable *variable, int n, const char *const *values, const char *formula,
                              hs_error *err)
{
    const int style = (int)variable->style;
    forget(variable);
    const bool has_list = style == HS_VARIABLE_INDEX || style == HS_VARIABLE_FILE || style == HS_VARIABLE_UNIVERSE;
    const bool has_text = style == HS_VARIABLE_STRING || style == HS_VARIABLE_GETENV || style == HS_VARIABLE_WORLD ||
                          style == HS_VARIABLE_ATOMFILE;
    const bool has_formula = style == HS_VARIABLE_EQUAL || style == HS_VARIABLE_VECTOR || style == HS_VARIABLE_ATOM;
    if (style < 0 || style >= HS_N_VARIABLE_STYLES || (has_list && (variable->which < 0 || variable->which >= n)) ||
        (has_formula && formula == NULL) || (has_text && n < 1) ||
        (style == HS_VARIABLE_FORMAT && (n < 2 || !hs_format_is_for_double(values[1]))))
        return hs_fail(err, HS_ERROR_INPUT, "the variable '%s' has no sound value", variable->name);
    if (n > 0) HS_TRY(copy_values(variable, n, values, err));
    if (formula == NULL) return HS_OK;
    return hs_formula_parse(&variable->formula, formula, shape_of((hs_variable_style)style), err);
}

static hs_status set_loop(hs_variable *variable, const hs_args *args, hs_error *err)
{
    int64_t n[2] = {1, 0};
    bool is_padded = strcmp(args->word[args->n - 1], "pad") == 0;
    int n_numbers = args->n - 2 - is_padded;
    HS_TRY(hs_arg_int(args, 2, 0, INT32_MAX, &n[n_numbers == 1 ? 1 : 0], err));
    if (n_numbers == 2) HS_TRY(hs_arg_int(args, 3, 0, INT32_MAX, &n[1], err));
    if (n[0] > n[1])
        return hs_fail(err, HS_ERROR_INPUT, "variable: a loop from %lld to %lld has no values", (long long)n[0],
                       (long long)n[1]);
    variable->first = variable->which = n[0];
    variable->last = n[1];
    variable->width = is_padded ? snprintf(NULL, 0, "%lld", (long long)n[1]) : 0;
    return HS_OK;
}

static hs_status set_formula(hs_variable *variable, const hs_args *args, hs_error *err)
{
    hs_formula *formula = NULL;
    HS_TRY(hs_formula_parse(&formula, args->word[2], shape_of(variable->style), err));
    hs_formula_destroy(&variable->formula);
    variable->formula = formula;
    return HS_OK;
}

/** Styles whose second definition is ignored, as in LAMMPS: this is how -var wins and how loops keep their place. */
static bool keeps_first(hs_variable_style style)
{
    return style == HS_VARIABLE_INDEX || style == HS_VARIABLE_LOOP || style == HS_VARIABLE_GETENV ||
           style == HS_VARIABLE_FILE || style == HS_VARIABLE_ATOMFILE || style == HS_VARIABLE_WORLD ||
           style == HS_VARIABLE_UNIVERSE || style == HS_VARIABLE_ULOOP;
}

/** Length of a list that `next` goes through; 0: it does not. */
static int64_t list_length(const hs_variable *variable)
{
    if (variable->style == HS_VARIABLE_LOOP || variable->style == HS_VARIABLE_ULOOP) return variable->last;
    return variable->style == HS_VARIABLE_INDEX || variable->style == HS_VARIABLE_UNIVERSE ? variable->n_values : 0;
}

/** LAMMPS's variables that several partitions of a machine take values from must have equally many. */
static bool is_shared(hs_variable_style style) { return style == HS_VARIABLE_UNIVERSE || style == HS_VARIABLE_ULOOP; }

static hs_status check_shared(const hs_variables *variables, const hs_variable *variable, hs_error *err)
{
    for (int i = 0; i < variables->n && is_shared(variable->style); ++i) {
        const hs_variable *other = variables->variable[i];
        if (is_shared(other->style) && list_length(other) != list_length(variable))
            return hs_fail(err, HS_ERROR_INPUT,
                           "variable: '%s' has %lld values and '%s' %lld: all universe and uloop variables must have "
                           "equally many; index and loop need not",
                           variable->name, (long long)list_length(variable), other->name,
                           (long long)list_length(other));
    }
    return HS_OK;
}

static hs_status fill_atoms(hs_deck *deck, hs_variable *variable, const hs_args *args, hs_error *err)
{
    bool is_there;
    HS_TRY(copy_values(variable, 1, args->word + 2, err));
    HS_TRY(hs_variables_join_atoms(deck->variables, &deck->sim->atoms, err));
    HS_TRY(hs_variable_read_atoms(variable, deck, &is_there, err));
    if (is_there) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "variable: the file '%s' has no values: every line is blank or a comment",
                   args->word[2]);
}

static hs_status fill(hs_deck *deck, hs_variable *variable, const hs_args *args, hs_error *err)
{
    switch (variable->style) {
    case HS_VARIABLE_LOOP:
    case HS_VARIABLE_ULOOP:
        return set_loop(variable, args, err);
    case HS_VARIABLE_ATOMFILE:
        return fill_atoms(deck, variable, args, err);
    case HS_VARIABLE_EQUAL:
    case HS_VARIABLE_VECTOR:
    case HS_VARIABLE_ATOM:
        return set_formula(variable, args, err);
    case HS_VARIABLE_INTERNAL:
        return hs_arg_double(args, 2, &variable->number, err);
    case HS_VARIABLE_FILE:
        return hs_variables_read_file(variable, args->word[2], deck, err);
    default:
        forget(variable);
        return copy_values(variable, args->n - 2, args->word + 2, err);
    }
}

hs_status hs_variables_define(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_variables *variables = deck->variables;
    HS_TRY(hs_variables_check(args, false, err));
    if (strcmp(args->word[1], "delete") == 0) {
        remove_variable(variables, args->word[0]);
        return HS_OK;
    }
    int style;
    HS_TRY(hs_arg_choice(args, 1, hs_variable_styles, &style, err));
    hs_variable *variable = hs_variables_find(variables, args->word[0]);
    if (variable != NULL) {
        if (keeps_first((hs_variable_style)style)) return HS_OK;
        if (variable->style != (hs_variable_style)style)
            return hs_fail(
                err, HS_ERROR_INPUT,
                "variable: '%s' exists as %s-style; 'variable %s delete' must come before it can be %s-style",
                variable->name, hs_variable_styles[variable->style], variable->name, hs_variable_styles[style]);
        if (variable->is_evaluating)
            return hs_fail(err, HS_ERROR_INPUT, "variable: '%s' cannot change while it is being evaluated",
                           variable->name);
        return fill(deck, variable, args, err);
    }
    HS_TRY(add(variables, args->word[0], (hs_variable_style)style, &variable, err));
    hs_status status = fill(deck, variable, args, err);
    if (status == HS_OK) status = check_shared(variables, variable, err);
    if (status != HS_OK) remove_variable(variables, args->word[0]);
    return status;
}

hs_status hs_variables_set_internal(hs_variables *variables, const char *name, double number, hs_error *err)
{
    hs_variable *variable;
    HS_TRY(hs_variables_need(variables, name, &variable, err));
    if (variable->style != HS_VARIABLE_INTERNAL)
        return hs_fail(err, HS_ERROR_INPUT, "the variable '%s' must be internal-style to be set", name);
    variable->number = number;
    return HS_OK;
}

static bool has_next(const hs_variable *variable)
{
    return list_length(variable) > 0 || variable->style == HS_VARIABLE_FILE || variable->style == HS_VARIABLE_ATOMFILE;
}

static hs_status check_next(const hs_variables *variables, const hs_args *args, hs_error *err)
{
    hs_variable_style style = HS_VARIABLE_INDEX;
    for (int i = 0; i < args->n; ++i) {
        hs_variable *variable;
        HS_TRY(hs_variables_need(variables, args->word[i], &variable, err));
        if (!has_next(variable))
            return hs_fail(err, HS_ERROR_INPUT,
                           "next: the variable '%s' is %s-style; only index, loop, file, atomfile, universe and uloop "
                           "have a next value",
                           variable->name, hs_variable_styles[variable->style]);
        if (i > 0 && variable->style != style && !(is_shared(variable->style) && is_shared(style)))
            return hs_fail(err, HS_ERROR_INPUT, "next: the variables '%s' and '%s' must have the same style",
                           args->word[0], args->word[i]);
        style = variable->style;
    }
    return HS_OK;
}

/** Go on to the next value; *is_there = false when there was none. */
static hs_status go_on(hs_deck *deck, hs_variable *variable, bool *is_there, hs_error *err)
{
    if (variable->style == HS_VARIABLE_ATOMFILE) return hs_variable_read_atoms(variable, deck, is_there, err);
    const bool is_loop = variable->style == HS_VARIABLE_LOOP || variable->style == HS_VARIABLE_ULOOP;
    *is_there = ++variable->which <= (is_loop ? variable->last : variable->n_values - 1);
    return HS_OK;
}

hs_status hs_variables_next(hs_deck *deck, const hs_args *args, bool *exhausted, hs_error *err)
{
    HS_TRY(check_next(deck->variables, args, err));
    *exhausted = false;
    for (int i = 0; i < args->n; ++i) {
        bool is_there;
        HS_TRY(go_on(deck, hs_variables_find(deck->variables, args->word[i]), &is_there, err));
        *exhausted = *exhausted || !is_there;
    }
    for (int i = 0; i < args->n && *exhausted; ++i) remove_variable(deck->variables, args->word[i]);
    return HS_OK;
}

hs_status hs_variables_go_on(hs_deck *deck, const char *name, hs_error *err)
{
    bool is_there;
    hs_variable *variable;
    HS_TRY(hs_variables_need(deck->variables, name, &variable, err));
    HS_TRY(go_on(deck, variable, &is_there, err));
    if (!is_there) remove_variable(deck->variables, name);
    return HS_OK;
}

void hs_variables_leave_atoms(hs_variables *variables)
{
    for (int i = variables->n - 1; i >= 0; --i)
        if (variables->variable[i]->style == HS_VARIABLE_ATOMFILE)
            remove_variable(variables, variables->variable[i]->name);
}
