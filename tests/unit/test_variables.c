/* Variables: styles, order of definition, next, text and numbers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "deck/variables.h"
#include "support/harness.h"
#include "support/run_deck.h"

static void check_text(hs_deck *deck, const char *name, const char *expected)
{
    hs_error err = {0};
    hs_text text = {0};
    ck_assert_hs_ok(hs_variables_text(deck, name, &text, &err), err);
    ck_assert_str_eq(hs_text_get(&text), expected);
    hs_text_fini(&text);
}

static double number(hs_deck *deck, const char *name)
{
    hs_error err = {0};
    double value = 0.0;
    ck_assert_hs_ok(hs_variables_number(deck, name, &value, &err), err);
    return value;
}

START_TEST(each_style_has_its_text)
{
    hs_deck *deck = hs_test_new_deck();
    setenv("HALFSHELL_TEST_VALUE", "from outside", 1);
    hs_test_command(deck, "variable i index first second");
    hs_test_command(deck, "variable l loop 7 12 pad");
    hs_test_command(deck, "variable s string 'two words'");
    hs_test_command(deck, "variable e equal 1/3");
    hs_test_command(deck, "variable f format e %8.3f");
    hs_test_command(deck, "variable g getenv HALFSHELL_TEST_VALUE");
    hs_test_command(deck, "variable n getenv HALFSHELL_TEST_NOTHING");
    hs_test_command(deck, "variable t internal 2.5");
    check_text(deck, "i", "first");
    check_text(deck, "l", "07");
    check_text(deck, "s", "two words");
    check_text(deck, "e", "0.333333333333333");
    check_text(deck, "f", "   0.333");
    check_text(deck, "g", "from outside");
    check_text(deck, "n", "");
    check_text(deck, "t", "2.5");
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(command_line_wins_over_index)
{
    hs_deck *deck = hs_test_new_deck();
    hs_error err = {0};
    const char *const values[] = {"5", "6"};
    ck_assert_hs_ok(hs_deck_set_variable(deck, "T", 2, values, &err), err);
    hs_test_command(deck, "variable T index 1 2 3");
    check_text(deck, "T", "5");
    hs_test_command(deck, "next T");
    check_text(deck, "T", "6");
    ck_assert_int_eq(hs_deck_set_variable(deck, "T", 1, values, &err), HS_ERROR_INPUT);
    ck_assert_str_eq(err.text, "-var T: the variable is given twice");
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(second_definitions)
{
    hs_deck *deck = hs_test_new_deck();
    hs_test_command(deck, "variable i index 1");
    hs_test_command(deck, "variable i index 2");
    check_text(deck, "i", "1");
    hs_test_command(deck, "variable e equal 1");
    hs_test_command(deck, "variable e equal v_i+5");
    check_text(deck, "e", "6");
    hs_test_command(deck, "variable s string a");
    hs_test_command(deck, "variable s string b");
    check_text(deck, "s", "b");
    hs_test_command(deck, "variable e index 3");
    check_text(deck, "e", "6");
    hs_test_command(deck, "variable i delete");
    hs_test_command(deck, "variable i equal 9");
    check_text(deck, "i", "9");
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(a_failed_definition_leaves_the_old_one)
{
    hs_deck *deck = hs_test_new_deck();
    hs_error err = {0};
    hs_test_command(deck, "variable e equal 1");
    ck_assert_int_eq(hs_deck_command(deck, "variable e equal 1+", &err), HS_ERROR_INPUT);
    check_text(deck, "e", "1");
    hs_error_clear(&err);
    ck_assert_int_eq(hs_deck_command(deck, "variable new equal 1+", &err), HS_ERROR_INPUT);
    ck_assert_ptr_null(hs_variables_find(deck->variables, "new"));
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(formulas_see_formulas_rounded_to_15_digits)
{
    /* LAMMPS passes them through their text; the digits of decks depend on it. */
    hs_deck *deck = hs_test_new_deck();
    hs_test_command(deck, "variable e equal 1/3");
    hs_test_command(deck, "variable d equal v_e-1/3");
    ck_assert_double_eq(number(deck, "e"), 1.0 / 3.0);
    check_text(deck, "d", "-3.33066907387547e-16");
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(next_deletes_at_the_end)
{
    hs_deck *deck = hs_test_new_deck();
    hs_error err = {0};
    const char *const words[] = {"i", "j"};
    const hs_args args = {.command = "next", .n = 2, .word = words};
    bool exhausted;
    hs_test_command(deck, "variable i index a b");
    hs_test_command(deck, "variable j index 1 2 3");
    ck_assert_hs_ok(hs_variables_next(deck, &args, &exhausted, &err), err);
    ck_assert(!exhausted);
    check_text(deck, "i", "b");
    check_text(deck, "j", "2");
    ck_assert_hs_ok(hs_variables_next(deck, &args, &exhausted, &err), err);
    ck_assert(exhausted);
    ck_assert_ptr_null(hs_variables_find(deck->variables, "i"));
    ck_assert_ptr_null(hs_variables_find(deck->variables, "j"));
    hs_deck_destroy(&deck);
}
END_TEST

