/** How the cluster loop reads positions and adds forces: in double from and to the atoms' arrays; in mixed precision from and
 *  to packed clusters (kernel/packed.h), whose positions are whole multiples of a small unit of length. Differences of
 *  whole numbers are exact, so that large boxes lose no digits; they become floats, in that unit, only then.
 *
 *  Included by kernel/cluster_loop.h after kernel/accumulate.h. */

#ifdef HS_MIXED

/** One coordinate of the j-atoms of a vector, and of one atom. */
typedef int32_t hs_place;
#if HS_LANES == 1
typedef int32_t hs_places;
#else
typedef int32_t hs_places __attribute__((vector_size(4 * HS_LANES)));
#endif

HS_INLINE hs_places hs_load_places(const int32_t *numbers, const hs_cluster_entry *entry, int sub)
{
    hs_places a;
#if HS_LANES == 8
    (void)sub;
    typedef int32_t four __attribute__((vector_size(16)));
    four low, high;
    memcpy(&low, numbers + entry[0].first, sizeof low);
    memcpy(&high, numbers + entry[1].first, sizeof high);
    a = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    memcpy(&a, numbers + entry->first + HS_LANES * sub, sizeof a);
#endif
    return a;
}

/** x_j - x_i in the unit of length; the subtraction wraps around. */
HS_INLINE hs_vec hs_apart(hs_places x_j, hs_place x_i)
{
#if HS_LANES == 1
    return (hs_vec)(int32_t)((uint32_t)x_j - (uint32_t)x_i);
#else
    typedef hs_real reals __attribute__((vector_size(4 * HS_LANES)));
    typedef uint32_t wrapping __attribute__((vector_size(4 * HS_LANES)));
    return (hs_vec) __builtin_convertvector((hs_places)((wrapping)x_j - (uint32_t)x_i), reals);
#endif
}

HS_INLINE const hs_place *hs_places_of(const hs_kernel_input *in, int axis) { return in->site + HS_CLUSTER * axis; }
HS_INLINE const hs_place *hs_listed_places_of(const hs_kernel_input *in, int axis)
{
    return in->site_listed + HS_CLUSTER * axis;
}
/** The square of the unit. */
HS_INLINE double hs_length2(const hs_kernel_input *in) { return in->unit * in->unit; }
/** From squared distances in the unit to squared distances. */
HS_INLINE hs_vec hs_in_length2(hs_vec r2, hs_vec unit2) { return r2 * unit2; }

/** Forces, in energy per unit, of the j-atoms += sum. */
HS_INLINE void hs_add_reaction(hs_kernel_output *out, int axis, const hs_cluster_entry *entry, int sub, hs_acc sum)
{
    float *f = out->packed_f + HS_CLUSTER * axis;
#if HS_LANES == 8
    (void)sub;
    hs_rows_acc part[2] = {(hs_rows_acc)__builtin_shufflevector(sum, sum, 0, 1, 2, 3),
                           (hs_rows_acc)__builtin_shufflevector(sum, sum, 4, 5, 6, 7)};
    for (int k = 0; k < 2; ++k) {
        hs_rows_acc value;
        memcpy(&value, f + entry[k].first, sizeof value);
        value += part[k];
        memcpy(f + entry[k].first, &value, sizeof value);
    }
#else
    hs_acc value;
    memcpy(&value, f + entry->first + HS_LANES * sub, sizeof value);
    value += sum;
    memcpy(f + entry->first + HS_LANES * sub, &value, sizeof value);
#endif
}
HS_INLINE void *hs_own_forces(hs_kernel_output *out, int axis, int first)
{
    return out->packed_f + HS_CLUSTER * axis + first;
}

#else

typedef double hs_place;
typedef hs_vec hs_places;

HS_INLINE hs_places hs_load_places(const double *x, const hs_cluster_entry *entry, int sub)
{
    return hs_load_clusters(x, 0.0, entry, sub);
}
HS_INLINE hs_vec hs_apart(hs_places x_j, hs_place x_i) { return x_j - hs_set1(x_i); }
HS_INLINE const hs_place *hs_places_of(const hs_kernel_input *in, int axis) { return in->x[axis]; }
HS_INLINE const hs_place *hs_listed_places_of(const hs_kernel_input *in, int axis) { return in->x_listed[axis]; }
HS_INLINE double hs_length2(const hs_kernel_input *in)
{
    (void)in;
    return 1.0;
}
HS_INLINE hs_vec hs_in_length2(hs_vec r2, hs_vec unit2)
{
    (void)unit2;
    return r2;
}
HS_INLINE void hs_add_reaction(hs_kernel_output *out, int axis, const hs_cluster_entry *entry, int sub, hs_acc sum)
{
    hs_acc_add_clusters(out->f[axis], entry, sub, sum);
}
HS_INLINE void *hs_own_forces(hs_kernel_output *out, int axis, int first) { return out->f[axis] + first; }

#endif
