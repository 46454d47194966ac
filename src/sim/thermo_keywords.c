/* The keywords of thermo output and their values. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "core/atom_style.h"
#include "sim/thermo_internal.h"
#include "style/atom_sum.h"

typedef hs_thermo T;

#define VALUE(name, expression)                                                                                        \
    static hs_status get_##name(T *t, double *value, hs_error *err)                                                    \
    {                                                                                                                  \
        (void)t, (void)err;                                                                                            \
        *value = (expression);                                                                                         \
        return HS_OK;                                                                                                  \
    }

/** Energies of the table are per atom under thermo_modify norm yes. */
static double per_atom(const T *t, double value)
{
    return t->is_norm && t->n_atoms > 0 ? value / (double)t->n_atoms : value;
}

static double elapsed_s(const T *t)
{
    double elapsed = t->sim->env.step == t->sim->env.first_step ? 0.0 : hs_time_now_s() - t->sim->timer.start_s;
    hs_parallel_broadcast(&t->sim->parallel, 0, &elapsed, sizeof elapsed);
    return elapsed;
}

static double remaining_s(const T *t)
{
    const hs_env *env = &t->sim->env;
    if (env->step == env->first_step) return 0.0;
    return elapsed_s(t) * (double)(env->last_step - env->step) / (double)(env->step - env->first_step);
}

static inline const hs_box *box(const T *t) { return &t->sim->box; }
static double cell_c(const hs_box *box)
{
    return sqrt(box->tilt[1] * box->tilt[1] + box->tilt[2] * box->tilt[2] +
                hs_box_length(box, 2) * hs_box_length(box, 2));
}
static double cell_angle(double cosine) { return acos(cosine) * 180.0 / M_PI; }

VALUE(step, (double)t->sim->env.step)
VALUE(elapsed, (double)(t->sim->env.step - t->sim->env.first_step))
VALUE(elaplong, (double)(t->sim->env.step - t->sim->env.ramp_start))
VALUE(dt, t->sim->env.dt)
VALUE(time, t->sim->env.time_origin + (double)(t->sim->env.step - t->sim->env.time_origin_step) * t->sim->env.dt)
VALUE(cpu, elapsed_s(t))
VALUE(cpuremain, remaining_s(t))
VALUE(zero, 0.0)
VALUE(atoms, (double)t->n_atoms)
VALUE(lx, hs_box_length(&t->sim->box, 0))
VALUE(ly, hs_box_length(&t->sim->box, 1))
VALUE(lz, hs_box_length(&t->sim->box, 2))
VALUE(xlo, t->sim->box.lo[0])
VALUE(xhi, t->sim->box.hi[0])
VALUE(ylo, t->sim->box.lo[1])
VALUE(yhi, t->sim->box.hi[1])
VALUE(zlo, t->sim->box.lo[2])
VALUE(zhi, t->sim->box.hi[2])
VALUE(xlat, t->sim->lattice.spacing[0])
VALUE(ylat, t->sim->lattice.spacing[1])
VALUE(zlat, t->sim->lattice.spacing[2])
VALUE(xy, t->sim->box.tilt[0])
VALUE(xz, t->sim->box.tilt[1])
VALUE(yz, t->sim->box.tilt[2])
VALUE(cellb, hypot(hs_box_length(box(t), 1), box(t)->tilt[0]))
VALUE(cellc, cell_c(box(t)))
VALUE(cellalpha, cell_angle((box(t)->tilt[0] * box(t)->tilt[1] + hs_box_length(box(t), 1) * box(t)->tilt[2]) /
                            (hypot(hs_box_length(box(t), 1), box(t)->tilt[0]) * cell_c(box(t)))))