/* The first word of each line that has one; like index they keep their first definition, and end. */
START_TEST(lines_of_a_file)
{
    hs_test_enter_folder();
    hs_test_write_file("values.txt", "# densities\n\n 0.7 liquid\n0.8 # denser\n\t0.9\n");
    hs_test_write_file("others.txt", "1\n");
    hs_deck *deck = hs_test_new_deck();
    hs_test_command(deck, "variable d file values.txt");
    hs_test_command(deck, "variable e equal 2*v_d");
    check_text(deck, "d", "0.7");
    hs_test_command(deck, "variable d file others.txt");
    hs_test_command(deck, "next d");
    check_text(deck, "d", "0.8");
    ck_assert_double_eq(number(deck, "e"), 1.6);
    hs_test_command(deck, "next d");
    check_text(deck, "d", "0.9");
    hs_test_command(deck, "next d");
    ck_assert_ptr_null(hs_variables_find(deck->variables, "d"));
    hs_deck_destroy(&deck);
    hs_test_leave_folder();
}
END_TEST

START_TEST(chains_of_variables_end)
{
    hs_deck *deck = hs_test_new_deck();
    hs_error err = {0};
    double value;
    char line[64];
    for (int i = 0; i < 500; ++i) {
        snprintf(line, sizeof line, "variable a%d equal v_a%d+1", i, i + 1);
        hs_test_command(deck, line);
    }
    ck_assert_int_eq(hs_variables_number(deck, "a0", &value, &err), HS_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(err.text, "more than 100 variables use one another in a chain"));
    hs_error_clear(&err);
    hs_test_command(deck, "variable a50 equal 1");
    ck_assert_hs_ok(hs_variables_number(deck, "a0", &value, &err), err);
    ck_assert_double_eq(value, 51.0);
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(lines_that_grow_without_bound_are_refused)
{
    hs_deck *deck = hs_test_new_deck();
    hs_error err = {0};
    hs_status status = hs_deck_command(deck, "variable a string aaaaaaaaaa", &err);
    for (int i = 0; i < 40 && status == HS_OK; ++i) status = hs_deck_command(deck, "variable a string $a$a", &err);
    ck_assert_int_eq(status, HS_ERROR_INPUT);
    ck_assert_str_eq(err.text, "with its variables replaced the line is longer than 1 MiB");
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(formats_must_have_one_conversion_for_a_number)
{
    static const char *const good[] = {"%g", "%10.4f", "%-8.2e", "%+.0f", "%020.15g", "T = %g K", "%g%%", "%a"};
    static const char *const bad[] = {"",    "x",   "%",      "%d",      "%s", "%n", "%g%g", "%ld",
                                      "%*g", "%Lf", "%9999g", "%.9999f", "%%", "%5", "%hhn"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; ++i)
        ck_assert_msg(hs_format_is_for_double(good[i]), "%s", good[i]);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        ck_assert_msg(!hs_format_is_for_double(bad[i]), "%s", bad[i]);
}
END_TEST

HS_TEST_MAIN("variables", each_style_has_its_text, command_line_wins_over_index, second_definitions,
             a_failed_definition_leaves_the_old_one, formulas_see_formulas_rounded_to_15_digits,
             next_deletes_at_the_end, lines_of_a_file, chains_of_variables_end,
             lines_that_grow_without_bound_are_refused, formats_must_have_one_conversion_for_a_number)
