/** Group functions of formulas: sums over the atoms of a group, and optionally within a region. Collective. */
#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "core/exact_sum.h"
#include "core/rotation.h"
#include "deck/formula_nodes.h"
#include "style/places.h"

/** The atoms a function is about. */
typedef struct selection {
    const hs_sim *sim;
    uint32_t mask;
    const hs_region *region; /**< NULL: everywhere */
} selection;

static hs_status select_atoms(hs_deck *deck, const hs_node *node, selection *chosen, hs_error *err)
{
    hs_sim *sim = deck->sim;
    int bit;
    HS_TRY(hs_sim_need_box(sim, node->words_of->usage, err));
    HS_TRY(hs_groups_get(&sim->groups, node->words[0], &bit, err));
    *chosen = (selection){.sim = sim, .mask = hs_group_mask(bit)};
    if (node->n_words < node->words_of->n_max) return HS_OK;
    const char *region = node->words[node->n_words - 1];
    return hs_sim_need_region(sim, node->words_of->usage, region, &chosen->region, err);
}

static bool is_chosen(const selection *chosen, int i)
{
    const hs_atoms *atoms = &chosen->sim->atoms;
    return (atoms->mask[i] & chosen->mask) != 0 && (chosen->region == NULL || hs_region_has(chosen->region, atoms, i));
}

/** 0 without atoms, as in LAMMPS: a region may become empty in the middle of a run. */
static double per_mass(double sum, double mass) { return mass > 0.0 ? sum / mass : 0.0; }

static hs_status axis_of(const hs_node *node, const char *word, int *axis, hs_error *err)
{
    if (strlen(word) == 1 && word[0] >= 'x' && word[0] <= 'z') {
        *axis = word[0] - 'x';
        return HS_OK;
    }
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must be x, y or z", node->words_of->usage, word);
}

static hs_status do_count(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    HS_TRY(select_atoms(deck, node, &chosen, err));
    int64_t n = 0;
    for (int i = 0; i < chosen.sim->atoms.n_local; ++i) n += is_chosen(&chosen, i);
    hs_parallel_sum_int64(&chosen.sim->parallel, &n, 1);
    *value = (double)n;
    return HS_OK;
}

/** Sums of m, m x, m y, m z of the unwrapped places: sums[4]. */
static void sum_mass(const selection *chosen, double sums[4])
{
    const hs_atoms *atoms = &chosen->sim->atoms;
    hs_exact_sum exact[4] = {{.n_added = 0}};
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_chosen(chosen, i)) continue;
        double x[3];
        hs_unwrapped_place(&chosen->sim->env, i, x);
        const double mass = hs_atom_mass(atoms, i);
        hs_exact_add(&exact[0], mass);
        for (int d = 0; d < 3; ++d) hs_exact_add(&exact[1 + d], x[d] * mass);
    }
    hs_exact_total(exact, 4, &chosen->sim->parallel, sums);
}

static hs_status do_mass(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    double sums[4];
    HS_TRY(select_atoms(deck, node, &chosen, err));
    sum_mass(&chosen, sums);
    *value = sums[0];
    return HS_OK;
}

static hs_status do_xcm(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    double sums[4];
    int axis;
    HS_TRY(axis_of(node, node->words[1], &axis, err));
    HS_TRY(select_atoms(deck, node, &chosen, err));
    sum_mass(&chosen, sums);
    *value = per_mass(sums[1 + axis], sums[0]);
    return HS_OK;
}

static hs_status do_vcm(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    int axis;
    HS_TRY(axis_of(node, node->words[1], &axis, err));
    HS_TRY(select_atoms(deck, node, &chosen, err));
    const hs_atoms *atoms = &chosen.sim->atoms;
    hs_exact_sum exact[2] = {{.n_added = 0}};
    double sums[2];
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_chosen(&chosen, i)) continue;
        const double mass = hs_atom_mass(atoms, i);
        hs_exact_add(&exact[0], mass);
        hs_exact_add(&exact[1], atoms->v[axis][i] * mass);
    }
    hs_exact_total(exact, 2, &chosen.sim->parallel, sums);
    *value = per_mass(sums[1], sums[0]);
    return HS_OK;
}

