/** What of a style decides the future and must survive a restart: named numbers. One hook moves them in either
 *  direction, into a checkpoint or back out of it, so that writing and reading cannot differ:
 *
 *      static hs_status keep_state(hs_fix *fix, hs_state *state, hs_error *err)
 *      {
 *          my_state *my = fix->state;
 *          HS_TRY(hs_state_double(state, "eta", my->eta, 3, err));
 *          return hs_state_int64(state, "n_sampled", &my->n_sampled, 1, err);
 *      }
 *
 *  Only what is the same on all ranks goes here. What belongs to atoms is a field of theirs (hs_atoms_add_field) and is
 *  kept without any doing of the style, as are the words the style was created with. */
#ifndef HS_STYLE_STATE_H
#define HS_STYLE_STATE_H

#include <stdint.h>

#include "base/error.h"

typedef struct hs_state_value {
    char *name;                                                   /**< owned */
    enum { HS_STATE_REAL, HS_STATE_INTEGER, HS_STATE_TEXT } kind; /**< double, int64_t, bytes */
    int64_t n;
    void *data; /**< owned [n]; a text is followed by a zero, which n does not count */
} hs_state_value;

/** The values of one style. Zero-initialised it is empty and ready to be written to. */
typedef struct hs_state {
    bool is_reading;       /**< values go to the style; else they come from it */
    hs_state_value *value; /**< owned [n_values] */
    int n_values;
} hs_state;

void hs_state_fini(hs_state *state);
/** Append a value; @p data is copied. For readers of files. */
HS_MUST_USE hs_status hs_state_add(hs_state *state, const char *name, int kind, const void *data, int64_t n,
                                   hs_error *err);
/** NULL when there is none of that name. */
const hs_state_value *hs_state_find(const hs_state *state, const char *name);

/* Move values. When reading, a name that is missing or has another count or kind is an error. */
HS_MUST_USE hs_status hs_state_double(hs_state *state, const char *name, double *values, int64_t n, hs_error *err);
HS_MUST_USE hs_status hs_state_int64(hs_state *state, const char *name, int64_t *values, int64_t n, hs_error *err);
HS_MUST_USE hs_status hs_state_int(hs_state *state, const char *name, int *value, hs_error *err);
HS_MUST_USE hs_status hs_state_bool(hs_state *state, const char *name, bool *value, hs_error *err);
/** Arrays whose length is part of the state: when reading, *values is given back and allocated anew
 *  (hs_memory_alloc). */
HS_MUST_USE hs_status hs_state_doubles(hs_state *state, const char *name, double **values, int64_t *n, hs_error *err);
HS_MUST_USE hs_status hs_state_int64s(hs_state *state, const char *name, int64_t **values, int64_t *n, hs_error *err);
/** A string, or NULL: when reading, *text is given back and allocated anew. */
HS_MUST_USE hs_status hs_state_text(hs_state *state, const char *name, char **text, hs_error *err);

#endif
