#include "core/atoms.h"

#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "parallel/parallel.h"

/** Elements of every array, also of those that have no halo part, so that the sort can let them change places
 *  with the force arrays. What is never written never becomes resident, so the unused part costs no memory. */
static size_t room(int capacity_local, int capacity_halo)
{
    return (size_t)capacity_local + (size_t)capacity_halo + HS_ATOMS_PAD;
}

static hs_status add_field(hs_atoms *atoms, const char *name, void **array, size_t size, bool has_halo, bool is_force,
                           hs_error *err)
{
    HS_TRY(HS_EXTEND(atoms->field, atoms->n_fields, atoms->capacity_fields, err));
    HS_TRY(hs_memory_alloc(array, room(atoms->capacity_local, atoms->capacity_halo), size, err));
    atoms->field[atoms->n_fields++] = (hs_atom_field){.name = name,
                                                      .array = array,
                                                      .size = size,
                                                      .has_halo = has_halo,
                                                      .is_force = is_force,
                                                      .goes_to_halo = has_halo && !is_force};
    return HS_OK;
}

hs_status hs_atoms_init(hs_atoms *atoms, hs_error *err)
{
    static const char *const x_name[3] = {"x", "y", "z"}, *const v_name[3] = {"vx", "vy", "vz"},
                             *const f_name[3] = {"fx", "fy", "fz"}, *const image_name[3] = {"ix", "iy", "iz"};
    memset(atoms, 0, sizeof *atoms);
    atoms->generation = 1;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(add_field(atoms, x_name[axis], (void **)&atoms->x[axis], sizeof(double), true, false, err));
        hs_atoms_keep_from_halo(atoms, (void **)&atoms->x[axis]);
        HS_TRY(add_field(atoms, v_name[axis], (void **)&atoms->v[axis], sizeof(double), false, false, err));
        HS_TRY(add_field(atoms, f_name[axis], (void **)&atoms->f[axis], sizeof(double), true, true, err));
        HS_TRY(add_field(atoms, image_name[axis], (void **)&atoms->image[axis], sizeof(int32_t), false, false, err));
    }
    HS_TRY(add_field(atoms, "id", (void **)&atoms->id, sizeof(int64_t), false, false, err));
    HS_TRY(add_field(atoms, "type", (void **)&atoms->type, sizeof(int32_t), true, false, err));
    return add_field(atoms, "mask", (void **)&atoms->mask, sizeof(uint32_t), false, false, err);
}

void hs_atoms_fini(hs_atoms *atoms)
{
    for (int k = 0; k < atoms->n_fields; ++k) HS_FREE(*atoms->field[k].array);
    HS_FREE(atoms->field);
    HS_FREE(atoms->mass);
    memset(atoms, 0, sizeof *atoms);
}

hs_status hs_atoms_set_types(hs_atoms *atoms, int n_types, hs_error *err)
{
    HS_TRY(HS_GROW(atoms->mass, 0, (size_t)n_types + 1, err));
    atoms->n_types = n_types;
    return HS_OK;
}

/** Move every array into room for the given capacities; local and halo atoms stay where their indices say. */
static hs_status resize(hs_atoms *atoms, int capacity_local, int capacity_halo, hs_error *err)
{
    size_t n_used = (size_t)atoms->n_local + (size_t)atoms->n_halo;
    for (int k = 0; k < atoms->n_fields; ++k) {
        hs_atom_field *field = &atoms->field[k];
        size_t n_keep = field->has_halo ? n_used : (size_t)atoms->n_local;
        HS_TRY(hs_memory_grow(field->array, n_keep, room(capacity_local, capacity_halo), field->size, err));
    }
    atoms->capacity_local = capacity_local;
    atoms->capacity_halo = capacity_halo;
    return HS_OK;
}

