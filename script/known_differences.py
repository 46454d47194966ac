"""What script/compare-random knows: refusals of Halfshell that are meant, and places where LAMMPS is wrong or does something that is
deliberately not followed. docs/validation.md has the same list in words."""
import collections
import re

# Messages of Halfshell, and why it refuses what LAMMPS runs.
REFUSALS = [
    (r"counts steps", "read_dump changes the number of the step under a fix that counts steps, which goes wrong in LAMMPS"),
    (r"does not meet its own images", "an indenter that jumps where the tilted box ends"),
    (r"of which there is no snapshot", "averages in a rerun whose samples are not among the snapshots: LAMMPS averages what there is"),
    (r"has flown off since lists were made", "atoms of a system that has blown up, under a box that LAMMPS lets follow them"),
    (r"are outside of the walls", "atoms that are behind a reflecting wall when the run begins: LAMMPS puts them before it"),
    (r"bins must be slabs in units reduced", "chunks by distance in a box that has become tilted, which LAMMPS bins as if it had not"),
    (r"the format line has \d+ words but a row has", "LAMMPS leaves columns out that a format line has no words for"),
    (r"to the broken power", "a root of a negative number, which LAMMPS lets be nan"),
    (r"there is no atom of that ID", "LAMMPS takes 0 for values of atoms that are not there"),
    (r"whose members stay", "what remembers its atoms, or has lists of them, is given a dynamic group"),
    (r"is on or behind the wall", "an atom behind a wall, which LAMMPS's wall/lj1043 lets go"),
    (r"elements and has", "the number of chunks changes within a window of fix ave/time, for which LAMMPS holds it"),
]

