/* Chunks: atoms numbered by bins, types or values per atom. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/chunk_bins.h"
#include "style/chunks.h"
#include "style/region.h"
#include "style/value.h"

typedef enum { BY_TYPE, BY_VALUE, BY_BIN } chunk_kind;
typedef struct chunk_state {
    hs_chunks chunks; /**< first */
    chunk_kind kind;
    hs_value value;     /**< BY_VALUE */
    hs_chunk_bins bins; /**< BY_BIN */
    hs_where where;
    int64_t limit; /**< 0: none */
    bool is_exact_limit;
    bool is_counted_once, is_kept; /**< nchunk once; ids once or nfreq */
    bool is_set_up;                /**< chunks were counted */
    int64_t n_raw;                 /**< chunks before they were compressed and limited */
    int64_t *number;               /**< owned [n_raw + 1]: of compressed chunks; 0: no atoms are there */
    double *kept;                  /**< memory of hs_atoms: numbers that are kept */
    char *field;                   /**< owned; name of that field */
} chunk_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "atoms outside of the region belong to no chunk"},
    {"nchunk", 1, "once|every", "count chunks once or whenever they are needed (default: every)"},
    {"limit", 2, "<N> max|exact", "types and values: no more chunks than N, or just as many"},
    {"ids", 1, "once|nfreq|every",
     "number atoms once, at the start of each averaging window, or whenever needed (default: every)"},
    {"compress", 1, "yes|no", "leave out chunks without atoms"},
    {"discard", 1, "yes|no|mixed",
     "atoms outside of all bins belong to none, to the nearest bin, or to none beyond a `bound` (default: mixed)"},
    {"bound", 3, "<x|y|z> <lo> <hi>",
     "bins cover this range (distance, or fractions); `lower` and `upper` are the box's faces"},
    {"pbc", 1, "yes|no", "shells: distances to the nearest image of the center (default: no)"},
    {"units", 1, "lattice|box|reduced", "lengths in lattice spacings (default), distance, or fractions of the box"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keyword(hs_compute *compute, const hs_args *args, int i, hs_error *err)
{
    static const char *const limits[] = {"max", "exact", NULL}, *const discards[] = {"mixed", "yes", "no", NULL},
                             *const units[] = {"lattice", "box", "reduced", NULL};
    chunk_state *state = compute->state;
    const char *word = args->word[i], *value = args->word[i + 1];
    int choice;
    if (strcmp(word, "bound") == 0) return hs_chunk_bins_read_bound(&state->bins, args, i + 1, err);
    if (strcmp(word, "pbc") == 0) return hs_arg_bool(args, i + 1, &state->bins.shells.is_periodic, err);
    if (strcmp(word, "compress") == 0) return hs_arg_bool(args, i + 1, &state->chunks.is_compressed, err);
    if (strcmp(word, "nchunk") == 0) state->is_counted_once = strcmp(value, "once") == 0;
    state->chunks.is_once |=
        strcmp(word, "ids") == 0 || strcmp(word, "nchunk") == 0 ? strcmp(value, "once") == 0 : false;
    if (strcmp(word, "ids") == 0) {
        state->is_kept = strcmp(value, "every") != 0;
        state->chunks.is_by_window = strcmp(value, "nfreq") == 0;
    } else if (strcmp(word, "region") == 0) {
        HS_TRY(hs_where_set(&state->where, value, err));
    } else if (strcmp(word, "discard") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, discards, &choice, err));
        state->bins.discard = (hs_bins_discard)choice;
    } else if (strcmp(word, "units") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, units, &choice, err));
        state->bins.units = (hs_bins_units)choice;
    } else if (strcmp(word, "limit") == 0) {
        if (state->kind == BY_BIN) /* LAMMPS ignores it */
            return hs_arg_refuse(args, i, "of use with bins: their width and 'bound' say how many there are", NULL,
                                 err);
        HS_TRY(hs_arg_int(args, i + 1, 0, INT32_MAX, &state->limit, err));
        HS_TRY(hs_arg_choice(args, i + 2, limits, &choice, err));
        state->is_exact_limit = choice == 1;
    }
    return HS_OK;
}

/** Number of chunks and volume of one, before atoms are looked at. */
static hs_status count_raw(hs_compute *compute, hs_error *err)
{
    chunk_state *state = compute->state;
    int64_t n_bins; /* without bins it is one, the whole box */
    HS_TRY(hs_chunk_bins_lay(&state->bins, compute->env, hs_compute_who(compute).text, &n_bins, &state->chunks.volume,
                             err));
    if (state->kind == BY_TYPE) state->n_raw = compute->env->atoms->n_types;
    if (state->kind == BY_BIN) state->n_raw = n_bins;
    state->chunks.n = state->n_raw;
    return HS_OK;
}

