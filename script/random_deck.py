"""Grammar of random decks: what script/compare-random lets LAMMPS and Halfshell both run.

random_deck(seed) is the text of one deck, a pure function of the seed. A deck is made in the order of a user's: system, atoms,
velocities, pairs, groups, integrator, other fixes, computes, output, runs. Each part is a function that takes a Deck and adds
lines; each family of commands is a table or a list of lines to choose from, where a new style is one more entry.

Decks are small (some hundred atoms) and short (tens of steps), so that chaos does not make a difference out of rounding. Atoms are
moved a little from their lattice at random, because what depends on exact ties (which neighbor is nearest, in which bin an atom
on its border is) is decided by rounding."""
import random
import re

PRESSURE_OF = {"lj": 1.0, "real": 68568.415, "metal": 1602176.6}  # units of pressure in an energy per volume
BOLTZMANN = {"lj": 1.0, "real": 0.0019872067, "metal": 8.617343e-5}
ARGON = {"lj": (1.0, 1.0, 1.0, 1.0), "real": (0.238, 3.405, 39.948, 2156.0), "metal": (0.01032, 3.405, 39.948, 2.156)}


def scales_of(units):
    """Natural sizes of quantities in units of a deck: those of a Lennard-Jones atom like argon."""
    energy, length, mass, time = ARGON[units]
    return {"": 1.0, "energy": energy, "length": length, "mass": mass, "time": time, "temperature": energy / BOLTZMANN[units],
            "pressure": PRESSURE_OF[units] * energy / length**3, "velocity": length / time, "force": energy / length,
            "stiffness": energy / length**2, "cubic stiffness": energy / length**3, "rate": 1 / time, "power": energy / time,
            "friction": energy * time / length**2, "acceleration": length / time**2, "1/length": 1 / length,
            "1/area": 1 / length**2, "energy length": energy * length, "energy length^6": energy * length**6,
            "energy length^8": energy * length**8, "density": mass / length**3}


class Deck:
    """A deck that is being made: its lines, the random choices, and what later lines need to know of earlier ones."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.lines = []
        self.groups = ["all"]
        self.columns = []  # of thermo output
        self.n_names = 0

    def add(self, *lines):
        self.lines += [line for line in lines if line]

    def chance(self, probability):
        return self.random.random() < probability

    def pick(self, *choices):
        return self.random.choice(choices)

    def number(self, low, high, quantity="", n_digits=3):
        """A number from low to high, in natural sizes of the quantity, in the deck's units."""
        return f"{self.random.uniform(low, high) * self.scales[quantity]:.{n_digits}g}"

    def value(self, number, quantity=""):
        return f"{number * self.scales[quantity]:.6g}"

    def seed(self):
        return self.random.randint(1, 900000)

    def group(self):
        return self.random.choice(self.groups)

    def name(self, prefix):
        """A name that no other compute, fix, variable or group of the deck has."""
        self.n_names += 1
        return f"{prefix}{self.n_names}"

    def is_periodic(self):
        return self.boundary == ["p"] * 3

    def may_reset(self):
        """Whether nothing counts steps, so that the number of the step may be changed."""
        return not any(re.match(r"dump |fix \S+ \S+ (ave/|deform|vector)", line) for line in self.lines)

    def keeps_places(self):
        """Whether a style remembers where atoms were, so that LAMMPS cannot replicate them."""
        return any(re.match(r"fix \S+ \S+ spring/self|compute \S+ \S+ (msd|vacf|displace/atom)", line) for line in self.lines)

    def text(self):
        return "\n".join(self.lines) + "\n"


def random_deck(seed):
    deck = Deck(seed)
    for part in (add_system, add_atoms, add_velocities, add_pairs, add_neighbors, add_groups, add_integrator, add_fixes,
                 add_computes, add_variables, add_thermo, add_averages, add_dumps, add_runs):
        part(deck)
    return deck.text()


# ---- the system -------------------------------------------------------------------------------------------------------------

LATTICES = {3: {"fcc": 4, "bcc": 5, "sc": 7, "diamond": 4}, 2: {"sq": 12, "hex": 9, "sq2": 9}}  # name: cells along an edge
ORIGINS = {3: ["", "", " origin 0.1 0.1 0.1", " origin 0.25 0.5 0"], 2: ["", " origin 0.1 0.2 0"]}
BASIS = {"fcc": 4, "bcc": 2, "sc": 1, "diamond": 8, "sq": 1, "hex": 2, "sq2": 2}


def add_system(deck):
    """Units, dimension, faces, kind of atoms, lattice and box."""
    deck.units = deck.pick("lj", "lj", "lj", "real", "metal")
    deck.scales = scales_of(deck.units)
    deck.dimension = deck.pick(3, 3, 3, 2)
    deck.is_tilted = deck.chance(0.25)
    deck.boundary = ["p"] * 3 if deck.is_tilted or deck.chance(0.5) else [deck.pick("p", "p", "f", "s", "m") for _ in range(3)]
    if deck.dimension == 2:
        deck.boundary[2] = "p"
    deck.atom_style = deck.pick(*["atomic"] * 6, "sphere", "dipole", "hybrid dipole sphere")
    deck.add(f"units {deck.units}", f"dimension {deck.dimension}" if deck.dimension == 2 else "",
             "boundary " + " ".join(deck.boundary), f"atom_style {deck.atom_style}",
             f"atom_modify map {deck.pick('array', 'hash', 'yes')}{deck.pick('', ' sort 0 0')}")
    add_lattice(deck)
    deck.cells = [LATTICES[deck.dimension][deck.lattice] + deck.random.randint(0, 2) for _ in range(3)]
    nx, ny, nz = deck.cells
    faces = f"0 {nx} 0 {ny} " + ("-0.25 0.25" if deck.dimension == 2 else f"0 {nz}")
    if deck.is_tilted:
        tilts = [deck.number(-1.5, 1.5) if axis == 0 or deck.dimension == 3 else "0" for axis in range(3)]
        deck.add(f"region box prism {faces} {' '.join(tilts)}")
    else:
        deck.add(f"region box block {faces}")
    deck.n_types = deck.pick(1, 1, 2, 3)
    deck.add(f"create_box {deck.n_types} box")


