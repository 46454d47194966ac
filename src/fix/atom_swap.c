/* Monte Carlo of types: two atoms swap theirs, or (semi-grand canonical) one atom gets another.
 *
 * A move is accepted with the probability min(1, exp(-(dU - dmu) / k T)) (N. Metropolis et al., J. Chem. Phys. 21, 1087 (1953),
 * doi:10.1063/1.1699114; semi-grand: D. A. Kofke, E. D. Glandt, Mol. Phys. 64, 1105 (1988), doi:10.1080/00268978800100743).
 * Atoms are chosen some at a time, none twice, by random numbers of their ids: which are chosen depends on the types only through
 * who is of which type, and all choices are equally likely before and after the moves, so each batch of moves leaves the
 * distribution as it is. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "style/local_energy.h"
#include "style/region.h"

enum {
    BATCH = 256,                   /**< moves whose atoms are chosen together */
    MOVE_DRAW = HS_NOISE_DRAWS - 1 /**< draw of what decides a move; those below choose atoms */
};

typedef struct swap_state {
    int64_t every, n_moves; /**< steps; moves at each such step */
    double temperature;
    hs_noise noise;
    int *type; /**< owned [n_types] that take part */
    int n_types;
    double *mu; /**< owned [n_types]: chemical potentials, energy; NULL: none were given */
    int n_mu;
    bool is_semi_grand, keeps_kinetic;
    hs_where where;
    int64_t first, next; /**< steps */
    int64_t n_attempts, n_accepted;
} swap_state;

/** An atom that was chosen. The same on all ranks but for the local index. */
typedef struct chosen {
    int64_t id;
    double x[3];
    int64_t type, class;
    int64_t i; /**< local index, -1: another rank's */
} chosen;

/** One that may be; those with the smallest draws are. */
typedef struct candidate {
    int64_t draw, id;
    int i;
} candidate;

static const hs_keyword keywords[] = {
    {"types", -1, "<type> <type> ...", "types that take part: two, or with semi-grand any number"},
    {"mu", -1, "<mu> <mu> ...", "semi-grand: chemical potentials of these types, energy"},
    {"ke", 1, "yes|no", "atoms keep their kinetic energy, not their velocity, where masses differ (default yes)"},
    {"semi-grand", 1, "yes|no", "moves give single atoms other types (default no: two atoms swap theirs)"},
    {"region", 1, "<region-ID>", "only atoms in the region"},
    {NULL, 0, NULL, NULL},
};

static bool is_keyword(const char *word)
{
    for (const hs_keyword *keyword = keywords; keyword->name != NULL; ++keyword)
        if (strcmp(keyword->name, word) == 0) return true;
    return false;
}

static hs_status read_types(hs_fix *fix, const hs_args *args, int i, int n, hs_error *err)
{
    swap_state *state = fix->state;
    state->n_types = 0;
    HS_TRY(HS_GROW(state->type, 0, (size_t)n + 1, err));
    for (int k = 0; k < n; ++k) {
        int64_t type;
        HS_TRY(hs_arg_type(args, i + k, fix->env->atoms->n_types, &type, err));
        for (int other = 0; other < k; ++other)
            if (state->type[other] == type)
                return hs_arg_refuse(args, i + k, "a type that was not named yet", NULL, err);
        state->type[state->n_types++] = (int)type;
    }
    return HS_OK;
}

static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, int n, hs_error *err)
{
    swap_state *state = fix->state;
    const char *word = args->word[i];
    if (strcmp(word, "types") == 0) return read_types(fix, args, i + 1, n, err);
    if (strcmp(word, "ke") == 0) return hs_arg_bool(args, i + 1, &state->keeps_kinetic, err);
    if (strcmp(word, "semi-grand") == 0) return hs_arg_bool(args, i + 1, &state->is_semi_grand, err);
    if (strcmp(word, "region") == 0) return hs_where_set(&state->where, args->word[i + 1], err);
    state->n_mu = n;
    HS_TRY(HS_GROW(state->mu, 0, (size_t)n + 1, err));
    for (int k = 0; k < n; ++k) HS_TRY(hs_arg_double(args, i + 1 + k, &state->mu[k], err));
    return HS_OK;
}

