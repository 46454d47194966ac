"""Grammar of random decks: what script/compare-random lets LAMMPS and Halfshell both run.

random_deck(seed) is the text of one deck, a pure function of the seed; with is_alone it may have noise, and what only Halfshell has.
A deck is made in the order of a user's: system, atoms,
velocities, pairs, groups, integrator, other fixes, computes, output, runs. Each part is a function that takes a Deck and adds
lines; each family of commands is a table or a list of lines to choose from, where a new style is one more entry.

Decks are small (some hundred atoms) and short (tens of steps), so that chaos does not make a difference out of rounding. Atoms are
moved a little from their lattice at random, because what depends on exact ties (which neighbor is nearest, in which bin an atom
on its border is) is decided by rounding."""
from random_decks.deck import Deck
from random_decks.fixes import add_fixes, add_integrator
from random_decks.formulas import add_variables
from random_decks.measures import add_computes
from random_decks.output import add_averages, add_dumps, add_thermo
from random_decks.pairs import add_neighbors, add_pairs
from random_decks.runs import add_runs
from random_decks.system import add_atoms, add_groups, add_removals, add_system, add_velocities


def random_deck(seed, is_alone=False):
    deck = Deck(seed, is_alone)
    for part in (add_system, add_atoms, add_velocities, add_pairs, add_neighbors, add_removals, add_groups, add_integrator, add_fixes,
                 add_computes, add_variables, add_thermo, add_averages, add_dumps, add_runs):
        part(deck)
    return deck.text()
