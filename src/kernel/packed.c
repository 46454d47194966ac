#include "kernel/packed.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/wide.h"
#include "parallel/parallel.h"

void hs_packed_fini(hs_packed *packed)
{
    HS_FREE(packed->site);
    HS_FREE(packed->site_listed);
    HS_FREE(packed->radius);
    HS_FREE(packed->place_of);
    memset(packed, 0, sizeof *packed);
}

/** Longest edge of the bounding boxes of a part's clusters. */
static double longest_edge(const hs_cluster_part *part)
{
    float longest = 0.0f;
    for (int a = 0; a < 3; ++a) {
        const float *lo = part->box[a], *hi = part->box[a + 3];
#pragma omp parallel for simd schedule(static) reduction(max : longest)
        for (int c = 0; c < part->n; ++c) longest = hi[c] - lo[c] > longest ? hi[c] - lo[c] : longest;
    }
    return longest;
}

/** Whole numbers wrap around, and only differences count: 2^32 units are four times as long as atoms of two clusters that
 *  are neighbors can be apart, which leaves as much for atoms to move until they are packed anew. */
static void choose_unit(hs_packed *packed, const hs_clusters *clusters, const hs_atoms *atoms, double reach)
{
    const double edge = fmax(longest_edge(&clusters->local), longest_edge(&clusters->halo));
    int exponent;
    (void)frexp(2.0 * edge + reach, &exponent); /* smaller than 2^exponent */
    packed->unit = ldexp(1.0, exponent + 2 - 32);
    for (int axis = 0; axis < 3; ++axis) packed->origin[axis] = atoms->n_local > 0 ? atoms->x[axis][0] : 0.0;
}

hs_status hs_packed_begin(hs_packed *packed, const hs_clusters *clusters, const hs_atoms *atoms, double reach,
                          hs_error *err)
{
    const int64_t n = (int64_t)clusters->local.n + clusters->halo.n;
    const int64_t n_atoms = (int64_t)atoms->n_local + atoms->n_halo;
    if (n > INT32_MAX / HS_PACKED - HS_PACKED)
        return hs_fail(err, HS_ERROR_RUN, "too many atoms on one rank for mixed precision: use more ranks");
    if (n > packed->capacity) {
        const int64_t capacity = n + n / 32 + 16;
        HS_TRY(HS_GROW(packed->site, 0, (size_t)capacity * HS_PACKED, err));
        packed->capacity = capacity;
    }
    if (n_atoms > packed->capacity_atoms) {
        const int64_t capacity = n_atoms + n_atoms / 32 + 16;
        HS_TRY(HS_GROW(packed->place_of, 0, (size_t)capacity, err));
        packed->capacity_atoms = capacity;
    }
    packed->n = (int)n;
    choose_unit(packed, clusters, atoms, reach);
#pragma omp parallel for schedule(static)
    for (int c = 0; c < packed->n; ++c) packed->place_of[hs_packed_atom(clusters, c * HS_PACKED)] = c * HS_PACKED;
    return HS_OK;
}

typedef double four_doubles __attribute__((vector_size(4 * sizeof(double))));
typedef uint64_t four_patterns __attribute__((vector_size(4 * sizeof(uint64_t))));
typedef float four_floats __attribute__((vector_size(4 * sizeof(float))));
typedef uint32_t four_numbers __attribute__((vector_size(4 * sizeof(uint32_t))));

/** Clusters [begin, end). Positions become multiples of the unit, modulo 2^32: adding magic = 1.5 * 2^52 units leaves the multiple in
 *  the low bits of the double's pattern. Beyond the last atom of a short cluster it is the next atom's, which masks hide. */
HS_WIDE static void pack_clusters(const hs_packed *packed, const hs_clusters *clusters, const double *const x[3],
                                  int32_t *site, int begin, int end)
{
    const double magic = 1.5 * 0x1p52 * packed->unit;
    for (int c = begin; c < end; ++c) {
        const int first = hs_packed_atom(clusters, c * HS_PACKED);
        int32_t *to = site + (size_t)c * HS_PACKED;
        for (int axis = 0; axis < 3; ++axis) {
            four_doubles place;
            memcpy(&place, x[axis] + first, sizeof place);
            place = (place - packed->origin[axis]) + magic;
            const four_numbers low = __builtin_convertvector((four_patterns)place, four_numbers);
            memcpy(to + HS_CLUSTER * axis, &low, sizeof low);
        }
        memcpy(to + HS_PACKED_TYPES, packed->type + first, HS_CLUSTER * sizeof *to);
    }
}

