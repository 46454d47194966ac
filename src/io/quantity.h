/** What a column of a table means: its label and unit, from its name and from the deck that made it. */
#ifndef HS_IO_QUANTITY_H
#define HS_IO_QUANTITY_H

#include "base/text.h"
#include "core/units.h"

/** A compute, fix or variable that a deck defines. */
typedef struct hs_deck_name {
    char kind;   /**< 'c', 'f' or 'v' */
    char *id;    /**< owned */
    char *style; /**< owned */
} hs_deck_name;

/** What a deck says about the numbers its run writes. Zeroed: nothing is known. */
typedef struct hs_deck_facts {
    const hs_units *units; /**< NULL: not known */
    double dt;             /**< timestep, time; 0: not known */
    int dimension;
    bool is_per_atom; /**< thermo energies are divided by the number of atoms */
    hs_deck_name *name;
    int n_names; /**< owned */
} hs_deck_facts;

/** Learn from a deck, or from a log that echoes one: units, timestep, dimension, thermo_modify norm, and what c_, f_,
 *  v_ names are. Lines that are no such commands are passed over. */
HS_MUST_USE hs_status hs_deck_facts_learn(hs_deck_facts *facts, const char *text, hs_error *err);
/** The same from a file. */
HS_MUST_USE hs_status hs_deck_facts_read(hs_deck_facts *facts, const char *path, hs_error *err);
/** Units named on the command line win over the deck's. */
HS_MUST_USE hs_status hs_deck_facts_set_units(hs_deck_facts *facts, const char *name, hs_error *err);
void hs_deck_facts_fini(hs_deck_facts *facts);

/** Label of an axis: quantity and, when the unit system is known, its unit: "temperature (ε/k)". Names that are not
 *  known are their own labels. The text is replaced. */
HS_MUST_USE hs_status hs_quantity_label(hs_text *label, const char *column, const hs_deck_facts *facts, hs_error *err);

#endif
