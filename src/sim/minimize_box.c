/* Minimisations that relax the box: the coordinates of one fix (style/box_freedom.h) are moved together with those of
 * the atoms. */
#include <math.h>
#include <string.h>

#include "sim/minimizer.h"
#include "style/box_change.h"

hs_status hs_min_find_box(hs_sim *sim, hs_fix **fix, hs_error *err)
{
    *fix = NULL;
    for (int k = 0; k < sim->n_fixes; ++k) {
        if (sim->fix[k]->style->box_freedom == NULL) continue;
        if (*fix != NULL)
            return hs_fail(err, HS_ERROR_INPUT, "minimize: one fix relaxes the box, and here are two, '%s' and '%s'",
                           (*fix)->id, sim->fix[k]->id);
        *fix = sim->fix[k];
    }
    if (*fix == NULL || sim->minimize.style->has_direction) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "minimize: %s relaxes the box along search directions, and min_style %s has none; "
                   "'min_style cg' and 'min_style sd' have",
                   hs_fix_who(*fix).text, sim->minimize.style->name);
}

hs_status hs_min_measure_box(hs_minimizer *min, hs_error *err)
{
    hs_min_box *box = &min->box;
    if (box->fix == NULL) return HS_OK;
    return box->fix->style->box_freedom->measure(box->fix, &box->energy, box->force, err);
}

hs_status hs_min_add_box(hs_minimizer *min, hs_error *err)
{
    static const char *const names[2][3] = {{"minimize start x", "minimize start y", "minimize start z"},
                                            {"minimize image x", "minimize image y", "minimize image z"}};
    hs_atoms *atoms = &min->sim->atoms;
    hs_min_box *box = &min->box;
    for (int axis = 0; axis < 3 && box->fix != NULL; ++axis) {
        HS_TRY(hs_atoms_add_field(atoms, names[0][axis], (void **)&box->x[axis], sizeof(double), false, err));
        HS_TRY(hs_atoms_add_field(atoms, names[1][axis], (void **)&box->image[axis], sizeof(int32_t), false, err));
    }
    return HS_OK;
}

void hs_min_remove_box(hs_minimizer *min)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_atoms_remove_field(&min->sim->atoms, (void **)&min->box.x[axis]);
        hs_atoms_remove_field(&min->sim->atoms, (void **)&min->box.image[axis]);
    }
}

void hs_min_add_box_products(const hs_minimizer *min, hs_min_sums *sums)
{
    const hs_min_box *box = &min->box;
    if (box->fix == NULL) return;
    for (int k = 0; k < HS_BOX_COORDINATES; ++k) {
        sums->force_force += box->force[k] * box->force[k];
        sums->force_before += box->force[k] * box->before[k];
        sums->force_direction += box->force[k] * box->direction[k];
    }
}

double hs_min_largest_of_box(const hs_minimizer *min, const double value[HS_BOX_COORDINATES])
{
    double largest = 0.0;
    for (int k = 0; k < HS_BOX_COORDINATES && min->box.fix != NULL; ++k) largest = fmax(largest, fabs(value[k]));
    return largest;
}

void hs_min_turn_box(hs_minimizer *min, double beta)
{
    hs_min_box *box = &min->box;
    for (int k = 0; k < HS_BOX_COORDINATES; ++k) {
        box->direction[k] = box->force[k] + beta * box->direction[k];
        box->before[k] = box->force[k];
    }
}

int hs_min_count_box(const hs_minimizer *min)
{
    const hs_fix *fix = min->box.fix;
    return fix != NULL ? fix->style->box_freedom->count(fix) : 0;
}

double hs_min_limit_of_box(const hs_minimizer *min)
{
    const hs_fix *fix = min->box.fix;
    const double largest = hs_min_largest_of_box(min, min->box.direction);
    return largest > 0.0 ? fix->style->box_freedom->farthest(fix) / largest : INFINITY;
}

void hs_min_begin_line_of_box(hs_minimizer *min)
{
    const hs_atoms *atoms = &min->sim->atoms;
    hs_min_box *box = &min->box;
    if (box->fix == NULL) return;
    box->fix->style->box_freedom->keep(box->fix);
    box->start = min->sim->box;
    for (int axis = 0; axis < 3; ++axis) {
        memcpy(box->x[axis], atoms->x[axis], (size_t)atoms->n_local * sizeof *box->x[axis]);
        memcpy(box->image[axis], atoms->image[axis], (size_t)atoms->n_local * sizeof *box->image[axis]);
    }
}

static void move_share(hs_minimizer *min, const hs_box_map *map, uint32_t followers, double alpha)
{
    const hs_atoms *atoms = &min->sim->atoms;
    const hs_min_box *box = &min->box;
    const double magic = min->sim->env.position_magic;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        /* on the grid of now, which a growing box may have made coarser since the line began */
        double x[3] = {hs_moved(0.0, box->x[0][i], magic), hs_moved(0.0, box->x[1][i], magic),
                       hs_moved(0.0, box->x[2][i], magic)};
        double shift[3];
        int32_t images[3];
        if (atoms->mask[i] & followers) hs_box_map_move(map, magic, x);
        for (int axis = 0; axis < 3; ++axis) images[axis] = box->image[axis][i] - atoms->image[axis][i];
        hs_box_shift(&map->to, images, shift);
        for (int axis = 0; axis < 3; ++axis)
            atoms->x[axis][i] = hs_moved(x[axis], alpha * min->direction[axis][i], magic) + shift[axis];
    }
}

/** Box and atoms at a place of the line: atoms keep their fractions of the box and move along their own directions. */
void hs_min_go_with_box(hs_minimizer *min, double alpha)
{
    hs_env *env = &min->sim->env;
    hs_min_box *box = &min->box;
    const hs_box_freedom *freedom = box->fix->style->box_freedom;
    hs_box to;
    freedom->place(box->fix, alpha, box->direction, &to);
    if (alpha == 0.0) to = box->start;
    hs_sim_round_box(&to, env->position_magic);
    hs_sim_round_box(&box->start, env->position_magic);
    const hs_box_map map = hs_box_map_make(&box->start, &to);
    const uint32_t followers = freedom->followers(box->fix);
    HS_ON_THREADS(move_share(min, &map, followers, alpha));
    *env->box = to;
    hs_env_changed(env);
}

hs_status hs_min_renew_box(hs_minimizer *min, hs_error *err)
{
    hs_fix *fix = min->box.fix;
    if (fix == NULL || !fix->style->box_freedom->renew(fix)) return HS_OK;
    HS_TRY(hs_min_measure_box(min, err));
    min->energy = hs_min_energy(min);
    return HS_OK;
}
