/* Dump files byte for byte (what LAMMPS of 29 September 2021 wrote for the same decks), their order, selection, and
 * what is
 * refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "io/writer.h"
#include "support/harness.h"
#include "support/run_deck.h"

/* The box of a reproducible run is rounded to its grid: not the last digits of LAMMPS. */
static const char head[] =
    "reproducible off\nboundary p p f\nlattice fcc 0.8442\nregion box block 0 1 0 1 0 1\ncreate_box 2 box\n"
    "create_atoms 1 box\nmass * 1.5\nset atom 3 type 2\nset atom 2 image 1 -2 0\n"
    "velocity all set 0.5 -0.25 0 units box\npair_style zero 1.0\npair_coeff * *\nfix 1 all nve\n";

static const char box_lines[] = "ITEM: BOX BOUNDS pp pp ff\n"
                                "0.0000000000000000e+00 1.6795961913825073e+00\n"
                                "0.0000000000000000e+00 1.6795961913825073e+00\n"
                                "0.0000000000000000e+00 1.6795961913825073e+00\n";

static void run(const char *lines, hs_error *err)
{
    char deck[8192];
    snprintf(deck, sizeof deck, "%s%s", head, lines);
    free(hs_test_run_deck(deck, err));
}

static void run_good(const char *lines)
{
    hs_error err;
    run(lines, &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
}

static void expect_error(const char *lines, const char *text)
{
    hs_error err;
    run(lines, &err);
    ck_assert_msg(err.status != HS_OK, "no error for: %s", lines);
    ck_assert_msg(strstr(err.text, text) != NULL, "expected '%s' in '%s'", text, err.text);
}

static void expect_file(const char *name, const char *expected)
{
    char *text = hs_test_read_file(name);
    ck_assert_msg(text != NULL, "%s is missing", name);
    ck_assert_str_eq(text, expected);
    free(text);
}

static void expect_snapshot(const char *name, long step, int n, const char *columns, const char *rows)
{
    char expected[4096];
    snprintf(expected, sizeof expected, "ITEM: TIMESTEP\n%ld\nITEM: NUMBER OF ATOMS\n%d\n%sITEM: ATOMS %s\n%s", step, n,
             box_lines, columns, rows);
    expect_file(name, expected);
}

START_TEST(test_atom)
{
    hs_test_enter_folder();
    run_good("dump 1 all atom 10 a\ndump 2 all atom 10 b\ndump_modify 2 scale no image yes\nrun 0\n");
    expect_snapshot("a", 0, 4, "id type xs ys zs", "1 1 0 0 0\n2 1 0.5 0.5 0\n3 2 0.5 0 0.5\n4 1 0 0.5 0.5\n");
    expect_snapshot("b", 0, 4, "id type x y z ix iy iz",
                    "1 1 0 0 0 0 0 0\n2 1 0.839798 0.839798 0 1 -2 0\n3 2 0.839798 0 0.839798 0 0 0\n"
                    "4 1 0 0.839798 0.839798 0 0 0\n");
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_custom)
{
    hs_test_enter_folder();
    run_good("dump 1 all custom 5 c.*.dump id type element mass x xs xu xsu yu ix iy iz vx vy fx proc procp1\n"
             "dump_modify 1 element Ar Xe pad 6\nrun 5\n");
    expect_snapshot("c.000000.dump", 0, 4, "id type element mass x xs xu xsu yu ix iy iz vx vy fx proc procp1",
                    "1 1 Ar 1.5 0 0 0 0 0 0 0 0 0.5 -0.25 0 0 1\n"
                    "2 1 Ar 1.5 0.839798 0.5 2.51939 1.5 -2.51939 1 -2 0 0.5 -0.25 0 0 1\n"
                    "3 2 Xe 1.5 0.839798 0.5 0.839798 0.5 0 0 0 0 0.5 -0.25 0 0 1\n"
                    "4 1 Ar 1.5 0 0 0 0 0.839798 0 0 0 0.5 -0.25 0 0 1\n");
    ck_assert_int_eq(access("c.000005.dump", F_OK), 0);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_xyz)
{
    hs_test_enter_folder();
    run_good("dump 1 all xyz 5 x.xyz\ndump 2 all xyz 5 y.xyz\ndump_modify 2 element Ar Xe format line \"%s %.2f %.2f "
             "%.1f\"\nrun 5\n");
    expect_file("x.xyz",
                "4\nAtoms. Timestep: 0\n1 0 0 0\n1 0.839798 0.839798 0\n2 0.839798 0 0.839798\n1 0 0.839798 0.839798\n"
                "4\nAtoms. Timestep: 5\n1 0.0125 -0.00625 0\n1 0.852298 0.833548 0\n2 0.852298 -0.00625 0.839798\n"
                "1 0.0125 0.833548 0.839798\n");
    char *text = hs_test_read_file("y.xyz");
    ck_assert_int_eq(strncmp(text, "4\nAtoms. Timestep: 0\nAr 0.00 0.00 0.0\nAr 0.84 0.84 0.0\nXe 0.84 0.00 0.8\n", 71),
                     0);
    free(text);
    hs_test_leave_folder();
}
END_TEST

/** The second line says all that ASE and OVITO need; brackets are no part of a property's name. */
START_TEST(test_extxyz)
{
    static const char about[] =
        "4\nLattice=\"1.679596191382507 0 0 0 1.679596191382507 0 0 0 1.679596191382507\" Origin=\"0 0 0\" "
        "Properties=species:S:1:pos:R:3:id:I:1:type:I:1 pbc=\"T T F\" ";
    char expected[2048];
    hs_test_enter_folder();
    run_good("compute s all stress/atom NULL virial\ndump 1 all extxyz 5 x.xyz vx vy vz c_s[1] ix vy\n"
             "dump 2 all extxyz 5 y.xyz\ndump_modify 2 element Ar Xe format float %.3f\nrun 5\n");
    snprintf(expected, sizeof expected,
             "%sStep=0 Time=0\nAr 0.000 0.000 0.000 1 1\nAr 0.840 0.840 0.000 2 1\nXe 0.840 0.000 0.840 3 2\n"
             "Ar 0.000 0.840 0.840 4 1\n%sStep=5 Time=0.025\nAr 0.013 -0.006 0.000 1 1\nAr 0.852 0.834 0.000 2 1\n"
             "Xe 0.852 -0.006 0.840 3 2\nAr 0.013 0.834 0.840 4 1\n",
             about, about);
    expect_file("y.xyz", expected);
    char *text = hs_test_read_file("x.xyz");
    ck_assert_ptr_nonnull(strstr(text, "type:I:1:velo:R:3:c_s_1:R:1:ix:I:1:vy:R:1 pbc"));
    ck_assert_ptr_nonnull(strstr(text, "\nX 0.8397980957 0.8397980957 0 2 1 0.5 -0.25 0 "));
    free(text);
    hs_test_leave_folder();
}
END_TEST
/** Bytes as lmp writes them. */
START_TEST(test_cfg)
{
    static const char box[] = "H0(1,1) = 1.6796 A\nH0(1,2) = 0 A \nH0(1,3) = 0 A \nH0(2,1) = 0 A \nH0(2,2) = 1.6796 A\n"
                              "H0(2,3) = 0 A \nH0(3,1) = 0 A \nH0(3,2) = 0 A \nH0(3,3) = 1.6796 A\n.NO_VELOCITY.\n";
    char expected[2048];
    hs_test_enter_folder();
    run_good("compute q all stress/atom NULL\ndump 1 all cfg 5 a.*.cfg mass type xs ys zs ix vx\n"
             "dump_modify 1 element Ar Kr\ndump 2 all cfg 5 b.*.cfg mass type xsu ysu zsu id c_q[1]\n"
             "dump_modify 2 format float %.3f format 3 %.1f\nrun 0\n");
    snprintf(expected, sizeof expected,
             "Number of particles = 4\nA = 1 Angstrom (basic length-scale)\n%sentry_count = 5\nauxiliary[0] = ix\n"
             "auxiliary[1] = vx\n1.500000 \nAr \n0 0 0 0 0.5\n1.500000 \nAr \n0.5 0.5 0 1 0.5\n"
             "1.500000 \nKr \n0.5 0 0.5 0 0.5\n1.500000 \nAr \n0 0.5 0.5 0 0.5\n",
             box);
    expect_file("a.0.cfg", expected);
    snprintf(expected, sizeof expected,
             "Number of particles = 4\nA = 10 Angstrom (basic length-scale)\n%sentry_count = 5\nauxiliary[0] = id\n"
             "auxiliary[1] = c_q_1\n1.500000 \nC \n0.5 0.450 0.450 1 -0.375\n1.500000 \nC \n0.6 0.300 0.450 2 -0.375\n"
             "1.500000 \nC \n0.5 0.450 0.500 3 -0.375\n1.500000 \nC \n0.5 0.500 0.500 4 -0.375\n",
             box);
    expect_file("b.0.cfg", expected);
    expect_error("dump 1 all cfg 5 a mass type xs ys zs\nrun 0\n", "the name 'a' needs a *");
    expect_error("dump 1 all cfg 5 a.*.cfg mass type x y z\n",
                 "'x' is not what the format begins with: mass type xs ys zs");
    expect_error("dump 1 all cfg 5 a.*.cfg mass type xsu ys zs\n", "'ys' is not what the format begins with");
    expect_error("dump 1 all cfg 5 a.*.cfg mass type xs ys zs foo\n", "unknown attribute 'foo'");
    hs_test_leave_folder();
}
END_TEST

/** A number of a binary file. */
static int32_t int_at(const char *bytes, size_t at)
{
    int32_t value;
    memcpy(&value, bytes + at, sizeof value);
    return value;
}

static double double_at(const char *bytes, size_t at)
{
    double value;
    memcpy(&value, bytes + at, sizeof value);
    return value;
}

static float float_at(const char *bytes, size_t at)
{
    float value;
    memcpy(&value, bytes + at, sizeof value);
    return value;
}

enum { DCD_HEAD = 92 + 172 + 12 };

/** Whole files of frames of n atoms each; returns the bytes, which the caller frees. */
static char *read_dcd(const char *name, int n_frames, int n_atoms)
{
    const size_t frame = 56 + 3 * (8 + 4 * (size_t)n_atoms), size = DCD_HEAD + (size_t)n_frames * frame;
    char *bytes = malloc(size);
    FILE *file = fopen(name, "rb");
    ck_assert_msg(file != NULL, "%s is missing", name);
    ck_assert_uint_eq(fread(bytes, 1, size, file), size);
    ck_assert_int_eq(fgetc(file), EOF);
    fclose(file);
    ck_assert_int_eq(int_at(bytes, 8), n_frames);
    ck_assert_int_eq(int_at(bytes, 268), n_atoms);
    for (int k = 0; k < n_frames; ++k) { /* every record has its length before and behind it */
        size_t at = DCD_HEAD + (size_t)k * frame;
        for (int record = 0; record < 4; ++record) {
            const int length = record == 0 ? 48 : 4 * n_atoms;
            ck_assert_int_eq(int_at(bytes, at), length);
            ck_assert_int_eq(int_at(bytes, at + 4 + (size_t)length), length);
            at += 8 + (size_t)length;
        }
    }
    return bytes;
}

/** The places of the head's numbers are those of the format (CHARMM 24). */
START_TEST(test_dcd)
{
    hs_test_enter_folder();
    run_good(
        "reset_timestep 3\ngroup two id 2 3\ndump 1 all dcd 5 a.dcd\ndump 2 two dcd 5 b.dcd\ndump_modify 2 unwrap yes "
        "first yes\nrun 10\nrun 5\nwrite_dump two dcd c.dcd\n");
    char *bytes = read_dcd("a.dcd", 3, 4); /* 5 10 15 */
    ck_assert_int_eq(int_at(bytes, 0), 84);
    ck_assert_int_eq(memcmp(bytes + 4, "CORD", 4), 0);
    ck_assert_int_eq(int_at(bytes, 12), 5);
    ck_assert_int_eq(int_at(bytes, 16), 5);
    ck_assert_int_eq(int_at(bytes, 20), 15);
    ck_assert(float_at(bytes, 44) == 0.005F);
    ck_assert_int_eq(int_at(bytes, 48), 1);
    ck_assert_int_eq(int_at(bytes, 84), 24);
    ck_assert_int_eq(int_at(bytes, 88), 84);
    ck_assert_int_eq(int_at(bytes, 92), 164);
    ck_assert_int_eq(int_at(bytes, 96), 2);
    ck_assert_int_eq(int_at(bytes, 260), 164);
    for (int k = 0; k < 6; ++k)
        ck_assert(double_at(bytes, DCD_HEAD + 4 + 8 * (size_t)k) ==
                  (k == 1 || k == 3 || k == 4 ? 0.0 : 1.6795961913825073));
    ck_assert_float_eq_tol(float_at(bytes, DCD_HEAD + 56 + 4 + 8), 0.844798F,
                           1e-6F); /* x of atom 3 at the second step */
    free(bytes);
    bytes = read_dcd("b.dcd", 4, 2); /* 3 5 10 15 */
    ck_assert_int_eq(int_at(bytes, 12), 3);
    ck_assert_float_eq_tol(float_at(bytes, DCD_HEAD + 56 + 4), 2.519394F, 1e-6F); /* atom 2 has image 1 -2 0 */
    ck_assert_float_eq_tol(float_at(bytes, DCD_HEAD + 56 + 16 + 4), -2.519394F, 1e-6F);
    free(bytes);
    bytes = read_dcd("c.dcd", 1, 2);
    ck_assert_int_eq(int_at(bytes, 12), 18);
    free(bytes);
    /* more frames, into the same file */
    run_good("reset_timestep 20\ndump 1 all dcd 5 a.dcd\ndump_modify 1 append yes\nrun 10\n");
    bytes = read_dcd("a.dcd", 6, 4);
    ck_assert_int_eq(int_at(bytes, 12), 5);
    ck_assert_int_eq(int_at(bytes, 20), 30);
    free(bytes);
    run_good("dump 1 all dcd 5 new.dcd\ndump_modify 1 append yes\nrun 5\n");
    free(read_dcd("new.dcd", 2, 4));
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_dcd_refusals)
{
    hs_test_enter_folder();
    run_good("dump 1 all dcd 5 a.dcd\nrun 5\n");
    char *bytes = read_dcd("a.dcd", 2, 4);
    expect_error("dump 1 all dcd 5 a.*.dcd\n", "all frames go into one file");
    expect_error("dump 1 all dcd 5 a.dcd.gz\n", "cannot be compressed");
    expect_error("dump 1 all dcd 5 b.dcd\ndump_modify 1 sort off\n", "'off' is not id, the only order");
    expect_error("dump 1 all dcd 5 b.dcd\ndump_modify 1 thresh x < 1\n",
                 "'thresh' is not a keyword of dumps of style dcd");
    expect_error("dump 1 all custom 5 b id\ndump_modify 1 unwrap yes\n",
                 "'unwrap' is not a keyword of dumps of style custom");
    expect_error("dump 1 all dcd 5 b.dcd\nrun 0\ndump_modify 1 every 7\n", "5 steps between frames");
    expect_error("dump 1 all dcd 5 b.dcd\nrun 0\ndelete_atoms group all\nrun 5\n",
                 "the frames of 'b.dcd' have 4 atoms each, and now there are 0");
    expect_error("reset_timestep 3000000000\ndump 1 all dcd 5 b.dcd\nrun 0\n", "is beyond what a dcd file can tell");
    expect_error("dump 1 all dcd 4 a.dcd\ndump_modify 1 append yes\nrun 0\n", "has frames of every 5 steps");
    expect_error("group two id 2 3\ndump 1 two dcd 5 a.dcd\ndump_modify 1 append yes\nrun 0\n",
                 "the frames of 'a.dcd' have 4 atoms each, and now there are 2");
    free(read_dcd("a.dcd", 2, 4)); /* what was refused has changed nothing */
    /* a part of a frame, another head, no head at all */
    for (int k = 0; k < 4; ++k) {
        static const size_t size[] = {DCD_HEAD + 2 * 128 - 7, DCD_HEAD + 2 * 128, DCD_HEAD, 9};
        FILE *file = fopen("c.dcd", "wb");
        bytes[4] = k == 1 ? 'V' : 'C';
        ck_assert_uint_eq(fwrite(bytes, 1, size[k], file), size[k]);
        fclose(file);
        expect_error("dump 1 all dcd 5 c.dcd\ndump_modify 1 append yes\nrun 0\n",
                     "'c.dcd' is not a dcd file of whole frames");
        struct stat info;
        ck_assert_int_eq(stat("c.dcd", &info), 0);
        ck_assert_uint_eq((size_t)info.st_size, size[k]);
    }
    free(bytes);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_formats_and_headers)
{
    hs_test_enter_folder();
    run_good(
        "dump 1 all custom 5 f id type x vx\n"
        "dump_modify 1 format line \"%d %3d %12.4f %g\" format int %04d format 3 <%g> time yes units yes\nrun 5\n");
    char expected[2048];
    snprintf(expected, sizeof expected,
             "ITEM: UNITS\nlj\nITEM: TIME\n0\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n4\n%sITEM: ATOMS id type x vx\n"
             "0001 0001 <0> 0.5\n0002 0001 <0.839798> 0.5\n0003 0002 <0.839798> 0.5\n0004 0001 <0> 0.5\n"
             "ITEM: TIME\n0.025\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n4\n%sITEM: ATOMS id type x vx\n"
             "0001 0001 <0.0125> 0.5\n0002 0001 <0.852298> 0.5\n0003 0002 <0.852298> 0.5\n0004 0001 <0.0125> 0.5\n",
             box_lines, box_lines);
    expect_file("f", expected);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_sort_and_selection)
{
    hs_test_enter_folder();
    run_good("region low block INF INF INF INF 0 0.5 units box\ngroup two id 2 3\nvariable d atom x-z\n"
             "dump 1 all custom 5 up id x\ndump_modify 1 sort 2\ndump 2 all custom 5 down id x\ndump_modify 2 sort -2\n"
             "dump 3 all custom 5 low id\ndump_modify 3 region low\ndump 4 all custom 5 thresh id x v_d\n"
             "dump_modify 4 thresh x > 0.5 thresh type == 1\ndump 5 two custom 5 two id\n"
             "dump 6 all custom 5 var id\ndump_modify 6 thresh v_d < 0\nrun 0\n");
    expect_snapshot("up", 0, 4, "id x", "1 0\n4 0\n2 0.839798\n3 0.839798\n");
    expect_snapshot("down", 0, 4, "id x", "2 0.839798\n3 0.839798\n1 0\n4 0\n");
    expect_snapshot("low", 0, 2, "id", "1\n2\n");
    expect_snapshot("thresh", 0, 1, "id x v_d", "2 0.839798 0.839798\n");
    expect_snapshot("two", 0, 2, "id", "2\n3\n");
    expect_snapshot("var", 0, 1, "id", "4\n");
    hs_test_leave_folder();
}
END_TEST

/** Number of snapshots in a file. */
static int count_snapshots(const char *name)
{
    char *text = hs_test_read_file(name);
    int n = 0;
    for (const char *at = text; at != NULL && (at = strstr(at, "ITEM: TIMESTEP")) != NULL; ++at) ++n;
    free(text);
    return n;
}

START_TEST(test_when)
{
    hs_test_enter_folder();
    run_good("reset_timestep 3\ndump 1 all atom 5 plain\ndump 2 all atom 5 first\ndump_modify 2 first yes\n"
             "dump 3 all atom 5 delay\ndump_modify 3 delay 10\ndump 4 all atom 5 every\ndump_modify 4 every 4\n"
             "dump 5 all atom 2 max.*\ndump_modify 5 maxfiles 2\nrun 10\nrun 0\nrun 2\nundump 1\nrun 5\n");
    ck_assert_int_eq(count_snapshots("plain"), 3); /* 5 10 15 */
    ck_assert_int_eq(count_snapshots("first"), 5); /* 3 5 10 15 20: the first run alone has a first step */
    ck_assert_int_eq(count_snapshots("delay"), 3); /* 10 15 20 */
    ck_assert_int_eq(count_snapshots("every"), 5); /* 4 8 12 16 20 */
    ck_assert_int_ne(access("max.16", F_OK), 0);
    ck_assert_int_eq(access("max.18", F_OK), 0);
    ck_assert_int_eq(access("max.20", F_OK), 0);
    run_good("dump 1 all atom 5 plain\ndump_modify 1 append yes\nrun 0\n");
    ck_assert_int_eq(count_snapshots("plain"), 4);
    run_good("dump 1 all atom 5 plain\nrun 0\n");
    ck_assert_int_eq(count_snapshots("plain"), 1);
    run_good("reset_timestep 1\ndump 1 all atom 1000 least\nminimize 0.5 0 100 1000\n");
    ck_assert_int_eq(count_snapshots("least"), 1); /* the minimum, though its step is no multiple */
    hs_test_leave_folder();
}
END_TEST

/** As in LAMMPS the last snapshot of a rerun has a row, whatever `thermo` says. */
START_TEST(test_last_row_of_rerun)
{
    hs_test_enter_folder();
    char deck[8192];
    hs_error err;
    snprintf(deck, sizeof deck, "%s%s", head,
             "dump 1 all custom 5 places id x y z\nrun 10\nundump 1\nthermo 3\n"
             "thermo_style custom step atoms\nrerun places dump x y z\n");
    char *log = hs_test_run_deck(deck, &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    const char *text = strstr(log, "rerun places");
    ck_assert_ptr_nonnull(text);
    ck_assert_ptr_nonnull(strstr(text, "\n       0 "));
    ck_assert_ptr_null(strstr(text, "\n       5 "));
    ck_assert_ptr_nonnull(strstr(text, "\n      10 "));
    free(log);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_gzip_and_write_dump)
{
    hs_test_enter_folder();
    run_good("dump 1 all custom 5 z.gz id\nrun 5\nwrite_dump all custom w.*.gz id modify sort id\nwrite_dump all xyz "
             "w.xyz\n");
    char text[4096] = "";
    gzFile file = gzopen("z.gz", "rb");
    const int n = gzread(file, text, sizeof text - 1);
    gzclose(file);
    ck_assert_int_gt(n, 0);
    ck_assert_ptr_nonnull(strstr(text, "ITEM: ATOMS id\n1\n2\n3\n4\nITEM: TIMESTEP\n5\n"));
    ck_assert_int_eq(access("w.5.gz", F_OK), 0);
    ck_assert_int_eq(access("w.xyz", F_OK), 0);
    ck_assert_int_eq(system("test -z \"$(ls | grep part)\""), 0); /* no unfinished files */
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_refusals)
{
    hs_test_enter_folder();
    expect_error("dump 1 all atmo 5 x\n", "unknown style 'atmo'; did you mean 'atom'?");
    expect_error("dump 1 all custom 5 x id foo\n", "unknown attribute 'foo'");
    expect_error("dump 1 all custom 5 x id vxx\n", "did you mean 'vx'?");
    expect_error("dump 1 all custom 5 x id mol\n", "'mol' needs an atom style with molecules");
    expect_error("dump 1 all custom 5 x id c_p\n",
                 "dump custom: there is no compute 'p' for c_p: the command 'compute' makes one");
    expect_error("dump 1 all custom 5 x\n", "too few words");
    expect_error("dump 1 all atom 5 x id\n", "unexpected word 'id'");
    expect_error("dump 1 none atom 5 x\n", "there is no group 'none'");
    expect_error("dump 1 all atom 0 x\n", "'0' is not a whole number of 1 or more");
    expect_error("dump 1 all atom 5 x\ndump 1 all atom 5 y\n", "is taken");
    expect_error("dump_modify 1 sort id\n", "there is no dump '1'");
    expect_error("undump 1\n", "there is no dump '1'");
    static const char *const bad[][2] = {
        {"sort id2", "'id2' is not id, off"},
        {"sort 9", "a row has 2 columns"},
        {"format line %d", "has 1 words but"},
        {"format float %d", "wrong kind"},
        {"format 1 %s", "wrong kind"},
        {"format 7 %d", "the columns are 1 to 2"},
        {"thresh foo < 1", "unknown attribute 'foo'"},
        {"thresh x ~ 1", "'~'"},
        {"thresh element == LAST", "use type instead of element"},
        {"thresh x < nan", "not a finite number"},
        {"element C", "a name for each of the 2 atom types"},
        {"colour x", "unknown keyword"},
        {"fileper 2", "unknown keyword"},
        {"maxfiles 2", "needs a file name with *"},
        {"first maybe", "'maybe'"},
        {"every 0", "'0'"},
        {"scale no", "for dumps of style atom"},
        {"region nope", "there is no region 'nope'"},
        {"pad 99", "'99'"},
        {"thresh v_nope < 1", "nope"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        char lines[256];
        snprintf(lines, sizeof lines, "dump 1 all custom 5 x id x\ndump_modify 1 %s\nrun 0\n", bad[k][0]);
        expect_error(lines, bad[k][1]);
    }
    expect_error("dump 1 all atom 5 no/such/folder/x\nrun 0\n", "there is no folder 'no/such/folder'");
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_writer)
{
    hs_error err = {0};
    hs_writer *writer;
    hs_test_enter_folder();
    hs_test_write_file("kept", "old");
    ck_assert_hs_ok(hs_writer_open(&writer, "kept", HS_WRITE_WHOLE, &err), err);
    ck_assert_hs_ok(hs_writer_printf(writer, &err, "%d", 12), err);
    expect_file("kept", "old");
    hs_writer_abandon(&writer);
    expect_file("kept", "old");
    ck_assert_int_eq(system("test $(ls | wc -l) = 1"), 0);
    ck_assert_int_eq(symlink("kept", "link"), 0);
    ck_assert_hs_ok(hs_writer_open(&writer, "link", HS_WRITE_WHOLE, &err), err);
    ck_assert_hs_ok(hs_writer_printf(writer, &err, "new"), err);
    ck_assert_hs_ok(hs_writer_close(&writer, &err), err);
    expect_file("kept", "new"); /* through the link, which stays one */
    ck_assert_hs_ok(hs_writer_open(&writer, "kept", HS_WRITE_APPEND, &err), err);
    ck_assert_hs_ok(hs_writer_printf(writer, &err, "er"), err);
    ck_assert_hs_ok(hs_writer_commit(writer, &err), err);
    ck_assert_hs_ok(hs_writer_printf(writer, &err, "half"), err);
    hs_writer_abandon(&writer);
    expect_file("kept", "newer");
    /* more than any buffer holds */
    ck_assert_hs_ok(hs_writer_open(&writer, "big", HS_WRITE_REPLACE, &err), err);
    for (int k = 0; k < 200000; ++k) ck_assert_hs_ok(hs_writer_printf(writer, &err, "%09d\n", k), err);
    ck_assert_hs_ok(hs_writer_close(&writer, &err), err);
    char *text = hs_test_read_file("big");
    ck_assert_uint_eq(strlen(text), 2000000);
    ck_assert_int_eq(strncmp(text + 1999990, "000199999\n", 10), 0);
    free(text);
    ck_assert_hs_ok(hs_writer_open(&writer, "/dev/null", HS_WRITE_WHOLE, &err), err);
    ck_assert_hs_ok(hs_writer_close(&writer, &err), err);
    struct stat info;
    ck_assert_int_eq(stat("/dev/null", &info), 0);
    ck_assert(S_ISCHR(info.st_mode));
    if (access("/dev/full", W_OK) == 0) {
        ck_assert_hs_ok(hs_writer_open(&writer, "/dev/full", HS_WRITE_REPLACE, &err), err);
        ck_assert_hs_ok(hs_writer_printf(writer, &err, "x"), err);
        ck_assert_int_eq(hs_writer_close(&writer, &err), HS_ERROR_IO);
        ck_assert_ptr_nonnull(strstr(err.text, "No space left"));
    }
    hs_test_leave_folder();
}
END_TEST

HS_TEST_MAIN("dump", test_atom, test_custom, test_xyz, test_extxyz, test_cfg, test_dcd, test_dcd_refusals,
             test_formats_and_headers, test_sort_and_selection, test_when, test_last_row_of_rerun,
             test_gzip_and_write_dump, test_refusals, test_writer)
