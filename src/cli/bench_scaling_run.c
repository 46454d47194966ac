/* Runs of `halfshell bench scaling`, which mpirun starts; decks and logs stay beside the tables. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/bench_scaling.h"
#include "io/writer.h"

extern char **environ;

enum { WARM_UP_STEPS = 40 };

/* Names in the log. */
static const char *const phases[HS_N_PHASES] = {"Pair", "Neigh", "Comm", "Output", "Modify"};
static const char *const parts[HS_N_COMM_PARTS] = {"Pack", "Wait", "Unpack", "Agree", "Exchange"};

const char *hs_scaling_system_of(const hs_scaling_point *p) { return p->is_droplet ? "droplet" : "uniform"; }
const char *hs_scaling_kind_of(const hs_scaling_point *p) { return p->is_weak ? "weak" : "strong"; }

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

static hs_status write_deck(const hs_scaling_request *r, const hs_scaling_point *p, const char *path, hs_error *err)
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

/** The words that start so many ranks, each bound to as many cores as it has threads where that can be done; `count`
 *  and `place` hold numbers in words. Returns how many words there are. */
static int launch_words(const hs_scaling_request *r, int ranks, int threads, char count[32], char place[32],
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

/** Whether mpirun is there, can be used by this user, and this program is built for it: all that it is asked is the
 *  version. Some machines do not let it bind ranks to cores. */
static hs_status try_mpirun(hs_scaling_request *r, hs_error *err)
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

static hs_status run_point(const hs_scaling_request *r, const hs_scaling_point *p, const char *deck, const char *log,
                           const char *said, hs_error *err)
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
static hs_status read_log(const char *path, hs_scaling_point *p, hs_error *err)
{
    char line[512];
    int n_runs = 0;
    hs_scaling_point now = *p;
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

hs_status hs_scaling_prepare(hs_scaling_request *r, hs_error *err)
{
    const ssize_t length = readlink("/proc/self/exe", r->program, sizeof r->program - 1);
    if (length < 0)
        return hs_fail(err, HS_ERROR_RUN, "bench scaling: this program's file cannot be found: %s", strerror(errno));
    r->program[length] = '\0';
    if (mkdir(r->out, 0777) != 0 && errno != EEXIST)
        return hs_fail(err, HS_ERROR_IO, "-out: the folder '%s' cannot be made: %s", r->out, strerror(errno));
    return try_mpirun(r, err);
}

hs_status hs_scaling_measure(const hs_scaling_request *r, hs_scaling_point *p, hs_error *err)
{
    char deck[PATH_MAX], log[PATH_MAX], said[PATH_MAX], name[64];
    snprintf(name, sizeof name, "%s-%s-%dx%d", hs_scaling_kind_of(p), hs_scaling_system_of(p), p->ranks, p->threads);
    if (snprintf(deck, sizeof deck, "%s/%s.in", r->out, name) >= (int)sizeof deck - 8)
        return hs_fail(err, HS_ERROR_INPUT, "-out: the name is too long");
    snprintf(log, sizeof log, "%s/%s.log", r->out, name);
    snprintf(said, sizeof said, "%s/%s.txt", r->out, name);
    HS_TRY(write_deck(r, p, deck, err));
    HS_TRY(run_point(r, p, deck, log, said, err));
    (void)unlink(said);
    return read_log(log, p, err);
}
