/* dump h5md: a binary trajectory that stays readable whatever happens to the run. */
#include <string.h>

#include "base/memory.h"
#include "io/observables.h"
#include "io/rows.h"
#include "style/dump.h"

typedef enum { POSITION, VELOCITY, FORCE, IMAGE, SPECIES, N_ELEMENTS } element_kind;

static const char *const element_names[] = {"position", "velocity", "force", "image", "species", NULL};

typedef struct h5md_dump {
    int n_elements;
    element_kind kind[N_ELEMENTS];
    hs_h5md_element element[N_ELEMENTS];
    hs_observables observables;
    int deflate;
    bool is_open;  /**< on all ranks */
    hs_h5md *file; /**< owned; rank 0 only */
    /* Atoms of the latest frame: while they are the same, and row k is the k-th of them by id, no ids need be looked up. */
    bool is_regular;
    int64_t n_atoms, id_sum;
} h5md_dump;

static const char dump_command[] = "dump h5md";

static hs_status check_words(const hs_args *args, hs_error *err)
{
    bool is_behind = false;
    for (int i = 0; i < args->n; ++i) {
        int kind;
        if (strchr(args->word[i], '$') != NULL) continue;
        is_behind = is_behind || hs_value_is_reference(args->word[i]);
        if (hs_value_is_reference(args->word[i])) continue;
        if (is_behind) return hs_arg_refuse(args, i, "one of c_ID, f_ID, v_name, which come last", NULL, err);
        const hs_status status = hs_arg_choice(args, i, element_names, &kind, err);
        if (status != HS_OK) return status;
        for (int k = 0; k < i; ++k)
            if (strcmp(args->word[k], args->word[i]) == 0) return hs_arg_refuse(args, i, "allowed twice", NULL, err);
    }
    return HS_OK;
}

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    (void)file;
    return check_words(args, err);
}

/** In H5MD's form; NULL in lj units and for what has none. Real and metal units share the Angstrom. */
static const char *unit_of(element_kind kind, const hs_units *units)
{
    static const char *const of_real[] = {"Angstrom", "Angstrom fs-1", "kcal mol-1 Angstrom-1"}, *const of_metal[] = {
                                                                                                     "Angstrom",
                                                                                                     "Angstrom ps-1",
                                                                                                     "eV Angstrom-1"};
    if (kind > FORCE) return NULL;
    if (strcmp(units->name, "real") == 0) return of_real[kind];
    return strcmp(units->name, "metal") == 0 ? of_metal[kind] : NULL;
}

static void add_element(h5md_dump *self, element_kind kind, const hs_units *units)
{
    const int k = self->n_elements++;
    self->kind[k] = kind;
    self->element[k] = (hs_h5md_element){.name = element_names[kind],
                                         .n_columns = kind == SPECIES ? 1 : 3,
                                         .is_integer = kind == IMAGE || kind == SPECIES,
                                         .unit = unit_of(kind, units)};
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    h5md_dump *self = dump->state;
    HS_TRY(check_words(args, err));
    if (strchr(dump->file, '*') != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the file '%s' cannot have a '*': all frames go into one file",
                       args->command, dump->file);
    int n_words = 0;
    while (n_words < args->n && !hs_value_is_reference(args->word[n_words])) ++n_words;
    for (int i = 0, kind; i < n_words; ++i) {
        HS_TRY(hs_arg_choice(args, i, element_names, &kind, err));
        add_element(self, (element_kind)kind, dump->env->units);
    }
    if (n_words < args->n)
        HS_TRY(hs_observables_create(&self->observables, dump->env, args, n_words, args->n - n_words, err));
    if (self->n_elements > 0) return HS_OK;
    add_element(self, POSITION, dump->env->units);
    add_element(self, IMAGE, dump->env->units);
    return HS_OK;
}

static void destroy(hs_dump *dump)
{
    h5md_dump *self = dump->state;
    hs_error ignored = {0};
    (void)!hs_h5md_close(&self->file, &ignored); /* every frame was committed when it was written */
    hs_observables_fini(&self->observables);
}

