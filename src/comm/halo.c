/* Making the halo: which atoms go where. */
#include "comm/halo.h"

#include <string.h>

#include "base/memory.h"
#include "comm/halo_plan.h"

/* Parts into which several threads cut the atoms to find those that go to a halo: many more than threads. */
enum { PARTS_OF_THREADS = 64 };

/** Layers lo..hi along every axis that need an atom. */
typedef struct layer_range {
    int lo[3], hi[3];
} layer_range;

/** Whether an atom goes anywhere: atoms go down only (in lexicographic order), so it must be near a lower face. */
static inline bool is_near_lower_face(const hs_halo_plan *plan, const double x[3])
{
    return x[0] < plan->inner_lo[0] || x[1] < plan->inner_lo[1] || x[2] < plan->inner_lo[2];
}

static layer_range layers_of(const hs_halo_plan *plan, const double x[3])
{
    layer_range range;
    for (int axis = 0; axis < 3; ++axis) {
        const hs_halo_layers *layers = &plan->layers[axis];
        const double *shift = layers->shift + layers->below, *limit = layers->limit + layers->below;
        int lo = 0, hi = 0;
        while (-lo < layers->below && x[axis] + shift[lo - 1] < limit[lo - 1]) --lo;
        while (hi < layers->above && x[axis] + shift[hi + 1] >= limit[hi + 1]) ++hi;
        range.lo[axis] = lo;
        range.hi[axis] = hi;
    }
    return range;
}

/** From a place to its coordinates by which the planes are compared. */
static void make_upright(const hs_box *box, double x[3])
{
    const double place[3] = {x[0], x[1], x[2]};
    for (int axis = 0; axis < 2; ++axis) x[axis] = hs_box_upright(box, place, axis);
}

/** Count (source == NULL) or write the local atoms [begin, end) that go to other bricks: next[b] is the place of the next
 *  atom of block b, or the count so far. */
static void list_atoms(const hs_halo_plan *plan, const hs_atoms *atoms, int64_t begin, int64_t end, int *next,
                       int32_t *source)
{
    for (int64_t i = begin; i < end; ++i) {
        double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        if (plan->box->is_tilted) make_upright(plan->box, x);
        if (!is_near_lower_face(plan, x)) continue;
        const layer_range range = layers_of(plan, x);
        for (int j0 = range.lo[0]; j0 <= 0; ++j0)
            for (int j1 = range.lo[1]; j1 <= range.hi[1]; ++j1)
                for (int j2 = range.lo[2]; j2 <= range.hi[2]; ++j2) {
                    const int b = plan->block_of[hs_halo_plan_index(plan, j0, j1, j2)];
                    if (b < 0) continue;
                    if (source != NULL) source[next[b]] = (int32_t)i;
                    ++next[b];
                }
    }
}

/** list_atoms for parts of the local atoms, shared by the threads. Atoms near lower faces, which go to halos, stand together in the arrays;
 *  parts handed out in turn give every thread its share of them. */
static void list_parts(const hs_halo_plan *plan, const hs_halo *halo, const hs_atoms *atoms, int n_parts, int *next,
                       int32_t *source)
{
#pragma omp for schedule(static, 1) nowait
    for (int part = 0; part < n_parts; ++part) {
        int64_t begin, end;
        hs_thread_range(atoms->n_local, 1, part, n_parts, &begin, &end);
        list_atoms(plan, atoms, begin, end, next + (size_t)part * (size_t)halo->out.n_blocks, source);
    }
}

/** Turn the counts of all parts into places: next[part * n_blocks + b]. Blocks in order, parts within. */
static hs_status places_from_counts(hs_halo_side *out, int n_parts, int *next, hs_error *err)
{
    int64_t n = 0;
    const size_t n_blocks = (size_t)out->n_blocks;
    for (size_t b = 0; b < n_blocks; ++b) {
        out->block[b].begin = (int)n;
        for (int part = 0; part < n_parts; ++part) {
            int *const place = &next[(size_t)part * n_blocks + b];
            const int count = *place;
            *place = (int)n;
            n += count;
        }
        if (n > INT32_C(1) << 30)
            return hs_fail(err, HS_ERROR_RUN, "%lld periodic images are more than a rank can hold", (long long)n);
        out->block[b].end = (int)n;
    }
    out->n = (int)n;
    out->n_self_atoms = out->n_self > 0 ? out->block[out->n_self - 1].end : 0;
    return HS_OK;
}

