/** Questions about files that all ranks must answer alike, though only the first is sure to see the deck's file system. */
#ifndef HS_IO_FILES_H
#define HS_IO_FILES_H

#include "parallel/parallel.h"

/** Whether rank 0 can read the file (collective). */
bool hs_file_is_readable(const hs_parallel *parallel, const char *path);
/** Whether two names are of one ordinary file on rank 0, for what must not be written over (collective). */
bool hs_file_is_same(const hs_parallel *parallel, const char *one, const char *other);

#endif
