/** What formulas refer to: computes, fixes, variables, atoms; numbers, vectors, and values per atom. */
#include <stdio.h>

#include "base/memory.h"
#include "core/exact_sum.h"
#include "deck/formula_nodes.h"
#include "deck/variables.h"

/** Room for an array of n numbers as a node's value. */
hs_status hs_formula_make_array(hs_formula_result *out, int n, hs_error *err)
{
    out->n = n;
    return HS_ALLOC(out->array, (size_t)n, err);
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
    *value = hs_plain_zero(found[1]);
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

/** Vectors of vector-style formulas. */
static hs_status eval_vector(hs_env *env, const hs_value *value, hs_formula_result *out, hs_error *err)
{
    HS_TRY(hs_value_refresh(env, value, err));
    HS_TRY(hs_formula_make_array(out, hs_value_length(env, value), err));
    return hs_value_vector(env, value, out->array, err);
}

/** What node c_ID, f_ID, i_name or d_name refers to; its word is written to @p word. */
static hs_status read_reference(const hs_evaluation *e, const hs_node *node, hs_value *value, char word[160],
                                hs_error *err)
{
    *value = (hs_value){.kind = node->kind == HS_NODE_COMPUTE ? 'c'
                                : node->kind == HS_NODE_FIX   ? 'f'
                                                              : (char)node->attribute,
                        .word = word,
                        .id = node->text,
                        .n_indices = node->n_args};
    int length = snprintf(word, 160, "%c_%.80s", value->kind, node->text);
    for (int k = 0; k < node->n_args; ++k) {
        const double index = e->results[node->arg[k]].number;
        length += snprintf(word + length, 160 - (size_t)length, "[%.0f]", index);
        if (!(index >= 1.0 && index <= 0x1p53))
            return hs_fail(err, HS_ERROR_INPUT, "formula '%.400s': %s: indices count from 1", e->formula->text, word);
        value->index[k] = (int64_t)index;
    }
    return HS_OK;
}

/** c_ID and f_ID with their indices. In LAMMPS's order: the global value, the value of one atom, the vector, the values
 *  per atom. */
hs_status hs_formula_eval_reference(const hs_evaluation *e, const hs_node *node, hs_formula_result *out, hs_error *err)
{
    hs_sim *sim = e->deck->sim;
    hs_env *env = &sim->env;
    char word[160];
    hs_value value;
    HS_TRY(read_reference(e, node, &value, word, err));
    if (hs_value_has(env, &value, HS_VALUE_NUMBER)) return hs_value_number(env, &value, &out->number, err);
    hs_value column = value;
    column.n_indices = node->n_args - 1;
    column.index[0] = value.index[1];
    if (node->n_args > 0 && hs_value_has(env, &column, HS_VALUE_ATOMS))
        return eval_atom_reference(env, sim, &value, &out->number, err);
    if (e->shape == HS_VALUE_VECTOR && hs_value_has(env, &value, HS_VALUE_VECTOR))
        return eval_vector(env, &value, out, err);
    const bool has_atoms = hs_value_has(env, &value, HS_VALUE_ATOMS);
    if (has_atoms && e->shape == HS_VALUE_ATOMS) {
        HS_TRY(hs_formula_make_array(out, sim->atoms.n_local, err));
        return hs_value_atoms(env, &value, out->array, err);
    }
    if (has_atoms)
        return hs_fail(err, HS_ERROR_INPUT,
                       "formula '%.400s': %s has one value per atom: only atom-style variables may use it (%s[ID] "
                       "is that of one atom)",
                       e->formula->text, word, word);
    return hs_value_check(env, &value, e->shape == HS_VALUE_VECTOR ? HS_VALUE_VECTOR : HS_VALUE_NUMBER, "formula", err);
}

/** x[ID]: the rank that owns the atom tells the others. */
hs_status hs_formula_eval_atom_value(const hs_evaluation *e, const hs_node *node, double *value, hs_error *err)
{
    const hs_sim *sim = e->deck->sim;
    double *values;
    HS_TRY(HS_ALLOC(values, (size_t)sim->atoms.n_local, err));
    for (int i = 0; i < sim->atoms.n_local; ++i) values[i] = hs_formula_attribute(sim, node->attribute, i);
    hs_status status =
        find_atom(sim, e->results[node->arg[0]].number, values, hs_formula_attributes[node->attribute], value, err);
    HS_FREE(values);
    return status;
}

/** Elements of a vector-style variable. */
static hs_status eval_vector_variable(const char *name, hs_deck *deck, hs_formula_result *out, bool *varies,
                                      hs_error *err)
{
    int length;
    HS_TRY(hs_variables_length(deck, name, true, &length, varies, err));
    HS_TRY(hs_formula_make_array(out, length, err));
    return hs_variables_vector(deck, name, length, out->array, err);
}

/** v_name[i]: an element of a vector, or the value of one atom by its ID. Elements beyond the end of a vector whose length
 *  varies are 0, as those of computes and fixes are; those of a vector that grows have not come yet in halfshell check. */
static hs_status eval_element(const hs_node *node, hs_deck *deck, double index, double *value, hs_error *err)
{
    const hs_variable *variable = hs_variables_find(deck->variables, node->text);
    hs_formula_result whole = {0};
    if (variable == NULL) return hs_variables_rounded(deck, node->text, value, err); /* which names the nearest */
    hs_status status;
    if (variable->style == HS_VARIABLE_VECTOR) {
        bool varies;
        status = eval_vector_variable(node->text, deck, &whole, &varies, err);
        if (status == HS_OK && !(index >= 1.0 && (index <= whole.n || varies || deck->sim->env.dry_run)))
            status = hs_fail(err, HS_ERROR_INPUT, "v_%s[%.15g]: the vector has %d elements, which count from 1",
                             node->text, index, whole.n);
        if (status == HS_OK) *value = index <= whole.n ? whole.array[(int)index - 1] : 0.0;
    } else if (hs_variable_is_per_atom(variable)) {
        HS_TRY(hs_formula_make_array(&whole, deck->sim->atoms.n_local, err));
        status = hs_variables_atoms(deck, node->text, whole.array, err);
        if (status == HS_OK) status = find_atom(deck->sim, index, whole.array, node->text, value, err);
    } else {
        return hs_fail(err, HS_ERROR_INPUT,
                       "v_%s[...]: the variable has a single value; vector-style ones have elements, atom-style ones "
                       "a value for each atom",
                       node->text);
    }
    HS_FREE(whole.array);
    return status;
}

hs_status hs_formula_eval_variable(const hs_evaluation *e, const hs_node *node, hs_formula_result *out, hs_error *err)
{
    hs_deck *deck = e->deck;
    const hs_variable *variable = hs_variables_find(deck->variables, node->text);
    if (node->n_args > 0) return eval_element(node, deck, e->results[node->arg[0]].number, &out->number, err);
    if (variable == NULL) return hs_variables_rounded(deck, node->text, &out->number, err);
    bool varies;
    if (variable->style == HS_VARIABLE_VECTOR && e->shape == HS_VALUE_VECTOR)
        return eval_vector_variable(node->text, deck, out, &varies, err);
    if (variable->style == HS_VARIABLE_VECTOR)
        return hs_fail(err, HS_ERROR_INPUT,
                       "v_%s is a vector-style variable: only vector-style formulas may use all of it; v_%s[i] is an "
                       "element, sum(v_%s) and the like are numbers",
                       node->text, node->text, node->text);
    if (!hs_variable_is_per_atom(variable)) return hs_variables_rounded(deck, node->text, &out->number, err);
    if (e->shape != HS_VALUE_ATOMS)
        return hs_fail(err, HS_ERROR_INPUT,
                       "v_%s is an %s-style variable: it has one value per atom, and this formula needs %s", node->text,
                       hs_variable_styles[variable->style], e->shape == HS_VALUE_VECTOR ? "vectors" : "one number");
    HS_TRY(hs_formula_make_array(out, deck->sim->atoms.n_local, err));
    return hs_variables_atoms_within(deck, node->text, out->array, err);
}

/** The vector that a node of a vector-style formula is: false for all others. Which element or column does not matter
 *  here. */
static bool is_vector(hs_deck *deck, const hs_node *node, hs_value *value)
{
    *value = (hs_value){.kind = node->kind == HS_NODE_VARIABLE  ? 'v'
                                : node->kind == HS_NODE_COMPUTE ? 'c'
                                                                : 'f',
                        .id = node->text,
                        .n_indices = node->n_args,
                        .index = {1, 1}};
    if (node->kind != HS_NODE_COMPUTE && node->kind != HS_NODE_FIX && node->kind != HS_NODE_VARIABLE) return false;
    hs_env *env = &deck->sim->env;
    return !hs_value_has(env, value, HS_VALUE_NUMBER) && hs_value_has(env, value, HS_VALUE_VECTOR);
}

hs_status hs_formula_length(const hs_formula *formula, hs_deck *deck, bool refresh, int *length, bool *varies,
                            hs_error *err)
{
    hs_env *env = &deck->sim->env;
    hs_value value;
    *length = 0;
    *varies = false;
    for (int n = 0; n < formula->n_nodes; ++n) {
        if (!is_vector(deck, &formula->node[n], &value)) continue;
        if (refresh) HS_TRY(hs_value_refresh(env, &value, err));
        *length = hs_value_length(env, &value);
        *varies = *varies || hs_value_is_variable(env, &value);
    }
    return HS_OK;
}
