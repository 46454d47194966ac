/** Halfshell as a library: molecular dynamics of short-range particle systems from LAMMPS input decks.
 *
 *      hs_simulation *simulation;
 *      if (hs_simulation_create(&simulation, NULL) != HS_CODE_OK ||
 *          hs_simulation_deck_file(simulation, "melt.in") != HS_CODE_OK ||
 *          hs_simulation_run(simulation, 100) != HS_CODE_OK)
 *          fprintf(stderr, "%s\n", hs_simulation_error(simulation));
 *      hs_simulation_destroy(&simulation);
 *
 *  Any number of simulations live in one process; they share nothing. One simulation must not be used by two threads at
 *  the same time; different simulations may be (for H5MD files and checkpoints with an HDF5 that was built thread-safe, as
 *  Debian's). Numbers have a decimal point whatever the caller's locale is, and the caller's number of OpenMP threads stays
 *  as it was. Functions return a code and leave their message in hs_simulation_error.
 *  Lengths, energies and times are in the deck's `units`.
 *
 *  Arrays of vectors are n rows of x, y, z, owned by the caller. Their order is the caller's choice: HS_ORDER_ID is by
 *  increasing atom id and stays the same while atoms are neither made nor deleted; HS_ORDER_LOCAL is the order in
 *  memory, cheaper, and changes with every run or force evaluation.
 *
 *  Ranks. Where the program has called MPI_Init before it makes a simulation, the ranks of MPI_COMM_WORLD share it;
 *  else it runs on one. All functions are then collective (to be called by every rank, with the same arguments), and
 *  every rank gets the values of all atoms; only hs_simulation_stop, hs_simulation_error, hs_simulation_step,
 *  hs_simulation_n_atoms, hs_simulation_n_types, hs_simulation_box and hs_simulation_tilt may be called by one
 *  alone. */
#ifndef HALFSHELL_HALFSHELL_H
#define HALFSHELL_HALFSHELL_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define HS_API __attribute__((visibility("default")))
#else
#define HS_API
#endif

/** Outcome of a call; the numbers are the program's exit codes. */
typedef enum hs_code {
    HS_CODE_OK = 0,
    HS_CODE_INPUT = 1,      /**< the deck, a command, a file or an argument is wrong */
    HS_CODE_FAILED = 2,     /**< the run failed, a file could not be written, or memory ran out */
    HS_CODE_INTERRUPTED = 3 /**< hs_simulation_stop was called */
} hs_code;

/** Order of the rows of per-atom arrays. */
typedef enum hs_order { HS_ORDER_ID = 0, HS_ORDER_LOCAL = 1 } hs_order;

/** One simulation with its deck's variables. */
typedef struct hs_simulation hs_simulation;

/** Settings of a new simulation. Set `size` to sizeof(hs_simulation_options) and the rest to zero first (or use
 *  HS_SIMULATION_OPTIONS_INIT): programs built against this version then work with later ones that have more
 *  settings. */
typedef struct hs_simulation_options {
    size_t size;
    int n_threads;               /**< OpenMP threads, up to 4096; 0: OMP_NUM_THREADS, else 1 */
    const char *neighbor_method; /**< wins over the deck; NULL: the deck's or the default */
    const char *instruction_set; /**< of the kernels; NULL or "auto": the widest of this machine */
    FILE *screen; /**< where a run writes for people; borrowed for the simulation's life; NULL: nowhere */
    FILE *log;    /**< the same for the log; the deck's command `log` replaces it */
} hs_simulation_options;

#define HS_SIMULATION_OPTIONS_INIT                                                                                     \
    {                                                                                                                  \
        sizeof(hs_simulation_options), 0, NULL, NULL, NULL, NULL                                                       \
    }

/** Version of the library that is running, as in "0.1.0". Static. */
HS_API const char *hs_version(void);

/** New, empty simulation. The caller destroys it, also when this fails: the handle then only holds the message. NULL
 *  comes back in *simulation only when there is no memory at all, and all functions then fail with HS_CODE_FAILED.
 *  @p options may be NULL: the defaults, silent. */
HS_API hs_code hs_simulation_create(hs_simulation **simulation, const hs_simulation_options *options);
/** Free everything and clear the pointer. NULL is fine. Open dumps and logs are closed. */
HS_API void hs_simulation_destroy(hs_simulation **simulation);
/** What went wrong in the last call that failed, as "DECK:LINE: error: ..."; "" when the last call succeeded. Borrowed
 *  until the next call. */
