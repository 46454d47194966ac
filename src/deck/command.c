#include "deck/command.h"

#include <string.h>

#include "base/text.h"

const hs_command *hs_command_find(const char *name)
{
    for (int family = 0; hs_command_families[family] != NULL; ++family)
        for (const hs_command *command = hs_command_families[family]; command->about.name != NULL; ++command)
            if (strcmp(command->about.name, name) == 0) return command;
    return NULL;
}

/** Commands of LAMMPS (29 Sep 2021) that Halfshell does not have: refused by name, not as a misspelling. */
static const char *const of_lammps[] = {
    "angle_coeff",
    "angle_write",
    "atc",
    "bond_coeff",
    "bond_write",
    "create_bonds",
    "delete_bonds",
    "dielectric",
    "dihedral_coeff",
    "dihedral_write",
    "dynamical_matrix",
    "dynamical_matrix/kk",
    "group2ndx",
    "hyper",
    "improper_coeff",
    "improper_write",
    "kim",
    "kim_init",
    "kim_interactions",
    "kim_param",
    "kim_property",
    "kim_query",
    "kspace_modify",
    "mdi/engine",
    "message",
    "molecule",
    "ndx2group",
    "neb",
    "neb/spin",
    "partition",
    "plugin",
    "prd",
    "python",
    "reset_mol_ids",
    "server",
    "tad",
    "temper",
    "temper/grem",
    "temper/npt",
    "third_order",
    "third_order/kk",
    NULL,
};

hs_status hs_command_refuse(const char *name, hs_error *err)
{
    for (int k = 0; of_lammps[k] != NULL; ++k)
        if (strcmp(of_lammps[k], name) == 0)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is a command of LAMMPS that Halfshell does not support", name);
    enum { MAX = 256 };
    const char *names[MAX];
    size_t n = 0;
    for (int family = 0; hs_command_families[family] != NULL; ++family)
        for (const hs_command *command = hs_command_families[family]; command->about.name != NULL && n < MAX; ++command)
            names[n++] = command->about.name;
    const char *nearest = hs_text_nearest(name, names, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "unknown command '%.80s'; did you mean '%s'?", name, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "unknown command '%.80s'; 'halfshell help' lists all commands", name);
}
