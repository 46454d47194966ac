/** What fixes with flat walls share: which faces, where they stand, forces of a wall potential. */
#ifndef HS_FIX_WALL_H
#define HS_FIX_WALL_H

#include <string.h>

#include "base/memory.h"
#include "core/lattice.h"
#include "fix/wall_energy.h"
#include "style/atom_sum.h"
#include "style/fix.h"

enum { WALL_MAX = 6 };

static const char *const wall_faces[] = {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi", NULL};

/** One flat wall, across an axis. Particles are above a lower wall and below an upper one. */
typedef struct wall_face {
    int axis, end;                 /**< end 0: lower, 1: upper */
    bool is_edge;                  /**< stands where the box's face was when the fix was defined */
    char *variable;                /**< owned; equal-style variable that gives the place; NULL without */
    double place;                  /**< distance, from the box's origin */
    double epsilon, sigma, cutoff; /**< wall potentials only; energy, distance */
} wall_face;

typedef struct wall_state {
    wall_face face[WALL_MAX];
    int n;
    wall_energy energy; /**< wall potentials only */
} wall_state;

static inline void wall_destroy(hs_fix *fix)
{
    wall_state *state = fix->state;
    for (int k = 0; k < state->n; ++k) HS_FREE(state->face[k].variable);
}

/** Read a face and its place: words i and i + 1. */
static inline hs_status wall_read_face(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    wall_state *state = fix->state;
    const hs_box *box = fix->env->box;
    int which;
    HS_TRY(hs_arg_choice(args, i, wall_faces, &which, err));
    for (int k = 0; k < state->n; ++k)
        if (2 * state->face[k].axis + state->face[k].end == which)
            return hs_fail(err, HS_ERROR_INPUT, "%s: the wall %s is there twice", args->command, args->word[i]);
    wall_face *face = &state->face[state->n++];
    *face = (wall_face){.axis = which / 2, .end = which % 2};
    if (box->dimension == 2 && face->axis == 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no wall %s in two dimensions", args->command, args->word[i]);
    if (box->periodic[face->axis])
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the wall %s needs a boundary that is not periodic along %c ('boundary' with f, s or m)",
                       args->command, args->word[i], "xyz"[face->axis]);
    HS_TRY(hs_arg_need(args, i + 1, "the place of the wall", err));
    face->is_edge = strcmp(args->word[i + 1], "EDGE") == 0;
    if (face->is_edge) face->place = face->end == 0 ? box->lo[face->axis] : box->hi[face->axis];
    if (face->is_edge) return HS_OK;
    if (strncmp(args->word[i + 1], "v_", 2) == 0) return hs_memory_strdup(&face->variable, args->word[i + 1] + 2, err);
    return hs_arg_double(args, i + 1, &face->place, err);
}

/** Places that are numbers in lattice units become distances; those of variables do when they are read. */
static inline double wall_unit(const hs_fix *fix, const wall_face *face, bool is_lattice)
{
    return is_lattice && !face->is_edge ? fix->env->lattice->spacing[face->axis] : 1.0;
}

/** Where the wall stands at this step; @p unit as from wall_unit. */
static inline hs_status wall_place(const hs_fix *fix, wall_face *face, double unit, hs_error *err)
{
    const hs_env *env = fix->env;
    if (face->variable == NULL) return HS_OK;
    HS_TRY(env->variable_value(env->deck, face->variable, &face->place, err));
    face->place *= unit;
    return HS_OK;
}

/** A wall at an edge stands still; a shrink-wrapped box does not, and a restart would define it elsewhere. */
static inline hs_status wall_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    wall_state *state = fix->state;
    double place[WALL_MAX];
    for (int k = 0; k < state->n; ++k) place[k] = state->face[k].place;
    HS_TRY(hs_state_double(kept, "place", place, state->n, err));
    for (int k = 0; k < state->n; ++k) state->face[k].place = place[k];
    return HS_OK;
}

/** Atoms that are beyond a wall before the first step were placed there by the deck: an error. Walls are where they were placed
 *  last (collective). */
static inline hs_status wall_check_inside(const hs_fix *fix, hs_error *err)
{
    const wall_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    int64_t n_outside = 0;
    for (int k = 0; k < state->n; ++k) {
        const wall_face *face = &state->face[k];
        for (int i = 0; i < atoms->n_local; ++i) {
            const double x = atoms->x[face->axis][i], depth = face->end == 0 ? face->place - x : x - face->place;
            n_outside += atoms->mask[i] & fix->mask && depth > 0.0;
        }
    }
    hs_parallel_sum_int64(fix->env->parallel, &n_outside, 1);
    if (n_outside == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: %lld atoms are outside of the walls; place them inside, or leave them out of the fix's group",
                   hs_fix_who(fix).text, (long long)n_outside);
}

#endif
