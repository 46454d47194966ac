#include "sim/report.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "sim/methods.h"
#include "sim/thermo_internal.h"

/** Minimum, mean and maximum of a value over ranks (collective). */
typedef struct spread {
    double min, mean, max;
} spread;

static spread spread_of(const hs_parallel *parallel, double value)
{
    spread s = {value, value, value};
    hs_parallel_min_double(parallel, &s.min, 1);
    hs_parallel_max_double(parallel, &s.max, 1);
    hs_parallel_sum_double(parallel, &s.mean, 1);
    s.mean /= parallel->n_ranks > 1 ? parallel->n_ranks : 1;
    return s;
}

static hs_status describe_neighbors(const hs_sim *sim, hs_text *text, hs_error *err)
{
    const hs_neighbor_settings *settings = &sim->neighbor.settings;
    const double cutoff = sim->pair->cutoff_max, reach = cutoff > 0.0 ? cutoff + settings->skin : 0.0;
    HS_TRY(hs_text_printf(text, err,
                          "Neighbor list info ...\n  update every %lld steps, delay %lld steps, check %s%s\n",
                          (long long)settings->every, (long long)settings->delay, settings->check ? "yes" : "no",
                          settings->once ? ", once" : ""));
    HS_TRY(
        hs_text_printf(text, err, "  master list distance cutoff = %.8g\n  ghost atom cutoff = %.8g\n", reach, reach));
    if (cutoff > 0.0) HS_TRY(hs_sim_describe_cells(sim, text, err));
    if (hs_threads_get() < sim->n_threads)
        HS_TRY(hs_text_printf(text, err, "  1 thread, not %d, for few atoms: '-threads %d' insists\n", sim->n_threads,
                              sim->n_threads));
    return hs_text_printf(
        text, err, "  neighbor method %s: %s\n  pair kernels: %s, %s precision%s\n  pairs: %s\n",
        hs_neighbor_methods[settings->method], hs_sim_method(sim)->help, hs_isa_names[sim->isa],
        hs_precision_names[sim->precision], sim->kernel_precision == HS_PRECISION_FIXED ? ", reproducible sums" : "",
        settings->exact ? "all within the cutoff at every step" : "as the update schedule above gives them");
}

void hs_report_setup(hs_sim *sim)
{
    hs_text text = {0};
    hs_error err = {0};
    char **printed = &sim->thermo->neighbor_info;
    if (describe_neighbors(sim, &text, &err) == HS_OK &&
        (*printed == NULL || strcmp(*printed, hs_text_get(&text)) != 0)) {
        hs_say(sim->env.out, "%s", hs_text_get(&text));
        HS_FREE(*printed);
        if (hs_memory_strdup(printed, hs_text_get(&text), &err) != HS_OK) *printed = NULL;
    }
    hs_text_fini(&text);
    const spread memory = spread_of(&sim->parallel, (double)hs_memory_resident() / (1024.0 * 1024.0));
    hs_say(sim->env.out, "Per MPI rank memory allocation (min/avg/max) = %.4g | %.4g | %.4g Mbytes\n", memory.min,
           memory.mean, memory.max);
}

/** Speed in the user's terms; nothing for a run without steps. */
static void say_performance(const hs_sim *sim, int64_t n_steps, double loop_s)
{
    const hs_units *units = sim->env.units;
    const double seconds_per_day = 86400.0, steps_per_s = (double)n_steps / loop_s;
    const double time_per_day = steps_per_s * sim->env.dt * seconds_per_day;
    if (n_steps == 0 || loop_s <= 0.0) return;
    if (strcmp(units->name, "lj") == 0) {
        hs_say(sim->env.out, "Performance: %.3f tau/day, %.3f timesteps/s\n", time_per_day, steps_per_s);
        return;
    }
    if (strcmp(units->name, "electron") == 0) {
        const double hours = 24.0 / time_per_day;
        hs_say(sim->env.out, "Performance: %.3f fs/day, %.3f hours/fs, %.3f timesteps/s\n", time_per_day, hours,
               steps_per_s);
        return;
    }
    if (units->is_extreme) { /* nanoseconds would be no measure there */
        hs_say(sim->env.out, "Performance: %.3f timesteps/s\n", steps_per_s);
        return;
    }
    const double ns_per_day = time_per_day * units->ns;
    hs_say(sim->env.out, "Performance: %.3f ns/day, %.3f hours/ns, %.3f timesteps/s\n", ns_per_day, 24.0 / ns_per_day,
           steps_per_s);
}

static void say_table_head(const hs_sim *sim, const char *title)
{
    hs_say(sim->env.out,
           "%s:\nSection |  min time  |  avg time  |  max time  |%%varavg| %%total\n"
           "---------------------------------------------------------------\n",
           title);
}

