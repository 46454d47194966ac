/* Whole decks by every neighbor method, number of threads and instruction set: the same thermo tables, the same lists;
 * and forces of exclusions and of unlike cutoffs against a plain sum that knows nothing of kernel types, tables and
 * lists. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/harness.h"
#include "support/run_deck.h"

/* Two types of unlike size, depth and cutoff; nothing commensurate. */
#define LIQUID "lattice fcc 0.80\nregion box block 0 5 0 4 0 4.5\ncreate_box 2 box\ncreate_atoms 1 box\n"
#define DISKS                                                                                                          \
    "dimension 2\nlattice hex 0.80\nregion box block 0 18 0 11 -0.1 0.1\ncreate_box 2 box\ncreate_atoms 1 box\n"
#define ONE_TYPE "mass * 1.0\nvelocity all create 1.4 87287\npair_style lj/cut 2.5\npair_coeff * * 1.0 1.0\n"
#define TWO_TYPES                                                                                                      \
    "set type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.4 87287\npair_style lj/cut "     \
    "2.5\n"                                                                                                            \
    "pair_coeff 1 1 1.0 1.0\npair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\n"
#define SHORT_SCHEDULE "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
#define LAX_SCHEDULE   "neighbor 0.3 bin\nneigh_modify every 20 delay 0 check no\n"
#define RUN                                                                                                            \
    "fix 1 all nve\ntimestep 0.004\nthermo_style custom step temp pe etotal press pxx pyy pxy vol\n"                   \
    "thermo_modify format float %15.8g\nthermo 10\nrun 90\n"

static const struct deck {
    const char *name, *text;
} decks[] = {
    {"one type", LIQUID ONE_TYPE SHORT_SCHEDULE RUN},
    {"one type, lists on a lax schedule", LIQUID ONE_TYPE LAX_SCHEDULE RUN},
    {"one type, every pair", LIQUID ONE_TYPE LAX_SCHEDULE "neighbor_method cell pairs exact\n" RUN},
    {"two types, unlike cutoffs", LIQUID TWO_TYPES SHORT_SCHEDULE RUN},
    {"two types, lists on a lax schedule", LIQUID TWO_TYPES LAX_SCHEDULE RUN},
    {"two types, every pair", LIQUID TWO_TYPES LAX_SCHEDULE "neighbor_method cell pairs exact\n" RUN},
    {"types that do not see each other", LIQUID TWO_TYPES LAX_SCHEDULE "neigh_modify exclude type 1 2\n" RUN},
    {"groups that do not see each other",
     LIQUID TWO_TYPES LAX_SCHEDULE "group a id 1:150\ngroup b id 100:260\nneigh_modify exclude group a b\n" RUN},
    {"disks, one type", DISKS ONE_TYPE LAX_SCHEDULE RUN},
    {"disks, two types, exclusions",
     DISKS TWO_TYPES SHORT_SCHEDULE "group a id 1:100\nneigh_modify exclude group a a\n" RUN},
    {"box smaller than the cutoff",
     "lattice fcc 0.80\nregion box block 0 1 0 1 0 2\ncreate_box 2 box\ncreate_atoms 1 box\n" TWO_TYPES LAX_SCHEDULE
         RUN},
    {"thin box",
     "lattice fcc 0.80\nregion box block 0 2 0 2 0 12\ncreate_box 2 box\ncreate_atoms 1 box\n" TWO_TYPES LAX_SCHEDULE
         RUN},
    {"shrink-wrapped drop",
     "boundary s s f\nlattice fcc 0.90\nregion box block 0 3.9 0 3.9 -9 9\ncreate_box 2 box\n"
     "region drop block INF INF INF INF 0 3.9\ncreate_atoms 1 region drop\n" TWO_TYPES LAX_SCHEDULE RUN},
    {"runs that go on",
     LIQUID TWO_TYPES LAX_SCHEDULE RUN "run 13 pre no\nrun 20 pre no\nneigh_modify check yes every 5\n"
                                       "run 10\ngroup b type 2\nneigh_modify exclude group b b\nrun 20\n"},
};

/** Only what must be equal: the rows of the thermo tables, how often lists were built and, with_lists, how long they
 *  are. */
