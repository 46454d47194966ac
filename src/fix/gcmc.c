/* Grand canonical Monte Carlo of atoms: the number of atoms of a type follows a chemical potential.
 *
 * An insertion is accepted with the probability min(1, z V exp(-u/kT) / (N + 1)), a deletion with min(1, N exp(u/kT) / (z V)), a
 * move with min(1, exp(-(u' - u)/kT)); z = exp(mu/kT) / Lambda^3. Source: D. Frenkel, B. Smit, Understanding Molecular
 * Simulation, 2nd ed. (2002), section 5.6, ISBN 0-12-267351-4; G. E. Norman, V. S. Filinov, High Temp. (USSR) 7, 216 (1969). */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/local_energy.h"

/** What the numbers of an attempt are for: draws of its noise. Those of N_FIRST_MOVE on are displacements. */
enum { DRAW_KIND, DRAW_PLACE, DRAW_VELOCITY, DRAW_ATOM, DRAW_FIRST_MOVE };

/** Counts of attempts and successes, in the order of the vector. */
enum { MOVE, INSERTION, DELETION, N_KINDS };

typedef struct gcmc_state {
    int64_t every, n_exchanges, n_moves; /**< steps; mean numbers of attempts at each such step */
    int64_t type;
    double temperature, mu, displacement; /**< temperature, energy, distance */
    double pressure, fugacity_coefficient;
    bool has_pressure;
    double velocity_factor; /**< of the temperature of new atoms' velocities */
    int64_t n_least, n_most;
    uint32_t mask; /**< groups that new atoms join */
    hs_noise noise;
    int64_t first, next;
    int64_t n_attempts[N_KINDS], n_accepted[N_KINDS];

    /* while attempts are made */
    hs_local_energy local;
    double kt, z; /**< energy; activity, 1/volume */
    int64_t n;    /**< atoms that may go */
} gcmc_state;

/** An atom that was picked, the same on all ranks but for the local index. */
typedef struct picked_atom {
    int64_t id;
    double x[3];
    int i; /**< local index, -1: another rank's */
} picked_atom;

