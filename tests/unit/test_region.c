/* Regions: inside and outside, faces, extents, units, and what is refused. */
#include <stdio.h>
#include <string.h>

#include "core/lattice.h"
#include "style/region.h"
#include "support/harness.h"

enum { MAX_REGIONS = 16, MAX_WORDS = 24 };

/** A small world for regions: a box, a lattice, and the list in which unions look members up. */
static hs_box box;
static hs_lattice lattice;
static hs_region *known[MAX_REGIONS];
static int n_known;

static hs_region *find(hs_env *env, const char *id)
{
    (void)env;
    for (int k = 0; k < n_known; ++k)
        if (strcmp(known[k]->id, id) == 0) return known[k];
    return NULL;
}

static hs_env env = {.box = &box, .lattice = &lattice, .find_region = find};

/** `ID style words...`; NULL with an error. */
static hs_region *define(const char *line, hs_error *err)
{
    char buffer[256];
    const char *word[MAX_WORDS];
    int n = 0;
    snprintf(buffer, sizeof buffer, "%s", line);
    for (char *at = strtok(buffer, " "); at != NULL; at = strtok(NULL, " ")) word[n++] = at;
    const hs_args args = {.command = "region", .n = n - 2, .word = word + 2};
    hs_region *region = NULL;
    if (hs_region_create(&region, &env, word[0], word[1], &args, err) == HS_OK) known[n_known++] = region;
    return region;
}

static hs_region *must_define(const char *line)
{
    hs_error err = {0};
    hs_region *region = define(line, &err);
    ck_assert_msg(region != NULL, "%s: %s", line, err.text);
    return region;
}

static void begin(void)
{
    n_known = 0;
    hs_box_init(&box);
    box.exists = true;
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] = 10.0;
    hs_lattice_init(&lattice);
}

static void end(void)
{
    while (n_known > 0) hs_region_destroy(&known[--n_known]);
    hs_lattice_fini(&lattice);
}

static bool holds(const hs_region *region, double x, double y, double z)
{
    return hs_region_contains(region, (const double[3]){x, y, z});
}

START_TEST(test_block)
{
    begin();
    const hs_region *r = must_define("a block 0 1 EDGE 2 INF EDGE");
    ck_assert(holds(r, 0, 0, 0) && holds(r, 1, 2, 10) && holds(r, 0.5, 1, -1e9));
    ck_assert(!holds(r, 1.0000001, 1, 1) && !holds(r, 0.5, -0.1, 1) && !holds(r, 0.5, 1, 10.1));
    ck_assert(r->has_extent && r->extent[1][0] == 0.0 && r->extent[2][0] == -HS_REGION_FAR);
    const hs_region *o = must_define("b block 0 1 0 1 0 1 side out");
    ck_assert(!holds(o, 0.5, 0.5, 0.5) && !holds(o, 1, 1, 1) && holds(o, 2, 0.5, 0.5) && !o->has_extent);
    end();
}
END_TEST

START_TEST(test_units)
{
    begin();
    lattice.spacing[0] = 2.0, lattice.spacing[1] = 3.0, lattice.spacing[2] = 4.0;
    const hs_region *r = must_define("a block 0 1 0 1 0 1");
    ck_assert(r->extent[0][1] == 2.0 && r->extent[1][1] == 3.0 && r->extent[2][1] == 4.0);
    const hs_region *b = must_define("b block 0 1 0 1 0 1 units box side in");
    ck_assert(b->extent[1][1] == 1.0);
    const hs_region *c = must_define("c cylinder x 1 1 1 0 1"); /* radius in units of y */
    ck_assert(holds(c, 0, 3, 7) && !holds(c, 0, 3, 7.1) && holds(c, 2, 3, 4) && !holds(c, 2.1, 3, 4));
    const hs_region *d = must_define("d cylinder z 1 1 1 0 1"); /* of x */
    ck_assert(holds(d, 4, 3, 0) && !holds(d, 4.1, 3, 0));
    const hs_region *s = must_define("e sphere 0 0 0 1");
    ck_assert(holds(s, 0, 0, 2) && !holds(s, 0, 0, 2.1));
    end();
}
END_TEST

