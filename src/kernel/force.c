#include "kernel/force.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/motion.h"
#include "parallel/cache.h"
#include "parallel/parallel.h"

static int64_t n_blocks(int64_t n_atoms) { return (n_atoms + HS_FORCE_BLOCK - 1) >> HS_FORCE_BLOCK_BITS; }

static void fini_buffer(hs_force_buffer *buffer, bool owns_forces)
{
    for (int axis = 0; axis < 3 && owns_forces; ++axis) HS_FREE(buffer->f[axis]);
    HS_FREE(buffer->packed_f);
    HS_FREE(buffer->touched);
    HS_FREE(buffer->entries.entry);
    hs_cluster_search_fini(&buffer->search);
    hs_candidates_fini(&buffer->candidates);
}

static void fini_buffers(hs_force_space *space)
{
    for (int t = 0; t < space->n_threads; ++t) fini_buffer(&space->buffer[t], t > 0);
    HS_FREE(space->buffer);
    HS_FREE(space->share);
    space->n_threads = 0;
    space->capacity_packed = 0;
}

void hs_force_space_fini(hs_force_space *space)
{
    fini_buffers(space);
    HS_FREE(space->is_open);
    hs_packed_fini(&space->packed);
    memset(space, 0, sizeof *space);
}

/** Room for n_atoms on every thread; nothing is touched yet. */
hs_status hs_force_space_reserve(hs_force_space *space, const hs_atoms *atoms, hs_error *err)
{
    const int n_threads = hs_threads_get();
    const int64_t n_atoms = (int64_t)atoms->n_local + atoms->n_halo + HS_ATOMS_PAD;
    if (n_threads != space->n_threads || n_atoms > space->capacity_atoms) {
        const int64_t capacity = n_atoms + n_atoms / 32;
        fini_buffers(space);
        space->capacity_atoms = 0; /* until all buffers are there */
        memset(space->weight, 0, sizeof space->weight);
        HS_TRY(HS_ALLOC(space->buffer, (size_t)n_threads, err));
        HS_TRY(HS_ALLOC(space->share, HS_N_STAGES * (size_t)n_threads, err));
        space->n_threads = n_threads;
        const size_t room = (size_t)n_blocks(capacity) * HS_FORCE_BLOCK + HS_ATOMS_PAD;
        for (int t = 0; t < n_threads; ++t) {
            for (int axis = 0; axis < 3 && t > 0; ++axis) HS_TRY(HS_ALLOC(space->buffer[t].f[axis], room, err));
            /* packed clusters may have less than four atoms each */
            const int64_t n_packed = capacity * HS_PACKED >> HS_PACKED_BLOCK_BITS;
            HS_TRY(HS_ALLOC(space->buffer[t].touched, (size_t)n_packed + 2, err));
        }
        space->capacity_atoms = capacity;
    }
    for (int axis = 0; axis < 3; ++axis) space->buffer[0].f[axis] = atoms->f[axis];
    return HS_OK;
}

static int64_t n_packed_blocks(const hs_packed *packed)
{
    return ((int64_t)packed->n * HS_PACKED + HS_PACKED_BLOCK - 1) >> HS_PACKED_BLOCK_BITS;
}

