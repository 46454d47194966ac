#include "deck/check_names.h"

#include <string.h>

#include "base/memory.h"
#include "deck/substitute.h"

/** A file's name with more combinations of values than this is not followed. */
enum { COMBINATIONS_MAX = 64, DEPTH_MAX = 8 };

static hs_known_variable *find(const hs_check_names *names, const char *name, size_t n)
{
    for (int i = 0; i < names->n_variables; ++i)
        if (strlen(names->variable[i].name) == n && memcmp(names->variable[i].name, name, n) == 0)
            return &names->variable[i];
    return NULL;
}

static hs_status add(hs_check_names *names, const char *name, hs_known_variable **added, hs_error *err)
{
    HS_TRY(HS_EXTEND(names->variable, names->n_variables, names->capacity, err));
    *added = &names->variable[names->n_variables];
    memset(*added, 0, sizeof **added);
    HS_TRY(hs_memory_strdup(&(*added)->name, name, err));
    ++names->n_variables;
    return HS_OK;
}

hs_status hs_check_names_init(hs_check_names *names, const hs_variables *given, hs_error *err)
{
    for (int i = 0; i < given->n; ++i) {
        hs_known_variable *known;
        const hs_variable *variable = given->variable[i];
        HS_TRY(add(names, variable->name, &known, err));
        known->is_fixed = true;
        known->is_open = variable->style != HS_VARIABLE_INDEX;
        for (int k = 0; k < variable->n_values; ++k) HS_TRY(hs_name_list_add(&known->values, variable->value[k], err));
    }
    return HS_OK;
}

void hs_check_names_fini(hs_check_names *names)
{
    hs_name_list_fini(&names->visited);
    hs_name_list_fini(&names->written);
    for (int i = 0; i < names->n_variables; ++i) {
        HS_FREE(names->variable[i].name);
        hs_name_list_fini(&names->variable[i].values);
    }
    HS_FREE(names->variable);
    names->n_variables = 0;
    names->capacity = 0;
}

hs_status hs_check_names_define(hs_check_names *names, const hs_args *args, hs_error *err)
{
    /* A line with `$` may not show all its words yet. */
    if (args->n < 2) return HS_OK;
    hs_known_variable *known = find(names, args->word[0], strlen(args->word[0]));
    if (known != NULL && known->is_fixed && strcmp(args->word[1], "delete") != 0) return HS_OK;
    if (known == NULL) HS_TRY(add(names, args->word[0], &known, err));
    if (strcmp(args->word[1], "index") != 0 && strcmp(args->word[1], "string") != 0) {
        known->is_open = true;
        return HS_OK;
    }
    for (int i = 2; i < args->n; ++i) {
        if (strchr(args->word[i], '$') != NULL)
            known->is_open = true;
        else
            HS_TRY(hs_name_list_add(&known->values, args->word[i], err));
    }
    return HS_OK;
}

static hs_status expand(const hs_check_names *names, const char *word, int depth, hs_name_list *expanded,
                        bool *is_known, hs_error *err)
{
    const char *at = strchr(word, '$');
    if (at == NULL) return hs_name_list_add(expanded, word, err);
    hs_dollar dollar;
    hs_error unsure = {0};
    const hs_known_variable *known = NULL;
    if (depth < DEPTH_MAX && hs_dollar_read(at, &dollar, &unsure) == HS_OK && dollar.kind == HS_DOLLAR_NAME)
        known = find(names, dollar.inside, dollar.n_inside);
    if (known == NULL || known->is_open || expanded->n + known->values.n > COMBINATIONS_MAX) {
        *is_known = false;
        return HS_OK;
    }
    hs_text one = {0};
    hs_status status = HS_OK;
    for (int i = 0; i < known->values.n && status == HS_OK && *is_known; ++i) {
        hs_text_clear(&one);
        if (strchr(known->values.name[i], '$') != NULL)
            *is_known = false;
        else
            status = hs_text_printf(&one, err, "%.*s%s%s", (int)(at - word), word, known->values.name[i],
                                    at + dollar.length);
        if (status == HS_OK && *is_known) status = expand(names, hs_text_get(&one), depth + 1, expanded, is_known, err);
    }
    hs_text_fini(&one);
    return status;
}

hs_status hs_check_names_expand(const hs_check_names *names, const char *word, hs_name_list *expanded, hs_error *err)
{
    bool is_known = true;
    HS_TRY(expand(names, word, 0, expanded, &is_known, err));
    if (!is_known) hs_name_list_fini(expanded);
    return HS_OK;
}
