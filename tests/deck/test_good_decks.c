/* What decks mean: loops, conditions, jumps, files, quotes, echo. The expected texts were printed by lmp (29 Sep
 * 2021) for the same decks, unless a case says otherwise. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "deck/deck.h"
#include "support/harness.h"

static char *screen_text, *log_text;
static int exit_code;

static void write_file(const char *name, const char *text)
{
    FILE *stream = fopen(name, "w");
    ck_assert_ptr_nonnull(stream);
    fputs(text, stream);
    fclose(stream);
}

static void read_file(const char *name, char *text, size_t size)
{
    FILE *stream = fopen(name, "r");
    ck_assert_ptr_nonnull(stream);
    size_t n = fread(text, 1, size - 1, stream);
    text[n] = '\0';
    fclose(stream);
    remove(name);
}

/** Run a deck as the program does; screen and log are in screen_text and log_text until forget(). */
static void run_with(const char *text, const char *variable, const char *value)
{
    hs_error err = {0};
    size_t n_screen, n_log;
    FILE *screen = open_memstream(&screen_text, &n_screen), *log = open_memstream(&log_text, &n_log);
    hs_sink out = {.screen = screen, .log = log};
    const hs_options options = {.n_threads = 1};
    hs_deck *deck = NULL;
    write_file("in.good", text);
    ck_assert_hs_ok(hs_deck_create(&deck, &options, &out, &err), err);
    if (variable != NULL) ck_assert_hs_ok(hs_deck_set_variable(deck, variable, 1, &value, &err), err);
    ck_assert_hs_ok(hs_deck_check(deck, "in.good", &err), err);
    ck_assert_hs_ok(hs_deck_run(deck, "in.good", &err), err);
    exit_code = deck->exit_code;
    hs_deck_destroy(&deck);
    fclose(screen);
    fclose(log);
    remove("in.good");
}

static void forget(void)
{
    free(screen_text);
    free(log_text);
}

static void check(const char *text, const char *expected)
{
    run_with(text, NULL, NULL);
    ck_assert_str_eq(screen_text, expected);
    forget();
}

static void check_log(const char *text, const char *expected)
{
    run_with(text, NULL, NULL);
    ck_assert_str_eq(log_text, expected);
    forget();
}

START_TEST(loops)
{
    check("variable i loop 3\nlabel l\nprint \"i $i\"\nnext i\njump SELF l\nprint done\n", "i 1\ni 2\ni 3\ndone\n");
    check("variable q index a b\nvariable p index 3 4 5\nlabel x\nprint \"$q $p\"\nnext q p\njump SELF x\nprint end\n",
          "a 3\nb 4\nend\n");
    check("variable b loop 2\nlabel outer\nvariable a index 3 4\nlabel inner\nprint \"$a $b\"\nnext a\njump SELF "
          "inner\nnext b\n"
          "jump SELF outer\nprint end\n",
          "3 1\n4 1\n3 2\n4 2\nend\n");
    check("variable i loop 8 11 pad\nlabel l\nprint f.$i\nnext i\njump SELF l\n", "f.08\nf.09\nf.10\nf.11\n");
    check("variable i loop 100\nlabel l\nif \"$i == 5\" then \"jump SELF break\"\nnext i\njump SELF l\nlabel "
          "break\nprint \"i $i\"\n",
          "i 5\n");
}
END_TEST

START_TEST(one_partition_takes_all_values)
{
    check("variable u universe a b c\nvariable l uloop 3 pad\nvariable w world only\nlabel x\nprint \"$u $l $w\"\n"
          "next u l\njump SELF x\nprint end\n",
          "a 1 only\nb 2 only\nc 3 only\nend\n");
    check("variable u universe a b\nvariable u universe c\nprint $u\n", "a\n");
}
END_TEST

/* Values that go with the atoms end with them. */
START_TEST(atomfiles_end_with_the_atoms)
{
    run_with("lattice sc 1\nregion b block 0 2 0 2 0 2\ncreate_box 1 b\ncreate_atoms 1 box\nprint 1 file set.txt\n"
             "print '3 0.5' append set.txt\nvariable q atomfile set.txt\nvariable r atom v_q+id\n"
             "create_atoms 1 single 0.5 0.5 0.5\n"
             "print \"values $(v_q[3]) $(v_q[4]) $(v_q[9]) $(v_r[3]) $(is_defined(variable,q))\"\n"
             "clear\nprint \"then $(is_defined(variable,q))\"\n",
             NULL, NULL);
    ck_assert_ptr_nonnull(strstr(screen_text, "values 0.5 0 0 3.5 1\n"));
    ck_assert_ptr_nonnull(strstr(screen_text, "then 0\n"));
    forget();
}
END_TEST

