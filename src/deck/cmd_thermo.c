/* Commands of thermodynamic output: thermo, thermo_style, thermo_modify. */
#include <string.h>

#include "deck/command.h"
#include "sim/thermo.h"

static hs_status run_thermo(hs_deck *deck, const hs_args *args, hs_error *err)
{
    int64_t every;
    if (strncmp(args->word[0], "v_", 2) == 0 && args->word[0][2] != '\0')
        return hs_thermo_set_every_variable(deck->sim->thermo, args->word[0] + 2, err);
    HS_TRY(hs_arg_int(args, 0, 0, INT64_MAX, &every, err));
    hs_thermo_set_every(deck->sim->thermo, every);
    return HS_OK;
}

static hs_status check_thermo(const hs_args *args, bool has_variables, hs_error *err)
{
    int64_t every;
    (void)has_variables;
    if (strchr(args->word[0], '$') != NULL || strncmp(args->word[0], "v_", 2) == 0) return HS_OK;
    return hs_arg_int(args, 0, 0, INT64_MAX, &every, err);
}

static hs_status run_thermo_style(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const hs_args words = hs_args_from(args, 1, NULL);
    return hs_thermo_set_style(deck->sim->thermo, args->word[0], &words, err);
}

/** The style and, for custom, every word that does not depend on a variable. */
static hs_status check_thermo_style(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const styles[] = {"one", "multi", "custom", NULL};
    int style;
    (void)has_variables;
    if (strchr(args->word[0], '$') != NULL) return HS_OK;
    HS_TRY(hs_arg_choice(args, 0, styles, &style, err));
    if (strcmp(args->word[0], "custom") != 0) {
        if (args->n == 1 || strchr(args->word[1], '$') != NULL) return HS_OK;
        return hs_fail(err, HS_ERROR_INPUT,
                       "thermo_style %s: unexpected word '%s'; only custom takes a list of keywords", args->word[0],
                       args->word[1]);
    }
    for (int i = 1; i < args->n; ++i) {
        const char *nearest = hs_thermo_check_word(args->word[i]);
        if (nearest == NULL) continue;
        if (nearest[0] != '\0')
            return hs_fail(err, HS_ERROR_INPUT, "thermo_style custom: unknown keyword '%s'; did you mean '%s'?",
                           args->word[i], nearest);
        return hs_fail(err, HS_ERROR_INPUT,
                       "thermo_style custom: unknown keyword '%s'; a column is a thermo keyword, c_ID, c_ID[i], f_ID, "
                       "f_ID[i] or v_name",
                       args->word[i]);
    }
    return HS_OK;
}

static hs_status run_thermo_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    return hs_thermo_modify(deck->sim->thermo, args, err);
}

const hs_command hs_commands_thermo[] = {
    {.about = {.name = "thermo",
               .syntax = {.usage = "<N | v_name>", .n_min = 1, .n_max = 1},
               .summary = "Write a row of thermodynamic output every N steps",
               .details = "The first and the last step of a run always have a row; with N = 0, the default, only they "
                          "have. With `v_name` the variable gives the step of the next row, is evaluated anew at each "
                          "row; the last step has one if one between it and the first has.",
               .example = "thermo 100\nvariable s equal logfreq(10,3,10)\nthermo v_s"},
     .run = run_thermo,
     .check = check_thermo},
    {.about =
         {.name = "thermo_style",
          .syntax = {.usage = "<one | multi | custom> [<keyword> ...]", .n_min = 1, .n_max = -1},
          .summary = "Choose the columns of thermodynamic output",
          .details =
              "`one` (the default) writes Step, Temp, E_pair, E_mol, TotEng, Press and, when the box can change, "
              "Volume on a line. `multi` writes energies, temperature and pressure as name = value on several lines. "
              "`custom` writes the columns that the keywords name: thermo keywords (`halfshell help thermo_style` "
              "lists them), `c_ID` and `c_ID[i]` of computes, `f_ID` and `f_ID[i]` of fixes, `v_name` of variables; "
              "`c_ID[*]` and `c_ID[2*4]` stand for several elements and need the compute to exist. Energies are per "
              "atom in lj units (`thermo_modify norm`). The command sets everything of thermo_modify back.",
          .example = "thermo_style custom step temp pe press c_mine[2] v_ratio"},
     .run = run_thermo_style,
     .check = check_thermo_style},
    {.about =
         {.name = "thermo_modify",
          .syntax = {.usage = "<keyword> <value> ...", .n_min = 0, .n_max = 0, .keywords = hs_thermo_modify_keywords},
          .summary = "Change numbers, formats and checks of thermodynamic output",
          .details =
              "Formats are those of printf with one conversion: `%d` for whole numbers, `%e`, `%f` or `%g` for others. "
              "A column's own format (`format N`) wins over `format int` and `format float`, these over `format line`, "
              "which has one word for each column. `temp` and `press` name computes; the pressure then uses that "
              "temperature. `means yes` prints after each run, below what log readers look at, the mean of each column "
              "over the rows of the run (without the first, which is the last of the run before), its standard error "
              "and statistical inefficiency from blocks of rows, and the drift of the total energy per atom and time.",
          .example = "thermo_modify norm no flush yes\nthermo_modify format float %15.8g format 1 %10d"},
     .run = run_thermo_modify},
    {.run = NULL},
};