/** What chunks are made by; *n_words is how many words that takes. */
static hs_status read_kind(hs_compute *compute, const hs_args *args, int *n_words, hs_error *err)
{
    static const char *const kinds[] = {"type", "bin/1d", "bin/2d", "bin/3d", "bin/sphere", "bin/cylinder", NULL};
    static const int words[] = {1, 4, 7, 10, 7, 9};
    chunk_state *state = compute->state;
    hs_chunk_bins *bins = &state->bins;
    int kind;
    *n_words = 1;
    if (hs_value_is_reference(args->word[0])) {
        state->kind = BY_VALUE;
        return hs_value_init(&state->value, compute->env, args, 0, HS_VALUE_ATOMS, err);
    }
    if (hs_arg_choice(args, 0, kinds, &kind, err) != HS_OK) {
        hs_error_clear(err);
        return hs_arg_refuse(
            args, 0, "type, bin/1d, bin/2d, bin/3d, bin/sphere, bin/cylinder or a value per atom (c_ID, f_ID, v_name)",
            kinds, err);
    }
    *n_words = words[kind];
    if (kind == 0) return HS_OK;
    state->kind = BY_BIN;
    if (kind == 4)
        HS_TRY(hs_chunk_bins_read_sphere(bins, args, err));
    else if (kind == 5)
        HS_TRY(hs_chunk_bins_read_cylinder(bins, compute->env, args, err));
    else
        HS_TRY(hs_chunk_bins_read(bins, compute->env, args, kind, err));
    state->chunks.n_axes = hs_chunk_bins_coordinates(bins);
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    chunk_state *state = compute->state;
    hs_text name = {0};
    int first;
    HS_TRY(read_kind(compute, args, &first, err));
    const int n_fixed = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    if (n_fixed != first) return hs_arg_refuse(args, n_fixed < first ? n_fixed : first, "a keyword here", NULL, err);
    for (int i = first; i < args->n;) {
        HS_TRY(read_keyword(compute, args, i, err));
        i += strcmp(args->word[i], "bound") == 0 ? 4 : strcmp(args->word[i], "limit") == 0 ? 3 : 2;
    }
    hs_chunk_bins_scale(&state->bins, compute->env);
    hs_status status = hs_text_printf(&name, err, "compute %s chunk", compute->id);
    if (status == HS_OK) status = hs_memory_strdup(&state->field, hs_text_get(&name), err);
    hs_text_fini(&name);
    if (status != HS_OK) return status;
    if (state->is_kept)
        HS_TRY(hs_atoms_add_field(compute->env->atoms, state->field, (void **)&state->kept, sizeof *state->kept, false,
                                  err));
    return count_raw(compute, err);
}

static void destroy(hs_compute *compute)
{
    chunk_state *state = compute->state;
    if (state->kept != NULL) hs_atoms_remove_field(compute->env->atoms, (void **)&state->kept);
    hs_value_fini(&state->value);
    HS_FREE(state->chunks.place);
    HS_FREE(state->chunks.volumes);
    HS_FREE(state->chunks.original);
    HS_FREE(state->number);
    hs_where_fini(&state->where);
    HS_FREE(state->field);
}

