#define _GNU_SOURCE
#include "support/harness.h"

#include <ftw.h>
#include <stdio.h>
#include <unistd.h>

int hs_test_main(const char *suite_name, const hs_test_loop *tests, size_t n_tests)
{
    Suite *suite = suite_create(suite_name);
    TCase *tcase = tcase_create("all");
    tcase_set_timeout(tcase, 0); /* CTest has one */
    for (size_t k = 0; k < n_tests; ++k) tcase_add_loop_test(tcase, tests[k].test, 0, tests[k].n);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

static char folder[32];

void hs_test_enter_folder(void)
{
    snprintf(folder, sizeof folder, "/tmp/halfshell-test-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_int_eq(chdir(folder), 0);
}

static int remove_one(const char *path, const struct stat *info, int type, struct FTW *place)
{
    (void)info;
    (void)type;
    (void)place;
    return remove(path);
}

void hs_test_leave_folder(void)
{
    ck_assert_int_eq(chdir("/"), 0);
    ck_assert_int_eq(nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS), 0);
}
