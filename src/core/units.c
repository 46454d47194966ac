#include "core/units.h"

#include <string.h>

const char *const hs_units_names[] = {"lj", "real", "metal", NULL};

/* Values as documented for (and printed by) LAMMPS of 2021, which differ from later CODATA sets in the last digits:
   a user who compares thermo tables needs the same ones. */
static const hs_units systems[] = {
    {.name = "lj",
     .boltz = 1.0,
     .mvv2e = 1.0,
     .ftm2v = 1.0,
     .nktv2p = 1.0,
     .dt = 0.005,
     .skin = 0.3,
     .time = "tau",
     .energy_per_atom = 1,
     .distance_label = "sigma",
     .energy_label = "epsilon",
     .pressure_label = "epsilon/sigma^3",
     .temperature_label = "epsilon/k",
     .time_label = "tau"},
    {.name = "real",
     .boltz = 0.0019872067,
     .mvv2e = 48.88821291 * 48.88821291,
     .ftm2v = 1.0 / 48.88821291 / 48.88821291,
     .nktv2p = 68568.415,
     .dt = 1.0,
     .skin = 2.0,
     .time = "fs",
     .distance_label = "Angstrom",
     .energy_label = "kcal/mol",
     .pressure_label = "atm",
     .temperature_label = "K",
     .time_label = "fs"},
    {.name = "metal",
     .boltz = 8.617343e-5,
     .mvv2e = 1.0364269e-4,
     .ftm2v = 1.0 / 1.0364269e-4,
     .nktv2p = 1.6021765e6,
     .dt = 0.001,
     .skin = 2.0,
     .time = "ps",
     .distance_label = "Angstrom",
     .energy_label = "eV",
     .pressure_label = "bar",
     .temperature_label = "K",
     .time_label = "ps"},
};

const hs_units *hs_units_find(const char *name)
{
    for (size_t i = 0; i < sizeof systems / sizeof systems[0]; ++i)
        if (strcmp(systems[i].name, name) == 0) return &systems[i];
    return NULL;
}
