/* Every pair style there is: forces by all methods, instruction sets and precisions against the plain sum; the force is
 * minus the slope of the energy; energy and force at the cutoff; published or exact values. */
#include "kernel/pair_system.h"

#define TABLE TEST_SOURCE_DIR "/kernel/potentials.table"

/** How a style is used here: words of pair_style, and of pair_coeff for the types 1 1, 2 2 and 1 2. */
static const struct usage {
    const char *style, *words, *coeff[3];
    /** Continuous at the cutoff: energy, then energy and force. 0: neither. With pair_modify shift yes, the energy
     *  always is. */
    int smoothness;
    bool can_shift;
} usages[] = {
    {"lj/cut", "2.5", {"1 1", "0.7 0.9 2.2", "1.3 0.95 2.8"}, 0, true},
    {"wca", "", {"1 1", "0.7 0.9", "1.3 0.95"}, 2, false},
    {"soft", "1.4", {"10", "25 1.2", "-3 1.9"}, 2, false},
    {"harmonic/cut", "", {"50 1.1", "20 1.3", "30 1.6"}, 2, false},
    {"harmonic/repulsion", "", {"50 1.1", "20 1.3", "30 1.6"}, 2, false},
    {"yukawa", "2.0 2.2", {"40", "10 1.8", "-3 1.7"}, 0, true},
    {"morse", "2.5", {"1 5 1.1", "2 4 1.2 2.2", "0.5 3 1.2"}, 0, true},
    {"gauss", "2.5", {"-30 2", "10 1.5 2.2", "0.3 1.0 1.8"}, 0, true},
    {"lj/expand", "2.0", {"1 0.7 0.3", "0.7 0.6 0.2 1.8", "1.3 0.7 -0.1 2.5"}, 0, true},
    {"lj/smooth", "1.2 2.5", {"1 1", "0.7 0.9 1.3 2.2", "1.3 0.95 1.1 2.7"}, 1, true},
    {"lj/cubic", "", {"1 1", "0.7 0.9", "1.3 0.95"}, 2, false},
    {"lj/smooth/linear", "2.5", {"1 1", "0.7 0.9 2.2", "1.3 0.95 2.7"}, 2, false},
    {"lj/sf", "2.5", {"1 1", "0.7 0.9 2.2", "1.3 0.95 2.7"}, 2, false},
    {"buck", "2.5", {"200 0.3 1", "150 0.32 0.7 2.2", "100 0.31 0.2"}, 0, true},
    {"harmonic/sphere", "", {"50", "20", "30"}, 2, false},
    {"table", "spline 400", {TABLE " SMALL", TABLE " LARGE", TABLE " WEAK"}, 0, false},
    {"mie/cut", "2.5", {"1 1 12 6", "0.7 0.9 14 7.5 2.2", "1.3 0.95 9.3 4 2.8"}, 0, true},
    {"nm/cut", "2.5", {"1 1.1 12 6", "0.7 1.0 13 7.5 2.2", "1.3 1.05 9.3 4 2.8"}, 0, true},
    {"lj96/cut", "2.5", {"1 1", "0.7 0.9 2.2", "1.3 0.95 2.8"}, 0, true},
    {"lj/class2", "2.5", {"1 1", "0.7 0.9 2.2", "1.3 0.95 2.8"}, 0, true},
    {"cosine/squared", "2.5", {"1 1.1 wca", "0.7 0.9 1.8", "1.3 1.2 1.2 wca"}, 2, false},
    {"gauss/cut", "2.5", {"2 1.2 0.3", "-3 1.5 0.4 2.2", "0.5 0 0.5 1.8"}, 0, true},
    {"colloid", "2.5", {"100 1 0.4 0.4", "144 0.9 0 0 2.2", "60 0.95 0.4 0 2.0"}, 0, true},
    {"born", "2.5", {"3 0.3 1 1 0.4", "2 0.32 0.9 0.7 0.3 2.2", "1 0.31 1.1 0.2 0.1"}, 0, true},
};
enum { N_USAGES = (int)(sizeof usages / sizeof usages[0]) };

/* One small and one large sphere, which set the cutoffs of harmonic/sphere. */
static double radius_of_two[2] = {0.3, 0.9};
static int32_t type_of_two[2] = {1, 2};
static hs_atoms two_spheres = {.n_local = 2, .radius = radius_of_two, .type = type_of_two};
static const hs_parallel one_rank = {.n_ranks = 1};
static hs_env env = {.atoms = &two_spheres, .parallel = &one_rank};

