/* Commands that read trajectories back: read_dump, rerun. */
#include <string.h>

#include "base/text.h"
#include "deck/command.h"
#include "sim/rerun.h"
#include "style/box_shape.h"

/** Steps are counted well within 64 bits, so that sums of them never overflow. */
static const int64_t step_max = INT64_C(1) << 60;

/* ---- The words that both have: fields, keywords, format ---- */

#define READ_KEYWORDS                                                                                                  \
    {"box", 1, "yes|no", "take over the snapshot's box (default: yes)"},                                               \
        {"timestep", 1, "yes|no", "take over its step (default: yes)"},                                                \
        {"replace", 1, "yes|no", "change atoms that are in the system and in the snapshot (default: yes)"},            \
        {"purge", 1, "yes|no", "remove all atoms first; needs `replace no` (default: no)"},                            \
        {"trim", 1, "yes|no", "remove atoms that the snapshot does not have (default: no)"},                           \
        {"add", 1, "yes|keep|no", "add atoms that the system does not have, with new ids or their own (default: no)"}, \
        {"label", 2, "<field> <column>", "read a field, `id` or `type` from this column"},                             \
        {"scaled", 1, "yes|no", "coordinates read by label are fractions of the box (default: no)"},                   \
        {"wrapped", 1, "yes|no", "coordinates read by label are within the box (default: yes)"},                       \
        {"nfile", 1, "<N>", "number of files of one snapshot: one, that is without %"},                                \
    {                                                                                                                  \
        "format", -1, "native | xyz | h5md [<group>]",                                                                 \
            "last keyword: LAMMPS's text, XYZ, or H5MD (default: native, or h5md where the file is one)"               \
    }

static const hs_keyword read_keywords[] = {READ_KEYWORDS, {0}};

static const hs_keyword rerun_keywords[] = {
    {"first", 1, "<step>", "first step to be read (default: 0)"},
    {"last", 1, "<step>", "last step to be read (default: that of the last snapshot)"},
    {"every", 1, "<N>", "only steps that are multiples of N, and the first; 0: all (default: 0)"},
    {"skip", 1, "<N>", "of these, one out of N (default: 1)"},
    {"start", 1, "<step>", "first step of the range over which `ramp` and the like change (default: first)"},
    {"stop", 1, "<step>", "last step of that range (default: last)"},
    {"post", 1, "yes|no", "timing table at the end (default: no)"},
    {"dump", -1, "<field> ... [keyword value ...]", "the last keyword: words of read_dump from its fields on"},
    {0},
};

static bool is_keyword(const hs_keyword *keywords, const char *word)
{
    for (; keywords->name != NULL; ++keywords)
        if (strcmp(keywords->name, word) == 0) return true;
    return false;
}

/** A word that is no field and no keyword. */
static hs_status refuse_word(const hs_args *args, int i, hs_error *err)
{
    enum { MAX = 64 };
    const char *words[MAX] = {NULL};
    int n = 0;
    if (is_keyword(rerun_keywords, args->word[i]) && strcmp(args->command, "rerun") == 0)
        return hs_arg_refuse(args, i, "allowed behind 'dump': all words after it are those of read_dump", NULL, err);
    for (int k = HS_FIELD_X; k < HS_N_FIELDS; ++k) words[n++] = hs_field_names[k];
    for (int k = 0; read_keywords[k].name != NULL && n < MAX - 1; ++k) words[n++] = read_keywords[k].name;
    return hs_arg_refuse(args, i, "a field (x y z vx vy vz ix iy iz) or a keyword", words, err);
}

