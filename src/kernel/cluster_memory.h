/** How the cluster loop reads positions and adds forces: in double from and to the atoms' arrays; in mixed precision from and
 *  to packed clusters (kernel/packed.h), whose positions are whole multiples of a small unit of length. They become floats
 *  only after the coordinates of a near atom were subtracted, which is exact, so that large boxes lose no digits.
 *
 *  Included by kernel/cluster_loop.h after kernel/accumulate.h. */

#ifdef HS_MIXED

/** One coordinate of an atom, and of the j-atoms of a vector. */
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

/** Where an i-cluster reckons from: its first atom. */
typedef struct hs_frame {
    int32_t origin[3];
    hs_vec unit; /**< distance; a power of two */
} hs_frame;

/** Set the frame's axis, and x of the four i-atoms in it. */
HS_INLINE void hs_frame_set(hs_frame *frame, const hs_kernel_input *in, int axis, const hs_place *own,
                            hs_real x[HS_CLUSTER])
{
    frame->origin[axis] = own[0];
    frame->unit = hs_set1(in->unit);
    for (int row = 0; row < HS_CLUSTER; ++row)
        x[row] = (float)(int32_t)((uint32_t)own[row] - (uint32_t)own[0]) * (float)in->unit;
}

/** Coordinates of the j-atoms in the frame; the subtraction wraps around. */
HS_INLINE hs_vec hs_load_x(const hs_place *places, const hs_frame *frame, int axis, const hs_cluster_entry *entry,
                           int sub)
{
    const hs_places x = hs_load_places(places, entry, sub);
#if HS_LANES == 1
    return (hs_vec)(int32_t)((uint32_t)x - (uint32_t)frame->origin[axis]) * frame->unit;
#else
    typedef hs_real reals __attribute__((vector_size(4 * HS_LANES)));
    typedef uint32_t wrapping __attribute__((vector_size(4 * HS_LANES)));
    return (hs_vec) __builtin_convertvector((hs_places)((wrapping)x - (uint32_t)frame->origin[axis]), reals) *
           frame->unit;
#endif
}

HS_INLINE const hs_place *hs_places_of(const hs_kernel_input *in, int axis) { return in->site + HS_CLUSTER * axis; }
HS_INLINE const hs_place *hs_listed_places_of(const hs_kernel_input *in, int axis)
{
    return in->site_listed + HS_CLUSTER * axis;
}
/** Forces of the j-atoms += sum. */
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

/** Doubles are reckoned from the origin of the box. */
typedef struct hs_frame {
    char unused;
} hs_frame;

HS_INLINE void hs_frame_set(hs_frame *frame, const hs_kernel_input *in, int axis, const hs_place *own,
                            hs_real x[HS_CLUSTER])
{
    (void)frame, (void)in, (void)axis;
    memcpy(x, own, HS_CLUSTER * sizeof *x);
}
HS_INLINE hs_vec hs_load_x(const hs_place *places, const hs_frame *frame, int axis, const hs_cluster_entry *entry,
                           int sub)
{
    (void)frame, (void)axis;
    return hs_load_clusters(places, 0.0, entry, sub);
}
HS_INLINE const hs_place *hs_places_of(const hs_kernel_input *in, int axis) { return in->x[axis]; }
HS_INLINE const hs_place *hs_listed_places_of(const hs_kernel_input *in, int axis) { return in->x_listed[axis]; }
HS_INLINE void hs_add_reaction(hs_kernel_output *out, int axis, const hs_cluster_entry *entry, int sub, hs_acc sum)
{
    hs_acc_add_clusters(out->f[axis], entry, sub, sum);
}
HS_INLINE void *hs_own_forces(hs_kernel_output *out, int axis, int first) { return out->f[axis] + first; }

#endif
