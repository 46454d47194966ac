#include "support/run_deck.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/harness.h"

char *hs_test_run_deck(const char *deck_text, hs_error *err)
{
    const hs_options options = {.n_threads = 1};
    return hs_test_run_deck_with(deck_text, &options, NULL, NULL, err);
}

char *hs_test_run_deck_with(const char *deck_text, const hs_options *options,
                            void (*at_end)(hs_deck *deck, void *context), void *context, hs_error *err)
{
    char *log = NULL, *lines = strdup(deck_text), *rest = NULL;
    size_t size;
    hs_sink sink = {.log = open_memstream(&log, &size)};
    hs_deck *deck = NULL;
    memset(err, 0, sizeof *err);
    hs_status status = hs_deck_create(&deck, options, &sink, err);
    for (char *line = strtok_r(lines, "\n", &rest); line != NULL && status == HS_OK; line = strtok_r(NULL, "\n", &rest))
        status = hs_deck_command(deck, line, err);
    if (status == HS_OK && at_end != NULL) at_end(deck, context);
    hs_deck_destroy(&deck);
    fclose(sink.log);
    free(lines);
    return log;
}

hs_options hs_test_options(int n_threads, const char *method, hs_isa isa)
{
    hs_options options = {.n_threads = n_threads};
    snprintf(options.neighbor_method, sizeof options.neighbor_method, "%s", method);
    snprintf(options.isa, sizeof options.isa, "%s", hs_isa_names[isa]);
    return options;
}

hs_deck *hs_test_new_deck(void)
{
    static hs_sink nowhere;
    hs_error err = {0};
    hs_deck *deck = NULL;
    const hs_options options = {.n_threads = 1};
    ck_assert_hs_ok(hs_deck_create(&deck, &options, &nowhere, &err), err);
    return deck;
}

void hs_test_command(hs_deck *deck, const char *line)
{
    hs_error err = {0};
    ck_assert_hs_ok(hs_deck_command(deck, line, &err), err);
}

char *hs_test_read_file(const char *path)
{
    char *text = NULL, piece[4096];
    size_t size, n;
    FILE *in = fopen(path, "rb");
    if (in == NULL) return NULL;
    FILE *out = open_memstream(&text, &size);
    while ((n = fread(piece, 1, sizeof piece, in)) > 0) fwrite(piece, 1, n, out);
    fclose(in);
    fclose(out);
    return text;
}

void hs_test_write_file(const char *path, const char *text)
{
    FILE *out = fopen(path, "wb");
    if (out == NULL || fwrite(text, 1, strlen(text), out) != strlen(text) || fclose(out) != 0) {
        perror(path);
        abort();
    }
}

int hs_test_each_case(const char *path, void (*run)(const char *start, const char *name, char *text))
{
    char *file = hs_test_read_file(path), *start = NULL;
    int n_cases = 0;
    ck_assert_ptr_nonnull(file);
    for (char *item = strstr(file, "\n== "); item != NULL;) {
        char *name = item + 4, *text = strchr(name, '\n') + 1, *next = strstr(text, "\n== ");
        text[-1] = '\0';
        if (next != NULL) *next = '\0';
        if (start == NULL)
            start = text;
        else
            run(start, name, text), ++n_cases;
        item = next;
    }
    free(file);
    return n_cases;
}
