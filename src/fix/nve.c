/* Constant-energy integration by velocity Verlet:
 *   v += (dt/2) f/m,  x += dt v   |  forces  |   v += (dt/2) f/m
 * Source: W. C. Swope et al., J. Chem. Phys. 76, 637 (1982), doi:10.1063/1.442716. */
#include "base/memory.h"
#include "base/wide.h"
#include "style/fix.h"

typedef struct nve_state {
    double half_dt;    /**< (dt/2) ftm2v */
    double *half_kick; /**< owned [n_types + 1]: half_dt / m, by type */
    int n_types;
} nve_state;

static hs_status init(hs_fix *fix, hs_error *err)
{
    nve_state *nve = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    if (nve->half_kick == NULL || nve->n_types != atoms->n_types) {
        HS_TRY(HS_GROW(nve->half_kick, 0, (size_t)atoms->n_types + 1, err));
        nve->n_types = atoms->n_types;
    }
    nve->half_dt = 0.5 * fix->env->dt * fix->env->units->ftm2v;
    for (int type = 1; type <= atoms->n_types; ++type) nve->half_kick[type] = nve->half_dt / atoms->mass[type];
    return HS_OK;
}

static void destroy(hs_fix *fix) { HS_FREE(((nve_state *)fix->state)->half_kick); }

/** What moves the atoms of one type alike. */
typedef struct step_sizes {
    double dt, magic, half_dt;
    const double *half_kick; /**< [n_types + 1] */
    uint32_t mask;
} step_sizes;

/** Where the mass of an atom is: one type and group all is the usual case, a loop without look-ups. */
typedef enum { MASS_OF_ALL, MASS_OF_TYPE, MASS_OF_ATOM } mass_kind;

/** One axis of the atoms: v += (dt/2) f/m, and with @p drift x += dt v. Both are constants where it is called. */
static inline __attribute__((always_inline)) void move_atoms(const hs_atoms *atoms, int axis, const step_sizes *sizes,
                                                             const bool drift, const mass_kind kind)
{
    double *restrict x = atoms->x[axis], *restrict v = atoms->v[axis];
    const double *restrict f = atoms->f[axis], *restrict rmass = atoms->rmass;
    const int32_t *restrict type = atoms->type;
    const uint32_t *restrict group = atoms->mask, mask = sizes->mask;
    const double *restrict half_kick = sizes->half_kick;
    const double dt = sizes->dt, magic = sizes->magic, half_dt = sizes->half_dt, only_kick = half_kick[1];
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        const bool is_moved = kind == MASS_OF_ALL || (group[i] & mask) != 0;
        const double kick = kind == MASS_OF_ALL    ? only_kick
                            : kind == MASS_OF_ATOM ? half_dt / rmass[i]
                                                   : half_kick[type[i]];
        const double v_new = v[i] + kick * f[i];
        v[i] = is_moved ? v_new : v[i];
        if (drift) x[i] = is_moved ? hs_moved(x[i], dt * v_new, magic) : x[i];
    }
}

HS_WIDE static void move(const hs_fix *fix, const bool drift)
{
    const nve_state *nve = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const step_sizes sizes = {.dt = fix->env->dt,
                              .magic = fix->env->position_magic,
                              .half_dt = nve->half_dt,
                              .half_kick = nve->half_kick,
                              .mask = fix->mask};
    const bool is_plain = atoms->n_types == 1 && atoms->rmass == NULL && fix->group == 0;
#define MOVE(drift, kind)                                                                                              \
    for (int axis = 0; axis < 3; ++axis) move_atoms(atoms, axis, &sizes, drift, kind)
    if (is_plain && drift)
        MOVE(true, MASS_OF_ALL);
    else if (is_plain)
        MOVE(false, MASS_OF_ALL);
    else if (atoms->rmass != NULL)
        MOVE(drift, MASS_OF_ATOM);
    else if (drift)
        MOVE(true, MASS_OF_TYPE);
    else
        MOVE(false, MASS_OF_TYPE);
#undef MOVE
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix, true));
    return HS_OK;
}

static hs_status final_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix, false));
    return HS_OK;
}

const hs_fix_style hs_fix_style_nve = {
    .about = {.name = "nve",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "integrate the equations of motion at constant energy",
              .details = "Velocity Verlet: half kick, drift, forces, half kick, with the timestep of `timestep`. "
                         "Atoms outside the group stay where they are.",
              .reference = "W. C. Swope et al., J. Chem. Phys. 76, 637 (1982), doi:10.1063/1.442716",
              .example = "fix 1 all nve"},
    .state_size = sizeof(nve_state),
    .destroy = destroy,
    .init = init,
    .initial_integrate = initial_integrate,
    .final_integrate = final_integrate,
    .is_integrator = true,
};
