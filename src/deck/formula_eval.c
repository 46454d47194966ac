/** Evaluation of formulas: node by node, operands first. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "deck/formula_nodes.h"
#include "deck/variables.h"
#include "sim/thermo.h"
#include "style/value.h"

/** Value of a node: one number, or one for every local atom. */
typedef struct result {
    double number;
    double *array; /**< owned [n_local]; NULL: one number */
} result;

double hs_formula_attribute(const hs_sim *sim, int attribute, int i)
{
    const hs_atoms *atoms = &sim->atoms;
    switch (attribute) {
    case 0:
        return (double)atoms->id[i];
    case 1:
        return hs_atom_mass(atoms, i);
    case 2:
        return (double)atoms->type[i];
    case 3:
    case 4:
    case 5:
        return atoms->x[attribute - 3][i];
    case 6:
    case 7:
    case 8:
        return atoms->v[attribute - 6][i];
    default:
        return atoms->f[attribute - 9][i];
    }
}

/** Whether a comparison or a logical operation holds. */
static bool holds(hs_node_kind kind, double a, double b)
{
    switch (kind) {
    case HS_NODE_EQUAL:
        return a == b;
    case HS_NODE_NOT_EQUAL:
        return a != b;
    case HS_NODE_LESS:
        return a < b;
    case HS_NODE_LESS_EQUAL:
        return a <= b;
    case HS_NODE_GREATER:
        return a > b;
    case HS_NODE_GREATER_EQUAL:
        return a >= b;
    case HS_NODE_AND:
        return a != 0.0 && b != 0.0;
    case HS_NODE_OR:
        return a != 0.0 || b != 0.0;
    default: /* HS_NODE_XOR */
        return (a != 0.0) != (b != 0.0);
    }
}

static hs_status apply_binary(const hs_formula *formula, hs_node_kind kind, double a, double b, double *value,
                              hs_error *err)
{
    switch (kind) {
    case HS_NODE_ADD:
        *value = a + b;
        break;
    case HS_NODE_SUBTRACT:
        *value = a - b;
        break;
    case HS_NODE_MULTIPLY:
        *value = a * b;
        break;
    case HS_NODE_DIVIDE:
        if (b == 0.0) return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': division by zero", formula->text);
        *value = a / b;
        break;
    case HS_NODE_MODULO:
        if (b == 0.0) return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': modulo (%%) by zero", formula->text);
        *value = fmod(a, b);
        break;
    case HS_NODE_POWER:
        if (a == 0.0 && b < 0.0)
            return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': 0 to the negative power %g", formula->text, b);
        if (a < 0.0 && b != floor(b))
            return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': the negative number %g to the broken power %g",
                           formula->text, a, b);
        *value = b == 0.0 ? 1.0 : pow(a, b);
        break;
    case HS_NODE_EQUAL:
    case HS_NODE_NOT_EQUAL:
    case HS_NODE_LESS:
    case HS_NODE_LESS_EQUAL:
    case HS_NODE_GREATER:
    case HS_NODE_GREATER_EQUAL:
    case HS_NODE_AND:
    case HS_NODE_OR:
    case HS_NODE_XOR:
        *value = holds(kind, a, b);
        break;
    default:
        return hs_fail(err, HS_ERROR_RUN, "formula '%.400s': no such operator %d", formula->text, (int)kind);
    }
    return HS_OK;
}

/** Value of an operation on numbers. */
static hs_status apply(const hs_formula *formula, const hs_node *node, const double *arg, const hs_call *place,
                       double *value, hs_error *err)
{
    if (node->kind == HS_NODE_NEGATE) {
        *value = -arg[0];
    } else if (node->kind == HS_NODE_NOT) {
        *value = arg[0] == 0.0;
    } else if (node->kind == HS_NODE_FUNCTION) {
        hs_call call = *place;
        call.function = node->function;
        call.arg = arg;
        HS_TRY(node->function->eval(&call, value, err));
    } else {
        HS_TRY(apply_binary(formula, node->kind, arg[0], arg[1], value, err));
    }
    if (isfinite(*value)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': a result is too large for a number (not finite)",
                   formula->text);
}

