#include "comm/halo_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Layers of bricks beyond which the halo would dwarf the bricks. */
enum { LAYERS_MAX = 100 };

/** Whether bricks k and k + a of an axis are within reach. Both of them ask with the same numbers (k is brought into the
 *  box), so that both find the same answer. */
static bool is_near(const hs_domain *domain, const hs_box *box, int axis, int k, int a, double reach)
{
    const int n = domain->n[axis], first = k >= 0 ? k % n : n - 1 - (-1 - k) % n;
    return hs_domain_plane(domain, box, axis, first + a) - hs_domain_plane(domain, box, axis, first + 1) < reach;
}

/** @p along is the reach in the coordinate of hs_box_upright. */
static hs_status refuse_layers(const hs_domain *domain, const hs_box *box, int axis, double along, hs_error *err)
{
    const double thickness = hs_box_thickness(box, axis), reach = along * thickness / hs_box_length(box, axis);
    if (domain->n[axis] == 1 && box->is_tilted)
        return hs_fail(err, HS_ERROR_RUN,
                       "the box is tilted so much that its faces across %c are %g apart, less than a hundredth of the "
                       "reach %g of the forces: smaller tilts give the same periodic images (xy less whole lengths "
                       "in x, yz less whole lengths in y)",
                       "xyz"[axis], thickness, reach);
    if (domain->n[axis] == 1)
        return hs_fail(err, HS_ERROR_RUN,
                       "the box is %g long in %c, less than a hundredth of the reach %g of the "
                       "forces: make the box larger or the cutoff shorter",
                       hs_box_length(box, axis), "xyz"[axis], reach);
    return hs_fail(
        err, HS_ERROR_RUN,
        "the box is cut into %d bricks along %c, so thin that the forces reach %g over more than a hundred of "
        "them: use fewer ranks, or 'processors' with fewer along %c",
        domain->n[axis], "xyz"[axis], reach, "xyz"[axis]);
}

static hs_status count_layers(hs_halo_layers *layers, const hs_domain *domain, const hs_box *box, int axis,
                              double reach, hs_error *err)
{
    const int at = domain->at[axis], n = domain->n[axis];
    const bool goes_around = box->periodic[axis];
    layers->below = layers->above = 0;
    if (axis >= box->dimension) return HS_OK;
    while (layers->above <= LAYERS_MAX && (goes_around || at + layers->above + 1 < n) &&
           is_near(domain, box, axis, at, layers->above + 1, reach))
        ++layers->above;
    while (layers->below <= LAYERS_MAX && (goes_around || at - layers->below - 1 >= 0) &&
           is_near(domain, box, axis, at - layers->below - 1, layers->below + 1, reach))
        ++layers->below;
    if (layers->above > LAYERS_MAX || layers->below > LAYERS_MAX) return refuse_layers(domain, box, axis, reach, err);
    return HS_OK;
}

/** Shifts and limits of every layer, in the frame of the brick the atoms go to. */
static hs_status measure_layers(hs_halo_layers *layers, const hs_domain *domain, const hs_box *box, int axis,
                                double reach, hs_error *err)
{
    const int n_layers = layers->below + 1 + layers->above, n = domain->n[axis];
    HS_TRY(HS_ALLOC(layers->shift, (size_t)n_layers, err));
    HS_TRY(HS_ALLOC(layers->image, (size_t)n_layers, err));
    HS_TRY(HS_ALLOC(layers->limit, (size_t)n_layers, err));
    for (int j = -layers->below; j <= layers->above; ++j) {
        const int k = domain->at[axis] + j, away = k >= 0 ? k / n : -((n - 1 - k) / n), within = k - away * n;
        layers->image[j + layers->below] = -away;
        layers->shift[j + layers->below] = -away * hs_box_length(box, axis);
        layers->limit[j + layers->below] = j < 0 ? hs_domain_plane(domain, box, axis, within + 1) + reach
                                                 : hs_domain_plane(domain, box, axis, within) - reach;
    }
    return HS_OK;
}

static bool is_positive(const int offset[3])
{
    return offset[0] != 0 ? offset[0] > 0 : offset[1] != 0 ? offset[1] > 0 : offset[2] > 0;
}