static hs_status modify(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    h5md_dump *self = dump->state;
    int64_t level;
    bool ignored;
    *n_used = 2;
    HS_TRY(hs_arg_need(args, 1, "the value after the keyword", err));
    const char *keyword = args->word[0];
    if (strcmp(keyword, "every") == 0) return hs_arg_int(args, 1, 1, INT64_MAX, &dump->every, err);
    if (strcmp(keyword, "first") == 0) return hs_arg_bool(args, 1, &dump->write_first, err);
    if (strcmp(keyword, "flush") == 0 || strcmp(keyword, "buffer") == 0) return hs_arg_bool(args, 1, &ignored, err);
    if (strcmp(keyword, "sort") == 0) {
        static const char *const words[] = {"id", NULL};
        return strcmp(args->word[1], "id") == 0
                   ? HS_OK
                   : hs_arg_refuse(args, 1, "id, the only order of rows in this style", words, err);
    }
    const bool is_append = strcmp(keyword, "append") == 0, is_compress = strcmp(keyword, "compress") == 0;
    if ((is_append || is_compress) && self->is_open)
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s must be set before the first run of the dump", args->command,
                       keyword);
    if (is_append) return hs_arg_bool(args, 1, &dump->append, err);
    if (is_compress) {
        HS_TRY(hs_arg_int(args, 1, 0, 9, &level, err));
        self->deflate = (int)level;
        return HS_OK;
    }
    *n_used = 0;
    return HS_OK;
}

/* ---- Files and frames ---- */

static hs_status open_file(hs_dump *dump, int64_t n_rows, hs_error *err)
{
    h5md_dump *self = dump->state;
    hs_env *env = dump->env;
    HS_TRY(hs_observables_measure(&self->observables, env, dump_command, err));
    const hs_h5md_plan plan = {.element = self->element,
                               .n_elements = self->n_elements,
                               .observable = self->observables.what,
                               .n_observables = self->observables.n,
                               .box = env->box,
                               .units = env->units,
                               .length_unit = strcmp(env->units->name, "lj") == 0 ? NULL : "Angstrom",
                               .time_unit = strcmp(env->units->name, "lj") == 0 ? NULL : env->units->time,
                               .version = HALFSHELL_VERSION,
                               .build = HALFSHELL_BUILD,
                               .deck = env->deck_text != NULL ? env->deck_text(env->deck) : NULL,
                               .n_rows = n_rows,
                               .deflate = self->deflate,
                               .is_single = dump->is_single,
                               .append = dump->append,
                               .step = env->step,
                               .drops_later = dump->is_resumed};
    if (env->parallel->rank == 0) (void)!hs_h5md_open(&self->file, dump->file, &plan, err);
    HS_TRY(hs_parallel_agree(env->parallel, err));
    self->is_open = true;
    self->is_regular = false;
    return HS_OK;
}

static hs_status init(hs_dump *dump, hs_error *err)
{
    h5md_dump *self = dump->state;
    if (dump->env->dry_run || self->is_open) return HS_OK;
    int64_t n = 0;
    for (int i = 0; i < dump->env->atoms->n_local; ++i) n += (dump->env->atoms->mask[i] & dump->mask) != 0;
    hs_parallel_sum_int64(dump->env->parallel, &n, 1);
    return open_file(dump, n, err);
}

/** A number that is another for other sets of ids, whatever their order. */
static int64_t sum_of_ids(const hs_atoms *atoms, uint32_t mask)
{
    uint64_t sum = 0;
    for (int i = 0; i < atoms->n_local; ++i) {
        if ((atoms->mask[i] & mask) == 0) continue;
        uint64_t z = (uint64_t)atoms->id[i] * UINT64_C(0x9e3779b97f4a7c15);
        z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
        sum += z ^ (z >> 31);
    }
    return (int64_t)(sum & INT64_MAX) >> 16; /* the sum over ranks must not overflow */
}

/** Room for one block on this rank. */
typedef struct block {
    void *mine; /**< owned; [n_mine] */
    void *all;  /**< owned on rank 0 of several ranks, else mine: [n_block] */
    size_t n_bytes;
} block;

