/** Integration at constant temperature and pressure: what fix nvt, fix npt and fix nph share.
 *
 *  Nose-Hoover chains for the temperature, a barostat of Martyna, Tobias and Klein with a chain of its own for the pressure:
 *
 *      x' = v + w (x - x0)         h' = w h
 *      v' = f/m - (w + tr(w)/(d N)) v - (p_eta/Q) v
 *      W w' = V (P - P0) + (kinetic energy term) - (strain energy term) - (chain)
 *
 *  with the edges of the box as columns of h and the strain rates w, an upper triangle as h: those of the lengths, and in
 *  tilted boxes those of the tilts. The strain energy (style/strain_energy.h) is that of targets which are not the same along
 *  all axes. In a flow (SLLOD) v' = f/m - G (v - u) - (p_eta/Q) (v - u) with the velocity u of the place and
 *  its gradient G (D. J. Evans, G. P. Morriss, Phys. Rev. A 30, 1528 (1984), doi:10.1103/PhysRevA.30.1528). Every step is a
 *  product of exactly solved parts, symmetric in time. Sources:
 *  G. J. Martyna, D. J. Tobias, M. L. Klein, J. Chem. Phys. 101, 4177 (1994), doi:10.1063/1.467468;
 *  G. J. Martyna et al., Mol. Phys. 87, 1117 (1996), doi:10.1080/00268979600100761;
 *  W. Shinoda, M. Shiga, M. Mikami, Phys. Rev. B 69, 134103 (2004), doi:10.1103/PhysRevB.69.134103;
 *  M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), doi:10.1088/0305-4470/39/19/S18. */
#ifndef HS_STYLE_NOSE_HOOVER_H
#define HS_STYLE_NOSE_HOOVER_H

#include "style/barometer.h"
#include "style/nh_chain.h"
#include "style/spheres.h"
#include "style/strain_energy.h"

/** Components of pressure and strain, in this order: x y z xy xz yz. */
enum { HS_NH_XY = 3, HS_NH_COMPONENTS = 6 };

/** State of such a fix. */
typedef struct hs_nose_hoover {
    bool has_thermostat, has_barostat;
    bool is_sllod;      /**< the velocities follow a box that changes; set by the style before hs_nose_hoover_create */
    hs_spheres spheres; /**< has_rotation: the atoms turn, too; set by the style before hs_nose_hoover_create */
    bool is_p_sllod;    /**< G v instead of G (v - u): the variant p-SLLOD */
    hs_barometer barometer; /**< is_iso: one strain for all axes, from the scalar pressure */
    double dt;

    double t_start, t_stop, t_rate; /**< temperature, and 1/damping time */
    double t_fixed;         /**< ptemp: sets the barostat's masses without a thermostat; 0: the first temperature */
    double t_target, t_now; /**< temperature */
    /** Twice the target's kinetic energy, with the degrees of freedom at the start of the step. */
    double kinetic_target;
    double n_dof;
    double drag;
    hs_nh_chain chain;

    bool moves[HS_NH_COMPONENTS]; /**< what the barostat acts on */
    int n_axes, n_moves;          /**< axes among these, and all */
    bool has_tilts;               /**< some of these are tilts */
    bool has_strain_energy;       /**< components were given one by one: targets may be unequal */
    double p_start[HS_NH_COMPONENTS], p_stop[HS_NH_COMPONENTS]; /**< pressure */
    double p_rate[HS_NH_COMPONENTS];                            /**< 1/damping time */
    double p_target[HS_NH_COMPONENTS], p_mean;                  /**< of the present step; p_mean: of the axes */
    double p_now[HS_NH_COMPONENTS];
    double strain[HS_NH_COMPONENTS], strain_rate[HS_NH_COMPONENTS]; /**< integral of w; w, 1/time */
    double mass[HS_NH_COMPONENTS];                                  /**< W, energy time^2 */
    double kinetic_term;                                            /**< tr(w)/(d N) of the last update */
    hs_nh_chain barostat_chain;
    bool is_mtk;               /**< with the terms that make the ensemble right */
    int64_t reset_every;       /**< steps after which the reference box is set anew; 0: never */
    bool has_reference;        /**< the next is set */
    hs_box reference;          /**< that strains refer to; its edges only */
    hs_strain_energy strained; /**< of the present targets, relative to it */
    double fixed_point[3];     /**< place that the strain leaves where it is, distance */
    uint32_t dilate;           /**< group bits of the atoms that follow the box */
    bool scales_tilt[3];       /**< xy, xz, yz keep their ratio to the length along their second axis */
    bool has_flips;            /**< a box too skewed gives way to an equivalent one */
} hs_nose_hoover;

