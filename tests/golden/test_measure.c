/* What is measured against LAMMPS: thermo columns, averages, correlations, histograms, values per atom and dumps.
 * tests/golden/measure/NAME.deck are the decks, NAME.values what lmp of 29 Sep 2021 wrote (measure/make.sh). */
#define _GNU_SOURCE
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "support/harness.h"
#include "support/run_deck.h"

/* Files have 6 digits, the last of which may be rounded the other way, and trajectories agree to about 1e-10 in so few
 * steps. */
#define TOLERANCE 2e-5
/* What cancels to zero (forces and momenta of a lattice) is rounding error in both programs. */
#define SMALL 1e-9

static char folder[] = "/tmp/halfshell_measure_XXXXXX";

/** Thermo tables of a log: lines from "Step" up to "Loop". */
static char *tables_of(const char *log)
{
    hs_text text = {0};
    hs_error err = {0};
    bool is_table = false;
    for (const char *at = log; *at != '\0';) {
        const char *end = strchrnul(at, '\n');
        if (strncmp(at, "Step ", 5) == 0) is_table = true;
        if (strncmp(at, "Loop", 4) == 0) is_table = false;
        if (is_table) ck_assert_hs_ok(hs_text_printf(&text, &err, "%.*s\n", (int)(end - at), at), err);
        at = *end == '\0' ? end : end + 1;
    }
    char *tables = strdup(hs_text_get(&text));
    hs_text_fini(&text);
    return tables;
}

static bool is_equal(const char *a, const char *b)
{
    double x, y;
    if (strcmp(a, b) == 0) return true;
    if (!hs_text_to_double(a, &x) || !hs_text_to_double(b, &y)) return false;
    return fabs(x - y) <= TOLERANCE * fmax(fabs(x), fabs(y)) || fmax(fabs(x), fabs(y)) < SMALL;
}

/** Word by word: numbers within the tolerance, all else the same. */
static void compare(const char *deck, const char *file, const char *got, const char *expected)
{
    char *a = strdup(got), *b = strdup(expected), *rest_a = NULL, *rest_b = NULL;
    char *word_a = strtok_r(a, " \n", &rest_a), *word_b = strtok_r(b, " \n", &rest_b);
    for (int n = 1; word_a != NULL && word_b != NULL; ++n) {
        ck_assert_msg(is_equal(word_a, word_b), "%s, %s: word %d is %s, LAMMPS has %s", deck, file, n, word_a, word_b);
        word_a = strtok_r(NULL, " \n", &rest_a);
        word_b = strtok_r(NULL, " \n", &rest_b);
    }
    ck_assert_msg(word_a == NULL && word_b == NULL, "%s, %s: not as long as LAMMPS's", deck, file);
    free(a);
    free(b);
}

static void check_deck(const char *name, int n_threads)
{
    char path[512];
    hs_error err = {0};
    /* a reproducible run rounds positions, by 1e-14 at step 0: displacements then are not 0, and lattice sites on the face of a
       region may be beyond it */
    const hs_options options = {.n_threads = n_threads,
                                .reproducible = strcmp(name, "temperatures") == 0 || strcmp(name, "chunks") == 0
                                                    ? HS_REPRODUCIBLE_OFF
                                                    : HS_REPRODUCIBLE_DEFAULT};
    snprintf(path, sizeof path, TEST_SOURCE_DIR "/golden/measure/%s.deck", name);
    char *deck = hs_test_read_file(path);
    snprintf(path, sizeof path, TEST_SOURCE_DIR "/golden/measure/%s.values", name);
    char *values = hs_test_read_file(path);
    ck_assert_ptr_nonnull(deck);
    ck_assert_ptr_nonnull(values);
    char *log = hs_test_run_deck_with(deck, &options, NULL, NULL, &err);
    ck_assert_msg(err.status == HS_OK, "%s: %s", name, err.text);
    char *tables = tables_of(log);
    for (char *at = values; at != NULL && *at != '\0';) {
        char *file = at + 3, *begin = strchr(at, '\n'), *next = strstr(begin, "\n== ");
        *begin++ = '\0';
        if (next != NULL) *next++ = '\0';
        char *written = strcmp(file, "log") == 0 ? strdup(tables) : hs_test_read_file(file);
        ck_assert_msg(written != NULL, "%s: the file %s is missing", name, file);
        compare(name, file, written, begin);
        free(written);
        if (strcmp(file, "log") != 0) ck_assert_int_eq(unlink(file), 0);
        at = next;
    }
    free(tables);
    free(log);
    free(values);
    free(deck);
}

START_TEST(every_deck_gives_lammps_s_numbers)
{
    enum { N_AT_LEAST = 47 }; /* decks there are: none may get lost */
    glob_t files;
    ck_assert_int_eq(glob(TEST_SOURCE_DIR "/golden/measure/*.deck", 0, NULL, &files), 0);
    ck_assert_int_ge((int)files.gl_pathc, N_AT_LEAST);
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_int_eq(chdir(folder), 0);
    for (size_t k = 0; k < files.gl_pathc; ++k) {
        char *name = strdup(strrchr(files.gl_pathv[k], '/') + 1);
        *strrchr(name, '.') = '\0';
        for (int n_threads = 1; n_threads <= 3; n_threads += 2) check_deck(name, n_threads);
        free(name);
    }
    globfree(&files);
    ck_assert_int_eq(chdir("/"), 0);
    ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

HS_TEST_MAIN("measurements as LAMMPS's", every_deck_gives_lammps_s_numbers)
