/* Writing a data file. */
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "io/data_internal.h"
#include "io/writer.h"

const char *hs_data_shortest(double value, char text[HS_SHORTEST_SIZE])
{
    for (int digits = 15; digits <= 17; ++digits) {
        snprintf(text, HS_SHORTEST_SIZE, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    return text;
}

static hs_status write_header(const hs_env *env, hs_writer *writer, hs_error *err)
{
    static const char *const bounds[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    const hs_atoms *atoms = env->atoms;
    char lo[HS_SHORTEST_SIZE], hi[HS_SHORTEST_SIZE], mass[HS_SHORTEST_SIZE];
    HS_TRY(hs_writer_printf(writer, err, "LAMMPS data file via Halfshell's write_data, timestep = %lld, units = %s\n\n",
                            (long long)env->step, env->units->name));
    HS_TRY(hs_writer_printf(writer, err, "%d atoms\n%d atom types\n\n", atoms->n_local, atoms->n_types));
    for (int axis = 0; axis < 3; ++axis)
        HS_TRY(hs_writer_printf(writer, err, "%s %s %s\n", hs_data_shortest(env->box->lo[axis], lo),
                                hs_data_shortest(env->box->hi[axis], hi), bounds[axis]));
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

/** Atoms in the order of ids. */
typedef struct id_index {
    int64_t id;
    int32_t index;
} id_index;

static int by_id(const void *a, const void *b)
{
    const id_index *p = a, *q = b;
    return (p->id > q->id) - (p->id < q->id);
}

static hs_status sorted_atoms(const hs_atoms *atoms, id_index **order, hs_error *err)
{
    HS_TRY(HS_ALLOC(*order, (size_t)atoms->n_local, err));
    for (int i = 0; i < atoms->n_local; ++i) (*order)[i] = (id_index){.id = atoms->id[i], .index = i};
    qsort(*order, (size_t)atoms->n_local, sizeof **order, by_id);
    return HS_OK;
}

/** Numbers, each after a space. */
static hs_status write_values(hs_writer *writer, const double *value, int n, hs_error *err)
{
    char text[HS_SHORTEST_SIZE];
    for (int k = 0; k < n; ++k) HS_TRY(hs_writer_printf(writer, err, " %s", hs_data_shortest(value[k], text)));
    return HS_OK;
}

static hs_status write_atoms(const hs_env *env, hs_writer *writer, const id_index *order, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    const hs_data_columns layout = hs_data_columns_of(&atoms->style);
    char style[HS_ATOM_STYLE_NAME_SIZE];
    hs_atom_style_name(&atoms->style, style);
    HS_TRY(hs_writer_printf(writer, err, "\nAtoms # %s\n\n", atoms->style.is_hybrid ? "hybrid" : style));
    for (int k = 0; k < atoms->n_local; ++k) {
        const int i = order[k].index;
        double x[3];
        int32_t image[3];
        for (int axis = 0; axis < 3; ++axis) x[axis] = atoms->x[axis][i], image[axis] = atoms->image[axis][i];
        hs_box_wrap(env->box, x, image);
        HS_TRY(hs_writer_printf(writer, err, "%lld %d", (long long)atoms->id[i], atoms->type[i]));
        for (int c = 0; c < layout.n; ++c) {
            double value[3];
            const int n = hs_data_get_column(atoms, i, layout.column[c], x, value);
            HS_TRY(write_values(writer, value, n, err));
        }
        HS_TRY(hs_writer_printf(writer, err, " %d %d %d\n", image[0], image[1], image[2]));
    }
    return HS_OK;
}

static hs_status write_velocities(const hs_env *env, hs_writer *writer, const id_index *order, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    HS_TRY(hs_writer_printf(writer, err, "\nVelocities\n\n"));
    for (int k = 0; k < atoms->n_local; ++k) {
        const int i = order[k].index;
        const double v[3] = {atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]};
        HS_TRY(hs_writer_printf(writer, err, "%lld", (long long)atoms->id[i]));
        HS_TRY(write_values(writer, v, 3, err));
        if (atoms->omega[0] != NULL) {
            const double omega[3] = {atoms->omega[0][i], atoms->omega[1][i], atoms->omega[2][i]};
            HS_TRY(write_values(writer, omega, 3, err));
        }
        HS_TRY(hs_writer_printf(writer, err, "\n"));
    }
    return HS_OK;
}

static hs_status write_file(const hs_env *env, hs_writer *writer, const hs_data_write_options *options, hs_error *err)
{
    id_index *order;
    HS_TRY(write_header(env, writer, err));
    if (options->pair != HS_DATA_PAIR_NONE && options->pair_style != NULL)
        HS_TRY(write_coefficients(env, writer, options, err));
    if (env->atoms->n_local == 0) return HS_OK;
    HS_TRY(sorted_atoms(env->atoms, &order, err));
    hs_status status = write_atoms(env, writer, order, err);
    if (status == HS_OK) status = write_velocities(env, writer, order, err);
    HS_FREE(order);
    return status;
}

hs_status hs_data_write(const hs_env *env, const char *path, const hs_data_write_options *options, hs_error *err)
{
    hs_writer *writer;
    if (env->parallel->n_ranks > 1)
        return hs_fail(err, HS_ERROR_INPUT, "write_data works in runs on one rank only; use threads instead of ranks");
    HS_TRY(hs_writer_open(&writer, path, HS_WRITE_WHOLE, err));
    const hs_status status = write_file(env, writer, options, err);
    if (status == HS_OK) return hs_writer_close(&writer, err);
    hs_writer_abandon(&writer);
    return status;
}
