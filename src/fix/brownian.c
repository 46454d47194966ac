/* Overdamped motion by the Euler-Maruyama scheme:
 *   x += (dt / gamma_t) f + sqrt(2 D_t dt) xi,  D_t = k T / gamma_t.
 * Source: P. E. Kloeden, E. Platen, Numerical Solution of Stochastic Differential Equations (1992),
 * doi:10.1007/978-3-662-12616-5, section 10.2. */
#include "fix/brownian_motion.h"

static void move(const hs_fix *fix)
{
    const brownian_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_noise_set *functions = hs_isa_noise(env->isa);
    const int n_blocks = (env->atoms->n_local + HS_NOISE_BLOCK - 1) / HS_NOISE_BLOCK;
#pragma omp for schedule(static) nowait
    for (int b = 0; b < n_blocks; ++b) {
        const int begin = b * HS_NOISE_BLOCK, left = env->atoms->n_local - begin;
        const int n = left < HS_NOISE_BLOCK ? left : HS_NOISE_BLOCK;
        hs_noise_block noise;
        if (state->has_noise)
            functions->fill(state->noise, state->kind, hs_fix_clock(fix), 0, env->box->dimension,
                            env->atoms->id + begin, n, &noise);
        else
            memset(&noise, 0, sizeof noise);
        brownian_translate(fix, begin, n, &noise);
    }
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(move(fix));
    return HS_OK;
}

static const hs_keyword keywords[] = {BROWNIAN_KEYWORDS, {NULL, 0, NULL, NULL}};

const hs_fix_style hs_fix_style_brownian = {
    .about = {.name = "brownian",
              .syntax = {.usage = "<temp> <seed> gamma_t <friction> [rng uniform|gaussian|none]",
                         .n_min = 2,
                         .n_max = 2,
                         .keywords = keywords},
              .summary = "overdamped (Brownian) motion of points",
              .details =
                  "Each step moves an atom by dt f / gamma_t plus noise of variance 2 k T dt / gamma_t in each "
                  "direction (Euler-Maruyama), so that free atoms diffuse with D = k T / gamma_t.\n\n" BROWNIAN_DETAILS,
              .reference = "P. E. Kloeden, E. Platen, Numerical Solution of Stochastic Differential Equations (1992), "
                           "doi:10.1007/978-3-662-12616-5",
              .example = "fix 1 all brownian 1.0 12345 gamma_t 1.0 rng gaussian"},
    .state_size = sizeof(brownian_state),
    .create = brownian_create,
    .init = brownian_init,
    .dt_changed = brownian_init,
    .initial_integrate = initial_integrate,
    .is_integrator = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
