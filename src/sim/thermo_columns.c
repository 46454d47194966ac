/* The columns of thermo output: keywords, and values of computes, fixes and variables. */
#include <string.h>

#include "base/memory.h"
#include "sim/thermo_internal.h"

static void fini_column(hs_thermo_column *column)
{
    HS_FREE(column->header);
    hs_value_fini(&column->value);
    HS_FREE(column->user_format);
    HS_FREE(column->format);
}

void hs_thermo_clear_columns(hs_thermo *thermo)
{
    for (int k = 0; k < thermo->n_columns; ++k) fini_column(&thermo->column[k]);
    thermo->n_columns = 0;
}

/** Append an empty column with the given header. */
static hs_status add_column(hs_thermo *thermo, const char *header, hs_thermo_column **column, hs_error *err)
{
    HS_TRY(HS_EXTEND(thermo->column, thermo->n_columns, thermo->capacity_columns, err));
    *column = &thermo->column[thermo->n_columns++];
    memset(*column, 0, sizeof **column);
    return hs_memory_strdup(&(*column)->header, header, err);
}

static hs_status add_keyword(hs_thermo *thermo, const char *name, hs_error *err)
{
    hs_thermo_column *column;
    const hs_thermo_entry *entry = hs_thermo_find_entry(name);
    HS_TRY(add_column(thermo, entry->header, &column, err));
    column->entry = entry;
    return HS_OK;
}

/** c_ID, c_ID[3], c_ID[*], f_..., v_name: one column, or several for a range. What is named need not exist yet, unless
 *  there is a range. */
static hs_status add_reference(hs_thermo *thermo, const hs_args *args, int i, hs_error *err)
{
    hs_value *values;
    int n;
    hs_status status = HS_OK;
    HS_TRY(hs_values_read(&values, &n, &thermo->sim->env, args, i, 1, HS_VALUE_NUMBER, err));
    for (int k = 0; k < n && status == HS_OK; ++k) {
        hs_thermo_column *column;
        status = add_column(thermo, values[k].word, &column, err);
        if (status != HS_OK) break;
        column->value = values[k];
        memset(&values[k], 0, sizeof values[k]);
    }
    hs_values_destroy(&values, n);
    return status;
}

hs_status hs_thermo_set_columns(hs_thermo *thermo, const hs_args *args, hs_error *err)
{
    const hs_args named = hs_args_from(args, 0, "thermo_style custom");
    hs_thermo_clear_columns(thermo);
    for (int i = 0; i < args->n; ++i) {
        const char *word = args->word[i], *nearest = hs_thermo_check_word(word);
        if (nearest != NULL && nearest[0] != '\0')
            return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: unknown keyword '%s'; did you mean '%s'?", word,
                           nearest);
        if (nearest != NULL)
            return hs_fail(err, HS_ERROR_INPUT,
                           "thermo_style custom: unknown keyword '%s'; a column is a thermo keyword, c_ID, c_ID[i], "
                           "f_ID, f_ID[i] or v_name",
                           word);
        HS_TRY(hs_thermo_find_entry(word) != NULL ? add_keyword(thermo, word, err)
                                                  : add_reference(thermo, &named, i, err));
    }
    return HS_OK;
}

hs_status hs_thermo_set_standard_columns(hs_thermo *thermo, hs_error *err)
{
    static const char *const one[] = {"step", "temp", "epair", "emol", "etotal", "press", NULL};
    static const char *const multi[] = {"etotal", "ke",    "temp",  "pe",    "ebond", "eangle", "edihed",
                                        "eimp",   "evdwl", "ecoul", "elong", "press", NULL};
    const char *const *name = thermo->style == HS_THERMO_STYLE_ONE ? one : multi;
    const hs_box *box = &thermo->sim->box;
    bool can_change = false;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            can_change |=
                box->boundary[axis][side] == HS_BOUNDARY_SHRINK || box->boundary[axis][side] == HS_BOUNDARY_SHRINK_MIN;
    for (int k = 0; k < thermo->sim->n_fixes; ++k) can_change |= thermo->sim->fix[k]->style->changes_box;
    /* Formats of thermo_modify belong to columns by number: keep what stays. */
    int n = 0;
    for (; name[n] != NULL; ++n)
        if (n >= thermo->n_columns) HS_TRY(add_keyword(thermo, name[n], err));
    if (can_change && thermo->n_columns == n) return add_keyword(thermo, "vol", err);
    if (!can_change && thermo->n_columns > n) fini_column(&thermo->column[--thermo->n_columns]);
    return HS_OK;
}

hs_status hs_thermo_resolve_columns(hs_thermo *thermo, hs_error *err)
{
    for (int k = 0; k < thermo->n_columns; ++k)
        if (thermo->column[k].entry == NULL)
            HS_TRY(hs_value_check(&thermo->sim->env, &thermo->column[k].value, HS_VALUE_NUMBER, "thermo_style custom",
                                  err));
    return HS_OK;
}

hs_status hs_thermo_column_value(hs_thermo *thermo, const hs_thermo_column *column, double *value, hs_error *err)
{
    hs_env *env = &thermo->sim->env;
    if (column->entry != NULL) return column->entry->eval(thermo, value, err);
    HS_TRY(hs_value_number(env, &column->value, value, err));
    if (thermo->is_norm && thermo->n_atoms > 0 && hs_value_is_extensive(env, &column->value))
        *value /= (double)thermo->n_atoms;
    return HS_OK;
}

bool hs_thermo_is_int(const hs_thermo_column *column) { return column->entry != NULL && column->entry->is_int; }
