/** Frames of atoms in an H5MD file: what the ranks have of each element is brought to rank 0 in blocks, ordered by id,
 *  and written. */
#ifndef HS_IO_H5MD_FRAMES_H
#define HS_IO_H5MD_FRAMES_H

#include "io/observables.h"

typedef enum {
    HS_H5MD_POSITION,
    HS_H5MD_VELOCITY,
    HS_H5MD_FORCE,
    HS_H5MD_IMAGE,
    HS_H5MD_SPECIES,
    HS_H5MD_N_ELEMENTS
} hs_h5md_kind;

typedef struct hs_h5md_frames {
    hs_h5md *file; /**< owned by who opened it; rank 0 only */
    uint32_t mask; /**< groups whose atoms are written */
    int n_elements;
    hs_h5md_kind kind[HS_H5MD_N_ELEMENTS];
    hs_h5md_element element[HS_H5MD_N_ELEMENTS];
    /* Atoms of the latest frame: while they are the same, and row k is the k-th of them by id, no ids need be looked
     * up. */
    bool is_regular; /**< false for a file that was just opened */
    int64_t n_atoms, id_sum;
} hs_h5md_frames;

/** Append a frame of the present step, with the observables (collective). An error on one rank is one on all; the frame
 *  is not there then. */
HS_MUST_USE hs_status hs_h5md_frames_write(hs_h5md_frames *self, hs_env *env, hs_observables *observables,
                                           hs_error *err);

#endif
