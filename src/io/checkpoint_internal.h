/** What checkpoint.c and checkpoint_atoms.c share. */
#ifndef HS_IO_CHECKPOINT_INTERNAL_H
#define HS_IO_CHECKPOINT_INTERNAL_H

#include <hdf5.h>

#include "io/checkpoint.h"
#include "io/part_file.h"

struct hs_checkpoint {
    char *path;           /**< owned */
    hs_part_file part;    /**< rank 0's file until it takes its name; none when reading, and after that */
    hs_parallel parallel; /**< a copy: the simulation may be made anew meanwhile */
    hid_t file;           /**< -1 on other ranks than 0 */
};

hs_status hs_checkpoint_fail(const hs_checkpoint *checkpoint, const char *what, hs_error *err);

#endif
