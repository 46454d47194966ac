#include "style/pair_columns.h"

#include <math.h>

#include "base/memory.h"

const hs_keyword hs_pair_columns_keywords[] = {
    {"cutoff", 1, "type|radius",
     "pairs nearer than the cutoff of their types (default), or than the sum of their radii"},
    {NULL, 0, NULL, NULL},
};

hs_status hs_pair_columns_add(hs_compute *compute, hs_pair_quantity quantity, hs_error *err)
{
    hs_pair_columns *columns = compute->state;
    HS_TRY(HS_GROW(columns->column, (size_t)columns->n, (size_t)columns->n + 1, err));
    columns->column[columns->n++] = quantity;
    compute->n_local_columns = columns->n > 1 ? columns->n : 0;
    compute->may_need_energy = true; /* the places of the forces are */
    return HS_OK;
}

hs_status hs_pair_columns_read_cutoff(hs_compute *compute, const hs_args *args, int i, hs_error *err)
{
    static const char *const words[] = {"type", "radius", NULL};
    hs_pair_columns *columns = compute->state;
    int choice = 0;
    if (i < args->n) HS_TRY(hs_arg_choice(args, i + 1, words, &choice, err));
    if (choice == 0 || columns->choice == HS_PAIRS_IN_LISTS) return HS_OK;
    if (compute->env->atoms->radius == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: 'cutoff radius' needs atoms that have one: atom_style sphere",
                       args->command);
    columns->choice = HS_PAIRS_IN_CONTACT;
    return HS_OK;
}

void hs_pair_columns_destroy(hs_compute *compute) { HS_FREE(((hs_pair_columns *)compute->state)->column); }

static double value_of(const hs_pair_row *row, hs_pair_quantity quantity)
{
    const double distance = sqrt(row->d[0] * row->d[0] + row->d[1] * row->d[1] + row->d[2] * row->d[2]);
    switch (quantity) {
    case HS_PAIR_DIST:
        return distance;
    case HS_PAIR_DX:
    case HS_PAIR_DY:
    case HS_PAIR_DZ:
        return row->d[quantity - HS_PAIR_DX];
    case HS_PAIR_ENG:
        return row->energy;
    case HS_PAIR_FORCE:
        return row->force_over_r * distance;
    case HS_PAIR_FX:
    case HS_PAIR_FY:
    case HS_PAIR_FZ:
        return row->force_over_r * row->d[quantity - HS_PAIR_FX];
    case HS_PAIR_ATOM1:
    case HS_PAIR_ATOM2:
        return (double)row->id[quantity - HS_PAIR_ATOM1];
    default:
        return row->type[quantity - HS_PAIR_TYPE1];
    }
}

hs_status hs_pair_columns_local(hs_compute *compute, hs_error *err)
{
    hs_pair_columns *columns = compute->state;
    hs_local_rows *local = &compute->local;
    bool with_forces = false;
    for (int c = 0; c < columns->n; ++c)
        with_forces |= columns->column[c] >= HS_PAIR_ENG && columns->column[c] <= HS_PAIR_FZ;
    hs_pair_rows rows = {0};
    hs_status status = hs_pair_rows_find(&rows, compute, columns->choice, with_forces, columns->n_rows, err);
    columns->n_rows = rows.n;
    if (status == HS_OK) status = hs_local_rows_reserve(local, rows.n, columns->n, err);
    for (int c = 0; c < columns->n && status == HS_OK; ++c)
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < rows.n; ++k)
            local->values[c * rows.n + k] = value_of(rows.order[k].row, columns->column[c]);
    hs_pair_rows_fini(&rows);
    return status;
}
