/* One double: any machine with a C compiler. Four "vectors" cover one cluster. */
typedef double hs_real;
typedef double hs_vec;
typedef bool hs_msk;
#define HS_LANES 1

static inline hs_vec hs_set1(double a) { return a; }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return a * b + c; }
static inline hs_vec hs_sqrt(hs_vec a) { return sqrt(a); }
static inline hs_real hs_local(double x, double origin)
{
    (void)origin;
    return x;
}
typedef uint32_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub) { return entry->mask >> sub; }
static inline hs_msk hs_masks_row(hs_masks masks, int row) { return (masks >> 4 * row & 1u) != 0; }
static inline uint32_t hs_mask_to_bits(hs_msk m) { return m; }
static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return m && n; }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return a < b; }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return m ? a : 0.0; }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b) { return m ? a : b; }
static inline hs_vec hs_max_abs(hs_vec a, hs_vec b) { return fabs(b) > a ? fabs(b) : a; }
static inline double hs_sum(hs_vec a) { return a; }

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)origin;
    return x[entry->first + sub];
}

static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    f[entry->first + sub] += a;
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    return table[stride * type[entry->first + sub]];
}