/** Choose the atoms to send. */
static hs_status choose_atoms(hs_halo *halo, const hs_halo_plan *plan, const hs_atoms *atoms, hs_error *err)
{
    const int n_parts = hs_threads_get() > 1 ? PARTS_OF_THREADS : 1;
    int *next;
    HS_TRY(HS_ALLOC(next, (size_t)n_parts * (size_t)halo->out.n_blocks, err));
    HS_ON_THREADS(list_parts(plan, halo, atoms, n_parts, next, NULL));
    hs_status status = places_from_counts(&halo->out, n_parts, next, err);
    if (status == HS_OK && halo->out.n > halo->capacity_source) {
        const size_t capacity = (size_t)halo->out.n + (size_t)halo->out.n / 8 + 64;
        status = HS_GROW(halo->source, 0, capacity, err);
        if (status == HS_OK) halo->capacity_source = (int)capacity;
    }
    if (status == HS_OK) HS_ON_THREADS(list_parts(plan, halo, atoms, n_parts, next, halo->source));
    HS_FREE(next);
    return status;
}

/** First block after `b` that has another partner. */
static int end_of_group(const hs_halo_side *side, int b)
{
    const int rank = side->block[b].rank;
    while (b < side->n_blocks && side->block[b].rank == rank) ++b;
    return b;
}

/** Tell every partner how many atoms of each block it will get: count[b] of blocks sent, incoming[b] of blocks received. */
static hs_status describe_counts(const hs_halo *halo, const int32_t *count, int32_t *incoming, hs_messages *messages,
                                 hs_error *err)
{
    for (int b = halo->out.n_self, end; b < halo->out.n_blocks; b = end) {
        end = end_of_group(&halo->out, b);
        HS_TRY(hs_messages_send(messages, halo->out.block[b].rank, count + b, end - b, sizeof *count, err));
    }
    for (int b = halo->in.n_self, end; b < halo->in.n_blocks; b = end) {
        end = end_of_group(&halo->in, b);
        HS_TRY(hs_messages_receive(messages, halo->in.block[b].rank, incoming + b, end - b, sizeof *incoming, err));
    }
    return HS_OK;
}

static hs_status set_incoming(hs_halo *halo, const int32_t *incoming, hs_error *err)
{
    int64_t n = 0;
    hs_halo_side *in = &halo->in;
    for (int b = 0; b < in->n_blocks; ++b) {
        const hs_halo_block *own = &halo->out.block[b];
        in->block[b].begin = (int)n;
        n += b < in->n_self ? own->end - own->begin : incoming[b];
        if (n > INT32_C(1) << 30)
            return hs_fail(err, HS_ERROR_RUN, "%lld halo atoms are more than a rank can hold", (long long)n);
        in->block[b].end = (int)n;
    }
    in->n = (int)n;
    in->n_self_atoms = halo->out.n_self_atoms;
    return HS_OK;
}

/** Exchange the numbers of atoms (collective). Errors up to here are agreed first, since messages need both sides. */
static void exchange_counts(hs_halo *halo, const hs_parallel *parallel, hs_error *err)
{
    hs_messages messages = {0};
    int32_t *count = NULL, *incoming = NULL;
    HS_UNLESS_FAILED(err, HS_ALLOC(count, (size_t)halo->out.n_blocks, err));
    HS_UNLESS_FAILED(err, HS_ALLOC(incoming, (size_t)halo->in.n_blocks, err));
    if (err->status == HS_OK) {
        for (int b = 0; b < halo->out.n_blocks; ++b) count[b] = halo->out.block[b].end - halo->out.block[b].begin;
        (void)describe_counts(halo, count, incoming, &messages, err);
    }
    if (hs_parallel_agree(parallel, err) == HS_OK) {
        hs_messages_start(&messages);
        hs_messages_wait(&messages);
        (void)set_incoming(halo, incoming, err);
    }
    hs_messages_fini(&messages);
    HS_FREE(count);
    HS_FREE(incoming);
}

static hs_status reserve_buffer(hs_halo_side *side, hs_error *err)
{
    const int n = side->n - side->n_self_atoms;
    if (n <= side->capacity_buffer) return HS_OK;
    const size_t capacity = (size_t)n + (size_t)n / 8 + 64;
    HS_TRY(HS_GROW(side->buffer, 0, capacity * HS_HALO_WORDS, err));
    side->capacity_buffer = (int)capacity;
    return HS_OK;
}

