/* Harmonic repulsion of spheres (disks) of different size that touch where their surfaces meet:
 *     U(r) = (k/2) (1 - r/s)^2,  F(r)/r = (k/s) (1 - r/s) / r   for r < s,  s = (d_i + d_j)/2
 * with the diameters d of atom_style sphere. harmonic/repulsion is the same with one s for each pair of types.
 * Units: k energy.
 * Source: C. S. O'Hern, L. E. Silbert, A. J. Liu, S. R. Nagel, Phys. Rev. E 68, 011306 (2003),
 * doi:10.1103/PhysRevE.68.011306, eq. (1) with alpha = 2. */
#include "kernel/evaluator.h"

enum { K, HALF_K, N_PARAMS, SUM_OF_RADII = N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(hs_max(r2, hs_set1(HS_TINY_R2)));
    const hs_vec inv_s = hs_set1(1.0) / p[SUM_OF_RADII], overlap = (p[SUM_OF_RADII] - r) * inv_s;
    *force_over_r = p[K] * overlap * inv_s / r;
    if (with_energy) *energy = p[HALF_K] * overlap * overlap;
}

#define HS_EVALUATOR harmonic_sphere
#define HS_EVALUATOR_RADII
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "base/memory.h"
#include "style/pair_coeffs.h"

typedef struct sphere_state {
    hs_pair_coeffs coeffs;
    double *largest; /**< owned [n_types + 1]: largest radius of each type at the latest init, distance */
} sphere_state;

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    sphere_state *state = pair->state;
    (void)args;
    if (state->largest != NULL) return HS_OK;
    HS_TRY(HS_ALLOC(state->largest, (size_t)pair->n_types + 1, err));
    return hs_pair_coeffs_set_cutoff(pair, 0.0, err);
}

static void destroy(hs_pair *pair)
{
    HS_FREE(((sphere_state *)pair->state)->largest);
    hs_pair_coeffs_destroy(pair);
}

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_arg_not_negative(args, 0, &hs_pair_coeffs_at(pair, i, j)->c[0], err);
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    (void)err;
    hs_pair_coeffs_at(pair, i, j)->c[0] =
        sqrt(hs_pair_coeffs_at(pair, i, i)->c[0] * hs_pair_coeffs_at(pair, j, j)->c[0]);
    return HS_OK;
}

static hs_status init(hs_pair *pair, hs_error *err)
{
    sphere_state *state = pair->state;
    const hs_atoms *atoms = pair->env->atoms;
    if (atoms->radius == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "run: pair_style harmonic/sphere needs atoms with diameters: 'atom_style sphere' before the "
                       "box; for one size per type there is harmonic/repulsion");
    /* the place of type 0, which no atom has, is for the ID of an atom without a size */
    for (int type = 0; type <= pair->n_types; ++type) state->largest[type] = 0.0;
    for (int i = 0; i < atoms->n_local; ++i) {
        const int type = atoms->type[i];
        state->largest[type] = fmax(state->largest[type], atoms->radius[i]);
        if (atoms->radius[i] == 0.0 && hs_pair_coeffs_at(pair, type, type)->c[0] > 0.0)
            state->largest[0] = fmax(state->largest[0], (double)atoms->id[i]);
    }
    hs_parallel_max_double(pair->env->parallel, state->largest, pair->n_types + 1);
    if (state->largest[0] == 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "run: pair_style harmonic/sphere: atom %.0f has the diameter 0 and would touch no other of its "
                   "size; 'set ... diameter' gives it one, and a coefficient of 0 leaves its type out",
                   state->largest[0]);
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const double *largest = ((sphere_state *)pair->state)->largest;
    const double sum = largest[i] + largest[j];
    /* the next larger number: no pair in contact may be lost to the rounding of the square */
    *cutoff = sum > 0.0 ? nextafter(sum, INFINITY) : 0.0;
    p[K] = hs_pair_coeffs_at(pair, i, j)->c[0];
    p[HALF_K] = 0.5 * p[K];
}

const hs_pair_style hs_pair_style_harmonic_sphere = {
    .about = {.name = "harmonic/sphere",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "harmonic repulsion of spheres that touch at the mean of their diameters",
              .details = "U(r) = (k/2) (1 - r/s)^2 for r < s, 0 beyond, where s = (d_i + d_j)/2 is the mean of the two "
                         "atoms' diameters: polydisperse grains, foams and emulsions without friction.\n\n"
                         "`pair_coeff I J <k>`: k (energy, above or at zero). The diameters are those of `atom_style "
                         "sphere`, which `set ... diameter` or a data file give. The largest diameters at the "
                         "beginning of a run make the cutoff. Unlike pairs are mixed by the geometric mean of k. Where "
                         "all atoms of a type have one size, harmonic/repulsion does the same and needs no diameters.",
              .reference = "C. S. O'Hern, L. E. Silbert, A. J. Liu, S. R. Nagel, Phys. Rev. E 68, 011306 (2003), "
                           "doi:10.1103/PhysRevE.68.011306",
              .example = "atom_style sphere\npair_style harmonic/sphere\npair_coeff * * 1000.0"},
    .coeff_syntax = {.usage = "<k>", .n_min = 1, .n_max = 1},
    .adaptable = (const hs_pair_adaptable[]){{"k", 0}, {NULL, 0}},
    .state_size = sizeof(sphere_state),
    .settings = settings,
    .destroy = destroy,
    .coeff = coeff,
    .mix = mix,
    .init = init,
    .params = params,
    .write_coeff = hs_pair_coeffs_write_bare,
    .evaluator = &hs_evaluator_harmonic_sphere,
};

#endif
