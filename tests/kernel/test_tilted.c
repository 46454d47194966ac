/* Tilted boxes: forces, energies and virials of every method against a plain sum over all periodic images, and wrapped
 * places against whole edges. The oracle knows the three edges of the box and nothing else. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/harness.h"
#include "support/run_deck.h"

/* Two types of unlike size, depth and cutoff, off their lattice sites after some steps. */
#define ATOMS                                                                                                          \
    "create_box 2 box\ncreate_atoms 1 box\nset type 1 type/ratio 2 0.35 8765\nmass 1 1.0\nmass 2 2.5\n"                \
    "velocity all create 1.4 87287 dist gaussian\npair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\n"                     \
    "pair_coeff 2 2 0.7 0.85 2.1\npair_coeff 1 2 1.3 0.95 2.8\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check "  \
    "yes\nfix 1 all nve\ntimestep 0.004\n"
#define FCC "lattice fcc 0.80\nregion box prism "
#define HEX "dimension 2\nlattice hex 0.80\nregion box prism "

static const struct deck {
    const char *name, *text;
    int n_atoms;
} decks[] = {
    {"no tilts", FCC "0 4 0 3 0 5 0 0 0\n", 240},
    {"moderate", FCC "0 5 0 4 0 4 1 1 -1\n", 320},
    {"one tilt", FCC "-2 3 0 4 -1 3 0 0 2\n", 320},
    {"negative", FCC "0 5 0 4 0 4 -2 -1 -2\n", 320},
    {"half of the lengths", FCC "0 4 0 4 0 4 2 2 2\n", 256},
    {"steep", "box tilt large\n" FCC "0 4 0 3 0 3 7 -6 5\n", 144},
    {"steeper still", "box tilt large\n" FCC "0 3 0 2 0 2 80 0 0\n", 48},
    {"rhombohedral", FCC "0 4 0 2 0 2 2 2 0\n", 64},
    {"thin", FCC "0 8 0 1 0 2 3 -4 0.5\n", 64},
    {"smaller than the cutoff", "box tilt large\n" FCC "0 1 0 1 0 0.5 -1 0.5 0\n", 2},
    {"shrink-wrapped along x", "boundary s p p\n" FCC "0 5 0 4 0 4 2 1 -1\n", 324},
    {"disks", HEX "0 18 0 10 -0.1 0.1 7 0 0\n", 360},
    {"disks, negative", HEX "0 12 0 7 -0.1 0.1 -6 0 0\n", 168},
    {"steep disks", "box tilt large\n" HEX "0 12 0 6 -0.1 0.1 31 0 0\n", 144},
    {"disks in a thin box", HEX "0 30 0 1 -0.1 0.1 15 0 0\n", 60},
};
enum { N_DECKS = sizeof decks / sizeof decks[0] };

/* Coefficients of the decks, said anew. */
typedef struct plain_pair {
    double epsilon, sigma, cutoff;
} plain_pair;

static plain_pair coefficients(int type_i, int type_j)
{
    if (type_i != type_j) return (plain_pair){1.3, 0.95, 2.8};
    return type_i == 1 ? (plain_pair){1.0, 1.0, 2.5} : (plain_pair){0.7, 0.85, 2.1};
}

/** Edges a, b, c of a box, from the definition of its tilts. */
static void find_edges(const hs_box *box, double edge[3][3])
{
    const double edges[3][3] = {{box->hi[0] - box->lo[0], 0.0, 0.0},
                                {box->tilt[0], box->hi[1] - box->lo[1], 0.0},
                                {box->tilt[1], box->tilt[2], box->hi[2] - box->lo[2]}};
    memcpy(edge, edges, sizeof edges);
}

/** How many boxes away images within the largest cutoff can be: the distance of two faces is volume by area. */
static void count_images(const hs_box *box, double edge[3][3], int m[3])
{
    const double volume = edge[0][0] * edge[1][1] * edge[2][2];
    for (int axis = 0; axis < 3; ++axis) {
        const double *p = edge[(axis + 1) % 3], *q = edge[(axis + 2) % 3];
        const double area = sqrt(pow(p[1] * q[2] - p[2] * q[1], 2.0) + pow(p[2] * q[0] - p[0] * q[2], 2.0) +
                                 pow(p[0] * q[1] - p[1] * q[0], 2.0));
        m[axis] = box->periodic[axis] && axis < box->dimension ? (int)ceil(2.8 * area / volume) : 0;
    }
}

