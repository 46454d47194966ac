/* Tables of pair parameters: coefficients that were given or mixed, cutoffs, exclusions. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "sim/sim.h"

/* Table rows beyond which group exclusions are refused: the table would no longer fit caches. */
enum { KERNEL_TYPES_MAX = 2048 };

/** Groups that occur in exclusions, each once: their bits decide an atom's exclusion class. */
static int excluded_groups(const hs_neighbor_settings *settings, int groups[HS_GROUPS_MAX])
{
    uint32_t seen = 0;
    int n = 0;
    for (int k = 0; k < settings->n_exclusions; ++k) {
        const hs_exclusion *e = &settings->exclusion[k];
        if (e->kind == HS_EXCLUDE_GROUP) seen |= hs_group_mask(e->a) | hs_group_mask(e->b);
    }
    for (int bit = 0; bit < HS_GROUPS_MAX; ++bit)
        if (seen & hs_group_mask(bit)) groups[n++] = bit;
    return n;
}

void hs_sim_set_kernel_types(hs_sim *sim)
{
    const hs_atoms *atoms = &sim->atoms;
    int groups[HS_GROUPS_MAX];
    const int n_groups = excluded_groups(&sim->neighbor.settings, groups);
    for (int i = 0; i < atoms->n_local; ++i) {
        int class = 0;
        for (int g = 0; g < n_groups; ++g) class |= (atoms->mask[i] >> groups[g] & 1u) << g;
        sim->kernel_type[i] = class * (atoms->n_types + 1) + atoms->type[i];
    }
}

static bool class_has_group(int class, int group, const int *groups, int n_groups)
{
    for (int g = 0; g < n_groups; ++g)
        if (groups[g] == group) return class >> g & 1;
    return false;
}

static bool is_excluded(const hs_neighbor_settings *settings, int type_i, int class_i, int type_j, int class_j,
                        const int *groups, int n_groups)
{
    for (int k = 0; k < settings->n_exclusions; ++k) {
        const hs_exclusion *e = &settings->exclusion[k];
        if (e->kind == HS_EXCLUDE_TYPE) {
            if ((type_i == e->a && type_j == e->b) || (type_i == e->b && type_j == e->a)) return true;
        } else {
            const bool i_a = class_has_group(class_i, e->a, groups, n_groups),
                       i_b = class_has_group(class_i, e->b, groups, n_groups);
            const bool j_a = class_has_group(class_j, e->a, groups, n_groups),
                       j_b = class_has_group(class_j, e->b, groups, n_groups);
            if ((i_a && j_b) || (i_b && j_a)) return true;
        }
    }
    return false;
}

/** Table of one part of the pair style. Its listed distances are those of the whole style, whose parts share their lists. */
static hs_status fill_table(hs_sim *sim, const hs_pair *part, hs_pair_table *table, int n_classes, const int *groups,
                            int n_groups, hs_error *err)
{
    const int n = part->n_types + 1;
    table->n_types = n_classes * n;
    table->stride = HS_TABLE_PARAMS + part->style->evaluator->n_params;
    table->shared = part->style->shared != NULL ? part->style->shared(part) : NULL;
    HS_TRY(HS_GROW(table->values, 0, (size_t)table->n_types * (size_t)table->n_types * (size_t)table->stride, err));
    for (int a = 0; a < table->n_types; ++a)
        for (int b = 0; b < table->n_types; ++b) {
            const int i = a % n, j = b % n;
            if (i == 0 || j == 0) continue; /* no atom has type 0: the row stays zero, no interaction */
            const double cutoff = part->cutoff[hs_pair_index(part, i, j)],
                         listed = sim->pair->cutoff[hs_pair_index(part, i, j)];
            if (listed <= 0.0 || is_excluded(&sim->neighbor.settings, i, a / n, j, b / n, groups, n_groups)) continue;
            double *row = table->values + ((size_t)a * (size_t)table->n_types + (size_t)b) * (size_t)table->stride;
            double unused;
            const double reach = listed + sim->neighbor.settings.skin;
            row[HS_TABLE_LISTED_R2] =
                nextafter(reach * reach, INFINITY); /* LAMMPS lists pairs up to and at the limit */
            row[HS_TABLE_CUT_R2] = cutoff * cutoff;
            if (cutoff > 0.0) part->style->params(part, i < j ? i : j, i < j ? j : i, &unused, row + HS_TABLE_PARAMS);
        }
    table->is_uniform = n_classes == 1 && hs_pair_table_is_uniform(table);
    return HS_OK;
}

