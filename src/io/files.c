#include "io/files.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"

bool hs_file_is_readable(const hs_parallel *parallel, const char *path)
{
    bool is_readable = parallel->rank == 0 && access(path, R_OK) == 0;
    hs_parallel_broadcast(parallel, 0, &is_readable, sizeof is_readable);
    return is_readable;
}

static bool is_same(const char *one, const char *other)
{
    struct stat a, b;
    return stat(one, &a) == 0 && stat(other, &b) == 0 && S_ISREG(a.st_mode) && a.st_dev == b.st_dev &&
           a.st_ino == b.st_ino;
}

bool hs_file_is_same(const hs_parallel *parallel, const char *one, const char *other)
{
    bool same = parallel->rank == 0 && is_same(one, other);
    hs_parallel_broadcast(parallel, 0, &same, sizeof same);
    return same;
}

static hs_status check_place(const char *who, const char *path, hs_error *err)
{
    struct stat what;
    const bool is_there = stat(path, &what) == 0;
    if (is_there && S_ISDIR(what.st_mode))
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%.400s' is a folder; the name of a file is needed", who, path);
    if (is_there) return HS_OK;
    const char *slash = strrchr(path, '/');
    char *folder;
    HS_TRY(hs_memory_strdup(&folder, slash != NULL ? path : ".", err));
    if (slash != NULL) folder[slash > path ? slash - path : 1] = '\0';
    int reason = 0;
    if (strchr(folder, '*') != NULL)
        reason = 0; /* it is another one at every step */
    else if (stat(folder, &what) != 0)
        reason = errno;
    else if (!S_ISDIR(what.st_mode))
        reason = ENOTDIR;
    else if (access(folder, W_OK | X_OK) != 0)
        reason = errno;
    hs_status status = HS_OK;
    if (reason == ENOENT)
        status = hs_fail(
            err, HS_ERROR_INPUT,
            "%s: '%.400s' cannot be written: there is no folder '%.400s'; make it first, or let the deck do so by "
            "'shell mkdir %.400s'",
            who, path, folder, folder);
    else if (reason != 0)
        status = hs_fail(err, HS_ERROR_INPUT, "%s: '%.400s' cannot be written: nothing can be put into '%.400s': %s",
                         who, path, folder, strerror(reason));
    HS_FREE(folder);
    return status;
}

hs_status hs_file_check_place(const hs_parallel *parallel, const char *who, const char *path, hs_error *err)
{
    if (parallel->rank == 0) HS_UNLESS_FAILED(err, check_place(who, path, err));
    return hs_parallel_agree(parallel, err);
}
