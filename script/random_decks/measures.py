"""Computes of a random deck: of numbers, of values per atom, of chunks."""
from random_decks.formulas import atom_formula
from random_decks.system import live_region
from random_decks.pairs import OWN_PAIRS, PAIRS

# Computes with numbers of all of a group: words after the style, and the columns that they give.
GLOBAL_COMPUTES = {
    "temp": ("", ["", "[1]", "[4]"]), "temp/com": ("", ["", "[2]"]), "temp/partial": ("{axes}", ["", "[1]"]), "ke": ("", [""]),
    "temp/ramp": ("vx 0 {v} y 0 4 units box", [""]), "temp/profile": ("{flow} {bins}", ["", "[1]"]),
    "temp/region": ("{region}", ["", "[1]"]), "msd": ("{com}", ["[1]", "[4]"]), "vacf": ("", ["[4]", "[1]"]), "com": ("", ["[1]", "[2]"]),
    "gyration": ("", ["", "[4]"]), "pressure": ("thermo_temp{parts}", ["", "[1]", "[4]"]), "pressure virial": ("", ["", "[2]"]),
    "group/group": ("{group}{pair}", ["", "[1]"]), "pe": ("{energies}", [""]), "temp/deform": ("", ["", "[4]"]),
    "rdf": ("{pairs}", ["[7][2]", "[15][3]", "[4][1]"]), "heat/flux": ("", ["[1]", "[4]"]),
}
SPHERE_COMPUTES = {"erotate/sphere": ("", [""]), "temp/sphere": ("{turning}", ["", "[1]", "[4]"])}
DIPOLE_COMPUTES = {"dipole": ("{geometry}", ["", "[1]", "[3]"])}
ALL_ATOMS_ONLY = ("pressure", "pressure virial", "pe", "heat/flux")
# Computes with values per atom: words, number of columns (0: a vector).
ATOM_COMPUTES = {"stress/atom": ("{stress}", 6), "pe/atom": ("{energies_pair}", 0), "ke/atom": ("", 0), "coord/atom": ("cutoff {reach}{of}", 0),
                 "displace/atom": ("", 4), "cluster/atom": ("{reach}", 0), "centro/atom": ("{neighbors}", 0), "cna/atom": ("{reach}", 0),
                 "property/atom": ("x xu vx ix fx mass", 6), "property/atom ": ("id type xs ys vz iy", 6),
                 "property/atom  ": ("xu yu zs xs fy vy", 6),
                 "orientorder/atom": ("{order}", 2)}


def fill(deck, words):
    """Words of a compute with its blanks filled in."""
    if "{region}" in words:
        words = words.replace("{region}", live_region(deck))
    if "{of}" in words:
        of = deck.pick("", "", " 1", f" group {deck.group()}", " 1 2" if deck.n_types > 1 else " 1*")
        words = words.replace("{of}", of)
    plane = deck.dimension == 2
    bins = deck.pick("x 4", "y 3", "xy 3 2") + " out tensor" if plane or deck.chance(0.5) else deck.pick("z 5", "xz 2 3", "yz 2 3", "xyz 2 2 3") + deck.pick("", " out tensor")
    z = 0 if plane else 1
    pairs = deck.pick("20", "20 1 1", "30 * *", "25 1 *" if deck.n_types > 1 else "25 1 1 1 1", f"20 cutoff {deck.value(1.7, 'length')}")
    far = deck.value(1.7, "length")
    order = deck.pick(f"nnn 8 degrees 2 4 6 cutoff {far}", f"nnn NULL degrees 2 3 5 cutoff {far}", f"nnn 6 degrees 1 4 wl yes cutoff {far}",
                      f"nnn 8 degrees 2 4 6 wl/hat yes cutoff {far}", f"nnn 5 degrees 1 3 components 3 cutoff {far}")
    return words.format(turning=deck.pick("", " dof rotate", " dof all"), geometry=deck.pick("", "mass", "geometry"), axes=deck.pick("1 1 0", f"0 1 {z}", "1 0 0"), flow=deck.pick(f"1 1 {z}", "1 0 0", f"0 1 {z}"), v=deck.value(0.5, "velocity"),
                        bins=bins, com=deck.pick("", "com yes", "average yes", "com yes average yes"), group=deck.group(),
                        parts=deck.pick("", "", " ke", " virial", " pair", " ke pair fix", " fix"), energies=deck.pick("", "", "pair", "fix", "pair fix"),
                        energies_pair=deck.pick("", "", "pair", "pair fix"), stress=deck.pick("NULL", "NULL", "thermo_temp", "NULL virial", "NULL ke", "NULL pair", "thermo_temp ke pair"),
                        pair=deck.pick("", "", " pair yes", " kspace no"), pairs=pairs, order=order,
                        reach=deck.number(1.1, 1.25, "length"), neighbors=4 if plane else deck.pick("12", "fcc", "bcc", "8"))


