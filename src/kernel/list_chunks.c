#include "kernel/list_chunks.h"

#include "base/memory.h"
#include "parallel/parallel.h"

enum { CHUNKS_MIN = 64 };

int hs_list_chunks_for(int n_clusters, int n_per_chunk_max)
{
    const int by_size = (n_clusters + n_per_chunk_max - 1) / n_per_chunk_max;
    return by_size > CHUNKS_MIN ? by_size : CHUNKS_MIN;
}

void hs_list_chunk_range(int n_clusters, int n_chunks, int chunk, int *begin, int *end)
{
    int64_t first, last;
    hs_thread_range(n_clusters, 1, chunk, n_chunks, &first, &last);
    *begin = (int)first;
    *end = (int)last;
}

void hs_list_share(const void *list, int64_t (*weight)(const void *list, int chunk), int n_chunks, int thread,
                   int n_threads, int *begin, int *end)
{
    int64_t total = 0, before = 0;
    for (int k = 0; k < n_chunks; ++k) total += weight(list, k);
    *begin = *end = n_chunks;
    for (int k = 0; k < n_chunks; ++k) {
        const int64_t middle = 2 * before + weight(list, k); /* twice the chunk's middle */
        const int owner = total == 0 ? 0 : (int)(middle * n_threads / (2 * total + 1));
        if (owner >= thread && *begin == n_chunks) *begin = k;
        if (owner > thread) {
            *end = k;
            break;
        }
        before += weight(list, k);
    }
    if (*begin > *end) *begin = *end;
}

hs_status hs_block_list_set(hs_block_list *list, const unsigned char *touched, int64_t n_blocks, hs_error *err)
{
    int64_t n = 0;
    list->n = 0;
    for (int64_t b = 0; b < n_blocks; ++b) n += touched[b];
    if (n > list->capacity) {
        list->capacity = n + n / 8 + 8;
        HS_TRY(HS_GROW(list->block, 0, (size_t)list->capacity, err));
    }
    for (int64_t b = 0; b < n_blocks; ++b)
        if (touched[b]) list->block[list->n++] = (int32_t)b;
    return HS_OK;
}

void hs_block_list_touch(const hs_block_list *list, hs_force_buffer *buffer, const hs_force_job *job)
{
    const int64_t n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD;
    for (int64_t k = 0; k < list->n; ++k) {
        if (hs_force_is_packed(job))
            hs_force_touch_packed(buffer, list->block[k]);
        else
            hs_force_touch(buffer, (int64_t)list->block[k] << HS_FORCE_BLOCK_BITS, n_room);
    }
}
