#include "style/pair_rows.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "comm/deliver.h"
#include "style/pair_scan.h"

void hs_pair_rows_fini(hs_pair_rows *rows)
{
    HS_FREE(rows->order);
    HS_FREE(rows->row);
    rows->n = 0;
}

/* Finding */

typedef struct search {
    hs_pair_scan scan;
    hs_pair_view view;
    const hs_pair *pair;
    uint32_t mask;
    hs_pair_choice choice;
    bool with_forces;
    hs_pair_row *row;
    int64_t *next; /**< owned [threads]: pairs that a thread has counted; then, where its next row goes */
} search;

/** Whether atoms so far apart are put into the lists: LAMMPS lists pairs up to and at the limit. */
static bool is_list_distance(const search *s, double cutoff, double sum_of_radii, double r2)
{
    const double reach = cutoff + s->view.skin, reach_of_radii = sum_of_radii + s->view.skin;
    return r2 <= reach * reach && (!s->view.listed_by_radius || r2 < reach_of_radii * reach_of_radii);
}

static bool is_chosen(const search *s, int i, int j, double r2)
{
    const hs_pair_scan *scan = &s->scan;
    const double cutoff =
                     s->pair->cutoff[hs_pair_index(s->pair, hs_pair_scan_type(scan, i), hs_pair_scan_type(scan, j))],
                 sum_of_radii = scan->radius != NULL ? scan->radius[i] + scan->radius[j] : 0.0;
    if (!(scan->mask[i] & scan->mask[j] & s->mask) || cutoff <= 0.0) return false;
    if (s->choice == HS_PAIRS_IN_CUTOFF && !(r2 < cutoff * cutoff)) return false;
    if (s->choice == HS_PAIRS_IN_CONTACT && !(r2 < sum_of_radii * sum_of_radii)) return false;
    const bool is_as_listed = s->choice == HS_PAIRS_IN_LISTS || scan->x_listed[0] == NULL;
    return is_list_distance(s, cutoff, sum_of_radii, is_as_listed ? r2 : hs_pair_scan_listed_r2(scan, i, j));
}

/** Pair p of a batch, the atom of the lower id first. */
static void fill_row(const search *s, const hs_pair_batch *batch, int p, hs_pair_row *row)
{
    const hs_pair_scan *scan = &s->scan;
    const int i = batch->i[p], j = batch->j[p];
    bool is_turned = scan->id[i] > scan->id[j];
    if (scan->id[i] == scan->id[j]) {
        int axis = 0;
        while (axis < 2 && batch->dx[axis][p] == 0.0) ++axis;
        is_turned = batch->dx[axis][p] > 0.0;
    }
    const int atom[2] = {is_turned ? j : i, is_turned ? i : j};
    for (int k = 0; k < 2; ++k) {
        row->id[k] = scan->id[atom[k]];
        row->type[k] = hs_pair_scan_type(scan, atom[k]);
    }
    for (int axis = 0; axis < 3; ++axis) /* 0 has no sign */
        row->d[axis] = is_turned ? batch->dx[axis][p] + 0.0 : 0.0 - batch->dx[axis][p];
    row->force_over_r = row->energy = 0.0;
    if (s->with_forces && s->choice != HS_PAIRS_IN_LISTS && s->view.pair != NULL)
        hs_pair_scan_eval(scan, &s->view, i, j, batch->r2[p], &row->force_over_r, &row->energy);
}

static void count_batch(void *context, int thread, const hs_pair_batch *batch)
{
    const search *s = context;
    int64_t n = 0;
    for (int p = 0; p < batch->n; ++p) n += is_chosen(s, batch->i[p], batch->j[p], batch->r2[p]);
    s->next[thread] += n;
}

static void take_batch(void *context, int thread, const hs_pair_batch *batch)
{
    const search *s = context;
    for (int p = 0; p < batch->n; ++p)
        if (is_chosen(s, batch->i[p], batch->j[p], batch->r2[p])) fill_row(s, batch, p, &s->row[s->next[thread]++]);
}

/** Where each thread's rows begin, from how many it has. *n: of all. */
static void place_threads(search *s, int64_t *n)
{
    *n = 0;
    for (int t = 0; t < hs_threads_get(); ++t) {
        const int64_t n_of_thread = s->next[t];
        s->next[t] = *n;
        *n += n_of_thread;
    }
}

/** The scan that the choice asks for. */
static hs_status begin_scan(search *s, hs_env *env, hs_error *err)
{
    const double cutoff = s->view.cutoff_max, reach = cutoff + s->view.skin;
    if (s->choice == HS_PAIRS_IN_LISTS)
        return hs_pair_scan_begin_at_lists(&s->scan, env, nextafter(reach, INFINITY), err);
    return hs_pair_scan_begin_at_forces(&s->scan, env, s->choice == HS_PAIRS_IN_CONTACT ? reach : cutoff, err);
}

/** The pairs of this rank's scan, in any order: counted, then taken, for threads meet the same ones both times. */
static hs_status search_pairs(search *s, hs_env *env, hs_pair_rows *rows, hs_error *err)
{
    HS_UNLESS_FAILED(err, HS_ALLOC(s->next, (size_t)hs_threads_get(), err));
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) status = begin_scan(s, env, err);
    if (status == HS_OK) {
        hs_pair_scan_visit(&s->scan, count_batch, s);
        place_threads(s, &rows->n);
        status = HS_ALLOC(rows->row, (size_t)rows->n, err);
        s->row = rows->row;
    }
    if (status == HS_OK) hs_pair_scan_visit(&s->scan, take_batch, s);
    hs_pair_scan_end(&s->scan);
    HS_FREE(s->next);
    return status;
}

