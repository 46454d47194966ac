#include "style/pair_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "comm/deliver.h"
#include "style/pair_scan.h"

void hs_pair_rows_fini(hs_pair_rows *rows)
{
    HS_FREE(rows->order);
    for (int k = 0; k < rows->n_pieces; ++k) HS_FREE(rows->piece[k].row);
    HS_FREE(rows->piece);
    rows->n = rows->n_pieces = 0;
}

/* Finding */

typedef struct search {
    hs_pair_scan scan;
    hs_pair_view view;
    const hs_pair *pair;
    uint32_t mask;
    hs_pair_choice choice;
    bool with_forces;
    hs_pair_piece *piece; /**< [threads]: the rows of each */
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

/** Room for as many more rows; false: there is none. */
static bool has_room(hs_pair_piece *piece, size_t n)
{
    if (piece->err.status != HS_OK) return false;
    if (piece->n + n <= piece->capacity) return true;
    const size_t capacity = 2 * piece->capacity + n;
    if (HS_GROW(piece->row, piece->n, capacity, &piece->err) != HS_OK) return false;
    piece->capacity = capacity;
    return true;
}

static void take_batch(void *context, int thread, const hs_pair_batch *batch)
{
    const search *s = context;
    hs_pair_piece *piece = &s->piece[thread];
    if (!has_room(piece, (size_t)batch->n)) return;
    for (int p = 0; p < batch->n; ++p)
        if (is_chosen(s, batch->i[p], batch->j[p], batch->r2[p])) fill_row(s, batch, p, &piece->row[piece->n++]);
}

/** The scan that the choice asks for. */
static hs_status begin_scan(search *s, hs_env *env, hs_error *err)
{
    const double cutoff = s->view.cutoff_max, reach = cutoff + s->view.skin;
    if (s->choice == HS_PAIRS_IN_LISTS)
        return hs_pair_scan_begin_at_lists(&s->scan, env, nextafter(reach, INFINITY), err);
    return hs_pair_scan_begin_at_forces(&s->scan, env, s->choice == HS_PAIRS_IN_CONTACT ? reach : cutoff, err);
}

/** The pairs of this rank's scan, in any order. */
static hs_status search_pairs(search *s, hs_env *env, int64_t n_expected, hs_pair_rows *rows, hs_error *err)
{
    HS_UNLESS_FAILED(err, HS_ALLOC(rows->piece, (size_t)hs_threads_get(), err));
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) status = begin_scan(s, env, err);
    if (status == HS_OK) {
        rows->n_pieces = hs_threads_get();
        s->piece = rows->piece;
        const size_t expected = (size_t)(n_expected / rows->n_pieces);
        for (int k = 0; k < rows->n_pieces; ++k) (void)has_room(&rows->piece[k], expected + expected / 16);
        hs_pair_scan_visit(&s->scan, take_batch, s);
        for (int k = 0; k < rows->n_pieces; ++k) {
            rows->n += (int64_t)rows->piece[k].n;
            if (rows->piece[k].err.status != HS_OK && err->status == HS_OK) *err = rows->piece[k].err;
        }
    }
    hs_pair_scan_end(&s->scan);
    return err->status;
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

/** Bring places into the order of the parts of their lower (which = 0) or higher ids; those of one part keep theirs. From next[p] to
 *  next[p + 1] - 1 they are of part p, when it is done. next[parts->n + 2] is 0 before. */
static void group_places(const hs_pair_place *from, int64_t n, const id_parts *parts, int which, int64_t *next,
                         hs_pair_place *to)
{
    ++next; /* shifted by one: next[p] ends where part p + 1 begins */
    for (int64_t k = 0; k < n; ++k) ++next[part_of(parts, from[k].id[which]) + 1];
    for (int64_t p = 0; p < parts->n; ++p) next[p + 1] += next[p];
    for (int64_t k = 0; k < n; ++k) to[next[part_of(parts, from[k].id[which])]++] = from[k];
}

/** rows->order with the rows of each part of the lower ids behind those of the part before, and in each those of higher ids rather
 *  behind: from (*begin)[p] to (*begin)[p + 1] - 1 they are of part p. *begin is the caller's, also after an error. */
static hs_status group_rows(hs_pair_rows *rows, const id_parts *parts, int64_t **begin, hs_error *err)
{
    hs_pair_place *grouped = NULL;
    const size_t n_begin = (size_t)parts->n + 2;
    HS_TRY(HS_ALLOC(*begin, n_begin, err));
    HS_TRY(HS_ALLOC(rows->order, (size_t)rows->n, err));
    HS_TRY(HS_ALLOC(grouped, (size_t)rows->n, err));
    hs_pair_place *place = rows->order;
    for (int piece = 0; piece < rows->n_pieces; ++piece)
        for (size_t k = 0; k < rows->piece[piece].n; ++k) {
            const hs_pair_row *row = &rows->piece[piece].row[k];
            *place++ = (hs_pair_place){.id = {row->id[0], row->id[1]}, .row = row};
        }
    group_places(rows->order, rows->n, parts, 1, *begin, grouped);
    memset(*begin, 0, n_begin * sizeof **begin);
    group_places(grouped, rows->n, parts, 0, *begin, rows->order);
    HS_FREE(grouped);
    return HS_OK;
}

/** The rows of all pieces in one array, in the order of rows->order, which is given back with them. The array is the caller's. */
static hs_status take_rows(hs_pair_rows *rows, hs_pair_row **taken, hs_error *err)
{
    HS_TRY(HS_ALLOC(*taken, (size_t)rows->n, err));
    for (int64_t k = 0; k < rows->n; ++k) (*taken)[k] = *rows->order[k].row;
    hs_pair_rows_fini(rows);
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
    hs_pair_row *leaving = NULL;
    void *received = NULL;
    int64_t n_received = 0;
    HS_UNLESS_FAILED(err, group_rows(rows, &parts, &begin, err));
    HS_UNLESS_FAILED(err, take_rows(rows, &leaving, err));
    HS_UNLESS_FAILED(err, HS_ALLOC(rows->piece, 1, err));
    for (int rank = 0; rank < parallel->n_ranks && err->status == HS_OK; ++rank)
        begin[rank] = begin[rank + 1] - begin[rank];
    const hs_status status = hs_deliver(parallel, leaving, sizeof *leaving, begin, &received, &n_received, err);
    HS_FREE(begin);
    HS_FREE(leaving);
    if (status != HS_OK) return status;
    rows->n_pieces = 1;
    rows->piece[0] = (hs_pair_piece){.row = received, .n = (size_t)n_received};
    rows->n = n_received;
    return HS_OK;
}

static int compare_places(const void *a, const void *b)
{
    const hs_pair_place *x = a, *y = b;
    for (int k = 0; k < 2; ++k)
        if (x->id[k] != y->id[k]) return x->id[k] < y->id[k] ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis)
        if (x->row->d[axis] != y->row->d[axis]) return x->row->d[axis] < y->row->d[axis] ? -1 : 1;
    return 0;
}

