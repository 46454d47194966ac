/* Maps from numbers to colours: dump_modify amap. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "io/color.h"

enum { NAMED_SIZE = 9 };

/** Maps by name, at equal distances. viridis: its lightness grows evenly, and it survives colour-blind eyes and grey
 *  paper (S. van der Walt, N. Smith, public domain). coolwarm: two sides of a middle (K. Moreland 2009,
 *  doi:10.1007/978-3-642-10520-3_9). */
static const struct {
    const char *name;
    hs_color color[NAMED_SIZE];
} named[] = {
    {"viridis", {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725}},
    {"coolwarm", {0x3b4cc0, 0x6282ea, 0x8db0fe, 0xb8d0f9, 0xdddddd, 0xf5c4ad, 0xf49a7b, 0xde604d, 0xb40426}},
    {"gray", {0x202020, 0x393939, 0x525252, 0x6c6c6c, 0x858585, 0x9e9e9e, 0xb7b7b7, 0xd1d1d1, 0xeaeaea}},
};
static const char *const named_words[] = {"viridis", "coolwarm", "gray", "ca", "cf", "da", "df", "sa", "sf", NULL};
enum { N_NAMED = sizeof named / sizeof named[0] };

void hs_color_map_fini(hs_color_map *map)
{
    HS_FREE(map->entry);
    map->n = 0;
}

hs_status hs_color_map_init(hs_color_map *map, hs_error *err)
{
    *map = (hs_color_map){.kind = HS_MAP_CONTINUOUS, .is_fractional = true, .lo = -INFINITY, .hi = INFINITY};
    HS_TRY(HS_ALLOC(map->entry, 2, err));
    map->n = 2;
    map->entry[0] = (hs_map_entry){.lo = -INFINITY, .color = 0x0000ff};
    map->entry[1] = (hs_map_entry){.lo = INFINITY, .color = 0xff0000};
    return HS_OK;
}

/** A number, or min or max. */
static hs_status parse_bound(const hs_args *args, int i, double *bound, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "a bound (a number, min or max)", err));
    *bound = strcmp(args->word[i], "min") == 0 ? -INFINITY : INFINITY;
    if (strcmp(args->word[i], "min") == 0 || strcmp(args->word[i], "max") == 0) return HS_OK;
    return hs_arg_double(args, i, bound, err);
}

static hs_status parse_entry(hs_color_map *map, int k, const hs_color_names *names, const hs_args *args, int *i,
                             hs_error *err)
{
    hs_map_entry *entry = &map->entry[k];
    if (map->kind != HS_MAP_SEQUENTIAL) HS_TRY(parse_bound(args, (*i)++, &entry->lo, err));
    if (map->kind == HS_MAP_DISCRETE) HS_TRY(parse_bound(args, (*i)++, &entry->hi, err));
    HS_TRY(hs_color_parse(names, args, (*i)++, &entry->color, err));
    if (map->kind == HS_MAP_DISCRETE && entry->lo > entry->hi)
        return hs_fail(err, HS_ERROR_INPUT, "%s: amap: entry %d ends below its beginning", args->command, k + 1);
    if (map->kind != HS_MAP_CONTINUOUS) return HS_OK;
    const bool is_first = k == 0, is_last = k == map->n - 1;
    if (is_first != (entry->lo == -INFINITY) || is_last != (entry->lo == INFINITY))
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: amap: the first value of a continuous map must be min and the last max", args->command);
    if (k > 0 && entry->lo <= map->entry[k - 1].lo)
        return hs_fail(err, HS_ERROR_INPUT, "%s: amap: the values of a continuous map must grow", args->command);
    return HS_OK;
}

static hs_status parse_named(hs_color_map *map, int choice, hs_error *err)
{
    map->kind = HS_MAP_CONTINUOUS;
    map->is_fractional = true;
    HS_TRY(HS_ALLOC(map->entry, NAMED_SIZE, err));
    map->n = NAMED_SIZE;
    for (int k = 0; k < NAMED_SIZE; ++k)
        map->entry[k] = (hs_map_entry){.lo = (double)k / (NAMED_SIZE - 1), .color = named[choice].color[k]};
    map->entry[0].lo = -INFINITY;
    map->entry[NAMED_SIZE - 1].lo = INFINITY;
    return HS_OK;
}

