#include "kernel/verlet_list.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/parallel.h"

enum {
    CLUSTERS_PER_CHUNK_MAX = 1024,
    VECTORS_BETWEEN = 16, /* vectors whose pairs are mixed: see mix */
    LANES_MAX = 16,
};
_Static_assert((int)LANES_MAX <= (int)HS_VERLET_PAD, "a vector beyond the last neighbor is in the padding");

void hs_verlet_list_fini(hs_verlet_list *list)
{
    for (int k = 0; k < list->n_chunks; ++k) {
        HS_FREE(list->chunk[k].start);
        HS_FREE(list->chunk[k].neighbor);
        HS_FREE(list->chunk[k].rest.i);
        HS_FREE(list->chunk[k].rest.j);
        HS_FREE(list->chunk[k].blocks.block);
    }
    HS_FREE(list->chunk);
    memset(list, 0, sizeof *list);
}

static hs_status set_chunks(hs_verlet_list *list, const hs_cluster_part *local, hs_error *err)
{
    const int n_chunks = hs_list_chunks_for(local->n, CLUSTERS_PER_CHUNK_MAX);
    if (n_chunks > list->n_chunks) {
        HS_TRY(HS_GROW(list->chunk, (size_t)list->n_chunks, (size_t)n_chunks, err));
        list->n_chunks = n_chunks;
    }
    for (int k = 0; k < list->n_chunks; ++k) {
        hs_verlet_chunk *chunk = &list->chunk[k];
        hs_list_chunk_range(local->n, list->n_chunks, k, &chunk->begin, &chunk->end);
        chunk->first = chunk->n_atoms = 0;
        if (chunk->begin == chunk->end) continue;
        const int last = chunk->end - 1;
        chunk->first = local->entry[chunk->begin].first;
        chunk->n_atoms = local->entry[last].first + local->size[last] - chunk->first;
    }
    return HS_OK;
}

static int64_t n_pairs_of(const hs_verlet_chunk *chunk) { return chunk->n + chunk->rest.n; }

/** Room for n_more neighbors and the padding. */
static hs_status reserve_neighbors(hs_verlet_chunk *chunk, int64_t n_more, hs_error *err)
{
    if (chunk->n + n_more <= chunk->capacity) return HS_OK;
    const int64_t capacity = (chunk->n + n_more) * 5 / 4 + 256;
    HS_TRY(HS_GROW(chunk->neighbor, (size_t)chunk->n, (size_t)capacity + HS_VERLET_PAD, err));
    chunk->capacity = capacity;
    return HS_OK;
}

static hs_status reserve_pairs(hs_pair_list *pairs, int64_t n_more, hs_error *err)
{
    if (pairs->n + n_more <= pairs->capacity) return HS_OK;
    const int64_t capacity = (pairs->n + n_more) * 5 / 4 + 256;
    HS_TRY(HS_GROW(pairs->i, (size_t)pairs->n, (size_t)capacity + HS_VERLET_PAD, err));
    HS_TRY(HS_GROW(pairs->j, (size_t)pairs->n, (size_t)capacity + HS_VERLET_PAD, err));
    pairs->capacity = capacity;
    return HS_OK;
}

static hs_status begin_chunk(hs_verlet_chunk *chunk, hs_error *err)
{
    chunk->n = 0;
    chunk->rest.n = 0;
    chunk->blocks.n = 0;
    HS_TRY(reserve_neighbors(chunk, 1, err)); /* what is read beyond the last is there, even if there is none */
    if (chunk->n_atoms + 1 > chunk->capacity_start) {
        const int64_t capacity = chunk->n_atoms + chunk->n_atoms / 8 + 4;
        HS_TRY(HS_GROW(chunk->start, 0, (size_t)capacity, err));
        chunk->capacity_start = capacity;
    }
    return HS_OK;
}

