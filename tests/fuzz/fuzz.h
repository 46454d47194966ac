/** What the fuzzers share. A fuzzer gives bytes that libFuzzer thinks up to one reader; whatever they are, the reader must
 *  say so or take them: no crash, no leak, no hang, no huge memory. */
#ifndef HS_FUZZ_FUZZ_H
#define HS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "deck/deck.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static char hs_fuzz_folder[64];

static inline void hs_fuzz_leave(void)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", hs_fuzz_folder);
    if (chdir("/") != 0 || system(command) != 0) fprintf(stderr, "'%s' could not be removed\n", hs_fuzz_folder);
}

/** Go to a new folder, which is removed at the end. */
static inline void hs_fuzz_enter(void)
{
    strcpy(hs_fuzz_folder, "/tmp/halfshell-fuzz-XXXXXX");
    if (mkdtemp(hs_fuzz_folder) == NULL || chdir(hs_fuzz_folder) != 0) abort();
    if (atexit(hs_fuzz_leave) != 0) abort();
}

static inline void hs_fuzz_write(const char *name, const uint8_t *data, size_t size)
{
    FILE *file = fopen(name, "wb");
    if (file == NULL || fwrite(data, 1, size, file) != size || fclose(file) != 0) abort();
}

static inline hs_deck *hs_fuzz_deck(bool dry_run)
{
    static hs_sink sink;
    const hs_options options = {.n_threads = 1, .dry_run = dry_run};
    hs_error err = {0};
    hs_deck *deck = NULL;
    if (hs_deck_create(&deck, &options, &sink, &err) != HS_OK) abort();
    return deck;
}

/** Carry out lines that must be right. */
static inline void hs_fuzz_run(hs_deck *deck, const char *const *lines, size_t n)
{
    hs_error err = {0};
    for (size_t k = 0; k < n; ++k)
        if (hs_deck_command(deck, lines[k], &err) != HS_OK) {
            fprintf(stderr, "%s: %s\n", lines[k], err.text);
            abort();
        }
}

/** A refusal says why. */
static inline void hs_fuzz_judge(hs_status status, const hs_error *err)
{
    if (status != HS_OK && (err->text[0] == '\0' || err->status != status)) abort();
}

#endif