VALUE(cellbeta, cell_angle(box(t)->tilt[1] / cell_c(box(t))))
VALUE(cellgamma, cell_angle(box(t)->tilt[0] / hypot(hs_box_length(box(t), 1), box(t)->tilt[0])))
VALUE(vol, hs_box_volume(&t->sim->box))
VALUE(nbuild, (double)t->sim->neighbor.counters.n_builds)
VALUE(ndanger, (double)t->sim->neighbor.counters.n_dangerous)

/** Simulated time per second of wall time since the last such value. */
static hs_status get_tpcpu(T *t, double *value, hs_error *err)
{
    double now_s = elapsed_s(t), time;
    HS_TRY(get_time(t, &time, err));
    const double spent_s = now_s - t->last_tpcpu_s;
    *value = now_s > 0.0 && spent_s > 0.0 ? (time - t->last_tpcpu_time) / spent_s : 0.0;
    t->last_tpcpu_s = now_s;
    t->last_tpcpu_time = time;
    return HS_OK;
}

/** Timesteps per second of wall time since the last such value. */
static hs_status get_spcpu(T *t, double *value, hs_error *err)
{
    (void)err;
    const double now_s = elapsed_s(t), spent_s = now_s - t->last_spcpu_s;
    *value = now_s > 0.0 && spent_s > 0.0 ? (double)(t->sim->env.step - t->last_spcpu_step) / spent_s : 0.0;
    t->last_spcpu_s = now_s;
    t->last_spcpu_step = t->sim->env.step;
    return HS_OK;
}

static hs_status get_temp(T *t, double *value, hs_error *err) { return hs_compute_scalar(t->temp, value, err); }
static hs_status get_press(T *t, double *value, hs_error *err) { return hs_compute_scalar(t->press, value, err); }

static hs_status get_pe(T *t, double *value, hs_error *err)
{
    HS_TRY(hs_compute_scalar(t->pe, value, err));
    *value = per_atom(t, *value);
    return HS_OK;
}

/** From the temperature, as a thermostat would see it: n_dof k T / 2. */
static hs_status get_ke(T *t, double *value, hs_error *err)
{
    HS_TRY(hs_compute_scalar(t->temp, value, err));
    *value = per_atom(t, 0.5 * t->temp->n_dof * t->sim->env.units->boltz * *value);
    return HS_OK;
}

static hs_status get_etotal(T *t, double *value, hs_error *err)
{
    double pe, ke;
    HS_TRY(get_pe(t, &pe, err));
    HS_TRY(get_ke(t, &ke, err));
    *value = pe + ke;
    return HS_OK;
}

/** What thermostats and barostats have given away. */
static hs_status get_ecouple(T *t, double *value, hs_error *err)
{
    double sum = 0.0;
    for (int k = 0; k < t->sim->n_fixes; ++k) {
        hs_fix *fix = t->sim->fix[k];
        double energy;
        if (!fix->is_coupling) continue;
        HS_TRY(fix->style->scalar(fix, &energy, err));
        sum += energy;
    }
    *value = per_atom(t, sum);
    return HS_OK;
}

static hs_status get_econserve(T *t, double *value, hs_error *err)
{
    double energy, coupled;
    HS_TRY(get_etotal(t, &energy, err));
    HS_TRY(get_ecouple(t, &coupled, err));
    *value = energy + coupled;
    return HS_OK;
}

static hs_status get_enthalpy(T *t, double *value, hs_error *err)
{
    double energy, pressure;
    HS_TRY(get_etotal(t, &energy, err));
    HS_TRY(get_press(t, &pressure, err));
    *value = energy + per_atom(t, pressure * hs_box_volume(&t->sim->box) / t->sim->env.units->nktv2p);
    return HS_OK;
}

/** Energy of the pair style; refused when this step did not compute it. */
static hs_status get_epair(T *t, double *value, hs_error *err)
{
    const hs_env *env = &t->sim->env;
    if (env->energy_step != env->step)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the pair energy of step %lld was not computed on that step; use it on steps with thermo "
                       "output, or after 'run 0'",
                       (long long)env->step);
    *value = per_atom(t, env->pair_energy + env->tail_energy);
    return HS_OK;
}

