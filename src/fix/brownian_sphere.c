/* Overdamped motion of spheres: places as in fix brownian, orientations by rotational diffusion, D_r = k T / gamma_r.
 *
 * Two dimensions: the angle of the dipole grows by sqrt(2 D_r dt) xi, a plain random walk on the circle. With normal xi
 * that is the exact solution of the rotational diffusion equation for any timestep.
 * Three dimensions: the dipole is turned about the vector w = sqrt(2 D_r dt) (xi_1, xi_2, xi_3) by the angle |w|
 * (Rodrigues' formula). That is a true rotation, keeps the length to rounding, and is right to order dt^2 for each
 * step: <e' . e> = (1 + 2 (1 - s) exp(-s/2)) / 3 = exp(-s) - s^2 / 12 + ..., s = 2 D_r dt.
 * Source: I. M. Ilie et al., J. Chem. Phys. 142, 114103 (2015), doi:10.1063/1.4914322. */
#include "core/noise_formulas.h"
#include "fix/brownian_motion.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    const brownian_state *state = fix->state;
    HS_TRY(brownian_create(fix, args, err));
    if (state->gamma_r == 0.0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the rotational friction is missing: 'gamma_r <friction>'",
                       args->command);
    if (fix->env->atoms->mu[0] != NULL) return HS_OK;
    return hs_fail(
        err, HS_ERROR_INPUT,
        "%s: the atoms have no dipoles to rotate: use 'atom_style hybrid dipole sphere', or 'fix brownian' for points",
        args->command);
}

/** Turn the dipoles of atoms [begin, begin + n) in the plane by turn * xi[i]. */
static void rotate_2d(const hs_fix *fix, int begin, int n, const double *xi)
{
    const brownian_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const uint32_t *group = fix->group == 0 ? NULL : atoms->mask + begin; /* group all: fewer instructions */
    const hs_turning turning = {.turn = state->turn,
                                .is_small = state->turn * hs_noise_largest(state->kind) <= HS_SMALL_ANGLE};
    hs_isa_motion(fix->env->isa)->rotate(&turning, n, group, fix->mask, xi, atoms->mu[0] + begin, atoms->mu[1] + begin);
}

/** Turn them in space about turn * (xi_0, xi_1, xi_2). */
static void rotate_3d(const hs_fix *fix, const hs_noise_set *functions, int begin, int n, const hs_noise_block *xi)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double turn = ((brownian_state *)fix->state)->turn;
    const uint32_t mask = fix->mask, *restrict group = atoms->mask + begin;
    double *restrict mu[3] = {atoms->mu[0] + begin, atoms->mu[1] + begin, atoms->mu[2] + begin};
    double angle[HS_NOISE_BLOCK], sine[HS_NOISE_BLOCK], cosine[HS_NOISE_BLOCK];
    for (int i = 0; i < n; ++i) {
        const double x = xi->number[0][i], y = xi->number[1][i], z = xi->number[2][i];
        angle[i] = group[i] & mask ? turn * sqrt(x * x + y * y + z * z) : 0.0;
    }
    functions->sincos(angle, n, sine, cosine);
    for (int i = 0; i < n; ++i) {
        const double scale = angle[i] > 0.0 ? turn / angle[i] : 0.0;
        const double k_x = scale * xi->number[0][i], k_y = scale * xi->number[1][i], k_z = scale * xi->number[2][i];
        const double x = mu[0][i], y = mu[1][i], z = mu[2][i];
        const double along = (k_x * x + k_y * y + k_z * z) * (1.0 - cosine[i]);
        mu[0][i] = x * cosine[i] + (k_y * z - k_z * y) * sine[i] + k_x * along;
        mu[1][i] = y * cosine[i] + (k_z * x - k_x * z) * sine[i] + k_y * along;
        mu[2][i] = z * cosine[i] + (k_x * y - k_y * x) * sine[i] + k_z * along;
    }
}

/** Draw 0 moves the atoms, and in the plane its third number turns them; in space draw 1 turns them. */
static void move_block(const hs_fix *fix, const hs_noise_set *functions, int begin, int n)
{
    const brownian_state *state = fix->state;
    const int64_t clock = hs_fix_clock(fix), *id = fix->env->atoms->id + begin;
    hs_noise_block noise;
    if (!state->has_noise) {
        memset(&noise, 0, sizeof noise);
        brownian_translate(fix, begin, n, &noise);
        return;
    }
    functions->fill(state->noise, state->kind, clock, 0, 3, id, n, &noise);
    brownian_translate(fix, begin, n, &noise);
    if (fix->env->box->dimension == 2) {
        rotate_2d(fix, begin, n, noise.number[2]);
        return;
    }
    functions->fill(state->noise, state->kind, clock, 1, 3, id, n, &noise);
    rotate_3d(fix, functions, begin, n, &noise);
}

static void move(const hs_fix *fix)
{
    const int n_local = fix->env->atoms->n_local, n_blocks = (n_local + HS_NOISE_BLOCK - 1) / HS_NOISE_BLOCK;
    const hs_noise_set *functions = hs_isa_noise(fix->env->isa);
#pragma omp for schedule(static) nowait
    for (int b = 0; b < n_blocks; ++b) {
        const int begin = b * HS_NOISE_BLOCK, left = n_local - begin;
        move_block(fix, functions, begin, left < HS_NOISE_BLOCK ? left : HS_NOISE_BLOCK);
    }
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix));
    return HS_OK;
}

static const hs_keyword keywords[] = {
    BROWNIAN_KEYWORDS,
    {"gamma_r", 1, "<friction>", "rotational friction, mass distance^2/time"},
    {NULL, 0, NULL, NULL},
};

const hs_fix_style hs_fix_style_brownian_sphere = {
    .about =
        {.name = "brownian/sphere",
         .syntax = {.usage = "<temp> <seed> gamma_t <friction> gamma_r <friction> [rng uniform|gaussian|none]",
                    .n_min = 2,
                    .n_max = 2,
                    .keywords = keywords},
         .summary = "overdamped (Brownian) motion of spheres with a direction",
         .details =
             "Atoms move as with `fix brownian`, and their dipoles turn by rotational diffusion, D_r = k T / gamma_r: "
             "<e(t).e(0)> = exp(-(d - 1) D_r t). In two dimensions the angle makes a random walk (with `rng gaussian` "
             "exact for any timestep), in three the dipole is turned by the whole random rotation of a step, not by "
             "its linear part, so its length stays what it was. The two frictions are independent. The atoms need "
             "dipoles (`atom_style dipole`, or `hybrid dipole sphere`).\n\n" BROWNIAN_DETAILS,
         .reference = "I. M. Ilie et al., J. Chem. Phys. 142, 114103 (2015), doi:10.1063/1.4914322",
         .example = "fix 1 all brownian/sphere 1.0 12345 gamma_t 1.0 gamma_r 0.33"},
    .state_size = sizeof(brownian_state),
    .create = create,
    .init = brownian_init,
    .dt_changed = brownian_init,
    .initial_integrate = initial_integrate,
    .is_integrator = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
