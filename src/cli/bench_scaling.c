/* halfshell bench scaling: strong and weak scaling over ranks and threads of a liquid that fills its box and of a droplet in an
   empty one. Every point is a run of its own. */
#include "cli/bench_scaling.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "io/figure.h"
#include "io/writer.h"

enum { POINTS_MAX = 4 * HS_SCALING_COUNTS_MAX * HS_SCALING_COUNTS_MAX };

static hs_status read_count(const char *option, const char *word, int64_t max, int64_t *value, hs_error *err)
{
    if (hs_text_to_int64(word, value) && *value >= 1 && *value <= max) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a whole number from 1 to %lld", option, word, (long long)max);
}

static hs_status read_counts(const char *option, const char *list, int counts[HS_SCALING_COUNTS_MAX], int *n,
                             hs_error *err)
{
    char copy[256];
    if (snprintf(copy, sizeof copy, "%s", list) >= (int)sizeof copy)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the list is too long", option);
    char *rest = copy;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) {
        int64_t value;
        HS_TRY(read_count(option, word, 1000000, &value, err));
        if (*n == HS_SCALING_COUNTS_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "%s: more than %d counts", option, HS_SCALING_COUNTS_MAX);
        counts[(*n)++] = (int)value;
    }
    return HS_OK;
}

/** 1, 2, 4, ... and all cores. */
static void take_powers(int counts[HS_SCALING_COUNTS_MAX], int *n)
{
    const int n_cores = hs_threads_available();
    for (int k = 1; k < n_cores && *n < HS_SCALING_COUNTS_MAX - 1; k *= 2) counts[(*n)++] = k;
    counts[(*n)++] = n_cores;
}

static hs_status parse(const hs_cli *cli, hs_scaling_request *r, hs_error *err)
{
    *r = (hs_scaling_request){.out = "scaling", .size = 40, .steps = 100, .repeat = 3};
    for (int i = 1; i < cli->n; i += 2) {
        const hs_cli_option *option;
        hs_options ignored = {0};
        const char *value = i + 1 < cli->n ? cli->word[i + 1] : NULL;
        HS_TRY(hs_cli_find_option(cli->word[i], HS_CLI_BENCH, &option, err));
        const char *name = option->name;
        if (value == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", cli->word[i], option->values);
        if (strcmp(name, "-out") == 0) {
            r->out = value;
        } else if (strcmp(name, "-size") == 0) {
            HS_TRY(read_count(name, value, 1000, &r->size, err));
        } else if (strcmp(name, "-steps") == 0) {
            HS_TRY(read_count(name, value, 1000000000, &r->steps, err));
        } else if (strcmp(name, "-repeat") == 0) {
            HS_TRY(read_count(name, value, 1000, &r->repeat, err));
        } else if (strcmp(name, "-ranks") == 0) {
            HS_TRY(read_counts(name, value, r->ranks, &r->n_ranks, err));
        } else if (strcmp(name, "-threads") == 0) {
            HS_TRY(read_counts(name, value, r->threads, &r->n_threads, err));
        } else if (strcmp(name, "-precision") == 0) {
            HS_TRY(hs_cli_parse_precision(r->precision = value, &ignored, err));
        } else if (strcmp(name, "-reproducible") == 0) {
            HS_TRY(hs_cli_parse_reproducible(r->reproducible = value, &ignored, err));
        } else if (strcmp(name, "-isa") == 0) {
            HS_TRY(hs_cli_parse_isa(r->isa = value, &ignored, err));
        } else {
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s is not for 'halfshell bench scaling', which knows -ranks, -threads, -size, -steps, "
                           "-repeat, -precision, -reproducible, -isa and -out",
                           name);
        }
    }
    if (r->n_ranks == 0) take_powers(r->ranks, &r->n_ranks);
    if (r->n_threads == 0) take_powers(r->threads, &r->n_threads);
    return HS_OK;
}

