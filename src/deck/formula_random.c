/** Random numbers of atom-style formulas between runs. LAMMPS evaluates a formula atom by atom, so that one generator
 *  gives each atom all its numbers before the next atom's turn; formulas here go node by node. So the numbers are drawn
 *  ahead. */
#include "base/memory.h"
#include "deck/by_id.h"
#include "deck/formula_nodes.h"
#include "deck/variables.h"

hs_status hs_random_seed(const hs_function *function, double value, int *seed, hs_error *err)
{
    int64_t whole;
    HS_TRY(hs_formula_whole(function->usage, value, &whole, err));
    if (whole < 1 || whole > HS_MARSAGLIA_SEED_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the seed must be a whole number from 1 to 900000000 (got %.15g)",
                       function->usage, value);
    *seed = (int)whole;
    return HS_OK;
}

static hs_status append(hs_atom_draws *draws, hs_draw_kind kind, hs_error *err)
{
    HS_TRY(HS_EXTEND(draws->kind, draws->n, draws->capacity, err));
    draws->kind[draws->n++] = kind;
    return HS_OK;
}

hs_status hs_atom_draws_init(hs_atom_draws *draws, const hs_formula *formula, hs_deck *deck, hs_error *err)
{
    for (int k = 0; k < formula->n_nodes; ++k) {
        const hs_node *node = &formula->node[k];
        if (node->kind == HS_NODE_FUNCTION && node->function->draws != HS_DRAWS_NOTHING)
            HS_TRY(append(draws, node->function->draws, err));
        if (node->kind != HS_NODE_VARIABLE || node->n_args > 0) continue;
        hs_variable *variable = hs_variables_find(deck->variables, node->text);
        /* one that uses itself is refused when it is evaluated */
        if (variable == NULL || variable->style != HS_VARIABLE_ATOM || variable->is_evaluating) continue;
        variable->is_evaluating = true;
        const hs_status status = hs_atom_draws_init(draws, variable->formula, deck, err);
        variable->is_evaluating = false;
        HS_TRY(status);
    }
    return HS_OK;
}

void hs_atom_draws_fini(hs_atom_draws *draws)
{
    HS_FREE(draws->kind);
    HS_FREE(draws->number);
}

/** Where the draws are, while all IDs are visited. */
typedef struct visit {
    hs_atom_draws *draws;
    hs_marsaglia *generator;
    const hs_atoms *atoms;
    const int32_t *order; /**< local atoms by ID */
    int next;             /**< place in order */
} visit;

static hs_status draw_for_atom(void *context, int64_t id, hs_error *err)
{
    (void)err;
    visit *v = context;
    const int n_local = v->atoms->n_local;
    const bool is_here = v->next < n_local && v->atoms->id[v->order[v->next]] == id;
    for (int k = 0; k < v->draws->n; ++k) {
        const double number = v->draws->kind[k] == HS_DRAWS_NORMAL ? hs_marsaglia_gaussian(v->generator)
                                                                   : hs_marsaglia_uniform(v->generator);
        if (is_here) v->draws->number[(size_t)k * (size_t)n_local + (size_t)v->order[v->next]] = number;
    }
    if (is_here) ++v->next;
    return HS_OK;
}

static hs_status draw_all(hs_atom_draws *draws, hs_deck *deck, hs_error *err)
{
    const hs_sim *sim = deck->sim;
    const hs_atoms *atoms = &sim->atoms;
    const size_t n_local = (size_t)atoms->n_local;
    int32_t *order = NULL;
    unsigned char *all = NULL;
    HS_UNLESS_FAILED(err, HS_ALLOC(draws->number, (size_t)draws->n * n_local + 1, err));
    HS_UNLESS_FAILED(err, HS_ALLOC(all, n_local + 1, err));
    HS_UNLESS_FAILED(err, hs_by_id_order(atoms, &order, err));
    hs_status status = hs_parallel_agree(&sim->parallel, err);
    if (status == HS_OK) {
        for (size_t i = 0; i < n_local; ++i) all[i] = 1;
        visit v = {draws, &deck->variables->atom_generator, atoms, order, 0};
        status = hs_by_id_visit(sim, all, draw_for_atom, &v, err);
    }
    HS_FREE(order);
    HS_FREE(all);
    return status;
}

hs_status hs_atom_draws_next(hs_atom_draws *draws, hs_deck *deck, double seed, const double **numbers, hs_error *err)
{
    if (draws->number == NULL) {
        hs_marsaglia *generator = &deck->variables->atom_generator;
        if (!generator->is_seeded) hs_marsaglia_init(generator, (int)seed);
        HS_TRY(draw_all(draws, deck, err));
    }
    if (draws->next >= draws->n) return hs_fail(err, HS_ERROR_RUN, "random numbers of atoms: more draws than foreseen");
    *numbers = draws->number + (size_t)draws->next++ * (size_t)deck->sim->atoms.n_local;
    return HS_OK;
}
