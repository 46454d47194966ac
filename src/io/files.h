/** Questions about files that all ranks must answer alike, though only the first is sure to see the deck's file system. */
#ifndef HS_IO_FILES_H
#define HS_IO_FILES_H

#include "base/error.h"
#include "parallel/parallel.h"

/** Whether rank 0 can read the file (collective). */
bool hs_file_is_readable(const hs_parallel *parallel, const char *path);
/** Whether two names are of one ordinary file on rank 0, for what must not be written over (collective). */
bool hs_file_is_same(const hs_parallel *parallel, const char *one, const char *other);
/** Refuse a name that rank 0 can write no file of: that of a folder, or one in a folder that is not there or may not be
 *  written (collective). A `*` may stand in the name; with one in the folder's, nothing is known. @p who begins the message. */
HS_MUST_USE hs_status hs_file_check_place(const hs_parallel *parallel, const char *who, const char *path,
                                          hs_error *err);

#endif