static char *keep_results(const char *log, bool with_lists)
{
    char *kept = calloc(strlen(log) + 2, 1), *to = kept;
    bool is_table = false;
    ck_assert_ptr_nonnull(kept);
    for (const char *line = log, *end; *line != '\0'; line = *end != '\0' ? end + 1 : end) {
        end = line + strcspn(line, "\n");
        is_table = strncmp(line, "Step ", 5) == 0 || (is_table && strncmp(line, "Loop time", 9) != 0);
        const bool is_count = strncmp(line, "Neighbor list builds", 20) == 0 ||
                              (with_lists && strncmp(line, "Total # of neighbors", 20) == 0);
        if (is_table || is_count) to += sprintf(to, "%.*s\n", (int)(end - line), line);
    }
    return kept;
}

/** The log of a deck. */
static char *run_with(const char *text, const char *method, int n_threads, hs_isa isa)
{
    hs_error err;
    const hs_options options = hs_test_options(n_threads, method, isa);
    char *log = hs_test_run_deck_with(text, &options, NULL, NULL, &err);
    ck_assert_msg(err.status == HS_OK, "%s: %s", method, err.text);
    return log;
}

static void assert_equal(const char *first_log, const char *other_log, bool with_lists, const char *what)
{
    char *first = keep_results(first_log, with_lists), *other = keep_results(other_log, with_lists);
    int n_lines = 0;
    for (const char *c = first; *c != '\0'; ++c) n_lines += *c == '\n';
    ck_assert_int_ge(n_lines, with_lists ? 13 : 12); /* header, ten rows, length and number of lists */
    ck_assert_msg(strcmp(first, other) == 0, "%s gives\n%s\nand not\n%s", what, other, first);
    free(first);
    free(other);
}

/** Sums in another order differ by 1e-15; chaos makes 1e-14 of it within these 0.4 tau: no digit of 8 changes. */
START_TEST(same_tables)
{
    const struct deck *deck = &decks[_i];
    char *right = run_with(deck->text, "nsq", 1, HS_ISA_PORTABLE),
         *listed = run_with(deck->text, "cluster", 1, HS_ISA_PORTABLE);
    for (int method = 0; method < HS_N_METHODS; ++method)
        for (int n_threads = 1; n_threads <= 3; ++n_threads)
            for (int isa = 0; isa <= (method == HS_METHOD_NSQ ? 0 : (int)hs_isa_best()); ++isa) {
                /* How threads share the work does not depend on the instruction set, and
                 * tests/physics/test_reproducible.c has every method bit for bit on several: all numbers of threads for
                 * the usual method, one for the others. */
                const bool tries_all = method == HS_METHOD_CLUSTER && isa == (int)hs_isa_best();
                if (!tries_all && n_threads != 1 + (isa + method) % 2) continue;
                char what[160];
                snprintf(what, sizeof what, "%s: %s, %d threads, %s", deck->name, hs_neighbor_methods[method],
                         n_threads, hs_isa_names[isa]);
                char *other = run_with(deck->text, hs_neighbor_methods[method], n_threads, (hs_isa)isa);
                assert_equal(right, other, false, what);
                if (method == HS_METHOD_VERLET || method == HS_METHOD_CLUSTER) assert_equal(listed, other, true, what);
                free(other);
            }
    free(right);
    free(listed);
}
END_TEST

/** `pairs exact` on a lax schedule is what a careful schedule gives, and not what the lax one gives. */
START_TEST(exact_pairs)
{
    static const char lax[] = LIQUID TWO_TYPES LAX_SCHEDULE RUN, careful[] = LIQUID TWO_TYPES SHORT_SCHEDULE RUN;
    static const char exact[] = LIQUID TWO_TYPES LAX_SCHEDULE "neighbor_method nsq pairs exact\n" RUN;
    const char *const texts[3] = {careful, exact, lax};
    for (int method = 0; method < HS_N_METHODS; ++method) {
        char *table[3];
        for (int k = 0; k < 3; ++k) {
            char *log = run_with(texts[k], hs_neighbor_methods[method], 1, hs_isa_best());
            table[k] = keep_results(log, false);
            *strstr(table[k], "Neighbor list builds") = '\0';
            free(log);
        }
        ck_assert_msg(strcmp(table[0], table[1]) == 0, "%s: careful\n%s\nexact\n%s", hs_neighbor_methods[method],
                      table[0], table[1]);
        ck_assert_msg(strcmp(table[0], table[2]) != 0, "%s: the lax schedule should miss pairs\n%s",
                      hs_neighbor_methods[method], table[2]);
        for (int k = 0; k < 3; ++k) free(table[k]);
    }
}
END_TEST