/** Keywords of nvt, of nvt/sllod, and of npt and nph. */
extern const hs_keyword hs_nose_hoover_nvt_keywords[], hs_nose_hoover_sllod_keywords[], hs_nose_hoover_npt_keywords[];
/** The same for spheres that turn. */
extern const hs_keyword hs_nose_hoover_nvt_sphere_keywords[], hs_nose_hoover_npt_sphere_keywords[];

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
/** ->pre_exchange: flips. */
HS_MUST_USE hs_status hs_nose_hoover_pre_exchange(hs_fix *fix, hs_error *err);

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
    .set_pressure = hs_nose_hoover_set_pressure, .needs_energy = hs_nose_hoover_needs_energy,                          \
    .pre_exchange = hs_nose_hoover_pre_exchange, .changes_box = true
#define HS_NOSE_HOOVER_REFERENCE                                                                                       \
    "G. J. Martyna, D. J. Tobias, M. L. Klein, J. Chem. Phys. 101, 4177 (1994), doi:10.1063/1.467468; "                \
    "W. Shinoda, M. Shiga, M. Mikami, Phys. Rev. B 69, 134103 (2004), doi:10.1103/PhysRevB.69.134103; "                \
    "M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), doi:10.1088/0305-4470/39/19/S18"
/** Paragraphs of the manual that npt and nph share. */
#define HS_NOSE_HOOVER_PRESSURE_DETAILS                                                                                \
    "`iso` changes all lengths of the box alike, by the scalar pressure; `aniso` (one target) and `x`, "               \
    "`y`, `z` (each its own, and only those axes) let them change on their own; `couple` gives some of "               \
    "those the mean of their pressures. In a tilted box `tri` lets the tilts change, too, until there is "             \
    "no shear stress, and `xy`, `xz`, `yz` let single ones follow targets of their own. The box must be "              \
    "periodic along axes that change (`xy`: along y). A tilt without a target is scaled with the length "              \
    "along its second axis (xy with y, xz and yz with z), so that angles between edges stay, unless "                  \
    "`scalexy no` or the like is said. Pdamp is the time in which the pressure relaxes, usually some "                 \
    "thousand timesteps. Atoms of the group `dilate` follow the box as their fractions of it, around "                 \
    "`fixedpoint`.\n\nA tilt that has become more than 0.6 of the length along its first axis gives way "              \
    "to an equivalent one with the next neighbor lists, unless `flip no` is said. A liquid bears no shear "            \
    "stress: its box goes on tilting under a target that is not 0.\n\nWhere targets are unequal, or of "               \
    "tilts, the stress that the difference does work against refers to the box at the start (Parrinello "              \
    "and Rahman), or to that of the last `nreset`. `mtk no` leaves out two terms of order 1/N.\n\nThe fix "            \
    "makes the computes `ID_temp` and `ID_press`, both of all atoms; `fix_modify temp` and `press` take "              \
    "others. Energies and virials are computed at every step, which costs some speed.\n\nThe scalar "                  \
    "`f_ID` is the energy given to thermostat and barostat: with that of the atoms it is constant "                    \
    "(`econserve` in thermo output). The vector `f_ID[i]` has, in this order: places and rates of the "                \
    "thermostats (npt), strains and strain rates (one with one pressure for all axes, else three, and "                \
    "with tilts six: x y z yz xz xy), places and rates of the barostat's thermostats; then, in the same "              \
    "order, the potential and kinetic energies of all these, and the strain energy where targets were "                \
    "given one by one."

#endif
