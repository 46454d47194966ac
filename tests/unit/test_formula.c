/* Formulas: grammar, precedence and numbers as LAMMPS has them. Expected values were printed by lmp (29 Sep 2021). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "deck/boolean.h"
#include "deck/formula.h"
#include "support/harness.h"
#include "support/run_deck.h"

/** The formula's value printed with %.17g. */
static void check_value(hs_deck *deck, const char *text, const char *expected)
{
    hs_error err = {0};
    double value = 0.0;
    char printed[64];
    ck_assert_msg(hs_formula_once(deck, text, &value, &err) == HS_OK, "%s: %s", text, err.text);
    snprintf(printed, sizeof printed, "%.17g", value);
    ck_assert_msg(strcmp(printed, expected) == 0, "%s is %s, expected %s", text, printed, expected);
}

static void check_table(const char *const (*cases)[2], size_t n)
{
    hs_deck *deck = hs_test_new_deck();
    for (size_t i = 0; i < n; ++i) check_value(deck, cases[i][0], cases[i][1]);
    hs_deck_destroy(&deck);
}

#define CHECK_TABLE(cases) check_table(cases, sizeof cases / sizeof cases[0])

START_TEST(operators_bind_as_in_lammps)
{
    static const char *const cases[][2] = {
        {"1+2*3-4/2", "5"}, {"-2^2", "4"},    {"2^3^2", "64"},  {"2^-1", "0.5"},  {"2*-3", "-6"},  {"- -3", "3"},
        {"7%3", "1"},       {"-7%3", "-1"},   {"(1+2)*3", "9"}, {"8/4/2", "1"},   {"2-3-4", "-5"}, {"1<2==1", "1"},
        {"3>2>1", "0"},     {"1||0&&0", "1"}, {"1|^1", "0"},    {"1|^0", "1"},    {"!0", "1"},     {"!3", "0"},
        {"1+!0", "2"},      {"1 != 2", "1"},  {"2>=2", "1"},    {"2<=1", "0"},    {"0^0", "1"},    {"  1  ", "1"},
        {"((((7))))", "7"}, {"!1==0", "1"},   {"2*3%4", "2"},   {"1&&2&&0", "0"},
    };
    CHECK_TABLE(cases);
}
END_TEST

START_TEST(numbers_and_constants)
{
    static const char *const cases[][2] = {
        {"1.5e3", "1500"},
        {".5", "0.5"},
        {"1E-3", "0.001"},
        {"1e+2", "100"},
        {"3.", "3"},
        {"PI", "3.1415926535897931"},
        {"version", "20210929"},
        {"yes", "1"},
        {"no", "0"},
        {"on", "1"},
        {"off", "0"},
        {"true", "1"},
        {"false", "0"},
    };
    CHECK_TABLE(cases);
}
END_TEST

START_TEST(functions)
{
    static const char *const cases[][2] = {
        {"sqrt(2)", "1.4142135623730951"},
        {"exp(1)", "2.7182818284590451"},
        {"ln(2)", "0.69314718055994529"},
        {"log(100)", "2"},
        {"abs(-3)", "3"},
        {"sin(1)", "0.8414709848078965"},
        {"cos(1)", "0.54030230586813977"},
        {"tan(1)", "1.5574077246549023"},
        {"asin(0.5)", "0.52359877559829893"},
        {"acos(0.5)", "1.0471975511965979"},
        {"atan(1)", "0.78539816339744828"},
        {"atan2(1,2)", "0.46364760900080609"},
        {"ceil(1.2)", "2"},
        {"floor(-1.2)", "-2"},
        {"round(2.5)", "3"},
        {"round(-2.5)", "-2"},
        {"sqrt(sqrt(16))", "2"},
        {"atan2( 1 , sqrt(4) )", "0.46364760900080609"},
        {"is_defined(group,all)", "1"},
        {"is_defined(variable,nothing)", "0"},
        {"is_available(command,run)", "1"},
        {"is_available(pair,eam)", "0"},
        {"is_file(/)", "1"},
        {"is_file(/nowhere)", "0"},
    };
    CHECK_TABLE(cases);
}
END_TEST