static hs_status fill_tables(hs_sim *sim, int n_classes, const int *groups, int n_groups, hs_error *err)
{
    const hs_pair *pair = sim->pair;
    if (pair->n_parts > sim->n_pair_tables) {
        HS_TRY(HS_GROW(sim->pair_table, (size_t)sim->n_pair_tables, (size_t)pair->n_parts, err));
        sim->n_pair_tables = pair->n_parts;
    }
    for (int k = 0; k < pair->n_parts; ++k)
        if (pair->part[k]->style->evaluator != NULL)
            HS_TRY(fill_table(sim, pair->part[k], &sim->pair_table[k], n_classes, groups, n_groups, err));
    return HS_OK;
}

static hs_status count_types(hs_sim *sim, hs_error *err)
{
    HS_TRY(HS_GROW(sim->n_of_type, 0, (size_t)sim->atoms.n_types + 1, err));
    for (int i = 0; i < sim->atoms.n_local; ++i) ++sim->n_of_type[sim->atoms.type[i]];
    hs_parallel_sum_int64(&sim->parallel, sim->n_of_type, sim->atoms.n_types + 1);
    return HS_OK;
}

/** Which pairs of kernel types are excluded. */
static hs_status fill_excluded(hs_sim *sim, int n_classes, const int *groups, int n_groups, hs_error *err)
{
    const hs_neighbor_settings *settings = &sim->neighbor.settings;
    const int n = sim->atoms.n_types + 1, n_all = n_classes * n;
    HS_FREE(sim->excluded);
    if (settings->n_exclusions == 0) return HS_OK;
    HS_TRY(HS_ALLOC(sim->excluded, (size_t)n_all * (size_t)n_all, err));
    sim->n_kernel_types = n_all;
    for (int a = 0; a < n_all; ++a)
        for (int b = 0; b < n_all; ++b)
            sim->excluded[(size_t)a * (size_t)n_all + (size_t)b] =
                is_excluded(settings, a % n, a / n, b % n, b / n, groups, n_groups);
    return HS_OK;
}

/** Cutoffs and tables, all else being known. */
static hs_status renew(hs_sim *sim, hs_error *err)
{
    int groups[HS_GROUPS_MAX];
    const int n_groups = excluded_groups(&sim->neighbor.settings, groups);
    HS_TRY(hs_pair_complete(sim->pair, err));
    sim->env.reach = sim->pair->cutoff_max > 0.0 ? sim->pair->cutoff_max + sim->neighbor.settings.skin : 0.0;
    HS_TRY(fill_excluded(sim, 1 << n_groups, groups, n_groups, err));
    return fill_tables(sim, 1 << n_groups, groups, n_groups, err);
}

hs_status hs_sim_renew_pair(hs_sim *sim, bool *needs_lists, hs_error *err)
{
    const size_t n = (size_t)(sim->pair->n_types + 1) * (size_t)(sim->pair->n_types + 1);
    double *before = NULL;
    HS_TRY(HS_ALLOC(before, n, err));
    memcpy(before, sim->pair->cutoff, n * sizeof *before);
    const hs_status status = renew(sim, err);
    *needs_lists = hs_pair_has_radii(sim->pair, false) || memcmp(before, sim->pair->cutoff, n * sizeof *before) != 0;
    HS_FREE(before);
    return status;
}

hs_status hs_sim_fit_kernel_types(hs_sim *sim, hs_error *err)
{
    int groups[HS_GROUPS_MAX];
    const int n_groups = excluded_groups(&sim->neighbor.settings, groups);
    if (n_groups > 0 && sim->kernel_type == NULL) {
        HS_TRY(hs_atoms_add_field(&sim->atoms, "kernel type", (void **)&sim->kernel_type, sizeof(int32_t), true, err));
        hs_atoms_keep_from_halo(&sim->atoms, (void **)&sim->kernel_type); /* computed anew after the halo is made */
    }
    if (n_groups == 0 && sim->kernel_type != NULL) hs_atoms_remove_field(&sim->atoms, (void **)&sim->kernel_type);
    return HS_OK;
}

hs_status hs_sim_setup_pair(hs_sim *sim, hs_error *err)
{
    int groups[HS_GROUPS_MAX];
    const int n_groups = excluded_groups(&sim->neighbor.settings, groups);
    HS_TRY(hs_sim_need_pair(sim, "run", err));
    HS_TRY(hs_sim_fit_pair(sim, err));
    HS_TRY(count_types(sim, err));
    if (n_groups > 10 || (sim->atoms.n_types + 1) << n_groups > KERNEL_TYPES_MAX)
        return hs_fail(err, HS_ERROR_INPUT,
                       "neigh_modify exclude: %d groups and %d atom types are too many together; give the atoms types "
                       "of their own and exclude those",
                       n_groups, sim->atoms.n_types);
    HS_TRY(hs_sim_fit_kernel_types(sim, err));
    return renew(sim, err);
}
