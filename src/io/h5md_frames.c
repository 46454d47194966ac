#include "io/h5md_frames.h"

#include "base/memory.h"
#include "io/rows.h"

/** A number that is another for other sets of ids, whatever their order. */
static int64_t sum_of_ids(const hs_atoms *atoms, uint32_t mask)
{
    uint64_t sum = 0;
    for (int i = 0; i < atoms->n_local; ++i) {
        if ((atoms->mask[i] & mask) == 0) continue;
        uint64_t z = (uint64_t)atoms->id[i] * UINT64_C(0x9e3779b97f4a7c15);
        z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
        sum += z ^ (z >> 31);
    }
    return (int64_t)(sum & INT64_MAX) >> 16; /* the sum over ranks must not overflow */
}

/** Room for one block on this rank. */
typedef struct block {
    void *mine; /**< owned; [n_mine] */
    void *all;  /**< owned on rank 0 of several ranks, else mine: [n_block] */
    size_t n_bytes;
} block;

static hs_status fit_block(block *b, const hs_rows *rows, hs_error *err)
{
    const size_t n_bytes = 3 * sizeof(double) * (size_t)rows->n_block;
    if (n_bytes > b->n_bytes) {
        if (b->all != b->mine) HS_FREE(b->all);
        HS_FREE(b->mine);
        b->all = NULL;
        b->n_bytes = 0;
        if (hs_memory_alloc(&b->mine, n_bytes, 1, err) == HS_OK) b->n_bytes = n_bytes;
        b->all = b->mine;
        if (rows->parallel->n_ranks > 1) {
            b->all = NULL;
            if (rows->parallel->rank == 0 && hs_memory_alloc(&b->all, n_bytes, 1, err) != HS_OK) b->n_bytes = 0;
        }
    }
    return hs_parallel_agree(rows->parallel, err);
}

static void free_block(block *b)
{
    if (b->all != b->mine) HS_FREE(b->all);
    HS_FREE(b->mine);
}

/** Ids of the block's rows on rank 0. */
static hs_status gather_ids(const hs_atoms *atoms, hs_rows *rows, int64_t *mine, int64_t *all, hs_error *err)
{
    for (int k = 0; k < rows->n_mine; ++k) mine[k] = atoms->id[rows->mine[k]];
    return hs_rows_gather(rows, mine, sizeof *mine, all, err);
}

/** On rank 0: rows for those atoms of the block that have none. Called with the gathered ids and types. */
static hs_status add_rows(hs_h5md *file, const hs_atoms *atoms, int n, int64_t *id, int32_t *type, double *mass,
                          hs_error *err)
{
    int n_new = 0;
    for (int k = 0; k < n; ++k) {
        if (hs_h5md_row(file, id[k]) >= 0) continue;
        id[n_new] = id[k];
        type[n_new] = type[k];
        mass[n_new++] = atoms->mass[type[k]];
    }
    if (n_new == 0) return HS_OK;
    const hs_h5md_rows rows = {.id = id, .species = type, .mass = mass};
    return hs_h5md_set_rows(file, hs_h5md_n_rows(file), n_new, &rows, err);
}

/** All atoms of this frame have rows after this (collective). */
static hs_status find_rows(hs_h5md_frames *self, const hs_env *env, hs_error *err)
{
    const bool is_root = env->parallel->rank == 0;
    hs_rows rows = {0};
    block ids = {0}, types = {0}, masses = {0};
    if (is_root) (void)!hs_h5md_index(self->file, err);
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) status = hs_rows_begin(&rows, env->parallel, env->atoms, self->mask, err);
    while (status == HS_OK && hs_rows_next(&rows, &status, err)) {
        status = fit_block(&ids, &rows, err);
        if (status == HS_OK) status = fit_block(&types, &rows, err);
        if (status == HS_OK) status = fit_block(&masses, &rows, err);
        if (status == HS_OK) status = gather_ids(env->atoms, &rows, ids.mine, ids.all, err);
        int32_t *type = types.mine;
        for (int k = 0; k < rows.n_mine && status == HS_OK; ++k) type[k] = env->atoms->type[rows.mine[k]];
        if (status == HS_OK) status = hs_rows_gather(&rows, types.mine, sizeof(int32_t), types.all, err);
        if (status == HS_OK && is_root)
            (void)!add_rows(self->file, env->atoms, rows.n_block, ids.all, types.all, masses.mine, err);
        status = hs_parallel_agree(env->parallel, err);
    }
    if (status == HS_OK && is_root) (void)!hs_h5md_index(self->file, err);
    free_block(&ids);
    free_block(&types);
    free_block(&masses);
    hs_rows_end(&rows);
    return hs_parallel_agree(env->parallel, err);
}

static void pack_vectors(double *const from[3], const hs_rows *rows, double *mine)
{
#pragma omp parallel for schedule(static)
    for (int k = 0; k < rows->n_mine; ++k)
        for (int axis = 0; axis < 3; ++axis) mine[3 * k + axis] = from[axis][rows->mine[k]];
}