static const hs_keyword keywords[] = {
    {"pressure", 1, "<p>", "of an ideal gas reservoir, in place of mu"},
    {"fugacity_coeff", 1, "<phi>", "fugacity over that pressure (default 1)"},
    {"group", 1, "<group-ID>", "new atoms are in this group, too"},
    {"tfac_insert", 1, "<factor>", "velocities of new atoms are of T times this (default 1)"},
    {"max", 1, "<N>", "no insertions beyond so many atoms"},
    {"min", 1, "<N>", "no deletions below so many"},
    {"full_energy", 0, "", "accepted: energies are always whole"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    gcmc_state *state = fix->state;
    const char *word = args->word[i];
    int group;
    if (strcmp(word, "fugacity_coeff") == 0) return hs_arg_positive(args, i + 1, &state->fugacity_coefficient, err);
    if (strcmp(word, "tfac_insert") == 0) return hs_arg_not_negative(args, i + 1, &state->velocity_factor, err);
    if (strcmp(word, "max") == 0) return hs_arg_int(args, i + 1, 0, INT64_MAX, &state->n_most, err);
    if (strcmp(word, "min") == 0) return hs_arg_int(args, i + 1, 0, INT64_MAX, &state->n_least, err);
    if (strcmp(word, "pressure") == 0) {
        state->has_pressure = true;
        return hs_arg_positive(args, i + 1, &state->pressure, err);
    }
    HS_TRY(hs_groups_get(fix->env->groups, args->word[i + 1], &group, err));
    state->mask |= hs_group_mask(group);
    return HS_OK;
}

static hs_status check_system(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    if (fix->env->box->dimension == 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the chemical potential is that of three dimensions", args->command);
    if (fix->env->atoms->rmass == NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: atoms with masses of their own (atom_style sphere) are not supported",
                   args->command);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    gcmc_state *state = fix->state;
    int64_t seed;
    state->fugacity_coefficient = state->velocity_factor = 1.0;
    state->n_most = INT64_MAX;
    state->mask = fix->mask;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 1, 0, 1 << 20, &state->n_exchanges, err));
    HS_TRY(hs_arg_int(args, 2, 0, 1 << 20, &state->n_moves, err));
    HS_TRY(hs_arg_type(args, 3, fix->env->atoms->n_types, &state->type, err));
    HS_TRY(hs_arg_int(args, 4, 1, INT32_MAX, &seed, err));
    HS_TRY(hs_arg_positive(args, 5, &state->temperature, err));
    HS_TRY(hs_arg_double(args, 6, &state->mu, err));
    HS_TRY(hs_arg_not_negative(args, 7, &state->displacement, err));
    for (int i = 8; i < args->n; i += strcmp(args->word[i], "full_energy") == 0 ? 1 : 2)
        if (strcmp(args->word[i], "full_energy") != 0) HS_TRY(read_keyword(fix, args, i, err));
    if (state->n_exchanges + state->n_moves == 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: neither exchanges nor moves are asked for", args->command);
    HS_TRY(check_system(fix, args, err));
    state->first = state->next = fix->env->step + 1;
    return hs_fix_noise(fix, seed, &state->noise, err);
}

/** In lj units Lambda is 1, as in LAMMPS; in others h follows from k and the unit of time. */
static double find_activity(const hs_fix *fix)
{
    const gcmc_state *state = fix->state;
    const hs_units *units = fix->env->units;
    const double planck = 6.62606896e-34, boltzmann = 1.3806504e-23; /* J s, J/K */
    if (state->has_pressure) return state->pressure * state->fugacity_coefficient / (state->kt * units->nktv2p);
    double length = 1.0;
    if (units->ns > 0.0) {
        const double h = planck / boltzmann * units->boltz / (1e-9 * units->ns);
        length = h / sqrt(2.0 * M_PI * fix->env->atoms->mass[state->type] * units->mvv2e * state->kt);
    }
    return exp(state->mu / state->kt) / (length * length * length);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    gcmc_state *state = fix->state;
    (void)err;
    state->kt = fix->env->units->boltz * state->temperature;
    state->z = find_activity(fix);
    state->next = state->first + (fix->env->step - state->first + state->every) / state->every * state->every;
    return HS_OK;
}

static int64_t next_exchange(const hs_fix *fix) { return ((const gcmc_state *)fix->state)->next; }

/* Random numbers of an attempt */

/** Even in (0, 1). */
static double even(uint32_t word) { return ((double)word + 0.5) * 0x1p-32; }

static void words_of(const hs_fix *fix, int64_t attempt, int draw, uint32_t word[HS_NOISE_NUMBERS])
{
    hs_noise_words(((const gcmc_state *)fix->state)->noise, hs_fix_clock(fix), draw, attempt, word);
}

static bool is_gas(const hs_fix *fix, int i)
{
    const hs_atoms *atoms = fix->env->atoms;
    return (atoms->mask[i] & fix->mask) != 0 && atoms->type[i] == ((const gcmc_state *)fix->state)->type;
}

/** One of the atoms, all equally likely: that with the smallest draw of this attempt (collective). */
static picked_atom pick(const hs_fix *fix, int64_t attempt)
{
    const gcmc_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    picked_atom best = {.i = -1};
    int64_t draw = INT64_MIN, place[3] = {0, 0, 0};
    for (int i = 0; i < atoms->n_local; ++i) {
        uint32_t word[HS_NOISE_NUMBERS];
        if (!is_gas(fix, i)) continue;
        hs_noise_words(state->noise, hs_fix_clock(fix), DRAW_ATOM,
                       (int64_t)((uint64_t)atoms->id[i] + ((uint64_t)(attempt + 1) << 40)), word);
        const int64_t mine = -((int64_t)(word[0] >> 1) << 31 | word[1] >> 1);
        if (mine < draw || (mine == draw && atoms->id[i] > best.id)) continue;
        draw = mine;
        best = (picked_atom){.id = atoms->id[i], .i = i};
    }
    const int64_t mine = draw;
    hs_parallel_max_int64(fix->env->parallel, &draw, 1);
    int64_t id = best.i >= 0 && mine == draw ? -best.id : INT64_MIN;
    hs_parallel_max_int64(fix->env->parallel, &id, 1);
    if (best.i >= 0 && best.id != -id) best.i = -1;
    best.id = -id;
    for (int axis = 0; axis < 3 && best.i >= 0; ++axis) memcpy(&place[axis], &atoms->x[axis][best.i], sizeof place[0]);
    hs_parallel_sum_int64(fix->env->parallel, place, 3); /* the owner's bits and zeros */
    memcpy(best.x, place, sizeof best.x);
    return best;
}

/** Energies at n places (1 or 2) without the atom @p id; *overlaps: more at the second place than at the first, or at the only
 *  one than nowhere. */
static double measure(const hs_fix *fix, const double (*x)[3], int n, int64_t id, int *overlaps)
{
    gcmc_state *state = fix->state;
    const int type = (int)state->type;
    const int64_t left_out[2] = {id, 0};
    hs_exact_sum sums[2];
    int64_t n_overlaps[2] = {0, 0};
    double energy[2];
    for (int k = 0; k < n; ++k) {
        hs_exact_clear(&sums[k]);
        hs_local_energy_add(&state->local, x[k], 0, &type, 1, left_out, &sums[k], &n_overlaps[k]);
    }
    hs_local_energy_total(&state->local, sums, n, energy, n_overlaps);
    const int64_t more = n == 2 ? n_overlaps[1] - n_overlaps[0] : n_overlaps[0];
    *overlaps = (more > 0) - (more < 0);
    return n == 2 ? energy[1] - energy[0] : energy[0];
}

/** Atoms have changed: energies are asked for anew (collective). */
static hs_status begin_anew(hs_fix *fix, hs_error *err)
{
    gcmc_state *state = fix->state;
    hs_local_energy_end(&state->local);
    hs_env_changed(fix->env);
    return hs_local_energy_begin(&state->local, fix, 1e12 * state->kt, err);
}

/* Attempts */

static bool is_accepted(double log_probability, uint32_t word)
{
    return log_probability >= 0.0 || even(word) < exp(log_probability);
}

/** A place within the displacement of where the atom is. */
static void displace(const hs_fix *fix, int64_t attempt, double x[3])
{
    const gcmc_state *state = fix->state;
    for (int draw = DRAW_FIRST_MOVE; draw < HS_NOISE_DRAWS; ++draw) { /* the last is hardly ever reached: 0.48^252 */
        uint32_t word[HS_NOISE_NUMBERS];
        double d[3], r2 = 0.0;
        words_of(fix, attempt, draw, word);
        for (int axis = 0; axis < 3; ++axis) {
            d[axis] = 2.0 * even(word[axis]) - 1.0;
            r2 += d[axis] * d[axis];
        }
        if (r2 > 1.0) continue;
        for (int axis = 0; axis < 3; ++axis)
            x[axis] = hs_moved(x[axis], state->displacement * d[axis], fix->env->position_magic);
        return;
    }
}

static bool is_in_box(const hs_box *box, const double x[3])
{
    for (int axis = 0; axis < 3; ++axis) {
        const double at = hs_box_upright(box, x, axis);
        if (!box->periodic[axis] && (at < box->lo[axis] || at >= box->hi[axis])) return false;
    }
    return true;
}

static hs_status try_move(hs_fix *fix, int64_t attempt, uint32_t chance, bool *is_done, hs_error *err)
{
    gcmc_state *state = fix->state;
    double x[2][3];
    int overlaps;
    if (state->n == 0) return HS_OK;
    const picked_atom atom = pick(fix, attempt);
    memcpy(x[0], atom.x, sizeof x[0]);
    memcpy(x[1], atom.x, sizeof x[1]);
    displace(fix, attempt, x[1]);
    if (!is_in_box(fix->env->box, x[1])) return HS_OK;
    const double du = measure(fix, (const double(*)[3])x, 2, atom.id, &overlaps);
    if (overlaps > 0 || (overlaps == 0 && !is_accepted(-du / state->kt, chance))) return HS_OK;
    *is_done = true;
    for (int axis = 0; axis < 3 && atom.i >= 0; ++axis) fix->env->atoms->x[axis][atom.i] = x[1][axis];
    return begin_anew(fix, err);
}

/** A new atom on the first rank; the exchange that follows brings it home. */
static hs_status add_atom(hs_fix *fix, int64_t attempt, const double x[3], hs_error *err)
{
    const gcmc_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    double normal[HS_NOISE_NUMBERS];
    int64_t id = hs_atoms_max_id(atoms);
    hs_parallel_max_int64(fix->env->parallel, &id, 1);
    if (fix->env->parallel->rank == 0) HS_UNLESS_FAILED(err, hs_atoms_add(atoms, id + 1, (int)state->type, x, err));
    HS_TRY(hs_parallel_agree(fix->env->parallel, err));
    ++atoms->n_all;
    if (fix->env->parallel->rank != 0) return HS_OK;
    const double speed = sqrt(state->velocity_factor * state->kt / (atoms->mass[state->type] * fix->env->units->mvv2e));
    hs_noise_numbers(state->noise, HS_NOISE_GAUSSIAN, hs_fix_clock(fix), DRAW_VELOCITY, attempt, normal);
    const int i = atoms->n_local - 1;
    atoms->mask[i] |= state->mask;
    for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = speed * normal[axis];
    return HS_OK;
}

static hs_status try_insertion(hs_fix *fix, int64_t attempt, uint32_t chance, bool *is_done, hs_error *err)
{
    gcmc_state *state = fix->state;
    uint32_t word[HS_NOISE_NUMBERS];
    double fraction[3], x[1][3];
    int overlaps;
    if (state->n >= state->n_most) return HS_OK;
    words_of(fix, attempt, DRAW_PLACE, word);
    for (int axis = 0; axis < 3; ++axis) fraction[axis] = even(word[axis]);
    hs_box_place(fix->env->box, fraction, x[0]);
    for (int axis = 0; axis < 3; ++axis) x[0][axis] = hs_moved(0.0, x[0][axis], fix->env->position_magic);
    const double u =
        measure(fix, (const double(*)[3])x, 1, 0, &overlaps) + hs_local_energy_tail(&state->local, (int)state->type);
    const double expected = state->z * hs_box_volume(fix->env->box) / (double)(state->n + 1);
    if (overlaps > 0 || !is_accepted(log(expected) - u / state->kt, chance)) return HS_OK;
    *is_done = true;
    ++state->n;
    HS_TRY(add_atom(fix, attempt, x[0], err));
    return begin_anew(fix, err);
}

static hs_status remove_atom(hs_fix *fix, const picked_atom *atom, hs_error *err)
{
    hs_atoms *atoms = fix->env->atoms;
    unsigned char *drop = NULL;
    HS_UNLESS_FAILED(err, HS_ALLOC(drop, (size_t)atoms->n_local + 1, err));
    const hs_status status = hs_parallel_agree(fix->env->parallel, err);
    if (status == HS_OK) {
        if (atom->i >= 0) drop[atom->i] = 1;
        hs_atoms_remove(atoms, drop);
        --atoms->n_all;
    }
    HS_FREE(drop);
    return status;
}

static hs_status try_deletion(hs_fix *fix, int64_t attempt, uint32_t chance, bool *is_done, hs_error *err)
{
    gcmc_state *state = fix->state;
    int overlaps;
    if (state->n == 0 || state->n <= state->n_least) return HS_OK;
    const picked_atom atom = pick(fix, attempt);
    double u = measure(fix, &atom.x, 1, atom.id, &overlaps);
    --state->local.n_of_type[state->type];
    u += hs_local_energy_tail(&state->local, (int)state->type);
    ++state->local.n_of_type[state->type];
    const double expected = state->z * hs_box_volume(fix->env->box) / (double)state->n;
    if (overlaps == 0 && !is_accepted(u / state->kt - log(expected), chance)) return HS_OK;
    *is_done = true;
    --state->n;
    HS_TRY(remove_atom(fix, &atom, err));
    return begin_anew(fix, err);
}

static hs_status attempt_one(hs_fix *fix, int64_t attempt, hs_error *err)
{
    gcmc_state *state = fix->state;
    uint32_t word[HS_NOISE_NUMBERS];
    bool is_done = false;
    words_of(fix, attempt, DRAW_KIND, word);
    const double at = even(word[0]) * (double)(state->n_exchanges + state->n_moves);
    const int kind = at < (double)state->n_moves ? MOVE : word[2] & 1 ? INSERTION : DELETION;
    hs_status status;
    ++state->n_attempts[kind];
    if (kind == MOVE)
        status = try_move(fix, attempt, word[1], &is_done, err);
    else if (kind == INSERTION)
        status = try_insertion(fix, attempt, word[1], &is_done, err);
    else
        status = try_deletion(fix, attempt, word[1], &is_done, err);
    state->n_accepted[kind] += is_done;
    return status;
}

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    gcmc_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    if (fix->env->step != state->next) return HS_OK;
    state->next += state->every;
    state->n = 0;
    for (int i = 0; i < atoms->n_local; ++i) state->n += is_gas(fix, i);
    hs_parallel_sum_int64(fix->env->parallel, &state->n, 1);
    hs_status status = begin_anew(fix, err);
    if (status == HS_OK && state->local.view.type != atoms->type)
        status = hs_fail(err, HS_ERROR_INPUT,
                         "%s: with 'neigh_modify exclude group' it is not known what a new atom interacts with; "
                         "exclude types instead",
                         hs_fix_who(fix).text);
    for (int64_t k = 0; k < state->n_exchanges + state->n_moves && status == HS_OK; ++k)
        status = attempt_one(fix, k, err);
    hs_local_energy_end(&state->local);
    hs_env_changed(fix->env);
    return status;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const gcmc_state *state = fix->state;
    (void)err;
    *value = i / 2 >= N_KINDS ? 0.0 : (double)(i % 2 == 0 ? state->n_attempts[i / 2] : state->n_accepted[i / 2]);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    gcmc_state *state = fix->state;
    HS_TRY(hs_state_int64(kept, "first", &state->first, 1, err));
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    HS_TRY(hs_state_int64(kept, "attempts", state->n_attempts, N_KINDS, err));
    return hs_state_int64(kept, "accepted", state->n_accepted, N_KINDS, err);
}

