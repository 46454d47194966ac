"""Runs of a random deck, and what happens between them."""
import re

from random_decks.fixes import add_fixes
from random_decks.formulas import random_formula
from random_decks.measures import add_atom_compute, add_global_compute
from random_decks.output import add_average, add_dump, thermo_words
from random_decks.pairs import OWN_PAIRS, PAIRS, words_of
from random_decks.system import add_group, more_regions, velocity_change


def simple_runs(deck):
    """Runs, with changes of the system between them."""
    length = deck.value(0.01, "length")
    choices = [["run 20"], ["run 20"], ["run 12", "run 15"], ["run 10", "reset_timestep 0", "run 10"] if deck.may_reset() else ["run 20"],
               ["run 10", f"displace_atoms all move {length} 0 0 units box", "run 10"],
               ["run 10", "unfix int", "fix int all nve", "run 10"], ["run 10", f"delete_atoms group {deck.groups[-1]}", "run 10"],
               ['run 20 every 5 "print hi" "variable now equal step"'], ["run 10", "replicate 2 1 1", "run 10"] if not deck.keeps_places() else ["run 20"],
               ["run 10", "run 25 upto"], ["run 10 start 0 stop 30", "run 20 start 0 stop 30"], ["run 10", "run 10 pre no post no"],
               ["run 10 post no", "run 5 pre no", "run 7 pre yes post yes"], ["run 0", "run 15"], ["run 0 post no", "run 12 start 0 stop 100"],
               ["run 20 every 10 NULL"], ["run 18 every 6 \"print 'T $(temp:%.6g) at $(step)' append printed.ave\""],
               ["run 20 upto every 7 'velocity all zero linear'"], ["run 10 upto", "run 30 upto start 0 stop 50"],
               ["run 10", "velocity all scale " + deck.value(0.9, "temperature"), "run 10"],
               ["run 10", "set type 1 vx 0.0", "run 8"], ["run 10", "timestep " + deck.value(0.003, "time"), "run 10"],
               ["run 10", "neighbor " + deck.value(0.35, "length") + " bin", "run 10"]]
    runs = deck.random.choice(choices)
    is_gone = any(line.startswith("delete_atoms group all") for line in runs)
    deck.add(*(["run 15"] if is_gone or (runs[1:2] == ["unfix int"] and deck.integrator == "sllod") else runs))


def run_words(deck):
    n = deck.random.randint(3, 14)
    return f"run {n}" + deck.pick("", "", "", " post no", f" start 0 stop {n + 60}", " every 4 NULL")


def change_fixes(deck):
    """A fix ends, a new one comes, or one is defined anew with its ID."""
    old = [line.split()[1] for line in deck.lines if re.match(r"fix e\d+ ", line)]
    old = [name for name in old if not any(re.search(rf"\bf_{name}\b|unfix {name}\b", line) for line in deck.lines)]
    if old and deck.chance(0.6):
        deck.add(f"unfix {deck.random.choice(old)}")
    else:
        add_fixes_later(deck)


def add_fixes_later(deck):
    """More fixes, which have no column in the table that is there."""
    kept = list(deck.columns)
    add_fixes(deck)
    deck.columns = kept


def change_computes(deck):
    deck.columns = [column for column in deck.columns if not column.startswith("f_") or not deck.has(rf"unfix {re.escape(column[2:].split('[')[0])}$")]
    deck.pick(add_global_compute, add_atom_compute)(deck)
    thermo_words(deck)


def change_pairs(deck):
    style = deck.pair
    if style == "table" or style in OWN_PAIRS:
        return
    if style in PAIRS and deck.chance(0.5):
        deck.add(f"pair_coeff * * {words_of(deck, PAIRS[style][1])}".rstrip())
    elif style in PAIRS and style not in ("soft", "zero") and not deck.has(r"fix \S+ \S+ adapt"):
        deck.add(f"pair_style lj/cut {words_of(deck, ['cutoff'])}", f"pair_coeff * * {deck.value(1, 'energy')} {deck.value(1, 'length')}")
        deck.pair = "lj/cut"
    else:
        deck.add("pair_modify shift yes")


def change_output(deck):
    dumps = [line.split()[1] for line in deck.lines if line.startswith("dump d")]
    dumps = [name for name in dumps if f"undump {name}" not in deck.lines]
    if dumps and deck.chance(0.5):
        name = deck.random.choice(dumps)
        deck.add(deck.pick(f"undump {name}", f"dump_modify {name} every 3", f"dump_modify {name} sort off sort id"))
    else:
        deck.pick(add_dump, add_average)(deck)


