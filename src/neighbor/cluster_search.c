#include "neighbor/cluster_search.h"

#include <float.h>
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
    uint32_t rows;   /**< mask of the rows that are atoms */
} probe;

/* Pairs within one cluster: j > i only. */
static const uint32_t self_mask = 0x8ceu;

static probe make_probe(const hs_clusters *clusters, const hs_cells *cells, int ci, double reach)
{
    const hs_cluster_part *local = &clusters->local;
    probe p;
    float extent = 0.0f;
    for (int a = 0; a < 3; ++a) {
        p.lo[a] = local->box[a][ci];
        p.hi[a] = local->box[a + 3][ci];
        const float length = (float)(cells->pitch[a] * cells->n[a]);
        extent = length > extent ? length : extent;
    }
    /* Boxes are rounded to float: a margin of several units in the last place of the largest coordinate keeps the
       search from missing a pair. */
    p.reach = (float)reach + 8.0f * FLT_EPSILON * (extent + (float)reach);
    p.reach2 = p.reach * p.reach;
    p.rows = hs_cluster_rows(local->size[ci]);
    return p;
}

static inline float gap(float lo_i, float hi_i, float lo_j, float hi_j)
{
    const float below = lo_i - hi_j, above = lo_j - hi_i;
    const float larger = below > above ? below : above;
    return larger > 0.0f ? larger : 0.0f;
}

/* How many boxes are tested at once. Each instruction set gives
 *   near_lanes(part, p, c)              bits of the clusters c, c + 1, ... whose boxes are within reach (may read beyond
 *                                       the last cluster: boxes are padded)
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

#else

enum { TEST_LANES = 1 };

static inline uint32_t near_lanes(const hs_cluster_part *part, const probe *p, int c)
{
    const float d0 = gap(p->lo[0], p->hi[0], part->box[0][c], part->box[3][c]);
    const float d1 = gap(p->lo[1], p->hi[1], part->box[1][c], part->box[4][c]);
    const float d2 = gap(p->lo[2], p->hi[2], part->box[2][c], part->box[5][c]);
    return d0 * d0 + d1 * d1 + d2 * d2 <= p->reach2;
}

#endif

#if defined(HS_SIMD_AVX512)

static inline int append(hs_cluster_entry *to, const hs_cluster_entry *from, uint32_t near, uint32_t rows)
{
    /* compress in the register and store all of it: compressing into memory is slow on some processors */
    const __m512i all = _mm512_and_epi64(_mm512_loadu_si512(from), _mm512_set1_epi64((int64_t)((uint64_t)rows << 32 | 0xffffffffu)));
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

/** Test the bounding boxes of clusters [begin, end) and append those within reach. */
static void test_run(const hs_cluster_part *part, const probe *p, int begin, int end, hs_entry_list *entries)
{
    hs_cluster_entry *entry = entries->entry;
    int n = entries->n;
    for (int c = begin; c < end; c += TEST_LANES) {
        uint32_t near = near_lanes(part, p, c);
        if (end - c < TEST_LANES) near &= (1u << (end - c)) - 1u;
        n += append(entry + n, part->entry + c, near, p->rows);
    }
    entries->n = n;
}

/** Clusters of one column whose atoms can be within dz of the probe along the run axis. */
static void cluster_range(const hs_cluster_part *part, const hs_cells *cells, const int32_t *start, int column,
                          const probe *p, float dz, int *begin, int *end)
{
    const float inv = (float)cells->inv_pitch[2];
    const float z_lo = (p->lo[2] - dz) * inv, z_hi = (p->hi[2] + dz) * inv;
    const int n2 = cells->n[2];
    /* one cell more on each side than the float arithmetic says, against its rounding */
    const int c_lo = z_lo <= 1.0f ? 0 : z_lo >= (float)n2 ? n2 - 1 : (int)z_lo - (z_lo - (float)(int)z_lo < 1e-3f);
    const int c_hi = z_hi <= 0.0f ? 0 : z_hi >= (float)(n2 - 1) ? n2 - 1 : (int)z_hi + (z_hi - (float)(int)z_hi > 0.999f);
    const int32_t *cell = start + (int64_t)column * n2;
    const int a_begin = cell[c_lo] - cell[0], a_end = cell[c_hi + 1] - cell[0];
    *begin = part->column_begin[column] + a_begin / HS_CLUSTER;
    *end = part->column_begin[column] + (a_end + HS_CLUSTER - 1) / HS_CLUSTER;
    if (a_begin >= a_end) *end = *begin;
}

