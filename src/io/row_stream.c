#include "io/row_stream.h"

#include "base/memory.h"

/* Pieces in which rows travel: some hundred kilobytes, less where pieces of very many ranks must be held at once. */
enum { PIECE_BYTES_MAX = 1 << 19, PIECE_BYTES_MIN = 1 << 12, PIECES_BYTES = 1 << 27 };

/** A row within a piece. */
typedef struct placed_row {
    hs_row_key key;
    int64_t begin, length; /**< of its text */
} placed_row;

/** Some rows of one rank, in order. */
typedef struct piece {
    placed_row *row; /**< owned [capacity_rows] */
    hs_text text;
    int64_t n, capacity_rows;
    int64_t next;  /**< first row not written yet */
    int64_t taken; /**< rows of this rank in this piece and those before it */
    bool is_last;  /**< no further piece comes */
} piece;

static void fini_piece(piece *p)
{
    HS_FREE(p->row);
    hs_text_fini(&p->text);
}

int hs_row_compare(const hs_row_key *a, const hs_row_key *b, bool is_descending)
{
    if (a->value != b->value) return (a->value < b->value) != is_descending ? -1 : 1;
    return (a->id > b->id) - (a->id < b->id);
}

static hs_status reserve_rows(piece *p, int64_t n, hs_error *err)
{
    if (n <= p->capacity_rows) return HS_OK;
    const int64_t capacity = 2 * n + 64;
    HS_TRY(HS_GROW(p->row, (size_t)p->n, (size_t)capacity, err));
    p->capacity_rows = capacity;
    return HS_OK;
}

static size_t piece_bytes(const hs_parallel *parallel)
{
    const int64_t share = PIECES_BYTES / parallel->n_ranks;
    return (size_t)(share > PIECE_BYTES_MAX ? PIECE_BYTES_MAX : share < PIECE_BYTES_MIN ? PIECE_BYTES_MIN : share);
}

/** Make the text of this rank's next rows. */
static hs_status fill(piece *p, const hs_text_rows *rows, const hs_parallel *parallel, hs_error *err)
{
    const size_t n_bytes = piece_bytes(parallel);
    hs_text_clear(&p->text);
    p->n = p->next = 0;
    while (p->taken < rows->n && p->text.length < n_bytes) {
        const int64_t k = p->taken, begin = (int64_t)p->text.length;
        HS_TRY(reserve_rows(p, p->n + 1, err));
        HS_TRY(rows->format(rows->context, k, &p->text, err));
        const hs_row_key key = rows->by_rank ? (hs_row_key){parallel->rank, k} : rows->key(rows->context, k);
        p->row[p->n++] = (placed_row){.key = key, .begin = begin, .length = (int64_t)p->text.length - begin};
        ++p->taken;
    }
    p->is_last = p->taken == rows->n;
    return HS_OK;
}

/** What goes before a piece. */
typedef struct announcement {
    int64_t n_rows, n_bytes, is_last;
} announcement;

/** Send all rows of this rank to the first one, piece by piece. When the text of a row cannot be made the others must
 *  not wait for it: an empty last piece ends the rows, and the error is agreed on later. */
static void send_rows(const hs_text_rows *rows, const hs_parallel *parallel, hs_error *err)
{
    piece p = {0};
    do {
        if (fill(&p, rows, parallel, err) != HS_OK) {
            p.n = 0;
            p.is_last = true;
            hs_text_clear(&p.text);
        }
        const announcement head = {p.n, (int64_t)p.text.length, p.is_last};
        hs_parallel_send(parallel, 0, &head, sizeof head);
        hs_parallel_send(parallel, 0, p.row, (size_t)p.n * sizeof *p.row);
        hs_parallel_send(parallel, 0, p.text.data, p.text.length);
    } while (!p.is_last);
    fini_piece(&p);
}

/** Bytes that nobody can keep: the sender waits for them to be taken. */
static void discard(const hs_parallel *parallel, int rank, int64_t n)
{
    char waste[4096];
    for (int64_t at = 0, length; at < n; at += length) {
        length = n - at < (int64_t)sizeof waste ? n - at : (int64_t)sizeof waste;
        hs_parallel_receive(parallel, rank, waste, (size_t)length);
    }
}

