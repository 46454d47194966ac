/* halfshell bench scaling: strong and weak scaling over ranks and threads of a liquid that fills its box and of a droplet in an
   empty one. Every point is a run of its own, which mpirun starts; its deck and log stay beside the table. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <spawn.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "io/figure.h"
#include "io/writer.h"

extern char **environ;

enum { COUNTS_MAX = 16, POINTS_MAX = 4 * COUNTS_MAX * COUNTS_MAX, WARM_UP_STEPS = 40 };

typedef struct request {
    const char *out;
    int64_t size, steps, repeat;
    int ranks[COUNTS_MAX], threads[COUNTS_MAX];
    int n_ranks, n_threads;
    const char *precision, *reproducible, *isa; /**< NULL: the default */
    char program[PATH_MAX];
    bool has_mpirun, can_bind;
} request;

/** One run, and what its log tells of the fastest repetition. */
typedef struct point {
    bool is_droplet, is_weak;
    int ranks, threads;
    double n_atoms, seconds, phase_s[HS_N_PHASES], comm_s[HS_N_COMM_PARTS];
    double imbalance;                                         /**< most atoms of a rank / mean */
    double halo_atoms, bytes_forward, bytes_back, n_messages; /**< mean of the ranks, in a step */
    double efficiency;                                        /**< 1: as fast as one rank and thread by workers */
} point;

static const char *const phases[HS_N_PHASES] = {"Pair", "Neigh", "Comm", "Output", "Modify"};
static const char *const parts[HS_N_COMM_PARTS] = {"Pack", "Wait", "Unpack", "Agree", "Exchange"};

static hs_status read_count(const char *option, const char *word, int64_t max, int64_t *value, hs_error *err)
{
    if (hs_text_to_int64(word, value) && *value >= 1 && *value <= max) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a whole number from 1 to %lld", option, word, (long long)max);
}

static hs_status read_counts(const char *option, const char *list, int counts[COUNTS_MAX], int *n, hs_error *err)
{
    char copy[256];
    if (snprintf(copy, sizeof copy, "%s", list) >= (int)sizeof copy)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the list is too long", option);
    char *rest = copy;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) {
        int64_t value;
        HS_TRY(read_count(option, word, 1000000, &value, err));
        if (*n == COUNTS_MAX) return hs_fail(err, HS_ERROR_INPUT, "%s: more than %d counts", option, COUNTS_MAX);
        counts[(*n)++] = (int)value;
    }
    return HS_OK;
}

/** 1, 2, 4, ... and all cores. */
static void take_powers(int counts[COUNTS_MAX], int *n)
{
    const int n_cores = hs_threads_available();
    for (int k = 1; k < n_cores && *n < COUNTS_MAX - 1; k *= 2) counts[(*n)++] = k;
    counts[(*n)++] = n_cores;
}

static hs_status parse(const hs_cli *cli, request *r, hs_error *err)
{
    *r = (request){.out = "scaling", .size = 40, .steps = 100, .repeat = 3};
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
            return hs_fail(
                err, HS_ERROR_INPUT,
                "%s is not for 'halfshell bench scaling', which knows -ranks, -threads, -size, -steps, -repeat, "
                "-precision, -reproducible, -isa and -out",
                name);
        }
    }
    if (r->n_ranks == 0) take_powers(r->ranks, &r->n_ranks);
    if (r->n_threads == 0) take_powers(r->threads, &r->n_threads);
    return HS_OK;
}

/** The same cubes of liquid for any number of workers, piled up as evenly as their number allows. */
static void pile_up(int n, int piles[3])
{
    piles[0] = piles[1] = piles[2] = 1;
    for (int factor = n; factor > 1;) {
        int largest = 2, least = 0;
        for (int rest = factor; rest > 1; ++largest)
            while (rest > 1 && rest % largest == 0) rest /= largest;
        --largest; /* the largest prime factor goes to the shortest edge */
        for (int axis = 1; axis < 3; ++axis)
            if (piles[axis] < piles[least]) least = axis;
        piles[least] *= largest;
        factor /= largest;
    }
}