hs_status hs_atoms_check_room(const hs_atoms *atoms, int64_t n_local, int64_t n_halo, hs_error *err)
{
    const double gibibyte = 1024.0 * 1024.0 * 1024.0, memory_bytes = (double)hs_memory_physical();
    const int64_t limit = INT32_C(1) << 30;
    if (n_local > limit || n_halo > limit)
        return hs_fail(err, HS_ERROR_RUN, "%lld atoms on one rank are more than the %lld it can hold; use more ranks",
                       (long long)(n_local > n_halo ? n_local : n_halo), (long long)limit);
    double bytes = 0.0;
    for (int k = 0; k < atoms->n_fields; ++k)
        bytes += (double)atoms->field[k].size * (double)(n_local + (atoms->field[k].has_halo ? n_halo : 0));
    /* Systems promise more memory than they have, and end the process (or another one) when it is used. */
    if (memory_bytes > 0.0 && bytes > memory_bytes)
        return hs_fail(err, HS_ERROR_MEMORY, "%lld atoms need %.1f GiB of memory at least; this machine has %.1f GiB",
                       (long long)n_local, bytes / gibibyte, memory_bytes / gibibyte);
    return HS_OK;
}

hs_status hs_atoms_reserve(hs_atoms *atoms, int64_t n_local, int64_t n_halo, hs_error *err)
{
    if (n_local <= atoms->capacity_local && n_halo <= atoms->capacity_halo) return HS_OK;
    HS_TRY(hs_atoms_check_room(atoms, n_local, n_halo, err));
    if (n_local <= atoms->capacity_local) {
        /* the arrays move anyway: what growth by halves has left over is given back */
        const int64_t kept = (int64_t)atoms->n_local + atoms->n_local / 64 + 64;
        if (n_local < kept) n_local = kept < atoms->capacity_local ? kept : atoms->capacity_local;
    }
    if (n_halo < atoms->capacity_halo) n_halo = atoms->capacity_halo;
    return resize(atoms, (int)n_local, (int)n_halo, err);
}

hs_status hs_atoms_add(hs_atoms *atoms, int64_t id, int type, const double x[3], hs_error *err)
{
    if (atoms->n_local == atoms->capacity_local)
        HS_TRY(hs_atoms_reserve(atoms, (int64_t)atoms->capacity_local * 3 / 2 + 64, 0, err));
    const int i = atoms->n_local;
    for (int k = 0; k < atoms->n_fields; ++k)
        memset((char *)*atoms->field[k].array + (size_t)i * atoms->field[k].size, 0, atoms->field[k].size);
    for (int axis = 0; axis < 3; ++axis) atoms->x[axis][i] = x[axis];
    for (int k = 0; k < atoms->n_fields; ++k)
        if (atoms->field[k].place_along > 0) ((double *)*atoms->field[k].array)[i] = x[atoms->field[k].place_along - 1];
    atoms->id[i] = id;
    atoms->type[i] = type;
    atoms->mask[i] = 1;
    if (atoms->radius != NULL) {
        atoms->radius[i] = 0.5; /* as in LAMMPS: diameter 1, density 1 */
        atoms->rmass[i] = hs_ball_volume(0.5);
    }
    atoms->n_local = i + 1;
    atoms->n_halo = 0;
    ++atoms->generation;
    return HS_OK;
}

void hs_atoms_remove(hs_atoms *atoms, const unsigned char *drop)
{
    for (int k = 0; k < atoms->n_fields; ++k) {
        char *array = *atoms->field[k].array;
        const size_t size = atoms->field[k].size;
        int n_kept = 0;
        for (int i = 0; i < atoms->n_local; ++i)
            if (!drop[i]) memmove(array + size * (size_t)n_kept++, array + size * (size_t)i, size);
    }
    int n_kept = 0;
    for (int i = 0; i < atoms->n_local; ++i) n_kept += !drop[i];
    atoms->n_local = n_kept;
    atoms->n_halo = 0;
    ++atoms->generation;
}