/** Radii up to those of two_spheres, for the atoms of a system. */
static void set_radii(system_t *s)
{
    for (int i = 0; i < s->atoms.n_local && s->radius != NULL; ++i)
        s->radius[i] = radius_of_two[s->atoms.type[i] - 1] * (1.0 - 0.07 * (i % 8));
}

/** The potential at a distance; of harmonic/sphere for the two largest spheres of the types. */
static void single(const hs_pair *pair, int i, int j, double r, double *over_r, double *energy)
{
    const hs_evaluator *evaluator = pair->style->evaluator;
    double cutoff, p[HS_EVALUATOR_PARAMS_MAX + 1];
    pair->style->params(pair, i, j, &cutoff, p);
    if (evaluator->has_radii) p[evaluator->n_params] = radius_of_two[i - 1] + radius_of_two[j - 1];
    const double *shared = pair->style->shared != NULL ? pair->style->shared(pair) : NULL;
    evaluator->single(p, shared, r * r, over_r, energy);
}

/** Words of a line as arguments; the words live until the next call with the same buffer. */
static hs_args split(const char *line, char *buffer, size_t size, const char *words[16])
{
    hs_args args = {.command = "test", .word = words};
    snprintf(buffer, size, "%s", line);
    for (char *word = strtok(buffer, " "); word != NULL; word = strtok(NULL, " ")) words[args.n++] = word;
    return args;
}

static hs_pair *make_pair(const struct usage *usage, int n_types, bool shift)
{
    static const int types[3][2] = {{1, 1}, {2, 2}, {1, 2}};
    const char *words[16];
    char buffer[512];
    hs_pair *pair = NULL;
    memset(&err, 0, sizeof err);
    two_spheres.n_local = n_types; /* one of each type that there is */
    const hs_pair_style *style = hs_pair_style_find(usage->style);
    ck_assert_msg(style != NULL, "there is no pair style %s", usage->style);
    ck_assert_hs_ok(hs_pair_create(&pair, style, &env, n_types, &err), err);
    hs_args args = split(usage->words, buffer, sizeof buffer, words);
    ck_assert_hs_ok(style->settings(pair, &args, &err), err);
    for (int k = 0; k < 2 * n_types - 1; ++k) {
        args = split(usage->coeff[k], buffer, sizeof buffer, words);
        ck_assert_hs_ok(style->coeff(pair, types[k][0], types[k][1], &args, &err), err);
        pair->is_set[hs_pair_index(pair, types[k][0], types[k][1])] = 1;
    }
    pair->shift = shift;
    ck_assert_hs_ok(hs_pair_complete(pair, &err), err);
    return pair;
}

static void begin_system(system_t *s, hs_pair *pair, int dimension, const double length[3], const char *boundary)
{
    begin_box(s, pair->style->evaluator, dimension, length, boundary, pair->n_types);
    s->table.shared = pair->style->shared != NULL ? pair->style->shared(pair) : NULL;
    for (int i = 1; i <= pair->n_types; ++i)
        for (int j = i; j <= pair->n_types; ++j) {
            double cutoff, p[HS_EVALUATOR_PARAMS_MAX + 1];
            pair->style->params(pair, i, j, &cutoff, p);
            set_row(s, i, j, cutoff, p);
        }
    s->table.is_uniform = hs_pair_table_is_uniform(&s->table);
}

/** As in test_forces.c; here no potential is steeper than r^-14 at r = 0.8, so the same tolerances hold, with
 *  exponentials and cosines of 2 units in the last place among the some tens of terms. */
static const double tolerances[HS_N_PRECISIONS] = {1e-12, 4e-5, 1e-12};