typedef struct check {
    const struct deck *deck;
    const char *what; /**< method, instruction set, precision */
    double relative;  /**< error of a pair force, of the largest one */
} check;

/** Forces, energy and virial of a simulation after `run 0`. */
static void compare_with_plain_sum(hs_deck *deck, void *context)
{
    const check *c = context;
    const hs_sim *sim = deck->sim;
    const hs_atoms *atoms = &sim->atoms;
    double energy = 0.0, virial[6] = {0}, edge[3][3], largest = 1.0, *f = calloc(3 * (size_t)atoms->n_local, sizeof *f);
    static const int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
    int m[3];
    ck_assert_ptr_nonnull(f);
    ck_assert_int_eq(atoms->n_local, c->deck->n_atoms);
    ck_assert(sim->box.is_tilted);
    find_edges(&sim->box, edge);
    count_images(&sim->box, edge, m);
    for (int i = 0; i < atoms->n_local; ++i)
        for (int j = 0; j < atoms->n_local; ++j) {
            const plain_pair pair = coefficients(atoms->type[i], atoms->type[j]);
            for (int image = 0; image < (2 * m[0] + 1) * (2 * m[1] + 1) * (2 * m[2] + 1); ++image) {
                const int k[3] = {image % (2 * m[0] + 1) - m[0], image / (2 * m[0] + 1) % (2 * m[1] + 1) - m[1],
                                  image / (2 * m[0] + 1) / (2 * m[1] + 1) - m[2]};
                double d[3], r2 = 0.0;
                for (int axis = 0; axis < 3; ++axis) {
                    d[axis] = atoms->x[axis][i] - atoms->x[axis][j] - k[0] * edge[0][axis] - k[1] * edge[1][axis] -
                              k[2] * edge[2][axis];
                    r2 += d[axis] * d[axis];
                }
                if (r2 == 0.0 || r2 >= pair.cutoff * pair.cutoff) continue;
                const double s6 = pow(pair.sigma * pair.sigma / r2, 3.0);
                const double over_r = 24.0 * pair.epsilon * (2.0 * s6 * s6 - s6) / r2;
                largest = fmax(largest, fabs(over_r) * sqrt(r2));
                energy += 2.0 * pair.epsilon * (s6 * s6 - s6); /* half: ordered pairs */
                for (int n = 0; n < 6; ++n) virial[n] += 0.5 * over_r * d[first[n]] * d[second[n]];
                for (int axis = 0; axis < 3; ++axis) f[3 * i + axis] += over_r * d[axis];
            }
        }
    /* a hundred terms with that relative error each */
    const double force_limit = 100.0 * c->relative * largest, limit = force_limit * (atoms->n_local + 10);
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3; ++axis)
            ck_assert_msg(fabs(atoms->f[axis][i] - f[3 * i + axis]) < force_limit,
                          "%s, %s: force %c of atom %lld: %.15g, not %.15g", c->deck->name, c->what, "xyz"[axis],
                          (long long)atoms -> id[i], atoms -> f[axis][i], f[3 * i + axis]);
    ck_assert_msg(fabs(sim->env.pair_energy - energy) < limit, "%s, %s: energy %.15g, not %.15g", c->deck->name,
                  c->what, sim->env.pair_energy, energy);
    for (int n = 0; n < 6; ++n)
        ck_assert_msg(fabs(sim->env.pair_virial[n] - virial[n]) < limit, "%s, %s: virial %d %.15g, not %.15g",
                      c->deck->name, c->what, n, sim->env.pair_virial[n], virial[n]);
    free(f);
}

