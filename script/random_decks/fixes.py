"""Fixes of a random deck: the integrator, and others beside it."""
import re

from random_decks.system import live_region, more_regions


def heat_bath_words(deck):
    return f"temp {deck.number(0.5, 1.5, 'temperature')} {deck.number(0.5, 1.5, 'temperature')} {deck.number(0.3, 1, 'time')}"


def add_integrator(deck):
    """The fixes that move atoms; box changes only along periodic axes."""
    choices = ["nve", "nve", "nve", "nvt", "nve/limit", "two", "biased"]
    box_may_change = all(face == "p" for face in deck.boundary[:deck.dimension])
    if box_may_change:
        choices += ["npt", "nph"]
    if deck.is_tilted:
        choices += ["sllod"]
    if deck.is_sphere():
        choices += ["sphere"] * 6
    if deck.is_alone and deck.chance(0.5):
        choices = ["noise"]
    deck.integrator = deck.random.choice(choices)
    chains = deck.pick("", " tchain 1", " tloop 2", " drag 0.5", " tchain 4 mtk no")
    if deck.integrator == "nve":
        deck.add("fix int all nve")
    elif deck.integrator == "two":
        first = deck.groups[-1]
        deck.add(f"group rest subtract all {first}" if first != "all" else "")
        deck.add(f"fix int {first} {deck.pick('nve', 'nvt ' + heat_bath_words(deck) + chains)}")
        if first != "all":
            deck.add(f"fix int2 rest {deck.pick('nve', 'nve/noforce', 'nve/limit ' + deck.value(0.03, 'length'), 'nvt ' + heat_bath_words(deck))}"
                     if deck.chance(0.7) else "")
    elif deck.integrator == "biased":
        style = deck.pick("temp/com", "temp/partial 1 1 0", "temp/profile 1 0 0 y 3", "temp")
        deck.add(f"compute bath all {style}", f"fix int all nvt {heat_bath_words(deck)}{chains}", "fix_modify int temp bath")
    elif deck.integrator == "sphere":
        turned = deck.pick("", "", " disc" if deck.dimension == 2 else "")
        turned += deck.pick("", " update dipole", " update dipole/dlm") if deck.is_dipole() else ""
        style = deck.pick("nve", "nve", "nvt", *["npt", "nph"] * box_may_change)
        words = {"nve": "", "nvt": f" {heat_bath_words(deck)}", "npt": f" {heat_bath_words(deck)} {barostat(deck)}", "nph": f" {barostat(deck)}"}[style]
        deck.integrator = style  # as to what goes with it
        deck.add(f"fix int all {style}/sphere{words}{turned}")
    elif deck.integrator == "noise":
        add_noisy_integrator(deck)
    elif deck.integrator == "nve/limit":
        deck.add(f"fix int all nve/limit {deck.value(0.05, 'length')}")
    elif deck.integrator == "nvt":
        deck.add(f"fix int all nvt {heat_bath_words(deck)}{chains}")
    elif deck.integrator == "sllod":
        deck.add(f"fix int all nvt/sllod {heat_bath_words(deck)}{deck.pick('', '', ' tchain 2')}",
                 f"fix shear all deform 1 xy erate {deck.number(0.05, 0.2, 'rate')} remap v")
    else:
        deck.add(f"fix int all {deck.integrator} {heat_bath_words(deck) + ' ' if deck.integrator == 'npt' else ''}{barostat(deck)}")
        if deck.chance(0.15):
            deck.add(f"compute bath all temp{deck.pick('', '/com')}", "fix_modify int temp bath")


def add_noisy_integrator(deck):
    """Integrators with noise, which is each program's own."""
    warm = deck.number(0.5, 1.5, "temperature")
    overdamped = f"gamma_t {deck.number(20, 60, 'friction')}"
    choices = ["langevin", "langevin", f"brownian {warm} {deck.seed()} {overdamped}{deck.pick('', ' rng gaussian', ' rng none')}", "temp/csvr"]
    if deck.is_dipole():
        choices += 2 * [f"brownian/sphere {warm} {deck.seed()} {overdamped} gamma_r {deck.number(20, 60, 'friction')}{deck.pick('', ' rng gaussian')}"]
    words = deck.random.choice(choices)
    if words == "langevin":
        spins = deck.is_sphere() and deck.chance(0.7)
        more = deck.pick("", "", " tally yes", " zero yes", " scale 1 2.0") + (" omega yes" if spins else "")
        deck.add(f"fix int all nve{'/sphere' if spins else ''}",
                 f"fix bath {deck.group()} langevin {warm} {warm} {deck.number(0.2, 1, 'time')} {deck.seed()}{more}")
    elif words == "temp/csvr":
        deck.add("fix int all nve", f"fix bath {deck.group()} temp/csvr {warm} {warm} {deck.number(0.05, 0.3, 'time')} {deck.seed()}")
    else:
        deck.add(f"fix int all {words}")
    if deck.is_dipole() and deck.chance(0.5):
        deck.add(f"fix swim {deck.group()} propel/self {deck.pick('dipole', 'velocity')} {deck.number(1, 5, 'force')}")