/* Order */

/** Ids from lo on, cut into parts. */
typedef struct id_parts {
    int64_t lo, n;
    double per_id; /**< parts an id takes up */
} id_parts;

static id_parts cut_ids(int64_t lo, int64_t hi, int64_t n)
{
    return (id_parts){.lo = lo, .n = n, .per_id = (double)n / ((double)(hi - lo) + 1.0)};
}

/** Ascends with the id. */
static inline int64_t part_of(const id_parts *parts, int64_t id)
{
    const int64_t part = (int64_t)((double)(id - parts->lo) * parts->per_id);
    return part < parts->n ? part : parts->n - 1;
}

/** rows->order with the rows of each part of the ids behind those of the part before: from (*begin)[p] to (*begin)[p + 1] - 1 they are
 *  of part p. *begin is the caller's, also after an error. */
static hs_status group_rows(hs_pair_rows *rows, const id_parts *parts, int64_t **begin, hs_error *err)
{
    HS_TRY(HS_ALLOC(*begin, (size_t)parts->n + 2, err));
    HS_TRY(HS_ALLOC(rows->order, (size_t)rows->n, err));
    int64_t *next = *begin + 1; /* shifted by one: next[p] ends as begin[p + 1] */
    for (int64_t k = 0; k < rows->n; ++k) ++next[part_of(parts, rows->row[k].id[0]) + 1];
    for (int64_t p = 0; p < parts->n; ++p) next[p + 1] += next[p];
    for (int64_t k = 0; k < rows->n; ++k) rows->order[next[part_of(parts, rows->row[k].id[0])]++] = &rows->row[k];
    return HS_OK;
}

/** The rows themselves in the order of rows->order, which is given back. */
static hs_status move_rows(hs_pair_rows *rows, hs_error *err)
{
    hs_pair_row *moved;
    HS_TRY(HS_ALLOC(moved, (size_t)rows->n, err));
    for (int64_t k = 0; k < rows->n; ++k) moved[k] = *rows->order[k];
    HS_FREE(rows->order);
    HS_FREE(rows->row);
    rows->row = moved;
    return HS_OK;
}

/** Give every rank the rows whose lower ids are in its part of the ids (collective, errors agreed). */
static hs_status share_rows(hs_pair_rows *rows, const hs_env *env, hs_error *err)
{
    const hs_parallel *parallel = env->parallel;
    int64_t max_id = hs_atoms_max_id(env->atoms), *begin = NULL;
    if (parallel->n_ranks == 1) return err->status;
    hs_parallel_max_int64(parallel, &max_id, 1);
    const id_parts parts = cut_ids(1, max_id, parallel->n_ranks);
    HS_UNLESS_FAILED(err, group_rows(rows, &parts, &begin, err));
    HS_UNLESS_FAILED(err, move_rows(rows, err));
    for (int rank = 0; rank < parallel->n_ranks && err->status == HS_OK; ++rank)
        begin[rank] = begin[rank + 1] - begin[rank];
    void *received;
    const hs_status status = hs_deliver(parallel, rows->row, sizeof *rows->row, begin, &received, &rows->n, err);
    HS_FREE(begin);
    HS_FREE(rows->row);
    rows->row = received;
    return status;
}

static int compare_rows(const void *a, const void *b)
{
    const hs_pair_row *x = *(hs_pair_row *const *)a, *y = *(hs_pair_row *const *)b;
    for (int k = 0; k < 2; ++k)
        if (x->id[k] != y->id[k]) return x->id[k] < y->id[k] ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis)
        if (x->d[axis] != y->d[axis]) return x->d[axis] < y->d[axis] ? -1 : 1;
    return 0;
}

/** Sort this rank's rows: into parts of few rows, and within them. */
static hs_status sort_rows(hs_pair_rows *rows, hs_error *err)
{
    int64_t lo = INT64_MAX, hi = 1, *begin = NULL;
    for (int64_t k = 0; k < rows->n; ++k) {
        const int64_t id = rows->row[k].id[0];
        lo = id < lo ? id : lo;
        hi = id > hi ? id : hi;
    }
    const id_parts parts = cut_ids(lo < hi ? lo : hi, hi, rows->n / 8 + 1);
    const hs_status status = group_rows(rows, &parts, &begin, err);
    const int64_t n_parts = status == HS_OK ? parts.n : 0;
#pragma omp parallel for schedule(dynamic, 1024)
    for (int64_t p = 0; p < n_parts; ++p)
        qsort(rows->order + begin[p], (size_t)(begin[p + 1] - begin[p]), sizeof *rows->order, compare_rows);
    HS_FREE(begin);
    return status;
}

hs_status hs_pair_rows_find(hs_pair_rows *rows, const hs_compute *compute, hs_pair_choice choice, bool with_forces,
                            hs_error *err)
{
    hs_env *env = compute->env;
    search s = {.pair = env->pair(env), .mask = compute->mask, .choice = choice, .with_forces = with_forces};
    *rows = (hs_pair_rows){.n = 0};
    env->view_pairs(env, &s.view);
    if (!(s.view.cutoff_max > 0.0))
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: there are no pairs before the first run, nor without a pair style that has cutoffs: 'run 0' "
            "makes lists of them, and 'pair_style zero' has cutoffs without forces",
            hs_compute_who(compute).text);
    HS_UNLESS_FAILED(err, search_pairs(&s, env, rows, err));
    HS_TRY(share_rows(rows, env, err));
    HS_UNLESS_FAILED(err, sort_rows(rows, err));
    return hs_parallel_agree(env->parallel, err);
}
