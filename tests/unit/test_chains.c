/* Grid, stencil and chains of the textbook methods against counting by hand. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "neighbor/chains.h"
#include "support/harness.h"

static hs_error err;

static double next_uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

static hs_grid_plan plan_of(int dimension, double length, double reach, double edge)
{
    return (hs_grid_plan){
        .dimension = dimension, .hi = {length, length, length}, .reach = reach, .edge = edge, .is_cube = false};
}

/** Cells as wide as the cutoff: 13 neighbors in 3D, 4 in 2D, as every textbook says; half as wide: 62, the
 *  whole cube, of which a sphere reaches all (the corner's gap is sqrt(3)/2 of the cutoff); a third as wide: 171 in the
 *  cube, less the half of the 32 at offsets (3 3 3) and (3 3 2), whose gaps are sqrt(12)/3 and exactly 1. */
START_TEST(stencils)
{
    static const struct {
        int dimension;
        double edge;
        bool is_cube;
        int n;
    } cases[] = {{3, 1.0, false, 13}, {2, 1.0, false, 4},  {3, 0.5, true, 62},        {3, 0.5, false, 62},
                 {2, 0.5, false, 12}, {3, 1.5, false, 13}, {3, 1.0 / 3.0, true, 171}, {3, 1.0 / 3.0, false, 155}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        hs_grid grid = {0};
        hs_grid_plan plan = plan_of(cases[k].dimension, 20.0 + 1e-6, 1.0, cases[k].edge);
        plan.is_cube = cases[k].is_cube;
        ck_assert_hs_ok(hs_grid_set(&grid, &plan, NULL, &err), err);
        ck_assert_msg(grid.n_stencil == cases[k].n, "case %zu: %d cells, not %d", k, grid.n_stencil, cases[k].n);
        hs_grid_fini(&grid);
    }
}
END_TEST

/** No pair within reach is in cells that the stencil does not join, for cells of any size. */
START_TEST(stencil_joins_all_pairs)
{
    static const double edges[] = {0.05, 0.21, 0.5, 0.77, 1.0, 1.31, 4.0};
    uint64_t state = 3;
    for (size_t k = 0; k < sizeof edges / sizeof edges[0]; ++k) {
        hs_grid grid = {0};
        const hs_grid_plan plan = plan_of(3, 5.0, 1.0, edges[k]);
        ck_assert_hs_ok(hs_grid_set(&grid, &plan, NULL, &err), err);
        for (int trial = 0; trial < 300; ++trial) {
            double x[2][3], norm = 0.0;
            int c[2][3], d[3], sign = 0;
            for (int a = 0; a < 3; ++a) {
                x[0][a] = 7.0 * next_uniform(&state) - 1.0; /* some beyond the region */
                x[1][a] = 2.0 * next_uniform(&state) - 1.0;
                norm += x[1][a] * x[1][a];
            }
            for (int a = 0; a < 3; ++a) {
                x[1][a] = x[0][a] + x[1][a] / sqrt(norm) * 0.999999999;
                for (int p = 0; p < 2; ++p) c[p][a] = hs_grid_coordinate(&grid, a, x[p][a]);
                d[a] = c[1][a] - c[0][a];
                if (sign == 0) sign = d[a] > 0 ? 1 : d[a] < 0 ? -1 : 0;
            }
            bool is_found = sign == 0;
            for (int s = 0; s < grid.n_stencil && !is_found; ++s)
                is_found = d[0] == sign * grid.stencil[s][0] && d[1] == sign * grid.stencil[s][1] &&
                           d[2] == sign * grid.stencil[s][2];
            ck_assert_msg(is_found, "edge %g: offset %d %d %d is not in the stencil", edges[k], d[0], d[1], d[2]);
        }
        hs_grid_fini(&grid);
    }
}
END_TEST

enum { N_LOCAL = 300, N_HALO = 40 };

static void place_atoms(hs_atoms *atoms, int n_halo, double length, double step, uint64_t *state)
{
    ck_assert_hs_ok(hs_atoms_reserve(atoms, atoms->n_local, n_halo, &err), err);
    atoms->n_halo = n_halo;
    for (int i = 0; i < atoms->n_local + n_halo; ++i)
        for (int a = 0; a < 3; ++a)
            atoms->x[a][i] = step > 0.0 ? atoms->x[a][i] + step * (next_uniform(state) - 0.5)
                                        : length * (1.2 * next_uniform(state) - 0.1);
}

