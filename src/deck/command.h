/** The table of deck commands. A file of src/deck/cmd_*.c holds one family of commands and exports its array; the build
 *  collects the arrays. */
#ifndef HS_DECK_COMMAND_H
#define HS_DECK_COMMAND_H

#include "deck/deck.h"
#include "sim/sim.h"

typedef struct hs_command {
    hs_description about; /**< about.name is the command's word; about.syntax the words after it */
    /** Carry it out. args exclude the command's name; errors get the deck's place by the caller. */
    HS_MUST_USE hs_status (*run)(hs_deck *deck, const hs_args *args, hs_error *err);
    /** Extra checks of the first pass beyond the syntax (style names, sub-words); words may hold unexpanded `$`.
     *  NULL when the syntax says everything. */
    HS_MUST_USE hs_status (*check)(const hs_args *args, bool has_variables, hs_error *err);
} hs_command;

/** All families, ended by NULL; each is an array ended by an entry without a name. Made by the build:
 *  src/deck/cmd_NAME.c must define `const hs_command hs_commands_NAME[]`. */
extern const hs_command *const hs_command_families[];

/** The command of that name, or NULL. */
const hs_command *hs_command_find(const char *name);
/** Refuse a name that is no command: as one of LAMMPS's that is not supported, or with the nearest that is. */
HS_MUST_USE hs_status hs_command_refuse(const char *name, hs_error *err);

#endif
