/** Unit systems of the deck command `units`. */
#ifndef HS_CORE_UNITS_H
#define HS_CORE_UNITS_H

#include <stdbool.h>

/** Constants of one unit system; forces, energies, masses and velocities are used in the deck's own units. */
typedef struct hs_units {
    const char *name;
    double boltz;        /**< Boltzmann constant, energy/temperature */
    double mvv2e;        /**< mass velocity^2 -> energy */
    double ftm2v;        /**< force time / mass -> velocity */
    double nktv2p;       /**< energy/volume -> pressure */
    double dt;           /**< default timestep, time */
    double skin;         /**< default skin, distance */
    double mass_density; /**< mass/distance^3 -> what `thermo density` shows */
    double ns;           /**< nanoseconds in a unit of time; 0 in lj */
    bool is_extreme;     /**< numbers of atoms are so small that their powers do not fit into single precision */
    const char *time;    /**< name of the time unit, as in the log's Performance line: "tau", "fs", "ps" */
    int energy_per_atom; /**< thermo prints energies per atom by default (lj) */
    const char *distance_label, *energy_label, *pressure_label, *temperature_label, *time_label; /**< for plots */
    /** Of positions, velocities and forces in H5MD files, in the form of its module units; NULL in lj. */
    const char *h5md[3];
} hs_units;

/** The system of that name, or NULL. */
const hs_units *hs_units_find(const char *name);
/** Names of all systems, ended by NULL. */
extern const char *const hs_units_names[];

#endif
