/* Center of mass of a group. */
#include "base/memory.h"
#include "style/compute.h"
#include "style/moments.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    compute->n_vector = 3;
    return HS_ALLOC(compute->vector, 3, err);
}

static void destroy(hs_compute *compute) { HS_FREE(compute->vector); }

static hs_status vector(hs_compute *compute, hs_error *err)
{
    (void)err;
    hs_center_of_mass(compute->env, compute->mask, compute->vector, NULL);
    return HS_OK;
}

const hs_compute_style hs_compute_style_com = {
    .about =
        {.name = "com",
         .syntax = {.usage = "", .n_min = 0, .n_max = 0},
         .summary = "center of mass of a group",
         .details =
             "The vector `c_ID[1]` ... `c_ID[3]` is the center of mass of the group's atoms at their unwrapped places "
             "(distance): it moves on smoothly where atoms cross periodic faces.",
         .example = "compute middle all com"},
    .create = create,
    .destroy = destroy,
    .vector = vector,
};
