/* What of a simulation is kept in a checkpoint, and how it is set up again. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "sim/methods.h"
#include "sim/saving.h"
#include "sim/thermo.h"
#include "style/pair_coeffs.h"

/** Tilts, which only tilted boxes keep. */
static hs_status keep_tilt(bool is_tilted, const char *name, double tilt[3], hs_state *state, hs_error *err)
{
    if (state->is_reading && !is_tilted) memset(tilt, 0, 3 * sizeof *tilt);
    return is_tilted ? hs_state_double(state, name, tilt, 3, err) : HS_OK;
}

hs_status hs_sim_keep_box(hs_sim *sim, hs_state *state, hs_error *err)
{
    hs_box *box = &sim->box;
    int64_t boundary[6];
    HS_TRY(hs_state_int(state, "types", &sim->atoms.n_types, err));
    HS_TRY(hs_state_int(state, "dimension", &box->dimension, err));
    HS_TRY(hs_state_bool(state, "exists", &box->exists, err));
    HS_TRY(hs_state_double(state, "lo", box->lo, 3, err));
    HS_TRY(hs_state_double(state, "hi", box->hi, 3, err));
    HS_TRY(hs_state_double(state, "shrink margin", box->shrink_margin, 3, err));
    HS_TRY(hs_state_double(state, "shrink limit", &box->shrink_limit[0][0], 6, err));
    if (state->is_reading) box->is_tilted = hs_state_find(state, "tilt") != NULL;
    HS_TRY(keep_tilt(box->is_tilted, "tilt", box->tilt, state, err));
    for (int k = 0; k < 6; ++k) boundary[k] = box->boundary[k / 2][k % 2];
    HS_TRY(hs_state_int64(state, "boundary", boundary, 6, err));
    for (int k = 0; k < 6; ++k) {
        if (strchr("pfsm", (int)(boundary[k] & 0x7f)) == NULL || boundary[k] <= 0 || boundary[k] > 'z')
            return hs_fail(err, HS_ERROR_INPUT, "the boundary has an unknown kind");
        box->boundary[k / 2][k % 2] = (hs_boundary)boundary[k];
        box->periodic[k / 2] = boundary[k] == 'p';
    }
    for (int axis = 0; axis < 3; ++axis)
        if (box->exists && !(box->hi[axis] > box->lo[axis])) return hs_fail(err, HS_ERROR_INPUT, "the box is empty");
    if (sim->atoms.n_types < 0 || sim->atoms.n_types > 1000000)
        return hs_fail(err, HS_ERROR_INPUT, "the number of types is wrong");
    return HS_OK;
}

static hs_status keep_neighbor(hs_neighbor *neighbor, const hs_box *box, hs_state *state, hs_error *err)
{
    hs_neighbor_counters *counters = &neighbor->counters;
    HS_TRY(hs_state_int64(state, "steps since lists", &neighbor->ago, 1, err));
    HS_TRY(hs_state_bool(state, "lists are late", &neighbor->is_late, err));
    HS_TRY(hs_state_double(state, "listed lo", neighbor->lo_listed, 3, err));
    HS_TRY(hs_state_double(state, "listed hi", neighbor->hi_listed, 3, err));
    HS_TRY(keep_tilt(box->is_tilted, "listed tilt", neighbor->tilt_listed, state, err));
    HS_TRY(hs_state_int64(state, "list builds", &counters->n_builds, 1, err));
    HS_TRY(hs_state_int64(state, "dangerous builds", &counters->n_dangerous, 1, err));
    HS_TRY(hs_state_int64(state, "late steps", &counters->n_late_steps, 1, err));
    return hs_state_int64(state, "first late step", &counters->first_late_step, 1, err);
}

