/* Means of thermo columns with their errors, and the drift of the energy: thermo_modify means. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "sim/thermo_internal.h"

hs_status hs_thermo_means_begin(hs_thermo *thermo, hs_error *err)
{
    memset(&thermo->drift, 0, sizeof thermo->drift);
    hs_thermo_means_fini(thermo);
    if (!thermo->has_means) return HS_OK;
    thermo->means.n_series = thermo->n_columns;
    return HS_ALLOC(thermo->mean_row, (size_t)thermo->n_columns + 1, err);
}

void hs_thermo_means_fini(hs_thermo *thermo)
{
    hs_series_set_fini(&thermo->means);
    HS_FREE(thermo->mean_row);
}

hs_status hs_thermo_means_keep(hs_thermo *thermo, hs_state *state, hs_error *err)
{
    hs_line *drift = &thermo->drift;
    double sums[] = {drift->mean_x, drift->mean_y, drift->sxx, drift->sxy, drift->syy};
    if (thermo->mean_row == NULL || (state->is_reading && hs_state_find(state, "rows of the drift") == NULL))
        return HS_OK;
    HS_TRY(hs_series_set_keep(&thermo->means, state, "rows", err));
    HS_TRY(hs_state_int64(state, "rows of the drift", &drift->n, 1, err));
    HS_TRY(hs_state_double(state, "drift", sums, 5, err));
    *drift = (hs_line){drift->n, sums[0], sums[1], sums[2], sums[3], sums[4]};
    return HS_OK;
}

/** The first row of a run stands in the run before as well, or is its starting point. */
static bool is_counted(const hs_thermo *thermo)
{
    return thermo->has_means && thermo->mean_row != NULL && thermo->sim->env.step != thermo->sim->env.first_step;
}

void hs_thermo_means_note(hs_thermo *thermo, int k, double value)
{
    if (is_counted(thermo) && k < thermo->means.n_series) thermo->mean_row[k] = value;
}

hs_status hs_thermo_means_row(hs_thermo *thermo, hs_error *err)
{
    double energy, time;
    bool found;
    if (!is_counted(thermo)) return HS_OK;
    HS_TRY(hs_series_set_add(&thermo->means, thermo->mean_row, NULL, err));
    if (thermo->n_atoms == 0) return HS_OK;
    HS_TRY(hs_thermo_keyword(thermo, "etotal", &energy, &found, err));
    HS_TRY(hs_thermo_keyword(thermo, "time", &time, &found, err));
    if (!thermo->is_norm) energy /= (double)thermo->n_atoms;
    hs_line_add(&thermo->drift, time, energy);
    return HS_OK;
}

static void say_drift(const hs_thermo *thermo)
{
    const hs_units *units = thermo->sim->env.units;
    double slope, error;
    if (thermo->drift.n < 3) return;
    hs_line_slope(&thermo->drift, &slope, &error);
    hs_say(thermo->sim->env.out, "Drift of the total energy: %.3g +- %.1g per atom and %s\n", slope, error,
           units->time[0] != '\0' ? units->time : "time");
}

void hs_thermo_say_means(hs_thermo *thermo)
{
    hs_sink *out = thermo->sim->env.out;
    if (!thermo->has_means || thermo->mean_row == NULL) return;
    const int64_t n_rows = thermo->means.n_levels > 0 ? thermo->means.level[0].n : 0;
    if (n_rows < 2) {
        hs_say(out, "\nMeans: fewer than two rows of thermo output after the first: nothing to average\n");
        return;
    }
    bool is_uncertain = false;
    char title[64];
    snprintf(title, sizeof title, "Means of %lld rows", (long long)n_rows);
    hs_average_say_head(out, title);
    for (int k = 0; k < thermo->means.n_series; ++k) {
        const hs_thermo_column *column = &thermo->column[k];
        const hs_estimate e = hs_series_set_estimate(&thermo->means, k);
        if (column->entry != NULL && strcmp(column->entry->name, "step") == 0) continue;
        hs_average_say_row(out, column->header, &e);
        is_uncertain |= !e.is_converged;
    }
    hs_average_say_foot(out, is_uncertain);
    say_drift(thermo);
}
