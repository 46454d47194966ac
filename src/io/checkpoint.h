/** Checkpoint files: all that decides the future of a run, whatever the number of ranks and threads.
 *
 *  A checkpoint is an HDF5 file behind 512 bytes of text (HDF5's "user block"; all its tools read such files), which
 *  name the version of the format, the size and the CRC-32 of the rest. So a file that is cut, damaged or too new is
 *  known before any of it is believed. It is written beside its place, flushed to disk, and renamed: it is there wholly
 *  or not at all.
 *
 *      /SECTION/NAME     values: hs_state, one group each ("simulation", "fix/ID", ...)
 *      /atoms/FIELD      [n_all] or [n_all][words], rows in the order of ids: every field of hs_atoms
 *
 *  All functions are collective, and the ranks agree on errors. */
#ifndef HS_IO_CHECKPOINT_H
#define HS_IO_CHECKPOINT_H

#include "core/atoms.h"
#include "parallel/parallel.h"
#include "style/state.h"

/** Version of the format: raised when older programs could not read it; the oldest that is read. Format 1, never
 *  released, had other sums for standard errors and other names of computes' fields. */
enum { HS_CHECKPOINT_FORMAT = 2, HS_CHECKPOINT_FORMAT_OLDEST = 2 };

typedef struct hs_checkpoint hs_checkpoint;

HS_MUST_USE hs_status hs_checkpoint_create(hs_checkpoint **checkpoint, const char *path, const hs_parallel *parallel,
                                           hs_error *err);
HS_MUST_USE hs_status hs_checkpoint_put(hs_checkpoint *checkpoint, const char *section, const hs_state *state,
                                        hs_error *err);
HS_MUST_USE hs_status hs_checkpoint_put_atoms(hs_checkpoint *checkpoint, const hs_atoms *atoms, hs_error *err);
/** The file takes its name; what had it is replaced. Clears the pointer. */
HS_MUST_USE hs_status hs_checkpoint_commit(hs_checkpoint **checkpoint, hs_error *err);

/** Open a file for reading after its size and CRC were found right. */
HS_MUST_USE hs_status hs_checkpoint_open(hs_checkpoint **checkpoint, const char *path, const hs_parallel *parallel,
                                         hs_error *err);
/** Values of a section, ready for reading; the caller finishes the state. An error when there is no such section. */
HS_MUST_USE hs_status hs_checkpoint_get(hs_checkpoint *checkpoint, const char *section, hs_state *state, hs_error *err);
/** Replace all atoms by the file's. Each rank takes a share; the next exchange brings atoms to their owners. Fields
 *  that the file has not stay zero; with @p all_fields those are an error, and so are fields of the file that the atoms
 *  have not. */
HS_MUST_USE hs_status hs_checkpoint_get_atoms(hs_checkpoint *checkpoint, hs_atoms *atoms, bool all_fields,
                                              hs_error *err);

/** Close a file that was read, or give up one that was being written, of which nothing stays. NULL is fine. */
void hs_checkpoint_destroy(hs_checkpoint **checkpoint);

#endif
