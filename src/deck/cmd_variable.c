/* Commands about variables, and words of LAMMPS about its surroundings: variable, shell, package, suffix. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/variables.h"

static hs_status variable_check(const hs_args *args, bool has_variables, hs_error *err)
{
    return hs_variables_check(args, has_variables, err);
}

static hs_status variable_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    return hs_variables_define(deck, args, err);
}

static hs_status shell_check(const hs_args *args, bool has_variables, hs_error *err)
{
    if (has_variables && args->n > 0 && strchr(args->word[0], '$') != NULL) return HS_OK;
    if (args->n > 0 && strcmp(args->word[0], "mkdir") == 0) return hs_arg_need(args, 1, "the name of a folder", err);
    return hs_fail(err, HS_ERROR_INPUT,
                   "shell: a deck can make folders (shell mkdir), but not run programs or change files around it; do "
                   "that in a script that calls Halfshell (-var hands values in, print ... file hands them out)");
}

/** Make a folder and those it is in; one that is there already is left alone. */
static hs_status make_folder(const char *name, hs_error *err)
{
    char *path;
    HS_TRY(hs_memory_strdup(&path, name, err));
    int reason = 0;
    for (char *at = path; at != NULL && reason == 0;) {
        at = strchr(at + 1, '/');
        if (at != NULL) *at = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST) reason = errno;
        if (at != NULL) *at = '/';
    }
    struct stat what;
    if (reason == 0 && (stat(path, &what) != 0 || !S_ISDIR(what.st_mode))) reason = ENOTDIR;
    HS_FREE(path);
    return reason == 0 ? HS_OK
                       : hs_fail(err, HS_ERROR_IO, "shell mkdir: the folder '%.400s' cannot be made: %s", name,
                                 strerror(reason));
}

static hs_status shell_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(shell_check(args, false, err));
    if (deck->options.dry_run) return HS_OK;
    if (deck->sim->parallel.rank == 0)
        for (int i = 1; i < args->n; ++i)
            if (strcmp(args->word[i], "-p") != 0) HS_UNLESS_FAILED(err, make_folder(args->word[i], err));
    return hs_parallel_agree(&deck->sim->parallel, err);
}

static hs_status package_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const packages[] = {"gpu", "intel", "kokkos", "omp", NULL};
    int which;
    if (has_variables) return HS_OK;
    return hs_arg_choice(args, 0, packages, &which, err);
}

static hs_status suffix_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const words[] = {"off", "on", "hybrid", "gpu", "intel", "kk", "omp", "opt", NULL};
    int which;
    if (has_variables) return HS_OK;
    HS_TRY(hs_arg_choice(args, 0, words, &which, err));
    const int n_wanted = strcmp(args->word[0], "hybrid") == 0 ? 3 : 1;
    if (args->n == n_wanted) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "suffix: expected: suffix on|off|gpu|intel|kk|omp|opt, or suffix hybrid <first> <second>");
}

static hs_status no_effect_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)err;
    hs_say(deck->out, "The command %s has no effect: Halfshell chooses its own kernels\n", args->command);
    return HS_OK;
}

