/** Evaluation of formulas: node by node, operands first. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "deck/formula_nodes.h"
#include "deck/variables.h"
#include "sim/thermo.h"
#include "style/value.h"

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
static hs_status draw_numbers(const hs_evaluation *e, const hs_node *node, int64_t *draw, const double **drawn,
                              hs_error *err)
{
    hs_deck *deck = e->deck;
    const hs_formula_result *seed = &e->results[node->arg[node->n_args - 1]];
    int whole;
    if (seed->array != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the seed must be one number, not one for each atom",
                       node->function->usage);
    HS_TRY(hs_random_seed(node->function, seed->number, &whole, err));
    if (!deck->is_running) return hs_atom_draws_next(deck->variables->draws, deck, seed->number, drawn, err);
    *draw = deck->variables->n_draws++;
    return HS_OK;
}

/** Length of the arrays among an operation's operands; -1: all are numbers. Vectors must be equally long. */
static hs_status operand_length(const hs_evaluation *e, const hs_node *node, int *n, hs_error *err)
{
    *n = -1;
    for (int a = 0; a < node->n_args; ++a) {
        const hs_formula_result *operand = &e->results[node->arg[a]];
        if (operand->array == NULL) continue;
        if (*n >= 0 && *n != operand->n)
            return hs_fail(err, HS_ERROR_INPUT,
                           "formula '%.400s': vectors of %d and of %d elements: they must be equally long",
                           e->formula->text, *n, operand->n);
        *n = operand->n;
    }
    return HS_OK;
}

/** The next random number for an element of a vector: of the generator that atoms have between runs, as in LAMMPS. All
 *  ranks draw the same. */
static hs_status draw_for_element(const hs_evaluation *e, const hs_node *node, double seed, double *number,
                                  hs_error *err)
{
    hs_marsaglia *generator = &e->deck->variables->atom_generator;
    int whole;
    HS_TRY(hs_random_seed(node->function, seed, &whole, err));
    if (!generator->is_seeded) hs_marsaglia_init(generator, whole);
    *number =
        node->function->draws == HS_DRAWS_NORMAL ? hs_marsaglia_gaussian(generator) : hs_marsaglia_uniform(generator);
    return HS_OK;
}