/** Gather this thread's share of one field into `to`. */
static void gather(void *to, const void *from, const int32_t *order, int64_t begin, int64_t end, size_t size)
{
    if (size == 8) {
        uint64_t *restrict out = to;
        const uint64_t *restrict in = from;
        for (int64_t k = begin; k < end; ++k) out[k] = in[order[k]];
    } else if (size == 4) {
        uint32_t *restrict out = to;
        const uint32_t *restrict in = from;
        for (int64_t k = begin; k < end; ++k) out[k] = in[order[k]];
    } else {
        for (int64_t k = begin; k < end; ++k)
            memcpy((char *)to + size * (size_t)k, (const char *)from + size * (size_t)order[k], size);
    }
}

/** Force arrays that a permutation may overwrite; hs_atoms_sort_scratch has the third. */
enum { N_SPARE = 2 };

/** Fields of 8 bytes an atom, two at a time, into force arrays, whose contents are not needed: the sorted
 *  arrays become the fields, and the old ones serve as the force arrays of the next two. Nothing is copied back and
 *  no memory is needed. All threads of a region call this together. */
static void permute_by_rotation(hs_atoms *atoms, const int32_t *order, int64_t begin, int64_t end)
{
    void **batch[N_SPARE];
    int n_batch = 0;
    for (int k = 0; k <= atoms->n_fields; ++k) {
        hs_atom_field *field = k < atoms->n_fields ? &atoms->field[k] : NULL;
        if (field != NULL && field->size == 8 && !field->is_force) batch[n_batch++] = field->array;
        if (n_batch < N_SPARE && field != NULL) continue;
        for (int b = 0; b < n_batch; ++b) gather(atoms->f[b], *batch[b], order, begin, end, 8);
#pragma omp barrier
#pragma omp single
        for (int b = 0; b < n_batch; ++b) {
            void *sorted = atoms->f[b];
            atoms->f[b] = *batch[b];
            *batch[b] = sorted;
        }
        n_batch = 0;
    }
}

/** Fields of 4 bytes an atom, four at a time, through the memory of the force arrays and back. */
static void permute_by_copy(hs_atoms *atoms, const int32_t *order, int64_t begin, int64_t end)
{
    int first = 0;
    while (first < atoms->n_fields) {
        uint32_t *scratch[2 * N_SPARE];
        void *array[2 * N_SPARE];
        int n = 0;
        for (; first < atoms->n_fields && n < 2 * N_SPARE; ++first) {
            if (atoms->field[first].size != 4) continue;
            scratch[n] = (uint32_t *)(void *)atoms->f[n / 2] + (n % 2 ? atoms->n_local : 0);
            array[n++] = *atoms->field[first].array;
        }
        for (int b = 0; b < n; ++b) gather(scratch[b], array[b], order, begin, end, 4);
#pragma omp barrier
        for (int b = 0; b < n; ++b) memcpy((uint32_t *)array[b] + begin, scratch[b] + begin, (size_t)(end - begin) * 4);
#pragma omp barrier
    }
}

/** Wider fields (of styles) are rare and pay for a copy. */
static hs_status permute_wide(hs_atoms *atoms, const hs_atom_field *field, const int32_t *order, hs_error *err)
{
    const size_t bytes = (size_t)atoms->n_local * field->size;
    char *sorted;
    HS_TRY(HS_ALLOC(sorted, bytes, err));
    gather(sorted, *field->array, order, 0, atoms->n_local, field->size);
    memcpy(*field->array, sorted, bytes);
    HS_FREE(sorted);
    return HS_OK;
}

static void permute_share(hs_atoms *atoms, const int32_t *order)
{
    int64_t begin, end;
    hs_thread_range(atoms->n_local, 16, hs_thread_number(), hs_thread_count(), &begin, &end);
    permute_by_rotation(atoms, order, begin, end);
    permute_by_copy(atoms, order, begin, end);
}

