#include "kernel/cluster_list.h"

#include <string.h>

#include "base/memory.h"
#include "parallel/parallel.h"

enum { CHUNKS_MIN = 64, CLUSTERS_PER_CHUNK_MAX = 2048 };

static void fini_chunk(hs_list_chunk *chunk)
{
    HS_FREE(chunk->start);
    HS_FREE(chunk->entries.entry);
    HS_FREE(chunk->outer);
    HS_FREE(chunk->touched);
}

void hs_cluster_list_fini(hs_cluster_list *list)
{
    for (int k = 0; k < list->n_chunks; ++k) fini_chunk(&list->chunk[k]);
    HS_FREE(list->chunk);
    memset(list, 0, sizeof *list);
}

static hs_status set_chunks(hs_cluster_list *list, int n_clusters, hs_error *err)
{
    const int by_size = (n_clusters + CLUSTERS_PER_CHUNK_MAX - 1) / CLUSTERS_PER_CHUNK_MAX;
    const int n_chunks = by_size > CHUNKS_MIN ? by_size : CHUNKS_MIN;
    if (n_chunks > list->n_chunks) {
        HS_TRY(HS_GROW(list->chunk, (size_t)list->n_chunks, (size_t)n_chunks, err));
        list->n_chunks = n_chunks;
    }
    for (int k = 0; k < list->n_chunks; ++k) {
        int64_t begin, end;
        hs_thread_range(n_clusters, 1, k, list->n_chunks, &begin, &end);
        list->chunk[k].begin = (int)begin;
        list->chunk[k].end = (int)end;
    }
    return HS_OK;
}

static hs_status reserve_chunk(hs_list_chunk *chunk, int64_t n_blocks, hs_error *err)
{
    const int64_t n = chunk->end - chunk->begin + 1;
    if (n > chunk->capacity_start) {
        chunk->capacity_start = n + n / 8 + 4;
        HS_TRY(HS_GROW(chunk->start, 0, (size_t)chunk->capacity_start, err));
    }
    if (n_blocks > chunk->capacity_touched) {
        chunk->capacity_touched = n_blocks + n_blocks / 8;
        HS_TRY(HS_GROW(chunk->touched, 0, (size_t)chunk->capacity_touched, err));
    }
    memset(chunk->touched, 0, (size_t)n_blocks);
    chunk->entries.n = 0;
    chunk->n_outer = 0;
    chunk->n_pairs = 0;
    return HS_OK;
}

static hs_status add_outer(hs_list_chunk *chunk, int ci, hs_error *err)
{
    if (chunk->n_outer == chunk->capacity_outer) {
        const int64_t capacity = 2 * chunk->capacity_outer + 32;
        HS_TRY(HS_GROW(chunk->outer, (size_t)chunk->n_outer, (size_t)capacity, err));
        chunk->capacity_outer = capacity;
    }
    chunk->outer[chunk->n_outer++] = ci;
    return HS_OK;
}

static inline void mark(hs_list_chunk *chunk, int first)
{
    chunk->touched[first >> HS_FORCE_BLOCK_BITS] = 1;
    chunk->touched[(first + HS_CLUSTER - 1) >> HS_FORCE_BLOCK_BITS] = 1;
}

/** Whether an entry has pairs with another rank's atoms. */
static inline bool is_remote(const hs_force_job *job, const hs_cluster_entry *entry)
{
    const int n_local = job->atoms->n_local;
    if (job->is_remote == NULL || entry->first < n_local) return false;
    const unsigned char *flag = job->is_remote + (entry->first - n_local);
    for (int lane = 0; lane < HS_CLUSTER; ++lane)
        if ((entry->mask >> lane & 0x1111u) != 0 && flag[lane]) return true;
    return false;
}

