/* The styles a simulation owns: pair, fixes, computes, regions, dumps. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "sim/restored.h"
#include "sim/sim.h"

/* The kinds of named styles are kept in arrays of pointers alike; one set of macros serves their lists. */
#define DESTROY_STYLE(item)                                                                                            \
    do {                                                                                                               \
        if ((item)->state != NULL && (item)->style->destroy != NULL) (item)->style->destroy(item);                     \
        HS_FREE((item)->state);                                                                                        \
        HS_FREE((item)->id);                                                                                           \
        HS_FREE(item);                                                                                                 \
    } while (0)

static void destroy_fix(hs_fix *fix)
{
    hs_compute *own[HS_FIX_OWN_MAX];
    memcpy(own, fix->own, sizeof own);
    DESTROY_STYLE(fix);
    for (int k = 0; k < HS_FIX_OWN_MAX; ++k) hs_compute_destroy(&own[k]);
}

static void destroy_dump(hs_dump *dump)
{
    HS_FREE(dump->file);
    HS_FREE(dump->every_variable);
    DESTROY_STYLE(dump);
}

void hs_sim_destroy_styles(hs_sim *sim)
{
    /* they may look up one another while they go: nothing that is gone is listed */
    while (sim->n_dumps > 0) destroy_dump(sim->dump[--sim->n_dumps]);
    while (sim->n_fixes > 0) destroy_fix(sim->fix[--sim->n_fixes]);
    while (sim->n_computes > 0) hs_compute_destroy(&sim->compute[--sim->n_computes]);
    while (sim->n_regions > 0) hs_region_destroy(&sim->region[--sim->n_regions]);
    HS_FREE(sim->dump);
    HS_FREE(sim->fix);
    HS_FREE(sim->compute);
    HS_FREE(sim->region);
    hs_pair_destroy(&sim->pair);
    hs_text_fini(&sim->pair_words);
}

