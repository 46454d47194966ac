/* dump image: discs and balls in their places and colours, the nearer one in front, the same bytes from any number of
 * threads, and what is refused. */
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "io/color.h"
#include "support/harness.h"
#include "support/run_deck.h"

static const char flat_head[] = "dimension 2\nregion b block 0 10 0 10 -0.5 0.5\ncreate_box 2 b\nmass * 1\n"
                                "pair_style zero 1\npair_coeff * *\n";
static const char deep_head[] = "region b block 0 10 0 10 0 10\ncreate_box 2 b\nmass * 1\n"
                                "pair_style zero 1\npair_coeff * *\n";

static void run(const char *head, const char *lines, int n_threads, hs_error *err)
{
    char deck[8192];
    hs_options options = {.n_threads = n_threads};
    snprintf(deck, sizeof deck, "%s%s", head, lines);
    free(hs_test_run_deck_with(deck, &options, NULL, NULL, err));
}

static void run_good(const char *head, const char *lines)
{
    hs_error err = {0};
    run(head, lines, 1, &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
}

static void expect_error(const char *lines, const char *text)
{
    hs_error err = {0};
    run(flat_head, lines, 1, &err);
    ck_assert_msg(err.status == HS_ERROR_INPUT, "no error for: %s", lines);
    ck_assert_msg(strstr(err.text, text) != NULL, "expected '%s' in '%s'", text, err.text);
}

/** A picture read back, by libpng, or as PPM. */
typedef struct picture {
    int width, height;
    unsigned char *rgb;
} picture;

static picture read_ppm(const char *name)
{
    picture p;
    FILE *file = fopen(name, "rb");
    ck_assert_msg(file != NULL, "%s is missing", name);
    ck_assert_int_eq(fscanf(file, "P6 %d %d 255", &p.width, &p.height), 2);
    ck_assert_int_eq(fgetc(file), '\n');
    const size_t n = 3 * (size_t)p.width * (size_t)p.height;
    p.rgb = malloc(n);
    ck_assert_uint_eq(fread(p.rgb, 1, n, file), n);
    ck_assert_int_eq(fgetc(file), EOF);
    fclose(file);
    return p;
}

static picture read_png(const char *name)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    ck_assert_msg(png_image_begin_read_from_file(&image, name) != 0, "%s: %s", name, image.message);
    image.format = PNG_FORMAT_RGB;
    picture p = {.width = (int)image.width, .height = (int)image.height, .rgb = malloc(PNG_IMAGE_SIZE(image))};
    ck_assert(png_image_finish_read(&image, NULL, p.rgb, 0, NULL) != 0);
    return p;
}

static int pixel(const picture *p, int column, int row)
{
    const unsigned char *at = p->rgb + 3 * (row * p->width + column);
    return at[0] << 16 | at[1] << 8 | at[2];
}

#define PLAIN " fsaa no box no 0.1 size 100 100"

START_TEST(one_disc)
{
    hs_test_enter_folder();
    run_good(flat_head, "create_atoms 1 single 2.5 7.5 0\ndump d all image 1 a.*.ppm type type adiam 1" PLAIN "\n"
                        "dump_modify d backcolor white acolor 1 blue\nrun 0\n");
    picture p = read_ppm("a.0.ppm");
    ck_assert_int_eq(p.width, 100);
    /* 9.5 pixels to a length (the box fills 95 of 100), so the middle is at 50 -+ 9.5 * 2.5 and the radius 4.75 */
    const double x = 26.25, y = 26.25, radius = 4.75;
    for (int row = 0; row < 100; ++row)
        for (int column = 0; column < 100; ++column)
            ck_assert_int_eq(pixel(&p, column, row),
                             hypot(column + 0.5 - x, row + 0.5 - y) <= radius ? 0x0000ff : 0xffffff);
    free(p.rgb);
    hs_test_leave_folder();
}
END_TEST

START_TEST(smooth_edges_and_rims)
{
    hs_test_enter_folder();
    run_good(flat_head,
             "create_atoms 2 single 5 5 0\ndump d all image 1 a.*.png type type adiam 4 box no 0.1 size 100 100\n"
             "run 0\n");
    picture p = read_png("a.0.png");
    ck_assert_int_eq(pixel(&p, 50, 50), 0x008000); /* the second type's colour, and black around it */
    ck_assert_int_eq(pixel(&p, 2, 2), 0x000000);
    ck_assert_int_eq(pixel(&p, 50 + 18, 50), 0x005300); /* the rim: 65 % of 0x80 */
    int n_between = 0;
    for (int k = 0; k < 100 * 100; ++k) {
        const int color = pixel(&p, k % 100, k / 100);
        n_between += color != 0x008000 && color != 0x005300 && color != 0;
    }
    ck_assert_int_gt(n_between, 50); /* two circles of 120 and 100 pixels around: many are cut */
    free(p.rgb);
    hs_test_leave_folder();
}
END_TEST

