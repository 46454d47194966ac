#include "sim/minimize.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sim/minimizer.h"
#include "sim/report.h"
#include "sim/saving.h"
#include "sim/thermo_internal.h"
#include "style/atom_sum.h"

const hs_min_style *const hs_min_styles[] = {&hs_min_style_cg,       &hs_min_style_sd,       &hs_min_style_fire,
                                             &hs_min_style_fire_old, &hs_min_style_quickmin, NULL};

static const char *const reasons[HS_N_MIN_REASONS] = {
    [HS_MIN_MAX_ITERATIONS] = "max iterations",
    [HS_MIN_MAX_EVALUATIONS] = "max force evaluations",
    [HS_MIN_ENERGY] = "energy tolerance",
    [HS_MIN_FORCE] = "force tolerance",
    [HS_MIN_UPHILL] = "search direction is not downhill",
    [HS_MIN_HALTED] = "walltime limit reached", /* LAMMPS's words for fix halt, too */
    [HS_MIN_ALPHA] = "linesearch alpha is zero",
    [HS_MIN_FLAT] = "quadratic factors are zero",
    [HS_MIN_NO_FORCES] = "forces are zero",
    [HS_MIN_NEGATIVE_POWER] = "max iterations with v.f negative",
};

void hs_min_settings_init(hs_min_settings *settings)
{
    *settings = (hs_min_settings){.style = &hs_min_style_cg,
                                  .dmax = 0.1,
                                  .line = HS_LINE_QUADRATIC,
                                  .norm = HS_NORM_TWO,
                                  .integrator = HS_FIRE_EULER_IMPLICIT,
                                  .tmax = 10.0,
                                  .tmin = 0.02,
                                  .delaystep = 20,
                                  .dtgrow = 1.1,
                                  .dtshrink = 0.5,
                                  .alpha0 = 0.25,
                                  .alphashrink = 0.99,
                                  .vdfmax = 2000,
                                  .halfstepback = true,
                                  .initialdelay = true};
}

/* ---- Sums over atoms ---- */

enum { FORCE_FORCE, FORCE_BEFORE, FORCE_DIRECTION, N_SUMS };

/** sum += a[begin] b[begin] + ... + a[end - 1] b[end - 1]. */
static void add_dot(const double *a, const double *b, int begin, int end, hs_exact_sum *sum)
{
    double term[HS_EXACT_ARRAY_MAX];
    for (int i = begin; i < end; ++i) term[i - begin] = a[i] * b[i];
    hs_exact_add_array(sum, term, end - begin);
}

static void add_products(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_minimizer *min = context;
    for (int axis = 0; axis < 3; ++axis) {
        const double *f = atoms->f[axis];
        add_dot(f, f, begin, end, &sums[FORCE_FORCE]);
        if (min->direction[axis] == NULL) continue;
        add_dot(f, min->before[axis], begin, end, &sums[FORCE_BEFORE]);
        add_dot(f, min->direction[axis], begin, end, &sums[FORCE_DIRECTION]);
    }
}

void hs_min_add_up(const hs_minimizer *min, hs_min_sums *sums)
{
    double value[N_SUMS];
    hs_atom_sum(&min->sim->atoms, &min->sim->parallel, add_products, min, N_SUMS, value);
    *sums = (hs_min_sums){value[FORCE_FORCE], value[FORCE_BEFORE], value[FORCE_DIRECTION]};
    hs_min_add_box_products(min, sums);
}

/** *largest becomes the largest of what the threads have found. */
static void keep_largest(double found, double *largest)
{
#pragma omp critical(hs_min_largest)
    if (found > *largest) *largest = found;
}

static void find_largest(int n, double *const vector[3], double *largest)
{
    double found = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
#pragma omp for schedule(static) nowait
        for (int i = 0; i < n; ++i) found = fabs(vector[axis][i]) > found ? fabs(vector[axis][i]) : found;
    }
    keep_largest(found, largest);
}

