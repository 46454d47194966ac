/* Data files: what is read, what is written, and that nothing hostile gets in. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/random.h"
#include "io/data_file.h"
#include "support/harness.h"
#include "support/run_deck.h"

static const char good[] =
    "title # with a comment\n\n2 atoms\n2 atom types\n0 bonds\n0 10 xlo xhi   # box\n0 10 ylo yhi\n"
    "-5.5 0.5e1 zlo zhi\n\nMasses\n\n1 1.5\n2 2.5 # heavy\n\nPair Coeffs # lj/cut\n\n1 1.0 1.0 3.0\n2 0.5 "
    "1.25\n\nAtoms # atomic\n\n7 2 1 2 3 1 -2 0\n\n3 1 -0.5 10.0 -5.5\n\nVelocities\n\n3 1 2 3\n7 0.25 "
    "-1e-3 4\n";

static char *run(const char *deck, hs_error *err) { return hs_test_run_deck(deck, err); }

static void run_good(const char *deck)
{
    hs_error err;
    free(run(deck, &err));
    ck_assert_msg(err.status == HS_OK, "%s:%ld: %s", err.file, err.line, err.text);
}

/** Reading a file of that text fails on the given line (0: any) with the given words. */
static void expect_error(const char *text, long line, const char *words)
{
    hs_error err;
    hs_test_write_file("bad.data", text);
    free(run("pair_style lj/cut 2.5\nread_data bad.data\n", &err));
    ck_assert_msg(err.status == HS_ERROR_INPUT, "status %d (%s) for:\n%s", err.status, err.text, text);
    ck_assert_msg(strstr(err.text, words) != NULL, "expected '%s' in '%s'", words, err.text);
    ck_assert_str_eq(err.file, "bad.data");
    if (line > 0) ck_assert_msg(err.line == line, "line %ld, not %ld: %s", err.line, line, err.text);
}

/** The good file with one piece of it replaced. */
static void expect_error_with(const char *old, const char *new, long line, const char *words)
{
    char text[8192];
    const char *at = strstr(good, old);
    ck_assert_msg(at != NULL, "'%s' is not in the good file", old);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, new, at + strlen(old));
    expect_error(text, line, words);
}

