/* Bond-orientational order of each atom:  q_n = (1/N) sum over its neighbors exp(i n theta).
 * Source: D. R. Nelson, B. I. Halperin, Phys. Rev. B 19, 2457 (1979), doi:10.1103/PhysRevB.19.2457. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/compute.h"
#include "style/pair_scan.h"

typedef struct hexorder_state {
    int64_t degree;
    int n_nearest; /**< neighbors that count; 0: all within the cutoff */
    double cutoff; /**< 0: that of the pair style */
} hexorder_state;

static const hs_keyword keywords[] = {
    {"degree", 1, "<n>", "of the symmetry: 6 for hexagons (default: 6)"},
    {"nnn", 1, "<N>|NULL", "nearest neighbors that count; NULL: all within the cutoff (default: 6)"},
    {"cutoff", 1, "<distance>", "where neighbors are looked for (default: the cutoff of the pair style)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    hexorder_state *state = compute->state;
    int64_t n_nearest = 6;
    state->degree = 6;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    for (int i = 0; i + 1 < args->n; i += 2) {
        if (strcmp(args->word[i], "degree") == 0)
            HS_TRY(hs_arg_int(args, i + 1, 1, 1000, &state->degree, err));
        else if (strcmp(args->word[i], "cutoff") == 0)
            HS_TRY(hs_arg_positive(args, i + 1, &state->cutoff, err));
        else if (strcmp(args->word[i + 1], "NULL") == 0)
            n_nearest = 0;
        else
            HS_TRY(hs_arg_int(args, i + 1, 1, 1000, &n_nearest, err));
    }
    state->n_nearest = (int)n_nearest;
    compute->n_atom_columns = 2;
    return HS_OK;
}

/** A neighbor as seen from an atom. */
typedef struct neighbor {
    double r2, dx, dy;
    int64_t id;
} neighbor;

/** The neighbors of each atom, one atom after the other. */
typedef struct table {
    int64_t *start; /**< owned [n + 2]; while the table is filled, start[i + 1] is the next free place of atom i */
    neighbor *item; /**< owned */
    int n;
} table;

static void table_fini(table *t)
{
    HS_FREE(t->start);
    HS_FREE(t->item);
}

/** Turn counts of atom i in start[i + 2] into places. */
static hs_status table_lay_out(table *t, hs_error *err)
{
    for (int i = 0; i < t->n; ++i) t->start[i + 2] += t->start[i + 1];
    return HS_ALLOC(t->item, (size_t)t->start[t->n + 1], err);
}

static inline neighbor *table_place(table *t, int i)
{
    int64_t place;
#pragma omp atomic capture
    place = t->start[i + 1]++;
    return &t->item[place];
}

typedef struct finding {
    const hs_pair_scan *scan;
    table table; /**< of local and halo atoms */
} finding;

static void count_pairs(void *context, int thread, const hs_pair_batch *batch)
{
    finding *f = context;
    (void)thread;
    for (int p = 0; p < batch->n; ++p) {
#pragma omp atomic
        ++f->table.start[batch->i[p] + 2];
#pragma omp atomic
        ++f->table.start[batch->j[p] + 2];
    }
}

static void keep_pairs(void *context, int thread, const hs_pair_batch *batch)
{
    finding *f = context;
    const int64_t *id = f->scan->id;
    (void)thread;
    for (int p = 0; p < batch->n; ++p) {
        const int i = batch->i[p], j = batch->j[p];
        const double dx = batch->dx[0][p], dy = batch->dx[1][p];
        *table_place(&f->table, i) = (neighbor){.r2 = batch->r2[p], .dx = -dx, .dy = -dy, .id = id[j]};
        *table_place(&f->table, j) = (neighbor){.r2 = batch->r2[p], .dx = dx, .dy = dy, .id = id[i]};
    }
}

/** By distance; then by whatever makes the order definite. */
static bool is_before(const neighbor *a, const neighbor *b)
{
    if (a->r2 != b->r2) return a->r2 < b->r2;
    if (a->id != b->id) return a->id < b->id;
    return a->dx != b->dx ? a->dx < b->dx : a->dy < b->dy;
}

/** Bring the nearest neighbors of atom i to the front of its part of the table; how many of them there are. */
static int sort_nearest(const table *t, int i, int n_wanted)
{
    neighbor *item = t->item + t->start[i];
    const int n = (int)(t->start[i + 1] - t->start[i]);
    for (int k = 1; k < n; ++k) {
        const neighbor moved = item[k];
        int at = k;
        for (; at > 0 && is_before(&moved, &item[at - 1]); --at) item[at] = item[at - 1];
        item[at] = moved;
    }
    return n_wanted > 0 && n > n_wanted ? n_wanted : n;
}

/** Neighbors that this rank has found of atoms of others, and those that others have found of atoms of this rank. */
typedef struct mail {
    int64_t n_records;  /**< neighbors of each atom, at most */
    neighbor *sent;     /**< owned [n_all][n_records] */
    neighbor *received; /**< owned [halo.out.n][n_records]; ids of 0: none */
} mail;

/** The nearest neighbors of halo atoms go to the ranks of these atoms. */
static hs_status exchange(const finding *f, const hs_env *env, int n_wanted, mail *m, hs_error *err)
{
    const hs_pair_scan *scan = f->scan;
    const table *t = &f->table;
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
        const int n = sort_nearest(t, j, n_wanted);
        if (n > 0) memcpy(m->sent + (size_t)j * n_records, t->item + t->start[j], (size_t)n * sizeof(neighbor));
    }
    hs_halo_collect(&scan->halo, &scan->atoms, m->sent, n_records * sizeof(neighbor), m->received);
    return HS_OK;
}