def add_lattice(deck):
    """In lj units a lattice has a density, in others a constant."""
    deck.lattice = deck.random.choice(list(LATTICES[deck.dimension]))
    density = deck.random.uniform(0.6, 0.95) * (0.7 if deck.lattice == "diamond" else 1)
    per_area = 2 / 3**0.5 if deck.lattice == "hex" else 1.0
    constant = (BASIS[deck.lattice] / (per_area if deck.lattice == "hex" else 1) / density) ** (1 / deck.dimension)
    if deck.lattice == "hex":
        constant = (per_area / density) ** 0.5
    size = f"{density:.3g}" if deck.units == "lj" else f"{constant * deck.scales['length']:.4g}"
    deck.spacing = constant  # natural lengths
    deck.add(f"lattice {deck.lattice} {size}{deck.pick(*ORIGINS[deck.dimension])}")


def region_words(deck):
    """Words of a region somewhere in the box, in lattice spacings."""
    nx, ny, nz = deck.cells
    middle = f"{nx / 2} {ny / 2}"
    z_range = "INF INF" if deck.dimension == 2 else f"0.7 {nz - 0.8:.3g}"
    z_middle = 0 if deck.dimension == 2 else nz / 2
    radius = f"{min(nx, ny) / 2 - 0.6:.3g}"
    choices = [f"block 0.6 {nx - 0.7:.3g} 0.6 {ny - 0.7:.3g} {z_range}", f"cylinder z {middle} {radius} {z_range}",
               f"sphere {middle} {z_middle} {min(deck.cells) / 2 - 0.6 if deck.dimension == 3 else min(nx, ny) / 2 - 0.6:.3g}"]
    return deck.random.choice(choices)


def more_regions(deck):
    """A region of any kind, with its name: for groups, computes and chunks, not for walls."""
    nx, ny, nz = deck.cells
    name = deck.name("r")
    side = deck.pick("", "", " side out")
    low_z, high_z = ("-0.25", "0.25") if deck.dimension == 2 else ("0.31", f"{nz - 0.4:.3g}")
    z_middle = 0 if deck.dimension == 2 else nz / 2
    kind = deck.pick("plane", "prism", "half", "union", "intersect", "cylinder", "words")
    if kind == "plane":
        deck.add(f"region {name} plane {nx / 2} {ny / 2} {z_middle} {deck.number(-1, 1)} {deck.number(0.2, 1)} 0{side}")
    elif kind == "prism":
        deck.add(f"region {name} prism 0.3 {nx - 0.9:.3g} 0.4 {ny - 0.3:.3g} {low_z} {high_z} {deck.number(-1, 1)} 0 0{side}")
    elif kind == "half":
        deck.add(f"region {name} block INF {nx * 0.51:.4g} INF {ny * 0.73:.4g} INF INF{side}")
    elif kind == "cylinder" and deck.dimension == 3:
        deck.add(f"region {name} cylinder {deck.pick('x', 'y')} {ny / 2} {nz / 2} {deck.number(1, 2)} INF INF{side}")
    elif kind in ("union", "intersect"):
        one, two = deck.name("r"), deck.name("r")
        deck.add(f"region {one} {region_words(deck)}", f"region {two} block {nx * 0.36:.4g} INF INF INF INF INF",
                 f"region {name} {kind} 2 {one} {two}{side}")
    else:
        deck.add(f"region {name} {region_words(deck)}{side}")
    return name


def add_atoms(deck):
    """Atoms on the lattice, in all of the box or away from its faces, their types, masses and more; then a little disorder."""
    deck.is_inner = not deck.is_periodic() or deck.chance(0.3)
    if deck.is_inner:
        deck.add(f"region in {region_words(deck)}", "create_atoms 1 region in")
    else:
        deck.add("create_atoms 1 box")
    if deck.n_types >= 2:
        deck.add(*deck.pick(["set group all type/fraction 2 0.3 4711"], ["set group all type/ratio 2 0.4 991"],
                            [f"region half block INF {deck.cells[0] * 0.51:.4g} INF INF INF INF", "set region half type 2"]))
    if deck.n_types == 3:
        deck.add("set type 1 type/fraction 3 0.25 77")
    if "sphere" in deck.atom_style:
        deck.add(f"set group all diameter {deck.number(0.9, 1.1, 'length')}",
                 f"set group all density {deck.number(1, 3, 'density')}")
    else:
        deck.add(*(f"mass {kind} {deck.value(deck.pick(1.0, 1.0, 2.0, 0.5), 'mass')}" for kind in range(1, deck.n_types + 1)))
    if "dipole" in deck.atom_style:
        deck.add(f"set group all dipole/random {deck.seed()} 1.0")
    reach = deck.value(0.03, "length")
    deck.add(f"displace_atoms all random {reach} {reach} {reach if deck.dimension == 3 else 0} {deck.seed()} units box")