START_TEST(test_read_and_write)
{
    hs_test_enter_folder();
    hs_test_write_file("good.data", good);
    hs_error err;
    char *log = run("pair_style lj/cut 2.5\nread_data good.data\nwrite_data out.data pair ij\nwrite_data ii.*.data\n"
                    "write_data none.data nocoeff\n",
                    &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    ck_assert_ptr_nonnull(
        strstr(log, "Reading data file ...\n"
                    "  orthogonal box = (0.0000000 0.0000000 -5.5000000) to (10.000000 10.000000 5.0000000)\n"
                    "  1 by 1 by 1 MPI processor grid\n  reading atoms ...\n  2 atoms\n"
                    "  reading velocities ...\n  2 velocities\n  read_data CPU = "));
    free(log);
    char *text = hs_test_read_file("out.data");
    ck_assert_ptr_nonnull(strstr(text,
                                 "\n\n2 atoms\n2 atom types\n\n0 10 xlo xhi\n0 10 ylo yhi\n-5.5 5 zlo zhi\n\nMasses\n\n"
                                 "1 1.5\n2 2.5\n\nPairIJ Coeffs # lj/cut\n\n1 1 1 1 3\n1 2 "));
    ck_assert_ptr_nonnull(strstr(text,
                                 "\n2 2 0.5 1.25 2.5\n\nAtoms # atomic\n\n3 1 9.5 0 -5.5 -1 1 0\n7 2 1 2 3 1 -2 0\n\n"
                                 "Velocities\n\n3 1 2 3\n7 0.25 -0.001 4\n"));
    free(text);
    text = hs_test_read_file("none.data");
    ck_assert_ptr_null(strstr(text, "Coeffs"));
    free(text);
    ck_assert_int_eq(access("ii.0.data", F_OK), 0);
    /* reading what was written gives the same file */
    run_good("pair_style lj/cut 2.5\nread_data out.data\nwrite_data again.data pair ij\n");
    ck_assert_int_eq(system("cmp out.data again.data"), 0);
    ck_assert_int_eq(system("gzip -k out.data"), 0);
    run_good("pair_style lj/cut 2.5\nread_data out.data.gz\nwrite_data third.data.gz pair ij\n");
    ck_assert_int_eq(system("zcat third.data.gz | cmp - out.data"), 0);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_add)
{
    hs_test_enter_folder();
    hs_test_write_file("good.data", good);
    run_good("pair_style lj/cut 2.5\nread_data good.data extra/atom/types 2 nocoeff\n"
             "read_data good.data add append shift 20 0 0 offset 2 0 0 0 0 group new nocoeff\n"
             "set group new type 4\nmass * 1\nwrite_data out.data nocoeff\n");
    char *text = hs_test_read_file("out.data");
    ck_assert_ptr_nonnull(strstr(text, "\n4 atoms\n4 atom types\n\n0 30 xlo xhi\n"));
    ck_assert_ptr_nonnull(strstr(text, "\n10 4 19.5 0 -5.5 0 1 0\n")); /* 3 + 7; shifted, and wrapped in y */
    ck_assert_ptr_nonnull(strstr(text, "\n14 4 21 2 3 1 -2 0\n"));
    free(text);
    hs_error err;
    static const char *const bad[][2] = {
        {"read_data good.data nocoeff\nread_data good.data nocoeff\n", "there is a box already"},
        {"read_data good.data add append\n", "needs a box"},
        {"read_data good.data nocoeff\nread_data good.data add merge nocoeff\n", "exists already"},
        {"read_data good.data nocoeff\nread_data good.data add append offset 1 0 0 0 0 nocoeff\n",
         "has 2 atom types (offset 1)"},
        {"read_data good.data fix 1 a b\n", "there is no fix with the ID '1'"},
        {"read_data good.data extra/bond/types 2\n", "unknown keyword 'extra/bond/types'"},
        {"read_data nope.data\n", "'nope.data' cannot be read: No such file"},
        {"read_data /tmp\n", "it is a directory"},
        {"read_data good.data\n", "needs a pair style"},
        {"write_data out.data\n", "no simulation box"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        free(run(bad[k][0], &err));
        ck_assert_msg(strstr(err.text, bad[k][1]) != NULL, "expected '%s' in '%s'", bad[k][1], err.text);
    }
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_bad_headers)
{
    hs_test_enter_folder();
    expect_error("", 0, "no line '<N> atoms'");
    expect_error("only a title", 0, "no line '<N> atoms'");
    expect_error_with("2 atoms", "-2 atoms", 3, "'-2' is not a count");
    expect_error_with("2 atoms", "2.5 atoms", 3, "'2.5' is not a count");
    expect_error_with("2 atoms", "99999999999999999999 atoms", 3, "is not a count");
    expect_error_with("2 atoms", "2 atomss", 3, "unknown line 'atomss' in the header; did you mean 'atoms'?");
    expect_error_with("2 atoms", "2 2 atoms", 3, "'atoms' needs 1 number before it, not 2");
    expect_error_with("2 atom types", "0 atom types", 4, "from 1 to 10000");
    expect_error_with("2 atom types", "2000000000 atom types", 4, "from 1 to 10000");
    expect_error_with("0 bonds", "4 bonds", 5, "'bonds' must be 0");
    expect_error_with("0 10 xlo", "10 0 xlo", 6, "do not leave a box");
    expect_error_with("0 10 xlo", "0 0 xlo", 6, "do not leave a box");
    expect_error_with("0 10 xlo", "-1e308 1e308 xlo", 6, "are too far apart: a box is less than 1e+150 long");
    expect_error_with("0 10 xlo", "0 1e999 xlo", 6, "finite numbers");
    expect_error_with("0 10 ylo", "0 inf ylo", 7, "unknown line 'inf ylo yhi'");
    expect_error_with("0 10 ylo yhi\n", "", 0, "no line '<lo> <hi> ylo yhi'");
    expect_error_with("0 bonds", "0 0 1e999 xy xz yz", 5,
                      "tilts must be three numbers of a size below 1e+150, and '1e999' is none");
    expect_error_with("0 bonds", "0 0 xy xz yz", 5, "'xy xz yz' needs 3 numbers before it, not 2");
    expect_error_with("0 bonds", "6 0 0 xy xz yz", 0, "the tilt xy, 6, is more than half of the box's length in x, 10");
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_tilted_box)
{
    hs_test_enter_folder();
    hs_error err;
    char text[8192];
    const char *at = strstr(good, "0 bonds");
    snprintf(text, sizeof text, "%.*s-2.5 0.1 1e-3 xy xz yz%s", (int)(at - good), good, at + strlen("0 bonds"));
    hs_test_write_file("tilted.data", text);
    char *log = run("pair_style lj/cut 2.5\nread_data tilted.data\nwrite_data out.data pair ij\nclear\n"
                    "pair_style lj/cut 2.5\nread_data out.data\nwrite_data again.data pair ij\n",
                    &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    ck_assert_ptr_nonnull(
        strstr(log, "  triclinic box = (0.0000000 0.0000000 -5.5000000) to (10.000000 10.000000 5.0000000) "
                    "with tilt (-2.5000000 0.10000000 0.0010000000)\n"));
    free(log);
    char *out = hs_test_read_file("out.data"), *again = hs_test_read_file("again.data");
    ck_assert_ptr_nonnull(strstr(out, "\n-5.5 5 zlo zhi\n-2.5 0.1 0.001 xy xz yz\n\nMasses\n"));
    ck_assert_str_eq(out, again);
    free(out);
    free(again);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_bad_sections)
{
    hs_test_enter_folder();
    expect_error_with("Masses", "Massses", 10, "unknown section 'Massses'; did you mean 'Masses'?");
    expect_error_with("Masses", "Bonds", 10, "'Bonds' is not for atoms of the supported styles");
    expect_error_with("1 1.5", "1 0", 12, "is not a mass");
    expect_error_with("1 1.5", "1 -1.5", 12, "is not a mass");
    expect_error_with("1 1.5", "3 1.5", 12, "not an atom type from 1 to 2");
    expect_error_with("1 1.5", "1 1.5 2", 12, "this one has 3 words");
    expect_error_with("1 1.0 1.0 3.0", "1 1.0 x", 17, "'x' is not");
    expect_error_with("1 1.0 1.0 3.0", "1 1.0", 17, "");
    expect_error_with("7 2 1 2 3 1 -2 0", "0 2 1 2 3 1 -2 0", 22, "'0' is not an atom id");
    expect_error_with("7 2 1 2 3 1 -2 0", "9223372036854775807 2 1 2 3 1 -2 0", 22, "from 1 to 2^62");
    expect_error_with("7 2 1 2 3 1 -2 0", "-7 2 1 2 3 1 -2 0", 22, "'-7' is not an atom id");
    expect_error_with("7 2 1 2 3 1 -2 0", "7.5 2 1 2 3 1 -2 0", 22, "is not a whole number");
    expect_error_with("7 2 1 2 3 1 -2 0", "9999999999999999999 2 1 2 3", 22, "is not a whole number");
    expect_error_with("7 2 1 2 3 1 -2 0", "3 2 1 2 3 1 -2 0", 24, "atom id 3 was given on line 22 already");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 3 1 2 3 1 -2 0", 22, "'3' is not an atom type from 1 to 2");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 0 1 2 3 1 -2 0", 22, "'0' is not an atom type from 1 to 2");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 2 nan 2 3 1 -2 0", 22, "'nan' is not a finite number (a coordinate)");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 2 1 --3 3 1 -2 0", 22, "'--3' is not a finite number");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 2 1 1e300 3 1 -2 0", 22, "more than 1000 box lengths outside");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 2 1 2 3 1 -2", 22, "this one has 7 words");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 2 1 2 3 1.5 -2 0", 22, "'1.5' is not an image flag");
    expect_error_with("7 2 1 2 3 1 -2 0", "7 2 1 2 3 9999999999 -2 0", 22,
                      "is not an image flag (a whole number from -1073741824 to 1073741824)");
    expect_error_with("3 1 -0.5 10.0 -5.5\n", "", 25, "section Atoms ends after 1 lines; the header says there are 2");
    expect_error_with("3 1 -0.5 10.0 -5.5\n", "3 1 -0.5 10.0 -5.5\n4 1 1 1 1\n", 25,
                      "a section name was expected, not '4 1 1 1 1'");
    expect_error_with("3 1 2 3\n", "4 1 2 3\n", 28, "no atom with id 4");
    expect_error_with("3 1 2 3\n", "7 1 2 3\n", 29, "atom 7 has a velocity already");
    expect_error_with("3 1 2 3\n", "3 1 2\n", 28, "this one has 3 words");
    expect_error_with("3 1 2 3\n", "3 1 2 inf\n", 28, "'inf' is not a finite number (a velocity)");
    expect_error_with("7 0.25 -1e-3 4\n", "", 28, "section Velocities ends after 1 lines");
    expect_error_with("Atoms # atomic", "Velocities", 20, "must come after Atoms");
    expect_error_with("2 atom types", "1 atom types", 0, "section");
    expect_error("t\n\n1 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nMasses\n\n1 1\n", 0,
                 "no section Atoms");
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_box_edges)
{
    hs_test_enter_folder();
    hs_error err;
    hs_test_write_file(
        "out.data", "t\n\n1 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms\n\n1 1 0.5 1.5 0.5\n");
    free(run("boundary p f p\nread_data out.data\n", &err));
    ck_assert_ptr_nonnull(strstr(err.text, "the atom's y = 1.5 is outside of the box, 0 to 1, which is not periodic"));
    ck_assert_int_eq(err.line, 11);
    run_good("boundary f p p\nread_data out.data\n");
    /* an atom on the face of a box that is not periodic is inside */
    hs_test_write_file("on.data",
                       "t\n\n1 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms\n\n1 1 1 0 1\n");
    run_good("boundary f f s\nread_data on.data\n");
    /* what a shrink-wrapped run writes can be read again, though atoms have moved since the last list */
    hs_test_write_file("good.data", good);
    run_good(
        "boundary p m s\npair_style lj/cut 2.5\nread_data good.data nocoeff\npair_coeff * * 1 1\nfix 1 all nve\nrun 3\n"
        "write_data end.data\n");
    run_good("boundary f f f\nread_data end.data nocoeff\n");
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_truncated)
{
    /* every beginning of the good file is read or refused, and never more */
    hs_test_enter_folder();
    for (size_t n = 0; n < strlen(good); ++n) {
        char text[sizeof good];
        hs_error err;
        memcpy(text, good, n);
        text[n] = '\0';
        hs_test_write_file("cut.data", text);
        free(run("pair_style lj/cut 2.5\nread_data cut.data\n", &err));
        ck_assert_msg(err.status == HS_OK || err.status == HS_ERROR_INPUT, "%zu bytes: %s", n, err.text);
    }
    hs_test_write_file("good.data", good);
    ck_assert_int_eq(system("gzip good.data; head -c 150 good.data.gz > cut.gz"), 0);
    hs_error err;
    free(run("pair_style lj/cut 2.5\nread_data cut.gz\n", &err));
    ck_assert_int_eq(err.status, HS_ERROR_INPUT);
    hs_test_leave_folder();
}
END_TEST

