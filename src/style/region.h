/** Interface of regions: subsets of space. One region style is one file in src/region/. */
#ifndef HS_STYLE_REGION_H
#define HS_STYLE_REGION_H

#include "style/args.h"
#include "style/env.h"

struct hs_region;

/** A surface near a point. */
typedef struct hs_contact {
    double r;       /**< distance from the surface, >= 0 */
    double away[3]; /**< unit vector from the surface to the point */
} hs_contact;
enum { HS_CONTACTS_MAX = 6 };

typedef struct hs_region_style {
    hs_description about; /**< syntax of the style's own words; side, units, ... are common to all (style/region.c) */
    size_t state_size;    /**< bytes of private state, allocated zeroed before create, freed after destroy */
    /** args: the style's own words (common keywords taken off), lengths still in the deck's units: multiply them with
     *  region->scale. Sets region->extent and has_extent of the shape itself. */
    HS_MUST_USE hs_status (*create)(struct hs_region *region, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_region *region); /**< free what create allocated; NULL: nothing */
    /** Sizes that follow variables have new values, region->size[].value: take them over; false: they make no shape.
     *  Also part of create. NULL: the style has none. */
    bool (*fit)(struct hs_region *region);
    /** Bring the regions that this one is made of up to the present step (collective); NULL: it is made of none. */
    HS_MUST_USE hs_status (*update)(struct hs_region *region, hs_error *err);
    /** Whether x is inside the shape, its surface included (side is applied by hs_region_contains). */
    bool (*inside)(const struct hs_region *region, const double x[3]);
    /** Surfaces nearer than cutoff to a point x that the region (with its side in or out) contains: fills contact[],
     *  gives their number. NULL: the region cannot be a wall. In two dimensions surfaces across z do not count. */
    int (*surfaces)(const struct hs_region *region, const double x[3], double cutoff, hs_contact *contact);
    /** Whether this region is made of that one; NULL: of none. */
    bool (*uses)(const struct hs_region *region, const struct hs_region *other);
} hs_region_style;

/** A length of a shape: constant, or following an equal-style variable. */
typedef struct hs_region_size {
    char *variable; /**< owned; NULL: constant */
    double scale;   /**< distance of one unit of the variable */
    double value;   /**< now, distance */
} hs_region_size;
enum { HS_REGION_SIZES_MAX = 4 };

/** How a region moves: turned about an axis, then displaced. */
typedef struct hs_region_motion {
    char *move[3];            /**< owned; variables of the displacement, distance; NULL: none along this axis */
    char *angle;              /**< owned; variable of the angle, radians; NULL: it does not turn */
    double point[3], axis[3]; /**< a place on the axis, distance; its direction, of length 1 */
    double d[3];              /**< displacement now */
    double turn[3][3];        /**< the rotation now: turned = turn x */
} hs_region_motion;

typedef struct hs_region {
    const hs_region_style *style;
    char *id;            /**< owned by hs_sim */
    hs_env *env;         /**< borrowed */
    void *state;         /**< style's own */
    bool is_outside;     /**< side out: the complement */
    double scale[3];     /**< units lattice: spacings; units box: 1 */
    bool has_extent;     /**< bounded (never with side out): extent holds it */
    double extent[3][2]; /**< bounding box [axis][lo, hi], distance */
    bool is_prism; /**< it can be a tilted box, with these bounds before tilting, and tilts xy, xz, yz, distance: */
    double prism_lo[3], prism_hi[3], prism_tilt[3];
    hs_region_size size[HS_REGION_SIZES_MAX]; /**< of styles whose lengths may follow variables */
    int n_sizes;
    hs_region_motion *motion; /**< owned; NULL: it stays where it is */
    bool is_varying;          /**< place or shape follow variables: hs_region_update before each use; no extent */
    double edge[6];           /**< what the words EDGE stood for, one after the other: a checkpoint keeps them */
    int n_edges;
} hs_region;

