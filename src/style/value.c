#include "style/value.h"

#include <string.h>

#include "base/memory.h"
#include "style/custom_atom.h"

void hs_value_fini(hs_value *value)
{
    HS_FREE(value->word);
    HS_FREE(value->id);
}

void hs_values_destroy(hs_value **values, int n)
{
    for (int i = 0; *values != NULL && i < n; ++i) hs_value_fini(&(*values)[i]);
    HS_FREE(*values);
}

static hs_compute *compute_of(hs_env *env, const hs_value *value)
{
    return value->kind == 'c' ? env->find_compute(env, value->id) : NULL;
}

static hs_fix *fix_of(hs_env *env, const hs_value *value)
{
    return value->kind == 'f' ? env->find_fix(env, value->id) : NULL;
}

/** The value per atom i_name or d_name. */
static const hs_atom_field *custom_of(const hs_env *env, const hs_value *value)
{
    return value->kind == 'i' || value->kind == 'd' ? hs_custom_atom_find(env->atoms, value->kind, value->id) : NULL;
}

int hs_value_limit(hs_env *env, const hs_value *value, hs_value_shape shape, int which)
{
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    if (compute == NULL && fix == NULL) return 0;
    if (shape == HS_VALUE_LOCAL) return compute != NULL && compute->has_local ? compute->n_local_columns : 0;
    const bool has_array = compute != NULL ? compute->has_array : fix->has_array;
    const bool has_vector = compute != NULL ? compute->has_vector : fix->has_vector;
    const bool has_atoms = compute != NULL ? compute->has_atoms : fix->has_atoms;
    const int n_columns = compute != NULL ? compute->n_columns : fix->n_columns;
    if (shape == HS_VALUE_VECTOR) return has_array ? n_columns : 0;
    if (shape == HS_VALUE_ATOMS)
        return has_atoms ? (compute != NULL ? compute->n_atom_columns : fix->n_atom_columns) : 0;
    if (value->n_indices < 2) return has_vector ? (compute != NULL ? compute->n_vector : fix->n_vector) : 0;
    if (!has_array) return 0;
    return which == 1 ? n_columns : compute != NULL ? compute->n_rows : fix->n_rows;
}

/** Whether index number `which` counts elements or rows of which there may be more at another time. */
static bool is_open_ended(hs_env *env, const hs_value *value, hs_value_shape shape, int which)
{
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    if (shape != HS_VALUE_NUMBER || which != 0) return false;
    if (!hs_value_is_variable(env, value)) return false;
    if (value->n_indices == 1) return compute != NULL ? compute->has_vector : fix->has_vector;
    return compute != NULL ? compute->has_array : fix->has_array;
}

bool hs_value_exists(hs_env *env, const hs_value *value)
{
    return compute_of(env, value) != NULL || fix_of(env, value) != NULL;
}

bool hs_value_has(hs_env *env, const hs_value *value, hs_value_shape shape)
{
    if (value->kind == 'v') {
        const hs_variable_kind kind = hs_env_variable_kind(env, value->id);
        if (value->n_indices > 0) return shape == HS_VALUE_NUMBER && kind == HS_VECTOR_VARIABLE;
        return shape == HS_VALUE_VECTOR   ? kind == HS_VECTOR_VARIABLE
               : shape == HS_VALUE_NUMBER ? kind == HS_NUMBER_VARIABLE
               : shape == HS_VALUE_LOCAL  ? false
                                          : kind == HS_NUMBER_VARIABLE || kind == HS_ATOM_VARIABLE;
    }
    if (custom_of(env, value) != NULL) return shape == HS_VALUE_ATOMS && value->n_indices == 0;
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    if (compute == NULL && fix == NULL) return false;
    for (int k = 0; k < value->n_indices; ++k)
        if (value->index[k] > (is_open_ended(env, value, shape, k) ? INT32_MAX : hs_value_limit(env, value, shape, k)))
            return false;
    if (value->n_indices > 0) return shape == HS_VALUE_NUMBER || value->n_indices == 1;
    switch (shape) {
    case HS_VALUE_NUMBER:
        return compute != NULL ? compute->has_scalar : fix->has_scalar;
    case HS_VALUE_VECTOR:
        return compute != NULL ? compute->has_vector : fix->has_vector;
    case HS_VALUE_LOCAL:
        return compute != NULL && compute->has_local && compute->n_local_columns == 0;
    default:
        return compute != NULL ? compute->has_atoms && compute->n_atom_columns == 0
                               : fix->has_atoms && fix->n_atom_columns == 0;
    }
}

