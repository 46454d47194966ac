/* Checkpoints. A first byte of 0: the other bytes are the file, which the text at its head must refuse. Else a true
 * checkpoint is taken and numbers in it are changed, under a checksum that is right: each nine bytes are the number of a
 * dataset, the number of its element and the change. So what stands behind the checksum is tested, and not HDF5. */
#include <hdf5.h>
#include <zlib.h>

#include "fuzz.h"
#include "io/checkpoint.h"

enum { HEAD_SIZE = 512, NAME_SIZE = 512, SETS_MAX = 256 };

static uint8_t *whole; /**< the true checkpoint */
static size_t n_whole;
static char names[SETS_MAX][NAME_SIZE]; /**< of its datasets of numbers */
static size_t n_names;

static herr_t note(hid_t file, const char *name, const H5O_info_t *info, void *context)
{
    (void)context;
    if (info->type != H5O_TYPE_DATASET || n_names == SETS_MAX) return 0;
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set);
    if (H5Tget_class(type) != H5T_STRING) snprintf(names[n_names++], NAME_SIZE, "%s", name);
    H5Tclose(type);
    H5Dclose(set);
    return 0;
}

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
        "run 2",
        "write_restart true.h5",
    };
    (void)argc;
    (void)argv;
    hs_fuzz_enter();
    hs_deck *deck = hs_fuzz_deck(false);
    hs_fuzz_run(deck, lines, sizeof lines / sizeof lines[0]);
    hs_deck_destroy(&deck);
    FILE *file = fopen("true.h5", "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) abort();
    n_whole = (size_t)ftell(file);
    rewind(file);
    whole = malloc(n_whole);
    if (whole == NULL || fread(whole, 1, n_whole, file) != n_whole) abort();
    fclose(file);
    const hid_t h5 = H5Fopen("true.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
    if (h5 < 0 || H5Ovisit(h5, H5_INDEX_NAME, H5_ITER_INC, note, NULL) < 0) abort();
    H5Fclose(h5);
    return 0;
}

static void change(hid_t file, const uint8_t *bytes)
{
    int64_t delta;
    hid_t set = H5Dopen2(file, names[bytes[0] % n_names], H5P_DEFAULT), type = H5Dget_type(set);
    const hid_t space = H5Dget_space(set);
    const size_t n = (size_t)H5Sget_simple_extent_npoints(space), size = H5Tget_size(type);
    uint8_t *values = calloc(n + 1, size);
    memcpy(&delta, bytes + 1, sizeof delta);
    /* the low byte also chooses the element: changes of one element are what minds most */
    if (n > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0) {
        memcpy(values + (bytes[1] % n) * size, &delta, size < sizeof delta ? size : sizeof delta);
        if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) abort();
    }
    free(values);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
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
        hs_fuzz_write("fuzz.h5", whole, n_whole);
        const hid_t file = H5Fopen("fuzz.h5", H5F_ACC_RDWR, H5P_DEFAULT);
        if (file < 0) abort();
        for (size_t at = 1; at + 9 <= size; at += 9) change(file, data + at);
        H5Fclose(file);
        sign();
    }
    hs_deck *deck = hs_fuzz_deck(true);
    hs_fuzz_judge(hs_deck_command(deck, "read_restart fuzz.h5", &err), &err);
    hs_deck_destroy(&deck);
    return 0;
}