VALUE(etail, per_atom(t, t->sim->env.tail_energy))

static hs_status tensor(T *t, int i, double *value, hs_error *err)
{
    return hs_compute_vector(t->press, i, value, err);
}

static hs_status get_pxx(T *t, double *value, hs_error *err) { return tensor(t, 0, value, err); }
static hs_status get_pyy(T *t, double *value, hs_error *err) { return tensor(t, 1, value, err); }
static hs_status get_pzz(T *t, double *value, hs_error *err) { return tensor(t, 2, value, err); }
static hs_status get_pxy(T *t, double *value, hs_error *err) { return tensor(t, 3, value, err); }
static hs_status get_pxz(T *t, double *value, hs_error *err) { return tensor(t, 4, value, err); }
static hs_status get_pyz(T *t, double *value, hs_error *err) { return tensor(t, 5, value, err); }

static void add_f2(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    (void)context;
    for (int i = begin; i < end; ++i)
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[0], atoms->f[axis][i] * atoms->f[axis][i]);
}

static hs_status get_fnorm(T *t, double *value, hs_error *err)
{
    (void)err;
    hs_atom_sum(&t->sim->atoms, &t->sim->parallel, add_f2, NULL, 1, value);
    *value = sqrt(*value);
    return HS_OK;
}

static hs_status get_fmax(T *t, double *value, hs_error *err)
{
    (void)err;
    const hs_atoms *atoms = &t->sim->atoms;
    double max = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < atoms->n_local; ++i) max = fmax(max, fabs(atoms->f[axis][i]));
    hs_parallel_max_double(&t->sim->parallel, &max, 1);
    *value = max;
    return HS_OK;
}

static void add_mass(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    (void)context;
    for (int i = begin; i < end; ++i) hs_exact_add(&sums[0], hs_atom_mass(atoms, i));
}

/** Mass density: mass/distance^3, but gram/cm^3 in real and metal units (masses there are gram/mole). */
static hs_status get_density(T *t, double *value, hs_error *err)
{
    (void)err;
    hs_atom_sum(&t->sim->atoms, &t->sim->parallel, add_mass, NULL, 1, value);
    *value *= t->sim->env.units->mass_density / hs_box_volume(&t->sim->box);
    return HS_OK;
}