static hs_status fit_block(block *b, const hs_rows *rows, hs_error *err)
{
    const size_t n_bytes = 3 * sizeof(double) * (size_t)rows->n_block;
    if (n_bytes > b->n_bytes) {
        if (b->all != b->mine) HS_FREE(b->all);
        HS_FREE(b->mine);
        b->all = NULL;
        b->n_bytes = 0;
        if (hs_memory_alloc(&b->mine, n_bytes, 1, err) == HS_OK) b->n_bytes = n_bytes;
        b->all = b->mine;
        if (rows->parallel->n_ranks > 1) {
            b->all = NULL;
            if (rows->parallel->rank == 0 && hs_memory_alloc(&b->all, n_bytes, 1, err) != HS_OK) b->n_bytes = 0;
        }
    }
    return hs_parallel_agree(rows->parallel, err);
}

static void free_block(block *b)
{
    if (b->all != b->mine) HS_FREE(b->all);
    HS_FREE(b->mine);
}

/** Ids of the block's rows on rank 0. */
static hs_status gather_ids(const hs_atoms *atoms, hs_rows *rows, int64_t *mine, int64_t *all, hs_error *err)
{
    for (int k = 0; k < rows->n_mine; ++k) mine[k] = atoms->id[rows->mine[k]];
    return hs_rows_gather(rows, mine, sizeof *mine, all, err);
}

/** On rank 0: rows for those atoms of the block that have none. Called with the gathered ids and types. */
static hs_status add_rows(hs_dump *dump, int n, int64_t *id, int32_t *type, double *mass, hs_error *err)
{
    h5md_dump *self = dump->state;
    int n_new = 0;
    for (int k = 0; k < n; ++k) {
        if (hs_h5md_row(self->file, id[k]) >= 0) continue;
        id[n_new] = id[k];
        type[n_new] = type[k];
        mass[n_new++] = dump->env->atoms->mass[type[k]];
    }
    if (n_new == 0) return HS_OK;
    const hs_h5md_rows rows = {.id = id, .species = type, .mass = mass};
    return hs_h5md_set_rows(self->file, hs_h5md_n_rows(self->file), n_new, &rows, err);
}

/** All atoms of this frame have rows after this (collective). */
static hs_status find_rows(hs_dump *dump, hs_error *err)
{
    h5md_dump *self = dump->state;
    const hs_env *env = dump->env;
    const bool is_root = env->parallel->rank == 0;
    hs_rows rows = {0};
    block ids = {0}, types = {0}, masses = {0};
    if (is_root) (void)!hs_h5md_index(self->file, err);
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) status = hs_rows_begin(&rows, env->parallel, env->atoms, dump->mask, err);
    while (status == HS_OK && hs_rows_next(&rows, &status, err)) {
        status = fit_block(&ids, &rows, err);
        if (status == HS_OK) status = fit_block(&types, &rows, err);
        if (status == HS_OK) status = fit_block(&masses, &rows, err);
        if (status == HS_OK) status = gather_ids(env->atoms, &rows, ids.mine, ids.all, err);
        int32_t *type = types.mine;
        for (int k = 0; k < rows.n_mine && status == HS_OK; ++k) type[k] = env->atoms->type[rows.mine[k]];
        if (status == HS_OK) status = hs_rows_gather(&rows, types.mine, sizeof(int32_t), types.all, err);
        if (status == HS_OK && is_root) (void)!add_rows(dump, rows.n_block, ids.all, types.all, masses.mine, err);
        status = hs_parallel_agree(env->parallel, err);
    }
    if (status == HS_OK && is_root) (void)!hs_h5md_index(self->file, err);
    free_block(&ids);
    free_block(&types);
    free_block(&masses);
    hs_rows_end(&rows);
    return hs_parallel_agree(env->parallel, err);
}

static void pack_vectors(double *const from[3], const hs_rows *rows, double *mine)
{
#pragma omp parallel for schedule(static)
    for (int k = 0; k < rows->n_mine; ++k)
        for (int axis = 0; axis < 3; ++axis) mine[3 * k + axis] = from[axis][rows->mine[k]];
}

