/** Files written as text, in pieces that appear whole: a buffered writer for plain and gzip files. */
#ifndef HS_IO_WRITER_H
#define HS_IO_WRITER_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

typedef enum {
    HS_WRITE_WHOLE,   /**< beside the target, renamed over it by hs_writer_close: there wholly or not at all */
    HS_WRITE_REPLACE, /**< a growing file, emptied at first */
    HS_WRITE_APPEND   /**< a growing file, added to */
} hs_write_mode;

typedef struct hs_writer hs_writer;

/** Open a file for writing; a name that ends in .gz is compressed. What is not a regular file (a pipe, /dev/null) is
 *  written in place in every mode. Not collective. The caller closes or abandons it. */
HS_MUST_USE hs_status hs_writer_open(hs_writer **writer, const char *path, hs_write_mode mode, hs_error *err);
HS_MUST_USE hs_status hs_writer_bytes(hs_writer *writer, const char *bytes, size_t n, hs_error *err);
HS_MUST_USE hs_status hs_writer_printf(hs_writer *writer, hs_error *err, const char *fmt, ...) HS_PRINTF(3, 4);
/** Bytes up to the last commit. */
int64_t hs_writer_committed(const hs_writer *writer);
/** Cut a growing file, just opened to be added to, to its first @p size bytes; a shorter one stays as it is. */
HS_MUST_USE hs_status hs_writer_cut(hs_writer *writer, int64_t size, hs_error *err);
/** Write other bytes in the place of some that were committed; what is no regular file stays as it is. */
HS_MUST_USE hs_status hs_writer_patch(hs_writer *writer, int64_t place, const char *bytes, size_t n, hs_error *err);
/** End of a piece (a snapshot): all bytes so far go to the system, a gzip member is ended. A growing file whose piece
 *  cannot be written is cut back to the end of the last whole one. */
HS_MUST_USE hs_status hs_writer_commit(hs_writer *writer, hs_error *err);
/** Commit, flush to disk and close; a whole file takes its name now. Clears the pointer; NULL is fine. */
HS_MUST_USE hs_status hs_writer_close(hs_writer **writer, hs_error *err);
/** Close without the bytes since the last commit: a whole file vanishes, a growing one is cut back. NULL is fine. */
void hs_writer_abandon(hs_writer **writer);

/** Name of the file of a step: the first `*` of the pattern becomes the step, with leading zeros to @p pad digits;
 *  owned by the caller. Patterns without `*` are copied. */
HS_MUST_USE hs_status hs_writer_step_name(char **name, const char *pattern, int64_t step, int pad, hs_error *err);

#endif
