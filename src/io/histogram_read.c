/* The words of fix ave/histo. */
#include <string.h>

#include "base/memory.h"
#include "io/histogram.h"

const hs_keyword hs_histogram_keywords[] = {
    HS_AVERAGE_KEYWORDS,
    {"mode", 1, "scalar|vector", "inputs are numbers, or vectors, values per atom and local values (default: scalar)"},
    {"kind", 1, "global|peratom|local", "which of them is meant where a compute or fix has more than one"},
    {"beyond", 1, "ignore|end|extra", "values beyond lo and hi: not counted, in the end bins, or in two more bins"},
    {NULL, 0, NULL, NULL},
};

/* Words */

/** Mode, kind and beyond decide how the inputs and bins are read. @p kind: HS_VALUE_VECTOR, HS_VALUE_ATOMS, HS_VALUE_LOCAL, or
 *  HS_VALUE_NUMBER when nothing was said. */
static hs_status read_own_keywords(hs_histogram *histogram, const hs_args *args, int first, hs_value_shape *kind,
                                   hs_error *err)
{
    static const char *const modes[] = {"scalar", "vector", NULL};
    static const char *const kinds[] = {"global", "peratom", "local", NULL};
    static const hs_value_shape shapes[] = {HS_VALUE_VECTOR, HS_VALUE_ATOMS, HS_VALUE_LOCAL};
    static const char *const beyonds[] = {"ignore", "end", "extra", NULL};
    *kind = HS_VALUE_NUMBER;
    for (int i = first, n_used; i < args->n; i += n_used) {
        int choice;
        HS_TRY(hs_average_keyword(&histogram->schedule, &histogram->fold, &histogram->file, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        if (strcmp(args->word[i], "mode") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, modes, &choice, err));
            histogram->is_vector = choice == 1;
        } else if (strcmp(args->word[i], "kind") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, kinds, &choice, err));
            *kind = shapes[choice];
        } else {
            HS_TRY(hs_arg_choice(args, i + 1, beyonds, &choice, err));
            histogram->beyond = (hs_beyond)choice;
        }
    }
    return HS_OK;
}

/** What mode vector may be of, the first that there is being meant unless `kind` says which. */
static const hs_value_shape vectors[] = {HS_VALUE_VECTOR, HS_VALUE_LOCAL, HS_VALUE_ATOMS};
enum { N_VECTORS = 3 };

/** References of one word: a range counts columns of an array, or else of local values, or of values per atom. */
static hs_status read_references(hs_fix *fix, const hs_args *args, int i, hs_value **values, int *n, hs_error *err)
{
    const hs_histogram *histogram = fix->state;
    if (!histogram->is_vector) return hs_values_read(values, n, fix->env, args, i, 1, HS_VALUE_NUMBER, err);
    hs_status status = HS_ERROR_INPUT;
    for (int k = 0; k < N_VECTORS && status != HS_OK; ++k) {
        hs_error_clear(err);
        status = hs_values_read(values, n, fix->env, args, i, 1, vectors[k], err);
    }
    return status;
}

static hs_status add_inputs(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const int attribute = hs_attribute_find(args->word[i]);
    int n = 0, which;
    hs_value *values = NULL;
    if (hs_value_is_reference(args->word[i])) {
        HS_TRY(read_references(fix, args, i, &values, &n, err));
    } else if (hs_arg_choice(args, i, hs_atom_source_motion, &which, err) != HS_OK) {
        hs_error_clear(err);
        return hs_arg_refuse(args, i, "x, y, z, vx, vy, vz, fx, fy, fz, c_ID, c_ID[i], f_ID, f_ID[i] or v_name",
                             hs_atom_source_motion, err);
    }
    return hs_atom_sources_add(&histogram->inputs, &histogram->n_inputs, attribute, &values, n, HS_VALUE_ATOMS, err);
}

