/* Commands of dumps: dump, dump_modify, undump, write_dump. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "deck/command.h"
#include "io/dump_table.h"

/** A style's name at word i, its file at word @p file and its own words from word @p first on, before anything runs. */
static hs_status check_style(const hs_args *args, int i, int file, int first, int n_words, hs_error *err)
{
    const char *names[256] = {NULL};
    size_t n = 0;
    if (strchr(args->word[i], '$') != NULL) return HS_OK;
    const hs_dump_style *style = NULL;
    for (size_t k = 0; hs_dump_styles[k] != NULL && n < 256; ++k) {
        names[n++] = hs_dump_styles[k]->about.name;
        if (strcmp(hs_dump_styles[k]->about.name, args->word[i]) == 0) style = hs_dump_styles[k];
    }
    if (style == NULL) {
        const char *nearest = hs_text_nearest(args->word[i], names, n);
        return hs_fail(err, HS_ERROR_INPUT, "%s: unknown style '%s'; %s%s%s", args->command, args->word[i],
                       nearest != NULL ? "did you mean '" : "'halfshell help' lists those there are",
                       nearest != NULL ? nearest : "", nearest != NULL ? "'?" : "");
    }
    const hs_args words = {.command = args->command, .n = n_words, .word = args->word + first};
    HS_TRY(hs_syntax_check(&style->about.syntax, &words, true, err));
    if (style->check == NULL) return HS_OK;
    char command[64];
    snprintf(command, sizeof command, "%s %s", args->command, style->about.name);
    const hs_args own = {.command = command, .n = n_words, .word = args->word + first};
    return style->check(args->word[file], &own, err);
}

static hs_status check_dump(const hs_args *args, bool has_variables, hs_error *err)
{
    int64_t every;
    (void)has_variables;
    if (strchr(args->word[3], '$') == NULL) HS_TRY(hs_arg_int(args, 3, 1, INT64_MAX, &every, err));
    return check_style(args, 2, 4, 5, args->n - 5, err);
}

static hs_status run_dump(hs_deck *deck, const hs_args *args, hs_error *err)
{
    int64_t every;
    const hs_args words = hs_args_from(args, 5, NULL);
    HS_TRY(hs_sim_need_box(deck->sim, args->command, err));
    HS_TRY(hs_arg_int(args, 3, 1, INT64_MAX, &every, err));
    return hs_sim_add_dump(deck->sim, args->word[0], args->word[1], args->word[2], every, args->word[4], &words, err);
}

/** The dump that a command names. */
static hs_status find_dump(hs_deck *deck, const hs_args *args, hs_dump **dump, hs_error *err)
{
    const char *names[256];
    size_t n = 0;
    *dump = hs_sim_find_dump(deck->sim, args->word[0]);
    if (*dump != NULL) return HS_OK;
    for (int k = 0; k < deck->sim->n_dumps && n < 256; ++k) names[n++] = deck->sim->dump[k]->id;
    const char *nearest = hs_text_nearest(args->word[0], names, n);
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no dump '%s'%s%s%s", args->command, args->word[0],
                   nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'?" : "");
}

static hs_status run_dump_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_dump *dump;
    const hs_args words = hs_args_from(args, 1, NULL);
    HS_TRY(find_dump(deck, args, &dump, err));
    return hs_dump_modify(dump, &words, err);
}

static hs_status run_undump(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_dump *dump;
    HS_TRY(find_dump(deck, args, &dump, err));
    return hs_sim_remove_dump(deck->sim, args->word[0], err);
}

/** Place of the word `modify` of write_dump, args->n without one. */
static int find_modify(const hs_args *args)
{
    int i = 3;
    while (i < args->n && strcmp(args->word[i], "modify") != 0) ++i;
    return i;
}

static hs_status check_write_dump(const hs_args *args, bool has_variables, hs_error *err)
{
    const int modify = find_modify(args);
    const hs_syntax syntax = {.usage = "... modify <keyword> <value> ...", .keywords = hs_dump_modify_keywords};
    const hs_args words = hs_args_from(args, modify + 1, NULL);
    HS_TRY(check_style(args, 1, 2, 3, modify - 3, err));
    return hs_syntax_check(&syntax, &words, has_variables, err);
}

/** A dump that lives for one snapshot. */
static hs_status run_write_dump(hs_deck *deck, const hs_args *args, hs_error *err)
{
    static const char id[] = "WRITE_DUMP";
    const int modify = find_modify(args);
    const hs_args words = {.command = args->command, .n = modify - 3, .word = args->word + 3};
    const hs_args changes = hs_args_from(args, modify + 1, NULL);
    HS_TRY(hs_sim_need_box(deck->sim, args->command, err));
    HS_TRY(hs_sim_add_dump(deck->sim, id, args->word[0], args->word[1], 1, args->word[2], &words, err));
    hs_dump *dump = hs_sim_find_dump(deck->sim, id);
    dump->is_single = true;
    hs_status status = hs_dump_modify(dump, &changes, err);
    if (status == HS_OK) status = dump->style->init(dump, err);
    if (status == HS_OK && !deck->options.dry_run) status = dump->style->write(dump, err);
    hs_error ignored = {0};
    const hs_status removed = hs_sim_remove_dump(deck->sim, id, status == HS_OK ? err : &ignored);
    return status != HS_OK ? status : removed;
}

const hs_command hs_commands_dump[] = {
    {.about =
         {.name = "dump",
          .syntax = {.usage = "<ID> <group-ID> <style> <N> <output-file> [words of the style]",
                     .n_min = 5,
                     .n_max = -1},
          .summary = "Write snapshots of atoms every N steps",
          .details =
              "A `*` in the file's name becomes the step: one file a snapshot, which appears whole or not at all. "
              "Without it all snapshots go to one file, emptied at the start (`dump_modify append yes` adds to it); "
              "only whole snapshots are added. A name ending in `.gz` is compressed. The styles are listed under "
              "dumps.",
          .example = "dump 1 all atom 100 run.dump\ndump 2 mobile custom 1000 run.*.dump.gz id type x y z"},
     .run = run_dump,
     .check = check_dump},
    {.about =
         {.name = "dump_modify",
          .syntax =
              {.usage = "<dump-ID> <keyword> <value> ...", .n_min = 1, .n_max = 1, .keywords = hs_dump_modify_keywords},
          .summary = "Change what a dump writes and when",
          .details =
              "Formats are those of printf with one conversion; a column's own (`format N`) wins over `format int` and "
              "`format float`, these over `format line`. Keywords of LAMMPS that are not listed are refused.",
          .example = "dump_modify 1 sort id format float %20.15g\ndump_modify 2 element Ar Kr thresh x < 10"},
     .run = run_dump_modify},
    {.about = {.name = "undump",
               .syntax = {.usage = "<dump-ID>", .n_min = 1, .n_max = 1},
               .summary = "End a dump",
               .details = "The file is closed and the ID is free again.",
               .example = "undump 1"},
     .run = run_undump},
    {.about =
         {.name = "write_dump",
          .syntax = {.usage = "<group-ID> <style> <output-file> [words of the style] [modify <keyword> <value> ...]",
                     .n_min = 3,
                     .n_max = -1},
          .summary = "Write one snapshot of atoms now",
          .details =
              "As a dump would, with the keywords of dump_modify after `modify`. The file appears whole or not at all.",
          .example = "write_dump all custom last.dump id type x y z modify sort id"},
     .run = run_write_dump,
     .check = check_write_dump},
    {.run = NULL},
};
