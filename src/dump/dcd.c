/* dump dcd: positions in the binary format of CHARMM and NAMD, one record for each axis, which most viewers read.
 *
 * Every record stands between two 32-bit numbers, its length in bytes. The head is three records (84 bytes of numbers, two
 * lines of text, the number of atoms); a frame is the box (six doubles) and the x, the y and the z of all atoms (floats).
 * All frames have one size, so the file's size tells how many there are; the head's number of frames and last step are
 * put right when a frame is whole. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"
#include "io/rows.h"

/** The head as it is in the file: records with their lengths before and after. */
typedef struct dcd_head {
    int32_t numbers_begin;
    char magic[4];
    int32_t n_frames, first_step, every, last_step, unused_1[5];
    float dt;
    int32_t has_box, unused_2[8], version, numbers_end;
    int32_t text_begin, n_lines;
    char line[2][80];
    int32_t text_end;
    int32_t n_atoms_begin, n_atoms, n_atoms_end;
} dcd_head;

_Static_assert(sizeof(dcd_head) == 92 + 172 + 12, "the head of a dcd file has no gaps");

/** Lengths before and after stand in 32 bits with a sign. */
enum { N_ATOMS_MAX = INT32_MAX / 4, RECORD_ENDS = 8, BOX_SIZE = 6 * 8 };

typedef struct dcd_dump {
    hs_dump_table table; /**< schedule and file; must be first */
    dcd_head head;       /**< of the file so far, on the first rank */
    int64_t n_atoms;     /**< of every frame, -1: none was written */
    int64_t every;       /**< steps between frames, as the head says; 0: nothing was written */
    bool is_unwrapped;
    bool is_irregular; /**< said: steps of frames are not those that follow from the head */
} dcd_dump;

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    const size_t n = strlen(file);
    if (strchr(file, '*') != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the file '%s' cannot have a '*': all frames go into one file",
                       args->command, file);
    if (n > 3 && strcmp(file + n - 3, ".gz") == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the file '%s' cannot be compressed: the head is written anew with each frame",
                       args->command, file);
    return HS_OK;
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    dcd_dump *self = dump->state;
    HS_TRY(check(dump->file, args, err));
    self->table.delay = self->table.max_files = -1;
    self->n_atoms = -1;
    return HS_OK;
}

static hs_status modify(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    static const char *const shared[] = {"append", "buffer", "delay", "first", "flush", "pbc", NULL};
    dcd_dump *self = dump->state;
    const char *keyword = args->word[0];
    *n_used = 2;
    if (strcmp(keyword, "unwrap") == 0) return hs_arg_bool(args, 1, &self->is_unwrapped, err);
    if (strcmp(keyword, "every") == 0) {
        int64_t every;
        HS_TRY(hs_arg_int(args, 1, 1, INT32_MAX, &every, err));
        if (self->every != 0 && every != self->every)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: every %lld: the file's head says that there are %lld steps between frames; a dump into "
                           "another file can have its own",
                           args->command, (long long)every, (long long)self->every);
        return hs_dump_read_every(dump, args, err);
    }
    if (strcmp(keyword, "sort") == 0) {
        static const char *const words[] = {"id", NULL};
        HS_TRY(hs_arg_need(args, 1, "id", err));
        return strcmp(args->word[1], "id") == 0
                   ? HS_OK
                   : hs_arg_refuse(args, 1, "id, the only order of atoms in this style", words, err);
    }
    for (const char *const *name = shared; *name != NULL; ++name)
        if (strcmp(*name, keyword) == 0) return hs_dump_table_modify(dump, args, n_used, err);
    *n_used = 0;
    return HS_OK;
}

/* ---- The file ---- */

static int64_t frame_size(int64_t n_atoms) { return RECORD_ENDS + BOX_SIZE + 3 * (RECORD_ENDS + 4 * n_atoms); }

static dcd_head make_head(const hs_dump *dump, int64_t n_atoms)
{
    const hs_env *env = dump->env;
    dcd_head head = {.numbers_begin = 84,
                     .magic = {'C', 'O', 'R', 'D'},
                     .first_step = (int32_t)env->step,
                     .every = (int32_t)dump->every,
                     .dt = (float)env->dt,
                     .has_box = 1,
                     .version = 24,
                     .numbers_end = 84,
                     .text_begin = 164,
                     .n_lines = 2,
                     .text_end = 164,
                     .n_atoms_begin = 4,
                     .n_atoms = (int32_t)n_atoms,
                     .n_atoms_end = 4};
    char line[2][sizeof head.line[0] + 1];
    snprintf(line[0], sizeof line[0], "%-80s", "Created by Halfshell");
    snprintf(line[1], sizeof line[1], "%-80s", "REMARKS units");
    memcpy(line[1] + sizeof "REMARKS units", env->units->name, strlen(env->units->name));
    for (int k = 0; k < 2; ++k) memcpy(head.line[k], line[k], sizeof head.line[k]);
    return head;
}

