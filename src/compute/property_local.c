/* Atoms and types of each pair. */
#include <string.h>

#include "style/pair_columns.h"

/** natom1, natom2, ntype1, ntype2 of the pairs in lists, then the same of those in the cutoff. */
static const char *const words[] = {"natom1", "natom2", "ntype1", "ntype2", "patom1",
                                    "patom2", "ptype1", "ptype2", NULL};
enum { N_OF_CHOICE = 4 };

/** Words of LAMMPS about bonds, angles and so on. */
static bool is_of_bonds(const char *word)
{
    return word[0] != '\0' && strchr("badi", word[0]) != NULL &&
           (strncmp(word + 1, "atom", 4) == 0 || strcmp(word + 1, "type") == 0);
}

static hs_status add_word(hs_compute *compute, const hs_args *args, int i, hs_error *err)
{
    hs_pair_columns *columns = compute->state;
    int which;
    if (is_of_bonds(args->word[i]))
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: '%s': atoms have no bonds here; pairs have patom1, patom2, ptype1, ptype2", args->command,
                       args->word[i]);
    HS_TRY(hs_arg_choice(args, i, words, &which, err));
    const hs_pair_choice choice = which < N_OF_CHOICE ? HS_PAIRS_IN_LISTS : HS_PAIRS_IN_CUTOFF;
    if (i > 0 && choice != columns->choice)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: '%s' is of other pairs than '%s': those in the lists (natom1 ...) and those within the cutoff "
            "(patom1 ...) are as many rows each, and need a compute each",
            args->command, args->word[i], args->word[0]);
    columns->choice = choice;
    return hs_pair_columns_add(compute, (hs_pair_quantity)(HS_PAIR_ATOM1 + which % N_OF_CHOICE), err);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    const int n = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    for (int i = 0; i < n; ++i) HS_TRY(add_word(compute, args, i, err));
    return hs_pair_columns_read_cutoff(compute, args, n, err);
}

const hs_compute_style hs_compute_style_property_local = {
    .about =
        {.name = "property/local",
         .syntax = {.usage = "<value> ... [cutoff type|radius]",
                    .n_min = 1,
                    .n_max = -1,
                    .keywords = hs_pair_columns_keywords},
         .summary = "ids and types of the atoms of each pair",
         .details = "Local values: a row for each pair of atoms of the group, with the ids `patom1`, `patom2` of its "
                    "atoms, of which the first is the lower, and their types `ptype1`, `ptype2`. The pairs, their "
                    "order, and `cutoff` are those of compute pair/local: rows of both stand side by side in dump "
                    "local.\n\n"
                    "`natom1 natom2 ntype1 ntype2` are the same of all pairs that were within cutoff and skin when "
                    "the lists were made last, for which `cutoff` has no meaning. Values of bonds, angles and so on "
                    "(`batom1` ...) are refused: there are none. With one value it is `c_ID`, with several `c_ID[1]` "
                    "and so on.",
         .example =
             "compute i all property/local patom1 patom2 ptype1 ptype2\ncompute n all property/local natom1 natom2"},
    .state_size = sizeof(hs_pair_columns),
    .create = create,
    .destroy = hs_pair_columns_destroy,
    .local = hs_pair_columns_local,
};