/* KEYWORD(name, getter, header, quantity, is whole number, help) */
#define KEYWORDS(KEYWORD)                                                                                              \
    KEYWORD(step, step, "Step", "step", true, "number of the timestep")                                                \
    KEYWORD(elapsed, elapsed, "Elapsed", "step", true, "timesteps since the start of this run")                        \
    KEYWORD(elaplong, elaplong, "Elaplong", "step", true, "timesteps since the start of a series of runs")             \
    KEYWORD(dt, dt, "Dt", "time", false, "timestep size")                                                              \
    KEYWORD(time, time, "Time", "time", false, "simulated time")                                                       \
    KEYWORD(cpu, cpu, "CPU", NULL, false, "wall time since the start of this run, seconds")                            \
    KEYWORD(tpcpu, tpcpu, "T/CPU", NULL, false, "simulated time per second of wall time")                              \
    KEYWORD(spcpu, spcpu, "S/CPU", NULL, false, "timesteps per second of wall time")                                   \
    KEYWORD(cpuremain, cpuremain, "CPULeft", NULL, false, "estimated wall time to the end of the run, s")              \
    KEYWORD(part, zero, "Part", NULL, true, "partition of a multi-replica run: always 0")                              \
    KEYWORD(timeremain, zero, "TimeoutLeft", NULL, false, "seconds left of a time limit: 0, there is none")            \
    KEYWORD(atoms, atoms, "Atoms", "count", true, "number of atoms")                                                   \
    KEYWORD(temp, temp, "Temp", "temperature", false, "temperature")                                                   \
    KEYWORD(press, press, "Press", "pressure", false, "pressure")                                                      \
    KEYWORD(pe, pe, "PotEng", "energy", false, "potential energy")                                                     \
    KEYWORD(ke, ke, "KinEng", "energy", false, "kinetic energy")                                                       \
    KEYWORD(etotal, etotal, "TotEng", "energy", false, "total energy, pe + ke")                                        \
    KEYWORD(evdwl, epair, "E_vdwl", "energy", false, "van der Waals energy of pairs, with tail")                       \
    KEYWORD(ecoul, zero, "E_coul", "energy", false, "Coulomb energy of pairs: 0, this version has none")               \
    KEYWORD(epair, epair, "E_pair", "energy", false, "energy of all pairs, evdwl + ecoul + elong")                     \
    KEYWORD(ebond, zero, "E_bond", "energy", false, "bond energy: 0, this version has none")                           \
    KEYWORD(eangle, zero, "E_angle", "energy", false, "angle energy: 0")                                               \
    KEYWORD(edihed, zero, "E_dihed", "energy", false, "dihedral energy: 0")                                            \
    KEYWORD(eimp, zero, "E_impro", "energy", false, "improper energy: 0")                                              \
    KEYWORD(emol, zero, "E_mol", "energy", false, "molecular energy, ebond + eangle + edihed + eimp: 0")               \
    KEYWORD(elong, zero, "E_long", "energy", false, "long-range Coulomb energy: 0")                                    \
    KEYWORD(etail, etail, "E_tail", "energy", false, "long-range correction of pair_modify tail yes")                  \
    KEYWORD(enthalpy, enthalpy, "Enthalpy", "energy", false, "enthalpy, etotal + press * vol")                         \
    KEYWORD(ecouple, ecouple, "Ecouple", "energy", false, "energy given to thermostats and barostats")                 \
    KEYWORD(econserve, econserve, "Econserve", "energy", false, "conserved energy, etotal + ecouple")                  \
    KEYWORD(vol, vol, "Volume", "volume", false, "volume (area in two dimensions)")                                    \
    KEYWORD(density, density, "Density", "density", false, "mass density")                                             \
    KEYWORD(lx, lx, "Lx", "distance", false, "box length in x")                                                        \
    KEYWORD(ly, ly, "Ly", "distance", false, "box length in y")                                                        \
    KEYWORD(lz, lz, "Lz", "distance", false, "box length in z")                                                        \
    KEYWORD(xlo, xlo, "Xlo", "distance", false, "lower box bound in x")                                                \
    KEYWORD(xhi, xhi, "Xhi", "distance", false, "upper box bound in x")                                                \
    KEYWORD(ylo, ylo, "Ylo", "distance", false, "lower box bound in y")                                                \
    KEYWORD(yhi, yhi, "Yhi", "distance", false, "upper box bound in y")                                                \
    KEYWORD(zlo, zlo, "Zlo", "distance", false, "lower box bound in z")                                                \
    KEYWORD(zhi, zhi, "Zhi", "distance", false, "upper box bound in z")                                                \
    KEYWORD(xy, xy, "Xy", "distance", false, "tilt of the box, of y along x")                                          \
    KEYWORD(xz, xz, "Xz", "distance", false, "tilt of z along x")                                                      \
    KEYWORD(yz, yz, "Yz", "distance", false, "tilt of z along y")                                                      \
    KEYWORD(xlat, xlat, "Xlat", "distance", false, "lattice spacing in x")                                             \
    KEYWORD(ylat, ylat, "Ylat", "distance", false, "lattice spacing in y")                                             \
    KEYWORD(zlat, zlat, "Zlat", "distance", false, "lattice spacing in z")                                             \
    KEYWORD(bonds, zero, "Bonds", "count", true, "number of bonds: 0")                                                 \
    KEYWORD(angles, zero, "Angles", "count", true, "number of angles: 0")                                              \
    KEYWORD(dihedrals, zero, "Diheds", "count", true, "number of dihedrals: 0")                                        \
    KEYWORD(impropers, zero, "Impros", "count", true, "number of impropers: 0")                                        \
    KEYWORD(pxx, pxx, "Pxx", "pressure", false, "pressure tensor, xx")                                                 \
    KEYWORD(pyy, pyy, "Pyy", "pressure", false, "pressure tensor, yy")                                                 \
    KEYWORD(pzz, pzz, "Pzz", "pressure", false, "pressure tensor, zz")                                                 \
    KEYWORD(pxy, pxy, "Pxy", "pressure", false, "pressure tensor, xy")                                                 \
    KEYWORD(pxz, pxz, "Pxz", "pressure", false, "pressure tensor, xz")                                                 \
    KEYWORD(pyz, pyz, "Pyz", "pressure", false, "pressure tensor, yz")                                                 \
    KEYWORD(fmax, fmax, "Fmax", "force", false, "largest force component on any atom")                                 \
    KEYWORD(fnorm, fnorm, "Fnorm", "force", false, "length of the vector of all forces")                               \
    KEYWORD(nbuild, nbuild, "Nbuild", "count", true, "neighbor list builds of this run")                               \
    KEYWORD(ndanger, ndanger, "Ndanger", "count", true, "dangerous neighbor list builds of this run")                  \
    KEYWORD(cella, lx, "Cella", "distance", false, "length of the cell vector a")                                      \
    KEYWORD(cellb, cellb, "Cellb", "distance", false, "length of the cell vector b")                                   \
    KEYWORD(cellc, cellc, "Cellc", "distance", false, "length of the cell vector c")                                   \
    KEYWORD(cellalpha, cellalpha, "CellAlpha", NULL, false, "cell angle alpha, degrees")                               \
    KEYWORD(cellbeta, cellbeta, "CellBeta", NULL, false, "cell angle beta, degrees")                                   \
    KEYWORD(cellgamma, cellgamma, "CellGamma", NULL, false, "cell angle gamma, degrees")
