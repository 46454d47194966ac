/* Values to and from halo atoms. Blocks of this rank itself are copied while the messages of the others are under way. */
#include <string.h>

#include "comm/halo.h"
#include "parallel/parallel.h"

/** Part of a per-atom array, as it stands in the words of a message. */
typedef struct piece {
    char *array;
    size_t stride, at;    /**< bytes an atom, and where the piece begins in them */
    size_t place, length; /**< where it goes in the words of an atom */
} piece;

/** Atom k of another rank's block, in the buffer of a side. */
static inline double *words_of(const hs_halo_side *side, int k)
{
    return side->buffer + (int64_t)(k - side->n_self_atoms) * HS_HALO_WORDS;
}

void hs_halo_fit_box(hs_halo *halo, const hs_box *box)
{
    for (int b = 0; b < halo->out.n_blocks; ++b) {
        hs_halo_block *block = &halo->out.block[b];
        hs_box_shift(box, block->image, block->shift);
    }
}

/** First place in [begin, end) whose source is not below `atom`; if sources do not ascend, some place that only grows with it. */
static int place_of(const hs_halo *halo, int begin, int end, int64_t atom)
{
    while (begin < end) {
        const int middle = begin + (end - begin) / 2;
        if (halo->source[middle] < atom)
            begin = middle + 1;
        else
            end = middle;
    }
    return begin;
}

/** Share of the calling thread in a block to send: copies of the atoms that are its share in all loops over atoms, so that it finds them in
 *  its cache and does not take them from another's. */
static void share_of_block(const hs_halo *halo, const hs_halo_block *block, int n_local, int *begin, int *end)
{
    int64_t first, last;
    const int thread = hs_thread_number(), n_threads = hs_thread_count();
    hs_thread_range(n_local, 1, thread, n_threads, &first, &last);
    *begin = place_of(halo, block->begin, block->end, first);
    *end = thread == n_threads - 1 ? block->end : place_of(halo, block->begin, block->end, last);
}

static void pack_positions(const hs_halo *halo, int n_local, double *const position[3])
{
    for (int b = halo->out.n_self, begin, end; b < halo->out.n_blocks; ++b) {
        const hs_halo_block *block = &halo->out.block[b];
        share_of_block(halo, block, n_local, &begin, &end);
        for (int k = begin; k < end; ++k) {
            double *words = words_of(&halo->out, k);
            for (int axis = 0; axis < 3; ++axis) words[axis] = position[axis][halo->source[k]] + block->shift[axis];
        }
    }
}

static void copy_own_positions(const hs_halo *halo, int n_local, double *const position[3])
{
    for (int b = 0, begin, end; b < halo->out.n_self; ++b) {
        const hs_halo_block *block = &halo->out.block[b];
        share_of_block(halo, block, n_local, &begin, &end);
        for (int k = begin; k < end; ++k)
            for (int axis = 0; axis < 3; ++axis)
                position[axis][n_local + halo->slot[k]] = position[axis][halo->source[k]] + block->shift[axis];
    }
}

static void unpack_positions(const hs_halo *halo, int n_local, double *const position[3])
{
#pragma omp for schedule(static) nowait
    for (int k = halo->in.n_self_atoms; k < halo->n; ++k)
        for (int axis = 0; axis < 3; ++axis) position[axis][n_local + halo->slot[k]] = words_of(&halo->in, k)[axis];
}

/* Each of these on all threads, unless there is nothing to do. */

static void send_positions(const hs_halo *halo, int n_local, double *const position[3])
{
    if (halo->out.n > halo->out.n_self_atoms) HS_ON_THREADS(pack_positions(halo, n_local, position));
    hs_messages_start(&halo->forward);
}

static void make_own_images(const hs_halo *halo, int n_local, double *const position[3])
{
    if (halo->out.n_self_atoms > 0) HS_ON_THREADS(copy_own_positions(halo, n_local, position));
}

static void take_positions(const hs_halo *halo, int n_local, double *const position[3])
{
    if (halo->n > halo->in.n_self_atoms) HS_ON_THREADS(unpack_positions(halo, n_local, position));
}

void hs_halo_forward_positions(const hs_halo *halo, const hs_atoms *atoms, double *const position[3])
{
    send_positions(halo, atoms->n_local, position);
    make_own_images(halo, atoms->n_local, position);
    hs_messages_wait(&halo->forward);
    take_positions(halo, atoms->n_local, position);
}

void hs_halo_forward(const hs_halo *halo, hs_atoms *atoms) { hs_halo_forward_positions(halo, atoms, atoms->x); }

void hs_halo_forward_send(hs_halo *halo, hs_atoms *atoms)
{
    send_positions(halo, atoms->n_local, atoms->x);
    make_own_images(halo, atoms->n_local, atoms->x);
    halo->is_awaited = halo->forward.n > 0;
}

void hs_halo_forward_wait(hs_halo *halo)
{
    hs_messages_wait(&halo->forward);
    halo->is_awaited = false;
}

