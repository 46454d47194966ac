#include "style/custom_atom.h"

#include <string.h>

bool hs_custom_atom_is_name(const char *word)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return (word[0] == 'i' || word[0] == 'd') && word[1] == '_' && word[2] != '\0' &&
           word[2 + strspn(word + 2, letters)] == '\0';
}

const hs_atom_field *hs_custom_atom_find(const hs_atoms *atoms, char kind, const char *name)
{
    /* what a restart file has kept for a fix to come goes by the same name, but has no room for the halo */
    for (int k = 0; k < atoms->n_fields; ++k) {
        const char *full = atoms->field[k].name;
        if (atoms->field[k].has_halo && strncmp(full, "fix ", 4) == 0 && full[4] == kind && full[5] == '_' &&
            strcmp(full + 6, name) == 0)
            return &atoms->field[k];
    }
    return NULL;
}

hs_status hs_custom_atom_get(const hs_atoms *atoms, const char *name, const char *command, const hs_atom_field **field,
                             hs_error *err)
{
    *field = hs_custom_atom_find(atoms, name[0], name + 2);
    if (*field != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: atoms have no value '%s': 'fix <ID> all property/atom %s' adds one",
                   command, name, name);
}

void hs_custom_atom_read(const hs_atoms *atoms, const hs_atom_field *field, double *out)
{
    const bool is_whole = field->size == sizeof(int32_t);
    const int32_t *whole = *field->array;
    const double *real = *field->array;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) out[i] = is_whole ? whole[i] : real[i];
}

hs_status hs_custom_atom_write(const hs_atoms *atoms, const hs_atom_field *field, const unsigned char *flag,
                               const double *values, const char *command, hs_error *err)
{
    const bool is_whole = field->size == sizeof(int32_t);
    for (int i = 0; i < atoms->n_local; ++i) {
        if (flag != NULL && !flag[i]) continue;
        if (!is_whole)
            ((double *)*field->array)[i] = values[i];
        else if (values[i] > -2147483649.0 && values[i] < 2147483648.0)
            ((int32_t *)*field->array)[i] = (int32_t)values[i];
        else
            return hs_fail(err, HS_ERROR_INPUT, "%s: %s cannot be %g: it is a whole number of 32 bits", command,
                           field->name + 4, values[i]);
    }
    return HS_OK;
}