/** Blocks of forces of this evaluation. */
static int64_t n_blocks_of(const hs_force_space *space, const hs_force_job *job)
{
    return hs_force_is_packed(job) ? n_packed_blocks(&space->packed)
                                   : n_blocks((int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD);
}

hs_status hs_force_pack(hs_force_space *space, hs_force_job *job, bool is_new, hs_error *err)
{
    hs_packed *packed = &space->packed;
    if (job->precision != HS_PRECISION_MIXED) return HS_OK;
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
    if (is_new) HS_TRY(hs_packed_begin(packed, job->clusters, job->atoms, job->cutoff_max, err));
    const int64_t n = n_packed_blocks(packed) << HS_PACKED_BLOCK_BITS;
    if (n > space->capacity_packed) {
        space->capacity_packed = n + n / 32;
        for (int t = 0; t < space->n_threads; ++t)
            HS_TRY(HS_GROW(space->buffer[t].packed_f, 0, (size_t)space->capacity_packed, err));
    }
    return hs_packed_use(packed, &job->input, err);
}

static void begin_thread(hs_force_space *space, const hs_force_job *job, int thread)
{
    hs_force_buffer *buffer = &space->buffer[thread];
    const int64_t n_blocks_used = n_blocks_of(space, job);
    const bool is_ready = job->is_added && thread == 0 && !hs_force_is_packed(job); /* to be added to */
    buffer->n_axes = job->input.is_flat ? 2 : 3;
    memset(buffer->touched, is_ready, (size_t)n_blocks_used + 1);
    memset(&buffer->error, 0, sizeof buffer->error);
    buffer->entries.n = 0;
    buffer->out = (hs_kernel_output){.f = {buffer->f[0], buffer->f[1], buffer->f[2]}, .packed_f = buffer->packed_f};
    memset(buffer->weight, 0, sizeof buffer->weight);
}

/** f = a + b on [begin, end), where f may be a; in fixed point all hold integers. */
static void add_forces(double *f, const double *a, const double *b, int64_t begin, int64_t end, bool is_fixed)
{
    typedef uint64_t __attribute__((may_alias)) integer;
    if (is_fixed)
        for (int64_t i = begin; i < end; ++i) ((integer *)f)[i] = ((const integer *)a)[i] + ((const integer *)b)[i];
    else
        for (int64_t i = begin; i < end; ++i) f[i] = a[i] + b[i];
}

/** Blocks of forces, and what becomes of them. */
typedef struct reduction {
    hs_force_space *space;
    const hs_motion_set *motion;
    int64_t n_room; /**< atoms of all blocks */
    int n_axes;
    bool is_fixed;
    double settling_unit; /**< as in the job */
} reduction;

/** One axis of one block [begin, end): what all threads wrote to it, in thread 0's (the atoms') forces. */
static void reduce_axis(const reduction *r, int axis, int64_t block, int64_t begin, int64_t end, bool is_settled)
{
    const hs_force_space *space = r->space;
    double *const f = space->buffer[0].f[axis];
    const double *sum = space->buffer[0].touched[block] ? f : NULL;
    for (int t = 1; t < space->n_threads; ++t) {
        const double *part = space->buffer[t].f[axis];
        if (!space->buffer[t].touched[block]) continue;
        if (sum != NULL) add_forces(f, sum, part, begin, end, r->is_fixed);
        sum = sum != NULL ? f : part;
    }
    if (sum == NULL)
        memset(f + begin, 0, (size_t)(end - begin) * sizeof *f); /* an integer 0 is the number 0, too */
    else if (is_settled)
        r->motion->settle(f + begin, sum + begin, end - begin, r->settling_unit);
    else if (sum != f)
        memcpy(f + begin, sum + begin, (size_t)(end - begin) * sizeof *f);
}

static void reduce_block(const reduction *r, int64_t block, bool is_local)
{
    const int64_t begin = block << HS_FORCE_BLOCK_BITS;
    const int64_t end = begin + HS_FORCE_BLOCK < r->n_room ? begin + HS_FORCE_BLOCK : r->n_room;
    const bool is_settled = is_local && r->settling_unit != 0.0 && !r->space->is_open[block];
    for (int axis = 0; axis < r->n_axes; ++axis) reduce_axis(r, axis, block, begin, end, is_settled);
}

/** Take the positions of a block that other threads have read back from their caches, for they will be written soon. */
static void take_back_positions(const hs_force_space *space, const hs_force_job *job, int64_t block, int thread)
{
    const hs_atoms *atoms = job->atoms;
    const int64_t begin = block << HS_FORCE_BLOCK_BITS, left = atoms->n_local - begin;
    const int n_axes = job->input.is_flat ? 2 : 3;
    bool is_shared = false;
    for (int t = 0; t < space->n_threads && left > 0; ++t) is_shared |= t != thread && space->buffer[t].touched[block];
    for (int axis = 0; axis < n_axes && is_shared; ++axis)
        hs_cache_take(atoms->x[axis] + begin, sizeof(double) * (size_t)(left < HS_FORCE_BLOCK ? left : HS_FORCE_BLOCK));
}

/** The atoms' forces of one block of packed clusters, from the threads that wrote there. */
static void unpack_block(const hs_force_space *space, const hs_force_job *job, const float **part, int64_t block)
{
    int n_parts = 0;
    for (int t = 0; t < space->n_threads; ++t)
        if (space->buffer[t].touched[block]) part[n_parts++] = space->buffer[t].packed_f;
    hs_packed_unpack(&space->packed, job->clusters, block, part, n_parts, job->atoms, job->is_added);
}

void hs_force_result_add(hs_force_result *sum, const hs_force_result *added)
{
    sum->energy += added->energy;
    sum->energy_fixed += added->energy_fixed;
    for (int k = 0; k < 6; ++k) {
        sum->virial[k] += added->virial[k];
        sum->virial_fixed[k] += added->virial_fixed[k];
    }
    sum->peak_force = fmax(sum->peak_force, added->peak_force);
    sum->peak_energy = fmax(sum->peak_energy, added->peak_energy);
}

static void add_output(hs_force_result *result, const hs_kernel_output *out)
{
    result->energy += out->energy;
    result->energy_fixed += out->energy_fixed;
    for (int k = 0; k < 6; ++k) {
        result->virial[k] += out->virial[k];
        result->virial_fixed[k] += out->virial_fixed[k];
    }
    result->peak_force = fmax(result->peak_force, out->peak_force);
    result->peak_energy = fmax(result->peak_energy, out->peak_energy);
}

/** The first block of forces on halo atoms. */
static int64_t first_halo_block(const hs_force_job *job)
{
    return hs_force_is_packed(job) ? (int64_t)job->clusters->local.n * HS_PACKED >> HS_PACKED_BLOCK_BITS
                                   : job->atoms->n_local >> HS_FORCE_BLOCK_BITS;
}

/** Reduce one block of forces; is_local: all of its atoms are. */
static void reduce(hs_force_space *space, const hs_force_job *job, const float **part, int64_t block, bool is_local)
{
    const reduction r = {.space = space,
                         .motion = hs_isa_motion(job->isa),
                         .n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD,
                         .n_axes = job->input.is_flat ? 2 : 3,
                         .is_fixed = job->precision == HS_PRECISION_FIXED,
                         .settling_unit = job->settling_unit};
    if (hs_force_is_packed(job)) {
        unpack_block(space, job, part, block);
    } else {
        reduce_block(&r, block, is_local);
        take_back_positions(space, job, block, hs_thread_number());
        for (int t = 0; t < space->n_threads; ++t) space->buffer[t].touched[block] = t == 0;
    }
}

/** A stage, and the blocks of forces [begin, end) that are reduced after it. */
typedef struct stage_work {
    hs_force_space *space;
    const hs_force_job *job;
    hs_force_work work;
    hs_force_stage stage;
    int64_t begin, end;
} stage_work;

/** One stage on one thread, then its share of the reduction. Blocks of local atoms come first, shared as the loops over local atoms are
 *  that follow, so that each thread finds in its cache what it has written. */
static void run_stage_on_thread(const stage_work *w)
{
    hs_force_space *space = w->space;
    const hs_force_job *job = w->job;
    const int thread = hs_thread_number();
    hs_force_buffer *buffer = &space->buffer[thread];
    const float *part[space->n_threads];
    const int64_t first_halo = first_halo_block(job),
                  middle = first_halo < w->begin ? w->begin : (first_halo < w->end ? first_halo : w->end);
    if (w->stage == HS_STAGE_ALL || w->stage == HS_STAGE_BEFORE) begin_thread(space, job, thread);
    if (buffer->error.status == HS_OK) (void)w->work(space, job, w->stage, thread);
#pragma omp barrier
#pragma omp for schedule(static) nowait
    for (int64_t block = w->begin; block < middle; ++block) reduce(space, job, part, block, true);
#pragma omp for schedule(static) nowait
    for (int64_t block = middle; block < w->end; ++block) reduce(space, job, part, block, false);
}

static void run_stage(hs_force_space *space, const hs_force_job *job, hs_force_work work, hs_force_stage stage,
                      int64_t begin, int64_t end)
{
    const stage_work w = {space, job, work, stage, begin, end};
    HS_ON_THREADS(run_stage_on_thread(&w));
}

/** Pack clusters from number `begin` on. */
static void fill_packed(hs_force_space *space, const hs_force_job *job, int begin)
{
    if (hs_force_is_packed(job)) hs_packed_fill(&space->packed, job->clusters, &job->input, begin, space->packed.n);
}

static void run_stages(hs_force_space *space, const hs_force_job *job, hs_force_work work, bool is_staged)
{
    const hs_force_halo *halo = job->halo;
    const int64_t n_all = n_blocks_of(space, job);
    /* what is unpacked twice must not be added twice */
    const bool can_add = !hs_force_is_packed(job) || !job->is_added;
    if (is_staged && can_add && halo != NULL && halo->is_remote) {
        fill_packed(space, job, 0); /* the halo, too: images of the rank's own atoms are there already */
        run_stage(space, job, work, HS_STAGE_BEFORE, 0, 0);
        halo->await(halo->context);
        fill_packed(space, job, job->clusters->local.n);
        run_stage(space, job, work, HS_STAGE_MAIN, first_halo_block(job), n_all);
        if (halo->send != NULL) halo->send(halo->context);
        run_stage(space, job, work, HS_STAGE_AFTER, 0, n_all);
        return;
    }
    if (halo != NULL) halo->await(halo->context);
    fill_packed(space, job, 0);
    run_stage(space, job, work, HS_STAGE_ALL, 0, n_all);
    if (halo != NULL && halo->send != NULL) halo->send(halo->context);
}

hs_status hs_force_run_threads(hs_force_space *space, const hs_force_job *job, hs_force_work work, bool is_staged,
                               hs_force_result *result, hs_error *err)
{
    HS_TRY(hs_force_space_reserve(space, job->atoms, err));
    run_stages(space, job, work, is_staged);
    memset(result, 0, sizeof *result);
    for (int t = 0; t < space->n_threads; ++t) {
        const hs_force_buffer *buffer = &space->buffer[t];
        if (buffer->error.status != HS_OK && err->status == HS_OK) *err = buffer->error;
        add_output(result, &buffer->out);
    }
    return err->status;
}

void hs_force_share(const hs_force_space *space, int64_t n, int thread, int64_t *begin, int64_t *end)
{
    int64_t total = 0, before = 0;
    for (int k = 0; k < HS_FORCE_CHUNKS; ++k) total += space->weight[k] + 1;
    int64_t *const bound[2] = {begin, end};
    for (int side = 0; side < 2; ++side) {
        const int64_t wanted = total * (thread + side) / space->n_threads;
        int k = 0;
        for (before = 0; k < HS_FORCE_CHUNKS && before + space->weight[k] + 1 <= wanted; ++k)
            before += space->weight[k] + 1;
        const double chunk = k < HS_FORCE_CHUNKS ? k + (double)(wanted - before) / (double)(space->weight[k] + 1) : k;
        *bound[side] = (int64_t)(chunk * (double)n / HS_FORCE_CHUNKS);
    }
    if (thread == space->n_threads - 1) *end = n;
}

void hs_force_keep_weights(hs_force_space *space)
{
    for (int k = 0; k < HS_FORCE_CHUNKS; ++k) {
        space->weight[k] = 0;
        for (int t = 0; t < space->n_threads; ++t) space->weight[k] += space->buffer[t].weight[k];
    }
}

int hs_fixed_exponent(double value, int bits)
{
    int exponent;
    (void)frexp(value, &exponent); /* value < 2^exponent */
    return exponent - bits;
}

void hs_force_job_set_grid(hs_force_job *job, hs_fixed_grid grid)
{
    job->input.magic_force = ldexp(1.5, 52 + grid.force);
    job->input.magic_energy = ldexp(1.5, 52 + grid.energy);
}

hs_status hs_force_find_open(hs_force_space *space, int n_local, const int32_t *source, int n_sources, uint64_t version,
                             hs_error *err)
{
    const int64_t n = n_blocks((int64_t)n_local + 1); /* the last one even where it is empty */
    if (space->open_version == version) return HS_OK;
    if (n > space->capacity_open) {
        space->open_version = 0;
        HS_TRY(HS_GROW(space->is_open, 0, (size_t)(n + n / 8), err));
        space->capacity_open = n + n / 8;
    }
    memset(space->is_open, 0, (size_t)n);
    space->is_open[n_local >> HS_FORCE_BLOCK_BITS] = 1;
    for (int k = 0; k < n_sources; ++k) space->is_open[source[k] >> HS_FORCE_BLOCK_BITS] = 1;
    space->open_version = version;
    return HS_OK;
}

static void settle_open(const hs_force_space *space, hs_atoms *atoms, hs_motion_settle settle, double unit, int n_axes)
{
    const int64_t n_atoms = atoms->n_local;
#pragma omp for schedule(static) nowait
    for (int64_t block = 0; block < n_blocks(n_atoms); ++block) {
        const int64_t begin = block << HS_FORCE_BLOCK_BITS, left = n_atoms - begin,
                      n = left < HS_FORCE_BLOCK ? left : HS_FORCE_BLOCK;
        for (int axis = 0; axis < n_axes && space->is_open[block]; ++axis)
            settle(atoms->f[axis] + begin, atoms->f[axis] + begin, n, unit);
    }
}

void hs_force_settle(const hs_force_space *space, hs_atoms *atoms, hs_isa isa, int exponent, bool is_flat)
{
    const double unit = ldexp(1.0, exponent);
    HS_ON_THREADS(settle_open(space, atoms, hs_isa_motion(isa)->settle, unit, is_flat ? 2 : 3));
}