/** Numbers of a random function for all atoms: between runs *drawn, during runs *draw, from which they follow. */
static hs_status draw_numbers(const hs_node *node, hs_deck *deck, const result *results, int64_t *draw,
                              const double **drawn, hs_error *err)
{
    const result *seed = &results[node->arg[node->n_args - 1]];
    int whole;
    if (seed->array != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the seed must be one number, not one for each atom",
                       node->function->usage);
    HS_TRY(hs_random_seed(node->function, seed->number, &whole, err));
    if (!deck->is_running) return hs_atom_draws_next(deck->variables->draws, deck, seed->number, drawn, err);
    *draw = deck->variables->n_draws++;
    return HS_OK;
}

/** An operation whose operands are known; per atom as soon as one operand is. */
static hs_status eval_operation(const hs_formula *formula, const hs_node *node, hs_deck *deck, bool per_atom,
                                result *results, result *out, hs_error *err)
{
    double arg[HS_FUNCTION_ARGS_MAX];
    const bool is_random = per_atom && node->kind == HS_NODE_FUNCTION && node->function->draws != HS_DRAWS_NOTHING;
    hs_call place = {.deck = deck};
    bool has_array = is_random;
    for (int a = 0; a < node->n_args; ++a) {
        arg[a] = results[node->arg[a]].number;
        has_array = has_array || results[node->arg[a]].array != NULL;
    }
    if (!has_array) return apply(formula, node, arg, &place, &out->number, err);
    const hs_atoms *atoms = &deck->sim->atoms;
    const double *drawn = NULL;
    if (is_random) HS_TRY(draw_numbers(node, deck, results, &place.draw, &drawn, err));
    hs_status status = HS_ALLOC(out->array, (size_t)atoms->n_local, err);
    for (int i = 0; i < atoms->n_local && status == HS_OK; ++i) {
        for (int a = 0; a < node->n_args; ++a)
            if (results[node->arg[a]].array != NULL) arg[a] = results[node->arg[a]].array[i];
        place.atom = is_random ? atoms->id[i] : 0;
        place.drawn = drawn != NULL ? &drawn[i] : NULL;
        status = apply(formula, node, arg, &place, &out->array[i], err);
    }
    /* One rank's atom may be the only one that fails: all must stop before the next collective call. */
    return hs_parallel_agree(&deck->sim->parallel, err);
}

/** The value of one atom, by its ID, from the rank that owns it. @p name is for messages. */
static hs_status find_atom(const hs_sim *sim, double id, const double *values, const char *name, double *value,
                           hs_error *err)
{
    double found[2] = {0.0, 0.0};
    for (int i = 0; i < sim->atoms.n_local; ++i) {
        if ((double)sim->atoms.id[i] != id) continue;
        found[0] = 1.0;
        found[1] = values[i];
    }
    hs_parallel_sum_double(&sim->parallel, found, 2);
    *value = found[1];
    if (found[0] == 1.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s[%.15g]: there is no atom of that ID", name, id);
}

/** c_ID[i] of a value per atom, or c_ID[i][j] of column j: atom i's. */
static hs_status eval_atom_reference(hs_env *env, const hs_sim *sim, const hs_value *reference, double *value,
                                     hs_error *err)
{
    hs_value column = *reference;
    column.n_indices = reference->n_indices - 1;
    column.index[0] = reference->index[1];
    double *values;
    HS_TRY(HS_ALLOC(values, (size_t)sim->atoms.n_local, err));
    hs_status status = hs_value_atoms(env, &column, values, err);
    if (status == HS_OK) status = find_atom(sim, (double)reference->index[0], values, reference->id, value, err);
    HS_FREE(values);
    return status;
}

/** c_ID and f_ID with their indices. In LAMMPS's order: the global value, the value of one atom, the values per
 *  atom. */
static hs_status eval_reference(const hs_formula *formula, const hs_node *node, hs_deck *deck, bool per_atom,
                                const result *results, result *out, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_env *env = &sim->env;
    char word[160];
    hs_value value = {.kind = node->kind == HS_NODE_COMPUTE ? 'c'
                              : node->kind == HS_NODE_FIX   ? 'f'
                                                            : (char)node->attribute,
                      .id = node->text,
                      .n_indices = node->n_args};
    int length = snprintf(word, sizeof word, "%c_%.80s", value.kind, node->text);
    value.word = word;
    for (int k = 0; k < node->n_args; ++k) {
        const double index = results[node->arg[k]].number;
        length += snprintf(word + length, sizeof word - (size_t)length, "[%.0f]", index);
        if (!(index >= 1.0 && index <= 0x1p53))
            return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': %s: indices count from 1", formula->text, word);
        value.index[k] = (int64_t)index;
    }
    if (hs_value_has(env, &value, HS_VALUE_NUMBER)) return hs_value_number(env, &value, &out->number, err);
    hs_value column = value;
    column.n_indices = node->n_args - 1;
    column.index[0] = value.index[1];
    if (node->n_args > 0 && hs_value_has(env, &column, HS_VALUE_ATOMS))
        return eval_atom_reference(env, sim, &value, &out->number, err);
    if (!per_atom || !hs_value_has(env, &value, HS_VALUE_ATOMS)) {
        if (!per_atom && hs_value_has(env, &value, HS_VALUE_ATOMS))
            return hs_fail(err, HS_ERROR_INPUT,
                           "formula '%.400s': %s has one value per atom: only atom-style variables may use it (%s[ID] "
                           "is that of one atom)",
                           formula->text, word, word);
        return hs_value_check(env, &value, HS_VALUE_NUMBER, "formula", err);
    }
    HS_TRY(HS_ALLOC(out->array, (size_t)sim->atoms.n_local, err));
    return hs_value_atoms(env, &value, out->array, err);
}

static hs_status eval_keyword(const hs_node *node, hs_deck *deck, double *value, hs_error *err)
{
    static const char *const without_box[] = {"step", "dt", "time", "cpu", "atoms"};
    bool needs_box = true, found = false;
    for (size_t i = 0; i < sizeof without_box / sizeof without_box[0]; ++i)
        if (strcmp(node->text, without_box[i]) == 0) needs_box = false;
    if (needs_box && !deck->sim->box.exists)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the thermo keyword '%s' has no value before the box exists (create_box, read_data)",
                       node->text);
    HS_TRY(hs_thermo_keyword(deck->sim->thermo, node->text, value, &found, err));
    if (!found) return hs_fail(err, HS_ERROR_INPUT, "the thermo keyword '%s' has no value", node->text);
    return HS_OK;
}

