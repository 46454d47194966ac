/* Writing a data file. */
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "io/data_internal.h"
#include "io/row_stream.h"
#include "io/writer.h"
#include "style/box_flow.h"
#include "style/fix.h"

const char *hs_data_shortest(double value, char text[HS_SHORTEST_SIZE])
{
    for (int digits = 15; digits <= 17; ++digits) {
        snprintf(text, HS_SHORTEST_SIZE, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    return text;
}

static hs_status write_header(const hs_env *env, hs_writer *writer, int64_t n_atoms, hs_error *err)
{
    static const char *const bounds[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    const hs_atoms *atoms = env->atoms;
    char lo[HS_SHORTEST_SIZE], hi[HS_SHORTEST_SIZE], mass[HS_SHORTEST_SIZE];
    HS_TRY(hs_writer_printf(writer, err, "LAMMPS data file via Halfshell's write_data, timestep = %lld, units = %s\n\n",
                            (long long)env->step, env->units->name));
    HS_TRY(hs_writer_printf(writer, err, "%lld atoms\n%d atom types\n\n", (long long)n_atoms, atoms->n_types));
    for (int axis = 0; axis < 3; ++axis)
        HS_TRY(hs_writer_printf(writer, err, "%s %s %s\n", hs_data_shortest(env->box->lo[axis], lo),
                                hs_data_shortest(env->box->hi[axis], hi), bounds[axis]));
    if (env->box->is_tilted)
        HS_TRY(hs_writer_printf(writer, err, "%s %s %s xy xz yz\n", hs_data_shortest(env->box->tilt[0], lo),
                                hs_data_shortest(env->box->tilt[1], hi), hs_data_shortest(env->box->tilt[2], mass)));
    bool has_masses = true; /* masses of types are optional where atoms have their own */
    for (int type = 1; type <= atoms->n_types; ++type) has_masses = has_masses && atoms->mass[type] > 0.0;
    if (!has_masses) return HS_OK;
    HS_TRY(hs_writer_printf(writer, err, "\nMasses\n\n"));
    for (int type = 1; type <= atoms->n_types; ++type)
        HS_TRY(hs_writer_printf(writer, err, "%d %s\n", type, hs_data_shortest(atoms->mass[type], mass)));
    return HS_OK;
}

static hs_status write_coefficients(const hs_env *env, hs_writer *writer, const hs_data_write_options *options,
                                    hs_error *err)
{
    const int n_types = env->atoms->n_types;
    const bool is_ij = options->pair == HS_DATA_PAIR_IJ;
    hs_text words = {0};
    hs_status status =
        hs_writer_printf(writer, err, "\n%s # %s\n\n", is_ij ? "PairIJ Coeffs" : "Pair Coeffs", options->pair_style);
    for (int i = 1; i <= n_types && status == HS_OK; ++i)
        for (int j = i; j <= (is_ij ? n_types : i) && status == HS_OK; ++j) {
            hs_text_clear(&words);
            status = options->write_coeff(options->context, i, j, &words, err);
            if (status == HS_OK && is_ij)
                status = hs_writer_printf(writer, err, "%d %d %s\n", i, j, hs_text_get(&words));
            if (status == HS_OK && !is_ij) status = hs_writer_printf(writer, err, "%d %s\n", i, hs_text_get(&words));
        }
    hs_text_fini(&words);
    return status;
}

/** Local atoms in the order of ids. */
typedef struct id_index {
    int64_t id;
    int32_t index;
} id_index;

static int by_id(const void *a, const void *b)
{
    const id_index *p = a, *q = b;
    return (p->id > q->id) - (p->id < q->id);
}

static hs_status sort_atoms(const hs_atoms *atoms, id_index **order, hs_error *err)
{
    HS_TRY(HS_ALLOC(*order, (size_t)atoms->n_local, err));
    for (int i = 0; i < atoms->n_local; ++i) (*order)[i] = (id_index){.id = atoms->id[i], .index = i};
    if (atoms->n_local > 0) qsort(*order, (size_t)atoms->n_local, sizeof **order, by_id);
    return HS_OK;
}

/** What rows are made of. */
typedef struct row_source {
    const hs_env *env;
    const id_index *order;
    const hs_fix *fix; /**< whose section it is */
} row_source;

static hs_row_key row_key(const void *context, int64_t k)
{
    return (hs_row_key){.value = 0.0, .id = ((const row_source *)context)->order[k].id};
}

/** Numbers, each after a space. */
static hs_status append_values(hs_text *row, const double *value, int n, hs_error *err)
{
    char text[HS_SHORTEST_SIZE];
    for (int k = 0; k < n; ++k) HS_TRY(hs_text_printf(row, err, " %s", hs_data_shortest(value[k], text)));
    return HS_OK;
}

static hs_status append_atom(const void *context, int64_t k, hs_text *row, hs_error *err)
{
    const row_source *source = context;
    const hs_atoms *atoms = source->env->atoms;
    const hs_data_columns layout = hs_data_columns_of(&atoms->style);
    const int i = source->order[k].index;
    double x[3];
    int32_t image[3];
    for (int axis = 0; axis < 3; ++axis) x[axis] = atoms->x[axis][i], image[axis] = atoms->image[axis][i];
    hs_box_wrap(source->env->box, x, image);
    HS_TRY(hs_text_printf(row, err, "%lld %d", (long long)atoms->id[i], atoms->type[i]));
    for (int c = 0; c < layout.n; ++c) {
        double value[3];
        const int n = hs_data_get_column(atoms, i, layout.column[c], x, value);
        HS_TRY(append_values(row, value, n, err));
    }
    return hs_text_printf(row, err, " %d %d %d\n", image[0], image[1], image[2]);
}

static hs_status append_velocity(const void *context, int64_t k, hs_text *row, hs_error *err)
{
    const row_source *source = context;
    const hs_atoms *atoms = source->env->atoms;
    const int i = source->order[k].index;
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]},
           v[3] = {atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]};
    int32_t crossed[3] = {0, 0, 0};
    hs_box_wrap(source->env->box, x, crossed); /* as the places are */
    hs_box_flow_cross(source->env, atoms->mask[i], crossed, v);
    HS_TRY(hs_text_printf(row, err, "%lld", (long long)atoms->id[i]));
    HS_TRY(append_values(row, v, 3, err));
    if (atoms->omega[0] != NULL) {
        const double omega[3] = {atoms->omega[0][i], atoms->omega[1][i], atoms->omega[2][i]};
        HS_TRY(append_values(row, omega, 3, err));
    }
    return hs_text_append(row, "\n", 1, err);
}

