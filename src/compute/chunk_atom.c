/* Chunks: atoms numbered by bins, types or values per atom. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/lattice.h"
#include "style/chunks.h"
#include "style/region.h"
#include "style/value.h"

typedef enum { BY_TYPE, BY_VALUE, BY_BIN } chunk_kind;
typedef enum { UNITS_LATTICE, UNITS_BOX, UNITS_REDUCED } chunk_units;
typedef enum { FROM_LOWER, FROM_CENTER, FROM_UPPER, FROM_NUMBER } chunk_origin;
typedef enum { DISCARD_MIXED, DISCARD_YES, DISCARD_NO } chunk_discard;

/** Bins along one axis. Lengths in distance, or fractions of the box with units reduced. */
typedef struct bins {
    int axis;
    chunk_origin from;
    double origin, delta;
    bool has_bound[2]; /**< else the box's face */
    double bound[2];
    double offset; /**< lower end of the first bin */
    int64_t n;
} bins;

typedef struct chunk_state {
    hs_chunks chunks; /**< first */
    chunk_kind kind;
    hs_value value; /**< BY_VALUE */
    bins axis[3];   /**< BY_BIN: [chunks.n_axes], the last one changes fastest */
    chunk_units units;
    chunk_discard discard;
    char *region_id; /**< owned; NULL: everywhere */
    int64_t limit;   /**< 0: none */
    bool is_exact_limit;
    bool is_counted_once, is_kept; /**< nchunk once; ids once or nfreq */
    bool is_set_up;                /**< chunks were counted */
    int64_t n_raw;                 /**< chunks before they were compressed and limited */
    int64_t *number;               /**< owned [n_raw + 1]: of compressed chunks; 0: no atoms are there */
    double *kept;                  /**< memory of hs_atoms: numbers that are kept */
    char *field;                   /**< owned; name of that field */
} chunk_state;

static const char *const axis_names[] = {"x", "y", "z", NULL};

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
    {"units", 1, "lattice|box|reduced", "lengths in lattice spacings (default), distance, or fractions of the box"},
    {NULL, 0, NULL, NULL},
};

/** Read lengths still in the deck's units; they are scaled once all keywords are known. */
static hs_status read_bins(hs_compute *compute, const hs_args *args, int n_axes, hs_error *err)
{
    static const char *const origins[] = {"lower", "center", "upper", NULL};
    chunk_state *state = compute->state;
    state->kind = BY_BIN;
    state->chunks.n_axes = n_axes;
    for (int k = 0; k < n_axes; ++k) {
        bins *b = &state->axis[k];
        int origin = 0;
        HS_TRY(hs_arg_need(args, 3 * k + 3, "an axis, an origin and a width of bins", err));
        HS_TRY(hs_arg_choice(args, 3 * k + 1, axis_names, &b->axis, err));
        for (int j = 0; j < k; ++j)
            if (state->axis[j].axis == b->axis)
                return hs_arg_refuse(args, 3 * k + 1, "an axis that has no bins yet", NULL, err);
        if (b->axis == 2 && compute->env->box->dimension == 2)
            return hs_arg_refuse(args, 3 * k + 1, "an axis of a two-dimensional box", NULL, err);
        b->from = FROM_NUMBER;
        while (origins[origin] != NULL && strcmp(args->word[3 * k + 2], origins[origin]) != 0) ++origin;
        if (origins[origin] != NULL)
            b->from = (chunk_origin)origin;
        else if (hs_arg_double(args, 3 * k + 2, &b->origin, err) != HS_OK) {
            hs_error_clear(err);
            return hs_arg_refuse(args, 3 * k + 2, "lower, center, upper or a number", origins, err);
        }
        HS_TRY(hs_arg_positive(args, 3 * k + 3, &b->delta, err));
    }
    return HS_OK;
}

static hs_status read_bound(chunk_state *state, const hs_args *args, int i, hs_error *err)
{
    static const char *const faces[] = {"lower", "upper"};
    int axis, k = 0;
    HS_TRY(hs_arg_choice(args, i, axis_names, &axis, err));
    while (k < state->chunks.n_axes && state->axis[k].axis != axis) ++k;
    if (k == state->chunks.n_axes || state->kind != BY_BIN)
        return hs_arg_refuse(args, i, "an axis along which there are bins", NULL, err);
    for (int end = 0; end < 2; ++end) {
        state->axis[k].has_bound[end] = strcmp(args->word[i + 1 + end], faces[end]) != 0;
        if (state->axis[k].has_bound[end]) HS_TRY(hs_arg_double(args, i + 1 + end, &state->axis[k].bound[end], err));
    }
    if (state->axis[k].has_bound[0] && state->axis[k].has_bound[1] &&
        !(state->axis[k].bound[0] < state->axis[k].bound[1]))
        return hs_arg_refuse(args, i + 2, "above the lower bound", NULL, err);
    return HS_OK;
}