/** What the compute or fix does have, for messages: "a scalar, a vector of 6". */
static void describe(hs_env *env, const hs_value *value, char *text, size_t size)
{
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    const char *id = value->id;
    char part[4][160] = {"", "", "", ""}, scalar[160] = "";
    const char k = value->kind;
    const bool has_scalar = compute != NULL ? compute->has_scalar : fix->has_scalar;
    hs_value number = *value;
    number.n_indices = 1;
    const int n_vector = hs_value_limit(env, &number, HS_VALUE_NUMBER, 0);
    number.n_indices = 2;
    const int n_rows = hs_value_limit(env, &number, HS_VALUE_NUMBER, 0),
              n_columns = hs_value_limit(env, &number, HS_VALUE_NUMBER, 1);
    const bool has_array = compute != NULL ? compute->has_array : fix->has_array;
    const bool has_atoms = compute != NULL ? compute->has_atoms : fix->has_atoms;
    const int n_atoms = hs_value_limit(env, value, HS_VALUE_ATOMS, 0),
              n_local = hs_value_limit(env, value, HS_VALUE_LOCAL, 0);
    const bool has_local = compute != NULL && compute->has_local;
    static const char readers[] = ", for dump local, compute reduce and fix ave/histo";
    if (has_scalar) snprintf(scalar, sizeof scalar, "; the value %c_%.60s", k, id);
    if (n_vector > 0) snprintf(part[0], sizeof part[0], "; the vector %c_%.60s of %d elements", k, id, n_vector);
    if (has_array)
        snprintf(part[1], sizeof part[1], "; the array %c_%.60s of %d rows and %d columns", k, id, n_rows, n_columns);
    if (has_atoms && n_atoms == 0) snprintf(part[2], sizeof part[2], "; values per atom %c_%.60s", k, id);
    if (has_atoms && n_atoms > 0)
        snprintf(part[2], sizeof part[2], "; %d values per atom, %c_%.60s[1] and so on", n_atoms, k, id);
    if (has_local && n_local == 0) snprintf(part[3], sizeof part[3], "; local values %c_%.60s%s", k, id, readers);
    if (has_local && n_local > 0)
        snprintf(part[3], sizeof part[3], "; %d local values a row, %c_%.60s[1] and so on%s", n_local, k, id, readers);
    snprintf(text, size, "%s%s%s%s%s", scalar, part[0], part[1], part[2], part[3]);
}

hs_status hs_value_check(hs_env *env, const hs_value *value, hs_value_shape shape, const char *command, hs_error *err)
{
    static const char *const wanted[] = {"a number", "a vector", "a value for each atom", "a local value"};
    if (hs_value_has(env, value, shape)) return HS_OK;
    const char *kind = value->kind == 'c' ? "compute" : value->kind == 'f' ? "fix" : "variable";
    if (value->kind == 'v') {
        static const char *const has[] = {"", "one number", "one for each atom", "a vector"};
        const hs_variable_kind its_kind = hs_env_variable_kind(env, value->id);
        if (its_kind == HS_NO_VARIABLE)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: there is no variable '%s' for %s: the command 'variable' makes one", command, value->id,
                           value->word);
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s is needed here, and the variable v_%s has %s%s", command,
                       wanted[shape], value->id, has[its_kind],
                       value->n_indices > 0 ? ": only elements of vectors are counted" : "");
    }
    if (value->kind == 'i' || value->kind == 'd') {
        const hs_atom_field *field;
        HS_TRY(hs_custom_atom_get(env->atoms, value->word, command, &field, err));
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s is needed here, and %s is one for each atom", command,
                       wanted[shape], value->word);
    }
    if (!hs_value_exists(env, value))
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no %s '%s' for %s: the command '%s' makes one", command, kind,
                       value->id, value->word, kind);
    char has[800]; /* five parts of less than 160 characters */
    describe(env, value, has, sizeof has);
    const char *style =
        value->kind == 'c' ? compute_of(env, value)->style->about.name : fix_of(env, value)->style->about.name;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s is not %s; %s '%s' (%s) has %s", command, value->word, wanted[shape],
                   kind, value->id, style, has[0] != '\0' ? has + 2 : "no values");
}

