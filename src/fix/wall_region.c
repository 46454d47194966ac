/* The surface of a region as a wall with a potential of the distance to it. */
#include <string.h>

#include "fix/wall_energy.h"
#include "style/atom_sum.h"
#include "style/fix.h"
#include "style/places.h"
#include "style/region.h"

typedef struct region_wall_state {
    hs_where where;
    wall_energy energy_at;
    double epsilon, sigma, cutoff; /**< energy, distance */
} region_wall_state;

static const char *const names[] = {"lj93", "lj126", "lj1043", "harmonic", NULL};
static const wall_energy energies[] = {wall_lj93, wall_lj126, wall_lj1043, wall_harmonic};

static hs_status find_region(hs_fix *fix, hs_error *err)
{
    region_wall_state *state = fix->state;
    HS_TRY(hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err));
    if (state->where.region->style->surfaces != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: region '%s' (%s) cannot be a wall; block, cylinder, plane and sphere can",
                   hs_fix_who(fix).text, state->where.id, state->where.region->style->about.name);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    region_wall_state *state = fix->state;
    int which;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_where_set(&state->where, args->word[0], err));
    HS_TRY(find_region(fix, err));
    HS_TRY(hs_arg_choice(args, 1, names, &which, err));
    state->energy_at = energies[which];
    HS_TRY(hs_arg_not_negative(args, 2, &state->epsilon, err));
    HS_TRY(hs_arg_positive(args, 3, &state->sigma, err));
    return hs_arg_positive(args, 4, &state->cutoff, err);
}

static void destroy(hs_fix *fix) { hs_where_fini(&((region_wall_state *)fix->state)->where); }

static hs_status init(hs_fix *fix, hs_error *err) { return find_region(fix, err); }

/** Force, energy and virial of the surfaces within reach of an atom; the lever is the distance from the surface. */
typedef struct touch {
    double f[3], energy, virial[6];
} touch;

/** Add up the surfaces within reach of atom i; false when it is not inside of the region. */
static bool add_surfaces(const hs_fix *fix, const hs_places *places, int i, touch *sum)
{
    const region_wall_state *state = fix->state;
    const double x[3] = {places->x[0][i], places->x[1][i], places->x[2][i]};
    hs_contact contact[HS_CONTACTS_MAX];
    memset(sum, 0, sizeof *sum);
    if (!hs_region_contains(state->where.region, x)) return false;
    const int n = hs_region_surfaces(state->where.region, x, state->cutoff, contact);
    for (int k = 0; k < n; ++k) {
        double force, f[3], lever[3];
        if (!(contact[k].r > 0.0)) return false;
        sum->energy += state->energy_at(state->epsilon, state->sigma, state->cutoff, contact[k].r, &force);
        for (int axis = 0; axis < 3; ++axis) {
            f[axis] = force * contact[k].away[axis];
            lever[axis] = contact[k].r * contact[k].away[axis];
            sum->f[axis] += f[axis];
        }
        hs_fix_add_virial(lever, f, sum->virial);
    }
    return true;
}

static void virial_of(const hs_fix *fix, int i, double w[6])
{
    const hs_places now = hs_places_now(fix->env);
    touch sum;
    (void)add_surfaces(fix, &now, i, &sum);
    for (int k = 0; k < 6; ++k) w[k] += sum.virial[k];
}

static hs_status report_outside(const hs_fix *fix, hs_error *err)
{
    const hs_atoms *atoms = fix->env->atoms;
    const hs_places now = hs_places_now(fix->env);
    int first = -1;
    for (int i = 0; i < atoms->n_local; ++i) {
        touch sum;
        if (atoms->mask[i] & fix->mask && !add_surfaces(fix, &now, i, &sum) &&
            (first < 0 || atoms->id[i] < atoms->id[first]))
            first = i;
    }
    return hs_fail(err, HS_ERROR_RUN,
                   "%s: at step %lld atom %lld at (%g %g %g) is on the surface or outside of the region '%s'. Place "
                   "atoms inside, or use a shorter timestep or a stronger wall",
                   hs_fix_who(fix).text, (long long)fix->env->step, (long long)atoms->id[first], atoms->x[0][first],
                   atoms->x[1][first], atoms->x[2][first], ((region_wall_state *)fix->state)->where.id);
}

/** Forces on a thread's share of the atoms; *is_inside becomes false when one is on the surface or outside. */
static void push(const hs_fix *fix, bool *is_inside)
{
    const hs_atoms *atoms = fix->env->atoms;
    const hs_places now = hs_places_now(fix->env);
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        touch sum;
        if (!(atoms->mask[i] & fix->mask)) continue;
        if (!add_surfaces(fix, &now, i, &sum)) {
#pragma omp atomic write
            *is_inside = false;
        }
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += sum.f[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    bool is_inside = true;
    HS_TRY(hs_where_update(&((region_wall_state *)fix->state)->where, err));
    HS_ON_THREADS(push(fix, &is_inside));
    if (!is_inside) (void)report_outside(fix, err);
    HS_TRY(hs_parallel_agree(fix->env->parallel, err));
    if (hs_fix_needs_virial(fix)) hs_fix_sum_virial(fix, virial_of);
    return HS_OK;
}

/** Energy, and the force on the wall. */
static void wall_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const hs_places places = hs_places_of_forces(fix->env);
    for (int i = begin; i < end; ++i) {
        touch sum;
        if (!(atoms->mask[i] & fix->mask) || !add_surfaces(fix, &places, i, &sum)) continue;
        hs_exact_add(&sums[0], sum.energy);
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[1 + axis], -sum.f[axis]);
    }
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    double sums[4];
    (void)err;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, wall_terms, fix, 4, sums);
    *value = sums[0];
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    double sums[4];
    (void)err;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, wall_terms, fix, 4, sums);
    *value = sums[1 + i];
    return HS_OK;
}

const hs_fix_style hs_fix_style_wall_region = {
    .about = {.name = "wall/region",
              .syntax = {.usage = "<region-ID> lj93|lj126|lj1043|harmonic <epsilon> <sigma> <cutoff>",
                         .n_min = 5,
                         .n_max = 5},
              .summary = "the surface of a region as a wall",
              .details =
                  "Atoms of the group, which must be inside of the region (outside of the shape with `side out`), are "
                  "pushed by the potential of `wall/lj93`, `wall/lj126`, `wall/lj1043` or `wall/harmonic` at their "
                  "distance r from the surface, when r is below the cutoff. In a corner every face within reach "
                  "pushes. Regions of style block, cylinder, plane and sphere can be walls; faces at INF are open. An "
                  "atom on the surface or outside stops the run. A wall that moves (`move`, `rotate` and `v_name` of "
                  "regions) must not pass an atom in a step; friction it has none.\n\n"
                  "The scalar `f_ID` is the wall's energy, `f_ID[1]` ... `f_ID[3]` the force on it. `fix_modify energy "
                  "yes` adds the energy to the potential energy, `virial yes` the virial to the pressure.",
              .example = "region drop sphere 0 0 0 10 units box\nfix wall all wall/region drop lj126 1.0 1.0 1.12"},
    .state_size = sizeof(region_wall_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .post_force = post_force,
    .acts_in_minimize = true,
    .scalar = scalar,
    .vector = vector,
    .n_vector = 3,
    .is_extensive = true,
    .is_vector_extensive = true,
    .has_energy = true,
    .has_virial = true,
    .allows_dynamic_group = true,
};
