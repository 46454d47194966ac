#include "deck/place_atoms.h"

#include <math.h>
#include <string.h>

#include "style/box_change.h"
#include "style/box_flow.h"

/** A periodic axis along which x is farther from the box than images can count; -1: none. */
static int too_far_along(const hs_box *box, const double x[3])
{
    for (int axis = 0; axis < 3; ++axis)
        if (box->periodic[axis] &&
            !(fabs(hs_box_upright(box, x, axis) - box->lo[axis]) < HS_BOX_FARTHEST * hs_box_length(box, axis)))
            return axis;
    return -1;
}

hs_status hs_atoms_wrap_all(hs_sim *sim, const char *command, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        int32_t image[3] = {atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]};
        const int far = too_far_along(&sim->box, x);
        if (far >= 0) {
            (void)hs_fail(err, HS_ERROR_INPUT, "%s: atom %lld would be at %g in %c, more than 1e9 box lengths away",
                          command, (long long)atoms->id[i], x[far], "xyz"[far]);
            break;
        }
        hs_box_wrap(&sim->box, x, image);
        for (int axis = 0; axis < 3; ++axis) {
            atoms->x[axis][i] = x[axis];
            atoms->image[axis][i] = image[axis];
        }
    }
    return hs_parallel_agree(&sim->parallel, err);
}

hs_status hs_atoms_bring_back(hs_sim *sim, const char *command, hs_error *err)
{
    const hs_box_flow *flow = sim->env.box_flow;
    if (flow != NULL && flow->moves_velocities != 0) hs_box_wrap_flowing(&sim->env, flow->edge, flow->moves_velocities);
    return hs_atoms_wrap_all(sim, command, err);
}

hs_status hs_boundary_read(const hs_args *args, int i, int axis, hs_boundary faces[2], hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "p, f, s or m", err));
    const char *word = args->word[i];
    const size_t n = strlen(word);
    if (n < 1 || n > 2 || strspn(word, "pfsm") != n)
        return hs_arg_refuse(args, i, "p, f, s or m, or two of these letters for the lower and the upper face", NULL,
                             err);
    faces[0] = (hs_boundary)word[0];
    faces[1] = (hs_boundary)word[n - 1];
    if ((faces[0] == HS_BOUNDARY_PERIODIC) != (faces[1] == HS_BOUNDARY_PERIODIC))
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' for %c: both faces of an axis must be periodic, or neither",
                       args->command, word, "xyz"[axis]);
    return HS_OK;
}
