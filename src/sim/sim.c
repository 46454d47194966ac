/* The simulation object: making it, and the styles it owns. */
#include "sim/methods.h"

#include <string.h>

#include "base/memory.h"
#include "sim/restored.h"
#include "sim/saving.h"
#include "sim/thermo.h"
#include "style/pair_scan.h"

static void view_pairs(hs_env *env, hs_pair_view *view);
static hs_status set_timestep(hs_env *env, double dt, hs_error *err);
static hs_status pairs_changed(hs_env *env, bool *needs_lists, hs_error *err);
static hs_pair *pair_of(hs_env *env);
static hs_compute *find_compute(hs_env *env, const char *id);
static hs_fix *find_fix(hs_env *env, const char *id);
static hs_region *find_region(hs_env *env, const char *id);

/** The simulation that an env is part of. */
static hs_sim *sim_of(hs_env *env) { return (hs_sim *)((char *)env - offsetof(hs_sim, env)); }

static hs_status add_thermo_computes(hs_sim *sim, hs_error *err)
{
    static const char *const temp_id[] = {"thermo_temp"};
    const hs_args none = {.command = "thermo", .n = 0}, with_temp = {.command = "thermo", .n = 1, .word = temp_id};
    HS_TRY(hs_sim_add_compute(sim, "thermo_temp", "all", "temp", &none, err));
    HS_TRY(hs_sim_add_compute(sim, "thermo_press", "all", "pressure", &with_temp, err));
    return hs_sim_add_compute(sim, "thermo_pe", "all", "pe", &none, err);
}

static hs_status create(hs_sim *sim, const hs_options *options, hs_sink *out, hs_error *err)
{
    sim->options = *options;
    hs_threads_set(options->n_threads);
    sim->n_threads = hs_threads_get();
    hs_box_init(&sim->box);
    hs_lattice_init(&sim->lattice);
    HS_TRY(hs_isa_get(options->isa, &sim->isa, err));
    HS_TRY(hs_groups_init(&sim->groups, err));
    HS_TRY(hs_atoms_init(&sim->atoms, err));
    const hs_units *units = hs_units_find("lj");
    hs_min_settings_init(&sim->minimize);
    HS_TRY(hs_neighbor_init(&sim->neighbor, &sim->atoms, units->skin, err));
    if (options->precision[0] != '\0') HS_TRY(hs_precision_get(options->precision, &sim->precision, err));
    sim->reproducible = options->reproducible;
    if (options->neighbor_method[0] != '\0')
        HS_TRY(hs_neighbor_set_method(&sim->neighbor, options->neighbor_method, err));
    sim->env = (hs_env){.parallel = &sim->parallel,
                        .out = out,
                        .units = units,
                        .box = &sim->box,
                        .domain = &sim->domain,
                        .timer = &sim->timer,
                        .n_listed_pairs = &sim->neighbor.counters.n_pairs,
                        .atoms = &sim->atoms,
                        .groups = &sim->groups,
                        .lattice = &sim->lattice,
                        .pair_shares = &sim->pair_shares,
                        .isa = sim->isa,
                        .dry_run = options->dry_run,
                        .dt = units->dt,
                        .energy_step = -1,
                        .revision = 1,
                        .view_pairs = view_pairs,
                        .set_timestep = set_timestep,
                        .pairs_changed = pairs_changed,
                        .pair = pair_of,
                        .find_compute = find_compute,
                        .find_fix = find_fix,
                        .find_region = find_region};
    hs_parallel_world(&sim->parallel);
    hs_domain_init(&sim->domain, &sim->parallel);
    HS_TRY(HS_ALLOC(sim->saving, 1, err));
    HS_TRY(add_thermo_computes(sim, err));
    return hs_thermo_create(&sim->thermo, sim, err);
}

hs_status hs_sim_create(hs_sim **sim, const hs_options *options, hs_sink *out, hs_error *err)
{
    HS_TRY(HS_ALLOC(*sim, 1, err));
    const hs_status status = create(*sim, options, out, err);
    if (status != HS_OK) hs_sim_destroy(sim);
    return status;
}

