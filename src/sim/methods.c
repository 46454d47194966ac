#include "sim/methods.h"

#include <math.h>

#include "base/memory.h"

/* Steps after which atoms are sorted again for methods whose lists do not need it: diffusion undoes the order
 * slowly. */
enum { SORT_EVERY = 1000 };

hs_neighbor_method hs_sim_method_in_use(const hs_sim *sim)
{
    const hs_neighbor_method method = sim->neighbor.settings.method;
    return method == HS_METHOD_AUTO ? sim->tuner.method : method;
}

const hs_method *hs_sim_method(const hs_sim *sim) { return &hs_methods[hs_sim_method_in_use(sim)]; }

static double listed_reach(const hs_sim *sim) { return sim->pair->cutoff_max + sim->neighbor.settings.skin; }

/* nsq */

/** The halo of methods that keep no lists. */
static hs_status renew_halo(hs_sim *sim, hs_error *err)
{
    HS_TRY(hs_sim_make_halo(sim, listed_reach(sim), err));
    /* the halo stays until lists are due again, and an atom may be late before that */
    hs_halo_forward_positions(&sim->halo, &sim->atoms, sim->neighbor.x_listed);
    return HS_OK;
}

static hs_status forces_nsq(hs_sim *sim, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    return hs_force_nsq(&sim->forces, job, result, err);
}

/* linked, incremental, hash */

/* Cells of their own pay when a cell of the largest atoms could hold so many of the smallest: a ratio of sizes of 2.7
 * in space and of 4.5 in the plane (docs/neighbor-methods.md). */
static const double crowd = 20.0;

/** Largest radius of an atom up to @p limit, on all ranks (collective); 0 without atoms. */
static double largest_radius(const hs_sim *sim, double limit)
{
    double largest = 0.0;
    for (int i = 0; i < sim->atoms.n_local; ++i)
        if (sim->atoms.radius[i] <= limit) largest = fmax(largest, sim->atoms.radius[i]);
    hs_parallel_max_double(&sim->parallel, &largest, 1);
    return largest;
}

/** Small and large atoms into chains of their own where radii make the cutoffs and differ enough (collective): the
 *  border is the geometric mean of the extremes. */
static void choose_levels(hs_sim *sim)
{
    hs_neighbor *neighbor = &sim->neighbor;
    double largest = 0.0, smallest = 0.0, small = 0.0;
    neighbor->has_levels = false;
    if (hs_pair_has_radii(sim->pair, true)) {
        largest = largest_radius(sim, INFINITY);
        smallest = largest;
        for (int i = 0; i < sim->atoms.n_local; ++i) smallest = fmin(smallest, sim->atoms.radius[i]);
        hs_parallel_min_double(&sim->parallel, &smallest, 1);
        neighbor->has_levels = pow(largest, sim->box.dimension) > crowd * pow(smallest, sim->box.dimension);
    }
    if (neighbor->has_levels) small = largest_radius(sim, sqrt(fmax(smallest, largest / 64.0) * largest));
    neighbor->has_levels = small > 0.0;
    if (neighbor->has_levels) {
        hs_chains_set_sizes(&neighbor->chains, -1.0, small);
        hs_chains_set_sizes(&neighbor->coarse, small, largest);
    } else {
        hs_chains_set_all_sizes(&neighbor->chains);
    }
}

/** Cells over this rank's brick and the halo around it. */
static hs_status set_chain_grid(hs_sim *sim, hs_error *err)
{
    hs_neighbor *neighbor = &sim->neighbor;
    const hs_neighbor_settings *settings = &neighbor->settings;
    const double edge = settings->cell > 0.0 ? settings->cell : 1.0;
    hs_grid_plan plan = {.dimension = sim->box.dimension, .is_cube = settings->is_cube};
    hs_domain_brick(&sim->domain, &sim->box, plan.lo, plan.hi);
    for (int axis = 0; axis < 3; ++axis) {
        const bool has_halo = sim->box.periodic[axis] || sim->domain.n[axis] > 1;
        plan.lo[axis] -= has_halo ? listed_reach(sim) : 0.0;
        plan.hi[axis] += has_halo ? listed_reach(sim) : 0.0;
    }
    if (neighbor->has_levels) {
        plan.reach = sim->pair->cutoff_max;
        plan.edge = edge * plan.reach;
        HS_TRY(hs_chains_set_grid(&neighbor->coarse, &plan, settings->order, err));
    }
    plan.reach = neighbor->has_levels ? 2.0 * neighbor->chains.radius_hi : sim->pair->cutoff_max;
    plan.edge = edge * plan.reach;
    return hs_chains_set_grid(&neighbor->chains, &plan, settings->order, err);
}

