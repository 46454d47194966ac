/* Trajectories read back. The first byte chooses: native dumps read by read_dump, or by rerun, XYZ, or H5MD; for that a true
 * file is taken and numbers in it are changed: see fuzz_h5.h. */
#include "fuzz_h5.h"

static const char *const system_lines[] = {
    "lattice fcc 0.8442", "region b block 0 2 0 2 0 2", "create_box 2 b",         "create_atoms 1 box",
    "mass * 1.0",         "pair_style lj/cut 1.2",      "pair_coeff * * 1.0 1.0", "thermo 1",
};
enum { N_SYSTEM = sizeof system_lines / sizeof system_lines[0] };

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    static const char *const lines[] = {"velocity all create 1.44 87287", "fix 1 all nve",
                                        "dump d all h5md 1 true.h5 position velocity image species", "run 3"};
    (void)argc;
    (void)argv;
    hs_fuzz_enter();
    hs_deck *deck = hs_fuzz_deck(false);
    hs_fuzz_run(deck, system_lines, N_SYSTEM);
    hs_fuzz_run(deck, lines, sizeof lines / sizeof lines[0]);
    hs_deck_destroy(&deck);
    hs_fuzz_h5_take("true.h5");
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const lines[] = {
        "read_dump fuzz.dump 10 x y z vx vy vz ix iy iz add keep trim yes",
        "rerun fuzz.dump dump x y z",
        "read_dump fuzz.dump 0 x y z box no purge yes replace no add yes format xyz",
        "rerun fuzz.dump dump x y z vx vy vz ix iy iz add yes",
    };
    hs_error err = {0};
    if (size == 0) return 0;
    const int kind = data[0] % 4;
    if (kind == 3)
        hs_fuzz_h5_make("fuzz.dump", data + 1, size - 1);
    else
        hs_fuzz_write("fuzz.dump", data + 1, size - 1);
    hs_deck *deck = hs_fuzz_deck(false);
    hs_fuzz_run(deck, system_lines, N_SYSTEM);
    hs_fuzz_judge(hs_deck_command(deck, lines[kind], &err), &err);
    hs_deck_destroy(&deck);
    return 0;
}
