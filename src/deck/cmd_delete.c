/* The command delete_atoms. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "deck/by_id.h"
#include "deck/command.h"
#include "deck/marsaglia.h"
#include "deck/place_atoms.h"
#include "style/pair_scan.h"

typedef enum { DELETE_GROUP, DELETE_REGION, DELETE_OVERLAP, DELETE_POROSITY } delete_style;
static const char *const delete_styles[] = {"group", "region", "overlap", "porosity", NULL};
static const int delete_words[] = {1, 1, 3, 3};

static const hs_keyword delete_keywords[] = {
    {"compress", 1, "yes|no", "number the atoms that are left from 1 on without gaps (default: yes)"},
    {"bond", 1, "no", "there are no bonds to be deleted"},
    {"mol", 1, "no", "there are no molecules to be deleted"},
    {NULL, 0, NULL, NULL},
};

static hs_syntax syntax_of(int style)
{
    return (hs_syntax){"group <group-ID> | region <ID> | overlap <cutoff> <group-1> <group-2> | porosity <region-ID> "
                       "<fraction> <seed> [keyword value ...]",
                       1 + delete_words[style], 1 + delete_words[style], delete_keywords};
}

static hs_status delete_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int style;
    if (strchr(args->word[0], '$') != NULL) return HS_OK;
    HS_TRY(hs_arg_choice(args, 0, delete_styles, &style, err));
    const hs_syntax syntax = syntax_of(style);
    return hs_syntax_check(&syntax, args, has_variables, err);
}

static hs_status mark_group(hs_sim *sim, const hs_args *args, unsigned char *drop, hs_error *err)
{
    int bit;
    HS_TRY(hs_groups_get(&sim->groups, args->word[1], &bit, err));
    for (int i = 0; i < sim->atoms.n_local; ++i) drop[i] = (sim->atoms.mask[i] & hs_group_mask(bit)) != 0;
    return HS_OK;
}

static hs_status mark_region(hs_sim *sim, const hs_args *args, unsigned char *drop, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    const hs_region *region;
    HS_TRY(hs_sim_need_region(sim, args->command, args->word[1], &region, err));
    for (int i = 0; i < atoms->n_local; ++i) drop[i] = hs_region_has(region, atoms, i);
    return HS_OK;
}

/** Pairs of atoms that overlap. */
typedef struct overlap {
    hs_pair_scan *scan;
    uint32_t mask[2];
} overlap;

/** Whether i goes because of j. Of two that could both go, the one with the higher id stays. */
static bool goes(const overlap *o, int i, int j)
{
    const uint32_t *mask = o->scan->mask;
    if (!(mask[i] & o->mask[0]) || !(mask[j] & o->mask[1])) return false;
    const bool is_mutual = mask[j] & o->mask[0] && mask[i] & o->mask[1];
    return !(is_mutual && o->scan->id[j] < o->scan->id[i]);
}

static void mark_pairs(void *context, int thread, const hs_pair_batch *batch)
{
    const overlap *o = context;
    double *n = o->scan->atoms.f[0];
    (void)thread;
    for (int p = 0; p < batch->n; ++p) {
        const int i = batch->i[p], j = batch->j[p];
        n[i] += goes(o, i, j);
        n[j] += goes(o, j, i);
    }
}

static hs_status mark_overlap(hs_sim *sim, const hs_args *args, unsigned char *drop, hs_error *err)
{
    hs_pair_scan scan = {0};
    overlap o = {.scan = &scan};
    double cutoff;
    HS_TRY(hs_arg_positive(args, 1, &cutoff, err));
    for (int k = 0; k < 2; ++k) {
        int bit;
        HS_TRY(hs_groups_get(&sim->groups, args->word[2 + k], &bit, err));
        o.mask[k] = hs_group_mask(bit);
    }
    HS_TRY(hs_atoms_bring_back(sim, args->command, err));
    const hs_status status = hs_pair_scan_begin(&scan, &sim->env, cutoff, err);
    if (status == HS_OK) {
        for (int k = 0; k < 3; ++k) memset(scan.atoms.f[k], 0, (size_t)scan.n_all * sizeof(double));
        hs_pair_scan_visit(&scan, mark_pairs, &o);
        hs_pair_scan_reverse(&scan);
        for (int i = 0; i < sim->atoms.n_local; ++i) drop[i] = scan.atoms.f[0][i] > 0.0;
    }
    hs_pair_scan_end(&scan);
    return status;
}