HS_API const char *hs_simulation_error(const hs_simulation *simulation);

/** Give an index variable its values before the deck does, like `-var` on the command line. */
HS_API hs_code hs_simulation_set_variable(hs_simulation *simulation, const char *name, int n,
                                          const char *const *values);
/** Value of an equal-style (or other number-like) variable of the deck: any formula can be asked for this way. */
HS_API hs_code hs_simulation_get_variable(hs_simulation *simulation, const char *name, double *value);

/** Read a deck from a file and carry it out; nothing is done when its first pass finds an error. May be called
 *  again. */
HS_API hs_code hs_simulation_deck_file(hs_simulation *simulation, const char *path);
/** The same for a deck in memory: any number of lines. */
HS_API hs_code hs_simulation_deck_text(hs_simulation *simulation, const char *text);
/** Carry out one command, with variables substituted as in a deck. */
HS_API hs_code hs_simulation_command(hs_simulation *simulation, const char *line);
/** Run so many timesteps: the command `run N`. Computes forces first when they are not up to date. */
HS_API hs_code hs_simulation_run(hs_simulation *simulation, int64_t n_steps);
/** Ask a run to end after its present step; it then returns HS_CODE_INTERRUPTED, and the next run starts as usual. May
 *  be called from a signal handler and from other threads. */
HS_API void hs_simulation_stop(hs_simulation *simulation);

/** Number of the present timestep; 0 for a new simulation. */
HS_API int64_t hs_simulation_step(const hs_simulation *simulation);
/** Atoms, and atom types; 0 while there is no box. */
HS_API int64_t hs_simulation_n_atoms(const hs_simulation *simulation);
HS_API int hs_simulation_n_types(const hs_simulation *simulation);
/** The box: lower and upper corner, distance, and which axes are periodic (1 or 0). Any pointer may be NULL. An error
 *  while there is no box, as for all functions below. */
HS_API hs_code hs_simulation_box(hs_simulation *simulation, double lo[3], double hi[3], int periodic[3]);
/** Its tilts xy, xz, yz, distance, all 0 in an orthogonal box: the edges are (lx, 0, 0), (xy, ly, 0) and (xz, yz, lz),
 *  with lx = hi[0] - lo[0]. */
HS_API hs_code hs_simulation_tilt(hs_simulation *simulation, double tilt[3]);

/** A value of the thermo output by its keyword ("temp", "pe", "press", "lx", ...), normed as the deck's thermo output
 *  is. Computes forces first when they are not up to date. */
HS_API hs_code hs_simulation_thermo(hs_simulation *simulation, const char *keyword, double *value);

/* Per-atom arrays. @p n is the number of atoms the array has room for, which must be hs_simulation_n_atoms: the sizes
 * are checked, so that a stale array is an error and no overrun. Vectors take 3 n values. */

/** Positions inside the box, distance. */
HS_API hs_code hs_simulation_get_positions(hs_simulation *simulation, hs_order order, int64_t n, double *xyz);
/** Positions with the periodic images undone: the path an atom took; distance. */
HS_API hs_code hs_simulation_get_unwrapped(hs_simulation *simulation, hs_order order, int64_t n, double *xyz);
/** Velocities, distance/time. */
HS_API hs_code hs_simulation_get_velocities(hs_simulation *simulation, hs_order order, int64_t n, double *xyz);
/** Forces, energy/distance. Computes them first when they are not up to date, which may change the local order. */
HS_API hs_code hs_simulation_get_forces(hs_simulation *simulation, hs_order order, int64_t n, double *xyz);
/** Atom ids: 1, 2, ... without gaps unless atoms were deleted. */
HS_API hs_code hs_simulation_get_ids(hs_simulation *simulation, hs_order order, int64_t n, int64_t *ids);
/** Atom types, from 1. */
HS_API hs_code hs_simulation_get_types(hs_simulation *simulation, hs_order order, int64_t n, int32_t *types);
/** New positions, distance. Along periodic axes they are wrapped into the box, and the unwrapped positions are then the
 *  given ones; outside of a fixed face, or not a number, they are an error that changes nothing. Forces are computed
 *  anew when they are needed next. */
HS_API hs_code hs_simulation_set_positions(hs_simulation *simulation, hs_order order, int64_t n, const double *xyz);
/** New velocities, distance/time; a value that is not a number is an error that changes nothing. */
HS_API hs_code hs_simulation_set_velocities(hs_simulation *simulation, hs_order order, int64_t n, const double *xyz);

#ifdef __cplusplus
}
#endif

#endif