/** Coefficients that fix adapt has changed; those of pair_coeff come from its repetition. */
static hs_status keep_adapted(hs_pair *pair, hs_state *state, hs_error *err)
{
    for (int k = 0; pair != NULL && k < pair->n_parts; ++k) {
        hs_pair *part = pair->part[k];
        char name[48];
        snprintf(name, sizeof name, "part %d of pairs is adapted", k + 1);
        if (state->is_reading ? hs_state_find(state, name) == NULL : !part->is_adapted) continue;
        HS_TRY(hs_state_bool(state, name, &part->is_adapted, err));
        snprintf(name, sizeof name, "part %d of pairs:", k + 1);
        HS_TRY(hs_pair_coeffs_keep(part, name, state, err));
    }
    return HS_OK;
}

/** Checkpoints from before there were these have none. */
static hs_status keep_peaks(hs_env *env, hs_state *state, hs_error *err)
{
    static const char name[] = "largest pairs";
    double peaks[2] = {env->peak_force, env->peak_energy};
    if (state->is_reading && hs_state_find(state, name) == NULL) return HS_OK;
    HS_TRY(hs_state_double(state, name, peaks, 2, err));
    env->peak_force = peaks[0];
    env->peak_energy = peaks[1];
    return HS_OK;
}

hs_status hs_sim_keep_run(hs_sim *sim, hs_state *state, hs_error *err)
{
    hs_env *env = &sim->env;
    struct {
        const char *name;
        int64_t *value;
    } integers[] = {{"step", &env->step},
                    {"first step", &env->first_step},
                    {"last step", &env->last_step},
                    {"ramp start", &env->ramp_start},
                    {"ramp stop", &env->ramp_stop},
                    {"clock ahead", &env->clock_ahead},
                    {"time origin step", &env->time_origin_step},
                    {"energy step", &env->energy_step}};
    struct {
        const char *name;
        double *value;
        int n;
    } reals[] = {{"timestep", &env->dt, 1},
                 {"time origin", &env->time_origin, 1},
                 {"pair energy", &env->pair_energy, 1},
                 {"pair virial", env->pair_virial, 6},
                 {"fix energy", &env->fix_energy, 1},
                 {"fix virial", env->fix_virial, 6},
                 {"tail energy", &env->tail_energy, 1},
                 {"tail pressure", &env->tail_pressure, 1}};
    for (size_t k = 0; k < sizeof integers / sizeof integers[0]; ++k)
        HS_TRY(hs_state_int64(state, integers[k].name, integers[k].value, 1, err));
    for (size_t k = 0; k < sizeof reals / sizeof reals[0]; ++k)
        HS_TRY(hs_state_double(state, reals[k].name, reals[k].value, reals[k].n, err));
    HS_TRY(keep_peaks(env, state, err));
    HS_TRY(hs_state_int(state, "force exponent", &sim->force_exponent, err));
    HS_TRY(hs_state_bool(state, "is set up", &sim->is_initialized, err));
    HS_TRY(hs_state_bool(state, "output is due", &sim->is_output_due, err));
    if (state->is_reading ? hs_state_find(state, "is halted") != NULL : env->is_halted)
        HS_TRY(hs_state_bool(state, "is halted", &env->is_halted, err));
    HS_TRY(hs_state_double(state, "mass", sim->atoms.mass, sim->atoms.n_types + 1, err));
    HS_TRY(hs_state_int(state, "restart turn", &sim->saving->restart[1].turn, err));
    HS_TRY(hs_sim_keep_box_of_forces(sim, state, err));
    HS_TRY(keep_adapted(sim->pair, state, err));
    return keep_neighbor(&sim->neighbor, &sim->box, state, err);
}

static hs_status keep_counts_of_types(hs_sim *sim, hs_state *state, hs_error *err)
{
    static const char name[] = "atoms of types";
    if (sim->n_of_type == NULL || (state->is_reading && hs_state_find(state, name) == NULL)) return HS_OK;
    return hs_state_int64(state, name, sim->n_of_type, sim->atoms.n_types + 1, err);
}