const hs_fix_style hs_fix_style_gcmc = {
    .about =
        {.name = "gcmc",
         .syntax = {.usage = "<N> <X> <M> <type> <seed> <T> <mu> <displace> [keyword values ...]",
                    .n_min = 8,
                    .n_max = 8,
                    .keywords = keywords},
         .summary = "grand canonical Monte Carlo: the number of atoms follows a chemical potential",
         .details =
             "Every N steps X exchanges with a reservoir (insertions and deletions in equal shares) and M moves are "
             "tried, in random order, of atoms of the type in the fix's group. T is the temperature, mu the chemical "
             "potential (energy), k T ln(Lambda^3 n) in an ideal gas of number density n; in `units lj` Lambda is 1. "
             "`pressure` gives the reservoir by its pressure instead. A move takes an atom to an even place within "
             "`displace`; exchanges alone do where other fixes move the atoms, whose thermostat must hold the same T. "
             "New atoms get velocities of T and join group all, the fix's, and that of `group`.\n\n"
             "The first attempts come at the step after the fix was defined. Energies are those with all atoms within "
             "the cutoff, long-range corrections of `pair_modify tail` included (thermo output counts atoms for these "
             "when a run begins); the box must be thicker than the cutoff where it is periodic. Random numbers and "
             "results are the same on any ranks and threads. Temperatures need `compute_modify thermo_temp dynamic/dof "
             "yes`. Regions, molecules and two dimensions are not supported.\n\n"
             "The vector `f_ID[i]`: moves tried (1) and accepted (2), insertions (3, 4), deletions (5, 6), rotations "
             "(7, 8: none).",
         .reference = "D. Frenkel, B. Smit, Understanding Molecular Simulation, 2nd ed. (2002), section 5.6",
         .example =
             "fix 1 all nvt temp 1.5 1.5 0.5\ncompute_modify thermo_temp dynamic/dof yes\n"
             "fix g all gcmc 10 100 0 1 29494 1.5 -3.0 0.2\nthermo_style custom step temp atoms density f_g[4] f_g[6]"},
    .state_size = sizeof(gcmc_state),
    .create = create,
    .init = init,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .vector = vector,
    .keep_state = keep_state,
    .n_vector = 8,
    .is_time_dependent = true,
};
