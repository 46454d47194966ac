/* The command info: what there is at this point of the deck. */
#include <string.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/variables.h"

/** What info tells, and how. */
typedef struct topic {
    const char *name;
    void (*tell)(hs_sink *out, const hs_deck *deck);
    bool is_default; /**< told by `info` without words as part of all */
} topic;

static void tell_system(hs_sink *out, const hs_deck *deck)
{
    const hs_sim *sim = deck->sim;
    const hs_box *box = &sim->box;
    hs_say(out, "\nSystem information:\n");
    hs_say(out, "Units         = %s\n", sim->env.units->name);
    hs_say(out, "Atom style    = atomic\n");
    hs_say(out, "Atoms         = %lld,  types = %d\n", (long long)sim->atoms.n_all, sim->atoms.n_types);
    hs_say(out, "Dimensions    = %d\n", box->dimension);
    hs_say(out, "Boundaries    =");
    for (int d = 0; d < 3; ++d) hs_say(out, " %c%c", (char)box->boundary[d][0], (char)box->boundary[d][1]);
    if (box->exists)
        for (int d = 0; d < 3; ++d)
            hs_say(out, "\n%clo, %chi      = %.8g, %.8g", "xyz"[d], "xyz"[d], box -> lo[d], box -> hi[d]);
    if (box->exists && box->is_tilted)
        hs_say(out, "\nxy, xz, yz    = %.8g, %.8g, %.8g", box->tilt[0], box->tilt[1], box->tilt[2]);
    if (!box->exists) hs_say(out, "\nBox has not yet been created");
    hs_say(out, "\nPair style    = %s\n", sim->pair != NULL ? sim->pair->style->about.name : "none");
    hs_say(out, "Timestep      = %.15g at step %lld\n", sim->env.dt, (long long)sim->env.step);
}

static void tell_memory(hs_sink *out, const hs_deck *deck)
{
    (void)deck;
    hs_say(out, "\nMemory allocation information (first rank):\n");
    hs_say(out, "Resident      = %.4g Mbyte now, %.4g Mbyte at most\n", (double)hs_memory_resident() / (1 << 20),
           (double)hs_memory_resident_peak() / (1 << 20));
}

static void tell_communication(hs_sink *out, const hs_deck *deck)
{
    hs_say(out, "\nCommunication information:\n");
    hs_say(out, "Nprocs        = %d,   Nthreads = %d\n",
           deck->sim->parallel.n_ranks > 1 ? deck->sim->parallel.n_ranks : 1, hs_threads_get());
    const hs_domain *domain = &deck->sim->domain;
    if (hs_domain_is_divided(domain))
        hs_say(out, "Processor grid = %d x %d x %d\n", domain->n[0], domain->n[1], domain->n[2]);
}

static void tell_computes(hs_sink *out, const hs_deck *deck)
{
    const hs_sim *sim = deck->sim;
    hs_say(out, "\nCompute information:\n");
    for (int i = 0; i < sim->n_computes; ++i)
        hs_say(out, "Compute[%3d]:  %s,  style = %s,  group = %s\n", i, sim->compute[i]->id,
               sim->compute[i]->style->about.name, sim->groups.name[sim->compute[i]->group]);
}

static void tell_dumps(hs_sink *out, const hs_deck *deck)
{
    const hs_sim *sim = deck->sim;
    hs_say(out, "\nDump information:\n");
    for (int i = 0; i < sim->n_dumps; ++i)
        hs_say(out, "Dump[%3d]:     %s,  file = %s,  style = %s,  group = %s,  every = %lld\n", i, sim->dump[i]->id,
               sim->dump[i]->file, sim->dump[i]->style->about.name, sim->groups.name[sim->dump[i]->group],
               (long long)sim->dump[i]->every);
}

static void tell_fixes(hs_sink *out, const hs_deck *deck)
{
    const hs_sim *sim = deck->sim;
    hs_say(out, "\nFix information:\n");
    for (int i = 0; i < sim->n_fixes; ++i)
        hs_say(out, "Fix[%3d]:      %s,  style = %s,  group = %s\n", i, sim->fix[i]->id, sim->fix[i]->style->about.name,
               sim->groups.name[sim->fix[i]->group]);
}

static void tell_groups(hs_sink *out, const hs_deck *deck)
{
    hs_say(out, "\nGroup information:\n");
    for (int i = 0; i < HS_GROUPS_MAX; ++i)
        if (deck->sim->groups.name[i] != NULL) hs_say(out, "Group[%2d]:     %s\n", i, deck->sim->groups.name[i]);
}

static void tell_regions(hs_sink *out, const hs_deck *deck)
{
    const hs_sim *sim = deck->sim;
    hs_say(out, "\nRegion information:\n");
    for (int i = 0; i < sim->n_regions; ++i)
        hs_say(out, "Region[%3d]:   %s,  style = %s,  side = %s\n", i, sim->region[i]->id,
               sim->region[i]->style->about.name, sim->region[i]->is_outside ? "out" : "in");
}

