#include "style/pair_coeffs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"

static hs_pair_coeffs *coeffs_of(const hs_pair *pair) { return pair->state; }

hs_status hs_pair_coeffs_set_cutoff(hs_pair *pair, double cutoff, hs_error *err)
{
    hs_pair_coeffs *coeffs = pair->state;
    const size_t n = (size_t)(pair->n_types + 1) * (size_t)(pair->n_types + 1);
    coeffs->cutoff = cutoff;
    if (coeffs->at == NULL) return HS_ALLOC(coeffs->at, n, err);
    for (size_t k = 0; k < n; ++k)
        if (pair->is_set[k]) coeffs->at[k].cutoff = cutoff;
    return HS_OK;
}

hs_status hs_pair_coeffs_settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    double cutoff;
    HS_TRY(hs_arg_positive(args, 0, &cutoff, err));
    return hs_pair_coeffs_set_cutoff(pair, cutoff, err);
}

hs_status hs_pair_coeffs_no_settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    (void)args;
    return coeffs_of(pair)->at != NULL ? HS_OK : hs_pair_coeffs_set_cutoff(pair, 0.0, err);
}

hs_status hs_pair_coeffs_read_cutoff(const hs_pair *pair, const hs_args *args, int i, double *cutoff, hs_error *err)
{
    *cutoff = ((hs_pair_coeffs *)pair->state)->cutoff;
    return args->n > i ? hs_arg_not_negative(args, i, cutoff, err) : HS_OK;
}

hs_status hs_pair_coeffs_read(const hs_pair *pair, const char *kinds, const hs_args *args, hs_pair_coeff *coeff,
                              hs_error *err)
{
    int n = 0;
    for (; kinds[n] != '\0'; ++n)
        HS_TRY(kinds[n] == '+'   ? hs_arg_positive(args, n, &coeff->c[n], err)
               : kinds[n] == '0' ? hs_arg_not_negative(args, n, &coeff->c[n], err)
                                 : hs_arg_double(args, n, &coeff->c[n], err));
    return hs_pair_coeffs_read_cutoff(pair, args, n, &coeff->cutoff, err);
}

hs_status hs_pair_coeffs_set(const hs_pair *pair, int i, int j, const char *kinds, const hs_args *args, hs_error *err)
{
    hs_pair_coeff coeff = {.cutoff = 0.0};
    HS_TRY(hs_pair_coeffs_read(pair, kinds, args, &coeff, err));
    *hs_pair_coeffs_at(pair, i, j) = coeff;
    return HS_OK;
}

/** A number with as many digits as bring it back. */
static hs_status write_number(double value, hs_text *words, hs_error *err)
{
    char text[40];
    snprintf(text, sizeof text, "%.15g", value);
    return hs_text_printf(words, err, strtod(text, NULL) == value ? "%.15g" : "%.17g", value);
}

static hs_status write_first(const hs_pair *pair, int i, int j, int n, hs_text *words, hs_error *err)
{
    const hs_pair_coeff *coeff = hs_pair_coeffs_at(pair, i, j);
    for (int k = 0; k < n; ++k) {
        if (k > 0) HS_TRY(hs_text_append(words, " ", 1, err));
        HS_TRY(write_number(coeff->c[k], words, err));
    }
    return HS_OK;
}

hs_status hs_pair_coeffs_write(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err)
{
    HS_TRY(write_first(pair, i, j, pair->style->coeff_syntax.n_max - 1, words, err));
    HS_TRY(hs_text_append(words, " ", 1, err));
    return write_number(hs_pair_coeffs_at(pair, i, j)->cutoff, words, err);
}

hs_status hs_pair_coeffs_write_bare(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err)
{
    return write_first(pair, i, j, pair->style->coeff_syntax.n_max, words, err);
}

hs_status hs_pair_coeffs_keep(hs_pair *pair, const char *name, hs_state *state, hs_error *err)
{
    const hs_pair_adaptable *adaptable = pair->style->adaptable;
    for (; adaptable != NULL && adaptable->name != NULL; ++adaptable) {
        hs_text full = {0};
        double *values = NULL;
        const int n = pair->n_types + 1;
        hs_status status = hs_text_printf(&full, err, "%s %s", name, adaptable->name);
        if (status == HS_OK) status = HS_ALLOC(values, (size_t)n * (size_t)n, err);
        for (int k = 0; k < n * n && status == HS_OK; ++k) values[k] = coeffs_of(pair)->at[k].c[adaptable->index];
        if (status == HS_OK) status = hs_state_double(state, hs_text_get(&full), values, (int64_t)n * n, err);
        for (int k = 0; k < n * n && status == HS_OK; ++k) coeffs_of(pair)->at[k].c[adaptable->index] = values[k];
        hs_text_fini(&full);
        HS_FREE(values);
        HS_TRY(status);
    }
    return HS_OK;
}

void hs_pair_coeffs_destroy(hs_pair *pair)
{
    hs_pair_coeffs *coeffs = pair->state;
    HS_FREE(coeffs->at);
}

hs_status hs_pair_coeffs_read_one(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "n", args, err);
}

hs_status hs_pair_coeffs_mix_one(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) =
        (hs_pair_coeff){.c = {sqrt(a.c[0] * b.c[0])}, .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}