/** Find and refine the entries of one cluster in the thread's scratch list, and append what is left to the chunk's. */
static hs_status list_cluster(hs_list_chunk *chunk, hs_force_buffer *buffer, const hs_force_job *job, int ci,
                              int column, int group, hs_error *err)
{
    hs_entry_list *found = &buffer->entries, *kept = &chunk->entries;
    const int first = job->clusters->local.entry[ci].first;
    found->n = 0;
    HS_TRY(hs_isa_find(job->isa)(&buffer->search, ci, column, found, err));
    const int n_found = found->n;
    if (n_found == 0) return HS_OK;
    HS_TRY(hs_entry_list_pad(found, 0, group, first, err));
    HS_TRY(hs_entry_list_reserve(found, n_found, err));
    found->n = hs_isa_refine(job->isa)(&job->input, first, found->entry, n_found, group, found->entry + found->n);
    bool is_outer = false;
    for (int e = 0; e < found->n; ++e) {
        mark(chunk, found->entry[e].first);
        is_outer = is_outer || is_remote(job, &found->entry[e]);
        chunk->n_pairs += __builtin_popcount(found->entry[e].mask & 0xffffu);
    }
    if (found->n == 0) return HS_OK;
    mark(chunk, first);
    if (is_outer) HS_TRY(add_outer(chunk, ci, err));
    HS_TRY(hs_entry_list_reserve(kept, found->n, err));
    memcpy(kept->entry + kept->n, found->entry, (size_t)found->n * sizeof *found->entry);
    kept->n += found->n;
    return HS_OK;
}

static hs_status build_chunk(hs_list_chunk *chunk, hs_force_buffer *buffer, const hs_force_job *job, hs_error *err)
{
    const hs_atoms *atoms = job->atoms;
    const int64_t n_room = (int64_t)atoms->n_local + atoms->n_halo + HS_ATOMS_PAD;
    const int group = job->evaluator->set[job->isa][job->precision]->group;
    HS_TRY(reserve_chunk(chunk, (n_room >> HS_FORCE_BLOCK_BITS) + 1, err));
    int column = chunk->begin < chunk->end ? hs_clusters_column(job->clusters, job->cells, chunk->begin) : 0;
    for (int ci = chunk->begin; ci < chunk->end; ++ci) {
        while (job->clusters->local.column_begin[column + 1] <= ci) ++column;
        chunk->start[ci - chunk->begin] = chunk->entries.n;
        HS_TRY(list_cluster(chunk, buffer, job, ci, column, group, err));
    }
    chunk->start[chunk->end - chunk->begin] = chunk->entries.n;
    return HS_OK;
}

hs_status hs_cluster_list_build(hs_cluster_list *list, hs_force_space *space, const hs_force_job *job, hs_error *err)
{
    HS_TRY(set_chunks(list, job->clusters->local.n, err));
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
#pragma omp parallel num_threads(space->n_threads)
    {
        hs_force_buffer *buffer = &space->buffer[hs_thread_number()];
        hs_cluster_search_begin(&buffer->search, job->clusters, job->cells, job->cutoff_max);
#pragma omp for schedule(dynamic, 1)
        for (int k = 0; k < list->n_chunks; ++k) {
            hs_list_chunk *chunk = &list->chunk[k];
            hs_error_clear(&chunk->error);
            (void)(build_chunk(chunk, buffer, job, &chunk->error) == HS_OK);
        }
    }
    for (int k = 0; k < list->n_chunks; ++k)
        if (list->chunk[k].error.status != HS_OK) {
            *err = list->chunk[k].error;
            return err->status;
        }
    list->generation = job->atoms->generation;
    return HS_OK;
}

int64_t hs_cluster_list_n_pairs(const hs_cluster_list *list)
{
    int64_t n = 0;
    for (int k = 0; k < list->n_chunks; ++k) n += list->chunk[k].n_pairs;
    return n;
}