static hs_status check_words(const swap_state *state, const hs_args *args, hs_error *err)
{
    if (state->n_types < 2 || (state->n_types > 2 && !state->is_semi_grand))
        return hs_fail(err, HS_ERROR_INPUT, "%s: 'types' must name two types%s", args->command,
                       state->is_semi_grand ? " or more" : ", unless 'semi-grand yes' is said");
    if (!state->is_semi_grand && state->mu != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: mu goes with 'semi-grand yes'; swaps change no numbers",
                       args->command);
    if (state->is_semi_grand && state->n_mu != state->n_types)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: semi-grand needs 'mu' with a chemical potential for each of the %d types", args->command,
                       state->n_types);
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    swap_state *state = fix->state;
    int64_t seed;
    state->keeps_kinetic = true;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 1, 1, INT32_MAX, &state->n_moves, err));
    HS_TRY(hs_arg_int(args, 2, 1, INT32_MAX, &seed, err));
    HS_TRY(hs_arg_positive(args, 3, &state->temperature, err));
    for (int i = 4, end; i < args->n; i = end) {
        for (end = i + 1; end < args->n && !is_keyword(args->word[end]);) ++end;
        HS_TRY(read_keyword(fix, args, i, end - i - 1, err));
    }
    HS_TRY(check_words(state, args, err));
    HS_TRY(hs_fix_noise(fix, seed, &state->noise, err));
    state->first = state->next = fix->env->step + 1;
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

static void destroy(hs_fix *fix)
{
    swap_state *state = fix->state;
    HS_FREE(state->type);
    HS_FREE(state->mu);
    hs_where_fini(&state->where);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    swap_state *state = fix->state;
    state->next = state->first + (fix->env->step - state->first + state->every) / state->every * state->every;
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

static int64_t next_exchange(const hs_fix *fix) { return ((const swap_state *)fix->state)->next; }

/* Choosing atoms */

static int by_draw(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->draw != q->draw) return p->draw < q->draw ? -1 : 1;
    return (p->id > q->id) - (p->id < q->id);
}

/** Whether local atom i may be chosen: of type @p type, 0: of any that takes part. */
static bool takes_part(const hs_fix *fix, int i, int type)
{
    const swap_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    if (!(atoms->mask[i] & fix->mask) || !hs_where_has(&state->where, atoms, i)) return false;
    for (int k = 0; k < state->n_types; ++k)
        if (atoms->type[i] == state->type[k]) return type == 0 || atoms->type[i] == type;
    return false;
}

/** This rank's candidates in the order of their draws of the round. */
static hs_status find_candidates(const hs_fix *fix, int type, int64_t round, candidate **found, int *n_found,
                                 hs_error *err)
{
    const swap_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    candidate *list;
    int n = 0;
    HS_TRY(HS_ALLOC(list, (size_t)atoms->n_local + 1, err));
    for (int i = 0; i < atoms->n_local; ++i) {
        uint32_t word[HS_NOISE_NUMBERS];
        if (!takes_part(fix, i, type)) continue;
        hs_noise_words(state->noise, hs_fix_clock(fix), (int)(round % MOVE_DRAW),
                       (int64_t)((uint64_t)atoms->id[i] + ((uint64_t)(round / MOVE_DRAW) << 48)), word);
        list[n++] = (candidate){(int64_t)(word[0] >> 1) << 31 | word[1] >> 1, atoms->id[i], i};
    }
    qsort(list, (size_t)n, sizeof *list, by_draw);
    *found = list;
    *n_found = n;
    return HS_OK;
}

/** Up to n_wanted atoms with the smallest draws of all ranks, in their order; returns how many (collective). */
static int choose(const hs_fix *fix, const hs_local_energy *local, const candidate *list, int n_list, int n_wanted,
                  chosen *picked)
{
    enum { N_NUMBERS = 6 };
    const hs_parallel *parallel = fix->env->parallel;
    const hs_atoms *atoms = fix->env->atoms;
    int64_t number[BATCH * N_NUMBERS];
    int next = 0, n = 0;
    for (; n < n_wanted; ++n) {
        const int64_t mine = next < n_list ? -list[next].draw : INT64_MIN;
        int64_t draw = mine;
        hs_parallel_max_int64(parallel, &draw, 1);
        if (draw == INT64_MIN) break;
        int64_t id = mine == draw ? -list[next].id : INT64_MIN;
        hs_parallel_max_int64(parallel, &id, 1);
        picked[n] = (chosen){.id = -id, .i = -1};
        if (mine == draw && list[next].id == -id) picked[n].i = list[next++].i;
    }
    /* what the others know of an atom is its owner's bits and zeros */
    memset(number, 0, sizeof number);
    for (int k = 0; k < n; ++k) {
        const int64_t i = picked[k].i;
        int64_t *to = number + k * N_NUMBERS;
        if (i < 0) continue;
        for (int axis = 0; axis < 3; ++axis) memcpy(&to[axis], &atoms->x[axis][i], sizeof *to);
        to[3] = atoms->type[i];
        to[4] = hs_local_energy_class(local, (int)i);
    }
    hs_parallel_sum_int64(parallel, number, n * N_NUMBERS);
    for (int k = 0; k < n; ++k) {
        const int64_t *from = number + k * N_NUMBERS;
        memcpy(picked[k].x, from, sizeof picked[k].x);
        picked[k].type = from[3];
        picked[k].class = from[4];
    }
    return n;
}