START_TEST(nearer_balls_hide_others)
{
    static const struct {
        const char *view;
        int red, green;
    } cases[] = {{"0 0", 0, 1}, {"180 0", 1, 0}};
    for (int k = 0; k < 2; ++k) {
        char lines[512];
        hs_test_enter_folder();
        snprintf(lines, sizeof lines,
                 "create_atoms 1 single 5 5 2\ncreate_atoms 2 single 5 5 8\n"
                 "dump d all image 1 a.*.png type type view %s adiam 3 box no 0.1 size 64 64\nrun 0\n",
                 cases[k].view);
        run_good(deep_head, lines);
        picture p = read_png("a.0.png");
        const int color = pixel(&p, 32, 32);
        ck_assert_int_eq((color >> 16) > 100, cases[k].red);
        ck_assert_int_eq((color >> 8 & 255) > 100 && (color >> 16) < 100, cases[k].green);
        /* lit from the upper left: brighter there than at the lower right */
        const int shift = cases[k].red ? 16 : 8;
        ck_assert_int_gt(pixel(&p, 29, 29) >> shift & 255, pixel(&p, 37, 37) >> shift & 255);
        free(p.rgb);
        hs_test_leave_folder();
    }
}
END_TEST

START_TEST(box_and_axes)
{
    hs_test_enter_folder();
    run_good(flat_head, "dump d all image 1 a.*.png type type fsaa no box yes 0.04 axes yes 0.5 0.04 size 200 200\n"
                        "dump_modify d boxcolor white backcolor navy\nrun 0\n");
    picture p = read_png("a.0.png");
    ck_assert_int_eq(pixel(&p, 195, 100), 0xffffff); /* the right edge, 95 pixels from the middle and four wide */
    ck_assert_int_eq(pixel(&p, 100, 5), 0xffffff);
    ck_assert_int_eq(pixel(&p, 100, 100), 0x000080);
    ck_assert_int_eq(pixel(&p, 5, 50), 0xffffff); /* the left edge above the axis y */
    ck_assert_int_ne(pixel(&p, 5, 150), 0x000080);
    free(p.rgb);
    hs_test_leave_folder();
}
END_TEST

START_TEST(colors_of_numbers)
{
    hs_test_enter_folder();
    /* x from 1 to 9: the ends of the map, its middle, and a region and a threshold that leave atoms out */
    run_good(flat_head, "create_atoms 1 single 1 5 0\ncreate_atoms 1 single 5 5 0\ncreate_atoms 1 single 9 5 0\n"
                        "create_atoms 1 single 5 8 0\nregion low block INF INF 0 6 INF INF\n"
                        "dump d all image 1 a.*.ppm x type" PLAIN "\ndump_modify d region low\n"
                        "dump e all image 1 b.*.ppm x type" PLAIN "\n"
                        "dump_modify e color mine 0.2 0.4 0.6 thresh x < 8 amap 0 10 sa 2 2 mine white\n"
                        "dump f all image 1 c.*.ppm y type" PLAIN "\n"
                        "dump_modify f amap min max df 1 2 0 0.5 gold min max tan\n"
                        "dump g all image 1 d.*.ppm x type" PLAIN "\ndump_modify g amap min max viridis\nrun 0\n");
    const int left = 12, middle = 50, right = 88, high = 21; /* 50 -+ 9.5 * 4, 50 - 9.5 * 3 */
    picture a = read_ppm("a.0.ppm"), b = read_ppm("b.0.ppm"), c = read_ppm("c.0.ppm"), d = read_ppm("d.0.ppm");
    ck_assert_int_eq(pixel(&a, left, 50), 0x0000ff);
    ck_assert_int_eq(pixel(&a, middle, 50), 0x800080);
    ck_assert_int_eq(pixel(&a, right, 50), 0xff0000);
    ck_assert_int_eq(pixel(&a, middle, high), 0x000000);
    ck_assert_int_eq(pixel(&b, left, 50), 0x336699); /* bins 0 and 2 */
    ck_assert_int_eq(pixel(&b, middle, 50), 0x336699);
    ck_assert_int_eq(pixel(&b, right, 50), 0x000000);
    ck_assert_int_eq(pixel(&c, middle, 50), 0xffd700);
    ck_assert_int_eq(pixel(&c, middle, high), 0xd2b48c);
    ck_assert_int_eq(pixel(&d, left, 50), 0x440154);
    ck_assert_int_eq(pixel(&d, right, 50), 0xfde725);
    free(a.rgb), free(b.rgb), free(c.rgb), free(d.rgb);
    hs_test_leave_folder();
}
END_TEST

