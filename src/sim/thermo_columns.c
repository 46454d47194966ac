/* The columns of thermo output: keywords, and values of computes, fixes and variables. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "sim/thermo_internal.h"

static void fini_column(hs_thermo_column *column)
{
    HS_FREE(column->header);
    HS_FREE(column->id);
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
    if (thermo->n_columns == thermo->capacity_columns) {
        const int capacity = thermo->capacity_columns * 2 + 16;
        HS_TRY(HS_GROW(thermo->column, (size_t)thermo->n_columns, (size_t)capacity, err));
        thermo->capacity_columns = capacity;
    }
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

static hs_status add_reference(hs_thermo *thermo, char kind, const char *id, int index, hs_error *err)
{
    hs_text header = {0};
    hs_thermo_column *column;
    hs_status status = hs_text_printf(&header, err, "%c_%s", kind, id);
    if (status == HS_OK && index > 0) status = hs_text_printf(&header, err, "[%d]", index);
    if (status == HS_OK) status = add_column(thermo, hs_text_get(&header), &column, err);
    hs_text_fini(&header);
    HS_TRY(status);
    column->kind = kind;
    column->index = index;
    return hs_memory_strdup(&column->id, id, err);
}

/** Elements of the vector of a compute or fix that the deck has made already. */
static hs_status vector_length(hs_thermo *thermo, char kind, const char *id, int *n, hs_error *err)
{
    hs_compute *compute = kind == 'c' ? hs_sim_find_compute(thermo->sim, id) : NULL;
    hs_fix *fix = kind == 'f' ? hs_sim_find_fix(thermo->sim, id) : NULL;
    if (compute == NULL && fix == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: %c_%s[*] needs the %s '%s' to exist already", kind,
                       id, kind == 'c' ? "compute" : "fix", id);
    *n = compute != NULL ? compute->n_vector : fix->style->n_vector;
    if (*n > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: %c_%s[*]: '%s' has no vector", kind, id, id);
}

/** c_ID[2*4]: a range of elements, each a column. */
static hs_status add_elements(hs_thermo *thermo, char kind, const char *id, const char *range, hs_error *err)
{
    int n, lo, hi;
    HS_TRY(vector_length(thermo, kind, id, &n, err));
    hs_args args = {.command = "thermo_style custom", .n = 1, .word = &range};
    if (hs_arg_range(&args, 0, n, &lo, &hi, err) != HS_OK) {
        hs_error_clear(err);
        return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: %c_%s[%s]: the elements are 1 to %d", kind, id, range,
                       n);
    }
    for (int i = lo; i <= hi; ++i) HS_TRY(add_reference(thermo, kind, id, i, err));
    return HS_OK;
}

