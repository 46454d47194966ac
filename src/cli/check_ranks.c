/* halfshell check -ranks: what a deck's last system would need on so many ranks. */
#include <math.h>
#include <stdio.h>

#include "cli/cli.h"
#include "comm/predict.h"

/* Constants of the prediction, measured as docs/scaling.md tells. */
static const double bytes_local = 230.0, bytes_halo = 80.0; /* of memory for an atom, default method */
static const double halo_atom_s = 20e-9;        /* choosing, packing and adding back of a halo atom, for each step */
static const double uneven = 0.03;              /* of a step's work: what ranks wait for the slowest one */
static const double bytes_a_step = 2 * 3 * 8.0; /* of a halo atom: positions one way, forces the other */

/** What a machine does. */
typedef struct machine {
    double atom_s, latency_s, seconds_a_byte;
} machine;

/** Seconds of a step on so many ranks. */
static double step_time(const hs_prediction *p, int n_ranks, const machine *m)
{
    const double work_s = p->n_local * m->atom_s + p->n_halo * halo_atom_s;
    if (n_ranks == 1) return work_s;
    /* two agreements of all ranks in a step, up and down a tree */
    const double agree_s = 2.0 * 2.0 * ceil(log2(n_ranks)) * m->latency_s;
    const double halo_s = 2.0 * p->n_partners * m->latency_s + p->n_remote * bytes_a_step * m->seconds_a_byte;
    return (1.0 + uneven) * work_s + halo_s + agree_s;
}

static hs_status tell_row(const hs_deck *deck, int n_ranks, const machine *m, double one_s, hs_error *err)
{
    const hs_sim *sim = deck->sim;
    hs_prediction p;
    HS_TRY(hs_predict(&p, &sim->box, sim->domain.wanted, n_ranks, (double)sim->atoms.n_all, sim->env.reach, err));
    const double step_s = step_time(&p, n_ranks, m);
    const double mib = (p.n_local * bytes_local + p.n_halo * bytes_halo) / (1024.0 * 1024.0);
    char grid[48];
    snprintf(grid, sizeof grid, "%dx%dx%d", p.n[0], p.n[1], p.n[2]);
    hs_say(deck->out, "%8d %16s %12.4g %12.4g %12.4g %8d %10.4g %12.4g %10.1f\n", n_ranks, grid, p.n_local, p.n_halo,
           p.n_remote * bytes_a_step, p.n_partners, mib, 1e6 * step_s,
           one_s > 0.0 ? 100.0 * one_s / (n_ranks * step_s) : 100.0);
    return HS_OK;
}

hs_status hs_cli_predict_ranks(const hs_deck *deck, const hs_cli_settings *settings, hs_error *err)
{
    const machine m = {.atom_s = 1e-6 / settings->speed,
                       .latency_s = 1e-6 * settings->latency_us,
                       .seconds_a_byte = 1e-9 / settings->bandwidth};
    if (settings->n_rank_counts == 0) return HS_OK;
    if (!deck->sim->box.exists || deck->sim->env.reach <= 0.0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "-ranks: the deck has no run with forces at its end to make a prediction for");
    hs_prediction alone;
    const int free_grid[3] = {0, 0, 0};
    HS_TRY(
        hs_predict(&alone, &deck->sim->box, free_grid, 1, (double)deck->sim->atoms.n_all, deck->sim->env.reach, err));
    const double one_s = step_time(&alone, 1, &m);
    hs_say(deck->out,
           "\nPrediction for atoms spread evenly, %.4g million atom-steps/s a core, %g us a message, %g GB/s a rank\n"
           "%8s %16s %12s %12s %12s %8s %10s %12s %10s\n",
           settings->speed, settings->latency_us, settings->bandwidth, "ranks", "bricks", "atoms/rank", "halo atoms",
           "bytes/step", "partners", "MiB/rank", "us/step", "efficiency");
    for (int k = 0; k < settings->n_rank_counts; ++k) {
        hs_error row = {0};
        if (tell_row(deck, settings->rank_counts[k], &m, one_s, &row) != HS_OK)
            hs_say(deck->out, "%8d  %s\n", settings->rank_counts[k], row.text);
    }
    return HS_OK;
}