void hs_halo_forward_receive(const hs_halo *halo, hs_atoms *atoms) { take_positions(halo, atoms->n_local, atoms->x); }

static void renumber_slots(const hs_halo *halo, const int32_t *order)
{
#pragma omp for schedule(static) nowait
    for (int q = 0; q < halo->n; ++q) {
        halo->slot[order[q]] = q;
        halo->is_remote[q] = order[q] >= halo->in.n_self_atoms;
    }
}

void hs_halo_reorder(hs_halo *halo, hs_atoms *atoms, const int32_t *order)
{
    HS_ON_THREADS(renumber_slots(halo, order));
    make_own_images(halo, atoms->n_local, atoms->x);
    take_positions(halo, atoms->n_local, atoms->x); /* those of the build are in the buffer still */
}

/** The usual lengths as plain moves. */
static inline void copy_bytes(char *to, const char *from, size_t length)
{
    if (length == 4)
        memcpy(to, from, 4);
    else if (length == 8)
        memcpy(to, from, 8);
    else
        memcpy(to, from, length);
}

static void pack_pieces(const hs_halo *halo, const piece *pieces, int n_pieces)
{
#pragma omp for schedule(static) nowait
    for (int k = halo->out.n_self_atoms; k < halo->out.n; ++k)
        for (int p = 0; p < n_pieces; ++p)
            copy_bytes((char *)words_of(&halo->out, k) + pieces[p].place,
                       pieces[p].array + pieces[p].stride * (size_t)halo->source[k] + pieces[p].at, pieces[p].length);
}

static void copy_own_pieces(const hs_halo *halo, int n_local, const piece *pieces, int n_pieces)
{
#pragma omp for schedule(static) nowait
    for (int k = 0; k < halo->out.n_self_atoms; ++k)
        for (int p = 0; p < n_pieces; ++p) {
            char *array = pieces[p].array + pieces[p].at;
            copy_bytes(array + pieces[p].stride * (size_t)(n_local + halo->slot[k]),
                       array + pieces[p].stride * (size_t)halo->source[k], pieces[p].length);
        }
}

static void unpack_pieces(const hs_halo *halo, int n_local, const piece *pieces, int n_pieces)
{
#pragma omp for schedule(static) nowait
    for (int k = halo->in.n_self_atoms; k < halo->n; ++k)
        for (int p = 0; p < n_pieces; ++p)
            copy_bytes(pieces[p].array + pieces[p].stride * (size_t)(n_local + halo->slot[k]) + pieces[p].at,
                       (const char *)words_of(&halo->in, k) + pieces[p].place, pieces[p].length);
}

/** Bring pieces, which together fit into the words of an atom, to the halo. */
static void forward_pieces(const hs_halo *halo, int n_local, const piece *pieces, int n_pieces)
{
    if (halo->out.n > halo->out.n_self_atoms) HS_ON_THREADS(pack_pieces(halo, pieces, n_pieces));
    hs_messages_start(&halo->forward);
    HS_ON_THREADS(copy_own_pieces(halo, n_local, pieces, n_pieces));
    hs_messages_wait(&halo->forward);
    if (halo->n > halo->in.n_self_atoms) HS_ON_THREADS(unpack_pieces(halo, n_local, pieces, n_pieces));
}

enum { WORDS_BYTES = HS_HALO_WORDS * sizeof(double), PIECES_MAX = WORDS_BYTES / 4 };

/** Pieces gathered until the words of an atom are full. */
typedef struct batch {
    const hs_halo *halo;
    int n_local;
    piece piece[PIECES_MAX];
    int n;
    size_t filled;
} batch;

static void flush(batch *b)
{
    if (b->n > 0) forward_pieces(b->halo, b->n_local, b->piece, b->n);
    b->n = 0;
    b->filled = 0;
}

static void add_array(batch *b, void *array, size_t size)
{
    for (size_t at = 0, length; at < size; at += length) {
        if (b->filled == WORDS_BYTES) flush(b);
        length = size - at < WORDS_BYTES - b->filled ? size - at : WORDS_BYTES - b->filled;
        b->piece[b->n++] = (piece){.array = array, .stride = size, .at = at, .place = b->filled, .length = length};
        b->filled += length;
    }
}

void hs_halo_forward_array(const hs_halo *halo, const hs_atoms *atoms, void *values, size_t size)
{
    batch b = {.halo = halo, .n_local = atoms->n_local};
    add_array(&b, values, size);
    flush(&b);
}

void hs_halo_forward_fields(const hs_halo *halo, hs_atoms *atoms)
{
    batch b = {.halo = halo, .n_local = atoms->n_local};
    for (int k = 0; k < atoms->n_fields; ++k)
        if (atoms->field[k].goes_to_halo) add_array(&b, *atoms->field[k].array, atoms->field[k].size);
    flush(&b);
}

