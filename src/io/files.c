#include "io/files.h"

#include <sys/stat.h>
#include <unistd.h>

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
