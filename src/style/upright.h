/** Styles that serve orthogonal boxes only. */
#ifndef HS_STYLE_UPRIGHT_H
#define HS_STYLE_UPRIGHT_H

#include "style/env.h"

/** Refuse a tilted box; @p what, the style or the keyword that does not know them, begins the message. */
static inline HS_MUST_USE hs_status hs_need_upright(const hs_env *env, const char *what, hs_error *err)
{
    if (!env->box->is_tilted) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s is for orthogonal boxes, and this one is tilted (triclinic)", what);
}

#endif