def add_velocities(deck):
    words = deck.pick("", " loop geom", " dist gaussian", " mom no", " rot yes", " loop geom dist gaussian rot yes",
                      " dist uniform", " loop local")
    if deck.is_tilted:  # where wrapping displaced atoms changes the last bit of their places, from which loop geom draws
        words = words.replace(" loop geom", "")
    deck.add(f"velocity all create {deck.number(0.3, 2, 'temperature')} {deck.seed()}{words}")
    v = deck.value(0.3, "velocity")
    more = [f"velocity all ramp vx 0 {v} y 0 {deck.cells[1]} units box", f"velocity all set {v} NULL 0.0 sum yes units box",
            f"velocity all scale {deck.number(0.5, 1.5, 'temperature')}", "velocity all zero linear", "velocity all zero angular"]
    if deck.chance(0.4):
        deck.add(deck.random.choice(more))


# ---- pairs ------------------------------------------------------------------------------------------------------------------

# Style: words of pair_style after the name and words of pair_coeff after the types; (low, high, quantity) is a random number,
# "cutoff" and "inner" are those of the deck. Styles in MIXES know coefficients of unlike atoms from those of like ones.
EPSILON, SIGMA = (0.6, 1.2, "energy"), (0.9, 1.05, "length")
PAIRS = {
    "lj/cut": (["cutoff"], [EPSILON, SIGMA]),
    "lj/smooth": (["inner", "cutoff"], [EPSILON, SIGMA]),
    "lj/smooth/linear": (["cutoff"], [EPSILON, SIGMA]),
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
}
MIXES = ["lj/cut", "lj/smooth", "lj/expand", "lj/cubic", "lj/smooth/linear"]
WITH_CUTOFF = ["lj/cut", "morse", "yukawa", "born", "buck", "gauss", "lj/smooth/linear", "lj/expand"]  # pair_coeff takes one
PAIR_WEIGHTS = ["lj/cut"] * 4 + list(PAIRS)
PARTNERS = ["morse", "yukawa", "gauss", "soft"]  # of lj/cut in hybrids


def words_of(deck, entries):
    """Words of a table entry: numbers drawn, cutoffs filled in."""
    lengths = {"cutoff": deck.cutoff, "inner": deck.cutoff - 0.4}
    return " ".join(deck.value(lengths[entry], "length") if entry in lengths else deck.number(*entry) for entry in entries)


def add_pairs(deck):
    deck.cutoff = round(deck.random.uniform(1.75, 2.6), 2)
    deck.pair = deck.random.choice(PAIR_WEIGHTS + ["hybrid", "hybrid/overlay"])
    if deck.pair.startswith("hybrid"):
        add_hybrid(deck)
        return
    deck.add(f"pair_style {deck.pair} {words_of(deck, PAIRS[deck.pair][0])}")
    if deck.chance(0.5) and deck.pair not in ("zero", "soft"):
        mix = deck.pick("", " mix arithmetic", " mix geometric", " mix sixthpower") if deck.pair in MIXES else ""
        tail = " tail yes" if deck.pair == "lj/cut" and deck.dimension == 3 and deck.is_periodic() and deck.chance(0.5) else ""
        deck.add(f"pair_modify shift {'no' if tail else deck.pick('yes', 'no')}{mix}{tail}")
    kinds = range(1, deck.n_types + 1)
    if deck.pair in MIXES and deck.chance(0.6):
        pairs = [(kind, kind) for kind in kinds]
    elif deck.chance(0.5):
        pairs = [(one, two) for one in kinds for two in kinds if one <= two]
    else:
        pairs = [("*", "*")]
    for one, two in pairs:
        own_cutoff = " " + deck.number(1.75, 2.5, "length") if deck.pair in WITH_CUTOFF and deck.chance(0.2) else ""
        deck.add(f"pair_coeff {one} {two} {words_of(deck, PAIRS[deck.pair][1])}{own_cutoff}")


def add_hybrid(deck):
    """lj/cut and another style: added to each other, or the other one for unlike atoms only."""
    partner = deck.random.choice(PARTNERS)
    deck.add(f"pair_style {deck.pair} lj/cut {words_of(deck, ['cutoff'])} {partner} {words_of(deck, PAIRS[partner][0])}",
             f"pair_coeff * * lj/cut {deck.value(1.0, 'energy')} {deck.value(1.0, 'length')}")
    coefficients = words_of(deck, PAIRS[partner][1])
    if deck.pair == "hybrid/overlay":
        deck.add(f"pair_coeff * * {partner} {coefficients}")
    elif deck.n_types > 1:
        deck.add(f"pair_coeff 1 2 {partner} {coefficients}")
    else:
        deck.pair = "hybrid without partner"
        deck.lines[-2] = f"pair_style hybrid lj/cut {words_of(deck, ['cutoff'])}"


def add_neighbors(deck):
    deck.add(f"neighbor {deck.number(0.2, 0.6, 'length')} bin",
             deck.pick("neigh_modify every 1 delay 0 check yes", "neigh_modify every 5 delay 0 check no",
                       "neigh_modify every 2 delay 4 check yes", "neigh_modify delay 10", ""),
             f"timestep {deck.value(deck.pick(0.005, 0.002, 0.001), 'time')}")


# ---- groups -----------------------------------------------------------------------------------------------------------------

def add_groups(deck):
    """Groups g1, ... by type, id, region and variable, and of other groups; sometimes pairs within one are left out."""
    n_groups = deck.pick(0, 1, 2, 3)
    for _ in range(n_groups):
        name = deck.name("g")
        kinds = ["id 1:100", "id 1:200:3 250 251", "id <= 150", "region", "variable"]
        kinds += ["type 2", "type <> 1 2"] if deck.n_types >= 2 else []
        kinds += [f"subtract all {deck.groups[-1]}", f"union {deck.groups[-1]} {deck.groups[1]}",
                  f"intersect all {deck.groups[-1]}"] if len(deck.groups) > 1 else []
        kind = deck.random.choice(kinds)
        if kind == "region":
            kind = f"region {more_regions(deck)}"
        elif kind == "variable":
            formula = deck.pick("vx>0", "(x<xcm(all,x))&&(type==1)", "id%3==1", f"gmask({deck.groups[-1]})==0")
            kind = f"variable {name}"
            deck.add(f'variable {name} atom "{formula}"')
        deck.add(f"group {name} {kind}")
        deck.groups.append(name)
    if len(deck.groups) > 1 and deck.chance(0.15):
        deck.add(deck.pick(f"neigh_modify exclude group {deck.groups[1]} {deck.groups[1]}",
                           f"neigh_modify exclude group all {deck.groups[1]}", "neigh_modify exclude type 1 1"))


