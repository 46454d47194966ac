#include "style/nearest.h"

#include <string.h>

#include "base/memory.h"
#include "style/pair_scan.h"

void hs_nearest_fini(hs_nearest *nearest)
{
    HS_FREE(nearest->start);
    HS_FREE(nearest->item);
}

/** Turn counts of atom i in start[i + 2] into places: start[i + 1] is then the next free place of atom i. */
static hs_status lay_out(hs_nearest *t, hs_error *err)
{
    for (int i = 0; i < t->n; ++i) t->start[i + 2] += t->start[i + 1];
    return HS_ALLOC(t->item, (size_t)t->start[t->n + 1], err);
}

static inline hs_near *next_place(hs_nearest *t, int i) { return &t->item[t->start[i + 1]++]; }

typedef struct finding {
    const hs_pair_scan *scan;
    hs_nearest table; /**< of local and halo atoms */
} finding;

static void count_pairs(void *context, int thread, const hs_pair_batch *batch)
{
    finding *f = context;
    (void)thread;
    for (int p = 0; p < batch->n; ++p) {
        ++f->table.start[batch->i[p] + 2];
        ++f->table.start[batch->j[p] + 2];
    }
}

static void keep_pairs(void *context, int thread, const hs_pair_batch *batch)
{
    finding *f = context;
    const int64_t *id = f->scan->id;
    const int32_t *type = f->scan->atoms.type;
    (void)thread;
    for (int p = 0; p < batch->n; ++p) {
        const int i = batch->i[p], j = batch->j[p];
        const double dx = batch->dx[0][p], dy = batch->dx[1][p], dz = batch->dx[2][p];
        *next_place(&f->table, i) = (hs_near){.r2 = batch->r2[p], .d = {dx, dy, dz}, .id = id[j], .type = type[j]};
        *next_place(&f->table, j) = (hs_near){.r2 = batch->r2[p], .d = {-dx, -dy, -dz}, .id = id[i], .type = type[i]};
    }
}

/** By distance; then by whatever makes the order definite. */
static bool is_before(const hs_near *a, const hs_near *b)
{
    if (a->r2 != b->r2) return a->r2 < b->r2;
    if (a->id != b->id) return a->id < b->id;
    for (int axis = 0; axis < 2; ++axis)
        if (a->d[axis] != b->d[axis]) return a->d[axis] < b->d[axis];
    return a->d[2] < b->d[2];
}

/** Bring the nearest n_wanted neighbors of atom i (0: all) to the front, in order; how many they are. */
static int sort_one(const hs_nearest *t, int i, int n_wanted)
{
    hs_near *item = t->item + t->start[i];
    const int n = (int)(t->start[i + 1] - t->start[i]), n_sorted = n_wanted > 0 && n > n_wanted ? n_wanted : n;
    for (int k = 1; k < n; ++k) {
        const hs_near moved = item[k];
        int at = k;
        if (k >= n_sorted) { /* the last of the nearest gives way, if this one is nearer */
            at = n_sorted - 1;
            if (!is_before(&moved, &item[at])) continue;
            item[k] = item[at];
        }
        for (; at > 0 && is_before(&moved, &item[at - 1]); --at) item[at] = item[at - 1];
        item[at] = moved;
    }
    return n_sorted;
}

/** Neighbors that this rank has found of atoms of others, and those that others have found of atoms of this rank. */
typedef struct mail {
    int64_t n_records; /**< neighbors of each atom, at most */
    hs_near *sent;     /**< owned [n_all][n_records] */
    hs_near *received; /**< owned [halo.out.n][n_records]; ids of 0: none */
} mail;

