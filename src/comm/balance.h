/** Load balance: cut planes are moved so that all bricks have equal work. */
#ifndef HS_COMM_BALANCE_H
#define HS_COMM_BALANCE_H

#include "comm/domain.h"
#include "core/atoms.h"

enum { HS_BALANCE_AXES_MAX = 3 };

/** How planes are moved: words of `balance ... shift` and of `fix balance`. */
typedef struct hs_balance {
    int axis[HS_BALANCE_AXES_MAX]; /**< axes in the order in which their planes are moved */
    int n_axes;
    int n_iterations;   /**< for each axis at most: every one finds the places of the planes 16 times more exactly */
    double stop_factor; /**< an axis is done when its slabs are no farther from equal work than this factor */
    double least_width; /**< of bricks, distance: thinner ones cost more in messages than they save in work */
} hs_balance;

/** Words "<axes> <Niter> <stop factor>", axes being x, y, z, xy, ... zyx, from word @p first on. */
HS_MUST_USE hs_status hs_balance_read_axes(hs_balance *balance, const char *word, int dimension, const char *command,
                                           hs_error *err);

/** The work that is to be spread: that of all atoms of all ranks. All borrowed. */
typedef struct hs_balance_work {
    const hs_parallel *parallel;
    const hs_box *box;
    const hs_atoms *atoms;
    const double *cost; /**< [n_local] of the atoms; NULL: all the same */
} hs_balance_work;

/** What stands for LAMMPS's style rcb, whose parts are not in rows: all axes, to within 5 %. */
void hs_balance_take_rcb(hs_balance *balance, int dimension);
/** Move the planes so that the work is spread evenly over the slabs of each axis. Atoms stay where they are until the next
 *  migration. *n_iterations counts what was needed. Collective, errors agreed. */
HS_MUST_USE hs_status hs_balance_shift(const hs_balance *balance, hs_domain *domain, const hs_balance_work *work,
                                       int *n_iterations, hs_error *err);

/** The largest load of a rank, and its ratio to the mean: 1 when all are equal, or there is no load (collective). */
void hs_balance_measure(const hs_parallel *parallel, double load, double *largest, double *factor);
/** The load that this rank would have if all atoms were where the planes say. Collective, errors agreed. */
HS_MUST_USE hs_status hs_balance_predict(const hs_domain *domain, const hs_balance_work *work, double *load,
                                         hs_error *err);

#endif
