/** Pictures of balls and sticks, drawn by every rank of its own atoms and merged by depth.
 *
 *  A pixel is one 64-bit number, depth above colour, so that "nearer wins" is the maximum of two numbers: the picture
 *  does not depend on the order of drawing, nor on the number of threads and ranks. */
#ifndef HS_IO_IMAGE_H
#define HS_IO_IMAGE_H

#include "core/box.h"
#include "io/color.h"
#include "io/writer.h"
#include "parallel/parallel.h"

enum { HS_IMAGE_SIZE_MAX = 32768 };

typedef struct hs_image {
    int width, height; /**< of the finished picture, pixels */
    int sampling;      /**< samples along each edge of a pixel: 1, or 2 for smooth edges */
    int64_t *sample;   /**< owned [height * sampling][width * sampling] */
    bool is_flat;      /**< discs of one colour with a rim instead of shaded balls: pictures of two dimensions */
    double shine;      /**< strength of highlights, 0 to 1 */
} hs_image;

/** Parallel projection from space to samples: x to the right, y down, z towards the viewer. */
typedef struct hs_image_view {
    double center[3];  /**< the point of space in the middle of the picture */
    double axis[3][3]; /**< unit vectors of space along the picture's x, up, and towards the viewer */
    double scale;      /**< samples for a unit of distance */
    double middle[2];  /**< sample coordinates of the center */
} hs_image_view;

/** A ball in sample coordinates. */
typedef struct hs_image_ball {
    double x, y, z, radius;
    hs_color color;
} hs_image_ball;

/** Allocate, all background. The caller frees it with hs_image_fini. */
HS_MUST_USE hs_status hs_image_init(hs_image *image, int width, int height, int sampling, hs_color background,
                                    hs_error *err);
void hs_image_fini(hs_image *image);

/** A view from the direction theta, phi (degrees, from z and from x in the plane) with @p up as near to upwards as can
 *  be, that shows the whole box at zoom 1; @p center as fractions of the box. */
hs_image_view hs_image_look(const hs_image *image, const hs_box *box, double theta, double phi, const double up[3],
                            const double center[3], double zoom);
void hs_image_project(const hs_image_view *view, const double x[3], double sample[3]);

/** Draw balls (threaded). */
void hs_image_draw_balls(hs_image *image, const hs_image_ball *ball, int n);
/** Draw a stick with round ends between two points in sample coordinates. */
void hs_image_draw_stick(hs_image *image, const double from[3], const double to[3], double radius, hs_color color);
/** Nearest samples of all ranks, on all ranks (collective). */
void hs_image_merge(hs_image *image, const hs_parallel *parallel);
/** Colour of a finished pixel, the mean of its samples. */
hs_color hs_image_pixel(const hs_image *image, int column, int row);

/** Formats by the ending of a name: .png, .ppm. */
bool hs_image_is_known(const char *path);
/** Encode into a writer, in the format that @p path ends in. Not collective. */
HS_MUST_USE hs_status hs_image_write(const hs_image *image, const char *path, hs_writer *writer, hs_error *err);

#endif
