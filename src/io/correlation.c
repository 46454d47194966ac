#include "io/correlation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/** Which pairs of values are correlated. */
typedef enum { PAIRS_AUTO, PAIRS_UPPER, PAIRS_LOWER, PAIRS_AUTO_UPPER, PAIRS_AUTO_LOWER, PAIRS_FULL } pair_type;
static const char *const pair_types[] = {"auto", "upper", "lower", "auto/upper", "auto/lower", "full", NULL};

hs_status hs_correlation_numbers(hs_fix *fix, const hs_args *args, int64_t n_min, int64_t n_max, int64_t *n,
                                 hs_error *err)
{
    hs_correlation *c = fix->state;
    c->prefactor = 1.0;
    HS_TRY(hs_arg_int(args, 0, 1, INT32_MAX, &c->every, err));
    HS_TRY(hs_arg_int(args, 1, n_min, n_max, n, err));
    HS_TRY(hs_arg_int(args, 2, 1, INT64_MAX / 4, &c->freq, err));
    if (c->freq % c->every == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: output comes every %lld steps (Nfreq), which must be a multiple of the %lld steps between "
                   "samples (Nevery)",
                   args->command, (long long)c->freq, (long long)c->every);
}

hs_status hs_correlation_values(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_correlation *c = fix->state;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    return hs_values_create(&c->values, &c->n_values, fix->env, args, 3, first - 3, HS_VALUE_NUMBER, err);
}

hs_status hs_correlation_keyword(hs_fix *fix, const hs_args *args, int i, int *n_used, hs_error *err)
{
    hs_correlation *c = fix->state;
    const char *word = args->word[i];
    HS_TRY(hs_average_keyword(&c->schedule, NULL, &c->file, args, i, n_used, err));
    if (*n_used > 0) return HS_OK;
    *n_used = 2;
    if (strcmp(word, "type") == 0) return hs_arg_choice(args, i + 1, pair_types, &c->type, err);
    if (strcmp(word, "prefactor") == 0) return hs_arg_double(args, i + 1, &c->prefactor, err);
    if (strcmp(word, "error") == 0) return hs_arg_bool(args, i + 1, &c->has_errors, err);
    *n_used = 0;
    return HS_OK;
}

static bool is_wanted(int type, int i, int j)
{
    switch ((pair_type)type) {
    case PAIRS_AUTO:
        return i == j;
    case PAIRS_UPPER:
        return i < j;
    case PAIRS_LOWER:
        return i > j;
    case PAIRS_AUTO_UPPER:
        return i <= j;
    case PAIRS_AUTO_LOWER:
        return i >= j;
    default:
        return true;
    }
}

hs_status hs_correlation_pair(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_correlation *c = fix->state;
    HS_TRY(HS_ALLOC(c->pair, (size_t)c->n_values * (size_t)c->n_values, err));
    for (int i = 0; i < c->n_values; ++i)
        for (int j = 0; j < c->n_values; ++j) {
            if (!is_wanted(c->type, i, j)) continue;
            c->pair[c->n_pairs][0] = i;
            c->pair[c->n_pairs++][1] = j;
        }
    if (c->n_pairs > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: one value has no pairs of type %s; 'type auto' correlates it with itself",
                   args->command, pair_types[c->type]);
}

hs_status hs_correlation_product(hs_text *head, const hs_fix *fix, int k, hs_error *err)
{
    const hs_correlation *c = fix->state;
    return hs_text_printf(head, err, "%s*%s", c->values[c->pair[k][0]].word, c->values[c->pair[k][1]].word);
}

static hs_status make_head(const hs_fix *fix, hs_text *head, const char *x_name, hs_correlation_name name,
                           hs_error *err)
{
    static const char *const suffixes[] = {"", "_err", "_ineff"};
    hs_correlation *c = fix->state;
    HS_TRY(hs_text_printf(head, err, "# Index %s Ncount", x_name));
    for (int s = 0; s < (c->has_errors ? 3 : 1); ++s)
        for (int k = 0; k < c->n_pairs; ++k) {
            HS_TRY(hs_text_append(head, " ", 1, err));
            HS_TRY(name(head, fix, k, err));
            HS_TRY(hs_text_append(head, suffixes[s], strlen(suffixes[s]), err));
        }
    return hs_memory_strdup(&c->head, hs_text_get(head), err);
}

/** The first sample at or after a step. */
static void renew(hs_correlation *c, int64_t step)
{
    if (c->schedule.start > step) step = c->schedule.start;
    c->next = (step + c->every - 1) / c->every * c->every;
}