/** c_ID, c_ID[3], c_ID[*], f_..., v_name; hs_thermo_check_word has approved the form. */
static hs_status parse_reference(hs_thermo *thermo, const char *word, hs_error *err)
{
    char id[256], range[32] = "";
    const char *bracket = strchr(word, '[');
    const size_t n_id = bracket != NULL ? (size_t)(bracket - word) - 2 : strlen(word) - 2;
    const size_t n_range = bracket != NULL ? strlen(bracket) - 2 : 0;
    if (n_id >= sizeof id || n_range >= sizeof range)
        return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: '%s' is too long", word);
    memcpy(id, word + 2, n_id);
    id[n_id] = '\0';
    if (bracket == NULL) return add_reference(thermo, word[0], id, 0, err);
    if (word[0] == 'v')
        return hs_fail(err, HS_ERROR_INPUT,
                       "thermo_style custom: '%s': a variable in thermo output has one value; use v_%s", word, id);
    memcpy(range, bracket + 1, n_range);
    range[n_range] = '\0';
    if (strchr(range, '*') != NULL) return add_elements(thermo, word[0], id, range, err);
    int64_t index;
    if (!hs_text_to_int64(range, &index) || index < 1 || index > INT32_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: '%s': elements count from 1", word);
    return add_reference(thermo, word[0], id, (int)index, err);
}

hs_status hs_thermo_set_columns(hs_thermo *thermo, const hs_args *args, hs_error *err)
{
    hs_thermo_clear_columns(thermo);
    for (int i = 0; i < args->n; ++i) {
        const char *word = args->word[i], *nearest = hs_thermo_check_word(word);
        if (nearest != NULL && nearest[0] != '\0')
            return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: unknown keyword '%s'; did you mean '%s'?", word,
                           nearest);
        if (nearest != NULL)
            return hs_fail(err, HS_ERROR_INPUT,
                           "thermo_style custom: unknown keyword '%s'; a column is a thermo keyword, "
                           "c_ID, c_ID[i], f_ID, f_ID[i] or v_name",
                           word);
        HS_TRY(hs_thermo_find_entry(word) != NULL ? add_keyword(thermo, word, err)
                                                  : parse_reference(thermo, word, err));
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
    /* Formats of thermo_modify belong to columns by number: keep what stays. */
    int n = 0;
    for (; name[n] != NULL; ++n)
        if (n >= thermo->n_columns) HS_TRY(add_keyword(thermo, name[n], err));
    if (can_change && thermo->n_columns == n) return add_keyword(thermo, "vol", err);
    if (!can_change && thermo->n_columns > n) fini_column(&thermo->column[--thermo->n_columns]);
    return HS_OK;
}

static hs_status resolve_column(hs_thermo *thermo, hs_thermo_column *column, hs_error *err)
{
    const hs_env *env = &thermo->sim->env;
    bool is_missing = false, has_value = true;
    if (column->kind == 'c') {
        column->compute = hs_sim_find_compute(thermo->sim, column->id);
        is_missing = column->compute == NULL;
        if (!is_missing)
            has_value = column->index > 0
                            ? column->compute->style->vector != NULL && column->index <= column->compute->n_vector
                            : column->compute->style->scalar != NULL;
    } else if (column->kind == 'f') {
        column->fix = hs_sim_find_fix(thermo->sim, column->id);
        is_missing = column->fix == NULL;
        if (!is_missing)
            has_value = column->index > 0
                            ? column->fix->style->vector != NULL && column->index <= column->fix->style->n_vector
                            : column->fix->style->scalar != NULL;
    } else if (column->kind == 'v' && env->variable_value == NULL) {
        is_missing = true;
    }
    const char *what = column->kind == 'c' ? "compute" : column->kind == 'f' ? "fix" : "variable";
    if (is_missing)
        return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: there is no %s '%s' for the column %s", what,
                       column->id, column->header);
    if (!has_value)
        return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: the %s '%s' has no value %s", what, column->id,
                       column->header);
    return HS_OK;
}

hs_status hs_thermo_resolve_columns(hs_thermo *thermo, hs_error *err)
{
    for (int k = 0; k < thermo->n_columns; ++k) HS_TRY(resolve_column(thermo, &thermo->column[k], err));
    return HS_OK;
}

static hs_status compute_value(hs_thermo *thermo, const hs_thermo_column *column, double *value, hs_error *err)
{
    const hs_compute_style *style = column->compute->style;
    bool is_extensive = style->is_extensive;
    if (column->index > 0) {
        is_extensive = style->is_vector_extensive;
        HS_TRY(hs_compute_vector(column->compute, column->index - 1, value, err));
    } else {
        HS_TRY(hs_compute_scalar(column->compute, value, err));
    }
    if (is_extensive && thermo->is_norm && thermo->n_atoms > 0) *value /= (double)thermo->n_atoms;
    return HS_OK;
}

hs_status hs_thermo_column_value(hs_thermo *thermo, const hs_thermo_column *column, double *value, hs_error *err)
{
    switch (column->kind) {
    case 'c':
        return compute_value(thermo, column, value, err);
    case 'f':
        if (column->index > 0) return column->fix->style->vector(column->fix, column->index - 1, value, err);
        return column->fix->style->scalar(column->fix, value, err);
    case 'v':
        return thermo->sim->env.variable_value(thermo->sim->env.deck, column->id, value, err);
    default:
        return column->entry->eval(thermo, value, err);
    }
}

bool hs_thermo_is_int(const hs_thermo_column *column) { return column->entry != NULL && column->entry->is_int; }
