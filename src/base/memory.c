#include "base/memory.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/** Stands before every array. */
typedef struct array_header {
    void *block;         /**< what the system gave */
    size_t mapped_bytes; /**< length of the mapping; 0: the block is from the heap */
} array_header;

/* From this size on an array is a mapping of its own: it comes zeroed and untouched (pages become resident on the node
   of the thread that first writes them, and pages that nobody writes cost nothing), and goes back to the system when
   freed, which malloc's heap does not promise. Sanitizers see only what is on the heap. */
#ifdef HS_SANITIZE
static const size_t mapping_bytes_min = SIZE_MAX;
#else
static const size_t mapping_bytes_min = 1u << 20;
#endif

/* Where the system has huge pages on request (Linux: transparent_hugepage = madvise, the usual setting), whole ones of an array are
   such: the pair loop reads and writes all over positions and forces, and with pages of 4 KiB it waits for their addresses.
   An array that begins where a huge page does has most of them, and none that reaches beyond what is used of it. */
static const size_t huge_page_bytes = 1u << 21;

/** Zeroed mapping that begins at a multiple of a huge page, if it has one, or NULL. */
static void *new_mapping(size_t bytes)
{
    const size_t slack = bytes < huge_page_bytes ? 0 : huge_page_bytes;
    char *block = mmap(NULL, bytes + slack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (block == MAP_FAILED) return NULL;
    if (slack == 0) return block;
    const size_t before = (0 - (uintptr_t)block) % huge_page_bytes;
    if (before > 0) munmap(block, before);
    if (before < slack) munmap(block + before + bytes, slack - before);
#ifdef MADV_HUGEPAGE
    madvise(block + before, bytes, MADV_HUGEPAGE);
#endif
    return block + before;
}

/** The next multiple of the size of a page. */
static size_t whole_pages(size_t bytes)
{
    const size_t page_bytes = (size_t)sysconf(_SC_PAGESIZE);
    return (bytes + page_bytes - 1) / page_bytes * page_bytes;
}

/** Zeroed block from the heap. The array ends where the block does, so that checkers notice the first byte beyond. */
static void *new_heap_block(size_t bytes)
{
    void *block;
    if (posix_memalign(&block, HS_ALIGNMENT, bytes) != 0) return NULL;
    return memset(block, 0, bytes);
}

hs_status hs_memory_alloc(void **array, size_t n, size_t size, hs_error *err)
{
    *array = NULL;
    _Static_assert(sizeof(array_header) <= HS_ALIGNMENT, "the header fits before an aligned array");
    if (size > 0 && n > (SIZE_MAX / 2 - HS_ALIGNMENT) / size)
        return hs_fail(err, HS_ERROR_MEMORY, "an array of %zu elements of %zu bytes is larger than memory can be", n,
                       size);
    const size_t needed = n * size + HS_ALIGNMENT;
    const bool is_mapped = needed >= mapping_bytes_min;
    const size_t bytes = is_mapped ? whole_pages(needed) : needed;
    char *block = is_mapped ? new_mapping(bytes) : new_heap_block(bytes);
    if (block == NULL) return hs_fail(err, HS_ERROR_MEMORY, "out of memory: %zu bytes more were needed", n * size);
    char *start = block + HS_ALIGNMENT;
    ((array_header *)(void *)start)[-1] = (array_header){block, is_mapped ? bytes : 0};
    *array = start;
    return HS_OK;
}

hs_status hs_memory_grow(void **array, size_t n_keep, size_t n_new, size_t size, hs_error *err)
{
    void *grown;
    HS_TRY(hs_memory_alloc(&grown, n_new, size, err));
    if (*array != NULL && n_keep > 0) memcpy(grown, *array, (n_keep < n_new ? n_keep : n_new) * size);
    hs_memory_free(*array);
    *array = grown;
    return HS_OK;
}

hs_status hs_memory_reserve(void **array, size_t *capacity, size_t n, size_t size, hs_error *err)
{
    if (*array != NULL && n <= *capacity) return HS_OK;
    HS_TRY(hs_memory_grow(array, 0, n + n / 8, size, err));
    *capacity = n + n / 8;
    return HS_OK;
}

hs_status hs_memory_extend(void **array, size_t n, size_t *capacity, size_t size, hs_error *err)
{
    if (n < *capacity) return HS_OK;
    HS_TRY(hs_memory_grow(array, n, 2 * n + 16, size, err));
    *capacity = 2 * n + 16;
    return HS_OK;
}

void hs_memory_free(void *array)
{
    if (array == NULL) return;
    const array_header header = ((array_header *)array)[-1];
    if (header.mapped_bytes > 0)
        munmap(header.block, header.mapped_bytes);
    else
        free(header.block);
}

hs_status hs_memory_strdup(char **copy, const char *text, hs_error *err)
{
    HS_TRY(hs_memory_alloc((void **)copy, strlen(text) + 1, 1, err));
    memcpy(*copy, text, strlen(text) + 1);
    return HS_OK;
}

hs_status hs_memory_replace(char **kept, const char *text, hs_error *err)
{
    char *copy;
    HS_TRY(hs_memory_strdup(&copy, text, err));
    HS_FREE(*kept);
    *kept = copy;
    return HS_OK;
}

void hs_memory_trim(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

size_t hs_memory_resident(void)
{
    unsigned long pages_total, pages_resident = 0;
    FILE *statm = fopen("/proc/self/statm", "r");
    if (statm == NULL) return 0;
    if (fscanf(statm, "%lu %lu", &pages_total, &pages_resident) != 2) pages_resident = 0;
    fclose(statm);
    return pages_resident * (size_t)sysconf(_SC_PAGESIZE);
}

size_t hs_memory_resident_peak(void)
{
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return (size_t)usage.ru_maxrss * 1024;
}

size_t hs_memory_physical(void)
{
    const long n_pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGESIZE);
    return n_pages > 0 && page_bytes > 0 ? (size_t)n_pages * (size_t)page_bytes : 0;
}