START_TEST(test_garbage)
{
    /* the good file with random bytes changed */
    hs_park park;
    hs_park_init(&park, 4711);
    hs_test_enter_folder();
    for (int round = 0; round < 400; ++round) {
        char text[sizeof good];
        hs_error err;
        memcpy(text, good, sizeof good);
        const int n_changes = 1 + (int)(hs_park_uniform(&park) * 4.0);
        for (int k = 0; k < n_changes; ++k)
            text[(size_t)(hs_park_uniform(&park) * (double)(sizeof good - 1))] = (char)(hs_park_uniform(&park) * 256.0);
        FILE *out = fopen("odd.data", "wb");
        fwrite(text, 1, sizeof good - 1, out);
        fclose(out);
        free(run("pair_style lj/cut 2.5\nread_data odd.data\n", &err));
        ck_assert_msg(err.status == HS_OK || err.status == HS_ERROR_INPUT, "round %d: %s", round, err.text);
    }
    FILE *out = fopen("long.data", "wb");
    for (int k = 0; k < 200000; ++k) fputs("1 ", out);
    fclose(out);
    hs_error err;
    free(run("read_data long.data\n", &err));
    ck_assert_ptr_nonnull(strstr(err.text, "longer than"));
    hs_test_leave_folder();
}
END_TEST

