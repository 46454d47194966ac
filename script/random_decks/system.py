"""The system of a random deck: units, box, lattice, regions, atoms, velocities, groups."""
from random_decks.deck import scales_of

LATTICES = {3: {"fcc": 4, "bcc": 5, "sc": 7, "diamond": 4, "hcp": 5, "custom": 4}, 2: {"sq": 12, "hex": 9, "sq2": 9, "custom": 11}}
ORIGINS = {3: ["", "", " origin 0.1 0.1 0.1", " origin 0.25 0.5 0"], 2: ["", " origin 0.1 0.2 0"]}
BASIS = {"fcc": 4, "bcc": 2, "sc": 1, "diamond": 8, "hcp": 4, "sq": 1, "hex": 2, "sq2": 2, "custom": 2}
# Volume of the cell in cubes of the lattice's constant (squares in two dimensions).
CELL_VOLUME = {"hex": 3**0.5, "hcp": 3**0.5 * (8 / 3) ** 0.5}
TURNED = {3: [" orient x 1 1 0 orient y -1 1 0 orient z 0 0 1", " orient x 1 1 1 orient y 1 -1 0 orient z 1 1 -2", " orient x 0 1 0 orient y 0 0 1 orient z 1 0 0"],
          2: [" orient x 1 1 0 orient y -1 1 0"]}


def add_system(deck):
    """Units, dimension, faces, kind of atoms, lattice and box."""
    deck.units = deck.pick(*["lj"] * 6, *["real", "metal"] * 2, "electron", "micro", "nano", deck.pick("si", "cgs"))
    deck.scales = scales_of(deck.units)
    deck.dimension = deck.pick(3, 3, 3, 2)
    deck.is_tilted = deck.chance(0.25)
    deck.boundary = ["p"] * 3 if deck.is_tilted or deck.chance(0.5) else [deck.pick("p", "p", "f", "s", "m", "fs", "mf", "sm") for _ in range(3)]
    if deck.dimension == 2:
        deck.boundary[2] = "p"
    deck.atom_style = deck.pick(*["atomic"] * 6, "sphere", "dipole", "hybrid dipole sphere", "hybrid sphere dipole")
    deck.add(f"units {deck.units}", f"dimension {deck.dimension}" if deck.dimension == 2 else "",
             deck.pick("", "", "", "newton on", "newton off", "newton on off"),
             deck.pick("", "", "", "processors * * *", "processors 1 1 1", "processors 1 * * map xyz"),
             "boundary " + " ".join(deck.boundary), f"atom_style {deck.atom_style}",
             f"atom_modify map {deck.pick('array', 'hash', 'yes')}{deck.pick('', ' sort 0 0', ' sort 10 0.0')}",
             "box tilt large" if deck.is_tilted and deck.chance(0.3) else "",
             deck.pick("", "", "", "", "comm_modify mode single vel yes", "comm_style tiled", "suffix off"))
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
    deck.add(f"create_box {deck.n_types} box", "run_style verlet" if deck.chance(0.05) else "")


def add_lattice(deck):
    """In lj units a lattice has a density, in others a constant."""
    deck.lattice = deck.random.choice(list(LATTICES[deck.dimension]))
    density = deck.random.uniform(0.6, 0.95) * (0.7 if deck.lattice == "diamond" else 1)
    cell_volume = CELL_VOLUME.get(deck.lattice, 1.0)
    constant = (BASIS[deck.lattice] / cell_volume / density) ** (1 / deck.dimension)
    more = deck.pick(*ORIGINS[deck.dimension])
    if deck.lattice == "custom":
        more += " a1 1 0 0 a2 0 1 0 a3 0 0 1 basis 0 0 0 " + ("basis 0.5 0.5 0.5" if deck.dimension == 3 else "basis 0.5 0.45 0")
    elif deck.lattice in ("fcc", "bcc", "sc", "sq", "sq2", "diamond") and not deck.is_tilted and deck.chance(0.12):
        more += deck.random.choice(TURNED[deck.dimension])
    elif deck.chance(0.05):
        more += " spacing 1.1 1.2 " + ("1" if deck.dimension == 2 else "1.15")
    size = f"{density:.3g}" if deck.units == "lj" else f"{constant * deck.scales['length']:.4g}"
    deck.spacing = constant  # natural lengths
    deck.add(f"lattice {deck.lattice} {size}{more}")
    deck.is_turned = "orient" in more


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


