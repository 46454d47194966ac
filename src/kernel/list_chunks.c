#include "kernel/list_chunks.h"

#include "base/memory.h"
#include "parallel/cache.h"
#include "parallel/parallel.h"

enum {
    /* Fewer leave the threads out of balance. Each chunk costs the time to find which blocks its forces act on, at every list build and
       evaluation: with 256 in place of 64, one thread took 3 % longer. */
    CHUNKS_PER_THREAD = 64,
    /* In a chunk, unless that makes fewer chunks than several threads need to share them evenly. One thread shares with nobody: with 64 chunks,
       420 discs took a quarter longer. */
    CLUSTERS_MIN = 16,
    /* One chunk of so many is cut into inner and outer clusters at each end of a thread's share. Time enough for messages; outer
       clusters apart from their neighbors find less in the caches, so more of them would cost more than is gained. */
    CUT_SHARE = 8,
};

int hs_list_chunks_for(int n_clusters, int n_per_chunk_max)
{
    const int by_size = (n_clusters + n_per_chunk_max - 1) / n_per_chunk_max, by_room = n_clusters / CLUSTERS_MIN;
    const int n_threads = hs_threads_get(), by_threads = n_threads * CHUNKS_PER_THREAD;
    const int least = n_threads > 1 ? CHUNKS_PER_THREAD : 1;
    int n = by_room < by_threads ? by_room : by_threads;
    n = n > least ? n : least;
    return by_size > n ? by_size : n;
}

void hs_list_chunk_range(int n_clusters, int n_chunks, int chunk, int *begin, int *end)
{
    int64_t first, last;
    hs_thread_range(n_clusters, 1, chunk, n_chunks, &first, &last);
    *begin = (int)first;
    *end = (int)last;
}

/** What stages find to do of the chunks [begin, end) of a thread. */
static void set_stages(hs_force_space *space, int thread, int begin, int end)
{
    hs_share *share = space->share + thread;
    hs_force_buffer *buffer = &space->buffer[thread];
    const int n_cut = (end - begin) / CUT_SHARE;
    buffer->uncut_begin = begin + n_cut;
    buffer->uncut_end = end - n_cut;
    hs_share_set(&share[HS_STAGE_ALL * space->n_threads], begin, end);
    hs_share_set(&share[HS_STAGE_BEFORE * space->n_threads], begin, buffer->uncut_begin);
    hs_share_set(&share[HS_STAGE_MAIN * space->n_threads], begin, end);
    hs_share_set(&share[HS_STAGE_AFTER * space->n_threads], buffer->uncut_end, end);
}

void hs_list_share(hs_force_space *space, const void *list, int64_t (*weight)(const void *list, int chunk),
                   int n_chunks)
{
    int64_t total = 0, before = 0;
    for (int k = 0; k < n_chunks; ++k) total += weight(list, k);
    int begin = 0;
    for (int thread = 0; thread < space->n_threads; ++thread) {
        int end = begin;
        /* a chunk belongs to the thread whose part of the weight has its middle */
        for (int64_t here; end < n_chunks; before += here, ++end) {
            here = weight(list, end);
            if ((2 * before + here) * space->n_threads >= (thread + 1) * (2 * total + 1)) break;
        }
        set_stages(space, thread, begin, end);
        begin = end;
    }
}

int hs_list_take(hs_force_space *space, hs_force_stage stage, int thread, bool *is_cut)
{
    hs_share *share = space->share + (int)stage * space->n_threads;
    int owner = thread;
    const int chunk = hs_share_take_any(share, space->n_threads, thread, &owner);
    const hs_force_buffer *buffer = &space->buffer[owner];
    *is_cut = stage != HS_STAGE_ALL && (chunk < buffer->uncut_begin || chunk >= buffer->uncut_end);
    return chunk;
}

hs_status hs_block_list_set(hs_block_list *list, const unsigned char *touched, int64_t n_blocks, hs_error *err)
{
    int64_t n = 0;
    list->n = 0;
    for (int64_t b = 0; b < n_blocks; ++b) n += touched[b];
    if (n > list->capacity) {
        const int64_t capacity = n + n / 8 + 8;
        HS_TRY(HS_GROW(list->block, 0, (size_t)capacity, err));
        list->capacity = capacity;
    }
    for (int64_t b = 0; b < n_blocks; ++b)
        if (touched[b]) list->block[list->n++] = (int32_t)b;
    return HS_OK;
}

/** Make a block of the atoms' arrays ready; the positions there will be read by the first pairs that come to it, which the memory would
 *  keep waiting where the arrays are larger than the caches. */
static void touch_atoms(hs_force_buffer *buffer, const hs_force_job *job, int64_t block, int64_t n_room)
{
    const int64_t begin = block << HS_FORCE_BLOCK_BITS, left = n_room - begin;
    const size_t n_bytes = (size_t)(left < HS_FORCE_BLOCK ? left : HS_FORCE_BLOCK) * sizeof(double);
    if (buffer->touched[block]) return;
    for (int axis = 0; axis < buffer->n_axes; ++axis) hs_cache_fetch(job->atoms->x[axis] + begin, n_bytes);
    hs_force_touch(buffer, begin, n_room);
}

/** The same of a block of packed clusters. */
static void touch_packed(hs_force_buffer *buffer, const hs_force_job *job, int64_t block)
{
    if (buffer->touched[block]) return;
    hs_cache_fetch(job->input.site + (block << HS_PACKED_BLOCK_BITS), HS_PACKED_BLOCK * sizeof *job->input.site);
    hs_force_touch_packed(buffer, block);
}

void hs_block_list_touch(const hs_block_list *list, hs_force_buffer *buffer, const hs_force_job *job)
{
    const int64_t n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD;
    for (int64_t k = 0; k < list->n; ++k) {
        if (hs_force_is_packed(job))
            touch_packed(buffer, job, list->block[k]);
        else
            touch_atoms(buffer, job, list->block[k], n_room);
    }
}
