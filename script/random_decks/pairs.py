"""Pair styles and neighbor lists of a random deck."""
# Style: words of pair_style after the name and words of pair_coeff after the types; (low, high, quantity) is a random number,
# "cutoff" and "inner" are those of the deck, "diameters" two of small or large spheres. Styles in MIXES know coefficients of unlike atoms from those of like ones.
EPSILON, SIGMA = (0.6, 1.2, "energy"), (0.9, 1.05, "length")
PAIRS = {
    "lj/cut": (["cutoff"], [EPSILON, SIGMA]),
    "lj/smooth": (["inner", "cutoff"], [EPSILON, SIGMA]),
    "lj/smooth/linear": (["cutoff"], [EPSILON, SIGMA]),
    "lj/sf": (["cutoff"], [EPSILON, SIGMA]),
    "lj/cubic": ([], [EPSILON, SIGMA]),
    "lj/expand": (["cutoff"], [EPSILON, SIGMA, (0, 0.1, "length")]),
    "morse": (["cutoff"], [EPSILON, (4, 7, "1/length"), (1, 1.2, "length")]),
    "yukawa": ([(0.5, 2, "1/length"), "cutoff"], [(5, 20, "energy length")]),
    "born": (["cutoff"], [EPSILON, (0.1, 0.3, "length"), (1, 1.01, "length"), (0.1, 1, "energy length^6"),
                          (0.1, 0.5, "energy length^8")]),
    "buck": (["cutoff"], [(100, 200, "energy"), (0.2, 0.3, "length"), (0.1, 1, "energy length^6")]),
    "gauss": (["cutoff"], [(-3, 3, "energy"), (0.5, 2, "1/area")]),
    "soft": ([(1.3, 1.5, "length")], [(5, 30, "energy")]),
    "zero": (["cutoff"], []),
    "lj96/cut": (["cutoff"], [EPSILON, SIGMA]),
    "lj/class2": (["cutoff"], [EPSILON, (1, 1.1, "length")]),
    "mie/cut": (["cutoff"], [EPSILON, SIGMA, (9, 14), (5, 7)]),
    "nm/cut": (["cutoff"], [EPSILON, (1, 1.2, "length"), (9, 14), (5, 7)]),
    "gauss/cut": (["cutoff"], [(-1, 1, "energy length"), (1, 1.5, "length"), (0.1, 0.3, "length")]),
    "cosine/squared": (["cutoff"], [EPSILON, (1, 1.1, "length")]),
    "colloid": (["cutoff"], [(5, 100, "energy"), (0.5, 0.8, "length"), "diameters"]),
}
# What lmp has not; without cutoffs of their own.
OWN_PAIRS = {
    "harmonic/cut": ([], [(20, 100, "stiffness"), (1, 1.3, "length")]),
    "harmonic/repulsion": ([], [(20, 100, "energy"), (1, 1.3, "length")]),
    "harmonic/sphere": ([], [(20, 100, "energy")]),
    "wca": ([], [EPSILON, SIGMA]),
}
MIXES = ["lj/cut", "lj/smooth", "lj/expand", "lj/cubic", "lj/smooth/linear", "lj/sf", "lj96/cut", "lj/class2", "mie/cut"]
WITH_CUTOFF = ["lj/cut", "morse", "yukawa", "born", "buck", "gauss", "lj/smooth/linear", "lj/expand", "lj/sf", "soft", "zero", "lj96/cut", "lj/class2",
               "mie/cut", "nm/cut", "gauss/cut", "cosine/squared", "colloid"]  # pair_coeff takes one
WITH_SHIFT = ["lj/cut", "morse", "yukawa", "born", "buck", "gauss", "lj/smooth", "lj/expand", "lj/cubic", "lj/smooth/linear", "lj/sf", "lj96/cut", "lj/class2",
              "mie/cut", "nm/cut", "gauss/cut", "colloid"]
PAIR_WEIGHTS = ["lj/cut"] * 5 + list(PAIRS) + ["colloid"]
PARTNERS = ["morse", "yukawa", "gauss", "soft", "born", "buck", "gauss/cut", "lj96/cut", "mie/cut", "nm/cut"]  # of lj/cut in hybrids


def words_of(deck, entries):
    """Words of a table entry: numbers drawn, cutoffs filled in."""
    lengths = {"cutoff": deck.cutoff, "inner": deck.cutoff - 0.4}
    words = []
    for entry in entries:
        if entry == "diameters":
            size = deck.number(0.2, 0.5, "length")
            words.append(deck.pick("0 0", f"{size} {size}"))
        else:
            words.append(deck.value(lengths[entry], "length") if entry in lengths else deck.number(*entry))
    return " ".join(words)


