/* The values that variables have now, as numbers and texts. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "deck/variables.h"

/** Formulas within formulas: more would only end in the stack's overflow. */
enum { DEPTH_MAX = 100 };

/** Put "variable 'NAME': " before an error that was met while evaluating it. */
static void blame(hs_error *err, const char *name)
{
    char text[sizeof err->text];
    if (err->status == HS_OK || strncmp(err->text, "variable '", 10) == 0) return;
    snprintf(text, sizeof text, "%s", err->text);
    snprintf(err->text, sizeof err->text, "variable '%.80s': %.1900s", name, text);
}

/** Guard an evaluation against variables that use themselves. */
static hs_status enter(hs_variables *variables, hs_variable *variable, hs_error *err)
{
    if (variable->is_evaluating)
        return hs_fail(err, HS_ERROR_INPUT,
                       "variable '%s': its formula '%.400s' uses the variable itself, directly or through others",
                       variable->name,
                       variable->formula != NULL ? hs_formula_text(variable->formula) : variable->value[0]);
    if (variables->depth >= DEPTH_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "variable '%s': more than %d variables use one another in a chain",
                       variable->name, DEPTH_MAX);
    variable->is_evaluating = true;
    ++variables->depth;
    return HS_OK;
}

static void leave(hs_variables *variables, hs_variable *variable)
{
    variable->is_evaluating = false;
    --variables->depth;
}

/** Value of an equal-style formula, full precision. */
static hs_status eval_equal(hs_deck *deck, hs_variable *variable, double *value, hs_error *err)
{
    HS_TRY(enter(deck->variables, variable, err));
    hs_status status = hs_formula_value(variable->formula, deck, value, err);
    leave(deck->variables, variable);
    if (status != HS_OK) blame(err, variable->name);
    return status;
}

bool hs_format_is_for_double(const char *format)
{
    int n = 0;
    for (const char *at = format; *at != '\0'; ++at) {
        if (*at != '%') continue;
        if (*++at == '%') continue;
        at += strspn(at, "-+ #0");
        size_t width = strspn(at, "0123456789");
        at += width;
        size_t precision = 0;
        if (*at == '.') {
            precision = strspn(at + 1, "0123456789");
            at += 1 + precision;
        }
        if (width > 3 || precision > 3 || *at == '\0' || strchr("efgEFGaA", *at) == NULL) return false;
        ++n;
    }
    return n == 1;
}

static hs_status format_text(hs_deck *deck, hs_variable *variable, hs_text *text, hs_error *err)
{
    double value;
    HS_TRY(enter(deck->variables, variable, err));
    hs_status status = hs_variables_number(deck, variable->value[0], &value, err);
    if (status == HS_OK) status = hs_text_printf(text, err, variable->value[1], value);
    leave(deck->variables, variable);
    return status;
}

hs_status hs_variables_text(hs_deck *deck, const char *name, hs_text *text, hs_error *err)
{
    hs_variable *variable;
    double value;
    hs_text_clear(text);
    HS_TRY(hs_variables_need(deck->variables, name, &variable, err));
    switch (variable->style) {
    case HS_VARIABLE_INDEX:
    case HS_VARIABLE_UNIVERSE:
    case HS_VARIABLE_FILE:
        return hs_text_printf(text, err, "%s", variable->value[variable->which]);
    case HS_VARIABLE_LOOP:
    case HS_VARIABLE_ULOOP:
        return hs_text_printf(text, err, "%0*lld", variable->width, (long long)variable->which);
    case HS_VARIABLE_STRING:
    case HS_VARIABLE_WORLD:
        return hs_text_printf(text, err, "%s", variable->value[0]);
    case HS_VARIABLE_FORMAT:
        return format_text(deck, variable, text, err);
    case HS_VARIABLE_GETENV: {
        const char *found = getenv(variable->value[0]);
        return hs_text_printf(text, err, "%s", found != NULL ? found : "");
    }
    case HS_VARIABLE_EQUAL:
        HS_TRY(eval_equal(deck, variable, &value, err));
        return hs_text_printf(text, err, "%.15g", value);
    case HS_VARIABLE_INTERNAL:
        return hs_text_printf(text, err, "%.15g", variable->number);
    case HS_VARIABLE_VECTOR:
        return hs_fail(
            err, HS_ERROR_INPUT,
            "the variable '%s' is vector-style: it has several values and no text; $(v_%s[1]) is that of its "
            "first element",
            variable->name, variable->name);
    default:
        return hs_fail(err, HS_ERROR_INPUT, "the variable '%s' is %s-style: it has one value per atom and no text",
                       variable->name, hs_variable_styles[variable->style]);
    }
}

