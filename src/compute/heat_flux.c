/* Heat current of a group:  J V = sum(e_i v_i) - sum(S_i v_i),  e_i energy and S_i virial stress (times volume) of atom
 * i.
 * Source: J. H. Irving, J. G. Kirkwood, J. Chem. Phys. 18, 817 (1950), doi:10.1063/1.1747782. */
#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/compute.h"

enum { KE, PE, STRESS, N_INPUTS };
static const char *const styles[N_INPUTS] = {"ke/atom", "pe/atom", "stress/atom"};

typedef struct flux_state {
    char *id[N_INPUTS];          /**< owned */
    hs_compute *input[N_INPUTS]; /**< borrowed; found anew before each use */
} flux_state;

static hs_status find_inputs(const hs_compute *compute, hs_error *err)
{
    flux_state *state = compute->state;
    for (int k = 0; k < N_INPUTS; ++k) {
        state->input[k] = compute->env->find_compute(compute->env, state->id[k]);
        if (state->input[k] == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "%s: there is no compute '%s'", hs_compute_who(compute).text,
                           state->id[k]);
        if (!state->input[k]->has_atoms || state->input[k]->n_atom_columns != (k == STRESS ? 6 : 0))
            return hs_fail(err, HS_ERROR_INPUT, "%s: %s should be one like %s, with %s", hs_compute_who(compute).text,
                           hs_compute_who(state->input[k]).text, styles[k],
                           k == STRESS ? "six values for each atom" : "one value for each atom");
    }
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    flux_state *state = compute->state;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    for (int k = 0; k < N_INPUTS; ++k) HS_TRY(hs_memory_strdup(&state->id[k], args->word[k], err));
    HS_TRY(find_inputs(compute, err));
    compute->n_vector = 6;
    compute->may_need_energy = true;
    return HS_ALLOC(compute->vector, 6, err);
}

static void destroy(hs_compute *compute)
{
    flux_state *state = compute->state;
    for (int k = 0; k < N_INPUTS; ++k) HS_FREE(state->id[k]);
    HS_FREE(compute->vector);
}

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    /* places of S_ab in the order xx yy zz xy xz yz */
    static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    const hs_compute *compute = context;
    const flux_state *state = compute->state;
    const size_t n = (size_t)atoms->n_local;
    const double *ke = state->input[KE]->atoms, *pe = state->input[PE]->atoms, *stress = state->input[STRESS]->atoms;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & compute->mask)) continue;
        for (int a = 0; a < 3; ++a) {
            double virial = 0.0;
            for (int b = 0; b < 3; ++b) virial += stress[(size_t)place[a][b] * n + (size_t)i] * atoms->v[b][i];
            hs_exact_add(&sums[a], (ke[i] + pe[i]) * atoms->v[a][i]);
            hs_exact_add(&sums[3 + a], -virial);
        }
    }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    const flux_state *state = compute->state;
    const hs_env *env = compute->env;
    double sums[6];
    HS_TRY(find_inputs(compute, err));
    for (int k = 0; k < N_INPUTS; ++k) HS_TRY(hs_compute_eval_atoms(state->input[k], err));
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 6, sums);
    for (int a = 0; a < 3; ++a) {
        compute->vector[a] = sums[a] + sums[3 + a] / env->units->nktv2p;
        compute->vector[3 + a] = sums[a];
    }
    return HS_OK;
}

static hs_status init(hs_compute *compute, hs_error *err) { return find_inputs(compute, err); }

const hs_compute_style hs_compute_style_heat_flux = {
    .about = {.name = "heat/flux",
              .syntax = {.usage = "<ke-ID> <pe-ID> <stress-ID>", .n_min = 3, .n_max = 3},
              .summary = "heat current, for thermal conductivity by the Green-Kubo formula",
              .details = "From a compute ke/atom, a compute pe/atom and a compute stress/atom (which should be without "
                         "its kinetic part: `stress/atom NULL virial`) of the group the vector `c_ID` has the heat "
                         "current times volume, energy velocity: `c_ID[1]` to `c_ID[3]` all of it, `c_ID[4]` to "
                         "`c_ID[6]` the part that moving atoms carry. The current is that divided by the volume; the "
                         "conductivity is V/(k T^2) times the integral of its correlation (fix ave/correlate).",
              .reference = "J. H. Irving, J. G. Kirkwood, J. Chem. Phys. 18, 817 (1950), doi:10.1063/1.1747782",
              .example = "compute ke all ke/atom\ncompute pe all pe/atom\ncompute s all stress/atom NULL virial\n"
                         "compute j all heat/flux ke pe s\nvariable jx equal c_j[1]/vol"},
    .state_size = sizeof(flux_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .vector = vector,
    .is_vector_extensive = true,
};
