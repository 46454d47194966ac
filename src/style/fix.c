#include "style/fix.h"

#include "style/atom_sum.h"
#include "style/compute.h"
#include "style/shared_fields.h"

hs_who hs_fix_who(const hs_fix *fix)
{
    hs_who who;
    snprintf(who.text, sizeof who.text, "fix '%.128s' (%.40s)", fix->id, fix->style->about.name);
    return who;
}

hs_status hs_fix_own_compute(hs_fix *fix, int k, const char *style, const char *suffix, int group, const hs_args *args,
                             hs_error *err)
{
    hs_text id = {0};
    hs_status status = hs_text_printf(&id, err, "%s_%s", fix->id, suffix);
    if (status == HS_OK)
        status =
            hs_compute_create(&fix->own[k], fix->env, hs_compute_style_find(style), hs_text_get(&id), group, args, err);
    hs_text_fini(&id);
    return status;
}

hs_status hs_fix_noise(const hs_fix *fix, int64_t seed, hs_noise *noise, hs_error *err)
{
    hs_text name = {0};
    const hs_status status = hs_text_printf(&name, err, "%s %s", fix->style->about.name, fix->id);
    *noise = hs_noise_open(seed, hs_text_get(&name));
    hs_text_fini(&name);
    return status;
}

hs_status hs_fix_need_sample(const hs_fix *fix, int64_t next, hs_error *err)
{
    if (next >= fix->env->step || fix->env->dry_run) return HS_OK; /* halfshell check passes over the steps */
    return hs_fail(
        err, HS_ERROR_INPUT,
        "%s needs a sample at step %lld, of which there is no snapshot: its steps must be steps of the snapshots",
        hs_fix_who(fix).text, (long long)next);
}

void hs_fix_add_virial(const double r[3], const double f[3], double w[6])
{
    for (int axis = 0; axis < 3; ++axis) w[axis] += r[axis] * f[axis];
    w[3] += r[0] * f[1];
    w[4] += r[0] * f[2];
    w[5] += r[1] * f[2];
}

typedef struct virial_context {
    const hs_fix *fix;
    hs_fix_virial virial;
} virial_context;

static void add_virials(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const virial_context *c = context;
    for (int i = begin; i < end; ++i) {
        double w[6] = {0.0};
        if (!(atoms->mask[i] & c->fix->mask)) continue;
        c->virial(c->fix, i, w);
        for (int k = 0; k < 6; ++k) hs_exact_add(&sums[k], w[k]);
        double *const *of_atom = c->fix->env->virial_of_fixes; /* each atom is met once, so threads may add */
        for (int k = 0; k < 6 && of_atom[0] != NULL; ++k) of_atom[k][i] += w[k];
    }
}

void hs_fix_sum_virial(hs_fix *fix, hs_fix_virial virial)
{
    const virial_context context = {.fix = fix, .virial = virial};
    hs_atom_sum(fix->env->atoms, fix->env->parallel, add_virials, &context, 6, fix->virial);
}

hs_status hs_virial_of_fixes_want(hs_env *env, hs_error *err)
{
    static const char *const name[6] = {"fixvxx", "fixvyy", "fixvzz", "fixvxy", "fixvxz", "fixvyz"};
    return hs_shared_fields_want(env->atoms, env->virial_of_fixes, name, 6, &env->n_virial_users, err);
}

void hs_virial_of_fixes_release(hs_env *env)
{
    hs_shared_fields_release(env->atoms, env->virial_of_fixes, 6, &env->n_virial_users);
}
