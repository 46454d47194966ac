/* The command read_restart: what another deck left, for this one to go on with. save.c says what is in a checkpoint. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "deck/saved.h"
#include "io/checkpoint.h"
#include "sim/restored.h"

/** Call keep for each of the names that a text joins. */
static hs_status keep_each(hs_checkpoint *checkpoint, hs_sim *sim, hs_state *state, const char *list,
                           hs_status (*keep)(hs_checkpoint *, hs_sim *, const char *, hs_error *), hs_error *err)
{
    char *names = NULL;
    const hs_state_value *value = hs_state_find(state, list); /* older files have none */
    if (value == NULL || value->kind != HS_STATE_TEXT) return HS_OK;
    hs_status status = hs_state_text(state, list, &names, err);
    for (char *at = names; at != NULL && *at != '\0' && status == HS_OK;) {
        char *end = strchr(at, HS_SAVED_COMMAND);
        if (end != NULL) *end++ = '\0';
        status = keep(checkpoint, sim, at, err);
        at = end;
    }
    HS_FREE(names);
    return status;
}

static hs_status keep_field(hs_checkpoint *checkpoint, hs_sim *sim, const char *words, hs_error *err)
{
    unsigned size = 0;
    int n = 0;
    (void)checkpoint;
    if (sscanf(words, "%u %n", &size, &n) < 1 || n == 0 || size < 4 || size > 4096 || (size != 4 && size % 8 != 0))
        return hs_fail(err, HS_ERROR_INPUT, "a field of the atoms has no size");
    return hs_restored_keep_field(sim, words + n, size, err);
}

static hs_status keep_style(hs_checkpoint *checkpoint, hs_sim *sim, hs_restored_kind kind, const char *id,
                            hs_error *err)
{
    hs_state state = {0};
    char *name = NULL;
    HS_TRY(hs_saved_get(checkpoint, hs_restored_kinds[kind], id, &state, err));
    hs_status status = hs_state_text(&state, "style", &name, err);
    if (status == HS_OK && name != NULL) status = hs_restored_keep_style(sim, kind, id, name, &state, err);
    HS_FREE(name);
    hs_state_fini(&state);
    return status;
}

static hs_status keep_fix(hs_checkpoint *checkpoint, hs_sim *sim, const char *id, hs_error *err)
{
    return keep_style(checkpoint, sim, HS_RESTORED_FIX, id, err);
}

static hs_status keep_compute(hs_checkpoint *checkpoint, hs_sim *sim, const char *id, hs_error *err)
{
    return keep_style(checkpoint, sim, HS_RESTORED_COMPUTE, id, err);
}

hs_status hs_deck_read_restart(hs_deck *deck, const char *path, hs_error *err)
{
    hs_checkpoint *checkpoint = NULL;
    hs_state state = {0};
    char *commands = NULL;
    hs_sim *sim = deck->sim;
    HS_TRY(hs_checkpoint_open(&checkpoint, path, &sim->parallel, err));
    hs_status status = hs_checkpoint_get(checkpoint, "deck", &state, err);
    if (status == HS_OK) status = hs_state_text(&state, "commands", &commands, err);
    if (status == HS_OK) status = hs_saved_repeat(checkpoint, deck, commands, true, err);
    if (status == HS_OK) status = keep_each(checkpoint, sim, &state, "fixes", keep_fix, err);
    if (status == HS_OK) status = keep_each(checkpoint, sim, &state, "computes", keep_compute, err);
    if (status == HS_OK) status = keep_each(checkpoint, sim, &state, "fields of fixes", keep_field, err);
    if (status == HS_OK) status = keep_each(checkpoint, sim, &state, "fields of computes", keep_field, err);
    if (status == HS_OK) status = hs_saved_get_atoms(checkpoint, sim, false, err);
    if (status == HS_OK) status = hs_saved_get_run(checkpoint, sim, false, err);
    sim->is_initialized = false;
    hs_state_fini(&state);
    HS_FREE(commands);
    hs_checkpoint_destroy(&checkpoint);
    if (status == HS_OK)
        hs_say(deck->out, "Reading restart file ...\n  %lld atoms, step %lld\n", (long long)sim->atoms.n_all,
               (long long)sim->env.step);
    return status;
}