/** Something that is counted along ascending ids of all ranks, for the local atoms among them. */
typedef struct walk {
    const hs_atoms *atoms;
    const int32_t *order; /**< local atoms by id */
    int next;             /**< of order[] */
    int64_t n;            /**< ids so far */
    hs_marsaglia generator;
    double fraction;
    unsigned char *drop;
    int64_t *wanted;     /**< [n_local]: numbers of holes, ... */
    int64_t *new_id;     /**< [n_local] */
    const int32_t *tail; /**< local atoms that look for holes, in the order of wanted[] */
    int n_tail;
} walk;

/** The local atom with that id, -1: another rank's. */
static int local_of(walk *w, int64_t id)
{
    while (w->next < w->atoms->n_local && w->atoms->id[w->order[w->next]] < id) ++w->next;
    if (w->next == w->atoms->n_local || w->atoms->id[w->order[w->next]] != id) return -1;
    return w->order[w->next];
}

static hs_status draw(void *context, int64_t id, hs_error *err)
{
    walk *w = context;
    const int i = local_of(w, id);
    const double u = hs_marsaglia_uniform(&w->generator);
    (void)err;
    if (i >= 0) w->drop[i] = u <= w->fraction;
    return HS_OK;
}

/** One number for each atom of the region in the order of ids, as LAMMPS draws them on one rank. */
static hs_status mark_porosity(hs_sim *sim, const hs_args *args, unsigned char *drop, hs_error *err)
{
    walk w = {.atoms = &sim->atoms, .drop = drop};
    int32_t *order = NULL;
    unsigned char *selected = NULL;
    int64_t seed;
    HS_TRY(hs_arg_double(args, 2, &w.fraction, err));
    if (!(w.fraction >= 0.0 && w.fraction <= 1.0)) return hs_arg_refuse(args, 2, "a fraction from 0 to 1", NULL, err);
    HS_TRY(hs_arg_int(args, 3, 1, HS_MARSAGLIA_SEED_MAX, &seed, err));
    HS_TRY(mark_region(sim, args, drop, err));
    hs_marsaglia_init(&w.generator, (int)seed);
    hs_status status = hs_by_id_order(&sim->atoms, &order, err);
    if (status == HS_OK) status = HS_ALLOC(selected, (size_t)sim->atoms.n_local, err);
    if (hs_parallel_agree(&sim->parallel, err) == HS_OK) {
        if (sim->atoms.n_local > 0) memcpy(selected, drop, (size_t)sim->atoms.n_local);
        w.order = order;
        status = hs_by_id_visit(sim, selected, draw, &w, err);
    }
    HS_FREE(order);
    HS_FREE(selected);
    return status != HS_OK ? status : err->status;
}

/* Numbering anew */

static hs_status number(void *context, int64_t id, hs_error *err)
{
    walk *w = context;
    const int i = local_of(w, id);
    (void)err;
    ++w->n;
    if (i >= 0) w->new_id[i] = w->n;
    return HS_OK;
}

/** The ids of deleted atoms, ascending: each goes to the atom that waits for this one. */
static hs_status fill_hole(void *context, int64_t id, hs_error *err)
{
    walk *w = context;
    (void)err;
    while (w->next < w->n_tail && w->wanted[w->tail[w->next]] < w->n) ++w->next;
    if (w->next < w->n_tail && w->wanted[w->tail[w->next]] == w->n) w->new_id[w->tail[w->next]] = id;
    ++w->n;
    return HS_OK;
}