static hs_status write_deck(const request *r, const point *p, const char *path, hs_error *err)
{
    const int n = p->is_weak ? p->ranks * p->threads : 1;
    hs_writer *deck;
    HS_TRY(hs_writer_open(&deck, path, HS_WRITE_WHOLE, err));
    hs_status status = hs_writer_printf(deck, err, "units lj\nlattice fcc 0.8442\n");
    if (status == HS_OK && p->is_droplet) {
        /* as many atoms, in the lower corner of a box eight times as large */
        const double edge = (double)r->size * cbrt(n), radius = edge * cbrt(3.0 / (4.0 * M_PI));
        status = hs_writer_printf(deck, err,
                                  "region box block 0 %.6f 0 %.6f 0 %.6f\nregion liquid sphere %.6f %.6f %.6f %.6f\n"
                                  "create_box 1 box\ncreate_atoms 1 region liquid\n",
                                  2 * edge, 2 * edge, 2 * edge, 0.65 * edge, 0.7 * edge, 0.75 * edge, radius);
    } else if (status == HS_OK) {
        int piles[3];
        pile_up(n, piles);
        status = hs_writer_printf(
            deck, err, "region box block 0 %lld 0 %lld 0 %lld\ncreate_box 1 box\ncreate_atoms 1 box\n",
            (long long)(piles[0] * r->size), (long long)(piles[1] * r->size), (long long)(piles[2] * r->size));
    }
    if (status == HS_OK)
        status = hs_writer_printf(deck, err,
                                  "mass 1 1.0\nvelocity all create %s 87287 loop geom\npair_style lj/cut 2.5\n"
                                  "pair_coeff 1 1 1.0 1.0 2.5\nneighbor 0.3 bin\n"
                                  "neigh_modify delay 0 every 20 check no\nfix 1 all nve\n%sthermo 100\nrun %d\n",
                                  p->is_droplet ? "1.0" : "1.44",
                                  p->is_droplet ? "balance 1.02 shift xyz 10 1.02\n"
                                                  "fix even all balance 40 1.02 shift xyz 10 1.02 weight time 1.0\n"
                                                : "",
                                  WARM_UP_STEPS);
    for (int64_t i = 0; i < r->repeat && status == HS_OK; ++i)
        status = hs_writer_printf(deck, err, "run %lld\n", (long long)r->steps);
    if (status == HS_OK) return hs_writer_close(&deck, err);
    hs_writer_abandon(&deck);
    return status;
}

/** Start a program with its output in a file, and wait for it. */
static hs_status start(char *const words[], const char *said, hs_error *err)
{
    posix_spawn_file_actions_t actions;
    pid_t child;
    int state = 0;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    const int failure = posix_spawnp(&child, words[0], &actions, NULL, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        return hs_fail(err, HS_ERROR_RUN, "bench scaling: '%s' cannot be started: %s", words[0], strerror(failure));
    while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "bench scaling: a run failed; '%s' tells why", said);
}

enum { LAUNCH_WORDS_MAX = 32 };

/** The words that start so many ranks, each bound to as many cores as it has threads where that can be done; `count` and `place` hold
 *  numbers in words. Returns how many words there are. */
static int launch_words(const request *r, int ranks, int threads, char count[32], char place[32],
                        char *words[LAUNCH_WORDS_MAX])
{
    int n = 0;
    snprintf(count, 32, "%d", ranks);
    snprintf(place, 32, "slot:PE=%d", threads);
    const char *const bound[] = {"mpirun", "--map-by", place, "--bind-to", "core", "-np", count};
    const char *const loose[] = {"mpirun", "--oversubscribe", "--bind-to", "none", "-np", count};
    const char *const *choice = r->can_bind ? bound : loose;
    const size_t n_choice = r->can_bind ? sizeof bound / sizeof bound[0] : sizeof loose / sizeof loose[0];
    for (size_t k = 0; k < n_choice; ++k) words[n++] = (char *)(uintptr_t)choice[k];
    return n;
}

/** Whether mpirun is there, can be used by this user, and this program is built for it: all that it is asked is the version. Some
 *  machines do not let it bind ranks to cores. */
static hs_status try_mpirun(request *r, hs_error *err)
{
    hs_text said = {0};
    hs_error reason = {0};
    HS_TRY(hs_text_printf(&said, err, "%s/mpirun.txt", r->out));
    r->can_bind = true;
    for (;;) {
        char count[32], place[32], *words[LAUNCH_WORDS_MAX];
        int n = launch_words(r, 2, 1, count, place, words);
        words[n++] = r->program;
        words[n++] = (char *)(uintptr_t) "--version";
        words[n] = NULL;
        hs_error_clear(&reason);
        r->has_mpirun = start(words, hs_text_get(&said), &reason) == HS_OK;
        if (r->has_mpirun || !r->can_bind) break;
        r->can_bind = false;
    }
    if (r->has_mpirun)
        (void)unlink(hs_text_get(&said));
    else
        printf("Threads only, for two ranks could not be started: %s\n", reason.text);
    hs_text_fini(&said);
    return HS_OK;
}

