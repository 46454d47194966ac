#include "io/part_file.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"

static const char suffix[] = ".halfshell-part-";

/* ---- What dead processes have left ---- */

/** Whether the names differ in nothing but the digits of their numbers; a has n bytes. */
static bool is_kin(const char *a, size_t n, const char *b)
{
    size_t i = 0;
    while (i < n) {
        if (isdigit((unsigned char)a[i]) && isdigit((unsigned char)*b)) {
            while (i < n && isdigit((unsigned char)a[i])) ++i;
            while (isdigit((unsigned char)*b)) ++b;
        } else if (a[i++] != *b++) {
            return false;
        }
    }
    return *b == '\0';
}

/** Whether the file is a part of the series of @p name. */
static bool is_part_of(const char *file, const char *name)
{
    const char *mark = NULL;
    for (const char *at = file; (at = strstr(at, suffix)) != NULL; ++at) mark = at;
    if (mark == NULL) return false;
    const char *pid = mark + sizeof suffix - 1;
    return *pid != '\0' && pid[strspn(pid, "0123456789")] == '\0' && is_kin(file, (size_t)(mark - file), name);
}

/** Remove a part that nobody holds the lock of. Its maker, should it come to life between, finds it gone (see
 *  lock_part). */
static void remove_if_dead(int folder, const char *file)
{
    const int fd = openat(folder, file, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0) return;
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) unlinkat(folder, file, 0);
    close(fd);
}

/** The folder that holds a file; the caller frees it. NULL when there is no memory. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? strdup(".") : strndup(path, (size_t)(slash - path) + 1);
}

void hs_part_file_sweep(const char *target)
{
    enum { MOST = 4096 }; /* looking through a huge folder before each file would cost more than rubbish does */
    const char *slash = strrchr(target, '/'), *name = slash != NULL ? slash + 1 : target;
    char *path = folder_of(target);
    DIR *folder = path != NULL ? opendir(path) : NULL;
    const struct dirent *entry;
    for (int n = 0; folder != NULL && n < MOST && (entry = readdir(folder)) != NULL; ++n)
        if (is_part_of(entry->d_name, name)) remove_if_dead(dirfd(folder), entry->d_name);
    if (folder != NULL) closedir(folder);
    free(path);
}

/* ---- The part ---- */

static hs_status fail_open(const char *target, hs_error *err)
{
    return hs_fail(err, HS_ERROR_IO, "'%s' could not be opened for writing: %s", target, strerror(errno));
}

/** Open and lock the part; *is_mine = false when it was removed before the lock was there, as one without a maker. A
 *  file system without locks goes without: nobody removes its parts then. */
static hs_status lock_part(hs_part_file *part, const char *target, mode_t mode, bool *is_mine, hs_error *err)
{
    struct stat mine, there;
    const int fd = open(part->path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
    if (fd < 0) return fail_open(target, err);
    while (flock(fd, LOCK_SH) != 0 && errno == EINTR) continue;
    *is_mine = fstat(fd, &mine) == 0 && stat(part->path, &there) == 0 && mine.st_dev == there.st_dev &&
               mine.st_ino == there.st_ino;
    if (*is_mine)
        part->lock = fd;
    else
        close(fd);
    return HS_OK;
}

static void release(hs_part_file *part)
{
    if (part->path != NULL) close(part->lock);
    HS_FREE(part->path);
    HS_FREE(part->target);
}

hs_status hs_part_file_make(hs_part_file *part, const char *target, hs_error *err)
{
    enum { TRIES = 100 };
    char resolved[PATH_MAX];
    struct stat info;
    hs_text path = {0};
    bool is_mine = false;
    const mode_t mode = stat(target, &info) == 0 ? info.st_mode & 0777 : 0666;
    *part = (hs_part_file){0};
    HS_TRY(hs_memory_strdup(&part->target, realpath(target, resolved) != NULL ? resolved : target, err));
    hs_part_file_sweep(part->target);
    hs_status status = hs_text_printf(&path, err, "%s%s%ld", part->target, suffix, (long)getpid());
    if (status == HS_OK) status = hs_memory_strdup(&part->path, hs_text_get(&path), err);
    hs_text_fini(&path);
    for (int k = 0; status == HS_OK && !is_mine && k < TRIES; ++k)
        status = lock_part(part, target, mode, &is_mine, err);
    if (status == HS_OK && !is_mine)
        status = hs_fail(err, HS_ERROR_IO, "'%s' could not be opened for writing: another program removes it", target);
    if (status != HS_OK) {
        HS_FREE(part->path);
        HS_FREE(part->target);
    }
    return status;
}

/** The folder's entry must be on the disk, too. */
static void sync_folder(const char *path)
{
    char *folder = folder_of(path);
    const int fd = folder != NULL ? open(folder, O_RDONLY | O_DIRECTORY) : -1;
    if (fd >= 0) {
        (void)!fsync(fd);
        close(fd);
    }
    free(folder);
}

hs_status hs_part_file_finish(hs_part_file *part, hs_error *err)
{
    hs_status status = HS_OK;
    if (rename(part->path, part->target) == 0) {
        sync_folder(part->target);
    } else {
        status = hs_fail(err, HS_ERROR_IO, "'%s' could not be renamed into place: %s", part->target, strerror(errno));
        unlink(part->path);
    }
    release(part);
    return status;
}

void hs_part_file_abandon(hs_part_file *part)
{
    if (part->path != NULL) unlink(part->path);
    release(part);
}