# What differs and is known to. condition: pattern of the deck (None: any). culprit: pattern of lines of the deck, whose group "id" is the
# compute or fix that differs, so that only columns and files are excused that depend on it (None: any). column: pattern of the column
# or file (None: any).
Known = collections.namedtuple("Known", "condition culprit column reason")
NEIGHBORS = r"^compute (?P<id>\S+) \S+ (coord/atom|centro/atom|cluster/atom|orientorder/atom|group/group|rdf|pair/local)"
MEASURED = r"^compute (?P<id>\S+) \S+ (coord/atom|centro/atom|cluster/atom|orientorder/atom)"
BOX_CHANGES = r"fix \S+ all (deform|nvt/sllod|nph|npt|press)|^change_box"
KNOWN = [
    Known(r"^units lj(.|\n)*thermo_modify (?!norm no)|thermo_modify .*norm yes", None, r"^(Ecouple|Econserve)$",
          "LAMMPS does not divide the heat bath's energy by the number of atoms"),
    Known(r"fix int all n(pt|ph) .*\biso |^dimension 2(.|\n)*fix int all n(pt|ph) .*couple xy", None, r"^(Ecouple|Econserve)$",
          "isotropic barostats: LAMMPS counts their chain with as many kT as there are axes, while it acts with one"),
    Known(r"(prism|triclinic)(.|\n)*fix int all n(pt|ph) .*\b[xyz] ", None, r"^(Ecouple|Econserve)$",
          "strain energy in tilted boxes: LAMMPS's is not that of its forces, and not constant"),
    Known(None, r"^fix (?P<id>\S+) \S+ wall/region", None, "LAMMPS's energy and force of wall/region stay those of the first step"),
    Known(r"^run(.|\n)*^delete_atoms", r"^(?:dump|variable) (?P<id>\S+) (?:.*(?:custom|atom|xyz|cfg) |.*\[\d+\])", None,
          "delete_atoms after a run: LAMMPS numbers the atoms in the order that they have in memory; Halfshell in that of their ids"),
    Known(r"^delete_atoms", NEIGHBORS, None, "LAMMPS counts no neighbors for some atoms after delete_atoms"),
    Known(r"fix \S+ all (deform|nvt/sllod)", NEIGHBORS, None,
          "fix deform moves atoms before output; LAMMPS then measures distances to images that have not moved"),
    Known(r"fix \S+ all press/berendsen", r"^compute (?P<id>\S+) \S+ pair/local", None,
          "the box changes at the end of a step: LAMMPS tells pairs at the places after, Halfshell those of the step's forces"),
    Known(r"\A(?!(.|\n)*neigh_modify every 1 )", MEASURED, None,
          "LAMMPS measures pairs of its lists, which come late by neigh_modify; Halfshell all that are there"),
    Known(r"^group \S+ dynamic", NEIGHBORS, None, "dynamic groups: LAMMPS's periodic images keep the groups of the atoms when lists were made"),
    Known(r"prism", r"^compute (?P<id>\S+) \S+ coord/atom", None, "LAMMPS misses neighbors in tilted boxes whose ghosts end too near"),
    Known(None, r"^compute (?P<id>\S+) \S+ reduce/chunk \S+ sum", None, "LAMMPS's sums of the last chunk grow from one call to the next"),
    Known(None, r"^compute (?P<id>\S+) \S+ reduce/chunk \S+ (min|max)", None, "chunks without atoms: LAMMPS gives 1e20, Halfshell 0"),
    Known(r"prism|triclinic", r"^compute (?P<id>\S+) \S+ msd .*average yes", None,
          "with average yes in tilted boxes LAMMPS's displacements in y and z are not 0 before anything has moved"),
    Known(None, r"^compute (?P<id>\S+) \S+ msd .*average yes", None,
          "with average yes a step counts once in the mean places, in LAMMPS once for each who asks"),
    Known(r"^run(.|\n)*^displace_atoms", r"^compute (?P<id>\S+) \S+ temp/chunk", None,
          "first row after displace_atoms between runs: LAMMPS takes the chunks' velocities of before"),
    Known(None, r"^compute (?P<id>\S+) \S+ chunk/atom .*exact compress yes", None, "LAMMPS writes whatever is in memory for chunks that compression leaves empty"),
    Known(BOX_CHANGES + r"|^boundary .*[sm]", r"^fix (?P<id>\S+) \S+ ave/chunk .*density", None, "LAMMPS takes the box's volume at a window's start"),
    Known(r"^run .*every|^(run|minimize|include)(.|\n)*^(run|rerun|jump)", r"^(compute (?=\S+ \S+ (global|centro|chunk/spread)/atom)|variable (?=\S+ vector))(?P<id>\S+)", None,
          "first row of a later run: LAMMPS keeps what it had at that step, though the box or the time in the run has changed"),
    Known(None, r"^compute (?P<id>\S+) .*bin/(cylinder|sphere)", None, "LAMMPS leaves out atoms that have left the box since its last list"),
    Known(r"^boundary .*[sm]", r"^compute (?P<id>\S+) .*(compress yes|chunk/atom bin/)", None, "LAMMPS leaves out atoms that have left the box since its last list"),
    Known(None, r"^fix (?P<id>\S+) .*ave/histo.*ave running", r"column [56]$", "LAMMPS's extremes of running histograms begin at 0"),
    Known(r"fix \S+ all deform(.|\n)*pre no", None, None, "LAMMPS's fix deform goes wrong without set-up (run ... pre no)"),
    Known(r"deform(.|\n)*dt/reset|dt/reset(.|\n)*deform", None, None, "rates of fix deform are of time; LAMMPS's of steps, by the timestep at the start"),
    Known(r"deform \S+ \S+ (trate|wiggle|variable|.*volume)", r"^compute (?P<id>\S+) \S+ temp/deform", None, "later runs begin at the rate that the box has; in LAMMPS at 0"),
    Known(r"deform \S+ \S+ (trate|wiggle|variable|.*volume)(.|\n)*remap v", None, None,
          "a later run begins at the rate that the box has; in LAMMPS at 0, so that atoms that cross keep their velocity"),
    Known(r"fix \S+ \S+ (deform|ehex|heat|temp/|momentum|recenter|thermal)(.|\n)*^rerun", None, None,
          "in a rerun LAMMPS lets fixes act that change atoms or box at the end of a step"),
    Known(r"update dipole/dlm", None, None, "LAMMPS's angular velocities drift by 1e-7 of themselves a step"),
    Known(r"prism(.|\n)*thermal/conductivity", None, None, "layers of tilted boxes: LAMMPS's are not continued across faces that are shifted"),
    Known(r"boundary .*[sm](.|\n)*change_box", None, None, "change_box moves the shrink-wrapped faces of LAMMPS by 1e-4 of the box"),
    Known(r"^neigh_modify once(.|\n)*^minimize", None, None, "minimize makes lists in time, whatever neigh_modify says; LAMMPS holds to once"),
    Known(r"^write_data \S+ pair ij", None, None, "LAMMPS writes coefficients with six digits"),
    Known(r"^pair_style lj/cubic(.|\n)*^pair_coeff (\* \*|\S*\*\S* |1 [23]|2 3)", None, None,
          "LAMMPS's energies of lj/cubic are nan, or others, where pair_coeff names unlike types instead of leaving them to be mixed"),
    Known(r"^region (\S+) .*\brotate (.|\n)*^region \S+ (union|intersect) \d+ (.* )?\1\b", None, None,
          "LAMMPS turns unions and intersections with parts that turn by an angle that was never set (uninitialized memory, valgrind says)"),
    Known(r"^pair_style lj/cubic(.|\n)*^fix \S+ (all (nph|npt|press)|\S+ (ave/\S+|vector) .*thermo_press)", None, None,
          "barostats and averages of the pressure with lj/cubic: LAMMPS's has its virial only at steps with output of energies"),
    Known(r"remap v(.|\n)*^balance", None, None, "LAMMPS's command balance wraps atoms without the change of velocity that remap v gives them"),
    Known(r"^fix \S+ \S+ (ave/\S+|vector) .*thermo_press(.|\n)*^fix \S+ \S+ (heat|ehex)", None, r"^(P[xyz]|c_)",
          "fixes that change velocities at the end of a step, after one that has asked for the pressure: LAMMPS shows that of before"),
    Known(r"^fix \S+ all dt/reset(.|\n)*^fix \S+ \S+ (addforce|setforce|aveforce|spring|gravity|indent|wall|viscous|lineforce|planeforce)", None, None,
          "fix dt/reset before fixes with forces: LAMMPS chooses the first timestep without these"),
    Known(r"^min_style fire", None, r"^Dt$", "rows of minimize show the deck's timestep, LAMMPS's that of fire"),
]