/** All neighbors of the local atoms: those that this rank has found, and those in the mail. */
static hs_status merge(const finding *f, const mail *m, table *all, hs_error *err)
{
    const hs_pair_scan *scan = f->scan;
    const int64_t n_received = scan->halo.out.n * m->n_records;
    all->n = scan->atoms.n_local;
    HS_TRY(HS_ALLOC(all->start, (size_t)all->n + 2, err));
    for (int i = 0; i < all->n; ++i) all->start[i + 2] = f->table.start[i + 1] - f->table.start[i];
    for (int64_t k = 0; k < n_received; ++k)
        all->start[scan->halo.source[k / m->n_records] + 2] += m->received[k].id > 0;
    HS_TRY(table_lay_out(all, err));
    for (int i = 0; i < all->n; ++i)
        for (int64_t k = f->table.start[i]; k < f->table.start[i + 1]; ++k) *table_place(all, i) = f->table.item[k];
    for (int64_t k = 0; k < n_received; ++k)
        if (m->received[k].id > 0) *table_place(all, scan->halo.source[k / m->n_records]) = m->received[k];
    return HS_OK;
}

static hs_status find_neighbors(finding *f, const hs_env *env, int n_wanted, table *all, hs_error *err)
{
    mail m = {0};
    f->table.n = f->scan->n_all;
    hs_status status = HS_ALLOC(f->table.start, (size_t)f->table.n + 2, err);
    if (status == HS_OK) {
        hs_pair_scan_visit(f->scan, count_pairs, f);
        status = table_lay_out(&f->table, err);
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

/** q_n of one atom from its sorted neighbors. */
static void find_order(const hexorder_state *state, const neighbor *item, int n, double q[2])
{
    q[0] = q[1] = 0.0;
    if (n == 0 || n < state->n_nearest) return;
    for (int k = 0; k < n; ++k) {
        const double angle = (double)state->degree * atan2(item[k].dy, item[k].dx);
        q[0] += cos(angle) / n;
        q[1] += sin(angle) / n;
    }
}

static hs_status find_range(const hs_compute *compute, double *range, hs_error *err)
{
    const hexorder_state *state = compute->state;
    hs_pair_view view;
    *range = state->cutoff;
    if (state->cutoff > 0.0) return HS_OK;
    compute->env->view_pairs(compute->env, &view);
    *range = view.cutoff_max;
    if (*range > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "compute '%s' (hexorder/atom): there is no cutoff of a pair style before the first run, or none at "
                   "all; 'cutoff <distance>' says where to look for neighbors",
                   compute->id);
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const hexorder_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const size_t n_local = (size_t)atoms->n_local;
    hs_pair_scan scan = {0};
    finding f = {.scan = &scan};
    table all = {0};
    double range;
    HS_TRY(find_range(compute, &range, err));
    hs_status status = hs_pair_scan_begin(&scan, compute->env, range, err);
    if (status == HS_OK) status = find_neighbors(&f, compute->env, state->n_nearest, &all, err);
    if (status == HS_OK) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n_local; ++i) {
            double q[2] = {0.0, 0.0};
            const int n = sort_nearest(&all, (int)i, state->n_nearest);
            if (atoms->mask[i] & compute->mask) find_order(state, all.item + all.start[i], n, q);
            for (size_t column = 0; column < 2; ++column) compute->atoms[column * n_local + i] = q[column];
        }
    }
    table_fini(&f.table);
    table_fini(&all);
    hs_pair_scan_end(&scan);
    return status;
}

const hs_compute_style hs_compute_style_hexorder_atom = {
    .about = {.name = "hexorder/atom",
              .syntax = {.usage = "[keyword value ...]", .n_min = 0, .n_max = 0, .keywords = keywords},
              .summary = "bond-orientational order parameter of each atom",
              .details =
                  "q_n = (1/N) sum exp(i n theta) over the N nearest neighbors, theta being the angle of the bond with "
                  "the x axis in the xy plane; n is the degree. `c_ID[1]` is its real part, `c_ID[2]` its imaginary "
                  "part: |q_6| is 1 in a perfect hexagonal lattice. Neighbors are all atoms, of any group. An atom "
                  "with fewer than N neighbors within the cutoff, or outside of the compute's group, has 0.",
              .reference = "D. R. Nelson, B. I. Halperin, Phys. Rev. B 19, 2457 (1979), doi:10.1103/PhysRevB.19.2457",
              .example = "compute q all hexorder/atom degree 6 nnn 6 cutoff 2.0\n"
                         "variable psi atom sqrt(c_q[1]^2+c_q[2]^2)"},
    .state_size = sizeof(hexorder_state),
    .create = create,
    .per_atom = per_atom,
};