/** compute->atoms: numbers before they are compressed. */
static hs_status number_raw(hs_compute *compute, hs_error *err)
{
    chunk_state *state = compute->state;
    const hs_env *env = compute->env;
    const hs_atoms *atoms = env->atoms;
    double *id = compute->atoms;
    HS_TRY(hs_where_find(&state->where, compute->env, hs_compute_who(compute).text, err));
    HS_TRY(hs_where_update(&state->where, err));
    if (state->kind == BY_VALUE) HS_TRY(hs_value_atoms(compute->env, &state->value, id, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (state->kind == BY_VALUE) id[i] = id[i] >= 1.0 && id[i] < INT32_MAX ? trunc(id[i]) : 0.0;
        if (state->kind == BY_TYPE) id[i] = atoms->type[i];
        if (state->kind == BY_BIN) id[i] = (double)(hs_chunk_bins_find(&state->bins, env, i) + 1);
        if (!(atoms->mask[i] & compute->mask) || !hs_where_has(&state->where, atoms, i)) id[i] = 0.0;
    }
    return HS_OK;
}

/** Which chunks have atoms: number[1 ... n_raw] from 1, chunks.original. */
static hs_status compress(hs_compute *compute, hs_error *err)
{
    chunk_state *state = compute->state;
    const hs_env *env = compute->env;
    hs_status status = HS_GROW(state->number, 0, (size_t)state->n_raw + 1, err);
    if (status == HS_OK) status = HS_GROW(state->chunks.original, 0, (size_t)state->n_raw + 1, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    memset(state->number, 0, ((size_t)state->n_raw + 1) * sizeof *state->number);
    for (int i = 0; i < env->atoms->n_local; ++i) {
        const double id = compute->atoms[i];
        if (id > 0.0) state->number[(size_t)id] = 1;
    }
    hs_parallel_sum_int64(env->parallel, state->number, (int)state->n_raw + 1);
    state->chunks.n = 0;
    for (int64_t id = 1; id <= state->n_raw; ++id) {
        if (state->number[id] == 0) continue;
        state->chunks.original[state->chunks.n] = id;
        state->number[id] = ++state->chunks.n;
    }
    return HS_OK;
}

static hs_status place_chunks(hs_compute *compute, hs_error *err)
{
    const chunk_state *state = compute->state;
    hs_chunks *chunks = hs_chunks_of(compute);
    const bool has_shells = state->bins.shells.n > 0;
    if (chunks->n_axes == 0) return HS_OK;
    HS_TRY(HS_GROW(chunks->place, 0, (size_t)chunks->n * (size_t)chunks->n_axes + 1, err));
    if (has_shells) HS_TRY(HS_GROW(chunks->volumes, 0, (size_t)chunks->n + 1, err));
    for (int64_t c = 0; c < chunks->n; ++c) {
        const int64_t bin = chunks->is_compressed ? chunks->original[c] - 1 : c;
        double *place = chunks->place + c * chunks->n_axes;
        /* `limit exact` may have asked for more than there are */
        const bool is_there = bin >= 0 && bin < state->n_raw;
        for (int k = 0; k < chunks->n_axes; ++k) place[k] = 0.0;
        if (is_there) hs_chunk_bins_place(&state->bins, bin, place);
        if (has_shells)
            chunks->volumes[c] =
                is_there ? hs_chunk_bins_volume(&state->bins, compute->env->box, bin, chunks->volume) : chunks->volume;
    }
    return HS_OK;
}

/** Count the chunks; compute->atoms holds raw numbers. */
static hs_status set_up(hs_compute *compute, hs_error *err)
{
    chunk_state *state = compute->state;
    const hs_env *env = compute->env;
    if (state->kind == BY_VALUE) {
        double largest = 0.0;
        for (int i = 0; i < env->atoms->n_local; ++i) largest = fmax(largest, compute->atoms[i]);
        hs_parallel_max_double(env->parallel, &largest, 1);
        state->n_raw = state->chunks.n = (int64_t)largest;
    }
    if (state->chunks.is_compressed) HS_TRY(compress(compute, err));
    if (state->limit > 0 && (state->is_exact_limit || state->chunks.n > state->limit)) {
        const int64_t n = state->chunks.n;
        if (state->chunks.is_compressed && state->limit > n) {
            HS_TRY(HS_GROW(state->chunks.original, (size_t)n, (size_t)state->limit, err));
            memset(state->chunks.original + n, 0, (size_t)(state->limit - n) * sizeof(int64_t));
        }
        state->chunks.n = state->limit;
    }
    state->is_set_up = true;
    return place_chunks(compute, err);
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    chunk_state *state = compute->state;
    const size_t n = (size_t)compute->env->atoms->n_local;
    const bool may_change = state->chunks.is_by_window && state->chunks.n_locks == 0;
    if (state->is_kept && state->is_set_up && !may_change) {
        if (n > 0) memcpy(compute->atoms, state->kept, n * sizeof *compute->atoms);
        return HS_OK;
    }
    const bool is_new = !state->is_set_up || (!state->is_counted_once && state->chunks.n_locks == 0);
    if (is_new) HS_TRY(count_raw(compute, err));
    HS_TRY(number_raw(compute, err));
    if (is_new) HS_TRY(set_up(compute, err));
    for (size_t i = 0; i < n; ++i) {
        double *id = &compute->atoms[i];
        if (*id > (double)state->n_raw) *id = 0.0;
        if (state->chunks.is_compressed) *id = (double)state->number[(size_t)*id];
        if (*id > (double)state->chunks.n) *id = 0.0;
    }
    if (state->is_kept && n > 0) memcpy(state->kept, compute->atoms, n * sizeof *compute->atoms);
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(hs_compute_eval_atoms(compute, err));
    *value = (double)hs_chunks_of(compute)->n;
    return HS_OK;
}

static hs_status keep_state(hs_compute *compute, hs_state *kept, hs_error *err)
{
    chunk_state *state = compute->state;
    hs_chunks *chunks = &state->chunks;
    int64_t n_original = chunks->original != NULL ? chunks->n : 0,
            n_number = state->number != NULL ? state->n_raw + 1 : 0;
    HS_TRY(hs_state_bool(kept, "is_set_up", &state->is_set_up, err));
    HS_TRY(hs_state_int64(kept, "n", &chunks->n, 1, err));
    HS_TRY(hs_state_int64(kept, "n_raw", &state->n_raw, 1, err));
    HS_TRY(hs_state_int64(kept, "n_locks", &chunks->n_locks, 1, err));
    HS_TRY(hs_state_double(kept, "volume", &chunks->volume, 1, err));
    HS_TRY(hs_state_double(kept, "center", state->bins.shells.place, 3, err));
    HS_TRY(hs_state_double(kept, "radii", state->bins.shells.ends, 2, err));
    for (int k = 0; k < state->bins.n_axes; ++k) {
        const char *const offset[] = {"offset 1", "offset 2", "offset 3"}, *const n[] = {"bins 1", "bins 2", "bins 3"};
        HS_TRY(hs_state_double(kept, offset[k], &state->bins.axis[k].offset, 1, err));
        HS_TRY(hs_state_int64(kept, n[k], &state->bins.axis[k].n, 1, err));
    }
    if (state->chunks.is_compressed && state->is_set_up) {
        HS_TRY(hs_state_int64s(kept, "original", &chunks->original, &n_original, err));
        HS_TRY(hs_state_int64s(kept, "number", &state->number, &n_number, err));
    }
    return kept->is_reading && state->is_set_up ? place_chunks(compute, err) : HS_OK;
}

/** Chunks that are counted or numbered once are so at the start of the first run. */
static hs_status setup(hs_compute *compute, hs_error *err)
{
    return hs_chunks_of(compute)->is_once ? hs_compute_eval_atoms(compute, err) : HS_OK;
}

const hs_compute_style hs_compute_style_chunk_atom = {
    .about = {.name = "chunk/atom",
              .syntax = {.usage = "type | bin/1d <axis> <origin> <delta> | bin/2d ... | bin/3d ... | bin/sphere <x> "
                                  "<y> <z> <rmin> <rmax> <n> | bin/cylinder <axis> <origin> <delta> <c1> <c2> <rmin> "
                                  "<rmax> <n> | <value> [keyword value ...]",
                         .n_min = 1,
                         .n_max = -1,
                         .keywords = keywords},
              .summary = "number atoms by bins, types or values, for averages over each part",
              .details =
                  "The value per atom `c_ID` is the number of the chunk it belongs to, from 1; 0 for none (atoms "
                  "outside of the group or the `region`). The scalar `c_ID` is the number of chunks.\n\n"
                  "`type`: the atom's type. `bin/1d`, `bin/2d`, `bin/3d`: layers, columns or boxes; for each axis (x, "
                  "y, z) an origin (`lower`, `center`, `upper` of the covered range, or a coordinate) and a width "
                  "delta. Edges are at origin plus multiples of delta, and bins cover the box, or the `bound`; the "
                  "last axis changes fastest. `bin/sphere`: n shells around a point (rings in two dimensions), from "
                  "rmin to rmax; `bin/cylinder`: such shells around a line along an axis, at c1, c2 of the two others, "
                  "in layers along the axis; c1, c2 and the radii are distances even in lattice units, as in LAMMPS. A "
                  "value per atom (`c_ID`, `c_ID[i]`, `f_ID`, `v_name`): its whole part, if that is at least 1.\n\n"
                  "With `nchunk every` bins follow the box and chunks are counted anew, though not within an averaging "
                  "window; means of several windows (`ave running`, `ave window`) hold those of the first. `limit N "
                  "max` leaves out numbers above N, `limit N exact` makes just N chunks. `compress "
                  "yes` numbers only chunks that have atoms. `discard` says what becomes of atoms outside of all bins: "
                  "`mixed` puts them into the nearest bin or shell, except beyond a bound given as a number. In "
                  "lattice units the bound of x (with bins along two axes of x and y, along three of all) is scaled, "
                  "others are not, as in LAMMPS. `ids once` keeps the first numbers, `ids nfreq` those of the first "
                  "sample of each window of fix ave/chunk, and of fix ave/time in mode vector.",
              .example =
                  "compute layers all chunk/atom bin/1d z lower 0.05 units reduced\n"
                  "compute grid flow chunk/atom bin/2d x lower 1.0 y lower 1.0\ncompute kinds all chunk/atom type\n"
                  "compute drop all chunk/atom bin/sphere 10 10 10 0 8 32 units box"},
    .state_size = sizeof(chunk_state),
    .create = create,
    .destroy = destroy,
    .setup = setup,
    .scalar = scalar,
    .per_atom = per_atom,
    .keep_state = keep_state,
};
