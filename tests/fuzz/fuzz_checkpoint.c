/* Checkpoints. A first byte of 0: the other bytes are the file, which the text at its head must refuse. Else a true
 * checkpoint is taken and numbers in it are changed, under a checksum that is right: each nine bytes are the number of a
 * dataset, the number of its element and the change. So what stands behind the checksum is tested, and not HDF5. */
#include <zlib.h>

#include "fuzz_h5.h"
#include "io/checkpoint.h"

enum { HEAD_SIZE = 512 };

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    static const char *const lines[] = {
        "lattice fcc 0.8442",
        "region b block 0 2 0 2 0 2",
        "create_box 2 b",
        "create_atoms 1 box",
        "mass * 1.0",
        "set group all type/fraction 2 0.5 4711",
        "velocity all create 1.44 87287",
        "pair_style lj/cut 1.2",
        "pair_coeff * * 1.0 1.0",
        "group g id 1:5",
        "variable a equal step*2",
        "fix n all nve",
        "compute m all msd average yes",
        "fix a all ave/time 1 2 2 c_m[4] ave window 3",
        "run 2",
        "write_restart true.h5",
    };
    (void)argc;
    (void)argv;
    hs_fuzz_enter();
    hs_deck *deck = hs_fuzz_deck(false);
    hs_fuzz_run(deck, lines, sizeof lines / sizeof lines[0]);
    hs_deck_destroy(&deck);
    hs_fuzz_h5_take("true.h5");
    return 0;
}

/** Put the true checksum and size at the head of fuzz.h5. */
static void sign(void)
{
    FILE *file = fopen("fuzz.h5", "r+b");
    uint8_t part[65536];
    uLong crc = crc32(0, NULL, 0);
    size_t n, size = HEAD_SIZE;
    if (file == NULL || fseek(file, HEAD_SIZE, SEEK_SET) != 0) abort();
    for (; (n = fread(part, 1, sizeof part, file)) > 0; size += n) crc = crc32(crc, part, (uInt)n);
    rewind(file);
    fprintf(file, "Halfshell checkpoint\nformat %d\nbytes %zu\ncrc32 %08lx\n", HS_CHECKPOINT_FORMAT, size, crc);
    fclose(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    hs_error err = {0};
    if (size == 0) return 0;
    if (data[0] == 0) {
        hs_fuzz_write("fuzz.h5", data + 1, size - 1);
    } else {
        hs_fuzz_h5_make("fuzz.h5", data + 1, size - 1);
        sign();
    }
    hs_deck *deck = hs_fuzz_deck(true);
    hs_fuzz_judge(hs_deck_command(deck, "read_restart fuzz.h5", &err), &err);
    hs_deck_destroy(&deck);
    return 0;
}