def add_computes(deck):
    """Some computes of numbers and of values per atom, these reduced to a number, and chunks."""
    for _ in range(deck.pick(0, 1, 2, 3)):
        add_global_compute(deck)
    for _ in range(deck.pick(0, 0, 1, 2)):
        add_atom_compute(deck)
    if deck.chance(0.15):
        add_own_values(deck)
    if deck.chance(0.15):
        add_pair_energy(deck)
    if deck.chance(0.15):
        add_local_values(deck)
    if deck.is_alone and deck.chance(0.3):
        add_own_measures(deck)
    if deck.chance(0.15):
        add_kept_values(deck)
    if deck.chance(0.2):
        add_vectors(deck)
    if deck.chance(0.1):
        add_values_of_file(deck)
    if deck.chance(0.3):
        add_chunks(deck)


def add_global_compute(deck):
    computes = {**GLOBAL_COMPUTES, **(SPHERE_COMPUTES if deck.is_sphere() else {}), **(DIPOLE_COMPUTES if deck.is_dipole() else {})}
    style = deck.random.choice(list(computes) + (list(computes)[len(GLOBAL_COMPUTES):]) * 3)
    words, outputs = computes[style]
    if style == "rdf" and deck.pair in ("zero", "soft") or style == "heat/flux":
        add_heat_flux(deck)
        return
    name = deck.name("c")
    group = "all" if style in ALL_ATOMS_ONLY else deck.group()
    command = "pressure NULL virial" if style == "pressure virial" else f"{style} {fill(deck, words)}"
    deck.add(f"compute {name} {group} {command}".rstrip())
    if style.startswith("temp") and deck.chance(0.3):
        deck.add(f"compute_modify {name} {deck.pick('extra/dof 0', 'dynamic/dof yes', 'extra 2 dynamic yes', 'extra/dof 7')}")
    deck.columns += [f"c_{name}{output}" for output in outputs]


def add_pair_energy(deck):
    """What one of the pair styles adds to the energy."""
    line = [line for line in deck.lines if line.startswith("pair_style")][-1]
    style = deck.random.choice([word for word in line.split()[1:] if word in (*PAIRS, *OWN_PAIRS, "table")])
    number = f" {deck.pick(1, 2)}" if line.split().count(style) > 1 else ""
    name = deck.name("c")
    deck.add(f"compute {name} all pair {style}{number}{deck.pick('', ' epair', ' evdwl', ' ecoul')}")
    deck.columns.append(f"c_{name}")


def add_local_values(deck):
    """Local values of pairs, reduced to numbers that do not depend on which atom of a pair is the first."""
    name, total = deck.name("c"), deck.name("c")
    deck.add(f"compute {name} {deck.group()} pair/local dist eng force")
    modes = deck.pick("sum", "min", "max", "ave", "sumsq", "avesq")
    replace = " replace 1 2" if modes in ("min", "max") and deck.chance(0.5) else ""
    deck.add(f"compute {total} all reduce {modes} c_{name}[1] c_{name}[2] c_{name}[3]{replace}")
    deck.columns += [f"c_{total}[{column}]" for column in (1, 2, 3)]