# ---- fixes ------------------------------------------------------------------------------------------------------------------

def add_integrator(deck):
    """One of the fixes that move all atoms; box changes only along periodic axes."""
    choices = ["nve", "nve", "nve", "nvt", "nve/limit"]
    box_may_change = all(face == "p" for face in deck.boundary[:deck.dimension])
    if box_may_change:
        choices += ["npt", "nph"]
    if deck.is_tilted:
        choices += ["sllod"]
    deck.integrator = deck.random.choice(choices)
    heat_bath = f"temp {deck.number(0.5, 1.5, 'temperature')} {deck.number(0.5, 1.5, 'temperature')} {deck.number(0.3, 1, 'time')}"
    if deck.integrator == "nve":
        deck.add("fix int all nve")
    elif deck.integrator == "nve/limit":
        deck.add(f"fix int all nve/limit {deck.value(0.05, 'length')}")
    elif deck.integrator == "nvt":
        deck.add(f"fix int all nvt {heat_bath}{deck.pick('', ' tchain 1', ' tloop 2', ' drag 0.5', ' tchain 4 mtk no')}")
    elif deck.integrator == "sllod":
        deck.add(f"fix int all nvt/sllod {heat_bath}", f"fix shear all deform 1 xy erate {deck.number(0.05, 0.2, 'rate')} remap v")
    else:
        deck.add(f"fix int all {deck.integrator} {heat_bath + ' ' if deck.integrator == 'npt' else ''}{barostat(deck)}")


def barostat(deck):
    target = f"{deck.value(1.0, 'pressure')} {deck.number(0.5, 3, 'pressure')} {deck.value(2.0, 'time')}"
    choices = [f"iso {target}", f"aniso {target}", f"x {target}", f"x {target} y {target} couple xy"]
    if deck.is_tilted:
        choices += [f"tri {target}", f"xy 0 0 {deck.value(2.0, 'time')}", f"x {target} scalexy no"]
    more = deck.pick("", "", " drag 0.2", " pchain 1", " nreset 10", " mtk no", " ploop 2", " dilate all")
    return deck.random.choice(choices) + more


def fix_choices(deck):
    """Lines of fixes beside the integrator, without ID and group; {axes} of the plane only in two dimensions."""
    n, plane = deck.number, deck.dimension == 2
    steps = deck.pick(1, 2, 5)
    choices = [
        f"addforce {n(-1, 1, 'force')} 0 {0 if plane else n(-1, 1, 'force')}", "addforce v_push 0 0",
        f"setforce {n(-0.5, 0.5, 'force')} NULL 0", "setforce 0 0 0", f"aveforce NULL {n(-1, 1, 'force')} NULL",
        f"viscous {n(0.2, 1, 'friction')}", f"spring/self {n(1, 10, 'stiffness')}{deck.pick('', ' xy', ' x')}",
        f"temp/rescale {steps} {n(0.8, 1.1, 'temperature')} {n(0.8, 1.1, 'temperature')} {n(0.01, 0.03, 'temperature')} {n(0.3, 1)}",
        f"temp/berendsen {n(0.8, 1.1, 'temperature')} {n(0.5, 1.1, 'temperature')} {n(0.1, 1, 'time')}",
        f"momentum {steps} linear 1 1 {0 if plane else 1}{deck.pick('', ' angular', ' rescale')}",
        f"gravity {n(0.2, 1, 'acceleration')} vector 1 0.5 0", f"gravity {n(0.2, 1, 'acceleration')} chute 24.0",
        f"indent {n(5, 20, 'cubic stiffness')} sphere {n(0, 3, 'length')} {n(0, 3, 'length')} 0 {n(1, 2, 'length')} units box",
        f"indent {n(5, 20, 'cubic stiffness')} plane x {deck.pick('lo', 'hi')} {n(0.5, 2)}".replace("lo ", "").replace("hi ", "")
        + f" {deck.pick('lo', 'hi')}",
        f"indent {n(2, 8, 'cubic stiffness')} cylinder z 2 2 1.0 {deck.pick('', 'side in')}".strip(),
        f"heat {steps} {n(0.05, 0.2, 'power')}", f"ehex {steps} {n(0.05, 0.2, 'power')}",
        "recenter INIT INIT " + ("NULL" if plane else "INIT"), "lineforce 1 0.5 0", "planeforce 0 1 0.3",
        f"thermal/conductivity {steps} x 4",
    ]
    if plane:
        choices += ["enforce2d"] * 2
    if deck.is_inner:
        choices.append(f"wall/region in {deck.pick('lj93', 'lj126', 'harmonic')} {n(0.5, 1, 'energy')} "
                       f"{n(0.2, 0.3, 'length')} {n(0.4, 0.5, 'length')}")
    if deck.pair == "lj/cut":
        choices.append(f"adapt {steps} pair lj/cut epsilon 1 1 v_grow")
    if deck.boundary[0] != "p":
        choices += 2 * wall_choices(deck)
    if deck.boundary[0] == "p" and deck.integrator not in ("npt", "nph", "sllod") and deck.chance(0.7):
        choices += 2 * deform_choices(deck, steps)
    if deck.is_periodic() and deck.dimension == 3 and deck.integrator == "nve" and not deck.is_tilted:
        choices.append(f"press/berendsen iso {deck.value(1, 'pressure')} {deck.value(1, 'pressure')} {deck.value(2, 'time')} "
                       f"modulus {deck.value(50, 'pressure')}")
    return choices


