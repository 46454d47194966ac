#include "neighbor/cluster_search.h"

#include <math.h>

#if defined(HS_SIMD_AVX512) || defined(HS_SIMD_AVX2)
#include <immintrin.h>
#elif defined(HS_SIMD_SSE2)
#include <emmintrin.h>
#endif

/** The i-cluster of a search, in coordinates relative to the grid. */
typedef struct probe {
    float lo[3], hi[3];
    float reach, reach2;
    float calm;    /**< clusters whose atoms have moved farther than that go to the other list */
    uint32_t rows; /**< mask of the rows that are atoms */
} probe;

/* Clusters one on the other that look for their neighbors together: columns, cells and runs are found once for all of them. */
enum { BATCH = 4 };

/* Pairs within one cluster: j > i only. */
static const uint32_t self_mask = 0x8ceu | 0xfu << HS_ENTRY_ROWS_SHIFT;

static inline float gap(float lo_i, float hi_i, float lo_j, float hi_j)
{
    const float below = lo_i - hi_j, above = lo_j - hi_i;
    const float larger = below > above ? below : above;
    return larger > 0.0f ? larger : 0.0f;
}

/* How many boxes are tested at once. Each instruction set gives
 *   near_lanes(part, p, c)              bits of the clusters c, c + 1, ... whose boxes are within reach (may read beyond
 *                                       the last cluster: boxes are padded)
 *   moved_lanes(part, p, c)             bits of those that have moved too far
 *   append(to, from, near, rows)        copies the entries whose bit is set, masks cut to `rows`; may write TEST_LANES
 *                                       entries; returns how many count */
#if defined(HS_SIMD_AVX512) || defined(HS_SIMD_AVX2)

enum { TEST_LANES = 8 };

static inline __m256 gap_vector(const hs_cluster_part *part, const probe *p, int a, int c)
{
    const __m256 below = _mm256_sub_ps(_mm256_set1_ps(p->lo[a]), _mm256_loadu_ps(part->box[a + 3] + c));
    const __m256 above = _mm256_sub_ps(_mm256_loadu_ps(part->box[a] + c), _mm256_set1_ps(p->hi[a]));
    return _mm256_max_ps(_mm256_max_ps(below, above), _mm256_setzero_ps());
}

static inline uint32_t near_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    const __m256 d0 = gap_vector(part, p, 0, c), d1 = gap_vector(part, p, 1, c), d2 = gap_vector(part, p, 2, c);
    const __m256 r2 = _mm256_fmadd_ps(d2, d2, _mm256_fmadd_ps(d1, d1, _mm256_mul_ps(d0, d0)));
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(r2, _mm256_set1_ps(p->reach2), _CMP_LE_OQ));
}

static inline uint32_t moved_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    const __m256 moved = _mm256_loadu_ps(part->moved + c);
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(moved, _mm256_set1_ps(p->calm), _CMP_GT_OQ));
}

#elif defined(HS_SIMD_SSE2)

enum { TEST_LANES = 4 };

static inline __m128 gap_vector(const hs_cluster_part *part, const probe *p, int a, int c)
{
    const __m128 below = _mm_sub_ps(_mm_set1_ps(p->lo[a]), _mm_loadu_ps(part->box[a + 3] + c));
    const __m128 above = _mm_sub_ps(_mm_loadu_ps(part->box[a] + c), _mm_set1_ps(p->hi[a]));
    return _mm_max_ps(_mm_max_ps(below, above), _mm_setzero_ps());
}

static inline uint32_t near_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    const __m128 d0 = gap_vector(part, p, 0, c), d1 = gap_vector(part, p, 1, c), d2 = gap_vector(part, p, 2, c);
    const __m128 r2 = _mm_add_ps(_mm_mul_ps(d2, d2), _mm_add_ps(_mm_mul_ps(d1, d1), _mm_mul_ps(d0, d0)));
    return (uint32_t)_mm_movemask_ps(_mm_cmple_ps(r2, _mm_set1_ps(p->reach2)));
}

static inline uint32_t moved_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmpgt_ps(_mm_loadu_ps(part->moved + c), _mm_set1_ps(p->calm)));
}

#else

enum { TEST_LANES = 1 };

static inline uint32_t near_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    const float d0 = gap(p->lo[0], p->hi[0], part->box[0][c], part->box[3][c]);
    const float d1 = gap(p->lo[1], p->hi[1], part->box[1][c], part->box[4][c]);
    const float d2 = gap(p->lo[2], p->hi[2], part->box[2][c], part->box[5][c]);
    return d0 * d0 + d1 * d1 + d2 * d2 <= p->reach2;
}