def add_own_measures(deck):
    """Rows of pairs, and shapes, which not every lmp has or which it writes in the order of its lists."""
    pairs, ids, listed, gyration, shape, total = (deck.name(prefix) for prefix in ("l", "l", "l", "c", "c", "c"))
    group = deck.group()
    cutoff = deck.pick("", "", " cutoff radius") if deck.is_sphere() else ""
    deck.add(f"compute {pairs} {group} pair/local dist dx dy dz eng force fx fy fz{cutoff}",
             f"compute {ids} {group} property/local patom1 patom2 ptype1 ptype2{cutoff}",
             f"compute {listed} {deck.group()} property/local natom1 ntype2",
             f"compute {gyration} {group} gyration", f"compute {shape} {group} gyration/shape {gyration}",
             f"compute {total} all reduce {deck.pick('sum', 'max', 'ave')} c_{listed}[1] c_{listed}[2]")
    deck.columns += [f"c_{shape}[{deck.random.randint(1, 6)}]", f"c_{total}[1]"]
    if deck.chance(0.5):
        name = deck.name("c")
        deck.add(f"compute {name} {group} msd/nongauss{deck.pick('', ' com yes')}")
        deck.columns += [f"c_{name}[1]", f"c_{name}[3]"]
    if deck.dimension == 2 and deck.chance(0.6):
        name = deck.name("c")
        deck.add(f"compute {name} {group} hexorder/atom {deck.pick('', 'degree 4 nnn 4', 'nnn NULL cutoff ' + deck.value(1.5, 'length'))}".rstrip())
        deck.atom_values += [f"c_{name}[1]", f"c_{name}[2]"]
    if deck.chance(0.7):
        dump = deck.name("d")
        deck.add(f"dump {dump} all local {deck.pick(1, 4, 5)} {dump}.{deck.pick('', '*.')}dump index c_{ids}[*] c_{pairs}[*]",
                 deck.pick("", f"dump_modify {dump} sort {deck.random.randint(2, 9)}", f"dump_modify {dump} label PAIRS format float %.12g"))
    if deck.chance(0.3):
        name = deck.name("f")
        far = deck.value(2, "length")
        deck.add(deck.pick(f"fix {name} all ave/histo 2 2 4 0 {far} 6 c_{pairs}[1] mode vector kind local file h{name}.ave",
                           f"fix {name} all ave/histo/weight 1 3 3 0 {far} 5 c_{pairs}[1] c_{pairs}[5] mode vector kind local file h{name}.ave"))


def add_vectors(deck):
    """Vectors, their elements by slice, by the number of an atom, and in formulas."""
    for style in deck.random.sample(["msd", "msd com yes", "vacf"] + ["rdf 6"] * (deck.pair not in ("zero", "soft")), 2):
        name = deck.name("c")
        deck.add(f"compute {name} all {style}")
        deck.vectors.append(f"c_{name}[2]" if style.startswith("rdf") else f"c_{name}")
    one, other = deck.random.choice(deck.vectors), deck.random.choice(deck.vectors)
    name, kind, given, total, formula = (deck.name(prefix) for prefix in ("s", "c", "c", "c", "v"))
    deck.add(f"compute {name} all slice {deck.pick('1 4 1', '2 4 2', '1 3 2')} {one}",
             deck.pick(f"compute {kind} all property/atom type", f'variable {kind} atom "id%6"'))
    index = f"c_{kind}" if deck.lines[-1].startswith("compute") else f"v_{kind}"
    deck.add(f"variable {formula} vector \"{deck.pick('{one}*2+1', 'abs({one})^0.5+temp', '{one}*{one}-{one}/3', 'ramp(0,1)*{one}').replace('{one}', one)}\"",
             f"compute {given} {deck.group()} global/atom {index} {one} {other} v_{formula}",
             f"compute {total} {deck.group()} reduce {deck.pick('sum', 'max')} c_{given}[1] c_{given}[3]")
    deck.columns += [f"c_{name}[1]", f"c_{total}[1]", f"c_{total}[2]", f"v_{formula}[2]"]
    deck.atom_values += [f"c_{given}[{deck.pick(1, 2, 3)}]"]
    number = deck.name("v")
    deck.add(f"variable {number} equal {deck.pick('sum', 'ave', 'max', 'min', 'trap', 'slope')}(v_{formula})")
    deck.columns.append(f"v_{number}")


def add_values_of_file(deck):
    """Values per atom from a file."""
    name, other = deck.name("q"), deck.name("v")
    file = f"{name}.txt"
    deck.add(f'print "3" file {file} screen no', *(f'print "{atom} {deck.number(-2, 2)}" append {file} screen no' for atom in deck.random.sample(range(1, 20), 3)),
             f"variable {name} atomfile {file}", f'variable {other} atom "v_{name}*{deck.pick("x", "vy", "type")}+v_{name}"')
    deck.atom_values += [f"v_{name}", f"v_{other}"]


def add_kept_values(deck):
    """Values of atoms that are stored, or averaged over time."""
    name, total = deck.name("y"), deck.name("c")
    value = deck.random.choice(["vx"] + [value for value in deck.atom_values if value.startswith("c_")])
    kept = [f"store/state {deck.pick(0, 0, 3, 5)} {deck.pick('x', 'xu', 'vx', 'yu', 'type')} {value}{deck.pick('', ' com yes')}", f"ave/atom {deck.pick('1 1 1', '1 2 5', '2 3 10')} {value} {deck.pick('fx', 'vy')}"]
    deck.add(f"fix {name} {deck.group()} {deck.random.choice(kept)}", f'variable {name} atom "f_{name}[1]*2-f_{name}[2]"')
    deck.atom_values += [f"f_{name}[1]", f"f_{name}[2]", f"v_{name}"]