def own_fix_choices(deck):
    """Lines of fixes that LAMMPS has not, or whose random numbers are not the same."""
    n, steps = deck.number, deck.pick(1, 2, 3, 5)
    seed, warm = deck.seed(), deck.number(0.5, 1.5, "temperature")
    choices = [f"ave/self {deck.pick(1, 2)} 4 {deck.pick(4, 8)} {deck.pick('msd vacf', 'msd alpha2', 'isf ' + n(1, 7, '1/length') + ' msd')} origins {deck.pick(1, 2)} error yes file self.ave",
               f"ave/spectrum 1 4 4 c_thermo_temp c_thermo_press[1] file spectrum.ave", f"evaporate {steps} 2 {more_regions(deck)} {seed}",
               f"widom {steps} 40 1 {seed} {warm}{deck.pick('', ' region ' + live_region(deck))}", f"numdiff {steps} {deck.value(1e-4, 'length')}"]
    middle = [f"{x * deck.spacing * deck.scales['length']:.6g}" for x in deck.middle()]
    choices += [f"drag {middle[0]} {deck.pick('NULL', middle[1])} NULL {n(-1, 1, 'force')} {n(0, 1, 'length')}",
                f"spring/rg {n(1, 10, 'stiffness')} {deck.pick('NULL', n(1, 4, 'length'))}",
                f"oneway {steps} {live_region(deck)} {deck.pick('x', 'y', '-x', '-y')}"]
    axis, other = deck.pick(("x", "y"), ("y", "x"))
    choices += [f"viscosity {steps} {axis} {other} {deck.pick(4, 6)}{deck.pick('', ' swap 2', ' vtarget ' + n(0.5, 2, 'velocity'))}", f"flow/gauss {deck.pick('1 0 0', '1 1 0', '0 1 0')}{deck.pick('', ' energy yes')}",
                f"controller {deck.pick(2, 5)} 1.0 {n(0.1, 1)} {n(0, 0.1)} 0 c_thermo_temp {warm} knob",
                f"ave/correlate/fft {deck.pick(1, 2)} 8 4 c_thermo_temp c_thermo_press[1] type full{deck.pick('', ' levels 3', ' error yes levels 2')} file fft.ave",
                f"ave/correlate/long 1 5 c_thermo_temp c_thermo_press[2] type auto/upper nlen 4 ncorr 3{deck.pick('', ' overwrite', ' error yes')} file long.ave"]
    if deck.boundary[0] != "p":
        wall = f"EDGE {warm} 0 {n(-0.2, 0.2, 'velocity')} 0"
        choices += [f"wall/reflect/stochastic {kind} {seed} xlo {wall}{more} xhi {wall}{more}" for kind, more in (("diffusive", ""), ("maxwell", " 0.7"), ("ccl", " 0.9 0.8 0.8"))]
    if deck.n_types > 1:
        potentials = " ".join(n(-1, 1, "energy") for _ in range(deck.n_types))
        types = " ".join(str(kind + 1) for kind in range(deck.n_types))
        choices += [f"atom/swap {steps} 30 {seed} {warm} types 1 2{deck.pick('', ' ke no', ' region ' + live_region(deck))}"] * 2
        choices += [f"atom/swap {steps} {deck.pick(20, 300)} {seed} {warm} semi-grand yes types {types} mu {potentials}"] * 2
    if deck.dimension == 3 and not deck.is_sphere():
        more = deck.pick("", "", " tfac_insert 0.5", " max 250", " min 200", f" group {deck.group()}", f" pressure {deck.value(1, 'pressure')}")
        choices += [f"gcmc {steps} {deck.pick(10, 30)} {deck.pick(0, 10)} {deck.random.randint(1, deck.n_types)} {seed} {warm} {n(-4, 2, 'energy')} {n(0.05, 0.3, 'length')}{more}"] * 3
    if deck.is_periodic() and deck.dimension == 3:
        choices += [f"ave/isf {deck.pick(1, 2)} 4 8 {n(2, 4, '1/length')} 5 file isf.ave"]
    if not deck.is_tilted:
        bounded = deck.name("r")
        deck.add(f"region {bounded} block 1 {deck.cells[0] - 1} 1 {deck.cells[1] - 1} " + ("-0.2 0.2" if deck.dimension == 2 else f"1 {deck.cells[2] - 1}"))
        choices += [f"deposit 5 1 {steps} {seed} region {bounded} near {deck.value(0.7, 'length')} units box attempt 50"]
        if deck.boundary[0] == "p" and deck.integrator not in ("npt", "nph"):
            choices += [f"rhok {deck.pick(1, 2, 4)} 0 0 {n(1, 5, 'energy')} {n(0, 2)}"]
    return choices


