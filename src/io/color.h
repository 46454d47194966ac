/** Colours of pictures: names, and maps from numbers to colours. */
#ifndef HS_IO_COLOR_H
#define HS_IO_COLOR_H

#include <stdint.h>

#include "style/args.h"

/** 0xRRGGBB, eight bits each as screens have them (sRGB). */
typedef uint32_t hs_color;

hs_color hs_color_mix(hs_color a, hs_color b, double part_of_b); /**< part_of_b from 0 to 1 */
hs_color hs_color_of(double red, double green, double blue);     /**< from 0 to 1 each */
/** Colour of a hue, a part of a turn: 0 red, 1/3 green, 2/3 blue; all of like lightness. */
hs_color hs_color_of_hue(double hue);

typedef struct hs_color_name {
    char *name; /**< owned */
    hs_color color;
} hs_color_name;

/** Names that a deck adds to the 140 of the web. */
typedef struct hs_color_names {
    hs_color_name *entry; /**< owned */
    int n;
} hs_color_names;

void hs_color_names_fini(hs_color_names *names);
HS_MUST_USE hs_status hs_color_names_add(hs_color_names *names, const char *name, hs_color color, hs_error *err);
/** The colour that word i names; an error with the nearest name otherwise. */
HS_MUST_USE hs_status hs_color_parse(const hs_color_names *names, const hs_args *args, int i, hs_color *color,
                                     hs_error *err);

typedef enum { HS_MAP_CONTINUOUS, HS_MAP_DISCRETE, HS_MAP_SEQUENTIAL } hs_map_kind;

/** One entry of a map. Bounds are numbers, or fractions of the map's range. */
typedef struct hs_map_entry {
    double lo, hi; /**< -INFINITY and INFINITY stand for min and max; continuous maps use lo only */
    hs_color color;
} hs_map_entry;

/** How numbers become colours: dump_modify amap. */
typedef struct hs_color_map {
    hs_map_kind kind;
    bool is_fractional;
    double lo, hi; /**< -INFINITY: the least value there is; INFINITY: the greatest */
    double bin;    /**< sequential: width of a bin */
    hs_map_entry *entry;
    int n; /**< owned [n] */
} hs_color_map;

/** From blue to red over the values there are. */
HS_MUST_USE hs_status hs_color_map_init(hs_color_map *map, hs_error *err);
void hs_color_map_fini(hs_color_map *map);
/** amap <lo> <hi> <style> <delta> <N> <entries>, or amap <lo> <hi> <name of a map>; *n_used words from word 0. */
HS_MUST_USE hs_status hs_color_map_parse(hs_color_map *map, const hs_color_names *names, const hs_args *args,
                                         int *n_used, hs_error *err);
/** Colour of a value, when all values lie between @p least and @p greatest. Not a number: grey. */
hs_color hs_color_map_get(const hs_color_map *map, double value, double least, double greatest);

#endif
