/* How far the surroundings of each atom are from being the same on opposite sides.
 * Source: C. L. Kelchner, S. J. Plimpton, J. C. Hamilton, Phys. Rev. B 58, 11085 (1998),
 * doi:10.1103/PhysRevB.58.11085. */
#include <stdlib.h>
#include <string.h>

#include "style/nearest.h"
#include "style/pair_scan.h"

enum { N_MAX = 200 }; /* neighbors that count: N^2/2 pairs of them are compared for each atom */

typedef struct centro_state {
    int n_nearest;
} centro_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    centro_state *state = compute->state;
    int64_t n;
    state->n_nearest = strcmp(args->word[0], "fcc") == 0 ? 12 : strcmp(args->word[0], "bcc") == 0 ? 8 : 0;
    if (state->n_nearest > 0) return HS_OK;
    if (strspn(args->word[0], "0123456789") != strlen(args->word[0]) || strtol(args->word[0], NULL, 10) % 2 != 0)
        return hs_arg_refuse(args, 0, "fcc (12), bcc (8), or an even number of neighbors", NULL, err);
    HS_TRY(hs_arg_int(args, 0, 2, N_MAX, &n, err));
    state->n_nearest = (int)n;
    return HS_OK;
}

static hs_status find_range(const hs_compute *compute, double *range, hs_error *err)
{
    hs_pair_view view;
    compute->env->view_pairs(compute->env, &view);
    *range = view.cutoff_max;
    if (*range > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: neighbors are looked for within the cutoff of the pair style, and there is none before the "
                   "first run or without forces",
                   hs_compute_who(compute).text);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    double range;
    return find_range(compute, &range, err);
}

/** Sum of the n/2 least |d_i + d_j|^2 over all pairs of n neighbors, added in ascending order. */
static double asymmetry(const hs_near *near, int n)
{
    double least[N_MAX / 2], sum = 0.0; /* ascending */
    int n_least = 0;
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j) {
            const double x = near[i].d[0] + near[j].d[0], y = near[i].d[1] + near[j].d[1],
                         z = near[i].d[2] + near[j].d[2], size = x * x + y * y + z * z;
            int at = n_least;
            if (n_least < n / 2)
                ++n_least;
            else if (!(size < least[--at]))
                continue;
            for (; at > 0 && size < least[at - 1]; --at) least[at] = least[at - 1];
            least[at] = size;
        }
    for (int k = 0; k < n_least; ++k) sum += least[k];
    return sum;
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const int n_wanted = ((centro_state *)compute->state)->n_nearest;
    const hs_atoms *atoms = compute->env->atoms;
    hs_nearest nearest = {0};
    double range;
    HS_TRY(find_range(compute, &range, err));
    const hs_status status = hs_nearest_find(&nearest, compute->env, range, n_wanted, err);
    if (status == HS_OK) {
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i) {
            int n;
            const hs_near *near = hs_nearest_of(&nearest, i, n_wanted, &n);
            compute->atoms[i] = atoms->mask[i] & compute->mask && n == n_wanted ? asymmetry(near, n) : 0.0;
        }
    }
    hs_nearest_fini(&nearest);
    return status;
}

const hs_compute_style hs_compute_style_centro_atom = {
    .about = {.name = "centro/atom",
              .syntax = {.usage = "fcc|bcc|<N>", .n_min = 1, .n_max = 1},
              .summary = "deviation from central symmetry of each atom",
              .details =
                  "The value per atom is the sum of the N/2 least |r_i + r_j|^2 (distance^2) over all pairs of its N "
                  "nearest neighbors, r being the vectors to them: 0 in a perfect lattice, small where it is strained "
                  "or warm, large at dislocations, stacking faults and surfaces. N is even; `fcc` stands for 12, `bcc` "
                  "for 8, and 6 is right for a hexagonal plane. Neighbors are looked for within the pair style's "
                  "cutoff, and need not belong to the group; an atom that has fewer than N there has 0.",
              .reference = "C. L. Kelchner, S. J. Plimpton, J. C. Hamilton, Phys. Rev. B 58, 11085 (1998), "
                           "doi:10.1103/PhysRevB.58.11085",
              .example = "compute csym all centro/atom fcc\ndump d all custom 1000 flaws.txt id x y z c_csym"},
    .state_size = sizeof(centro_state),
    .create = create,
    .init = init,
    .per_atom = per_atom,
};