static int compare_blocks(const hs_halo_block *a, const hs_halo_block *b)
{
    if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis)
        if (a->offset[axis] != b->offset[axis]) return a->offset[axis] < b->offset[axis] ? -1 : 1;
    return 0;
}

static int compare(const void *a, const void *b) { return compare_blocks(a, b); }

/** Blocks of one side: partners at `sign` times a positive offset. */
static hs_status list_blocks(hs_halo_side *side, const hs_halo_plan *plan, const hs_domain *domain, int sign,
                             hs_error *err)
{
    const hs_halo_layers *l = plan->layers;
    int64_t n = 1;
    for (int axis = 0; axis < 3; ++axis) n *= l[axis].below + 1 + l[axis].above;
    HS_TRY(HS_RESERVE(side->block, side->capacity_blocks, (size_t)n,
                      err)); /* brick at a corner: all offsets may be positive */
    side->n_blocks = side->n_self = 0;
    for (int j0 = -l[0].below; j0 <= l[0].above; ++j0)
        for (int j1 = -l[1].below; j1 <= l[1].above; ++j1)
            for (int j2 = -l[2].below; j2 <= l[2].above; ++j2) {
                hs_halo_block block = {.offset = {sign * j0, sign * j1, sign * j2}};
                if (!is_positive(block.offset)) continue;
                const int partner[3] = {domain->at[0] + j0, domain->at[1] + j1, domain->at[2] + j2};
                block.rank = hs_domain_rank(domain, partner);
                const int place[3] = {j0 + l[0].below, j1 + l[1].below, j2 + l[2].below};
                for (int axis = 0; axis < 3; ++axis) block.image[axis] = l[axis].image[place[axis]];
                hs_box_shift(plan->box, block.image, block.shift);
                if (block.rank == domain->rank) {
                    block.rank = -1; /* sorts first */
                    ++side->n_self;
                }
                side->block[side->n_blocks++] = block;
            }
    qsort(side->block, (size_t)side->n_blocks, sizeof *side->block, compare);
    for (int b = 0; b < side->n_self; ++b) side->block[b].rank = domain->rank;
    return HS_OK;
}

static hs_status index_blocks(hs_halo_plan *plan, const hs_halo_side *out, hs_error *err)
{
    const hs_halo_layers *l = plan->layers;
    const int64_t n = hs_halo_plan_index(plan, l[0].above, l[1].above, l[2].above) + 1;
    HS_TRY(HS_ALLOC(plan->block_of, (size_t)n, err));
    for (int64_t k = 0; k < n; ++k) plan->block_of[k] = -1;
    for (int b = 0; b < out->n_blocks; ++b) {
        const int *offset = out->block[b].offset;
        plan->block_of[hs_halo_plan_index(plan, -offset[0], -offset[1], -offset[2])] = b;
    }
    return HS_OK;
}

hs_status hs_halo_plan_make(hs_halo_plan *plan, hs_halo *halo, const hs_domain *domain, const hs_box *box, double reach,
                            hs_error *err)
{
    memset(plan, 0, sizeof *plan);
    plan->box = box;
    for (int axis = 0; axis < 3; ++axis) {
        hs_halo_layers *layers = &plan->layers[axis];
        const double along = hs_box_reach(box, axis, reach);
        HS_TRY(count_layers(layers, domain, box, axis, along, err));
        HS_TRY(measure_layers(layers, domain, box, axis, along, err));
        plan->inner_lo[axis] =
            layers->below > 0 ? hs_domain_plane(domain, box, axis, domain->at[axis]) + along : -INFINITY;
    }
    HS_TRY(list_blocks(&halo->out, plan, domain, -1, err));
    HS_TRY(list_blocks(&halo->in, plan, domain, 1, err));
    return index_blocks(plan, &halo->out, err);
}

void hs_halo_plan_fini(hs_halo_plan *plan)
{
    for (int axis = 0; axis < 3; ++axis) {
        HS_FREE(plan->layers[axis].shift);
        HS_FREE(plan->layers[axis].image);
        HS_FREE(plan->layers[axis].limit);
    }
    HS_FREE(plan->block_of);
}