/** One row of a table of times; returns the mean of all ranks (collective). */
static double say_time(const hs_sim *sim, const char *name, double seconds, double loop_s)
{
    const spread time = spread_of(&sim->parallel, seconds);
    /* 100 * sqrt(<t^2>/<t>^2 - 1): how unevenly the ranks were busy */
    const spread square = spread_of(&sim->parallel, seconds * seconds);
    const double excess = time.mean > 0.0 ? square.mean / (time.mean * time.mean) - 1.0 : 0.0;
    const double uneven = sim->parallel.n_ranks > 1 && excess > 0.0 ? 100.0 * sqrt(excess) : 0.0;
    hs_say(sim->env.out, "%-7s | %-10.5g | %-10.5g | %-10.5g |%6.1f |%6.2f\n", name, time.min, time.mean, time.max,
           uneven, loop_s > 0.0 ? 100.0 * time.mean / loop_s : 0.0);
    return time.mean;
}

static void say_timing(const hs_sim *sim, double loop_s)
{
    static const char *const names[HS_N_PHASES] = {"Pair", "Neigh", "Comm", "Output", "Modify"};
    double other_s = loop_s;
    hs_say(sim->env.out, "\n");
    say_table_head(sim, "MPI task timing breakdown");
    for (int phase = 0; phase < HS_N_PHASES; ++phase)
        other_s -= say_time(sim, names[phase], sim->timer.phase_s[phase], loop_s);
    if (other_s < 0.0) other_s = 0.0;
    hs_say(sim->env.out, "Other   |            | %-10.4g |            |       |%6.2f\n\n", other_s,
           loop_s > 0.0 ? 100.0 * other_s / loop_s : 0.0);
}

/** The parts of Comm. */
static void say_comm_timing(const hs_sim *sim, double loop_s)
{
    static const char *const names[HS_N_COMM_PARTS] = {"Pack", "Wait", "Unpack", "Agree", "Exchange"};
    if (sim->parallel.n_ranks <= 1) return;
    say_table_head(sim, "Parts of Comm (halo: Pack, Wait, Unpack; all ranks: Agree; new lists: Exchange)");
    for (int part = 0; part < HS_N_COMM_PARTS; ++part)
        (void)say_time(sim, names[part], sim->timer.comm_s[part], loop_s);
    hs_say(sim->env.out, "\n");
}

/** One line with a number per rank and its histogram over ranks (collective). */
static void say_histogram(const hs_sim *sim, const char *name, double value)
{
    enum { N_BINS = 10 };
    const spread s = spread_of(&sim->parallel, value);
    int64_t bins[N_BINS] = {0};
    const double width = s.max - s.min;
    int bin = width > 0.0 ? (int)((value - s.min) / width * N_BINS) : 0;
    if (bin >= N_BINS) bin = N_BINS - 1;
    bins[bin] = 1;
    hs_parallel_sum_int64(&sim->parallel, bins, N_BINS);
    hs_say(sim->env.out, "%-8s   %#11.6g ave %11.6g max %11.6g min\nHistogram:", name, s.mean, s.max, s.min);
    for (int k = 0; k < N_BINS; ++k) hs_say(sim->env.out, " %lld", (long long)bins[k]);
    hs_say(sim->env.out, "\n");
}

/** How far the busiest rank is above the mean, for `balance` (collective). */
static void say_imbalance(const hs_sim *sim)
{
    if (sim->parallel.n_ranks <= 1) return;
    const spread atoms = spread_of(&sim->parallel, sim->atoms.n_local);
    const spread pair_s = spread_of(&sim->parallel, sim->timer.phase_s[HS_PHASE_PAIR]);
    hs_say(sim->env.out, "Load imbalance (largest/mean) = %.4g by atoms, %.4g by time of pair forces\n",
           atoms.mean > 0.0 ? atoms.max / atoms.mean : 1.0, pair_s.mean > 0.0 ? pair_s.max / pair_s.mean : 1.0);
}

static void say_tuning(hs_sim *sim)
{
    hs_text text = {0};
    hs_error err = {0};
    if (hs_tuner_describe(sim, &text, &err) == HS_OK && text.length > 0) hs_say(sim->env.out, "%s", hs_text_get(&text));
    hs_text_fini(&text);
}

/** What a rank sends in a step without new lists, the mean of all (collective). */
static void say_traffic(const hs_sim *sim)
{
    if (sim->parallel.n_ranks <= 1) return;
    const hs_halo *halo = &sim->halo;
    const double bytes_an_atom = sizeof(double) * HS_HALO_WORDS;
    const spread forward = spread_of(&sim->parallel, bytes_an_atom * (halo->out.n - halo->out.n_self_atoms));
    const spread back = spread_of(&sim->parallel, bytes_an_atom * (halo->in.n - halo->in.n_self_atoms));
    const spread messages = spread_of(&sim->parallel, 0.5 * halo->forward.n); /* sent and received */
    hs_say(sim->env.out, "Halo traffic = %.6g bytes forward, %.6g back, %.4g messages each way (a rank and step)\n",
           forward.mean, back.mean, messages.mean);
}

