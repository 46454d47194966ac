/* A rank that is killed can tell nobody, and its launcher only knows a signal: mpirun says "exited on signal 9" and returns 137. The process
 * that a launcher starts therefore makes another one, which is the rank, and waits for it. It passes signals on, ends as the rank
 * ends, and tells what happened to one that was killed. When it is killed itself, the rank goes with it. */
#define _GNU_SOURCE
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/cli.h"

static const int passed_on[] = {SIGINT, SIGTERM, SIGHUP};
enum { N_PASSED_ON = sizeof passed_on / sizeof passed_on[0] };

static volatile sig_atomic_t is_asked_to_end;
static volatile pid_t rank_process;

static void pass_on(int number)
{
    const int before = errno;
    is_asked_to_end = 1;
    kill(rank_process, number);
    errno = before;
}

/** Wait for the rank; returns its exit code, or 2 when it was killed, but not by whoever ends all ranks. */
static int await_end(void)
{
    int state = 0;
    while (waitpid(rank_process, &state, 0) < 0)
        if (errno != EINTR) return hs_exit_code(HS_ERROR_RUN);
    if (!WIFSIGNALED(state)) return WEXITSTATUS(state);
    const int number = WTERMSIG(state);
    if (is_asked_to_end) return 128 + number;
    hs_error err = {0};
    (void)hs_fail(&err, HS_ERROR_RUN,
                  "rank %s (process %ld) was ended by signal %d (%s)%s. All ranks stop; what "
                  "'checkpoint' or 'restart' of the deck has written, or the automatic checkpoint, can be resumed",
                  hs_parallel_launched_rank(), (long)rank_process, number, strsignal(number),
                  number == SIGKILL ? ", as the system does where memory runs out" : "");
    hs_error_print(&err, stderr);
    return hs_exit_code(err.status);
}

/** Who looks for ranks by name finds ranks: no name, and no arguments. */
static void hide(char **argv)
{
    (void)prctl(PR_SET_NAME, "rank watch");
    for (char **word = argv; *word != NULL; ++word) memset(*word, 0, strlen(*word));
}

static void watch(char **argv)
{
    for (int k = 0; k < N_PASSED_ON; ++k) {
        struct sigaction action, before;
        memset(&action, 0, sizeof action);
        action.sa_handler = pass_on;
        sigemptyset(&action.sa_mask);
        if (sigaction(passed_on[k], NULL, &before) == 0 && before.sa_handler == SIG_IGN) continue; /* nohup */
        sigaction(passed_on[k], &action, NULL);
    }
    hide(argv);
}

/** The number of this process, for it and what it starts in its place. */
static const char mark[] = "HALFSHELL_WATCHED";

/** Whether this process is a rank that is watched already: the program starts itself anew, see main.c. */
static bool is_watched(void)
{
    const char *marked = getenv(mark);
    return marked != NULL && strtol(marked, NULL, 10) == (long)getpid();
}

static void be_rank(pid_t watcher)
{
    char number[24];
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != watcher) (void)raise(SIGKILL); /* it was gone before that */
    snprintf(number, sizeof number, "%ld", (long)getpid());
    (void)setenv(mark, number, 1);
}

bool hs_cli_watch_rank(char **argv, int *exit_code)
{
    sigset_t passed, before;
    if (!hs_parallel_is_launched() || is_watched()) return false;
    sigemptyset(&passed);
    for (int k = 0; k < N_PASSED_ON; ++k) sigaddset(&passed, passed_on[k]);
    sigprocmask(SIG_BLOCK, &passed, &before); /* until it is known to whom they go */
    const pid_t watcher = getpid(), made = fork();
    if (made == 0) be_rank(watcher);
    if (made > 0) {
        rank_process = made;
        watch(argv);
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (made <= 0) return false; /* without another process the run is right all the same */
    *exit_code = await_end();
    return true;
}

pid_t hs_cli_watcher(void) { return is_watched() ? getppid() : 0; }
