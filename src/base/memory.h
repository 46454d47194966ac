/** Memory: 64-byte aligned arrays with checked sizes. The creator of an array frees it with HS_FREE. */
#ifndef HS_BASE_MEMORY_H
#define HS_BASE_MEMORY_H

#include <stddef.h>

#include "base/error.h"

enum { HS_ALIGNMENT = 64 };

/** Allocate @p n zeroed elements of @p size bytes, aligned to 64 bytes. n = 0 gives a valid empty array.
 *  Large arrays come untouched from the system: pages become resident where they are first written. */
HS_MUST_USE hs_status hs_memory_alloc(void **array, size_t n, size_t size, hs_error *err);

/** Move an array into a new one of @p n_new zeroed elements, keeping the first @p n_keep. */
HS_MUST_USE hs_status hs_memory_grow(void **array, size_t n_keep, size_t n_new, size_t size, hs_error *err);

/** Room for @p n elements whose former values are not needed: where *capacity is less, or there is no array, a new one of zeros
 *  with an eighth to spare. Use HS_RESERVE. */
HS_MUST_USE hs_status hs_memory_reserve(void **array, size_t *capacity, size_t n, size_t size, hs_error *err);
/** Room for one more element behind the first @p n, which stay: *capacity is doubled when they fill it. Use HS_EXTEND. */
HS_MUST_USE hs_status hs_memory_extend(void **array, size_t n, size_t *capacity, size_t size, hs_error *err);

/** Give an array of hs_memory_alloc back; NULL is fine. Use HS_FREE, which clears the pointer too. */
void hs_memory_free(void *array);

/** Copy of a string on the heap; the caller frees it with HS_FREE. */
HS_MUST_USE hs_status hs_memory_strdup(char **copy, const char *text, hs_error *err);

/** Put a copy of @p text in the place of the string *kept (or NULL), which is given back; *kept is what it was after an
 *  error, and
 *  @p text may be part of it. */
HS_MUST_USE hs_status hs_memory_replace(char **kept, const char *text, hs_error *err);

/** Give memory that was freed back to the system, for what is to be measured next. */
void hs_memory_trim(void);
/** Resident memory of this process now and at its peak, bytes; 0 when the system does not tell. */
size_t hs_memory_resident(void);
size_t hs_memory_resident_peak(void);
/** Memory of this machine, bytes; 0 when the system does not tell. */
size_t hs_memory_physical(void);

#define HS_ALLOC(pointer, n, err) hs_memory_alloc((void **)&(pointer), (n), sizeof *(pointer), (err))
#define HS_GROW(pointer, n_keep, n_new, err)                                                                           \
    hs_memory_grow((void **)&(pointer), (n_keep), (n_new), sizeof *(pointer), (err))
#define HS_RESERVE(pointer, capacity, n, err)                                                                          \
    hs_memory_reserve((void **)&(pointer), &(capacity), (n), sizeof *(pointer), (err))
#define HS_EXTEND(pointer, n, capacity, err)                                                                           \
    hs_memory_extend((void **)&(pointer), (size_t)(n), &(capacity), sizeof *(pointer), (err))
#define HS_FREE(pointer) (hs_memory_free(pointer), (pointer) = NULL)

#endif
