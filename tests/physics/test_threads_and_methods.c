/* The same thermo table from every number of threads and every neighbor method. Forces differ between them by
 * rounding only, and rounding errors (1e-16) grow by about e^3 a tau in these liquids: over the 0.6 tau and less of
 * these runs they stay below the eighth digit by far. */
#include <sys/wait.h>
#include <unistd.h>

#include "physics.h"

/* Two types of unlike size, depth, mass and cutoff, nothing commensurate; more than one cell a side and, for the thin
   one, fewer. */
static const struct system {
    const char *name, *text;
} systems[] = {
    {"3d mixture",
     "units lj\nlattice fcc 0.80\nregion box block 0 6 0 5 0 7\ncreate_box 2 box\ncreate_atoms 1 box\n"
     "set type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.4 87287 dist gaussian\n"
     "pair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\n"},
    {"2d mixture",
     "units lj\ndimension 2\nlattice hex 0.80\nregion box block 0 24 0 14 -0.1 0.1\ncreate_box 2 box\ncreate_atoms 1 "
     "box\n"
     "set type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.0 87287 dist gaussian\n"
     "pair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\n"},
    {"3d thin box, smaller than two cutoffs",
     "units lj\nlattice fcc 0.80\nregion box block 0 2 0 2 0 9\ncreate_box 2 box\ncreate_atoms 1 box\n"
     "set type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.4 87287 dist gaussian\n"
     "pair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\n"},
    {"3d droplet in a shrink-wrapped box",
     "units lj\nboundary s s s\nlattice fcc 0.90\nregion box block 0 4.9 0 4.9 0 4.9\ncreate_box 2 box\ncreate_atoms 1 "
     "box\n"
     "set type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.0 87287 dist gaussian\n"
     "pair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\n"},
    {"2d WCA disks", "units lj\ndimension 2\nlattice sq2 0.70\nregion box block 0 18 0 15 -0.1 0.1\ncreate_box 2 "
                     "box\ncreate_atoms 1 box\n"
                     "set type 1 type/ratio 2 0.35 8765\nmass * 1.0\nvelocity all create 1.0 87287 dist gaussian\n"
                     "pair_style wca\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 1.0 1.2\n"},
};

static const char tail[] =
    "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\ntimestep 0.004\n"
    "thermo_style custom step temp pe etotal press pxx pyy pxy vol\nthermo_modify format float %15.8g\n"
    "thermo 15\nrun 150\n";

/** The thermo table as printed, by the program with these options. The caller frees it. */
static char *print_table(const char *deck_file, const char *options)
{
    char command[1024];
    /* threads that wait must not hold up the others where there are fewer cores than threads */
    snprintf(command, sizeof command, "OMP_WAIT_POLICY=passive %s -in %s -log none %s 2>&1", HALFSHELL_PROGRAM,
             deck_file, options);
    FILE *pipe = popen(command, "r");
    ck_assert_ptr_nonnull(pipe);
    static char text[65536];
    text[fread(text, 1, sizeof text - 1, pipe)] = '\0';
    const int status = pclose(pipe);
    ck_assert_msg(WIFEXITED(status) && WEXITSTATUS(status) == 0, "%s: %s", options, text);
    char *begin = strstr(text, "\nStep "), *end = strstr(text, "\nLoop time");
    ck_assert_msg(begin != NULL && end != NULL, "%s: %s", options, text);
    *end = '\0';
    return strdup(begin + 1);
}

START_TEST(test_same_table)
{
    static const char *const options[] = {
        "-neigh nsq -threads 1",     "-neigh nsq -threads 2",     "-neigh nsq -threads 3",
        "-neigh cell -threads 1",    "-neigh cell -threads 2",    "-neigh cell -threads 3",
        "-neigh cluster -threads 1", "-neigh cluster -threads 2", "-neigh cluster -threads 3",
        "-neigh verlet -threads 1",  "-neigh verlet -threads 2",  "-neigh verlet -threads 3",
    };
    const struct system *system = &systems[_i];
    char path[] = "/tmp/halfshell-threads-XXXXXX";
    const int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    FILE *stream = fdopen(file, "w");
    ck_assert_ptr_nonnull(stream);
    fprintf(stream, "%s%s", system->text, tail);
    ck_assert_int_eq(fclose(stream), 0);
    char *first = print_table(path, options[0]);
    int n_rows = 0;
    for (const char *c = first; *c != '\0'; ++c) n_rows += *c == '\n';
    ck_assert_int_eq(n_rows, 11);
    for (size_t k = 1; k < sizeof options / sizeof options[0]; ++k) {
        char *other = print_table(path, options[k]);
        ck_assert_msg(strcmp(first, other) == 0, "%s: with %s\n%s\nwith %s\n%s", system->name, options[0], first,
                      options[k], other);
        free(other);
    }
    printf("  %s: %d rows of 8 columns equal to 8 digits: nsq, cell, cluster, verlet, 1 to 3 threads\n", system->name,
           n_rows);
    free(first);
    unlink(path);
}
END_TEST

HS_LOOP_TEST_MAIN("threads and methods", {test_same_table, (int)(sizeof systems / sizeof systems[0])})
