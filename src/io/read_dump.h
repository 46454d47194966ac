/** Atoms from a snapshot of a trajectory: what the commands read_dump and rerun do with each. */
#ifndef HS_IO_READ_DUMP_H
#define HS_IO_READ_DUMP_H

#include "io/frames.h"
#include "style/env.h"

typedef enum {
    HS_ADD_NO,
    HS_ADD_YES, /**< new atoms get ids after the largest one */
    HS_ADD_KEEP /**< they keep the ids of the snapshot */
} hs_read_add;

typedef struct hs_read_options {
    hs_frames_plan plan;
    bool box;      /**< take over the snapshot's box */
    bool timestep; /**< and its step; for the caller */
    bool replace;  /**< change atoms that are in both */
    bool purge;    /**< remove all atoms first */
    bool trim;     /**< remove atoms that the snapshot has not */
    hs_read_add add;
} hs_read_options;

/** Atoms on all ranks. */
typedef struct hs_read_counts {
    int64_t before, in_snapshot, purged, replaced, trimmed, added, after;
} hs_read_counts;

/** Take atoms over from a snapshot (collective). They are wrapped into the box and brought to the ranks that own their
 *  places. The caller then tells the simulation that atoms have changed. */
HS_MUST_USE hs_status hs_read_snapshot(hs_env *env, hs_frames *frames, const hs_snapshot *snapshot,
                                       const hs_read_options *options, hs_read_counts *counts, hs_error *err);

#endif