def add_heat_flux(deck):
    one, two, three, flux = (deck.name("c") for _ in range(4))
    deck.add(f"compute {one} all ke/atom", f"compute {two} all pe/atom", f"compute {three} all stress/atom NULL virial",
             f"compute {flux} {deck.group()} heat/flux {one} {two} {three}")
    deck.columns += [f"c_{flux}[{deck.pick(1, 2, 4, 5)}]"]


def add_atom_compute(deck):
    style = deck.random.choice(list(ATOM_COMPUTES))
    if style == "orientorder/atom" and deck.dimension == 2:
        style = "coord/atom"
    words, n_columns = ATOM_COMPUTES[style]
    name, total = deck.name("c"), deck.name("c")
    group = "all" if style in ("pe/atom", "stress/atom") and deck.chance(0.6) else deck.group()
    words = fill(deck, words)
    if style == "coord/atom" and words.split()[2:3] and words.split()[2:3] != ["group"]:
        n_columns = len(words.split()) - 2 if len(words.split()) > 3 else 0
    deck.add(f"compute {name} {group} {style.strip()} {words}".rstrip())
    value = f"c_{name}" + (f"[{deck.random.randint(1, n_columns)}]" if n_columns else "")
    deck.atom_values.append(value)
    formula = deck.name("a")
    deck.add(f'variable {formula} atom "{atom_formula(deck, value)}"')
    deck.atom_values.append(f"v_{formula}")
    mode = deck.pick("sum", "min", "max", "ave", "sumsq", "avesq")
    where = f"reduce/region {live_region(deck)}" if deck.chance(0.3) else "reduce"
    has_ties = "x*x+vy" not in deck.lines[-1]  # of which both programs take any
    replace = " replace 1 2" if mode in ("min", "max") and not has_ties else ""
    deck.add(f"compute {total} {deck.pick('all', deck.group())} {where} {mode} {value} v_{formula}{replace}")
    deck.columns += [f"c_{total}[1]", f"c_{total}[2]"]


def add_own_values(deck):
    """Values of fix property/atom."""
    name = deck.name("p")
    deck.add(f"fix {name} all property/atom i_kind d_heat{deck.pick('', ' ghost yes')}", f"set group {deck.group()} i_kind 3 d_heat {deck.number(0, 2)}",
             f'variable {name} atom "vx*2+id"', f"set type 1 d_heat v_{name}", f"compute {name} all property/atom i_kind d_heat",
             f"compute {name}s all reduce sum c_{name}[1] c_{name}[2]")
    deck.columns += [f"c_{name}s[1]", f"c_{name}s[2]"]
    deck.atom_values += [f"c_{name}[2]"]


def chunk_words(deck):
    """Words of compute chunk/atom."""
    units = "units reduced" if deck.is_tilted else deck.pick("units reduced", "units box", "units lattice")
    delta = {"units reduced": "0.2", "units box": deck.value(1.7, "length"), "units lattice": "1.3"}[units]
    origin = deck.pick("lower", "upper", "center", "0.0")
    z_middle = 0 if deck.dimension == 2 else deck.cells[2] / 2 * deck.spacing
    middle = f"{deck.value(deck.cells[0] / 2 * deck.spacing, 'length')} {deck.value(deck.cells[1] / 2 * deck.spacing, 'length')}"
    far = deck.value(3.3, "length")
    choices = ["type", "type limit 2 max", "type limit 5 exact compress yes", f"bin/1d {deck.pick('x', 'y')} {origin} {delta} {units}",
               f"bin/2d x {origin} {delta} y lower {delta} {units}",
               "bin/1d x lower 0.1 units reduced discard yes bound x 0.2 0.8", "bin/1d y lower 0.15 units reduced discard no bound y 0.2 upper",
               f"bin/1d x lower {delta} {units} discard {deck.pick('yes', 'no', 'mixed')} ids {deck.pick('once', 'every', 'nfreq')}",
               f"bin/1d x lower {delta} {units} nchunk once ids once",
               f"v_part limit 4 {deck.pick('max', 'exact')}", "v_part nchunk every compress yes", f"region {delta} {units}"]
    if not deck.is_tilted:
        choices.append(f"bin/sphere {middle} {deck.value(z_middle, 'length')} {deck.value(0.2, 'length')} {far} 5 units box discard {deck.pick('yes', 'no', 'mixed')}")
    if deck.dimension == 3 and not deck.is_tilted:
        choices.append(f"bin/cylinder z lower {deck.value(1000, 'length')} {middle} {deck.value(0.2, 'length')} {far} 5 units box discard yes")
        choices.append(f"bin/cylinder z lower {deck.value(1.5, 'length')} {middle} 0 {far} 3 units box pbc {deck.pick('yes', 'no')}")
    if deck.dimension == 3:
        choices.append(f"bin/3d x lower {delta} y lower {delta} z lower {delta} {units} compress yes ids every")
    words = deck.random.choice(choices)
    if words.startswith("region"):
        words = f"bin/1d x lower {delta} {units} region {live_region(deck)}"
    if "v_part" in words:
        deck.add('variable part atom "1+(id%3)+2*(x>3)"')
    return words


