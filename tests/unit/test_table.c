/* Reading tables from the files that runs leave behind, and what their columns are called on axes. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "io/quantity.h"
#include "io/table.h"
#include "support/harness.h"
#include "support/run_deck.h"

static char path[64];

static void write_file(const char *text)
{
    snprintf(path, sizeof path, "/tmp/halfshell-table-%d", (int)getpid());
    hs_test_write_file(path, text);
}

static hs_table_file read_good(const char *text)
{
    hs_table_file file;
    hs_error err = {0};
    write_file(text);
    ck_assert_hs_ok(hs_table_file_read(&file, path, &err), err);
    unlink(path);
    return file;
}

static void expect_error(const char *text, long line, const char *part)
{
    hs_table_file file;
    hs_error err = {0};
    write_file(text);
    ck_assert(hs_table_file_read(&file, path, &err) == HS_ERROR_INPUT);
    unlink(path);
    ck_assert_msg(strstr(err.text, part) != NULL, "expected '%s' in '%s'", part, err.text);
    ck_assert_int_eq(err.line, line);
    hs_table_file_fini(&file);
}

#define MEMORY "Per MPI rank memory allocation (min/avg/max) = 1 | 1 | 1 Mbytes\n"

START_TEST(logs)
{
    hs_table_file file =
        read_good("units lj\nStep Temp in a comment\n" MEMORY "Step Temp Press \n 0 1.5 -2\n"
                  "WARNING: something\n 10 1.25 inf\nLoop time of 1\n0 1 2\n" MEMORY "Step Temp\n 10 1.25\n 20 1\n 3");
    ck_assert_int_eq(file.kind, HS_TABLE_LOG);
    ck_assert_int_eq(file.n_tables, 2);
    ck_assert_int_eq(file.table[0].n_rows, 2); /* neither the warning nor what follows the run */
    ck_assert_int_eq(file.table[0].n_columns, 3);
    ck_assert_double_eq(file.table[0].column[1].value[1], 1.25);
    ck_assert(isinf(file.table[0].column[2].value[1]));
    ck_assert_int_eq(file.table[1].n_rows, 2); /* the line that was being written is no row */
    hs_table_file_fini(&file);
}
END_TEST

START_TEST(logs_of_style_multi)
{
    hs_table_file file =
        read_good(MEMORY "---------------- Step      100 ----- CPU =      0.0000 (sec) ----------------\n"
                         "TotEng   =        -4.6246 KinEng   =         1.1268 Temp     =         0.7521 \n"
                         "Press    =         0.5\n"
                         "---------------- Step      110 ----- CPU =      0.0044 (sec) ----------------\n"
                         "TotEng   =        -4.6248 KinEng   =         1.1484 Temp     =         0.7665 \n"
                         "Press    =         0.25\nLoop time of 1\n");
    ck_assert_int_eq(file.n_tables, 1);
    ck_assert_int_eq(file.table[0].n_rows, 2);
    ck_assert_int_eq(hs_table_find(&file.table[0], "Step"), 0);
    ck_assert_double_eq(file.table[0].column[0].value[1], 110.0);
    ck_assert_double_eq(file.table[0].column[hs_table_find(&file.table[0], "Press")].value[1], 0.25);
    hs_table_file_fini(&file);
}
END_TEST

START_TEST(files_of_fixes)
{
    hs_table_file series = read_good("# Time-averaged data for fix b\n# TimeStep c_msd[4] v_a\n0 0 1.44\n10 0.5 1\n");
    ck_assert_int_eq(series.kind, HS_TABLE_SERIES);
    ck_assert_str_eq(series.about, "Time-averaged data for fix b");
    ck_assert_int_eq(series.table[0].n_rows, 2);
    ck_assert_str_eq(series.table[0].column[1].name, "c_msd[4]");
    hs_table_file_fini(&series);
    /* the line of a block has as many words as its rows: only its header tells them apart */
    hs_table_file blocks = read_good("# Chunk-averaged data for fix c and group all\n"
                                     "# Timestep Number-of-chunks Total-count\n# Chunk Ncount temp\n"
                                     "50 2 864\n  1 101 0.5\n  2 79 0.75\n100 2 864\n  1 99 0.25\n  2 80 1\n");
    ck_assert_int_eq(blocks.kind, HS_TABLE_BLOCKS);
    ck_assert_int_eq(blocks.n_tables, 2);
    ck_assert_int_eq(blocks.table[1].step, 100);
    ck_assert_int_eq(blocks.table[1].n_rows, 2);
    ck_assert_double_eq(blocks.table[1].column[2].value[0], 0.25);
    hs_table_file_fini(&blocks);
}
END_TEST