def barostat(deck):
    target = f"{deck.value(1.0, 'pressure')} {deck.number(0.5, 3, 'pressure')} {deck.value(2.0, 'time')}"
    choices = [f"iso {target}", f"aniso {target}", f"x {target}", f"x {target} y {target} couple xy", f"y {target}",
               f"y {target} x {deck.value(0.5, 'pressure')} {deck.value(0.5, 'pressure')} {deck.value(3.0, 'time')}"]
    if deck.dimension == 3:
        choices += [f"z {target}", f"x {target} z {target} couple xz", f"aniso {target} couple xy"]
    if deck.is_tilted:
        choices += [f"tri {target}", f"x {target} scalexy no", f"y {target} scalexy no"]
    more = deck.pick("", "", " drag 0.2", " pchain 1", " pchain 0", " nreset 10", " mtk no", " ploop 2", f" dilate {deck.group()}",
                     f" fixedpoint {deck.value(1, 'length')} {deck.value(1, 'length')} 0")
    if deck.integrator == "nph" and deck.chance(0.2):
        more += f" ptemp {deck.value(1.2, 'temperature')}"
    return deck.random.choice(choices) + more


def fix_choices(deck):
    """Lines of fixes beside the integrator, without ID and group; {axes} of the plane only in two dimensions."""
    n, plane = deck.number, deck.dimension == 2
    steps = deck.pick(1, 2, 5)
    choices = [
        f"addforce {n(-1, 1, 'force')} 0 {0 if plane else n(-1, 1, 'force')}", "addforce v_push 0 0", "addforce v_field v_push 0",
        f"addforce {n(-1, 1, 'force')} 0 0 every {steps}", "addforce v_field 0 0 energy v_potential", "addforce {n} 0 0 region {r}",
        f"setforce {n(-0.5, 0.5, 'force')} NULL 0", "setforce 0 0 0", f"aveforce NULL {n(-1, 1, 'force')} NULL", "setforce v_field NULL NULL",
        "setforce 0 NULL NULL region {r}", "aveforce {n} NULL NULL region {r}", "aveforce v_push NULL NULL",
        f"viscous {n(0.2, 1, 'friction')}", f"spring/self {n(1, 10, 'stiffness')}{deck.pick('', ' xy', ' x', ' yz', ' xyz')}",
        f"viscous {n(0.2, 1, 'friction')} scale 1 {n(0.5, 2)}",
        f"spring tether {n(5, 50, 'stiffness')} {n(0, 3, 'length')} {n(0, 3, 'length')} {deck.pick('NULL', '0.0')} {n(0, 1, 'length')}",
        f"spring tether {n(5, 50, 'stiffness')} NULL {n(0, 3, 'length')} NULL 0.0",
        f"temp/rescale {steps} {n(0.8, 1.1, 'temperature')} {n(0.8, 1.1, 'temperature')} {n(0.01, 0.03, 'temperature')} {n(0.3, 1)}",
        f"temp/rescale {steps} v_warm 0.0 {n(0.01, 0.03, 'temperature')} {n(0.3, 1)}",
        f"temp/berendsen {n(0.8, 1.1, 'temperature')} {n(0.5, 1.1, 'temperature')} {n(0.1, 1, 'time')}",
        f"temp/berendsen v_warm 0 {n(0.1, 1, 'time')}",
        f"momentum {steps} linear 1 1 {0 if plane else 1}{deck.pick('', ' angular', ' rescale')}",
        f"momentum {steps} {deck.pick('angular', 'linear 0 1 0 angular rescale', 'linear 1 0 0')}",
        f"gravity {n(0.2, 1, 'acceleration')} vector 1 0.5 0", f"gravity {n(0.2, 1, 'acceleration')} chute 24.0", "gravity v_pull vector 0 1 0",
        f"indent {n(5, 20, 'cubic stiffness')} sphere {n(0, 3, 'length')} {n(0, 3, 'length')} 0 {n(1, 2, 'length')} units box",
        f"indent {n(5, 20, 'cubic stiffness')} sphere v_go {n(0, 3, 'length')} 0 {n(1, 2, 'length')} units box",
        f"indent {n(5, 20, 'cubic stiffness')} plane x {n(0.5, 2)} {deck.pick('lo', 'hi')}",
        f"indent {n(2, 8, 'cubic stiffness')} cylinder z 2 2 1.0 {deck.pick('', 'side in')}".strip(),
        f"heat {steps} {n(0.05, 0.2, 'power')}", f"ehex {steps} {n(0.05, 0.2, 'power')}", f"heat {steps} {n(0.05, 0.2, 'power')} region {{r}}",
        f"ehex {steps} {n(0.05, 0.2, 'power')} {deck.pick('region {r}', 'hex')}",
        "recenter INIT INIT " + ("NULL" if plane else "INIT"), "lineforce 1 0.5 0", "planeforce 0 1 0.3",
        "recenter " + deck.pick("0.5 NULL NULL units fraction", "NULL 2 NULL", f"INIT {n(1, 3, 'length')} NULL units box", f"INIT NULL NULL shift {deck.group()}"),
        f"thermal/conductivity {steps} {deck.pick('x', 'y')} {deck.pick(4, 6)}{deck.pick('', ' swap 2')}",
        f"dt/reset {steps} {deck.value(0.0005, 'time')} {deck.value(0.005, 'time')} {deck.value(0.02, 'length')} units box",
    ]
    choices = [choice.replace("{n}", n(-1, 1, "force")) for choice in choices]
    if len(deck.groups) > 2 and not deck.is_inner:  # where groups have atoms
        choices += [f"spring couple {deck.groups[1]} {n(5, 50, 'stiffness')} {n(0, 1, 'length')} NULL NULL {n(0, 1, 'length')}"]
    if plane:
        choices += ["enforce2d"] * 2
    choices += [f"balance {steps} {deck.pick('1.0', '1.1')} {deck.pick('shift xy 5 1.05', 'shift x 10 1.0', 'shift yx 3 1.1 weight neigh 0.8')}"]
    choices += [f"halt {deck.pick(1, 3, 4)} v_{deck.pick('late', 'hot')} {deck.pick('>', '>=', '!=')} 1 {deck.pick('error soft', 'error continue', 'error continue message no', '')}".strip()]
    if deck.is_inner:
        choices.append(f"wall/region in {deck.pick('lj93', 'lj126', 'harmonic', 'lj1043')} {n(0.5, 1, 'energy')} "
                       f"{n(0.2, 0.3, 'length')} {n(0.4, 0.5, 'length')}")
    if deck.pair in ("lj/cut", "soft"):
        coefficient = "epsilon" if deck.pair == "lj/cut" else "a"
        choices.append(f"adapt {deck.pick(0, 1, 2, 5)} pair {deck.pair} {coefficient} {deck.pick('1 1', '* *', '1 *')} v_grow{deck.pick('', ' scale yes', ' reset yes')}"
                       .replace("v_grow scale", "v_grow1 scale"))
    if deck.is_sphere():
        choices.append(f"adapt {deck.pick(1, 5)} atom diameter v_swell{deck.pick('', ' reset yes')}")
    if deck.boundary[0] != "p":
        choices += 2 * wall_choices(deck)
    if deck.boundary[0] == "p" and deck.integrator not in ("npt", "nph", "sllod") and deck.chance(0.7):
        choices += 2 * deform_choices(deck, steps)
    if deck.is_periodic() and deck.dimension == 3 and deck.integrator == "nve" and not deck.is_tilted:
        p, t = deck.value(1, "pressure"), deck.value(2, "time")
        choices.append(f"press/berendsen {deck.pick('iso', 'aniso', 'x')} {p} {p} {t} modulus {deck.value(50, 'pressure')}{deck.pick('', ' dilate partial')}")
        choices.append(f"press/berendsen x {p} {p} {t} y {p} {p} {t} couple xy modulus {deck.value(50, 'pressure')}")
    return choices