def live_region(deck):
    """As more_regions, but it may move or change its size: for what asks in the midst of runs, as LAMMPS finds its variables there."""
    if deck.chance(0.6):
        return more_regions(deck)
    nx, ny = deck.cells[:2]
    z_middle = 0 if deck.dimension == 2 else deck.cells[2] / 2
    name, go, turn, size = (deck.name(prefix) for prefix in ("r", "go", "turn", "size"))
    side = deck.pick("", "", " side out")
    axis = f"{nx / 2} {ny / 2} {z_middle} " + ("0 0 1" if deck.dimension == 2 else deck.pick("0 0 1", "1 1 0.5", "0 -1 0.2"))
    block = f"block 0.8 {nx * 0.71:.4g} 0.7 {ny * 0.63:.4g} " + ("INF INF" if deck.dimension == 2 else f"0.9 {deck.cells[2] * 0.77:.4g}")
    round_one = f"sphere {nx * 0.45:.4g} {ny * 0.52:.4g} {z_middle} {min(nx, ny) * 0.31:.4g}"
    middle = f"{deck.value(nx * 0.45 * deck.spacing, 'length')} {deck.value(ny * 0.52 * deck.spacing, 'length')} {deck.value(z_middle * deck.spacing, 'length')}"
    deck.add(f"variable {go} equal {deck.pick(deck.value(0.03, 'length') + '*step', 'swiggle(0,' + deck.value(1, 'length') + ',' + deck.value(0.2, 'time') + ')')}",
             f"variable {turn} equal 0.03*step", f"variable {size} equal {deck.value(1.5, 'length')}*(1+0.01*step)")
    words = deck.pick(f"{block} move v_{go} NULL NULL", f"{block} rotate v_{turn} {axis}", f"{block} move NULL v_{go} NULL rotate v_{turn} {axis}",
                      f"{round_one} move v_{go} v_{go} NULL", f"sphere {middle} v_{size} units box", f"sphere v_{size} {middle.split(' ', 1)[1]} v_{size} units box",
                      f"cylinder z {' '.join(middle.split()[:2])} v_{size} INF INF units box", f"cylinder z {middle.split()[0]} v_{size} v_{size} INF INF units box",
                      f"{block} units box rotate v_{turn} {axis} move v_{go} NULL NULL")
    if deck.chance(0.2):
        other, still = deck.name("r"), deck.name("r")
        deck.add(f"region {other} {words}", f"region {still} {region_words(deck)}", f"region {name} {deck.pick('union', 'intersect')} 2 {other} {still}{side}")
    else:
        deck.add(f"region {name} {words}{side}")
    return name


def more_regions(deck):
    """A region of any kind, with its name: for groups, computes and chunks, not for walls."""
    nx, ny, nz = deck.cells
    name = deck.name("r")
    side = deck.pick("", "", " side out", " side in")
    low_z, high_z = ("-0.25", "0.25") if deck.dimension == 2 else ("0.31", f"{nz - 0.4:.3g}")
    z_middle = 0 if deck.dimension == 2 else nz / 2
    kind = deck.pick("plane", "prism", "cone", "half", "union", "intersect", "cylinder", "words", "box units", "edge", "three")
    if kind == "plane":
        deck.add(f"region {name} plane {nx / 2} {ny / 2} {z_middle} {deck.number(-1, 1)} {deck.number(0.2, 1)} 0{side}")
    elif kind == "prism":
        deck.add(f"region {name} prism 0.3 {nx - 0.9:.3g} 0.4 {ny - 0.3:.3g} {low_z} {high_z} {deck.number(-1, 1)} 0 0{side}")
    elif kind == "half":
        deck.add(f"region {name} block INF {nx * 0.51:.4g} INF {ny * 0.73:.4g} INF INF{side}")
    elif kind == "edge" and not deck.is_tilted:
        deck.add(f"region {name} block EDGE {nx * 0.47:.4g} {ny * 0.13:.4g} EDGE EDGE EDGE{side}")
    elif kind == "box units":
        deck.add(f"region {name} block {deck.number(0.2, 1, 'length')} {deck.number(3, 5, 'length')} INF INF INF INF units box{side}")
    elif kind == "cone" and deck.dimension == 3:
        deck.add(f"region {name} cone {deck.pick('x', 'y')} {ny / 2} {nz / 2} {deck.pick(deck.number(0.3, 1), 0)} {deck.number(1.2, 2.5)} 0.3 {min(nx, ny) * 0.7:.3g}{side}")
    elif kind == "cylinder" and deck.dimension == 3:
        deck.add(f"region {name} cylinder {deck.pick('x', 'y')} {ny / 2} {nz / 2} {deck.number(1, 2)} INF INF{side}")
    elif kind in ("union", "intersect"):
        one, two = deck.name("r"), deck.name("r")
        deck.add(f"region {one} {region_words(deck)}", f"region {two} block {nx * 0.36:.4g} INF INF INF INF INF{deck.pick('', ' side out')}",
                 f"region {name} {kind} 2 {one} {two}{side}")
    elif kind == "three":
        one, two = more_regions(deck), more_regions(deck)
        deck.add(f"region {deck.name('r')} sphere {nx * 0.4:.3g} {ny * 0.45:.3g} {z_middle} {min(nx, ny) * 0.37:.3g}")
        three = deck.lines[-1].split()[1]
        deck.add(f"region {name} {deck.pick('union', 'intersect')} 3 {one} {two} {three}{side}")
    else:
        deck.add(f"region {name} {region_words(deck)}{side}")
    return name


