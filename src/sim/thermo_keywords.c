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

const hs_thermo_entry hs_thermo_entries[] = {
    {"step", "Step", "number of the timestep", true, get_step},
    {"elapsed", "Elapsed", "timesteps since the start of this run", true, get_elapsed},
    {"elaplong", "Elaplong", "timesteps since the start of a series of runs", true, get_elaplong},
    {"dt", "Dt", "timestep size", false, get_dt},
    {"time", "Time", "simulated time", false, get_time},
    {"cpu", "CPU", "wall time since the start of this run, seconds", false, get_cpu},
    {"tpcpu", "T/CPU", "simulated time per second of wall time", false, get_tpcpu},
    {"spcpu", "S/CPU", "timesteps per second of wall time", false, get_spcpu},
    {"cpuremain", "CPULeft", "estimated wall time to the end of the run, s", false, get_cpuremain},
    {"part", "Part", "partition of a multi-replica run: always 0", true, get_zero},
    {"timeremain", "TimeoutLeft", "seconds left of a time limit: 0, there is none", false, get_zero},
    {"atoms", "Atoms", "number of atoms", true, get_atoms},
    {"temp", "Temp", "temperature", false, get_temp},
    {"press", "Press", "pressure", false, get_press},
    {"pe", "PotEng", "potential energy", false, get_pe},
    {"ke", "KinEng", "kinetic energy", false, get_ke},
    {"etotal", "TotEng", "total energy, pe + ke", false, get_etotal},
    {"evdwl", "E_vdwl", "van der Waals energy of pairs, with tail", false, get_epair},
    {"ecoul", "E_coul", "Coulomb energy of pairs: 0, this version has none", false, get_zero},
    {"epair", "E_pair", "energy of all pairs, evdwl + ecoul + elong", false, get_epair},
    {"ebond", "E_bond", "bond energy: 0, this version has none", false, get_zero},
    {"eangle", "E_angle", "angle energy: 0", false, get_zero},
    {"edihed", "E_dihed", "dihedral energy: 0", false, get_zero},
    {"eimp", "E_impro", "improper energy: 0", false, get_zero},
    {"emol", "E_mol", "molecular energy, ebond + eangle + edihed + eimp: 0", false, get_zero},
    {"elong", "E_long", "long-range Coulomb energy: 0", false, get_zero},
    {"etail", "E_tail", "long-range correction of pair_modify tail yes", false, get_etail},
    {"enthalpy", "Enthalpy", "enthalpy, etotal + press * vol", false, get_enthalpy},
    {"ecouple", "Ecouple", "energy given to thermostats and barostats", false, get_ecouple},
    {"econserve", "Econserve", "conserved energy, etotal + ecouple", false, get_econserve},
    {"vol", "Volume", "volume (area in two dimensions)", false, get_vol},
    {"density", "Density", "mass density", false, get_density},
    {"lx", "Lx", "box length in x", false, get_lx},
    {"ly", "Ly", "box length in y", false, get_ly},
    {"lz", "Lz", "box length in z", false, get_lz},
    {"xlo", "Xlo", "lower box bound in x", false, get_xlo},
    {"xhi", "Xhi", "upper box bound in x", false, get_xhi},
    {"ylo", "Ylo", "lower box bound in y", false, get_ylo},
    {"yhi", "Yhi", "upper box bound in y", false, get_yhi},
    {"zlo", "Zlo", "lower box bound in z", false, get_zlo},
    {"zhi", "Zhi", "upper box bound in z", false, get_zhi},
    {"xy", "Xy", "tilt of the box, of y along x", false, get_xy},
    {"xz", "Xz", "tilt of z along x", false, get_xz},
    {"yz", "Yz", "tilt of z along y", false, get_yz},
    {"xlat", "Xlat", "lattice spacing in x", false, get_xlat},
    {"ylat", "Ylat", "lattice spacing in y", false, get_ylat},
    {"zlat", "Zlat", "lattice spacing in z", false, get_zlat},
    {"bonds", "Bonds", "number of bonds: 0", true, get_zero},
    {"angles", "Angles", "number of angles: 0", true, get_zero},
    {"dihedrals", "Diheds", "number of dihedrals: 0", true, get_zero},
    {"impropers", "Impros", "number of impropers: 0", true, get_zero},
    {"pxx", "Pxx", "pressure tensor, xx", false, get_pxx},
    {"pyy", "Pyy", "pressure tensor, yy", false, get_pyy},
    {"pzz", "Pzz", "pressure tensor, zz", false, get_pzz},
    {"pxy", "Pxy", "pressure tensor, xy", false, get_pxy},
    {"pxz", "Pxz", "pressure tensor, xz", false, get_pxz},
    {"pyz", "Pyz", "pressure tensor, yz", false, get_pyz},
    {"fmax", "Fmax", "largest force component on any atom", false, get_fmax},
    {"fnorm", "Fnorm", "length of the vector of all forces", false, get_fnorm},
    {"nbuild", "Nbuild", "neighbor list builds of this run", true, get_nbuild},
    {"ndanger", "Ndanger", "dangerous neighbor list builds of this run", true, get_ndanger},
    {"cella", "Cella", "length of the cell vector a", false, get_lx},
    {"cellb", "Cellb", "length of the cell vector b", false, get_cellb},
    {"cellc", "Cellc", "length of the cell vector c", false, get_cellc},
    {"cellalpha", "CellAlpha", "cell angle alpha, degrees", false, get_cellalpha},
    {"cellbeta", "CellBeta", "cell angle beta, degrees", false, get_cellbeta},
    {"cellgamma", "CellGamma", "cell angle gamma, degrees", false, get_cellgamma},
    {NULL, NULL, NULL, false, NULL},
};

const hs_thermo_entry *hs_thermo_find_entry(const char *name)
{
    for (const hs_thermo_entry *entry = hs_thermo_entries; entry->name != NULL; ++entry)
        if (strcmp(entry->name, name) == 0) return entry;
    return NULL;
}

const char *hs_thermo_nearest(const char *word)
{
    enum { MAX = 256 };
    const char *names[MAX];
    size_t n = 0;
    for (; hs_thermo_entries[n].name != NULL && n < MAX; ++n) names[n] = hs_thermo_entries[n].name;
    return hs_text_nearest(word, names, n);
}

const char *hs_thermo_check_word(const char *word)
{
    if (strchr(word, '$') != NULL || hs_value_is_reference(word) || hs_thermo_find_entry(word) != NULL) return NULL;
    const char *nearest = hs_thermo_nearest(word);
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