/** The next piece of another rank. */
static void receive_piece(piece *p, const hs_parallel *parallel, int rank, hs_error *err)
{
    announcement head;
    hs_parallel_receive(parallel, rank, &head, sizeof head);
    p->n = p->next = 0;
    hs_text_clear(&p->text);
    HS_UNLESS_FAILED(err, reserve_rows(p, head.n_rows, err));
    HS_UNLESS_FAILED(err, hs_text_reserve(&p->text, (size_t)head.n_bytes, err));
    p->is_last = head.is_last != 0;
    if (err->status != HS_OK) {
        discard(parallel, rank, head.n_rows * (int64_t)sizeof *p->row);
        discard(parallel, rank, head.n_bytes);
        return;
    }
    hs_parallel_receive(parallel, rank, p->row, (size_t)head.n_rows * sizeof *p->row);
    hs_parallel_receive(parallel, rank, p->text.data, (size_t)head.n_bytes);
    p->n = head.n_rows;
    p->text.length = (size_t)head.n_bytes;
}

/** Bring a rank's piece to its next row; false when it has none left. */
static bool advance(piece *p, int rank, const hs_text_rows *rows, const hs_parallel *parallel, hs_error *err)
{
    while (p->next == p->n) {
        if (p->is_last) return false;
        if (rank != parallel->rank)
            receive_piece(p, parallel, rank, err);
        else if (err->status != HS_OK || fill(p, rows, parallel, err) != HS_OK)
            p->is_last = true, p->n = p->next = 0;
    }
    return true;
}

/** Ranks by the keys of their next rows: a heap, the first row on top. */
typedef struct merge {
    piece *piece; /**< owned [n_ranks] */
    int *heap;    /**< owned [n_ranks]: ranks that have rows */
    int n;
    bool is_descending;
} merge;

static bool is_before(const merge *m, int a, int b)
{
    const piece *p = &m->piece[a], *q = &m->piece[b];
    return hs_row_compare(&p->row[p->next].key, &q->row[q->next].key, m->is_descending) < 0;
}

static void sift_down(merge *m, int root)
{
    for (int child = 2 * root + 1; child < m->n; root = child, child = 2 * root + 1) {
        if (child + 1 < m->n && is_before(m, m->heap[child + 1], m->heap[child])) ++child;
        if (!is_before(m, m->heap[child], m->heap[root])) return;
        const int rank = m->heap[root];
        m->heap[root] = m->heap[child];
        m->heap[child] = rank;
    }
}

/** First rank: take rows off the ranks in order. After an error all rows are still taken, so that nobody waits. */
static void merge_rows(merge *m, const hs_text_rows *rows, hs_writer *writer, const hs_parallel *parallel,
                       hs_error *err)
{
    for (int rank = 0; rank < parallel->n_ranks; ++rank)
        if (advance(&m->piece[rank], rank, rows, parallel, err)) m->heap[m->n++] = rank;
    for (int root = m->n / 2 - 1; root >= 0; --root) sift_down(m, root);
    while (m->n > 0) {
        const int rank = m->heap[0];
        piece *p = &m->piece[rank];
        const placed_row *row = &p->row[p->next++];
        HS_UNLESS_FAILED(err, hs_writer_bytes(writer, p->text.data + row->begin, (size_t)row->length, err));
        if (!advance(p, rank, rows, parallel, err)) m->heap[0] = m->heap[--m->n];
        sift_down(m, 0);
    }
}

/** One rank: no keys, no pieces. */
static hs_status write_alone(const hs_text_rows *rows, hs_writer *writer, hs_error *err)
{
    hs_text text = {0};
    hs_status status = HS_OK;
    for (int64_t k = 0; k < rows->n && status == HS_OK; ++k) {
        hs_text_clear(&text);
        status = rows->format(rows->context, k, &text, err);
        if (status == HS_OK) status = hs_writer_bytes(writer, hs_text_get(&text), text.length, err);
    }
    hs_text_fini(&text);
    return status;
}

hs_status hs_text_rows_write(const hs_text_rows *rows, hs_writer *writer, const hs_parallel *parallel, hs_error *err)
{
    merge m = {.is_descending = rows->is_descending && !rows->by_rank};
    if (parallel->n_ranks <= 1) return err->status != HS_OK ? err->status : write_alone(rows, writer, err);
    if (parallel->rank == 0) {
        HS_UNLESS_FAILED(err, HS_ALLOC(m.piece, (size_t)parallel->n_ranks, err));
        HS_UNLESS_FAILED(err, HS_ALLOC(m.heap, (size_t)parallel->n_ranks, err));
    }
    if (hs_parallel_agree(parallel, err) == HS_OK) {
        if (parallel->rank == 0)
            merge_rows(&m, rows, writer, parallel, err);
        else
            send_rows(rows, parallel, err);
        (void)!hs_parallel_agree(parallel, err); /* the status is in err, too */
    }
    for (int rank = 0; m.piece != NULL && rank < parallel->n_ranks; ++rank) fini_piece(&m.piece[rank]);
    HS_FREE(m.piece);
    HS_FREE(m.heap);
    return err->status;
}