/* Coefficients in force, mixed ones included, and ids without gaps. */
START_TEST(what_is_there_can_be_written_and_numbered)
{
    run_with(
        "region b block 0 4 0 4 0 4\ncreate_box 3 b\ncreate_atoms 1 random 5 123 NULL\nmass * 1\n"
        "pair_style hybrid/overlay lj/cut 2.5 soft 1.2 lj/cut 2\npair_coeff * * lj/cut 1 1 1\n"
        "pair_coeff 3 3 lj/cut 2 0.1 1 1.4\npair_coeff 1 2 soft 5\nwrite_coeff a.coeff\n"
        "pair_style hybrid/overlay lj/cut 2.5 soft 1.2 lj/cut 2\ninclude a.coeff\nwrite_coeff b.coeff\n"
        "pair_style lj/cut 2.5\npair_coeff 1 1 0.25 1\npair_coeff 2 2 1 4 3\npair_coeff 3 3 1 1\n"
        "write_coeff c.coeff\ngroup g id 2 4\nvariable before equal x[5]\nvariable x equal ${before}\n"
        "delete_atoms group g compress no\nreset_atom_ids\nprint \"same $(abs(v_x-x[3])<1e-12) of $(count(all))\"\n",
        NULL, NULL);
    char a[1000], b[1000], c[1000];
    read_file("a.coeff", a, sizeof a);
    read_file("b.coeff", b, sizeof b);
    read_file("c.coeff", c, sizeof c);
    ck_assert_ptr_nonnull(strstr(a, "pair_coeff 1 1 lj/cut 1 1 1 2.5\n"));
    ck_assert_ptr_nonnull(strstr(a, "pair_coeff 1 2 soft 5 1.2\n"));
    ck_assert_str_eq(a, b);
    ck_assert_str_eq(c, "# coefficients of\n# pair_style lj/cut\npair_coeff 1 1 0.25 1 2.5\n"
                        "pair_coeff 1 2 0.5 2 2.7386127875258306\npair_coeff 1 3 0.5 1 2.5\npair_coeff 2 2 1 4 3\n"
                        "pair_coeff 2 3 1 2 2.7386127875258306\npair_coeff 3 3 1 1 2.5\n");
    ck_assert_ptr_nonnull(strstr(screen_text, "same 1 of 3\n"));
    forget();
}
END_TEST

/* next() in formulas: what the function returned last is gone. */
START_TEST(formulas_read_files)
{
    check("print 3 file n.txt\nprint 5 append n.txt\nvariable f file n.txt\nvariable e equal next(f)*2\n"
          "print \"$e $f\"\nprint \"$e\"\nprint $(is_defined(variable,f))\n",
          "3\n5\n6 5\n10\n0\n");
}
END_TEST

START_TEST(command_line_variables_win)
{
    run_with("variable T index 1.0\nprint \"T = $T\"\n", "T", "2.5");
    ck_assert_str_eq(screen_text, "T = 2.5\n");
    forget();
}
END_TEST

START_TEST(branches)
{
    static const char deck[] = "variable a index 1 2 3\nlabel l\n"
                               "if \"$a == 1\" then 'print \"one\"' 'print again' elif \"$a == 2\" \"print two\" else "
                               "\"print many\"\nnext a\njump SELF l\n";
    check(deck, "one\nagain\ntwo\nmany\n");
    check("if 0 then \"print a\"\nif 1 then \"if 1 then 'print inner'\"\n", "inner\n");
    check("if \"$(1+1) == 2 && abc == abc\" then \"variable x equal 4\" \"print $(v_x)\"\n", "4\n");
    /* a jump skips what follows it in the same branch */
    check("if 1 then \"jump SELF x\" \"print never\"\nprint never\nlabel x\nprint here\n", "here\n");
    /* skipped lines may use variables that do not exist; lmp stops there */
    check("jump SELF x\nprint ${nothing}\nlabel x\nprint here\n", "here\n");
}
END_TEST

START_TEST(quotes_and_substitution)
{
    check("variable a equal 1/3\nprint \"b ${a} $(v_a-1/3) $(v_a:%.3f) $(v_a:%8.2e)|\"\n",
          "b 0.333333333333333 -3.3306690738754696213e-16 0.333 3.33e-01|\n");
    check("variable a string x\nprint 'single \"inner\" $a'\nprint \"mixed 'inner ${a}' ${a}\"\n",
          "single \"inner\" x\nmixed 'inner ${a}' x\n");
    check("variable x string \"a # b\"\nprint 'q$x' # comment\nprint \"\"\"ab # not comment\"\"\"\n",
          "qa # b\nab # not comment\n");
    check("print a\"b\nprint \"cont &\n  inued\"\n", "a\"b\ncont   inued\n");
    check("print \"\"\"triple\n line 'x' \"y\" two\"\"\"\n", "triple\n line 'x' \"y\" two\n");
    check("variable c string \"print hello\"\n$c\n${c}\n", "hello\nhello\n");
    check("variable e equal 0.1+0.2\nprint \"$e $(v_e) $(0.1+0.2)\"\n",
          "0.3 0.2999999999999999889 0.30000000000000004441\n");
    check("variable e equal 1e10\nvariable f equal 123456789012345678\nprint \"$e $f\"\n",
          "10000000000 1.23456789012346e+17\n");
}
END_TEST