def add_atoms(deck):
    """Atoms on the lattice, in all of the box or away from its faces, their types, masses and more; then a little disorder."""
    deck.is_inner = not deck.is_periodic() or deck.chance(0.3)
    n_most = deck.n_types
    more = deck.pick("", "", "", f" basis 1 {n_most}", f" ratio 0.9 {deck.seed()}", f" subset {deck.random.randint(60, 90)} {deck.seed()}")
    if BASIS[deck.lattice] < 2 and "basis" in more:
        more = ""
    if deck.is_inner:
        deck.add(f"region in {region_words(deck)}", f"create_atoms 1 region in{more}")
    else:
        deck.add(f"create_atoms 1 box{more}")
    add_types(deck)
    reach = deck.value(0.03, "length")
    deck.add(f"displace_atoms all random {reach} {reach} {reach if deck.dimension == 3 else 0} {deck.seed()} units box")
    if deck.chance(0.06) and not deck.is_turned:
        deck.add(f"replicate {deck.pick('2 1 1', '1 2 1', '1 1 1')}{deck.pick('', ' bbox') if deck.is_periodic() else ''}")
    if deck.chance(0.15):
        add_settings(deck)


def add_types(deck):
    """Types of atoms, their masses, sizes and directions."""
    if deck.n_types >= 2:
        deck.add(*deck.pick(["set group all type/fraction 2 0.3 4711"], ["set group all type/ratio 2 0.4 991"], ["set type 1 type/subset 2 40 123"],
                            [f"region half block INF {deck.cells[0] * 0.51:.4g} INF INF INF INF", "set region half type 2"],
                            ['variable kind atom "1+(id%2)"', "set group all type v_kind"], ["set atom 20*60 type 2"]))
    if deck.n_types == 3:
        deck.add("set type 1 type/fraction 3 0.25 77")
    if deck.is_sphere():
        how = deck.pick("density", "density", "mass", "density/disc" if deck.dimension == 2 else "density")
        size = deck.number(1, 3, "density") if how != "mass" else deck.number(0.5, 2, "mass")
        if how == "density/disc":
            size = f"{deck.random.uniform(1, 2) * deck.scales['mass'] / deck.scales['length']**2:.3g}"
        deck.add(f"set group all diameter {deck.number(0.9, 1.1, 'length')}", f"set group all {how} {size}")
        deck.add("mass * 1.0" if deck.is_dipole() else "")  # not used, but written to data files
        turn = deck.number(0.3, 2, "rate")
        deck.add(f"set group all omega {'0 0' if deck.dimension == 2 else turn + ' -' + turn} {turn}" if deck.chance(0.7) else "")
    elif deck.n_types > 1 and deck.chance(0.2):
        deck.add(f"mass * {deck.value(1.5, 'mass')}")
    else:
        deck.add(*(f"mass {kind} {deck.value(deck.pick(1.0, 1.0, 2.0, 0.5), 'mass')}" for kind in range(1, deck.n_types + 1)))
    if deck.is_dipole():
        deck.add(f"set group all dipole/random {deck.seed()} 1.0" if deck.chance(0.7) else "set group all dipole 0.6 0.8 0.0")


def add_removals(deck):
    """Atoms are removed, or one is added and those near it removed, before there is anything that counts them."""
    if not deck.chance(0.15):
        return
    if deck.chance(0.3):
        deck.add(f"create_atoms 1 single {' '.join(f'{x + 0.13:.3f}' if i < deck.dimension else '0' for i, x in enumerate(deck.middle()))}",
                 f"delete_atoms overlap {deck.value(0.8, 'length')} all all")
        return
    choices = [f"delete_atoms region {more_regions(deck)}", f"delete_atoms porosity {more_regions(deck)} 0.2 {deck.seed()}",
               f"delete_atoms overlap {deck.value(0.9, 'length')} all all"]
    deck.add(deck.random.choice(choices) + deck.pick("", " compress no", " compress yes"))


