/* The halo of one rank: every copy is its source's place and a box length away, whatever the number of threads, with
 * more threads than atoms, and after a sort; what the copies have is added to their sources, each once. */
#include <stdio.h>
#include <string.h>

#include "comm/halo_plan.h"
#include "parallel/parallel.h"
#include "support/harness.h"

enum { N_MAX = 300 };

typedef struct halo_system {
    hs_box box;
    hs_parallel parallel;
    hs_domain domain;
    hs_atoms atoms;
    hs_halo halo;
} halo_system_t;

static hs_error err;

/** A number in [0, 1) for atom i and axis, some of them alike. */
static double place_of(int i, int axis) { return (double)((i * (37 + 8 * axis) + 11 * axis) % 101) / 101.0; }

static void begin(halo_system_t *s, int n)
{
    memset(s, 0, sizeof *s);
    memset(&err, 0, sizeof err);
    hs_box_init(&s->box);
    s->parallel.n_ranks = 1;
    for (int axis = 0; axis < 3; ++axis) {
        s->box.lo[axis] = -1.0;
        s->box.hi[axis] = 7.0 + axis;
        s->box.periodic[axis] = axis != 2;
    }
    ck_assert_hs_ok(hs_atoms_init(&s->atoms, &err), err);
    ck_assert_hs_ok(hs_atoms_set_types(&s->atoms, 1, &err), err);
    for (int i = 0; i < n; ++i) {
        double x[3];
        for (int axis = 0; axis < 3; ++axis)
            x[axis] = s->box.lo[axis] + hs_box_length(&s->box, axis) * place_of(i, axis);
        ck_assert_hs_ok(hs_atoms_add(&s->atoms, i + 1, 1, x, &err), err);
    }
    s->atoms.n_all = n;
    hs_domain_init(&s->domain, &s->parallel);
    ck_assert_hs_ok(hs_domain_divide(&s->domain, &s->box, &err), err);
    ck_assert_hs_ok(hs_halo_build(&s->halo, &s->domain, &s->parallel, &s->box, &s->atoms, 2.5, &err), err);
}

static void end(halo_system_t *s)
{
    hs_halo_fini(&s->halo);
    hs_domain_fini(&s->domain);
    hs_atoms_fini(&s->atoms);
}

/** Move the atoms, and see the copies follow. */
static void check_forward(halo_system_t *s, const char *what)
{
    hs_atoms *atoms = &s->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < atoms->n_local; ++i) atoms->x[axis][i] += 0.25;
        for (int q = 0; q < s->halo.n; ++q) atoms->x[axis][atoms->n_local + q] = 1e30;
    }
    hs_halo_forward(&s->halo, atoms);
    for (int b = 0; b < s->halo.out.n_blocks; ++b) {
        const hs_halo_block *block = &s->halo.out.block[b];
        for (int k = block->begin; k < block->end; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                const double x = atoms->x[axis][s->halo.source[k]] + block->shift[axis];
                ck_assert_msg(atoms->x[axis][atoms->n_local + s->halo.slot[k]] == x, "%s: copy %d is at %g, not %g",
                              what, k, atoms->x[axis][atoms->n_local + s->halo.slot[k]], x);
            }
    }
}

/** Forces 1 of an atom and 2^-k of its copy in block k add up to a number that tells which copies were added. */
static void check_reverse(halo_system_t *s, const char *what)
{
    hs_atoms *atoms = &s->atoms;
    double wanted[N_MAX];
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < atoms->n_local; ++i) atoms->f[axis][i] = wanted[i] = 1.0;
        for (int b = 0; b < s->halo.out.n_blocks; ++b)
            for (int k = s->halo.out.block[b].begin; k < s->halo.out.block[b].end; ++k) {
                atoms->f[axis][atoms->n_local + s->halo.slot[k]] = 1.0 / (double)(UINT64_C(2) << b);
                wanted[s->halo.source[k]] += 1.0 / (double)(UINT64_C(2) << b);
            }
    }
    hs_halo_reverse(&s->halo, atoms, false);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < atoms->n_local; ++i)
            ck_assert_msg(atoms->f[axis][i] == wanted[i], "%s: force %g on atom %d, not %g", what, atoms->f[axis][i], i,
                          wanted[i]);
}

/** Sort the atoms the other way round: sources no longer ascend in their blocks. */
static void turn_round(halo_system_t *s)
{
    const int n = s->atoms.n_local;
    int32_t order[N_MAX], place[N_MAX];
    for (int i = 0; i < n; ++i) order[i] = place[i] = n - 1 - i;
    ck_assert_hs_ok(hs_atoms_permute(&s->atoms, order, &err), err);
    hs_halo_follow(&s->halo, &s->atoms, place);
}

START_TEST(copies_follow_and_give_back)
{
    static const int sizes[] = {0, 1, 2, 5, 64, N_MAX};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; ++k)
        for (int n_threads = 1; n_threads <= 7; ++n_threads)
            for (int is_turned = 0; is_turned < 2; ++is_turned) {
                halo_system_t s;
                char what[80];
                hs_threads_set(n_threads);
                begin(&s, sizes[k]);
                if (is_turned) turn_round(&s);
                snprintf(what, sizeof what, "%d atoms, %d threads%s", sizes[k], n_threads, is_turned ? ", sorted" : "");
                if (sizes[k] == N_MAX) ck_assert_int_gt(s.halo.n, N_MAX / 4);
                check_forward(&s, what);
                check_reverse(&s, what);
                end(&s);
            }
}
END_TEST

/** A brick at the upper face of a box that is not periodic has neighbors below only: nearly all its offsets are positive. The blocks of a
 *  longer reach take the place of those of a shorter one. */
START_TEST(blocks_of_a_longer_reach_have_room)
{
    static const double reach[] = {1.0, 2.0, 3.0, 9.0, 21.0, 40.0};
    const hs_parallel ranks = {.n_ranks = 8};
    hs_halo halo = {0};
    hs_domain domain;
    hs_box box;
    memset(&err, 0, sizeof err);
    hs_box_init(&box);
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] = 20.0;
    box.periodic[0] = false;
    hs_domain_init(&domain, &ranks);
    domain.wanted[0] = 8;
    ck_assert_hs_ok(hs_domain_divide(&domain, &box, &err), err);
    for (int at = 0; at < 8; ++at)
        for (size_t k = 0; k < sizeof reach / sizeof reach[0]; ++k) {
            hs_halo_plan plan;
            domain.at[0] = domain.rank = at;
            ck_assert_hs_ok(hs_halo_plan_make(&plan, &halo, &domain, &box, reach[k], &err), err);
            ck_assert_uint_le((size_t)halo.out.n_blocks, halo.out.capacity_blocks);
            ck_assert_uint_le((size_t)halo.in.n_blocks, halo.in.capacity_blocks);
            hs_halo_plan_fini(&plan);
        }
    hs_halo_fini(&halo);
    hs_domain_fini(&domain);
}
END_TEST

HS_TEST_MAIN("halo", copies_follow_and_give_back, blocks_of_a_longer_reach_have_room)
