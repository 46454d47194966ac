#include "base/error.h"

#include <stdio.h>

hs_status(hs_fail)(hs_error *err, hs_status status, const char *fmt, ...)
{
    if (err->status != HS_OK) return err->status;
    err->status = status;
    va_list args;
    va_start(args, fmt);
    vsnprintf(err->text, sizeof err->text, fmt, args);
    va_end(args);
    return status;
}

void hs_error_locate(hs_error *err, const char *file, long line)
{
    if (err->status == HS_OK || err->file[0] != '\0') return;
    snprintf(err->file, sizeof err->file, "%s", file);
    err->line = line;
}

void hs_error_print(const hs_error *err, FILE *stream)
{
    if (err->file[0] != '\0' && err->line > 0)
        fprintf(stream, "%s:%ld: ", err->file, err->line);
    else
        fprintf(stream, "%s: ", err->file[0] != '\0' ? err->file : "halfshell");
    fprintf(stream, "%s%s\n", err->status == HS_INTERRUPTED ? "" : "error: ", err->text);
}

void hs_error_clear(hs_error *err)
{
    err->status = HS_OK;
    err->rank = 0;
    err->line = 0;
    err->file[0] = err->text[0] = '\0'; /* the rest of the texts is never read, and much to clear */
}

int hs_exit_code(hs_status status)
{
    switch (status) {
    case HS_OK:
        return 0;
    case HS_ERROR_INPUT:
        return 1;
    case HS_INTERRUPTED:
        return 3;
    default:
        return 2;
    }
}
