/* The command thermo_modify. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "io/user_format.h"
#include "sim/thermo_internal.h"

const hs_keyword hs_thermo_modify_keywords[] = {
    {"lost", 1, "error|warn|ignore", "what to do when atoms are missing (default error)"},
    {"lost/bond", 1, "error|warn|ignore", "the same for atoms of bonds; there are none, so it changes nothing"},
    {"warn", 1, "<ignore | reset | default | N>", "print no warnings, count anew, print at most 100, or at most N"},
    {"norm", 1, "yes|no", "energies per atom (default yes in lj units, else no)"},
    {"flush", 1, "yes|no", "write every row to disk at once (default no)"},
    {"line", 1, "one|multi", "a row on one line, or several lines of name = value"},
    {"format", -1, "<line 'formats' | int format | float format | N format | none>", "printf formats of the numbers"},
    {"means", 1, "yes|no",
     "a table of means with standard errors after the run, and the drift of the energy (default no)"},
    {"temp", 1, "<compute>", "temperature compute for temp, ke, etotal (default thermo_temp)"},
    {"press", 1, "<compute>", "pressure compute for press, pxx, ... (default thermo_press)"},
    {NULL, 0, NULL, NULL},
};

static void forget_formats(hs_thermo *thermo)
{
    HS_FREE(thermo->format_line);
    HS_FREE(thermo->format_int);
    HS_FREE(thermo->format_float);
    for (int k = 0; k < thermo->n_columns; ++k) HS_FREE(thermo->column[k].user_format);
}

/** Check a format by its kind before it is kept. */
static hs_status set_format(char **target, const char *format, hs_format_kind kind, hs_error *err)
{
    char *normalized;
    HS_TRY(hs_format_normalize(&normalized, format, kind, "thermo_modify format", err));
    HS_FREE(normalized);
    return hs_memory_replace(target, format, err);
}

/** format line S | int S | float S | N S | none, from word i on; *n_used words. */
static hs_status modify_format(hs_thermo *thermo, const hs_args *args, int i, int *n_used, hs_error *err)
{
    int64_t column;
    HS_TRY(hs_arg_need(args, i, "a word after format (line, int, float, a column number, none)", err));
    *n_used = 1;
    if (strcmp(args->word[i], "none") == 0) {
        forget_formats(thermo);
        return HS_OK;
    }
    *n_used = 2;
    HS_TRY(hs_arg_need(args, i + 1, "the format itself", err));
    const char *format = args->word[i + 1];
    if (strcmp(args->word[i], "line") == 0) {
        if (hs_format_class(format) == 0) return hs_arg_refuse(args, i + 1, "a line of printf formats", NULL, err);
        return hs_memory_replace(&thermo->format_line, format, err);
    }
    if (strcmp(args->word[i], "int") == 0) return set_format(&thermo->format_int, format, HS_FORMAT_INT, err);
    if (strcmp(args->word[i], "float") == 0) return set_format(&thermo->format_float, format, HS_FORMAT_FLOAT, err);
    if (!hs_text_to_int64(args->word[i], &column)) {
        static const char *const words[] = {"line", "int", "float", "none", NULL};
        return hs_arg_refuse(args, i, "line, int, float, none or a column number", words, err);
    }
    if (column < 1 || column > thermo->n_columns)
        return hs_fail(err, HS_ERROR_INPUT, "%s: format %lld: the columns are 1 to %d", args->command,
                       (long long)column, thermo->n_columns);
    hs_thermo_column *target = &thermo->column[column - 1];
    return set_format(&target->user_format, format, hs_thermo_is_int(target) ? HS_FORMAT_INT : HS_FORMAT_FLOAT, err);
}

static hs_status modify_compute(hs_thermo *thermo, const hs_args *args, int i, bool is_temp, hs_error *err)
{
    hs_compute *compute;
    HS_TRY(hs_compute_get(&thermo->sim->env, args->word[i], is_temp ? HS_TEMPERATURE : HS_PRESSURE, args->command,
                          &compute, err));
    HS_TRY(hs_memory_replace(is_temp ? &thermo->temp_id : &thermo->press_id, args->word[i], err));
    if (!is_temp) return HS_OK;
    if (compute->group != 0)
        hs_warn(thermo->sim->env.out, "the temperature of thermo output is that of %s, not of all atoms",
                hs_compute_who(compute).text);
    /* as LAMMPS does, the pressure follows the temperature */
    hs_compute *press = hs_sim_find_compute(thermo->sim, thermo->press_id != NULL ? thermo->press_id : "thermo_press");
    if (press == NULL || press->style->set_temperature == NULL) return HS_OK;
    return press->style->set_temperature(press, args->word[i], err);
}

static hs_status modify_warn(hs_thermo *thermo, const hs_args *args, int i, hs_error *err)
{
    hs_sink *out = thermo->sim->env.out;
    int64_t limit;
    if (strcmp(args->word[i], "ignore") == 0) {
        out->warning_limit = -1;
    } else if (strcmp(args->word[i], "reset") == 0) {
        out->n_warnings = 0;
    } else if (strcmp(args->word[i], "default") == 0) {
        out->warning_limit = 100;
    } else {
        HS_TRY(hs_arg_int(args, i, 0, INT32_MAX, &limit, err));
        out->warning_limit = limit > 0 ? (long)limit : -1;
    }
    return HS_OK;
}

/** The keyword at word i; *n_used words in all. */
static hs_status modify_keyword(hs_thermo *thermo, const hs_args *args, int i, int *n_used, hs_error *err)
{
    static const char *const lost_modes[] = {"error", "warn", "ignore", NULL};
    static const char *const lines[] = {"one", "multi", NULL};
    const char *keyword = args->word[i];
    bool is_yes;
    int choice;
    *n_used = 2;
    if (strcmp(keyword, "lost") == 0 || strcmp(keyword, "lost/bond") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, lost_modes, &choice, err));
        if (strcmp(keyword, "lost") == 0) thermo->lost = choice;
        return HS_OK;
    }
    if (strcmp(keyword, "line") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, lines, &choice, err));
        thermo->is_multi_line = choice == 1;
        return HS_OK;
    }
    if (strcmp(keyword, "means") == 0) return hs_arg_bool(args, i + 1, &thermo->has_means, err);
    if (strcmp(keyword, "norm") == 0 || strcmp(keyword, "flush") == 0) {
        HS_TRY(hs_arg_bool(args, i + 1, &is_yes, err));
        if (strcmp(keyword, "norm") == 0)
            thermo->norm = is_yes;
        else
            thermo->flush = is_yes;
        return HS_OK;
    }
    if (strcmp(keyword, "temp") == 0 || strcmp(keyword, "press") == 0)
        return modify_compute(thermo, args, i + 1, strcmp(keyword, "temp") == 0, err);
    if (strcmp(keyword, "warn") == 0) return modify_warn(thermo, args, i + 1, err);
    HS_TRY(modify_format(thermo, args, i + 1, n_used, err));
    ++*n_used;
    return HS_OK;
}

hs_status hs_thermo_modify(hs_thermo *thermo, const hs_args *args, hs_error *err)
{
    const hs_syntax syntax = {.usage = "keyword value ...", .keywords = hs_thermo_modify_keywords};
    HS_TRY(hs_syntax_check(&syntax, args, false, err));
    for (int i = 0, n_used; i < args->n; i += n_used) HS_TRY(modify_keyword(thermo, args, i, &n_used, err));
    thermo->is_modified = true;
    return HS_OK;
}
