/** Which bricks exchange halo atoms, and which places each of them needs; part of comm/halo.c. */
#ifndef HS_COMM_HALO_PLAN_H
#define HS_COMM_HALO_PLAN_H

#include "comm/halo.h"

/** The bricks below and above this one along an axis that are within reach of it. */
typedef struct hs_halo_layers {
    int below, above;
    /** Owned [below + 1 + above]: of coordinates sent to layer j (hs_box_upright), at shift[j + below]. */
    double *shift;
    int *image;    /**< owned: the same in edges of the box */
    double *limit; /**< owned: layers j < 0 need x + shift < limit, layers j > 0 x + shift >= limit */
} hs_halo_layers;

typedef struct hs_halo_plan {
    const hs_box *box; /**< borrowed */
    hs_halo_layers layers[3];
    double inner_lo[3]; /**< atoms from here on go to no layer below along this axis */
    int32_t *block_of;  /**< owned: block to send for layers (j0, j1, j2), lexicographic; -1: none is sent there */
} hs_halo_plan;

/** Find the neighbors of this rank's brick, and list the blocks of both sides of the halo (without atoms yet). Not
 *  collective; the plans of all ranks fit together. Free the plan also after an error. */
HS_MUST_USE hs_status hs_halo_plan_make(hs_halo_plan *plan, hs_halo *halo, const hs_domain *domain, const hs_box *box,
                                        double reach, hs_error *err);
void hs_halo_plan_fini(hs_halo_plan *plan);

/** Place of layers (j0, j1, j2) in block_of. */
static inline int64_t hs_halo_plan_index(const hs_halo_plan *plan, int j0, int j1, int j2)
{
    const hs_halo_layers *l = plan->layers;
    const int64_t n1 = l[1].below + 1 + l[1].above, n2 = l[2].below + 1 + l[2].above;
    return ((j0 + l[0].below) * n1 + j1 + l[1].below) * n2 + j2 + l[2].below;
}

#endif
