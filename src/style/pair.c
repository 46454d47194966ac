#include "style/pair.h"

#include <math.h>

#include "base/memory.h"
#include "base/text.h"

double hs_pair_mix_energy(hs_mix_rule rule, double eps_i, double eps_j, double sigma_i, double sigma_j)
{
    if (rule != HS_MIX_SIXTHPOWER) return sqrt(eps_i * eps_j);
    return 2.0 * sqrt(eps_i * eps_j) * pow(sigma_i, 3.0) * pow(sigma_j, 3.0) / (pow(sigma_i, 6.0) + pow(sigma_j, 6.0));
}

double hs_pair_mix_distance(hs_mix_rule rule, double sigma_i, double sigma_j)
{
    switch (rule) {
    case HS_MIX_ARITHMETIC:
        return 0.5 * (sigma_i + sigma_j);
    case HS_MIX_SIXTHPOWER:
        return pow(0.5 * (pow(sigma_i, 6.0) + pow(sigma_j, 6.0)), 1.0 / 6.0);
    default:
        return sqrt(sigma_i * sigma_j);
    }
}

const hs_pair_style *hs_pair_style_find(const char *name)
{
    for (size_t k = 0; hs_pair_styles[k] != NULL; ++k)
        if (hs_text_is_style(name, hs_pair_styles[k]->about.name)) return hs_pair_styles[k];
    return NULL;
}

hs_status hs_pair_create(hs_pair **created, const hs_pair_style *style, hs_env *env, int n_types, hs_error *err)
{
    const size_t n = (size_t)(n_types + 1) * (size_t)(n_types + 1);
    HS_TRY(HS_ALLOC(*created, 1, err));
    hs_pair *pair = *created;
    *pair = (hs_pair){.style = style, .env = env, .n_types = n_types};
    HS_TRY(hs_memory_alloc(&pair->state, 1, style->state_size + 1, err));
    HS_TRY(HS_ALLOC(pair->is_set, n, err));
    HS_TRY(HS_ALLOC(pair->cutoff, n, err));
    if (style->is_hybrid) return HS_OK;
    HS_TRY(HS_ALLOC(pair->part, 1, err));
    pair->part[0] = pair;
    pair->n_parts = 1;
    return HS_OK;
}

void hs_pair_destroy(hs_pair **destroyed)
{
    hs_pair *pair = *destroyed;
    if (pair == NULL) return;
    for (int k = 0; k < pair->n_parts; ++k)
        if (pair->part[k] != pair) hs_pair_destroy(&pair->part[k]);
    if (pair->state != NULL && pair->style->destroy != NULL) pair->style->destroy(pair);
    HS_FREE(pair->part);
    HS_FREE(pair->state);
    HS_FREE(pair->is_set);
    HS_FREE(pair->cutoff);
    HS_FREE(*destroyed);
}

void hs_pair_copy_modified(hs_pair *to, const hs_pair *from)
{
    for (int k = 0; k < to->n_parts; ++k) {
        to->part[k]->shift = from->part[k]->shift;
        to->part[k]->tail = from->part[k]->tail;
        to->part[k]->mix = from->part[k]->mix;
    }
}

/** Whether (i, j) can be mixed from (i, i) and (j, j), in every part that has these. */
static bool can_mix(const hs_pair *pair, int i, int j)
{
    const int ii = hs_pair_index(pair, i, i), jj = hs_pair_index(pair, j, j);
    if (i == j || !pair->is_set[ii] || !pair->is_set[jj]) return false;
    for (int k = 0; k < pair->n_parts; ++k) {
        const hs_pair *part = pair->part[k];
        if (!part->is_set[ii] != !part->is_set[jj]) return false;
        if (part->is_set[ii] && part->style->mix == NULL) return false;
    }
    return true;
}

static hs_status complete_types(hs_pair *pair, int i, int j, hs_error *err)
{
    const int ij = hs_pair_index(pair, i, j), ji = hs_pair_index(pair, j, i);
    const bool is_mixed = !pair->is_set[ij];
    double unused[HS_EVALUATOR_PARAMS_MAX], largest = 0.0;
    if (is_mixed && !can_mix(pair, i, j))
        return hs_fail(err, HS_ERROR_INPUT, "run: no pair_coeff was given for the types %d %d of pair_style %s", i, j,
                       pair->style->about.name);
    for (int k = 0; k < pair->n_parts; ++k) {
        hs_pair *part = pair->part[k];
        double cutoff = 0.0;
        if (part->is_set[is_mixed ? hs_pair_index(pair, i, i) : ij]) {
            if (is_mixed) HS_TRY(part->style->mix(part, i, j, err));
            part->style->params(part, i, j, &cutoff, unused);
        }
        part->cutoff[ij] = part->cutoff[ji] = cutoff;
        if (cutoff > largest) largest = cutoff;
    }
    pair->cutoff[ij] = pair->cutoff[ji] = largest;
    if (largest > pair->cutoff_max) pair->cutoff_max = largest;
    return HS_OK;
}

hs_status hs_pair_complete(hs_pair *pair, hs_error *err)
{
    pair->cutoff_max = 0.0;
    if (pair->style->allows_none) return HS_OK;
    for (int k = 0; k < pair->n_parts; ++k)
        if (pair->part[k]->style->init != NULL) HS_TRY(pair->part[k]->style->init(pair->part[k], err));
    for (int i = 1; i <= pair->n_types; ++i)
        for (int j = i; j <= pair->n_types; ++j) HS_TRY(complete_types(pair, i, j, err));
    return HS_OK;
}

bool hs_pair_has_forces(const hs_pair *pair)
{
    for (int k = 0; k < pair->n_parts; ++k)
        if (pair->part[k]->style->evaluator != NULL) return true;
    return false;
}

bool hs_pair_has_radii(const hs_pair *pair, bool all)
{
    for (int k = 0; k < pair->n_parts; ++k) {
        const hs_evaluator *evaluator = pair->part[k]->style->evaluator;
        if (evaluator != NULL && evaluator->has_radii != all) return !all;
    }
    return all && hs_pair_has_forces(pair);
}
