#include "kernel/cluster_list.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/pair_histogram.h"
#include "parallel/parallel.h"

enum { CLUSTERS_PER_CHUNK_MAX = 2048 };

static void fini_chunk(hs_list_chunk *chunk)
{
    HS_FREE(chunk->start);
    HS_FREE(chunk->entries.entry);
    HS_FREE(chunk->outer);
    HS_FREE(chunk->blocks.block);
}

void hs_cluster_list_fini(hs_cluster_list *list)
{
    for (int k = 0; k < list->n_chunks; ++k) fini_chunk(&list->chunk[k]);
    HS_FREE(list->chunk);
    memset(list, 0, sizeof *list);
}

static hs_status set_chunks(hs_cluster_list *list, int n_clusters, hs_error *err)
{
    const int n_chunks = hs_list_chunks_for(n_clusters, CLUSTERS_PER_CHUNK_MAX);
    if (n_chunks > list->n_chunks) {
        HS_TRY(HS_GROW(list->chunk, (size_t)list->n_chunks, (size_t)n_chunks, err));
        list->n_chunks = n_chunks;
    }
    for (int k = 0; k < list->n_chunks; ++k)
        hs_list_chunk_range(n_clusters, list->n_chunks, k, &list->chunk[k].begin, &list->chunk[k].end);
    return HS_OK;
}

