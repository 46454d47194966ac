"""Thermo output, averages and dumps of a random deck."""
from random_decks.system import live_region

KEYWORDS = ("ke etotal pxx pyy pxy vol lx ly xlo xhi ylo yhi density enthalpy evdwl atoms fmax fnorm cella cellb dt time "
            "elapsed elaplong ecouple econserve epair emol etail ecoul ebond eimp bonds part xlat ylat cellalpha cellbeta cellgamma zlo zhi lz").split()


def add_thermo(deck):
    thermo_words(deck)
    n = deck.pick(5, 10, 3, 0, 1, 7)
    deck.add(f"thermo {n}")
    if deck.chance(0.06):
        deck.add("variable when equal stride(0,100000,4)", "thermo v_when")


def thermo_words(deck):
    keywords = KEYWORDS + (["pzz", "pxz", "pyz", "zlat", "cellc"] if deck.dimension == 3 else [])
    keywords += ["xy"] if deck.is_tilted else []
    chosen = deck.random.sample(keywords, deck.random.randint(4, 9))
    columns = ["step", "temp", "pe", "press", *deck.columns, *chosen]
    if deck.chance(0.1):
        deck.add(deck.pick("thermo_style one", "thermo_style multi"))
        columns = ["step"] * 6
    else:
        deck.add(f"thermo_style custom {' '.join(columns)}")
    line = " ".join("%8d" if column in ("step", "atoms", "bonds", "part", "elapsed", "elaplong") else "%.9g" for column in columns)
    is_custom = "custom" in deck.lines[-1]
    deck.add("thermo_modify " + deck.pick("norm no", "norm yes", "norm no format float %20.13g", "lost warn", "format 2 %.10g", "flush yes", "norm no",
                                          f"format line '{line}'" if is_custom else "norm no", "format float %.11e format int %12d", "format none",
                                          "lost ignore norm yes", "lost error", "line one", "format 1 %07d format 3 %15.10f" if is_custom else "norm yes"))
    if deck.chance(0.12):
        deck.add(f"compute other{deck.n_names} all {deck.pick('temp/com', 'temp/partial 1 1 0', 'temp')}", f"thermo_modify temp other{deck.n_names}")


def add_averages(deck):
    """Files of averages of what thermo output shows, histograms and correlations."""
    for _ in range(deck.pick(0, 0, 0, 1, 1, 2)):
        add_average(deck)


def add_average(deck):
    numbers = [column for column in deck.columns if column.startswith(("c_", "v_", "f_"))] + ["c_thermo_temp", "c_thermo_press", "c_thermo_press[1]"]
    value, other = deck.random.choice(numbers), deck.random.choice(numbers)
    name = deck.name("f")
    span = f"{deck.value(-3, 'velocity')} {deck.value(3, 'velocity')}"
    per_atom = deck.random.choice([v for v in deck.atom_values if v.startswith(("c_", "v_"))] or ["vx"])
    more = deck.pick("", "", "", " start 7", " ave running overwrite", " format ' %15.9g'", " title1 'first' title2 'second'", " ave running", " ave one", " ave window 2")
    unformatted = more.replace(" format ' %15.9g'", "")
    no_window = unformatted.replace("ave window 2", "ave running")
    choices = [f"ave/time 1 5 5 {value} {other} file t{name}.ave{more}", f"ave/time 2 3 10 {value} file t{name}.ave{more}",
               f"ave/time 1 2 4 {value} ave window 3 file t{name}.ave", f"ave/time 5 1 5 {value} off 1 file t{name}.ave",
               f"ave/time 1 1 1 {value} {other} c_thermo_temp file t{name}.ave{more}", f"ave/time 1 4 6 c_thermo_press[*] file t{name}.ave{more}",
               f"ave/time 1 2 2 c_thermo_press mode vector file t{name}.ave{more}",
               f"ave/correlate 2 4 8 {value} {other} type {deck.pick('auto', 'full', 'upper', 'lower', 'auto/upper', 'auto/lower')} file s{name}.ave{no_window}",
               f"ave/correlate 1 5 5 {value} prefactor 2.5 file s{name}.ave", f"ave/correlate 1 3 9 {value} {other} type auto/lower ave running file s{name}.ave",
               f"ave/histo 2 2 4 {span} 7 vx vy beyond {deck.pick('ignore', 'end', 'extra')} mode vector file h{name}.ave{unformatted}",
               f"ave/histo 1 5 10 {span} 5 vx mode vector ave running file h{name}.ave",
               f"ave/histo 3 2 6 -2 20 6 {per_atom} x mode vector kind peratom beyond {deck.pick('ignore', 'end', 'extra')} file h{name}.ave",
               f"ave/histo/weight 2 2 4 {span} 5 vx {per_atom} mode vector file h{name}.ave" if per_atom != "vx" else "vector 4 " + value,
               f"ave/histo 1 4 4 -10 10 6 {value} file h{name}.ave{unformatted}", "vector 3 " + value]
    words = deck.random.choice(choices)
    group = deck.group() if "vector" in words and "ave/h" in words else "all"
    deck.add(f"fix {name} {group} {words}")
    if words.startswith("ave/time 1 1 1 "):  # others have values at some steps only
        deck.columns += [f"f_{name}[1]", f"f_{name}[2]"]
    if words.startswith("ave/time") and "[*]" not in words and "mode vector" not in words and deck.chance(0.3):
        deck.add(f"variable {name} equal f_{name}{'' if len(words.split('file')[0].split()) == 5 else '[1]'}",
                 f"fix {name}p all print 10 \"at $(step): ${{{name}}} $(temp:%.8g)\" file p{name}.ave screen no")
    if words.startswith("vector"):
        deck.add(f"variable {name} equal {deck.pick('sum', 'ave', 'max', 'min', 'trap', 'slope')}(f_{name})+f_{name}[1]",
                 f"fix {name}p all print 9 \"${{{name}}}\" file p{name}.ave screen no" if deck.chance(0.5) else "")


