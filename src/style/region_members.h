/** Regions made of other regions: what union and intersect have in common. Their state begins with
 *  hs_region_members. */
#ifndef HS_STYLE_REGION_MEMBERS_H
#define HS_STYLE_REGION_MEMBERS_H

#include "style/region.h"

/** The members, borrowed: hs_sim keeps a region for as long as another one refers to it. */
typedef struct hs_region_members {
    hs_region **region; /**< owned array [n] */
    int n;
} hs_region_members;

/** Read "<N> <ID> ..." into the region's state. */
HS_MUST_USE hs_status hs_region_members_read(hs_region *region, const hs_args *args, hs_error *err);
/** Hook `destroy`. */
void hs_region_members_destroy(hs_region *region);
/** Hook `update`. */
HS_MUST_USE hs_status hs_region_members_update(hs_region *region, hs_error *err);
/** Hook `uses`. */
bool hs_region_members_use(const hs_region *region, const hs_region *other);

#endif