static hs_status begin_chunk(hs_list_chunk *chunk, hs_error *err)
{
    const int64_t n = chunk->end - chunk->begin + 1;
    if (n > chunk->capacity_start) {
        const int64_t capacity = n + n / 8 + 4;
        HS_TRY(HS_GROW(chunk->start, 0, (size_t)capacity, err));
        chunk->capacity_start = capacity;
    }
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

/** Mark the blocks that the forces of n entries and of their i-cluster act on. */
static void mark_atoms(unsigned char *touched, int first, const hs_cluster_entry *entry, int n)
{
    for (int e = -1; e < n; ++e) {
        const int begin = e < 0 ? first : entry[e].first;
        touched[begin >> HS_FORCE_BLOCK_BITS] = 1;
        touched[(begin + HS_CLUSTER - 1) >> HS_FORCE_BLOCK_BITS] = 1;
    }
}

static void mark_packed(unsigned char *touched, int first, const hs_cluster_entry *entry, int n)
{
    touched[first >> HS_PACKED_BLOCK_BITS] = 1;
    for (int e = 0; e < n; ++e) touched[entry[e].first >> HS_PACKED_BLOCK_BITS] = 1;
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
static hs_status list_cluster(hs_list_chunk *chunk, hs_force_buffer *buffer, const hs_packed *packed,
                              const hs_force_job *job, int ci, int column, int group, hs_error *err)
{
    hs_entry_list *found = &buffer->entries, *kept = &chunk->entries;
    const int first = job->clusters->local.entry[ci].first;
    found->n = 0;
    HS_TRY(hs_isa_find(job->isa)(&buffer->search, ci, column, found, err));
    const int n_found = found->n;
    if (n_found == 0) return HS_OK;
    HS_TRY(hs_entry_list_pad(found, 0, group, first, err));
    HS_TRY(hs_entry_list_reserve(kept, found->n, err));
    hs_cluster_entry *entry = kept->entry + kept->n;
    const int n = hs_isa_refine(job->isa)(&job->input, first, found->entry, n_found, group, entry, &chunk->n_pairs);
    if (n == 0) return HS_OK;
    bool is_outer = false;
    for (int e = 0; e < n && !is_outer; ++e) is_outer = is_remote(job, &entry[e]);
    if (is_outer) HS_TRY(add_outer(chunk, ci, err));
    if (packed != NULL) {
        hs_packed_rename(packed, entry, n);
        mark_packed(buffer->touched, packed->place_of[first], entry, n);
    } else
        mark_atoms(buffer->touched, first, entry, n);
    kept->n += n;
    return HS_OK;
}

static hs_status build_chunk(hs_list_chunk *chunk, hs_force_buffer *buffer, const hs_packed *packed,
                             const hs_force_job *job, hs_error *err)
{
    const hs_atoms *atoms = job->atoms;
    const int64_t n_room = (int64_t)atoms->n_local + atoms->n_halo + HS_ATOMS_PAD;
    const int64_t n_blocks = packed != NULL ? ((int64_t)packed->n * HS_PACKED >> HS_PACKED_BLOCK_BITS) + 1
                                            : (n_room >> HS_FORCE_BLOCK_BITS) + 1;
    const int group = job->evaluator->set[job->isa][job->precision]->group;
    HS_TRY(begin_chunk(chunk, err));
    memset(buffer->touched, 0, (size_t)n_blocks); /* scratch here: every evaluation clears it before use */
    int column = chunk->begin < chunk->end ? hs_clusters_column(job->clusters, job->cells, chunk->begin) : 0;
    for (int ci = chunk->begin; ci < chunk->end; ++ci) {
        while (job->clusters->local.column_begin[column + 1] <= ci) ++column;
        chunk->start[ci - chunk->begin] = chunk->entries.n;
        HS_TRY(list_cluster(chunk, buffer, packed, job, ci, column, group, err));
    }
    chunk->start[chunk->end - chunk->begin] = chunk->entries.n;
    return hs_block_list_set(&chunk->blocks, buffer->touched, n_blocks, err);
}

/** Chunks that this thread comes to. */
static void build_chunks(hs_cluster_list *list, hs_force_space *space, const hs_packed *packed, const hs_force_job *job)
{
    hs_force_buffer *buffer = &space->buffer[hs_thread_number()];
    hs_cluster_search_begin(&buffer->search, job->clusters, job->cells, job->cutoff_max, INFINITY);
#pragma omp for schedule(dynamic, 1) nowait
    for (int k = 0; k < list->n_chunks; ++k) {
        hs_list_chunk *chunk = &list->chunk[k];
        hs_error_clear(&chunk->error);
        (void)(build_chunk(chunk, buffer, packed, job, &chunk->error) == HS_OK);
    }
}

hs_status hs_cluster_list_build(hs_cluster_list *list, hs_force_space *space, const hs_force_job *job, hs_error *err)
{
    HS_TRY(set_chunks(list, job->clusters->local.n, err));
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
    list->is_packed = job->precision == HS_PRECISION_MIXED;
    const hs_packed *packed = list->is_packed ? &space->packed : NULL;
    if (list->is_packed) HS_TRY(hs_packed_begin(&space->packed, job->clusters, job->atoms, job->cutoff_max, err));
    HS_ON_THREADS(build_chunks(list, space, packed, job));
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

static int64_t weight(const void *list, int chunk) { return ((const hs_cluster_list *)list)->chunk[chunk].entries.n; }

/** Work of one thread on one chunk. */
typedef struct chunk_work {
    const hs_force_space *space;
    const hs_list_chunk *chunk;
    const hs_force_job *job;
    hs_kernel_output *out;
    hs_cluster_kernel kernel;
} chunk_work;

static inline void apply_kernel(const chunk_work *w, int ci)
{
    const int32_t *start = w->chunk->start + (ci - w->chunk->begin);
    if (start[1] > start[0])
        w->kernel(&w->job->input, w->out, hs_force_place(w->space, w->job, w->job->clusters->local.entry[ci].first),
                  w->chunk->entries.entry + start[0], start[1] - start[0]);
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

bool hs_force_can_count(const hs_force_job *job, double r_max)
{
    const hs_pair_table *table = job->input.table;
    const double *row = table->values + (size_t)(table->n_types + 1) * (size_t)table->stride; /* of types 1 and 1 */
    return !job->with_energy && table->is_uniform && row[HS_TABLE_CUT_R2] == r_max * r_max &&
           !job->evaluator->has_radii && job->evaluator->set[job->isa][job->precision]->counting != NULL;
}

static hs_cluster_kernel choose_kernel(const hs_force_job *job)
{
    const hs_kernel_set *set = job->evaluator->set[job->isa][job->precision];
    return job->counter != NULL ? set->counting : hs_kernel_for_clusters(set, &job->input, job->with_energy, false);
}

static hs_status work_cluster(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    hs_force_buffer *buffer = &space->buffer[thread];
    const hs_cluster_list *list = job->list;
    chunk_work w = {.space = space, .job = job, .out = &buffer->out, .kernel = choose_kernel(job)};
    bool is_cut;
    if (job->counter != NULL) buffer->out.histogram = &job->counter->thread[thread];
    for (int k; (k = hs_list_take(space, stage, thread, &is_cut)) >= 0;) {
        w.chunk = &list->chunk[k];
        hs_block_list_touch(&w.chunk->blocks, buffer, job);
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
    HS_TRY(hs_force_pack(space, &listed, false, err));
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
    if (job->counter != NULL) HS_TRY(hs_pair_counter_begin(job->counter, err));
    hs_list_share(space, list, weight, list->n_chunks);
    return hs_force_run_threads(space, &listed, work_cluster, true, result, err);
}