/** Messages of one side, from or into its buffer: one for each partner, none for partners without atoms. */
static hs_status describe_side(const hs_halo_side *side, bool is_sent, hs_messages *messages, hs_error *err)
{
    for (int b = side->n_self, end; b < side->n_blocks; b = end) {
        end = end_of_group(side, b);
        const int64_t begin = side->block[b].begin, n = side->block[end - 1].end - begin;
        double *words = side->buffer + (begin - side->n_self_atoms) * HS_HALO_WORDS;
        const size_t size = HS_HALO_WORDS * sizeof(double);
        if (n == 0) continue;
        HS_TRY(is_sent ? hs_messages_send(messages, side->block[b].rank, words, n, size, err)
                       : hs_messages_receive(messages, side->block[b].rank, words, n, size, err));
    }
    return HS_OK;
}

static hs_status describe_messages(hs_halo *halo, hs_error *err)
{
    HS_TRY(reserve_buffer(&halo->out, err));
    HS_TRY(reserve_buffer(&halo->in, err));
    HS_TRY(describe_side(&halo->in, false, &halo->forward, err));
    HS_TRY(describe_side(&halo->out, true, &halo->forward, err));
    HS_TRY(describe_side(&halo->out, false, &halo->reverse, err));
    return describe_side(&halo->in, true, &halo->reverse, err);
}

/** Room for the halo atoms. */
static hs_status reserve_atoms(hs_halo *halo, hs_atoms *atoms, hs_error *err)
{
    const int64_t n = halo->in.n;
    if (n > halo->capacity) {
        const size_t capacity = (size_t)(n + n / 8 + 64);
        HS_TRY(HS_GROW(halo->slot, 0, capacity, err));
        HS_TRY(HS_GROW(halo->is_remote, 0, capacity, err));
        halo->capacity = (int)capacity;
    }
    if (n > atoms->capacity_halo) return hs_atoms_reserve(atoms, atoms->n_local, n + n / 8 + 64, err);
    return HS_OK;
}

/** Vectors may reach beyond the last atom. What they load there is masked, but must be numbers: the memory may have held
 *  fixed-point forces, and some integers are the patterns of NaN. */
static void clear_padding(const hs_atoms *atoms)
{
    for (int axis = 0; axis < 3; ++axis)
        memset(atoms->x[axis] + atoms->n_local + atoms->n_halo, 0, HS_ATOMS_PAD * sizeof(double));
}

static void number_slots(const hs_halo *halo)
{
#pragma omp for schedule(static) nowait
    for (int k = 0; k < halo->n; ++k) {
        halo->slot[k] = k;
        halo->is_remote[k] = k >= halo->in.n_self_atoms;
    }
}

/** Halo atoms behind the local ones, in order of blocks. */
static void place_atoms(hs_halo *halo, hs_atoms *atoms)
{
    atoms->n_halo = halo->n;
    halo->generation = atoms->generation;
    ++halo->version;
    HS_ON_THREADS(number_slots(halo));
    clear_padding(atoms);
    hs_halo_forward(halo, atoms);
}

hs_status hs_halo_build(hs_halo *halo, const hs_domain *domain, const hs_parallel *parallel, const hs_box *box,
                        hs_atoms *atoms, double reach, hs_error *err)
{
    hs_halo_plan plan = {0};
    hs_messages_clear(&halo->forward);
    hs_messages_clear(&halo->reverse);
    HS_UNLESS_FAILED(err, hs_halo_plan_make(&plan, halo, domain, box, reach, err));
    HS_UNLESS_FAILED(err, choose_atoms(halo, &plan, atoms, err));
    hs_halo_plan_fini(&plan);
    exchange_counts(halo, parallel, err);
    HS_UNLESS_FAILED(err, reserve_atoms(halo, atoms, err));
    HS_UNLESS_FAILED(err, describe_messages(halo, err));
    HS_TRY(hs_parallel_agree(parallel, err));
    halo->n = halo->in.n;
    halo->is_ascending = true;
    place_atoms(halo, atoms);
    return HS_OK;
}

static void renumber_sources(const hs_halo *halo, const int32_t *place)
{
#pragma omp for schedule(static) nowait
    for (int k = 0; k < halo->out.n; ++k) halo->source[k] = place[halo->source[k]];
}

void hs_halo_follow(hs_halo *halo, hs_atoms *atoms, const int32_t *place)
{
    HS_ON_THREADS(renumber_sources(halo, place));
    halo->is_ascending = false;
    place_atoms(halo, atoms);
}

static void fini_side(hs_halo_side *side)
{
    HS_FREE(side->block);
    HS_FREE(side->buffer);
}

void hs_halo_fini(hs_halo *halo)
{
    hs_messages_fini(&halo->forward);
    hs_messages_fini(&halo->reverse);
    fini_side(&halo->out);
    fini_side(&halo->in);
    HS_FREE(halo->source);
    HS_FREE(halo->slot);
    HS_FREE(halo->is_remote);
    memset(halo, 0, sizeof *halo);
}