def change_system(deck):
    """Atoms, velocities, groups, lists."""
    length = deck.value(0.01, "length")
    middle = " ".join(deck.value(x * deck.spacing, "length") for x in deck.middle())
    choices = [velocity_change(deck, deck.group()), f"displace_atoms {deck.group()} ramp y 0 {length} x 1 2",
               f"displace_atoms all ramp x 0 {length} y 0 3 units box", f"displace_atoms {deck.group()} rotate {middle} 0 0 1 0.3 units box",
               f"displace_atoms {deck.group()} move v_shove 0 0 units box",
               f"set group {deck.group()} vy {deck.value(0.1, 'velocity')}", f"timestep {deck.value(0.002, 'time')}",
               f"neighbor {deck.number(0.3, 0.5, 'length')} bin", "neigh_modify delay 2 every 2 check yes", "neigh_modify every 1 delay 0 check no",
               "reset_timestep 100" if deck.may_reset() else "info all out log", "info groups regions", "thermo 4",
               f"write_dump all custom w{deck.name('w')}.dump id type x y z vx vy modify sort id format float %.10g",
               f"write_dump {deck.group()} atom w{deck.name('w')}.dump modify scale no sort id", "comm_modify vel yes",
               f"print 'step $(step) ke $(ke:%.9g) box $(lx:%.8g)' append printed.ave screen no"]
    if deck.n_types > 1:
        choices += ["set type 2 type 1", f"set group {deck.groups[-1]} type 2"]
    choices += ["write_coeff written.coeff", "timer full", "balance 1.1 shift xy 5 1.05", "balance 1.0 x uniform"]
    choices += changes_of_atoms(deck)
    words = deck.random.choice(choices)
    if "v_shove" in words and not deck.has("variable shove"):
        deck.add(f"variable shove atom {length}*(id%2)")
    deck.add(words)
    if deck.chance(0.15):
        add_group(deck)


def changes_of_atoms(deck):
    """Atoms that come and go between runs, unless something remembers where each was."""
    if deck.keeps_places() or deck.has(r"fix \S+ \S+ (ave/chunk|ave/histo|store)|compute \S+ \S+ \S*/chunk|dump "):
        return []
    choices = [f"delete_atoms region {more_regions(deck)}", "reset_atom_ids", "reset_atom_ids sort no"]
    choices += [f"delete_atoms group {deck.group()} compress no"] if len(deck.groups) > 1 else []
    if deck.integrator == "nve/limit" or deck.pair in ("soft", "gauss", "zero"):  # where atoms may be made upon others
        place = " ".join(f"{x + 0.29:.3f}" if i < deck.dimension else "0" for i, x in enumerate(deck.middle()))
        choices += [f"create_atoms 1 single {place}", f"create_atoms {deck.n_types} random 3 {deck.seed()} NULL"]
    return choices


def redefinitions(deck):
    """Several runs, between which nearly everything may change."""
    deck.add(run_words(deck))
    for _ in range(deck.pick(1, 2, 2, 3)):
        for _ in range(deck.pick(1, 1, 2, 3)):
            deck.pick(change_fixes, change_computes, change_computes, change_pairs, change_output, change_system, change_system)(deck)
        deck.add(run_words(deck))


def box_runs(deck):
    """Changes of the box between runs."""
    if not deck.is_periodic():
        deck.add("run 10", deck.pick("change_box all x scale 1.02", "change_box all y scale 1.01 remap"), "run 10")
        return
    length = deck.cells[0]
    changes = ["x scale 1.02 remap", f"x final 0 {length * 1.02:.4g} remap", "y delta -0.1 0.1 remap", "x scale 1.01 y volume remap", "set x delta 0 0.1 remap",
               "x scale 1.01 remap y scale 1.02 remap", f"y delta 0 {deck.value(0.2, 'length')} remap units box", "x scale 1.01 remap set y scale 0.99 remap"]
    changes += ["x scale 1.01 y volume z volume remap", "z scale 1.01 remap"] if deck.dimension == 3 else []
    if deck.is_tilted:
        changes += ["xy delta 0.2 remap", "xy final 0.1 remap", "xy final 0 remap"]
    elif not deck.is_turned:
        changes += ["triclinic", "triclinic xy final 0.3 remap", "triclinic xy delta 0.2"]
    for _ in range(deck.pick(1, 1, 2)):
        deck.add("run 8", f"change_box {deck.pick('all', 'all', deck.group())} {deck.random.choice(changes)}")
    deck.add("run 10")