START_TEST(all_methods)
{
    const struct usage *usage = &usages[_i];
    int n_cases = 0;
    for (int dimension = 2; dimension <= 3; ++dimension)
        for (int n_types = 1; n_types <= 2; ++n_types) {
            hs_pair *pair = make_pair(usage, n_types, usage->can_shift && dimension == 3);
            system_t s;
            begin_system(&s, pair, dimension, (const double[]){7.0, 6.3, dimension == 2 ? 1.0 : 5.9},
                         dimension == 2 ? "pfp" : "ppf");
            add_random(&s, dimension == 2 ? 40 : 190, 0.8, 4711);
            set_radii(&s);
            forces_t right = sum_all_images(&s);
            for (int kind = -1; kind < 3 * 2 * HS_N_PRECISIONS * ((int)hs_isa_best() + 1); ++kind) {
                const method_t method = kind < 0 ? NSQ : (method_t)(CELL + kind % 3);
                const bool with_energy = kind < 0 || kind / 3 % 2;
                const hs_precision precision =
                    (hs_precision)(kind < 0 ? HS_PRECISION_DOUBLE : kind / 6 % HS_N_PRECISIONS);
                const hs_isa isa = kind < 0 ? HS_ISA_PORTABLE : (hs_isa)(kind / (6 * HS_N_PRECISIONS));
                char name[160];
                hs_threads_set(1 + (kind + 1 + n_cases++) % 2);
                forces_t given = evaluate_with(&s, method, isa, precision, with_energy);
                snprintf(name, sizeof name, "%s, %dD, %d types, %s, %s, %s", usage->style, dimension, n_types,
                         method_names[method], hs_isa_names[isa], form_names[precision]);
                assert_same(&given, &right, s.atoms.n_local, with_energy, tolerances[precision], name);
                free_forces(&given);
            }
            free_forces(&right);
            end_system(&s);
            hs_pair_destroy(&pair);
        }
}
END_TEST

/** By central differences: truncation h^2 U'''/6 with U''' below 1e5 of the energy's scale beyond r = 0.8; rounding eps
 *  U/h. */
START_TEST(force_is_minus_slope)
{
    const struct usage *usage = &usages[_i];
    hs_pair *pair = make_pair(usage, 2, usage->can_shift);
    /* a table has splines for force and energy each: they meet in the rows of its file only, here 0.01 apart */
    const double h = 1e-6, tolerance = strcmp(usage->style, "table") == 0 ? 3e-4 : 1e-8;
    for (int i = 1; i <= 2; ++i)
        for (int j = i; j <= 2; ++j) {
            double cutoff, p[HS_EVALUATOR_PARAMS_MAX + 1], over_r, unused, low, high;
            pair->style->params(pair, i, j, &cutoff, p);
            for (int k = 0; k < 200; ++k) {
                const double first = fmin(0.8, 0.5 * cutoff), r = first + (cutoff - first - 2.0 * h) * k / 199.0;
                single(pair, i, j, r, &over_r, &unused);
                single(pair, i, j, r - h, &unused, &low);
                single(pair, i, j, r + h, &unused, &high);
                const double slope = (high - low) / (2.0 * h), scale = 1.0 + fabs(low) + fabs(over_r * r);
                ck_assert_msg(fabs(over_r * r + slope) < tolerance * scale, "%s %d %d at %g: force %.12g, slope %.12g",
                              usage->style, i, j, r, over_r * r, slope);
            }
        }
    hs_pair_destroy(&pair);
}
END_TEST

/** At the cutoff what is continuous is zero to rounding, and what is not is not. */
START_TEST(at_the_cutoff)
{
    const struct usage *usage = &usages[_i];
    for (int shift = 0; shift <= (int)usage->can_shift; ++shift) {
        hs_pair *pair = make_pair(usage, 2, shift);
        for (int i = 1; i <= 2; ++i)
            for (int j = i; j <= 2; ++j) {
                double cutoff, p[HS_EVALUATOR_PARAMS_MAX + 1], over_r, energy, inner, energy_inner;
                pair->style->params(pair, i, j, &cutoff, p);
                single(pair, i, j, cutoff, &over_r, &energy);
                single(pair, i, j, fmin(0.8, 0.5 * cutoff), &inner, &energy_inner);
                const double scale = 1e-13 * (fabs(inner) + fabs(energy_inner));
                const bool has_energy = !shift && usage->can_shift;
                ck_assert_msg((fabs(energy) < scale) == !has_energy, "%s %d %d: energy %g at the cutoff", usage->style,
                              i, j, energy);
                const bool has_force = usage->smoothness < 2 && strcmp(usage->style, "lj/smooth") != 0;
                ck_assert_msg(strcmp(usage->style, "wca") == 0 || (fabs(over_r) < scale) == !has_force,
                              "%s %d %d: force/r %g at the cutoff", usage->style, i, j, over_r);
            }
        hs_pair_destroy(&pair);
    }
}
END_TEST