static hs_status append_fix(const void *context, int64_t k, hs_text *row, hs_error *err)
{
    const row_source *source = context;
    const int i = source->order[k].index;
    HS_TRY(hs_text_printf(row, err, "%lld", (long long)source->env->atoms->id[i]));
    HS_TRY(source->fix->style->data->format(source->fix, i, row, err));
    return hs_text_append(row, "\n", 1, err);
}

/** The section of a fix (collective). */
static hs_status write_section(row_source *source, const hs_fix *fix, hs_writer *writer, hs_error *err)
{
    const hs_text_rows rows = {
        .n = source->env->atoms->n_local, .key = row_key, .format = append_fix, .context = source};
    hs_text names = {0};
    source->fix = fix;
    if (writer != NULL) {
        HS_UNLESS_FAILED(err, fix->style->data->names(fix, &names, err));
        HS_UNLESS_FAILED(err, hs_writer_printf(writer, err, "\n%s # %s\n\n", fix->id, hs_text_get(&names)));
        hs_text_fini(&names);
    }
    return hs_text_rows_write(&rows, writer, source->env->parallel, err);
}

/** The sections Atoms and Velocities, and those of fixes (collective). */
static hs_status write_atoms(const hs_env *env, hs_writer *writer, const hs_data_write_options *options, hs_error *err)
{
    id_index *order = NULL;
    char style[HS_ATOM_STYLE_NAME_SIZE];
    hs_atom_style_name(&env->atoms->style, style);
    HS_UNLESS_FAILED(err, sort_atoms(env->atoms, &order, err));
    row_source source = {.env = env, .order = order};
    hs_text_rows rows = {.n = env->atoms->n_local, .key = row_key, .format = append_atom, .context = &source};
    if (writer != NULL)
        HS_UNLESS_FAILED(
            err, hs_writer_printf(writer, err, "\nAtoms # %s\n\n", env->atoms->style.is_hybrid ? "hybrid" : style));
    hs_status status = hs_text_rows_write(&rows, writer, env->parallel, err);
    if (status == HS_OK) {
        if (writer != NULL) HS_UNLESS_FAILED(err, hs_writer_printf(writer, err, "\nVelocities\n\n"));
        rows.format = append_velocity;
        status = hs_text_rows_write(&rows, writer, env->parallel, err);
    }
    for (int k = 0; k < options->n_fixes && status == HS_OK; ++k)
        if (options->fix[k]->style->data != NULL) status = write_section(&source, options->fix[k], writer, err);
    HS_FREE(order);
    return status;
}

/** All of the file; the writer is the first rank's (collective). */
static hs_status write_file(const hs_env *env, hs_writer *writer, const hs_data_write_options *options, hs_error *err)
{
    int64_t n_atoms = env->atoms->n_local;
    hs_parallel_sum_int64(env->parallel, &n_atoms, 1);
    if (writer != NULL) {
        HS_UNLESS_FAILED(err, write_header(env, writer, n_atoms, err));
        if (options->pair != HS_DATA_PAIR_NONE && options->pair_style != NULL)
            HS_UNLESS_FAILED(err, write_coefficients(env, writer, options, err));
    }
    return n_atoms > 0 ? write_atoms(env, writer, options, err) : hs_parallel_agree(env->parallel, err);
}

hs_status hs_data_write(const hs_env *env, const char *path, const hs_data_write_options *options, hs_error *err)
{
    const bool is_mine = env->parallel->rank == 0;
    hs_writer *writer = NULL;
    if (is_mine) HS_UNLESS_FAILED(err, hs_writer_open(&writer, path, HS_WRITE_WHOLE, err));
    HS_TRY(hs_parallel_agree(env->parallel, err));
    if (write_file(env, writer, options, err) != HS_OK) hs_writer_abandon(&writer);
    if (is_mine) HS_UNLESS_FAILED(err, hs_writer_close(&writer, err));
    return hs_parallel_agree(env->parallel, err);
}
