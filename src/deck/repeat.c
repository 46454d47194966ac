/* What going on from a checkpoint and read_restart share: the commands that made the simulation, repeated, and its box
 * and atoms. */
#include <string.h>

#include "base/memory.h"
#include "comm/domain.h"
#include "deck/command.h"
#include "deck/saved.h"
#include "sim/saving.h"

hs_status hs_saved_cut_words(char *text, hs_args *words, hs_error *err)
{
    const char **word;
    int n = 1;
    for (const char *c = text; *c != '\0'; ++c) n += *c == HS_SAVED_WORD;
    HS_TRY(HS_ALLOC(word, (size_t)n, err));
    words->n = 0;
    for (char *at = text; at != NULL;) {
        char *end = strchr(at, HS_SAVED_WORD);
        if (end != NULL) *end++ = '\0';
        word[words->n++] = at;
        at = end;
    }
    words->word = word;
    return HS_OK;
}

/** The number of types decides how much memory is taken: another value must confirm it first. */
static hs_status check_types(hs_checkpoint *checkpoint, int n_types, hs_error *err)
{
    hs_state state;
    HS_TRY(hs_checkpoint_get(checkpoint, "run", &state, err));
    const hs_state_value *mass = hs_state_find(&state, "mass");
    const bool is_fine = mass != NULL && mass->n == (int64_t)n_types + 1;
    hs_state_fini(&state);
    return is_fine ? HS_OK : hs_fail(err, HS_ERROR_INPUT, "there are not as many masses as types");
}

hs_status hs_saved_get_atoms(hs_checkpoint *checkpoint, hs_sim *sim, bool all_fields, hs_error *err)
{
    hs_state state;
    const int n_types = sim->atoms.n_types;
    HS_TRY(hs_checkpoint_get(checkpoint, "box", &state, err));
    hs_status status = hs_sim_keep_box(sim, &state, err);
    hs_state_fini(&state);
    HS_TRY(status);
    HS_TRY(check_types(checkpoint, sim->atoms.n_types, err));
    if (n_types != sim->atoms.n_types || sim->atoms.mass == NULL)
        HS_TRY(hs_atoms_set_types(&sim->atoms, sim->atoms.n_types, err));
    HS_TRY(hs_domain_divide(&sim->domain, &sim->box, err));
    HS_TRY(hs_checkpoint_get_atoms(checkpoint, &sim->atoms, all_fields, err));
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

hs_status hs_saved_get_run(hs_checkpoint *checkpoint, hs_sim *sim, bool is_resumed, hs_error *err)
{
    hs_state state;
    HS_TRY(hs_checkpoint_get(checkpoint, "run", &state, err));
    hs_status status = hs_sim_keep_run(sim, &state, err);
    if (!is_resumed) sim->env.is_halted = false; /* that was another deck's run */
    if (status == HS_OK && is_resumed) status = hs_sim_keep_under_way(sim, &state, err);
    hs_state_fini(&state);
    return status;
}

/** Commands whose effects come from the checkpoint's values, and `clear`, which makes an empty simulation as there is one: they are not
 *  repeated. */
static bool is_done_once(const char *name)
{
    static const char *const names[] = {
        "balance",        "clear",       "create_atoms", "delete_atoms",   "displace_atoms",
        "echo",           "if",          "include",      "info",           "jump",
        "label",          "log",         "minimize",     "next",           "print",
        "quit",           "read_dump",   "rerun",        "reset_atom_ids", "replicate",
        "reset_timestep", "run",         "set",          "shell",          "variable",
        "velocity",       "write_coeff", "write_data",   "write_dump",     "write_restart",
        "change_box",     "timestep",    "plot",         "report",         NULL};
    for (int k = 0; names[k] != NULL; ++k)
        if (strcmp(names[k], name) == 0) return true;
    return false;
}

/** Commands that make the box: it and the atoms come from the checkpoint here. */
static bool makes_box(const char *name)
{
    return strcmp(name, "create_box") == 0 || strcmp(name, "read_data") == 0 || strcmp(name, "read_restart") == 0;
}

/** read_restart takes these over from the deck that wrote the file, as LAMMPS does. */
static bool is_of_restart(const char *name)
{
    static const char *const names[] = {"units",      "dimension",   "boundary", "atom_style", "newton", "pair_style",
                                        "pair_coeff", "pair_modify", "group",    "mass",       NULL};
    for (int k = 0; names[k] != NULL; ++k)
        if (strcmp(names[k], name) == 0) return true;
    return false;
}

static hs_status repeat(hs_checkpoint *checkpoint, hs_deck *deck, char *text, bool is_restart, hs_error *err)
{
    hs_args words;
    HS_TRY(hs_saved_cut_words(text, &words, err));
    const char *name = words.word[0];
    const hs_args args = {.command = name, .n = words.n - 1, .word = words.word + 1};
    const hs_command *command = hs_command_find(name);
    hs_status status = HS_OK;
    if (makes_box(name)) {
        const bool is_first = !deck->sim->box.exists;
        if (is_first) status = hs_saved_get_atoms(checkpoint, deck->sim, false, err);
        /* what follows it needs the box also when this deck's own checkpoints are read */
        if (status == HS_OK && is_first && is_restart) status = hs_deck_remember(deck, &args, err);
    } else if (is_restart ? is_of_restart(name) : !is_done_once(name)) {
        if (command == NULL) status = hs_fail(err, HS_ERROR_INPUT, "there is no command '%s' in this version", name);
        if (status == HS_OK) status = command->run(deck, &args, err);
        if (status == HS_OK && is_restart) status = hs_deck_remember(deck, &args, err);
    }
    hs_memory_free((void *)(uintptr_t)words.word);
    return status;
}

/** As in LAMMPS, groups that changed keep the members that they had: in this deck nothing chooses others. */
static hs_status end_dynamic_groups(hs_deck *deck, hs_error *err)
{
    const hs_groups *groups = &deck->sim->groups;
    for (int group = 0; group < HS_GROUPS_MAX; ++group) {
        if (!(groups->dynamic & hs_group_mask(group))) continue;
        const char *const words[] = {groups->name[group], "static"};
        const hs_args args = {.command = "group", .n = 2, .word = words};
        HS_TRY(hs_command_find(args.command)->run(deck, &args, err));
        HS_TRY(hs_deck_remember(deck, &args, err));
    }
    return HS_OK;
}

hs_status hs_saved_repeat(hs_checkpoint *checkpoint, hs_deck *deck, char *commands, bool is_restart, hs_error *err)
{
    hs_sink quiet = {0}, *const out = deck->out;
    const hs_sink before = *out;
    hs_status status = HS_OK;
    *out = quiet;
    deck->sim->env.is_resuming = true;
    for (char *at = commands; at != NULL && *at != '\0' && status == HS_OK;) {
        char *end = strchr(at, HS_SAVED_COMMAND);
        if (end != NULL) *end++ = '\0';
        status = repeat(checkpoint, deck, at, is_restart, err);
        at = end;
    }
    if (status == HS_OK && is_restart) status = end_dynamic_groups(deck, err);
    deck->sim->env.is_resuming = false;
    *out = before;
    return status;
}
