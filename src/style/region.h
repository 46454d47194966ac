/** Interface of regions: subsets of space. One region style is one file in src/region/. */
#ifndef HS_STYLE_REGION_H
#define HS_STYLE_REGION_H

#include "style/args.h"
#include "style/env.h"

struct hs_region;

typedef struct hs_region_style {
    hs_description about;   /**< syntax of the style's own words; side, units, ... are common to all (style/region.c) */
    size_t state_size;
    /** args: the style's own words, lengths still in the deck's units; hs_region_scale() converts them. Sets
     *  region->extent and has_extent. */
    HS_MUST_USE hs_status (*create)(struct hs_region *region, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_region *region);
    /** Whether x is inside the shape, its surface included (side is applied by hs_region_contains). */
    bool (*inside)(const struct hs_region *region, const double x[3]);
} hs_region_style;

typedef struct hs_region {
    const hs_region_style *style;
    char *id;             /**< owned by hs_sim */
    hs_env *env;
    void *state;
    bool is_outside;      /**< side out: the complement */
    double scale[3];      /**< units lattice: spacings; units box: 1 */
    bool has_extent;      /**< bounded: extent holds it */
    double extent[3][2];  /**< bounding box [axis][lo, hi], distance */
} hs_region;

/** Whether the region holds x, with side in or out. */
bool hs_region_contains(const hs_region *region, const double x[3]);

extern const hs_region_style *const hs_region_styles[];

#endif