static hs_status read_keyword(hs_compute *compute, const hs_args *args, int i, hs_error *err)
{
    static const char *const limits[] = {"max", "exact", NULL}, *const discards[] = {"mixed", "yes", "no", NULL},
                             *const units[] = {"lattice", "box", "reduced", NULL};
    chunk_state *state = compute->state;
    const char *word = args->word[i], *value = args->word[i + 1];
    int choice;
    if (strcmp(word, "bound") == 0) return read_bound(state, args, i + 1, err);
    if (strcmp(word, "compress") == 0) return hs_arg_bool(args, i + 1, &state->chunks.is_compressed, err);
    if (strcmp(word, "nchunk") == 0) state->is_counted_once = strcmp(value, "once") == 0;
    state->chunks.is_once |=
        strcmp(word, "ids") == 0 || strcmp(word, "nchunk") == 0 ? strcmp(value, "once") == 0 : false;
    if (strcmp(word, "ids") == 0) {
        state->is_kept = strcmp(value, "every") != 0;
        state->chunks.is_by_window = strcmp(value, "nfreq") == 0;
    } else if (strcmp(word, "region") == 0) {
        HS_FREE(state->region_id);
        HS_TRY(hs_memory_strdup(&state->region_id, value, err));
    } else if (strcmp(word, "discard") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, discards, &choice, err));
        state->discard = (chunk_discard)choice;
    } else if (strcmp(word, "units") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, units, &choice, err));
        state->units = (chunk_units)choice;
    } else if (strcmp(word, "limit") == 0) {
        if (state->kind == BY_BIN)
            return hs_arg_refuse(args, i, "of use with bins: their width and 'bound' say how many there are", NULL,
                                 err);
        HS_TRY(hs_arg_int(args, i + 1, 0, INT32_MAX, &state->limit, err));
        HS_TRY(hs_arg_choice(args, i + 2, limits, &choice, err));
        state->is_exact_limit = choice == 1;
    }
    return HS_OK;
}

static void scale_lengths(hs_compute *compute)
{
    chunk_state *state = compute->state;
    if (state->units != UNITS_LATTICE) return;
    for (int k = 0; k < state->chunks.n_axes; ++k) {
        bins *b = &state->axis[k];
        const double spacing = compute->env->lattice->spacing[b->axis];
        b->origin *= spacing;
        b->delta *= spacing; /* bounds are not in lattice units in LAMMPS either */
    }
}

/** The bins of an axis: edges are at origin + i delta, and as few as cover the range. */
static hs_status count_bins(const hs_compute *compute, bins *b, hs_error *err)
{
    const chunk_state *state = compute->state;
    const hs_box *box = compute->env->box;
    const bool is_reduced = state->units == UNITS_REDUCED;
    const double lo = is_reduced ? 0.0 : box->lo[b->axis], hi = is_reduced ? 1.0 : box->hi[b->axis];
    const double range[2] = {b->has_bound[0] ? b->bound[0] : lo, b->has_bound[1] ? b->bound[1] : hi};
    const double from[] = {range[0], 0.5 * (range[0] + range[1]), range[1], b->origin};
    const double origin = from[b->from];
    double end[2];
    for (int k = 0; k < 2; ++k) {
        const double bound = range[k], sign = bound < origin ? -1.0 : 1.0;
        /* whole bins towards the bound; one more where these do not reach it */
        end[k] = origin + sign * trunc(fabs(bound - origin) / b->delta) * b->delta;
        if (k == 0 ? end[k] > bound : end[k] < bound) end[k] += k == 0 ? -b->delta : b->delta;
    }
    b->offset = end[0];
    b->n = (int64_t)((end[1] - end[0]) / b->delta + 0.5);
    if (b->n > 0 && b->n <= INT32_MAX) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "compute '%s' (chunk/atom): %lld bins along %s; there must be 1 to %d",
                   compute->id, (long long)b->n, axis_names[b->axis], INT32_MAX);
}

