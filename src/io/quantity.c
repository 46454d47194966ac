/* Names of columns and what they stand for. */
#include "io/quantity.h"

#include <stdlib.h>
#include <string.h>

typedef enum {
    NO_UNIT,
    TIME,
    DISTANCE,
    AREA,
    VOLUME,
    ENERGY, /**< of the system, or of an atom where thermo output is normalized */
    ENERGY_TOTAL,
    TEMPERATURE,
    PRESSURE,
    NUMBER_DENSITY,
    VELOCITY,
    VELOCITY_SQUARED,
    WAVE_VECTOR,
    FREQUENCY,
    SECONDS
} unit;

typedef struct quantity {
    const char *name;
    const char *label;
    unit unit;
} quantity;

/** Columns of thermo output, and those that fixes name by themselves. */
static const quantity columns[] = {
    {"Step", "step", NO_UNIT},
    {"TimeStep", "step", NO_UNIT},
    {"Elapsed", "steps since the run began", NO_UNIT},
    {"Elaplong", "steps since the series of runs began", NO_UNIT},
    {"Time", "time", TIME},
    {"Dt", "timestep", TIME},
    {"CPU", "wall time", SECONDS},
    {"S/CPU", "steps per second", NO_UNIT},
    {"T/CPU", "simulated time per second", TIME},
    {"CPULeft", "wall time left", SECONDS},
    {"Atoms", "number of atoms", NO_UNIT},
    {"Temp", "temperature", TEMPERATURE},
    {"Press", "pressure", PRESSURE},
    {"Pxx", "pressure tensor", PRESSURE},
    {"Pyy", "pressure tensor", PRESSURE},
    {"Pzz", "pressure tensor", PRESSURE},
    {"Pxy", "shear stress", PRESSURE},
    {"Pxz", "shear stress", PRESSURE},
    {"Pyz", "shear stress", PRESSURE},
    {"PotEng", "energy", ENERGY},
    {"KinEng", "energy", ENERGY},
    {"TotEng", "energy", ENERGY},
    {"E_pair", "energy", ENERGY},
    {"E_mol", "energy", ENERGY},
    {"E_vdwl", "energy", ENERGY},
    {"E_coul", "energy", ENERGY},
    {"E_bond", "energy", ENERGY},
    {"E_angle", "energy", ENERGY},
    {"E_dihed", "energy", ENERGY},
    {"E_impro", "energy", ENERGY},
    {"E_long", "energy", ENERGY},
    {"E_tail", "energy", ENERGY},
    {"Enthalpy", "enthalpy", ENERGY},
    {"Volume", "volume", VOLUME},
    {"Density", "density", NUMBER_DENSITY},
    {"Lx", "box length", DISTANCE},
    {"Ly", "box length", DISTANCE},
    {"Lz", "box length", DISTANCE},
    {"Coord", "value", NO_UNIT},
    {"Coord1", "position", NO_UNIT},
    {"Coord2", "position", NO_UNIT},
    {"Coord3", "position", NO_UNIT},
    {"TimeDelta", "time lag (steps)", NO_UNIT},
    {"Frequency", "frequency", FREQUENCY},
    {"msd", "mean-square displacement", AREA},
    {"vacf", "velocity autocorrelation", VELOCITY_SQUARED},
    {"alpha2", "non-Gaussian parameter", NO_UNIT},
    {"Count/Total", "fraction", NO_UNIT},
    {"Ncount", "number of atoms", NO_UNIT},
    {"Count", "count", NO_UNIT},
    {"density/number", "number density", NUMBER_DENSITY},
    {"density/mass", "mass density", NO_UNIT},
    {"temp", "temperature", TEMPERATURE},
    {"vx", "velocity", VELOCITY},
    {"vy", "velocity", VELOCITY},
    {"vz", "velocity", VELOCITY},
    {NULL, NULL, NO_UNIT},
};