def refusal_reason(message):
    """Why Halfshell refuses what LAMMPS runs; None if that is not meant."""
    return next((reason for pattern, reason in REFUSALS if re.search(pattern, message)), None)


def what_it_depends_on(text, column):
    """Names of all computes, fixes, variables and dumps from which a column of thermo output or a file is made."""
    lines = text.splitlines()
    named = {}
    for line in lines:
        words = line.split()
        if len(words) > 2 and words[0] in ("compute", "fix", "variable", "dump"):
            named.setdefault(words[1], []).append(words[2:])
    file_name = column.split()[0]
    stem = re.sub(r"\.\d+\.dump$", "", file_name)
    waiting = [re.sub(r"^[cfv]_|\[.*$", "", column)]
    waiting += [words[1] for words in map(str.split, lines) if len(words) > 2 and words[0] in ("fix", "dump")
                and any(word == file_name or word.startswith(stem + ".") for word in words)]
    found = set()
    while waiting:
        name = waiting.pop()
        if name in found or name not in named:
            continue
        found.add(name)
        for words in named[name]:
            waiting += re.findall(r"[A-Za-z]\w*", re.sub(r"\b[cfv]_", " ", " ".join(words)))
    return found


def known_reason(text, column):
    """Why a difference is known; None if it is not."""
    for known in KNOWN:
        if known.condition and not re.search(known.condition, text, re.MULTILINE) or known.column and not re.search(known.column, column):
            continue
        culprits = {found["id"] for found in re.finditer(known.culprit, text, re.MULTILINE)} if known.culprit else None
        if culprits is None or culprits & what_it_depends_on(text, column):
            return known.reason
    return None