/** Number of chunks and volume of one, before atoms are looked at. */
static hs_status count_raw(hs_compute *compute, hs_error *err)
{
    chunk_state *state = compute->state;
    const hs_box *box = compute->env->box;
    double volume = 1.0;
    for (int axis = 0; axis < box->dimension; ++axis) volume *= hs_box_length(box, axis);
    if (state->kind == BY_TYPE) state->n_raw = compute->env->atoms->n_types;
    if (state->kind == BY_BIN) state->n_raw = 1;
    for (int k = 0; k < state->chunks.n_axes; ++k) {
        bins *b = &state->axis[k];
        HS_TRY(count_bins(compute, b, err));
        if (b->n > INT32_MAX / state->n_raw)
            return hs_fail(err, HS_ERROR_INPUT, "compute '%s' (chunk/atom): there are more than %d bins", compute->id,
                           INT32_MAX);
        state->n_raw *= b->n;
        volume *= state->units == UNITS_REDUCED ? b->delta : b->delta / hs_box_length(box, b->axis);
    }
    state->chunks.volume = volume;
    state->chunks.n = state->n_raw;
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    static const char *const kinds[] = {"type", "bin/1d", "bin/2d", "bin/3d", NULL};
    chunk_state *state = compute->state;
    hs_text name = {0};
    int kind, first = 1;
    if (hs_value_is_reference(args->word[0])) {
        state->kind = BY_VALUE;
        HS_TRY(hs_value_init(&state->value, compute->env, args, 0, HS_VALUE_ATOMS, err));
    } else {
        if (hs_arg_choice(args, 0, kinds, &kind, err) != HS_OK) {
            hs_error_clear(err);
            return hs_arg_refuse(args, 0, "type, bin/1d, bin/2d, bin/3d or a value per atom (c_ID, f_ID, v_name)",
                                 kinds, err);
        }
        if (kind > 0) HS_TRY(read_bins(compute, args, kind, err));
        first = 1 + 3 * kind;
    }
    const int n_fixed = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    if (n_fixed != first) return hs_arg_refuse(args, n_fixed < first ? n_fixed : first, "a keyword here", NULL, err);
    for (int i = first; i < args->n;) {
        HS_TRY(read_keyword(compute, args, i, err));
        i += strcmp(args->word[i], "bound") == 0 ? 4 : strcmp(args->word[i], "limit") == 0 ? 3 : 2;
    }
    scale_lengths(compute);
    hs_status status = hs_text_printf(&name, err, "compute %s chunk", compute->id);
    if (status == HS_OK) status = hs_memory_strdup(&state->field, hs_text_get(&name), err);
    hs_text_fini(&name);
    if (status != HS_OK) return status;
    if (state->is_kept)
        HS_TRY(hs_atoms_add_field(compute->env->atoms, state->field, (void **)&state->kept, sizeof *state->kept, false,
                                  err));
    state->chunks.is_stale = true;
    return count_raw(compute, err);
}

static void destroy(hs_compute *compute)
{
    chunk_state *state = compute->state;
    if (state->kept != NULL) hs_atoms_remove_field(compute->env->atoms, (void **)&state->kept);
    hs_value_fini(&state->value);
    HS_FREE(state->chunks.place);
    HS_FREE(state->chunks.original);
    HS_FREE(state->number);
    HS_FREE(state->region_id);
    HS_FREE(state->field);
}

/** Number of a place from 0, or -1: outside. */
static int64_t bin_of(const hs_compute *compute, int i)
{
    const chunk_state *state = compute->state;
    const hs_box *box = compute->env->box;
    int64_t place = 0;
    for (int k = 0; k < state->chunks.n_axes; ++k) {
        const bins *b = &state->axis[k];
        const double length = hs_box_length(box, b->axis);
        double x = compute->env->atoms->x[b->axis][i];
        if (box->periodic[b->axis]) {
            if (x < box->lo[b->axis]) x += length;
            if (x >= box->hi[b->axis]) x -= length;
        }
        if (state->units == UNITS_REDUCED) x = (x - box->lo[b->axis]) / length;
        const double at = floor((x - b->offset) * (1.0 / b->delta));
        const bool is_below = at < 0.0, is_above = at >= (double)b->n;
        if ((is_below || is_above) &&
            (state->discard == DISCARD_YES || (state->discard == DISCARD_MIXED && b->has_bound[is_above])))
            return -1;
        place = place * b->n + (is_below ? 0 : is_above ? b->n - 1 : (int64_t)at);
    }
    return place;
}