def wall_choices(deck):
    """Walls at the faces in x, which are not periodic."""
    coefficients = f"EDGE {deck.number(0.5, 1, 'energy')} {deck.number(0.5, 1, 'length')} {deck.value(2.5, 'length')}"
    choices = ["wall/reflect xlo EDGE xhi EDGE", f"wall/lj93 xlo {coefficients}", f"wall/lj126 xlo {coefficients} xhi {coefficients}",
               f"wall/lj1043 xhi {coefficients}", f"wall/reflect xhi {deck.cells[0] * 0.9:.3g}", "wall/reflect xlo v_wall units box",
               f"wall/harmonic xlo EDGE {deck.number(20, 100, 'stiffness')} 1.0 {deck.value(1, 'length')}",
               f"wall/lj126 xlo {deck.number(-1, 0)} {coefficients[5:]} units lattice",
               f"wall/lj93 xlo v_wall {coefficients[5:]} units box",
               f"wall/harmonic xhi EDGE v_push {deck.number(1, 1, 'length')} {deck.value(1.5, 'length')}"]
    if deck.boundary[1] != "p":
        choices += [f"wall/lj126 ylo {coefficients} xhi {coefficients}", "wall/reflect ylo EDGE yhi EDGE xlo EDGE"]
    return choices


def deform_choices(deck, steps):
    length = deck.cells[0]
    styles = [f"x erate {deck.number(-0.1, 0.1, 'rate')}", f"x vel {deck.value(0.2, 'velocity')} units box", "x scale 1.05", "x vel 0.1",
              f"x final 0 {length * 1.03:.4g}", f"x trate {deck.number(0.02, 0.1, 'rate')}", "x variable v_longer v_faster",
              f"x wiggle {deck.value(0.2)} {deck.value(1, 'time')}", "x delta -0.1 0.2", f"x delta 0 {deck.value(0.3, 'length')} units box"]
    if deck.boundary[1] == "p":
        styles += [f"x erate {deck.number(0.02, 0.1, 'rate')} y volume", "x scale 1.02 y scale 0.97"]
    if deck.boundary[1] == "p" and deck.boundary[2] == "p" and deck.dimension == 3:
        styles += [f"x erate {deck.number(0.02, 0.1, 'rate')} y volume z volume"]
    if deck.is_tilted:
        styles += 2 * [f"xy erate {deck.number(0.05, 0.3, 'rate')}", "xy delta 0.3", "xy final 0.1", "xy wiggle 0.2 "
                       + deck.value(1, "time"), f"xy vel {deck.value(0.2, 'velocity')} units box", f"xy erate {deck.number(5, 20, 'rate')}"]
    more = deck.pick("", "", "", " flip no") if deck.is_tilted else ""
    return [f"deform {steps} {style} remap {deck.pick('x', 'x', 'v', 'none')}{more}" for style in styles]


