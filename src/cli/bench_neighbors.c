/* halfshell bench neighbors: what each neighbor method costs, as tables, CSV files and pictures. One thread. */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "base/timer.h"
#include "cli/bench_experiments.h"
#include "cli/cli.h"
#include "io/figure.h"
#include "io/writer.h"
#include "sim/methods.h"

enum { ATOM_STEPS = 200000, STEPS_MIN = 5, STEPS_MAX = 200, WARM_UP_STEPS = 5, NAMES_MAX = 16 };

typedef struct request {
    const char *out; /**< folder for files; NULL: tables on the screen only */
    bool is_chosen[NAMES_MAX];
    int64_t repeat;
    hs_options options;
} request;

/** Samples of an experiment: [series][x]. */
typedef struct results {
    hs_bench_sample sample[HS_BENCH_SERIES_MAX][HS_BENCH_POINTS_MAX];
} results;

static hs_status choose(request *r, const char *list, hs_error *err)
{
    const char *names[NAMES_MAX];
    size_t n_names = 0;
    while (hs_bench_experiments[n_names].name != NULL) {
        names[n_names] = hs_bench_experiments[n_names].name;
        ++n_names;
    }
    char copy[256];
    if (snprintf(copy, sizeof copy, "%s", list) >= (int)sizeof copy)
        return hs_fail(err, HS_ERROR_INPUT, "-only: the list is too long");
    char *rest = copy;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) {
        size_t k = 0;
        while (k < n_names && strcmp(names[k], word) != 0) ++k;
        if (k == n_names) {
            const char *nearest = hs_text_nearest(word, names, n_names);
            return hs_fail(err, HS_ERROR_INPUT,
                           "-only: '%s' is not one of size, density, emptiness, temperature, order, cells%s%s%s", word,
                           nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                           nearest != NULL ? "'?" : "");
        }
        r->is_chosen[k] = true;
    }
    return HS_OK;
}

static hs_status parse(const hs_cli *cli, request *r, hs_error *err)
{
    *r = (request){.repeat = 3, .options = {.n_threads = 1}};
    bool is_any_chosen = false;
    for (int i = 1; i < cli->n; i += 2) {
        const hs_cli_option *option;
        const char *value = i + 1 < cli->n ? cli->word[i + 1] : NULL;
        HS_TRY(hs_cli_find_option(cli->word[i], HS_CLI_BENCH, &option, err));
        const char *name = option->name;
        if (value == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", cli->word[i], option->values);
        if (strcmp(name, "-out") == 0) {
            r->out = value;
        } else if (strcmp(name, "-only") == 0) {
            HS_TRY(choose(r, value, err));
            is_any_chosen = true;
        } else if (strcmp(name, "-repeat") == 0) {
            if (!hs_text_to_int64(value, &r->repeat) || r->repeat < 1 || r->repeat > 1000)
                return hs_fail(err, HS_ERROR_INPUT, "-repeat: '%s' is not a whole number from 1 to 1000", value);
        } else if (strcmp(name, "-precision") == 0) {
            HS_TRY(hs_cli_parse_precision(value, &r->options, err));
        } else if (strcmp(name, "-isa") == 0) {
            HS_TRY(hs_cli_parse_isa(value, &r->options, err));
        } else {
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s is for 'halfshell bench'; 'halfshell bench neighbors' knows -out, -only, -repeat, "
                           "-precision and -isa",
                           name);
        }
    }
    for (int k = 0; k < NAMES_MAX && !is_any_chosen; ++k) r->is_chosen[k] = true;
    return HS_OK;
}

