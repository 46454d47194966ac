/* Facts of a deck that its outputs do not repeat. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "io/quantity.h"
#include "io/table.h"

enum { WORDS_MAX = 6, LINE_SIZE = 1024 };

static hs_status add_name(hs_deck_facts *facts, char kind, const char *id, const char *style, hs_error *err)
{
    for (int k = 0; k < facts->n_names; ++k) /* the last definition counts */
        if (facts->name[k].kind == kind && strcmp(facts->name[k].id, id) == 0)
            return hs_memory_replace(&facts->name[k].style, style, err);
    HS_TRY(HS_GROW(facts->name, (size_t)facts->n_names, (size_t)facts->n_names + 1, err));
    hs_deck_name *name = &facts->name[facts->n_names++];
    *name = (hs_deck_name){.kind = kind};
    HS_TRY(hs_memory_strdup(&name->id, id, err));
    return hs_memory_strdup(&name->style, style, err);
}

static void set_units(hs_deck_facts *facts, const hs_units *units)
{
    if (facts->units != NULL || facts->dt == 0.0) facts->dt = units->dt;
    facts->units = units;
    facts->is_per_atom = units->energy_per_atom != 0;
}

static hs_status learn_line(hs_deck_facts *facts, char *const *word, int n, hs_error *err)
{
    double dt;
    if (n < 2) return HS_OK;
    if (strcmp(word[0], "units") == 0 && hs_units_find(word[1]) != NULL) set_units(facts, hs_units_find(word[1]));
    /* a deck that does not say has LAMMPS's default by the time it chooses a pair style */
    if (strcmp(word[0], "pair_style") == 0 && facts->units == NULL) set_units(facts, hs_units_find("lj"));
    if (strcmp(word[0], "timestep") == 0 && hs_text_to_double(word[1], &dt) && dt > 0.0) facts->dt = dt;
    if (strcmp(word[0], "dimension") == 0) facts->dimension = word[1][0] == '2' ? 2 : 3;
    if (strcmp(word[0], "thermo_modify") == 0)
        for (int k = 1; k + 1 < n; ++k)
            if (strcmp(word[k], "norm") == 0) facts->is_per_atom = strcmp(word[k + 1], "yes") == 0;
    if (n > 3 && strcmp(word[0], "compute") == 0) return add_name(facts, 'c', word[1], word[3], err);
    if (n > 3 && strcmp(word[0], "fix") == 0) return add_name(facts, 'f', word[1], word[3], err);
    if (n > 2 && strcmp(word[0], "variable") == 0) return add_name(facts, 'v', word[1], word[2], err);
    return HS_OK;
}

hs_status hs_deck_facts_learn(hs_deck_facts *facts, const char *text, hs_error *err)
{
    if (facts->dimension == 0) facts->dimension = 3;
    while (*text != '\0') {
        char line[LINE_SIZE], *word[WORDS_MAX], *rest = NULL;
        const size_t length = strcspn(text, "\n"), kept = length < LINE_SIZE ? length : LINE_SIZE - 1;
        memcpy(line, text, kept);
        line[kept] = '\0';
        text += length + (text[length] == '\n');
        int n = 0;
        for (char *next = strtok_r(line, " \t\r", &rest); next != NULL && n < WORDS_MAX && next[0] != '#';
             next = strtok_r(NULL, " \t\r", &rest))
            word[n++] = next;
        HS_TRY(learn_line(facts, word, n, err));
    }
    return HS_OK;
}

hs_status hs_deck_facts_read(hs_deck_facts *facts, const char *path, hs_error *err)
{
    hs_text text = {0};
    hs_status status = hs_table_read_text(path, &text, err);
    if (status == HS_OK) status = hs_deck_facts_learn(facts, hs_text_get(&text), err);
    hs_text_fini(&text);
    return status;
}

hs_status hs_deck_facts_set_units(hs_deck_facts *facts, const char *name, hs_error *err)
{
    const hs_units *units = hs_units_find(name);
    if (units == NULL) {
        size_t n = 0;
        while (hs_units_names[n] != NULL) ++n;
        const char *nearest = hs_text_nearest(name, hs_units_names, n);
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a unit system%s%s%s", name,
                       nearest != NULL ? "; did you mean '" : " (lj, real, metal, si, cgs, electron, micro, nano)",
                       nearest != NULL ? nearest : "", nearest != NULL ? "'?" : "");
    }
    set_units(facts, units);
    return HS_OK;
}

void hs_deck_facts_fini(hs_deck_facts *facts)
{
    for (int k = 0; k < facts->n_names; ++k) {
        HS_FREE(facts->name[k].id);
        HS_FREE(facts->name[k].style);
    }
    HS_FREE(facts->name);
    facts->n_names = 0;
}
