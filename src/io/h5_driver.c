#include "io/h5_driver.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

/** A write to the file's structure that waits for the next flush. */
typedef struct held {
    haddr_t at;
    size_t size;
    H5FD_mem_t kind;
    int rank;    /**< place in the order of the commit */
    char *bytes; /**< owned */
} held;

typedef struct h5_file {
    H5FD_t head; /**< HDF5's part comes first */
    int fd;
    haddr_t eoa;       /**< end of what HDF5 has allocated */
    haddr_t eof;       /**< end of what was written */
    haddr_t committed; /**< end of the file of the last flush: what lies beyond it nothing refers to yet */
    held *waiting;     /**< owned [n_waiting] */
    size_t n_waiting, capacity;
    int failed; /**< errno of the first failure */
    dev_t device;
    ino_t inode;
} h5_file;

static int write_at(h5_file *file, haddr_t at, const char *bytes, size_t size)
{
    while (size > 0 && file->failed == 0) {
        const ssize_t n = pwrite(file->fd, bytes, size, (off_t)at);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            file->failed = n < 0 ? errno : ENOSPC;
            break;
        }
        bytes += n;
        at += (haddr_t)n;
        size -= (size_t)n;
    }
    return file->failed == 0 ? 0 : -1;
}

/** What the kernel copies in one go: a process can be killed in the middle of a longer write. */
enum { PAGE = 4096 };

/** Layout of a node of an index, HDF5's "version 1 B-trees": "TREE", type, level, entries in use (2 bytes). */
enum { NODE_LEVEL = 5, NODE_USED = 6, NODE_HEAD = 8 };

static int entries_of(const char *node)
{
    return (unsigned char)node[NODE_USED] + 256 * (unsigned char)node[NODE_USED + 1];
}

/** Is this a node to which entries were added, so that what is new in it counts only with its head? */
static bool grows(const h5_file *file, const held *write)
{
    char old[NODE_HEAD];
    return write->kind == H5FD_MEM_BTREE && write->size > NODE_HEAD &&
           pread(file->fd, old, sizeof old, (off_t)write->at) == sizeof old &&
           memcmp(old, write->bytes, NODE_LEVEL + 1) == 0 && entries_of(write->bytes) >= entries_of(old);
}

/** Overwrite structure page by page: with the head last when entries were added, else with the head first. */
static void overwrite(h5_file *file, const held *write)
{
    const haddr_t first = write->at / PAGE, last = (write->at + write->size - 1) / PAGE;
    const bool is_backward = grows(file, write);
    for (haddr_t k = first; k <= last; ++k) {
        const haddr_t page = is_backward ? last - (k - first) : k;
        const haddr_t begin = page == first ? write->at : page * PAGE;
        const haddr_t end = page == last ? write->at + write->size : (page + 1) * PAGE;
        (void)write_at(file, begin, write->bytes + (begin - write->at), (size_t)(end - begin));
    }
}

static void forget_waiting(h5_file *file)
{
    for (size_t i = 0; i < file->n_waiting; ++i) free(file->waiting[i].bytes);
    file->n_waiting = 0;
}

/** Order of the commit. */
enum { NEW, SUPERBLOCK, TREE_ROOT, TREE_LEAF = TREE_ROOT + 255, OTHER, HEADER };

static int rank_of(const h5_file *file, const held *write)
{
    if (write->at >= file->committed) return NEW;
    if (write->kind == H5FD_MEM_SUPER) return SUPERBLOCK;
    if (write->kind == H5FD_MEM_OHDR) return HEADER;
    /* A node is split by moving entries to a new node, telling the parent, and only then shortening
     * the old node; so parents (of higher level) come first. */
    if (write->kind == H5FD_MEM_BTREE && write->size > NODE_HEAD)
        return TREE_LEAF - (unsigned char)write->bytes[NODE_LEVEL];
    return OTHER;
}

/** Drop what was added since the last commit. */
static void roll_back(h5_file *file)
{
    forget_waiting(file);
    if (ftruncate(file->fd, (off_t)file->committed) == 0) file->eof = file->committed;
}

static int compare_ranks(const void *a, const void *b)
{
    const held *first = a, *second = b;
    if (first->rank != second->rank) return first->rank < second->rank ? -1 : 1;
    return first->at < second->at ? -1 : first->at > second->at;
}