/** Every atom is in the chain of its own cell and in no other. */
static void check_chains(const hs_chains *chains, const hs_atoms *atoms, const char *what)
{
    const int n = atoms->n_local + atoms->n_halo;
    int n_seen = 0, *seen = calloc((size_t)n, sizeof *seen);
    for (int64_t cell = 0; cell < chains->n_cells; ++cell) {
        int at[3];
        hs_chains_coordinates(chains, cell, at);
        ck_assert_int_eq(hs_chains_first(chains, at), chains->head[cell]);
        for (int32_t i = chains->head[cell]; i != HS_CHAIN_END; i = chains->next[i]) {
            int c[3];
            ck_assert_msg(i >= 0 && i < n && n_seen < n, "%s: a chain leads to atom %d of %d", what, i, n);
            hs_chains_locate(chains, atoms, i, c);
            ck_assert_msg(memcmp(c, at, sizeof c) == 0, "%s: atom %d is in a wrong cell", what, i);
            ++n_seen;
            ++seen[i];
        }
    }
    for (int i = 0; i < n; ++i) ck_assert_msg(seen[i] == 1, "%s: atom %d occurs %d times", what, i, seen[i]);
    free(seen);
}

START_TEST(chains_hold_all_atoms)
{
    hs_atoms atoms;
    hs_chains linked = {0}, incremental = {0}, hash = {0};
    uint64_t state = 77;
    ck_assert_hs_ok(hs_atoms_init(&atoms, &err), err);
    ck_assert_hs_ok(hs_atoms_set_types(&atoms, 1, &err), err);
    for (int i = 0; i < N_LOCAL; ++i)
        ck_assert_hs_ok(hs_atoms_add(&atoms, i + 1, 1, (const double[3]){0.0, 0.0, 0.0}, &err), err);
    place_atoms(&atoms, N_HALO, 6.0, 0.0, &state);
    for (int round = 0; round < 60; ++round) {
        const bool has_new_halo = round % 5 == 0;
        const hs_grid_plan plan = plan_of(round < 40 ? 3 : 2, round < 20 ? 6.0 : 6.5, 1.0, round < 30 ? 0.7 : 1.1);
        hs_chains *const all[3] = {&linked, &incremental, &hash};
        for (int k = 0; k < 3; ++k)
            ck_assert_hs_ok(hs_chains_set_grid(all[k], &plan, (hs_cell_order)(round / 7 % HS_N_CELL_ORDERS), &err),
                            err);
        place_atoms(&atoms, has_new_halo ? N_HALO + 7 * round : atoms.n_halo, 6.0, round % 11 == 0 ? 0.0 : 0.2, &state);
        if (round % 17 == 16) ++atoms.generation; /* as if they had been sorted */
        ck_assert_hs_ok(hs_linked_build(&linked, &atoms, &err), err);
        ck_assert_hs_ok(hs_incremental_update(&incremental, &atoms, has_new_halo, &err), err);
        ck_assert_hs_ok(hs_hash_build(&hash, &atoms, &err), err);
        check_chains(&linked, &atoms, "linked");
        check_chains(&incremental, &atoms, "incremental");
        check_chains(&hash, &atoms, "hash");
    }
    /* a step of 0.1 on average along each axis, cells of about 1: some leave, most stay */
    ck_assert_int_gt((int)incremental.n_changed, 0);
    ck_assert_int_lt((int)incremental.n_changed, (int)(incremental.n_checked / 3));
    /* one kind after another in the same chains */
    ck_assert_hs_ok(hs_hash_build(&incremental, &atoms, &err), err);
    check_chains(&incremental, &atoms, "hash after incremental");
    ck_assert_hs_ok(hs_linked_build(&incremental, &atoms, &err), err);
    check_chains(&incremental, &atoms, "linked after hash");
    ck_assert_hs_ok(hs_incremental_update(&incremental, &atoms, false, &err), err);
    check_chains(&incremental, &atoms, "incremental after linked");
    hs_chains_fini(&linked);
    hs_chains_fini(&incremental);
    hs_chains_fini(&hash);
    hs_atoms_fini(&atoms);
}
END_TEST