static void pack_positions(const hs_packed *packed, const hs_clusters *clusters, const double *const x[3],
                           int32_t *site, int begin, int end)
{
#pragma omp parallel
    {
        int64_t from, to;
        hs_thread_range(end - begin, 1, hs_thread_number(), hs_thread_count(), &from, &to);
        pack_clusters(packed, clusters, x, site, begin + (int)from, begin + (int)to);
    }
}

static void pack_radii(const hs_packed *packed, const hs_clusters *clusters, int begin, int end)
{
#pragma omp parallel for schedule(static)
    for (int c = begin; c < end; ++c)
        memcpy(packed->radius + (size_t)c * HS_PACKED, packed->source_radius + hs_packed_atom(clusters, c * HS_PACKED),
               HS_CLUSTER * sizeof *packed->radius);
}

hs_status hs_packed_use(hs_packed *packed, hs_kernel_input *in, hs_error *err)
{
    if (in->listed_only && packed->capacity > packed->capacity_listed) {
        HS_TRY(HS_GROW(packed->site_listed, 0, (size_t)packed->capacity * HS_PACKED, err));
        packed->capacity_listed = packed->capacity;
    }
    if (in->radius != NULL && packed->capacity > packed->capacity_radius) {
        HS_TRY(HS_GROW(packed->radius, 0, (size_t)packed->capacity * HS_PACKED, err));
        packed->capacity_radius = packed->capacity;
    }
    packed->type = in->type;
    packed->source_radius = in->radius;
    if (in->radius != NULL) in->radius = packed->radius;
    in->site = packed->site;
    in->site_listed = packed->site_listed;
    in->type = packed->site + HS_PACKED_TYPES;
    in->unit = packed->unit;
    return HS_OK;
}

void hs_packed_fill(hs_packed *packed, const hs_clusters *clusters, const hs_kernel_input *in, int begin, int end)
{
    pack_positions(packed, clusters, in->x, packed->site, begin, end);
    if (in->listed_only) pack_positions(packed, clusters, in->x_listed, packed->site_listed, begin, end);
    if (packed->source_radius != NULL) pack_radii(packed, clusters, begin, end);
}

void hs_packed_rename(const hs_packed *packed, hs_cluster_entry *entry, int n)
{
    for (int e = 0; e < n; ++e) entry[e].first = packed->place_of[entry[e].first];
}

/** Clusters [begin, end) of one part, whose packed forces begin at number `at` of each array. */
HS_WIDE static void unpack_clusters(const hs_cluster_part *of, int begin, int end, size_t at, const float *const *part,
                                    int n_parts, double *const f[3], bool is_added)
{
    for (int c = begin; c < end; ++c, at += HS_PACKED) {
        const int first = of->entry[c].first, size = of->size[c];
        for (int axis = 0; axis < 3; ++axis) {
            four_floats sum = {0}, one;
            for (int p = 0; p < n_parts; ++p) {
                memcpy(&one, part[p] + at + HS_CLUSTER * axis, sizeof one);
                sum += one;
            }
            const four_doubles wide = __builtin_convertvector(sum, four_doubles);
            double *to = f[axis] + first;
            if (size == HS_CLUSTER && !is_added)
                memcpy(to, &wide, sizeof wide);
            else
                for (int k = 0; k < size; ++k) to[k] = (is_added ? to[k] : 0.0) + wide[k];
        }
    }
}

void hs_packed_unpack(const hs_packed *packed, const hs_clusters *clusters, int64_t block, const float *const *part,
                      int n_parts, hs_atoms *atoms, bool is_added)
{
    const int per_block = HS_PACKED_BLOCK / HS_PACKED, n_local = clusters->local.n, begin = (int)block * per_block;
    const int end = begin + per_block < packed->n ? begin + per_block : packed->n;
    const int middle = n_local < begin ? begin : n_local < end ? n_local : end; /* local ones come first */
    unpack_clusters(&clusters->local, begin, middle, (size_t)begin * HS_PACKED, part, n_parts, atoms->f, is_added);
    unpack_clusters(&clusters->halo, middle - n_local, end - n_local, (size_t)middle * HS_PACKED, part, n_parts,
                    atoms->f, is_added);
}
