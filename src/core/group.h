/** Groups: named subsets of atoms, one bit each. */
#ifndef HS_CORE_GROUP_H
#define HS_CORE_GROUP_H

#include <stdint.h>

#include "base/error.h"

/** As in LAMMPS: the bits of a 32-bit mask. Group 0 is "all". */
enum { HS_GROUPS_MAX = 32 };

typedef struct hs_groups {
    char *name[HS_GROUPS_MAX]; /**< owned; NULL for a free bit */
    uint32_t dynamic;          /**< bits of groups whose members are chosen anew during runs */
} hs_groups;

HS_MUST_USE hs_status hs_groups_init(hs_groups *groups, hs_error *err);
void hs_groups_fini(hs_groups *groups);
/** Bit number of a group, or -1. */
int hs_groups_find(const hs_groups *groups, const char *name);
/** Bit number of a group; an error naming the nearest group when there is none. */
HS_MUST_USE hs_status hs_groups_get(const hs_groups *groups, const char *name, int *bit, hs_error *err);
/** Bit number of a group, made if new; an error when all 32 are taken or the name is empty or has blanks,
 *  quotes, brackets, commas or any of $ & # *. */
HS_MUST_USE hs_status hs_groups_add(hs_groups *groups, const char *name, int *bit, hs_error *err);
void hs_groups_remove(hs_groups *groups, int bit);
static inline uint32_t hs_group_mask(int bit) { return UINT32_C(1) << bit; }

#endif