/** Memory of hs_sim renumbering: see renumber. */
typedef struct renumbering {
    int32_t *order, *tail;    /**< owned [n_local] */
    int64_t *wanted, *new_id; /**< owned [n_local] */
    unsigned char *selected;  /**< owned [n_local] */
} renumbering;

static hs_status allocate(renumbering *r, const hs_atoms *atoms, hs_error *err)
{
    const size_t n = (size_t)atoms->n_local;
    HS_TRY(hs_by_id_order(atoms, &r->order, err));
    HS_TRY(HS_ALLOC(r->tail, n, err));
    HS_TRY(HS_ALLOC(r->wanted, n, err));
    HS_TRY(HS_ALLOC(r->new_id, n, err));
    return HS_ALLOC(r->selected, n, err);
}

/** Ids 1 to N before: as in LAMMPS, whose last atom moves into the first gap, then the last but one into the second,
 *  atoms keep their ids unless they are beyond the new number of atoms; those get the ids of the gaps. */
static hs_status fill_gaps(hs_sim *sim, const unsigned char *drop, int64_t n_left, renumbering *r, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    walk w = {.atoms = atoms, .order = r->order, .new_id = r->wanted};
    for (int i = 0; i < atoms->n_local; ++i) {
        r->new_id[i] = atoms->id[i];
        r->selected[i] = !drop[i] && atoms->id[i] > n_left;
    }
    HS_TRY(hs_by_id_visit(sim, r->selected, number, &w, err)); /* wanted[i]: from 1, ascending ids */
    walk holes = {.atoms = atoms, .wanted = r->wanted, .new_id = r->new_id, .tail = r->tail};
    for (int k = atoms->n_local; k-- > 0;) { /* the last atom comes first */
        const int i = r->order[k];
        if (!r->selected[i]) continue;
        r->wanted[i] = w.n - r->wanted[i];
        r->tail[holes.n_tail++] = i;
    }
    for (int i = 0; i < atoms->n_local; ++i) r->selected[i] = drop[i] && atoms->id[i] <= n_left;
    return hs_by_id_visit(sim, r->selected, fill_hole, &holes, err);
}

/** Any ids before: the order of ids stays. */
static hs_status close_ranks(hs_sim *sim, const unsigned char *drop, renumbering *r, hs_error *err)
{
    walk w = {.atoms = &sim->atoms, .order = r->order, .new_id = r->new_id};
    for (int i = 0; i < sim->atoms.n_local; ++i) r->selected[i] = !drop[i];
    return hs_by_id_visit(sim, r->selected, number, &w, err);
}

/** New ids of the atoms that are left (collective). */
static hs_status renumber(hs_sim *sim, const unsigned char *drop, int64_t n_left, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    renumbering r = {0};
    int64_t max_id = hs_atoms_max_id(atoms);
    hs_parallel_max_int64(&sim->parallel, &max_id, 1);
    hs_status status = allocate(&r, atoms, err);
    if (hs_parallel_agree(&sim->parallel, err) == HS_OK)
        status = max_id == atoms->n_all ? fill_gaps(sim, drop, n_left, &r, err) : close_ranks(sim, drop, &r, err);
    if (status == HS_OK && err->status == HS_OK)
        for (int i = 0; i < atoms->n_local; ++i) atoms->id[i] = r.new_id[i];
    HS_FREE(r.order);
    HS_FREE(r.tail);
    HS_FREE(r.wanted);
    HS_FREE(r.new_id);
    HS_FREE(r.selected);
    return status != HS_OK ? status : err->status;
}

static hs_status mark(hs_sim *sim, const hs_args *args, int style, unsigned char *drop, hs_error *err)
{
    switch ((delete_style)style) {
    case DELETE_GROUP:
        return mark_group(sim, args, drop, err);
    case DELETE_REGION:
        return mark_region(sim, args, drop, err);
    case DELETE_OVERLAP:
        return mark_overlap(sim, args, drop, err);
    default:
        return mark_porosity(sim, args, drop, err);
    }
}

