/* Set-up commands against LAMMPS: box, positions, types and image numbers must have the same bits, velocities all but
 * the last few: LAMMPS rounds the sums for momentum and temperature at every atom, Halfshell once.
 * tests/golden/setup/NAME.deck are the decks, NAME.values what lmp of 29 Sep 2021 made of them (setup/make.sh). */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "deck/deck.h"
#include "support/harness.h"

/* Sums of up to some thousand terms of order 1 that are rounded at each term: a few tens of units in the last place. */
#define V_TOLERANCE 1e-14

/** An expected atom. */
typedef struct row {
    int64_t id;
    int type, image[3];
    double x[3], v[3];
} row;

static FILE *open_values(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/golden/setup/%s.values", TEST_SOURCE_DIR, name);
    FILE *file = fopen(path, "r");
    ck_assert_msg(file != NULL, "cannot open %s", path);
    return file;
}

static void check_box(const char *name, const hs_box *box, FILE *file)
{
    for (int axis = 0; axis < 3; ++axis) {
        double lo, hi;
        ck_assert_int_eq(fscanf(file, "%lf %lf", &lo, &hi), 2);
        ck_assert_msg(box->lo[axis] == lo && box->hi[axis] == hi,
                      "%s: box along %c is %.17g %.17g, LAMMPS has %.17g "
                      "%.17g",
                      name, "xyz"[axis], box -> lo[axis], box -> hi[axis], lo, hi);
    }
}

static int find_atom(const hs_atoms *atoms, int64_t id)
{
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->id[i] == id) return i;
    return -1;
}

static bool read_row(FILE *file, row *r)
{
    return fscanf(file, "%" SCNd64 " %d %lf %lf %lf %lf %lf %lf %d %d %d", &r->id, &r->type, &r->x[0], &r->x[1],
                  &r->x[2], &r->v[0], &r->v[1], &r->v[2], &r->image[0], &r->image[1], &r->image[2]) == 11;
}

static void check_atom(const char *name, const hs_atoms *atoms, const row *r)
{
    const int i = find_atom(atoms, r->id);
    ck_assert_msg(i >= 0, "%s: atom %" PRId64 " is missing", name, r->id);
    ck_assert_msg(atoms->type[i] == r->type, "%s: atom %" PRId64 " has type %d, LAMMPS %d", name, r->id, atoms->type[i],
                  r->type);
    for (int axis = 0; axis < 3; ++axis) {
        ck_assert_msg(atoms->x[axis][i] == r->x[axis], "%s: atom %" PRId64 ": %c is %.17g, LAMMPS has %.17g", name,
                      r->id, "xyz"[axis], atoms -> x[axis][i], r -> x[axis]);
        ck_assert_msg(fabs(atoms->v[axis][i] - r->v[axis]) <= V_TOLERANCE * (1.0 + fabs(r->v[axis])),
                      "%s: atom %" PRId64 ": v%c is %.17g, LAMMPS has %.17g", name, r->id, "xyz"[axis],
                      atoms -> v[axis][i], r -> v[axis]);
        ck_assert_msg(atoms->image[axis][i] == r->image[axis], "%s: atom %" PRId64 ": i%c is %d, LAMMPS has %d", name,
                      r->id, "xyz"[axis], atoms -> image[axis][i], r -> image[axis]);
    }
}

static void compare(const char *name)
{
    hs_error err = {0};
    hs_sink out = {0};
    hs_options options = {.n_threads = 1};
    hs_deck *deck = NULL;
    char path[512];
    snprintf(path, sizeof path, "%s/golden/setup/%s.deck", TEST_SOURCE_DIR, name);
    ck_assert_hs_ok(hs_deck_create(&deck, &options, &out, &err), err);
    ck_assert_hs_ok(hs_deck_check(deck, path, &err), err);
    ck_assert_hs_ok(hs_deck_run(deck, path, &err), err);
    FILE *file = open_values(name);
    check_box(name, &deck->sim->box, file);
    row r;
    int n = 0;
    for (; read_row(file, &r); ++n) check_atom(name, &deck->sim->atoms, &r);
    ck_assert(feof(file));
    fclose(file);
    ck_assert_msg(n == deck->sim->atoms.n_local, "%s: %d atoms, LAMMPS has %d", name, deck->sim->atoms.n_local, n);
    hs_deck_destroy(&deck);
}

static const char *const names[] = {
    "fcc_geom", "bcc_two_masses", "hex_2d",    "diamond_orient",  "fcc_111", "custom",
    "sq2_ramp", "hcp_real",       "random_3d", "random_2d",       "shrink",  "cones",
    "regions",  "random_types",   "variables", "random_formulas",
};

START_TEST(test_same_bits)
{
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) compare(names[k]);
}
END_TEST

HS_TEST_MAIN("golden.setup", test_same_bits)