/** The same atoms in a box of 10^15 times the volume: the same arrays. An array of all cells would not fit, and says
 *  so. */
START_TEST(hash_goes_by_atoms)
{
    hs_atoms atoms;
    hs_chains chains[2] = {{.n_cells = 0}}, linked = {0};
    uint64_t state = 5;
    ck_assert_hs_ok(hs_atoms_init(&atoms, &err), err);
    ck_assert_hs_ok(hs_atoms_set_types(&atoms, 1, &err), err);
    for (int i = 0; i < N_LOCAL; ++i)
        ck_assert_hs_ok(hs_atoms_add(&atoms, i + 1, 1, (const double[3]){0.0, 0.0, 0.0}, &err), err);
    place_atoms(&atoms, 0, 6.0, 0.0, &state);
    for (int k = 0; k < 2; ++k) {
        const hs_grid_plan plan = plan_of(3, k == 0 ? 6.0 : 6e5, 1.0, 1.0);
        ck_assert_hs_ok(hs_chains_set_grid(&chains[k], &plan, HS_CELL_ORDER_MORTON, &err), err);
        ck_assert_hs_ok(hs_hash_build(&chains[k], &atoms, &err), err);
        check_chains(&chains[k], &atoms, "hash");
    }
    ck_assert_int_eq(chains[0].capacity_cells, chains[1].capacity_cells);
    ck_assert_int_eq(chains[0].table.capacity_slots, chains[1].table.capacity_slots);
    ck_assert_int_eq(chains[0].capacity_atoms, chains[1].capacity_atoms);
    const hs_grid_plan plan = plan_of(3, 6e5, 1.0, 1.0);
    ck_assert_hs_ok(hs_chains_set_grid(&linked, &plan, HS_CELL_ORDER_MORTON, &err), err);
    ck_assert_int_eq(hs_linked_build(&linked, &atoms, &err), HS_ERROR_RUN);
    ck_assert_ptr_nonnull(strstr(err.text, "use 'neighbor_method hash'"));
    hs_error_clear(&err);
    for (int k = 0; k < 2; ++k) hs_chains_fini(&chains[k]);
    hs_chains_fini(&linked);
    hs_atoms_fini(&atoms);
}
END_TEST

/** Sorted atoms have ascending keys, equal ones ascending ids. */
START_TEST(sorting_follows_the_order)
{
    hs_atoms atoms;
    hs_chains chains = {0};
    int32_t order[N_LOCAL];
    uint64_t state = 9;
    ck_assert_hs_ok(hs_atoms_init(&atoms, &err), err);
    ck_assert_hs_ok(hs_atoms_set_types(&atoms, 1, &err), err);
    for (int i = 0; i < N_LOCAL; ++i)
        ck_assert_hs_ok(hs_atoms_add(&atoms, N_LOCAL - i, 1, (const double[3]){0.0, 0.0, 0.0}, &err), err);
    place_atoms(&atoms, 0, 6.0, 0.0, &state);
    for (int k = 0; k < 2; ++k) {
        const hs_grid_plan plan = plan_of(3, 6.0, 1.0, 1.0);
        ck_assert_hs_ok(hs_chains_set_grid(&chains, &plan, (hs_cell_order)k, &err), err);
        ck_assert_hs_ok(hs_chains_sort(&chains, &atoms, order, &err), err);
        uint64_t before = 0;
        for (int i = 0; i < N_LOCAL; ++i) {
            int c[3];
            hs_chains_locate(&chains, &atoms, order[i], c);
            const uint64_t key = hs_grid_key(&chains.grid, (hs_cell_order)k, c);
            ck_assert(key >= before);
            if (i > 0 && key == before) ck_assert_int_gt((int)atoms.id[order[i]], (int)atoms.id[order[i - 1]]);
            before = key;
        }
    }
    hs_chains_fini(&chains);
    hs_atoms_fini(&atoms);
}
END_TEST

HS_TEST_MAIN("chains", stencils, stencil_joins_all_pairs, chains_hold_all_atoms, hash_goes_by_atoms,
             sorting_follows_the_order)
