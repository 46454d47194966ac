#include "comm/predict.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "comm/halo_plan.h"

/** Ranks that receive atoms: blocks follow one another partner by partner. */
static int count_partners(const hs_halo_side *side)
{
    int n = 0;
    for (int b = side->n_self; b < side->n_blocks; ++b)
        n += b == side->n_self || side->block[b].rank != side->block[b - 1].rank;
    return n;
}

/** How much of a brick's length (and reach, both in the coordinate of hs_box_upright) along an axis is within reach of the brick `j` layers away: nothing more than all of it. */
static double depth(double length, double reach, int j)
{
    const double inside = reach - (abs(j) - 1) * length;
    return j == 0 ? length : fmin(fmax(inside, 0.0), length);
}

/** Volume of the atoms that come in a block. */
static double block_volume(const hs_halo_block *block, const double length[3], const hs_box *box, double reach)
{
    double volume = 1.0;
    for (int axis = 0; axis < box->dimension; ++axis)
        volume *= depth(length[axis], hs_box_reach(box, axis, reach), block->offset[axis]);
    return volume;
}

static hs_status describe(hs_prediction *p, const hs_domain *domain, const hs_box *box, double n_atoms, double reach,
                          hs_error *err)
{
    hs_halo halo = {0};
    hs_halo_plan plan;
    double volume = 1.0, halo_volume = 0.0, own_volume = 0.0;
    memcpy(p->n, domain->n, sizeof p->n);
    for (int axis = 0; axis < 3; ++axis) {
        p->length[axis] = hs_box_length(box, axis) / domain->n[axis];
        if (axis < box->dimension) volume *= p->length[axis];
    }
    const hs_status status = hs_halo_plan_make(&plan, &halo, domain, box, reach, err);
    for (int b = 0; status == HS_OK && b < halo.in.n_blocks; ++b) {
        const double part = block_volume(&halo.in.block[b], p->length, box, reach);
        halo_volume += part;
        own_volume += b < halo.in.n_self ? part : 0.0;
    }
    p->n_local = n_atoms / domain->n_ranks;
    p->n_halo = p->n_local * halo_volume / volume;
    p->n_remote = p->n_local * (halo_volume - own_volume) / volume;
    p->n_partners = count_partners(&halo.out);
    hs_halo_plan_fini(&plan);
    hs_halo_fini(&halo);
    return status;
}

hs_status hs_predict(hs_prediction *prediction, const hs_box *box, const int wanted[3], int n_ranks, double n_atoms,
                     double reach, hs_error *err)
{
    const hs_parallel ranks = {.n_ranks = n_ranks};
    hs_domain domain;
    memset(prediction, 0, sizeof *prediction);
    hs_domain_init(&domain, &ranks);
    memcpy(domain.wanted, wanted, sizeof domain.wanted);
    hs_status status = hs_domain_divide(&domain, box, err);
    if (status == HS_OK) {
        for (int axis = 0; axis < 3; ++axis) domain.at[axis] = domain.n[axis] / 2;
        domain.rank = hs_domain_rank(&domain, domain.at);
        status = describe(prediction, &domain, box, n_atoms, reach, err);
    }
    hs_domain_fini(&domain);
    return status;
}
