/* The program: arguments, one subcommand, and the only place that exits. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "cli/cli.h"

/** The one thing that a run looks at after every step. */
static volatile sig_atomic_t stop_requested;
/** The process that watches this rank and passes signals on (cli/watch.c), 0: none; and who has asked to stop: it, or another one. */
static pid_t watcher;
static volatile sig_atomic_t has_asked[2];

/** SIGINT and SIGTERM: the first lets the step end and the run save itself; the second stops at once. A launcher that sends one to all
 *  processes of a rank has sent it once, though it comes from the watcher, too. */
static void on_signal(int number, siginfo_t *info, void *context)
{
    const int by_watcher = watcher != 0 && info->si_pid == watcher;
    (void)context;
    if (has_asked[by_watcher]) _exit(128 + number);
    has_asked[by_watcher] = stop_requested = 1;
}

/** SIGHUP: the terminal is gone, and often tells so twice. */
static void on_hangup(int number, siginfo_t *info, void *context)
{
    (void)number, (void)info, (void)context;
    stop_requested = 1;
}

/** SIGPIPE: who reads the output is gone. The write fails, too, and that ends a run as a full disk does, with a checkpoint. */
static void on_broken_pipe(int number, siginfo_t *info, void *context) { (void)number, (void)info, (void)context; }

static void catch_signal(int number, void (*handler)(int, siginfo_t *, void *))
{
    struct sigaction action = {.sa_sigaction = handler, .sa_flags = SA_RESTART | SA_SIGINFO};
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

static bool is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

static void catch_signals(bool is_run)
{
    catch_signal(SIGINT, on_signal);
    catch_signal(SIGTERM, on_signal);
    if (!is_ignored(SIGHUP)) catch_signal(SIGHUP, on_hangup); /* nohup */
    if (is_run) catch_signal(SIGPIPE, on_broken_pipe); /* a handler, which programs that are started do not inherit */
    signal(SIGXFSZ, SIG_IGN); /* a file beyond the limit of the shell: an error of the write, as on a full disk */
}

/** Standard streams that were closed before the start: the next files to be opened would take their numbers, and what is meant for the
 *  screen would go into them. In their places come streams that refuse what is asked of them. */
static void fill_closed_streams(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF)
            (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

static hs_status run_subcommand(const hs_cli *cli, const char *name, int *exit_code, hs_error *err)
{
    if (strcmp(name, "check") == 0) return hs_cli_check(cli, err);
    if (strcmp(name, "bench") == 0) return hs_cli_bench(cli, err);
    if (strcmp(name, "plot") == 0) return hs_cli_plot(cli, err);
    if (strcmp(name, "report") == 0) return hs_cli_report(cli, err);
    if (strcmp(name, "resume") == 0) return hs_cli_resume(cli, exit_code, err);
    if (strcmp(name, "help") == 0) return hs_cli_help(cli, err);
    return hs_cli_run(cli, exit_code, err);
}

static void report(const hs_parallel *parallel, const hs_error *err)
{
    /* The ranks agreed on one error; the first of them tells it. */
    if (parallel->rank != 0) return;
    fflush(stdout);
    hs_error_print(err, stderr);
}

static bool is_word(const char *word, const char *a, const char *b, const char *c)
{
    return strcmp(word, a) == 0 || strcmp(word, b) == 0 || strcmp(word, c) == 0;
}

static bool asks_for_help(const char *word) { return is_word(word, "--help", "-help", "-h"); }

/** The subcommand of that name, or NULL. */
static const hs_cli_command *find_subcommand(const char *name)
{
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command)
        if (strcmp(name, command->name) == 0) return command;
    return NULL;
}

/** GNU OpenMP lets a waiting thread spin for milliseconds. Where ranks have more threads together than there are cores, the
 *  thread that is waited for then gets no core: eight times as long with two ranks of two threads on two cores. Ranks
 *  therefore spin for some 15 to 30 microseconds only. A program of its own binds its threads to cores (hs_threads_bind), so they
 *  do not keep each other off; it spins for 0.2 to 0.5 milliseconds, because to sleep and to be woken costs more than most waits
 *  (docs/scaling.md). The library reads the setting when the program is loaded, so the program starts itself anew, once, and
 *  then forgets it: ranks that it starts (bench scaling) choose for themselves. What the user set is left alone. */
static void limit_spinning(char **argv)
{
    static const char mark[] = "HALFSHELL_STARTED_ANEW"; /* by the process of this number */
    char number[24];
    snprintf(number, sizeof number, "%ld", (long)getpid());
    const char *marked = getenv(mark);
    if (marked != NULL && strcmp(marked, number) == 0) {
        unsetenv("GOMP_SPINCOUNT");
        unsetenv(mark);
        return;
    }
    if (getenv("GOMP_SPINCOUNT") != NULL || getenv("OMP_WAIT_POLICY") != NULL) return;
    if (setenv("GOMP_SPINCOUNT", hs_parallel_is_launched() ? "1000" : "16000", 1) != 0 || setenv(mark, number, 1) != 0)
        return;
    hs_threads_unbind();
    execv("/proc/self/exe", argv); /* names the process "exe": see main */
    /* where that is not possible the run is right all the same */
}

/** What needs no start-up: --help and --version. False: neither was asked for. */
static bool answer(int argc, char **argv, const hs_cli_command *command)
{
    if (argc > 1 && asks_for_help(argv[1])) {
        hs_cli_usage(stdout);
        return true;
    }
    for (int k = 2; k < argc && command != NULL; ++k) {
        if (k == 2 ? !asks_for_help(argv[k]) : strcmp(argv[k], "--help") != 0) continue;
        hs_cli_usage_of(stdout, command);
        return true;
    }
    if (argc <= 1 || !is_word(argv[1], "--version", "-version", "-V")) return false;
    printf("halfshell %s\n", HALFSHELL_VERSION);
    return true;
}

/** Exit code after an answer. */
static int finish_answer(void)
{
    hs_error err = {0};
    if (hs_cli_flush(stdout, "screen output", &err) == HS_OK) return EXIT_SUCCESS;
    hs_error_print(&err, stderr);
    return hs_exit_code(err.status);
}

int main(int argc, char **argv)
{
    const hs_cli_command *command = argc > 1 ? find_subcommand(argv[1]) : NULL;
    fill_closed_streams();
    if (answer(argc, argv, command)) return finish_answer();
    int exit_code = EXIT_SUCCESS;
    if (hs_cli_watch_rank(argv, &exit_code)) return exit_code;
    limit_spinning(argv);
    watcher = hs_cli_watcher();
    (void)prctl(PR_SET_NAME, "halfshell"); /* as top shows it and pkill looks for it */
    const char *name = command != NULL ? command->name : "run";
    const int first = command != NULL ? 2 : 1;
    hs_error err = {0};
    hs_parallel parallel = {.n_ranks = 1};
    hs_cli cli = {.n = argc - first, .word = argv + first, .stop_requested = &stop_requested, .parallel = &parallel};
    catch_signals(command == NULL || command->bit == HS_CLI_RUN || command->bit == HS_CLI_RESUME);
    hs_status status = hs_parallel_init(&parallel, &err);
    if (status == HS_OK) status = run_subcommand(&cli, name, &exit_code, &err);
    HS_UNLESS_FAILED(&err, hs_cli_flush(stdout, "screen output", &err));
    bool stop = stop_requested;
    status = hs_parallel_settle(&parallel, &stop, &err);
    if (status != HS_OK) {
        report(&parallel, &err);
        exit_code = hs_exit_code(status);
    }
    hs_parallel_fini(&parallel);
    return exit_code;
}
