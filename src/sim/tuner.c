#include "sim/tuner.h"

#include <math.h>

#include "sim/sim.h"

static const hs_neighbor_method candidates[HS_TUNER_CANDIDATES] = {HS_METHOD_CLUSTER, HS_METHOD_VERLET};

enum {
    TRIALS = 3,          /* of each candidate, of which the first does not count */
    STEPS_TO_PAY = 1000, /* shorter runs would spend too much of their time on the slower method */
};

/* With fewer neighbors in its half list than this, an atom is better served by `verlet`: short runs, which try nothing,
 * use that. */
static const double short_list = 6.0;

/** Neighbors that an atom has in half a list, if the density is even. */
static double expected_neighbors(const hs_sim *sim)
{
    const double reach = sim->pair->cutoff_max + sim->neighbor.settings.skin;
    const double region = sim->box.dimension == 2 ? M_PI * reach * reach : 4.0 / 3.0 * M_PI * reach * reach * reach;
    return 0.5 * (double)sim->atoms.n_all * region / hs_box_volume(&sim->box);
}

static double busy_s(const hs_sim *sim)
{
    const double *phase_s = sim->timer.phase_s;
    return phase_s[HS_PHASE_PAIR] + phase_s[HS_PHASE_NEIGH] + phase_s[HS_PHASE_COMM];
}

static void begin_trial(hs_sim *sim)
{
    sim->tuner.begin_s = busy_s(sim);
    sim->tuner.begin_step = sim->env.step;
}

void hs_tuner_start(hs_sim *sim)
{
    const bool is_trying =
        sim->neighbor.settings.method == HS_METHOD_AUTO && sim->env.last_step - sim->env.step >= STEPS_TO_PAY;
    const bool is_short = expected_neighbors(sim) < short_list;
    sim->tuner = (hs_tuner){.method = is_short && !is_trying ? HS_METHOD_VERLET : candidates[0],
                            .is_trying = is_trying,
                            .n_atoms = (double)sim->atoms.n_all};
}

/** The slowest rank's seconds a step since the trial began. */
static double seconds_a_step(const hs_sim *sim)
{
    double spent_s = busy_s(sim) - sim->tuner.begin_s;
    hs_parallel_max_double(&sim->parallel, &spent_s, 1);
    return spent_s / (double)(sim->env.step - sim->tuner.begin_step);
}

/** The fastest candidate is kept; the lists of the others are given back. */
static void choose(hs_sim *sim)
{
    hs_tuner *tuner = &sim->tuner;
    int best = 0;
    for (int k = 1; k < HS_TUNER_CANDIDATES; ++k)
        if (tuner->best_s[k] < tuner->best_s[best]) best = k;
    tuner->method = candidates[best];
    tuner->is_trying = false;
    if (tuner->method != HS_METHOD_CLUSTER) hs_cluster_list_fini(&sim->list);
    if (tuner->method != HS_METHOD_VERLET) hs_verlet_list_fini(&sim->verlet);
}

void hs_tuner_at_build(hs_sim *sim)
{
    hs_tuner *tuner = &sim->tuner;
    if (!tuner->is_trying) return;
    if (sim->env.step > tuner->begin_step && tuner->trial > 0) {
        const double spent_s = seconds_a_step(sim);
        double *best_s = &tuner->best_s[tuner->candidate];
        *best_s = tuner->trial == 1 ? spent_s : fmin(*best_s, spent_s);
    }
    if (++tuner->trial == TRIALS) {
        tuner->trial = 0;
        if (++tuner->candidate == HS_TUNER_CANDIDATES)
            choose(sim);
        else
            tuner->method = candidates[tuner->candidate];
    }
    begin_trial(sim);
}

hs_status hs_tuner_describe(const hs_sim *sim, hs_text *text, hs_error *err)
{
    const hs_tuner *tuner = &sim->tuner;
    if (sim->neighbor.settings.method != HS_METHOD_AUTO || tuner->is_trying || tuner->best_s[0] <= 0.0) return HS_OK;
    HS_TRY(
        hs_text_printf(text, err, "Neighbor method auto: %s (per atom and step:", hs_neighbor_methods[tuner->method]));
    for (int k = 0; k < HS_TUNER_CANDIDATES; ++k)
        HS_TRY(hs_text_printf(text, err, "%s %s %.1f ns", k == 0 ? "" : ",", hs_neighbor_methods[candidates[k]],
                              1e9 * tuner->best_s[k] / fmax(tuner->n_atoms, 1.0)));
    return hs_text_printf(text, err, ")\n");
}