def wall_choices(deck):
    """Walls at the faces in x, which are not periodic."""
    coefficients = f"EDGE {deck.number(0.5, 1, 'energy')} {deck.number(0.5, 1, 'length')} {deck.value(2.5, 'length')}"
    return ["wall/reflect xlo EDGE xhi EDGE", f"wall/lj93 xlo {coefficients}", f"wall/lj126 xlo {coefficients} xhi {coefficients}",
            f"wall/lj1043 xhi {coefficients}",
            f"wall/harmonic xlo EDGE {deck.number(20, 100, 'stiffness')} 1.0 {deck.value(1, 'length')}",
            f"wall/lj126 xlo {deck.number(-1, 0)} {coefficients[5:]} units lattice"]


def deform_choices(deck, steps):
    length = deck.cells[0]
    styles = [f"x erate {deck.number(-0.1, 0.1, 'rate')}", f"x vel {deck.value(0.2, 'velocity')}", "x scale 1.05",
              f"x final 0 {length * 1.03:.4g}", f"x trate {deck.number(0.02, 0.1, 'rate')}",
              f"x wiggle {deck.value(0.2)} {deck.value(1, 'time')}", "x delta -0.1 0.2"]
    if deck.boundary[1] == "p":
        styles += [f"x erate {deck.number(0.02, 0.1, 'rate')} y volume", "x scale 1.02 y scale 0.97"]
    if deck.is_tilted:
        styles += 3 * [f"xy erate {deck.number(0.05, 0.3, 'rate')}", "xy delta 0.3", "xy final 0.1", "xy wiggle 0.2 "
                       + deck.value(1, "time")]
    return [f"deform {steps} {style} remap {deck.pick('x', 'x', 'v', 'none')}" for style in styles]


WHOLE_GROUP = ("deform", "enforce2d", "thermal", "press", "heat", "ehex")  # fixes that are given group all here
WITH_ENERGY = ("addforce", "spring", "gravity", "indent", "wall/lj", "wall/har")  # fix_modify energy yes


def add_fixes(deck):
    deck.add(f"variable push equal {deck.value(0.3, 'force')}*step/10", f"variable grow equal {deck.value(1, 'energy')}*(1+step/500)")
    n_fixes = deck.pick(0, 0, 1, 1, 2, 3)
    used = set()
    for _ in range(n_fixes):
        words = deck.random.choice(fix_choices(deck))
        style = words.split()[0]
        family = style.replace("press/berendsen", "deform")  # of which one may change the box
        if family in used:
            continue
        used.add(family)
        name = deck.name("e")
        deck.add(f"fix {name} {'all' if style.startswith(WHOLE_GROUP) else deck.group()} {words}")
        is_periodic_gravity = style == "gravity" and "p" in deck.boundary  # LAMMPS's energy is of places in the box then
        if style.startswith(WITH_ENERGY) and "v_" not in words and not is_periodic_gravity and deck.chance(0.5):
            deck.add(f"fix_modify {name} energy yes")
        if style.startswith(WITH_ENERGY) and style != "gravity" and "v_" not in words:
            deck.columns.append(f"f_{name}" if deck.chance(0.5) or style == "spring/self" else f"f_{name}{'[1]'}")


# ---- computes and variables ---------------------------------------------------------------------------------------------------

# Computes with numbers of all of a group: words after the style, and the columns that they give.
GLOBAL_COMPUTES = {
    "temp": ("", ["", "[1]", "[4]"]), "temp/com": ("", ["", "[2]"]), "temp/partial": ("1 1 0", ["", "[1]"]), "ke": ("", [""]),
    "temp/ramp": ("vx 0 {v} y 0 4 units box", [""]), "temp/profile": ("1 1 {z} {bins}", ["", "[1]"]),
    "temp/region": ("{region}", [""]), "msd": ("{com}", ["[1]", "[4]"]), "vacf": ("", ["[4]"]), "com": ("", ["[1]", "[2]"]),
    "gyration": ("", ["", "[4]"]), "pressure": ("thermo_temp", ["", "[1]", "[4]"]), "pressure virial": ("", ["", "[2]"]),
    "group/group": ("{group}", ["", "[1]"]), "pe": ("", [""]), "temp/deform": ("", [""]),
    "rdf": ("20", ["[7][2]", "[15][3]"]), "heat/flux": ("", ["[1]", "[4]"]),
}
ALL_ATOMS_ONLY = ("pressure", "pressure virial", "pe", "heat/flux")
# Computes with values per atom: words, number of columns (0: a vector).
ATOM_COMPUTES = {"stress/atom": ("NULL", 6), "pe/atom": ("", 0), "ke/atom": ("", 0), "coord/atom": ("cutoff {reach}", 0),
                 "displace/atom": ("", 4), "cluster/atom": ("{reach}", 0), "centro/atom": ("{neighbors}", 0),
                 "property/atom": ("x xu vx ix fx mass", 6),
                 "orientorder/atom": ("nnn 8 degrees 2 4 6 cutoff {far}", 2)}


