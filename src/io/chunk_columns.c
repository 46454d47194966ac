#include "io/chunk_columns.h"

#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"

static const char *const words[] = {
    "density/number", "density/mass", "mass", "temp", "vx", "vy", "vz", "fx", "fy", "fz", NULL};

void hs_chunk_columns_fini(hs_chunk_columns *columns)
{
    for (int k = 0; k < columns->n; ++k) hs_value_fini(&columns->column[k].source.value);
    HS_FREE(columns->column);
    HS_FREE(columns->bias_id);
}

hs_status hs_chunk_columns_add(hs_chunk_columns *columns, hs_env *env, const hs_args *args, int i, hs_error *err)
{
    hs_atom_source *sources = NULL;
    int n = 1, which = HS_CHUNK_SOURCE;
    if (!hs_value_is_reference(args->word[i]) && hs_arg_choice(args, i, words, &which, err) != HS_OK) {
        hs_error_clear(err);
        return hs_arg_refuse(args, i,
                             "vx, vy, vz, fx, fy, fz, mass, temp, density/number, density/mass or a value per atom",
                             words, err);
    }
    if (which >= HS_CHUNK_SOURCE)
        HS_TRY(hs_atom_sources_read(&sources, &n, env, args, i, 1, hs_atom_source_motion, err));
    const hs_status status = HS_GROW(columns->column, (size_t)columns->n, (size_t)(columns->n + n), err);
    if (status != HS_OK) {
        hs_atom_sources_destroy(&sources, n);
        return status;
    }
    for (int k = 0; k < n; ++k) {
        hs_chunk_column *c = &columns->column[columns->n++];
        c->kind = sources != NULL ? HS_CHUNK_SOURCE : (hs_chunk_quantity)which;
        if (sources != NULL) c->source = sources[k];
        c->name = c->source.value.word != NULL ? c->source.value.word : words[which];
    }
    HS_FREE(sources);
    return HS_OK;
}

hs_status hs_chunk_columns_bias(const hs_chunk_columns *columns, const hs_fix *fix, hs_compute **bias, hs_error *err)
{
    *bias = columns->bias_id != NULL ? fix->env->find_compute(fix->env, columns->bias_id) : NULL;
    if (columns->bias_id == NULL || (*bias != NULL && (*bias)->style->is_temperature)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no temperature compute '%s'", hs_fix_who(fix).text,
                   columns->bias_id);
}

hs_status hs_chunk_columns_keyword(hs_chunk_columns *columns, const hs_fix *fix, const hs_args *args, int i,
                                   hs_error *err)
{
    static const char *const norms[] = {"all", "sample", "none", NULL};
    hs_compute *bias;
    int norm;
    if (strcmp(args->word[i], "norm") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, norms, &norm, err));
        columns->norm = (hs_chunk_norm)norm;
        return HS_OK;
    }
    if (strcmp(args->word[i], "adof") == 0) return hs_arg_double(args, i + 1, &columns->adof, err);
    if (strcmp(args->word[i], "cdof") == 0) return hs_arg_double(args, i + 1, &columns->cdof, err);
    HS_TRY(hs_memory_replace(&columns->bias_id, args->word[i + 1], err));
    return hs_chunk_columns_bias(columns, fix, &bias, err);
}

hs_status hs_chunk_columns_check(const hs_chunk_columns *columns, const hs_fix *fix, const char *command, hs_error *err)
{
    hs_compute *bias;
    HS_TRY(hs_chunk_columns_bias(columns, fix, &bias, err));
    for (int k = 0; k < columns->n; ++k)
        HS_TRY(hs_atom_sources_check(fix->env, &columns->column[k].source, 1, command, err));
    return HS_OK;
}

bool hs_chunk_columns_need_energy(const hs_chunk_columns *columns, hs_env *env)
{
    bool is_needed = false;
    for (int k = 0; k < columns->n; ++k) is_needed |= hs_atom_sources_need_energy(env, &columns->column[k].source, 1);
    return is_needed;
}

hs_status hs_chunk_columns_fill(const hs_chunk_columns *columns, hs_env *env, int k, const hs_compute *bias,
                                double *values, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    const hs_chunk_quantity kind = k < 0 ? HS_CHUNK_NUMBER : columns->column[k].kind;
    if (kind == HS_CHUNK_SOURCE) return hs_atom_source_values(env, &columns->column[k].source, UINT32_MAX, values, err);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        double b[3] = {0.0}, v2 = 0.0;
        values[i] = 1.0;
        if (kind == HS_CHUNK_MASS || kind == HS_CHUNK_MASS_DENSITY) values[i] = hs_atom_mass(atoms, i);
        if (kind != HS_CHUNK_TEMPERATURE) continue;
        if (bias != NULL && bias->style->bias != NULL) bias->style->bias(bias, i, b);
        for (int axis = 0; axis < 3; ++axis) v2 += (atoms->v[axis][i] - b[axis]) * (atoms->v[axis][i] - b[axis]);
        values[i] = hs_atom_mass(atoms, i) * v2;
    }
    return HS_OK;
}

double hs_chunk_columns_mean(const hs_chunk_columns *columns, const hs_env *env, double volume, int k, double sum,
                             double count, double n_samples)
{
    const hs_units *units = env->units;
    const hs_chunk_quantity kind = columns->column[k].kind;
    const double n_dof = n_samples * columns->cdof + columns->adof * count;
    if (count == 0.0) return 0.0;
    if (kind == HS_CHUNK_NUMBER) return sum / volume / n_samples;
    if (kind == HS_CHUNK_MASS_DENSITY) return sum / volume / n_samples * units->mass_density;
    if (kind == HS_CHUNK_TEMPERATURE) return n_dof > 0.0 ? sum * units->mvv2e / (n_dof * units->boltz) : 0.0;
    return columns->norm == HS_NORM_NONE ? sum / n_samples : sum / count;
}

void hs_chunk_columns_weigh(const hs_chunk_columns *columns, const hs_env *env, double volume, int k, double sum,
                            double count, double *value, double *weight)
{
    const hs_units *units = env->units;
    const hs_chunk_quantity kind = k < 0 ? HS_CHUNK_NUMBER : columns->column[k].kind;
    const bool is_density = kind == HS_CHUNK_NUMBER || kind == HS_CHUNK_MASS_DENSITY;
    *weight = 1.0;
    *value = k < 0 ? count : hs_chunk_columns_mean(columns, env, volume, k, sum, count, 1.0);
    if (is_density || columns->norm != HS_NORM_ALL) return;
    *weight = kind == HS_CHUNK_TEMPERATURE ? columns->cdof + columns->adof * count : count;
    *value = kind == HS_CHUNK_TEMPERATURE ? sum * units->mvv2e / units->boltz : sum;
}
