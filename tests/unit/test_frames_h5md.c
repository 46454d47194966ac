/* H5MD files that are not as they should be: refused, whatever stands in them. */
#include <hdf5.h>
#include <string.h>

#include "io/frames.h"
#include "support/harness.h"

static void put(hid_t file, const char *path, hid_t type, int rank, const hsize_t *extents, const void *values)
{
    const hid_t links = H5Pcreate(H5P_LINK_CREATE), space = H5Screate_simple(rank, extents, NULL);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t set = H5Dcreate2(file, path, type, space, links, H5P_DEFAULT, H5P_DEFAULT);
    ck_assert_int_ge(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(links);
}

/** Two frames of two atoms, with one step between frames, of which the attribute `offset` has n_offsets numbers. */
static void write_file(int64_t second_id, hsize_t n_offsets)
{
    const hsize_t of_positions[3] = {2, 2, 3}, of_ids[2] = {2, 2};
    const double positions[12] = {1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0};
    const int64_t ids[4] = {1, second_id, 1, second_id}, every = 10;
    static const int64_t offsets[1000] = {5};
    const hid_t file = H5Fcreate("frames.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const char *const elements[] = {"position", "id"};
    put(file, "particles/all/position/value", H5T_NATIVE_DOUBLE, 3, of_positions, positions);
    put(file, "particles/all/id/value", H5T_NATIVE_INT64, 2, of_ids, ids);
    for (int k = 0; k < 2; ++k) {
        char path[64];
        snprintf(path, sizeof path, "particles/all/%s/step", elements[k]);
        put(file, path, H5T_NATIVE_INT64, 0, NULL, &every);
        const hid_t set = H5Dopen2(file, path, H5P_DEFAULT), space = H5Screate_simple(1, &n_offsets, NULL);
        const hid_t offset = H5Acreate2(set, "offset", H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT);
        ck_assert_int_ge(H5Awrite(offset, H5T_NATIVE_INT64, offsets), 0);
        H5Aclose(offset);
        H5Sclose(space);
        H5Dclose(set);
    }
    H5Fclose(file);
}

/** Read all frames; the number of rows of all. */
static hs_status read_file(int64_t *last_step, int *n_rows, hs_error *err)
{
    const char *const name = "frames.h5";
    const hs_parallel alone = {.n_ranks = 1};
    const hs_frames_plan plan = {.file = &name,
                                 .n_files = 1,
                                 .format = HS_FRAMES_H5MD,
                                 .wants = {[HS_FIELD_X] = true, [HS_FIELD_Y] = true, [HS_FIELD_Z] = true}};
    hs_frames *frames;
    hs_snapshot snapshot;
    hs_frame_rows rows = {.n = 0};
    bool is_there = true;
    *n_rows = 0;
    hs_status status = hs_frames_open(&frames, &plan, &alone, err);
    while (status == HS_OK && is_there) {
        status = hs_frames_next(frames, &snapshot, &is_there, err);
        if (status == HS_OK && is_there) *last_step = snapshot.step;
        do {
            if (status == HS_OK && is_there) status = hs_frames_read(frames, &rows, err);
            *n_rows += status == HS_OK && is_there ? rows.n : 0;
        } while (status == HS_OK && is_there && rows.n > 0);
    }
    if (frames != NULL) hs_frames_close(&frames);
    return status;
}

static void refuse(const char *words)
{
    int64_t step;
    int n_rows;
    hs_error err = {0};
    ck_assert_int_eq(read_file(&step, &n_rows, &err), HS_ERROR_INPUT);
    ck_assert_msg(strstr(err.text, words) != NULL, "'%s' is not in '%s'", words, err.text);
}

START_TEST(test_steps_and_ids)
{
    int64_t step = -1;
    int n_rows;
    hs_error err = {0};
    hs_test_enter_folder();
    write_file(2, 1);
    ck_assert_hs_ok(read_file(&step, &n_rows, &err), err);
    ck_assert_int_eq(step, 15);
    ck_assert_int_eq(n_rows, 4);
    write_file(2, 1000); /* more numbers than there is room for */
    refuse("the step of a frame cannot be read");
    write_file(INT64_MAX, 1);
    refuse("an id in it is above 2^62");
    hs_test_leave_folder();
}
END_TEST

HS_TEST_MAIN("frames_h5md", test_steps_and_ids)