#define ENTRY(name, getter, header, quantity, is_int, help) {#name, header, quantity, is_int, get_##getter},
#define HELP(name, getter, header, quantity, is_int, help)  #name, help,
#define NAME(name, getter, header, quantity, is_int, help)  #name,

static const hs_thermo_entry entries[] = {KEYWORDS(ENTRY)};
static const char *const names[] = {KEYWORDS(NAME)};
const char *const hs_thermo_keywords[] = {KEYWORDS(HELP) NULL, NULL};

enum { N_ENTRIES = sizeof entries / sizeof entries[0] };

const hs_thermo_entry *hs_thermo_find_entry(const char *name)
{
    for (int k = 0; k < N_ENTRIES; ++k)
        if (strcmp(entries[k].name, name) == 0) return &entries[k];
    return NULL;
}

const char *hs_thermo_quantity(const char *keyword)
{
    const hs_thermo_entry *entry = hs_thermo_find_entry(keyword);
    return entry != NULL ? entry->quantity : NULL;
}

const char *hs_thermo_check_word(const char *word)
{
    if (strchr(word, '$') != NULL || hs_value_is_reference(word) || hs_thermo_find_entry(word) != NULL) return NULL;
    const char *nearest = hs_text_nearest(word, names, N_ENTRIES);
    return nearest != NULL ? nearest : "";
}

hs_status hs_thermo_keyword(hs_thermo *thermo, const char *keyword, double *value, bool *found, hs_error *err)
{
    const hs_thermo_entry *entry = hs_thermo_find_entry(keyword);
    *found = entry != NULL;
    if (entry == NULL) return HS_OK;
    HS_TRY(hs_thermo_find_computes(thermo, err));
    return entry->eval(thermo, value, err);
}