/** Of a row of four j-atoms: where the ones whose bit is set are, packed to the front. */
typedef int32_t row_places __attribute__((vector_size(HS_CLUSTER * sizeof(int32_t))));
static const row_places packed[16] = {
    {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {2, 0, 0, 0}, {0, 2, 0, 0}, {1, 2, 0, 0}, {0, 1, 2, 0},
    {3, 0, 0, 0}, {0, 3, 0, 0}, {1, 3, 0, 0}, {0, 1, 3, 0}, {2, 3, 0, 0}, {0, 2, 3, 0}, {1, 2, 3, 0}, {0, 1, 2, 3},
};
static const unsigned char n_bits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/** Append the j-atoms of one row (i-atom) of refined entries. There is room for all of their atoms: each entry writes four,
 *  of which the next overwrites what does not count. */
static void append_row(hs_verlet_chunk *chunk, const hs_entry_list *entries, int row)
{
    int32_t *to = chunk->neighbor + chunk->n;
    for (int e = 0; e < entries->n; ++e) {
        const uint32_t bits = entries->entry[e].mask >> HS_CLUSTER * row & 0xfu;
        const row_places atoms = packed[bits] + entries->entry[e].first;
        memcpy(to, &atoms, sizeof atoms);
        to += n_bits[bits];
    }
    chunk->n = to - chunk->neighbor;
}

/** Take the last neighbors of atom i, those beyond full vectors of so many lanes (a power of two), over to the pairs. The list begins
 *  at neighbor[begin]; there is room, and padding, into which more is written than counts. */
static void take_rest(hs_verlet_chunk *chunk, int64_t begin, int i, int lanes)
{
    hs_pair_list *rest = &chunk->rest;
    const int64_t n_rest = (chunk->n - begin) & (lanes - 1);
    chunk->n -= n_rest;
    memcpy(rest->j + rest->n, chunk->neighbor + chunk->n, LANES_MAX * sizeof *rest->j);
    for (int k = 0; k < LANES_MAX; ++k) rest->i[rest->n + k] = i;
    rest->n += n_rest;
}

/** List the neighbors of the atoms of one cluster. */
static hs_status list_cluster(hs_verlet_chunk *chunk, hs_force_buffer *buffer, const hs_force_job *job, int ci,
                              int column, hs_error *err)
{
    const hs_kernel_set *set = job->evaluator->set[job->isa][job->precision];
    hs_entry_list *found = &buffer->entries;
    const hs_cluster_part *local = &job->clusters->local;
    const int first = local->entry[ci].first;
    found->n = 0;
    HS_TRY(hs_isa_find(job->isa)(&buffer->search, ci, column, found, err));
    const int n_found = found->n;
    hs_entry_list kept = {0}; /* in the room behind the candidates */
    if (n_found > 0) {
        HS_TRY(hs_entry_list_pad(found, 0, set->group, first, err));
        HS_TRY(hs_entry_list_reserve(found, found->n, err));
        int64_t n_pairs = 0; /* counted by the lists, below */
        kept.entry = found->entry + found->n;
        kept.n = hs_isa_refine(job->isa)(&job->input, first, found->entry, n_found, set->group, kept.entry, &n_pairs);
    }
    HS_TRY(reserve_neighbors(chunk, (int64_t)HS_CLUSTER * HS_CLUSTER * kept.n, err));
    HS_TRY(reserve_pairs(&chunk->rest, (int64_t)HS_CLUSTER * set->lanes, err));
    for (int row = 0; row < local->size[ci]; ++row) {
        const int64_t begin = chunk->n;
        chunk->start[first + row - chunk->first] = begin;
        append_row(chunk, &kept, row);
        take_rest(chunk, begin, first + row, set->lanes);
    }
    return HS_OK;
}

/** Note the blocks of all atoms of the chunk's pairs, each once. Uses the thread's `touched` as scratch: it is cleared
 *  before every evaluation. */
static hs_status note_blocks(hs_verlet_chunk *chunk, unsigned char *touched, int64_t n_blocks, hs_error *err)
{
    memset(touched, 0, (size_t)n_blocks);
    for (int i = 0; i < chunk->n_atoms; i += HS_FORCE_BLOCK) touched[(chunk->first + i) >> HS_FORCE_BLOCK_BITS] = 1;
    touched[(chunk->first + chunk->n_atoms - 1) >> HS_FORCE_BLOCK_BITS] = 1;
    for (int64_t k = 0; k < chunk->n; ++k) touched[chunk->neighbor[k] >> HS_FORCE_BLOCK_BITS] = 1;
    for (int64_t k = 0; k < chunk->rest.n; ++k) touched[chunk->rest.j[k] >> HS_FORCE_BLOCK_BITS] = 1;
    return hs_block_list_set(&chunk->blocks, touched, n_blocks, err);
}

/** Neighbors of one atom follow one another; a vector of such pairs would add to one force again and again, each time waiting for the
 *  last sum (half the kernel's time). So blocks of pairs are transposed: each lane gets a run of them. */
static void mix(int32_t *of_pairs, int64_t n, int lanes)
{
    int32_t block[VECTORS_BETWEEN * LANES_MAX];
    for (int64_t begin = 0; begin < n; begin += VECTORS_BETWEEN * lanes) {
        const int64_t left = n - begin, vectors = left / lanes < VECTORS_BETWEEN ? left / lanes : VECTORS_BETWEEN;
        memcpy(block, of_pairs + begin, (size_t)(vectors * lanes) * sizeof *block);
        for (int64_t v = 0; v < vectors; ++v)
            for (int lane = 0; lane < lanes; ++lane) of_pairs[begin + v * lanes + lane] = block[lane * vectors + v];
    }
}

static hs_status build_chunk(hs_verlet_chunk *chunk, hs_force_buffer *buffer, const hs_force_job *job, hs_error *err)
{
    const hs_atoms *atoms = job->atoms;
    HS_TRY(begin_chunk(chunk, err));
    if (chunk->begin == chunk->end) return HS_OK;
    int column = hs_clusters_column(job->clusters, job->cells, chunk->begin);
    for (int ci = chunk->begin; ci < chunk->end; ++ci) {
        while (job->clusters->local.column_begin[column + 1] <= ci) ++column;
        HS_TRY(list_cluster(chunk, buffer, job, ci, column, err));
    }
    chunk->start[chunk->n_atoms] = chunk->n;
    if (n_pairs_of(chunk) == 0) return HS_OK;
    const int lanes = job->evaluator->set[job->isa][job->precision]->lanes;
    mix(chunk->rest.i, chunk->rest.n, lanes);
    mix(chunk->rest.j, chunk->rest.n, lanes);
    for (int k = 0; k < HS_VERLET_PAD; ++k) {
        chunk->neighbor[chunk->n + k] = chunk->first;
        chunk->rest.i[chunk->rest.n + k] = chunk->rest.j[chunk->rest.n + k] = chunk->first;
    }
    const int64_t n_atoms = (int64_t)atoms->n_local + atoms->n_halo;
    return note_blocks(chunk, buffer->touched, (n_atoms + HS_FORCE_BLOCK - 1) >> HS_FORCE_BLOCK_BITS, err);
}

/** Chunks that this thread comes to. */
static void build_chunks(hs_verlet_list *list, hs_force_space *space, const hs_force_job *job)
{
    hs_force_buffer *buffer = &space->buffer[hs_thread_number()];
    hs_cluster_search_begin(&buffer->search, job->clusters, job->cells, job->cutoff_max, INFINITY);
#pragma omp for schedule(dynamic, 1) nowait
    for (int k = 0; k < list->n_chunks; ++k) {
        hs_verlet_chunk *chunk = &list->chunk[k];
        hs_error_clear(&chunk->error);
        (void)(build_chunk(chunk, buffer, job, &chunk->error) == HS_OK);
    }
}

hs_status hs_verlet_list_build(hs_verlet_list *list, hs_force_space *space, const hs_force_job *job, hs_error *err)
{
    HS_TRY(set_chunks(list, &job->clusters->local, err));
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
    HS_ON_THREADS(build_chunks(list, space, job));
    for (int k = 0; k < list->n_chunks; ++k)
        if (list->chunk[k].error.status != HS_OK) {
            *err = list->chunk[k].error;
            return err->status;
        }
    list->generation = job->atoms->generation;
    return HS_OK;
}

int64_t hs_verlet_list_n_pairs(const hs_verlet_list *list)
{
    int64_t n = 0;
    for (int k = 0; k < list->n_chunks; ++k) n += n_pairs_of(&list->chunk[k]);
    return n;
}

static int64_t weight(const void *list, int chunk) { return n_pairs_of(&((const hs_verlet_list *)list)->chunk[chunk]); }

static hs_status work_verlet(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    hs_force_buffer *buffer = &space->buffer[thread];
    const hs_verlet_list *list = job->verlet;
    const hs_kernel_set *set = job->evaluator->set[job->isa][job->precision];
    const bool by_type = !job->input.table->is_uniform;
    const hs_verlet_kernel kernel = set->verlet[job->with_energy][by_type];
    const hs_pairs_kernel pairs_kernel = set->pairs[job->with_energy][by_type];
    bool is_cut; /* never: there are no stages */
    for (int k; (k = hs_list_take(space, stage, thread, &is_cut)) >= 0;) {
        const hs_verlet_chunk *chunk = &list->chunk[k];
        if (n_pairs_of(chunk) == 0) continue;
        hs_block_list_touch(&chunk->blocks, buffer, job);
        if (chunk->n > 0)
            kernel(&job->input, &buffer->out, chunk->first, chunk->first + chunk->n_atoms, chunk->start,
                   chunk->neighbor);
        pairs_kernel(&job->input, &buffer->out, chunk->rest.n, chunk->rest.i, chunk->rest.j);
    }
    return HS_OK;
}

hs_status hs_force_verlet(hs_force_space *space, const hs_verlet_list *list, const hs_force_job *job,
                          hs_force_result *result, hs_error *err)
{
    hs_force_job listed = *job;
    assert(list->generation == job->atoms->generation);
    listed.verlet = list;
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
    hs_list_share(space, list, weight, list->n_chunks);
    return hs_force_run_threads(space, &listed, work_verlet, false, result, err);
}