WHOLE_GROUP = ("deform", "enforce2d", "thermal", "press", "heat", "ehex", "dt/reset")  # fixes that are given group all here
WITH_ENERGY = ("addforce", "spring", "gravity", "indent", "wall/lj", "wall/har")  # fix_modify energy yes
WITH_VIRIAL = ("addforce", "wall/lj", "wall/har", "wall/region")  # fix_modify virial yes
# Numbers of fixes that are good columns of thermo output: style, elements.
OUTPUTS = {"addforce": ["", "[1]", "[3]"], "setforce": ["[1]", "[2]"], "aveforce": ["[1]", "[2]"], "spring/self": [""], "spring": ["", "[1]", "[4]"],
           "indent": ["", "[1]", "[2]"], "wall/lj93": ["", "[1]"], "wall/lj126": ["", "[1]"], "wall/lj1043": ["", "[1]"], "wall/harmonic": ["", "[1]"],
           "temp/rescale": [""], "temp/berendsen": [""], "heat": [""], "thermal/conductivity": [""], "dt/reset": ["", "[1]"],
           "nvt": ["", "[1]", "[4]"], "nve/limit": [""], "press/berendsen": []}


def add_fixes(deck):
    x_high = deck.cells[0] * deck.spacing
    deck.add(f"variable push equal {deck.value(0.3, 'force')}*step/10", f"variable grow equal {deck.value(1, 'energy')}*(1+step/500)",
             "variable grow1 equal 1+step/500", f"variable swell equal {deck.value(1, 'length')}*(1+step/1000)",
             f"variable field atom {deck.value(0.3, 'force')}*y/{deck.value(x_high, 'length')}",
             f"variable potential atom -{deck.value(0.3, 'force')}*y*x/{deck.value(x_high, 'length')}",
             f"variable warm equal {deck.value(1, 'temperature')}+{deck.value(0.01, 'temperature')}*step",
             f"variable pull equal {deck.value(0.02, 'acceleration')}*step", f"variable go equal {deck.value(1, 'length')}*(1+0.01*step)",
             f"variable wall equal {deck.value(-0.5, 'length')}*(1+0.01*step)",
             f"variable late equal step/{deck.pick(7, 9, 14)}", f"variable hot equal temp/{deck.number(0.5, 2, 'temperature')}",
             f"variable longer equal {deck.value(0.005, 'length')}*elapsed", f"variable faster equal {deck.value(0.005, 'length')}/dt")
    for _ in range(deck.pick(0, 0, 1, 1, 2, 3)):
        add_fix(deck)
    if deck.is_alone and deck.chance(0.6):
        add_own_fix(deck)
    unused_variables(deck)