def minimizations(deck):
    if any(re.match(r"fix \S+ \S+ (addforce|setforce|aveforce|flow|gravity v_|spring (tether|couple))", line) for line in deck.lines):
        deck.add("run 20")  # whose energy is not known
        return
    if any("remap v" in line for line in deck.lines):
        deck.add("run 18")
        return
    style = deck.pick("cg", "sd", "fire", "quickmin", "fire/old")
    deck.add(f"min_style {style}")
    words = [f"dmax {deck.value(0.05, 'length')}", "norm max", "norm inf", "norm two"]
    words += ["line backtrack", "line quadratic"] if style in ("cg", "sd") else []
    words += ["integrator verlet", "integrator leapfrog", "integrator eulerexplicit", "tmax 4", "tmin 0.1", "delaystep 3", "dtgrow 1.2", "dtshrink 0.4",
              "alpha0 0.2", "alphashrink 0.9", "halfstepback no", "initialdelay no"] if style == "fire" else []
    chosen = deck.random.sample(words, deck.pick(0, 0, 1, 2))
    deck.add(f"min_modify {' '.join(chosen)}" if chosen else "")
    limits = f"{deck.value(1e-4, 'force')} {deck.pick(10, 15)} {deck.pick(100, 100, 12) if style in ('cg', 'sd') else 100}"
    if style in ("cg", "sd") and deck.is_periodic() and deck.integrator == "nve" and deck.chance(0.5):
        kinds = ["iso", "aniso"] if deck.dimension == 3 else ["x", "y"]
        more = deck.pick("", "", " nreset 4", " dilate partial", " fixedpoint 0 0 0")
        deck.add(f"fix relax all box/relax {deck.random.choice(kinds)} {deck.value(0.5, 'pressure')} vmax 0.001{more}",
                 f"minimize 0 {limits}", "unfix relax", "run 5")
        return
    deck.add(f"minimize {deck.pick('0', '1e-5', '1e-8')} {limits}")
    if deck.chance(0.3):
        deck.add(f"min_style {deck.pick('cg', 'sd')}", f"minimize 0 0 5 50")
    deck.add("run 10")


def loops(deck):
    """Runs in a loop, with a condition in it and a file that is included."""
    deck.add('print "run 4" file part.in', "variable i loop 4", "label again", "include part.in",
             'if "$i == 2" then "velocity all zero linear" elif "$i == 3" "variable now equal temp" else "print $i"',
             "print $(v_i+step:%.3f)", "next i", "jump SELF again")


def language(deck):
    """Variables of all styles, conditions, nested loops, quotes, formats: a deck that prints much and runs little."""
    formulas = [random_formula(deck) for _ in range(3)]
    deck.add("run 2", "variable a index 3 1 2", "variable w index one two three", "variable l loop 2 3", "variable p loop 12 pad", "variable s string 'two words'",
             "variable n internal 2.5", f"variable e equal {formulas[0]}", "variable f format e %12.6g", "variable g getenv HOME_THAT_IS_NOT",
             "variable t equal v_a+v_n", 'print "1 alpha" file words.txt', 'print "beta # gone" append words.txt', 'print "gamma" append words.txt',
             "variable r file words.txt", "label outer", "label inner",
             'print "a $a w ${w} l $l p $p e $(v_e:%.9g) r $r t $(v_t)" append printed.ave',
             f'print "$({formulas[1]}:%.8g) $({formulas[2]}:%.10e) ${{f}} $n ${{s}}" append printed.ave',
             deck.pick("""if "$a == 3 && ${w} == one" then 'print "first" append printed.ave' 'print "both" append printed.ave' else 'print "not" append printed.ave'""",
                       """if "$(v_a) > 1 || !($l == 2)" then "print 'yes' append printed.ave" elif "${w} != two" "print 'elif' append printed.ave" """,
                       """if "${w} == two |^ $a < 2" then &\n  "print 'cut' append printed.ave" &\n  "variable m equal $a*2" else "variable m equal 7" """,
                       """if $(is_defined(variable,m)) then "print 'm' append printed.ave" else "print 'no m' append printed.ave" """),
             "next l", "jump SELF inner", "variable l delete", "variable l loop 2", deck.pick("next a w r", "next a w p", "next r a"), "jump SELF outer",
             'print """several "words" $(step) and \'more\'""" append printed.ave', "variable m equal 4", "print '$m ${m}$m ${m}x' append printed.ave",
             f"variable m equal $m+{deck.random.randint(1, 9)}",
             "print '$m $(v_m^2) $(floor(v_m/3))' append printed.ave", "variable x string $m", 'if "$x > 5" then "run 3" else "run 4"',
             f"run $(2+v_m%{deck.pick(2, 3)})", deck.pick("quit", "jump SELF end", "") , "run 5", "label end", "print $(step) append printed.ave")


