/** Atoms that have left their rank's brick go to the rank that owns their place. */
#ifndef HS_COMM_MIGRATE_H
#define HS_COMM_MIGRATE_H

#include "comm/domain.h"
#include "core/atoms.h"

/** Bring every atom to the rank whose brick holds it, with all its fields. Atoms must have been wrapped into the box. They go
 *  from brick to brick, axis by axis, until none is misplaced anywhere: most need one brick, those that a command has placed
 *  far away several. Collective; an error that one rank holds in @p err already, or meets here, stops all. */
HS_MUST_USE hs_status hs_migrate(hs_atoms *atoms, const hs_domain *domain, const hs_parallel *parallel,
                                 const hs_box *box, hs_error *err);

#endif
