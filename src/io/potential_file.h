/** Files of tabulated pair potentials, as pair_style table reads and pair_write writes them: sections of a name, a line
 *  `N <n> [R|RSQ <first> <last>] [FPRIME <first> <last>]`, and n lines of number, distance, energy, force. */
#ifndef HS_IO_POTENTIAL_FILE_H
#define HS_IO_POTENTIAL_FILE_H

#include "io/line_reader.h"

/** One section. */
typedef struct hs_tabulated {
    int n;                  /**< rows, at least 2 */
    double *r;              /**< [n], owned: distances, rising */
    double *energy, *force; /**< [n], owned */
    double slope[2];        /**< of the force at the first and the last row, force/distance */
} hs_tabulated;

/** Read a section, on all ranks (collective). Zero the result before; give it back with hs_tabulated_fini, also after an
 *  error. @p command is for messages. */
HS_MUST_USE hs_status hs_tabulated_read(hs_tabulated *table, const char *command, const char *path, const char *section,
                                        const hs_parallel *parallel, hs_error *err);
void hs_tabulated_fini(hs_tabulated *table);
/** Distance of row i of n between first and last, equally spaced in r or (@p by_square) in r^2. */
double hs_tabulated_distance(int i, int n, double first, double last, bool by_square);

#endif