/** Atoms in random order in memory: as after a long run, or as a careless program creates them. */
static hs_status shuffle(hs_atoms *atoms, hs_error *err)
{
    int32_t *order = NULL;
    uint64_t state = 20260101; /* a linear congruential generator with Knuth's MMIX constants is random enough */
    HS_TRY(HS_ALLOC(order, (size_t)atoms->n_local, err));
    for (int i = 0; i < atoms->n_local; ++i) order[i] = i;
    for (int i = atoms->n_local - 1; i > 0; --i) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        const int j = (int)((state >> 33) % (uint64_t)(i + 1));
        const int32_t other = order[j];
        order[j] = order[i];
        order[i] = other;
    }
    const hs_status status = hs_atoms_permute(atoms, order, err);
    HS_FREE(order);
    return status;
}

static hs_status set_up(hs_deck *deck, const hs_bench_case *c, hs_error *err)
{
    hs_text text = {0};
    const double edge = (double)c->size * cbrt(c->emptiness);
    hs_status status =
        hs_text_printf(&text, err,
                       "units lj\nlattice fcc %.17g\nregion atoms block 0 %d 0 %d 0 %d\n"
                       "region box block 0 %.17g 0 %.17g 0 %.17g\ncreate_box 1 box\n"
                       "create_atoms 1 region atoms\nmass 1 1.0\n"
                       "velocity all create %.17g 87287 loop geom\npair_style lj/cut 2.5\n"
                       "pair_coeff 1 1 1.0 1.0 2.5\nneighbor 0.3 bin\n"
                       "neigh_modify delay 0 every 1 check yes\nfix 1 all nve\ntimestep 0.002\n"
                       "thermo 1000000000\nneighbor_method %s",
                       c->density, c->size, c->size, c->size, edge, edge, edge, c->temperature, c->method);
    if (status == HS_OK && c->cell > 0.0) status = hs_text_printf(&text, err, " cell %.17g", c->cell);
    char *rest = status == HS_OK ? text.data : NULL;
    for (char *line = strsep(&rest, "\n"); line != NULL && status == HS_OK; line = strsep(&rest, "\n"))
        status = hs_deck_command(deck, line, err);
    hs_text_fini(&text);
    if (status == HS_OK && c->is_shuffled) status = shuffle(&deck->sim->atoms, err);
    char warm_up[32];
    snprintf(warm_up, sizeof warm_up, "run %d", WARM_UP_STEPS);
    return status == HS_OK ? hs_deck_command(deck, warm_up, err) : status;
}

/** One run; the fastest of all counts. Processor time, so that other programs disturb little. */
static hs_status run_once(hs_deck *deck, const hs_bench_case *c, hs_bench_sample *sample, hs_error *err)
{
    hs_chains *chains = &deck->sim->neighbor.chains;
    const double n_atoms = (double)hs_bench_n_atoms(c);
    const int n_steps = (int)fmin(fmax(ATOM_STEPS / n_atoms, STEPS_MIN), STEPS_MAX);
    char run[48];
    snprintf(run, sizeof run, "run %d pre no post no", n_steps);
    chains->n_checked = chains->n_changed = 0;
    const double start_s = hs_time_cpu_s();
    HS_TRY(hs_deck_command(deck, run, err));
    const double scale = 1e9 / (n_steps * n_atoms);
    sample->total_ns = fmin(sample->total_ns, (hs_time_cpu_s() - start_s) * scale);
    sample->cells_ns = fmin(sample->cells_ns, deck->sim->timer.phase_s[HS_PHASE_NEIGH] * scale);
    if (hs_sim_method(deck->sim)->options & HS_METHOD_TAKES_STENCIL) {
        sample->bytes = (double)hs_chains_memory(chains) / n_atoms;
        sample->stencil = chains->grid.n_stencil;
    }
    if (chains->n_checked > 0) sample->changed = 100.0 * (double)chains->n_changed / (double)chains->n_checked;
    return HS_OK;
}

/** The system and the method of one place in the table; false where the series has none. */
static bool case_of(const hs_bench_experiment *e, int series, int x, hs_bench_case *c)
{
    *c = (hs_bench_case){
        .size = 10, .density = 0.8442, .emptiness = 1.0, .temperature = 1.44, .method = e->series[series].method};
    e->set(c, e->x[x]);
    return e->series[series].n_atoms_max == 0 || hs_bench_n_atoms(c) <= e->series[series].n_atoms_max;
}

