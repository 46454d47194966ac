/** How the cluster loop reads positions and adds forces: in double from and to the atoms' arrays; in mixed precision from and
 *  to packed clusters (kernel/packed.h), whose positions are whole multiples of a small unit of length. They become floats
 *  only after the coordinates of a near atom were subtracted, which is exact, so that large boxes lose no digits.
 *
 *  Included by kernel/cluster_loop.h after kernel/accumulate.h. */

#ifdef HS_MIXED

#ifndef HS_TAKES_PACKED
/** One coordinate of the j-atoms of a vector. */
#if HS_LANES == 1
typedef int32_t hs_places;
#else
typedef int32_t hs_places __attribute__((vector_size(4 * HS_LANES)));
#endif

/** One axis of the j-atoms of a vector. */
HS_INLINE hs_places hs_load_axis(const int32_t *numbers, const hs_cluster_entry *entry, int sub)
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
HS_INLINE void hs_load_packed(const int32_t *site, const hs_cluster_entry *entry, int sub, hs_places x[3])
{
    for (int axis = 0; axis < 3; ++axis) x[axis] = hs_load_axis(site + HS_CLUSTER * axis, entry, sub);
}

HS_INLINE void hs_add_axis(float *f, const hs_cluster_entry *entry, int sub, hs_acc sum)
{
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
HS_INLINE void hs_add_packed(float *f, const hs_cluster_entry *entry, int sub, const hs_acc sum[3])
{
    for (int axis = 0; axis < 3; ++axis) hs_add_axis(f + HS_CLUSTER * axis, entry, sub, sum[axis]);
}
#endif

/** Where an i-cluster reckons from: its first atom. */
typedef struct hs_frame {
    int32_t origin[3];
    hs_vec unit; /**< distance; a power of two */
} hs_frame;

/** Set the frame and x of the four i-atoms, whose packed cluster is at `first`, in it. */
HS_INLINE void hs_frame_set(hs_frame *frame, const hs_kernel_input *in, bool listed, int first,
                            hs_real x[3][HS_CLUSTER])
{
    const int32_t *own = (listed ? in->site_listed : in->site) + first;
    frame->unit = hs_set1(in->unit);
    for (int axis = 0; axis < 3; ++axis, own += HS_CLUSTER) {
        frame->origin[axis] = own[0];
        for (int row = 0; row < HS_CLUSTER; ++row)
            x[axis][row] = (float)(int32_t)((uint32_t)own[row] - (uint32_t)own[0]) * (float)in->unit;
    }
}

/** Coordinates of the j-atoms in the frame; the subtraction wraps around. */
HS_INLINE void hs_load_near(const hs_kernel_input *in, bool listed, const hs_frame *frame,
                            const hs_cluster_entry *entry, int sub, hs_vec x[3])
{
    hs_places place[3];
    hs_load_packed(listed ? in->site_listed : in->site, entry, sub, place);
#if HS_LANES == 1
    for (int axis = 0; axis < 3; ++axis)
        x[axis] = (hs_vec)(int32_t)((uint32_t)place[axis] - (uint32_t)frame->origin[axis]) * frame->unit;
#else
    typedef hs_real reals __attribute__((vector_size(4 * HS_LANES)));
    typedef int32_t numbers __attribute__((vector_size(4 * HS_LANES)));
    typedef uint32_t wrapping __attribute__((vector_size(4 * HS_LANES)));
    for (int axis = 0; axis < 3; ++axis) {
        const numbers number = (numbers)((wrapping)place[axis] - (uint32_t)frame->origin[axis]);
        x[axis] = (hs_vec) __builtin_convertvector(number, reals) * frame->unit;
    }
#endif
}

/** Forces of the j-atoms += sum. */
HS_INLINE void hs_add_reaction(hs_kernel_output *out, const hs_cluster_entry *entry, int sub, const hs_acc sum[3])
{
    hs_add_packed(out->packed_f, entry, sub, sum);
}
HS_INLINE void *hs_own_forces(hs_kernel_output *out, int axis, int first)
{
    return out->packed_f + HS_CLUSTER * axis + first;
}

#else

/** Doubles are reckoned from the origin of the box. */
typedef struct hs_frame {
    char unused;
} hs_frame;

HS_INLINE void hs_frame_set(hs_frame *frame, const hs_kernel_input *in, bool listed, int first,
                            hs_real x[3][HS_CLUSTER])
{
    (void)frame;
    for (int axis = 0; axis < 3; ++axis)
        memcpy(x[axis], (listed ? in->x_listed[axis] : in->x[axis]) + first, HS_CLUSTER * sizeof x[axis][0]);
}
HS_INLINE void hs_load_near(const hs_kernel_input *in, bool listed, const hs_frame *frame,
                            const hs_cluster_entry *entry, int sub, hs_vec x[3])
{
    (void)frame;
    for (int axis = 0; axis < 3; ++axis)
        x[axis] = hs_load_clusters(listed ? in->x_listed[axis] : in->x[axis], 0.0, entry, sub);
}
HS_INLINE void hs_add_reaction(hs_kernel_output *out, const hs_cluster_entry *entry, int sub, const hs_acc sum[3])
{
    for (int axis = 0; axis < 3; ++axis) hs_acc_add_clusters(out->f[axis], entry, sub, sum[axis]);
}
HS_INLINE void *hs_own_forces(hs_kernel_output *out, int axis, int first) { return out->f[axis] + first; }

#endif
