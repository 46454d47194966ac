#include "sim/restored.h"

#include <string.h>

#include "base/memory.h"

typedef struct kept_style {
    const char *kind;  /**< "fix" or "compute" */
    char *id, *name;   /**< owned; name: of the style */
    hs_state state;    /**< owned */
    bool has_got_back; /**< the new one of its ID has something of it */
} kept_style;

/** Its place in memory stays: the atoms point to array. */
typedef struct kept_field {
    char *name;  /**< owned */
    void *array; /**< memory of hs_atoms */
    size_t size;
} kept_field;

struct hs_restored {
    kept_style *style; /**< owned [n_styles] */
    int n_styles;
    kept_field **field; /**< owned [n_fields], each of them too; NULL: given away */
    int n_fields;
};
typedef struct hs_restored hs_restored;

const char *const hs_restored_kinds[] = {"fix", "compute"};

static hs_status need(hs_sim *sim, hs_error *err)
{
    return sim->restored != NULL ? HS_OK : HS_ALLOC(sim->restored, 1, err);
}

static void drop_field(hs_sim *sim, int k)
{
    kept_field *field = sim->restored->field[k];
    if (field == NULL) return;
    hs_atoms_remove_field(&sim->atoms, &field->array);
    HS_FREE(field->name);
    HS_FREE(sim->restored->field[k]);
}

void hs_restored_forget(hs_sim *sim)
{
    if (sim->restored == NULL) return;
    for (int k = 0; k < sim->restored->n_fields; ++k) drop_field(sim, k);
    for (int k = 0; k < sim->restored->n_styles; ++k) {
        HS_FREE(sim->restored->style[k].id);
        HS_FREE(sim->restored->style[k].name);
        hs_state_fini(&sim->restored->style[k].state);
    }
    HS_FREE(sim->restored->field);
    HS_FREE(sim->restored->style);
    HS_FREE(sim->restored);
}

hs_status hs_restored_keep_style(hs_sim *sim, hs_restored_kind kind, const char *id, const char *name, hs_state *state,
                                 hs_error *err)
{
    HS_TRY(need(sim, err));
    hs_restored *kept = sim->restored;
    HS_TRY(HS_GROW(kept->style, (size_t)kept->n_styles, (size_t)kept->n_styles + 1, err));
    kept_style *style = &kept->style[kept->n_styles++];
    *style = (kept_style){.kind = hs_restored_kinds[kind], .state = *state};
    *state = (hs_state){0};
    HS_TRY(hs_memory_strdup(&style->id, id, err));
    return hs_memory_strdup(&style->name, name, err);
}

hs_status hs_restored_keep_field(hs_sim *sim, const char *name, size_t size, hs_error *err)
{
    HS_TRY(need(sim, err));
    hs_restored *kept = sim->restored;
    HS_TRY(HS_GROW(kept->field, (size_t)kept->n_fields, (size_t)kept->n_fields + 1, err));
    kept->field[kept->n_fields] = NULL;
    HS_TRY(HS_ALLOC(kept->field[kept->n_fields], 1, err));
    kept_field *field = kept->field[kept->n_fields++];
    field->size = size;
    HS_TRY(hs_memory_strdup(&field->name, name, err));
    return hs_atoms_add_field(&sim->atoms, field->name, &field->array, size, false, err);
}

/** The fix or compute that there is now in the place of a kept one; NULL: none of that ID and style. */
typedef struct successor {
    hs_fix *fix;
    hs_compute *compute;
} successor;

static successor find_successor(hs_sim *sim, const kept_style *kept)
{
    successor now = {0};
    if (kept->kind == hs_restored_kinds[HS_RESTORED_FIX])
        now.fix = hs_sim_find_fix(sim, kept->id);
    else
        now.compute = hs_sim_find_compute(sim, kept->id);
    if (now.fix != NULL && strcmp(now.fix->style->about.name, kept->name) != 0) now.fix = NULL;
    if (now.compute != NULL && strcmp(now.compute->style->about.name, kept->name) != 0) now.compute = NULL;
    return now;
}

static bool has_state(successor now)
{
    return (now.fix != NULL && now.fix->style->keep_state != NULL) ||
           (now.compute != NULL && now.compute->style->keep_state != NULL);
}

static hs_status keep_state(successor now, hs_state *state, hs_error *err)
{
    return now.fix != NULL ? now.fix->style->keep_state(now.fix, state, err)
                           : now.compute->style->keep_state(now.compute, state, err);
}

void hs_restored_give_fields(hs_sim *sim, hs_restored_kind kind, const char *id)
{
    const hs_atoms *atoms = &sim->atoms;
    kept_style *old = NULL;
    for (int k = 0; sim->restored != NULL && k < sim->restored->n_styles; ++k) {
        kept_style *kept = &sim->restored->style[k];
        if (kept->kind != hs_restored_kinds[kind] || strcmp(kept->id, id) != 0) continue;
        const successor now = find_successor(sim, kept);
        if (now.fix != NULL || now.compute != NULL) old = kept;
    }
    for (int k = 0; sim->restored != NULL && k < sim->restored->n_fields; ++k) {
        kept_field *kept = sim->restored->field[k];
        for (int j = 0; kept != NULL && j < atoms->n_fields; ++j) {
            const hs_atom_field *field = &atoms->field[j];
            if (field->array == &kept->array || field->size != kept->size || strcmp(field->name, kept->name) != 0)
                continue;
            if (old != NULL) {
                memcpy(*field->array, kept->array, kept->size * (size_t)atoms->n_local);
                old->has_got_back = true;
            }
            drop_field(sim, k);
            break;
        }
    }
}

/** Whether the state has the names and counts that the new style asks for. Arrays of any length are empty in a new
 *  one. */
static bool fits(successor new, const hs_state *state)
{
    hs_state now = {0};
    hs_error ignored = {0};
    bool is_fitting = keep_state(new, &now, &ignored) == HS_OK;
    for (int k = 0; k < now.n_values && is_fitting; ++k) {
        const hs_state_value *value = &now.value[k], *kept = hs_state_find(state, value->name);
        is_fitting = kept != NULL && kept->kind == value->kind &&
                     (kept->n == value->n || value->n == 0 || value->kind == HS_STATE_TEXT);
    }
    hs_state_fini(&now);
    return is_fitting;
}

hs_status hs_restored_give_states(hs_sim *sim, hs_error *err)
{
    if (sim->restored == NULL) return HS_OK;
    for (int k = 0; k < sim->restored->n_styles; ++k) {
        kept_style *kept = &sim->restored->style[k];
        const successor now = find_successor(sim, kept);
        if (has_state(now) && !fits(now, &kept->state)) {
            hs_warn(sim->env.out,
                    "%s '%s' (%s): its state in the restart file does not fit its present words: it begins anew",
                    kept->kind, kept->id, kept->name);
            continue;
        }
        kept->state.is_reading = true;
        if (has_state(now)) HS_TRY(keep_state(now, &kept->state, err));
        if (has_state(now) || kept->has_got_back)
            hs_say(sim->env.out, "Resetting global %s info from restart file:\n  %s style: %s, %s ID: %s\n", kept->kind,
                   kept->kind, kept->name, kept->kind, kept->id);
    }
    hs_restored_forget(sim);
    return HS_OK;
}