START_TEST(random_numbers_are_those_of_lammps)
{
    /* The seeds after the first call's have no effect: one generator serves all formulas of a deck. */
    static const char *const cases[][2] = {
        {"random(0,1,12345)", "0.86995309591293335"},
        {"random(0,1,999)", "0.010425925254821777"},
        {"normal(0,1,7)", "-0.22060725448637514"},
        {"random(2,5,3)", "3.9327452778816223"},
    };
    CHECK_TABLE(cases);
}
END_TEST

START_TEST(functions_of_time)
{
    /* step, then stagger(100,10), logfreq(10,3,10), logfreq2(1,7,2), logfreq3(1,10,1000), stride(30,777,10),
     * stride2(10,1000,100,200,300,10), as printed by lmp */
    static const char *const formulas[] = {"stagger(100,10)",   "logfreq(10,3,10)",
                                           "logfreq2(1,7,2)",   "logfreq3(1,10,1000)",
                                           "stride(30,777,10)", "stride2(10,1000,100,200,300,10)"};
    static const struct {
        int step;
        const char *values[6];
    } cases[] = {
        {0, {"10", "10", "1", "1", "30", "10"}},
        {5, {"10", "10", "6", "11", "30", "10"}},
        {10, {"100", "20", "11", "11", "30", "110"}},
        {11, {"100", "20", "12", "22", "30", "110"}},
        {77, {"100", "100", "83", "101", "80", "110"}},
        {100, {"110", "200", "101", "101", "110", "110"}},
        {299, {"300", "300", "330", "465", "300", "300"}},
        {450, {"500", "1000", "476", "465", "460", "510"}},
        {777, {"800", "1000", "805", "1000", "9.2233720368547758e+18", "810"}},
        {999, {"1000", "1000", "1024", "1000", "9.2233720368547758e+18", "1010"}},
    };
    hs_deck *deck = hs_test_new_deck();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        deck->sim->env.step = cases[i].step;
        for (int k = 0; k < 6; ++k) check_value(deck, formulas[k], cases[i].values[k]);
    }
    hs_deck_destroy(&deck);
}
END_TEST

/** Eight atoms of two types at the corners of a cube of edge 1, with unit velocities along x for the odd ids. */
static hs_deck *deck_with_cube(void)
{
    hs_deck *deck = hs_test_new_deck();
    hs_test_command(deck, "lattice sc 1.0");
    hs_test_command(deck, "region b block 0 2 0 2 0 2");
    hs_test_command(deck, "create_box 2 b");
    hs_test_command(deck, "create_atoms 1 box");
    hs_test_command(deck, "mass 1 1.0");
    hs_test_command(deck, "mass 2 3.0");
    hs_test_command(deck, "set atom 8 type 2");
    hs_test_command(deck, "region lower block INF INF INF INF INF 0.5");
    hs_test_command(deck, "group low region lower");
    for (int i = 0; i < deck->sim->atoms.n_local; ++i)
        deck->sim->atoms.v[0][i] = deck->sim->atoms.id[i] % 2 == 1 ? 1.0 : 0.0;
    return deck;
}