static void get_energy(hs_deck *deck, void *context) { *(double *)context = deck->sim->env.pair_energy; }

/** Lists made for the kernels of one precision are not given to those of the other: `pre no` then makes them anew. */
START_TEST(precision_changed_between_runs)
{
    static const char *const texts[2] = {LIQUID TWO_TYPES LAX_SCHEDULE "fix 1 all nve\nrun 20\nrun 1 pre no\n",
                                         LIQUID TWO_TYPES LAX_SCHEDULE
                                         "fix 1 all nve\nrun 20\nprecision mixed\nrun 1 pre no\n"};
    for (int method = 0; method < HS_N_METHODS; ++method)
        for (int isa = 0; isa <= (int)hs_isa_best(); ++isa) {
            double energy[2] = {0.0, 0.0};
            for (int k = 0; k < 2; ++k) {
                hs_error err;
                const hs_options options = hs_test_options(1, hs_neighbor_methods[method], isa);
                free(hs_test_run_deck_with(texts[k], &options, get_energy, &energy[k], &err));
                ck_assert_msg(err.status == HS_OK, "%s: %s", hs_neighbor_methods[method], err.text);
            }
            /* mixed precision: 1e-6 of each pair's energy */
            ck_assert_msg(fabs(energy[0] - energy[1]) < 1e-5 * fabs(energy[0]), "%s, %s: %.9g, then %.9g",
                          hs_neighbor_methods[method], hs_isa_names[isa], energy[0], energy[1]);
        }
}
END_TEST

/* Coefficients of TWO_TYPES, and which pairs the deck leaves out, said anew. */
typedef struct plain_pair {
    double epsilon, sigma, cutoff;
} plain_pair;

static plain_pair plain_coefficients(int type_i, int type_j)
{
    if (type_i != type_j) return (plain_pair){1.3, 0.95, 2.8};
    return type_i == 1 ? (plain_pair){1.0, 1.0, 2.5} : (plain_pair){0.7, 0.85, 2.1};
}

typedef struct plain_atom {
    int type;
    int64_t id;
} plain_atom;

static bool none(plain_atom a, plain_atom b) { return (void)a, (void)b, false; }
static bool unlike_types(plain_atom a, plain_atom b) { return a.type != b.type; }
static bool second_type(plain_atom a, plain_atom b) { return a.type == 2 && b.type == 2; }
static bool first_with_all_but_last(plain_atom a, plain_atom b)
{
    return (a.id <= 100 && b.id <= 240) || (b.id <= 100 && a.id <= 240);
}
static bool overlapping(plain_atom a, plain_atom b)
{
    return (a.id <= 150 && b.id >= 100 && b.id <= 260) || (b.id <= 150 && a.id >= 100 && a.id <= 260);
}
static bool overlapping_or_second_type(plain_atom a, plain_atom b) { return overlapping(a, b) || second_type(a, b); }
static bool odd_among_themselves(plain_atom a, plain_atom b) { return a.id % 2 != 0 && b.id % 2 != 0; }
static bool all_pairs(plain_atom a, plain_atom b) { return (void)a, (void)b, true; }

static const struct exclusion_case {
    const char *words;
    bool (*is_excluded)(plain_atom a, plain_atom b);
} exclusions[] = {
    {"", none},
    {"neigh_modify exclude type 1 2\n", unlike_types},
    {"neigh_modify exclude type 2 2\n", second_type},
    {"group a id 1:100\ngroup b id 1:240\nneigh_modify exclude group a b\n", first_with_all_but_last},
    {"group a id 1:150\ngroup b id 100:260\nneigh_modify exclude group b a\n", overlapping},
    {"group a id 1:150\ngroup b id 100:260\nneigh_modify exclude group a b exclude type 2 2\n",
     overlapping_or_second_type},
    {"group odd id 1:9999:2\nneigh_modify exclude group odd odd\n", odd_among_themselves},
    {"neigh_modify exclude group all all\n", all_pairs},
    {"neigh_modify exclude group all all\nneigh_modify exclude none exclude type 2 2\n", second_type},
};

