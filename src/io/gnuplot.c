#include "io/gnuplot.h"

#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/** Script, picture and messages go through files without names: no pipe can fill up, whatever their size. */
typedef struct streams {
    FILE *script, *output, *messages;
} streams;

static hs_status open_streams(streams *s, const hs_text *script, hs_error *err)
{
    s->script = tmpfile();
    s->output = tmpfile();
    s->messages = tmpfile();
    if (s->script == NULL || s->output == NULL || s->messages == NULL ||
        fwrite(script->data, 1, script->length, s->script) != script->length || fflush(s->script) != 0)
        return hs_fail(err, HS_ERROR_IO, "a temporary file for gnuplot could not be written: %s", strerror(errno));
    rewind(s->script);
    return HS_OK;
}

static void close_streams(streams *s)
{
    if (s->script != NULL) fclose(s->script);
    if (s->output != NULL) fclose(s->output);
    if (s->messages != NULL) fclose(s->messages);
}

static hs_status read_stream(FILE *stream, hs_text *text, hs_error *err)
{
    char piece[1 << 14];
    size_t n;
    rewind(stream);
    while ((n = fread(piece, 1, sizeof piece, stream)) > 0) HS_TRY(hs_text_append(text, piece, n, err));
    return HS_OK;
}

static int spawn(const streams *s, pid_t *child)
{
    static char program[] = "gnuplot", no_startup_file[] = "-d", standard_input[] = "-";
    char *const words[] = {program, no_startup_file, standard_input, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t plain;
    sigemptyset(&plain);
    sigaddset(&plain, SIGINT);
    sigaddset(&plain, SIGTERM);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigdefault(&attributes, &plain);
    posix_spawn_file_actions_adddup2(&actions, fileno(s->script), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(s->output), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(s->messages), STDERR_FILENO);
    const int code = posix_spawnp(child, program, &actions, &attributes, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return code;
}

/** gnuplot shows the line of the script, a caret, and then the reason, which is the line that is told. */
static hs_status refuse(const streams *s, int status, hs_error *err)
{
    hs_text messages = {0};
    hs_error ignored = {0};
    const char *reason = "";
    if (read_stream(s->messages, &messages, &ignored) == HS_OK && messages.length > 0) {
        char *rest = NULL;
        for (char *line = strtok_r(messages.data, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest))
            if (line[strspn(line, " \t^")] != '\0') reason = line;
    }
    const hs_status failed =
        hs_fail(err, HS_ERROR_RUN, "gnuplot ended with %s %d: %s", WIFSIGNALED(status) ? "signal" : "exit code",
                WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), reason);
    hs_text_fini(&messages);
    return failed;
}

static hs_status run(const streams *s, hs_text *output, hs_error *err)
{
    pid_t child;
    int status;
    const int code = spawn(s, &child);
    if (code == ENOENT)
        return hs_fail(
            err, HS_ERROR_RUN,
            "gnuplot, which draws the plots, is not on the PATH; on Debian or Ubuntu: apt-get install gnuplot-nox");
    if (code != 0) return hs_fail(err, HS_ERROR_RUN, "gnuplot could not be started: %s", strerror(code));
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return hs_fail(err, HS_ERROR_RUN, "gnuplot was lost: %s", strerror(errno));
    if (status != 0) return refuse(s, status, err);
    HS_TRY(read_stream(s->output, output, err));
    return output->length > 0 ? HS_OK : refuse(s, status, err);
}

hs_status hs_gnuplot_run(const hs_text *script, hs_text *output, hs_error *err)
{
    streams s = {0};
    hs_status status = open_streams(&s, script, err);
    if (status == HS_OK) status = run(&s, output, err);
    close_streams(&s);
    return status;
}
