/* Shape of a group: eigenvalues l1 >= l2 >= l3 of its gyration tensor, b = l1 - (l2 + l3)/2, c = l2 - l3 and
 * kappa^2 = (3/2) (l1^2 + l2^2 + l3^2)/(l1 + l2 + l3)^2 - 1/2. */
#include <string.h>

#include "base/memory.h"
#include "core/rotation.h"
#include "style/compute.h"

enum { N_VALUES = 6 };

typedef struct shape_state {
    char *id; /**< owned; of the compute gyration */
} shape_state;

/** The compute of the tensor as it is now. */
static hs_status find(const hs_compute *compute, hs_compute **gyration, hs_error *err)
{
    const char *id = ((const shape_state *)compute->state)->id;
    const hs_who who = hs_compute_who(compute);
    *gyration = compute->env->find_compute(compute->env, id);
    if (*gyration == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s: there is no compute '%s'", who.text, id);
    if (strcmp((*gyration)->style->about.name, "gyration") == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s is not of style gyration", who.text, hs_compute_who(*gyration).text);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    hs_compute *unused;
    return find(compute, &unused, err);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    shape_state *state = compute->state;
    HS_TRY(hs_memory_strdup(&state->id, args->word[0], err));
    HS_TRY(init(compute, err));
    compute->n_vector = N_VALUES;
    return HS_ALLOC(compute->vector, N_VALUES, err);
}

static void destroy(hs_compute *compute)
{
    HS_FREE(((shape_state *)compute->state)->id);
    HS_FREE(compute->vector);
}

static void swap_if_less(double *first, double *second)
{
    const double kept = *first;
    if (!(*first < *second)) return;
    *first = *second;
    *second = kept;
}

/** Eigenvalues of the tensor xx yy zz xy xz yz, the largest first. */
static void find_eigenvalues(const double t[6], double l[3])
{
    const double matrix[3][3] = {{t[0], t[3], t[4]}, {t[3], t[1], t[5]}, {t[4], t[5], t[2]}};
    double unused[3][3];
    hs_principal_axes(matrix, l, unused);
    swap_if_less(&l[0], &l[1]);
    swap_if_less(&l[1], &l[2]);
    swap_if_less(&l[0], &l[1]);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    double *l = compute->vector;
    hs_compute *gyration;
    HS_TRY(find(compute, &gyration, err));
    HS_TRY(hs_compute_eval_vector(gyration, err));
    find_eigenvalues(gyration->vector, l);
    const double sum = l[0] + l[1] + l[2], sum_of_squares = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
    l[3] = l[0] - 0.5 * (l[1] + l[2]);
    l[4] = l[1] - l[2];
    l[5] = sum > 0.0 ? 1.5 * sum_of_squares / (sum * sum) - 0.5 : 0.0;
    return HS_OK;
}

const hs_compute_style hs_compute_style_gyration_shape = {
    .about =
        {.name = "gyration/shape",
         .syntax = {.usage = "<compute-ID>", .n_min = 1, .n_max = 1},
         .summary = "shape of a group, from its gyration tensor",
         .details =
             "The vector `c_ID[1]` ... `c_ID[3]` has the eigenvalues l1 >= l2 >= l3 of the tensor that the compute "
             "gyration of that ID computes, whose group counts, `c_ID[4]` the asphericity l1 - (l2 + l3)/2, `c_ID[5]` "
             "the acylindricity l2 - l3 (all distance^2), and `c_ID[6]` the relative shape anisotropy kappa^2 = (3/2) "
             "(l1^2 + l2^2 + l3^2)/(l1 + l2 + l3)^2 - 1/2: 0 for what is as wide in all directions, 1/4 for a flat "
             "ring, 1 for a line; 0 also of a single atom or none.",
         .reference = "D. N. Theodorou, U. W. Suter, Macromolecules 18, 1206 (1985), doi:10.1021/ma00148a028",
         .example = "compute g chain gyration\ncompute shape chain gyration/shape g\n"
                    "thermo_style custom step c_g c_shape[6]"},
    .state_size = sizeof(shape_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .vector = vector,
};
