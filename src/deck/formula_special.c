/** Special functions of formulas: about vectors of computes and fixes, groups and regions per atom, and what is
 *  defined. */
#include <string.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/formula_nodes.h"
#include "deck/variables.h"
#include "io/files.h"
#include "style/value.h"

/** One of the functions of a vector x of n elements. */
static double of_vector(const char *name, int n_elements, const double *x)
{
    double sum = 0.0, least = 0.0, greatest = 0.0, moment = 0.0;
    const double n = n_elements;
    for (int i = 0; i < n_elements; ++i) {
        sum += x[i];
        moment += x[i] * (i + 1);
        if (i == 0 || x[i] < least) least = x[i];
        if (i == 0 || x[i] > greatest) greatest = x[i];
    }
    if (strcmp(name, "sum") == 0) return sum;
    if (strcmp(name, "min") == 0) return least;
    if (strcmp(name, "max") == 0) return greatest;
    if (strcmp(name, "ave") == 0) return n_elements > 0 ? sum / n : 0.0;
    if (strcmp(name, "trap") == 0) return n_elements > 1 ? sum - 0.5 * (x[0] + x[n_elements - 1]) : 0.0;
    /* a single point has no slope: LAMMPS says 1e20 */
    return n_elements > 1 ? (moment - 0.5 * (n + 1.0) * sum) / (n * (n * n - 1.0) / 12.0) : 1e20;
}

/** c_ID, f_ID, v_name: a vector; c_ID[j], f_ID[j]: column j of an array. */
static hs_status do_vector(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    hs_env *env = &deck->sim->env;
    const hs_args args = {.command = node->words_of->usage, .n = 1, .word = &node->words[0]};
    hs_value vector = {0};
    double *x = NULL;
    HS_TRY(hs_value_init(&vector, env, &args, 0, HS_VALUE_VECTOR, err));
    hs_status status = hs_value_refresh(env, &vector, err);
    const int n = hs_value_length(env, &vector);
    if (status == HS_OK) status = HS_ALLOC(x, (size_t)n + 1, err);
    if (status == HS_OK) status = hs_value_vector(env, &vector, x, err);
    if (status == HS_OK) *value = of_vector(node->words_of->name, n, x);
    HS_FREE(x);
    hs_value_fini(&vector);
    return status;
}

static hs_status do_masks(hs_deck *deck, const hs_node *node, double *values, hs_error *err)
{
    hs_sim *sim = deck->sim;
    const bool has_group = node->words_of->name[0] == 'g',
               has_region = node->words_of->name[0] == 'r' || node->n_words == 2;
    int bit = 0;
    const hs_region *region = NULL;
    if (has_group) HS_TRY(hs_groups_get(&sim->groups, node->words[0], &bit, err));
    if (has_region)
        HS_TRY(hs_sim_need_region(sim, node->words_of->usage, node->words[node->n_words - 1], &region, err));
    for (int i = 0; i < sim->atoms.n_local; ++i)
        values[i] =
            (sim->atoms.mask[i] & hs_group_mask(bit)) != 0 && (region == NULL || hs_region_has(region, &sim->atoms, i));
    return HS_OK;
}

/** A file-style variable's present value, which then goes on to its next. */
static hs_status do_next(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    hs_variable *variable;
    HS_TRY(hs_variables_need(deck->variables, node->words[0], &variable, err));
    if (variable->style != HS_VARIABLE_FILE)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the variable '%s' must be file-style, or in atom-style formulas atomfile-style",
                       node->words_of->usage, variable->name);
    HS_TRY(hs_variables_number(deck, variable->name, value, err));
    return hs_variables_go_on(deck, node->words[0], err);
}

/** The same for each atom; an atomfile-style variable's present values. */
static hs_status do_next_atoms(hs_deck *deck, const hs_node *node, double *values, hs_error *err)
{
    const hs_variable *variable = hs_variables_find(deck->variables, node->words[0]);
    if (variable != NULL && variable->style == HS_VARIABLE_ATOMFILE) {
        HS_TRY(hs_variables_atoms(deck, node->words[0], values, err));
        return hs_variables_go_on(deck, node->words[0], err);
    }
    double value;
    HS_TRY(do_next(deck, node, &value, err));
    for (int i = 0; i < deck->sim->atoms.n_local; ++i) values[i] = value;
    return HS_OK;
}

