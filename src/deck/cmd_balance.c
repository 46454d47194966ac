/* The command balance: where the planes between the ranks' bricks are. */
#include <string.h>

#include "base/memory.h"
#include "base/timer.h"
#include "comm/balance.h"
#include "deck/command.h"
#include "deck/place_atoms.h"
#include "style/balance_weight.h"

/** One balance command. */
typedef struct request {
    double threshold;
    hs_balance plan;    /**< n_axes = 0: no shift */
    int at[3];          /**< first word after x, y, z; 0: not given */
    int n_fractions[3]; /**< numbers there; 0: uniform */
    hs_balance_weight weight;
} request;

static bool is_keyword(const char *word)
{
    static const char *const words[] = {"x", "y", "z", "shift", "rcb", "weight", "out"};
    for (size_t k = 0; k < sizeof words / sizeof words[0]; ++k)
        if (strcmp(words[k], word) == 0) return true;
    return false;
}

/** x, y or z at word *i: uniform, or fractions up to the next keyword. */
static hs_status read_planes(const hs_args *args, int *i, request *r, hs_error *err)
{
    const int axis = args->word[*i][0] - 'x', first = *i + 1;
    int end = first;
    while (end < args->n && !is_keyword(args->word[end])) ++end;
    HS_TRY(hs_arg_need(args, first, "uniform, or fractions of the box", err));
    if (r->at[axis] > 0)
        return hs_fail(err, HS_ERROR_INPUT, "balance: the planes along %c are given twice", "xyz"[axis]);
    r->at[axis] = first;
    r->n_fractions[axis] = end - first;
    *i = end - 1;
    if (strcmp(args->word[first], "uniform") != 0) return HS_OK;
    r->n_fractions[axis] = 0;
    if (end > first + 1) return hs_arg_refuse(args, first + 1, "a keyword after uniform", NULL, err);
    return HS_OK;
}

static hs_status read_shift(const hs_args *args, int *i, int dimension, request *r, hs_error *err)
{
    int64_t n;
    HS_TRY(hs_arg_need(args, *i + 3, "shift: the axes, the iterations and the stop factor", err));
    HS_TRY(hs_balance_read_axes(&r->plan, args->word[*i + 1], dimension, "balance", err));
    HS_TRY(hs_arg_int(args, *i + 2, 1, 1000, &n, err));
    r->plan.n_iterations = (int)n;
    HS_TRY(hs_arg_double(args, *i + 3, &r->plan.stop_factor, err));
    if (r->plan.stop_factor < 1.0) return hs_arg_refuse(args, *i + 3, "a factor of 1 or more", NULL, err);
    *i += 3;
    return HS_OK;
}

/** The words. The request is to be freed with hs_balance_weight_fini(&r->weight), after an error, too. */
static hs_status read_request(const hs_args *args, int dimension, request *r, hs_error *err)
{
    static const char *const words[] = {"x", "y", "z", "shift", "rcb", "weight", NULL};
    *r = (request){.threshold = 1.0};
    HS_TRY(hs_arg_double(args, 0, &r->threshold, err));
    for (int i = 1; i < args->n; ++i) {
        int which;
        if (strcmp(args->word[i], "out") == 0)
            return hs_fail(
                err, HS_ERROR_INPUT,
                "balance: 'out' is not supported; dump custom with the attribute proc shows who owns which atoms");
        HS_TRY(hs_arg_choice(args, i, words, &which, err));
        if (which < 3) HS_TRY(read_planes(args, &i, r, err));
        if (which == 3) HS_TRY(read_shift(args, &i, dimension, r, err));
        if (which == 4) hs_balance_take_rcb(&r->plan, dimension);
        if (which != 5) continue;
        ++i;
        HS_TRY(hs_balance_weight_read(&r->weight, args, &i, err));
    }
    const bool has_planes = r->at[0] + r->at[1] + r->at[2] > 0;
    if (has_planes != (r->plan.n_axes > 0)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "balance: %s; either planes (x, y, z) or shift says where they go",
                   has_planes ? "planes and shift are both given" : "neither planes nor shift are given");
}

static hs_status check_balance(const hs_args *args, bool has_variables, hs_error *err)
{
    request r = {0};
    if (has_variables) return HS_OK;
    const hs_status status = read_request(args, 3, &r, err);
    hs_balance_weight_fini(&r.weight);
    return status;
}

