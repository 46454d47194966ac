#include "style/stress_parts.h"

#include <string.h>

const hs_keyword hs_stress_parts_keywords[] = {
    {"ke", 0, "", "the kinetic part"},
    {"pair", 0, "", "the virial of the pair style; in the pressure with its long-range correction"},
    {"virial", 0, "", "every part but the kinetic one"},
    {"bond", 0, "", "the virial of bonds: 0, this version has none"},
    {"angle", 0, "", "the virial of angles: 0"},
    {"dihedral", 0, "", "the virial of dihedrals: 0"},
    {"improper", 0, "", "the virial of impropers: 0"},
    {"kspace", 0, "", "the virial of long-range Coulomb forces: 0"},
    {"fix", 0, "", "the virial of the fixes that `fix_modify virial yes` was said for"},
    {NULL, 0, NULL, NULL},
};

hs_stress_parts hs_stress_parts_read(const hs_args *args, int first)
{
    const bool is_all = first >= args->n;
    hs_stress_parts parts = {is_all, is_all, is_all};
    for (int i = first; i < args->n; ++i) {
        const bool is_virial = strcmp(args->word[i], "virial") == 0;
        parts.has_ke |= strcmp(args->word[i], "ke") == 0;
        parts.has_pair |= is_virial || strcmp(args->word[i], "pair") == 0;
        parts.has_fix |= is_virial || strcmp(args->word[i], "fix") == 0;
    }
    return parts;
}