hs_status hs_sim_keep_under_way(hs_sim *sim, hs_state *state, hs_error *err)
{
    static const char name[] = "degrees of freedom";
    int64_t n = 0;
    double *values = NULL;
    HS_TRY(keep_counts_of_types(sim, state, err));
    HS_TRY(hs_thermo_keep(sim->thermo, state, err));
    if (state->is_reading && hs_state_find(state, name) == NULL) return HS_OK; /* older checkpoints have none */
    while (hs_sim_temperature(sim, (int)n) != NULL) ++n;
    HS_TRY(HS_ALLOC(values, (size_t)n, err));
    for (int k = 0; k < n; ++k) values[k] = hs_sim_temperature(sim, k)->n_dof;
    const hs_status status = hs_state_double(state, name, values, n, err);
    for (int k = 0; k < n; ++k) hs_sim_temperature(sim, k)->n_dof = values[k];
    HS_FREE(values);
    return status;
}

/** Arrays that travel with the atoms for a while: what the exchange would lose. */
typedef struct kept {
    double *x[3], *f[3]; /**< atom fields */
} kept;

static hs_status keep_arrays(hs_sim *sim, kept *arrays, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_atoms_add_field(atoms, "kept x", (void **)&arrays->x[axis], sizeof(double), false, err));
        HS_TRY(hs_atoms_add_field(atoms, "kept f", (void **)&arrays->f[axis], sizeof(double), false, err));
        const size_t n_bytes = sizeof(double) * (size_t)atoms->n_local;
        memcpy(arrays->x[axis], atoms->x[axis], n_bytes);
        memcpy(arrays->f[axis], atoms->f[axis], n_bytes);
    }
    return HS_OK;
}

static void give_back(hs_sim *sim, double *array[3], double *copy[3])
{
    hs_atoms *atoms = &sim->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        if (copy[axis] != NULL) memcpy(array[axis], copy[axis], sizeof(double) * (size_t)atoms->n_local);
        hs_atoms_remove_field(atoms, (void **)&copy[axis]);
    }
}

/** Make lists from the positions, in the box, of the last scheduled build, as the run did then. The order
 *  of atoms is that of their places at that time, so it comes out the same, too. */
static hs_status list_again(hs_sim *sim, hs_error *err)
{
    hs_neighbor *neighbor = &sim->neighbor;
    const hs_neighbor before = *neighbor;
    const hs_box box = sim->box;
    const size_t n_bytes = sizeof(double) * (size_t)sim->atoms.n_local;
    for (int axis = 0; axis < 3; ++axis) memcpy(sim->atoms.x[axis], neighbor->x_listed[axis], n_bytes);
    memcpy(sim->box.lo, neighbor->lo_listed, sizeof sim->box.lo);
    memcpy(sim->box.hi, neighbor->hi_listed, sizeof sim->box.hi);
    memcpy(sim->box.tilt, neighbor->tilt_listed, sizeof sim->box.tilt);
    HS_TRY(hs_sim_exchange(sim, err));
    sim->box = box;
    neighbor->ago = before.ago;
    sim->listed_step = sim->env.step - before.ago;
    neighbor->is_late = before.is_late;
    neighbor->counters.n_builds = before.counters.n_builds;
    return HS_OK;
}

hs_status hs_sim_setup_resumed(hs_sim *sim, hs_error *err)
{
    kept arrays = {0};
    const hs_method *method = hs_sim_method(sim);
    const bool has_halo = sim->pair != NULL && sim->pair->cutoff_max > 0.0;
    const hs_neighbor_counters counters = sim->neighbor.counters;
    sim->is_initialized = false; /* atoms may be anywhere, on any rank */
    HS_TRY(keep_arrays(sim, &arrays, err));
    hs_status status = list_again(sim, err);
    give_back(sim, sim->atoms.x, arrays.x);
    sim->neighbor.counters = counters;
    if (status == HS_OK && has_halo) {
        hs_halo_fit_box(&sim->halo, &sim->box);
        hs_halo_forward(&sim->halo, &sim->atoms);
        if (method->update != NULL) status = method->update(sim, err);
    }
    give_back(sim, sim->atoms.f, arrays.f); /* at last, for a sort leaves forces behind */
    hs_sim_show_force_places(sim);
    sim->is_initialized = true;
    return status;
}
