#include "core/group.h"

#include <ctype.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"

hs_status hs_groups_init(hs_groups *groups, hs_error *err)
{
    int all;
    memset(groups, 0, sizeof *groups);
    return hs_groups_add(groups, "all", &all, err);
}

void hs_groups_fini(hs_groups *groups)
{
    for (int bit = 0; bit < HS_GROUPS_MAX; ++bit) HS_FREE(groups->name[bit]);
}

int hs_groups_find(const hs_groups *groups, const char *name)
{
    for (int bit = 0; bit < HS_GROUPS_MAX; ++bit)
        if (groups->name[bit] != NULL && strcmp(groups->name[bit], name) == 0) return bit;
    return -1;
}

hs_status hs_groups_get(const hs_groups *groups, const char *name, int *bit, hs_error *err)
{
    *bit = hs_groups_find(groups, name);
    if (*bit >= 0) return HS_OK;
    const char *names[HS_GROUPS_MAX];
    size_t n = 0;
    for (int i = 0; i < HS_GROUPS_MAX; ++i)
        if (groups->name[i] != NULL) names[n++] = groups->name[i];
    const char *nearest = hs_text_nearest(name, names, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "there is no group '%s'; did you mean '%s'?", name, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "there is no group '%s': the command 'group' makes one", name);
}

static bool has_blank(const char *name)
{
    for (const char *c = name; *c != '\0'; ++c)
        if (!isgraph((unsigned char)*c)) return true;
    return false;
}

hs_status hs_groups_add(hs_groups *groups, const char *name, int *bit, hs_error *err)
{
    *bit = hs_groups_find(groups, name);
    if (*bit >= 0) return HS_OK;
    /* LAMMPS lets names have any characters; those that could not be told apart within formulas are refused */
    if (name[0] == '\0' || strpbrk(name, "()[],$&#'\"*") != NULL || has_blank(name))
        return hs_fail(
            err, HS_ERROR_INPUT,
            "the group name '%s' may not be empty or have blanks, quotes, brackets, commas, any of $ & # *, or letters "
            "other than a to z and A to Z",
            name);
    for (int i = 0; i < HS_GROUPS_MAX; ++i) {
        if (groups->name[i] != NULL) continue;
        *bit = i;
        return hs_memory_strdup(&groups->name[i], name, err);
    }
    return hs_fail(err, HS_ERROR_INPUT,
                   "group '%s' would be one more than the %d a run can have (group ID delete frees one)", name,
                   HS_GROUPS_MAX);
}

void hs_groups_remove(hs_groups *groups, int bit)
{
    HS_FREE(groups->name[bit]);
    groups->dynamic &= ~hs_group_mask(bit);
}
