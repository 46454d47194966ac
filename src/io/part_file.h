/** Files that are there wholly or not at all: written under another name beside their place, and renamed when complete.
 *
 *  The other name is NAME.halfshell-part-PID, and its maker holds a lock on it (flock) as long as it lives. So what a
 *  killed process has left can be told from what another run is writing at this moment, on any machine that shares the
 *  folder: whoever makes a part removes first the parts without a living maker that belong to the same file, or to
 *  another one of its series (names that differ in digits only: checkpoint.40.h5, checkpoint.80.h5).
 *
 *  Not collective: one rank writes. */
#ifndef HS_IO_PART_FILE_H
#define HS_IO_PART_FILE_H

#include "base/error.h"

/** Zeroed: none. */
typedef struct hs_part_file {
    char *target; /**< owned; the file that the part is to become, symbolic links followed */
    char *path;   /**< owned; name of the part; NULL: there is none */
    int lock;     /**< descriptor that holds the lock, with path */
} hs_part_file;

/** Make the empty part of @p target, with the access rights of the file that it will replace. */
HS_MUST_USE hs_status hs_part_file_make(hs_part_file *part, const char *target, hs_error *err);
/** The part, which must have been written and flushed, takes its name. On failure it is removed. */
HS_MUST_USE hs_status hs_part_file_finish(hs_part_file *part, hs_error *err);
/** Remove the part, if there is one. */
void hs_part_file_abandon(hs_part_file *part);
/** Remove what dead processes have left of @p target and its series. */
void hs_part_file_sweep(const char *target);

#endif
