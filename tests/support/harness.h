/** One main() for all Check programs of the tests. */
#ifndef HS_TESTS_HARNESS_H
#define HS_TESTS_HARNESS_H

#include <check.h>
#include <stdlib.h>

/** HS_TEST_MAIN("suite", test_a, test_b, ...): runs the tests one after the other in one process each. */
#define HS_TEST_MAIN(suite_name, ...)                                                                                  \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        const TTest *const tests[] = {__VA_ARGS__};                                                                    \
        Suite *suite = suite_create(suite_name);                                                                       \
        TCase *tcase = tcase_create("all");                                                                            \
        tcase_set_timeout(tcase, 0);                                                                                   \
        for (size_t i = 0; i < sizeof tests / sizeof tests[0]; ++i) tcase_add_test(tcase, tests[i]);                   \
        suite_add_tcase(suite, tcase);                                                                                 \
        SRunner *runner = srunner_create(suite);                                                                       \
        srunner_run_all(runner, CK_NORMAL);                                                                            \
        int n_failed = srunner_ntests_failed(runner);                                                                  \
        srunner_free(runner);                                                                                          \
        return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;                                                            \
    }

/** Assert that an hs_status is HS_OK, showing the error text otherwise. */
#define ck_assert_hs_ok(call, err) ck_assert_msg((call) == HS_OK, "%s:%ld: %s", (err).file, (err).line, (err).text)

#endif