static int commit(h5_file *file)
{
    if (file->failed != 0) return -1;
    const haddr_t end = file->eoa > file->eof ? file->eoa : file->eof;
    size_t i = 0;
    for (size_t k = 0; k < file->n_waiting; ++k) file->waiting[k].rank = rank_of(file, &file->waiting[k]);
    if (file->n_waiting > 1) qsort(file->waiting, file->n_waiting, sizeof *file->waiting, compare_ranks);
    for (; i < file->n_waiting && file->waiting[i].rank == NEW; ++i)
        (void)write_at(file, file->waiting[i].at, file->waiting[i].bytes, file->waiting[i].size);
    /* The superblock names the file's length: the file must have it first. */
    if (file->failed == 0 && ftruncate(file->fd, (off_t)end) != 0) file->failed = errno;
    for (; i < file->n_waiting; ++i) overwrite(file, &file->waiting[i]);
    if (file->failed != 0) {
        roll_back(file);
        return -1;
    }
    forget_waiting(file);
    file->eof = file->committed = end;
    return 0;
}

/* ---- What HDF5 calls ---- */

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t fapl, haddr_t maxaddr)
{
    (void)fapl, (void)maxaddr;
    const int mode = ((flags & H5F_ACC_RDWR) ? O_RDWR : O_RDONLY) | ((flags & H5F_ACC_CREAT) ? O_CREAT : 0) |
                     ((flags & H5F_ACC_TRUNC) ? O_TRUNC : 0) | ((flags & H5F_ACC_EXCL) ? O_EXCL : 0);
    struct stat info;
    const int fd = open(name, mode, 0666);
    if (fd < 0) return NULL;
    h5_file *file = fstat(fd, &info) == 0 ? calloc(1, sizeof *file) : NULL;
    if (file == NULL) {
        close(fd);
        return NULL;
    }
    file->fd = fd;
    file->eof = file->committed = (haddr_t)info.st_size;
    file->device = info.st_dev;
    file->inode = info.st_ino;
    return &file->head;
}

static herr_t driver_close(H5FD_t *head)
{
    h5_file *file = (h5_file *)head;
    if (file->failed != 0) roll_back(file);
    if (file->n_waiting > 0) (void)commit(file);
    forget_waiting(file);
    free(file->waiting);
    const bool is_closed = close(file->fd) == 0;
    free(file);
    return is_closed ? 0 : -1;
}

static int driver_cmp(const H5FD_t *a, const H5FD_t *b)
{
    const h5_file *first = (const h5_file *)a, *second = (const h5_file *)b;
    if (first->device != second->device) return first->device < second->device ? -1 : 1;
    if (first->inode != second->inode) return first->inode < second->inode ? -1 : 1;
    return 0;
}

/** At the end of the file. Structure of less than a page does not cross the border of one, longer structure begins at
 *  one, so that `overwrite` changes every head at once. */
static haddr_t driver_alloc(H5FD_t *head, H5FD_mem_t kind, hid_t dxpl, hsize_t size)
{
    (void)dxpl;
    h5_file *file = (h5_file *)head;
    haddr_t at = file->eoa;
    if (kind != H5FD_MEM_DRAW && at % PAGE + size > PAGE) at = (at + PAGE - 1) / PAGE * PAGE;
    file->eoa = at + size;
    return at;
}

/** No accumulation, sieving or aggregation: each piece comes by itself and at a place of its own. */
static herr_t driver_query(const H5FD_t *head, unsigned long *flags)
{
    (void)head;
    *flags = 0;
    return 0;
}

static haddr_t driver_get_eoa(const H5FD_t *head, H5FD_mem_t kind)
{
    (void)kind;
    return ((const h5_file *)head)->eoa;
}

static herr_t driver_set_eoa(H5FD_t *head, H5FD_mem_t kind, haddr_t at)
{
    (void)kind;
    ((h5_file *)head)->eoa = at;
    return 0;
}

static haddr_t driver_get_eof(const H5FD_t *head, H5FD_mem_t kind)
{
    (void)kind;
    return ((const h5_file *)head)->eof;
}

/** For the functions below. */
static herr_t driver_get_handle(H5FD_t *head, hid_t fapl, void **handle)
{
    (void)fapl;
    *handle = head;
    return 0;
}