def unused_variables(deck):
    """Take the definitions of variables away that no other line uses."""
    names = ("push", "grow", "grow1", "swell", "field", "potential", "warm", "pull", "go", "wall", "late", "hot", "longer", "faster")
    for name in names:
        if not any(f"v_{name}" in re.split(r"[ ]", line) for line in deck.lines):
            deck.lines = [line for line in deck.lines if not line.startswith(f"variable {name} ")]


def add_own_fix(deck):
    words = deck.random.choice(own_fix_choices(deck))
    style = words.split()[0]
    if deck.has(rf"fix \S+ \S+ {style}\b"):
        return
    name = deck.name("o")
    deck.add("variable knob internal 1.0" if style == "controller" else "")
    deck.add(f"fix {name} {deck.group() if style in ('evaporate', 'gcmc', 'atom/swap', 'ave/self', 'drag', 'spring/rg', 'oneway') else 'all'} {words}")
    deck.columns += {"widom": [f"f_{name}[2]", f"f_{name}[3]"], "atom/swap": [f"f_{name}[1]", f"f_{name}[2]"], "evaporate": [f"f_{name}"],
                     "gcmc": [f"f_{name}[2]", f"f_{name}[4]", f"f_{name}[6]"], "deposit": [f"f_{name}"], "rhok": [f"f_{name}", f"f_{name}[3]"],
                     "viscosity": [f"f_{name}"], "flow/gauss": [f"f_{name}", f"f_{name}[1]"], "controller": [f"f_{name}[1]", f"f_{name}[2]", "v_knob"],
                     "drag": [f"f_{name}[1]", f"f_{name}[3]"]}.get(style, [])


def add_fix(deck):
    """One more fix, with its place in the thermo output. Of a family of fixes there is one."""
    words = deck.random.choice(fix_choices(deck))
    if "{r}" in words:
        words = words.replace("{r}", live_region(deck))
    style = words.split()[0]
    family = style.replace("press/berendsen", "deform")  # of which one may change the box
    if deck.has(rf"fix e\S+ \S+ {family}\b") or family == "deform" and deck.has(r"fix e\S+ \S+ press/"):
        return
    name = deck.name("e")
    deck.add(f"fix {name} {'all' if style.startswith(WHOLE_GROUP) else deck.group()} {words}")
    is_periodic_gravity = style == "gravity" and "p" in deck.boundary  # LAMMPS's energy is of places in the box then
    if style.startswith(WITH_ENERGY) and "v_" not in words and not is_periodic_gravity and deck.chance(0.5):
        deck.add(f"fix_modify {name} energy yes")
    if style.startswith(WITH_VIRIAL) and deck.chance(0.2):
        deck.add(f"fix_modify {name} virial {deck.pick('yes', 'no')}")
    if style in ("temp/rescale", "temp/berendsen") and deck.chance(0.25):
        deck.add(f"compute {name}t all {deck.pick('temp/com', 'temp/partial 1 1 0', 'temp/profile 1 1 0 y 2')}", f"fix_modify {name} temp {name}t")
    outputs = OUTPUTS.get(style, [])
    if outputs and "v_" not in words:
        deck.columns.append(f"f_{name}{deck.random.choice(outputs)}")
