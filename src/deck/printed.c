#include "deck/printed.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"

/** The line of a file in the list, and where the next one begins; NULL when there is none. */
static const char *find_line(const char *list, const char *file, const char **next)
{
    const size_t n = strlen(file);
    for (const char *line = list; line != NULL && *line != '\0'; line = *next) {
        const char *name = strchr(line, ' '), *end = strchr(line, '\n');
        if (name == NULL || end == NULL || ++name > end) return NULL; /* only a damaged list of a checkpoint */
        *next = end + 1;
        if ((size_t)(end - name) == n && memcmp(name, file, n) == 0) return line;
    }
    return NULL;
}

hs_status hs_printed_note(char **list, const char *file, int64_t size, hs_error *err)
{
    hs_text text = {0};
    const char *next = NULL, *line = find_line(*list, file, &next);
    hs_status status = HS_OK;
    if (line != NULL) status = hs_text_append(&text, *list, (size_t)(line - *list), err);
    if (status == HS_OK && (line != NULL ? next : *list) != NULL)
        status = hs_text_printf(&text, err, "%s", line != NULL ? next : *list);
    if (status == HS_OK) status = hs_text_printf(&text, err, "%lld %s\n", (long long)size, file);
    if (status == HS_OK) {
        HS_FREE(*list);
        status = hs_memory_strdup(list, hs_text_get(&text), err);
    }
    hs_text_fini(&text);
    return status;
}

hs_status hs_printed_expect(char **list, const char *file, hs_error *err)
{
    const char *next;
    struct stat info;
    if (find_line(*list, file, &next) != NULL) return HS_OK;
    if (stat(file, &info) != 0) return hs_printed_note(list, file, 0, err);
    return S_ISREG(info.st_mode) ? hs_printed_note(list, file, info.st_size, err) : HS_OK;
}

static hs_status cut(const char *file, int64_t size, hs_error *err)
{
    struct stat info;
    if (stat(file, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size <= size) return HS_OK;
    if (truncate(file, size) == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_IO, "the file '%.400s' cannot be cut back to what it was at the checkpoint: %s", file,
                   strerror(errno));
}

hs_status hs_printed_cut(const char *list, hs_error *err)
{
    char *copy = NULL, *rest;
    HS_TRY(hs_memory_strdup(&copy, list, err));
    hs_status status = HS_OK;
    rest = copy;
    for (char *line = strsep(&rest, "\n"); line != NULL && status == HS_OK; line = strsep(&rest, "\n")) {
        char *name;
        const long long size = strtoll(line, &name, 10);
        if (*name == ' ' && name > line && size >= 0) status = cut(name + 1, size, err);
    }
    HS_FREE(copy);
    return status;
}
