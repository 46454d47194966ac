/* Commands about bonds and charges, of which there are none: decks say them for safety, or because others do. */
#include <string.h>

#include "deck/command.h"

static hs_status check_none(const hs_args *args, bool has_variables, hs_error *err)
{
    const char *what = args->command[0] == 'k' ? "none: atoms have no charge, and no force has a long range"
                                               : "none: there are no bonds between atoms";
    if (has_variables && strchr(args->word[0], '$') != NULL) return HS_OK;
    if (strcmp(args->word[0], "none") != 0) return hs_arg_refuse(args, 0, what, NULL, err);
    return args->n == 1 ? HS_OK : hs_arg_refuse(args, 1, "expected after none", NULL, err);
}

static hs_status run_none(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)deck;
    return check_none(args, false, err);
}

static const hs_keyword special_keywords[] = {
    {"amber", 0, "", "weights of a force field"},
    {"charmm", 0, "", "the same"},
    {"dreiding", 0, "", "the same"},
    {"fene", 0, "", "weights of bead-spring chains"},
    {"lj", 3, "<w12> <w13> <w14>", "weights of the pair potential"},
    {"coul", 3, "<w12> <w13> <w14>", "weights of Coulomb forces"},
    {"lj/coul", 3, "<w12> <w13> <w14>", "weights of both"},
    {"angle", 1, "yes|no", "only where there is an angle"},
    {"dihedral", 1, "yes|no", "only where there is a dihedral"},
    {0},
};

/** Weights, which are from 0 to 1, are numbers at least. */
static hs_status check_special(const hs_args *args, bool has_variables, hs_error *err)
{
    for (int i = 0; i < args->n; ++i) {
        double weight;
        const char *word = args->word[i];
        const bool is_weight = strspn(word, "0123456789.+-eE") == strlen(word);
        if (has_variables || !is_weight) continue;
        HS_TRY(hs_arg_double(args, i, &weight, err));
        if (weight < 0.0 || weight > 1.0) return hs_arg_refuse(args, i, "a weight from 0 to 1", NULL, err);
    }
    return HS_OK;
}

static hs_status run_special(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)deck;
    return check_special(args, false, err);
}

/* Only `none` makes sense of these styles. */
#define NO_STYLE(command, of, what)                                                                                    \
    {                                                                                                                  \
        .about = {.name = command,                                                                                     \
                  .syntax = {.usage = "none", .n_min = 1, .n_max = -1},                                                \
                  .summary = "Style of " of ", of which there are none",                                               \
                  .details = "`none` is accepted and changes nothing; all other styles are refused, for " what ".",    \
                  .example = command " none"},                                                                         \
        .run = run_none, .check = check_none                                                                           \
    }

const hs_command hs_commands_bonds[] = {
    NO_STYLE("bond_style", "bonds", "atoms have no bonds"),
    NO_STYLE("angle_style", "angles", "atoms have no bonds"),
    NO_STYLE("dihedral_style", "dihedrals", "atoms have no bonds"),
    NO_STYLE("improper_style", "impropers", "atoms have no bonds"),
    NO_STYLE("kspace_style", "long-range Coulomb forces", "atoms have no charge"),
    {.about = {.name = "special_bonds",
               .syntax = {.usage = "<keyword> <value> ...", .n_min = 0, .n_max = 0, .keywords = special_keywords},
               .summary = "Weights of forces between bonded atoms, accepted without effect",
               .details = "There are no bonds, so no pair of atoms has another weight than 1. Words are checked.",
               .example = "special_bonds lj/coul 0 1 1"},
     .run = run_special,
     .check = check_special},
    {.run = NULL},
};
