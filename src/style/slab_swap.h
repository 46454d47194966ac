/** Exchange of velocities between atoms of the lowest and of the middle layer of the box, as reverse nonequilibrium
 *  methods make it (F. Müller-Plathe, J. Chem. Phys. 106, 6082 (1997), doi:10.1063/1.473271). */
#ifndef HS_STYLE_SLAB_SWAP_H
#define HS_STYLE_SLAB_SWAP_H

#include "style/fix.h"

/** The layers, and how many pairs of atoms exchange velocities each time. */
typedef struct hs_slab_swap {
    int axis;    /**< along which the layers follow each other */
    int n_bins;  /**< layers, even */
    int n_swaps; /**< pairs of atoms */
} hs_slab_swap;

enum { HS_SLAB_LOWEST, HS_SLAB_MIDDLE };
enum { HS_SLAB_SWAPS_MAX = 1000000 };

/** How little local atom i of a layer is wanted as a partner; the atoms with the lowest values are chosen. INFINITY:
 *  never. */
typedef double (*hs_slab_rank)(const hs_fix *fix, int i, int slab);
/** What one pair has exchanged: mass of the lowest layer's atom, and its velocity before and after. */
typedef void (*hs_slab_exchanged)(hs_fix *fix, double mass, const double before[3], const double after[3]);

/** Read the words <axis> <N bins> of a fix from words i and i + 1. */
HS_MUST_USE hs_status hs_slab_swap_read(hs_slab_swap *swap, const hs_fix *fix, const hs_args *args, int i,
                                        hs_error *err);
/** Choose pairs, the best of each layer first, and let the components [first, end) of their velocities collide
 *  elastically: atoms of equal mass change velocities. @p exchanged is called on all ranks for every pair, in the same
 *  order. Collective. */
HS_MUST_USE hs_status hs_slab_swap_make(const hs_slab_swap *swap, hs_fix *fix, int first, int end, hs_slab_rank rank,
                                        hs_slab_exchanged exchanged, hs_error *err);

#endif