START_TEST(csv)
{
    hs_table_file file = read_good("method, threads,\"rate, \"\"fast\"\"\"\r\ncluster,1,10\r\n\"a,b\",2,19\r\n");
    ck_assert_int_eq(file.kind, HS_TABLE_CSV);
    ck_assert_str_eq(file.table[0].column[1].name, "threads");
    ck_assert_str_eq(file.table[0].column[2].name, "rate, \"fast\"");
    ck_assert_str_eq(file.table[0].column[0].word[1], "a,b");
    ck_assert_double_eq(file.table[0].column[2].value[1], 19.0);
    hs_table_file_fini(&file);
    hs_table_file plain = read_good("1 2\n3 4\n");
    ck_assert_str_eq(plain.table[0].column[1].name, "2");
    ck_assert_int_eq(plain.table[0].n_rows, 2);
    hs_table_file_fini(&plain);
}
END_TEST

START_TEST(many_columns)
{
    hs_text text = {0};
    hs_error err = {0};
    for (int row = 0; row < 2; ++row)
        for (int k = 0; k < 500; ++k)
            ck_assert_hs_ok(hs_text_printf(&text, &err, row == 0 ? "name%d%c" : "%d%c", k, k < 499 ? ',' : '\n'), err);
    hs_table_file file = read_good(hs_text_get(&text));
    ck_assert_int_eq(file.table[0].n_columns, 500);
    ck_assert_double_eq(file.table[0].column[499].value[0], 499.0);
    hs_table_file_fini(&file);
    hs_text_fini(&text);
}
END_TEST

START_TEST(bad_files)
{
    expect_error("", 0, "is empty");
    expect_error("a,b\n1,2\n1,2,3\n", 3, "this row has 3 cells, but there are 2 columns");
    expect_error("some prose without numbers\nand more\n", 2, "neither a log, nor a fix's output, nor CSV");
    expect_error("a,b\n", 0, "holds no rows of numbers");
    expect_error(MEMORY "Step Temp\nLoop time", 0, "no run in it got as far as its first thermo line");
    expect_error("# x\n# TimeStep a\n1 2\n3 4 5\n", 4, "this row has 3 words, but there are 2 columns");
    expect_error("# x\n# Timestep Number-of-rows\n# Row a\n1 1\n1 2\nnext 1\n", 6, "a step and a number of rows");
}
END_TEST

static void expect_label(const hs_deck_facts *facts, const char *column, const char *label)
{
    hs_text text = {0};
    hs_error err = {0};
    ck_assert_hs_ok(hs_quantity_label(&text, column, facts, &err), err);
    ck_assert_str_eq(hs_text_get(&text), label);
    hs_text_fini(&text);
}

START_TEST(labels)
{
    hs_deck_facts facts = {0};
    hs_error err = {0};
    expect_label(&facts, "Temp", "temperature");
    expect_label(&facts, "c_x[2]", "c_x[2]");
    ck_assert_hs_ok(hs_deck_facts_learn(&facts,
                                        "units\t lj\r\ndimension 2 # flat\ntimestep 0.001\ncompute r all rdf 50\n"
                                        "compute m all msd\ncompute v all vacf",
                                        &err),
                    err);
    ck_assert_double_eq(facts.dt, 0.001);
    expect_label(&facts, "Temp", "temperature (ε/k)");
    expect_label(&facts, "TotEng", "energy per atom (ε)");
    expect_label(&facts, "Volume", "volume (σ²)");
    expect_label(&facts, "c_r[1]", "distance r (σ)");
    expect_label(&facts, "c_r[4]", "pair correlation g(r)");
    expect_label(&facts, "c_r[5]", "neighbors within r");
    expect_label(&facts, "c_m[4]", "mean-square displacement (σ²)");
    expect_label(&facts, "c_v[4]", "velocity autocorrelation (σ²/τ²)");
    expect_label(&facts, "c_thermo_press", "pressure (ε/σ²)");
    expect_label(&facts, "v_p*v_p", "autocorrelation of v_p");
    ck_assert_hs_ok(hs_deck_facts_set_units(&facts, "real", &err), err);
    expect_label(&facts, "Press", "pressure (atm)");
    expect_label(&facts, "TotEng", "energy (kcal/mol)");
    expect_label(&facts, "Lx", "box length (Å)");
    ck_assert(hs_deck_facts_set_units(&facts, "metall", &err) == HS_ERROR_INPUT);
    ck_assert_msg(strstr(err.text, "did you mean 'metal'?") != NULL, "%s", err.text);
    hs_deck_facts_fini(&facts);
}
END_TEST

HS_TEST_MAIN("tables", logs, logs_of_style_multi, files_of_fixes, csv, many_columns, bad_files, labels)
