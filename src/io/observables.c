#include "io/observables.h"

#include "base/memory.h"

hs_status hs_observables_create(hs_observables *self, hs_env *env, const hs_args *args, int first, int n_words,
                                hs_error *err)
{
    HS_TRY(hs_values_read(&self->value, &self->n, env, args, first, n_words, HS_VALUE_NUMBER, err));
    HS_TRY(HS_ALLOC(self->what, (size_t)self->n, err));
    for (int k = 0; k < self->n; ++k) self->what[k].name = self->value[k].word;
    return hs_observables_measure(self, env, args->command, err);
}

hs_status hs_observables_measure(hs_observables *self, hs_env *env, const char *command, hs_error *err)
{
    for (int k = 0; k < self->n; ++k) {
        hs_value_extents extents;
        HS_TRY(hs_value_find_extents(env, &self->value[k], command, &extents, err));
        self->what[k].rank = extents.rank;
        for (int i = 0; i < 2; ++i) self->what[k].n[i] = extents.n[i];
    }
    return HS_OK;
}

static hs_status write_one(hs_observables *self, int k, hs_env *env, hs_h5md *file, const char *command, hs_error *err)
{
    const hs_h5md_observable *what = &self->what[k];
    const size_t n = (size_t)what->n[0] * (size_t)what->n[1];
    hs_value_extents extents;
    HS_TRY(hs_value_find_extents(env, &self->value[k], command, &extents, err));
    if (extents.rank != what->rank || extents.n[0] != what->n[0] || extents.n[1] != what->n[1])
        return hs_fail(
            err, HS_ERROR_RUN,
            "%s: %s has %d x %d numbers now, and had %d x %d when the file was made: H5MD observables cannot "
            "change their lengths",
            command, what->name, extents.n[0], extents.n[1], what->n[0], what->n[1]);
    if (n > self->n_now) {
        HS_TRY(HS_GROW(self->now, self->n_now, n, err));
        self->n_now = n;
    }
    HS_TRY(hs_value_all(env, &self->value[k], &extents, self->now, err));
    return file != NULL ? hs_h5md_put_observable(file, k, self->now, err) : HS_OK;
}

hs_status hs_observables_write(hs_observables *self, hs_env *env, hs_h5md *file, const char *command, hs_error *err)
{
    for (int k = 0; k < self->n; ++k) {
        (void)!write_one(self, k, env, file, command, err);
        HS_TRY(hs_parallel_agree(env->parallel, err));
    }
    return HS_OK;
}

void hs_observables_fini(hs_observables *self)
{
    hs_values_destroy(&self->value, self->n);
    HS_FREE(self->what);
    HS_FREE(self->now);
    self->n = 0;
    self->n_now = 0;
}
