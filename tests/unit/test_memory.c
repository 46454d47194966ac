/* Arrays: aligned and zeroed, sizes checked; scratch and lists that grow. */
#include <check.h>
#include <stdint.h>

#include "base/memory.h"
#include "support/harness.h"

static bool is_aligned(const void *array) { return (uintptr_t)array % HS_ALIGNMENT == 0; }

/** Sizes on both sides of where arrays become mappings of their own. */
START_TEST(new_arrays_are_zeros)
{
    const size_t sizes[] = {0, 1, 1000, 1000000};
    for (int k = 0; k < 4; ++k) {
        double *array;
        hs_error err = {0};
        ck_assert_int_eq(HS_ALLOC(array, sizes[k], &err), HS_OK);
        ck_assert(array != NULL && is_aligned(array));
        for (size_t i = 0; i < sizes[k]; ++i) ck_assert(array[i] == 0.0);
        HS_FREE(array);
        ck_assert(array == NULL);
    }
}
END_TEST

START_TEST(sizes_beyond_memory_are_refused)
{
    double *array;
    hs_error err = {0};
    ck_assert_int_eq(HS_ALLOC(array, SIZE_MAX / 4, &err), HS_ERROR_MEMORY);
    ck_assert(array == NULL);
}
END_TEST

START_TEST(scratch_has_room)
{
    int *scratch = NULL;
    size_t capacity = 0;
    hs_error err = {0};
    const size_t wanted[] = {0, 5, 3, 2000000, 7}; /* n = 0, too: an array there is */
    for (int k = 0; k < 5; ++k) {
        const int *before = scratch;
        const size_t capacity_before = capacity;
        ck_assert_int_eq(HS_RESERVE(scratch, capacity, wanted[k], &err), HS_OK);
        ck_assert(scratch != NULL && capacity >= wanted[k]);
        if (before != NULL && wanted[k] <= capacity_before) ck_assert(scratch == before && capacity == capacity_before);
        for (size_t i = 0; i < wanted[k]; ++i) scratch[i] = (int)i;
    }
    HS_FREE(scratch);
}
END_TEST

START_TEST(lists_keep_what_they_have)
{
    int64_t *list = NULL;
    size_t capacity = 0;
    int n_grown = 0;
    hs_error err = {0};
    for (int n = 0; n < 100000; ++n) {
        const size_t before = capacity;
        ck_assert_int_eq(HS_EXTEND(list, n, capacity, &err), HS_OK);
        ck_assert_uint_gt(capacity, (size_t)n);
        n_grown += capacity != before;
        list[n] = 3 * n;
    }
    for (int n = 0; n < 100000; ++n) ck_assert_int_eq(list[n], 3 * n);
    ck_assert_int_le(n_grown, 14); /* 16 (2^14 - 1) is more: copies cost a constant each element */
    HS_FREE(list);
}
END_TEST

HS_TEST_MAIN("memory", new_arrays_are_zeros, sizes_beyond_memory_are_refused, scratch_has_room,
             lists_keep_what_they_have)
