/** Halo atoms: copies of periodic images (and of other ranks' atoms) within reach of this rank's brick. */
#ifndef HS_COMM_HALO_H
#define HS_COMM_HALO_H

#include "core/atoms.h"
#include "core/box.h"

typedef struct hs_halo {
    int n;
} hs_halo;

#endif
