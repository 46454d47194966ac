/* Which atoms, or rows of local values, a snapshot holds, and in which order. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"
#include "style/region.h"

static bool is_selected(const hs_dump *dump, int i)
{
    const hs_dump_table *table = dump->state;
    const hs_atoms *atoms = dump->env->atoms;
    if (!(atoms->mask[i] & dump->mask) || !hs_where_has(&table->where, atoms, i)) return false;
    for (int k = 0; k < table->n_conditions; ++k) {
        const hs_dump_condition *condition = &table->condition[k];
        const double value = hs_dump_value(dump, &condition->column, i),
                     last = condition->last != NULL ? condition->last->values[i] : 0.0,
                     other = condition->last == NULL ? condition->value
                             : isnan(last)           ? value
                                                     : last;
        if (!hs_compares(value, condition->how, other)) return false;
    }
    return true;
}

/** For the next snapshot. */
static void remember_values(const hs_dump *dump)
{
    const hs_dump_table *table = dump->state;
    for (int k = 0; k < table->n_conditions; ++k)
        for (int i = 0; table->condition[k].last != NULL && i < dump->env->atoms->n_local; ++i)
            table->condition[k].last->values[i] = hs_dump_value(dump, &table->condition[k].column, i);
}

/** What a row is sorted by; ties go by id. */
typedef struct sort_key {
    hs_row_key key;
    int32_t index;
} sort_key;

static int ascending(const void *a, const void *b)
{
    return hs_row_compare(&((const sort_key *)a)->key, &((const sort_key *)b)->key, false);
}

static int descending(const void *a, const void *b)
{
    return hs_row_compare(&((const sort_key *)a)->key, &((const sort_key *)b)->key, true);
}

hs_row_key hs_dump_key(const void *context, int64_t k)
{
    const hs_dump *dump = context;
    const hs_dump_table *table = dump->state;
    const int32_t i = table->order[k];
    const int64_t id = table->is_local ? table->first_row + i : dump->env->atoms->id[i];
    const double value = table->sort_column > 0 ? hs_dump_value(dump, &table->column[table->sort_column - 1], i) : 0.0;
    return (hs_row_key){.value = value, .id = id};
}

/** Sort table->order by id or by a column. Without dump_modify sort the rows go by id too: the order in memory
 *  depends on the method and on when atoms were sorted last, and files should not. */
static hs_status sort_rows(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const int n = table->n_rows;
    sort_key *key;
    bool is_sorted = table->sort_column == 0 && !table->is_descending;
    for (int k = 1; k < n && is_sorted; ++k) is_sorted = hs_dump_key(dump, k - 1).id < hs_dump_key(dump, k).id;
    if (is_sorted || table->is_unsorted) return HS_OK;
    HS_TRY(HS_ALLOC(key, (size_t)n, err));
    for (int k = 0; k < n; ++k) key[k] = (sort_key){.key = hs_dump_key(dump, k), .index = table->order[k]};
    qsort(key, (size_t)n, sizeof *key, table->is_descending ? descending : ascending);
    for (int k = 0; k < n; ++k) table->order[k] = key[k].index;
    HS_FREE(key);
    return HS_OK;
}

static hs_status fill_variable(hs_dump *dump, hs_dump_column *column, hs_error *err)
{
    hs_env *env = dump->env;
    if (column->attribute != HS_ATTR_VARIABLE) return HS_OK;
    HS_FREE(column->values);
    HS_TRY(HS_ALLOC(column->values, (size_t)env->atoms->n_local, err));
    return hs_value_atoms(env, &column->reference, column->values, err);
}

static hs_status select_atoms(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const hs_atoms *atoms = dump->env->atoms;
    for (int k = 0; k < table->n_columns; ++k) HS_TRY(fill_variable(dump, &table->column[k], err));
    for (int k = 0; k < table->n_conditions; ++k) HS_TRY(fill_variable(dump, &table->condition[k].column, err));
    HS_TRY(hs_where_find(&table->where, dump->env, hs_dump_who(dump).text, err));
    HS_TRY(hs_where_update(&table->where, err));
    HS_TRY(HS_RESERVE(table->order, table->capacity_order, (size_t)atoms->n_local, err));
    table->n_rows = 0;
    for (int i = 0; i < atoms->n_local; ++i)
        if (is_selected(dump, i)) table->order[table->n_rows++] = i;
    remember_values(dump);
    return sort_rows(dump, err);
}

/** The rows that all columns must have. */
static hs_status find_rows(hs_dump *dump, const hs_local_rows **rows, hs_error *err)
{
    const hs_dump_table *table = dump->state;
    const hs_value *first = NULL;
    const double *unused;
    for (int k = 0; k < table->n_columns; ++k) {
        const hs_dump_column *column = &table->column[k];
        if (column->attribute != HS_ATTR_VARIABLE) continue;
        if (first == NULL) first = &column->reference;
        HS_TRY(hs_values_check_rows(dump->env, first, &column->reference, hs_dump_who(dump).text, err));
    }
    return hs_value_local(dump->env, first, rows, &unused, err);
}

static hs_status copy_column(hs_dump *dump, hs_dump_column *column, hs_error *err)
{
    const hs_local_rows *rows;
    const double *values;
    if (column->attribute != HS_ATTR_VARIABLE) return HS_OK;
    HS_TRY(hs_value_local(dump->env, &column->reference, &rows, &values, err));
    HS_FREE(column->values);
    HS_TRY(HS_ALLOC(column->values, (size_t)rows->n, err));
    if (rows->n > 0) memcpy(column->values, values, (size_t)rows->n * sizeof *values);
    return HS_OK;
}

/** All rows of local values. First all are found, on all ranks: after that no rank waits for others. */
static hs_status select_rows(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const hs_local_rows *rows = NULL;
    HS_TRY(find_rows(dump, &rows, err));
    for (int k = 0; k < table->n_columns; ++k) HS_TRY(copy_column(dump, &table->column[k], err));
    HS_TRY(HS_RESERVE(table->order, table->capacity_order, (size_t)rows->n, err));
    table->first_row = rows->first;
    table->n_rows = rows->n;
    for (int i = 0; i < rows->n; ++i) table->order[i] = i;
    return sort_rows(dump, err);
}

hs_status hs_dump_select(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const hs_status status = table->is_local ? select_rows(dump, err) : select_atoms(dump, err);
    table->n_rows_all = table->n_rows;
    hs_parallel_sum_int64(dump->env->parallel, &table->n_rows_all, 1);
    return status;
}
