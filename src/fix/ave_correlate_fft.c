/* Time correlations over long windows, by fast Fourier transforms: as the direct sum, at a cost that hardly grows with
 * the number of lags; beyond the window on coarser grids. */
#include "io/correlation.h"

typedef struct fft_state {
    hs_correlation table; /**< first, as io/correlation.h wants it */
    hs_correlation_tau sums;
} fft_state;

static const hs_keyword keywords[] = {
    HS_CORRELATION_KEYWORDS,
    HS_CORRELATION_LEVELS,
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    fft_state *state = fix->state;
    int64_t n_lags;
    HS_TRY(hs_correlation_numbers(fix, args, 2, 1 << 28, &n_lags, err));
    HS_TRY(hs_correlation_values(fix, args, err));
    HS_TRY(hs_correlation_tau_keywords(fix, &state->sums, args, n_lags, err));
    HS_TRY(hs_correlation_pair(fix, args, err));
    return hs_correlation_tau_of_pairs(fix, &state->sums, (int)n_lags, err);
}

static void destroy(hs_fix *fix)
{
    fft_state *state = fix->state;
    hs_correlation_tau_fini(&state->sums);
    hs_correlation_fini(&state->table);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_correlation_init(fix, "Time-correlated data", "time-windows", err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    bool is_due;
    HS_TRY(hs_correlation_tau_sample(fix, &((fft_state *)fix->state)->sums, &is_due, err));
    return is_due ? hs_correlation_finish(fix, err) : HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_correlation_tau_keep(fix, &((fft_state *)fix->state)->sums, kept, err);
}

const hs_fix_style hs_fix_style_ave_correlate_fft = {
    .about =
        {.name = "ave/correlate/fft",
         .syntax = {.usage = "<Nevery> <Nlags> <Nfreq> <value> ... [keyword value ...]",
                    .n_min = 4,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "time correlations of numbers over long times",
         .details =
             "As `fix ave/correlate ... ave running`, with the same numbers to rounding: values are sampled every "
             "Nevery steps, and products V_i(s) V_j(s + t) up to Nlags - 1 samples apart are averaged over the whole "
             "series. They are made by zero-padded fast Fourier transforms of blocks of Nlags samples, so that a "
             "sample costs about log(Nlags) instead of Nlags products, and tens of thousands of lags are cheap; memory "
             "is that of two blocks. Results come every Nfreq steps; the file holds the last ones.\n\n"
             "`levels L` goes on beyond the window in the same memory for each level (multiple-tau): a sample of a "
             "level is the mean of two samples of the level below, and its lags from Nlags/2 to Nlags - 1 (of 2^l "
             "Nevery steps) follow those of the level below. So `200 levels 12` reaches from 1 to 400,000 samples with "
             "1300 lags. Averaging over 2^l samples shifts a correlation by about C''(t) (2^l)^2/12, which is small "
             "with a hundred lags or more a level.\n\n"
             "The array `f_ID[i][j]` has the columns time in steps, number of samples, and one for each pair of values "
             "(`type`); lags are not equally spaced beyond the first Nlags rows. With `error yes` a column of standard "
             "errors for each pair follows, from the scatter of blocks of Nlags samples, and then one of "
             "inefficiencies (blocks that count as one); both are `nan` before two blocks are complete. The group has "
             "no meaning.",
         .reference = "W. H. Press et al., Numerical Recipes, 3rd ed. (2007), section 13.2; J. Ramirez et al., J. "
                      "Chem. Phys. 133, 154103 (2010), doi:10.1063/1.3491098",
         .example = "variable pxy equal pxy\nfix SS all ave/correlate/fft 1 20000 100000 v_pxy file "
                    "stress.corr\nvariable eta equal vol/temp*dt*trap(f_SS[3])\nfix long all ave/correlate/fft 10 256 "
                    "100000 v_pxy levels 10 error yes file long.corr"},
    .state_size = sizeof(fft_state),
    HS_CORRELATION_HOOKS,
};