/** First rank: the head of a file that is added to, and whether frames of ours fit behind it. */
static hs_status read_head(hs_dump *dump, int64_t size, hs_error *err)
{
    dcd_dump *self = dump->state;
    dcd_head *head = &self->head;
    FILE *file = fopen(dump->file, "rb");
    const size_t n = file != NULL ? fread(head, sizeof *head, 1, file) : 0;
    if (file != NULL) fclose(file);
    const dcd_head like = make_head(dump, head->n_atoms);
    const bool is_known = n == 1 && head->n_atoms >= 0 && head->n_atoms <= N_ATOMS_MAX && head->has_box == 1 &&
                          head->every > 0 &&
                          memcmp(&head->numbers_begin, &like.numbers_begin, offsetof(dcd_head, n_frames)) == 0 &&
                          memcmp(&head->text_begin, &like.text_begin, 8) == 0 &&
                          memcmp(&head->text_end, &like.text_end, sizeof like - offsetof(dcd_head, text_end)) == 0;
    const int64_t behind = size - (int64_t)sizeof *head;
    if (!is_known || behind <= 0 || behind % frame_size(head->n_atoms) != 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: '%s' is not a dcd file of whole frames with boxes, as dump dcd writes them; it cannot be added to",
            hs_dump_who(dump).text, dump->file);
    if (head->every != dump->every)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: '%s' has frames of every %d steps, the dump of every %lld; all of a file must have one interval",
            hs_dump_who(dump).text, dump->file, (int)head->every, (long long)dump->every);
    const int64_t n_frames = behind / frame_size(head->n_atoms);
    self->n_atoms = head->n_atoms;
    head->n_frames = (int32_t)n_frames;
    head->last_step = (int32_t)(head->first_step + head->every * (n_frames - 1));
    return HS_OK;
}

/** First rank: number of frames and last step in the file's head. */
static hs_status patch_head(dcd_dump *self, hs_error *err)
{
    const dcd_head *head = &self->head;
    return hs_writer_patch(self->table.writer, offsetof(dcd_head, n_frames), (const char *)&head->n_frames,
                           offsetof(dcd_head, unused_1) - offsetof(dcd_head, n_frames), err);
}

/** First rank. A resumed run goes on behind the frames that were there at the checkpoint. */
static hs_status open_growing(hs_dump *dump, hs_error *err)
{
    dcd_dump *self = dump->state;
    hs_writer **writer = &self->table.writer;
    self->n_atoms = -1;
    HS_TRY(hs_writer_open(writer, dump->file, dump->append ? HS_WRITE_APPEND : HS_WRITE_REPLACE, err));
    if (dump->is_resumed && dump->resume_at >= 0) HS_TRY(hs_writer_cut(*writer, dump->resume_at, err));
    const int64_t size = hs_writer_committed(*writer);
    if (size == 0) return HS_OK;
    HS_TRY(read_head(dump, size, err));
    return patch_head(self, err);
}

static hs_status init(hs_dump *dump, hs_error *err)
{
    dcd_dump *self = dump->state;
    hs_dump_table *table = &self->table;
    const hs_parallel *parallel = dump->env->parallel;
    if (dump->env->dry_run || dump->is_single || table->is_open) return HS_OK;
    if (parallel->rank == 0) HS_UNLESS_FAILED(err, open_growing(dump, err));
    HS_TRY(hs_parallel_agree(parallel, err));
    hs_parallel_max_int64(parallel, &self->n_atoms, 1);
    self->every = self->n_atoms >= 0 ? dump->every : 0;
    table->is_open = true;
    return HS_OK;
}

/* ---- Frames ---- */