static hs_status run_point(const request *r, const point *p, const char *deck, const char *log, const char *said,
                           hs_error *err)
{
    char count[32], place[32], threads[16], *words[LAUNCH_WORDS_MAX];
    int n = p->ranks > 1 ? launch_words(r, p->ranks, p->threads, count, place, words) : 0;
    snprintf(threads, sizeof threads, "%d", p->threads);
    const char *const plain[] = {r->program, "-in", deck, "-log", log, "-screen", "none", "-threads", threads};
    const char *const choices[3][2] = {
        {"-precision", r->precision}, {"-reproducible", r->reproducible}, {"-isa", r->isa}};
    for (size_t k = 0; k < sizeof plain / sizeof plain[0]; ++k) words[n++] = (char *)(uintptr_t)plain[k];
    for (int k = 0; k < 3; ++k) {
        if (choices[k][1] == NULL) continue;
        words[n++] = (char *)(uintptr_t)choices[k][0];
        words[n++] = (char *)(uintptr_t)choices[k][1];
    }
    words[n] = NULL;
    return start(words, said, err);
}

/** The fastest of the measured runs in a log. */
static hs_status read_log(const char *path, point *p, hs_error *err)
{
    char line[512];
    int n_runs = 0;
    point now = *p;
    p->seconds = INFINITY;
    FILE *log = fopen(path, "r");
    if (log == NULL) return hs_fail(err, HS_ERROR_IO, "bench scaling: '%s' cannot be read: %s", path, strerror(errno));
    while (fgets(line, sizeof line, log) != NULL) {
        long long n_steps;
        int procs;
        char name[32];
        double first, mean;
        if (sscanf(line, "Loop time of %lf on %d procs for %lld steps with %lf", &first, &procs, &n_steps, &mean) ==
            4) {
            ++n_runs;
            now.seconds = first;
            now.n_atoms = mean;
            now.imbalance = 1.0;
        } else if (sscanf(line, "%31s | %lf | %lf", name, &first, &mean) == 3) {
            for (int k = 0; k < HS_N_PHASES; ++k)
                if (strcmp(name, phases[k]) == 0) now.phase_s[k] = mean;
            for (int k = 0; k < HS_N_COMM_PARTS; ++k)
                if (strcmp(name, parts[k]) == 0) now.comm_s[k] = mean;
        }
        (void)sscanf(line, "Nghost: %lf", &now.halo_atoms);
        (void)sscanf(line, "Load imbalance (largest/mean) = %lf", &now.imbalance);
        (void)sscanf(line, "Halo traffic = %lf bytes forward, %lf back, %lf", &now.bytes_forward, &now.bytes_back,
                     &now.n_messages);
        if (strncmp(line, "Neighbor list builds", 20) == 0 && n_runs > 1 && now.seconds < p->seconds) *p = now;
    }
    fclose(log);
    if (p->seconds < INFINITY) return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "bench scaling: '%s' tells of no finished run", path);
}

/** Steps a second by one rank with one thread, from its own first point, which every series begins with. */
static void judge(point *all, int n)
{
    for (int k = 0; k < n; ++k)
        for (int first = 0; first < n; ++first) {
            const point *one = &all[first];
            if (one->ranks * one->threads != 1 || one->is_droplet != all[k].is_droplet ||
                one->is_weak != all[k].is_weak)
                continue;
            all[k].efficiency =
                one->seconds / one->n_atoms * all[k].n_atoms / (all[k].seconds * all[k].ranks * all[k].threads);
        }
}

static const char *system_of(const point *p) { return p->is_droplet ? "droplet" : "uniform"; }
static const char *kind_of(const point *p) { return p->is_weak ? "weak" : "strong"; }
static double speed_of(const request *r, const point *p) { return 1e-6 * p->n_atoms * (double)r->steps / p->seconds; }

static hs_status measure(const request *r, point *p, hs_error *err)
{
    char deck[PATH_MAX], log[PATH_MAX], said[PATH_MAX], name[64];
    snprintf(name, sizeof name, "%s-%s-%dx%d", kind_of(p), system_of(p), p->ranks, p->threads);
    if (snprintf(deck, sizeof deck, "%s/%s.in", r->out, name) >= (int)sizeof deck - 8)
        return hs_fail(err, HS_ERROR_INPUT, "-out: the name is too long");
    snprintf(log, sizeof log, "%s/%s.log", r->out, name);
    snprintf(said, sizeof said, "%s/%s.txt", r->out, name);
    HS_TRY(write_deck(r, p, deck, err));
    HS_TRY(run_point(r, p, deck, log, said, err));
    (void)unlink(said);
    return read_log(log, p, err);
}