/** x[ID]: the rank that owns the atom tells the others. */
static hs_status eval_atom_value(const hs_node *node, hs_deck *deck, const result *results, double *value,
                                 hs_error *err)
{
    const hs_sim *sim = deck->sim;
    double *values;
    HS_TRY(HS_ALLOC(values, (size_t)sim->atoms.n_local, err));
    for (int i = 0; i < sim->atoms.n_local; ++i) values[i] = hs_formula_attribute(sim, node->attribute, i);
    hs_status status =
        find_atom(sim, results[node->arg[0]].number, values, hs_formula_attributes[node->attribute], value, err);
    HS_FREE(values);
    return status;
}

static hs_status eval_attribute(const hs_node *node, const hs_sim *sim, result *out, hs_error *err)
{
    HS_TRY(HS_ALLOC(out->array, (size_t)sim->atoms.n_local, err));
    for (int i = 0; i < sim->atoms.n_local; ++i) out->array[i] = hs_formula_attribute(sim, node->attribute, i);
    return HS_OK;
}

/** v_name[ID]: the value of one atom. */
static hs_status eval_atom_of_variable(const hs_node *node, hs_deck *deck, double id, double *value, hs_error *err)
{
    const hs_variable *variable = hs_variables_find(deck->variables, node->text);
    double *values;
    if (variable == NULL) return hs_variables_rounded(deck, node->text, value, err); /* which names the nearest */
    if (variable->style != HS_VARIABLE_ATOM)
        return hs_fail(err, HS_ERROR_INPUT,
                       "v_%s[...]: the variable has a single value; atom-style ones have one for each atom",
                       node->text);
    HS_TRY(HS_ALLOC(values, (size_t)deck->sim->atoms.n_local + 1, err));
    hs_status status = hs_variables_atoms(deck, node->text, values, err);
    if (status == HS_OK) status = find_atom(deck->sim, id, values, node->text, value, err);
    HS_FREE(values);
    return status;
}