/** Fields from word i on, up to the first keyword. */
static hs_status read_fields(const hs_args *args, int *i, hs_read_options *options, hs_error *err)
{
    static const char *const not_here[] = {"q", "fx", "fy", "fz", NULL};
    const char *const *const names = hs_field_names + HS_FIELD_X;
    const int first = *i;
    for (; *i < args->n && !is_keyword(read_keywords, args->word[*i]); ++*i) {
        int k;
        for (k = 0; not_here[k] != NULL; ++k)
            if (strcmp(args->word[*i], not_here[k]) == 0)
                return hs_arg_refuse(args, *i,
                                     k == 0 ? "a field that can be read: atoms have no charge"
                                            : "a field that can be read: forces are computed from the places",
                                     NULL, err);
        for (k = 0; names[k] != NULL && strcmp(names[k], args->word[*i]) != 0;) ++k;
        if (names[k] == NULL) return refuse_word(args, *i, err);
        if (options->plan.wants[HS_FIELD_X + k]) return hs_arg_refuse(args, *i, "allowed twice", NULL, err);
        options->plan.wants[HS_FIELD_X + k] = true;
    }
    if (*i > first) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: a field is missing: x y z vx vy vz ix iy iz", args->command);
}

static hs_status read_label(const hs_args *args, int i, hs_frames_plan *plan, hs_error *err)
{
    int field;
    HS_TRY(hs_arg_choice(args, i, hs_field_names, &field, err));
    if (plan->label[field] != NULL) return hs_arg_refuse(args, i, "allowed to have two labels", NULL, err);
    plan->label[field] = args->word[i + 1];
    if (field > HS_FIELD_TYPE && !plan->wants[field]) return hs_arg_refuse(args, i, "a field that is read", NULL, err);
    return HS_OK;
}

static hs_status read_format(const hs_args *args, int i, hs_frames_plan *plan, hs_error *err)
{
    static const char *const formats[] = {"native", "xyz", "h5md", "molfile", "adios", NULL};
    int format;
    HS_TRY(hs_arg_choice(args, i, formats, &format, err));
    if (format > 2)
        return hs_arg_refuse(args, i, "a format that can be read: native (LAMMPS's text), xyz, h5md", NULL, err);
    plan->format = format == 0 ? HS_FRAMES_NATIVE : format == 1 ? HS_FRAMES_XYZ : HS_FRAMES_H5MD;
    if (format == 2 && i + 1 < args->n) plan->group = args->word[++i];
    return i + 1 < args->n ? hs_arg_refuse(args, i + 1, "expected: 'format' is the last keyword", NULL, err) : HS_OK;
}

static hs_status read_flag(const hs_args *args, int i, hs_read_options *options, hs_error *err)
{
    const struct {
        const char *name;
        bool *flag;
    } flags[] = {{"box", &options->box},
                 {"timestep", &options->timestep},
                 {"replace", &options->replace},
                 {"purge", &options->purge},
                 {"trim", &options->trim},
                 {"scaled", &options->plan.is_scaled},
                 {"wrapped", &options->plan.is_wrapped}};
    for (size_t k = 0; k < sizeof flags / sizeof flags[0]; ++k)
        if (strcmp(flags[k].name, args->word[i]) == 0) return hs_arg_bool(args, i + 1, flags[k].flag, err);
    return hs_arg_refuse(args, i, "a keyword of it", NULL, err);
}

/** Keywords from word i to the end. */
static hs_status read_options(const hs_args *args, int i, hs_read_options *options, hs_error *err)
{
    static const char *const adding[] = {"no", "yes", "keep", NULL};
    int add = HS_ADD_NO;
    for (; i < args->n; i += 2) {
        const char *word = args->word[i];
        if (strcmp(word, "format") == 0) {
            HS_TRY(read_format(args, i + 1, &options->plan, err));
            break;
        }
        if (strcmp(word, "label") == 0) {
            HS_TRY(hs_arg_need(args, i + 2, "the field and its column after 'label'", err));
            HS_TRY(read_label(args, ++i, &options->plan, err));
        } else if (strcmp(word, "add") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, adding, &add, err));
        } else if (strcmp(word, "nfile") == 0) {
            int64_t n;
            HS_TRY(hs_arg_int(args, i + 1, 1, INT32_MAX, &n, err));
            if (n != 1) return hs_arg_refuse(args, i + 1, "1: a snapshot is read from one file", NULL, err);
        } else {
            HS_TRY(read_flag(args, i, options, err));
        }
    }
    options->add = (hs_read_add)add;
    options->plan.wants[HS_FIELD_TYPE] = options->add != HS_ADD_NO;
    options->plan.wants[HS_FIELD_ID] = true;
    if (options->purge && (options->replace || options->trim))
        return hs_fail(err, HS_ERROR_INPUT, "%s: 'purge yes' leaves no atoms to %s: it needs '%s no'", args->command,
                       options->replace ? "replace" : "trim", options->replace ? "replace" : "trim");
    return HS_OK;
}

