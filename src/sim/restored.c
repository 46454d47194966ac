#include "sim/restored.h"

#include <string.h>

#include "base/memory.h"

typedef struct kept_fix {
    char *id, *style; /**< owned */
    hs_state state;   /**< owned */
} kept_fix;

/** Its place in memory stays: the atoms point to array. */
typedef struct kept_field {
    char *name;  /**< owned */
    void *array; /**< memory of hs_atoms */
    size_t size;
} kept_field;

struct hs_restored {
    kept_fix *fix; /**< owned [n_fixes] */
    int n_fixes;
    kept_field **field; /**< owned [n_fields], each of them too; NULL: given away */
    int n_fields;
};
typedef struct hs_restored hs_restored;

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
    for (int k = 0; k < sim->restored->n_fixes; ++k) {
        HS_FREE(sim->restored->fix[k].id);
        HS_FREE(sim->restored->fix[k].style);
        hs_state_fini(&sim->restored->fix[k].state);
    }
    HS_FREE(sim->restored->field);
    HS_FREE(sim->restored->fix);
    HS_FREE(sim->restored);
}

hs_status hs_restored_keep_fix(hs_sim *sim, const char *id, const char *style, hs_state *state, hs_error *err)
{
    HS_TRY(need(sim, err));
    hs_restored *kept = sim->restored;
    HS_TRY(HS_GROW(kept->fix, (size_t)kept->n_fixes, (size_t)kept->n_fixes + 1, err));
    kept_fix *fix = &kept->fix[kept->n_fixes++];
    *fix = (kept_fix){.state = *state};
    *state = (hs_state){0};
    HS_TRY(hs_memory_strdup(&fix->id, id, err));
    return hs_memory_strdup(&fix->style, style, err);
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

void hs_restored_give_fields(hs_sim *sim, const char *id)
{
    const hs_atoms *atoms = &sim->atoms;
    const hs_fix *fix = hs_sim_find_fix(sim, id);
    bool is_of_style = false;
    if (sim->restored == NULL || fix == NULL) return;
    for (int k = 0; k < sim->restored->n_fixes; ++k)
        is_of_style = is_of_style || (strcmp(sim->restored->fix[k].id, id) == 0 &&
                                      strcmp(sim->restored->fix[k].style, fix->style->about.name) == 0);
    for (int k = 0; k < sim->restored->n_fields && is_of_style; ++k) {
        kept_field *kept = sim->restored->field[k];
        for (int j = 0; kept != NULL && j < atoms->n_fields; ++j) {
            const hs_atom_field *field = &atoms->field[j];
            if (field->array == &kept->array || field->size != kept->size || strcmp(field->name, kept->name) != 0)
                continue;
            memcpy(*field->array, kept->array, kept->size * (size_t)atoms->n_local);
            drop_field(sim, k);
            break;
        }
    }
}

/** Whether the state has the names and counts that the new fix asks for. Arrays of any length are empty in a new fix. */
static bool fits(hs_fix *fix, const hs_state *state)
{
    hs_state now = {0};
    hs_error ignored = {0};
    bool is_fitting = fix->style->keep_state(fix, &now, &ignored) == HS_OK;
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
    for (int k = 0; k < sim->restored->n_fixes; ++k) {
        kept_fix *kept = &sim->restored->fix[k];
        hs_fix *fix = hs_sim_find_fix(sim, kept->id);
        if (fix == NULL || strcmp(fix->style->about.name, kept->style) != 0 || fix->style->keep_state == NULL) continue;
        if (!fits(fix, &kept->state)) {
            hs_warn(sim->env.out,
                    "fix '%s' (%s): its state in the restart file does not fit its present words: it begins anew",
                    fix->id, kept->style);
            continue;
        }
        kept->state.is_reading = true;
        HS_TRY(fix->style->keep_state(fix, &kept->state, err));
        hs_say(sim->env.out, "Resetting global fix info from restart file:\n  fix style: %s, fix ID: %s\n", kept->style,
               fix->id);
    }
    hs_restored_forget(sim);
    return HS_OK;
}