/** Error for a style name that is not in a table. */
static hs_status unknown_style(const char *kind, const char *name, const char *const *names, size_t n, hs_error *err)
{
    const char *nearest = hs_text_nearest(name, names, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: unknown style '%s'; did you mean '%s'?", kind, name, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "%s: unknown style '%s'; 'halfshell help' lists those there are", kind, name);
}

#define LOOK_UP(table, kind, name, found, err)                                                                         \
    do {                                                                                                               \
        const char *names_[256] = {NULL};                                                                              \
        size_t n_ = 0;                                                                                                 \
        (found) = NULL;                                                                                                \
        for (size_t k_ = 0; (table)[k_] != NULL; ++k_) {                                                               \
            if (n_ < 256) names_[n_++] = (table)[k_]->about.name;                                                      \
            if (hs_text_is_style((name), (table)[k_]->about.name)) (found) = (table)[k_];                              \
        }                                                                                                              \
        if ((found) == NULL) return unknown_style((kind), (name), names_, n_, (err));                                  \
    } while (0)

/** Syntax check of a style's own words, with "fix nve" as the command's name in messages. */
static hs_status check_words(const char *kind, const hs_description *about, const hs_args *args, char *command,
                             size_t size, hs_args *named, hs_error *err)
{
    snprintf(command, size, "%s %s", kind, about->name);
    *named = hs_args_from(args, 0, command);
    return hs_syntax_check(&about->syntax, named, false, err);
}

/* Pair style */

static hs_status create_pair(hs_sim *sim, const hs_pair_style *style, hs_error *err)
{
    hs_pair_destroy(&sim->pair);
    return hs_pair_create(&sim->pair, style, &sim->env, sim->atoms.n_types, err);
}

/** Remember the words of pair_style, one after the other with their zeros. */
static hs_status keep_pair_words(hs_sim *sim, const hs_args *args, hs_error *err)
{
    hs_text_clear(&sim->pair_words);
    for (int i = 0; i < args->n; ++i)
        HS_TRY(hs_text_append(&sim->pair_words, args->word[i], strlen(args->word[i]) + 1, err));
    return HS_OK;
}

hs_status hs_sim_set_pair(hs_sim *sim, const char *name, const hs_args *args, hs_error *err)
{
    const hs_pair_style *style;
    char command[128];
    hs_args named;
    LOOK_UP(hs_pair_styles, "pair_style", name, style, err);
    HS_TRY(check_words("pair_style", &style->about, args, command, sizeof command, &named, err));
    HS_TRY(keep_pair_words(sim, &named, err));
    if (sim->pair == NULL || sim->pair->style != style) HS_TRY(create_pair(sim, style, err));
    sim->is_initialized = false;
    return style->settings(sim->pair, &named, err);
}

hs_status hs_sim_fit_pair(hs_sim *sim, hs_error *err)
{
    enum { WORDS_MAX = 256 };
    const hs_pair *pair = sim->pair;
    const char *words[WORDS_MAX];
    if (pair == NULL || pair->n_types == sim->atoms.n_types) return HS_OK;
    hs_args args = {.command = "pair_style", .n = 0, .word = words};
    const char *const end = sim->pair_words.data + sim->pair_words.length;
    for (const char *at = sim->pair_words.data; at < end && args.n < WORDS_MAX; at += strlen(at) + 1)
        words[args.n++] = at;
    hs_pair *fitted = NULL;
    hs_status status = hs_pair_create(&fitted, pair->style, &sim->env, sim->atoms.n_types, err);
    if (status == HS_OK) status = fitted->style->settings(fitted, &args, err);
    if (status != HS_OK) {
        hs_pair_destroy(&fitted);
        return status;
    }
    hs_pair_copy_modified(fitted, pair);
    hs_pair_destroy(&sim->pair);
    sim->pair = fitted;
    return HS_OK;
}

hs_status hs_sim_pair_coeff(hs_sim *sim, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_sim_need_box(sim, "pair_coeff", err));
    HS_TRY(hs_sim_need_pair(sim, "pair_coeff", err));
    HS_TRY(hs_sim_fit_pair(sim, err));
    hs_pair *pair = sim->pair;
    int i_lo, i_hi, j_lo, j_hi, n_set = 0;
    HS_TRY(hs_arg_range(args, 0, pair->n_types, &i_lo, &i_hi, err));
    HS_TRY(hs_arg_range(args, 1, pair->n_types, &j_lo, &j_hi, err));
    const hs_args words = hs_args_from(args, 2, "pair_coeff <I> <J>");
    HS_TRY(hs_syntax_check(&pair->style->coeff_syntax, &words, false, err));
    for (int i = i_lo; i <= i_hi; ++i)
        for (int j = j_lo > i ? j_lo : i; j <= j_hi; ++j) {
            HS_TRY(pair->style->coeff(pair, i, j, &words, err));
            pair->is_set[hs_pair_index(pair, i, j)] = 1;
            ++n_set;
        }
    if (n_set == 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "pair_coeff: '%s %s' names no pair with the first type not above the second; write the smaller type first",
            args->word[0], args->word[1]);
    sim->is_initialized = false;
    return HS_OK;
}

/* Named styles */