void hs_report_loop(hs_sim *sim, int64_t n_steps, double loop_s)
{
    const int n_ranks = sim->parallel.n_ranks > 1 ? sim->parallel.n_ranks : 1;
    int64_t n_atoms = sim->atoms.n_local;
    hs_parallel_sum_int64(&sim->parallel, &n_atoms, 1);
    hs_say(sim->env.out, "Loop time of %.6g on %d procs for %lld steps with %lld atoms\n\n",
           spread_of(&sim->parallel, loop_s).mean, n_ranks * hs_threads_get(), (long long)n_steps, (long long)n_atoms);
}

/** What the processes of all ranks hold (collective). */
static void say_memory(const hs_sim *sim, int64_t n_atoms)
{
    const double mib = 1024.0 * 1024.0;
    double bytes[2] = {(double)hs_memory_resident(), 0.0};
    bytes[1] = fmax(bytes[0], (double)hs_memory_resident_peak()); /* the system brings it up to date now and then */
    hs_parallel_sum_double(&sim->parallel, bytes, 2);
    if (n_atoms > 0)
        hs_say(sim->env.out, "Memory = %.4g Mbytes, at its peak %.4g; %.4g bytes an atom\n", bytes[0] / mib,
               bytes[1] / mib, bytes[0] / (double)n_atoms);
}

void hs_report_finish(hs_sim *sim, int64_t n_steps, double loop_s, double cpu_s, const char *statistics)
{
    hs_sink *out = sim->env.out;
    const int n_ranks = sim->parallel.n_ranks > 1 ? sim->parallel.n_ranks : 1;
    const int n_threads = hs_threads_get();
    int64_t n_atoms = sim->atoms.n_local;
    hs_parallel_sum_int64(&sim->parallel, &n_atoms, 1);
    loop_s = spread_of(&sim->parallel, loop_s).mean;
    cpu_s = spread_of(&sim->parallel, cpu_s).mean;
    hs_report_loop(sim, n_steps, loop_s);
    if (statistics == NULL) say_performance(sim, n_steps, loop_s);
    hs_say(out, "%.1f%% CPU use with %d MPI tasks x %d OpenMP threads\n", loop_s > 0.0 ? 100.0 * cpu_s / loop_s : 0.0,
           n_ranks, n_threads);
    if (statistics != NULL) hs_say(out, "%s", statistics);
    say_timing(sim, loop_s);
    say_comm_timing(sim, loop_s);
    say_histogram(sim, "Nlocal:", sim->atoms.n_local);
    say_histogram(sim, "Nghost:", sim->atoms.n_halo);
    const hs_neighbor_counters *counters = &sim->neighbor.counters;
    int64_t n_pairs = counters->n_pairs;
    hs_parallel_sum_int64(&sim->parallel, &n_pairs, 1);
    if (n_pairs > 0) {
        say_histogram(sim, "Neighs:", (double)counters->n_pairs);
        hs_say(out, "\nTotal # of neighbors = %lld\nAve neighs/atom = %#.8g\n", (long long)n_pairs,
               n_atoms > 0 ? (double)n_pairs / (double)n_atoms : 0.0);
    } else {
        hs_say(out, "\n");
    }
    say_imbalance(sim);
    say_traffic(sim);
    hs_say(out, "Neighbor list builds = %lld\n", (long long)counters->n_builds);
    if (sim->neighbor.settings.check)
        hs_say(out, "Dangerous builds = %lld\n", (long long)counters->n_dangerous);
    else
        hs_say(out, "Dangerous builds not checked\n");
    say_memory(sim, n_atoms);
    say_tuning(sim);
    if (out->log != NULL) fflush(out->log);
}

void hs_report_progress(hs_sim *sim)
{
    const double interval_s = 0.5;
    const hs_env *env = &sim->env;
    const double now_s = sim->timer.last_s; /* the end of the step */
    const int64_t n_done = env->step - env->first_step, n_steps = env->last_step - env->first_step;
    if (env->out->screen == NULL || n_done <= 0 || now_s - sim->thermo->last_progress_s < interval_s) return;
    sim->thermo->last_progress_s = now_s;
    const double elapsed_s = now_s - sim->timer.start_s;
    if (elapsed_s < interval_s) return; /* a short run needs none */
    const double steps_per_s = (double)n_done / elapsed_s;
    const int64_t left_s = (int64_t)((double)(n_steps - n_done) / steps_per_s + 0.5);
    hs_progress(env->out,
                "step %lld of %lld  %5.1f%%  %.4g steps/s  %.4g million atom-steps/s  %lld:%02lld:%02lld left",
                (long long)env->step, (long long)env->last_step, 100.0 * (double)n_done / (double)n_steps, steps_per_s,
                1e-6 * steps_per_s * (double)sim->atoms.n_all, (long long)(left_s / 3600),
                (long long)(left_s / 60 % 60), (long long)(left_s % 60));
}