hs_sort_scratch hs_atoms_sort_scratch(const hs_atoms *atoms, int n)
{
    int32_t *memory = (int32_t *)(void *)atoms->f[2];
    return (hs_sort_scratch){.order = memory, .key = memory + n};
}

hs_status hs_atoms_permute(hs_atoms *atoms, const int32_t *order, hs_error *err)
{
    for (int k = 0; k < atoms->n_fields; ++k)
        if (atoms->field[k].size != 4 && atoms->field[k].size != 8)
            HS_TRY(permute_wide(atoms, &atoms->field[k], order, err));
    HS_ON_THREADS(permute_share(atoms, order));
    atoms->n_halo = 0;
    ++atoms->generation;
    return HS_OK;
}

hs_status hs_atoms_add_field(hs_atoms *atoms, const char *name, void **array, size_t size, bool has_halo, hs_error *err)
{
    return add_field(atoms, name, array, size, has_halo, false, err);
}

void hs_atoms_keep_from_halo(hs_atoms *atoms, void **array)
{
    for (int k = 0; k < atoms->n_fields; ++k)
        if (atoms->field[k].array == array) atoms->field[k].goes_to_halo = false;
}

void hs_atoms_mark_place(hs_atoms *atoms, void **array, int axis)
{
    for (int k = 0; k < atoms->n_fields; ++k)
        if (atoms->field[k].array == array) atoms->field[k].place_along = 1 + axis;
}

size_t hs_atoms_record_size(const hs_atoms *atoms)
{
    size_t size = 0;
    for (int k = 0; k < atoms->n_fields; ++k)
        if (!atoms->field[k].is_force) size += atoms->field[k].size;
    return (size + 7) / 8 * 8;
}

void hs_atoms_pack(const hs_atoms *atoms, int i, char *record)
{
    for (int k = 0; k < atoms->n_fields; ++k) {
        const hs_atom_field *field = &atoms->field[k];
        if (field->is_force) continue;
        memcpy(record, (const char *)*field->array + field->size * (size_t)i, field->size);
        record += field->size;
    }
}

void hs_atoms_unpack(hs_atoms *atoms, const char *record)
{
    for (int k = 0; k < atoms->n_fields; ++k) {
        const hs_atom_field *field = &atoms->field[k];
        if (field->is_force) continue;
        memcpy((char *)*field->array + field->size * (size_t)atoms->n_local, record, field->size);
        record += field->size;
    }
    ++atoms->n_local;
    atoms->n_halo = 0;
    ++atoms->generation;
}

void hs_atoms_take_out(hs_atoms *atoms, const int32_t *leavers, int n)
{
    int last = atoms->n_local, final = n - 1;
    for (int k = 0; k < n && leavers[k] < last; ++k) {
        /* the last atom that stays goes to this place */
        for (--last; final > k && leavers[final] == last; --final) --last;
        if (last == leavers[k]) break;
        for (int f = 0; f < atoms->n_fields; ++f) {
            char *array = *atoms->field[f].array;
            const size_t size = atoms->field[f].size;
            memcpy(array + size * (size_t)leavers[k], array + size * (size_t)last, size);
        }
    }
    atoms->n_local -= n;
    atoms->n_halo = 0;
    ++atoms->generation;
}

void hs_atoms_remove_field(hs_atoms *atoms, void **array)
{
    for (int k = 0; k < atoms->n_fields; ++k) {
        if (atoms->field[k].array != array) continue;
        HS_FREE(*array);
        memmove(&atoms->field[k], &atoms->field[k + 1], sizeof atoms->field[0] * (size_t)(atoms->n_fields - k - 1));
        --atoms->n_fields;
        return;
    }
}

int64_t hs_atoms_max_id(const hs_atoms *atoms)
{
    int64_t max = 0;
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->id[i] > max) max = atoms->id[i];
    return max;
}
