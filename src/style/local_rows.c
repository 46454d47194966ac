#include "style/local_rows.h"

#include "base/memory.h"

void hs_local_rows_fini(hs_local_rows *rows)
{
    HS_FREE(rows->values);
    *rows = (hs_local_rows){.n = 0};
}

hs_status hs_local_rows_reserve(hs_local_rows *rows, int64_t n, int n_columns, hs_error *err)
{
    if (n > INT32_MAX)
        return hs_fail(err, HS_ERROR_RUN, "%lld rows of local values are too many for a rank: use more ranks",
                       (long long)n);
    rows->n = (int)n;
    return HS_RESERVE(rows->values, rows->capacity, (size_t)n * (size_t)n_columns, err);
}

hs_status hs_local_rows_number(hs_local_rows *rows, const hs_parallel *parallel, hs_error *err)
{
    int64_t *n = NULL;
    HS_UNLESS_FAILED(err, HS_ALLOC(n, (size_t)parallel->n_ranks, err));
    if (hs_parallel_agree(parallel, err) == HS_OK) {
        hs_parallel_gather_int64(parallel, rows->n, n);
        rows->first = rows->n_all = 0;
        for (int rank = 0; rank < parallel->n_ranks; ++rank) {
            if (rank < parallel->rank) rows->first += n[rank];
            rows->n_all += n[rank];
        }
    }
    HS_FREE(n);
    return err->status;
}