/** Most parts are the rows of one atom, which are in order already unless it meets an image of itself or two of another. */
static void sort_part(hs_pair_place *order, int64_t n)
{
    enum { FEW = 64 };
    if (n > FEW) {
        qsort(order, (size_t)n, sizeof *order, compare_places);
        return;
    }
    for (int64_t k = 1; k < n; ++k) {
        const hs_pair_place place = order[k];
        int64_t at = k;
        for (; at > 0 && compare_places(&place, &order[at - 1]) < 0; --at) order[at] = order[at - 1];
        order[at] = place;
    }
}

/** Sort this rank's rows: into parts of few rows, and within them. */
static hs_status sort_rows(hs_pair_rows *rows, hs_error *err)
{
    int64_t lo = INT64_MAX, hi = 1, *begin = NULL;
    for (int piece = 0; piece < rows->n_pieces; ++piece)
        for (size_t k = 0; k < rows->piece[piece].n; ++k) {
            const int64_t *id = rows->piece[piece].row[k].id;
            lo = id[0] < lo ? id[0] : lo;
            hi = id[1] > hi ? id[1] : hi;
        }
    const int64_t span = lo < hi ? hi - lo + 1 : 1;
    const id_parts parts = cut_ids(lo < hi ? lo : hi, hi, span < rows->n ? span : rows->n + 1);
    const hs_status status = group_rows(rows, &parts, &begin, err);
    const int64_t n_parts = status == HS_OK ? parts.n : 0;
#pragma omp parallel for schedule(dynamic, 1024)
    for (int64_t p = 0; p < n_parts; ++p) sort_part(rows->order + begin[p], begin[p + 1] - begin[p]);
    HS_FREE(begin);
    return status;
}

hs_status hs_pair_rows_find(hs_pair_rows *rows, const hs_compute *compute, hs_pair_choice choice, bool with_forces,
                            int64_t n_expected, hs_error *err)
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
    HS_UNLESS_FAILED(err, search_pairs(&s, env, n_expected, rows, err));
    HS_TRY(share_rows(rows, env, err));
    HS_UNLESS_FAILED(err, sort_rows(rows, err));
    return hs_parallel_agree(env->parallel, err);
}