/** The one addition of the reverse exchange; in fixed point both are integers. */
static inline void add_back(double *to, const double *value, bool is_fixed)
{
    typedef uint64_t __attribute__((may_alias)) integer;
    if (is_fixed)
        *(integer *)to += *(const integer *)value;
    else
        *to += *value;
}

static void pack_back(const hs_halo *halo, int n_local, double *const values[3])
{
#pragma omp for schedule(static) nowait
    for (int k = halo->in.n_self_atoms; k < halo->n; ++k)
        for (int axis = 0; axis < 3; ++axis) words_of(&halo->in, k)[axis] = values[axis][n_local + halo->slot[k]];
}

/* Within one block a source occurs once at most. Where sources ascend, threads have atoms of their own in all blocks; else blocks follow
   one another. */

static void finish_block(const hs_halo *halo)
{
    if (halo->is_ascending) return;
#pragma omp barrier
}

static void add_own(const hs_halo *halo, int n_local, double *const values[3], bool is_fixed)
{
    for (int b = 0, begin, end; b < halo->out.n_self; ++b) {
        share_of_block(halo, &halo->out.block[b], n_local, &begin, &end);
        for (int k = begin; k < end; ++k)
            for (int axis = 0; axis < 3; ++axis)
                add_back(&values[axis][halo->source[k]], &values[axis][n_local + halo->slot[k]], is_fixed);
        finish_block(halo);
    }
}

static void add_received(const hs_halo *halo, int n_local, double *const values[3], bool is_fixed)
{
    for (int b = halo->out.n_self, begin, end; b < halo->out.n_blocks; ++b) {
        share_of_block(halo, &halo->out.block[b], n_local, &begin, &end);
        for (int k = begin; k < end; ++k)
            for (int axis = 0; axis < 3; ++axis)
                add_back(&values[axis][halo->source[k]], &words_of(&halo->out, k)[axis], is_fixed);
        finish_block(halo);
    }
}

static void send_back(const hs_halo *halo, int n_local, double *const values[3])
{
    if (halo->n > halo->in.n_self_atoms) HS_ON_THREADS(pack_back(halo, n_local, values));
    hs_messages_start(&halo->reverse);
}

static void take_own(const hs_halo *halo, int n_local, double *const values[3], bool is_fixed)
{
    if (halo->out.n_self_atoms > 0) HS_ON_THREADS(add_own(halo, n_local, values, is_fixed));
}

static void take_back(const hs_halo *halo, int n_local, double *const values[3], bool is_fixed)
{
    if (halo->out.n > halo->out.n_self_atoms) HS_ON_THREADS(add_received(halo, n_local, values, is_fixed));
}

void hs_halo_reverse(const hs_halo *halo, hs_atoms *atoms, bool is_fixed)
{
    send_back(halo, atoms->n_local, atoms->f);
    take_own(halo, atoms->n_local, atoms->f, is_fixed);
    hs_messages_wait(&halo->reverse);
    take_back(halo, atoms->n_local, atoms->f, is_fixed);
}

void hs_halo_reverse_send(const hs_halo *halo, const hs_atoms *atoms) { send_back(halo, atoms->n_local, atoms->f); }

void hs_halo_reverse_own(const hs_halo *halo, hs_atoms *atoms, bool is_fixed)
{
    take_own(halo, atoms->n_local, atoms->f, is_fixed);
}

void hs_halo_reverse_wait(const hs_halo *halo) { hs_messages_wait(&halo->reverse); }

void hs_halo_reverse_receive(const hs_halo *halo, hs_atoms *atoms, bool is_fixed)
{
    take_back(halo, atoms->n_local, atoms->f, is_fixed);
}

/** Bytes [at, at + length) of each value. */
static void collect_piece(const hs_halo *halo, int n_local, const char *values, size_t size, size_t at, size_t length,
                          char *collected)
{
#pragma omp parallel for schedule(static)
    for (int k = halo->in.n_self_atoms; k < halo->n; ++k)
        copy_bytes((char *)words_of(&halo->in, k), values + size * (size_t)(n_local + halo->slot[k]) + at, length);
    hs_messages_start(&halo->reverse);
#pragma omp parallel for schedule(static)
    for (int k = 0; k < halo->out.n_self_atoms; ++k)
        copy_bytes(collected + size * (size_t)k + at, values + size * (size_t)(n_local + halo->slot[k]) + at, length);
    hs_messages_wait(&halo->reverse);
#pragma omp parallel for schedule(static)
    for (int k = halo->out.n_self_atoms; k < halo->out.n; ++k)
        copy_bytes(collected + size * (size_t)k + at, (const char *)words_of(&halo->out, k), length);
}

void hs_halo_collect(const hs_halo *halo, const hs_atoms *atoms, const void *values, size_t size, void *collected)
{
    for (size_t at = 0; at < size; at += WORDS_BYTES)
        collect_piece(halo, atoms->n_local, values, size, at, size - at < WORDS_BYTES ? size - at : WORDS_BYTES,
                      collected);
}
