/* The command replicate. */
#include <string.h>

#include "base/memory.h"
#include "core/atom_id.h"
#include "deck/command.h"
#include "deck/place_atoms.h"
#include "style/box_shape.h"
#include "style/places.h"

static const hs_keyword replicate_keywords[] = {
    {"bbox", 0, "", "another way to the same result in LAMMPS: no effect"},
    {NULL, 0, NULL, NULL},
};

static hs_status check_room(const hs_sim *sim, const int64_t n[3], int64_t max_id, hs_error *err)
{
    const double n_copies = (double)n[0] * (double)n[1] * (double)n[2];
    if (n_copies * (double)max_id > (double)HS_ATOM_ID_MAX || n_copies * (double)sim->atoms.n_local > 2e9)
        (void)hs_fail(err, HS_ERROR_INPUT, "replicate: %g times %lld atoms are more than can be held", n_copies,
                      (long long)sim->atoms.n_all);
    else
        HS_UNLESS_FAILED(err, hs_atoms_check_room(&sim->atoms, (int64_t)n_copies * sim->atoms.n_local, 0, err));
    return hs_parallel_agree(&sim->parallel, err);
}

/** Copies have not been where their originals were when places were remembered. */
static hs_status refuse_places(const hs_sim *sim, hs_error *err)
{
    for (int k = 0; k < sim->atoms.n_fields; ++k) {
        const hs_atom_field *field = &sim->atoms.field[k]; /* "fix ID what" or "compute ID what" */
        const char *id = strchr(field->name, ' ');
        if (field->place_along == 0 || id == NULL) continue;
        return hs_fail(err, HS_ERROR_INPUT,
                       "replicate: %.*s '%.*s' remembers where atoms were, which copies were not: define it after",
                       (int)(id - field->name), field->name, (int)strcspn(id + 1, " "), id + 1);
    }
    return HS_OK;
}

/** Positions without images: LAMMPS copies the unwrapped system. */
static void unwrap(hs_sim *sim)
{
    hs_atoms *atoms = &sim->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        double x[3];
        hs_unwrapped_place(&sim->env, i, x);
        for (int axis = 0; axis < 3; ++axis) {
            atoms->x[axis][i] = x[axis];
            atoms->image[axis][i] = 0;
        }
    }
}

/** Append the copies of the local atoms, each with all that belongs to its original. */
static hs_status add_copies(hs_sim *sim, const int64_t n[3], int64_t max_id, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    const int n_before = atoms->n_local;
    char *record = NULL;
    atoms->n_halo = 0;
    HS_TRY(hs_atoms_reserve(atoms, n[0] * n[1] * n[2] * n_before, 0, err));
    HS_TRY(hs_memory_alloc((void **)&record, 1, hs_atoms_record_size(atoms), err));
    for (int64_t k = 1; k < n[0] * n[1] * n[2]; ++k) {
        const int32_t cell[3] = {(int32_t)(k % n[0]), (int32_t)(k / n[0] % n[1]), (int32_t)(k / (n[0] * n[1]))};
        double shift[3];
        hs_box_shift(&sim->box, cell, shift);
        for (int i = 0; i < n_before; ++i) {
            const int copy = atoms->n_local;
            hs_atoms_pack(atoms, i, record);
            hs_atoms_unpack(atoms, record);
            atoms->id[copy] = atoms->id[i] + k * max_id;
            for (int axis = 0; axis < 3; ++axis) {
                atoms->x[axis][copy] += shift[axis];
                atoms->f[axis][copy] = 0.0;
            }
        }
    }
    HS_FREE(record);
    return HS_OK;
}

static hs_status replicate_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_box *box = &sim->box;
    int64_t n[3], max_id;
    double length[3];
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(refuse_places(sim, err));
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_arg_int(args, axis, 1, 1000000, &n[axis], err));
        length[axis] = hs_box_length(box, axis);
        if (n[axis] > 1 && axis >= box->dimension)
            return hs_arg_refuse(args, axis, "1, as a 2d system needs it in z", NULL, err);
        if (n[axis] > 1 && !box->periodic[axis])
            hs_warn(deck->out, "replicate: the box is not periodic in %c: copies may not fit together", "xyz"[axis]);
    }
    max_id = hs_atoms_max_id(&sim->atoms);
    hs_parallel_max_int64(&sim->parallel, &max_id, 1);
    HS_TRY(check_room(sim, n, max_id, err));
    unwrap(sim);
    (void)add_copies(sim, n, max_id, err);
    HS_TRY(hs_parallel_agree(&sim->parallel, err));
    for (int axis = 0; axis < 3; ++axis) box->hi[axis] = box->lo[axis] + (double)n[axis] * length[axis];
    for (int k = 0; k < 3; ++k) box->tilt[k] *= (double)n[hs_tilt_second(k)];
    HS_TRY(hs_box_check_shape(box, sim->may_be_skewed, deck->out, args->command, err));
    hs_box_settle_faces(box);
    HS_TRY(hs_domain_divide(&sim->domain, box, err));
    HS_TRY(hs_atoms_wrap_all(sim, args->command, err));
    hs_sim_atoms_changed(sim);
    hs_box_say(deck->out, "Replicating atoms ...\n  ", box);
    hs_say(deck->out, "  %d by %d by %d MPI processor grid\n  %lld atoms\n", sim->domain.n[0], sim->domain.n[1],
           sim->domain.n[2], (long long)sim->atoms.n_all);
    return HS_OK;
}

const hs_command hs_commands_replicate[] = {
    {
        .about =
            {
                .name = "replicate",
                .syntax = {"<nx> <ny> <nz> [bbox]", 3, 3, replicate_keywords},
                .summary = "Put copies of the whole system side by side",
                .details =
                    "The box becomes nx, ny and nz times as long and is filled with copies of its atoms, which have "
                    "the velocities, groups and all else of their originals. Ids of copy k (x fastest, then y, then z) "
                    "are those of the originals plus k times the highest. Atoms that had crossed periodic faces count "
                    "where they are without images, as in LAMMPS; images start at 0. Computes and fixes that remember "
                    "places of atoms (msd, displace/atom, spring/self, move, ave/self) come after it.\n",
                .example = "replicate 2 2 1",
            },
        .run = replicate_run,
    },
    {.about = {.name = NULL}},
};
