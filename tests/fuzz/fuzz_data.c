/* Data files. The first letter of the title chooses the atom style: d dipole, s sphere, h both, any other atomic. */
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
    const char first = size > 0 ? (char)data[0] : ' ';
    const char *const lines[] = {first == 'd'   ? "atom_style dipole"
                                 : first == 's' ? "atom_style sphere"
                                 : first == 'h' ? "atom_style hybrid sphere dipole"
                                                : "atom_style atomic",
                                 "pair_style lj/cut 2.5"};
    hs_fuzz_write("fuzz.data", data, size);
    hs_deck *deck = hs_fuzz_deck(true);
    hs_fuzz_run(deck, lines, 2);
    hs_fuzz_judge(hs_deck_command(deck, "read_data fuzz.data", &err), &err);
    hs_deck_destroy(&deck);
    return 0;
}
