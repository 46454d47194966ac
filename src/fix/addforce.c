/* Adds a force to each atom of a group: f += F, with the energy -F r. */
#include <string.h>

#include "base/memory.h"
#include "style/applied_force.h"
#include "style/places.h"
#include "style/shown_sums.h"

typedef struct addforce_state {
    hs_late_sums sums; /**< first, for shown_sums.h: of the forces before, and energy, of the latest step it acted */
    hs_applied_force force;
    int64_t every;
    char *energy_variable;  /**< owned; atom-style variable that gives the energy of each atom; NULL: -F r */
    double *energy_of_atom; /**< owned [capacity] */
    size_t capacity;
} addforce_state;

static const hs_keyword keywords[] = {
    {"every", 1, "<N>", "act at multiples of N steps only"},
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {"energy", 1, "v_<name>", "atom-style variable: the potential energy of each atom in the added force"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    addforce_state *state = fix->state;
    if (strcmp(args->word[i], "every") == 0) return hs_arg_int(args, i + 1, 1, INT64_MAX, &state->every, err);
    if (strcmp(args->word[i], "region") == 0) return hs_applied_force_region(&state->force, fix, args, i + 1, err);
    if (strncmp(args->word[i + 1], "v_", 2) != 0)
        return hs_arg_refuse(args, i + 1, "an atom-style variable (v_name)", NULL, err);
    return hs_memory_replace(&state->energy_variable, args->word[i + 1] + 2, err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    addforce_state *state = fix->state;
    state->every = 1;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_applied_force_create(&state->force, args, false, err));
    for (int i = 3; i < args->n; i += 2) HS_TRY(read_keyword(fix, args, i, err));
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    addforce_state *state = fix->state;
    hs_applied_force_fini(&state->force);
    HS_FREE(state->energy_variable);
    HS_FREE(state->energy_of_atom);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    addforce_state *state = fix->state;
    HS_TRY(hs_applied_force_init(&state->force, fix, true, err));
    if (state->energy_variable == NULL) return HS_OK;
    const hs_variable_kind kind = hs_env_variable_kind(fix->env, state->energy_variable);
    if (kind == HS_ATOM_VARIABLE) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: energy needs an atom-style variable, and '%s' is %s", hs_fix_who(fix).text,
                   state->energy_variable,
                   kind == HS_NO_VARIABLE ? "no variable that has a value" : "of another style");
}

static hs_status update_energies(hs_fix *fix, hs_error *err)
{
    addforce_state *state = fix->state;
    const hs_env *env = fix->env;
    const size_t n = (size_t)env->atoms->n_local;
    if (state->energy_variable == NULL) return HS_OK;
    HS_TRY(HS_RESERVE(state->energy_of_atom, state->capacity, n, err));
    return env->variable_atoms(env->deck, state->energy_variable, state->energy_of_atom, err);
}

/** Add the force along one axis to atoms found[n]; before[] are the forces before, and their energy is taken off
 *  energy[]. */
static void add_along(const hs_fix *fix, int axis, const int32_t *found, int n, double *before, double *energy)
{
    const hs_applied_force *force = &((const addforce_state *)fix->state)->force;
    const hs_atoms *atoms = fix->env->atoms;
    const hs_box *box = fix->env->box;
    const double *of_atom = force->of_atom[axis], *x = atoms->x[axis], value = force->value[axis];
    const double length = hs_box_length(box, axis);
    const int32_t *image = atoms->image[axis];
    const bool is_tilted = box->is_tilted;
    double *restrict f = atoms->f[axis];
    for (int k = 0; k < n; ++k) {
        const int i = found[k];
        before[k] = f[i];
        f[i] = before[k] + (of_atom != NULL ? of_atom[i] : value);
    }
    if (of_atom == NULL && value == 0.0) return;
    for (int k = 0; k < n; ++k) {
        const int i = found[k];
        const double place = is_tilted ? hs_unwrapped(fix->env, axis, i) : x[i] + image[i] * length;
        energy[k] -= (of_atom != NULL ? of_atom[i] : value) * place;
    }
}

/** Add the force, and up the forces before and its energy. */
static void add_force(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const addforce_state *state = fix->state;
    int32_t found[HS_EXACT_ARRAY_MAX];
    double before[HS_EXACT_ARRAY_MAX], energy[HS_EXACT_ARRAY_MAX];
    const int n = hs_applied_force_find(&state->force, fix, begin, end, found);
    (void)atoms;
    memset(energy, 0, (size_t)n * sizeof *energy);
    for (int axis = 0; axis < 3; ++axis) {
        add_along(fix, axis, found, n, before, energy);
        hs_exact_add_array(&sums[axis], before, n);
    }
    for (int k = 0; state->energy_variable != NULL && k < n; ++k) energy[k] = state->energy_of_atom[found[k]];
    hs_exact_add_array(&sums[HS_SHOWN_ENERGY], energy, n);
}

static void virial_of(const hs_fix *fix, int i, double w[6])
{
    const addforce_state *state = fix->state;
    double r[3], f[3];
    if (!hs_applied_force_acts(&state->force, fix, i)) return;
    hs_unwrapped_place(fix->env, i, r);
    for (int axis = 0; axis < 3; ++axis) f[axis] = hs_applied_force_of(&state->force, axis, i);
    hs_fix_add_virial(f, r, w); /* F_a r_b as in LAMMPS: the virial of an outer force is not symmetric */
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    addforce_state *state = fix->state;
    if (fix->env->step % state->every != 0) return HS_OK;
    HS_TRY(hs_applied_force_update(&state->force, fix, err));
    HS_TRY(update_energies(fix, err));
    hs_late_sums_make(&state->sums, fix->env->atoms, add_force, fix, HS_N_SHOWN);
    if (hs_fix_needs_virial(fix)) hs_fix_sum_virial(fix, virial_of);
    return HS_OK;
}

const hs_fix_style hs_fix_style_addforce = {
    .about =
        {.name = "addforce",
         .syntax = {.usage = "<fx> <fy> <fz> [keyword value ...]", .n_min = 3, .n_max = 3, .keywords = keywords},
         .summary = "add a force to each atom of a group",
         .details =
             "At every step (with `every`, at multiples of N) fx, fy, fz (force units) are added to the force on each "
             "atom of the group. `v_name` is an equal-style variable, evaluated at every step, or an atom-style one. "
             "With `region` only atoms that are in the region at the step are concerned.\n\nThe vector `f_ID[1]` ... "
             "`f_ID[3]` is the sum of the forces on these atoms before. The scalar `f_ID` is the potential energy: the "
             "sum of -F r with unwrapped places, which is right for constant forces; for forces that depend on the "
             "place, `energy v_name` gives the energy of each atom. `fix_modify energy yes` adds it to the potential "
             "energy, `fix_modify virial yes` the virial of the force to the pressure.",
         .example = "fix drive beads addforce 0.1 0.0 0.0\n"
                    "variable push atom 0.5*sin(y)\nfix 2 all addforce v_push 0 0 region middle"},
    .state_size = sizeof(addforce_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .post_force = post_force,
    .acts_in_minimize = true,
    HS_SHOWN_HOOKS,
    .has_virial = true,
    .allows_dynamic_group = true,
};
