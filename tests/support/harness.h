/** One main() for all Check programs of the tests. */
#ifndef HS_TESTS_HARNESS_H
#define HS_TESTS_HARNESS_H

#include <check.h>
#include <stdlib.h>

/** A test, run with _i from 0 to n - 1. */
typedef struct hs_test_loop {
    const TTest *test;
    int n;
} hs_test_loop;

/** Runs the tests one after the other, each in a process of its own; returns what main returns. */
int hs_test_main(const char *suite_name, const hs_test_loop *tests, size_t n_tests);

/** HS_LOOP_TEST_MAIN("suite", {test_a, 7}, {test_b, 1}, ...): test_a seven times, with _i from 0 to 6. */
#define HS_LOOP_TEST_MAIN(suite_name, ...)                                                                             \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        const hs_test_loop tests[] = {__VA_ARGS__};                                                                    \
        return hs_test_main(suite_name, tests, sizeof tests / sizeof tests[0]);                                        \
    }

/** HS_TEST_MAIN("suite", test_a, test_b, ...): each test once. */
#define HS_TEST_MAIN(suite_name, ...)                                                                                  \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        const TTest *const once[] = {__VA_ARGS__};                                                                     \
        hs_test_loop tests[sizeof once / sizeof once[0]];                                                              \
        for (size_t k = 0; k < sizeof once / sizeof once[0]; ++k) tests[k] = (hs_test_loop){once[k], 1};               \
        return hs_test_main(suite_name, tests, sizeof once / sizeof once[0]);                                          \
    }

/** Assert that an hs_status is HS_OK, showing the error text otherwise. */
#define ck_assert_hs_ok(call, err) ck_assert_msg((call) == HS_OK, "%s:%ld: %s", (err).file, (err).line, (err).text)

/** An empty folder of its own becomes the working directory; leaving it removes it with all that is in it. */
void hs_test_enter_folder(void);
void hs_test_leave_folder(void);

#endif