/** One step of a method for all chains there are. */
typedef hs_status (*chains_step)(hs_chains *chains, const hs_atoms *atoms, hs_error *err);

static hs_status for_chains(hs_sim *sim, chains_step step, hs_error *err)
{
    hs_neighbor *neighbor = &sim->neighbor;
    HS_TRY(step(&neighbor->chains, &sim->atoms, err));
    return neighbor->has_levels ? step(&neighbor->coarse, &sim->atoms, err) : HS_OK;
}

/** Lay the cells, and sort the atoms in memory by them now and then. */
static hs_status sort_atoms(hs_sim *sim, hs_error *err)
{
    hs_neighbor *neighbor = &sim->neighbor;
    choose_levels(sim);
    if (neighbor->last_sort_step < 0)
        neighbor->chains.is_void = neighbor->coarse.is_void = true; /* sizes may be others */
    HS_TRY(set_chain_grid(sim, err));
    if (neighbor->settings.order == HS_CELL_ORDER_NONE) return HS_OK;
    if (neighbor->last_sort_step >= 0 && sim->env.step < neighbor->last_sort_step + SORT_EVERY) return HS_OK;
    int32_t *order = hs_atoms_sort_scratch(&sim->atoms, sim->atoms.n_local).order;
    HS_TRY(hs_chains_sort(&neighbor->chains, &sim->atoms, order, err));
    neighbor->last_sort_step = sim->env.step;
    return hs_atoms_permute(&sim->atoms, order, err);
}

static hs_status renew_atoms_of_chains(hs_sim *sim, hs_error *err)
{
    (void)sort_atoms(sim, err); /* the ranks agree on errors when they make the halo */
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    return renew_halo(sim, err);
}

static hs_status update_linked(hs_sim *sim, hs_error *err) { return for_chains(sim, hs_linked_build, err); }

static hs_status renew_linked(hs_sim *sim, hs_error *err)
{
    HS_TRY(renew_atoms_of_chains(sim, err));
    return update_linked(sim, err);
}

static hs_status with_old_halo(hs_chains *chains, const hs_atoms *atoms, hs_error *err)
{
    return hs_incremental_update(chains, atoms, false, err);
}

static hs_status with_new_halo(hs_chains *chains, const hs_atoms *atoms, hs_error *err)
{
    return hs_incremental_update(chains, atoms, true, err);
}

static hs_status update_incremental(hs_sim *sim, hs_error *err) { return for_chains(sim, with_old_halo, err); }

static hs_status renew_incremental(hs_sim *sim, hs_error *err)
{
    HS_TRY(renew_atoms_of_chains(sim, err));
    return for_chains(sim, with_new_halo, err);
}

static hs_status update_hash(hs_sim *sim, hs_error *err) { return for_chains(sim, hs_hash_build, err); }

static hs_status renew_hash(hs_sim *sim, hs_error *err)
{
    HS_TRY(renew_atoms_of_chains(sim, err));
    return update_hash(sim, err);
}

static hs_status forces_chains(hs_sim *sim, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    return hs_force_chains(&sim->forces, job, result, err);
}

/* cell, verlet, cluster */

static hs_status renew_cell(hs_sim *sim, hs_error *err) { return hs_sim_sort_and_cluster(sim, listed_reach(sim), err); }

static hs_status update_cell(hs_sim *sim, hs_error *err)
{
    HS_TRY(hs_sim_sort_again(sim, err));
    if (!sim->neighbor.is_late) return HS_OK;
    hs_sim_forward_listed(sim);
    hs_clusters_note_motion(&sim->neighbor.clusters, &sim->atoms, sim->neighbor.x_listed);
    return HS_OK;
}

static hs_status forces_cell(hs_sim *sim, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    return hs_force_cell(&sim->forces, job, result, err);
}

static hs_status renew_verlet(hs_sim *sim, hs_error *err)
{
    HS_TRY(hs_sim_sort_and_cluster(sim, listed_reach(sim), err));
    if (!hs_pair_has_forces(sim->pair)) return HS_OK;
    hs_force_job job = hs_sim_make_job(sim, false);
    job.cutoff_max = listed_reach(sim);
    HS_TRY(hs_verlet_list_build(&sim->verlet, &sim->forces, &job, err));
    sim->neighbor.counters.n_pairs = hs_verlet_list_n_pairs(&sim->verlet);
    return HS_OK;
}

static hs_status forces_verlet(hs_sim *sim, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    return hs_force_verlet(&sim->forces, &sim->verlet, job, result, err);
}