/** All series at one place of the horizontal axis: they take turns, so that a change of the machine's speed meets
 *  all. */
static hs_status run_point(const hs_cli *cli, const request *r, const hs_bench_experiment *e, int x, results *found,
                           hs_error *err)
{
    hs_sink silent = {0};
    hs_deck *deck[HS_BENCH_SERIES_MAX] = {NULL};
    hs_bench_case c;
    hs_status status = HS_OK;
    for (int s = 0; e->series[s].name != NULL && status == HS_OK; ++s) {
        found->sample[s][x] = (hs_bench_sample){NAN, NAN, NAN, NAN, NAN}; /* fmin takes the other number */
        if (!case_of(e, s, x, &c)) continue;
        status = hs_deck_create(&deck[s], &r->options, &silent, err);
        if (status != HS_OK) break;
        deck[s]->sim->stop_requested = cli->stop_requested;
        status = set_up(deck[s], &c, err);
    }
    for (int64_t i = 0; i < r->repeat && status == HS_OK; ++i)
        for (int s = 0; e->series[s].name != NULL && status == HS_OK; ++s)
            if (case_of(e, s, x, &c)) status = run_once(deck[s], &c, &found->sample[s][x], err);
    for (int s = 0; s < HS_BENCH_SERIES_MAX; ++s) hs_deck_destroy(&deck[s]);
    return status;
}

static hs_status run_experiment(const hs_cli *cli, const request *r, const hs_bench_experiment *e, results *found,
                                hs_error *err)
{
    for (int x = 0; x < e->n_x; ++x) HS_TRY(run_point(cli, r, e, x, found, err));
    return HS_OK;
}

static double value_of(const results *found, const hs_bench_metric *metric, int series, int x)
{
    return *(const double *)((const char *)&found->sample[series][x] + metric->offset);
}

/** Whether a series has any value of a metric: only then it is shown. */
static bool has_values(const hs_bench_experiment *e, const results *found, const hs_bench_metric *metric, int series)
{
    for (int k = 0; k < e->n_x; ++k)
        if (!isnan(value_of(found, metric, series, k))) return true;
    return false;
}

/** The table in Markdown. */
static void say_table(const hs_bench_experiment *e, const results *found, const hs_bench_metric *metric)
{
    printf("\n### %s%s\n\n%s: %s\n\n| %s |", e->name, metric->suffix, e->title, metric->label, e->x_label);
    for (int s = 0; e->series[s].name != NULL; ++s)
        if (has_values(e, found, metric, s)) printf(" %s |", e->series[s].name);
    printf("\n|---|");
    for (int s = 0; e->series[s].name != NULL; ++s)
        if (has_values(e, found, metric, s)) printf("---|");
    for (int k = 0; k < e->n_x; ++k) {
        printf("\n| %g |", e->x[k]);
        for (int s = 0; e->series[s].name != NULL; ++s) {
            const double value = value_of(found, metric, s, k);
            if (!has_values(e, found, metric, s)) continue;
            if (isnan(value))
                printf(" |");
            else
                printf(value < 10.0 ? " %.2g |" : " %.0f |", value);
        }
    }
    printf("\n");
    fflush(stdout);
}