static hs_status read_words(const hs_args *args, int i, hs_read_options *options, hs_error *err)
{
    const hs_frames_plan files = options->plan;
    *options = (hs_read_options){.box = true, .timestep = true, .replace = true, .plan = files};
    options->plan.is_wrapped = true;
    HS_TRY(read_fields(args, &i, options, err));
    HS_TRY(hs_syntax_check(&(hs_syntax){.usage = "", .keywords = read_keywords},
                           &(hs_args){args->command, args->n - i, args->word + i}, false, err));
    return read_options(args, i, options, err);
}

static hs_status refuse_percent(const hs_args *args, int i, hs_error *err)
{
    if (strchr(args->word[i], '%') == NULL) return HS_OK;
    return hs_arg_refuse(args, i, "a file that can be read: all atoms must be in one, without '%'", NULL, err);
}

/** What depends on the system. */
static hs_status check_system(const hs_sim *sim, const hs_args *args, const hs_read_options *options, hs_error *err)
{
    static const int of_z[] = {HS_FIELD_Z, HS_FIELD_VZ, HS_FIELD_IZ};
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    for (int k = 0; k < 3 && sim->box.dimension == 2; ++k)
        if (options->plan.wants[of_z[k]])
            return hs_fail(err, HS_ERROR_INPUT, "%s: the field '%s' cannot be read in two dimensions", args->command,
                           hs_field_names[of_z[k]]);
    return HS_OK;
}

/* ---- read_dump ---- */

static hs_status read_dump_words(const hs_args *args, int64_t *step, hs_read_options *options, hs_error *err)
{
    HS_TRY(refuse_percent(args, 0, err));
    HS_TRY(hs_arg_int(args, 1, 0, step_max, step, err));
    options->plan.file = args->word;
    options->plan.n_files = 1;
    return read_words(args, 2, options, err);
}

static hs_status read_dump_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int64_t step;
    hs_read_options options = {0};
    return has_variables ? HS_OK : read_dump_words(args, &step, &options, err);
}

static hs_status find_step(hs_frames *frames, const hs_args *args, int64_t step, hs_snapshot *snapshot, hs_error *err)
{
    bool is_there;
    int64_t n = 0, first = 0, last = 0;
    for (;; ++n) {
        HS_TRY(hs_frames_next(frames, snapshot, &is_there, err));
        if (is_there && snapshot->step == step) return HS_OK;
        if (!is_there) break;
        if (n == 0) first = snapshot->step;
        last = snapshot->step;
    }
    if (n == 0) return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' has no snapshots", args->command, args->word[0]);
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: '%s' has no snapshot of step %lld; the first of %lld is of step %lld, the last of %lld",
                   args->command, args->word[0], (long long)step, (long long)n, (long long)first, (long long)last);
}

static void say_counts(const hs_sim *sim, const hs_read_counts *counts)
{
    hs_box_say(sim->env.out, "  ", &sim->box);
    hs_say(sim->env.out,
           "  %lld atoms before read\n"
           "  %lld atoms in snapshot\n  %lld atoms purged\n  %lld atoms replaced\n  %lld atoms trimmed\n"
           "  %lld atoms added\n  %lld atoms after read\n",
           (long long)counts->before, (long long)counts->in_snapshot, (long long)counts->purged,
           (long long)counts->replaced, (long long)counts->trimmed, (long long)counts->added, (long long)counts->after);
}

