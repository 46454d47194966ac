/* Loaded before a program (LD_PRELOAD) this kills it at the N-th change it makes to a file: N in DIE_AT_WRITE. A write
 * is done up to the first border of a page inside it, as the kernel may leave it; one within a page is not done.
 * Without, the changes are counted into the file named by COUNT_WRITES. Used by tests/fault. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static long n_changes;

static int is_last(void)
{
    const char *limit = getenv("DIE_AT_WRITE");
    ++n_changes;
    return limit != NULL && n_changes >= atol(limit);
}

static void count(void)
{
    if (is_last()) raise(SIGKILL);
}

ssize_t pwrite64(int fd, const void *bytes, size_t n, off64_t at)
{
    ssize_t (*real)(int, const void *, size_t, off64_t) = dlsym(RTLD_NEXT, "pwrite64");
    if (!is_last()) return real(fd, bytes, n, at);
    const size_t in_page = 4096 - (size_t)at % 4096;
    if (in_page < n) (void)!real(fd, bytes, in_page, at);
    raise(SIGKILL);
    return -1;
}

ssize_t pwrite(int fd, const void *bytes, size_t n, off_t at) { return pwrite64(fd, bytes, n, at); }

int ftruncate64(int fd, off64_t length)
{
    int (*real)(int, off64_t) = dlsym(RTLD_NEXT, "ftruncate64");
    count();
    return real(fd, length);
}

int ftruncate(int fd, off_t length) { return ftruncate64(fd, length); }

int rename(const char *from, const char *to)
{
    int (*real)(const char *, const char *) = dlsym(RTLD_NEXT, "rename");
    count();
    return real(from, to);
}

__attribute__((destructor)) static void tell(void)
{
    const char *name = getenv("COUNT_WRITES");
    FILE *stream = name != NULL ? fopen(name, "w") : NULL;
    if (stream == NULL) return;
    fprintf(stream, "%ld\n", n_changes);
    fclose(stream);
}
