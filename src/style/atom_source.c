#include "style/atom_source.h"

#include "base/memory.h"

const char *const hs_atom_source_motion[] = {"x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", NULL};

hs_status hs_atom_sources_add(hs_atom_source **sources, int *n, int attribute, hs_value **values, int n_values,
                              hs_value_shape shape, hs_error *err)
{
    const int n_new = attribute < 0 ? n_values : 1;
    const hs_status status = HS_GROW(*sources, (size_t)*n, (size_t)(*n + n_new), err);
    if (status != HS_OK) {
        hs_values_destroy(values, n_values);
        return status;
    }
    for (int k = 0; k < n_new; ++k) {
        hs_atom_source *new = &(*sources)[(*n)++];
        new->attribute = attribute;
        new->shape = shape;
        if (attribute < 0) new->value = (*values)[k];
    }
    HS_FREE(*values);
    return HS_OK;
}

/** The attribute that word i names. */
static hs_status read_attribute(const hs_env *env, const hs_args *args, int i, const char *const *allowed,
                                int *attribute, hs_error *err)
{
    int which;
    HS_TRY(hs_arg_choice(args, i, allowed, &which, err));
    *attribute = hs_attribute_find(allowed[which]);
    if (*attribute == HS_ATTR_ELEMENT) return hs_arg_refuse(args, i, "a number of each atom; type is one", NULL, err);
    return hs_attribute_check((hs_attribute)*attribute, env->atoms, err);
}

/** References of word i: of local values if they may be and are, of atoms else. */
static hs_status read_references(hs_value **values, int *n, hs_env *env, const hs_args *args, int i, bool may_be_local,
                                 hs_value_shape *shape, hs_error *err)
{
    *shape = HS_VALUE_LOCAL;
    if (may_be_local && hs_values_create(values, n, env, args, i, 1, *shape, err) == HS_OK) return HS_OK;
    hs_error_clear(err);
    *shape = HS_VALUE_ATOMS;
    return hs_values_create(values, n, env, args, i, 1, *shape, err);
}

static hs_status read_word(hs_atom_source **sources, int *n, hs_env *env, const hs_args *args, int i,
                           const char *const *attributes, bool may_be_local, hs_error *err)
{
    hs_value *values = NULL;
    hs_value_shape shape = HS_VALUE_ATOMS;
    int attribute = -1, n_values = 0;
    if (hs_value_is_reference(args->word[i]))
        HS_TRY(read_references(&values, &n_values, env, args, i, may_be_local, &shape, err));
    else
        HS_TRY(read_attribute(env, args, i, attributes, &attribute, err));
    return hs_atom_sources_add(sources, n, attribute, &values, n_values, shape, err);
}

static hs_status read_words(hs_atom_source **sources, int *n, hs_env *env, const hs_args *args, int first, int n_words,
                            const char *const *attributes, bool may_be_local, hs_error *err)
{
    *sources = NULL;
    *n = 0;
    hs_status status = HS_OK;
    for (int i = first; i < first + n_words && status == HS_OK; ++i)
        status = read_word(sources, n, env, args, i, attributes, may_be_local, err);
    if (status != HS_OK) hs_atom_sources_destroy(sources, *n);
    return status;
}

hs_status hs_atom_sources_read(hs_atom_source **sources, int *n, hs_env *env, const hs_args *args, int first,
                               int n_words, const char *const *attributes, hs_error *err)
{
    return read_words(sources, n, env, args, first, n_words, attributes, false, err);
}

hs_status hs_atom_sources_read_any(hs_atom_source **sources, int *n, hs_env *env, const hs_args *args, int first,
                                   int n_words, const char *const *attributes, hs_error *err)
{
    return read_words(sources, n, env, args, first, n_words, attributes, true, err);
}

void hs_atom_sources_destroy(hs_atom_source **sources, int n)
{
    for (int k = 0; *sources != NULL && k < n; ++k) hs_value_fini(&(*sources)[k].value);
    HS_FREE(*sources);
}

hs_status hs_atom_sources_check(hs_env *env, const hs_atom_source *sources, int n, const char *command, hs_error *err)
{
    for (int k = 0; k < n; ++k)
        if (sources[k].attribute < 0) HS_TRY(hs_value_check(env, &sources[k].value, sources[k].shape, command, err));
    return HS_OK;
}

bool hs_atom_sources_need_energy(hs_env *env, const hs_atom_source *sources, int n)
{
    bool is_needed = false;
    for (int k = 0; k < n; ++k) is_needed |= sources[k].attribute < 0 && hs_value_needs_energy(env, &sources[k].value);
    return is_needed;
}

hs_status hs_atom_source_values(hs_env *env, const hs_atom_source *source, uint32_t mask, double *out, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    if (source->attribute < 0) HS_TRY(hs_value_atoms(env, &source->value, out, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & mask))
            out[i] = 0.0;
        else if (source->attribute >= 0)
            out[i] = hs_attribute_value(env, (hs_attribute)source->attribute, false, i);
    }
    return HS_OK;
}
