/* Bond-orientational order of each atom:  q_n = (1/N) sum over its neighbors exp(i n theta).
 * Source: D. R. Nelson, B. I. Halperin, Phys. Rev. B 19, 2457 (1979), doi:10.1103/PhysRevB.19.2457. */
#include <math.h>
#include <string.h>

#include "style/nearest.h"

typedef struct hexorder_state {
    int64_t degree;
    int n_nearest; /**< neighbors that count; 0: all within the cutoff */
    double cutoff; /**< 0: that of the pair style */
} hexorder_state;

static const hs_keyword keywords[] = {
    {"degree", 1, "<n>", "of the symmetry: 6 for hexagons (default: 6)"},
    {"nnn", 1, "<N>|NULL", "nearest neighbors that count; NULL: all within the cutoff (default: 6)"},
    {"cutoff", 1, "<distance>", "where neighbors are looked for (default: the cutoff of the pair style)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    hexorder_state *state = compute->state;
    int64_t n_nearest = 6;
    state->degree = 6;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    for (int i = 0; i + 1 < args->n; i += 2) {
        if (strcmp(args->word[i], "degree") == 0)
            HS_TRY(hs_arg_int(args, i + 1, 1, 1000, &state->degree, err));
        else if (strcmp(args->word[i], "cutoff") == 0)
            HS_TRY(hs_arg_positive(args, i + 1, &state->cutoff, err));
        else if (strcmp(args->word[i + 1], "NULL") == 0)
            n_nearest = 0;
        else
            HS_TRY(hs_arg_int(args, i + 1, 1, 1000, &n_nearest, err));
    }
    state->n_nearest = (int)n_nearest;
    compute->n_atom_columns = 2;
    return HS_OK;
}

/** q_n of one atom from its sorted neighbors. */
static void find_order(const hexorder_state *state, const hs_near *item, int n, double q[2])
{
    q[0] = q[1] = 0.0;
    if (n == 0 || n < state->n_nearest) return;
    for (int k = 0; k < n; ++k) {
        const double angle = (double)state->degree * atan2(-item[k].d[1], -item[k].d[0]);
        q[0] += cos(angle) / n;
        q[1] += sin(angle) / n;
    }
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const hexorder_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const size_t n_local = (size_t)atoms->n_local;
    hs_nearest nearest = {0};
    double range;
    HS_TRY(hs_nearest_range(compute, state->cutoff, &range, err));
    const hs_status status = hs_nearest_find(&nearest, compute->env, range, state->n_nearest, err);
    if (status == HS_OK) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n_local; ++i) {
            double q[2] = {0.0, 0.0};
            int n;
            const hs_near *near = hs_nearest_of(&nearest, (int)i, state->n_nearest, &n);
            if (atoms->mask[i] & compute->mask) find_order(state, near, n, q);
            for (size_t column = 0; column < 2; ++column) compute->atoms[column * n_local + i] = q[column];
        }
    }
    hs_nearest_fini(&nearest);
    return status;
}

const hs_compute_style hs_compute_style_hexorder_atom = {
    .about = {.name = "hexorder/atom",
              .syntax = {.usage = "[keyword value ...]", .n_min = 0, .n_max = 0, .keywords = keywords},
              .summary = "bond-orientational order parameter of each atom",
              .details =
                  "q_n = (1/N) sum exp(i n theta) over the N nearest neighbors, theta being the angle of the bond with "
                  "the x axis in the xy plane; n is the degree. `c_ID[1]` is its real part, `c_ID[2]` its imaginary "
                  "part: |q_6| is 1 in a perfect hexagonal lattice. Neighbors are all atoms, of any group. An atom "
                  "with fewer than N neighbors within the cutoff, or outside of the compute's group, has 0.",
              .reference = "D. R. Nelson, B. I. Halperin, Phys. Rev. B 19, 2457 (1979), doi:10.1103/PhysRevB.19.2457",
              .example = "compute q all hexorder/atom degree 6 nnn 6 cutoff 2.0\n"
                         "variable psi atom sqrt(c_q[1]^2+c_q[2]^2)"},
    .state_size = sizeof(hexorder_state),
    .create = create,
    .per_atom = per_atom,
};