ATTRIBUTES = ("id type x y z xs ys zs xu yu zu xsu ysu zsu ix iy iz vx vy vz fx fy fz mass element").split()


def add_dumps(deck):
    for _ in range(deck.pick(0, 0, 1, 1, 2)):
        if deck.chance(0.7):
            add_dump(deck)


def add_dump(deck):
    name = deck.name("d")
    columns = deck.random.sample(ATTRIBUTES, 6) + deck.atom_values
    columns += deck.pick([], ["mux", "muy", "mu"]) if deck.is_dipole() else []
    columns += deck.pick([], ["radius", "diameter", "omegax"]) if deck.is_sphere() else []
    columns += ["i_kind", "d_heat"] if deck.has(r"fix \S+ all property/atom") else []
    n, file = deck.pick(7, 5, 1, 10), f"{name}.dump"
    if deck.chance(0.15):
        file = f"{name}.*.dump"
    style = deck.pick(f"custom {n} {file} id " + " ".join(columns), f"atom {n} {file}", f"custom {n} {file} id x y z vx vy vz", f"xyz {n} {file}",
                      f"cfg {n} {name}.*.dump mass type {deck.pick('xs ys zs', 'xsu ysu zsu')} id {' '.join(columns[:3])}",
                      f"dcd {n} {name}.dcd" if deck.is_alone else f"atom {n} {file}", f"extxyz {n} {file} vx vy vz fx" if deck.is_alone else f"xyz {n} {file}")
    if deck.is_alone and deck.chance(0.2):
        deck.add(f"dump {name} {deck.group()} {deck.pick(f'h5md {n} {name}.h5 position velocity force', f'h5md {n} {name}.h5 image', f'image {n} {name}.*.ppm type type size 40 40')}")
        return
    if style.startswith("extxyz"):
        deck.add(f"dump {name} {deck.group()} {style}", deck.pick("", f"dump_modify {name} format float %.17g", f"dump_modify {name} first yes"))
        return
    if style.startswith("dcd"):
        deck.add(f"dump {name} all {style}", deck.pick("", f"dump_modify {name} unwrap yes", f"dump_modify {name} pbc yes"))
        return
    deck.add(f"dump {name} {deck.group()} {style}")
    is_custom, is_xyz, is_cfg = (style.startswith(kind) for kind in ("custom", "xyz", "cfg"))
    deck.add(f"dump_modify {name} sort id")
    elements = "element " + " ".join(["Ar", "Kr", "Xe"][:deck.n_types])
    more = ["", "first yes", "pbc yes", "every 4", "delay 8", "append yes", "flush no", "pad 5", "units yes", "time yes", "buffer no", "buffer yes"]
    more += [elements] if is_custom or is_xyz or is_cfg else []
    more += 3 * ["maxfiles 2", "maxfiles 1"] if ".*." in style else []
    if is_custom:
        more += 2 * ["format float %.9g", "format 2 %12.6g" if columns[0] not in ("id", "type", "element", "ix", "iy", "iz") else "format int %6d", "format int %5d"]
        more += ["sort -1", "sort 2" if columns[0] in ("x", "y", "vx", "vy", "xs", "ysu", "yu", "xu") else "sort 1", "format float %20.12e", "format none"]
    elif is_xyz:
        more += ["format line '%s %.8g %12.6f %g'"]
    elif is_cfg:
        more = [words for words in more if not words.startswith(("append", "pad", "units", "time"))] + ["format float %.9g"]
    else:
        more += 2 * ["scale no", "image yes", "scale no image yes", "format line '%d %d %.9g %.8g %.10g'"]
    for words in deck.random.sample(more, deck.pick(0, 1, 1, 2)):
        deck.add(f"dump_modify {name} {words}" if words else "")
    if is_custom and deck.chance(0.25):
        deck.add(f"dump_modify {name} " + deck.pick("thresh x > 2.5", "thresh type == 1", "thresh vx >= 0 thresh vy < 0.5", "thresh id != 10",
                                                    f"region {live_region(deck)}", "thresh v_sift > 0.1", "thresh none", "thresh vx < LAST", "thresh v_sift > LAST", "thresh ix != LAST",
                                                    "thresh v_slot != LAST thresh x > 2"))
        if "v_sift" in deck.lines[-1]:
            deck.lines.insert(-1, "variable sift atom x*0.1-vy*0.2")
        if "v_slot" in deck.lines[-1]:
            deck.lines.insert(-1, "variable slot atom floor(x*3)")