/** Definitions, not values: a formula's value may need a run. */
static void tell_variables(hs_sink *out, const hs_deck *deck)
{
    hs_say(out, "\nVariable information:\n");
    for (int i = 0; i < deck->variables->n; ++i) {
        const hs_variable *variable = deck->variables->variable[i];
        hs_say(out, "Variable[%3d]: %-10s,  style = %-10s,  def =", i, variable->name,
               hs_variable_styles[variable->style]);
        if (variable->style == HS_VARIABLE_LOOP || variable->style == HS_VARIABLE_ULOOP)
            hs_say(out, " %lld of %lld to %lld", (long long)variable->which, (long long)variable->first,
                   (long long)variable->last);
        if (variable->style == HS_VARIABLE_INTERNAL) hs_say(out, " %.15g", variable->number);
        if (variable->formula != NULL) hs_say(out, " %s", hs_formula_text(variable->formula));
        for (int k = 0; k < variable->n_values; ++k)
            hs_say(out, variable->style == HS_VARIABLE_INDEX && k == variable->which ? " [%s]" : " %s",
                   variable->value[k]);
        hs_say(out, "\n");
    }
}

static void tell_time(hs_sink *out, const hs_deck *deck)
{
    (void)deck;
    hs_say(out, "\nTime information:\nCPU time      = %.2f s\n", hs_time_cpu_s());
}

#define TELL_STYLES(out, title, table)                                                                                 \
    do {                                                                                                               \
        hs_say(out, "\n%s:\n", title);                                                                                 \
        for (int k = 0; (table)[k] != NULL; ++k) hs_say(out, " %s", (table)[k]->about.name);                           \
        hs_say(out, "\n");                                                                                             \
    } while (0)

static void tell_styles(hs_sink *out, const hs_deck *deck)
{
    (void)deck;
    TELL_STYLES(out, "Pair styles", hs_pair_styles);
    TELL_STYLES(out, "Fix styles", hs_fix_styles);
    TELL_STYLES(out, "Compute styles", hs_compute_styles);
    TELL_STYLES(out, "Region styles", hs_region_styles);
    TELL_STYLES(out, "Dump styles", hs_dump_styles);
    hs_say(out, "\nCommands:\n");
    for (int family = 0; hs_command_families[family] != NULL; ++family)
        for (const hs_command *command = hs_command_families[family]; command->about.name != NULL; ++command)
            hs_say(out, " %s", command->about.name);
    hs_say(out, "\n");
}

static const topic topics[] = {
    {"system", tell_system, true},     {"memory", tell_memory, true},   {"communication", tell_communication, true},
    {"computes", tell_computes, true}, {"dumps", tell_dumps, true},     {"fixes", tell_fixes, true},
    {"groups", tell_groups, true},     {"regions", tell_regions, true}, {"variables", tell_variables, true},
    {"time", tell_time, true},         {"styles", tell_styles, false},
};
enum { N_TOPICS = sizeof topics / sizeof topics[0] };

static int find_topic(const char *word)
{
    for (int i = 0; i < N_TOPICS; ++i)
        if (strcmp(topics[i].name, word) == 0) return i;
    return -1;
}

static hs_status info_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const words[] = {"all",   "out",    "system",  "memory",    "communication", "computes", "dumps",
                                        "fixes", "groups", "regions", "variables", "time",          "styles",   NULL};
    static const char *const outs[] = {"screen", "log", NULL};
    int which;
    if (has_variables) return HS_OK;
    for (int i = 0; i < args->n; ++i) {
        HS_TRY(hs_arg_choice(args, i, words, &which, err));
        if (strcmp(args->word[i], "out") != 0) continue;
        HS_TRY(hs_arg_need(args, ++i, "screen or log after 'out'", err));
        HS_TRY(hs_arg_choice(args, i, outs, &which, err));
    }
    return HS_OK;
}

static hs_status info_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(info_check(args, false, err));
    hs_sink out = {.screen = deck->out->screen};
    bool is_wanted[N_TOPICS] = {false}, any = false;
    hs_progress_wipe(deck->out);
    for (int i = 0; i < args->n; ++i) {
        if (strcmp(args->word[i], "out") == 0) {
            const bool to_log = strcmp(args->word[++i], "log") == 0;
            out = (hs_sink){.screen = to_log ? NULL : deck->out->screen, .log = to_log ? deck->out->log : NULL};
            continue;
        }
        const int which = find_topic(args->word[i]);
        any = true;
        for (int k = 0; k < N_TOPICS; ++k)
            is_wanted[k] = is_wanted[k] || k == which || (which < 0 && topics[k].is_default);
    }
    for (int k = 0; k < N_TOPICS; ++k)
        if (is_wanted[k] || (!any && topics[k].is_default)) topics[k].tell(&out, deck);
    hs_say(&out, "\n");
    return HS_OK;
}

const hs_command hs_commands_info[] = {
    {
        .about =
            {
                .name = "info",
                .syntax = {"[all] [system] [memory] [communication] [computes] [dumps] [fixes] [groups] [regions] "
                           "[variables] [time] [styles] [out screen|log]",
                           0, -1, NULL},
                .summary = "Tell what there is at this point of the deck",
                .details =
                    "Without words, and with `all`, everything but `styles`, the lists of what Halfshell supports. "
                    "`out` chooses where it is\nwritten (default: screen). Variables are shown by their definitions.\n",
                .example = "info system groups variables out log",
            },
        .run = info_run,
        .check = info_check,
    },
    {.about = {.name = NULL}},
};
