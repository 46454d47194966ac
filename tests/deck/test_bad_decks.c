/* Every deck of bad_decks*.txt must be refused with exactly the message that stands there.
 *
 * With HALFSHELL_PRINT_MESSAGES set, the table is printed with the messages of today: to be read, not just copied. */
#define _GNU_SOURCE
#include <glob.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "deck/deck.h"
#include "support/harness.h"

enum { N_MIN = 1031 }; /* decks there are: none may get lost */

/** Append a file to text, after what takes back the start of the file before. */
static void append_file(hs_text *text, const char *path)
{
    hs_error err = {0};
    FILE *stream = fopen(path, "rb");
    ck_assert_msg(stream != NULL, "%s cannot be read", path);
    char *line = NULL;
    size_t room = 0;
    ck_assert_int_eq(hs_text_printf(text, &err, "\n== start\n\n"), HS_OK);
    while (getline(&line, &room, stream) >= 0) ck_assert_int_eq(hs_text_printf(text, &err, "%s", line), HS_OK);
    free(line);
    fclose(stream);
}

/** All tables, one after the other; the caller frees it. */
static char *read_tables(void)
{
    hs_text text = {0};
    glob_t files;
    ck_assert_int_eq(glob(TEST_SOURCE_DIR "/deck/bad_decks*.txt", 0, NULL, &files), 0);
    for (size_t k = 0; k < files.gl_pathc; ++k) append_file(&text, files.gl_pathv[k]);
    globfree(&files);
    char *table = strdup(hs_text_get(&text));
    ck_assert_ptr_nonnull(table);
    hs_text_fini(&text);
    return table;
}

/** What the program says of in.bad: "in.bad:LINE: error: TEXT". */
static void run_bad(hs_text *message)
{
    hs_error err = {0};
    hs_sink out = {0};
    const hs_options options = {.n_threads = 1};
    hs_deck *deck = NULL;
    hs_status status = hs_deck_create(&deck, &options, &out, &err);
    if (status == HS_OK) status = hs_deck_check(deck, "in.bad", &err);
    if (status == HS_OK) status = hs_deck_run(deck, "in.bad", &err);
    hs_deck_destroy(&deck);
    hs_error ignored = {0};
    hs_text_clear(message);
    if (status == HS_OK)
        ck_assert_int_eq(hs_text_printf(message, &ignored, "(no error)"), HS_OK);
    else
        ck_assert_int_eq(hs_text_printf(message, &ignored, "%s:%ld: error: %s", err.file, err.line, err.text), HS_OK);
}

/** Write one file of the case, behind n_start bytes; returns the line after it. */
static char *write_file(const char *name, const char *start, size_t n_start, char *line)
{
    FILE *stream = fopen(name, "w");
    ck_assert_ptr_nonnull(stream);
    ck_assert_uint_eq(fwrite(start, 1, n_start, stream), n_start);
    while (line != NULL && strncmp(line, "++ ", 3) != 0 && strncmp(line, "-> ", 3) != 0) {
        char *end = strchr(line, '\n');
        ck_assert_msg(end != NULL, "a table ends within a deck");
        fprintf(stream, "%.*s\n", (int)(end - line), line);
        line = end + 1;
    }
    fclose(stream);
    return line;
}

START_TEST(every_deck_is_refused_with_its_message)
{
    char *table = read_tables();
    const bool is_printing = getenv("HALFSHELL_PRINT_MESSAGES") != NULL;
    const char *start = "";
    size_t n_start = 0;
    int n = 0, n_wrong = 0;
    hs_text message = {0};
    hs_test_enter_folder();
    for (char *at = strstr(table, "\n== "); at != NULL; at = strstr(at, "\n== ")) {
        char *name = at + 4, *line = strchr(name, '\n');
        *line++ = '\0';
        const char *body = line;
        if (strcmp(name, "start") == 0) {
            start = line;
            while (*line != '\n') line = strchr(line, '\n') + 1; /* to the blank line after it */
            n_start = (size_t)(line - start);
            at = line;
            continue;
        }
        line = write_file("in.bad", start, n_start, line);
        while (strncmp(line, "++ ", 3) == 0) {
            char *file = line + 3, *end = strchr(file, '\n');
            char copy[64];
            snprintf(copy, sizeof copy, "%.*s", (int)(end - file), file);
            line = write_file(copy, "", 0, end + 1);
        }
        char *end = strchr(line, '\n');
        ck_assert_msg(end != NULL, "%s: the message must end with a newline", name);
        *end = '\0';
        run_bad(&message);
        ++n;
        if (is_printing) {
            printf("\n== %s\n%.*s-> %s\n", name, (int)(line - body), body, hs_text_get(&message));
        } else if (strcmp(line + 3, hs_text_get(&message)) != 0) {
            ++n_wrong;
            fprintf(stderr, "%s\n  expected: %s\n  got:      %s\n", name, line + 3, hs_text_get(&message));
        }
        *end = '\n';
        at = end - 1;
    }
    hs_text_fini(&message);
    free(table);
    hs_test_leave_folder();
    ck_assert_int_eq(n_wrong, 0);
    ck_assert_int_ge(n, N_MIN);
}
END_TEST

HS_TEST_MAIN("bad decks", every_deck_is_refused_with_its_message)