hs_status hs_values_check(hs_env *env, const hs_value *values, int n, hs_value_shape shape, const char *command,
                          hs_error *err)
{
    for (int k = 0; k < n; ++k) HS_TRY(hs_value_check(env, &values[k], shape, command, err));
    return HS_OK;
}

/** Length of the vector of a variable; see env->variable_length. */
static hs_status variable_length(hs_env *env, const hs_value *value, bool refresh, int *length, bool *varies,
                                 hs_error *err)
{
    *length = 0;
    *varies = false;
    return env->variable_length != NULL ? env->variable_length(env->deck, value->id, refresh, length, varies, err)
                                        : HS_OK;
}

/** The same as it was when its parts were brought up to date last, which cannot fail. */
static int known_length(hs_env *env, const hs_value *value, bool *varies)
{
    int length;
    hs_error unused = {0};
    return variable_length(env, value, false, &length, varies, &unused) == HS_OK ? length : 0;
}

bool hs_value_is_variable(hs_env *env, const hs_value *value)
{
    bool varies;
    if (value->kind == 'v') return (void)known_length(env, value, &varies), varies;
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    return compute != NULL ? compute->has_variable_length : fix != NULL && fix->has_variable_length;
}

hs_status hs_value_refresh(hs_env *env, const hs_value *value, hs_error *err)
{
    int length;
    bool varies;
    if (value->kind == 'v') return variable_length(env, value, true, &length, &varies, err);
    hs_compute *compute = compute_of(env, value);
    if (compute == NULL || !compute->has_variable_length) return HS_OK;
    return compute->has_array ? hs_compute_eval_array(compute, err) : hs_compute_eval_vector(compute, err);
}

int hs_value_length(hs_env *env, const hs_value *value)
{
    bool varies;
    if (value->kind == 'v') return known_length(env, value, &varies);
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    if (compute == NULL && fix == NULL) return 0;
    if (value->n_indices > 0) return compute != NULL ? compute->n_rows : fix->n_rows;
    return compute != NULL ? compute->n_vector : fix->n_vector;
}

/** An element of a vector-style variable; those beyond its end are 0, as of computes whose length varies. */
static hs_status element_of_variable(hs_env *env, const hs_value *value, double *number, hs_error *err)
{
    int length;
    bool varies;
    double *values;
    HS_TRY(hs_value_check(env, value, HS_VALUE_NUMBER, value->word, err));
    HS_TRY(variable_length(env, value, true, &length, &varies, err));
    HS_TRY(HS_ALLOC(values, (size_t)length, err));
    const hs_status status = env->variable_vector(env->deck, value->id, length, values, err);
    *number = value->index[0] <= length ? values[value->index[0] - 1] : 0.0;
    HS_FREE(values);
    return status;
}

