/* The first pass over a deck. Nothing runs and nothing is written. */
#include "fuzz.h"

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    hs_fuzz_enter();
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    hs_error err = {0};
    hs_fuzz_write("in.fuzz", data, size);
    hs_deck *deck = hs_fuzz_deck(true);
    hs_fuzz_judge(hs_deck_check(deck, "in.fuzz", &err), &err);
    hs_deck_destroy(&deck);
    return 0;
}