def add_settings(deck):
    """Values of atoms by command set."""
    value = deck.value(0.4, "velocity")
    choices = [f"set group all vx {value}", f"set atom 7*90 vy {value} vx -{value}", f"set type 1 x v_place",
               f"set region {more_regions(deck)} vx v_swirl"]
    if deck.boundary[0] == "p":
        choices.append(f"set atom 3 image {deck.pick(1, -1, 2)} {'NULL' if deck.boundary[1] != 'p' else 1} NULL")
    deck.add("variable place atom x*1.0001", "variable swirl atom vy*0.5-vx", deck.random.choice(choices))


def add_velocities(deck):
    words = deck.pick("", " loop geom", " dist gaussian", " mom no", " rot yes", " loop geom dist gaussian rot yes",
                      " dist uniform", " loop local", " mom no rot yes", " sum yes", " temp warm", " loop all dist gaussian mom no")
    if deck.is_tilted:  # where wrapping displaced atoms changes the last bit of their places, from which loop geom draws
        words = words.replace(" loop geom", "")
    if "temp warm" in words:
        deck.add("compute warm all temp")
    deck.add(f"velocity all create {deck.number(0.3, 2, 'temperature')} {deck.seed()}{words}")
    for _ in range(deck.pick(0, 0, 0, 1, 1, 2)):
        deck.add(velocity_change(deck))


def velocity_change(deck, group="all"):
    v, t = deck.value(0.3, "velocity"), deck.number(0.5, 1.5, "temperature")
    deck.add("variable wind atom vy*0.1+0.2*vx" if not deck.has("variable wind") else "")
    return deck.pick(f"velocity {group} ramp vx 0 {v} y 0 {deck.cells[1]} units box", f"velocity {group} set {v} NULL 0.0 sum yes units box",
                     f"velocity {group} scale {t}", f"velocity {group} zero linear", f"velocity {group} zero angular",
                     f"velocity {group} set v_wind NULL NULL", f"velocity {group} set 0.1 0.2 NULL",
                     f"velocity {group} ramp vy -0.1 0.1 x 1 3 sum yes", f"velocity {group} create {t} {deck.seed()} sum yes")


def add_groups(deck):
    """Groups g1, ... by type, id, region and variable, and of other groups; sometimes pairs within one are left out."""
    for _ in range(deck.pick(0, 1, 2, 3)):
        add_group(deck)
    if len(deck.groups) > 1 and deck.chance(0.15):
        deck.add(deck.pick(f"neigh_modify exclude group {deck.groups[1]} {deck.groups[1]}",
                           f"neigh_modify exclude group all {deck.groups[1]}", "neigh_modify exclude type 1 1"))


def add_group(deck):
    name = deck.name("g")
    kinds = ["id 1:100", "id 1:200:3 250 251", "id <= 150", "id <> 20 170", "id > 40", "id != 50", "region", "region", "variable", "variable", "type 1",
             "type <= 2", "id 5 6:30 70:200:7"]
    kinds += ["type 2", "type <> 1 2", "type != 1", "type > 1"] if deck.n_types >= 2 else []
    kinds += [f"subtract all {deck.groups[-1]}", f"union {deck.groups[-1]} {deck.groups[1]}", f"intersect all {deck.groups[-1]}",
              f"intersect {deck.groups[1]} {deck.groups[-1]}"] if len(deck.groups) > 1 else []
    kind = deck.random.choice(kinds)
    if kind == "region":
        kind = f"region {more_regions(deck)}"
    elif kind == "variable":
        formula = deck.pick("vx>0", "(x<xcm(all,x))&&(type==1)", "id%3==1", f"gmask({deck.groups[-1]})==0",
                            f"rmask({more_regions(deck)})", f"grmask({deck.groups[-1]},{more_regions(deck)})", "random(0,1,77)<0.5&&0||y>xcm(all,y)")
        kind = f"variable {name}"
        deck.add(f'variable {name} atom "{formula}"')
    deck.add(f"group {name} {kind}")
    if deck.chance(0.1):
        deck.add(f"group {name} {deck.pick('id 3:60', 'type 1', 'clear')}", f"group {name} id 10:90")
    if deck.chance(0.08):
        add_dynamic_group(deck, name)
    deck.groups.append(name)


def add_dynamic_group(deck, name):
    """The group's atoms are chosen anew every few steps."""
    every = deck.pick("", " every 1", " every 3")
    formula = deck.pick("vx>0", "x>y", "(id%4==1)||(vy>0)")
    deck.add(f'variable {name}v atom "{formula}"', f"group {name} dynamic all {deck.pick(f'var {name}v', f'region {more_regions(deck)}', f'var {name}v region {more_regions(deck)}')}{every}")
