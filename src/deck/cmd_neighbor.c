/* Commands of the neighbor search and of communication: neighbor, neigh_modify, neighbor_method,
 * precision, reproducible, comm_modify, comm_style. */
#include <string.h>

#include "base/memory.h"
#include "deck/command.h"
#include "sim/methods.h"

static hs_status run_neighbor(hs_deck *deck, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"bin", "nsq", "multi", "multi/old", NULL};
    int style;
    HS_TRY(hs_arg_not_negative(args, 0, &deck->sim->neighbor.settings.skin, err));
    deck->sim->is_initialized = false;
    return hs_arg_choice(args, 1, styles, &style, err);
}

static const hs_keyword modify_keywords[] = {
    {"delay", 1, "<steps>", "build no list sooner than this after the last (default 10)"},
    {"every", 1, "<steps>", "consider building only every so many steps (default 1)"},
    {"check", 1, "yes|no", "build only when an atom has moved more than half the skin (default yes)"},
    {"once", 1, "yes|no", "build at the start of a run only (default no)"},
    {"exclude", -1, "type <i> <j> | group <group-ID> <group-ID> | none", "pairs that do not interact"},
    {"page", 1, "<n>", "accepted: Halfshell's lists grow by themselves"},
    {"one", 1, "<n>", "accepted: Halfshell's lists grow by themselves"},
    {"cluster", 1, "yes|no", "accepted: for bonded atoms, which there are none of"},
    {"binsize", 1, "<length>", "accepted: cells are laid out by `neighbor_method`"},
    {"collection/type", -1, "<N> <types> ...", "accepted: it is for LAMMPS's style `multi`"},
    {"collection/interval", -1, "<N> <r> ...", "accepted: it is for LAMMPS's style `multi`"},
    {"include", 1, "<group-ID>", "only `all` is supported"},
    {0},
};

static hs_status add_exclusion(hs_sim *sim, hs_exclusion exclusion, hs_error *err)
{
    hs_neighbor_settings *settings = &sim->neighbor.settings;
    HS_TRY(HS_GROW(settings->exclusion, (size_t)settings->n_exclusions, (size_t)settings->n_exclusions + 1, err));
    settings->exclusion[settings->n_exclusions++] = exclusion;
    return HS_OK;
}

/** exclude type I J | group G1 G2 | none, at word i; *n_used is how many words it took. */
static hs_status exclude(hs_sim *sim, const hs_args *args, int i, int *n_used, hs_error *err)
{
    static const char *const kinds[] = {"type", "group", "none", "molecule/intra", "molecule/inter", "molecule", NULL};
    int kind;
    HS_TRY(hs_arg_choice(args, i + 1, kinds, &kind, err));
    *n_used = 4;
    if (kind == 0) {
        int64_t a, b;
        HS_TRY(hs_sim_need_box(sim, "neigh_modify exclude type", err));
        HS_TRY(hs_arg_type(args, i + 2, sim->atoms.n_types, &a, err));
        HS_TRY(hs_arg_type(args, i + 3, sim->atoms.n_types, &b, err));
        return add_exclusion(sim, (hs_exclusion){HS_EXCLUDE_TYPE, (int)a, (int)b}, err);
    }
    if (kind == 1) {
        int a, b;
        HS_TRY(hs_arg_need(args, i + 3, "a second group-ID", err));
        HS_TRY(hs_groups_get(&sim->groups, args->word[i + 2], &a, err));
        HS_TRY(hs_groups_get(&sim->groups, args->word[i + 3], &b, err));
        if (sim->groups.dynamic & (hs_group_mask(a) | hs_group_mask(b)))
            return hs_fail(err, HS_ERROR_INPUT,
                           "neigh_modify: exclude group needs groups whose members stay, and '%s' is dynamic",
                           sim->groups.name[sim->groups.dynamic & hs_group_mask(a) ? a : b]);
        return add_exclusion(sim, (hs_exclusion){HS_EXCLUDE_GROUP, a, b}, err);
    }
    if (kind > 2)
        return hs_fail(err, HS_ERROR_INPUT,
                       "neigh_modify: 'exclude %s' needs molecules, which atom_style atomic does not have",
                       kinds[kind]);
    *n_used = 2;
    HS_FREE(sim->neighbor.settings.exclusion);
    sim->neighbor.settings.n_exclusions = 0;
    return HS_OK;
}

/** collection/type N ..., collection/interval N ...: so many lists of types, or so many sizes. */
static hs_status skip_collections(const hs_args *args, int i, int *n_used, hs_error *err)
{
    int64_t n;
    HS_TRY(hs_arg_int(args, i + 1, 1, 1000, &n, err));
    HS_TRY(hs_arg_need(args, i + 1 + (int)n, "a word for each collection", err));
    *n_used = 2 + (int)n;
    return HS_OK;
}