static hs_status read_dump_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_read_options options = {0};
    hs_frames *frames = NULL;
    hs_snapshot snapshot = {0};
    hs_read_counts counts = {0};
    int64_t step;
    HS_TRY(read_dump_words(args, &step, &options, err));
    HS_TRY(check_system(sim, args, &options, err));
    if (options.timestep && step != sim->env.step) HS_TRY(hs_sim_need_no_counters(sim, args->command, err));
    hs_status status = HS_OK;
    if (!deck->options.dry_run) { /* where the deck itself writes the file, it is not there yet */
        hs_say(sim->env.out, "Scanning dump file ...\n");
        status = hs_frames_open(&frames, &options.plan, &sim->parallel, err);
        if (status == HS_OK) status = find_step(frames, args, step, &snapshot, err);
        if (status == HS_OK) hs_say(sim->env.out, "Reading snapshot from dump file ...\n");
        if (status == HS_OK) status = hs_read_snapshot(&sim->env, frames, &snapshot, &options, &counts, err);
        hs_frames_close(&frames);
        if (status == HS_OK) say_counts(sim, &counts);
    }
    HS_TRY(status);
    if (options.timestep) hs_sim_set_clock(sim, step, sim->env.dt);
    if (options.timestep) sim->env.first_step = sim->env.last_step = step;
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

/* ---- rerun ---- */

static hs_status read_numbers(const hs_args *args, int i, int end, hs_rerun_plan *plan, hs_error *err)
{
    bool has_start = false, has_stop = false;
    struct {
        const char *name;
        int64_t *value, least;
        bool *is_given;
    } numbers[] = {{"first", &plan->first, 0, NULL},       {"last", &plan->last, 0, NULL},
                   {"every", &plan->every, 0, NULL},       {"skip", &plan->skip, 1, NULL},
                   {"start", &plan->start, 0, &has_start}, {"stop", &plan->stop, 0, &has_stop}};
    for (; i < end; i += 2) {
        for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; ++k) {
            if (strcmp(args->word[i], numbers[k].name) != 0) continue;
            HS_TRY(hs_arg_int(args, i + 1, numbers[k].least, step_max, numbers[k].value, err));
            if (numbers[k].is_given != NULL) *numbers[k].is_given = true;
        }
        if (strcmp(args->word[i], "post") == 0) HS_TRY(hs_arg_bool(args, i + 1, &plan->post, err));
    }
    if (!has_start) plan->start = plan->first;
    if (!has_stop) plan->stop = plan->last;
    if (plan->last < plan->first || plan->start > plan->first || plan->stop < plan->start)
        return hs_fail(err, HS_ERROR_INPUT, "%s: start, first, last and stop must follow one another", args->command);
    return HS_OK;
}

/** A number among the files: the word before it was meant as a keyword. */
static hs_status refuse_file(const hs_args *args, int i, hs_error *err)
{
    const hs_args words = hs_args_from(args, i, NULL);
    const hs_syntax syntax = {.usage = "<file> ... [keyword value ...] dump <field> ...", .keywords = rerun_keywords};
    return hs_syntax_check(&syntax, &words, false, err);
}