static hs_status renew_cluster(hs_sim *sim, hs_error *err)
{
    HS_TRY(hs_sim_sort_and_cluster(sim, listed_reach(sim), err));
    if (!hs_pair_has_forces(sim->pair)) return HS_OK;
    hs_force_job job = hs_sim_make_job(sim, false);
    job.cutoff_max = listed_reach(sim);
    HS_TRY(hs_cluster_list_build(&sim->list, &sim->forces, &job, err));
    sim->neighbor.counters.n_pairs = hs_cluster_list_n_pairs(&sim->list);
    return HS_OK;
}

static hs_status forces_cluster(hs_sim *sim, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    return hs_force_cluster(&sim->forces, &sim->list, job, result, err);
}

enum {
    COLUMN_OPTIONS = HS_METHOD_TAKES_CELL | HS_METHOD_TAKES_ORDER,
    CHAIN_OPTIONS = COLUMN_OPTIONS | HS_METHOD_TAKES_STENCIL | HS_METHOD_TAKES_NO_ORDER
};

const hs_method hs_methods[HS_N_METHODS] = {
    [HS_METHOD_NSQ] = {.help = "double loop over all pairs; slow, for checking the others",
                       .renew = renew_halo,
                       .forces = forces_nsq},
    [HS_METHOD_LINKED] = {.help = "the textbook's cells: head and next, built anew at every step",
                          .options = CHAIN_OPTIONS,
                          .renew = renew_linked,
                          .update = update_linked,
                          .forces = forces_chains},
    [HS_METHOD_INCREMENTAL] = {.help =
                                   "the same with doubly linked cells, in which only atoms that changed cell are moved",
                               .options = CHAIN_OPTIONS,
                               .renew = renew_incremental,
                               .update = update_incremental,
                               .forces = forces_chains},
    [HS_METHOD_HASH] = {.help = "the same with a hash table of the occupied cells: memory by atoms, not by volume",
                        .options = CHAIN_OPTIONS,
                        .renew = renew_hash,
                        .update = update_hash,
                        .forces = forces_chains},
    [HS_METHOD_CELL] =
        {.help = "atoms are sorted into Morton-ordered cells and pairs searched at every step; no list is kept",
         .options = COLUMN_OPTIONS,
         .renew = renew_cell,
         .update = update_cell,
         .forces = forces_cell},
    [HS_METHOD_VERLET] =
        {.help =
             "lists of the neighbors of each atom, made from the same cells and kept until atoms have moved too far",
         .options = COLUMN_OPTIONS,
         .renew = renew_verlet,
         .forces = forces_verlet},
    [HS_METHOD_CLUSTER] =
        {.help = "lists of pairs of four-atom clusters from the same cells, kept until atoms have moved too far",
         .options = COLUMN_OPTIONS,
         .renew = renew_cluster,
         .forces = forces_cluster},
    [HS_METHOD_AUTO] = {.help = "cluster or verlet, whichever is faster: longer runs try both",
                        .options = COLUMN_OPTIONS},
};

static hs_status describe_columns(const hs_cells *cells, hs_text *text, hs_error *err)
{
    return hs_text_printf(
        text, err, "  cells = %d x %d x %d of %.4g x %.4g x %.4g, in %d columns along %c in %s order\n", cells->n[0],
        cells->n[1], cells->n[2], cells->pitch[0], cells->pitch[1], cells->pitch[2], cells->n_columns,
        "xyz"[cells->axis[2]], cells -> curve == HS_CELL_ORDER_MORTON ? "Morton" : "row");
}

static hs_status describe_chains(const hs_chains *chains, hs_text *text, hs_error *err)
{
    const hs_grid *grid = &chains->grid;
    HS_TRY(hs_text_printf(text, err, "  cells%s = %d x %d x %d of %.4g x %.4g",
                          !chains->is_sized         ? ""
                          : chains->radius_lo < 0.0 ? " of small atoms"
                                                    : " of large atoms",
                          grid->n[0], grid->n[1], grid->n[2], grid->pitch[0], grid->pitch[1]));
    if (grid->inv_pitch[2] > 0.0) HS_TRY(hs_text_printf(text, err, " x %.4g", grid->pitch[2]));
    return hs_text_printf(text, err, ", order %s, %d neighbor cells in the half stencil\n",
                          hs_cell_order_names[chains->order], grid->n_stencil);
}

hs_status hs_sim_describe_cells(const hs_sim *sim, hs_text *text, hs_error *err)
{
    const unsigned options = hs_sim_method(sim)->options;
    if (options & HS_METHOD_TAKES_STENCIL) {
        const hs_neighbor *neighbor = &sim->neighbor;
        HS_TRY(describe_chains(&neighbor->chains, text, err));
        return neighbor->has_levels ? describe_chains(&neighbor->coarse, text, err) : HS_OK;
    }
    if (options & HS_METHOD_TAKES_CELL) return describe_columns(&sim->neighbor.cells, text, err);
    return HS_OK;
}