double hs_min_largest(const hs_minimizer *min, double *const vector[3])
{
    double largest = 0.0;
    HS_ON_THREADS(find_largest(min->sim->atoms.n_local, vector, &largest));
    hs_parallel_max_double(&min->sim->parallel, &largest, 1);
    return largest;
}

static void find_largest_square(const hs_atoms *atoms, double *largest)
{
    double found = 0.0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        const double x = atoms->f[0][i], y = atoms->f[1][i], z = atoms->f[2][i], square = x * x + y * y + z * z;
        found = square > found ? square : found;
    }
    keep_largest(found, largest);
}

/** The length of all forces by a norm (collective). */
static double force_norm(const hs_minimizer *min, hs_force_norm norm)
{
    const hs_atoms *atoms = &min->sim->atoms;
    const double largest_of_box = hs_min_largest_of_box(min, min->box.force);
    if (norm == HS_NORM_INF) return fmax(hs_min_largest(min, atoms->f), largest_of_box);
    if (norm == HS_NORM_TWO) {
        hs_min_sums sums;
        hs_min_add_up(min, &sums);
        return sqrt(sums.force_force);
    }
    double largest2 = 0.0;
    HS_ON_THREADS(find_largest_square(atoms, &largest2));
    hs_parallel_max_double(&min->sim->parallel, &largest2, 1);
    return fmax(sqrt(largest2), largest_of_box);
}

/* ---- Iterations ---- */

double hs_min_energy(const hs_minimizer *min)
{
    const hs_env *env = &min->sim->env;
    return env->pair_energy + env->tail_energy + env->fix_energy + min->box.energy;
}

hs_status hs_min_evaluate(hs_minimizer *min, hs_error *err)
{
    HS_TRY(hs_sim_move_forces(min->sim, err));
    HS_TRY(hs_min_measure_box(min, err));
    min->energy = hs_min_energy(min);
    ++min->n_evaluations;
    --*min->plan->evaluations_left;
    return HS_OK;
}

hs_min_reason hs_min_check(const hs_minimizer *min, bool with_energy)
{
    const double tiny = 1e-8 / min->energy_scale; /* energies of about zero have no meaningful relative change */
    const double size = 0.5 * (fabs(min->energy) + fabs(min->energy_before) + tiny);
    if (*min->plan->evaluations_left <= 0) return HS_MIN_MAX_EVALUATIONS;
    if (with_energy && fabs(min->energy - min->energy_before) < min->plan->energy_tolerance * size)
        return HS_MIN_ENERGY;
    if (min->plan->force_tolerance > 0.0 && force_norm(min, min->settings->norm) < min->plan->force_tolerance)
        return HS_MIN_FORCE;
    return HS_MIN_GOES_ON;
}

static void forget_vectors(hs_minimizer *min)
{
    hs_min_remove_box(min);
    for (int axis = 0; axis < 3; ++axis) {
        hs_atoms_remove_field(&min->sim->atoms, (void **)&min->direction[axis]);
        hs_atoms_remove_field(&min->sim->atoms, (void **)&min->before[axis]);
    }
}

/** Begin, or begin again, from the present forces. */
static hs_status begin(hs_minimizer *min, hs_error *err)
{
    static const char *const names[2][3] = {{"minimize direction x", "minimize direction y", "minimize direction z"},
                                            {"minimize before x", "minimize before y", "minimize before z"}};
    hs_atoms *atoms = &min->sim->atoms;
    for (int axis = 0; axis < 3 && min->settings->style->has_direction; ++axis) {
        HS_TRY(hs_atoms_add_field(atoms, names[0][axis], (void **)&min->direction[axis], sizeof(double), false, err));
        HS_TRY(hs_atoms_add_field(atoms, names[1][axis], (void **)&min->before[axis], sizeof(double), false, err));
    }
    HS_TRY(hs_min_add_box(min, err));
    min->settings->style->begin(min);
    return HS_OK;
}

/** Checkpoints hold no directions: whenever one is written the search begins again from the forces, so that one that is resumed is the
 *  same, bit by bit, as the one that went on. */
