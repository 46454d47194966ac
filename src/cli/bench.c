/* halfshell bench: the Lennard-Jones liquid of LAMMPS's "in.lj" at every asked thread count and neighbor method. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/timer.h"
#include "cli/bench_liquid.h"
#include "cli/cli.h"
#include "parallel/limits.h"
#include "sim/methods.h"

enum { CASES_MAX = 32, ATOMS_A_CELL = 4, WARM_UP_STEPS = 20, NSQ_ATOMS_MAX = 4000 };

typedef struct bench {
    int64_t size, steps, repeat;
    int threads[CASES_MAX];
    int n_threads;
    const char *method[CASES_MAX]; /**< entries of hs_neighbor_methods */
    int n_methods;
    hs_options options; /**< the instruction set */
} bench;

static hs_status parse_count(const char *option, const char *word, int64_t max, int64_t *value, hs_error *err)
{
    if (hs_text_to_int64(word, value) && *value >= 1 && *value <= max) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a whole number from 1 to %lld", option, word, (long long)max);
}

/** Cut "1,2,4" at its commas: each piece goes to @p piece(). */
static hs_status parse_list(bench *plan, const char *option, const char *list,
                            hs_status (*piece)(bench *plan, const char *word, hs_error *err), hs_error *err)
{
    char copy[256];
    if (snprintf(copy, sizeof copy, "%s", list) >= (int)sizeof copy)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the list is too long", option);
    char *rest = copy;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) HS_TRY(piece(plan, word, err));
    return HS_OK;
}

static hs_status add_threads(bench *plan, const char *word, hs_error *err)
{
    int64_t n;
    HS_TRY(parse_count("-threads", word, HS_THREADS_MAX, &n, err));
    if (plan->n_threads == CASES_MAX) return hs_fail(err, HS_ERROR_INPUT, "-threads: more than %d counts", CASES_MAX);
    plan->threads[plan->n_threads++] = (int)n;
    return HS_OK;
}

static hs_status add_method(bench *plan, const char *word, hs_error *err)
{
    size_t n = 0;
    while (hs_neighbor_methods[n] != NULL && strcmp(hs_neighbor_methods[n], word) != 0) ++n;
    if (hs_neighbor_methods[n] == NULL) {
        const char *nearest = hs_text_nearest(word, hs_neighbor_methods, n);
        return hs_fail(err, HS_ERROR_INPUT, "-neigh: '%s' is not a neighbor method%s%s%s", word,
                       nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                       nearest != NULL ? "'?" : "");
    }
    if (plan->n_methods == CASES_MAX) return hs_fail(err, HS_ERROR_INPUT, "-neigh: more than %d methods", CASES_MAX);
    plan->method[plan->n_methods++] = hs_neighbor_methods[n];
    return HS_OK;
}