START_TEST(echo_shows_lines_as_read_and_as_run)
{
    check_log("variable a index 5\nvariable b index 7   # comment\n\n  print \"$a\"\nvariable  c equal ${a}*${b}  # "
              "product\n# end &\nof it\n",
              "variable a index 5\nvariable b index 7   # comment\n\n  print \"$a\"\n5\nvariable  c equal ${a}*${b}  # "
              "product\n"
              "variable  c equal 5*${b}  \nvariable  c equal 5*7  \n# end of it\n");
    check_log("echo none\nprint a\n", "echo none\na\n");
    check("echo screen\nif 1 then \"print a\"\n", "if 1 then \"print a\"\nprint a\na\n");
    check_log("jump SELF x\nprint skipped\nlabel x\nprint done\n", "jump SELF x\nprint done\ndone\n");
}
END_TEST

START_TEST(files_within_files)
{
    write_file("in.inner", "print \"inner $a\"\njump in.third here\nprint never\n");
    write_file("in.third", "print never\nlabel here\nprint third\n");
    check("variable a index 1\ninclude in.inner\nprint outer\n", "inner 1\nthird\nouter\n");
    write_file("in.again", "print again\n");
    check("print a\njump in.again\nprint never\n", "a\nagain\n");
    remove("in.inner");
    remove("in.third");
    remove("in.again");
}
END_TEST

START_TEST(a_deck_may_include_what_it_has_written)
{
    check("variable n equal 2*3\nprint \"print $n\" file in.made\ninclude in.made\n", "print 6\n6\n");
    remove("in.made");
}
END_TEST

START_TEST(print_goes_where_it_is_told)
{
    char text[64];
    run_with("echo none\nprint a file out.txt\nprint \"b $(1+1)\" append out.txt screen no\nprint c screen yes\n", NULL,
             NULL);
    ck_assert_str_eq(screen_text, "a\nc\n");
    ck_assert_str_eq(log_text, "echo none\na\nc\n");
    forget();
    read_file("out.txt", text, sizeof text);
    ck_assert_str_eq(text, "a\nb 2\n");
}
END_TEST

START_TEST(log_moves_on)
{
    char text[64];
    run_with("print a\nlog second.log\nprint b\nlog none\nprint c\nlog second.log append\nprint d\n", NULL, NULL);
    ck_assert_str_eq(screen_text, "a\nb\nc\nd\n");
    ck_assert_str_eq(log_text, "print a\na\nlog second.log\n");
    forget();
    read_file("second.log", text, sizeof text);
    ck_assert_str_eq(text, "print b\nb\nlog none\nprint d\nd\n");
}
END_TEST

START_TEST(quit_ends_the_deck)
{
    check("print a\nquit\nprint b\nany text may follow, it's never read\n", "a\n");
    ck_assert_int_eq(exit_code, 0);
    check("if 1 then \"quit 7\" \"print b\"\nprint b\n", "");
    ck_assert_int_eq(exit_code, 7);
}
END_TEST

START_TEST(clear_forgets_the_box_and_keeps_variables)
{
    check("variable a index 5\nregion b block 0 1 0 1 0 1\nclear\nregion b block 0 2 0 2 0 2\nprint \"a $a\"\n",
          "a 5\n");
}
END_TEST

START_TEST(accelerator_words_are_said_to_have_no_effect)
{
    check("suffix omp\npackage omp 4\n", "The command suffix has no effect: Halfshell chooses its own kernels\n"
                                         "The command package has no effect: Halfshell chooses its own kernels\n");
}
END_TEST

/** One atom on its way: rows of the table are lines that begin with a number. */
static const char one_atom[] =
    "atom_modify sort 0 0\nregion b block 0 9 0 9 0 9\ncreate_box 1 b\nmass 1 1\npair_style zero 1.0\npair_coeff * *\n"
    "create_atoms 1 single 1 1 1 units box\nvelocity all set 1 0 0 units box\nfix 1 all nve\ntimestep 0.01\n";