static inline uint32_t moved_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    return part->moved[c] > p->calm;
}

#endif

#if defined(HS_SIMD_AVX512)

static inline int append(hs_cluster_entry *to, const hs_cluster_entry *from, uint32_t near, uint32_t rows)
{
    /* compress in the register and store all of it: compressing into memory is slow on some processors */
    const __m512i all =
        _mm512_and_epi64(_mm512_loadu_si512(from), _mm512_set1_epi64((int64_t)((uint64_t)rows << 32 | 0xffffffffu)));
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64((__mmask8)near, all));
    return __builtin_popcount(near);
}

#else

static inline int append(hs_cluster_entry *to, const hs_cluster_entry *from, uint32_t near, uint32_t rows)
{
    int n = 0;
    for (; near != 0; near &= near - 1u) {
        const hs_cluster_entry entry = from[__builtin_ctz(near)];
        to[n++] = (hs_cluster_entry){entry.first, entry.mask & rows};
    }
    return n;
}

#endif

/** Where the entries of an i-cluster go, and how many there are. */
typedef struct found_entries {
    hs_cluster_entry *entry, *moved;
    int n, n_moved;
} found_entries;

/** Test the bounding boxes of clusters [begin, end) and append those within reach; there must be room. */
static inline __attribute__((always_inline)) void test_run(const hs_cluster_part *part, const probe *p, int begin,
                                                           int end, const bool by_motion, found_entries *found)
{
    for (int c = begin; c < end; c += TEST_LANES) {
        const int n_lanes = end - c < TEST_LANES ? end - c : TEST_LANES;
        const uint32_t near = near_lanes(part, p, c) & ((1u << n_lanes) - 1u);
        const uint32_t moved = by_motion ? near & moved_lanes(part, p, c) : 0;
        found->n += append(found->entry + found->n, part->entry + c, near & ~moved, p->rows);
        if (by_motion) found->n_moved += append(found->moved + found->n_moved, part->entry + c, moved, p->rows);
    }
}

static inline float clamped(float a, float last)
{
    const float positive = a > 0.0f ? a : 0.0f;
    return positive < last ? positive : last;
}

/** Cells of every listed column that the probe can reach; cell_hi < cell_lo where the column is too far. A plain loop that
 *  compilers turn into vector code. */
static void reach_cells(const hs_cells *cells, const probe *p, hs_column_list *list)
{
    const float inv = (float)cells->inv_pitch[2], last = (float)(cells->n[2] - 1);
    const float *lo0 = list->bound[0], *hi0 = list->bound[1], *lo1 = list->bound[2], *hi1 = list->bound[3];
    int32_t *restrict cell_lo = list->cell_lo, *restrict cell_hi = list->cell_hi;
    const int n = list->n; /* read once: compilers must know that the stores leave it alone */
    for (int k = 0; k < n; ++k) {
        const float d0 = gap(p->lo[0], p->hi[0], lo0[k], hi0[k]), d1 = gap(p->lo[1], p->hi[1], lo1[k], hi1[k]);
        const float rest2 = p->reach2 - d0 * d0 - d1 * d1;
        const float dz = sqrtf(fabsf(rest2));
        /* a thousandth of a cell more on each side than the float arithmetic says, against its rounding */
        const float first = (p->lo[2] - dz) * inv - 1e-3f, final = (p->hi[2] + dz) * inv + 1e-3f;
        cell_lo[k] = (int32_t)clamped(first, last);
        const int32_t hi = (int32_t)clamped(final, last);
        cell_hi[k] = rest2 < 0.0f ? -1 : hi;
    }
}

/** The clusters that the probe may reach: runs of all listed columns. */
static void find_runs(hs_search *search, const hs_cluster_part *part, const int32_t *start, hs_column_list *list,
                      const probe *p)
{
    const int n2 = search->cells->n[2];
    int n = 0;
    reach_cells(search->cells, p, list);
    for (int k = 0; k < list->n; ++k) {
        if (list->cell_hi[k] < list->cell_lo[k]) continue;
        const int column = list->column[k];
        const int32_t *cell = start + (int64_t)column * n2;
        const int first_atom = cell[0], a_begin = cell[list->cell_lo[k]], a_end = cell[list->cell_hi[k] + 1];
        if (a_begin == a_end) continue;
        const int first = part->column_begin[column], begin = first + (a_begin - first_atom) / HS_CLUSTER,
                  end = first + (a_end - first_atom + HS_CLUSTER - 1) / HS_CLUSTER;
        list->run[n++] = (hs_run){begin, end};
        search->n_reached += end - begin;
    }
    list->n_runs = n;
}