/** Positions in the box (or, with is_image, the images that go with them). */
static void pack_wrapped(const hs_env *env, const hs_rows *rows, bool is_image, void *mine)
{
    const hs_atoms *atoms = env->atoms;
    double *real = mine;
    int32_t *whole = mine;
#pragma omp parallel for schedule(static)
    for (int k = 0; k < rows->n_mine; ++k) {
        const int i = rows->mine[k];
        double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        int32_t image[3] = {0, 0, 0};
        hs_box_wrap(env->box, x, image);
        for (int axis = 0; axis < 3; ++axis) {
            if (is_image)
                whole[3 * k + axis] = image[axis] + atoms->image[axis][i];
            else
                real[3 * k + axis] = x[axis];
        }
    }
}

/** This rank's values of an element. */
static void pack(const hs_env *env, element_kind kind, const hs_rows *rows, void *mine)
{
    switch (kind) {
    case POSITION:
    case IMAGE:
        pack_wrapped(env, rows, kind == IMAGE, mine);
        return;
    case VELOCITY:
        pack_vectors(env->atoms->v, rows, mine);
        return;
    case FORCE:
        pack_vectors(env->atoms->f, rows, mine);
        return;
    default:
        for (int k = 0; k < rows->n_mine; ++k) ((int32_t *)mine)[k] = env->atoms->type[rows->mine[k]];
    }
}

/** On rank 0: values of the block into their rows, in runs of rows that follow one another. */
static hs_status put_block(h5md_dump *self, int element, const hs_rows *rows, const int64_t *id, const char *values,
                           size_t size, hs_error *err)
{
    if (self->is_regular) return hs_h5md_put_rows(self->file, element, rows->first_row, rows->n_block, values, err);
    for (int begin = 0, end; begin < rows->n_block; begin = end) {
        const int64_t first = hs_h5md_row(self->file, id[begin]);
        for (end = begin + 1; end < rows->n_block && hs_h5md_row(self->file, id[end]) == first + (end - begin);) ++end;
        HS_TRY(hs_h5md_put_rows(self->file, element, first, end - begin, values + size * (size_t)begin, err));
    }
    return HS_OK;
}

static hs_status write_block(hs_dump *dump, hs_rows *rows, block *ids, block *values, bool *is_regular, hs_error *err)
{
    h5md_dump *self = dump->state;
    const bool is_root = dump->env->parallel->rank == 0;
    HS_TRY(fit_block(values, rows, err));
    HS_TRY(fit_block(ids, rows, err));
    if (!self->is_regular) HS_TRY(gather_ids(dump->env->atoms, rows, ids->mine, ids->all, err));
    for (int k = 0; k < rows->n_block && is_root && !self->is_regular; ++k)
        *is_regular = *is_regular && hs_h5md_row(self->file, ((int64_t *)ids->all)[k]) == rows->first_row + k;
    for (int element = 0; element < self->n_elements; ++element) {
        const size_t size = (self->element[element].is_integer ? sizeof(int32_t) : sizeof(double)) *
                            (size_t)self->element[element].n_columns;
        pack(dump->env, self->kind[element], rows, values->mine);
        HS_TRY(hs_rows_gather(rows, values->mine, size, values->all, err));
        if (is_root) (void)!put_block(self, element, rows, ids->all, values->all, size, err);
        HS_TRY(hs_parallel_agree(dump->env->parallel, err));
    }
    return HS_OK;
}

static hs_status write_frame(hs_dump *dump, hs_error *err)
{
    h5md_dump *self = dump->state;
    const hs_env *env = dump->env;
    const bool is_root = env->parallel->rank == 0;
    const double time = env->time_origin + (double)(env->step - env->time_origin_step) * env->dt;
    hs_rows rows = {0};
    block ids = {0}, values = {0};
    bool is_regular = true;
    if (is_root) (void)!hs_h5md_begin_frame(self->file, env->step, time, env->box, err);
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) status = hs_observables_write(&self->observables, dump->env, self->file, dump_command, err);
    if (status == HS_OK) status = hs_rows_begin(&rows, env->parallel, env->atoms, dump->mask, err);
    while (status == HS_OK && hs_rows_next(&rows, &status, err))
        status = write_block(dump, &rows, &ids, &values, &is_regular, err);
    if (status == HS_OK && is_root) {
        (void)!hs_h5md_end_frame(self->file, err);
        is_regular = is_regular && rows.n_all == hs_h5md_n_rows(self->file);
    }
    status = hs_parallel_agree(env->parallel, err);
    int64_t is_regular_all = is_root && is_regular;
    hs_parallel_max_int64(env->parallel, &is_regular_all, 1);
    self->is_regular = is_regular_all != 0;
    free_block(&ids);
    free_block(&values);
    hs_rows_end(&rows);
    return status;
}

