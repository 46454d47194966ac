/* Commands of energy minimisation: minimize, min_style, min_modify. */
#include <string.h>

#include "deck/command.h"
#include "deck/frames.h"
#include "sim/minimize.h"

/* ---- minimize ---- */

static const int64_t count_max = INT64_C(1) << 60;

/** Tolerances into the plan, numbers of iterations and evaluations into counts[2]. */
static hs_status read_minimize(const hs_args *args, hs_min_plan *plan, int64_t counts[2], hs_error *err)
{
    HS_TRY(hs_arg_not_negative(args, 0, &plan->energy_tolerance, err));
    HS_TRY(hs_arg_not_negative(args, 1, &plan->force_tolerance, err));
    HS_TRY(hs_arg_int(args, 2, 0, count_max, &counts[0], err));
    return hs_arg_int(args, 3, 0, count_max, &counts[1], err);
}

static hs_status check_minimize(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_min_plan plan;
    int64_t counts[2];
    return has_variables ? HS_OK : read_minimize(args, &plan, counts, err);
}

/** halfshell check: set-up only. */
static hs_status pretend(hs_deck *deck, const hs_frame *frame, hs_error *err)
{
    hs_sim *sim = deck->sim;
    HS_TRY(hs_sim_check_minimize(sim, err));
    HS_TRY(hs_sim_setup(sim, err));
    hs_say(deck->out, "Minimization (%s) of at most %lld iterations with %lld atoms\n", sim->minimize.style->name,
           (long long)frame->left, (long long)sim->atoms.n_all);
    return HS_OK;
}

hs_status hs_frame_run_minimize(hs_deck *deck, hs_frame *frame, bool is_within, hs_error *err)
{
    hs_min_plan plan = {.is_resumed = is_within};
    int64_t counts[2];
    HS_TRY(read_minimize(&frame->words, &plan, counts, err));
    if (frame->left < 0 || frame->part < 0)
        return hs_fail(err, HS_ERROR_INPUT, "minimize: the place within it is none");
    plan.iterations_left = &frame->left;
    plan.evaluations_left = &frame->part;
    if (deck->options.dry_run) return pretend(deck, frame, err);
    hs_frame_push(deck, frame);
    deck->is_running = true;
    const hs_status status = hs_sim_minimize(deck->sim, &plan, err);
    deck->is_running = false;
    hs_frame_pop(deck);
    return status;
}

static hs_status run_minimize(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_min_plan plan;
    int64_t counts[2];
    HS_TRY(read_minimize(args, &plan, counts, err));
    HS_TRY(hs_sim_need_box(deck->sim, "minimize", err));
    if (counts[0] > count_max - deck->sim->env.step)
        return hs_fail(err, HS_ERROR_INPUT, "minimize: %lld iterations from step %lld would go beyond step %lld",
                       (long long)counts[0], (long long)deck->sim->env.step, (long long)count_max);
    hs_frame frame = {.kind = HS_FRAME_MINIMIZE, .words = *args, .left = counts[0], .part = counts[1]};
    return hs_frame_run_minimize(deck, &frame, false, err);
}

/* ---- min_style ---- */

static hs_status find_style(const hs_args *args, const hs_min_style **style, hs_error *err)
{
    const char *names[8] = {NULL};
    int which;
    for (int k = 0; hs_min_styles[k] != NULL; ++k) names[k] = hs_min_styles[k]->name;
    HS_TRY(hs_arg_choice(args, 0, names, &which, err));
    *style = hs_min_styles[which];
    return HS_OK;
}

static hs_status check_style(const hs_args *args, bool has_variables, hs_error *err)
{
    const hs_min_style *style;
    return has_variables ? HS_OK : find_style(args, &style, err);
}

static hs_status run_style(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const hs_min_style *style;
    HS_TRY(find_style(args, &style, err));
    hs_min_settings_init(&deck->sim->minimize);
    deck->sim->minimize.style = style;
    return HS_OK;
}

/* ---- min_modify ---- */

