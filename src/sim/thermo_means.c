/* Means of thermo columns with their errors, and the drift of the energy: thermo_modify means. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "sim/thermo_internal.h"

hs_status hs_thermo_means_begin(hs_thermo *thermo, hs_error *err)
{
    memset(&thermo->drift, 0, sizeof thermo->drift);
    if (!thermo->has_means) return HS_OK;
    thermo->n_means = thermo->n_columns;
    return HS_GROW(thermo->means, 0, (size_t)thermo->n_columns, err);
}

/** The first row of a run stands in the run before as well, or is its starting point. */
static bool is_counted(const hs_thermo *thermo)
{
    return thermo->has_means && thermo->means != NULL && thermo->sim->env.step != thermo->sim->env.first_step;
}

void hs_thermo_means_add(hs_thermo *thermo, int k, double value)
{
    if (is_counted(thermo) && k < thermo->n_means) hs_series_add(&thermo->means[k], value, 1.0);
}

hs_status hs_thermo_means_row(hs_thermo *thermo, hs_error *err)
{
    double energy, time;
    bool found;
    if (!is_counted(thermo) || thermo->n_atoms == 0) return HS_OK;
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
    if (!thermo->has_means || thermo->means == NULL) return;
    if (thermo->means[0].n < 2) {
        hs_say(out, "\nMeans: fewer than two rows of thermo output after the first: nothing to average\n");
        return;
    }
    bool is_uncertain = false;
    char title[64];
    snprintf(title, sizeof title, "Means of %lld rows", (long long)thermo->means[0].n);
    hs_average_say_head(out, title);
    for (int k = 0; k < thermo->n_means; ++k) {
        const hs_thermo_column *column = &thermo->column[k];
        const hs_estimate e = hs_series_estimate(&thermo->means[k]);
        if (column->entry != NULL && strcmp(column->entry->name, "step") == 0) continue;
        hs_average_say_row(out, column->header, &e);
        is_uncertain |= !e.is_converged;
    }
    hs_average_say_foot(out, is_uncertain);
    say_drift(thermo);
}