static hs_status save_if_due(hs_minimizer *min, hs_error *err)
{
    hs_sim *sim = min->sim;
    const bool is_stopping = sim->parallel.n_ranks > 1 ? sim->is_stopping : hs_sim_is_asked_to_stop(sim);
    if (!is_stopping && !hs_sim_is_save_due(sim)) return HS_OK;
    forget_vectors(min);
    HS_TRY(hs_sim_save_if_due(sim, err));
    if (is_stopping) {
        char where[64];
        snprintf(where, sizeof where, "after step %lld, within minimize", (long long)sim->env.step);
        return hs_sim_stop(sim, where, err);
    }
    return begin(min, err);
}

/** Fixes may end the minimisation after this iteration: last_step is the present one then. */
static hs_status end_iteration(const hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    hs_sim *sim = min->sim;
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->end_of_iteration != NULL)
            HS_TRY(sim->fix[k]->style->end_of_iteration(sim->fix[k], err));
    const bool is_halted = sim->env.last_step == sim->env.step && *min->plan->iterations_left > 0;
    if (*reason == HS_MIN_GOES_ON && is_halted) *reason = HS_MIN_HALTED;
    return HS_OK;
}

static hs_status iterate(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    hs_sim *sim = min->sim;
    *reason = HS_MIN_GOES_ON;
    while (*reason == HS_MIN_GOES_ON) {
        if (*min->plan->iterations_left <= 0) {
            *reason = HS_MIN_MAX_ITERATIONS;
            return HS_OK;
        }
        ++sim->env.step;
        ++min->n_iterations;
        --*min->plan->iterations_left;
        min->energy_before = min->energy;
        HS_TRY(min->settings->style->iterate(min, reason, err));
        hs_env_changed(&sim->env);
        sim->env.energy_step = sim->env.step; /* the latest evaluation was of these places */
        HS_TRY(end_iteration(min, reason, err));
        const bool is_last = *reason != HS_MIN_GOES_ON || *min->plan->iterations_left <= 0;
        if (is_last) sim->env.last_step = sim->env.step;
        sim->env.is_cut_short = false; /* the last iteration always has a row */
        if (*reason != HS_MIN_GOES_ON) hs_thermo_want_row(sim->thermo);
        HS_TRY(hs_sim_output_if_due(sim, is_last, err));
        if (*reason != HS_MIN_GOES_ON) HS_TRY(hs_sim_write_all_dumps(sim, err)); /* the minimum, whatever its step */
        hs_report_progress(sim);
        if (!is_last) HS_TRY(save_if_due(min, err));
    }
    return HS_OK;
}

/** What a minimisation began with. */
typedef struct beginning {
    double energy, norm, largest;
} beginning;

static void describe(const hs_minimizer *min, const beginning *start, hs_min_reason reason, char *text, size_t size)
{
    const double scale = min->energy_scale;
    const bool has_direction = min->settings->style->has_direction;
    const double norm = force_norm(min, HS_NORM_TWO), largest = force_norm(min, HS_NORM_INF);
    snprintf(text, size,
             "\nMinimization stats:\n  Stopping criterion = %s\n"
             "  Energy initial, next-to-last, final = \n    %18.15g %18.15g %18.15g\n"
             "  Force two-norm initial, final = %#.8g %#.8g\n"
             "  Force max component initial, final = %#.8g %#.8g\n"
             "  Final line search alpha, max atom move = %#.8g %#.8g\n"
             "  Iterations, force evaluations = %lld %lld\n",
             reasons[reason], scale * start->energy, scale * min->energy_before, scale * min->energy, start->norm, norm,
             start->largest, largest, has_direction ? min->alpha_tried : 0.0,
             has_direction ? min->alpha_tried * largest : 0.0, (long long)min->n_iterations,
             (long long)min->n_evaluations);
}

