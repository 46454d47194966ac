/** What create_atoms makes: atoms on the sites of the lattice, at one place, or at random places. */
#ifndef HS_DECK_CREATION_H
#define HS_DECK_CREATION_H

#include "deck/interpreter.h"

typedef enum { HS_CREATE_BOX, HS_CREATE_REGION, HS_CREATE_SINGLE, HS_CREATE_RANDOM } hs_create_style;

/** One create_atoms command, as its words say it. */
typedef struct hs_creation {
    hs_deck *deck;
    hs_sim *sim;
    hs_create_style style;
    int type;                /**< default type */
    int *basis_type;         /**< owned [n_basis]: type of each basis atom */
    const hs_region *region; /**< NULL: everywhere */
    bool is_lattice_units, remap;
    double place[3]; /**< single: distance */
    int64_t n_random;
    int seed;         /**< random */
    double ratio;     /**< fraction of the sites, or */
    int64_t n_subset; /**< number of sites, to fill; both negative: all */
    int subset_seed;
    const char *test;          /**< variable that must not be 0 at a site; NULL: none */
    const char *coordinate[3]; /**< internal variables that hold x, y, z for it, or NULL */

    /* found by hs_creation_run */
    double lo[3], hi[3]; /**< where atoms may be: lo <= x < hi, distance; x pushed upright in a tilted box */
    int64_t next_id;
    int64_t n_created; /**< on all ranks */
} hs_creation;

/** Create the atoms (collective). On an error some may be there already. */
HS_MUST_USE hs_status hs_creation_run(hs_creation *c, hs_error *err);

#endif
