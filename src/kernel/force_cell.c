/* Method `cell`: no lists; the neighbors of each cluster are searched and its pairs computed at once, at every step. */
#include <math.h>

#include "kernel/force.h"

static hs_cluster_kernel choose_kernel(const hs_force_job *job, bool listed_only)
{
    const hs_kernel_set *set = job->evaluator->set[job->isa][job->precision];
    return hs_kernel_for_clusters(set, &job->input, job->with_energy, listed_only);
}

/** Make the forces on clusters [begin, end) of a part, which the thread may write to, ready to be added to. */
static void touch_run(hs_force_buffer *buffer, const hs_force_space *space, const hs_force_job *job,
                      const hs_cluster_part *part, hs_run run)
{
    const int64_t n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD;
    const int first = part->entry[run.begin].first, last = part->entry[run.end - 1].first;
    if (hs_force_is_packed(job)) {
        const int *place = space->packed.place_of;
        for (int64_t b = place[first] >> HS_PACKED_BLOCK_BITS; b <= place[last] >> HS_PACKED_BLOCK_BITS; ++b)
            hs_force_touch_packed(buffer, b);
    } else {
        for (int64_t b = first >> HS_FORCE_BLOCK_BITS; b <= (last + HS_CLUSTER - 1) >> HS_FORCE_BLOCK_BITS; ++b)
            hs_force_touch(buffer, b << HS_FORCE_BLOCK_BITS, n_room);
    }
}

/** The same for all clusters that those at hand can reach, themselves among them. */
static void touch_reached(hs_force_buffer *buffer, const hs_force_space *space, const hs_force_job *job)
{
    const hs_search *search = &buffer->search;
    for (int k = 0; k < search->local.n_runs; ++k)
        touch_run(buffer, space, job, &job->clusters->local, search->local.run[k]);
    for (int k = 0; k < search->halo.n_runs; ++k)
        touch_run(buffer, space, job, &job->clusters->halo, search->halo.run[k]);
}

/** The pairs of an i-cluster with the entries of a list. */
static hs_status apply_entries(hs_force_buffer *buffer, const hs_force_space *space, const hs_force_job *job, int ci,
                               hs_entry_list *entries, hs_cluster_kernel kernel)
{
    const int group = job->evaluator->set[job->isa][job->precision]->group,
              first = job->clusters->local.entry[ci].first;
    if (entries->n == 0) return HS_OK;
    HS_TRY(hs_entry_list_pad(entries, 0, group, first, &buffer->error));
    if (hs_force_is_packed(job)) hs_packed_rename(&space->packed, entries->entry, entries->n);
    kernel(&job->input, &buffer->out, hs_force_place(space, job, first), entries->entry, entries->n);
    hs_force_weigh(buffer, ci, job->clusters->local.n, entries->n);
    return HS_OK;
}

static hs_status work_cell(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    (void)stage;
    hs_force_buffer *buffer = &space->buffer[thread];
    hs_search *search = &buffer->search;
    const hs_cluster_part *local = &job->clusters->local;
    const bool by_motion = job->input.listed_only && job->clusters->has_motion;
    const hs_cluster_kernel kernel = choose_kernel(job, job->input.listed_only && !by_motion),
                            listed_kernel = choose_kernel(job, true);
    const hs_cluster_find find = hs_isa_find(job->isa);
    int64_t begin, end;
    hs_force_share(space, local->n, thread, &begin, &end);
    int column = begin < end ? hs_clusters_column(job->clusters, job->cells, (int)begin) : 0, touched_end = 0;
    /* pairs of atoms that have not moved by more than the skin together are listed */
    hs_cluster_search_begin(search, job->clusters, job->cells, job->cutoff_max, by_motion ? job->input.skin : INFINITY);
    for (int ci = (int)begin; ci < end; ++ci) {
        while (local->column_begin[column + 1] <= ci) ++column;
        buffer->entries.n = 0;
        HS_TRY(find(search, ci, column, &buffer->entries, &buffer->error));
        if (search->batch_end != touched_end) touch_reached(buffer, space, job);
        touched_end = search->batch_end;
        HS_TRY(apply_entries(buffer, space, job, ci, &buffer->entries, kernel));
        HS_TRY(apply_entries(buffer, space, job, ci, &search->moved, listed_kernel));
    }
    return HS_OK;
}

hs_status hs_force_cell(hs_force_space *space, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    hs_force_job packed = *job;
    HS_TRY(hs_force_pack(space, &packed, true, err));
    const hs_status status = hs_force_run_threads(space, &packed, work_cell, false, result, err);
    hs_force_keep_weights(space);
    return status;
}