static hs_status parse(hs_color_map *map, const hs_color_names *names, const hs_args *args, int *n_used, hs_error *err)
{
    int choice;
    int64_t n;
    HS_TRY(parse_bound(args, 1, &map->lo, err));
    HS_TRY(parse_bound(args, 2, &map->hi, err));
    if (map->lo >= map->hi)
        return hs_fail(err, HS_ERROR_INPUT, "%s: amap: the range from '%s' to '%s' is empty", args->command,
                       args->word[1], args->word[2]);
    HS_TRY(hs_arg_need(args, 3, "the style of the map", err));
    HS_TRY(hs_arg_choice(args, 3, named_words, &choice, err));
    *n_used = 4;
    if (choice < N_NAMED) return parse_named(map, choice, err);
    map->kind = (hs_map_kind)((choice - N_NAMED) / 2);
    map->is_fractional = (choice - N_NAMED) % 2 != 0;
    HS_TRY(hs_arg_need(args, 5, "the bin width and the number of entries", err));
    HS_TRY(hs_arg_positive(args, 4, &map->bin, err));
    HS_TRY(hs_arg_int(args, 5, map->kind == HS_MAP_CONTINUOUS ? 2 : 1, 100000, &n, err));
    HS_TRY(HS_ALLOC(map->entry, (size_t)n, err));
    map->n = (int)n;
    int i = 6;
    for (int k = 0; k < map->n; ++k) HS_TRY(parse_entry(map, k, names, args, &i, err));
    *n_used = i;
    return HS_OK;
}

hs_status hs_color_map_parse(hs_color_map *map, const hs_color_names *names, const hs_args *args, int *n_used,
                             hs_error *err)
{
    hs_color_map fresh = {0};
    const hs_status status = parse(&fresh, names, args, n_used, err);
    if (status != HS_OK) {
        hs_color_map_fini(&fresh);
        return status;
    }
    hs_color_map_fini(map);
    *map = fresh;
    return HS_OK;
}

/** Bound of an entry in the units of values. */
static double place(const hs_color_map *map, double bound, double lo, double hi)
{
    if (isinf(bound)) return bound < 0.0 ? lo : hi;
    return map->is_fractional ? lo + bound * (hi - lo) : bound;
}

static hs_color get_continuous(const hs_color_map *map, double value, double lo, double hi)
{
    for (int k = 1; k < map->n; ++k) {
        const double from = place(map, map->entry[k - 1].lo, lo, hi), to = place(map, map->entry[k].lo, lo, hi);
        if (value > to && k < map->n - 1) continue;
        const double part = to > from ? (value - from) / (to - from) : 0.0;
        return hs_color_mix(map->entry[k - 1].color, map->entry[k].color, part);
    }
    return map->entry[0].color;
}

hs_color hs_color_map_get(const hs_color_map *map, double value, double least, double greatest)
{
    const hs_color none = 0x808080;
    const double lo = isinf(map->lo) ? least : map->lo, hi = isinf(map->hi) ? greatest : map->hi;
    if (isnan(value)) return none;
    value = value < lo ? lo : value > hi ? hi : value;
    if (map->kind == HS_MAP_CONTINUOUS) return get_continuous(map, value, lo, hi);
    if (map->kind == HS_MAP_DISCRETE) {
        for (int k = 0; k < map->n; ++k)
            if (value >= place(map, map->entry[k].lo, lo, hi) && value <= place(map, map->entry[k].hi, lo, hi))
                return map->entry[k].color;
        return none;
    }
    const double bin = map->is_fractional ? map->bin * (hi - lo) : map->bin;
    const double number = bin > 0.0 ? floor((value - lo) / bin) : 0.0;
    return map->entry[(int)fmod(number, (double)map->n)].color;
}
