/** Integration at constant temperature and pressure: what fix nvt, fix npt and fix nph share.
 *
 *  Nose-Hoover chains for the temperature, a barostat of Martyna, Tobias and Klein with a chain of its own for the pressure:
 *
 *      x' = v + w (x - x0)         V' = V tr(w)
 *      v' = f/m - (w + tr(w)/(d N)) v - (p_eta/Q) v
 *      W w' = V (P - P0) + (kinetic energy term) - (chain)
 *
 *  with the strain rates w of the axes. In a flow (SLLOD) v' = f/m - G (v - u) - (p_eta/Q) (v - u) with the velocity u of the place and
 *  its gradient G (D. J. Evans, G. P. Morriss, Phys. Rev. A 30, 1528 (1984), doi:10.1103/PhysRevA.30.1528). Every step is a product of exactly solved parts, symmetric in time. Sources:
 *  G. J. Martyna, D. J. Tobias, M. L. Klein, J. Chem. Phys. 101, 4177 (1994), doi:10.1063/1.467468;
 *  G. J. Martyna et al., Mol. Phys. 87, 1117 (1996), doi:10.1080/00268979600100761;
 *  M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), doi:10.1088/0305-4470/39/19/S18. */
#ifndef HS_STYLE_NOSE_HOOVER_H
#define HS_STYLE_NOSE_HOOVER_H

#include "style/compute.h"
#include "style/fix.h"
#include "style/nh_chain.h"

typedef enum { HS_NH_NONE, HS_NH_XYZ, HS_NH_XY, HS_NH_YZ, HS_NH_XZ } hs_nh_coupling;

/** State of such a fix. */
typedef struct hs_nose_hoover {
    bool has_thermostat, has_barostat;
    bool is_sllod;   /**< the velocities follow a box that changes; set by the style before hs_nose_hoover_create */
    bool is_p_sllod; /**< G v instead of G (v - u): the variant p-SLLOD */
    char *temperature_id, *pressure_id; /**< owned; of fix_modify temp, press; NULL: the fix's own */
    double dt;

    double t_start, t_stop, t_rate; /**< temperature, and 1/damping time */
    double t_fixed;         /**< ptemp: sets the barostat's masses without a thermostat; 0: the first temperature */
    double t_target, t_now; /**< temperature */
    double n_dof;
    double drag;
    hs_nh_chain chain;

    bool axis[3]; /**< that the barostat acts on */
    int n_axes;
    bool is_iso; /**< one strain for all axes, from the scalar pressure */
    hs_nh_coupling coupling;
    bool has_strain_energy;                  /**< x, y or z was given: targets may be unequal */
    double p_start[3], p_stop[3], p_rate[3]; /**< pressure, and 1/damping time */
    double p_target[3], p_mean;              /**< of the present step */
    double p_now[3];
    double strain[3], strain_rate[3]; /**< integral of w; w, 1/time */
    double mass[3];                   /**< W, energy time^2 */
    double kinetic_term;              /**< tr(w)/(d N) of the last update */
    hs_nh_chain barostat_chain;
    bool is_mtk;                          /**< with the terms that make the ensemble right */
    int64_t reset_every;                  /**< steps after which the reference box is set anew; 0: never */
    double v_reference, inv_reference[3]; /**< volume and 1/lengths of the reference box; 0: not set yet */
    double fixed_point[3];                /**< place that the strain leaves where it is, distance */
    uint32_t dilate;                      /**< group bits of the atoms that follow the box */
    bool scales_tilt[3];                  /**< xy, xz, yz keep their ratio to the length along their second axis */
} hs_nose_hoover;

/** Keywords of nvt, of nvt/sllod, and of npt and nph. */
extern const hs_keyword hs_nose_hoover_nvt_keywords[], hs_nose_hoover_sllod_keywords[], hs_nose_hoover_npt_keywords[];

HS_MUST_USE hs_status hs_nose_hoover_create(hs_fix *fix, const hs_args *args, bool has_thermostat, bool has_barostat,
                                            hs_error *err);