def fill(deck, words):
    """Words of a compute with its blanks filled in."""
    if "{region}" in words:
        words = words.replace("{region}", more_regions(deck))
    bins = deck.pick("x 4", "y 3", "xy 3 2") + " out tensor"
    return words.format(z=0 if deck.dimension == 2 else 1, v=deck.value(0.5, "velocity"), bins=bins, com=deck.pick("", "com yes", "average yes"), group=deck.group(),
                        reach=deck.number(1.1, 1.25, "length"), neighbors=4 if deck.dimension == 2 else 12,
                        far=deck.value(1.7, "length"))


def add_computes(deck):
    """Some computes of numbers and of values per atom, these reduced to a number, and chunks."""
    deck.atom_values = ["vx", "x", "fx"]  # for dumps, averages and reductions
    for _ in range(deck.pick(0, 1, 2, 3)):
        style = deck.random.choice(list(GLOBAL_COMPUTES))
        words, outputs = GLOBAL_COMPUTES[style]
        if style == "rdf" and deck.pair in ("zero", "soft") or style == "heat/flux":
            add_heat_flux(deck)
            continue
        name = deck.name("c")
        group = "all" if style in ALL_ATOMS_ONLY else deck.group()
        command = "pressure NULL virial" if style == "pressure virial" else f"{style} {fill(deck, words)}"
        deck.add(f"compute {name} {group} {command}".rstrip())
        deck.columns += [f"c_{name}{output}" for output in outputs]
    for _ in range(deck.pick(0, 0, 1, 2)):
        add_atom_compute(deck)
    if deck.chance(0.3):
        add_chunks(deck)


def add_heat_flux(deck):
    one, two, three, flux = (deck.name("c") for _ in range(4))
    deck.add(f"compute {one} all ke/atom", f"compute {two} all pe/atom", f"compute {three} all stress/atom NULL virial",
             f"compute {flux} all heat/flux {one} {two} {three}")
    deck.columns += [f"c_{flux}[{deck.pick(1, 2, 4, 5)}]"]


def add_atom_compute(deck):
    style = deck.random.choice(list(ATOM_COMPUTES))
    if style == "orientorder/atom" and deck.dimension == 2:
        style = "coord/atom"
    words, n_columns = ATOM_COMPUTES[style]
    name, total = deck.name("c"), deck.name("c")
    group = "all" if style in ("pe/atom", "stress/atom") else deck.group()
    deck.add(f"compute {name} {group} {style} {fill(deck, words)}".rstrip())
    value = f"c_{name}" + (f"[{deck.random.randint(1, n_columns)}]" if n_columns else "")
    deck.atom_values.append(value)
    formula = deck.name("a")
    deck.add(f'variable {formula} atom "{deck.pick("x*x+vy", "abs(fx)", f"{value}+1", "mass*vx^2", "(id<100)*y", "type*fy")}"')
    deck.atom_values.append(f"v_{formula}")
    mode = deck.pick("sum", "min", "max", "ave", "sumsq", "avesq")
    where = f"reduce/region {more_regions(deck)}" if deck.chance(0.3) else "reduce"
    deck.add(f"compute {total} all {where} {mode} {value} v_{formula}")
    deck.columns += [f"c_{total}[1]", f"c_{total}[2]"]


def chunk_words(deck):
    """Words of compute chunk/atom."""
    units = "units reduced" if deck.is_tilted else deck.pick("units reduced", "units box", "units lattice")
    delta = {"units reduced": "0.2", "units box": deck.value(1.7, "length"), "units lattice": "1.3"}[units]
    origin = deck.pick("lower", "upper", "center")
    z_middle = 0 if deck.dimension == 2 else deck.cells[2] / 2 * deck.spacing
    middle = f"{deck.value(deck.cells[0] / 2 * deck.spacing, 'length')} {deck.value(deck.cells[1] / 2 * deck.spacing, 'length')}"
    far = deck.value(3.3, "length")
    choices = ["type", f"bin/1d {deck.pick('x', 'y')} {origin} {delta} {units}", f"bin/2d x {origin} {delta} y lower {delta} {units}",
               "bin/1d x lower 0.1 units reduced discard yes bound x 0.2 0.8", f"region {delta} {units}"]
    if not deck.is_tilted:
        choices.append(f"bin/sphere {middle} {deck.value(z_middle, 'length')} {deck.value(0.2, 'length')} {far} 5 units box discard yes")
    if deck.dimension == 3 and not deck.is_tilted:
        choices.append(f"bin/cylinder z lower {deck.value(1000, 'length')} {middle} {deck.value(0.2, 'length')} {far} 5 units box discard yes")
    if deck.dimension == 3:
        choices.append(f"bin/3d x lower {delta} y lower {delta} z lower {delta} {units} compress yes ids every")
    words = deck.random.choice(choices)
    if words.startswith("region"):
        words = f"bin/1d x lower {delta} {units} region {more_regions(deck)}"
    return words


def add_chunks(deck):
    """A compute chunk/atom, what is measured of its chunks, and files of both."""
    chunks, values = deck.name("k"), deck.name("k")
    place = deck.name("k")
    deck.add(f"compute {chunks} {deck.group()} chunk/atom {chunk_words(deck)}", f"compute {place} all property/atom x vy")
    if deck.chance(0.5):
        add_chunk_profile(deck, chunks)
        return
    style = deck.pick("com/chunk", "vcm/chunk", "gyration/chunk", "inertia/chunk", "angmom/chunk", "omega/chunk", "torque/chunk",
                      "msd/chunk", "property/chunk", "temp/chunk", "reduce/chunk", "temp")
    if style == "temp":
        deck.add(f"compute {values} all temp/chunk {chunks} com {deck.pick('yes', 'no')}")
        deck.columns.append(f"c_{values}")
    else:
        words = {"property/chunk": f"{chunks} count", "temp/chunk": f"{chunks} temp kecom internal",
                 "reduce/chunk": f"{chunks} {deck.pick('sum', 'min', 'max')} c_{place}[1] c_{place}[2]",
                 "gyration/chunk": f"{chunks} tensor"}.get(style, chunks)
        whole = f"c_{values}" if style == "property/chunk" else f"c_{values}[*]"
        deck.add(f"compute {values} all {style} {words}",
                 f"fix {deck.name('f')} all ave/time 2 2 6 {whole} mode vector file chunks.ave")


