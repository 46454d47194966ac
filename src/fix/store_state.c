/* Values of each atom, remembered: once, or anew every so many steps. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "style/attribute.h"
#include "style/moments.h"
#include "style/value.h"

/** One of the values. */
typedef struct column {
    hs_attribute attribute; /**< HS_ATTR_VARIABLE: `value` */
    hs_value *value;        /**< owned */
    char *name;             /**< owned: of the field */
    double *stored;         /**< atom field */
} column;

typedef struct store_state {
    int64_t every;        /**< 0: once */
    bool is_about_center; /**< unwrapped places are those from the group's center of mass */
    bool is_waiting;      /**< values of computes and the like come with the first run: there was none yet */
    column *columns;      /**< owned [n]; stays in place, for the atoms point into it */
    int n;
} store_state;

static const hs_keyword keywords[] = {
    {"com", 1, "yes|no", "store xu, yu, zu from the center of mass of the group (default no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_values(hs_fix *fix, const hs_args *args, int i, hs_value **values, int *n, hs_error *err)
{
    int which;
    *n = 1;
    *values = NULL;
    if (hs_value_is_reference(args->word[i]))
        return hs_values_create(values, n, fix->env, args, i, 1, HS_VALUE_ATOMS, err);
    HS_TRY(hs_arg_choice(args, i, hs_attributes, &which, err));
    if (which == HS_ATTR_ELEMENT) return hs_arg_refuse(args, i, "a number of each atom; type is one", NULL, err);
    return hs_attribute_check((hs_attribute)which, fix->env->atoms, err);
}

/** Take over the value; *value is cleared. */
static hs_status add_column(hs_fix *fix, const char *word, hs_value *value, hs_error *err)
{
    store_state *state = fix->state;
    column *c = &state->columns[state->n++];
    char name[160];
    c->attribute = HS_ATTR_VARIABLE;
    if (value == NULL) {
        c->attribute = (hs_attribute)hs_attribute_find(word);
    } else {
        HS_TRY(HS_ALLOC(c->value, 1, err));
        *c->value = *value;
        *value = (hs_value){.kind = 0};
    }
    snprintf(name, sizeof name, "fix %.100s stored %d", fix->id, state->n);
    HS_TRY(hs_memory_strdup(&c->name, name, err));
    return hs_atoms_add_field(fix->env->atoms, c->name, (void **)&c->stored, sizeof(double), false, err);
}

/** What is known before a run: attributes of the atoms. */
static void store_attribute(const hs_fix *fix, const column *c, const double center[3])
{
    const hs_atoms *atoms = fix->env->atoms;
    const int axis = (int)c->attribute - HS_ATTR_XU;
    const bool is_about_center = ((const store_state *)fix->state)->is_about_center && axis >= 0 && axis < 3;
    for (int i = 0; i < atoms->n_local; ++i)
        c->stored[i] = atoms->mask[i] & fix->mask ? hs_attribute_value(fix->env, c->attribute, false, i) -
                                                        (is_about_center ? center[axis] : 0.0)
                                                  : 0.0;
}

static void store_attributes(const hs_fix *fix)
{
    const store_state *state = fix->state;
    double center[3] = {0.0, 0.0, 0.0};
    if (state->is_about_center) (void)hs_center_of_mass(fix->env, fix->mask, center, NULL);
    for (int k = 0; k < state->n; ++k)
        if (state->columns[k].value == NULL) store_attribute(fix, &state->columns[k], center);
}

static hs_status store_values(const hs_fix *fix, hs_error *err)
{
    const store_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    for (int k = 0; k < state->n; ++k) {
        const column *c = &state->columns[k];
        if (c->value == NULL) continue;
        HS_TRY(hs_value_atoms(fix->env, c->value, c->stored, err));
        for (int i = 0; i < atoms->n_local; ++i)
            if (!(atoms->mask[i] & fix->mask)) c->stored[i] = 0.0;
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    store_state *state = fix->state;
    const int end = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    int n_columns = 0;
    HS_TRY(hs_arg_int(args, 0, 0, INT64_MAX, &state->every, err));
    for (int i = end; i < args->n; i += 2) HS_TRY(hs_arg_bool(args, i + 1, &state->is_about_center, err));
    for (int i = 1, n; i < end; ++i, n_columns += n) {
        hs_value *values;
        HS_TRY(read_values(fix, args, i, &values, &n, err));
        state->is_waiting |= values != NULL;
        hs_values_destroy(&values, n);
    }
    HS_TRY(HS_ALLOC(state->columns, (size_t)n_columns, err));
    for (int i = 1, n; i < end; ++i) {
        hs_value *values;
        HS_TRY(read_values(fix, args, i, &values, &n, err));
        hs_status status = HS_OK;
        for (int k = 0; k < n && status == HS_OK; ++k)
            status = add_column(fix, args->word[i], values != NULL ? &values[k] : NULL, err);
        hs_values_destroy(&values, n);
        HS_TRY(status);
    }
    fix->n_atom_columns = n_columns > 1 ? n_columns : 0;
    store_attributes(fix);
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    store_state *state = fix->state;
    for (int k = 0; k < state->n; ++k) {
        column *c = &state->columns[k];
        if (c->stored != NULL) hs_atoms_remove_field(fix->env->atoms, (void **)&c->stored);
        HS_FREE(c->name);
        hs_values_destroy(&c->value, 1);
    }
    HS_FREE(state->columns);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const store_state *state = fix->state;
    char command[128];
    snprintf(command, sizeof command, "fix '%.80s' (store/state)", fix->id);
    for (int k = 0; k < state->n; ++k)
        if (state->columns[k].value != NULL)
            HS_TRY(hs_value_check(fix->env, state->columns[k].value, HS_VALUE_ATOMS, command, err));
    return HS_OK;
}

static bool is_due(const store_state *state, int64_t step) { return state->every > 0 && step % state->every == 0; }

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const store_state *state = fix->state;
    bool is_needed = false;
    for (int k = 0; k < state->n; ++k)
        is_needed |= state->columns[k].value != NULL && hs_value_needs_energy(fix->env, state->columns[k].value);
    return is_needed && is_due(state, step);
}

static hs_status setup(hs_fix *fix, hs_error *err)
{
    store_state *state = fix->state;
    if (!state->is_waiting) return HS_OK;
    state->is_waiting = false;
    return store_values(fix, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    if (!is_due(fix->state, fix->env->step)) return HS_OK;
    store_attributes(fix);
    return store_values(fix, err);
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
    .about =
        {.name = "store/state",
         .syntax = {.usage = "<N> <value> ... [com yes|no]", .n_min = 2, .n_max = -1, .keywords = keywords},
         .summary = "remember values of each atom",
         .details =
             "A value is an attribute of atoms, as in `compute property/atom` (`id`, `type`, `mass`, `x`, `xs`, `xu`, "
             "`xsu`, `ix`, `vx`, `fx` ...), or a value per atom: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`; "
             "ranges as in "
             "`c_ID[*]` are several. Attributes are stored when the fix is defined, the others at the start of the "
             "first run; "
             "with N > 0 all are stored anew at each step that is a multiple of N. `com yes` stores `xu`, `yu`, `zu` "
             "from the center of mass of the group.\n\n"
             "`f_ID` (with several values `f_ID[1]`, `f_ID[2]` ...) is what is stored, 0 outside of the group. It "
             "stays with "
             "its atom, and is part of checkpoints.",
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
};
