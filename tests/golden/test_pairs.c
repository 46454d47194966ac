/* Thermo tables of the decks in golden/pair, every digit, against LAMMPS's (golden/pair/record makes them). */
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
        if (!is_on) continue;
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
    char recorded[512];
    hs_error err = {0};
    snprintf(recorded, sizeof recorded, "%.*s.thermo", (int)(strlen(path) - 3), path);
    char *deck = hs_test_read_file(path), *expected_log = hs_test_read_file(recorded);
    ck_assert_msg(deck != NULL && expected_log != NULL, "%s or %s cannot be read", path, recorded);
    char *log = hs_test_run_deck(deck, &err);
    ck_assert_msg(err.status == HS_OK, "%s: %s", path, err.text);
    char *given = tables_of(log), *expected = tables_of(expected_log);
    ck_assert_msg(strlen(expected) > 200, "%s holds no table", recorded);
    ck_assert_msg(strcmp(given, expected) == 0, "%s: LAMMPS's table is\n%s\nours\n%s", path, expected, given);
    free(deck);
    free(expected_log);
    free(log);
    free(given);
    free(expected);
}

START_TEST(every_digit_of_lammps)
{
    glob_t decks;
    ck_assert_int_eq(glob(TEST_SOURCE_DIR "/golden/pair/*.in", 0, NULL, &decks), 0);
    ck_assert_uint_ge(decks.gl_pathc, 9);
    for (size_t k = 0; k < decks.gl_pathc; ++k) check_deck(decks.gl_pathv[k]);
    globfree(&decks);
}
END_TEST

HS_TEST_MAIN("pair styles of LAMMPS", every_digit_of_lammps)