static hs_status modify_word(hs_sim *sim, const hs_args *args, int i, int *n_used, hs_error *err)
{
    hs_neighbor_settings *settings = &sim->neighbor.settings;
    const char *keyword = args->word[i];
    int64_t ignored;
    double length;
    bool flag;
    *n_used = 2;
    if (strcmp(keyword, "delay") == 0) return hs_arg_int(args, i + 1, 0, INT64_MAX, &settings->delay, err);
    if (strcmp(keyword, "every") == 0) return hs_arg_int(args, i + 1, 1, INT64_MAX, &settings->every, err);
    if (strcmp(keyword, "check") == 0) return hs_arg_bool(args, i + 1, &settings->check, err);
    if (strcmp(keyword, "once") == 0) return hs_arg_bool(args, i + 1, &settings->once, err);
    if (strcmp(keyword, "exclude") == 0) return exclude(sim, args, i, n_used, err);
    if (strcmp(keyword, "cluster") == 0) return hs_arg_bool(args, i + 1, &flag, err);
    if (strncmp(keyword, "collection/", 11) == 0) return skip_collections(args, i, n_used, err);
    if (strcmp(keyword, "binsize") == 0) return hs_arg_not_negative(args, i + 1, &length, err);
    if (strcmp(keyword, "include") == 0) {
        if (strcmp(args->word[i + 1], "all") == 0) return HS_OK;
        return hs_fail(err, HS_ERROR_INPUT, "neigh_modify: 'include %s' is not supported; only 'include all' is",
                       args->word[i + 1]);
    }
    return hs_arg_int(args, i + 1, 1, INT64_MAX, &ignored, err); /* page, one */
}

static hs_status run_neigh_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    int n_used;
    for (int i = 0; i < args->n; i += n_used) HS_TRY(modify_word(deck->sim, args, i, &n_used, err));
    deck->sim->is_initialized = false;
    return hs_sim_fit_kernel_types(deck->sim, err);
}

static const hs_keyword method_keywords[] = {
    {"pairs", 1, "scheduled|exact",
     "`scheduled` (default): count the pairs that LAMMPS's lists hold under neigh_modify's schedule; `exact`: every "
     "pair within the cutoff at every step"},
    {"cell", 1, "<fraction>",
     "edge of the cells as a fraction of the largest cutoff, 0.05 to 20 (default: 1 for linked, incremental and hash; "
     "chosen by density for cell, verlet and cluster, where it is the width of the columns)"},
    {"order", 1, "morton|row|none",
     "how cells are numbered and atoms sorted in memory: along the Morton curve (default) or row by row; `none` "
     "(linked, incremental, hash): atoms stay as they were created"},
    {"stencil", 1, "sphere|cube",
     "linked, incremental, hash: search the cells that a sphere of the cutoff's radius can reach (default), or the "
     "whole cube around them"},
    {0},
};

/** Read the keywords into settings; a word that the method has no use for is refused. */
static hs_status method_words(const hs_args *args, hs_neighbor_settings *settings, hs_error *err)
{
    static const char *const stencils[] = {"sphere", "cube", NULL};
    const unsigned options = hs_methods[settings->method].options;
    for (int i = 1; i + 1 < args->n; i += 2) {
        const char *keyword = args->word[i];
        int choice;
        if (strcmp(keyword, "pairs") == 0) {
            settings->exact = strcmp(args->word[i + 1], "exact") == 0;
            continue;
        }
        const unsigned needed = strcmp(keyword, "cell") == 0    ? HS_METHOD_TAKES_CELL
                                : strcmp(keyword, "order") == 0 ? HS_METHOD_TAKES_ORDER
                                                                : HS_METHOD_TAKES_STENCIL;
        if (!(options & needed))
            return hs_fail(
                err, HS_ERROR_INPUT, "%s: method '%s' has no use for '%s'; %s", args->command, args->word[0], keyword,
                needed == HS_METHOD_TAKES_STENCIL ? "linked, incremental and hash have" : "all methods but nsq have");
        if (needed == HS_METHOD_TAKES_CELL) {
            HS_TRY(hs_arg_double(args, i + 1, &settings->cell, err));
            if (!(settings->cell >= 0.05 && settings->cell <= 20.0))
                return hs_arg_refuse(args, i + 1, "a fraction of the cutoff from 0.05 to 20", NULL, err);
        } else if (needed == HS_METHOD_TAKES_ORDER) {
            HS_TRY(hs_arg_choice(args, i + 1, hs_cell_order_names, &choice, err));
            settings->order = (hs_cell_order)choice;
            if (choice == HS_CELL_ORDER_NONE && !(options & HS_METHOD_TAKES_NO_ORDER))
                return hs_fail(err, HS_ERROR_INPUT, "%s: method '%s' sorts its atoms: 'order' must be morton or row",
                               args->command, args->word[0]);
        } else {
            HS_TRY(hs_arg_choice(args, i + 1, stencils, &choice, err));
            settings->is_cube = choice == 1;
        }
    }
    return HS_OK;
}

