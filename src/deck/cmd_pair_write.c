/* Command pair_write: the potential of a pair of types as a table in a file. */
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/printed.h"
#include "io/potential_file.h"
#include "io/writer.h"

typedef struct plan {
    int type[2];
    int n;
    bool by_square;
    double first, last; /**< distance */
    const char *file, *section;
} plan;

static hs_status read_plan(plan *p, const hs_sim *sim, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"r", "rsq", NULL};
    int64_t n;
    int style;
    for (int k = 0; k < 2; ++k) {
        HS_TRY(hs_arg_type(args, k, sim->atoms.n_types, &n, err));
        p->type[k] = (int)n;
    }
    HS_TRY(hs_arg_int(args, 2, 2, 100000000, &n, err));
    HS_TRY(hs_arg_choice(args, 3, styles, &style, err));
    HS_TRY(hs_arg_positive(args, 4, &p->first, err));
    HS_TRY(hs_arg_positive(args, 5, &p->last, err));
    if (p->last <= p->first) return hs_arg_refuse(args, 5, "larger than the first distance", NULL, err);
    p->n = (int)n;
    p->by_square = style == 1;
    p->file = args->word[6];
    p->section = args->word[7];
    return HS_OK;
}

/** Energy and force of a pair at a distance: those of all parts of the pair style. */
static void evaluate(const hs_pair *pair, const plan *p, double r, double *energy, double *force)
{
    const int i = p->type[0] < p->type[1] ? p->type[0] : p->type[1], j = p->type[0] + p->type[1] - i;
    *energy = *force = 0.0;
    for (int k = 0; k < pair->n_parts; ++k) {
        const hs_pair *part = pair->part[k];
        const hs_evaluator *evaluator = part->style->evaluator;
        double params[HS_EVALUATOR_PARAMS_MAX], cutoff = part->cutoff[hs_pair_index(part, i, j)], over_r, u;
        if (evaluator == NULL || !(r * r < cutoff * cutoff)) continue;
        part->style->params(part, i, j, &cutoff, params);
        const double *shared = part->style->shared != NULL ? part->style->shared(part) : NULL;
        evaluator->single(params, shared, r * r, &over_r, &u);
        *energy += u;
        *force += over_r * r;
    }
}

static hs_status write_section(hs_writer *writer, const hs_sim *sim, const plan *p, bool is_new, hs_error *err)
{
    if (is_new) HS_TRY(hs_writer_printf(writer, err, "# UNITS: %s Created by pair_write\n", sim->env.units->name));
    HS_TRY(hs_writer_printf(writer, err, "# Pair potential %s for atom types %d %d: i,r,energy,force\n\n",
                            sim->pair->style->about.name, p->type[0], p->type[1]));
    HS_TRY(hs_writer_printf(writer, err, "%s\nN %d %s %.15g %.15g\n\n", p->section, p->n, p->by_square ? "RSQ" : "R",
                            p->first, p->last));
    for (int i = 0; i < p->n; ++i) {
        const double r = hs_tabulated_distance(i, p->n, p->first, p->last, p->by_square);
        double energy, force;
        evaluate(sim->pair, p, r, &energy, &force);
        if (!isfinite(energy) || !isfinite(force))
            return hs_fail(err, HS_ERROR_INPUT, "pair_write: energy or force is not finite at the distance %g", r);
        HS_TRY(hs_writer_printf(writer, err, "%d %.15g %.15g %.15g\n", i + 1, r, energy, force));
    }
    return HS_OK;
}

/** On one rank. */
static hs_status write_file(hs_deck *deck, const plan *p, hs_error *err)
{
    hs_writer *writer = NULL;
    const bool is_new = access(p->file, F_OK) != 0;
    HS_TRY(hs_writer_open(&writer, p->file, HS_WRITE_APPEND, err));
    const hs_status status = write_section(writer, deck->sim, p, is_new, err);
    if (status != HS_OK) {
        hs_writer_abandon(&writer);
        return status;
    }
    HS_TRY(hs_writer_close(&writer, err));
    struct stat info;
    if (stat(p->file, &info) != 0 || !S_ISREG(info.st_mode)) return HS_OK;
    return hs_printed_note(&deck->printed, p->file, info.st_size, err);
}

static hs_status run_pair_write(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    plan p;
    HS_TRY(hs_sim_need_box(sim, "pair_write", err));
    HS_TRY(hs_sim_need_pair(sim, "pair_write", err));
    HS_TRY(read_plan(&p, sim, args, err));
    HS_TRY(hs_sim_setup_pair(sim, err));
    sim->is_initialized = false;
    if (!hs_pair_has_forces(sim->pair) || hs_pair_has_radii(sim->pair, false))
        return hs_fail(err, HS_ERROR_INPUT, "pair_write: the potential of pair_style %s %s",
                       sim->pair->style->about.name,
                       hs_pair_has_forces(sim->pair) ? "depends on the sizes of the atoms, too" : "is zero everywhere");
    if (deck->options.dry_run || sim->env.is_resuming) return HS_OK;
    if (sim->parallel.rank == 0) HS_UNLESS_FAILED(err, write_file(deck, &p, err));
    return hs_parallel_agree(&sim->parallel, err);
}

const hs_command hs_commands_pair_write[] = {
    {.about = {.name = "pair_write",
               .syntax = {.usage = "<I> <J> <N> r|rsq <first> <last> <output-file> <section>", .n_min = 8, .n_max = 8},
               .summary = "Write the potential of a pair of types to a table in a file",
               .details =
                   "N rows of number, distance, energy and force, at distances from `first` to `last` that are equally "
                   "spaced in r or r^2: what `pair_style table` reads, and any plotting program. The section "
                   "is added to the file if there is one. Beyond the cutoff energy and force are 0. LAMMPS's "
                   "style `bitmap` and charges are not supported, nor are potentials that depend on the sizes "
                   "of atoms.",
               .example = "pair_write 1 1 500 r 0.8 2.5 potentials.table LJ_12_6"},
     .run = run_pair_write},
    {.run = NULL},
};
