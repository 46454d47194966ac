#include "cli/bench_experiments.h"

#include <math.h>

static int size_of(double n_atoms) { return (int)lround(cbrt(n_atoms / 4.0)); }

static void set_size(hs_bench_case *c, double x) { c->size = size_of(x); }
static void set_density(hs_bench_case *c, double x) { c->density = x; }
static void set_emptiness(hs_bench_case *c, double x) { c->emptiness = x; }
static void set_cell(hs_bench_case *c, double x) { c->cell = x; }
static void set_temperature(hs_bench_case *c, double x) { c->temperature = x; }
static void set_order(hs_bench_case *c, double x)
{
    c->size = size_of(x);
    c->is_shuffled = true;
}

#define TOTAL          "processor time of an atom-step (ns)"
#define CELLS          "part that updates cells or lists (ns)"
#define MEMORY         "memory of the cells (bytes an atom)"
#define OFFSET(member) offsetof(hs_bench_sample, member)

const hs_bench_experiment hs_bench_experiments[] = {
    {.name = "size",
     .title = "Liquid of density 0.8442: the double loop's N^2 beside the others' N",
     .x_label = "atoms",
     .x_name = "atoms",
     .x = {256, 864, 2048, 4000, 10976, 32000},
     .n_x = 6,
     .series = {{"nsq", "nsq", 4000},
                {"linked", "linked", 0},
                {"incremental", "incremental", 0},
                {"hash", "hash", 0},
                {"cell", "cell", 0},
                {"verlet", "verlet", 0},
                {"cluster", "cluster", 0}},
     .metric = {{"", TOTAL, OFFSET(total_ns), false, true}},
     .n_metrics = 1,
     .set = set_size},
    {.name = "density",
     .title = "4,000 atoms, spread ever more thinly",
     .x_label = "density",
     .x_name = "density",
     .x = {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.8},
     .n_x = 7,
     .series = {{"linked", "linked", 0}, {"hash", "hash", 0}, {"cell", "cell", 0}, {"cluster", "cluster", 0}},
     .metric = {{"", TOTAL, OFFSET(total_ns), false, true}, {"-memory", MEMORY, OFFSET(bytes), false, true}},
     .n_metrics = 2,
     .set = set_density},
    {.name = "emptiness",
     .title = "The same drop of 4,000 atoms in ever larger boxes",
     .x_label = "volume of the box / volume of the drop",
     .x_name = "volume",
     .x = {2, 10, 100, 1000, 10000},
     .n_x = 5,
     .series = {{"linked", "linked", 0}, {"hash", "hash", 0}},
     .metric = {{"", TOTAL, OFFSET(total_ns), false, true}, {"-memory", MEMORY, OFFSET(bytes), false, true}},
     .n_metrics = 2,
     .set = set_emptiness},
    {.name = "temperature",
     .title = "4,000 atoms, density 0.8442: what keeping cells or lists up to date costs",
     .x_label = "temperature at the start",
     .x_name = "temperature",
     .x = {0.01, 0.1, 1, 10, 100},
     .n_x = 5,
     .series = {{"linked", "linked cell 0.5", 0},
                {"incremental", "incremental cell 0.5", 0},
                {"hash", "hash cell 0.5", 0},
                {"cell", "cell", 0},
                {"verlet", "verlet", 0},
                {"cluster", "cluster", 0}},
     .metric = {{"", CELLS, OFFSET(cells_ns), false, true},
                {"-changed", "atoms that change cell in a step (percent)", OFFSET(changed), false, false}},
     .n_metrics = 2,
     .set = set_temperature},
    {.name = "order",
     .title = "Atoms that were created in random order: sorted in memory or not",
     .x_label = "atoms",
     .x_name = "atoms",
     .x = {4000, 13500, 32000, 108000},
     .n_x = 4,
     .series = {{"linked, not sorted", "linked order none", 0},
                {"linked, rows", "linked order row", 0},
                {"linked, Morton", "linked order morton", 0},
                {"cluster, rows", "cluster order row", 0},
                {"cluster, Morton", "cluster order morton", 0}},
     .metric = {{"", TOTAL, OFFSET(total_ns), true, true}},
     .n_metrics = 1,
     .set = set_order},
    {.name = "cells",
     .title = "4,000 atoms, density 0.8442: size of the cells, and which of them are searched",
     .x_label = "edge of a cell / cutoff",
     .x_name = "edge",
     .x = {0.2, 0.25, 0.3333, 0.4, 0.5, 0.6667, 0.8, 1.0, 1.5, 2.0},
     .n_x = 10,
     .is_linear_x = true,
     .series = {{"linked, sphere", "linked stencil sphere", 0},
                {"linked, cube", "linked stencil cube", 0},
                {"hash, sphere", "hash stencil sphere", 0},
                {"hash, cube", "hash stencil cube", 0}},
     .metric = {{"", TOTAL, OFFSET(total_ns), true, true},
                {"-stencil", "cells of the half stencil", OFFSET(stencil), false, false}},
     .n_metrics = 2,
     .set = set_cell},
    {.name = NULL},
};
