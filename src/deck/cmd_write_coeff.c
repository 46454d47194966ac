/* The command write_coeff: the pair style's coefficients as commands of a deck. */
#include "deck/command.h"
#include "io/writer.h"

/** Coefficients of the pairs of types that a part acts on; @p number: which of the parts of that name, 0: the only one. */
static hs_status write_part(hs_writer *writer, const hs_pair *pair, const hs_pair *part, int number, hs_error *err)
{
    hs_text words = {0};
    hs_status status = HS_OK;
    for (int i = 1; i <= part->n_types && status == HS_OK; ++i)
        for (int j = i; j <= part->n_types && status == HS_OK; ++j) {
            if (!(part->cutoff[hs_pair_index(part, i, j)] > 0.0)) continue;
            hs_text_clear(&words);
            status = part->style->write_coeff(part, i, j, &words, err);
            if (status == HS_OK) status = hs_writer_printf(writer, err, "pair_coeff %d %d ", i, j);
            if (status == HS_OK && part != pair) status = hs_writer_printf(writer, err, "%s ", part->style->about.name);
            if (status == HS_OK && number > 0) status = hs_writer_printf(writer, err, "%d ", number);
            if (status == HS_OK) status = hs_writer_printf(writer, err, "%s\n", hs_text_get(&words));
        }
    hs_text_fini(&words);
    return status;
}

/** Number of part k among those of its name, from 1; 0: there is only one. */
static int number_of(const hs_pair *pair, int k)
{
    int n = 0, number = 0;
    for (int other = 0; other < pair->n_parts; ++other) {
        if (pair->part[other]->style != pair->part[k]->style) continue;
        ++n;
        if (other == k) number = n;
    }
    return n > 1 ? number : 0;
}

/** On one rank. */
static hs_status write_file(const hs_sim *sim, const char *file, hs_error *err)
{
    const hs_pair *pair = sim->pair;
    hs_writer *writer = NULL;
    HS_TRY(hs_writer_open(&writer, file, HS_WRITE_WHOLE, err));
    hs_status status = hs_writer_printf(writer, err, "# coefficients of\n# pair_style %s\n", pair->style->about.name);
    for (int k = 0; k < pair->n_parts && status == HS_OK; ++k)
        if (pair->part[k]->style->evaluator != NULL)
            status = write_part(writer, pair, pair->part[k], number_of(pair, k), err);
    if (status == HS_OK) return hs_writer_close(&writer, err);
    hs_writer_abandon(&writer);
    return status;
}

static hs_status run_write_coeff(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(hs_sim_need_pair(sim, args->command, err));
    HS_TRY(hs_sim_setup_pair(sim, err));
    sim->is_initialized = false;
    for (int k = 0; k < sim->pair->n_parts; ++k) {
        const hs_pair_style *style = sim->pair->part[k]->style;
        if (style->evaluator != NULL && style->write_coeff == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "write_coeff: the coefficients of pair_style %s are no list of numbers",
                           style->about.name);
    }
    deck->is_unwritten = true;
    if (deck->options.dry_run) return HS_OK;
    if (sim->parallel.rank == 0) HS_UNLESS_FAILED(err, write_file(sim, args->word[0], err));
    return hs_parallel_agree(&sim->parallel, err);
}

const hs_command hs_commands_write_coeff[] = {
    {
        .about =
            {
                .name = "write_coeff",
                .syntax = {"<output-file>", 1, 1, NULL},
                .summary = "Write the pair style's coefficients as commands",
                .details =
                    "The file has a line `pair_coeff I J ...` for each pair of types that interacts, with the "
                    "coefficients in force, mixed ones included, and all their digits: `include` reads it after the "
                    "pair_style. Styles whose coefficients come from files (table) are refused. The file appears "
                    "whole or not at all.\n",
                .example = "write_coeff mixed.coeff\npair_style lj/cut 2.5\ninclude mixed.coeff",
            },
        .run = run_write_coeff,
    },
    {.about = {.name = NULL}},
};