def add_chunk_profile(deck, chunks):
    choices = ["vx", "temp", "density/number", "density/mass", "fy", "mass"]
    choices += [value for value in deck.atom_values if value.startswith(("c_", "v_"))]
    deck.add(f"fix {deck.name('f')} {deck.group()} ave/chunk 2 3 6 {chunks} {' '.join(deck.random.sample(choices, 3))} "
             f"norm {deck.pick('all', 'sample', 'none')} {deck.pick('', 'ave running ')}file layers.ave")


FORMULAS = ["pe/atoms+ke", "sqrt(temp)*exp(-step/50)", "ramp(0,5)", "step%7+vol^(1/3)", "bound(all,xmax)-bound(all,xmin)",
            "xcm(all,x)", "vcm(all,y)", "ke(all)", "gyration(all)", "mass(all)", "count(all)", "fcm(all,x)", "(step>10)*temp||0",
            "stagger(20,5)", "swiggle(1,2,10)", "vdisplace(1,0.1)", "cwiggle(1,2,10)", "torque(all,z)", "angmom(all,z)",
            "inertia(all,xx)", "omega(all,z)", "floor(vol*0.37)+ceil(pe)+round(ke)", "sin(step)+cos(step)*tan(0.1)+atan2(1,2)",
            "random(0,1,55)*0+ln(2)+log(10)", "logfreq(10,3,10)", "logfreq2(10,3,10)", "logfreq3(2,10,100)", "stride(5,60,7)",
            "stride2(1,50,5,20,30,2)", "normal(0,1,99)*0+abs(-2)", "x[5]+vy[7]", "fx[10]", "-2^2+2^-1", "!(step>3)&&1", "1<=2==1",
            "dt*elapsed+time*0"]
GROUP_FORMULAS = ["count({g})", "mass({g})", "xcm({g},y)", "vcm({g},x)", "fcm({g},y)", "bound({g},ymin)", "gyration({g})", "ke({g})",
                  "angmom({g},z)", "torque({g},z)", "inertia({g},zz)", "omega({g},z)", "count(all,{r})", "mass({g},{r})",
                  "ke({g},{r})", "xcm({g},x,{r})", "vcm({g},y,{r})", "bound({g},xmax,{r})"]


def add_variables(deck):
    for _ in range(deck.pick(0, 0, 1, 2)):
        name = deck.name("v")
        formula = deck.random.choice(FORMULAS + GROUP_FORMULAS)
        if "{r}" in formula:
            formula = formula.replace("{r}", more_regions(deck))
        deck.add(f'variable {name} equal "{formula.replace("{g}", deck.group())}"')
        deck.columns.append(f"v_{name}")


# ---- output -----------------------------------------------------------------------------------------------------------------

KEYWORDS = ("ke etotal pxx pyy pxy vol lx ly xlo xhi ylo yhi density enthalpy evdwl atoms fmax fnorm cella cellb dt time "
            "elapsed elaplong ecouple econserve").split()


def add_thermo(deck):
    keywords = KEYWORDS + (["pzz", "pxz", "pyz", "lz", "cellc"] if deck.dimension == 3 else [])
    keywords += ["xy", "cellgamma"] if deck.is_tilted else []
    chosen = deck.random.sample(keywords, deck.random.randint(4, 9))
    if deck.chance(0.1):
        deck.add(deck.pick("thermo_style one", "thermo_style multi"))
    else:
        deck.add(f"thermo_style custom step temp pe press {' '.join(deck.columns + chosen)}")
    deck.add("thermo_modify " + deck.pick("norm no", "norm yes", "norm no format float %20.13g", "lost warn", "format 2 %.10g"),
             f"thermo {deck.pick(5, 10, 3)}")


def add_averages(deck):
    """Files of averages of what thermo output shows, histograms and correlations."""
    numbers = [column for column in deck.columns if column.startswith(("c_", "v_"))] + ["c_thermo_temp", "c_thermo_press"]
    value, other = deck.random.choice(numbers), deck.random.choice(numbers)
    file_name = "fix {} all".format(deck.name("f"))
    span = f"{deck.value(-3, 'velocity')} {deck.value(3, 'velocity')}"
    choices = [f"ave/time 1 5 5 {value} {other} file time.ave", f"ave/time 2 3 10 {value} ave running file time.ave",
               f"ave/time 1 2 4 {value} ave window 3 file time.ave", f"ave/time 5 1 5 {value} off 1 file time.ave",
               f"ave/correlate 2 4 8 {value} {other} type {deck.pick('auto', 'full', 'upper')} ave running file series.ave",
               f"ave/correlate 1 5 5 {value} file series.ave",
               f"ave/histo 2 2 4 {span} 7 vx vy beyond {deck.pick('ignore', 'end', 'extra')} mode vector file histogram.ave",
               f"ave/histo 1 5 10 {span} 5 vx mode vector ave running file histogram.ave",
               "vector 3 " + value]
    if deck.chance(0.4):
        deck.add(f"{file_name} {deck.random.choice(choices)}")