/** Whether the region holds x, with side in or out. */
bool hs_region_contains(const hs_region *region, const double x[3]);
/** Surfaces near a point that it contains, as style->surfaces, which must not be NULL. */
int hs_region_surfaces(const hs_region *region, const double x[3], double cutoff, hs_contact *contact);
/** Bring place and shape to the present step, before a region is asked for atoms (collective). */
HS_MUST_USE hs_status hs_region_update(hs_region *region, hs_error *err);
/** Fail, naming who asks, unless the variables that it follows are there and of style equal. */
HS_MUST_USE hs_status hs_region_check_variables(const hs_region *region, const char *who, hs_error *err);

/** Whether it holds local atom i. */
static inline bool hs_region_has(const hs_region *region, const hs_atoms *atoms, int i)
{
    const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    return hs_region_contains(region, x);
}

/** Where a style acts: in the region of that name, or everywhere. Zero-initialised: everywhere. */
typedef struct hs_where {
    char *id;          /**< owned; NULL: everywhere */
    hs_region *region; /**< borrowed; found anew before each use or run */
} hs_where;

/** Name the region, in the place of one that was named before. The ID is copied; hs_where_fini frees it. */
HS_MUST_USE hs_status hs_where_set(hs_where *where, const char *id, hs_error *err);
/** Everywhere again. */
void hs_where_fini(hs_where *where);
/** Find the region as it is now. When there is none, the message names @p who asks for it (hs_fix_who and the like). */
HS_MUST_USE hs_status hs_where_find(hs_where *where, hs_env *env, const char *who, hs_error *err);
/** Bring the region to the present step: before atoms are looked for (collective). */
static inline hs_status hs_where_update(const hs_where *where, hs_error *err)
{
    return where->region != NULL && where->region->is_varying ? hs_region_update(where->region, err) : HS_OK;
}
/** Whether local atom i is there. */
static inline bool hs_where_has(const hs_where *where, const hs_atoms *atoms, int i)
{
    return where->region == NULL || hs_region_has(where->region, atoms, i);
}

/** Note a contact at the distance |d| along d, from the surface to the point, when it is below cutoff; *n counts. */
void hs_region_touch(const double d[3], double cutoff, hs_contact *contact, int *n);

/** Whether @p region refers to @p other, which must then outlive it. */
bool hs_region_uses(const hs_region *region, const hs_region *other);

/** A new region from the words after `region ID style`: the style's own, then the common keywords. Not yet in any list:
 *  the caller keeps it and gives it to hs_region_destroy. The ID is copied. Not collective. */
HS_MUST_USE hs_status hs_region_create(hs_region **region, hs_env *env, const char *id, const char *style,
                                       const hs_args *args, hs_error *err);
/** Free a region and clear the pointer; NULL is fine. */
void hs_region_destroy(hs_region **region);
/** First-pass check of `style words... keywords...`: style name, counts, keywords. */
HS_MUST_USE hs_status hs_region_check(const hs_args *args, bool has_variables, hs_error *err);

/** The next size: a length in the units of an axis, or v_name. region->size[n_sizes - 1] is it then. */
HS_MUST_USE hs_status hs_region_add_size(hs_region *region, const hs_args *args, int i, int axis, hs_error *err);
/** Take over sizes in create: those that follow variables have no values yet. Word @p i is the one to blame. */
HS_MUST_USE hs_status hs_region_fit(hs_region *region, const hs_args *args, int i, const char *expected, hs_error *err);
/** Read the keywords move and rotate with the words after them. Part of hs_region_create, as the end. */
HS_MUST_USE hs_status hs_region_read_motion(hs_region *region, const hs_args *args, int i, hs_error *err);
void hs_region_fini_motion(hs_region *region);
/** Length in the units of an axis; a variable (`v_name`) is refused by name. */
HS_MUST_USE hs_status hs_region_length(const hs_region *region, const hs_args *args, int i, int axis, double *value,
                                       hs_error *err);
/** Lower (end 0) or upper (end 1) bound of an axis: a length, INF (the far distance), or EDGE (the box's face). */
HS_MUST_USE hs_status hs_region_bound(hs_region *region, const hs_args *args, int i, int axis, int end, double *value,
                                      hs_error *err);

/** What INF stands for: farther than any atom, distance. */
#define HS_REGION_FAR 1.0e20

/** All region styles, ended by NULL; made by the build. */
extern const hs_region_style *const hs_region_styles[];

#endif