START_TEST(test_shapes)
{
    begin();
    const hs_region *s = must_define("s sphere 1 2 3 2");
    ck_assert(holds(s, 3, 2, 3) && !holds(s, 3.001, 2, 3) && s->extent[2][0] == 1.0 && s->extent[2][1] == 5.0);
    const hs_region *c = must_define("c cylinder y 1 3 2 INF 4");
    ck_assert(holds(c, 3, -100, 3) && !holds(c, 3, 4.1, 3) && !holds(c, 2.5, 0, 4.5));
    const hs_region *p = must_define("p plane 0 0 5 0 0 -2");
    ck_assert(holds(p, 7, 7, 5) && holds(p, 0, 0, -9) && !holds(p, 0, 0, 5.1) && !p->has_extent);
    const hs_region *t = must_define("t prism 0 2 0 2 0 2 1 0 0");
    ck_assert(holds(t, 0, 0, 0) && holds(t, 3, 2, 1) && !holds(t, 0.5, 2, 1) && !holds(t, 2.5, 0.5, 1));
    ck_assert(t->extent[0][0] == 0.0 && t->extent[0][1] == 3.0);
    const hs_region *n = must_define("n prism 0 2 0 2 0 2 -1 0.5 0");
    ck_assert(n->extent[0][0] == -1.0 && n->extent[0][1] == 2.5);
    end();
}
END_TEST

START_TEST(test_combinations)
{
    begin();
    hs_region *a = must_define("a block 0 4 0 4 0 4");
    hs_region *b = must_define("b block 2 6 0 4 0 4");
    must_define("nb block 2 6 0 4 0 4 side out");
    const hs_region *u = must_define("u union 2 a b");
    ck_assert(holds(u, 1, 1, 1) && holds(u, 5, 1, 1) && !holds(u, 7, 1, 1));
    ck_assert(u->has_extent && u->extent[0][0] == 0.0 && u->extent[0][1] == 6.0);
    const hs_region *i = must_define("i intersect 2 a b");
    ck_assert(holds(i, 3, 1, 1) && !holds(i, 1, 1, 1) && i->extent[0][0] == 2.0 && i->extent[0][1] == 4.0);
    const hs_region *d = must_define("d intersect 2 a nb");
    ck_assert(holds(d, 1, 1, 1) && !holds(d, 3, 1, 1) && d->has_extent);
    const hs_region *w = must_define("w union 2 a nb side out");
    ck_assert(!holds(w, 1, 1, 1) && !holds(w, 9, 9, 9) && holds(w, 5, 1, 1) && !w->has_extent);
    ck_assert(hs_region_uses(u, a) && !hs_region_uses(a, b) && hs_region_uses(i, b) && !hs_region_uses(d, b));
    end();
}
END_TEST

START_TEST(test_refusals)
{
    static const char *const bad[][2] = {
        {"a block 2 1 0 1 0 1", "lower bound of x, 2, is above"},
        {"a block 0 1 0 1 0", "too few words"},
        {"a block 0 1 0 1 0 nan", "'nan' is not a finite number"},
        {"a block 0 1 0 1 0 1 2", "unknown keyword '2'"},
        {"a block 0 1 0 1 0 1 side up", "'up' after 'side' must be in|out"},
        {"a block 0 1 0 1 0 1 unit box", "did you mean 'units'?"},
        {"a block 0 1 0 1 0 1 open 3", "'open' is not supported"},
        {"a block 0 1 0 1 0 1 move NULL NULL 0.5", "'0.5' is not v_name"},
        {"a sphere 0 0 0 -1", "'-1' is not a radius of 0 or more"},
        {"a block 0 v_r 0 1 0 1", "can follow a variable"},
        {"a cylinder w 0 0 1 0 1", "'w' is not one of x, y, z"},
        {"a cylinder z 0 0 0 0 1", "'0' is not a radius greater than 0"},
        {"a cylinder z 0 0 1 1 0", "above the upper end"},
        {"a plane 0 0 0 0 0 0", "has no direction"},
        {"a prism 0 1 0 1 0 0 0 0 0", "must be below the upper one"},
        {"a prism INF 1 0 1 0 1 0.5 0 0", "needs bounds of x other than INF"},
        {"a union 2 x y", "there is no region 'x'"},
        {"a union 3 x y", "3 region IDs must follow"},
        {"a union 1 x y", "'1' is not a whole number from 2"},
        {"a cone z 0 0 0 0 1 2", "'0' is not greater than 0, as one of both radii must be"},
        {"a cone z 0 0 -1 1 1 2", "'-1' is not a radius of 0 or more"},
        {"a cone z 0 0 2 1 2 2", "is not below the upper end"},
        {"a blok 0 1 0 1 0 1", "did you mean 'block'?"},
    };
    begin();
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        hs_error err = {0};
        ck_assert_msg(define(bad[k][0], &err) == NULL, "accepted: %s", bad[k][0]);
        ck_assert_int_eq(err.status, HS_ERROR_INPUT);
        ck_assert_msg(strstr(err.text, bad[k][1]) != NULL, "%s: '%s' is not in '%s'", bad[k][0], bad[k][1], err.text);
    }
    box.exists = false;
    hs_error err = {0};
    ck_assert(define("a block INF 1 0 1 0 1", &err) == NULL && strstr(err.text, "once the box exists") != NULL);
    end();
}
END_TEST

HS_TEST_MAIN("unit.region", test_block, test_units, test_shapes, test_combinations, test_refusals)