static hs_status do_is_defined(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    const char *category = node->words[0], *id = node->words[1];
    if (strcmp(category, "compute") == 0)
        *value = hs_sim_find_compute(deck->sim, id) != NULL;
    else if (strcmp(category, "dump") == 0)
        *value = hs_sim_find_dump(deck->sim, id) != NULL;
    else if (strcmp(category, "fix") == 0)
        *value = hs_sim_find_fix(deck->sim, id) != NULL;
    else if (strcmp(category, "region") == 0)
        *value = hs_sim_find_region(deck->sim, id) != NULL;
    else if (strcmp(category, "group") == 0)
        *value = hs_groups_find(&deck->sim->groups, id) >= 0;
    else if (strcmp(category, "variable") == 0)
        *value = hs_variables_find(deck->variables, id) != NULL;
    else
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must be compute, dump, fix, group, region or variable",
                       node->words_of->usage, category);
    return HS_OK;
}

#define IS_STYLE(table, id, out)                                                                                       \
    for (int k = 0; (table)[k] != NULL; ++k)                                                                           \
        if (strcmp((table)[k]->about.name, (id)) == 0) *(out) = 1.0;

static hs_status do_is_available(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    (void)deck;
    const char *category = node->words[0], *id = node->words[1];
    *value = 0.0;
    if (strcmp(category, "command") == 0)
        *value = hs_command_find(id) != NULL;
    else if (strcmp(category, "pair") == 0) {
        IS_STYLE(hs_pair_styles, id, value)
    } else if (strcmp(category, "fix") == 0) {
        IS_STYLE(hs_fix_styles, id, value)
    } else if (strcmp(category, "compute") == 0) {
        IS_STYLE(hs_compute_styles, id, value)
    } else if (strcmp(category, "region") == 0) {
        IS_STYLE(hs_region_styles, id, value)
    } else if (strcmp(category, "dump") == 0) {
        IS_STYLE(hs_dump_styles, id, value)
    } else
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must be command, pair, fix, compute, region or dump",
                       node->words_of->usage, category);
    return HS_OK;
}

static hs_status do_is_file(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    (void)err;
    *value = hs_file_is_readable(&deck->sim->parallel, node->words[0]);
    return HS_OK;
}

const hs_word_function hs_special_functions[] = {
    {"sum", 1, 1, do_vector, NULL, "sum(c_ID|f_ID|c_ID[j]|f_ID[j]|v_name)", "sum of the elements of a vector"},
    {"min", 1, 1, do_vector, NULL, "min(c_ID|f_ID|c_ID[j]|f_ID[j]|v_name)", "least element"},
    {"max", 1, 1, do_vector, NULL, "max(c_ID|f_ID|c_ID[j]|f_ID[j]|v_name)", "greatest element"},
    {"ave", 1, 1, do_vector, NULL, "ave(c_ID|f_ID|c_ID[j]|f_ID[j]|v_name)", "mean of the elements"},
    {"trap", 1, 1, do_vector, NULL, "trap(c_ID|f_ID|c_ID[j]|f_ID[j]|v_name)",
     "integral by the trapezoidal rule, distance 1"},
    {"slope", 1, 1, do_vector, NULL, "slope(c_ID|f_ID|c_ID[j]|f_ID[j]|v_name)",
     "slope of the line fitted to the elements"},
    {"gmask", 1, 1, NULL, do_masks, "gmask(group)", "1 for atoms of the group, 0 for others (per atom)"},
    {"rmask", 1, 1, NULL, do_masks, "rmask(region)", "1 for atoms in the region (per atom)"},
    {"grmask", 2, 2, NULL, do_masks, "grmask(group,region)", "1 for atoms of the group in the region (per atom)"},
    {"next", 1, 1, do_next, do_next_atoms, "next(name)",
     "present value of a file-style variable, or in atom-style formulas values of an atomfile-style one, which then "
     "goes on to the next; it is deleted when there is none"},
    {"is_defined", 2, 2, do_is_defined, NULL, "is_defined(category,ID)",
     "whether a compute, dump, fix, group, region or variable exists"},
    {"is_available", 2, 2, do_is_available, NULL, "is_available(category,name)",
     "whether a command or style is supported"},
    {"is_file", 1, 1, do_is_file, NULL, "is_file(name)", "whether a file can be read"},
    {0},
};