START_TEST(every_style_is_here)
{
    for (size_t k = 0; hs_pair_styles[k] != NULL; ++k) {
        const hs_pair_style *style = hs_pair_styles[k];
        bool is_here = style->evaluator == NULL;
        for (int n = 0; n < N_USAGES; ++n) is_here |= strcmp(usages[n].style, style->about.name) == 0;
        ck_assert_msg(is_here, "pair style %s is missing in this test's table", style->about.name);
    }
}
END_TEST

/** Energy and force/r of type pair 1 1 at a distance. */
static void check_value(const char *style, double r, double energy, double force)
{
    const struct usage *usage = usages;
    while (strcmp(usage->style, style) != 0) ++usage;
    hs_pair *pair = make_pair(usage, 1, false);
    double over_r, u;
    single(pair, 1, 1, r, &over_r, &u);
    ck_assert_msg(fabs(u - energy) < 1e-13 * (1.0 + fabs(energy)), "%s: energy %.17g, not %.17g", style, u, energy);
    ck_assert_msg(fabs(over_r * r - force) < 1e-13 * (1.0 + fabs(force)), "%s: force %.17g, not %.17g", style,
                  over_r * r, force);
    hs_pair_destroy(&pair);
}

START_TEST(exact_values)
{
    check_value("soft", 0.7, 10.0, 10.0 * M_PI / 1.4); /* half the cutoff: cosine 0, sine 1 */
    check_value("soft", 0.0, 20.0, 0.0);
    check_value("harmonic/cut", 1.0, 50.0 * 0.01, 100.0 * 0.1);
    check_value("harmonic/cut", 0.0, 50.0 * 1.21, 0.0);
    check_value("harmonic/repulsion", 0.55, 50.0 / 8.0, 50.0 / 1.1 * 0.5);
    check_value("harmonic/sphere", 0.3, 50.0 / 8.0, 50.0 / 0.6 * 0.5); /* diameters 0.6 */
    check_value("yukawa", 1.0, 40.0 * exp(-2.0), 120.0 * exp(-2.0));
    check_value("morse", 1.1, -1.0, 0.0);
    check_value("gauss", 1.0, 30.0 * exp(-2.0), 120.0 * exp(-2.0));
    check_value("gauss", 0.0, 30.0, 0.0);
    check_value("lj/expand", 1.0, 0.0, 24.0 / 0.7);
    check_value("lj/smooth", 1.0, 0.0, 24.0);
    check_value("lj/cubic", 1.0, 0.0, 24.0);
    check_value("lj/cubic", 67.0 / 48.0 * pow(26.0 / 7.0, 1.0 / 6.0), 0.0, 0.0);
    check_value("lj/smooth/linear", 2.5, 0.0, 0.0);
    check_value("mie/cut", 1.0, 0.0, 24.0);
    check_value("mie/cut", pow(2.0, 1.0 / 6.0), -1.0, 0.0);
    check_value("nm/cut", 1.1, -1.0, 0.0);
    check_value("lj96/cut", 1.0, 0.0, 12.0);
    check_value("lj/class2", 1.0, -1.0, 0.0);
    check_value("cosine/squared", 1.8, -0.5,
                -0.25 * M_PI / 0.7); /* half-way: cosine^2 1/2, sine of twice the angle 1 */
    check_value("cosine/squared", 1.1, -1.0, 0.0);
    check_value("gauss/cut", 1.2, 2.0 / (0.3 * sqrt(2.0 * M_PI)), 0.0);
    check_value("gauss/cut", 1.5, 2.0 / (0.3 * sqrt(2.0 * M_PI)) * exp(-0.5),
                2.0 / (0.09 * sqrt(2.0 * M_PI)) * exp(-0.5));
    check_value("buck", 1.0, 200.0 * exp(-1.0 / 0.3) - 1.0, 200.0 / 0.3 * exp(-1.0 / 0.3) - 6.0);
    check_value("born", 1.0, 3.0 - 1.0 + 0.4, 10.0 - 6.0 + 3.2);
}
END_TEST

HS_LOOP_TEST_MAIN("pair styles", {all_methods, N_USAGES}, {force_is_minus_slope, N_USAGES}, {at_the_cutoff, N_USAGES},
                  {every_style_is_here, 1}, {exact_values, 1})