static hs_status parse(const hs_cli *cli, bench *plan, hs_error *err)
{
    *plan = (bench){.size = 20, .steps = 100, .repeat = 3};
    for (int i = 0; i < cli->n; i += 2) {
        const hs_cli_option *option;
        const char *value = i + 1 < cli->n ? cli->word[i + 1] : NULL;
        HS_TRY(hs_cli_find_option(cli->word[i], HS_CLI_BENCH, &option, err));
        if (value == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", cli->word[i], option->values);
        if (strcmp(option->name, "-only") == 0 || strcmp(option->name, "-out") == 0)
            return hs_fail(err, HS_ERROR_INPUT, "%s is for 'halfshell bench neighbors'", option->name);
        if (strcmp(option->name, "-ranks") == 0)
            return hs_fail(err, HS_ERROR_INPUT, "-ranks is for 'halfshell bench scaling'");
        if (strcmp(option->name, "-size") == 0) HS_TRY(parse_count("-size", value, 1000, &plan->size, err));
        if (strcmp(option->name, "-steps") == 0) HS_TRY(parse_count("-steps", value, 1000000000, &plan->steps, err));
        if (strcmp(option->name, "-repeat") == 0) HS_TRY(parse_count("-repeat", value, 1000, &plan->repeat, err));
        if (strcmp(option->name, "-threads") == 0) HS_TRY(parse_list(plan, "-threads", value, add_threads, err));
        if (strcmp(option->name, "-precision") == 0) HS_TRY(hs_cli_parse_precision(value, &plan->options, err));
        if (strcmp(option->name, "-reproducible") == 0) HS_TRY(hs_cli_parse_reproducible(value, &plan->options, err));
        if (strcmp(option->name, "-isa") == 0) HS_TRY(hs_cli_parse_isa(value, &plan->options, err));
        if (strcmp(option->name, "-neigh") == 0) HS_TRY(parse_list(plan, "-neigh", value, add_method, err));
    }
    if (plan->n_threads == 0) {
        int n = hs_threads_available();
        plan->threads[plan->n_threads++] = 1;
        if (n > 1) plan->threads[plan->n_threads++] = n;
    }
    const int64_t n_atoms = ATOMS_A_CELL * plan->size * plan->size * plan->size;
    int n_methods = 0;
    for (int k = 0; plan->n_methods == 0 && hs_neighbor_methods[k] != NULL && n_methods < CASES_MAX; ++k) {
        if (strcmp(hs_neighbor_methods[k], "auto") == 0) continue; /* one of the others */
        /* The double loop is the oracle, not a contestant: it would take hours on the larger systems. */
        if (strcmp(hs_neighbor_methods[k], "nsq") == 0 && n_atoms > NSQ_ATOMS_MAX) continue;
        if (hs_methods[k].options & HS_METHOD_TAKES_STENCIL) continue; /* nor are the textbook's: bench neighbors */
        plan->method[n_methods++] = hs_neighbor_methods[k];
    }
    if (n_methods > 0) plan->n_methods = n_methods;
    return HS_OK;
}

/** Fastest of the repeated runs, seconds; and the memory that the simulation holds. */
static hs_status measure(const hs_cli *cli, const bench *plan, int n_threads, const char *method, double *best_s,
                         double *bytes, hs_error *err)
{
    hs_sink silent = {0};
    hs_options options = plan->options;
    options.n_threads = n_threads;
    snprintf(options.neighbor_method, sizeof options.neighbor_method, "%s", method);
    char warm_up[32];
    snprintf(warm_up, sizeof warm_up, "run %d", WARM_UP_STEPS);
    hs_deck *deck = NULL;
    hs_memory_trim(); /* else this one would be made in what the one before it has left */
    const double before = (double)hs_memory_resident();
    hs_status status = hs_deck_create(&deck, &options, &silent, err);
    if (status == HS_OK) {
        deck->sim->stop_requested = cli->stop_requested;
        if (cli->parallel->n_ranks == 1) hs_threads_bind();
        status = hs_bench_feed_liquid(deck, plan->size, err);
        if (status == HS_OK) status = hs_deck_command(deck, warm_up, err);
    }
    char run[48];
    snprintf(run, sizeof run, "run %lld pre no post no", (long long)plan->steps);
    for (int64_t i = 0; i < plan->repeat && status == HS_OK; ++i) {
        const double start_s = hs_time_now_s();
        status = hs_deck_command(deck, run, err);
        const double elapsed_s = hs_time_now_s() - start_s;
        if (i == 0 || elapsed_s < *best_s) *best_s = elapsed_s;
    }
    *bytes = (double)hs_memory_resident() - before;
    hs_deck_destroy(&deck);
    return status;
}

hs_status hs_cli_bench(const hs_cli *cli, hs_error *err)
{
    if (cli->n > 0 && strcmp(cli->word[0], "neighbors") == 0) return hs_cli_bench_neighbors(cli, err);
    if (cli->n > 0 && strcmp(cli->word[0], "kernels") == 0) return hs_cli_bench_kernels(cli, err);
    if (cli->n > 0 && strcmp(cli->word[0], "scaling") == 0) return hs_cli_bench_scaling(cli, err);
    bench plan;
    HS_TRY(parse(cli, &plan, err));
    const double n_atoms = (double)ATOMS_A_CELL * (double)plan.size * (double)plan.size * (double)plan.size;
    hs_sink out = {.screen = cli->parallel->rank == 0 ? stdout : NULL};
    hs_say(&out, "Lennard-Jones liquid, %.0f atoms, density 0.8442, cutoff 2.5; %lld steps, fastest of %lld\n\n",
           n_atoms, (long long)plan.steps, (long long)plan.repeat);
    hs_say(&out, "%-12s %8s %12s %22s %10s %12s\n", "method", "threads", "seconds", "million atom-steps/s", "speed-up",
           "bytes/atom");
    for (int m = 0; m < plan.n_methods; ++m) {
        double first_s = 0.0;
        for (int t = 0; t < plan.n_threads; ++t) {
            double seconds = 0.0, bytes = 0.0;
            HS_TRY(measure(cli, &plan, plan.threads[t], plan.method[m], &seconds, &bytes, err));
            if (t == 0) first_s = seconds;
            hs_say(&out, "%-12s %8d %12.4f %22.3f %10.2f %12.0f\n", plan.method[m], plan.threads[t], seconds,
                   n_atoms * (double)plan.steps / seconds * 1e-6, first_s / seconds, bytes / n_atoms);
            if (out.screen != NULL) fflush(out.screen);
        }
    }
    return HS_OK;
}
