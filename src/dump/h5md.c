/* dump h5md: a binary trajectory that stays readable whatever happens to the run. */
#include <string.h>

#include "io/h5md_frames.h"
#include "style/atom_sum.h"
#include "style/dump.h"

static const char *const element_names[] = {"position", "velocity", "force", "image", "species", NULL};

typedef struct h5md_dump {
    hs_h5md_frames frames; /**< its file is owned */
    hs_observables observables;
    int deflate;
    bool is_open; /**< on all ranks */
} h5md_dump;

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

/** In H5MD's form; NULL in lj units and for what has none. */
static const char *unit_of(hs_h5md_kind kind, const hs_units *units)
{
    return kind <= HS_H5MD_FORCE ? units->h5md[kind] : NULL;
}

static void add_element(h5md_dump *self, hs_h5md_kind kind, const hs_units *units)
{
    const int k = self->frames.n_elements++;
    self->frames.kind[k] = kind;
    self->frames.element[k] = (hs_h5md_element){.name = element_names[kind],
                                                .n_columns = kind == HS_H5MD_SPECIES ? 1 : 3,
                                                .is_integer = kind == HS_H5MD_IMAGE || kind == HS_H5MD_SPECIES,
                                                .unit = unit_of(kind, units)};
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    h5md_dump *self = dump->state;
    self->frames.mask = dump->mask;
    HS_TRY(check_words(args, err));
    if (strchr(dump->file, '*') != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the file '%s' cannot have a '*': all frames go into one file",
                       args->command, dump->file);
    int n_words = 0;
    while (n_words < args->n && !hs_value_is_reference(args->word[n_words])) ++n_words;
    for (int i = 0, kind; i < n_words; ++i) {
        HS_TRY(hs_arg_choice(args, i, element_names, &kind, err));
        add_element(self, (hs_h5md_kind)kind, dump->env->units);
    }
    if (n_words < args->n)
        HS_TRY(hs_observables_create(&self->observables, dump->env, args, n_words, args->n - n_words, err));
    if (self->frames.n_elements > 0) return HS_OK;
    add_element(self, HS_H5MD_POSITION, dump->env->units);
    add_element(self, HS_H5MD_IMAGE, dump->env->units);
    return HS_OK;
}

static void destroy(hs_dump *dump)
{
    h5md_dump *self = dump->state;
    hs_error ignored = {0};
    (void)!hs_h5md_close(&self->frames.file, &ignored); /* every frame was committed when it was written */
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
    if (strcmp(keyword, "every") == 0) return hs_dump_read_every(dump, args, err);
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
    HS_TRY(hs_observables_measure(&self->observables, env, "dump h5md", err));
    const hs_h5md_plan plan = {.element = self->frames.element,
                               .n_elements = self->frames.n_elements,
                               .observable = self->observables.what,
                               .n_observables = self->observables.n,
                               .box = env->box,
                               .units = env->units,
                               .length_unit = env->units->h5md[HS_H5MD_POSITION],
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
    if (env->parallel->rank == 0) (void)!hs_h5md_open(&self->frames.file, dump->file, &plan, err);
    HS_TRY(hs_parallel_agree(env->parallel, err));
    self->is_open = true;
    self->frames.is_regular = false;
    return HS_OK;
}

static hs_status init(hs_dump *dump, hs_error *err)
{
    h5md_dump *self = dump->state;
    if (dump->env->dry_run || self->is_open) return HS_OK;
    return open_file(dump, hs_atom_count(dump->env->atoms, dump->env->parallel, dump->mask), err);
}

static hs_status write(hs_dump *dump, hs_error *err)
{
    h5md_dump *self = dump->state;
    HS_TRY(hs_h5md_frames_write(&self->frames, dump->env, &self->observables, err));
    if (!dump->is_single) return HS_OK;
    if (dump->env->parallel->rank == 0) (void)!hs_h5md_close(&self->frames.file, err);
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
             "choose what is stored of each atom of the group (default `position image`), in double precision: "
             "`position` (distance, wrapped into the box), `velocity` (distance/time), `force` (energy/distance), "
             "`image` (box lengths to add to an unwrapped position). `species` is the type; without the word it is "
             "stored once, as are `id` and `mass`. Values of the whole system come after these and go to "
             "`/observables`: numbers, `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]` and `v_name`, and where `c_ID` or `f_ID` "
             "is no number, all of the vector or array that it is. So averages with their errors are kept beside the "
             "trajectory: give the dump the Nfreq of `fix ave/time`; of a group without atoms it stores averages "
             "alone.\n\nRows are in the order of ids. An atom keeps its row; one that is gone has NaN there (the least "
             "integer for images), and atoms that come later get rows at the end. The box's edges are stored with "
             "every frame, its lower corner as `box/offset`. The deck's text, version and build stand in "
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