void hs_sim_destroy(hs_sim **sim_pointer)
{
    hs_sim *sim = *sim_pointer;
    if (sim == NULL) return;
    if (sim->thermo != NULL) hs_thermo_destroy(&sim->thermo);
    hs_restored_forget(sim);
    hs_sim_destroy_styles(sim);
    for (int k = 0; k < sim->n_pair_tables; ++k) HS_FREE(sim->pair_table[k].values);
    HS_FREE(sim->pair_table);
    hs_saving_fini(sim->saving);
    HS_FREE(sim->saving);
    HS_FREE(sim->n_of_type);
    HS_FREE(sim->excluded);
    hs_force_space_fini(&sim->forces);
    hs_cluster_list_fini(&sim->list);
    hs_verlet_list_fini(&sim->verlet);
    hs_halo_fini(&sim->halo);
    hs_domain_fini(&sim->domain);
    hs_neighbor_fini(&sim->neighbor);
    hs_lattice_fini(&sim->lattice);
    hs_atoms_fini(&sim->atoms);
    hs_groups_fini(&sim->groups);
    HS_FREE(*sim_pointer);
}

#define FIND(list, n, wanted)                                                                                          \
    do {                                                                                                               \
        for (int k_ = 0; k_ < (n); ++k_)                                                                               \
            if (strcmp((list)[k_]->id, (wanted)) == 0) return (list)[k_];                                              \
        return NULL;                                                                                                   \
    } while (0)

hs_fix *hs_sim_find_fix(hs_sim *sim, const char *id) { FIND(sim->fix, sim->n_fixes, id); }

/** The deck's, and those that fixes have made for themselves. */
hs_compute *hs_sim_find_compute(hs_sim *sim, const char *id)
{
    for (int k = 0; k < sim->n_fixes; ++k)
        for (int own = 0; own < HS_FIX_OWN_MAX; ++own) {
            hs_compute *compute = sim->fix[k]->own[own];
            if (compute != NULL && strcmp(compute->id, id) == 0) return compute;
        }
    FIND(sim->compute, sim->n_computes, id);
}

hs_compute *hs_sim_temperature(hs_sim *sim, int k)
{
    for (int i = 0; i < sim->n_computes; ++i)
        if (sim->compute[i]->style->is_temperature && k-- == 0) return sim->compute[i];
    for (int i = 0; i < sim->n_fixes; ++i)
        for (int own = 0; own < HS_FIX_OWN_MAX; ++own) {
            hs_compute *compute = sim->fix[i]->own[own];
            if (compute != NULL && compute->style->is_temperature && k-- == 0) return compute;
        }
    return NULL;
}

hs_region *hs_sim_find_region(hs_sim *sim, const char *id) { FIND(sim->region, sim->n_regions, id); }
hs_dump *hs_sim_find_dump(hs_sim *sim, const char *id) { FIND(sim->dump, sim->n_dumps, id); }

/** Which pairs are listed. */
static void view_listed(const hs_sim *sim, hs_pair_view *view)
{
    const hs_neighbor *neighbor = &sim->neighbor;
    view->listed_only = hs_sim_misses_pairs(sim);
    view->box_listed = sim->box;
    for (int axis = 0; axis < 3; ++axis) {
        view->x_listed[axis] = neighbor->x_listed[axis];
        view->box_listed.lo[axis] = neighbor->lo_listed[axis];
        view->box_listed.hi[axis] = neighbor->hi_listed[axis];
        view->box_listed.tilt[axis] = neighbor->tilt_listed[axis];
    }
    view->listed_by_radius = hs_pair_has_radii(sim->pair, true);
    view->skin = neighbor->settings.skin;
}

static void view_pairs(hs_env *env, hs_pair_view *view)
{
    const hs_sim *sim = sim_of(env);
    *view = (hs_pair_view){.type = sim->kernel_type != NULL ? sim->kernel_type : sim->atoms.type,
                           .excluded = sim->excluded,
                           .n_kernel_types = sim->n_kernel_types};
    if (sim->pair == NULL || sim->n_pair_tables < sim->pair->n_parts) return;
    view->cutoff_max = sim->pair->cutoff_max;
    if (!(view->cutoff_max > 0.0)) return;
    view_listed(sim, view);
    if (!hs_pair_has_forces(sim->pair)) return;
    view->pair = sim->pair;
    view->table = sim->pair_table;
    int k = 0;
    while (sim->pair->part[k]->style->evaluator == NULL) ++k;
    view->is_uniform = sim->pair_table[k].is_uniform && !hs_pair_has_radii(sim->pair, true);
    view->clusters = &sim->neighbor.clusters;
    if (hs_sim_method_in_use(sim) == HS_METHOD_CLUSTER && sim->list.generation == sim->atoms.generation &&
        !sim->has_moved)
        view->list = &sim->list;
}

