/** Numbers by atom id: a hash table of this rank's own, for readers of files that name atoms in any order. */
#ifndef HS_IO_ID_MAP_H
#define HS_IO_ID_MAP_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/** Zeroed it is empty. */
typedef struct hs_id_map {
    struct hs_id_map_slot {
        int64_t id; /**< 0: free; ids are 1 or more */
        int32_t value;
    } * slot;        /**< owned [capacity] */
    size_t capacity; /**< a power of two */
    size_t n;
} hs_id_map;

void hs_id_map_fini(hs_id_map *map);
/** The value of an id, NULL when it has none; borrowed until the next one is added. */
int32_t *hs_id_map_find(const hs_id_map *map, int64_t id);
/** Give an id that has none a value. */
HS_MUST_USE hs_status hs_id_map_add(hs_id_map *map, int64_t id, int32_t value, hs_error *err);

#endif
