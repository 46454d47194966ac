/* Clusters of atoms: two atoms nearer than a distance belong to one cluster, and so do all that are linked by such
 * pairs. */

#include "base/memory.h"
#include "style/compute.h"
#include "style/pair_scan.h"

typedef struct cluster_state {
    double cutoff;
} cluster_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    cluster_state *state = compute->state;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    return hs_arg_positive(args, 0, &state->cutoff, err);
}

/** Atoms that this rank knows (local and halo), linked to trees: one for each cluster, as far as this rank sees it. */
typedef struct forest {
    hs_pair_scan *scan;
    uint32_t mask;
    int32_t *parent; /**< owned [n_all]: a root is its own parent */
    int64_t *label;  /**< owned [n_all]: of roots: the smallest id of the cluster found so far */
    int64_t *seen;   /**< owned [n_all]: labels of atoms, as they are sent */
    int64_t *back;   /**< owned: labels of copies on other ranks */
} forest;

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void join(forest *f, int32_t i, int32_t j)
{
    i = root_of(f->parent, i);
    j = root_of(f->parent, j);
    if (i != j) f->parent[i > j ? i : j] = i > j ? j : i;
}

/** Which trees there are does not depend on the order in which pairs are joined. */
static void join_pairs(void *context, int thread, const hs_pair_batch *batch)
{
    forest *f = context;
    const uint32_t *mask = f->scan->mask;
    (void)thread;
#pragma omp critical(hs_cluster_atom)
    for (int p = 0; p < batch->n; ++p) {
        const int32_t i = batch->i[p], j = batch->j[p];
        if (mask[i] & mask[j] & f->mask) join(f, i, j);
    }
}

/** A label for the cluster of atom i: true when it is smaller than that which was known. */
static bool lower(forest *f, int32_t i, int64_t label)
{
    int64_t *known = &f->label[root_of(f->parent, i)];
    if (label >= *known) return false;
    *known = label;
    return true;
}

static hs_status plant(forest *f, const hs_env *env, hs_error *err)
{
    const size_t n_all = (size_t)f->scan->n_all;
    hs_status status = HS_ALLOC(f->parent, n_all, err);
    if (status == HS_OK) status = HS_ALLOC(f->label, n_all, err);
    if (status == HS_OK) status = HS_ALLOC(f->seen, n_all, err);
    if (status == HS_OK) status = HS_ALLOC(f->back, (size_t)f->scan->halo.out.n, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    for (int i = 0; i < f->scan->n_all; ++i) {
        f->parent[i] = i;
        f->label[i] = f->scan->id[i];
    }
    for (int j = f->scan->atoms.n_local; j < f->scan->n_all; ++j) { /* images of this rank's own atoms */
        const int i = hs_pair_scan_source(f->scan, j);
        if (i >= 0) join(f, i, j);
    }
    return HS_OK;
}

/** Tell the labels of atoms to the ranks that hold copies of them, and back; whether any became smaller anywhere. */
static bool exchange(forest *f, const hs_env *env)
{
    const hs_pair_scan *scan = f->scan;
    const int n_local = scan->atoms.n_local;
    int64_t n_changed = 0;
    for (int i = 0; i < scan->n_all; ++i) f->seen[i] = f->label[root_of(f->parent, i)];
    hs_halo_collect(&scan->halo, &scan->atoms, f->seen, sizeof *f->seen, f->back);
    for (int k = 0; k < scan->halo.out.n; ++k) n_changed += lower(f, scan->halo.source[k], f->back[k]);
    for (int i = 0; i < n_local; ++i) f->seen[i] = f->label[root_of(f->parent, i)];
    hs_halo_forward_array(&scan->halo, &scan->atoms, f->seen, sizeof *f->seen);
    for (int j = n_local; j < scan->n_all; ++j) n_changed += lower(f, j, f->seen[j]);
    hs_parallel_sum_int64(env->parallel, &n_changed, 1);
    return n_changed > 0;
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const cluster_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    hs_pair_scan scan = {0};
    forest f = {.scan = &scan, .mask = compute->mask};
    hs_status status = hs_pair_scan_begin(&scan, compute->env, state->cutoff, err);
    if (status == HS_OK) status = plant(&f, compute->env, err);
    if (status == HS_OK) {
        hs_pair_scan_visit(&scan, join_pairs, &f);
        for (int i = 0; i < scan.n_all; ++i) (void)lower(&f, i, scan.id[i]);
        while (exchange(&f, compute->env)) continue;
        for (int i = 0; i < atoms->n_local; ++i)
            compute->atoms[i] = atoms->mask[i] & compute->mask ? (double)f.label[root_of(f.parent, i)] : 0.0;
    }
    HS_FREE(f.parent);
    HS_FREE(f.label);
    HS_FREE(f.seen);
    HS_FREE(f.back);
    hs_pair_scan_end(&scan);
    return status;
}

const hs_compute_style hs_compute_style_cluster_atom = {
    .about = {.name = "cluster/atom",
              .syntax = {.usage = "<distance>", .n_min = 1, .n_max = 1},
              .summary = "which cluster each atom belongs to",
              .details = "Two atoms of the group that are nearer than the distance belong to one cluster, and so do "
                         "all atoms that are linked by such pairs, across periodic faces too. The value per atom is "
                         "the smallest id of the cluster's atoms; 0 for atoms outside of the group. Any distance will "
                         "do: pairs are found anew for each evaluation.\n\n"
                         "`compute chunk/atom c_ID compress yes` makes chunks of the clusters; `compute reduce` and "
                         "`fix ave/histo` count them.",
              .example = "compute c all cluster/atom 1.5\ncompute chunk all chunk/atom c_c compress yes\n"
                         "fix sizes all ave/chunk 100 1 100 chunk density/number norm none"},
    .state_size = sizeof(cluster_state),
    .create = create,
    .per_atom = per_atom,
};
