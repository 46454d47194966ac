/** Particle arrays of one rank: structure of arrays, local atoms first, then halo atoms.
 *
 *  Only hs_atoms_permute (the sort), the migration and creation or deletion reorder or resize the arrays; each raises
 *  `generation`. Lists and views remember the generation they were made for and are void when it changed. */
#ifndef HS_CORE_ATOMS_H
#define HS_CORE_ATOMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/** Elements that every array has beyond its capacity, so that full-width vector loads at its end stay inside. */
enum { HS_ATOMS_PAD = 16 };

/** An array that belongs to atoms and travels with them: sorted, migrated, grown with them. */
typedef struct hs_atom_field {
    const char *name;  /**< borrowed: a literal, or owned by the style that added the field */
    void **array;      /**< where the owner keeps the pointer; hs_atoms updates it when the array moves */
    size_t size;       /**< bytes per atom */
    bool has_halo;     /**< also has room for halo atoms */
    bool is_force;     /**< recomputed every step: not carried along by the sort */
    bool goes_to_halo; /**< copied to halo atoms whenever the halo is made */
    int place_along;   /**< 1, 2, 3: coordinate x, y, z of a place that is remembered; 0: something else */
} hs_atom_field;

/** What atoms of a style have beside type, place and velocity. */
typedef enum {
    HS_ATOM_ATOMIC,
    HS_ATOM_SPHERE, /**< diameter, own mass, angular velocity */
    HS_ATOM_DIPOLE, /**< dipole moment, which also serves as the direction of an active particle */
    HS_N_ATOM_PARTS
} hs_atom_part;

/** An atom style: one part, or several (hybrid) in the order of the deck. Zero is `atomic`. See core/atom_style.h. */
typedef struct hs_atom_style {
    bool is_hybrid;
    int n_parts;
    hs_atom_part part[HS_N_ATOM_PARTS];
} hs_atom_style;

typedef struct hs_atoms {
    int64_t n_all; /**< atoms on all ranks */
    int n_local;   /**< atoms owned by this rank: indices [0, n_local) */
    int n_halo;    /**< copies of others' atoms and periodic images: [n_local, n_local + n_halo) */
    int n_types;
    double *mass;      /**< [n_types + 1], by type from 1; 0 = not set; mass units */
    double *x[3];      /**< positions, distance; local and halo */
    double *v[3];      /**< velocities, distance/time; local */
    double *f[3];      /**< forces, energy/distance; local and halo */
    int64_t *id;       /**< 1 .. ; unique over ranks; local */
    int32_t *type;     /**< 1 .. n_types; local and halo */
    uint32_t *mask;    /**< group bits; local */
    int32_t *image[3]; /**< box lengths to add for the unwrapped position; local */
    hs_atom_style style;
    double *radius;    /**< distance; local and halo; this and the next are NULL unless the style has spheres */
    double *rmass;     /**< mass of each atom: takes the place of mass[type] (hs_atom_mass); local */
    double *omega[3];  /**< angular velocity, 1/time; local */
    double *mu[3];     /**< dipole moment; local; this and the next are NULL unless the style has dipoles */
    double *mu_length; /**< its length, which rotations keep; local */
    uint64_t generation;

    /* owned by hs_atoms.c */
    hs_atom_field *field;
    int n_fields;
    size_t capacity_fields;
    int capacity_local, capacity_halo; /**< room for atoms, without padding */
} hs_atoms;

HS_MUST_USE hs_status hs_atoms_init(hs_atoms *atoms, hs_error *err);
void hs_atoms_fini(hs_atoms *atoms);
/** Number of types and the mass table; called once, when the box is made. */
HS_MUST_USE hs_status hs_atoms_set_types(hs_atoms *atoms, int n_types, hs_error *err);
/** An error when one rank cannot hold so many atoms, or they need more memory than the machine has. Changes nothing. */
HS_MUST_USE hs_status hs_atoms_check_room(const hs_atoms *atoms, int64_t n_local, int64_t n_halo, hs_error *err);
/** Make room for at least that many local and halo atoms in all; keeps what is there. */
HS_MUST_USE hs_status hs_atoms_reserve(hs_atoms *atoms, int64_t n_local, int64_t n_halo, hs_error *err);
/** Append a local atom at rest, in group all, image 0, a sphere of diameter and density 1, all other fields zero. Room
 *  grows by itself. */
HS_MUST_USE hs_status hs_atoms_add(hs_atoms *atoms, int64_t id, int type, const double x[3], hs_error *err);
/** Remove local atoms whose flag is nonzero (drop[n_local]), keeping the order of the rest; halo atoms are forgotten.
 *  Not collective: the caller brings n_all up to date. */
void hs_atoms_remove(hs_atoms *atoms, const unsigned char *drop);
/** Bytes of one atom's record: all its fields but forces. */
size_t hs_atoms_record_size(const hs_atoms *atoms);
/** Copy a local atom's fields into a record; append an atom from a record (there must be room). Not collective. */
void hs_atoms_pack(const hs_atoms *atoms, int i, char *record);
void hs_atoms_unpack(hs_atoms *atoms, const char *record);
/** Take out the local atoms leavers[n] (ascending): the last ones move into their places. Halo atoms are forgotten. */
void hs_atoms_take_out(hs_atoms *atoms, const int32_t *leavers, int n);
/** Two arrays of numbers for who sorts atoms. */
typedef struct hs_sort_scratch {
    int32_t *order; /**< new place -> old index */
    int32_t *key;   /**< what is sorted by */
} hs_sort_scratch;
/** Scratch for n of the atoms, local or halo, each array [n]: memory of a force array, which loses what it holds. Borrowed; good until
 *  forces are written, arrays resized or this is called again. hs_atoms_permute leaves it alone. */
hs_sort_scratch hs_atoms_sort_scratch(const hs_atoms *atoms, int n);
/** Reorder the local atoms: new atom k is old atom order[k]. Threaded; halo atoms and forces are forgotten (they are
 *  computed anew; their memory is used for the sort). */
HS_MUST_USE hs_status hs_atoms_permute(hs_atoms *atoms, const int32_t *order, hs_error *err);
/** Register an array that travels with the atoms. *array is allocated zeroed at the present capacity. The caller
 *  owns the pointer variable, which must stay in place until hs_atoms_remove_field, which frees the array.
 *  @p size must be 4 or a multiple of 8 bytes. */
HS_MUST_USE hs_status hs_atoms_add_field(hs_atoms *atoms, const char *name, void **array, size_t size, bool has_halo,
                                         hs_error *err);
/** Fields with room for halo atoms are copied to them whenever the halo is made, unless this says no: positions, which
 *  are shifted, and fields that their owner brings to the halo himself. */
void hs_atoms_keep_from_halo(hs_atoms *atoms, void **array);
/** The field of doubles remembers places of atoms, along an axis: that of a new atom begins where the atom is made. */
void hs_atoms_mark_place(hs_atoms *atoms, void **array, int axis);
void hs_atoms_remove_field(hs_atoms *atoms, void **array);
/** Largest id on this rank, 0 without atoms. */
int64_t hs_atoms_max_id(const hs_atoms *atoms);

#endif
