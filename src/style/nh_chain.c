#include "style/nh_chain.h"

#include <math.h>

#include "base/memory.h"

hs_status hs_nh_chain_create(hs_nh_chain *chain, hs_error *err)
{
    const size_t n = (size_t)chain->n;
    HS_TRY(HS_ALLOC(chain->place, n, err));
    HS_TRY(HS_ALLOC(chain->rate, n + 1, err));
    HS_TRY(HS_ALLOC(chain->force, n, err));
    return HS_ALLOC(chain->mass, n, err);
}

void hs_nh_chain_destroy(hs_nh_chain *chain)
{
    HS_FREE(chain->place);
    HS_FREE(chain->rate);
    HS_FREE(chain->force);
    HS_FREE(chain->mass);
}

void hs_nh_chain_force(hs_nh_chain *chain, double kt)
{
    for (int k = 1; k < chain->n; ++k)
        chain->force[k] = (chain->mass[k - 1] * chain->rate[k - 1] * chain->rate[k - 1] - kt) / chain->mass[k];
}

double hs_nh_chain_advance(hs_nh_chain *chain, double kt, double target, double kinetic, double dt)
{
    const double part = 1.0 / chain->n_loops, kick = 0.25 * part * dt, eighth = 0.125 * part * dt;
    double *rate = chain->rate, *force = chain->force, scale = 1.0;
    force[0] = chain->mass[0] > 0.0 ? (kinetic - target) / chain->mass[0] : 0.0;
    for (int loop = 0; loop < chain->n_loops; ++loop) {
        for (int k = chain->n - 1; k >= 0; --k) {
            const double decay = exp(-eighth * rate[k + 1]);
            rate[k] = (rate[k] * decay + force[k] * kick) * chain->drag * decay;
        }
        const double factor = exp(-0.5 * part * dt * rate[0]);
        scale *= factor;
        kinetic *= factor * factor;
        force[0] = chain->mass[0] > 0.0 ? (kinetic - target) / chain->mass[0] : 0.0;
        for (int k = 0; k < chain->n; ++k) chain->place[k] += 0.5 * part * dt * rate[k];
        for (int k = 0; k < chain->n; ++k) {
            const double decay = exp(-eighth * rate[k + 1]);
            if (k > 0) force[k] = (chain->mass[k - 1] * rate[k - 1] * rate[k - 1] - kt) / chain->mass[k];
            rate[k] = (rate[k] * decay + force[k] * kick) * decay;
        }
    }
    return scale;
}

double hs_nh_chain_potential(const hs_nh_chain *chain, int k, double kt, double target)
{
    return (k == 0 ? target : kt) * chain->place[k];
}

double hs_nh_chain_kinetic(const hs_nh_chain *chain, int k)
{
    return 0.5 * chain->mass[k] * chain->rate[k] * chain->rate[k];
}

double hs_nh_chain_energy(const hs_nh_chain *chain, double kt, double target)
{
    double sum = 0.0;
    for (int k = 0; k < chain->n; ++k)
        sum += hs_nh_chain_potential(chain, k, kt, target) + hs_nh_chain_kinetic(chain, k);
    return sum;
}

hs_status hs_nh_chain_keep(hs_nh_chain *chain, hs_state *kept, const char *const names[4], hs_error *err)
{
    HS_TRY(hs_state_double(kept, names[0], chain->place, chain->n, err));
    HS_TRY(hs_state_double(kept, names[1], chain->rate, chain->n + 1, err));
    HS_TRY(hs_state_double(kept, names[2], chain->force, chain->n, err));
    return hs_state_double(kept, names[3], chain->mass, chain->n, err);
}
