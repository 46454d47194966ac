/** Cell lists for particles of your own: all pairs closer than a distance, or all particles around a point, in 2D and
 *  3D, in time proportional to their number. For simulations, analyses and lessons that have no need of the rest of
 *  Halfshell.
 *
 *      double x[N][3] = ...;
 *      const hs_cell_list_box box = {.dimension = 3, .hi = {20, 20, 20}, .periodic = {1, 1, 1}};
 *      hs_cell_list *list;
 *      if (hs_cell_list_create(&list, &box, 2.5, NULL) != HS_CODE_OK ||
 *          hs_cell_list_build(list, N, &x[0][0], &x[0][1], &x[0][2], sizeof x[0]) != HS_CODE_OK)
 *          fprintf(stderr, "%s\n", hs_cell_list_error(list));
 *      hs_cell_pair pair;
 *      for (hs_cell_iterator at = hs_cell_list_pairs(list); hs_cell_iterator_next(&at, &pair);)
 *          energy += u(pair.r2);       // each pair once; pair.d leads from particle pair.i to particle pair.j
 *      hs_cell_list_destroy(&list);
 *
 *  A list copies the positions, sorted by cell; the caller's arrays may change afterwards. Memory goes by particles:
 *  where most cells of the box are empty, only the occupied ones are kept, in a hash table. After a build the list is
 *  not changed by any function that takes it const: several threads may search one list at the same time.
 *
 *  Periodic axes. Displacements are to the nearest image, and to all images within reach where the box is shorter than
 *  twice the reach: a pair then occurs once for each image, and a particle whose own image is near occurs with itself
 *  (pair.i == pair.j). Positions may lie outside of the box; along periodic axes they are wrapped. */
#ifndef HALFSHELL_CELLS_H
#define HALFSHELL_CELLS_H

#include <stddef.h>
#include <stdint.h>

#include <halfshell/halfshell.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Particles in cells. */
typedef struct hs_cell_list hs_cell_list;

/** Where the particles are. In 2D the third numbers are of no account, and displacements have z = 0. */
typedef struct hs_cell_list_box {
    int dimension; /**< 2 or 3 */
    double lo[3], hi[3];
    int periodic[3]; /**< 1 or 0, by axis */
} hs_cell_list_box;

/** Settings that have defaults. Start from HS_CELL_LIST_OPTIONS_INIT: programs built against this version then work
 *  with later ones that have more settings. */
typedef struct hs_cell_list_options {
    size_t size;
    double cell;   /**< edge of the cells as a fraction of the reach, 0.05 to 20; 0: 1 */
    int n_threads; /**< OpenMP threads of a build; 0: OMP_NUM_THREADS, else 1 */
} hs_cell_list_options;

#define HS_CELL_LIST_OPTIONS_INIT                                                                                      \
    {                                                                                                                  \
        sizeof(hs_cell_list_options), 0.0, 0                                                                           \
    }

/** Two particles that are near each other. */
typedef struct hs_cell_pair {
    int64_t i, j; /**< numbers of the particles, from 0; i is -1 around a point */
    double d[3];  /**< from particle i (or the point) to the image of particle j that is near */
    double r2;    /**< |d|^2 */
} hs_cell_pair;

/** A walk over pairs. All members are private. */
typedef struct hs_cell_iterator {
    const hs_cell_list *list;
    double reach2, origin[3], shift[3];
    int64_t cell, cell_end, a, a_begin, a_end, b, b_begin, b_end;
    int64_t at[3], lo[3], hi[3];
    int step, is_around;
} hs_cell_iterator;

/** What is done with a pair; a result other than 0 ends the walk. */
typedef int (*hs_cell_visit)(void *context, const hs_cell_pair *pair);

/** New list without particles, for pairs closer than @p reach (> 0). The caller destroys it, also when this fails: the
 *  handle then only holds the message. NULL comes back only when there is no memory at all. @p options may be NULL. */
HS_API hs_code hs_cell_list_create(hs_cell_list **list, const hs_cell_list_box *box, double reach,
                                   const hs_cell_list_options *options);
/** Free everything and clear the pointer. NULL is fine. */
HS_API void hs_cell_list_destroy(hs_cell_list **list);
/** What went wrong in the last call that failed; "" when it succeeded. Borrowed until the next call. */
HS_API const char *hs_cell_list_error(const hs_cell_list *list);
/** Another box, for the next build; until then the list has no particles. */
HS_API hs_code hs_cell_list_set_box(hs_cell_list *list, const hs_cell_list_box *box);

/** Put n particles into the list, in place of those of the build before. x, y, z point to the coordinates of the first
 *  one;
 *  @p stride is the number of bytes from one particle to the next: sizeof(double) for arrays of their own,
 *  3 * sizeof(double) for rows of x, y, z, sizeof(struct particle) for structures. z may be NULL in 2D. A coordinate
 *  that is not a finite number is an error, after which the list has no particles. Threaded; the list is the same for
 *  any number of threads. */
HS_API hs_code hs_cell_list_build(hs_cell_list *list, int64_t n, const double *x, const double *y, const double *z,
                                  size_t stride);
/** The same for single precision. Searches compute in double. */
HS_API hs_code hs_cell_list_build_float(hs_cell_list *list, int64_t n, const float *x, const float *y, const float *z,
                                        size_t stride);
/** Particles in the list. */
HS_API int64_t hs_cell_list_n(const hs_cell_list *list);
/** Memory that the list holds, bytes. */
HS_API size_t hs_cell_list_memory(const hs_cell_list *list);

/** Walk over all pairs closer than the reach, each once. The list must not be built or destroyed meanwhile. */
HS_API hs_cell_iterator hs_cell_list_pairs(const hs_cell_list *list);
/** The same for one of n_parts shares of the pairs, 0 <= part < n_parts, so that threads can take a part each. */
HS_API hs_cell_iterator hs_cell_list_pairs_of_part(const hs_cell_list *list, int part, int n_parts);
/** Walk over the particles closer than @p radius to a point. The radius may be shorter or longer than the reach; one
 *  that is not a finite number, and such a point, have no particles around. */
HS_API hs_cell_iterator hs_cell_list_around(const hs_cell_list *list, const double point[3], double radius);
/** The next pair: 1, or 0 when there is none. */
HS_API int hs_cell_iterator_next(hs_cell_iterator *iterator, hs_cell_pair *pair);

/** Call @p visit for every pair closer than the reach. Returns what it returned last: 0 unless it ended the walk. */
HS_API int hs_cell_list_each_pair(const hs_cell_list *list, hs_cell_visit visit, void *context);
/** Call @p visit for every particle closer than @p radius to a point; likewise. */
HS_API int hs_cell_list_query(const hs_cell_list *list, const double point[3], double radius, hs_cell_visit visit,
                              void *context);

#ifdef __cplusplus
}
#endif

#endif