hs_status hs_value_number(hs_env *env, const hs_value *value, double *number, hs_error *err)
{
    if (value->kind == 'v' && value->n_indices > 0) return element_of_variable(env, value, number, err);
    if (value->kind == 'v') {
        if (env->variable_value != NULL) return env->variable_value(env->deck, value->id, number, err);
        return hs_fail(err, HS_ERROR_INPUT, "there is no variable '%s'", value->id);
    }
    HS_TRY(hs_value_check(env, value, HS_VALUE_NUMBER, value->word, err));
    hs_compute *compute = compute_of(env, value);
    hs_fix *fix = fix_of(env, value);
    const int i = (int)value->index[0] - 1, j = (int)value->index[1] - 1;
    switch (value->n_indices) {
    case 0:
        return compute != NULL ? hs_compute_scalar(compute, number, err) : fix->style->scalar(fix, number, err);
    case 1:
        return compute != NULL ? hs_compute_vector(compute, i, number, err) : fix->style->vector(fix, i, number, err);
    default:
        if (fix != NULL) return fix->style->array(fix, i, j, number, err);
        HS_TRY(hs_compute_eval_array(compute, err));
        /* the number of rows may be another now */
        *number = i < compute->n_rows ? compute->array[(size_t)i * (size_t)compute->n_columns + (size_t)j] : 0.0;
        return HS_OK;
    }
}

hs_status hs_value_vector(hs_env *env, const hs_value *value, double *out, hs_error *err)
{
    HS_TRY(hs_value_check(env, value, HS_VALUE_VECTOR, value->word, err));
    if (value->kind == 'v') return env->variable_vector(env->deck, value->id, hs_value_length(env, value), out, err);
    hs_compute *compute = compute_of(env, value);
    hs_fix *fix = fix_of(env, value);
    const int j = (int)value->index[0] - 1, n = hs_value_length(env, value);
    if (fix != NULL) {
        for (int i = 0; i < n; ++i)
            HS_TRY(value->n_indices > 0 ? fix->style->array(fix, i, j, &out[i], err)
                                        : fix->style->vector(fix, i, &out[i], err));
    } else if (value->n_indices > 0) {
        HS_TRY(hs_compute_eval_array(compute, err));
        for (int i = 0; i < n; ++i) out[i] = compute->array[(size_t)i * (size_t)compute->n_columns + (size_t)j];
    } else {
        HS_TRY(hs_compute_eval_vector(compute, err));
        memcpy(out, compute->vector, (size_t)n * sizeof *out);
    }
    return HS_OK;
}

hs_status hs_value_atoms(hs_env *env, const hs_value *value, double *out, hs_error *err)
{
    if (value->kind == 'v' && env->variable_atoms != NULL) return env->variable_atoms(env->deck, value->id, out, err);
    HS_TRY(hs_value_check(env, value, HS_VALUE_ATOMS, value->word, err));
    const hs_atom_field *custom = custom_of(env, value);
    if (custom != NULL) {
        hs_custom_atom_read(env->atoms, custom, out);
        return HS_OK;
    }
    const int column = value->n_indices > 0 ? (int)value->index[0] - 1 : 0;
    hs_fix *fix = fix_of(env, value);
    if (fix != NULL) return fix->style->per_atom(fix, column, out, err);
    hs_compute *compute = compute_of(env, value);
    HS_TRY(hs_compute_eval_atoms(compute, err));
    const size_t n = (size_t)env->atoms->n_local;
    if (n > 0) memcpy(out, compute->atoms + (size_t)column * n, n * sizeof *out);
    return HS_OK;
}

hs_status hs_value_local(hs_env *env, const hs_value *value, const hs_local_rows **rows, const double **column,
                         hs_error *err)
{
    HS_TRY(hs_value_check(env, value, HS_VALUE_LOCAL, value->word, err));
    hs_compute *compute = compute_of(env, value);
    HS_TRY(hs_compute_eval_local(compute, err));
    *rows = &compute->local;
    *column = compute->local.values + (value->n_indices > 0 ? value->index[0] - 1 : 0) * compute->local.n;
    return HS_OK;
}