static const char with_values[] =
    "title\n\n2 atoms\n1 atom types\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\nAtoms\n\n7 1 1 2 3\n3 1 4 5 6\n\n"
    "my values # i_n d_w\n\n3 -4 0.1\n7 5 1e-3\n\nothers\n\n7 2.5\n3 -1\n";

static const char reads_values[] = "fix p all property/atom i_n d_w\nfix q all property/atom d_e\n"
                                   "read_data values.data fix p NULL 'my values' fix q NULL others\nmass 1 1\n";

/** That deck with a file in which one piece is replaced must fail with these words. */
static void expect_bad_values(const char *old, const char *new, long line, const char *words)
{
    char text[4096];
    hs_error err;
    const char *at = strstr(with_values, old);
    ck_assert_ptr_nonnull(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - with_values), with_values, new, at + strlen(old));
    hs_test_write_file("values.data", text);
    free(run(reads_values, &err));
    ck_assert_msg(err.status == HS_ERROR_INPUT && err.line == line && strcmp(err.text, words) == 0,
                  "line %ld: '%s', not line %ld: '%s'", err.line, err.text, line, words);
}

/* Values of fix property/atom go to a data file and come back with all digits. */
START_TEST(test_values_of_fixes)
{
    char deck[1024];
    hs_error err;
    hs_test_enter_folder();
    hs_test_write_file("values.data", with_values);
    snprintf(deck, sizeof deck, "%swrite_data out.data\nwrite_data less.data nofix\n", reads_values);
    run_good(deck);
    char *text = hs_test_read_file("out.data");
    ck_assert_msg(strstr(text, "\np # i_n d_w\n\n3 -4 0.1\n7 5 0.001\n\nq # d_e\n\n3 -1\n7 2.5\n") != NULL, "%s", text);
    free(text);
    text = hs_test_read_file("less.data");
    ck_assert_ptr_null(strstr(text, "d_w"));
    free(text);
    run_good("fix p all property/atom i_n d_w\nfix q all property/atom d_e\n"
             "read_data out.data fix p NULL p fix q NULL q\nwrite_data again.data\n");
    ck_assert_int_eq(system("cmp out.data again.data"), 0);
    char *log = run("fix p all property/atom i_n d_w\nread_data less.data fix p NULL p\n", &err);
    ck_assert_ptr_nonnull(strstr(log, "WARNING: less.data: there is no section 'p' for fix 'p'"));
    free(log);
    expect_bad_values("5 1e-3", "5.5 1", 17, "'5.5' is not a whole number of 32 bits (i_n)");
    expect_bad_values("-4 0.1", "2147483648 0.1", 16, "'2147483648' is not a whole number of 32 bits (i_n)");
    expect_bad_values("1e-3", "nan", 17, "'nan' is not a finite number (d_w)");
    expect_bad_values("-4 0.1", "-4", 16,
                      "a line of section my values is an atom id and 2 values; this one has 2 words");
    expect_bad_values("7 5 1e-3", "3 5 1e-3", 17, "atom 3 has a line in section my values already");
    expect_bad_values("3 -1", "4 -1", 22, "the section Atoms has no atom with id 4");
    expect_bad_values("7 2.5\n", "", 21, "section others ends after 1 lines; the header says there are 2");
    expect_bad_values("others", "my values", 19, "there is a section my values already");
    expect_bad_values(
        "others", "else", 19,
        "unknown section 'else'; values of a fix property/atom are read with 'read_data ... fix <ID> NULL "
        "else'");
    expect_bad_values("Atoms\n\n", "others\n\n", 9, "the section others must come after Atoms");
}
END_TEST

START_TEST(test_shortest)
{
    char text[HS_SHORTEST_SIZE];
    ck_assert_str_eq(hs_data_shortest(0.1, text), "0.1");
    ck_assert_str_eq(hs_data_shortest(0.0, text), "0");
    ck_assert_str_eq(hs_data_shortest(-2.5e-7, text), "-2.5e-07");
    ck_assert_str_eq(hs_data_shortest(3.3591923827650145, text), "3.3591923827650145");
    ck_assert_str_eq(hs_data_shortest(0.8397980956912536, text), "0.8397980956912536");
    hs_park park;
    hs_park_init(&park, 99);
    for (int k = 0; k < 100000; ++k) {
        const double value = ldexp(hs_park_uniform(&park) - 0.5, (int)(hs_park_uniform(&park) * 200.0) - 100);
        ck_assert(strtod(hs_data_shortest(value, text), NULL) == value);
    }
}
END_TEST

HS_TEST_MAIN("data_file", test_read_and_write, test_add, test_bad_headers, test_tilted_box, test_bad_sections,
             test_box_edges, test_truncated, test_garbage, test_shortest, test_values_of_fixes)