START_TEST(group_functions)
{
    static const char *const cases[][2] = {
        {"count(all)", "8"},
        {"count(low)", "4"},
        {"count(all,lower)", "4"},
        {"mass(all)", "10"},
        {"mass(low)", "4"},
        {"xcm(all,x)", "0.59999999999999998"},
        {"xcm(low,z)", "0"},
        {"vcm(all,x)", "0.40000000000000002"},
        {"vcm(low,x)", "0.5"},
        {"fcm(all,y)", "0"},
        {"bound(all,xmax)", "1"},
        {"bound(low,zmax)", "0"},
        {"bound(all,ymin)", "0"},
        {"ke(all)", "2"},
        {"ke(all,lower)", "1"},
        {"gyration(low)", "0.70710678118654757"},
        {"angmom(low,z)", "0"},
        {"inertia(low,zz)", "2"},
        {"x[8]+y[8]+z[8]", "3"},
        {"type[8]*mass[8]", "6"},
        {"vx[1]", "1"},
        {"id[5]", "5"},
        {"atoms", "8"},
        {"lx*ly*lz", "8"},
    };
    hs_deck *deck = deck_with_cube();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) check_value(deck, cases[i][0], cases[i][1]);
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(atom_style_formulas_give_one_value_per_atom)
{
    hs_deck *deck = deck_with_cube();
    hs_error err = {0};
    double values[8];
    hs_formula *formula = NULL;
    ck_assert_hs_ok(
        hs_formula_parse(&formula, "id+10*type+x*y*gmask(low)-v_two*rmask(lower)+count(all)", HS_VALUE_ATOMS, &err),
        err);
    hs_test_command(deck, "variable two equal 2");
    ck_assert_hs_ok(hs_formula_atoms(formula, deck, values, &err), err);
    const hs_atoms *atoms = &deck->sim->atoms;
    for (int i = 0; i < 8; ++i) {
        const double low = atoms->x[2][i] < 0.5;
        const double expected =
            (double)atoms->id[i] + 10.0 * atoms->type[i] + atoms->x[0][i] * atoms->x[1][i] * low - 2.0 * low + 8.0;
        ck_assert_double_eq(values[i], expected);
    }
    hs_formula_destroy(&formula);
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(random_numbers_per_atom_depend_on_id_and_draw_only)
{
    hs_error err = {0};
    double first[8], second[8], again[8];
    hs_formula *formula = NULL;
    ck_assert_hs_ok(hs_formula_parse(&formula, "random(0,1,4711)", HS_VALUE_ATOMS, &err), err);
    hs_deck *deck = deck_with_cube();
    ck_assert_hs_ok(hs_formula_atoms(formula, deck, first, &err), err);
    ck_assert_hs_ok(hs_formula_atoms(formula, deck, second, &err), err);
    hs_deck_destroy(&deck);
    deck = deck_with_cube();
    const int32_t order[8] = {7, 6, 5, 4, 3, 2, 1, 0};
    ck_assert_hs_ok(hs_atoms_permute(&deck->sim->atoms, order, &err), err);
    ck_assert_hs_ok(hs_formula_atoms(formula, deck, again, &err), err);
    for (int i = 0; i < 8; ++i) {
        ck_assert(first[i] > 0.0 && first[i] < 1.0);
        ck_assert_double_ne(first[i], second[i]);
        ck_assert_double_eq(first[i], again[7 - i]);
    }
    hs_formula_destroy(&formula);
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(deep_formulas_are_refused_and_long_ones_are_not)
{
    hs_error err = {0};
    hs_text text = {0};
    double value;
    hs_deck *deck = hs_test_new_deck();
    for (int i = 0; i < 100000; ++i) ck_assert_hs_ok(hs_text_printf(&text, &err, "1+"), err);
    ck_assert_hs_ok(hs_text_printf(&text, &err, "1"), err);
    ck_assert_hs_ok(hs_formula_once(deck, hs_text_get(&text), &value, &err), err);
    ck_assert_double_eq(value, 100001.0);
    hs_text_clear(&text);
    for (int i = 0; i < 100000; ++i) ck_assert_hs_ok(hs_text_printf(&text, &err, "%c", i % 2 == 0 ? '(' : '-'), err);
    ck_assert_int_eq(hs_formula_once(deck, hs_text_get(&text), &value, &err), HS_ERROR_INPUT);
    hs_text_fini(&text);
    hs_deck_destroy(&deck);
}
END_TEST

START_TEST(conditions_of_if)
{
    static const struct {
        const char *text;
        bool holds;
    } cases[] = {
        {"1", true},
        {"0.0", false},
        {"1 == 1", true},
        {"abc==abc", true},
        {"abc != abd && 2 < 3", true},
        {"!(1 == 2)", true},
        {"1e2 == 100", true},
        {"1 |^ 1", false},
        {"-1 < 2", true},
        {"a/b == a/b", true},
        {"1 == 2 || 3 >= 3", true},
        {"1 || 0 && 0", true},
        {"(1 || 0) && 0", false},
        {"2 > 1 == 1", true},
        {"in.melt != in.flow", true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        hs_error err = {0};
        bool holds;
        ck_assert_hs_ok(hs_boolean_eval(cases[i].text, &holds, &err), err);
        ck_assert_msg(holds == cases[i].holds, "%s", cases[i].text);
    }
}
END_TEST

HS_TEST_MAIN("formula", operators_bind_as_in_lammps, numbers_and_constants, functions,
             random_numbers_are_those_of_lammps, functions_of_time, group_functions,
             atom_style_formulas_give_one_value_per_atom, random_numbers_per_atom_depend_on_id_and_draw_only,
             deep_formulas_are_refused_and_long_ones_are_not, conditions_of_if)
