/* halfshell bench kernels: the pair kernels of method `cluster` alone, in every instruction set and form. One
 * thread. */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/timer.h"
#include "cli/bench_liquid.h"
#include "cli/cli.h"
#include "io/writer.h"
#include "kernel/cluster_list.h"
#include "sim/methods.h"

/* A liquid far from its lattice; the kernel's own lists are made from the positions there. */
enum { WARM_UP_STEPS = 200, PEAK_ROUNDS = 1000000 };

/* Operations of lj/cut on the numbers of one pair (pair/lj_cut.c, kernel/cluster_loop.h), where a fused one counts two: the
   distance 8, force/r 7, force and both sums 9; energy and its sum 5, virial and its sums 15. */
enum { FORCE_OPERATIONS = 24, ENERGY_OPERATIONS = 20 };

static const char *const form_names[HS_N_PRECISIONS] = {"double", "mixed", "reproducible"};

typedef struct request {
    int64_t size, repeat;
    const char *out;
    const char *isa; /**< NULL: all of this machine */
} request;

typedef struct sample {
    double ns_per_atom, lanes_per_atom, near_per_atom, share_of_peak;
} sample;

static hs_status parse(const hs_cli *cli, request *r, hs_error *err)
{
    *r = (request){.size = 20, .repeat = 20};
    for (int i = 1; i < cli->n; i += 2) {
        const hs_cli_option *option;
        const char *value = i + 1 < cli->n ? cli->word[i + 1] : NULL;
        HS_TRY(hs_cli_find_option(cli->word[i], HS_CLI_BENCH, &option, err));
        if (value == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", cli->word[i], option->values);
        hs_options unused;
        int64_t *count = strcmp(option->name, "-size") == 0     ? &r->size
                         : strcmp(option->name, "-repeat") == 0 ? &r->repeat
                                                                : NULL;
        if (count != NULL) {
            if (!hs_text_to_int64(value, count) || *count < 1 || *count > 1000)
                return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a whole number from 1 to 1000", option->name,
                               value);
        } else if (strcmp(option->name, "-out") == 0) {
            r->out = value;
        } else if (strcmp(option->name, "-isa") == 0) {
            HS_TRY(hs_cli_parse_isa(value, &unused, err));
            r->isa = value;
        } else {
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s is not for 'halfshell bench kernels', which knows -size, -repeat, -isa and -out",
                           option->name);
        }
    }
    return HS_OK;
}

/** Operations on doubles per second in this instruction set, at best. */
static double measure_peak(hs_isa isa, int64_t repeat)
{
    double best_s = INFINITY, operations = 0.0;
    volatile double result;
    for (int64_t i = 0; i < repeat; ++i) {
        const double start_s = hs_time_now_s();
        result = hs_isa_peak(isa)(PEAK_ROUNDS, &operations);
        best_s = fmin(best_s, hs_time_now_s() - start_s);
    }
    (void)result;
    return operations / best_s;
}

/** Pairs within the cutoff, found by the double loop's rule over the list: what the lanes are for. */
static double count_near(const hs_sim *sim, const hs_cluster_list *list, double cutoff)
{
    const hs_clusters *clusters = &sim->neighbor.clusters;
    int64_t n = 0;
    for (int k = 0; k < list->n_chunks; ++k) {
        const hs_list_chunk *chunk = &list->chunk[k];
        for (int ci = chunk->begin; ci < chunk->end; ++ci)
            for (int e = chunk->start[ci - chunk->begin]; e < chunk->start[ci - chunk->begin + 1]; ++e)
                for (int bit = 0; bit < HS_CLUSTER * HS_CLUSTER; ++bit) {
                    const hs_cluster_entry entry = chunk->entries.entry[e];
                    if ((entry.mask >> bit & 1u) == 0) continue;
                    const int i = clusters->local.entry[ci].first + bit / HS_CLUSTER,
                              j = entry.first + bit % HS_CLUSTER;
                    double r2 = 0.0;
                    for (int axis = 0; axis < 3; ++axis) r2 += pow(sim->atoms.x[axis][i] - sim->atoms.x[axis][j], 2.0);
                    n += r2 < cutoff * cutoff;
                }
    }
    return (double)n;
}

/** Lanes that the kernels compute: of every group of entries, those of the rows that have a pair. */
static double count_lanes(const hs_cluster_list *list, int group)
{
    int64_t n_rows = 0;
    for (int k = 0; k < list->n_chunks; ++k)
        for (int e = 0; e < list->chunk[k].entries.n; e += group)
            n_rows += __builtin_popcount(list->chunk[k].entries.entry[e].mask >> HS_ENTRY_ROWS_SHIFT & 0xfu);
    return (double)n_rows * group * HS_CLUSTER;
}

static hs_status measure_form(hs_sim *sim, const request *r, hs_isa isa, hs_precision form, bool with_energy,
                              double near, double peak, sample *s, hs_error *err)
{
    hs_force_job job = hs_sim_make_job(sim, with_energy);
    hs_cluster_list list = {0};
    hs_force_result result;
    double best_s = INFINITY;
    job.isa = isa;
    job.precision = form;
    const double cutoff = job.cutoff_max;
    job.cutoff_max = cutoff + sim->neighbor.settings.skin;
    hs_status status = hs_cluster_list_build(&list, &sim->forces, &job, err);
    job.cutoff_max = cutoff;
    hs_force_job_set_grid(&job, (hs_fixed_grid){-32, -32}); /* room for forces of 2^18: liquids have less */
    for (int64_t i = 0; i < r->repeat && status == HS_OK; ++i) {
        const double start_s = hs_time_now_s();
        status = hs_force_cluster(&sim->forces, &list, &job, &result, err);
        best_s = fmin(best_s, hs_time_now_s() - start_s);
    }
    if (status == HS_OK) {
        const double n_atoms = sim->atoms.n_local;
        const double lanes = count_lanes(&list, job.evaluator->set[isa][form]->group);
        const double operations = lanes * (FORCE_OPERATIONS + (with_energy ? ENERGY_OPERATIONS : 0));
        /* a vector has twice as many floats as doubles */
        const bool is_wider = form == HS_PRECISION_MIXED && isa != HS_ISA_PORTABLE;
        *s = (sample){.ns_per_atom = best_s / n_atoms * 1e9,
                      .lanes_per_atom = lanes / n_atoms,
                      .near_per_atom = near / n_atoms,
                      .share_of_peak = operations / best_s / (is_wider ? 2.0 * peak : peak)};
    }
    hs_cluster_list_fini(&list);
    return status;
}