static void check_rows(const char *deck, const char *expected)
{
    char text[4096], rows[2048] = "";
    snprintf(text, sizeof text, "%s%s", one_atom, deck);
    run_with(text, NULL, NULL);
    for (char *line = strtok(screen_text, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        line += strspn(line, " ");
        if (strncmp(line, "say ", 4) != 0 &&
            (line[0] < '0' || line[0] > '9' || strchr(line, '%') != NULL || strstr(line, " by ") != NULL))
            continue;
        strncat(rows, line, sizeof rows - strlen(rows) - 2);
        strcat(rows, "\n");
    }
    ck_assert_str_eq(rows, expected);
    forget();
}

START_TEST(runs_count_steps_and_time)
{
    check_rows(
        "thermo_style custom step time elapsed elaplong\nthermo 2\nrun 4\nreset_timestep 50\nrun 4 start 40 stop 60\n"
        "timestep 0.02\nrun 56 upto\n",
        "0            0        0        0 \n2         0.02        2        2 \n4         0.04        4        4 \n"
        "50         0.04        0       10 \n52         0.06        2       12 \n54         0.08        4       14 \n"
        "54         0.08        0        0 \n56         0.12        2        2 \n");
}
END_TEST

START_TEST(ramps_and_oscillations_of_a_run)
{
    check_rows("variable r equal ramp(1,3)\nvariable v equal vdisplace(1,3)\nvariable s equal swiggle(1,3,0.3)\n"
               "variable c equal cwiggle(1,3,0.3)\nthermo_style custom step v_r v_v v_s v_c\nthermo 2\nrun "
               "4\nreset_timestep 50\n"
               "run 2 start 40 stop 60\n",
               "0            1            1            1            1 \n2            2         1.06    2.2202099    "
               "1.2593636 \n"
               "4            3         1.12    3.2294345    1.9926082 \n50            2          1.3    3.5980762      "
               "    5.5 \n"
               "52          2.2         1.36    2.7633558     6.427051 \n");
}
END_TEST

START_TEST(commands_between_the_parts_of_a_run)
{
    check_rows("variable k equal 3\nthermo_style custom step v_k\nthermo 10\n"
               "run 5 every 2 'print \"say $(step) $k\"' 'variable k equal $k+1'\nrun 2 every 1 NULL\n",
               "0            3 \n2            3 \nsay 2 3\n2            4 \n4            4 \nsay 4 4\n4            5 "
               "\n5            5 \n"
               "say 5 5\n5            6 \n6            6 \n6            6 \n7            6 \n");
    check_rows("thermo_style custom step\nrun 100 every 2 \"if '$(step) == 4' then quit\"\n", "0 \n2 \n2 \n4 \n");
}
END_TEST

/** A quarter of the atoms goes 2 along x, a quarter 1 along y: <r^2> = 5/4, <r^4> = 17/4; the mean displacement is (1/2, 1/4). */
START_TEST(displacements_that_are_not_gaussian)
{
    const char *deck = "create_atoms 1 single 2 2 2\ncreate_atoms 1 single 3 3 3\ncreate_atoms 1 single 4 4 4\n"
                       "velocity all set 0 0 0\ngroup one id 1\ngroup two id 2\ncompute g all msd/nongauss\n"
                       "compute d all msd/nongauss com yes\nthermo_style custom step c_g[*] c_d[*]\nrun 0\n"
                       "displace_atoms one move 2 0 0\ndisplace_atoms two move 0 1 0\nrun 0\n";
    check_rows(deck, "1 atoms in group one\n1 atoms in group two\n"
                     "0            0            0            0            0            0            0 \n"
                     "0         1.25         4.25        0.632       0.9375    1.5507812  0.058666667 \n");
}
END_TEST

START_TEST(thermo_rows_by_a_variable)
{
    check_rows("thermo_style custom step\nvariable s equal stride(4,8,2)\nthermo v_s\nrun 10\n",
               "0 \n4 \n6 \n8 \n10 \n");
}
END_TEST

HS_TEST_MAIN("good decks", loops, what_is_there_can_be_written_and_numbered, one_partition_takes_all_values,
             atomfiles_end_with_the_atoms, formulas_read_files, command_line_variables_win, branches,
             quotes_and_substitution, echo_shows_lines_as_read_and_as_run, files_within_files,
             a_deck_may_include_what_it_has_written, print_goes_where_it_is_told, log_moves_on, quit_ends_the_deck,
             clear_forgets_the_box_and_keeps_variables, accelerator_words_are_said_to_have_no_effect,
             runs_count_steps_and_time, ramps_and_oscillations_of_a_run, commands_between_the_parts_of_a_run,
             displacements_that_are_not_gaussian, thermo_rows_by_a_variable)
