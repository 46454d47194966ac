/* Thermo tables of the decks in golden/pair, relax, styles and tilted, every digit, against LAMMPS's (golden/record makes them). */
#define _GNU_SOURCE
#include <glob.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "support/harness.h"
#include "support/run_deck.h"

/** The lines of all thermo tables of a log, words parted by one space; the caller frees them. */
static char *tables_of(char *log)
{
    hs_text tables = {0};
    hs_error err = {0};
    bool is_on = false;
    for (char *line = strtok(log, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        char *rest = line, *word;
        if (strncmp(line, "Loop time", 9) == 0) is_on = false;
        if (strncmp(line, "Step", 4) == 0) is_on = true;
        if (!is_on || strncmp(line, "WARNING", 7) == 0) continue;
        while ((word = strsep(&rest, " \r")) != NULL)
            if (*word != '\0') ck_assert_int_eq(hs_text_printf(&tables, &err, "%s ", word), HS_OK);
        ck_assert_int_eq(hs_text_printf(&tables, &err, "\n"), HS_OK);
    }
    char *copy = strdup(hs_text_get(&tables));
    hs_text_fini(&tables);
    return copy;
}

static void check_deck(const char *path)
{
    char recorded[512], include[520];
    hs_error err = {0};
    snprintf(recorded, sizeof recorded, "%.*s.thermo", (int)(strlen(path) - 3), path);
    snprintf(include, sizeof include, "include %s", path);
    char *expected_log = hs_test_read_file(recorded);
    ck_assert_msg(expected_log != NULL, "%s cannot be read", recorded);
    char *log = hs_test_run_deck(include, &err);
    ck_assert_msg(err.status == HS_OK, "%s: %s", path, err.text);
    char *given = tables_of(log), *expected = tables_of(expected_log);
    ck_assert_msg(strlen(expected) > 200, "%s holds no table", recorded);
    ck_assert_msg(strcmp(given, expected) == 0, "%s: LAMMPS's table is\n%s\nours\n%s", path, expected, given);
    free(expected_log);
    free(log);
    free(given);
    free(expected);
}

static void check_folder(const char *pattern)
{
    glob_t decks;
    ck_assert_int_eq(glob(pattern, 0, NULL, &decks), 0);
    for (size_t k = 0; k < decks.gl_pathc; ++k) check_deck(decks.gl_pathv[k]);
    globfree(&decks);
}

START_TEST(pair_styles) { check_folder(TEST_SOURCE_DIR "/golden/pair/*.in"); }
END_TEST

START_TEST(other_styles) { check_folder(TEST_SOURCE_DIR "/golden/styles/*.in"); }
END_TEST

START_TEST(relaxed_boxes) { check_folder(TEST_SOURCE_DIR "/golden/relax/*.in"); }
END_TEST

START_TEST(tilted_boxes) { check_folder(TEST_SOURCE_DIR "/golden/tilted/*.in"); }
END_TEST

HS_TEST_MAIN("decks against every digit of LAMMPS", pair_styles, other_styles, relaxed_boxes, tilted_boxes)
