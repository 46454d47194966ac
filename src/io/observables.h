/** Numbers, vectors and arrays of the whole system that go into an H5MD file with every frame. */
#ifndef HS_IO_OBSERVABLES_H
#define HS_IO_OBSERVABLES_H

#include "io/h5md.h"
#include "style/value.h"

/** Zero-initialised it is empty. */
typedef struct hs_observables {
    int n;
    hs_value *value;          /**< owned [n] */
    hs_h5md_observable *what; /**< owned [n]: as they are in the file, named as in the deck */
    double *now;              /**< owned: one of them */
    size_t n_now;
} hs_observables;

/** Read the words [first, first + n_words): c_ID, c_ID[i], f_ID, f_ID[i], v_name, all there is of each. */
HS_MUST_USE hs_status hs_observables_create(hs_observables *self, hs_env *env, const hs_args *args, int first,
                                            int n_words, hs_error *err);
/** Find the lengths, which stay until the file is closed. */
HS_MUST_USE hs_status hs_observables_measure(hs_observables *self, hs_env *env, const char *command, hs_error *err);
/** Add them to the present frame; rank 0 has the file, the others NULL (collective). */
HS_MUST_USE hs_status hs_observables_write(hs_observables *self, hs_env *env, hs_h5md *file, const char *command,
                                           hs_error *err);
void hs_observables_fini(hs_observables *self);

#endif