static hs_status write(hs_dump *dump, hs_error *err)
{
    h5md_dump *self = dump->state;
    int64_t now[2] = {0, sum_of_ids(dump->env->atoms, dump->mask)};
    for (int i = 0; i < dump->env->atoms->n_local; ++i) now[0] += (dump->env->atoms->mask[i] & dump->mask) != 0;
    hs_parallel_sum_int64(dump->env->parallel, now, 2);
    self->is_regular = self->is_regular && now[0] == self->n_atoms && now[1] == self->id_sum;
    self->n_atoms = now[0];
    self->id_sum = now[1];
    if (!self->is_regular) HS_TRY(find_rows(dump, err));
    HS_TRY(write_frame(dump, err));
    if (!dump->is_single) return HS_OK;
    if (dump->env->parallel->rank == 0) (void)!hs_h5md_close(&self->file, err);
    return hs_parallel_agree(dump->env->parallel, err);
}

const hs_dump_style hs_dump_style_h5md = {
    .about =
        {.name = "h5md",
         .syntax = {.usage = "[position | velocity | force | image | species] ... [c_ID | f_ID | v_name] ...",
                    .n_min = 0,
                    .n_max = -1},
         .summary = "a binary trajectory in the H5MD 1.1 format",
         .details =
             "One HDF5 file for all frames, read by h5py, MDAnalysis, h5dump and every other HDF5 tool. The words "
             "choose "
             "what is stored of each atom of the group (default `position image`), in double precision: `position` "
             "(distance, wrapped into the box), `velocity` (distance/time), `force` (energy/distance), `image` (box "
             "lengths to add to an unwrapped position). `species` is the type; without the word it is stored once, as "
             "are `id` and `mass`. Values of the whole system come after these and go to `/observables`: numbers, "
             "`c_ID`, "
             "`c_ID[i]`, `f_ID`, `f_ID[i]` and `v_name`, and where `c_ID` or `f_ID` is no number, all of the vector "
             "or array that it is. So averages with their errors are kept beside the trajectory: give the dump the "
             "Nfreq of `fix ave/time`; of a group without atoms it stores averages alone.\n\nRows are in the order of "
             "ids. An atom keeps its row; one that "
             "is gone has NaN "
             "there (the least integer for images), and atoms that come later get rows at the end. The box's edges are "
             "stored with every frame, its lower corner as `box/offset`. The deck's text, version and build stand in "
             "`/parameters/halfshell`. In `units lj` nothing has a unit: MDAnalysis needs `convert_units=False`.\n\n"
             "A frame is added to the file as a whole: after a crash, a kill or with a full disk the file opens with "
             "all frames up to the last or the one before. It may be read while the run goes on. `dump_modify` knows "
             "`append`, `compress`, `every`, `first`, `sort id`.",
         .reference = "P. de Buyl, P. H. Colberg, F. Höfling, Comput. Phys. Commun. 185, 1546 (2014), "
                      "doi:10.1016/j.cpc.2014.01.018",
         .example = "dump t all h5md 1000 run.h5\ndump t all h5md 1000 run.h5 position velocity image c_thermo_press\n"
                    "group none empty\nfix g all ave/time 10 100 1000 c_rdf[*] mode vector error yes\n"
                    "dump a none h5md 1000 averages.h5 f_g\ndump_modify t append yes compress 4"},
    .state_size = sizeof(h5md_dump),
    .check = check,
    .create = create,
    .modify = modify,
    .destroy = destroy,
    .init = init,
    .write = write,
};