static herr_t driver_read(H5FD_t *head, H5FD_mem_t kind, hid_t dxpl, haddr_t at, size_t size, void *buffer)
{
    (void)kind, (void)dxpl;
    h5_file *file = (h5_file *)head;
    char *bytes = buffer;
    for (size_t done = 0; done < size;) {
        const ssize_t n = pread(file->fd, bytes + done, size - done, (off_t)(at + done));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return -1;
        if (n == 0) {
            memset(bytes + done, 0, size - done);
            break;
        }
        done += (size_t)n;
    }
    for (size_t i = 0; i < file->n_waiting; ++i) {
        const held *write = &file->waiting[i];
        const haddr_t begin = write->at > at ? write->at : at;
        const haddr_t end = write->at + write->size < at + size ? write->at + write->size : at + size;
        if (begin < end) memcpy(bytes + (begin - at), write->bytes + (begin - write->at), (size_t)(end - begin));
    }
    return 0;
}

static herr_t hold(h5_file *file, H5FD_mem_t kind, haddr_t at, size_t size, const void *buffer)
{
    for (size_t i = 0; i < file->n_waiting; ++i)
        if (file->waiting[i].at == at && file->waiting[i].size == size) {
            memcpy(file->waiting[i].bytes, buffer, size);
            return 0;
        }
    if (file->n_waiting == file->capacity) {
        const size_t capacity = file->capacity == 0 ? 64 : 2 * file->capacity;
        held *grown = realloc(file->waiting, capacity * sizeof *grown);
        if (grown == NULL) return file->failed = ENOMEM, -1;
        file->waiting = grown;
        file->capacity = capacity;
    }
    char *bytes = malloc(size);
    if (bytes == NULL) return file->failed = ENOMEM, -1;
    memcpy(bytes, buffer, size);
    file->waiting[file->n_waiting++] = (held){.at = at, .size = size, .kind = kind, .bytes = bytes};
    return 0;
}

/** Once a write has failed, all later ones are taken and dropped, so that the file can be closed. */
static herr_t driver_write(H5FD_t *head, H5FD_mem_t kind, hid_t dxpl, haddr_t at, size_t size, const void *buffer)
{
    (void)dxpl;
    h5_file *file = (h5_file *)head;
    if (file->failed != 0) return 0;
    if (at + size > file->eof) file->eof = at + size;
    if (kind != H5FD_MEM_DRAW) return hold(file, kind, at, size, buffer);
    return write_at(file, at, buffer, size);
}

static herr_t driver_flush(H5FD_t *head, hid_t dxpl, hbool_t closing)
{
    (void)dxpl;
    h5_file *file = (h5_file *)head;
    if (file->failed != 0) return closing ? 0 : -1;
    return commit(file);
}

/** The commit itself sets the length. */
static herr_t driver_truncate(H5FD_t *head, hid_t dxpl, hbool_t closing)
{
    (void)head, (void)dxpl, (void)closing;
    return 0;
}

static const H5FD_class_t driver = {
#if H5_VERSION_GE(1, 13, 0)
    .version = H5FD_CLASS_VERSION,
    .value = 9117, /* of the range for drivers of applications */
#endif
    .name = "halfshell",
    .maxaddr = INT64_MAX,
    .fc_degree = H5F_CLOSE_STRONG,
    .open = driver_open,
    .close = driver_close,
    .cmp = driver_cmp,
    .query = driver_query,
    .alloc = driver_alloc,
    .get_eoa = driver_get_eoa,
    .set_eoa = driver_set_eoa,
    .get_eof = driver_get_eof,
    .get_handle = driver_get_handle,
    .read = driver_read,
    .write = driver_write,
    .flush = driver_flush,
    .truncate = driver_truncate,
    .fl_map = H5FD_FLMAP_SINGLE,
};

hid_t hs_h5_driver_list(void)
{
    const hid_t list = H5Pcreate(H5P_FILE_ACCESS), id = H5FDregister(&driver);
    if (list < 0 || id < 0) return -1;
    /* The list keeps a reference to the driver of its own. */
    const bool is_set =
        H5Pset_driver(list, id, NULL) >= 0 && H5Pset_libver_bounds(list, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18) >= 0;
    H5FDunregister(id);
    if (is_set) return list;
    H5Pclose(list);
    return -1;
}

static h5_file *file_of(hid_t id)
{
    void *handle = NULL;
    return H5Fget_vfd_handle(id, H5P_DEFAULT, &handle) >= 0 ? handle : NULL;
}

void hs_h5_driver_opened(hid_t id)
{
    h5_file *file = file_of(id);
    if (file == NULL || file->eoa >= file->eof) return;
    file->committed = file->eoa;
    roll_back(file);
}

int hs_h5_driver_errno(hid_t id)
{
    const h5_file *file = file_of(id);
    return file != NULL ? file->failed : 0;
}