/** Steps a second by one rank with one thread, from its own first point, which every series begins with. */
static void judge(hs_scaling_point *all, int n)
{
    for (int k = 0; k < n; ++k)
        for (int first = 0; first < n; ++first) {
            const hs_scaling_point *one = &all[first];
            if (one->ranks * one->threads != 1 || one->is_droplet != all[k].is_droplet ||
                one->is_weak != all[k].is_weak)
                continue;
            all[k].efficiency =
                one->seconds / one->n_atoms * all[k].n_atoms / (all[k].seconds * all[k].ranks * all[k].threads);
        }
}

static double speed_of(const hs_scaling_request *r, const hs_scaling_point *p)
{
    return 1e-6 * p->n_atoms * (double)r->steps / p->seconds;
}

static hs_status write_csv(const hs_scaling_request *r, const hs_scaling_point *all, int n, hs_error *err)
{
    hs_text path = {0};
    hs_writer *csv = NULL;
    hs_status status = hs_text_printf(&path, err, "%s/scaling.csv", r->out);
    if (status == HS_OK) status = hs_writer_open(&csv, hs_text_get(&path), HS_WRITE_WHOLE, err);
    if (status == HS_OK)
        status =
            hs_writer_printf(csv, err,
                             "scaling,system,ranks,threads,atoms,steps,seconds,million_atom_steps_per_s,efficiency,"
                             "pair_s,neigh_s,comm_s,output_s,modify_s,pack_s,wait_s,unpack_s,agree_s,exchange_s,"
                             "imbalance,halo_atoms,bytes_forward_per_step,bytes_back_per_step,messages_per_step\n");
    for (int k = 0; k < n && status == HS_OK; ++k) {
        const hs_scaling_point *p = &all[k];
        status = hs_writer_printf(csv, err,
                                  "%s,%s,%d,%d,%.0f,%lld,%.6g,%.5g,%.4f,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%."
                                  "5g,%.4f,%.6g,%.6g,%.6g,%.4g\n",
                                  hs_scaling_kind_of(p), hs_scaling_system_of(p), p->ranks, p->threads, p->n_atoms,
                                  (long long)r->steps, p->seconds, speed_of(r, p), p->efficiency, p->phase_s[0],
                                  p->phase_s[1], p->phase_s[2], p->phase_s[3], p->phase_s[4], p->comm_s[0],
                                  p->comm_s[1], p->comm_s[2], p->comm_s[3], p->comm_s[4], p->imbalance, p->halo_atoms,
                                  p->bytes_forward, p->bytes_back, p->n_messages);
    }
    if (status == HS_OK) status = hs_writer_close(&csv, err);
    hs_writer_abandon(&csv);
    hs_text_fini(&path);
    return status;
}

/** Efficiency over workers, from 0 on, so that small losses look small: a curve for each system and number of threads. */
static hs_status draw(const hs_scaling_request *r, const hs_scaling_point *all, int n, bool is_weak, hs_error *err)
{
    hs_figure figure = {.style = HS_FIGURE_LINES_AND_POINTS,
                        .is_log_x = true,
                        .has_y_range = true,
                        .y_range = {0.0, 1.1},
                        .width = 800,
                        .height = 480};
    double x[HS_SCALING_COUNTS_MAX], y[HS_SCALING_COUNTS_MAX];
    hs_text path = {0};
    char title[64];
    hs_status status = hs_memory_replace(
        &figure.title,
        is_weak ? "Weak scaling: as many atoms for each core" : "Strong scaling: the same atoms on more cores", err);
    if (status == HS_OK) status = hs_memory_replace(&figure.x_label, "ranks x threads", err);
    for (int is_droplet = 0; is_droplet < 2; ++is_droplet)
        for (int t = 0; t < r->n_threads && status == HS_OK; ++t) {
            hs_curve curve = {.x = x, .y = y};
            for (int k = 0; k < n; ++k) {
                const hs_scaling_point *p = &all[k];
                if (p->is_weak != is_weak || p->is_droplet != is_droplet || p->threads != r->threads[t]) continue;
                x[curve.n] = p->ranks * p->threads;
                y[curve.n++] = p->efficiency;
                figure.y_range[1] = fmax(figure.y_range[1], 1.05 * p->efficiency);
            }
            snprintf(title, sizeof title, "%s, %d thread%s a rank", is_droplet ? "droplet" : "uniform", r->threads[t],
                     r->threads[t] == 1 ? "" : "s");
            if (curve.n > 0) status = hs_figure_add_curve(&figure, "efficiency", title, &curve, err);
        }
    if (status == HS_OK) status = hs_text_printf(&path, err, "%s/scaling-%s.png", r->out, is_weak ? "weak" : "strong");
    if (status == HS_OK) status = hs_figure_write(&figure, hs_text_get(&path), err);
    hs_figure_fini(&figure);
    hs_text_fini(&path);
    return status;
}

