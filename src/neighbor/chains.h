/** Cells as chains of atoms: `head` is the first atom of a cell, `next` the one after it. The structure of the textbooks
 *  (M. P. Allen, D. J. Tildesley, Computer Simulation of Liquids, 2nd ed., section 5.3.2; D. Frenkel, B. Smit,
 *  Understanding Molecular Simulation, appendix F), kept up to date in one of three ways:
 *
 *    linked       all cells of the grid have a head; everything is built anew at every step
 *    incremental  the chains are doubly linked, and only atoms that have changed cell are moved
 *    hash         only occupied cells have a head, found by a hash table: memory goes by atoms, not by volume
 *
 *  Local and halo atoms are in the same chains.
 *
 *  Where the cutoff of a pair is the sum of two radii, cells must be as wide as the largest sum, and when sizes differ much each holds
 *  many small atoms. Then there are two chains: small atoms in fine cells, as wide as their own largest sum, and large ones in coarse
 *  cells; pairs of a small and a large atom are found from the small one, which looks into the coarse cells around.
 *  Source: V. Ogarko, S. Luding, Comput. Phys. Commun. 183, 931 (2012), doi:10.1016/j.cpc.2011.12.019. */
#ifndef HS_NEIGHBOR_CHAINS_H
#define HS_NEIGHBOR_CHAINS_H

#include "core/atoms.h"
#include "neighbor/grid.h"
#include "neighbor/hash_table.h"

enum { HS_CHAIN_END = -1 }; /**< in head: the cell is empty; in next and previous: there is none */

/** Zero it before use. */
typedef struct hs_chains {
    hs_grid grid;
    hs_cell_order order;
    bool is_sized;               /**< only atoms of some sizes are in the chains: */
    double radius_lo, radius_hi; /**< lo < radius <= hi, distance */
    int64_t n_cells;             /**< cells with a head: all of the grid, or (hash) the occupied ones */
    int n_atoms;                 /**< atoms in the chains, local and halo */
    int32_t *head;               /**< owned [n_cells] */
    int32_t *next;               /**< owned [n_atoms] */
    int64_t capacity_cells, capacity_atoms;

    /* linked, incremental, in Morton order: numbers of the cells along the curve; NULL when they are numbered row by row */
    int32_t *number; /**< owned [n_cells]: of the cell at each place */
    int32_t *place;  /**< owned [n_cells]: of the cell of each number */

    /* incremental */
    int32_t *cell;                /**< owned [n_atoms]: cell in whose chain the atom is */
    int32_t *previous;            /**< owned [n_atoms] */
    int n_local;                  /**< atoms below are local ones */
    uint64_t generation;          /**< of the atoms in the chains */
    bool is_void;                 /**< the grid has changed: nothing can be kept */
    int64_t n_checked, n_changed; /**< atoms looked at, and moved to another chain, so far */

    /* hash */
    bool is_hashed;      /**< cells are the occupied ones, found in the table */
    hs_hash_table table; /**< owned */
} hs_chains;

/** Which atoms the next builds put into the chains: those with lo < radius <= hi. */
void hs_chains_set_sizes(hs_chains *chains, double radius_lo, double radius_hi);
/** All atoms, whatever their size. */
void hs_chains_set_all_sizes(hs_chains *chains);
/** Lay the grid for the next builds. */
HS_MUST_USE hs_status hs_chains_set_grid(hs_chains *chains, const hs_grid_plan *plan, hs_cell_order order,
                                         hs_error *err);
void hs_chains_fini(hs_chains *chains);
/** Memory of the arrays that the present method uses, bytes. */
size_t hs_chains_memory(const hs_chains *chains);

/** Method `linked`: put all atoms, local and halo, into the chains of their cells.  neighbor/linked.c */
HS_MUST_USE hs_status hs_linked_build(hs_chains *chains, const hs_atoms *atoms, hs_error *err);
/** Method `incremental`: move the atoms that have changed cell since the last call. After an exchange (@p has_new_halo) the
 *  halo atoms are others than before; when the local ones are too, the chains are built anew.  neighbor/incremental.c */
HS_MUST_USE hs_status hs_incremental_update(hs_chains *chains, const hs_atoms *atoms, bool has_new_halo, hs_error *err);
/** Method `hash`: like linked, with heads for occupied cells only.  neighbor/hash.c */
HS_MUST_USE hs_status hs_hash_build(hs_chains *chains, const hs_atoms *atoms, hs_error *err);

/** Heads for all cells of the grid, numbered in their order. Does nothing when there are as many already. */
HS_MUST_USE hs_status hs_chains_number_cells(hs_chains *chains, hs_error *err);
/** Room for the chains of n atoms; what is in them stays. */
HS_MUST_USE hs_status hs_chains_reserve(hs_chains *chains, int64_t n, hs_error *err);

/** New order of the local atoms, cell by cell (order[k]: old index of the atom that comes k-th); those of one cell by id. */
HS_MUST_USE hs_status hs_chains_sort(const hs_chains *chains, const hs_atoms *atoms, int32_t *order, hs_error *err);

/** Whether the chains are to hold atom i. */
static inline bool hs_chains_takes(const hs_chains *chains, const hs_atoms *atoms, int64_t i)
{
    return !chains->is_sized || (atoms->radius[i] > chains->radius_lo && atoms->radius[i] <= chains->radius_hi);
}

/** The cell of the grid that atom i is in. */
static inline void hs_chains_locate(const hs_chains *chains, const hs_atoms *atoms, int64_t i, int c[3])
{
    for (int a = 0; a < 3; ++a) c[a] = hs_grid_coordinate(&chains->grid, a, atoms->x[a][i]);
}

/** Number of the cell at c, where all cells have one. */
static inline int32_t hs_chains_number(const hs_chains *chains, const int c[3])
{
    const int64_t place = hs_grid_place(&chains->grid, c);
    return chains->number != NULL ? chains->number[place] : (int32_t)place;
}

/** First atom of the cell at c; HS_CHAIN_END for an empty cell and beyond the grid. */
static inline int32_t hs_chains_first(const hs_chains *chains, const int c[3])
{
    for (int a = 0; a < 3; ++a)
        if (c[a] < 0 || c[a] >= chains->grid.n[a]) return HS_CHAIN_END;
    if (!chains->is_hashed) return chains->head[hs_chains_number(chains, c)];
    const int32_t cell = hs_hash_table_find(&chains->table, hs_grid_place(&chains->grid, c));
    return cell < 0 ? HS_CHAIN_END : chains->head[cell];
}

/** Coordinates of the cell of a number. */
static inline void hs_chains_coordinates(const hs_chains *chains, int64_t cell, int c[3])
{
    const int64_t place = chains->is_hashed       ? chains->table.place_of[cell]
                          : chains->place != NULL ? chains->place[cell]
                                                  : cell;
    hs_grid_cell_at(&chains->grid, place, c);
}

#endif
