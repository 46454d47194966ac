#include "cli/catalog.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "deck/command.h"
#include "sim/methods.h"
#include "sim/thermo.h"

const hs_catalog hs_catalogs[] = {
    {"commands", "Commands", "command", "", "",
     "A deck holds one command a line. `&` at the end continues a line, `#` starts a comment, quotes hold words "
     "together, `$x`, `${name}` and `$(formula)` are replaced before a command is read."},
    {"pair", "Pair styles", "pair style", "pair_style", "",
     "Potentials between pairs of atoms, chosen with `pair_style` and given their coefficients with `pair_coeff`."},
    {"fix", "Fixes", "fix", "fix <ID> <group-ID>", "",
     "What acts on atoms during the timestep. Hooks run in the order in which the deck defines the fixes."},
    {"compute", "Computes", "compute", "compute <ID> <group-ID>", "",
     "Quantities measured when something asks for them; `c_ID` and `c_ID[i]` in formulas and thermo output."},
    {"region", "Regions", "region", "region <ID>", "",
     "Parts of space. All take the keywords `side in|out` and `units lattice|box` at the end."},
    {"dump", "Dumps", "dump style", "dump <ID> <group-ID>", "<N> <file>",
     "Snapshots of atoms written every N steps. `*` in the file's name stands for the step: one file a snapshot."},
    {"thermo", "Thermo keywords", "thermo keyword", NULL, NULL,
     "Columns of `thermo_style custom`, and values in formulas."},
    {"neighbor", "Neighbor methods", "neighbor method", NULL, NULL,
     "Ways to find the pairs within the cutoff, chosen with `neighbor_method` in the deck or `-neigh` on the command "
     "line. All give the same forces to rounding."},
    {NULL, NULL, NULL, NULL, NULL, NULL},
};

const char *const hs_exit_code_meanings[] = {
    "0",
    "Done.",
    "1",
    "The deck, a file it reads, or the command line is wrong; nothing was lost because nothing wrong was run.",
    "2",
    "The run failed: atoms lost, numbers out of range, a file that could not be written, no memory left.",
    "3",
    "Interrupted by SIGINT, SIGTERM or SIGHUP after the step was finished. A second SIGINT or SIGTERM stops at once.",
    NULL,
};

/** Entry @p i of a family, in the order of its table; false after the last. */
static bool get_style(const hs_catalog *family, int i, hs_catalog_entry *entry)
{
    const char *name = family->name;
    const hs_description *about = NULL;
    entry->coeff = NULL;
    if (strcmp(name, "pair") == 0 && hs_pair_styles[i] != NULL) {
        about = &hs_pair_styles[i]->about;
        entry->coeff = &hs_pair_styles[i]->coeff_syntax;
    } else if (strcmp(name, "fix") == 0 && hs_fix_styles[i] != NULL) {
        about = &hs_fix_styles[i]->about;
    } else if (strcmp(name, "compute") == 0 && hs_compute_styles[i] != NULL) {
        about = &hs_compute_styles[i]->about;
    } else if (strcmp(name, "region") == 0 && hs_region_styles[i] != NULL) {
        about = &hs_region_styles[i]->about;
    } else if (strcmp(name, "dump") == 0 && hs_dump_styles[i] != NULL) {
        about = &hs_dump_styles[i]->about;
    }
    if (about != NULL) entry->about = *about;
    return about != NULL;
}

static bool get_command(int i, hs_catalog_entry *entry)
{
    entry->coeff = NULL;
    for (int family = 0; hs_command_families[family] != NULL; ++family)
        for (const hs_command *command = hs_command_families[family]; command->about.name != NULL; ++command)
            if (i-- == 0) {
                entry->about = command->about;
                return true;
            }
    return false;
}

static bool get_entry(const hs_catalog *family, int i, hs_catalog_entry *entry)
{
    *entry = (hs_catalog_entry){.family = family};
    if (strcmp(family->name, "commands") == 0) return get_command(i, entry);
    if (strcmp(family->name, "thermo") == 0) {
        if (hs_thermo_entries[i].name == NULL) return false;
        entry->about = (hs_description){.name = hs_thermo_entries[i].name, .summary = hs_thermo_entries[i].help};
        return true;
    }
    if (strcmp(family->name, "neighbor") == 0) {
        if (hs_neighbor_methods[i] == NULL) return false;
        entry->about = (hs_description){.name = hs_neighbor_methods[i], .summary = hs_methods[i].help};
        return true;
    }
    return get_style(family, i, entry);
}

static int compare(const void *a, const void *b)
{
    return strcmp(((const hs_catalog_entry *)a)->about.name, ((const hs_catalog_entry *)b)->about.name);
}

hs_status hs_catalog_list(const hs_catalog *family, hs_catalog_entry **entries, int *n, hs_error *err)
{
    hs_catalog_entry entry;
    *n = 0;
    while (get_entry(family, *n, &entry)) ++*n;
    HS_TRY(HS_ALLOC(*entries, (size_t)*n, err));
    for (int i = 0; i < *n; ++i) get_entry(family, i, &(*entries)[i]);
    qsort(*entries, (size_t)*n, sizeof **entries, compare);
    return HS_OK;
}

static void put_word(FILE *stream, const char *word)
{
    if (word != NULL && word[0] != '\0') fprintf(stream, " %s", word);
}

void hs_catalog_syntax(FILE *stream, const hs_catalog_entry *entry)
{
    const char *before = entry->family->before;
    if (before != NULL && before[0] != '\0') fprintf(stream, "%s ", before);
    fputs(entry->about.name, stream);
    put_word(stream, entry->family->after);
    put_word(stream, entry->about.syntax.usage);
    fputc('\n', stream);
}

void hs_catalog_coeff_syntax(FILE *stream, const hs_catalog_entry *entry)
{
    if (entry->coeff == NULL) return;
    fputs("pair_coeff <I> <J>", stream);
    put_word(stream, entry->coeff->usage);
    fputc('\n', stream);
}