/* Moves */

/** Energy of a move, energies of the new types less those of the old; -1, 1 in *overlaps where it undoes or makes overlaps. */
static double measure(const hs_local_energy *local, const chosen *const atom[2], const int *to, int n_atoms,
                      int *overlaps)
{
    hs_exact_sum sums[4];
    int64_t n_overlaps[4] = {0};
    const int64_t left_out[2] = {atom[0]->id, n_atoms == 2 ? atom[1]->id : 0};
    double energy[4], difference = 0.0;
    memset(sums, 0, sizeof sums);
    for (int a = 0; a < n_atoms; ++a) {
        const int type[2] = {(int)atom[a]->type, to[a]};
        hs_local_energy_add(local, atom[a]->x, (int)atom[a]->class, type, 2, left_out, sums + 2 * a,
                            n_overlaps + 2 * a);
    }
    hs_local_energy_total(local, sums, 2 * n_atoms, energy, n_overlaps);
    int64_t more = 0;
    for (int a = 0; a < n_atoms; ++a) {
        difference += energy[2 * a + 1] - energy[2 * a];
        more += n_overlaps[2 * a + 1] - n_overlaps[2 * a];
    }
    *overlaps = (more > 0) - (more < 0);
    return difference;
}

/** Even in (0, 1). */
static double even(const uint32_t word[2])
{
    return ((double)((uint64_t)word[0] << 20 | word[1] >> 12) + 0.5) * 0x1p-52;
}

static void set_type(const hs_fix *fix, hs_local_energy *local, chosen *atom, int type)
{
    const swap_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    --local->n_of_type[atom->type];
    ++local->n_of_type[type];
    atom->type = type;
    if (atom->i < 0) return;
    const double before = hs_atom_mass(atoms, (int)atom->i);
    atoms->type[atom->i] = type;
    const double scale = sqrt(before / hs_atom_mass(atoms, (int)atom->i));
    for (int axis = 0; axis < 3 && state->keeps_kinetic; ++axis) atoms->v[axis][atom->i] *= scale;
}

/** Long-range corrections of a single atom's new type. */
static double tail_difference(hs_local_energy *local, const chosen *atom, int to)
{
    --local->n_of_type[atom->type];
    const double difference = hs_local_energy_tail(local, to) - hs_local_energy_tail(local, (int)atom->type);
    ++local->n_of_type[atom->type];
    return difference;
}

/** Another type for one atom: any of the others, all equally likely. */
static void move_one(hs_fix *fix, hs_local_energy *local, chosen *atom)
{
    swap_state *state = fix->state;
    uint32_t word[HS_NOISE_NUMBERS];
    int old = 0, overlaps;
    hs_noise_words(state->noise, hs_fix_clock(fix), MOVE_DRAW, state->n_attempts, word);
    while (state->type[old] != atom->type) ++old;
    const int new = (old + 1 + (int)((uint64_t)word[2] * (uint64_t)(state->n_types - 1) >> 32)) % state->n_types;
    const chosen *const one[2] = {atom, NULL};
    const double du =
        measure(local, one, &state->type[new], 1, &overlaps) + tail_difference(local, atom, state->type[new]);
    const double cost = (du - (state->mu[new] - state->mu[old])) / (fix->env->units->boltz * state->temperature);
    if (overlaps > 0 || (overlaps == 0 && !(cost <= 0.0 || even(word) < exp(-cost)))) return;
    set_type(fix, local, atom, state->type[new]);
    ++state->n_accepted;
}

static void move_two(hs_fix *fix, hs_local_energy *local, chosen *a, chosen *b)
{
    swap_state *state = fix->state;
    uint32_t word[HS_NOISE_NUMBERS];
    int overlaps;
    const chosen *const both[2] = {a, b};
    const int to[2] = {(int)b->type, (int)a->type};
    hs_noise_words(state->noise, hs_fix_clock(fix), MOVE_DRAW, state->n_attempts, word);
    const double cost = measure(local, both, to, 2, &overlaps) / (fix->env->units->boltz * state->temperature);
    if (overlaps > 0 || (overlaps == 0 && !(cost <= 0.0 || even(word) < exp(-cost)))) return;
    set_type(fix, local, a, to[0]);
    set_type(fix, local, b, to[1]);
    ++state->n_accepted;
}

