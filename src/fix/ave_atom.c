/* Averages over time of values of each atom. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "style/attribute.h"
#include "style/value.h"

/** One of the values. */
typedef struct column {
    hs_attribute attribute; /**< HS_ATTR_VARIABLE: `value` */
    hs_value *value;        /**< owned */
    char *name[2];          /**< owned: of the fields */
    double *sum, *mean;     /**< atom fields: of the present window; of the last one, 0 before its end */
} column;

typedef struct ave_state {
    hs_schedule schedule;
    column *columns; /**< owned [n]; stays in place, for the atoms point into it */
    int n;
    double *sample; /**< owned [capacity]: of each local atom */
    size_t capacity;
} ave_state;

/** x, y, z, vx ... fz, c_ID, f_ID or v_name; ranges are several. */
static hs_status read_values(hs_fix *fix, const hs_args *args, int i, hs_value **values, int *n, hs_error *err)
{
    static const char *const own[] = {"x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", NULL};
    int which;
    *n = 1;
    *values = NULL;
    if (!hs_value_is_reference(args->word[i])) return hs_arg_choice(args, i, own, &which, err);
    return hs_values_create(values, n, fix->env, args, i, 1, HS_VALUE_ATOMS, err);
}

static hs_status add_field(hs_fix *fix, char **name, const char *what, double **field, hs_error *err)
{
    const ave_state *state = fix->state;
    char text[160];
    snprintf(text, sizeof text, "fix %.100s %s %d", fix->id, what, state->n);
    HS_TRY(hs_memory_strdup(name, text, err));
    return hs_atoms_add_field(fix->env->atoms, *name, (void **)field, sizeof(double), false, err);
}

/** Take over the value; *value is cleared. */
static hs_status add_column(hs_fix *fix, const char *word, hs_value *value, hs_error *err)
{
    ave_state *state = fix->state;
    column *c = &state->columns[state->n++];
    c->attribute = HS_ATTR_VARIABLE;
    if (value == NULL) {
        c->attribute = (hs_attribute)hs_attribute_find(word);
    } else {
        HS_TRY(HS_ALLOC(c->value, 1, err));
        *c->value = *value;
        *value = (hs_value){.kind = 0};
    }
    HS_TRY(add_field(fix, &c->name[0], "sum", &c->sum, err));
    return add_field(fix, &c->name[1], "mean", &c->mean, err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ave_state *state = fix->state;
    int n_columns = 0;
    HS_TRY(hs_schedule_init(&state->schedule, args, 0, err));
    for (int i = 3, n; i < args->n; ++i, n_columns += n) {
        hs_value *values;
        HS_TRY(read_values(fix, args, i, &values, &n, err));
        hs_values_destroy(&values, n);
    }
    HS_TRY(HS_ALLOC(state->columns, (size_t)n_columns, err));
    for (int i = 3, n; i < args->n; ++i) {
        hs_value *values;
        HS_TRY(read_values(fix, args, i, &values, &n, err));
        hs_status status = HS_OK;
        for (int k = 0; k < n && status == HS_OK; ++k)
            status = add_column(fix, args->word[i], values != NULL ? &values[k] : NULL, err);
        hs_values_destroy(&values, n);
        HS_TRY(status);
    }
    fix->n_atom_columns = n_columns > 1 ? n_columns : 0;
    hs_schedule_begin(&state->schedule, fix->env->step);
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    ave_state *state = fix->state;
    for (int k = 0; k < state->n; ++k) {
        column *c = &state->columns[k];
        if (c->sum != NULL) hs_atoms_remove_field(fix->env->atoms, (void **)&c->sum);
        if (c->mean != NULL) hs_atoms_remove_field(fix->env->atoms, (void **)&c->mean);
        HS_FREE(c->name[0]);
        HS_FREE(c->name[1]);
        hs_values_destroy(&c->value, 1);
    }
    HS_FREE(state->columns);
    HS_FREE(state->sample);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    char command[128];
    snprintf(command, sizeof command, "fix '%.80s' (ave/atom)", fix->id);
    hs_schedule_renew(&state->schedule, fix->env->step);
    for (int k = 0; k < state->n; ++k)
        if (state->columns[k].value != NULL)
            HS_TRY(hs_value_check(fix->env, state->columns[k].value, HS_VALUE_ATOMS, command, err));
    return HS_OK;
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const ave_state *state = fix->state;
    bool is_needed = false;
    for (int k = 0; k < state->n; ++k)
        is_needed |= state->columns[k].value != NULL && hs_value_needs_energy(fix->env, state->columns[k].value);
    return is_needed && hs_schedule_is_due(&state->schedule, step);
}

static hs_status take_sample(hs_fix *fix, column *c, bool is_first, hs_error *err)
{
    ave_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const int n = atoms->n_local;
    if ((size_t)n >= state->capacity) {
        state->capacity = (size_t)n + (size_t)n / 8 + 1;
        HS_TRY(HS_GROW(state->sample, 0, state->capacity, err));
    }
    if (c->value != NULL) {
        HS_TRY(hs_value_atoms(fix->env, c->value, state->sample, err));
    } else {
        for (int i = 0; i < n; ++i) state->sample[i] = hs_attribute_value(fix->env, c->attribute, false, i);
    }
    for (int i = 0; i < n; ++i)
        if (atoms->mask[i] & fix->mask) c->sum[i] = (is_first ? 0.0 : c->sum[i]) + state->sample[i];
    return HS_OK;
}

/** The window is complete. Atoms that left the group have no mean. */
static void finish(const hs_fix *fix, column *c)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double n_samples = (double)((const ave_state *)fix->state)->schedule.repeat;
    for (int i = 0; i < atoms->n_local; ++i) c->mean[i] = atoms->mask[i] & fix->mask ? c->sum[i] / n_samples : 0.0;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    HS_TRY(hs_fix_need_sample(fix, state->schedule.next, err));
    if (!hs_schedule_is_due(&state->schedule, fix->env->step)) return HS_OK;
    const bool is_first = state->schedule.n_taken == 0;
    for (int k = 0; k < state->n; ++k) HS_TRY(take_sample(fix, &state->columns[k], is_first, err));
    if (!hs_schedule_advance(&state->schedule, fix->env->step)) return HS_OK;
    for (int k = 0; k < state->n; ++k) finish(fix, &state->columns[k]);
    return HS_OK;
}