/** Forces, energy and virial of a simulation after `run 0` against the plain sum over ordered pairs and all images. */
static void compare_with_plain_sum(hs_deck *deck, void *context)
{
    const struct exclusion_case *exclusion = context;
    const hs_sim *sim = deck->sim;
    const hs_atoms *atoms = &sim->atoms;
    const double scale = 1000.0; /* larger than any pair force between atoms as far apart as these */
    double energy = 0.0, virial = 0.0, length[3];
    int m[3];
    for (int axis = 0; axis < 3; ++axis) {
        length[axis] = hs_box_length(&sim->box, axis);
        m[axis] = axis < sim->box.dimension ? (int)ceil(2.8 / length[axis]) : 0;
    }
    for (int i = 0; i < atoms->n_local; ++i) {
        double f[3] = {0.0, 0.0, 0.0};
        for (int j = 0; j < atoms->n_local; ++j) {
            const plain_atom a = {atoms->type[i], atoms->id[i]}, b = {atoms->type[j], atoms->id[j]};
            const plain_pair pair = plain_coefficients(a.type, b.type);
            if (exclusion->is_excluded(a, b)) continue;
            for (int image = 0; image < (2 * m[0] + 1) * (2 * m[1] + 1) * (2 * m[2] + 1); ++image) {
                const int k[3] = {image % (2 * m[0] + 1) - m[0], image / (2 * m[0] + 1) % (2 * m[1] + 1) - m[1],
                                  image / (2 * m[0] + 1) / (2 * m[1] + 1) - m[2]};
                double d[3], r2 = 0.0;
                for (int axis = 0; axis < 3; ++axis) {
                    d[axis] = atoms->x[axis][i] - atoms->x[axis][j] - k[axis] * length[axis];
                    r2 += d[axis] * d[axis];
                }
                if (r2 == 0.0 || r2 >= pair.cutoff * pair.cutoff) continue;
                const double s6 = pow(pair.sigma * pair.sigma / r2, 3.0);
                const double over_r = 24.0 * pair.epsilon * (2.0 * s6 * s6 - s6) / r2;
                ck_assert_double_lt(fabs(over_r) * sqrt(r2), scale);
                energy += 2.0 * pair.epsilon * (s6 * s6 - s6); /* half: ordered pairs */
                virial += 0.5 * over_r * r2;
                for (int axis = 0; axis < 3; ++axis) f[axis] += over_r * d[axis];
            }
        }
        /* some tens of terms with relative errors of some epsilon each */
        for (int axis = 0; axis < 3; ++axis)
            ck_assert_msg(fabs(atoms->f[axis][i] - f[axis]) < 1e-12 * scale,
                          "%sforce %c of atom %lld: %.15g, not %.15g", exclusion->words, "xyz"[axis],
                          (long long)atoms -> id[i], atoms -> f[axis][i], f[axis]);
    }
    const double *w = sim->env.pair_virial;
    const double limit = 1e-13 * scale * atoms->n_local;
    ck_assert_msg(fabs(sim->env.pair_energy - energy) < limit, "%senergy %.15g, not %.15g", exclusion->words,
                  sim->env.pair_energy, energy);
    ck_assert_msg(fabs(w[0] + w[1] + w[2] - virial) < limit, "%svirial %.15g, not %.15g", exclusion->words,
                  w[0] + w[1] + w[2], virial);
}

/** After some steps, so that no symmetry of the lattice hides anything. */
START_TEST(exclusions_and_cutoffs)
{
    static const char *const systems[] = {LIQUID TWO_TYPES, DISKS TWO_TYPES};
    struct exclusion_case exclusion = exclusions[_i];
    char text[2048];
    for (int system = 0; system < 2; ++system) {
        snprintf(text, sizeof text, "%s%sfix 1 all nve\nrun 20\n%srun 0\n", systems[system], SHORT_SCHEDULE,
                 exclusion.words);
        for (int method = 0; method < HS_N_METHODS; ++method)
            for (int isa = 0; isa <= (method == HS_METHOD_NSQ ? 0 : (int)hs_isa_best()); ++isa) {
                hs_error err;
                const hs_options options = hs_test_options(1 + (method + isa) % 3, hs_neighbor_methods[method], isa);
                free(hs_test_run_deck_with(text, &options, compare_with_plain_sum, &exclusion, &err));
                ck_assert_msg(err.status == HS_OK, "%s: %s", hs_neighbor_methods[method], err.text);
            }
    }
}
END_TEST

HS_LOOP_TEST_MAIN("methods", {same_tables, (int)(sizeof decks / sizeof decks[0])}, {exact_pairs, 1},
                  {precision_changed_between_runs, 1},
                  {exclusions_and_cutoffs, (int)(sizeof exclusions / sizeof exclusions[0])})