/** Whether halo atoms can be near: they all lie about an upper face of the brick, or beyond it. */
static bool is_near_halo(const hs_cells *cells, const probe *p)
{
    for (int a = 0; a < 3; ++a)
        if (p->hi[a] + p->reach >= (float)cells->brick_hi[a]) return true;
    return false;
}

/** Runs for clusters [begin, end) of the column at hand. */
static void begin_batch(hs_search *search, int begin, int end)
{
    const hs_cells *cells = search->cells;
    const hs_clusters *clusters = search->clusters;
    const hs_cluster_part *local = &clusters->local;
    probe all = {.reach = search->reach, .reach2 = search->reach * search->reach};
    for (int a = 0; a < 3; ++a) {
        all.lo[a] = local->box[a][begin];
        all.hi[a] = local->box[a + 3][begin];
        for (int c = begin + 1; c < end; ++c) {
            all.lo[a] = local->box[a][c] < all.lo[a] ? local->box[a][c] : all.lo[a];
            all.hi[a] = local->box[a + 3][c] > all.hi[a] ? local->box[a + 3][c] : all.hi[a];
        }
    }
    search->batch_begin = begin;
    search->batch_end = end;
    search->n_reached = search->halo.n_runs = 0;
    find_runs(search, local, cells->start_local, &search->local, &all);
    if (search->halo.n > 0 && is_near_halo(cells, &all))
        find_runs(search, &clusters->halo, cells->start_halo, &search->halo, &all);
}

/** Test all clusters of the batch's runs. */
static inline __attribute__((always_inline)) found_entries test_runs(const hs_search *search, const probe *p, int ci,
                                                                     found_entries found, const bool by_motion)
{
    const hs_cluster_part *local = &search->clusters->local, *halo = &search->clusters->halo;
    const hs_run *run = search->local.run;
    /* its own column from the next cluster on, for each pair of clusters is found once */
    test_run(local, p, ci + 1, run[0].end, by_motion, &found);
    for (int k = 1; k < search->local.n_runs; ++k) test_run(local, p, run[k].begin, run[k].end, by_motion, &found);
    run = search->halo.run;
    for (int k = 0; k < search->halo.n_runs; ++k) test_run(halo, p, run[k].begin, run[k].end, by_motion, &found);
    return found;
}

static hs_status find(hs_search *search, int ci, int column, hs_entry_list *entries, hs_error *err)
{
    const hs_cluster_part *local = &search->clusters->local;
    const bool by_motion = search->skin < INFINITY;
    const float own_motion = by_motion ? local->moved[ci] : 0.0f;
    if (column != search->column) HS_TRY(hs_cluster_search_column(search, column, err));
    if (ci < search->batch_begin || ci >= search->batch_end) {
        const int last = local->column_begin[column + 1];
        begin_batch(search, ci, ci + BATCH < last ? ci + BATCH : last);
    }
    probe p = {.reach = search->reach,
               .reach2 = search->reach * search->reach,
               .calm = search->skin - own_motion,
               .rows = hs_cluster_rows(local->size[ci])};
    for (int a = 0; a < 3; ++a) {
        p.lo[a] = local->box[a][ci];
        p.hi[a] = local->box[a + 3][ci];
    }
    search->moved.n = 0;
    HS_TRY(hs_entry_list_reserve(entries, 1 + search->n_reached + TEST_LANES, err));
    if (by_motion) HS_TRY(hs_entry_list_reserve(&search->moved, 1 + search->n_reached + TEST_LANES, err));
    found_entries found = {entries->entry, search->moved.entry, entries->n, 0};
    if (local->size[ci] > 1) {
        const uint32_t mask = self_mask & p.rows & hs_cluster_lanes(local->size[ci]);
        hs_cluster_entry *self = own_motion > p.calm ? &found.moved[found.n_moved++] : &found.entry[found.n++];
        *self = (hs_cluster_entry){local->entry[ci].first, mask};
    }
    found = by_motion ? test_runs(search, &p, ci, found, true) : test_runs(search, &p, ci, found, false);
    entries->n = found.n;
    search->moved.n = found.n_moved;
    return HS_OK;
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_cluster_find PASTE(hs_cluster_find_, HS_KERNEL_ISA) = find;
