/* Trajectories read back. The first byte chooses: native dumps read by read_dump, or by rerun, XYZ, or H5MD; for that a true
 * file is taken and numbers in it are changed as in fuzz_checkpoint, so that what stands behind HDF5 is tested and not HDF5. */
#include <hdf5.h>

#include "fuzz.h"

enum { NAME_SIZE = 256, SETS_MAX = 64 };

static uint8_t *whole; /**< the true H5MD file */
static size_t n_whole;
static char names[SETS_MAX][NAME_SIZE]; /**< of its datasets of numbers */
static size_t n_names;

static const char *const system_lines[] = {
    "lattice fcc 0.8442", "region b block 0 2 0 2 0 2", "create_box 2 b",         "create_atoms 1 box",
    "mass * 1.0",         "pair_style lj/cut 1.2",      "pair_coeff * * 1.0 1.0", "thermo 1",
};
enum { N_SYSTEM = sizeof system_lines / sizeof system_lines[0] };

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
    static const char *const lines[] = {"velocity all create 1.44 87287", "fix 1 all nve",
                                        "dump d all h5md 1 true.h5 position velocity image species", "run 3"};
    (void)argc;
    (void)argv;
    hs_fuzz_enter();
    hs_deck *deck = hs_fuzz_deck(false);
    hs_fuzz_run(deck, system_lines, N_SYSTEM);
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

/** Nine bytes: the dataset, and the bits that one of its elements gets. */
static void change(hid_t file, const uint8_t *bytes)
{
    hid_t set = H5Dopen2(file, names[bytes[0] % n_names], H5P_DEFAULT), type = H5Dget_type(set);
    const hid_t space = H5Dget_space(set);
    const size_t n = (size_t)H5Sget_simple_extent_npoints(space), size = H5Tget_size(type);
    uint8_t *values = calloc(n + 1, size);
    if (n > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0) {
        memcpy(values + (bytes[1] % n) * size, bytes + 1, size < 8 ? size : 8);
        if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) abort();
    }
    free(values);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
}

static void make_h5md(const uint8_t *data, size_t size)
{
    hs_fuzz_write("fuzz.dump", whole, n_whole);
    const hid_t file = H5Fopen("fuzz.dump", H5F_ACC_RDWR, H5P_DEFAULT);
    if (file < 0) abort();
    for (size_t at = 0; at + 9 <= size; at += 9) change(file, data + at);
    H5Fclose(file);
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
        make_h5md(data + 1, size - 1);
    else
        hs_fuzz_write("fuzz.dump", data + 1, size - 1);
    hs_deck *deck = hs_fuzz_deck(false);
    hs_fuzz_run(deck, system_lines, N_SYSTEM);
    hs_fuzz_judge(hs_deck_command(deck, lines[kind], &err), &err);
    hs_deck_destroy(&deck);
    return 0;
}