/** Shape of the inputs: what the first one is, unless the words say it. */
static hs_status find_shape(const hs_fix *fix, const hs_args *args, hs_value_shape kind, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const hs_atom_source *first = &histogram->inputs[0];
    if (!histogram->is_vector && kind != HS_VALUE_NUMBER && kind != HS_VALUE_VECTOR)
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s are many: 'kind %s' needs 'mode vector'", args->command,
                       kind == HS_VALUE_ATOMS ? "values per atom" : "local values",
                       kind == HS_VALUE_ATOMS ? "peratom" : "local");
    if (!histogram->is_vector) return HS_OK;
    histogram->shape = kind != HS_VALUE_NUMBER ? kind : HS_VALUE_ATOMS;
    for (int k = N_VECTORS - 1; k >= 0 && kind == HS_VALUE_NUMBER && first->attribute < 0; --k)
        if (hs_value_has(fix->env, &first->value, vectors[k])) histogram->shape = vectors[k];
    return HS_OK;
}

static hs_status check_weight(const hs_fix *fix, const char *command, hs_error *err)
{
    const hs_histogram *histogram = fix->state;
    if (!histogram->is_weighted) return HS_OK;
    if (histogram->n_inputs != 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: two inputs are needed, the values and their weights; there are %d",
                       command, histogram->n_inputs);
    if (histogram->shape != HS_VALUE_VECTOR) return HS_OK;
    const int n = hs_value_length(fix->env, &histogram->inputs[0].value),
              n_weights = hs_value_length(fix->env, &histogram->inputs[1].value);
    if (n == n_weights) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: there must be as many weights as values, and %s has %d elements, %s %d",
                   command, histogram->inputs[0].value.word, n, histogram->inputs[1].value.word, n_weights);
}

hs_status hs_histogram_check(const hs_fix *fix, const char *command, hs_error *err)
{
    const hs_histogram *histogram = fix->state;
    for (int k = 0; k < histogram->n_inputs; ++k) {
        const hs_atom_source *input = &histogram->inputs[k];
        if (input->attribute < 0)
            HS_TRY(hs_value_check(fix->env, &input->value, histogram->shape, command, err));
        else if (histogram->shape != HS_VALUE_ATOMS)
            return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is a value of each atom, which needs 'mode vector'%s",
                           command, hs_attributes[input->attribute],
                           histogram->is_vector ? ", and no global vectors or local values beside it" : "");
    }
    return check_weight(fix, command, err);
}

static hs_status make_bins(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    int64_t n_bins;
    HS_TRY(hs_arg_double(args, 3, &histogram->lo, err));
    HS_TRY(hs_arg_double(args, 4, &histogram->hi, err));
    if (!(histogram->hi > histogram->lo)) return hs_arg_refuse(args, 4, "greater than the lower end", NULL, err);
    HS_TRY(hs_arg_int(args, 5, 1, INT32_MAX / 8, &n_bins, err));
    histogram->width = (histogram->hi - histogram->lo) / (double)n_bins;
    histogram->n_bins = (int)n_bins + (histogram->beyond == HS_BEYOND_EXTRA ? 2 : 0);
    const int n = HS_HISTO_BINS + histogram->n_bins;
    HS_TRY(HS_ALLOC(histogram->count, (size_t)n, err));
    const bool is_window = histogram->fold.mode == HS_FOLD_WINDOW;
    HS_TRY(HS_ALLOC(histogram->extremes, is_window ? (size_t)histogram->fold.n_window : 1, err));
    memcpy(histogram->extremes[0], hs_histogram_nothing, sizeof hs_histogram_nothing);
    return hs_fold_reserve(&histogram->fold, n, err);
}

hs_status hs_histogram_create(hs_fix *fix, const hs_args *args, bool is_weighted, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    hs_value_shape kind;
    histogram->is_weighted = is_weighted;
    HS_TRY(hs_schedule_init(&histogram->schedule, args, 0, err));
    HS_TRY(read_own_keywords(histogram, args, first, &kind, err));
    HS_TRY(hs_fold_check_errors(&histogram->fold, &histogram->schedule, args->command, err));
    histogram->fold.is_share = true;
    HS_TRY(make_bins(fix, args, err));
    for (int i = 6; i < first; ++i) HS_TRY(add_inputs(fix, args, i, err));
    HS_TRY(find_shape(fix, args, kind, err));
    HS_TRY(hs_histogram_check(fix, args->command, err));
    fix->n_rows = histogram->n_bins;
    fix->n_columns = histogram->fold.has_errors ? 5 : 3;
    hs_schedule_begin(&histogram->schedule, fix->env->step);
    return HS_OK;
}