CHUNK_COMPUTES = ["com/chunk", "vcm/chunk", "gyration/chunk", "inertia/chunk", "angmom/chunk", "omega/chunk", "torque/chunk", "msd/chunk",
                  "property/chunk", "temp/chunk", "reduce/chunk", "temp", "spread", "spread"]


def add_chunks(deck):
    """A compute chunk/atom, what is measured of its chunks, and files of both."""
    chunks, values = deck.name("k"), deck.name("k")
    place = deck.name("k")
    deck.add(f"compute {chunks} {deck.group()} chunk/atom {chunk_words(deck)}", f"compute {place} all property/atom x vy")
    if deck.chance(0.5):
        add_chunk_profile(deck, chunks)
        return
    style = deck.random.choice(CHUNK_COMPUTES + (["dipole/chunk"] * 4 if deck.is_dipole() else []))
    group = deck.pick("all", deck.group())
    if style == "spread":
        other, total = deck.name("k"), deck.name("k")
        deck.add(f"compute {values} {group} {deck.pick('vcm/chunk', 'com/chunk', 'angmom/chunk')} {chunks}",
                 f"compute {other} {deck.group()} chunk/spread/atom {chunks} c_{values}[1] c_{values}[{deck.pick(2, 3)}]",
                 f"compute {total} all reduce {deck.pick('sum', 'min', 'max')} c_{other}[1] c_{other}[2]")
        deck.columns += [f"c_{total}[1]", f"c_{total}[2]"]
        deck.atom_values.append(f"c_{other}[1]")
        return
    if style == "temp":
        deck.add(f"compute {values} all temp/chunk {chunks} com {deck.pick('yes', 'no')}{deck.pick('', ' adof 2', ' cdof 1')}")
        deck.columns.append(f"c_{values}")
        return
    words = {"property/chunk": f"{chunks} {deck.pick('count', 'count', 'id' if 'compress' in deck.lines[-2] else 'count')}",
             "temp/chunk": f"{chunks} {deck.pick('temp', 'temp kecom', 'temp kecom internal')}{deck.pick('', ' com yes', ' adof 2')}",
             "reduce/chunk": f"{chunks} {deck.pick('sum', 'min', 'max')} c_{place}[1] c_{place}[2]",
             "gyration/chunk": f"{chunks}{deck.pick(' tensor', '')}"}.get(style, chunks)
    is_vector = style == "property/chunk" or style == "gyration/chunk" and "tensor" not in words
    whole = f"c_{values}" if is_vector else f"c_{values}[*]"
    deck.add(f"compute {values} {group} {style} {words}",
             f"fix {deck.name('f')} all ave/time {deck.pick('2 2 6', '1 3 6', '3 1 3')} {whole} mode vector{deck.pick('', ' ave running', ' ave window 2')} file chunks.ave")


def add_chunk_profile(deck, chunks):
    choices = ["vx", "temp", "density/number", "density/mass", "fy", "vy", "vz", "temp"]
    choices += [value for value in deck.atom_values if value.startswith(("c_", "v_"))]
    more = deck.pick("", "ave running ", "ave window 2 ", "ave running overwrite ", "format ' %12.7g' ", "adof 2 ", "cdof 1 ", "title1 'a profile' ")
    deck.add(f"fix {deck.name('f')} {deck.group()} ave/chunk {deck.pick('2 3 6', '1 1 1', '1 5 5', '3 2 6')} {chunks} {' '.join(deck.random.sample(sorted(set(choices)), 3))} "
             f"norm {deck.pick('all', 'sample', 'none')} {more}file layers.ave")