hs_status hs_sim_add_fix(hs_sim *sim, const char *id, const char *group, const char *name, const hs_args *args,
                         hs_error *err)
{
    const hs_fix_style *style;
    char command[128];
    hs_args named;
    int bit, place = 0;
    LOOK_UP(hs_fix_styles, "fix", name, style, err);
    HS_TRY(check_words("fix", &style->about, args, command, sizeof command, &named, err));
    HS_TRY(hs_name_check("fix", "ID", id, err));
    if (!style->needs_no_box) HS_TRY(hs_sim_need_box(sim, "fix", err));
    HS_TRY(hs_groups_get(&sim->groups, group, &bit, err));
    while (place < sim->n_fixes && strcmp(sim->fix[place]->id, id) != 0) ++place;
    if (place < sim->n_fixes && sim->fix[place]->style != style)
        return hs_fail(err, HS_ERROR_INPUT, "fix: the ID '%s' is taken by a fix %s; unfix it first or use another", id,
                       sim->fix[place]->style->about.name);
    hs_fix *fix;
    HS_TRY(HS_ALLOC(fix, 1, err));
    *fix = (hs_fix){.style = style,
                    .group = bit,
                    .mask = hs_group_mask(bit),
                    .env = &sim->env,
                    .n_vector = style->n_vector,
                    .is_extensive = style->is_extensive,
                    .is_vector_extensive = style->is_vector_extensive,
                    .is_coupling = style->is_coupling,
                    .has_scalar = style->scalar != NULL,
                    .has_vector = style->vector != NULL,
                    .has_array = style->array != NULL,
                    .has_atoms = style->per_atom != NULL};
    hs_status status = hs_memory_strdup(&fix->id, id, err);
    if (status == HS_OK) status = hs_memory_alloc(&fix->state, 1, style->state_size + 1, err);
    if (status == HS_OK && style->create != NULL) status = style->create(fix, &named, err);
    if (status == HS_OK && place == sim->n_fixes) status = HS_GROW(sim->fix, (size_t)place, (size_t)place + 1, err);
    if (status != HS_OK) {
        destroy_fix(fix);
        return status;
    }
    if (place < sim->n_fixes)
        destroy_fix(sim->fix[place]);
    else
        ++sim->n_fixes;
    sim->fix[place] = fix;
    sim->is_initialized = false;
    hs_restored_give_fields(sim, HS_RESTORED_FIX, id);
    return hs_sim_fit_force_places(sim, err);
}

hs_status hs_sim_add_compute(hs_sim *sim, const char *id, const char *group, const char *name, const hs_args *args,
                             hs_error *err)
{
    const hs_compute_style *style;
    char command[128];
    hs_args named;
    int bit;
    LOOK_UP(hs_compute_styles, "compute", name, style, err);
    HS_TRY(check_words("compute", &style->about, args, command, sizeof command, &named, err));
    HS_TRY(hs_name_check("compute", "ID", id, err));
    HS_TRY(hs_groups_get(&sim->groups, group, &bit, err));
    if (hs_sim_find_compute(sim, id) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "compute: the ID '%s' is taken; uncompute it first or use another", id);
    HS_TRY(HS_GROW(sim->compute, (size_t)sim->n_computes, (size_t)sim->n_computes + 1, err));
    hs_compute *compute;
    HS_TRY(hs_compute_create(&compute, &sim->env, style, id, bit, &named, err));
    sim->compute[sim->n_computes++] = compute;
    hs_restored_give_fields(sim, HS_RESTORED_COMPUTE, id);
    return HS_OK;
}

hs_status hs_sim_add_region(hs_sim *sim, const char *id, const char *name, const hs_args *args, hs_error *err)
{
    if (id[0] == '\0') return hs_fail(err, HS_ERROR_INPUT, "region: the ID is empty");
    if (hs_sim_find_region(sim, id) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "region: the ID '%s' is taken; 'region %s delete' frees it", id, id);
    HS_TRY(HS_GROW(sim->region, (size_t)sim->n_regions, (size_t)sim->n_regions + 1, err));
    HS_TRY(hs_region_create(&sim->region[sim->n_regions], &sim->env, id, name, args, err));
    ++sim->n_regions;
    return HS_OK;
}

