/* Values of each atom, remembered: once, or anew every so many steps. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "style/atom_source.h"
#include "style/moments.h"

/** Of one of the sources. */
typedef struct column {
    char *name;     /**< owned: of the field */
    double *stored; /**< atom field */
} column;

typedef struct store_state {
    int64_t every;           /**< 0: once */
    bool is_about_center;    /**< unwrapped places are those from the group's center of mass */
    bool is_waiting;         /**< values of computes and the like come with the first run: there was none yet */
    hs_atom_source *sources; /**< owned [n] */
    column *columns;         /**< owned [n]; stays in place, for the atoms point into it */
    int n;
} store_state;

static const hs_keyword keywords[] = {
    {"com", 1, "yes|no", "store xu, yu, zu from the center of mass of the group (default no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status add_field(hs_fix *fix, int k, hs_error *err)
{
    column *c = &((store_state *)fix->state)->columns[k];
    char name[160];
    snprintf(name, sizeof name, "fix %.100s stored %d", fix->id, k + 1);
    HS_TRY(hs_memory_strdup(&c->name, name, err));
    return hs_atoms_add_field(fix->env->atoms, c->name, (void **)&c->stored, sizeof(double), false, err);
}

/** Store the attributes, which are known before a run, or all else. */
static hs_status store(const hs_fix *fix, bool is_attribute, hs_error *err)
{
    const store_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    double center[3] = {0.0, 0.0, 0.0};
    if (state->is_about_center && is_attribute) (void)hs_center_of_mass(fix->env, fix->mask, center, NULL);
    for (int k = 0; k < state->n; ++k) {
        const hs_atom_source *source = &state->sources[k];
        double *stored = state->columns[k].stored;
        if ((source->attribute >= 0) != is_attribute) continue;
        HS_TRY(hs_atom_source_values(fix->env, source, fix->mask, stored, err));
        const int axis = source->attribute - HS_ATTR_XU;
        for (int i = 0; i < atoms->n_local && state->is_about_center && axis >= 0 && axis < 3; ++i)
            if (atoms->mask[i] & fix->mask) stored[i] -= center[axis];
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    store_state *state = fix->state;
    const int end = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    HS_TRY(hs_arg_int(args, 0, 0, INT64_MAX, &state->every, err));
    for (int i = end; i < args->n; i += 2) HS_TRY(hs_arg_bool(args, i + 1, &state->is_about_center, err));
    HS_TRY(hs_atom_sources_read(&state->sources, &state->n, fix->env, args, 1, end - 1, hs_attributes, err));
    HS_TRY(HS_ALLOC(state->columns, (size_t)state->n, err));
    for (int k = 0; k < state->n; ++k) {
        state->is_waiting |= state->sources[k].attribute < 0;
        HS_TRY(add_field(fix, k, err));
    }
    fix->n_atom_columns = state->n > 1 ? state->n : 0;
    return store(fix, true, err);
}

static void destroy(hs_fix *fix)
{
    store_state *state = fix->state;
    for (int k = 0; state->columns != NULL && k < state->n; ++k) {
        hs_atoms_remove_field(fix->env->atoms, (void **)&state->columns[k].stored);
        HS_FREE(state->columns[k].name);
    }
    HS_FREE(state->columns);
    hs_atom_sources_destroy(&state->sources, state->n);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const store_state *state = fix->state;
    return hs_atom_sources_check(fix->env, state->sources, state->n, hs_fix_who(fix).text, err);
}

static bool is_due(const store_state *state, int64_t step) { return state->every > 0 && step % state->every == 0; }

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const store_state *state = fix->state;
    return is_due(state, step) && hs_atom_sources_need_energy(fix->env, state->sources, state->n);
}

static hs_status setup(hs_fix *fix, hs_error *err)
{
    store_state *state = fix->state;
    if (!state->is_waiting) return HS_OK;
    state->is_waiting = false;
    return store(fix, false, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    if (!is_due(fix->state, fix->env->step)) return HS_OK;
    HS_TRY(store(fix, true, err));
    return store(fix, false, err);
}

static hs_status per_atom(hs_fix *fix, int k, double *values, hs_error *err)
{
    (void)err;
    memcpy(values, ((const store_state *)fix->state)->columns[k].stored,
           (size_t)fix->env->atoms->n_local * sizeof *values);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_bool(kept, "waits", &((store_state *)fix->state)->is_waiting, err);
}

const hs_fix_style hs_fix_style_store_state = {
    .about = {.name = "store/state",
              .syntax = {.usage = "<N> <value> ... [com yes|no]", .n_min = 2, .n_max = -1, .keywords = keywords},
              .summary = "remember values of each atom",
              .details =
                  "A value is an attribute of atoms, as in `compute property/atom` (`id`, `type`, `mass`, `x`, `xs`, "
                  "`xu`, `xsu`, `ix`, `vx`, `fx` ...), or a value per atom: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, "
                  "`v_name`; ranges as in `c_ID[*]` are several. Attributes are stored when the fix is defined, the "
                  "others at the start of the first run; with N > 0 all are stored anew at each step that is a "
                  "multiple of N. `com yes` stores `xu`, `yu`, `zu` from the center of mass of the group.\n\n"
                  "`f_ID` (with several values `f_ID[1]`, `f_ID[2]` ...) is what is stored, 0 outside of the group. It "
                  "stays with its atom, and is part of checkpoints.",
              .example = "fix start all store/state 0 xu yu zu\nvariable gone atom "
                         "sqrt((xu-f_start[1])^2+(yu-f_start[2])^2)"},
    .state_size = sizeof(store_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .setup = setup,
    .end_of_step = end_of_step,
    .needs_energy = needs_energy,
    .per_atom = per_atom,
    .keep_state = keep_state,
    .is_time_dependent = true,
    .keeps_plane = true,
};
