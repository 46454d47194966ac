/* Distance, energy and force of each pair of atoms. */
#include <string.h>

#include "style/pair_columns.h"

/** In the order of hs_pair_quantity. */
static const char *const words[] = {"dist", "dx", "dy", "dz", "eng", "force", "fx", "fy", "fz", NULL};

static bool is_extra(const char *word)
{
    return word[0] == 'p' && word[1] != '\0' && strspn(word + 1, "0123456789") == strlen(word + 1);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    const int n = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    for (int i = 0, which; i < n; ++i) {
        if (is_extra(args->word[i]))
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: '%s': no pair style here has values of a pair beside energy and force", args->command,
                           args->word[i]);
        HS_TRY(hs_arg_choice(args, i, words, &which, err));
        HS_TRY(hs_pair_columns_add(compute, (hs_pair_quantity)which, err));
    }
    return hs_pair_columns_read_cutoff(compute, args, n, err);
}

const hs_compute_style hs_compute_style_pair_local = {
    .about = {.name = "pair/local",
              .syntax = {.usage = "<value> ... [cutoff type|radius]",
                         .n_min = 1,
                         .n_max = -1,
                         .keywords = hs_pair_columns_keywords},
              .summary = "distance, energy and force of each pair of atoms",
              .details =
                  "Local values: a row for each pair of atoms of the group that is nearer than the cutoff of its "
                  "types (of pairs that `neigh_modify` leaves out, or that late lists miss, there is none; where a "
                  "fix changes the box at the end of a step, at the places before). With one value it is `c_ID`, with "
                  "several `c_ID[1]` and so on: `dist` is the distance, `dx dy dz` its components, from the atom of "
                  "the higher id to that of the lower (distance units); `eng` the energy of the pair (energy units), "
                  "`force` the force between its atoms, positive where they repel each other, `fx fy fz` the "
                  "components of that on the atom of the lower id (energy/distance).\n\n"
                  "Rows are in the order of the lower id, then of the higher one, whatever the number of ranks and "
                  "threads and the neighbor method; of several images of one pair in small boxes in that of `dx`, "
                  "`dy`, `dz`. Compute property/local tells their ids and types, row by row. Rows are read by dump "
                  "local, compute reduce and fix ave/histo, not by thermo output and formulas, which need numbers.\n\n"
                  "`cutoff radius` takes pairs nearer than the sum of their radii (`atom_style sphere`), if they are "
                  "in the lists. `pair_style zero` gives a cutoff, and so pairs, without forces. Without pairs in the "
                  "first place, before a run has made lists or with `pair_style none`, there is an error. The pairs "
                  "are found anew for each evaluation, which takes some timesteps' time.",
              .example = "compute p all pair/local dist eng fx fy fz\ncompute i all property/local patom1 patom2\n"
                         "dump d all local 1000 pairs.*.dump index c_i[*] c_p[*]"},
    .state_size = sizeof(hs_pair_columns),
    .create = create,
    .destroy = hs_pair_columns_destroy,
    .local = hs_pair_columns_local,
};
