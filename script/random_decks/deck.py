"""A deck that is being made, and the natural sizes of quantities in its units."""
import random
import re

# Units of pressure in an energy per volume, Boltzmann's constant, and an atom like argon: energy, length, mass, time.
PRESSURE_OF = {"lj": 1.0, "real": 68568.415, "metal": 1602176.6, "si": 1.0, "cgs": 1.0, "electron": 2.94210108e13, "micro": 1.0, "nano": 1.0}
BOLTZMANN = {"lj": 1.0, "real": 0.0019872067, "metal": 8.617343e-5, "si": 1.3806504e-23, "cgs": 1.3806504e-16,
             "electron": 3.16681534e-6, "micro": 1.3806504e-8, "nano": 0.013806504}
ARGON = {"lj": (1.0, 1.0, 1.0, 1.0), "real": (0.238, 3.405, 39.948, 2156.0), "metal": (0.01032, 3.405, 39.948, 2.156),
         "si": (1.654e-21, 3.405e-10, 6.634e-26, 2.156e-12), "cgs": (1.654e-14, 3.405e-8, 6.634e-23, 2.156e-12),
         "electron": (3.793e-4, 6.434, 39.948, 2156.0), "micro": (1.654e-6, 3.405e-4, 6.634e-11, 2.156e-6),
         "nano": (1.654, 0.3405, 6.634e-5, 2.156e-3)}
# Times are those of velocities: lengths over times, but in electron units, where velocities are in bohr per 1.03275 fs.
VELOCITY_OF = {"electron": 1.03275}


def scales_of(units):
    """Natural sizes of quantities in units of a deck: those of a Lennard-Jones atom like argon."""
    energy, length, mass, time = ARGON[units]
    return {"": 1.0, "energy": energy, "length": length, "mass": mass, "time": time, "temperature": energy / BOLTZMANN[units],
            "pressure": PRESSURE_OF[units] * energy / length**3, "velocity": length / time * VELOCITY_OF.get(units, 1.0),
            "force": energy / length,
            "stiffness": energy / length**2, "cubic stiffness": energy / length**3, "rate": 1 / time, "power": energy / time,
            "friction": energy * time / length**2, "acceleration": length / time**2, "1/length": 1 / length,
            "1/area": 1 / length**2, "energy length": energy * length, "energy length^6": energy * length**6,
            "energy length^8": energy * length**8, "density": mass / length**3}


class Deck:
    """A deck that is being made: its lines, the random choices, and what later lines need to know of earlier ones."""

    def __init__(self, seed, is_alone=False):
        self.random = random.Random(seed)
        self.is_alone = is_alone  # only Halfshell runs it: noise and styles of its own may be drawn
        self.lines = []
        self.groups = ["all"]
        self.columns = []  # of thermo output
        self.vectors = []  # that are no numbers as well, with at least 4 elements
        self.atom_values = ["vx", "x", "fx"]  # for dumps, averages and reductions
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

    def has(self, pattern):
        """Whether a line of the deck begins so."""
        return any(re.match(pattern, line) for line in self.lines)

    def is_sphere(self):
        return "sphere" in self.atom_style

    def is_dipole(self):
        return "dipole" in self.atom_style

    def is_periodic(self):
        return self.boundary == ["p"] * 3

    def middle(self):
        """The middle of the box in lattice spacings."""
        return [n / 2 for n in self.cells[:self.dimension]] + [0] * (3 - self.dimension)

    def may_reset(self):
        """Whether nothing counts steps, so that the number of the step may be changed."""
        return not self.has(r"dump |fix \S+ \S+ (ave/|deform|vector|print)|thermo v_|restart")

    def keeps_places(self):
        """Whether a style remembers where atoms were, so that LAMMPS cannot replicate them."""
        return self.has(r"fix \S+ \S+ (spring/self|property/atom)|compute \S+ \S+ (msd|vacf|displace/atom)")

    def text(self):
        return "\n".join(self.lines) + "\n"