def add_dumps(deck):
    if not deck.chance(0.35):
        return
    name = deck.name("d")
    columns = deck.random.sample(["id", "type", "x", "ys", "xu", "zsu", "ix", "vx", "fy", "mass", "iy", "vz"], 5) + deck.atom_values
    columns += deck.pick([], ["mux", "muy"]) if "dipole" in deck.atom_style else []
    columns += deck.pick([], ["radius", "diameter"]) if "sphere" in deck.atom_style else []
    deck.add(deck.pick(f"dump {name} {deck.group()} custom 7 atoms.dump id " + " ".join(columns),
                       f"dump {name} {deck.group()} atom 7 atoms.dump",
                       f"dump {name} {deck.group()} custom 5 atoms.dump id x y z vx vy vz"))
    is_custom = " custom " in deck.lines[-1]
    more = ["", " first yes", " pbc yes", " every 4"] + (2 * [" format float %.9g"] if is_custom else [])
    deck.add(f"dump_modify {name} sort id{deck.random.choice(more)}")
    if is_custom and deck.chance(0.2):
        deck.add(f"dump_modify {name} " + deck.pick("thresh x > 2.5", "thresh type == 1",
                                                    f"region {more_regions(deck)}"))


# ---- runs -------------------------------------------------------------------------------------------------------------------

def simple_runs(deck):
    """Runs, with changes of the system between them."""
    length = deck.value(0.01, "length")
    choices = [["run 20"], ["run 20"], ["run 12", "run 15"], ["run 10", "reset_timestep 0", "run 10"] if deck.may_reset() else ["run 20"],
               ["run 10", f"displace_atoms all move {length} 0 0 units box", "run 10"],
               ["run 10", "unfix int", "fix int all nve", "run 10"], ["run 10", f"delete_atoms group {deck.groups[-1]}", "run 10"],
               ['run 20 every 5 "print hi" "variable now equal step"'], ["run 10", "replicate 2 1 1", "run 10"] if not deck.keeps_places() else ["run 20"],
               ["run 10", "run 25 upto"], ["run 10 start 0 stop 30", "run 20 start 0 stop 30"], ["run 10", "run 10 pre no post no"],
               ["run 10", "velocity all scale " + deck.value(0.9, "temperature"), "run 10"],
               ["run 10", "set type 1 vx 0.0", "run 8"], ["run 10", "timestep " + deck.value(0.003, "time"), "run 10"],
               ["run 10", "neighbor " + deck.value(0.35, "length") + " bin", "run 10"]]
    runs = deck.random.choice(choices)
    is_gone = any(line.startswith("delete_atoms group all") for line in runs)
    return ["run 15"] if is_gone or (runs[1:2] == ["unfix int"] and deck.integrator == "sllod") else runs


def box_runs(deck):
    """Changes of the box between runs."""
    if not deck.is_periodic():
        return ["run 10", "change_box all x scale 1.02", "run 10"]
    changes = ["x scale 1.02 remap", "x final 0 {:.4g} remap".format(deck.cells[0] * 1.02), "y delta -0.1 0.1 remap", "x scale 1.01 y volume remap"]
    if deck.is_tilted:
        changes += ["xy delta 0.2 remap", "xy final 0.1 remap"]
    return ["run 10", f"change_box all {deck.random.choice(changes)}", "run 10"]


def minimizations(deck):
    if any(re.match(r"fix \S+ \S+ (addforce|setforce|aveforce|flow)", line) for line in deck.lines):
        return ["run 20"]  # whose energy is not known
    style = deck.pick("cg", "sd", "fire")
    lines = [f"min_style {style}"] + deck.pick([], [f"min_modify dmax {deck.value(0.05, 'length')}"])
    if style != "fire" and deck.is_periodic() and deck.integrator == "nve" and deck.chance(0.5):
        kinds = ["iso", "aniso"] if deck.dimension == 3 else ["x", "y"]
        lines.append(f"fix relax all box/relax {deck.random.choice(kinds)} {deck.value(0.5, 'pressure')} vmax 0.001")
        return lines + [f"minimize 0 {deck.value(1e-4, 'force')} {deck.pick(10, 15)} 100", "unfix relax", "run 5"]
    return lines + [f"minimize {deck.pick('0', '1e-5')} {deck.value(1e-4, 'force')} {deck.pick(10, 15)} 100", "run 10"]


def loops(deck):
    """Runs in a loop, with a condition in it and a file that is included."""
    return ['print "run 4" file part.in', "variable i loop 4", "label again", "include part.in",
            'if "$i == 2" then "velocity all zero linear" elif "$i == 3" "variable now equal temp" else "print $i"',
            "print $(v_i+step:%.3f)", "next i", "jump SELF again"]


def rereads(deck):
    """What one run has written is read by another."""
    fields = "x y vx vy ix iy" if deck.dimension == 2 else "x y z vx vy vz ix iy iz"
    dump = [f"dump out all custom 5 written.dump id type {fields}", "dump_modify out sort id format float %.15g",
            "run 10", "undump out"]
    style = deck.pick("data", "rerun", "read_dump")
    if style == "rerun" and deck.may_reset():
        return dump + [f"rerun written.dump dump {fields}"]
    if style == "read_dump" and deck.may_reset():
        return dump + [f"read_dump written.dump 5 {fields}", "run 10"]
    again = [line for line in deck.lines if line.startswith(("units", "dimension", "boundary", "atom_style", "pair_style", "pair_coeff",
                                                             "pair_modify", "neighbor", "neigh_modify every", "neigh_modify delay",
                                                             "timestep"))]
    index = next(i for i, line in enumerate(again) if line.startswith("pair_style"))
    again.insert(index, "read_data written.data")
    return ["run 10", "write_data written.data nocoeff", "clear"] + again + ["fix int all nve", "thermo 5", "run 10"]


def add_runs(deck):
    kind = deck.pick(simple_runs, simple_runs, simple_runs, simple_runs, box_runs, minimizations, loops, rereads)
    deck.add(*kind(deck))
