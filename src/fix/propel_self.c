/* Self-propulsion of active particles: a force of constant size along the particle's dipole or velocity. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/wide.h"
#include "style/fix.h"
#include "style/places.h"

typedef enum { MODE_DIPOLE, MODE_VELOCITY } propel_mode;

typedef struct propel_state {
    propel_mode mode;
    double force;                /**< energy/distance (for dipoles of length 1) */
    unsigned char *is_propelled; /**< owned [n_types + 1]; NULL: all types */
} propel_state;

static hs_status read_types(hs_fix *fix, const hs_args *args, int first, hs_error *err)
{
    propel_state *state = fix->state;
    const int n_types = fix->env->atoms->n_types;
    HS_TRY(HS_ALLOC(state->is_propelled, (size_t)n_types + 1, err));
    for (int i = first; i < args->n; ++i) {
        int lo, hi;
        HS_TRY(hs_arg_range(args, i, n_types, &lo, &hi, err));
        for (int type = lo; type <= hi; ++type) state->is_propelled[type] = 1;
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const modes[] = {"dipole", "velocity", NULL};
    propel_state *state = fix->state;
    int mode;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    if (strcmp(args->word[0], "quat") == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: 'quat' needs ellipsoids, which are not supported; 'dipole' propels along the dipole of "
                       "'atom_style dipole'",
                       args->command);
    HS_TRY(hs_arg_choice(args, 0, modes, &mode, err));
    HS_TRY(hs_arg_double(args, 1, &state->force, err));
    state->mode = (propel_mode)mode;
    if (state->mode == MODE_DIPOLE && fix->env->atoms->mu[0] == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: mode dipole needs atoms with dipoles: 'atom_style dipole' or 'hybrid dipole sphere'",
                       args->command);
    return args->n > 2 ? read_types(fix, args, 3, err) : HS_OK;
}

static void destroy(hs_fix *fix) { HS_FREE(((propel_state *)fix->state)->is_propelled); }

HS_WIDE static void push_all(double *restrict f, const double *restrict mu, double force, int64_t n)
{
    for (int64_t i = 0; i < n; ++i) f[i] += force * mu[i];
}

HS_WIDE static void push_group(double *restrict f, const double *restrict mu, double force,
                               const uint32_t *restrict group, uint32_t mask, int64_t n)
{
    for (int64_t i = 0; i < n; ++i) f[i] = group[i] & mask ? f[i] + force * mu[i] : f[i];
}

static void push_types(const propel_state *state, double *restrict f, const double *restrict mu,
                       const uint32_t *restrict group, uint32_t mask, const int32_t *restrict type, int64_t n)
{
    for (int64_t i = 0; i < n; ++i)
        if (group[i] & mask && state->is_propelled[type[i]]) f[i] += state->force * mu[i];
}

/** The atoms of a thread. */
static void propel_along_dipoles(const hs_fix *fix)
{
    const propel_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    int64_t begin, end;
    hs_thread_range(atoms->n_local, 1, hs_thread_number(), hs_thread_count(), &begin, &end);
    const uint32_t *group = atoms->mask + begin;
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        double *f = atoms->f[axis] + begin;
        const double *mu = atoms->mu[axis] + begin;
        if (state->is_propelled != NULL)
            push_types(state, f, mu, group, fix->mask, atoms->type + begin, end - begin);
        else if (fix->group == 0)
            push_all(f, mu, state->force, end - begin);
        else
            push_group(f, mu, state->force, group, fix->mask, end - begin);
    }
}

static bool force_of(const hs_fix *fix, int i, double f[3])
{
    const propel_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const bool is_dipole = state->mode == MODE_DIPOLE;
    const double vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i],
                 speed = sqrt(vx * vx + vy * vy + vz * vz);
    if (state->is_propelled != NULL && !state->is_propelled[atoms->type[i]]) return false;
    if (!is_dipole && !(speed > 0.0)) return false;
    for (int axis = 0; axis < fix->env->box->dimension; ++axis)
        f[axis] = is_dipole ? state->force * atoms->mu[axis][i] : state->force / speed * atoms->v[axis][i];
    return true;
}

static void propel_along_velocities(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        double f[3] = {0.0};
        if (!(atoms->mask[i] & fix->mask) || !force_of(fix, i, f)) continue;
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += f[axis];
    }
}

static void virial_of(const hs_fix *fix, int i, double w[6])
{
    double r[3], f[3] = {0.0};
    hs_unwrapped_place(fix->env, i, r);
    if (force_of(fix, i, f)) hs_fix_add_virial(r, f, w);
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    if (((propel_state *)fix->state)->mode == MODE_DIPOLE)
        HS_ON_THREADS(propel_along_dipoles(fix));
    else
        HS_ON_THREADS(propel_along_velocities(fix));
    if (hs_fix_needs_virial(fix)) hs_fix_sum_virial(fix, virial_of);
    return HS_OK;
}

static const hs_keyword keywords[] = {
    {"types", -1, "<type> ...", "propel atoms of these types only: numbers or ranges"},
    {NULL, 0, NULL, NULL},
};

const hs_fix_style hs_fix_style_propel_self = {
    .about =
        {.name = "propel/self",
         .syntax =
             {.usage = "dipole|velocity <force> [types <type> ...]", .n_min = 2, .n_max = 2, .keywords = keywords},
         .summary = "self-propulsion of active particles",
         .details =
             "Adds a force to every atom of the group: in mode `dipole`, the force times the atom's dipole moment, "
             "so that dipoles of length 1 give a force of that size; in mode `velocity`, a force of that size along "
             "the velocity (none for atoms at rest). A negative force pulls backwards. Together with `brownian/sphere` "
             "atoms become active Brownian particles of speed force / gamma_t.\n\n`fix_modify virial yes` adds the sum "
             "of r f, with unwrapped coordinates, to the virial: the swim part of the pressure. It is left out by "
             "default. Ellipsoids (mode `quat`) are not supported.",
         .reference = "A. P. Solon et al., Phys. Rev. Lett. 114, 198301 (2015), doi:10.1103/PhysRevLett.114.198301",
         .example = "fix swim all propel/self dipole 4.0\nfix_modify swim virial yes"},
    .state_size = sizeof(propel_state),
    .create = create,
    .destroy = destroy,
    .post_force = post_force,
    .has_virial = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
