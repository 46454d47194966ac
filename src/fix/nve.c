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

/** What moves atoms alike. */
typedef struct step_sizes {
    double dt, magic;
} step_sizes;

/** Parts of a step. */
typedef enum half {
    FIRST_HALF,
    SECOND_HALF,
    BOTH_HALVES /**< the second one of a step, and the first of the next: with the same forces */
} half;

/** Atoms [0, n) along one axis: v += (dt/2) f/m, once or for both halves, and but for the second half x += dt v. kick[]: dt/2/m, of all
 *  atoms in kick[0] when @p is_uniform; moves[]: whether the atom moves, NULL: all do. The part and the bool are constants where it
 *  is called. */
static inline __attribute__((always_inline)) void move_axis(double *restrict x, double *restrict v,
                                                            const double *restrict f, const double *restrict kick,
                                                            const uint64_t *restrict moves, int n, step_sizes sizes,
                                                            const half part, const bool is_uniform)
{
    const double dt = sizes.dt, magic = sizes.magic, only_kick = kick[0];
    for (int i = 0; i < n; ++i) {
        const double v_old = v[i], change = (is_uniform ? only_kick : kick[i]) * f[i];
        const double v_new = part == BOTH_HALVES ? (v_old + change) + change : v_old + change;
        const bool is_moved = is_uniform || moves[i] != 0;
        if (part != SECOND_HALF) { /* x is read before v is written: arrays may begin at the same place of a page */
            const double x_old = x[i], x_new = hs_moved(x_old, dt * v_new, magic);
            v[i] = is_moved ? v_new : v_old;
            x[i] = is_moved ? x_new : x_old;
        } else {
            v[i] = is_moved ? v_new : v_old;
        }
    }
}

#define MOVE(is_uniform)                                                                                               \
    do {                                                                                                               \
        if (part == FIRST_HALF)                                                                                        \
            move_axis(x, v, f, kick, moves, n, sizes, FIRST_HALF, is_uniform);                                         \
        else if (part == SECOND_HALF)                                                                                  \
            move_axis(x, v, f, kick, moves, n, sizes, SECOND_HALF, is_uniform);                                        \
        else                                                                                                           \
            move_axis(x, v, f, kick, moves, n, sizes, BOTH_HALVES, is_uniform);                                        \
    } while (0)
HS_WIDE static void move_all(double *x, double *v, const double *f, const double *kick, int n, step_sizes sizes,
                             half part)
{
    const uint64_t *moves = NULL;
    MOVE(true);
}

HS_WIDE static void move_some(double *x, double *v, const double *f, const double *kick, const uint64_t *moves, int n,
                              step_sizes sizes, half part)
{
    MOVE(false);
}
#undef MOVE

enum { BLOCK = 256 }; /* atoms whose masses are looked up at a time */

/** The atoms of a thread. One type and group all is the usual case, without look-ups. */
static void move(const hs_fix *fix, half part)
{
    const nve_state *nve = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const step_sizes sizes = {.dt = fix->env->dt, .magic = fix->env->position_magic};
    double *const *x = atoms->x, *const *v = atoms->v, *const *f = atoms->f;
    double kick[BLOCK];
    uint64_t moves[BLOCK];
    const int n_axes = hs_env_n_axes(fix->env);
    int64_t begin, end;
    hs_thread_range(atoms->n_local, 1, hs_thread_number(), hs_thread_count(), &begin, &end);
    if (atoms->n_types == 1 && atoms->rmass == NULL && fix->group == 0) {
        for (int axis = 0; axis < n_axes; ++axis)
            move_all(x[axis] + begin, v[axis] + begin, f[axis] + begin, &nve->half_kick[1], (int)(end - begin), sizes,
                     part);
        return;
    }
    for (int64_t at = begin; at < end; at += BLOCK) {
        const int n = end - at < BLOCK ? (int)(end - at) : BLOCK;
        for (int k = 0; k < n; ++k) {
            moves[k] = atoms->mask[at + k] & fix->mask;
            kick[k] = atoms->rmass != NULL ? nve->half_dt / atoms->rmass[at + k] : nve->half_kick[atoms->type[at + k]];
        }
        for (int axis = 0; axis < n_axes; ++axis)
            move_some(x[axis] + at, v[axis] + at, f[axis] + at, kick, moves, n, sizes, part);
    }
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix, FIRST_HALF));
    return HS_OK;
}

static hs_status final_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix, SECOND_HALF));
    return HS_OK;
}

static hs_status join_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix, BOTH_HALVES));
    return HS_OK;
}

const hs_fix_style hs_fix_style_nve = {
    .about = {.name = "nve",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "integrate the equations of motion at constant energy",
              .details = "Velocity Verlet: half kick, drift, forces, half kick, with the timestep of `timestep`. Atoms "
                         "outside the group stay where they are.",
              .reference = "W. C. Swope et al., J. Chem. Phys. 76, 637 (1982), doi:10.1063/1.442716",
              .example = "fix 1 all nve"},
    .state_size = sizeof(nve_state),
    .destroy = destroy,
    .init = init,
    .dt_changed = init,
    .initial_integrate = initial_integrate,
    .final_integrate = final_integrate,
    .join_integrate = join_integrate,
    .is_integrator = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