START_TEST(forces_of_every_method)
{
    static const char *const forms[] = {"", "precision mixed\n", "reproducible off\n"};
    static const double relative[] = {1e-14, 1e-6, 1e-15};
    const struct deck *deck = &decks[_i];
    char text[2048], what[96];
    for (int method = 0; method < HS_N_METHODS; ++method)
        for (int isa = 0; isa <= (method == HS_METHOD_NSQ ? 0 : (int)hs_isa_best()); ++isa) {
            const int form = (method + isa) % 3;
            hs_error err;
            const hs_options options = hs_test_options(1 + (method + isa) % 3, hs_neighbor_methods[method], isa);
            snprintf(what, sizeof what, "%s, %s, form %d", hs_neighbor_methods[method], hs_isa_names[isa], form);
            snprintf(text, sizeof text, "%s%s%srun 20\nrun 0\n", forms[form], deck->text, ATOMS);
            check c = {deck, what, relative[form]};
            free(hs_test_run_deck_with(text, &options, compare_with_plain_sum, &c, &err));
            ck_assert_msg(err.status == HS_OK, "%s, %s: %s", deck->name, what, err.text);
        }
}
END_TEST

/** Places by id, one run. */
typedef struct places {
    double unwrapped[3], v[3];
} places;

static void keep_places(hs_deck *deck, void *context)
{
    places *all = context;
    const hs_atoms *atoms = &deck->sim->atoms;
    const hs_box *box = &deck->sim->box;
    double edge[3][3];
    find_edges(box, edge);
    for (int i = 0; i < atoms->n_local; ++i) {
        places *p = &all[atoms->id[i]];
        double x[3], fraction[3];
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] = p->unwrapped[axis] = atoms->x[axis][i];
            p->v[axis] = atoms->v[axis][i];
            for (int k = 0; k < 3; ++k) p->unwrapped[axis] += atoms->image[k][i] * edge[k][axis];
        }
        hs_box_fractions(box, x, fraction);
        for (int axis = 0; axis < 3; ++axis) ck_assert(fraction[axis] > -1e-12 && fraction[axis] < 1.0 + 1e-12);
    }
}

/** A free gas: atoms fly on straight lines, through faces and corners, and wrapping takes whole edges off. */
START_TEST(wrapped_places)
{
    static const char *const boxes[] = {"0 6 0 5 0 7 2.5 -3 2.1", "-1 6 2 5 -3 7 -3.5 3.5 -1.5", "0 6 0 5 0 7 0 0 0"};
    int n_far = 0;
    for (int box = 0; box < 3; ++box)
        for (int off = 0; off < 2; ++off) {
            char text[1024];
            hs_error err;
            const hs_options options = {.n_threads = 1};
            places at[2][4] = {0};
            for (int k = 0; k < 2; ++k) {
                snprintf(
                    text, sizeof text,
                    "%sregion box prism %s\ncreate_box 1 box\nlattice sc 1.0\nregion inner prism %s units box\n"
                    "create_atoms 1 single 1.1 2.2 3.3\ncreate_atoms 1 single 2.3 3.1 4.9\ncreate_atoms 1 single 4.4 "
                    "4.1 6.5\nmass 1 1.0\npair_style zero 1.0\npair_coeff * *\nvelocity all create 9.0 4711\n"
                    "neigh_modify every 1 delay 0 check yes\nfix 1 all nve\ntimestep 0.01\nrun %d\n",
                    off ? "reproducible off\n" : "", boxes[box], boxes[box], k * 2000);
                free(hs_test_run_deck_with(text, &options, keep_places, at[k], &err));
                ck_assert_msg(err.status == HS_OK, "%s: %s", boxes[box], err.text);
            }
            for (int id = 1; id <= 3; ++id)
                for (int axis = 0; axis < 3; ++axis) {
                    const double flown = at[1][id].unwrapped[axis] - at[0][id].unwrapped[axis];
                    /* 2000 additions, each rounded to 1e-15 of the box */
                    ck_assert_double_eq_tol(flown, 20.0 * at[0][id].v[axis], 1e-10);
                    n_far += fabs(flown) > 20.0;
                }
        }
    ck_assert_int_gt(n_far, 18); /* of 54: most have crossed some boxes */
}
END_TEST

HS_LOOP_TEST_MAIN("tilted", {forces_of_every_method, N_DECKS}, {wrapped_places, 1})
