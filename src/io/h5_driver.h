/** The way HDF5 files that grow are written: whatever moment the process is killed at, the file on disk is one that any
 *  reader opens, with all frames up to the last commit or the one before. Only folder io/ includes this. */
#ifndef HS_IO_H5_DRIVER_H
#define HS_IO_H5_DRIVER_H

#include <hdf5.h>

#include "base/error.h"

/** A file access list that uses the driver; the caller closes it. < 0 when it cannot be made.
 *
 *  HDF5's own drivers overwrite the file's structure in place, in no useful order, and a process killed meanwhile
 *  leaves a file that cannot be opened. (The single-writer mode would order writes, but leaves a mark in the file that
 *  makes plain readers refuse it; and it cannot be had together with MPI-IO.) This driver holds back what is
 *  overwritten until H5Fflush, and then writes first what is new and not yet referred to, then the structure from the
 *  top down, and last the headers that hold the datasets' extents: each state between is consistent, also in the middle
 *  of a write, which the kernel may leave after any page when the process is killed. A flush that fails (full disk)
 *  leaves the file as it was before. What it relies on:
 *  - formats of HDF5 1.8, whose superblock has no mark of being open, and whose chunk index is a B-tree;
 *  - every piece of structure is allocated at the end of the file (no aggregation), and freed space is not used again
 *    before a flush. */
hid_t hs_h5_driver_list(void);

/** To be called on an existing file that was opened for writing: cuts off what a killed process had not committed. */
void hs_h5_driver_opened(hid_t file);

/** errno of the first write that failed on this file, 0 when all went well. After a failure the file takes no more
 *  writes: it is as of the last good H5Fflush, also after H5Fclose. */
int hs_h5_driver_errno(hid_t file);

#endif