static const hs_keyword modify_keywords[] = {
    {"dmax", 1, "<distance>", "farthest that an atom may move along an axis in one iteration (default: 0.1)"},
    {"line", 1, "backtrack|quadratic",
     "line search of cg and sd: halving until the energy falls enough; `quadratic` (default) also tries the minimum of "
     "a parabola through the last two places"},
    {"norm", 1, "two|inf|max",
     "what the force tolerance is compared with: the length of the vector of all forces (`two`, default), the largest "
     "component (`inf`), or the largest force on an atom (`max`)"},
    {"integrator", 1, "eulerimplicit|verlet|leapfrog|eulerexplicit", "of fire (default: eulerimplicit)"},
    {"tmax", 1, "<factor>", "fire: largest timestep, in units of `timestep` (default: 10)"},
    {"tmin", 1, "<factor>", "fire: smallest timestep, in the same units, 0 for none (default: 0.02)"},
    {"delaystep", 1, "<steps>", "fire: steps downhill before the timestep grows (default: 20)"},
    {"dtgrow", 1, "<factor>", "fire: growth of the timestep, above 1 (default: 1.1)"},
    {"dtshrink", 1, "<factor>", "fire: its shrinking when atoms go uphill, below 1 (default: 0.5)"},
    {"alpha0", 1, "<number>", "fire: part of the velocity that is turned to the forces, 0 to 1 (default: 0.25)"},
    {"alphashrink", 1, "<factor>", "fire: its shrinking when the timestep grows, up to 1 (default: 0.99)"},
    {"vdfmax", 1, "<steps>", "fire: steps uphill in a row after which it gives up (default: 2000)"},
    {"halfstepback", 1, "yes|no", "fire: go half a step back when atoms go uphill (default: yes)"},
    {"initialdelay", 1, "yes|no", "fire: no shrinking in the first `delaystep` steps (default: yes)"},
    {0},
};

/** Fail unless low < value < high, or value = high where that is allowed. */
static hs_status number_between(const hs_args *args, int i, double low, double high, bool with_high,
                                const char *expected, double *value, hs_error *err)
{
    HS_TRY(hs_arg_double(args, i, value, err));
    if (*value > low && (*value < high || (with_high && *value == high))) return HS_OK;
    return hs_arg_refuse(args, i, expected, NULL, err);
}

static hs_status read_choice(const hs_args *args, int i, hs_min_settings *settings, hs_error *err)
{
    static const char *const lines[] = {"backtrack", "quadratic", NULL};
    static const char *const norms[] = {"two", "max", "inf", NULL};
    static const char *const integrators[] = {"eulerimplicit", "verlet", "leapfrog", "eulerexplicit", NULL};
    const char *keyword = args->word[i];
    int choice;
    if (strcmp(keyword, "line") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, lines, &choice, err));
        settings->line = (hs_line_search)choice;
    } else if (strcmp(keyword, "norm") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, norms, &choice, err));
        settings->norm = (hs_force_norm)choice;
    } else if (strcmp(keyword, "integrator") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, integrators, &choice, err));
        settings->integrator = (hs_fire_integrator)choice;
    } else if (strcmp(keyword, "halfstepback") == 0) {
        return hs_arg_bool(args, i + 1, &settings->halfstepback, err);
    } else {
        return hs_arg_bool(args, i + 1, &settings->initialdelay, err);
    }
    return HS_OK;
}

static hs_status read_modify(const hs_args *args, hs_min_settings *settings, hs_error *err)
{
    const struct {
        const char *name;
        double *value, low, high;
        bool with_high;
        const char *expected;
    } numbers[] = {
        {"dmax", &settings->dmax, 0.0, 1e300, false, "a distance greater than 0"},
        {"tmax", &settings->tmax, 0.0, 1e300, false, "a factor greater than 0"},
        {"tmin", &settings->tmin, -5e-324, 1e300, false, "a factor that is not negative"},
        {"dtgrow", &settings->dtgrow, 1.0, 1e300, false, "a factor greater than 1"},
        {"dtshrink", &settings->dtshrink, 0.0, 1.0, false, "a factor between 0 and 1"},
        {"alpha0", &settings->alpha0, 0.0, 1.0, true, "a number between 0 and 1"},
        {"alphashrink", &settings->alphashrink, 0.0, 1.0, true, "a factor between 0 and 1"},
    };
    for (int i = 0; i + 1 < args->n; i += 2) {
        const char *keyword = args->word[i];
        size_t k = 0;
        while (k < sizeof numbers / sizeof numbers[0] && strcmp(numbers[k].name, keyword) != 0) ++k;
        if (k < sizeof numbers / sizeof numbers[0])
            HS_TRY(number_between(args, i + 1, numbers[k].low, numbers[k].high, numbers[k].with_high,
                                  numbers[k].expected, numbers[k].value, err));
        else if (strcmp(keyword, "delaystep") == 0)
            HS_TRY(hs_arg_int(args, i + 1, 0, count_max, &settings->delaystep, err));
        else if (strcmp(keyword, "vdfmax") == 0)
            HS_TRY(hs_arg_int(args, i + 1, 1, count_max, &settings->vdfmax, err));
        else
            HS_TRY(read_choice(args, i, settings, err));
    }
    if (settings->tmin > settings->tmax)
        return hs_fail(err, HS_ERROR_INPUT, "min_modify: tmin (%g) must not be larger than tmax (%g)", settings->tmin,
                       settings->tmax);
    return HS_OK;
}