def add_pairs(deck):
    deck.cutoff = round(deck.random.uniform(1.75, 2.6), 2)
    deck.pair = deck.random.choice(PAIR_WEIGHTS + ["hybrid", "hybrid/overlay"] * 2)
    if deck.is_alone and deck.chance(0.1):
        add_own_pairs(deck)
        return
    if deck.chance(0.06):
        add_table(deck)
        return
    if deck.pair.startswith("hybrid"):
        add_hybrid(deck)
        return
    deck.add(f"pair_style {deck.pair} {words_of(deck, PAIRS[deck.pair][0])}".rstrip())
    if deck.chance(0.5) and deck.pair in WITH_SHIFT:
        mix = deck.pick("", " mix arithmetic", " mix geometric", " mix sixthpower") if deck.pair in MIXES else ""
        tail = " tail yes" if deck.pair == "lj/cut" and deck.dimension == 3 and deck.is_periodic() and deck.chance(0.5) else ""
        deck.add(f"pair_modify shift {'no' if tail else deck.pick('yes', 'no')}{mix}{tail}")
    kinds = range(1, deck.n_types + 1)
    if deck.pair in MIXES and deck.chance(0.6):
        pairs = [(kind, kind) for kind in kinds]
    elif deck.chance(0.5):
        pairs = [(one, two) for one in kinds for two in kinds if one <= two]
    else:
        pairs = [("*", "*")] + ([(deck.pick("1*2", "*", "1"), deck.pick("2", "2*", "2*2"))] if deck.n_types > 1 and deck.chance(0.5) else [])
    for one, two in pairs:
        own_cutoff = " " + deck.number(1.75, 2.5, "length") if deck.pair in WITH_CUTOFF and deck.chance(0.2) else ""
        if deck.pair == "lj/smooth" and deck.chance(0.2):
            own_cutoff = f" {deck.number(1.3, 1.6, 'length')} {deck.number(1.75, 2.5, 'length')}"
        deck.add(f"pair_coeff {one} {two} {words_of(deck, PAIRS[deck.pair][1])}{own_cutoff}")


def add_own_pairs(deck):
    """Pair styles that lmp has not."""
    deck.pair = deck.random.choice([style for style in OWN_PAIRS if style != "harmonic/sphere" or deck.is_sphere()])
    deck.add(f"pair_style {deck.pair}", f"pair_coeff * * {words_of(deck, OWN_PAIRS[deck.pair][1])}")
    if deck.n_types > 1 and deck.chance(0.5):
        deck.add(f"pair_coeff 2 2 {words_of(deck, OWN_PAIRS[deck.pair][1])}")


def add_table(deck):
    """A potential that is written to a table, and read from there."""
    cutoff = deck.value(deck.cutoff, "length")
    style = deck.pick("lj/cut", "morse", "gauss")
    near, far = deck.value(0.5, "length"), deck.value(deck.cutoff - 0.01, "length")
    deck.add(f"pair_style {style} {cutoff}", f"pair_coeff * * {words_of(deck, PAIRS[style][1])}",
             f"pair_write 1 1 {deck.pick(300, 1000)} {deck.pick('r', 'rsq')} {near} {far} pair.table ONE",
             f"pair_style table {deck.pick('lookup', 'linear', 'spline')} {deck.pick(500, 2000)}",
             f"pair_coeff * * pair.table ONE{deck.pick('', ' ' + deck.value(deck.cutoff - 0.1, 'length'))}")
    deck.pair = "table"


def add_hybrid(deck):
    """lj/cut and another style or two: added to each other, or the other one for unlike atoms only."""
    partners = deck.random.sample(PARTNERS, deck.pick(1, 1, 2))
    if deck.chance(0.15):
        partners[0] = "lj/cut"
    styles = " ".join(f"{partner} {words_of(deck, PAIRS[partner][0])}" for partner in partners)
    first = "lj/cut 1" if "lj/cut" in partners else "lj/cut"
    names = ["lj/cut 2" if partner == "lj/cut" else partner for partner in partners]
    if deck.pair == "hybrid" and deck.n_types == 1:
        deck.add(f"pair_style hybrid lj/cut {words_of(deck, ['cutoff'])}",
                 f"pair_coeff * * lj/cut {deck.value(1.0, 'energy')} {deck.value(1.0, 'length')}")
        deck.pair = "hybrid without partner"
        return
    deck.add(f"pair_style {deck.pair} lj/cut {words_of(deck, ['cutoff'])} {styles}",
             f"pair_coeff * * {first} {deck.value(1.0, 'energy')} {deck.value(1.0, 'length')}")
    unlike = [(1, 2), (1, 3), (2, 2), (2, 3)] if deck.n_types == 3 else [(1, 2), (2, 2)]
    for name, partner, pair in zip(names, partners, deck.random.sample(unlike, len(unlike))):
        coefficients = words_of(deck, PAIRS[partner][1])
        kinds = "* *" if deck.pair == "hybrid/overlay" and (deck.n_types == 1 or deck.chance(0.6)) else f"{pair[0]} {pair[1]}"
        deck.add(f"pair_coeff {kinds} {name} {coefficients}")
    if deck.pair == "hybrid" and deck.n_types > 1 and deck.chance(0.2):
        deck.add("pair_coeff 1 2 none")
    if deck.chance(0.3):
        deck.add(f"pair_modify pair {first} shift yes" if first == "lj/cut" else "pair_modify shift yes")


def add_neighbors(deck):
    deck.add(f"neighbor {deck.number(0.2, 0.6, 'length')} {deck.pick('bin', 'bin', 'bin', 'nsq')}",
             deck.pick("neigh_modify every 1 delay 0 check yes", "neigh_modify every 5 delay 0 check no",
                       "neigh_modify every 2 delay 4 check yes", "neigh_modify delay 10", "", "neigh_modify once yes", "neigh_modify delay 3 every 3 one 3000 page 100000",
                       "neigh_modify delay 0"),
             f"timestep {deck.value(deck.pick(0.005, 0.002, 0.001), 'time')}")
