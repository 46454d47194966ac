/* Averages over time of values of each atom. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "style/atom_source.h"

/** Of one of the sources. */
typedef struct column {
    char *name[2];      /**< owned: of the fields */
    double *sum, *mean; /**< atom fields: of the present window; of the last one, 0 before its end */
} column;

typedef struct ave_state {
    hs_schedule schedule;
    hs_atom_source *sources; /**< owned [n] */
    column *columns;         /**< owned [n]; stays in place, for the atoms point into it */
    int n;
    double *sample; /**< owned [capacity]: of each local atom */
    size_t capacity;
} ave_state;

static hs_status add_field(hs_fix *fix, char **name, const char *what, int k, double **field, hs_error *err)
{
    char text[160];
    snprintf(text, sizeof text, "fix %.100s %s %d", fix->id, what, k + 1);
    HS_TRY(hs_memory_strdup(name, text, err));
    return hs_atoms_add_field(fix->env->atoms, *name, (void **)field, sizeof(double), false, err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ave_state *state = fix->state;
    HS_TRY(hs_schedule_init(&state->schedule, args, 0, err));
    HS_TRY(
        hs_atom_sources_read(&state->sources, &state->n, fix->env, args, 3, args->n - 3, hs_atom_source_motion, err));
    HS_TRY(HS_ALLOC(state->columns, (size_t)state->n, err));
    for (int k = 0; k < state->n; ++k) {
        column *c = &state->columns[k];
        HS_TRY(add_field(fix, &c->name[0], "sum", k, &c->sum, err));
        HS_TRY(add_field(fix, &c->name[1], "mean", k, &c->mean, err));
    }
    fix->n_atom_columns = state->n > 1 ? state->n : 0;
    hs_schedule_begin(&state->schedule, fix->env->step);
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    ave_state *state = fix->state;
    for (int k = 0; state->columns != NULL && k < state->n; ++k) {
        column *c = &state->columns[k];
        hs_atoms_remove_field(fix->env->atoms, (void **)&c->sum);
        hs_atoms_remove_field(fix->env->atoms, (void **)&c->mean);
        HS_FREE(c->name[0]);
        HS_FREE(c->name[1]);
    }
    HS_FREE(state->columns);
    hs_atom_sources_destroy(&state->sources, state->n);
    HS_FREE(state->sample);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    hs_schedule_renew(&state->schedule, fix->env->step);
    return hs_atom_sources_check(fix->env, state->sources, state->n, hs_fix_who(fix).text, err);
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const ave_state *state = fix->state;
    return hs_schedule_is_due(&state->schedule, step) &&
           hs_atom_sources_need_energy(fix->env, state->sources, state->n);
}

static hs_status take_sample(hs_fix *fix, int k, bool is_first, hs_error *err)
{
    ave_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    double *sum = state->columns[k].sum;
    const int n = atoms->n_local;
    HS_TRY(HS_RESERVE(state->sample, state->capacity, (size_t)n, err));
    HS_TRY(hs_atom_source_values(fix->env, &state->sources[k], fix->mask, state->sample, err));
    for (int i = 0; i < n; ++i)
        if (atoms->mask[i] & fix->mask) sum[i] = (is_first ? 0.0 : sum[i]) + state->sample[i];
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
    for (int k = 0; k < state->n; ++k) HS_TRY(take_sample(fix, k, is_first, err));
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
    .keeps_plane = true,
};
