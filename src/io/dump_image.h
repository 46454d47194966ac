/** What dump image draws: atoms, the box and its axes. */
#ifndef HS_IO_DUMP_IMAGE_H
#define HS_IO_DUMP_IMAGE_H

#include "io/dump_table.h"
#include "io/image.h"

typedef enum { HS_LOOK_TYPE, HS_LOOK_VALUE, HS_LOOK_SPEED, HS_LOOK_ORIENTATION } hs_look_by;

typedef struct hs_dump_image {
    hs_dump_table table; /**< schedule, selection, names of files; must be first */
    hs_look_by color_by, diameter_by;
    bool has_atoms, has_box, has_axes, is_smooth, center_moves;
    int width, height;     /**< pixels */
    double theta, phi;     /**< direction from which one looks, degrees */
    double up[3];          /**< direction that points upwards */
    double center[3];      /**< middle of the picture, fractions of the box */
    double zoom, shine;    /**< 1 shows the whole box; strength of highlights */
    double diameter;       /**< of all atoms, distance; 0: as the second word says */
    double box_diameter;   /**< fraction of the shortest edge of the box */
    double axes[2];        /**< length and diameter, fractions of the box's edges and of its shortest */
    hs_color *type_color;  /**< owned [n_types + 1] */
    double *type_diameter; /**< owned [n_types + 1], distance */
    hs_color background, box_color;
    hs_color_names names;
    hs_color_map map;
    bool has_view; /**< the view is kept from the first picture on (center s) */
    hs_image_view view;
    const hs_image *picture; /**< while it is being written */
} hs_dump_image;

/** Least and greatest value that colours go by, over all ranks' selected atoms (collective). */
void hs_dump_image_find_range(const hs_dump *dump, double range[2]);
/** Draw what this rank has, seen as state->view says; on rank 0 also what belongs to none. Not collective: the pictures
 *  are to be merged. */
HS_MUST_USE hs_status hs_dump_image_draw(hs_dump *dump, hs_image *image, const double range[2], hs_error *err);

#endif
