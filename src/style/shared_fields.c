#include "style/shared_fields.h"

#include <string.h>

hs_status hs_shared_fields_want(hs_atoms *atoms, double **of, const char *const *name, int n, int *n_users,
                                hs_error *err)
{
    for (int k = 0; k < n; ++k)
        if (of[k] == NULL) HS_TRY(hs_atoms_add_field(atoms, name[k], (void **)&of[k], sizeof *of[k], false, err));
    ++*n_users;
    return HS_OK;
}

void hs_shared_fields_release(hs_atoms *atoms, double **of, int n, int *n_users)
{
    if (--*n_users > 0) return;
    for (int k = 0; k < n; ++k) hs_atoms_remove_field(atoms, (void **)&of[k]);
}

void hs_shared_fields_clear(const hs_atoms *atoms, double *const *of, int n)
{
    for (int k = 0; k < n && of[k] != NULL; ++k) memset(of[k], 0, (size_t)atoms->n_local * sizeof *of[k]);
}