static hs_status do_fcm(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    int axis;
    HS_TRY(axis_of(node, node->words[1], &axis, err));
    HS_TRY(select_atoms(deck, node, &chosen, err));
    hs_exact_sum sum = {0};
    for (int i = 0; i < chosen.sim->atoms.n_local; ++i)
        if (is_chosen(&chosen, i)) hs_exact_add(&sum, chosen.sim->atoms.f[axis][i]);
    hs_exact_total(&sum, 1, &chosen.sim->parallel, value);
    return HS_OK;
}

static hs_status do_bound(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    const char *word = node->words[1];
    selection chosen;
    if (strlen(word) != 4 || word[0] < 'x' || word[0] > 'z' ||
        (strcmp(word + 1, "min") != 0 && strcmp(word + 1, "max") != 0))
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must be xmin, xmax, ymin, ymax, zmin or zmax",
                       node->words_of->usage, word);
    HS_TRY(select_atoms(deck, node, &chosen, err));
    const double *x = chosen.sim->atoms.x[word[0] - 'x'], sign = word[2] == 'a' ? 1.0 : -1.0;
    /* The minimum is the maximum of the negatives. */
    double largest = -1e20; /* what LAMMPS gives without atoms */
    for (int i = 0; i < chosen.sim->atoms.n_local; ++i)
        if (is_chosen(&chosen, i) && sign * x[i] > largest) largest = sign * x[i];
    hs_parallel_max_double(&chosen.sim->parallel, &largest, 1);
    *value = hs_plain_zero(sign * largest);
    return HS_OK;
}

static hs_status do_ke(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    HS_TRY(select_atoms(deck, node, &chosen, err));
    const hs_atoms *atoms = &chosen.sim->atoms;
    hs_exact_sum exact = {0};
    double sum;
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_chosen(&chosen, i)) continue;
        const double vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i];
        hs_exact_add(&exact, (vx * vx + vy * vy + vz * vz) * hs_atom_mass(atoms, i));
    }
    hs_exact_total(&exact, 1, &chosen.sim->parallel, &sum);
    *value = 0.5 * chosen.sim->env.units->mvv2e * sum;
    return HS_OK;
}

/** Centre of mass of the selection; its mass is returned. */
static double find_centre(const selection *chosen, double centre[3])
{
    double sums[4];
    sum_mass(chosen, sums);
    for (int d = 0; d < 3; ++d) centre[d] = per_mass(sums[1 + d], sums[0]);
    return sums[0];
}

static hs_status do_gyration(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    double centre[3], sum;
    hs_exact_sum exact = {0};
    HS_TRY(select_atoms(deck, node, &chosen, err));
    const double mass = find_centre(&chosen, centre);
    const hs_atoms *atoms = &chosen.sim->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_chosen(&chosen, i)) continue;
        double x[3];
        hs_unwrapped_place(&chosen.sim->env, i, x);
        const double dx = x[0] - centre[0], dy = x[1] - centre[1], dz = x[2] - centre[2];
        hs_exact_add(&exact, (dx * dx + dy * dy + dz * dz) * hs_atom_mass(atoms, i));
    }
    hs_exact_total(&exact, 1, &chosen.sim->parallel, &sum);
    *value = sqrt(per_mass(sum, mass));
    return HS_OK;
}

/** Component @p axis of the sum over the atoms of (x - centre) cross (m v or f). */
static double moment_of(const selection *chosen, const double centre[3], int axis, bool of_forces)
{
    const hs_atoms *atoms = &chosen->sim->atoms;
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    double *const *vector = of_forces ? (double *const *)atoms->f : (double *const *)atoms->v;
    hs_exact_sum sum = {0};
    double total;
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_chosen(chosen, i)) continue;
        double x[3];
        hs_unwrapped_place(&chosen->sim->env, i, x);
        const double weight = of_forces ? 1.0 : hs_atom_mass(atoms, i);
        hs_exact_add(&sum, weight * ((x[a] - centre[a]) * vector[b][i] - (x[b] - centre[b]) * vector[a][i]));
    }
    hs_exact_total(&sum, 1, &chosen->sim->parallel, &total);
    return total;
}