/** Chunks [*begin, *end) of one thread: shares of the list as equal as whole chunks allow. */
static void chunks_of_thread(const hs_cluster_list *list, int thread, int n_threads, int *begin, int *end)
{
    int64_t total = 0, before = 0;
    for (int k = 0; k < list->n_chunks; ++k) total += list->chunk[k].entries.n;
    *begin = *end = list->n_chunks;
    for (int k = 0; k < list->n_chunks; ++k) {
        const int64_t middle = 2 * before + list->chunk[k].entries.n; /* twice the chunk's middle */
        const int owner = total == 0 ? 0 : (int)(middle * n_threads / (2 * total + 1));
        if (owner >= thread && *begin == list->n_chunks) *begin = k;
        if (owner > thread) {
            *end = k;
            break;
        }
        before += list->chunk[k].entries.n;
    }
    if (*begin > *end) *begin = *end;
}

/** Work of one thread on one chunk. */
typedef struct chunk_work {
    const hs_list_chunk *chunk;
    const hs_force_job *job;
    hs_kernel_output *out;
    hs_cluster_kernel kernel;
} chunk_work;

static inline void apply_kernel(const chunk_work *w, int ci)
{
    const int32_t *start = w->chunk->start + (ci - w->chunk->begin);
    if (start[1] > start[0])
        w->kernel(&w->job->input, w->out, w->job->clusters->local.entry[ci].first, w->chunk->entries.entry + start[0],
                  start[1] - start[0]);
}

static void work_inner(const chunk_work *w)
{
    const int32_t *outer = w->chunk->outer, *end = outer + w->chunk->n_outer;
    for (int ci = w->chunk->begin; ci < w->chunk->end; ++ci) {
        if (outer < end && *outer == ci)
            ++outer;
        else
            apply_kernel(w, ci);
    }
}

static void work_outer(const chunk_work *w)
{
    for (int k = 0; k < w->chunk->n_outer; ++k) apply_kernel(w, w->chunk->outer[k]);
}

static void work_all(const chunk_work *w)
{
    for (int ci = w->chunk->begin; ci < w->chunk->end; ++ci) apply_kernel(w, ci);
}

/* One chunk of so many is cut into inner and outer clusters at each end of a thread's share. Time enough for messages; outer
   clusters apart from their neighbors find less in the caches, so more of them would cost more than is gained. */
enum { CUT_SHARE = 8 };

static hs_status work_cluster(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    hs_force_buffer *buffer = &space->buffer[thread];
    const hs_cluster_list *list = job->list;
    chunk_work w = {
        .job = job,
        .out = &buffer->out,
        .kernel =
            job->evaluator->set[job->isa][job->precision]->cluster[job->with_energy][!job->input.table->is_uniform][0]};
    const int64_t n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD;
    int begin, end;
    chunks_of_thread(list, thread, space->n_threads, &begin, &end);
    const int n_cut = stage == HS_STAGE_ALL ? 0 : (end - begin) / CUT_SHARE, before = begin + n_cut,
              after = end - n_cut;
    if (stage == HS_STAGE_BEFORE) end = before;
    if (stage == HS_STAGE_AFTER) begin = after;
    for (int k = begin; k < end; ++k) {
        w.chunk = &list->chunk[k];
        const bool is_cut = k < before || k >= after;
        for (int64_t block = 0; block < (n_room >> HS_FORCE_BLOCK_BITS) + 1; ++block)
            if (w.chunk->touched[block]) hs_force_touch(buffer, block << HS_FORCE_BLOCK_BITS, n_room);
        if (!is_cut)
            work_all(&w);
        else if (stage == HS_STAGE_MAIN)
            work_outer(&w);
        else
            work_inner(&w);
    }
    return HS_OK;
}

hs_status hs_force_cluster(hs_force_space *space, const hs_cluster_list *list, const hs_force_job *job,
                           hs_force_result *result, hs_error *err)
{
    hs_force_job listed = *job;
    listed.list = list;
    return hs_force_run_threads(space, &listed, work_cluster, true, result, err);
}
