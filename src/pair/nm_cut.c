/* n-m potential:  U(r) = E0/(n - m) [m (r0/r)^n - n (r0/r)^m] - shift   for r < r_c:  the potential of mie/cut by place and
 * depth of its minimum. It has no evaluator of its own.
 * Source: J. H. R. Clarke, W. Smith, L. V. Woodcock, J. Chem. Phys. 84, 2290 (1986).
 * Units: E0 energy, r0 and r_c distance. */
#include "pair/powers.h"

extern const hs_evaluator hs_evaluator_mie_cut;

/** Coefficients. */
enum { DEPTH, PLACE, REPULSION, ATTRACTION };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_arg_double(args, 0, &c.c[DEPTH], err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.c[PLACE], err));
    HS_TRY(hs_powers_read(args, 2, &c.c[REPULSION], &c.c[ATTRACTION], err));
    HS_TRY(hs_pair_coeffs_read_cutoff(pair, args, 4, &c.cutoff, err));
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_powers powers_of(const hs_pair_coeff *c)
{
    const double n = c->c[REPULSION], m = c->c[ATTRACTION], r0 = c->c[PLACE];
    const double scale = n > m ? c->c[DEPTH] / (n - m) : 0.0;
    return (hs_powers){.a = scale * m * pow(r0, n), .n = n, .b = scale * n * pow(r0, m), .m = m};
}

static hs_status init(hs_pair *pair, hs_error *err) { return hs_powers_check_tail(pair, REPULSION, err); }

const hs_pair_style hs_pair_style_nm_cut = {
    .about =
        {.name = "nm/cut",
         .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
         .summary = "n-m potential: Lennard-Jones with exponents of your own, by place and depth of the minimum",
         .details =
             "U(r) = E0/(n - m) [m (r0/r)^n - n (r0/r)^m] for r < cutoff, 0 beyond: the minimum is -E0, at r0.\n\n"
             "`pair_coeff I J <E0> <r0> <n> <m> [<cutoff>]`: energy, distance, and the exponents of repulsion and "
             "attraction, n > m > 0, whole numbers or not. `pair_modify shift yes` makes the energy zero at the "
             "cutoff; `pair_modify tail yes` adds the long-range part to energy and pressure, for exponents above 3. "
             "Unlike pairs are not mixed: every pair of types must be given. `mie/cut` is the same potential "
             "with mixing.",
         .reference = "J. H. R. Clarke, W. Smith, L. V. Woodcock, J. Chem. Phys. 84, 2290 (1986)",
         .example = "pair_style nm/cut 3.0\npair_coeff * * 1.0 1.12246 14.0 8.0"},
    .coeff_syntax = {.usage = "<E0> <r0> <n> <m> [<cutoff>]", .n_min = 4, .n_max = 5},
    .adaptable =
        (const hs_pair_adaptable[]){{"e0", DEPTH}, {"r0", PLACE}, {"nn", REPULSION}, {"mm", ATTRACTION}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,
    .init = init,
    .params = hs_powers_params,
    .tail = hs_powers_tail,
    .evaluator = &hs_evaluator_mie_cut,
};