static hs_status write_csv(const request *r, const point *all, int n, hs_error *err)
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
                             "imbalance,halo_atoms,bytes_forward_per_step,"
                             "bytes_back_per_step,messages_per_step\n");
    for (int k = 0; k < n && status == HS_OK; ++k) {
        const point *p = &all[k];
        status =
            hs_writer_printf(csv, err,
                             "%s,%s,%d,%d,%.0f,%lld,%.6g,%.5g,%.4f,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%."
                             "4f,%.6g,%.6g,%.6g,%.4g\n",
                             kind_of(p), system_of(p), p->ranks, p->threads, p->n_atoms, (long long)r->steps,
                             p->seconds, speed_of(r, p), p->efficiency, p->phase_s[0], p->phase_s[1], p->phase_s[2],
                             p->phase_s[3], p->phase_s[4], p->comm_s[0], p->comm_s[1], p->comm_s[2], p->comm_s[3],
                             p->comm_s[4], p->imbalance, p->halo_atoms, p->bytes_forward, p->bytes_back, p->n_messages);
    }
    if (status == HS_OK) status = hs_writer_close(&csv, err);
    hs_writer_abandon(&csv);
    hs_text_fini(&path);
    return status;
}

/** Efficiency over workers: a curve for each system and number of threads. */
static hs_status draw(const request *r, const point *all, int n, bool is_weak, hs_error *err)
{
    hs_figure figure = {.style = HS_FIGURE_LINES_AND_POINTS, .is_log_x = true, .width = 800, .height = 480};
    double x[COUNTS_MAX], y[COUNTS_MAX];
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
                const point *p = &all[k];
                if (p->is_weak != is_weak || p->is_droplet != is_droplet || p->threads != r->threads[t]) continue;
                x[curve.n] = p->ranks * p->threads;
                y[curve.n++] = p->efficiency;
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
static hs_status measure_all(const request *r, point *all, int *n, hs_error *err)
{
    const int n_cores = hs_threads_available();
    for (int series = 0; series < 4; ++series)
        for (int t = 0; t < r->n_threads; ++t)
            for (int k = 0; k < r->n_ranks; ++k) {
                point *p = &all[*n];
                *p = (point){
                    .is_weak = series % 2, .is_droplet = series / 2, .ranks = r->ranks[k], .threads = r->threads[t]};
                if ((int64_t)p->ranks * p->threads > n_cores || (p->ranks > 1 && !r->has_mpirun)) continue;
                HS_TRY(measure(r, p, err));
                judge(all, ++*n);
                printf("%-7s %-8s %6d %8d %12.0f %10.4f %12.2f %10.3f %7.1f%% %10.3f %14.6g %14.6g\n", kind_of(p),
                       system_of(p), p->ranks, p->threads, p->n_atoms, p->seconds, speed_of(r, p), p->efficiency,
                       100.0 * p->phase_s[HS_PHASE_COMM] / p->seconds, p->imbalance, p->bytes_forward, p->bytes_back);
                fflush(stdout);
            }
    return HS_OK;
}

hs_status hs_cli_bench_scaling(const hs_cli *cli, hs_error *err)
{
    request r;
    point *all = NULL;
    int n = 0;
    if (cli->parallel->is_launched)
        return hs_fail(err, HS_ERROR_INPUT, "bench scaling starts mpirun itself: call it without mpirun");
    HS_TRY(parse(cli, &r, err));
    const ssize_t length = readlink("/proc/self/exe", r.program, sizeof r.program - 1);
    if (length < 0)
        return hs_fail(err, HS_ERROR_RUN, "bench scaling: this program's file cannot be found: %s", strerror(errno));
    r.program[length] = '\0';
    if (mkdir(r.out, 0777) != 0 && errno != EEXIST)
        return hs_fail(err, HS_ERROR_IO, "-out: the folder '%s' cannot be made: %s", r.out, strerror(errno));
    HS_TRY(try_mpirun(&r, err));
    printf("Lennard-Jones, cutoff 2.5; %lld steps, fastest of %lld; bytes: sent by a rank in a step, mean\n"
           "%-7s %-8s %6s %8s %12s %10s %12s %10s %8s %10s %14s %14s\n",
           (long long)r.steps, (long long)r.repeat, "scaling", "system", "ranks", "threads", "atoms", "seconds",
           "M a-steps/s", "efficiency", "comm", "imbalance", "bytes forward", "bytes back");
    fflush(stdout);
    HS_TRY(HS_ALLOC(all, POINTS_MAX, err));
    hs_status status = measure_all(&r, all, &n, err);
    if (status == HS_OK) status = write_csv(&r, all, n, err);
    for (int is_weak = 0; is_weak < 2 && status == HS_OK && n > 0; ++is_weak) status = draw(&r, all, n, is_weak, err);
    HS_FREE(all);
    return status;
}