hs_status hs_values_check_rows(hs_env *env, const hs_value *a, const hs_value *b, const char *command, hs_error *err)
{
    const hs_local_rows *of_a, *of_b;
    const double *unused;
    HS_TRY(hs_value_local(env, a, &of_a, &unused, err));
    HS_TRY(hs_value_local(env, b, &of_b, &unused, err));
    if (of_a->n != of_b->n)
        (void)!hs_fail(err, HS_ERROR_INPUT, "%s: %s has %lld rows and %s %lld: they are not of the same pairs", command,
                       a->word, (long long)of_a->n_all, b->word, (long long)of_b->n_all);
    return hs_parallel_agree(env->parallel, err);
}

hs_status hs_value_find_extents(hs_env *env, const hs_value *value, const char *command, hs_value_extents *extents,
                                hs_error *err)
{
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    const bool has_array = compute != NULL ? compute->has_array : fix != NULL && fix->has_array;
    *extents = (hs_value_extents){.rank = 0, .n = {1, 1}};
    if (hs_value_has(env, value, HS_VALUE_NUMBER)) return HS_OK;
    if (has_array && value->n_indices == 0) {
        extents->rank = 2;
        extents->n[0] = compute != NULL ? compute->n_rows : fix->n_rows;
        extents->n[1] = compute != NULL ? compute->n_columns : fix->n_columns;
        return HS_OK;
    }
    if (!hs_value_has(env, value, HS_VALUE_VECTOR)) return hs_value_check(env, value, HS_VALUE_NUMBER, command, err);
    extents->rank = 1;
    extents->n[0] = hs_value_length(env, value);
    return HS_OK;
}

hs_status hs_value_all(hs_env *env, const hs_value *value, const hs_value_extents *extents, double *out, hs_error *err)
{
    if (extents->rank == 0) return hs_value_number(env, value, out, err);
    if (extents->rank == 1) return hs_value_vector(env, value, out, err);
    const size_t n_columns = (size_t)extents->n[1];
    hs_compute *compute = compute_of(env, value);
    hs_fix *fix = fix_of(env, value);
    if (compute != NULL) {
        HS_TRY(hs_compute_eval_array(compute, err));
        /* the number of rows may be another now */
        const size_t n = (size_t)extents->n[0], n_there = (size_t)compute->n_rows < n ? (size_t)compute->n_rows : n;
        memcpy(out, compute->array, n_there * n_columns * sizeof *out);
        memset(out + n_there * n_columns, 0, (n - n_there) * n_columns * sizeof *out);
        return HS_OK;
    }
    for (int i = 0; i < extents->n[0]; ++i)
        for (int j = 0; j < extents->n[1]; ++j)
            HS_TRY(fix->style->array(fix, i, j, &out[(size_t)i * n_columns + (size_t)j], err));
    return HS_OK;
}

bool hs_value_needs_energy(hs_env *env, const hs_value *value)
{
    const hs_compute *compute = compute_of(env, value);
    if (value->kind == 'i' || value->kind == 'd') return false;
    return value->kind != 'c' || compute == NULL || compute->style->needs_energy || compute->may_need_energy;
}

bool hs_values_need_energy(hs_env *env, const hs_value *values, int n)
{
    bool is_needed = false;
    for (int k = 0; k < n; ++k) is_needed |= hs_value_needs_energy(env, &values[k]);
    return is_needed;
}

void hs_value_announce(hs_env *env, const hs_value *value)
{
    hs_compute *compute = compute_of(env, value);
    if (compute != NULL && compute->style->announce != NULL) compute->style->announce(compute);
}

bool hs_value_is_extensive(hs_env *env, const hs_value *value)
{
    const hs_compute *compute = compute_of(env, value);
    const hs_fix *fix = fix_of(env, value);
    if (compute != NULL)
        return value->n_indices == 0 ? compute->is_extensive : value->n_indices == 1 && compute->is_vector_extensive;
    if (fix == NULL) return false;
    if (value->n_indices == 1 && fix->is_element_extensive != NULL)
        return value->index[0] >= 1 && value->index[0] <= fix->n_vector &&
               fix->is_element_extensive[value->index[0] - 1];
    return value->n_indices == 0   ? fix->is_extensive
           : value->n_indices == 1 ? fix->is_vector_extensive
                                   : fix->is_array_extensive;
}