/** Method and options as the command gives them; what it does not name goes back to the defaults (except `pairs`). */
static hs_status read_method(const hs_args *args, hs_neighbor *neighbor, hs_error *err)
{
    HS_TRY(hs_neighbor_set_method(neighbor, args->word[0], err));
    hs_neighbor_settings *settings = &neighbor->settings;
    settings->cell = 0.0;
    settings->order = HS_CELL_ORDER_MORTON;
    settings->is_cube = false;
    return method_words(args, settings, err);
}

static hs_status run_neighbor_method(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_neighbor *neighbor = &deck->sim->neighbor;
    const char *from_command_line = deck->sim->options.neighbor_method;
    deck->sim->is_initialized = false;
    HS_TRY(read_method(args, neighbor, err));
    if (from_command_line[0] == '\0' || strcmp(from_command_line, args->word[0]) == 0) return HS_OK;
    /* another method from the command line: the deck's options are not meant for it */
    const hs_args other = {.command = args->command, .n = 1, .word = &from_command_line};
    return read_method(&other, neighbor, err);
}

static hs_status check_neighbor_method(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_neighbor scratch = {0};
    if (args->n == 0 || strchr(args->word[0], '$') != NULL) return HS_OK;
    return has_variables ? hs_neighbor_set_method(&scratch, args->word[0], err) : read_method(args, &scratch, err);
}

static hs_status run_precision(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const char *from_command_line = deck->sim->options.precision;
    deck->sim->is_initialized = false; /* lists are padded for the kernels of one precision */
    HS_TRY(hs_precision_get(args->word[0], &deck->sim->precision, err));
    return from_command_line[0] != '\0' ? hs_precision_get(from_command_line, &deck->sim->precision, err) : HS_OK;
}

static hs_status check_precision(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_precision scratch;
    (void)has_variables;
    if (args->n == 0 || strchr(args->word[0], '$') != NULL) return HS_OK;
    return hs_precision_get(args->word[0], &scratch, err);
}

static hs_status run_reproducible(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    bool is_on;
    HS_TRY(hs_arg_bool(args, 0, &is_on, err));
    sim->is_initialized = false;
    sim->reproducible = sim->options.reproducible != HS_REPRODUCIBLE_DEFAULT ? sim->options.reproducible
                        : is_on                                              ? HS_REPRODUCIBLE_ON
                                                                             : HS_REPRODUCIBLE_OFF;
    return HS_OK;
}

static hs_status check_reproducible(const hs_args *args, bool has_variables, hs_error *err)
{
    bool is_on;
    (void)has_variables;
    if (args->n == 0 || strchr(args->word[0], '$') != NULL) return HS_OK;
    return hs_arg_bool(args, 0, &is_on, err);
}

static const hs_keyword comm_keywords[] = {
    {"cutoff", 1, "<distance>", "accepted: the halo is as wide as the forces need"},
    {"cutoff/multi", 2, "<collection> <distance>", "accepted: the halo is as wide as the forces need"},
    {"reduce/multi", 0, "", "accepted: the halo is as wide as the forces need"},
    {"mode", 1, "single|multi", "accepted: the halo is as wide as the forces need, for `multi` too"},
    {"vel", 1, "yes|no", "accepted: halo velocities are exchanged when a style needs them"},
    {"group", 1, "all", "all atoms are exchanged"},
    {0},
};

static hs_status run_comm_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)deck;
    double cutoff;
    for (int i = 0; i < args->n; ++i)
        if (strcmp(args->word[i], "cutoff") == 0) HS_TRY(hs_arg_not_negative(args, i + 1, &cutoff, err));
    return HS_OK;
}

static hs_status run_comm_style(hs_deck *deck, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"brick", "tiled", NULL};
    int style;
    HS_TRY(hs_arg_choice(args, 0, styles, &style, err));
    if (style == 1) hs_say(deck->out, "comm_style: parts of the box are bricks in rows, which 'balance' moves, too\n");
    return HS_OK;
}

