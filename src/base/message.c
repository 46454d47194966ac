#include "base/message.h"

#include <unistd.h>

static void say(FILE *stream, const char *fmt, va_list args)
{
    if (stream == NULL) return;
    va_list copy;
    va_copy(copy, args);
    vfprintf(stream, fmt, copy);
    va_end(copy);
}

void hs_say(hs_sink *sink, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    hs_progress_wipe(sink);
    say(sink->screen, fmt, args);
    say(sink->log, fmt, args);
    va_end(args);
}

void hs_say_screen(hs_sink *sink, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    hs_progress_wipe(sink);
    say(sink->screen, fmt, args);
    va_end(args);
}

void hs_say_log(hs_sink *sink, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    say(sink->log, fmt, args);
    va_end(args);
}

void hs_warn(hs_sink *sink, const char *fmt, ...)
{
    ++sink->n_warnings;
    if (sink->warning_limit < 0 || (sink->warning_limit > 0 && sink->n_warnings > sink->warning_limit)) return;
    va_list args;
    va_start(args, fmt);
    hs_say(sink, "WARNING: ");
    say(sink->screen, fmt, args);
    say(sink->log, fmt, args);
    hs_say(sink, "\n");
    va_end(args);
}

void hs_progress(hs_sink *sink, const char *fmt, ...)
{
    if (sink->no_progress || sink->screen == NULL || !isatty(fileno(sink->screen))) return;
    va_list args;
    va_start(args, fmt);
    fputs("\r\033[K", sink->screen);
    vfprintf(sink->screen, fmt, args);
    fflush(sink->screen);
    sink->progress_shown = true;
    va_end(args);
}

void hs_progress_wipe(hs_sink *sink)
{
    if (!sink->progress_shown) return;
    fputs("\r\033[K", sink->screen);
    sink->progress_shown = false;
}
