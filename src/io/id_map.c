#include "io/id_map.h"

#include "base/memory.h"

void hs_id_map_fini(hs_id_map *map)
{
    HS_FREE(map->slot);
    *map = (hs_id_map){0};
}

/** The slot that holds the id, or the free one that it would get. */
static size_t place_of(const hs_id_map *map, int64_t id)
{
    const size_t last = map->capacity - 1;
    size_t at = (size_t)(((uint64_t)id * UINT64_C(0x9e3779b97f4a7c15)) >> 20) & last;
    while (map->slot[at].id != 0 && map->slot[at].id != id) at = (at + 1) & last;
    return at;
}

int32_t *hs_id_map_find(const hs_id_map *map, int64_t id)
{
    if (map->capacity == 0) return NULL;
    struct hs_id_map_slot *slot = &map->slot[place_of(map, id)];
    return slot->id == id ? &slot->value : NULL;
}

static hs_status grow(hs_id_map *map, hs_error *err)
{
    hs_id_map larger = {.capacity = map->capacity > 0 ? 2 * map->capacity : 1024, .n = map->n};
    HS_TRY(HS_ALLOC(larger.slot, larger.capacity, err));
    for (size_t k = 0; k < map->capacity; ++k)
        if (map->slot[k].id != 0) larger.slot[place_of(&larger, map->slot[k].id)] = map->slot[k];
    HS_FREE(map->slot);
    *map = larger;
    return HS_OK;
}

hs_status hs_id_map_add(hs_id_map *map, int64_t id, int32_t value, hs_error *err)
{
    if (2 * (map->n + 1) > map->capacity) HS_TRY(grow(map, err));
    struct hs_id_map_slot *slot = &map->slot[place_of(map, id)];
    slot->id = id;
    slot->value = value;
    ++map->n;
    return HS_OK;
}