static hs_status open_table(const request *r, hs_writer **csv, hs_error *err)
{
    char path[4096];
    if (r->out == NULL) return HS_OK;
    if (mkdir(r->out, 0777) != 0 && errno != EEXIST)
        return hs_fail(err, HS_ERROR_RUN, "-out: cannot make the folder %s: %s", r->out, strerror(errno));
    if (snprintf(path, sizeof path, "%s/kernels.csv", r->out) >= (int)sizeof path)
        return hs_fail(err, HS_ERROR_INPUT, "-out: the name is too long");
    HS_TRY(hs_writer_open(csv, path, HS_WRITE_WHOLE, err));
    return hs_writer_printf(
        *csv, err, "instruction set,form,computed,ns an atom,million pairs/s,lanes an atom,lanes used,share of peak\n");
}

/** All forms of one instruction set, each a line of the table. */
static hs_status measure_isa(hs_sim *sim, const request *r, hs_isa isa, hs_sink *out, hs_writer *csv, hs_error *err)
{
    const double peak = measure_peak(isa, r->repeat);
    hs_force_job job = hs_sim_make_job(sim, false);
    hs_cluster_list list = {0};
    job.isa = isa;
    job.precision = HS_PRECISION_DOUBLE;
    const double cutoff = job.cutoff_max;
    HS_TRY(hs_cluster_list_build(&list, &sim->forces, &job, err));
    const double near = count_near(sim, &list, cutoff);
    hs_cluster_list_fini(&list);
    for (int form = 0; form < HS_N_PRECISIONS; ++form)
        for (int with_energy = 0; with_energy < 2; ++with_energy) {
            sample s;
            HS_TRY(measure_form(sim, r, isa, (hs_precision)form, with_energy, near, peak, &s, err));
            const char *computed = with_energy ? "force, energy, virial" : "force";
            const double pairs = s.near_per_atom / s.ns_per_atom * 1e3, used = s.near_per_atom / s.lanes_per_atom;
            hs_say(out, "%-9s %-13s %-22s %10.1f %15.0f %14.1f %10.2f %13.2f\n", hs_isa_names[isa], form_names[form],
                   computed, s.ns_per_atom, pairs, s.lanes_per_atom, used, s.share_of_peak);
            if (csv != NULL)
                HS_TRY(hs_writer_printf(csv, err, "%s,%s,\"%s\",%.2f,%.1f,%.2f,%.4f,%.4f\n", hs_isa_names[isa],
                                        form_names[form], computed, s.ns_per_atom, pairs, s.lanes_per_atom, used,
                                        s.share_of_peak));
            if (out->screen != NULL) fflush(out->screen);
        }
    return HS_OK;
}

hs_status hs_cli_bench_kernels(const hs_cli *cli, hs_error *err)
{
    request r;
    HS_TRY(parse(cli, &r, err));
    hs_sink silent = {0}, out = {.screen = cli->parallel->rank == 0 ? stdout : NULL};
    hs_options options = {.n_threads = 1};
    snprintf(options.neighbor_method, sizeof options.neighbor_method, "cluster");
    HS_TRY(hs_cli_parse_reproducible("off", &options, err));
    hs_writer *csv = NULL;
    hs_deck *deck = NULL;
    char warm_up[32];
    snprintf(warm_up, sizeof warm_up, "run %d", WARM_UP_STEPS);
    hs_status status = hs_deck_create(&deck, &options, &silent, err);
    if (status == HS_OK) status = hs_bench_feed_liquid(deck, r.size, err);
    if (status == HS_OK) status = hs_deck_command(deck, warm_up, err);
    if (status == HS_OK) status = open_table(&r, &csv, err);
    if (status == HS_OK) {
        hs_say(&out,
               "Pair kernels of lj/cut on a liquid, %lld atoms, density 0.8442, cutoff 2.5, lists to 2.8; one thread, "
               "fastest of %lld\nLanes used: pairs within the cutoff. Share of peak: of multiplications and additions "
               "side by side.\n\n",
               (long long)(4 * r.size * r.size * r.size), (long long)r.repeat);
        hs_say(&out, "%-9s %-13s %-22s %10s %15s %14s %10s %13s\n", "isa", "form", "computed", "ns/atom",
               "million pairs/s", "lanes an atom", "lanes used", "share of peak");
    }
    for (int isa = 0; isa <= (int)hs_isa_best() && status == HS_OK; ++isa)
        if (r.isa == NULL || strcmp(r.isa, "auto") == 0 ? r.isa == NULL || isa == (int)hs_isa_best()
                                                        : strcmp(r.isa, hs_isa_names[isa]) == 0)
            status = measure_isa(deck->sim, &r, (hs_isa)isa, &out, csv, err);
    if (status == HS_OK && csv != NULL)
        status = hs_writer_close(&csv, err);
    else
        hs_writer_abandon(&csv);
    hs_deck_destroy(&deck);
    return status;
}