static hs_status per_atom(hs_fix *fix, int k, double *values, hs_error *err)
{
    (void)err;
    memcpy(values, ((const ave_state *)fix->state)->columns[k].mean, (size_t)fix->env->atoms->n_local * sizeof *values);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_schedule_keep(&((ave_state *)fix->state)->schedule, kept, err);
}

const hs_fix_style hs_fix_style_ave_atom = {
    .about =
        {.name = "ave/atom",
         .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <value> ...", .n_min = 4, .n_max = -1},
         .summary = "average values of each atom over time",
         .details =
             "A value is `x`, `y`, `z` (within the box), `vx`, `vy`, `vz`, `fx`, `fy`, `fz`, or a value per atom: "
             "`c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`; ranges as in `c_ID[*]` are several. At each multiple of "
             "Nfreq the mean of the last Nrepeat samples, Nevery steps apart, is made for each atom of the group.\n\n"
             "`f_ID` (with several values `f_ID[1]`, `f_ID[2]` ...) is the last mean of each atom, 0 before the first "
             "and outside of the group. Means of coordinates are of no use where atoms cross periodic faces: take "
             "`compute property/atom xu`. Sums stay with their atoms; a run that is resumed goes on within a window.",
         .example = "compute s all stress/atom NULL\nfix s all ave/atom 10 100 1000 c_s[1] c_s[2] c_s[3]\n"
                    "dump d all custom 1000 stress.dump id x y z f_s[1] f_s[2] f_s[3]"},
    .state_size = sizeof(ave_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .setup = end_of_step,
    .end_of_step = end_of_step,
    .needs_energy = needs_energy,
    .per_atom = per_atom,
    .keep_state = keep_state,
    .is_time_dependent = true,
};