static hs_status read_rerun(const hs_args *args, hs_rerun_plan *plan, hs_error *err)
{
    int first = 0, dump = 0;
    int64_t number;
    *plan = (hs_rerun_plan){.last = step_max, .skip = 1};
    while (first < args->n && !is_keyword(rerun_keywords, args->word[first])) ++first;
    while (dump < args->n && strcmp(args->word[dump], "dump") != 0) ++dump;
    if (first == 0) return hs_fail(err, HS_ERROR_INPUT, "%s: the name of a file is missing", args->command);
    if (dump >= args->n)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the keyword 'dump' and the fields to be read are missing, as in 'dump x y z'",
                       args->command);
    for (int i = 0; i < first; ++i) {
        HS_TRY(refuse_percent(args, i, err));
        if (i > 0 && hs_text_to_int64(args->word[i], &number)) return refuse_file(args, i - 1, err);
    }
    HS_TRY(read_numbers(args, first, dump, plan, err));
    plan->read.plan.file = args->word;
    plan->read.plan.n_files = first;
    HS_TRY(read_words(args, dump + 1, &plan->read, err));
    if (plan->read.timestep) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: 'timestep no' makes no sense here: steps are those of the snapshots",
                   args->command);
}

static hs_status rerun_check(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_rerun_plan plan;
    return has_variables ? HS_OK : read_rerun(args, &plan, err);
}

static hs_status rerun_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_rerun_plan plan;
    HS_TRY(read_rerun(args, &plan, err));
    HS_TRY(check_system(deck->sim, args, &plan.read, err));
    if (deck->options.dry_run) return hs_sim_setup(deck->sim, err);
    deck->is_running = true;
    const hs_status status = hs_sim_rerun(deck->sim, &plan, err);
    deck->is_running = false;
    return status;
}

const hs_command hs_commands_rerun[] = {
    {.about = {.name = "read_dump",
               .syntax = {"<file> <Nstep> <field> ... [keyword value ...]", 3, -1, read_keywords},
               .summary = "Take atoms over from a snapshot of a trajectory",
               .details = "Reads the snapshot of step Nstep: the fields x y z, vx vy vz, ix iy iz (image flags) of "
                          "atoms that are known by their ids, the box and the step. The file is a text dump of LAMMPS "
                          "or of this program (styles atom and custom, also `.gz`), an XYZ file (steps are numbers of "
                          "snapshots from 0 on, atoms are numbered in their order, and `box no` is needed), or an H5MD "
                          "file (of /particles the only group, `all`, or the one named).\n\n"
                          "x may be a column x, xs, xu or xsu, that is scaled to the box or not, wrapped or not; image "
                          "flags of unwrapped places begin at 0. Places are brought into the box. Atoms that are added "
                          "have the defaults of `create_atoms` where there is no field; their types are read.\n\n"
                          "A snapshot that is not whole is an error that names the line, so are ids that come twice "
                          "and numbers that are not finite.",
               .example = "read_dump run.dump 5000 x y z vx vy vz\nread_dump run.h5 5000 x y z\n"
                          "read_dump start.xyz 0 x y z box no purge yes replace no add keep format xyz"},
     .run = read_dump_run,
     .check = read_dump_check},
    {.about = {.name = "rerun",
               .syntax = {"<file> ... [keyword value ...] dump <field> ... [keyword value ...]", 1, -1, rerun_keywords},
               .summary = "Energies, forces and output of the snapshots of trajectories",
               .details = "Each snapshot is read as `read_dump` does it, and forces, computes, averages, thermo output "
                          "and dumps are made as if a run were at its step, perhaps with another potential or with "
                          "other measures than the run that wrote the file. Files follow one another; a snapshot that "
                          "is not after the one before is passed over. Fixes are asked for forces and samples; none "
                          "moves atoms. The samples of averaging fixes must fit the steps of the snapshots. The first "
                          "and the last snapshot have rows in the table, those between where `thermo` says so.\n\n"
                          "No checkpoints are written: a rerun can be begun anew at any step.",
               .example = "rerun run.dump dump x y z vx vy vz\n"
                          "rerun run.1.dump.gz run.2.dump.gz first 1000 every 500 dump x y z\nrerun run.h5 dump x y z"},
     .run = rerun_run,
     .check = rerun_check},
    {.about = {.name = NULL}},
};