hs_status hs_variables_rounded(hs_deck *deck, const char *name, double *value, hs_error *err)
{
    const hs_variable *variable = hs_variables_find(deck->variables, name);
    if (variable != NULL && variable->style == HS_VARIABLE_INTERNAL) {
        *value = variable->number;
        return HS_OK;
    }
    hs_text text = {0};
    hs_status status = hs_variables_text(deck, name, &text, err);
    const char *word = hs_text_get(&text);
    while (isspace((unsigned char)*word)) ++word;
    if (status == HS_OK && !hs_text_to_double(word, value))
        status = hs_fail(err, HS_ERROR_INPUT, "the value '%.80s' of the variable '%s' is not a number",
                         hs_text_get(&text), name);
    hs_text_fini(&text);
    return status;
}

hs_status hs_variables_number(hs_deck *deck, const char *name, double *value, hs_error *err)
{
    hs_variable *variable;
    HS_TRY(hs_variables_need(deck->variables, name, &variable, err));
    if (variable->style == HS_VARIABLE_EQUAL) return eval_equal(deck, variable, value, err);
    return hs_variables_rounded(deck, name, value, err);
}

hs_status hs_variables_length(hs_deck *deck, const char *name, bool refresh, int *length, bool *varies, hs_error *err)
{
    hs_variable *variable;
    *length = 0;
    *varies = false;
    HS_TRY(hs_variables_need(deck->variables, name, &variable, err));
    if (variable->style != HS_VARIABLE_VECTOR) return HS_OK;
    HS_TRY(enter(deck->variables, variable, err));
    const hs_status status = hs_formula_length(variable->formula, deck, refresh, length, varies, err);
    leave(deck->variables, variable);
    if (status != HS_OK) blame(err, variable->name);
    return status;
}

hs_status hs_variables_vector(hs_deck *deck, const char *name, int length, double *values, hs_error *err)
{
    hs_variable *variable;
    HS_TRY(hs_variables_need(deck->variables, name, &variable, err));
    if (variable->style != HS_VARIABLE_VECTOR)
        return hs_fail(err, HS_ERROR_INPUT, "the variable '%s' is %s-style: it has no vector", variable->name,
                       hs_variable_styles[variable->style]);
    HS_TRY(enter(deck->variables, variable, err));
    const hs_status status = hs_formula_vector(variable->formula, deck, length, values, err);
    leave(deck->variables, variable);
    if (status != HS_OK) blame(err, variable->name);
    return status;
}

typedef hs_status (*atoms_evaluation)(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err);

static hs_status eval_atoms(hs_deck *deck, const char *name, atoms_evaluation evaluate, double *values, hs_error *err)
{
    hs_variable *variable;
    HS_TRY(hs_variables_need(deck->variables, name, &variable, err));
    if (variable->style == HS_VARIABLE_ATOMFILE) {
        const size_t n = (size_t)deck->sim->atoms.n_local;
        if (n > 0) memcpy(values, hs_variable_atom_values(variable), n * sizeof *values);
        return HS_OK;
    }
    if (variable->style != HS_VARIABLE_ATOM) {
        double value;
        HS_TRY(hs_variables_number(deck, name, &value, err));
        for (int i = 0; i < deck->sim->atoms.n_local; ++i) values[i] = value;
        return HS_OK;
    }
    HS_TRY(hs_sim_need_box(deck->sim, "atom-style variables", err));
    HS_TRY(enter(deck->variables, variable, err));
    hs_status status = evaluate(variable->formula, deck, values, err);
    leave(deck->variables, variable);
    if (status != HS_OK) blame(err, variable->name);
    return status;
}

hs_status hs_variables_atoms(hs_deck *deck, const char *name, double *values, hs_error *err)
{
    return eval_atoms(deck, name, hs_formula_atoms, values, err);
}

hs_status hs_variables_atoms_within(hs_deck *deck, const char *name, double *values, hs_error *err)
{
    return eval_atoms(deck, name, hs_formula_atoms_within, values, err);
}