/** An operation whose operands are known; per atom, or element by element, as soon as one operand is. */
static hs_status eval_operation(const hs_evaluation *e, const hs_node *node, hs_formula_result *out, hs_error *err)
{
    double arg[HS_FUNCTION_ARGS_MAX], number;
    const hs_atoms *atoms = &e->deck->sim->atoms;
    const bool is_per_atom = e->shape == HS_VALUE_ATOMS, is_random = e->shape != HS_VALUE_NUMBER &&
                                                                     node->kind == HS_NODE_FUNCTION &&
                                                                     node->function->draws != HS_DRAWS_NOTHING;
    hs_call place = {.deck = e->deck};
    int n;
    HS_TRY(operand_length(e, node, &n, err));
    if (is_random) n = e->length;
    for (int a = 0; a < node->n_args; ++a) arg[a] = e->results[node->arg[a]].number;
    if (n < 0) return apply(e->formula, node, arg, &place, &out->number, err);
    const double *drawn = NULL;
    if (is_random && is_per_atom) HS_TRY(draw_numbers(e, node, &place.draw, &drawn, err));
    hs_status status = hs_formula_make_array(out, n, err);
    for (int i = 0; i < n && status == HS_OK; ++i) {
        for (int a = 0; a < node->n_args; ++a)
            if (e->results[node->arg[a]].array != NULL) arg[a] = e->results[node->arg[a]].array[i];
        place.atom = is_random && is_per_atom ? atoms->id[i] : 0;
        place.drawn = drawn != NULL ? &drawn[i] : NULL;
        if (is_random && !is_per_atom) {
            place.drawn = &number;
            status = draw_for_element(e, node, arg[node->n_args - 1], &number, err);
        }
        if (status == HS_OK) status = apply(e->formula, node, arg, &place, &out->array[i], err);
    }
    /* One rank's atom may be the only one that fails: all must stop before the next collective call. */
    return hs_parallel_agree(&e->deck->sim->parallel, err);
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

static hs_status eval_attribute(const hs_node *node, const hs_sim *sim, hs_formula_result *out, hs_error *err)
{
    HS_TRY(hs_formula_make_array(out, sim->atoms.n_local, err));
    for (int i = 0; i < sim->atoms.n_local; ++i) out->array[i] = hs_formula_attribute(sim, node->attribute, i);
    return HS_OK;
}

static hs_status eval_words(const hs_evaluation *e, const hs_node *node, hs_formula_result *out, hs_error *err)
{
    const hs_word_function *function = node->words_of;
    const bool is_per_atom = function->value == NULL || (e->shape == HS_VALUE_ATOMS && function->atoms != NULL);
    if (!is_per_atom) return function->value(e->deck, node, &out->number, err);
    HS_TRY(hs_formula_make_array(out, e->deck->sim->atoms.n_local, err));
    return function->atoms(e->deck, node, out->array, err);
}

static hs_status eval_node(const hs_evaluation *e, int n, hs_error *err)
{
    const hs_node *node = &e->formula->node[n];
    hs_formula_result *out = &e->results[n];
    switch (node->kind) {
    case HS_NODE_NUMBER:
        out->number = node->number;
        return HS_OK;
    case HS_NODE_VARIABLE:
        return hs_formula_eval_variable(e, node, out, err);
    case HS_NODE_COMPUTE:
    case HS_NODE_FIX:
    case HS_NODE_CUSTOM:
        return hs_formula_eval_reference(e, node, out, err);
    case HS_NODE_KEYWORD:
        return eval_keyword(node, e->deck, &out->number, err);
    case HS_NODE_ATTRIBUTE:
        return eval_attribute(node, e->deck->sim, out, err);
    case HS_NODE_ATOM_VALUE:
        return hs_formula_eval_atom_value(e, node, &out->number, err);
    case HS_NODE_GROUP:
    case HS_NODE_SPECIAL:
        return eval_words(e, node, out, err);
    default:
        return eval_operation(e, node, out, err);
    }
}

/** Evaluate all nodes. @p length: of values; in the shape HS_VALUE_NUMBER *values is the number. */
static hs_status evaluate(const hs_formula *formula, hs_deck *deck, hs_value_shape shape, int length, double *values,
                          hs_error *err)
{
    hs_evaluation e = {.formula = formula, .deck = deck, .shape = shape, .length = length};
    HS_TRY(HS_ALLOC(e.results, (size_t)formula->n_nodes, err));
    hs_status status = HS_OK;
    for (int n = 0; n < formula->n_nodes && status == HS_OK; ++n) {
        status = eval_node(&e, n, err);
        /* An operand serves one node only: its array can go. */
        for (int a = 0; a < formula->node[n].n_args; ++a) HS_FREE(e.results[formula->node[n].arg[a]].array);
    }
    const hs_formula_result *last = &e.results[formula->n_nodes - 1];
    if (status == HS_OK && shape == HS_VALUE_VECTOR && (last->array == NULL || last->n != length))
        status =
            hs_fail(err, HS_ERROR_INPUT,
                    last->array == NULL ? "formula '%.400s': there is no vector in it, such as c_ID, c_ID[j], f_ID, "
                                          "f_ID[j], or v_name of vector style"
                                        : "formula '%.400s': vectors in it are of several lengths",
                    formula->text);
    for (int i = 0; i < length && status == HS_OK; ++i) values[i] = last->array != NULL ? last->array[i] : last->number;
    for (int n = 0; n < formula->n_nodes; ++n) HS_FREE(e.results[n].array);
    HS_FREE(e.results);
    return status;
}

hs_status hs_formula_value(const hs_formula *formula, hs_deck *deck, double *value, hs_error *err)
{
    return evaluate(formula, deck, HS_VALUE_NUMBER, 1, value, err);
}

hs_status hs_formula_vector(const hs_formula *formula, hs_deck *deck, int length, double *values, hs_error *err)
{
    return evaluate(formula, deck, HS_VALUE_VECTOR, length, values, err);
}

hs_status hs_formula_atoms_within(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err)
{
    return evaluate(formula, deck, HS_VALUE_ATOMS, deck->sim->atoms.n_local, values, err);
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
    HS_TRY(hs_formula_parse(&formula, text, HS_VALUE_NUMBER, err));
    hs_status status = hs_formula_value(formula, deck, value, err);
    hs_formula_destroy(&formula);
    return status;
}
