/* Thermo output byte for byte. The expected tables were printed by LAMMPS of 29 September 2021 for the same decks. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "io/user_format.h"
#include "sim/thermo.h"
#include "support/harness.h"
#include "support/run_deck.h"

static const char solid[] = "lattice fcc 0.8442\n"
                            "region box block 0 3 0 3 0 3\n"
                            "create_box 1 box\n"
                            "create_atoms 1 box\n"
                            "mass 1 1.0\n"
                            "velocity all create 1.44 87287 loop geom\n"
                            "pair_style lj/cut 2.0\n"
                            "pair_coeff 1 1 1.0 1.0 2.0\n"
                            "neighbor 0.3 bin\n"
                            "fix 1 all nve\n"
                            "thermo 5\n";

static char *run(const char *head, const char *tail, hs_error *err)
{
    char deck[8192];
    snprintf(deck, sizeof deck, "%s%s", head, tail);
    return hs_test_run_deck(deck, err);
}

/** The log of solid and the given lines holds the expected text. */
static void expect(const char *lines, const char *text)
{
    hs_error err;
    char *log = run(solid, lines, &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    ck_assert_msg(strstr(log, text) != NULL, "expected:\n%s\nin:\n%s", text, log);
    free(log);
}

static void expect_error(const char *lines, const char *text)
{
    hs_error err;
    char *log = run(solid, lines, &err);
    ck_assert_msg(err.status != HS_OK, "no error for: %s", lines);
    ck_assert_msg(strstr(err.text, text) != NULL, "expected '%s' in '%s'", text, err.text);
    free(log);
}

START_TEST(test_style_one)
{
    expect("run 10\n", "Step Temp E_pair E_mol TotEng Press \n"
                       "       0         1.44   -6.0153586            0   -3.8753586   -3.7664743 \n"
                       "       5    1.3781415   -5.9874133            0   -3.9393418   -3.3241251 \n"
                       "      10    1.1395477   -5.7404966            0   -4.0470022   -1.6553633 \n"
                       "Loop time of ");
}
END_TEST

START_TEST(test_style_multi)
{
    expect("run 10\nthermo_style multi\nrun 0\n",
           "---------------- Step       10 ----- CPU =      0.0000 (sec) ----------------\n"
           "TotEng   =        -4.0470 KinEng   =         1.6935 Temp     =         1.1395 \n"
           "PotEng   =        -5.7405 E_bond   =         0.0000 E_angle  =         0.0000 \n"
           "E_dihed  =         0.0000 E_impro  =         0.0000 E_vdwl   =        -5.7405 \n"
           "E_coul   =         0.0000 E_long   =         0.0000 Press    =        -1.6554 \n");
    expect("thermo_style custom step temp dt pe\nthermo_modify line multi\nrun 0\n",
           "Step     =              0 Temp     =         1.4400 Dt       =         0.0050 \n"
           "PotEng   =        -6.0154 \n");
    expect("run 35\nthermo_style multi\nthermo_modify line one norm no\nrun 0\n",
           "TotEng KinEng Temp PotEng E_bond E_angle E_dihed E_impro E_vdwl E_coul E_long Press \n"
           "    -445.938    112.63418   0.70177059   -558.57218            0            0            0            0   "
           "-558.57218            0            0    1.5934932 \n");
}
END_TEST

START_TEST(test_energies)
{
    expect("run 20\nthermo_style custom step atoms temp press pe ke etotal evdwl ecoul epair ebond eangle edihed eimp "
           "emol "
           "elong etail enthalpy ecouple econserve vol density\nrun 5\n",
           "Step Atoms Temp Press PotEng KinEng TotEng E_vdwl E_coul E_pair E_bond E_angle E_dihed E_impro E_mol "
           "E_long E_tail "
           "Enthalpy Ecouple Econserve Volume Density \n"
           "      20      108   0.64020368    1.8430933   -5.0698349   0.95141381   -4.1184211   -5.0698349            "
           "0   "
           "-5.0698349            0            0            0            0            0            0            0   "
           "-1.9351786            0   -4.1184211    127.93177       0.8442 \n");
}
END_TEST

START_TEST(test_box_and_pressure)
{
    expect("run 25\nthermo_style custom step lx ly lz xlo xhi ylo yhi zlo zhi xy xz yz xlat ylat zlat bonds angles "
           "dihedrals "
           "impropers pxx pyy pzz pxy pxz pyz fmax fnorm cella cellb cellc cellalpha cellbeta cellgamma\nrun 0\n",
           "Step Lx Ly Lz Xlo Xhi Ylo Yhi Zlo Zhi Xy Xz Yz Xlat Ylat Zlat Bonds Angles Diheds Impros Pxx Pyy Pzz Pxy "
           "Pxz Pyz "
           "Fmax Fnorm Cella Cellb Cellc CellAlpha CellBeta CellGamma \n"
           "      25    5.0387886    5.0387886    5.0387886            0    5.0387886            0    5.0387886        "
           "    0    "
           "5.0387886            0            0            0    1.6795962    1.6795962    1.6795962        0        0  "
           "      0  "
           "      0    1.4398649    1.5826709    1.5371651  0.057096932  -0.37300768   0.34008996    41.607027    "
           "239.57947    "
           "5.0387886    5.0387886    5.0387886           90           90           90 \n");
}
END_TEST

START_TEST(test_computes)
{
    expect("compute p all pressure NULL virial\ncompute p2 all pressure thermo_temp ke\n"
           "compute p3 all pressure thermo_temp pair\ncompute ke all ke\ncompute pe2 all pe pair\n"
           "thermo_style custom step c_p c_p[1] c_p2 c_p3 c_ke c_thermo_pe c_pe2\nrun 5\n",
           "Step c_p c_p[1] c_p2 c_p3 c_ke c_thermo_pe c_pe2 \n"
           "       0   -4.9708663   -4.9708663     1.204392   -4.9708663         2.14   -6.0153586   -6.0153586 \n"
           "       5   -4.4767797   -4.4996292    1.1526546   -4.4767797    2.0480715   -5.9874133   -5.9874133 \n");
    expect("run 40\ncompute t all temp\ncompute p all pressure thermo_temp\n"
           "thermo_style custom step c_t c_t[1] c_p[2] c_p c_p[*]\n"
           "thermo_modify format float %15.5f format int %6d format 2 |%g|\nrun 0\n",
           "Step c_t c_t[1] c_p[2] c_p c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6] \n"
           "    40 |0.700137|         0.65988         2.04032         1.57154         1.42770         2.04032         "
           "1.24659    "
           "     0.36198        -0.70384        -0.16150 \n");
}
END_TEST

START_TEST(test_line_format)
{
    /* a column's format wins over that of its kind, this over the line's */
    expect("thermo_style custom step temp press vol\n"
           "thermo_modify format line \"%d %g |%.3f| %-10g\" format 4 %10.2e\nrun 0\n",
           "\n0 1.44 |-3.766|   1.28e+02 \n");
    expect("thermo_modify format 1 %d format float %g format none\nrun 0\n",
           "       0         1.44   -6.0153586            0   -3.8753586   -3.7664743 \n");
}
END_TEST

START_TEST(test_real_units)
{
    hs_error err;
    char *log =
        hs_test_run_deck("units real\nlattice fcc 5.3\nregion box block 0 3 0 3 0 3\ncreate_box 1 box\n"
                         "create_atoms 1 box\nmass 1 39.95\nvelocity all create 300 87287 loop geom\n"
                         "pair_style lj/cut 8.5\npair_modify tail yes\npair_coeff 1 1 0.238 3.405\nfix 1 all nve\n"
                         "thermo 50\nthermo_style custom step temp press etail pe pxx pxy enthalpy c_thermo_temp[3]\n"
                         "run 100\n",
                         &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    static const char text[] =
        "     100    110.40335    4915.7015   -14.662195   -160.36737    4689.0476    835.34353    "
        "163.01807     24.90895 \n";
    ck_assert_msg(strstr(log, text) != NULL, "expected %s in\n%s", text, log);
    ck_assert_ptr_nonnull(strstr(log, " ns/day, "));
    ck_assert_ptr_nonnull(strstr(log, " hours/ns, "));
    free(log);
}
END_TEST

START_TEST(test_report)
{
    hs_error err;
    char *log = run(solid, "run 10\nrun 0\n", &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    static const char *const lines[] = {
        "Neighbor list info ...\n  update every 1 steps, delay 10 steps, check yes\n",
        "  master list distance cutoff = 2.3\n", "Per MPI rank memory allocation (min/avg/max) = ",
        " on 1 procs for 10 steps with 108 atoms\n\nPerformance: ", " tau/day, ", " timesteps/s\n",
        "% CPU use with 1 MPI tasks x 1 OpenMP threads\n\nMPI task timing breakdown:\n"
        "Section |  min time  |  avg time  |  max time  |%varavg| %total\n"
        "---------------------------------------------------------------\nPair    | ",
        "Nlocal:        108.000 ave         108 max         108 min\nHistogram: 1 0 0 0 0 0 0 0 0 0\nNghost:     ",
        "\nNeighbor list builds = 1\nDangerous builds = 1\n",
        /* a run without steps has no performance */
        " on 1 procs for 0 steps with 108 atoms\n\n"};
    for (size_t k = 0; k < sizeof lines / sizeof lines[0]; ++k)
        ck_assert_msg(strstr(log, lines[k]) != NULL, "expected:\n%s\nin:\n%s", lines[k], log);
    char *first = strstr(log, "Neighbor list info");
    ck_assert_ptr_null(strstr(first + 1, "Neighbor list info")); /* printed once while nothing changes */
    free(log);
}
END_TEST

START_TEST(test_refusals)
{
    expect_error("thermo_style custom step tmep\n", "unknown keyword 'tmep'; did you mean 'temp'?");
    expect_error("thermo_style one step\n", "unexpected word 'step'");
    expect_error("thermo_style fancy\n", "'fancy' is not one of one, multi, custom");
    expect_error("thermo_style custom\n", "at least one keyword");
    expect_error("thermo_style custom step c_nope\nrun 0\n", "there is no compute 'nope' for c_nope");
    expect_error("thermo_style custom step c_thermo_temp[7]\nrun 0\n", "c_thermo_temp[7] is not a number");
    expect_error("thermo_style custom step c_thermo_pe[1]\nrun 0\n", "c_thermo_pe[1] is not a number");
    expect_error("thermo_style custom c_nope[*]\n", "needs the compute 'nope' to exist");
    expect_error("thermo_style custom step f_1\nrun 0\n", "f_1 is not a number; fix '1' (nve) has no values");
    expect_error("thermo_modify flux yes\n", "unknown keyword 'flux'; did you mean 'flush'?");
    expect_error("thermo_modify lost maybe\n", "'maybe'");
    expect_error("thermo_modify format 9 %d\n", "the columns are 1 to 6");
    expect_error("thermo_modify format int %g\n", "'%g' is the wrong kind");
    expect_error("thermo_modify format float %d\n", "'%d' is the wrong kind");
    expect_error("thermo_modify format float %s\n", "'%s' is the wrong kind");
    expect_error("thermo_modify format float %n\n", "wrong kind");
    expect_error("thermo_modify format float %*g\n", "is not a format");
    expect_error("thermo_modify format float %999g\n", "is not a format");
    expect_error("thermo_modify format float \"%g %g\"\n", "must have one conversion");
    expect_error("thermo_modify format line %d\nrun 0\n", "has 1 words but a row has 6 columns");
    expect_error("thermo_modify format line\n", "the format itself is missing");
    expect_error("thermo_modify temp nope\n", "there is no compute 'nope'");
    expect_error("thermo_modify temp thermo_pe\n", "does not compute a temperature");
    expect_error("thermo -5\n", "'-5' is not a whole number");
}
END_TEST

START_TEST(test_lost_atoms)
{
    hs_error err;
    char *log = hs_test_run_deck("boundary f f f\nregion box block 0 10 0 10 0 10\ncreate_box 1 box\n"
                                 "create_atoms 1 single 5 5 5\ncreate_atoms 1 single 9.9 5 5\nmass 1 1\n"
                                 "pair_style lj/cut 2.5\npair_coeff * * 1 1\nvelocity all set 10 0 0\nfix 1 all nve\n"
                                 "thermo 10\nthermo_modify lost ignore\nthermo_style one\nrun 10\n",
                                 &err);
    ck_assert_int_eq(err.status, HS_ERROR_ATOMS); /* thermo_style has set `lost` back to error */
    free(log);
    log = hs_test_run_deck("boundary f f f\nregion box block 0 10 0 10 0 10\ncreate_box 1 box\n"
                           "create_atoms 1 single 5 5 5\ncreate_atoms 1 single 9.9 5 5\nmass 1 1\n"
                           "pair_style lj/cut 2.5\npair_coeff * * 1 1\nvelocity all set 10 0 0\nfix 1 all nve\n"
                           "thermo 10\nthermo_style custom step atoms\nthermo_modify lost ignore\nrun 10\n",
                           &err);
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
    ck_assert_msg(strstr(log, "      10        1 \n") != NULL, "%s", log);
    free(log);
}
END_TEST

START_TEST(test_user_format)
{
    hs_error err = {0};
    char *format;
    ck_assert_hs_ok(hs_format_normalize(&format, "a%%%-08.3ldb", HS_FORMAT_INT, "t", &err), err);
    ck_assert_str_eq(format, "a%%%-08.3lldb");
    HS_FREE(format);
    static const char *const bad[] = {"", "%", "%%", "%5", "%1$d", "%d%", "%.123d", "%hhn", "%d\n", "%qd", "%Lg", "%p"};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        hs_error_clear(&err);
        ck_assert_msg(hs_format_normalize(&format, bad[k], HS_FORMAT_INT, "t", &err) != HS_OK, "'%s'", bad[k]);
        ck_assert_ptr_null(format);
    }
    ck_assert_int_eq(hs_format_class("x%%%8.3f"), 'f');
    ck_assert_int_eq(hs_format_class("no"), 0);
}
END_TEST

START_TEST(test_keyword_table)
{
    for (const hs_thermo_entry *entry = hs_thermo_entries; entry->name != NULL; ++entry) {
        ck_assert_ptr_null(hs_thermo_check_word(entry->name));
        ck_assert_ptr_nonnull(entry->help);
    }
    static const char *const good[] = {"c_a", "c_a[1]", "c_a[*]", "c_a[2*4]", "f_b", "v_x", "$x", "c_${id}"};
    for (size_t k = 0; k < sizeof good / sizeof good[0]; ++k) ck_assert_ptr_null(hs_thermo_check_word(good[k]));
    static const char *const bad[] = {"", "c_", "c_a[", "c_a[]", "c_a[1", "c_a[1]]", "c_a[x]", "v_", "x_a", "c_a b"};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k)
        ck_assert_msg(hs_thermo_check_word(bad[k]) != NULL, "'%s'", bad[k]);
    ck_assert_str_eq(hs_thermo_check_word("tempp"), "temp");
}
END_TEST

HS_TEST_MAIN("thermo_format", test_style_one, test_style_multi, test_energies, test_box_and_pressure, test_computes,
             test_line_format, test_real_units, test_report, test_refusals, test_lost_atoms, test_user_format,
             test_keyword_table)