hs_status hs_correlation_table(hs_fix *fix, int n_rows, const char *x_name, hs_correlation_name name, hs_error *err)
{
    hs_correlation *c = fix->state;
    hs_text head = {0};
    c->n_rows = n_rows;
    c->n_columns = c->n_pairs * (c->has_errors ? 3 : 1);
    HS_TRY(HS_ALLOC(c->x, (size_t)n_rows, err));
    HS_TRY(HS_ALLOC(c->count, (size_t)n_rows, err));
    HS_TRY(HS_ALLOC(c->result, (size_t)n_rows * (size_t)c->n_columns, err));
    fix->n_rows = n_rows;
    fix->n_columns = c->n_columns + 2;
    renew(c, fix->env->step);
    const hs_status status = make_head(fix, &head, x_name, name, err);
    hs_text_fini(&head);
    return status;
}

void hs_correlation_fini(hs_correlation *c)
{
    hs_values_destroy(&c->values, c->n_values);
    HS_FREE(c->pair);
    HS_FREE(c->x);
    HS_FREE(c->count);
    HS_FREE(c->result);
    HS_FREE(c->head);
    hs_average_file_fini(&c->file);
}

hs_status hs_correlation_init(hs_fix *fix, const char *title, const char *rows, hs_error *err)
{
    hs_correlation *c = fix->state;
    char first[160], second[80];
    if (c->next < fix->env->step) renew(c, fix->env->step);
    HS_TRY(hs_values_check(fix->env, c->values, c->n_values, HS_VALUE_NUMBER, hs_fix_who(fix).text, err));
    snprintf(first, sizeof first, "# %.40s for fix %.100s", title, fix->id);
    snprintf(second, sizeof second, "# Timestep Number-of-%.40s", rows != NULL ? rows : "");
    const char *const head[3] = {first, rows != NULL ? second : c->head, rows != NULL ? c->head : NULL};
    return hs_average_file_open(&c->file, fix->env, head, err);
}

bool hs_correlation_needs_energy(const hs_fix *fix, int64_t step)
{
    const hs_correlation *c = fix->state;
    return step == c->next && hs_values_need_energy(fix->env, c->values, c->n_values);
}

hs_status hs_correlation_sample(hs_fix *fix, double *sample, bool *is_due, hs_error *err)
{
    hs_correlation *c = fix->state;
    HS_TRY(hs_fix_need_sample(fix, c->next, err));
    *is_due = fix->env->step == c->next;
    if (!*is_due) return HS_OK;
    for (int k = 0; k < c->n_values; ++k) HS_TRY(hs_value_number(fix->env, &c->values[k], &sample[k], err));
    c->next += c->every;
    return HS_OK;
}

static hs_status put_rows(hs_correlation *c, hs_error *err)
{
    hs_average_file *file = &c->file;
    for (int row = 0; row < c->n_rows; ++row) {
        HS_TRY(hs_text_printf(&file->text, err, "%d %.15g %.0f", row + 1, c->x[row], c->count[row]));
        for (int k = 0; k < c->n_columns; ++k) {
            /* as in LAMMPS, a lag without samples is 0.0 */
            if (c->count[row] > 0.0)
                HS_TRY(hs_average_file_number(file, c->result[(size_t)row * (size_t)c->n_columns + (size_t)k], err));
            else
                HS_TRY(hs_text_append(&file->text, " 0.0", 4, err));
        }
        HS_TRY(hs_text_append(&file->text, "\n", 1, err));
    }
    return HS_OK;
}

void hs_correlation_scale(hs_correlation *c)
{
    for (int row = 0; row < c->n_rows && c->prefactor != 1.0; ++row)
        for (int k = 0; k < c->n_columns && k < 2 * c->n_pairs; ++k)
            c->result[(size_t)row * (size_t)c->n_columns + (size_t)k] *=
                k < c->n_pairs ? c->prefactor : fabs(c->prefactor);
}

hs_status hs_correlation_finish(hs_fix *fix, hs_error *err)
{
    hs_correlation *c = fix->state;
    hs_average_file *file = &c->file;
    hs_correlation_scale(c);
    if (hs_average_file_is_open(file)) {
        HS_TRY(hs_text_printf(&file->text, err, "%lld %d\n", (long long)fix->env->step, c->n_rows));
        HS_TRY(put_rows(c, err));
    }
    return hs_average_file_commit(file, fix->env, err);
}

hs_status hs_correlation_array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    const hs_correlation *c = fix->state;
    (void)err;
    *value = j == 0 ? c->x[i] : j == 1 ? c->count[i] : c->result[(size_t)i * (size_t)c->n_columns + (size_t)(j - 2)];
    return HS_OK;
}

hs_status hs_correlation_keep(hs_fix *fix, hs_state *kept, hs_error *err)
{
    hs_correlation *c = fix->state;
    HS_TRY(hs_state_int64(kept, "next", &c->next, 1, err));
    HS_TRY(hs_state_double(kept, "x", c->x, c->n_rows, err));
    HS_TRY(hs_state_double(kept, "result", c->result, (int64_t)c->n_rows * c->n_columns, err));
    HS_TRY(hs_state_double(kept, "result_count", c->count, c->n_rows, err));
    return hs_average_file_keep(&c->file, fix->env, kept, err);
}