/** Lengths of the edges and cosines of the angles between them, in the format's order. */
static void describe_box(const hs_box *box, double cell[6])
{
    const double *h = box->tilt; /* xy xz yz */
    const double a = hs_box_length(box, 0), y = hs_box_length(box, 1), z = hs_box_length(box, 2);
    const double b = sqrt(y * y + h[0] * h[0]), c = sqrt(z * z + h[1] * h[1] + h[2] * h[2]);
    cell[0] = a;
    cell[2] = b;
    cell[5] = c;
    cell[1] = h[0] / b;                           /* gamma, between a and b */
    cell[3] = h[1] / c;                           /* beta, between a and c */
    cell[4] = (h[0] * h[1] + y * h[2]) / (b * c); /* alpha, between b and c */
}

static hs_status put(hs_writer *writer, const void *bytes, size_t n, hs_error *err)
{
    return writer != NULL ? hs_writer_bytes(writer, bytes, n, err) : HS_OK;
}

/** The length of a record, before and behind it. */
static hs_status put_length(hs_writer *writer, int64_t n_bytes, hs_error *err)
{
    const int32_t length = (int32_t)n_bytes;
    return put(writer, &length, sizeof length, err);
}

static void fill(const hs_dump *dump, const hs_rows *rows, int axis, float *mine)
{
    const dcd_dump *self = dump->state;
    const hs_attribute attribute = (hs_attribute)((self->is_unwrapped ? HS_ATTR_XU : HS_ATTR_X) + axis);
#pragma omp parallel for schedule(static)
    for (int k = 0; k < rows->n_mine; ++k)
        mine[k] = (float)hs_attribute_value(dump->env, attribute, dump->wrap, rows->mine[k]);
}

/** One coordinate of all atoms (collective). */
static hs_status write_axis(hs_dump *dump, hs_rows *rows, int axis, hs_writer *writer, float *block[2], hs_error *err)
{
    hs_status status = HS_OK;
    HS_UNLESS_FAILED(err, put_length(writer, 4 * rows->n_all, err));
    hs_rows_again(rows);
    while (status == HS_OK && hs_rows_next(rows, &status, err)) {
        fill(dump, rows, axis, block[0]);
        status = hs_rows_gather(rows, block[0], sizeof **block, block[1], err);
        if (status == HS_OK) HS_UNLESS_FAILED(err, put(writer, block[1], sizeof **block * (size_t)rows->n_block, err));
    }
    HS_UNLESS_FAILED(err, put_length(writer, 4 * rows->n_all, err));
    return hs_parallel_agree(dump->env->parallel, err);
}

/** What the format cannot say. The same on all ranks. */
static hs_status check_frame(hs_dump *dump, const hs_rows *rows, hs_error *err)
{
    const dcd_dump *self = dump->state;
    const int64_t step = dump->env->step;
    if (step < INT32_MIN || step > INT32_MAX || dump->every > INT32_MAX)
        return hs_fail(err, HS_ERROR_IO, "%s: step %lld is beyond what a dcd file can tell (2^31 - 1)",
                       hs_dump_who(dump).text, (long long)step);
    if (rows->n_all > N_ATOMS_MAX)
        return hs_fail(err, HS_ERROR_IO, "%s: dcd files hold at most %d atoms; use dump h5md", hs_dump_who(dump).text,
                       N_ATOMS_MAX);
    if (self->n_atoms < 0 || self->n_atoms == rows->n_all) return HS_OK;
    return hs_fail(err, HS_ERROR_IO,
                   "%s: the frames of '%s' have %lld atoms each, and now there are %lld; where atoms come and go use "
                   "dump h5md or custom",
                   hs_dump_who(dump).text, dump->file, (long long)self->n_atoms, (long long)rows->n_all);
}

static hs_status write_frame(hs_dump *dump, hs_rows *rows, hs_writer *writer, hs_error *err)
{
    dcd_dump *self = dump->state;
    float *block[2] = {NULL, NULL};
    double cell[6];
    const size_t n_block = rows->n_all < HS_ROWS_BLOCK ? (size_t)rows->n_all : HS_ROWS_BLOCK;
    HS_TRY(check_frame(dump, rows, err));
    if (self->n_atoms < 0) self->head = make_head(dump, rows->n_all);
    ++self->head.n_frames;
    self->head.last_step = (int32_t)dump->env->step;
    describe_box(dump->env->box, cell);
    for (int k = 0; k < (writer != NULL ? 2 : 1); ++k) HS_UNLESS_FAILED(err, HS_ALLOC(block[k], n_block, err));
    if (self->n_atoms < 0) HS_UNLESS_FAILED(err, put(writer, &self->head, sizeof self->head, err));
    HS_UNLESS_FAILED(err, put_length(writer, BOX_SIZE, err));
    HS_UNLESS_FAILED(err, put(writer, cell, sizeof cell, err));
    HS_UNLESS_FAILED(err, put_length(writer, BOX_SIZE, err));
    hs_status status = hs_parallel_agree(dump->env->parallel, err);
    for (int axis = 0; axis < 3 && status == HS_OK; ++axis) status = write_axis(dump, rows, axis, writer, block, err);
    HS_FREE(block[0]);
    HS_FREE(block[1]);
    return status;
}