hs_status hs_sim_add_dump(hs_sim *sim, const char *id, const char *group, const char *name, int64_t every,
                          const char *file, const hs_args *args, hs_error *err)
{
    const hs_dump_style *style;
    char command[128];
    hs_args named;
    int bit;
    LOOK_UP(hs_dump_styles, "dump", name, style, err);
    HS_TRY(check_words("dump", &style->about, args, command, sizeof command, &named, err));
    HS_TRY(hs_name_check("dump", "ID", id, err));
    HS_TRY(hs_groups_get(&sim->groups, group, &bit, err));
    if (hs_sim_find_dump(sim, id) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "dump: the ID '%s' is taken; undump it first or use another", id);
    for (int k = 0; k < sim->n_dumps; ++k)
        if (strcmp(sim->dump[k]->file, file) == 0 && strncmp(file, "/dev/", 5) != 0)
            return hs_fail(err, HS_ERROR_INPUT, "dump: %s writes '%s' already; each needs a file of its own",
                           hs_dump_who(sim->dump[k]).text, file);
    hs_dump *dump;
    HS_TRY(HS_ALLOC(dump, 1, err));
    *dump = (hs_dump){.style = style,
                      .group = bit,
                      .mask = hs_group_mask(bit),
                      .env = &sim->env,
                      .every = every,
                      .last_written = -1,
                      .resume_at = -1};
    hs_status status = hs_memory_strdup(&dump->id, id, err);
    if (status == HS_OK) status = hs_memory_strdup(&dump->file, file, err);
    if (status == HS_OK) status = hs_memory_alloc(&dump->state, 1, style->state_size + 1, err);
    if (status == HS_OK && style->create != NULL) status = style->create(dump, &named, err);
    if (status == HS_OK) status = HS_GROW(sim->dump, (size_t)sim->n_dumps, (size_t)sim->n_dumps + 1, err);
    if (status != HS_OK) {
        destroy_dump(dump);
        return status;
    }
    sim->dump[sim->n_dumps++] = dump;
    return HS_OK;
}

/** Place of an ID in a list of styles; an error naming the kind when it is not there. */
#define PLACE_OF(list, n, kind, wanted, place, err)                                                                    \
    do {                                                                                                               \
        for ((place) = 0; (place) < (n) && strcmp((list)[place]->id, (wanted)) != 0;) ++(place);                       \
        if ((place) == (n))                                                                                            \
            return hs_fail((err), HS_ERROR_INPUT, "there is no %s with the ID '%s'", (kind), (wanted));                \
    } while (0)

#define CLOSE_GAP(list, n, place)                                                                                      \
    memmove(&(list)[place], &(list)[(place) + 1], sizeof *(list) * (size_t)(--(n) - (place)))

hs_status hs_sim_remove_fix(hs_sim *sim, const char *id, hs_error *err)
{
    int place;
    PLACE_OF(sim->fix, sim->n_fixes, "fix", id, place, err);
    destroy_fix(sim->fix[place]);
    CLOSE_GAP(sim->fix, sim->n_fixes, place);
    return hs_sim_fit_force_places(sim, err);
}

hs_status hs_sim_remove_compute(hs_sim *sim, const char *id, hs_error *err)
{
    int place;
    PLACE_OF(sim->compute, sim->n_computes, "compute", id, place, err);
    if (place < 3) return hs_fail(err, HS_ERROR_INPUT, "uncompute: '%s' belongs to the thermo output and stays", id);
    hs_compute_destroy(&sim->compute[place]);
    CLOSE_GAP(sim->compute, sim->n_computes, place);
    return HS_OK;
}

hs_status hs_sim_remove_region(hs_sim *sim, const char *id, hs_error *err)
{
    int place;
    PLACE_OF(sim->region, sim->n_regions, "region", id, place, err);
    for (int k = 0; k < sim->n_regions; ++k)
        if (k != place && hs_region_uses(sim->region[k], sim->region[place]))
            return hs_fail(err, HS_ERROR_INPUT, "region: '%s' is used by region '%s', which must be deleted first", id,
                           sim->region[k]->id);
    hs_region_destroy(&sim->region[place]);
    CLOSE_GAP(sim->region, sim->n_regions, place);
    return HS_OK;
}

hs_status hs_sim_remove_dump(hs_sim *sim, const char *id, hs_error *err)
{
    int place;
    PLACE_OF(sim->dump, sim->n_dumps, "dump", id, place, err);
    destroy_dump(sim->dump[place]);
    CLOSE_GAP(sim->dump, sim->n_dumps, place);
    return HS_OK;
}
