/** Words that the computes of dipole moments share. */
#ifndef HS_COMPUTE_DIPOLE_WORDS_H
#define HS_COMPUTE_DIPOLE_WORDS_H

#include "base/memory.h"
#include "style/compute.h"

/** Word i, if there is one: mass or geometry; and the atoms must have dipoles. */
static inline hs_status dipole_words(const hs_compute *compute, const hs_args *args, int i, hs_error *err)
{
    static const char *const words[] = {"mass", "geometry", NULL};
    int which;
    if (i < args->n) HS_TRY(hs_arg_choice(args, i, words, &which, err));
    if (compute->env->atoms->mu[0] != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the atoms have no dipole moments; 'atom_style dipole' gives them some",
                   args->command);
}

#endif