void hs_nose_hoover_destroy(hs_fix *fix);
HS_MUST_USE hs_status hs_nose_hoover_init(hs_fix *fix, hs_error *err);
/** ->dt_changed */
HS_MUST_USE hs_status hs_nose_hoover_take_dt(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_setup(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_initial_integrate(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_final_integrate(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_scalar(hs_fix *fix, double *value, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_vector(hs_fix *fix, int i, double *value, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_keep_state(hs_fix *fix, hs_state *kept, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_set_temperature(hs_fix *fix, const char *id, hs_error *err);
HS_MUST_USE hs_status hs_nose_hoover_set_pressure(hs_fix *fix, const char *id, hs_error *err);
bool hs_nose_hoover_needs_energy(const hs_fix *fix, int64_t step);

/** The hooks that all three descriptors have, and their reference. */
#define HS_NOSE_HOOVER_HOOKS                                                                                           \
    .state_size = sizeof(hs_nose_hoover), .create = create, .destroy = hs_nose_hoover_destroy,                         \
    .dt_changed = hs_nose_hoover_take_dt, .setup = hs_nose_hoover_setup,                                               \
    .initial_integrate = hs_nose_hoover_initial_integrate, .final_integrate = hs_nose_hoover_final_integrate,          \
    .keep_state = hs_nose_hoover_keep_state, .scalar = hs_nose_hoover_scalar, .vector = hs_nose_hoover_vector,         \
    .set_temperature = hs_nose_hoover_set_temperature, .is_extensive = true, .is_integrator = true,                    \
    .is_coupling = true
/** And those of the ones with a barostat. */
#define HS_NOSE_HOOVER_PRESSURE_HOOKS                                                                                  \
    .set_pressure = hs_nose_hoover_set_pressure, .needs_energy = hs_nose_hoover_needs_energy, .changes_box = true
#define HS_NOSE_HOOVER_REFERENCE                                                                                       \
    "G. J. Martyna, D. J. Tobias, M. L. Klein, J. Chem. Phys. 101, 4177 (1994), doi:10.1063/1.467468; "                \
    "M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), doi:10.1088/0305-4470/39/19/S18"
/** Paragraphs of the manual that npt and nph share. */
#define HS_NOSE_HOOVER_PRESSURE_DETAILS                                                                                \
    "`iso` changes all lengths of the box alike, by the scalar pressure; `aniso` (one target) and `x`, "               \
    "`y`, `z` (each its own, and only those axes) let them change on their own; `couple` gives some of "               \
    "those the mean of their pressures. The box must be periodic along axes that change. In a tilted box a "           \
    "tilt is scaled with the length along its second axis (xy with y, xz and yz with z), so that angles between "      \
    "edges "                                                                                                           \
    "stay, unless `scalexy no` or the like is said; pressures that change tilts are not supported. Pdamp is the "      \
    "time in which the pressure relaxes, usually some thousand timesteps. Atoms of the group `dilate` "                \
    "follow the box as their fractions of it, around `fixedpoint`.\n\nWhere targets are unequal, the "                 \
    "stress that the difference does work against refers to the box at the start (Parrinello and "                     \
    "Rahman), or to that of the last `nreset`. `mtk no` leaves out two terms of order 1/N.\n\n"                        \
    "The fix makes the computes `ID_temp` and `ID_press`, both of all atoms; "                                         \
    "`fix_modify temp` and `press` take others. Energies and virials are computed at every step, which "               \
    "costs some speed.\n\nThe scalar `f_ID` is the energy given to thermostat and barostat: with that of "             \
    "the atoms it is constant (`econserve` in thermo output). The vector `f_ID[i]` has, in this order: "               \
    "places and rates of the thermostats (npt), strains and strain rates (one with one pressure for all "              \
    "axes, else three), places and rates of the barostat's thermostats; then, in the same order, the "                 \
    "potential and kinetic energies of all these, and with x, y or z the strain energy."

/* Between the files style/nose_hoover*.c. */
/** Pressure times volume that unequal targets add along an axis, relative to the reference box.
 *  M. Parrinello, A. Rahman, J. Appl. Phys. 52, 7182 (1981), doi:10.1063/1.328693. */
double hs_nose_hoover_deviatoric(const hs_nose_hoover *nh, const hs_box *box, int axis);
/** What the chain of the barostat keeps, energy. */
double hs_nose_hoover_barostat_target(const hs_nose_hoover *nh, double kt);
/** Length of the vector f_ID. */
int hs_nose_hoover_n_vector(const hs_nose_hoover *nh);
/** Scale the thermal velocities of the group: by the bias of @p temperature. */
void hs_nose_hoover_scale(const hs_fix *fix, const hs_compute *temperature, const double factor[3]);
/** Scale them and let the flow act on them, for half a step. @p temperature NULL: the flow itself is the bias. */
void hs_nose_hoover_flow(const hs_fix *fix, const hs_compute *temperature, double factor);
/** Half a step of the velocities, and a step of the places. */
void hs_nose_hoover_kick(const hs_fix *fix);
void hs_nose_hoover_drift(const hs_fix *fix);
/** Read the words; part of create. */
HS_MUST_USE hs_status hs_nose_hoover_read(hs_fix *fix, const hs_args *args, hs_error *err);

#endif