static inline int clamp(int value, int last) { return value < 0 ? 0 : value > last ? last : value; }

/** Search one part in the columns around the probe. For the local part (own_column >= 0) only the upper half of them. */
static hs_status search(const hs_clusters *clusters, const hs_cells *cells, const hs_cluster_part *part, const int32_t *start,
                        const probe *p, int ci, int own_column, hs_entry_list *entries, hs_error *err)
{
    const bool is_local = own_column >= 0;
    const float pitch0 = (float)cells->pitch[0], pitch1 = (float)cells->pitch[1];
    const int n1 = cells->n[1];
    const int own0 = is_local ? clusters->column_at[own_column] / n1 : -1;
    const int own1 = is_local ? clusters->column_at[own_column] % n1 : -1;
    const int first0 = is_local ? own0 : clamp((int)floorf((p->lo[0] - p->reach) / pitch0), cells->n[0] - 1);
    const int last0 = clamp((int)floorf((p->hi[0] + p->reach) / pitch0), cells->n[0] - 1);
    const int first1 = clamp((int)floorf((p->lo[1] - p->reach) / pitch1), n1 - 1);
    const int last1 = clamp((int)floorf((p->hi[1] + p->reach) / pitch1), n1 - 1);
    for (int c0 = first0; c0 <= last0; ++c0) {
        const float d0 = gap(p->lo[0], p->hi[0], (float)c0 * pitch0, (float)(c0 + 1) * pitch0);
        for (int c1 = c0 == own0 ? own1 : first1; c1 <= last1; ++c1) {
            const float d1 = gap(p->lo[1], p->hi[1], (float)c1 * pitch1, (float)(c1 + 1) * pitch1);
            const float rest2 = p->reach2 - d0 * d0 - d1 * d1;
            if (rest2 <= 0.0f) continue;
            const int column = cells->column_rank[c0 * n1 + c1];
            int begin, end;
            cluster_range(part, cells, start, column, p, sqrtf(rest2), &begin, &end);
            if (column == own_column && begin <= ci) begin = ci + 1;
            if (begin >= end) continue;
            HS_TRY(hs_entry_list_reserve(entries, end - begin + TEST_LANES, err));
            test_run(part, p, begin, end, entries);
        }
    }
    return HS_OK;
}

/** Whether halo atoms can be near: they all lie beyond an upper face of the box. */
static bool is_near_halo(const hs_cells *cells, const probe *p)
{
    for (int a = 0; a < 3; ++a)
        if (p->hi[a] + p->reach >= (float)cells->box_hi[a]) return true;
    return false;
}

static hs_status find(const hs_clusters *clusters, const hs_cells *cells, int ci, int column, double reach,
                           hs_entry_list *entries, hs_error *err)
{
    const probe p = make_probe(clusters, cells, ci, reach);
    const int size = clusters->local.size[ci];
    HS_TRY(hs_entry_list_reserve(entries, 1, err));
    if (size > 1)
        entries->entry[entries->n++] =
            (hs_cluster_entry){clusters->local.entry[ci].first, self_mask & p.rows & hs_cluster_lanes(size)};
    HS_TRY(search(clusters, cells, &clusters->local, cells->start_local, &p, ci, column, entries, err));
    if (clusters->halo.n == 0 || !is_near_halo(cells, &p)) return HS_OK;
    return search(clusters, cells, &clusters->halo, cells->start_halo, &p, ci, -1, entries, err);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
const hs_cluster_search PASTE(hs_cluster_search_, HS_KERNEL_ISA) = find;