static hs_status set_up(const hs_minimizer *min, hs_error *err)
{
    hs_sim *sim = min->sim;
    hs_fix *relaxes = min->box.fix;
    if (min->plan->is_resumed) { /* all is as it was at this step, and its output is written */
        hs_thermo_header(sim->thermo);
        hs_timer_reset(&sim->timer);
        return HS_OK;
    }
    sim->env.first_step = sim->env.ramp_start = sim->env.step;
    sim->env.last_step = sim->env.ramp_stop = sim->env.step + *min->plan->iterations_left;
    for (int axis = 0; axis < 3 && sim->minimize.style->is_from_rest; ++axis)
        memset(sim->atoms.v[axis], 0, (size_t)sim->atoms.n_local * sizeof(double));
    HS_TRY(hs_sim_setup(sim, err));
    if (relaxes != NULL) relaxes->style->box_freedom->begin(relaxes);
    sim->tuner.is_trying = false;
    hs_say(sim->env.out, "Setting up %s style minimization ...\n  Unit style    : %s\n  Current step  : %lld\n",
           min->settings->style->name, sim->env.units->name, (long long)sim->env.step);
    hs_report_setup(sim);
    return hs_sim_begin_output(sim, err);
}

static hs_status minimize(hs_sim *sim, hs_min_plan *plan, hs_error *err)
{
    const hs_min_settings *settings = &sim->minimize;
    hs_minimizer min = {.sim = sim, .settings = settings, .plan = plan};
    HS_TRY(hs_min_find_box(sim, &min.box.fix, err));
    HS_TRY(set_up(&min, err));
    HS_TRY(hs_min_measure_box(&min, err));
    const double start_s = hs_time_now_s(), start_cpu_s = hs_time_cpu_s();
    hs_min_reason reason;
    min.energy_scale = sim->thermo->is_norm ? 1.0 / fmax((double)sim->atoms.n_all, 1.0) : 1.0;
    min.energy = min.energy_before = hs_min_energy(&min);
    const beginning start = {min.energy, force_norm(&min, HS_NORM_TWO), force_norm(&min, HS_NORM_INF)};
    hs_status status = begin(&min, err);
    if (status == HS_OK) status = iterate(&min, &reason, err);
    hs_progress_wipe(sim->env.out);
    forget_vectors(&min);
    HS_TRY(status);
    char text[1024];
    describe(&min, &start, reason, text, sizeof text);
    hs_report_finish(sim, min.n_iterations, hs_time_now_s() - start_s, hs_time_cpu_s() - start_cpu_s, text);
    return HS_OK;
}

hs_status hs_sim_check_minimize(hs_sim *sim, hs_error *err)
{
    hs_fix *relaxes;
    return hs_min_find_box(sim, &relaxes, err);
}

hs_status hs_sim_minimize(hs_sim *sim, hs_min_plan *plan, hs_error *err)
{
    hs_neighbor_settings *settings = &sim->neighbor.settings;
    const hs_neighbor_settings before = *settings;
    if (sim->env.is_halted && !plan->is_resumed) {
        hs_say(sim->env.out, "Skipped: a fix halt has ended the runs of this deck\n");
        return HS_OK;
    }
    /* line searches compare energies of the same pairs: lists must never be late */
    if (settings->every != 1 || settings->delay != 0 || !settings->check || settings->once)
        hs_warn(sim->env.out, "minimize makes lists as 'neigh_modify every 1 delay 0 check yes' says");
    settings->every = 1;
    settings->delay = 0;
    settings->check = true;
    settings->once = false;
    hs_env *env = &sim->env;
    if (!plan->is_resumed) { /* iterations count as timesteps among themselves, as in LAMMPS */
        env->time_origin += (double)(env->step - env->time_origin_step) * env->dt;
        env->time_origin_step = env->step - sim->n_minimized;
    }
    sim->is_minimizing = true;
    const hs_status status = minimize(sim, plan, err);
    sim->is_minimizing = false;
    sim->n_minimized = env->step - env->time_origin_step;
    env->time_origin_step = env->step; /* the run that follows goes on at the time of the last one */
    settings->every = before.every;
    settings->delay = before.delay;
    settings->check = before.check;
    settings->once = before.once;
    sim->is_initialized =
        false; /* a run without set-up would go on with another schedule, and without the other fixes' forces */
    return status;
}