static hs_status eval_variable(const hs_node *node, hs_deck *deck, bool per_atom, const result *results, result *out,
                               hs_error *err)
{
    const hs_variable *variable = hs_variables_find(deck->variables, node->text);
    if (node->n_args > 0) return eval_atom_of_variable(node, deck, results[node->arg[0]].number, &out->number, err);
    if (variable == NULL || variable->style != HS_VARIABLE_ATOM)
        return hs_variables_rounded(deck, node->text, &out->number, err);
    if (!per_atom)
        return hs_fail(err, HS_ERROR_INPUT,
                       "v_%s is an atom-style variable: it has one value per atom, and this formula needs one number",
                       node->text);
    HS_TRY(HS_ALLOC(out->array, (size_t)deck->sim->atoms.n_local, err));
    return hs_variables_atoms_within(deck, node->text, out->array, err);
}

static hs_status eval_words(const hs_node *node, hs_deck *deck, result *out, hs_error *err)
{
    const hs_word_function *function = node->words_of;
    if (function->value != NULL) return function->value(deck, node, &out->number, err);
    HS_TRY(HS_ALLOC(out->array, (size_t)deck->sim->atoms.n_local, err));
    return function->atoms(deck, node, out->array, err);
}

static hs_status eval_node(const hs_formula *formula, int n, hs_deck *deck, bool per_atom, result *results,
                           hs_error *err)
{
    const hs_node *node = &formula->node[n];
    result *out = &results[n];
    switch (node->kind) {
    case HS_NODE_NUMBER:
        out->number = node->number;
        return HS_OK;
    case HS_NODE_VARIABLE:
        return eval_variable(node, deck, per_atom, results, out, err);
    case HS_NODE_COMPUTE:
    case HS_NODE_FIX:
    case HS_NODE_CUSTOM:
        return eval_reference(formula, node, deck, per_atom, results, out, err);
    case HS_NODE_KEYWORD:
        return eval_keyword(node, deck, &out->number, err);
    case HS_NODE_ATTRIBUTE:
        return eval_attribute(node, deck->sim, out, err);
    case HS_NODE_ATOM_VALUE:
        return eval_atom_value(node, deck, results, &out->number, err);
    case HS_NODE_GROUP:
    case HS_NODE_SPECIAL:
        return eval_words(node, deck, out, err);
    default:
        return eval_operation(formula, node, deck, per_atom, results, out, err);
    }
}

/** Evaluate all nodes; values is NULL for a single number. */
static hs_status evaluate(const hs_formula *formula, hs_deck *deck, double *number, double *values, hs_error *err)
{
    result *results = NULL;
    HS_TRY(HS_ALLOC(results, (size_t)formula->n_nodes, err));
    hs_status status = HS_OK;
    for (int n = 0; n < formula->n_nodes && status == HS_OK; ++n) {
        status = eval_node(formula, n, deck, values != NULL, results, err);
        /* An operand serves one node only: its array can go. */
        for (int a = 0; a < formula->node[n].n_args; ++a) HS_FREE(results[formula->node[n].arg[a]].array);
    }
    const result *last = &results[formula->n_nodes - 1];
    if (status == HS_OK && values == NULL) *number = last->number;
    if (status == HS_OK && values != NULL)
        for (int i = 0; i < deck->sim->atoms.n_local; ++i)
            values[i] = last->array != NULL ? last->array[i] : last->number;
    for (int n = 0; n < formula->n_nodes; ++n) HS_FREE(results[n].array);
    HS_FREE(results);
    return status;
}

hs_status hs_formula_value(const hs_formula *formula, hs_deck *deck, double *value, hs_error *err)
{
    return evaluate(formula, deck, value, NULL, err);
}

hs_status hs_formula_atoms_within(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err)
{
    /* On a rank without atoms the caller's array may be NULL, which would mean a single number. */
    double nothing;
    return evaluate(formula, deck, NULL, values != NULL ? values : &nothing, err);
}

hs_status hs_formula_atoms(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err)
{
    hs_atom_draws draws = {0}, *outer = deck->variables->draws;
    hs_status status = hs_atom_draws_init(&draws, formula, deck, err);
    deck->variables->draws = &draws;
    if (status == HS_OK) status = hs_formula_atoms_within(formula, deck, values, err);
    deck->variables->draws = outer;
    hs_atom_draws_fini(&draws);
    return status;
}

hs_status hs_formula_once(hs_deck *deck, const char *text, double *value, hs_error *err)
{
    hs_formula *formula = NULL;
    HS_TRY(hs_formula_parse(&formula, text, false, err));
    hs_status status = hs_formula_value(formula, deck, value, err);
    hs_formula_destroy(&formula);
    return status;
}