/** Planes given in the deck. */
static hs_status set_planes(hs_domain *domain, const hs_args *args, const request *r, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        const int n = domain->n[axis];
        if (r->at[axis] == 0) continue;
        if (r->n_fractions[axis] > 0 && r->n_fractions[axis] != n - 1)
            return hs_fail(err, HS_ERROR_INPUT,
                           "balance: %c is cut into %d brick%s, so %d fraction%s must be given, not %d", "xyz"[axis], n,
                           n == 1 ? "" : "s", n - 1, n == 2 ? "" : "s", r->n_fractions[axis]);
        double before = 0.0;
        for (int k = 1; k < n; ++k) {
            double cut = (double)k / n;
            if (r->n_fractions[axis] > 0) HS_TRY(hs_arg_double(args, r->at[axis] + k - 1, &cut, err));
            if (!(cut > before && cut < 1.0))
                return hs_arg_refuse(args, r->at[axis] + k - 1, "fractions that ascend from above 0 to below 1", NULL,
                                     err);
            domain->cut[axis][k] = before = cut;
        }
    }
    return HS_OK;
}

static void tell_planes(const hs_sim *sim)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_say(sim->env.out, "  %c cuts:", "xyz"[axis]);
        for (int k = 0; k <= sim->domain.n[axis]; ++k) hs_say(sim->env.out, " %g", sim->domain.cut[axis][k]);
        hs_say(sim->env.out, "\n");
    }
}

/** Place the planes, and tell what came of it. */
static hs_status place(hs_sim *sim, const hs_args *args, request *r, const double *costs, hs_error *err)
{
    hs_sink *const out = sim->env.out;
    const hs_balance_work work = {&sim->parallel, &sim->box, &sim->atoms, costs};
    const double start_s = hs_time_now_s();
    double load, largest[2], factor[2];
    int n_iterations = 0;
    HS_TRY(hs_balance_predict(&sim->domain, &work, &load, err));
    hs_balance_measure(&sim->parallel, load, &largest[0], &factor[0]);
    hs_say(out, "Balancing ...\n");
    if (r->plan.n_axes == 0) {
        HS_TRY(set_planes(&sim->domain, args, r, err));
    } else if (factor[0] > r->threshold) {
        r->plan.least_width = 0.5 * sim->env.reach;
        HS_TRY(hs_balance_shift(&r->plan, &sim->domain, &work, &n_iterations, err));
    }
    HS_TRY(hs_balance_predict(&sim->domain, &work, &load, err));
    hs_balance_measure(&sim->parallel, load, &largest[1], &factor[1]);
    hs_sim_atoms_changed(sim); /* the next run brings them to their ranks */
    hs_say(out,
           "  rebalancing time: %.3f seconds\n  iteration count = %d\n  initial/final maximal load/proc = %.8g %.8g\n"
           "  initial/final imbalance factor  = %.8g %.8g\n",
           hs_time_now_s() - start_s, n_iterations, largest[0], largest[1], factor[0], factor[1]);
    tell_planes(sim);
    return HS_OK;
}

static hs_status run_balance(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    request r = {0};
    double *costs = NULL;
    HS_TRY(hs_sim_need_box(sim, "balance", err));
    hs_status status = read_request(args, sim->box.dimension, &r, err);
    if (status == HS_OK && sim->atoms.n_all == 0)
        status = hs_fail(err, HS_ERROR_INPUT, "balance: there are no atoms yet");
    if (status == HS_OK) status = hs_atoms_bring_back(sim, "balance", err);
    if (status == HS_OK)
        status =
            hs_balance_weight_eval(&r.weight, &sim->env, sim->timer.phase_s[HS_PHASE_PAIR], "balance", &costs, err);
    if (status == HS_OK) status = place(sim, args, &r, costs, err);
    HS_FREE(costs);
    hs_balance_weight_fini(&r.weight);
    return status;
}

const hs_command hs_commands_balance[] = {
    {.about = {.name = "balance",
               .syntax = {.usage = "<threshold> x|y|z uniform|<fractions> ... | shift <axes> <iterations> <stop "
                                   "factor> | rcb " HS_BALANCE_WEIGHTS,
                          .n_min = 1,
                          .n_max = -1},
               .summary = "place the planes between the ranks' parts of the box",
               .details =
                   "`x`, `y`, `z` put the planes that cut the box at equal distances (`uniform`) or at the fractions "
                   "given, one fewer than there are bricks along the axis. `shift` moves them along the axes named "
                   "(`x`, `xy`, `zyx`, ...) until the slabs between them hold equal loads, if the largest load of a "
                   "rank exceeds the mean by more than the threshold (1.1: ten per cent); each iteration finds the "
                   "places 16 times more exactly, and an axis is done when its slabs are within the stop factor. "
                   "`rcb`, which in LAMMPS cuts the box into parts that are not in rows, moves the planes along all "
                   "axes here. The load of a rank is the sum of its atoms' costs.\n\n" HS_BALANCE_WEIGHT_DETAILS
                   " (In the last run.)\n\n`fix balance` does the same during a run. Results do not depend on where "
                   "the planes are. `out` is refused.",
               .example = "balance 1.1 shift xy 10 1.02\nbalance 1.0 x uniform z 0.4 0.5 0.6"},
     .run = run_balance,
     .check = check_balance},
    {.run = NULL},
};