static hs_status check_modify(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_min_settings settings;
    hs_min_settings_init(&settings);
    if (has_variables) return HS_OK;
    settings.tmax = 1e300; /* an earlier command may have set it */
    return read_modify(args, &settings, err);
}

static hs_status run_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_min_settings settings = deck->sim->minimize;
    HS_TRY(read_modify(args, &settings, err));
    deck->sim->minimize = settings;
    return HS_OK;
}

const hs_command hs_commands_minimize[] = {
    {
        .about =
            {
                .name = "minimize",
                .syntax = {"<energy tolerance> <force tolerance> <iterations> <evaluations>", 4, 4, NULL},
                .summary = "Move atoms to a minimum of the energy",
                .details = "Ends as soon as the energy changes in one iteration by less than the energy tolerance "
                           "times its size, the length of the force vector (`min_modify norm`; force units) is below "
                           "the force tolerance, or so many iterations or evaluations of the forces were made. A "
                           "tolerance of 0 never ends it. The log tells which it was, with energies and forces. "
                           "Iterations count as steps, for thermo output and dumps too.\n\n"
                           "Lists of neighbors are made as `neigh_modify every 1 delay 0 check yes` says. Of the "
                           "fixes, those act that give or constrain forces: walls, spring/self, addforce, setforce, "
                           "aveforce, enforce2d; their energy counts where `fix_modify energy yes` was said, and "
                           "should where they have one. With fix box/relax the box changes, too. Nothing is integrated "
                           "in time, and there is no noise, friction or propulsion. A potential that jumps at its "
                           "cutoff ends line searches early: `pair_modify shift yes` helps.\n\n"
                           "The styles are chosen by `min_style`. Sums over atoms are exact: reproducible runs reach "
                           "the same bits on any number of threads and ranks. Velocities stay as they are, except with "
                           "style fire, which begins with all atoms at rest and leaves its own. A minimisation that a "
                           "checkpoint interrupts goes on with new search directions, as does the one that wrote it.\n",
                .example = "minimize 1.0e-6 1.0e-4 1000 10000",
            },
        .run = run_minimize,
        .check = check_minimize,
    },
    {
        .about =
            {
                .name = "min_style",
                .syntax = {"cg|sd|fire|fire/old|quickmin", 1, 1, NULL},
                .summary = "How minimize finds its way",
                .details = "`cg` (default): conjugate gradients in the form of Polak and Ribiere, with line searches. "
                           "`sd`: steepest descent, each line along the forces. `fire`: damped dynamics (FIRE 2.0), "
                           "with the masses and, at first, the timestep of the deck. Settings are those of "
                           "`min_modify` commands that follow: the defaults come back with every `min_style`. "
                           "`fire/old`: FIRE as first published, whose settings are fixed but for dmax: "
                           "explicit Euler steps, delaystep 5, tmax 10, tmin 0, no half step back. `quickmin`: steps "
                           "of the deck's timestep along the forces, from rest wherever the last one went too far.\n",
                .reference =
                    "J. Guenole et al., Comput. Mater. Sci. 175, 109584 (2020), doi:10.1016/j.commatsci.2020.109584",
                .example = "min_style fire",
            },
        .run = run_style,
        .check = check_style,
    },
    {
        .about =
            {
                .name = "min_modify",
                .syntax = {"keyword value ...", 0, 0, modify_keywords},
                .summary = "Settings of minimize",
                .details = "Settings stay until they are changed, or until the next `min_style`.\n",
                .example = "min_modify dmax 0.05 line backtrack\nmin_modify norm inf integrator verlet tmax 4",
            },
        .run = run_modify,
        .check = check_modify,
    },
    {.about = {.name = NULL}},
};
