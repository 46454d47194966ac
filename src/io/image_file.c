/* Pictures in files: PNG through libpng, and PPM, which needs no library. */
#include <png.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "io/image.h"

static bool ends_in(const char *path, const char *ending)
{
    const size_t n = strlen(path), m = strlen(ending);
    return n > m && strcasecmp(path + n - m, ending) == 0;
}

bool hs_image_is_known(const char *path) { return ends_in(path, ".png") || ends_in(path, ".ppm"); }

static void get_row(const hs_image *image, int row, unsigned char *bytes)
{
    for (int column = 0; column < image->width; ++column) {
        const hs_color color = hs_image_pixel(image, column, row);
        for (int k = 0; k < 3; ++k) bytes[3 * column + k] = (unsigned char)(color >> (16 - 8 * k) & 255);
    }
}

static hs_status write_ppm(const hs_image *image, unsigned char *row, hs_writer *writer, hs_error *err)
{
    HS_TRY(hs_writer_printf(writer, err, "P6\n%d %d\n255\n", image->width, image->height));
    for (int k = 0; k < image->height; ++k) {
        get_row(image, k, row);
        HS_TRY(hs_writer_bytes(writer, (const char *)row, 3 * (size_t)image->width, err));
    }
    return HS_OK;
}

/** Where libpng's output goes, and the error of that. */
typedef struct png_target {
    hs_writer *writer;
    hs_error *err;
    hs_status status;
} png_target;

static void put_bytes(png_structp png, png_bytep bytes, size_t n)
{
    png_target *target = png_get_io_ptr(png);
    if (target->status == HS_OK) target->status = hs_writer_bytes(target->writer, (const char *)bytes, n, target->err);
}

static void flush_nothing(png_structp png) { (void)png; }

/** libpng's errors come back here by a long jump; nothing is allocated in between. */
static hs_status write_png(const hs_image *image, unsigned char *row, hs_writer *writer, hs_error *err)
{
    png_target target = {.writer = writer, .err = err, .status = HS_OK};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    if (info == NULL) {
        png_destroy_write_struct(&png, NULL);
        return hs_fail(err, HS_ERROR_MEMORY, "the PNG library could not be started");
    }
    if (setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_write_struct(&png, &info);
        return target.status != HS_OK ? target.status : hs_fail(err, HS_ERROR_IO, "the picture could not be encoded");
    }
    png_set_write_fn(png, &target, put_bytes, flush_nothing);
    png_set_user_limits(png, HS_IMAGE_SIZE_MAX, HS_IMAGE_SIZE_MAX);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (int k = 0; k < image->height; ++k) {
        get_row(image, k, row);
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return target.status;
}

hs_status hs_image_write(const hs_image *image, const char *path, hs_writer *writer, hs_error *err)
{
    unsigned char *row;
    HS_TRY(HS_ALLOC(row, 3 * (size_t)image->width, err));
    const hs_status status =
        ends_in(path, ".ppm") ? write_ppm(image, row, writer, err) : write_png(image, row, writer, err);
    HS_FREE(row);
    return status;
}