/** Element of the tensor of the moments of inertia about @p centre. */
static double inertia_of(const selection *chosen, const double centre[3], int a, int b)
{
    const hs_atoms *atoms = &chosen->sim->atoms;
    hs_exact_sum sum = {0};
    double total;
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_chosen(chosen, i)) continue;
        double x[3], r2 = 0.0;
        hs_unwrapped_place(&chosen->sim->env, i, x);
        for (int d = 0; d < 3; ++d) x[d] -= centre[d], r2 += x[d] * x[d];
        hs_exact_add(&sum, hs_atom_mass(atoms, i) * ((a == b ? r2 : 0.0) - x[a] * x[b]));
    }
    hs_exact_total(&sum, 1, &chosen->sim->parallel, &total);
    return total;
}

static hs_status do_moment(hs_deck *deck, const hs_node *node, bool of_forces, double *value, hs_error *err)
{
    selection chosen;
    double centre[3];
    int axis;
    HS_TRY(axis_of(node, node->words[1], &axis, err));
    HS_TRY(select_atoms(deck, node, &chosen, err));
    find_centre(&chosen, centre);
    *value = moment_of(&chosen, centre, axis, of_forces);
    return HS_OK;
}

static hs_status do_angmom(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    return do_moment(deck, node, false, value, err);
}

static hs_status do_torque(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    return do_moment(deck, node, true, value, err);
}

static hs_status do_inertia(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    double centre[3];
    const char *word = node->words[1];
    if (strlen(word) != 2 || word[0] < 'x' || word[0] > 'z' || word[1] < 'x' || word[1] > 'z')
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must be xx, yy, zz, xy, yz or xz", node->words_of->usage, word);
    HS_TRY(select_atoms(deck, node, &chosen, err));
    find_centre(&chosen, centre);
    *value = inertia_of(&chosen, centre, word[0] - 'x', word[1] - 'x');
    return HS_OK;
}

static hs_status do_omega(hs_deck *deck, const hs_node *node, double *value, hs_error *err)
{
    selection chosen;
    double centre[3], inertia[3][3], momentum[3], omega[3];
    int axis;
    HS_TRY(axis_of(node, node->words[1], &axis, err));
    HS_TRY(select_atoms(deck, node, &chosen, err));
    find_centre(&chosen, centre);
    for (int a = 0; a < 3; ++a) {
        momentum[a] = moment_of(&chosen, centre, a, false);
        for (int b = a; b < 3; ++b) inertia[a][b] = inertia[b][a] = inertia_of(&chosen, centre, a, b);
    }
    hs_rotation_velocity((const double(*)[3])inertia, momentum, omega);
    *value = omega[axis];
    return HS_OK;
}

const hs_word_function hs_group_functions[] = {
    {"count", 1, 2, do_count, NULL, "count(group[,region])", "number of atoms"},
    {"mass", 1, 2, do_mass, NULL, "mass(group[,region])", "total mass"},
    {"xcm", 2, 3, do_xcm, NULL, "xcm(group,x|y|z[,region])", "centre of mass, unwrapped"},
    {"vcm", 2, 3, do_vcm, NULL, "vcm(group,x|y|z[,region])", "velocity of the centre of mass"},
    {"fcm", 2, 3, do_fcm, NULL, "fcm(group,x|y|z[,region])", "total force"},
    {"bound", 2, 3, do_bound, NULL, "bound(group,xmin|xmax|ymin|...[,region])", "least or greatest coordinate"},
    {"gyration", 1, 2, do_gyration, NULL, "gyration(group[,region])", "radius of gyration"},
    {"ke", 1, 2, do_ke, NULL, "ke(group[,region])", "kinetic energy"},
    {"angmom", 2, 3, do_angmom, NULL, "angmom(group,x|y|z[,region])", "angular momentum about the centre of mass"},
    {"torque", 2, 3, do_torque, NULL, "torque(group,x|y|z[,region])", "torque about the centre of mass"},
    {"inertia", 2, 3, do_inertia, NULL, "inertia(group,xx|yy|zz|xy|yz|xz[,region])",
     "component of the moment of inertia"},
    {"omega", 2, 3, do_omega, NULL, "omega(group,x|y|z[,region])", "angular velocity about the centre of mass"},
    {0},
};
