/** Errors: every function that can fail returns a status and fills an error record. */
#ifndef HS_BASE_ERROR_H
#define HS_BASE_ERROR_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

#define HS_MUST_USE          __attribute__((warn_unused_result))
#define HS_PRINTF(fmt, args) __attribute__((format(printf, fmt, args)))

typedef enum {
    HS_OK = 0,
    HS_ERROR_INPUT,  /**< the deck, a file it names, or the command line is wrong: exit code 1 */
    HS_ERROR_RUN,    /**< the simulation failed (lost atoms, NaN, ...): exit code 2 */
    HS_ERROR_ATOMS,  /**< atoms have moved as no system does, and all ranks know of it: exit code 2; sim/violation.h */
    HS_ERROR_IO,     /**< a file could not be written: exit code 2 */
    HS_ERROR_MEMORY, /**< out of memory: exit code 2 */
    HS_INTERRUPTED   /**< stopped by a signal: exit code 3 */
} hs_status;

enum { HS_ERROR_TEXT_SIZE = 2048, HS_ERROR_FILE_SIZE = 512 };

/** What went wrong and where. A zeroed record means "no error". Texts that do not fit are cut. */
typedef struct hs_error {
    hs_status status;
    int rank;                      /**< MPI rank that met the error first */
    long line;                     /**< deck line, 0 when the error has no line */
    char file[HS_ERROR_FILE_SIZE]; /**< deck (or data file) name, "" when there is none */
    char text[HS_ERROR_TEXT_SIZE]; /**< what, why, what would be right; no newline at the end */
} hs_error;

/** Fill @p err (kept if it already holds an error) and return @p status, so that one can write `return hs_fail(...)`. */
hs_status hs_fail(hs_error *err, hs_status status, const char *fmt, ...) HS_PRINTF(3, 4);

/* A failure is never HS_OK. Told so, the compiler can follow which results are set after HS_TRY, and warns of nothing else. */
static inline hs_status hs_failed(hs_status status)
{
    if (status == HS_OK) __builtin_unreachable();
    return status;
}
#define hs_fail(err, status, ...) hs_failed((hs_fail)((err), (status), __VA_ARGS__))

/** Add the place to an error that has none yet. Does nothing when @p err holds no error or has a place. */
void hs_error_locate(hs_error *err, const char *file, long line);

/** Tell the error in one line: `DECK:LINE: error: what, why, what would be right`. */
void hs_error_print(const hs_error *err, FILE *stream);

/** Forget the error. */
void hs_error_clear(hs_error *err);

/** Exit code of the program for a status: see docs/reference/exit-codes. */
int hs_exit_code(hs_status status);

/** Return from the calling function when @p expression is not HS_OK. For functions with nothing to clean up. */
#define HS_TRY(expression)                                                                                             \
    do {                                                                                                               \
        hs_status hs_try_ = (expression);                                                                              \
        if (hs_try_ != HS_OK) return hs_try_;                                                                          \
    } while (0)

/** Evaluate @p expression unless @p err holds an error already. For ranks that must go on together to the place where they
 *  agree on errors: what went wrong stays in @p err. */
#define HS_UNLESS_FAILED(err, expression)                                                                              \
    do {                                                                                                               \
        if ((err)->status == HS_OK) {                                                                                  \
            const hs_status hs_unused_ = (expression);                                                                 \
            (void)hs_unused_;                                                                                          \
        }                                                                                                              \
    } while (0)

#endif