/** Values of computes, by style. An index picks among several rows of one style. */
typedef struct compute_quantity {
    const char *style;
    int first, last; /**< elements it holds for; 0: the scalar; last < 0: every second from first on */
    const char *label;
    unit unit;
} compute_quantity;

static const compute_quantity computes[] = {
    {"temp", 0, 0, "temperature", TEMPERATURE},
    {"temp", 1, 6, "kinetic energy tensor", ENERGY_TOTAL},
    {"temp/partial", 0, 0, "temperature", TEMPERATURE},
    {"temp/region", 0, 0, "temperature", TEMPERATURE},
    {"temp/deform", 0, 0, "temperature", TEMPERATURE},
    {"temp/profile", 0, 0, "temperature", TEMPERATURE},
    {"pressure", 0, 0, "pressure", PRESSURE},
    {"pressure", 1, 3, "pressure tensor", PRESSURE},
    {"pressure", 4, 6, "shear stress", PRESSURE},
    {"ke", 0, 0, "kinetic energy", ENERGY},
    {"pe", 0, 0, "potential energy", ENERGY},
    {"msd", 1, 4, "mean-square displacement", AREA},
    {"vacf", 1, 4, "velocity autocorrelation", VELOCITY_SQUARED},
    {"com", 1, 3, "center of mass", DISTANCE},
    {"gyration", 0, 0, "radius of gyration", DISTANCE},
    {"rdf", 1, 1, "distance r", DISTANCE},
    {"rdf", 2, -1, "pair correlation g(r)", NO_UNIT},
    {"rdf", 3, -1, "neighbors within r", NO_UNIT},
    {NULL, 0, 0, NULL, NO_UNIT},
};

/** A label of core/units in the letters of print: sigma^3 is σ³. */
static hs_status put_unit_name(hs_text *text, const char *name, hs_error *err)
{
    static const char *const letters[][2] = {{"sigma", "σ"},    {"epsilon", "ε"}, {"tau", "τ"},
                                             {"Angstrom", "Å"}, {"^3", "³"},      {"^2", "²"}};
    while (*name != '\0') {
        size_t k = 0;
        while (k < sizeof letters / sizeof letters[0] && strncmp(name, letters[k][0], strlen(letters[k][0])) != 0) ++k;
        if (k < sizeof letters / sizeof letters[0]) {
            HS_TRY(hs_text_printf(text, err, "%s", letters[k][1]));
            name += strlen(letters[k][0]);
        } else {
            HS_TRY(hs_text_append(text, name++, 1, err));
        }
    }
    return HS_OK;
}

static hs_status put_unit(hs_text *text, unit kind, const hs_deck_facts *facts, hs_error *err)
{
    const hs_units *units = facts->units;
    const char *before = " (", *name = "", *after = ")";
    if (kind == SECONDS) return hs_text_printf(text, err, " (s)");
    if (kind == NO_UNIT || units == NULL) return HS_OK;
    const bool is_2d = facts->dimension == 2;
    switch (kind) {
    case TIME:
        name = units->time_label;
        break;
    case DISTANCE:
        name = units->distance_label;
        break;
    case AREA:
        name = units->distance_label, after = "²)";
        break;
    case VOLUME:
        name = units->distance_label, after = is_2d ? "²)" : "³)";
        break;
    case NUMBER_DENSITY:
        name = units->distance_label, before = " (1/", after = is_2d ? "²)" : "³)";
        break;
    case WAVE_VECTOR:
        name = units->distance_label, before = " (1/";
        break;
    case FREQUENCY:
        name = units->time_label, before = " (1/";
        break;
    case ENERGY:
        before = facts->is_per_atom ? " per atom (" : " (";
        name = units->energy_label;
        break;
    case ENERGY_TOTAL:
        name = units->energy_label;
        break;
    case TEMPERATURE:
        name = units->temperature_label;
        break;
    case PRESSURE:
        name = is_2d && strcmp(units->name, "lj") == 0 ? "epsilon/sigma^2" : units->pressure_label;
        break;
    default:
        HS_TRY(hs_text_printf(text, err, " ("));
        HS_TRY(put_unit_name(text, units->distance_label, err));
        HS_TRY(hs_text_printf(text, err, kind == VELOCITY_SQUARED ? "²/" : "/"));
        name = units->time_label, before = "", after = kind == VELOCITY_SQUARED ? "²)" : ")";
        break;
    }
    HS_TRY(hs_text_printf(text, err, "%s", before));
    HS_TRY(put_unit_name(text, name, err));
    return hs_text_printf(text, err, "%s", after);
}

