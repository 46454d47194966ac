/* Reproducible runs: the same bits of thermo output, positions, velocities and forces from every neighbor method,
 * number of threads, and instruction set with a fused multiply-add. Nothing here has a tolerance. */
#include <sys/wait.h>

#include "kernel/kernel.h"
#include "physics.h"

#define MIXTURE                                                                                                        \
    "set type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.4 87287 dist gaussian\n"         \
    "pair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\npair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\n"
#define CHECKED "neigh_modify every 1 delay 0 check yes\n"
#define LATE    "neigh_modify every 20 delay 0 check no\n"

static const struct system {
    const char *name, *text;
} systems[] = {
    {"melt whose lists are late",
     "units lj\nlattice fcc 0.8442\nregion box block 0 6 0 5 0 7\ncreate_box 1 box\ncreate_atoms 1 box\nmass 1 1.0\n"
     "velocity all create 3.0 87287 loop geom\npair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\n" LATE},
    {"mixture",
     "units lj\nlattice fcc 0.80\nregion box block 0 6 0 5 0 7\ncreate_box 2 box\ncreate_atoms 1 box\n" MIXTURE
         CHECKED},
    {"2d mixture", "units lj\ndimension 2\nlattice hex 0.80\nregion box block 0 24 0 14 -0.1 0.1\ncreate_box 2 box\n"
                   "create_atoms 1 box\n" MIXTURE CHECKED},
    {"box smaller than two cutoffs", "units lj\nlattice fcc 0.80\nregion box block 0 2 0 2 0 9\ncreate_box 2 box\n"
                                     "create_atoms 1 box\n" MIXTURE LATE},
    {"droplet in a shrink-wrapped box",
     "units lj\nboundary s s s\nlattice fcc 0.90\nregion box block 0 4.9 0 4.9 0 4.9\n"
     "create_box 2 box\ncreate_atoms 1 box\n" MIXTURE CHECKED},
    {"slab far from the origin",
     "units lj\nboundary p f p\nregion box block 900 912 -40 40 -1010 -1000 units box\ncreate_box 2 box\n"
     "lattice fcc 0.85\nregion slab block INF INF -8 8 INF INF units box\ncreate_atoms 1 region slab\n" MIXTURE
         CHECKED},
    /* a few large disks among small ones, so that most pairs of the cells are not listed; lists are late */
    {"polydisperse disks",
     "units lj\ndimension 2\natom_style sphere\nlattice sq2 1.0\nregion box block 0 15 0 13 -0.1 0.1\n"
     "create_box 2 box\ncreate_atoms 1 box\nset type 1 type/ratio 2 0.1 8765\ngroup large type 2\n"
     "variable d atom 0.7+0.4*((id*61)%101)/100\nset group all diameter v_d\nset group large diameter 1.7\n"
     "set group all mass 1.0\nvelocity all create 1.0 87287 dist gaussian\n"
     "pair_style harmonic/sphere\npair_coeff 1 1 100.0\npair_coeff 2 2 50.0\n" LATE},
    {"polydisperse spheres",
     "units lj\natom_style sphere\nlattice fcc 0.9\nregion box block 0 6 0 5 0 4\ncreate_box 1 box\n"
     "create_atoms 1 box\nvariable d atom 0.8+0.6*((id*61)%101)/100\nset group all diameter v_d\n"
     "set group all mass 1.0\nvelocity all create 1.0 87287 dist gaussian\n"
     "pair_style harmonic/sphere\npair_coeff 1 1 100.0\n" CHECKED},
    /* one atom fast enough that forces outgrow their grid in mid-run */
    {"collision",
     "units lj\nlattice fcc 0.6\nregion box block 0 5 0 5 0 5\ncreate_box 2 box\ncreate_atoms 1 box\n" MIXTURE CHECKED
     "set atom 7 vx 40\n"},
};

static const char tail[] =
    "neighbor 0.3 bin\nfix 1 all nve\ntimestep 0.004\nthermo_style custom step temp pe etotal press pxx pyy pxy vol\n"
    "thermo_modify format float %.17g\nthermo 15\ndump d all custom 60 final.dump id type x y z ix iy iz vx vy vz fx "
    "fy fz\n"
    "dump_modify d sort id pbc yes format float %.17g\nrun 60\n";

static char *read_all(FILE *stream)
{
    size_t n = 0, room = 1 << 16;
    char *text = malloc(room);
    ck_assert_ptr_nonnull(text);
    for (size_t got; (got = fread(text + n, 1, room - n - 1, stream)) > 0; n += got)
        if (room - n - got < 2) {
            text = realloc(text, room *= 2);
            ck_assert_ptr_nonnull(text);
        }
    text[n] = '\0';
    return text;
}

/** Thermo table and dump of a run with these options, as one text. The caller frees it. */
static char *run_with(const char *options)
{
    char command[1024];
    snprintf(command, sizeof command,
             "OMP_WAIT_POLICY=passive %s -in in.deck -log none %s > out.txt 2>&1 && sed -n '/^Step /,/^Loop/p' out.txt "
             "| grep -v "
             "^Loop | cat - final.dump",
             HALFSHELL_PROGRAM, options);
    FILE *pipe = popen(command, "r");
    ck_assert_ptr_nonnull(pipe);
    char *text = read_all(pipe);
    const int status = pclose(pipe);
    ck_assert_msg(WIFEXITED(status) && WEXITSTATUS(status) == 0, "%s: %s", options, text);
    ck_assert_msg(strstr(text, "\nITEM: ATOMS") != NULL && strncmp(text, "Step ", 5) == 0, "%s: %s", options, text);
    return text;
}

START_TEST(test_same_bits)
{
    static const char *const options[] = {
        "-neigh cluster -threads 1", "-neigh cluster -threads 2",
        "-neigh verlet -threads 3",  "-neigh cell -threads 2",
        "-neigh cell -threads 3",    "-neigh nsq -threads 2",
        "-neigh cluster -isa avx2",  "-neigh verlet -isa avx2 -threads 2",
        "-neigh cell -isa avx2",     "-neigh linked -threads 2",
        "-neigh incremental",        "-neigh hash -threads 3",
    };
    const size_t n = sizeof options / sizeof options[0];
    /* the plain kernels, which a test of the whole suite may ask for, round products and sums one by one */
    const bool has_wide = hs_isa_best() >= HS_ISA_AVX2 && getenv("HALFSHELL_ISA") == NULL;
    hs_test_enter_folder();
    FILE *deck = fopen("in.deck", "w");
    ck_assert_ptr_nonnull(deck);
    fprintf(deck, "%s%s", systems[_i].text, tail);
    ck_assert_int_eq(fclose(deck), 0);
    char *first = run_with(options[0]);
    for (size_t k = 1; k < n && (strstr(options[k], "avx2") == NULL || has_wide); ++k) {
        char *other = run_with(options[k]);
        ck_assert_msg(strcmp(first, other) == 0, "%s: '%s' and '%s' differ", systems[_i].name, options[0], options[k]);
        free(other);
    }
    free(first);
    hs_test_leave_folder();
}
END_TEST

HS_LOOP_TEST_MAIN("reproducible", {test_same_bits, (int)(sizeof systems / sizeof systems[0])})
