/* Where atoms were when the forces of a step were computed: remembered at steps whose energy is wanted, before fixes move
 * atoms or box at the step's end. */
#include <string.h>

#include "sim/saving.h"
#include "sim/sim.h"

/** A field of the atoms, so that checkpoints have it: the rows of a step may be written after it was resumed. */
hs_status hs_sim_fit_force_places(hs_sim *sim, hs_error *err)
{
    static const char *const names[] = {"x of forces", "y of forces", "z of forces"};
    hs_force_places *kept = &sim->force_places;
    bool is_needed = false;
    for (int k = 0; k < sim->n_fixes; ++k) is_needed |= sim->fix[k]->style->moves_at_end;
    if (is_needed == (kept->x[0] != NULL)) return HS_OK;
    hs_sim_forget_force_places(sim);
    for (int axis = 0; axis < 3; ++axis) {
        if (is_needed)
            HS_TRY(hs_atoms_add_field(&sim->atoms, names[axis], (void **)&kept->x[axis], sizeof(double), false, err));
        else
            hs_atoms_remove_field(&sim->atoms, (void **)&kept->x[axis]);
    }
    return HS_OK;
}

void hs_sim_forget_force_places(hs_sim *sim) { sim->env.force_places = NULL; }

void hs_sim_show_force_places(hs_sim *sim)
{
    hs_force_places *kept = &sim->force_places;
    if (!kept->is_kept || kept->x[0] == NULL) return;
    kept->places = (hs_places){.x = {kept->x[0], kept->x[1], kept->x[2]}, .box = &kept->box};
    sim->env.force_places = &kept->places;
}

void hs_sim_keep_force_places(hs_sim *sim)
{
    hs_force_places *kept = &sim->force_places;
    const size_t n_bytes = sizeof(double) * (size_t)sim->atoms.n_local;
    if (kept->x[0] == NULL || !sim->env.with_energy) return;
    for (int axis = 0; axis < 3; ++axis)
        if (n_bytes > 0) memcpy(kept->x[axis], sim->atoms.x[axis], n_bytes);
    kept->box = sim->box;
    kept->is_kept = true;
    hs_sim_show_force_places(sim);
}

hs_status hs_sim_keep_box_of_forces(hs_sim *sim, hs_state *state, hs_error *err)
{
    hs_force_places *kept = &sim->force_places;
    kept->is_kept = state->is_reading ? hs_state_find(state, "lo of forces") != NULL : sim->env.force_places != NULL;
    if (!kept->is_kept) return HS_OK;
    if (state->is_reading) kept->box = sim->box;
    HS_TRY(hs_state_double(state, "lo of forces", kept->box.lo, 3, err));
    HS_TRY(hs_state_double(state, "hi of forces", kept->box.hi, 3, err));
    return hs_state_double(state, "tilt of forces", kept->box.tilt, 3, err);
}