const hs_command hs_commands_neighbor[] = {
    {.about = {.name = "neighbor",
               .syntax = {.usage = "<skin> bin|nsq|multi", .n_min = 2, .n_max = 2},
               .summary = "the skin: how far beyond the cutoff pairs are listed",
               .details = "Skin in distance units; default 0.3 in lj, 2.0 in real and metal units. The second word is "
                          "accepted as in LAMMPS; how Halfshell searches is chosen by `neighbor_method`.",
               .example = "neighbor 0.3 bin"},
     .run = run_neighbor},
    {.about = {.name = "neigh_modify",
               .syntax = {.usage = "<keyword> <value> ...", .n_min = 0, .n_max = 0, .keywords = modify_keywords},
               .summary = "when neighbor lists are built, and which pairs are left out",
               .details =
                   "Repeated commands add up. Halfshell keeps LAMMPS's schedule: with `check no` or a long `delay`, "
                   "pairs that come within the cutoff between two builds without having been listed are not counted, "
                   "exactly as in LAMMPS, so that thermo tables agree digit by digit; a warning at the end of the run "
                   "tells when that happened. `neighbor_method ... pairs exact` counts every pair at every step.",
               .example = "neigh_modify delay 0 every 1 check yes\nneigh_modify exclude type 2 2"},
     .run = run_neigh_modify},
    {.about =
         {.name = "neighbor_method",
          .syntax = {.usage = "<method> [keyword value ...]", .n_min = 1, .n_max = 1, .keywords = method_keywords},
          .summary = "how pairs are found (Halfshell's own command)",
          .details = "Methods give the same forces to rounding. `nsq` is the double loop. `linked`, `incremental` and "
                     "`hash` are the cell methods of the textbooks, for teaching and for comparison: chains of the "
                     "atoms in each cell, built anew at every step, or brought up to date where atoms have changed "
                     "cell, or for the occupied cells only. `cell` sorts atoms into Morton-ordered cells at every "
                     "step, `verlet` keeps a list of the neighbors of each atom, `cluster` lists of pairs of four-atom "
                     "clusters; `auto` (default) begins with `cluster`, and runs of 1,000 steps and more try `verlet` "
                     "too, and keep the faster one. docs/neighbor-methods.md measures them. Keywords that a command "
                     "does not name go back to their defaults (except `pairs`). The command line's `-neigh` wins over "
                     "the deck's method, whose keywords are then not used.",
          .example =
              "neighbor_method cell\nneighbor_method cluster pairs exact\nneighbor_method linked cell 0.5 order row"},
     .run = run_neighbor_method,
     .check = check_neighbor_method},
    {.about = {.name = "precision",
               .syntax = {.usage = "double|mixed", .n_min = 1, .n_max = 1},
               .summary = "precision of the pair forces (Halfshell's own command)",
               .details =
                   "`double` (default) computes everything in double precision. `mixed` computes pairs in single "
                   "precision from coordinates relative to their neighbors, and adds forces, energies and virials in "
                   "double; positions and velocities stay double. Forces then differ by about 1e-6 of their size. The "
                   "command line's `-precision` wins over the deck. Method `nsq` always computes in double.",
               .example = "precision mixed"},
     .run = run_precision,
     .check = check_precision},
    {.about = {.name = "reproducible",
               .syntax = {.usage = "on|off", .n_min = 1, .n_max = 1},
               .summary = "the same bits on any number of threads and ranks (Halfshell's own command)",
               .details =
                   "`on` (default in double precision) gives the same bits of positions, velocities and thermo output "
                   "on any number of threads and ranks, with any neighbor method, with AVX2 and AVX-512 kernels, and "
                   "after any restart. Positions and the box are kept on a grid of a power of two (some 1e-14 of the "
                   "box, so a lattice site on the very face of a region may come to lie beyond it when a run starts), "
                   "forces and energies of pairs are added as 64-bit integers, sums over atoms are exact. The SSE2 and "
                   "portable kernels, which have no fused multiply-add, are reproducible among themselves. `off` adds "
                   "in floating point, a tenth faster; on several threads, which take work from each other, the last "
                   "bits then differ from run to run. It is off in mixed precision, where `on` is refused. The command "
                   "line's `-reproducible` wins over the deck.",
               .example = "reproducible off"},
     .run = run_reproducible,
     .check = check_reproducible},
    {.about = {.name = "comm_modify",
               .syntax = {.usage = "<keyword> <value> ...", .n_min = 0, .n_max = 0, .keywords = comm_keywords},
               .summary = "settings of LAMMPS's ghost atoms, accepted where they change no result",
               .details = "Halfshell sizes its halo by what the forces need.",
               .example = "comm_modify vel yes"},
     .run = run_comm_modify},
    {.about = {.name = "comm_style",
               .syntax = {.usage = "brick|tiled", .n_min = 1, .n_max = 1},
               .summary = "shape of the ranks' parts of the box",
               .details = "Parts are bricks in rows. `tiled`, which LAMMPS needs for `balance ... rcb`, makes no "
                          "difference here: both are for speed and change no result.",
               .example = "comm_style brick"},
     .run = run_comm_style},
    {.run = NULL},
};