/** Positions in the box (or, with is_image, the images that go with them). */
static void pack_wrapped(const hs_env *env, const hs_rows *rows, bool is_image, void *mine)
{
    const hs_atoms *atoms = env->atoms;
    double *real = mine;
    int32_t *whole = mine;
#pragma omp parallel for schedule(static)
    for (int k = 0; k < rows->n_mine; ++k) {
        const int i = rows->mine[k];
        double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        int32_t image[3] = {0, 0, 0};
        hs_box_wrap(env->box, x, image);
        for (int axis = 0; axis < 3; ++axis) {
            if (is_image)
                whole[3 * k + axis] = image[axis] + atoms->image[axis][i];
            else
                real[3 * k + axis] = x[axis];
        }
    }
}

/** This rank's values of an element. */
static void pack(const hs_env *env, hs_h5md_kind kind, const hs_rows *rows, void *mine)
{
    switch (kind) {
    case HS_H5MD_POSITION:
    case HS_H5MD_IMAGE:
        pack_wrapped(env, rows, kind == HS_H5MD_IMAGE, mine);
        return;
    case HS_H5MD_VELOCITY:
        pack_vectors(env->atoms->v, rows, mine);
        return;
    case HS_H5MD_FORCE:
        pack_vectors(env->atoms->f, rows, mine);
        return;
    default:
        for (int k = 0; k < rows->n_mine; ++k) ((int32_t *)mine)[k] = env->atoms->type[rows->mine[k]];
    }
}

/** On rank 0: values of the block into their rows, in runs of rows that follow one another. */
static hs_status put_block(const hs_h5md_frames *self, int element, const hs_rows *rows, const int64_t *id,
                           const char *values, size_t size, hs_error *err)
{
    if (self->is_regular) return hs_h5md_put_rows(self->file, element, rows->first_row, rows->n_block, values, err);
    for (int begin = 0, end; begin < rows->n_block; begin = end) {
        const int64_t first = hs_h5md_row(self->file, id[begin]);
        for (end = begin + 1; end < rows->n_block && hs_h5md_row(self->file, id[end]) == first + (end - begin);) ++end;
        HS_TRY(hs_h5md_put_rows(self->file, element, first, end - begin, values + size * (size_t)begin, err));
    }
    return HS_OK;
}

static hs_status write_block(const hs_h5md_frames *self, const hs_env *env, hs_rows *rows, block *ids, block *values,
                             bool *is_regular, hs_error *err)
{
    const bool is_root = env->parallel->rank == 0;
    HS_TRY(fit_block(values, rows, err));
    HS_TRY(fit_block(ids, rows, err));
    if (!self->is_regular) HS_TRY(gather_ids(env->atoms, rows, ids->mine, ids->all, err));
    for (int k = 0; k < rows->n_block && is_root && !self->is_regular; ++k)
        *is_regular = *is_regular && hs_h5md_row(self->file, ((int64_t *)ids->all)[k]) == rows->first_row + k;
    for (int element = 0; element < self->n_elements; ++element) {
        const size_t size = (self->element[element].is_integer ? sizeof(int32_t) : sizeof(double)) *
                            (size_t)self->element[element].n_columns;
        pack(env, self->kind[element], rows, values->mine);
        HS_TRY(hs_rows_gather(rows, values->mine, size, values->all, err));
        if (is_root) (void)!put_block(self, element, rows, ids->all, values->all, size, err);
        HS_TRY(hs_parallel_agree(env->parallel, err));
    }
    return HS_OK;
}

static hs_status write_frame(hs_h5md_frames *self, hs_env *env, hs_observables *observables, hs_error *err)
{
    const bool is_root = env->parallel->rank == 0;
    const double time = env->time_origin + (double)(env->step - env->time_origin_step) * env->dt;
    hs_rows rows = {0};
    block ids = {0}, values = {0};
    bool is_regular = true;
    if (is_root) (void)!hs_h5md_begin_frame(self->file, env->step, time, env->box, err);
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) status = hs_observables_write(observables, env, self->file, "dump h5md", err);
    if (status == HS_OK) status = hs_rows_begin(&rows, env->parallel, env->atoms, self->mask, err);
    while (status == HS_OK && hs_rows_next(&rows, &status, err))
        status = write_block(self, env, &rows, &ids, &values, &is_regular, err);
    if (status == HS_OK && is_root) {
        (void)!hs_h5md_end_frame(self->file, err);
        is_regular = is_regular && rows.n_all == hs_h5md_n_rows(self->file);
    }
    status = hs_parallel_agree(env->parallel, err);
    int64_t is_regular_all = is_root && is_regular;
    hs_parallel_max_int64(env->parallel, &is_regular_all, 1);
    self->is_regular = is_regular_all != 0;
    free_block(&ids);
    free_block(&values);
    hs_rows_end(&rows);
    return status;
}

hs_status hs_h5md_frames_write(hs_h5md_frames *self, hs_env *env, hs_observables *observables, hs_error *err)
{
    int64_t now[2] = {0, sum_of_ids(env->atoms, self->mask)};
    for (int i = 0; i < env->atoms->n_local; ++i) now[0] += (env->atoms->mask[i] & self->mask) != 0;
    hs_parallel_sum_int64(env->parallel, now, 2);
    self->is_regular = self->is_regular && now[0] == self->n_atoms && now[1] == self->id_sum;
    self->n_atoms = now[0];
    self->id_sum = now[1];
    if (!self->is_regular) HS_TRY(find_rows(self, env, err));
    return write_frame(self, env, observables, err);
}