/** Readers take the steps of frames from the head: the first one and the interval. Places are right all the same. First rank. */
static void warn_of_step(hs_dump *dump)
{
    dcd_dump *self = dump->state;
    const dcd_head *head = &self->head; /* the frame of the present step counts already */
    const int64_t told = head->first_step + (int64_t)head->every * (head->n_frames - 1), step = dump->env->step;
    if (self->is_irregular || told == step) return;
    self->is_irregular = true;
    hs_warn(dump->env->out,
            "%s: frame %d of '%s' is of step %lld, and readers of dcd files take it for one of step %lld: they count "
            "from the first frame (step %d) in equal intervals (%d). A new dump into another file, defined after "
            "reset_timestep, or without 'first yes', has the steps right",
            hs_dump_who(dump).text, (int)head->n_frames, dump->file, (long long)step, (long long)told,
            (int)head->first_step, (int)head->every);
}

/** A frame of the present step, and the head before the first one (collective). */
static hs_status write_atoms(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    dcd_dump *self = dump->state;
    const hs_env *env = dump->env;
    hs_rows rows = {0};
    hs_status status = hs_rows_begin(&rows, env->parallel, env->atoms, dump->mask, err);
    if (status == HS_OK) status = write_frame(dump, &rows, writer, err);
    if (status == HS_OK && !dump->is_single) {
        self->n_atoms = rows.n_all;
        self->every = dump->every;
    }
    hs_rows_end(&rows);
    return status;
}

static hs_status write(hs_dump *dump, hs_error *err)
{
    dcd_dump *self = dump->state;
    hs_dump_table *table = &self->table;
    if (dump->env->step == dump->last_written || dump->env->step < table->delay) return HS_OK;
    if (dump->is_single) return hs_dump_write_step_file(dump, write_atoms, err);
    const bool had_head = self->n_atoms >= 0;
    const hs_status status = write_atoms(dump, table->writer, err);
    if (status != HS_OK) {
        hs_writer_abandon(&table->writer);
        table->is_open = false;
        return status;
    }
    if (table->writer != NULL) HS_UNLESS_FAILED(err, hs_writer_commit(table->writer, err));
    if (table->writer != NULL && had_head) HS_UNLESS_FAILED(err, patch_head(self, err));
    if (table->writer != NULL) warn_of_step(dump);
    return hs_parallel_agree(dump->env->parallel, err);
}

const hs_dump_style hs_dump_style_dcd = {
    .about =
        {.name = "dcd",
         .syntax = {.usage = "", .n_min = 0, .n_max = 0},
         .summary = "positions in the binary DCD format of CHARMM and NAMD, which most viewers read",
         .details =
             "One file for all frames, read by VMD, OVITO, MDAnalysis (`format=\"LAMMPS\"`), mdtraj and others: x, y "
             "and z of the group's atoms as 32-bit floats in distance units, in the order of ids, and the box's edges "
             "and angles with each frame. `dump_modify unwrap yes` writes unwrapped places, `pbc yes` those in the "
             "box; else places are as they are between wraps. What the format has no room for is refused: another "
             "number of atoms than in the first frame, steps beyond 2^31 - 1, another interval between frames, "
             "compressed files. Tilted boxes lose their lower corner, as every box does in this format; `dump h5md` "
             "keeps it, and doubles.\n\n"
             "A frame is added to the file as a whole, and the number of frames in the file's head follows. Steps of "
             "frames are not in the file: readers count from that of the first one. A warning says so where they do "
             "not fit (`reset_timestep`, `dump_modify first yes` between multiples of N). With `dump_modify append "
             "yes` frames go behind those of a file that is there, if they are of as many atoms and as many steps "
             "apart. Other keywords of `dump_modify` are `delay`, `every`, `first` and `sort id`.",
         .example = "dump d all dcd 1000 run.dcd\ndump_modify d unwrap yes"},
    .state_size = sizeof(dcd_dump),
    .check = check,
    .create = create,
    .modify = modify,
    .destroy = hs_dump_table_destroy,
    .init = init,
    .position = hs_dump_table_position,
    .write = write,
};