static hs_status delete_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    unsigned char *drop = NULL;
    int style;
    bool is_compressed = true;
    HS_TRY(delete_check(args, false, err));
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(hs_arg_choice(args, 0, delete_styles, &style, err));
    for (int i = 1 + delete_words[style]; i + 1 < args->n; i += 2)
        if (strcmp(args->word[i], "compress") == 0) HS_TRY(hs_arg_bool(args, i + 1, &is_compressed, err));
    HS_TRY(HS_ALLOC(drop, (size_t)sim->atoms.n_local, err));
    hs_status status = mark(sim, args, style, drop, err);
    if (hs_parallel_agree(&sim->parallel, err) == HS_OK) {
        int64_t n_dropped = 0;
        for (int i = 0; i < sim->atoms.n_local; ++i) n_dropped += drop[i] != 0;
        hs_parallel_sum_int64(&sim->parallel, &n_dropped, 1);
        const int64_t n_left = sim->atoms.n_all - n_dropped;
        if (is_compressed) status = renumber(sim, drop, n_left, err);
        if (status == HS_OK) {
            hs_atoms_remove(&sim->atoms, drop);
            hs_sim_atoms_changed(sim);
            hs_say(deck->out, "Deleted %lld atoms, new total = %lld\n", (long long)n_dropped, (long long)n_left);
        }
    }
    HS_FREE(drop);
    return status != HS_OK ? status : err->status;
}

static hs_status reset_ids_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    unsigned char *none = NULL;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(hs_atoms_bring_back(sim, args->command, err));
    HS_UNLESS_FAILED(err, HS_ALLOC(none, (size_t)sim->atoms.n_local, err));
    hs_status status = hs_parallel_agree(&sim->parallel, err);
    if (status == HS_OK) {
        hs_say(deck->out, "Resetting atom IDs ...\n");
        status = renumber(sim, none, sim->atoms.n_all, err);
    }
    HS_FREE(none);
    if (status == HS_OK) hs_sim_atoms_changed(sim);
    return status;
}

static const hs_keyword reset_ids_keywords[] = {
    {"sort", 1, "no", "the order of ids stays (default); LAMMPS's order in space is not known here"},
    {NULL, 0, NULL, NULL},
};

const hs_command hs_commands_delete[] = {
    {
        .about =
            {
                .name = "reset_atom_ids",
                .syntax = {"[sort no]", 0, 0, reset_ids_keywords},
                .summary = "Number the atoms from 1 on without gaps",
                .details = "Ids become 1 to N, in the order in which they are. Where there are no gaps no id changes. "
                           "Atoms that have left the "
                           "box since the last lists are brought back, also by `balance` and `delete_atoms overlap`. "
                           "`delete_atoms` does so by itself; atoms that fixes remove leave gaps.\n",
                .example = "fix 1 all evaporate 100 10 top 4711\nrun 10000\nunfix 1\nreset_atom_ids",
            },
        .run = reset_ids_run,
    },
    {
        .about =
            {
                .name = "delete_atoms",
                .syntax = {"<style> <words> ... [keyword value ...]", 2, -1, NULL},
                .summary = "Remove atoms",
                .details = "`group <group-ID>` removes the atoms of a group, `region <ID>` those in a region.\n\n"
                           "`overlap <cutoff> <group-1> <group-2>` removes atoms of the first group that are nearer "
                           "than the cutoff (distance units) to one of the second; of two atoms that are in both "
                           "groups the one with the lower id goes. No pair style is needed.\n\n"
                           "`porosity <region-ID> <fraction> <seed>` removes a fraction of the atoms in a region, "
                           "chosen at random.\n\n"
                           "With `compress yes`, the default, the ids of the atoms that are left become 1 to N: those "
                           "beyond N get the ids that have become free, the highest the lowest, as in LAMMPS.\n",
                .example = "delete_atoms group gas\ndelete_atoms overlap 0.8 all all\n"
                           "delete_atoms porosity slab 0.1 482793 compress no",
            },
        .run = delete_run,
        .check = delete_check,
    },
    {.about = {.name = NULL}},
};