/** All points, row by row of the table; those that need more cores than there are are left out. */
static hs_status measure_all(const hs_cli *cli, const hs_scaling_request *r, hs_scaling_point *all, int *n,
                             hs_error *err)
{
    const int n_cores = hs_threads_available();
    for (int series = 0; series < 4; ++series)
        for (int t = 0; t < r->n_threads; ++t)
            for (int k = 0; k < r->n_ranks; ++k) {
                hs_scaling_point *p = &all[*n];
                *p = (hs_scaling_point){
                    .is_weak = series % 2, .is_droplet = series / 2, .ranks = r->ranks[k], .threads = r->threads[t]};
                if ((int64_t)p->ranks * p->threads > n_cores || (p->ranks > 1 && !r->has_mpirun)) continue;
                if (*cli->stop_requested) return hs_fail(err, HS_INTERRUPTED, "bench scaling: stopped by a signal");
                HS_TRY(hs_scaling_measure(r, p, err));
                judge(all, ++*n);
                printf("%-7s %-8s %6d %8d %12.0f %10.4f %12.2f %10.3f %7.1f%% %10.3f %14.6g %14.6g\n",
                       hs_scaling_kind_of(p), hs_scaling_system_of(p), p->ranks, p->threads, p->n_atoms, p->seconds,
                       speed_of(r, p), p->efficiency, 100.0 * p->phase_s[HS_PHASE_COMM] / p->seconds, p->imbalance,
                       p->bytes_forward, p->bytes_back);
                fflush(stdout);
            }
    return HS_OK;
}

hs_status hs_cli_bench_scaling(const hs_cli *cli, hs_error *err)
{
    hs_scaling_request r;
    hs_scaling_point *all = NULL;
    int n = 0;
    if (cli->parallel->is_launched)
        return hs_fail(err, HS_ERROR_INPUT, "bench scaling starts mpirun itself: call it without mpirun");
    HS_TRY(parse(cli, &r, err));
    HS_TRY(hs_scaling_prepare(&r, err));
    printf("Lennard-Jones, cutoff 2.5; %lld steps, fastest of %lld; bytes: sent by a rank in a step, mean\n"
           "%-7s %-8s %6s %8s %12s %10s %12s %10s %8s %10s %14s %14s\n",
           (long long)r.steps, (long long)r.repeat, "scaling", "system", "ranks", "threads", "atoms", "seconds",
           "M a-steps/s", "efficiency", "comm", "imbalance", "bytes forward", "bytes back");
    fflush(stdout);
    HS_TRY(HS_ALLOC(all, POINTS_MAX, err));
    hs_status status = measure_all(cli, &r, all, &n, err);
    if (status == HS_OK) status = write_csv(&r, all, n, err);
    for (int is_weak = 0; is_weak < 2 && status == HS_OK && n > 0; ++is_weak) status = draw(&r, all, n, is_weak, err);
    HS_FREE(all);
    return status;
}