static hs_status set_timestep(hs_env *env, double dt, hs_error *err)
{
    hs_sim *sim = sim_of(env);
    hs_sim_set_clock(sim, env->step, dt);
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->dt_changed != NULL) HS_TRY(sim->fix[k]->style->dt_changed(sim->fix[k], err));
    return HS_OK;
}

static hs_status pairs_changed(hs_env *env, bool *needs_lists, hs_error *err)
{
    return hs_sim_renew_pair(sim_of(env), needs_lists, err);
}

static hs_pair *pair_of(hs_env *env) { return sim_of(env)->pair; }
static hs_compute *find_compute(hs_env *env, const char *id) { return hs_sim_find_compute(sim_of(env), id); }
static hs_fix *find_fix(hs_env *env, const char *id) { return hs_sim_find_fix(sim_of(env), id); }
static hs_region *find_region(hs_env *env, const char *id) { return hs_sim_find_region(sim_of(env), id); }

hs_status hs_sim_need_box(const hs_sim *sim, const char *command, hs_error *err)
{
    if (sim->box.exists) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no simulation box yet; create_box or read_data makes one",
                   command);
}

hs_status hs_sim_need_region(hs_sim *sim, const char *command, const char *id, const hs_region **region, hs_error *err)
{
    hs_region *found = hs_sim_find_region(sim, id);
    *region = found;
    if (found != NULL) return hs_region_update(found, err);
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no region '%s'; the command 'region' makes one", command, id);
}

hs_status hs_sim_need_pair(const hs_sim *sim, const char *command, hs_error *err)
{
    if (sim->pair != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: there is no pair style yet; pair_style sets one ('pair_style none' for no forces)", command);
}

hs_status hs_sim_need_masses(const hs_sim *sim, const char *command, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    for (int i = 0; atoms->rmass != NULL && i < atoms->n_local && err->status == HS_OK; ++i)
        if (!(atoms->rmass[i] > 0.0))
            (void)hs_fail(err, HS_ERROR_INPUT,
                          "%s: atom %lld has no mass; 'set atom %lld density <value>' gives it one", command,
                          (long long)atoms->id[i], (long long)atoms->id[i]);
    if (atoms->rmass != NULL) return hs_parallel_agree(&sim->parallel, err);
    for (int type = 1; type <= sim->atoms.n_types; ++type)
        if (!(sim->atoms.mass[type] > 0.0))
            return hs_fail(err, HS_ERROR_INPUT, "%s: atom type %d has no mass; 'mass %d <value>' sets it", command,
                           type, type);
    return HS_OK;
}

hs_status hs_sim_need_no_counters(const hs_sim *sim, const char *command, hs_error *err)
{
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->is_time_dependent)
            return hs_fail(err, HS_ERROR_INPUT, "%s: %s counts steps: 'unfix %s' first, and define it again after",
                           command, hs_fix_who(sim->fix[k]).text, sim->fix[k]->id);
    return HS_OK;
}

void hs_sim_set_clock(hs_sim *sim, int64_t step, double dt)
{
    hs_env *env = &sim->env;
    /* What was remembered for another step of the old count must not be taken for this one's. */
    const bool has_energy = env->energy_step == env->step;
    env->time_origin += (double)(env->step - env->time_origin_step) * env->dt;
    env->clock_ahead += env->step - step;
    env->time_origin_step = env->step = step;
    env->dt = dt;
    env->energy_step = has_energy ? step : -1;
    hs_env_changed(env);
}

void hs_sim_atoms_moved(hs_sim *sim)
{
    if (sim->is_initialized) hs_sim_round_positions(sim);
    sim->has_moved = true;
    hs_sim_forget_force_places(sim);
    hs_env_changed(&sim->env);
}

void hs_sim_atoms_changed(hs_sim *sim)
{
    sim->atoms.n_all = sim->atoms.n_local;
    hs_parallel_sum_int64(&sim->parallel, &sim->atoms.n_all, 1);
    sim->atoms.n_halo = 0;
    hs_sim_forget_force_places(sim);
    ++sim->atoms.generation;
    sim->is_initialized = false;
    hs_env_changed(&sim->env);
}