/** compute->atoms: numbers before they are compressed. */
static hs_status number_raw(hs_compute *compute, hs_error *err)
{
    const chunk_state *state = compute->state;
    const hs_env *env = compute->env;
    const hs_atoms *atoms = env->atoms;
    const hs_region *region = NULL;
    double *id = compute->atoms;
    if (state->region_id != NULL && (region = env->find_region(compute->env, state->region_id)) == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "compute '%s' (chunk/atom): there is no region '%s'", compute->id,
                       state->region_id);
    if (state->kind == BY_VALUE) HS_TRY(hs_value_atoms(compute->env, &state->value, id, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        if (state->kind == BY_VALUE) id[i] = id[i] >= 1.0 && id[i] < INT32_MAX ? trunc(id[i]) : 0.0;
        if (state->kind == BY_TYPE) id[i] = atoms->type[i];
        if (state->kind == BY_BIN) id[i] = (double)(bin_of(compute, i) + 1);
        if (!(atoms->mask[i] & compute->mask) || (region != NULL && !hs_region_contains(region, x))) id[i] = 0.0;
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
    chunk_state *state = compute->state;
    hs_chunks *chunks = &state->chunks;
    if (chunks->n_axes == 0) return HS_OK;
    HS_TRY(HS_GROW(chunks->place, 0, (size_t)chunks->n * (size_t)chunks->n_axes + 1, err));
    for (int64_t c = 0; c < chunks->n; ++c) {
        int64_t rest = state->chunks.is_compressed ? chunks->original[c] - 1 : c;
        if (rest < 0) continue; /* `limit exact` asked for more than there are */
        for (int k = chunks->n_axes; k-- > 0; rest /= state->axis[k].n) {
            const bins *b = &state->axis[k];
            chunks->place[c * chunks->n_axes + k] = b->offset + ((double)(rest % b->n) + 0.5) * b->delta;
        }
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
    if (state->is_kept && !state->chunks.is_stale && state->is_set_up) {
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
    state->chunks.is_stale = false;
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
    HS_TRY(hs_state_bool(kept, "is_stale", &chunks->is_stale, err));
    HS_TRY(hs_state_int64(kept, "n", &chunks->n, 1, err));
    HS_TRY(hs_state_int64(kept, "n_raw", &state->n_raw, 1, err));
    HS_TRY(hs_state_int64(kept, "n_locks", &chunks->n_locks, 1, err));
    HS_TRY(hs_state_double(kept, "volume", &chunks->volume, 1, err));
    for (int k = 0; k < chunks->n_axes; ++k) {
        const char *const offset[] = {"offset 1", "offset 2", "offset 3"}, *const n[] = {"bins 1", "bins 2", "bins 3"};
        HS_TRY(hs_state_double(kept, offset[k], &state->axis[k].offset, 1, err));
        HS_TRY(hs_state_int64(kept, n[k], &state->axis[k].n, 1, err));
    }
    if (state->chunks.is_compressed && state->is_set_up) {
        HS_TRY(hs_state_int64s(kept, "original", &chunks->original, &n_original, err));
        HS_TRY(hs_state_int64s(kept, "number", &state->number, &n_number, err));
    }
    return kept->is_reading && state->is_set_up ? place_chunks(compute, err) : HS_OK;
}

const hs_compute_style hs_compute_style_chunk_atom = {
    .about =
        {.name = "chunk/atom",
         .syntax = {.usage =
                        "type | bin/1d <axis> <origin> <delta> | bin/2d ... | bin/3d ... | <value> [keyword value ...]",
                    .n_min = 1,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "number atoms by bins, types or values, for averages over each part",
         .details =
             "The value per atom `c_ID` is the number of the chunk it belongs to, from 1; 0 for none (atoms outside of "
             "the group or the `region`). The scalar `c_ID` is the number of chunks.\n\n"
             "`type`: the atom's type. `bin/1d`, `bin/2d`, `bin/3d`: layers, columns or boxes; for each axis (x, y, z) "
             "an origin (`lower`, `center`, `upper` of the covered range, or a coordinate) and a width delta. Edges "
             "are at origin "
             "plus multiples of delta, and bins cover the box, or the `bound`; the last axis changes fastest. A value "
             "per atom (`c_ID`, `c_ID[i]`, `f_ID`, `v_name`): its whole part, if that is at least 1.\n\n"
             "With `nchunk every` bins follow the box and chunks are counted anew, though not within an averaging "
             "window. `limit N max` leaves out numbers above N, `limit N exact` makes just N chunks. `compress yes` "
             "numbers only chunks that have atoms. `discard` says what becomes of atoms outside of all bins: `mixed` "
             "puts them into the nearest bin, except beyond a bound given as a number. `ids once` keeps the first "
             "numbers, `ids nfreq` those of the first sample of each window of fix ave/chunk.",
         .example = "compute layers all chunk/atom bin/1d z lower 0.05 units reduced\n"
                    "compute grid flow chunk/atom bin/2d x lower 1.0 y lower 1.0\ncompute kinds all chunk/atom type"},
    .state_size = sizeof(chunk_state),
    .create = create,
    .destroy = destroy,
    .scalar = scalar,
    .per_atom = per_atom,
    .keep_state = keep_state,
};