static void expect_same_files(const char *a, const char *b)
{
    FILE *first = fopen(a, "rb"), *second = fopen(b, "rb");
    int byte;
    ck_assert(first != NULL && second != NULL);
    do {
        byte = fgetc(first);
        ck_assert_int_eq(byte, fgetc(second));
    } while (byte != EOF);
    fclose(first);
    fclose(second);
}

START_TEST(any_number_of_threads)
{
    static const char head[] =
        "lattice fcc 0.8\nregion b block 0 6 0 6 0 6\ncreate_box 1 b\ncreate_atoms 1 box\nmass 1 1\n"
        "velocity all create 1.4 8728\npair_style lj/cut 2.5\npair_coeff 1 1 1 1\nfix 1 all nve\n";
    hs_test_enter_folder();
    for (int n_threads = 1; n_threads <= 3; ++n_threads) {
        hs_error err = {0};
        char lines[256];
        snprintf(lines, sizeof lines, "dump d all image 5 t%d.*.png speed type adiam 1.1 view 65 25\nrun 5\n",
                 n_threads);
        run(head, lines, n_threads, &err);
        ck_assert_msg(err.status == HS_OK, "%s", err.text);
    }
    expect_same_files("t1.0.png", "t2.0.png");
    expect_same_files("t1.0.png", "t3.0.png");
    hs_test_leave_folder();
}
END_TEST

START_TEST(one_picture)
{
    hs_test_enter_folder();
    run_good(flat_head, "create_atoms 1 single 5 5 0\nwrite_dump all image now.png type type adiam 4 size 20 30\n");
    picture p = read_png("now.png");
    ck_assert_int_eq(p.width, 20);
    ck_assert_int_eq(p.height, 30);
    ck_assert_int_eq(pixel(&p, 10, 15), 0xff0000);
    free(p.rgb);
    hs_test_leave_folder();
}
END_TEST

START_TEST(refused)
{
    static const char dump[] = "dump d all image 1 a.*.png type type\n";
    char lines[512];
    static const char *const modifications[][2] = {
        {"acolor 1 redd", "'redd' is not the name of a colour (dump_modify color makes new ones); did you mean 'red'?"},
        {"acolor 3 red", "3"},
        {"adiam 1 0", "greater than 0"},
        {"amap 0 1 cx 1 2 min red max blue", "'cx' is not one of"},
        {"amap 1 0 viridis", "the range from '1' to '0' is empty"},
        {"amap 0 1 ca 1 2 0 red max blue", "must be min and the last max"},
        {"color sky 0.2 2 1", "'2' is not a part from 0 to 1"},
        {"format line \"%d\"", "'format' is not a keyword of dumps of style image"},
    };
    hs_test_enter_folder();
    for (size_t k = 0; k < sizeof modifications / sizeof modifications[0]; ++k) {
        snprintf(lines, sizeof lines, "%sdump_modify d %s\n", dump, modifications[k][0]);
        expect_error(lines, modifications[k][1]);
    }
    expect_error("dump d all image 1 a.*.jpg type type\n", "should end in .png or .ppm");
    expect_error("dump d all image 1 a.png type type\nrun 0\n", "needs a *, which becomes the step");
    expect_error("dump d all image 1 a.*.png typ type\n", "'typ'; did you mean 'type'?");
    expect_error("dump d all image 1 a.*.png element type\n", "'element' is not supported");
    expect_error("dump d all image 1 a.*.png type type zom 2\n", "did you mean 'zoom'?");
    expect_error("dump d all image 1 a.*.png type type bond atom 1\n", "'bond'");
    expect_error("dump d all image 1 a.*.png type type size 0 100\n", "'0' is not a whole number from 1 to 32768");
    expect_error("dump d all image 1 a.*.png type type view 200 0\n", "an angle from 0 to 180 degrees");
    expect_error("dump d all image 1 a.*.png type type up 0 0 0\n", "up 0 0 0 is no direction");
    expect_error("dump d all image 1 a.*.png type type shiny 2\n", "a factor from 0 to 1");
    hs_test_leave_folder();
}
END_TEST

HS_TEST_MAIN("image", one_disc, smooth_edges_and_rims, nearer_balls_hide_others, box_and_axes, colors_of_numbers,
             any_number_of_threads, one_picture, refused)