/** The nearest neighbors of halo atoms go to the ranks of these atoms. */
static hs_status exchange(const finding *f, const hs_env *env, int n_wanted, mail *m, hs_error *err)
{
    const hs_pair_scan *scan = f->scan;
    const hs_nearest *t = &f->table;
    const int n_local = scan->atoms.n_local;
    for (int j = n_local; j < scan->n_all; ++j) {
        const int64_t n = t->start[j + 1] - t->start[j];
        if (n > m->n_records) m->n_records = n;
    }
    if (n_wanted > 0 && m->n_records > n_wanted) m->n_records = n_wanted;
    hs_parallel_max_int64(env->parallel, &m->n_records, 1);
    const size_t n_records = (size_t)m->n_records;
    hs_status status = HS_ALLOC(m->sent, (size_t)scan->n_all * n_records, err);
    if (status == HS_OK) status = HS_ALLOC(m->received, (size_t)scan->halo.out.n * n_records, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
#pragma omp parallel for schedule(static)
    for (int j = n_local; j < scan->n_all; ++j) {
        const int n = sort_one(t, j, n_wanted);
        if (n > 0) memcpy(m->sent + (size_t)j * n_records, t->item + t->start[j], (size_t)n * sizeof(hs_near));
    }
    hs_halo_collect(&scan->halo, &scan->atoms, m->sent, n_records * sizeof(hs_near), m->received);
    return HS_OK;
}

/** All neighbors of the local atoms: those that this rank has found, and those in the mail. */
static hs_status merge(const finding *f, const mail *m, hs_nearest *all, hs_error *err)
{
    const hs_pair_scan *scan = f->scan;
    const int64_t n_received = scan->halo.out.n * m->n_records;
    all->n = scan->atoms.n_local;
    HS_TRY(HS_ALLOC(all->start, (size_t)all->n + 2, err));
    for (int i = 0; i < all->n; ++i) all->start[i + 2] = f->table.start[i + 1] - f->table.start[i];
    for (int64_t k = 0; k < n_received; ++k)
        all->start[scan->halo.source[k / m->n_records] + 2] += m->received[k].id > 0;
    HS_TRY(lay_out(all, err));
    for (int i = 0; i < all->n; ++i)
        for (int64_t k = f->table.start[i]; k < f->table.start[i + 1]; ++k) *next_place(all, i) = f->table.item[k];
    for (int64_t k = 0; k < n_received; ++k)
        if (m->received[k].id > 0) *next_place(all, scan->halo.source[k / m->n_records]) = m->received[k];
    return HS_OK;
}

static hs_status find(finding *f, const hs_env *env, int n_wanted, hs_nearest *all, hs_error *err)
{
    mail m = {0};
    f->table.n = f->scan->n_all;
    hs_status status = HS_ALLOC(f->table.start, (size_t)f->table.n + 2, err);
    if (status == HS_OK) {
        hs_pair_scan_visit(f->scan, count_pairs, f);
        status = lay_out(&f->table, err);
    }
    if (hs_parallel_agree(env->parallel, err) == HS_OK) {
        hs_pair_scan_visit(f->scan, keep_pairs, f);
        status = exchange(f, env, n_wanted, &m, err); /* an error here is that of all ranks already */
        if (status == HS_OK) {
            (void)merge(f, &m, all, err);
            status = hs_parallel_agree(env->parallel, err);
        }
    }
    HS_FREE(m.sent);
    HS_FREE(m.received);
    return status != HS_OK ? status : err->status;
}

hs_status hs_nearest_range(const hs_compute *compute, double cutoff, double *range, hs_error *err)
{
    hs_pair_view view;
    *range = cutoff;
    if (cutoff > 0.0) return HS_OK;
    compute->env->view_pairs(compute->env, &view);
    *range = view.cutoff_max;
    if (*range > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: there is no cutoff of a pair style before the first run, or none at all; 'cutoff <distance>' "
                   "says where to look for neighbors",
                   hs_compute_who(compute).text);
}

hs_status hs_nearest_find(hs_nearest *nearest, hs_env *env, double range, int n_wanted, hs_error *err)
{
    hs_pair_scan scan = {0};
    finding f = {.scan = &scan};
    hs_status status = hs_pair_scan_begin(&scan, env, range, err);
    if (status == HS_OK) status = find(&f, env, n_wanted, nearest, err);
    if (status == HS_OK) {
#pragma omp parallel for schedule(static)
        for (int i = 0; i < nearest->n; ++i) (void)sort_one(nearest, i, n_wanted);
    }
    hs_nearest_fini(&f.table);
    hs_pair_scan_end(&scan);
    return status;
}

const hs_near *hs_nearest_of(const hs_nearest *nearest, int i, int n_wanted, int *n)
{
    const int64_t n_all = nearest->start[i + 1] - nearest->start[i];
    *n = n_wanted > 0 && n_all > n_wanted ? n_wanted : (int)n_all;
    return nearest->item + nearest->start[i];
}
