/* Loaded before a program (LD_PRELOAD) this makes a disk that is full: no file whose name holds the word FULL_NAME may
 * grow beyond FULL_BYTES bytes. Used by tests/fault where no small file system can be mounted. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/** How many of the n bytes at @p at there is room for. */
static size_t room(int fd, off_t at, size_t n)
{
    char link[64], name[4096];
    const char *word = getenv("FULL_NAME"), *bytes = getenv("FULL_BYTES");
    if (word == NULL || bytes == NULL) return n;
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t length = readlink(link, name, sizeof name - 1);
    if (length < 0) return n;
    name[length] = '\0';
    if (strstr(name, word) == NULL) return n;
    const off_t most = atol(bytes);
    return at >= most ? 0 : (off_t)n > most - at ? (size_t)(most - at) : n;
}

ssize_t write(int fd, const void *bytes, size_t n)
{
    ssize_t (*real)(int, const void *, size_t) = dlsym(RTLD_NEXT, "write");
    const off_t at = lseek(fd, 0, SEEK_CUR);
    const size_t n_room = at < 0 ? n : room(fd, at, n);
    if (n_room == 0 && n > 0) {
        errno = ENOSPC;
        return -1;
    }
    return real(fd, bytes, n_room);
}

ssize_t pwrite64(int fd, const void *bytes, size_t n, off_t at)
{
    ssize_t (*real)(int, const void *, size_t, off_t) = dlsym(RTLD_NEXT, "pwrite64");
    const size_t n_room = room(fd, at, n);
    if (n_room == 0 && n > 0) {
        errno = ENOSPC;
        return -1;
    }
    return real(fd, bytes, n_room, at);
}

ssize_t pwrite(int fd, const void *bytes, size_t n, off_t at) { return pwrite64(fd, bytes, n, at); }