def rereads(deck):
    """What one run has written is read by another."""
    fields = "x y vx vy ix iy" if deck.dimension == 2 else "x y z vx vy vz ix iy iz"
    style = deck.pick("data", "data", "rerun", "rerun", "read_dump", "restart", "restart")
    if any("remap v" in line for line in deck.lines):  # where LAMMPS forgets to change velocities of atoms that it wraps before it writes
        style = deck.pick("rerun", "read_dump")
    if style == "restart":
        reread_restart(deck)
        return
    if style != "data" and deck.may_reset():
        scaled = deck.pick("", "", "u", "s")
        places = " ".join(f"{axis}{scaled}" for axis in "xyz")
        deck.add(f"dump out all custom 5 written.dump id type {places} vx vy vz ix iy iz", "dump_modify out sort id format float %.15g",
                 "run 10", "undump out")
        if style == "rerun":
            more = deck.pick("", "", "first 5", "every 5", "last 5", "skip 2", "start 0 stop 100", "first 5 last 10 post no")
            deck.add(f"rerun written.dump {more} dump {fields if scaled != 'u' else 'x y z vx vy vz'}")
        else:
            words = deck.pick("", "", "box no", "timestep no", "box no timestep no", "replace yes trim yes")
            deck.add(f"read_dump written.dump 5 {fields if scaled != 'u' else 'x y z vx vy vz'} {words}".rstrip(), "run 10")
        return
    if any("remap v" in line for line in deck.lines):
        deck.add("run 20")
        return
    again = again_lines(deck)
    styles = [line for line in again if line.startswith("pair_style")]
    coefficients = [line for line in again if line.startswith(("pair_coeff", "pair_modify"))]
    others = [line for line in again if line not in styles + coefficients]
    is_in_file = deck.pair in ("lj/cut", "morse", "yukawa") and deck.chance(0.3)  # coefficients are read after the style is known
    order = [*styles, "read_data written.data"] if is_in_file else ["read_data written.data", *styles, *coefficients]
    before = [line for line in others if line.startswith(("units", "dimension", "boundary", "atom_style", "newton"))]
    after = [line for line in others if line not in before]
    deck.add("run 10", f"write_data written.data {'pair ij' if is_in_file else 'nocoeff'}", "clear", *before, *order, *after,
             "fix int all nve", "thermo 5", "run 10")


def again_lines(deck):
    """What is said again after clear: settings and the pair style."""
    return [line for line in deck.lines if line.startswith(("units", "dimension", "boundary", "atom_style", "pair_style", "pair_coeff", "pair_modify", "neighbor",
                                                            "neigh_modify every", "neigh_modify delay", "timestep", "newton"))]


def reread_restart(deck):
    """The programs read their own restart files."""
    if not deck.is_periodic():  # LAMMPS makes shrink-wrapped boxes anew before it writes, and their margins when it has read
        deck.add("run 20")
        return
    write = deck.pick(["run 10", "write_restart written.restart"], ["restart 5 written.restart", "run 12", "restart 0"], ["run 7", "write_restart written.*"])
    name = {"written.restart": "written.restart", "written.*": "written.7"}.get(write[-1].split()[-1], "written.restart.10")
    settings = [line for line in again_lines(deck) if line.startswith(("neighbor", "neigh_modify"))]
    hybrid = [line for line in again_lines(deck) if line.startswith("pair_coeff")] if "hybrid" in deck.pair else []
    pairs = [line for line in again_lines(deck) if line.startswith(("pair_style", "pair_coeff", "pair_modify"))] if deck.pair == "zero" else hybrid
    if name.endswith(".10") and deck.has("variable a"):  # LAMMPS wraps atoms before it writes, in the midst of a run
        write, name = ["run 10", "write_restart written.restart"], "written.restart"
    deck.add(*write, "clear", "dimension 2" if deck.dimension == 2 else "", f"read_restart {name}", *pairs, *settings, deck.pick("fix int all nve", f"fix int all nve/limit {deck.value(0.04, 'length')}"),
             "thermo_style custom step temp pe press pxx lx atoms", "thermo 5", f"run {deck.pick(10, '20 upto')}")


def add_runs(deck):
    kinds = [simple_runs] * 3 + [redefinitions] * 4 + [box_runs, minimizations, loops, language, rereads, rereads]
    deck.random.choice(kinds)(deck)