/** Up to n_wanted moves of atoms that are chosen together; *n_done of them, 0 where there are no atoms to move (collective). */
static hs_status move_batch(hs_fix *fix, hs_local_energy *local, int64_t round, int n_wanted, int *n_done,
                            hs_error *err)
{
    swap_state *state = fix->state;
    const int n_lists = state->is_semi_grand ? 1 : 2;
    candidate *list[2] = {NULL, NULL};
    chosen(*picked)[BATCH] = NULL;
    int n_list[2] = {0, 0};
    HS_UNLESS_FAILED(err, HS_ALLOC(picked, 2, err));
    for (int k = 0; k < n_lists; ++k)
        HS_UNLESS_FAILED(
            err, find_candidates(fix, state->is_semi_grand ? 0 : state->type[k], round, &list[k], &n_list[k], err));
    const hs_status status = hs_parallel_agree(fix->env->parallel, err);
    *n_done = n_wanted;
    for (int k = 0; k < n_lists && status == HS_OK; ++k)
        *n_done = choose(fix, local, list[k], n_list[k], *n_done, picked[k]);
    for (int m = 0; m < *n_done && status == HS_OK; ++m, ++state->n_attempts) {
        if (state->is_semi_grand)
            move_one(fix, local, &picked[0][m]);
        else
            move_two(fix, local, &picked[0][m], &picked[1][m]);
    }
    for (int k = 0; k < 2; ++k) HS_FREE(list[k]);
    HS_FREE(picked);
    return status;
}

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    swap_state *state = fix->state;
    hs_local_energy local = {0};
    if (fix->env->step != state->next) return HS_OK;
    state->next += state->every;
    HS_TRY(hs_where_update(&state->where, err));
    hs_status status = hs_local_energy_begin(&local, fix, 1e12 * fix->env->units->boltz * state->temperature, err);
    int64_t left = state->n_moves;
    for (int64_t round = 0; left > 0 && status == HS_OK; ++round) {
        int n_done;
        status = move_batch(fix, &local, round, left < BATCH ? (int)left : BATCH, &n_done, err);
        if (status != HS_OK) break;
        left -= n_done;
        if (n_done > 0) continue;
        state->n_attempts += left; /* there are no atoms to move, and LAMMPS counts that as attempts, too */
        left = 0;
    }
    hs_local_energy_end(&local);
    hs_env_changed(fix->env);
    return status;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const swap_state *state = fix->state;
    (void)err;
    *value = (double)(i == 0 ? state->n_attempts : state->n_accepted);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    swap_state *state = fix->state;
    HS_TRY(hs_state_int64(kept, "first", &state->first, 1, err));
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    HS_TRY(hs_state_int64(kept, "attempts", &state->n_attempts, 1, err));
    return hs_state_int64(kept, "accepted", &state->n_accepted, 1, err);
}

const hs_fix_style hs_fix_style_atom_swap = {
    .about = {.name = "atom/swap",
              .syntax = {.usage = "<N> <X> <seed> <T> types <type> <type> ... [keyword values ...]",
                         .n_min = 4,
                         .n_max = 4,
                         .keywords = keywords},
              .summary = "Monte Carlo of types, for mixtures at equilibrium",
              .details =
                  "Every N steps X moves are tried, by Metropolis's rule at the temperature T. An atom of the first "
                  "type and one of the second swap their types (at fixed numbers, which mixes and unmixes much faster "
                  "than diffusion does), or, with `semi-grand yes`, an atom gets another of the `types`, so that "
                  "numbers follow the chemical potentials `mu` (energy), of which only differences matter. Only atoms "
                  "of the group take part, with `region` only those in it. Places stay; with `ke yes` (default) "
                  "velocities are scaled where masses differ, so that the kinetic energy stays, too.\n\n"
                  "The first moves come at the step after the fix was defined. Energies are those of the pairs that a "
                  "move changes, whole and exact, long-range corrections of `pair_modify tail` included; the box must "
                  "be thicker than the cutoff where it is periodic, and the pair style must not go by diameters. Moves "
                  "and random numbers are the same on any ranks and threads. Other than in LAMMPS no atom is moved "
                  "twice in a batch of 256 moves; that, too, leaves the distribution as it is.\n\n"
                  "The vector: `f_ID[1]` the moves tried so far, `f_ID[2]` those accepted.",
              .reference =
                  "N. Metropolis et al., J. Chem. Phys. 21, 1087 (1953), doi:10.1063/1.1699114; D. A. Kofke, E. D. "
                  "Glandt, Mol. Phys. 64, 1105 (1988), doi:10.1080/00268978800100743",
              .example = "fix mix all atom/swap 10 20 29494 1.0 types 1 2\n"
                         "fix sg all atom/swap 10 100 29494 1.0 semi-grand yes types 1 2 mu 0.0 -0.35"},
    .state_size = sizeof(swap_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .vector = vector,
    .keep_state = keep_state,
    .n_vector = 2,
    .is_time_dependent = true,
    .allows_dynamic_group = true,
};
