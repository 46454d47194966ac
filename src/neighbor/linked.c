/* Method `linked`: cells with head and next, built anew at every step. */
#include "neighbor/chains.h"

hs_status hs_linked_build(hs_chains *chains, const hs_atoms *atoms, hs_error *err)
{
    const int n = atoms->n_local + atoms->n_halo;
    HS_TRY(hs_chains_number_cells(chains, err));
    HS_TRY(hs_chains_reserve(chains, n, err));
    chains->n_atoms = n;
    chains->is_void = true; /* for `incremental`, which could not tell whose chains these are */
    for (int64_t cell = 0; cell < chains->n_cells; ++cell) chains->head[cell] = HS_CHAIN_END;
    for (int i = n - 1; i >= 0; --i) { /* backwards, so that chains ascend */
        int c[3];
        if (!hs_chains_takes(chains, atoms, i)) continue;
        hs_chains_locate(chains, atoms, i, c);
        int32_t *head = &chains->head[hs_chains_number(chains, c)];
        chains->next[i] = *head;
        *head = i;
    }
    return HS_OK;
}