static bool holds_for(const compute_quantity *entry, int element)
{
    if (entry->last < 0) return element >= entry->first && (element - entry->first) % 2 == 0;
    return element >= entry->first && element <= entry->last;
}

/** "c_rdf[2]" through the deck's `compute rdf all rdf 50`. */
static const compute_quantity *find_compute(const char *column, const hs_deck_facts *facts)
{
    static const char *const own[][2] = {
        {"thermo_temp", "temp"}, {"thermo_press", "pressure"}, {"thermo_pe", "pe"}}; /* every deck has them */
    const char *id = column + 2, *style = NULL;
    if (strncmp(column, "c_", 2) != 0 || strchr(id, '*') != NULL) return NULL;
    const size_t length = strcspn(id, "[");
    const int element = id[length] == '[' ? atoi(id + length + 1) : 0;
    for (int k = 0; k < facts->n_names; ++k)
        if (facts->name[k].kind == 'c' && strlen(facts->name[k].id) == length &&
            memcmp(facts->name[k].id, id, length) == 0)
            style = facts->name[k].style;
    for (size_t k = 0; k < sizeof own / sizeof own[0]; ++k)
        if (strlen(own[k][0]) == length && memcmp(own[k][0], id, length) == 0) style = own[k][1];
    for (const compute_quantity *entry = computes; style != NULL && entry->style != NULL; ++entry)
        if (strcmp(entry->style, style) == 0 && holds_for(entry, element)) return entry;
    return NULL;
}

/** c_x*c_x of fix ave/correlate: "autocorrelation of c_x". */
static hs_status put_product(hs_text *label, const char *column, hs_error *err)
{
    const char *star = strchr(column, '*');
    const size_t length = (size_t)(star - column);
    if (strlen(star + 1) == length && memcmp(column, star + 1, length) == 0)
        return hs_text_printf(label, err, "autocorrelation of %s", star + 1);
    return hs_text_printf(label, err, "correlation of %.*s and %s", (int)length, column, star + 1);
}

/** power(v_x) of fix ave/spectrum: "spectrum of v_x". */
static hs_status put_power(hs_text *label, const char *column, hs_error *err)
{
    const char *name = strchr(column, '(') + 1;
    return hs_text_printf(label, err, "spectrum of %.*s", (int)strlen(name) - 1, name);
}

hs_status hs_quantity_label(hs_text *label, const char *column, const hs_deck_facts *facts, hs_error *err)
{
    hs_text_clear(label);
    for (const quantity *entry = columns; entry->name != NULL; ++entry)
        if (strcmp(entry->name, column) == 0) {
            HS_TRY(hs_text_printf(label, err, "%s", entry->label));
            return put_unit(label, entry->unit, facts, err);
        }
    const compute_quantity *compute = find_compute(column, facts);
    if (compute != NULL) {
        HS_TRY(hs_text_printf(label, err, "%s", compute->label));
        return put_unit(label, compute->unit, facts, err);
    }
    if (strncmp(column, "F(", 2) == 0) return hs_text_printf(label, err, "intermediate scattering F(q,t)");
    if (strncmp(column, "Fs(", 3) == 0) return hs_text_printf(label, err, "self scattering F(q,t)");
    if (strncmp(column, "power(", 6) == 0 && column[strlen(column) - 1] == ')') return put_power(label, column, err);
    const char *star = strchr(column, '*');
    if (star != NULL && star != column && star[1] != '\0') return put_product(label, column, err);
    return hs_text_printf(label, err, "%s", column);
}
