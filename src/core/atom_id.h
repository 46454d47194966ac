/** Ids of atoms. */
#ifndef HS_CORE_ATOM_ID_H
#define HS_CORE_ATOM_ID_H

#include <stdint.h>

/** Ids are from 1 to this: what is counted on from the highest is a number still. */
#define HS_ATOM_ID_MAX (INT64_C(1) << 62)

#endif