const hs_command hs_commands_variable[] = {
    {
        .about =
            {
                .name = "variable",
                .syntax = {"<name> "
                           "index|loop|file|string|format|getenv|equal|vector|atom|atomfile|internal|universe|uloop|"
                           "world|delete <words>",
                           2, -1, NULL},
                .summary = "Define a variable",
                .details =
                    "| style | words | value |\n"
                    "|---|---|---|\n"
                    "| `index` | `<value> ...` | one of the values; `next` goes on to the next one |\n"
                    "| `loop` | `<N>` or `<N1> <N2>`, `[pad]` | 1 to N, or N1 to N2; `pad` writes all with equally "
                    "many digits |\n"
                    "| `file` | `<file>` | the first word of each line that has one (`#` begins a comment), one after "
                    "the other by `next`, as with index |\n"
                    "| `string` | `<text>` | the text |\n"
                    "| `format` | `<variable> <format>` | the number of another variable in a format such as `%10.4f` "
                    "|\n"
                    "| `getenv` | `<name>` | an environment variable |\n"
                    "| `equal` | `<formula>` | the formula's value whenever it is asked for |\n"
                    "| `vector` | `<formula>` | a vector; the formula is made of vectors of computes, fixes and "
                    "other vector variables, all equally long, and of numbers |\n"
                    "| `atom` | `<formula>` | one value per atom |\n"
                    "| `atomfile` | `<file>` | one value per atom, from the file; the next set by `next` |\n"
                    "| `internal` | `<number>` | a number that other commands set |\n"
                    "| `universe` | `<value> ...` | as index: LAMMPS shares such values among partitions of the "
                    "processors, and Halfshell has one partition |\n"
                    "| `uloop` | `<N> [pad]` | as loop, for the same reason |\n"
                    "| `world` | `<value>` | the value of the one partition, as string |\n"
                    "| `delete` | | the variable is forgotten |\n\n"
                    "`$x` (one letter) or `${name}` puts a variable's value into a line before it is carried "
                    "out, `$(formula)` that of a formula\n"
                    "(`$(formula:%fmt)` in a format); not within quotes, except in the texts of `print` and "
                    "`if`. `index`, `loop`, `file`, `atomfile`, `universe`, `uloop`, `world` and `getenv`\n"
                    "variables that exist already keep their value, so that the option `-var` wins; "
                    "`string`, `format`, `equal`, `vector`, `atom` and\n"
                    "`internal` ones are replaced.\n"
                    "\n"
                    "A set of an atomfile is a line with the number of its values, then as many lines `<atom "
                    "ID> <value>`; atoms that it does not name have 0. Blank lines and what follows `#` do "
                    "not count. The values go with the atoms; `clear` deletes the variable with them.\n"
                    "\n"
                    "Formulas know `+ - * / % ^`, `== != < <= > >=`, `&& || |^ !`, parentheses, where signs "
                    "bind tighter than `^`, so that `-2^2`\n"
                    "is 4; `PI`, `version`, `yes`, `no`, `true`, `false`, `on`, `off`; thermo keywords; "
                    "`c_ID`, `c_ID[i]` of computes and\n"
                    "`f_ID`, `f_ID[i]` of fixes; `v_name`, rounded to 15 digits as in LAMMPS; `v_name[i]`, "
                    "element i of a vector or the value of atom i; `x[ID]` and the like for one atom. In "
                    "`atom`\n"
                    "style also `id mass type x y z vx vy vz fx fy fz`. In `vector` style `c_ID` and `f_ID` "
                    "are numbers where there is one, else vectors; `c_ID[j]` and `f_ID[j]` are elements of a "
                    "vector, else columns of an array; operators and functions work element by element.\n"
                    "\n"
                    "Functions: `sqrt exp ln log abs sin cos tan asin acos atan atan2 random normal ceil "
                    "floor round`; of time `ramp stagger\n"
                    "logfreq logfreq2 logfreq3 stride stride2 vdisplace swiggle cwiggle`; of groups `count "
                    "mass xcm vcm fcm bound gyration ke\n"
                    "angmom torque inertia omega` with the group, `x`, `y` or `z` where there is a "
                    "direction, and optionally a region,\n"
                    "which are 0 without atoms (bound 1e20 or -1e20); of vectors\n"
                    "`sum min max ave trap slope`; per atom `gmask rmask grmask`; `next` of file and "
                    "atomfile variables; `is_defined is_available is_file`.\n"
                    "\n"
                    "Division by zero, roots and logarithms of numbers that have none, and results that are "
                    "not finite are errors. LAMMPS's styles\n"
                    "`python` and `timer` are refused.\n",
                .example = "variable T index 0.7 0.8 0.9\nvariable p equal press*2.0\nvariable r atom sqrt(x*x+y*y)\n"
                           "variable d vector c_msd-f_old\nprint \"at T = $T: $p, $(temp:%.3f)\"",
            },
        .run = variable_run,
        .check = variable_check,
    },
    {
        .about =
            {
                .name = "shell",
                .syntax = {"mkdir <folder> ...", 0, -1, NULL},
                .summary = "Make folders; nothing else of a shell",
                .details =
                    "Folders that are there already are left alone; those on the way are made, too. A deck runs no "
                    "programs, and changes no files but its own. Let a script call Halfshell: `-var` hands "
                    "values in, `print ... file` hands them out.\n",
                .example = "shell mkdir frames\ndump 1 all custom 100 frames/*.dump id x y z",
            },
        .run = shell_run,
        .check = shell_check,
    },
    {
        .about =
            {
                .name = "package",
                .syntax = {"gpu|intel|kokkos|omp <words>", 1, -1, NULL},
                .summary = "Settings of LAMMPS's accelerators, accepted without effect",
                .details = "Halfshell chooses its own kernels; threads are set with the option `-threads`.\n",
                .example = "package omp 4",
            },
        .run = no_effect_run,
        .check = package_check,
    },
    {
        .about =
            {
                .name = "suffix",
                .syntax = {"on|off|gpu|intel|kk|omp|opt, or hybrid <first> <second>", 1, 3, NULL},
                .summary = "Variants of LAMMPS's styles, accepted without effect",
                .details = "Halfshell has one variant of each style and chooses its kernels itself. Names of "
                           "LAMMPS's variants (`lj/cut/omp`, `nve/kk`, ...) mean the style itself.\n",
                .example = "suffix omp",
            },
        .run = no_effect_run,
        .check = suffix_check,
    },
    {.about = {.name = NULL}},
};