static hs_status write_csv(const hs_bench_experiment *e, const results *found, const hs_bench_metric *metric,
                           const char *path, hs_error *err)
{
    hs_writer *csv;
    HS_TRY(hs_writer_open(&csv, path, HS_WRITE_WHOLE, err));
    hs_status status = hs_writer_printf(csv, err, "%s", e->x_name);
    for (int s = 0; e->series[s].name != NULL && status == HS_OK; ++s)
        if (has_values(e, found, metric, s)) status = hs_writer_printf(csv, err, ",\"%s\"", e->series[s].name);
    for (int k = 0; k < e->n_x && status == HS_OK; ++k) {
        status = hs_writer_printf(csv, err, "\n%g", e->x[k]);
        for (int s = 0; e->series[s].name != NULL && status == HS_OK; ++s)
            if (has_values(e, found, metric, s))
                status = hs_writer_printf(csv, err, ",%.4g", value_of(found, metric, s, k));
    }
    if (status == HS_OK) status = hs_writer_printf(csv, err, "\n");
    if (status == HS_OK) return hs_writer_close(&csv, err);
    hs_writer_abandon(&csv);
    return status;
}

static hs_status draw(const hs_bench_experiment *e, const results *found, const hs_bench_metric *metric,
                      const char *path, hs_error *err)
{
    hs_figure figure = {.style = HS_FIGURE_LINES_AND_POINTS,
                        .is_log_x = !e->is_linear_x,
                        .is_log_y = !metric->is_linear,
                        .width = 800,
                        .height = 480};
    double x[HS_BENCH_POINTS_MAX], y[HS_BENCH_POINTS_MAX];
    hs_status status = hs_memory_replace(&figure.title, e->title, err);
    if (status == HS_OK) status = hs_memory_replace(&figure.x_label, e->x_label, err);
    for (int s = 0; e->series[s].name != NULL && status == HS_OK; ++s) {
        hs_curve points = {.x = x, .y = y};
        for (int k = 0; k < e->n_x; ++k) {
            const double value = value_of(found, metric, s, k);
            if (isnan(value) || (figure.is_log_y && value <= 0.0)) continue;
            x[points.n] = e->x[k];
            y[points.n++] = value;
        }
        if (points.n > 0) status = hs_figure_add_curve(&figure, metric->label, e->series[s].name, &points, err);
    }
    if (status == HS_OK) status = hs_figure_write(&figure, path, err);
    hs_figure_fini(&figure);
    return status;
}

static hs_status write_files(const request *r, const hs_bench_experiment *e, const results *found,
                             const hs_bench_metric *metric, hs_error *err)
{
    hs_text path = {0};
    hs_status status = hs_text_printf(&path, err, "%s/neighbors-%s%s.csv", r->out, e->name, metric->suffix);
    if (status == HS_OK) status = write_csv(e, found, metric, hs_text_get(&path), err);
    if (status == HS_OK && metric->is_drawn) {
        hs_text_clear(&path);
        status = hs_text_printf(&path, err, "%s/neighbors-%s%s.png", r->out, e->name, metric->suffix);
        if (status == HS_OK) status = draw(e, found, metric, hs_text_get(&path), err);
    }
    hs_text_fini(&path);
    return status;
}

hs_status hs_cli_bench_neighbors(const hs_cli *cli, hs_error *err)
{
    request r;
    HS_TRY(parse(cli, &r, err));
    if (r.out != NULL && mkdir(r.out, 0777) != 0 && errno != EEXIST)
        return hs_fail(err, HS_ERROR_IO, "-out: the folder '%s' cannot be made: %s", r.out, strerror(errno));
    results *found = NULL;
    HS_TRY(HS_ALLOC(found, 1, err));
    printf("Neighbor methods on one thread, Lennard-Jones, cutoff 2.5; fastest of %lld runs each\n",
           (long long)r.repeat);
    hs_status status = HS_OK;
    for (int k = 0; hs_bench_experiments[k].name != NULL && status == HS_OK; ++k) {
        const hs_bench_experiment *e = &hs_bench_experiments[k];
        if (!r.is_chosen[k]) continue;
        status = run_experiment(cli, &r, e, found, err);
        for (int m = 0; m < e->n_metrics && status == HS_OK; ++m) {
            say_table(e, found, &e->metric[m]);
            if (r.out != NULL) status = write_files(&r, e, found, &e->metric[m], err);
        }
    }
    HS_FREE(found);
    return status;
}
