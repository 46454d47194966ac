/* Common neighbor analysis: which crystal each atom is part of.
 *
 * Each bond (pair of neighbors) is told by the neighbors that its two atoms have in common: how many there are, how many bonds are
 * between these, and the largest and least number of such bonds that one of them has. The bonds of an atom then tell its crystal.
 * Sources: D. Faken, H. Jonsson, Comput. Mater. Sci. 2, 279 (1994), doi:10.1016/0927-0256(94)90109-0; H. Tsuzuki, P. S. Branicio,
 * J. P. Rino, Comput. Phys. Commun. 177, 518 (2007), doi:10.1016/j.cpc.2007.05.018. */
#include "style/nearest.h"
#include "style/pair_scan.h"

/** Results, as numbers. */
typedef enum { UNKNOWN, FCC, HCP, BCC, ICOSAHEDRON, OTHER } crystal;

enum { N_CLOSE = 12, N_BCC = 14 };

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    return hs_arg_positive(args, 0, compute->state, err);
}

/** What makes a bond: atoms nearer than the cutoff, but for types whose pairs are excluded. */
typedef struct bonding {
    double cutoff;
    hs_pair_view pairs;
} bonding;

static bool is_bond(const bonding *b, const hs_near *one, const hs_near *two)
{
    const double x = one->d[0] - two->d[0], y = one->d[1] - two->d[1], z = one->d[2] - two->d[2];
    if (!(x * x + y * y + z * z < b->cutoff * b->cutoff)) return false;
    return b->pairs.excluded == NULL || !b->pairs.excluded[one->type * b->pairs.n_kernel_types + two->type];
}

/** Which of the neighbors are bonded to which: bit k of bonds[i]. */
static void find_bonds(const bonding *b, const hs_near *near, int n, uint32_t bonds[N_BCC])
{
    for (int i = 0; i < n; ++i) bonds[i] = 0;
    for (int i = 0; i < n; ++i)
        for (int k = i + 1; k < n; ++k) {
            if (!is_bond(b, &near[i], &near[k])) continue;
            bonds[i] |= 1u << k;
            bonds[k] |= 1u << i;
        }
}

/** Signature of the bond to neighbor i as one number: common neighbors, their bonds, most and least bonds of one of them. */
static int signature(const uint32_t bonds[N_BCC], int n, int i)
{
    const uint32_t common = bonds[i];
    int n_ends = 0, most = 0, least = N_BCC;
    for (int k = 0; k < n; ++k) {
        if (!(common >> k & 1u)) continue;
        const int n_bonds = __builtin_popcount(bonds[k] & common);
        n_ends += n_bonds;
        if (n_bonds > most) most = n_bonds;
        if (n_bonds < least) least = n_bonds;
    }
    return common == 0 ? 0 : 1000 * __builtin_popcount(common) + 100 * (n_ends / 2) + 10 * most + least;
}

static crystal crystal_of(const bonding *b, const hs_near *near, int n)
{
    uint32_t bonds[N_BCC];
    int n_4211 = 0, n_4220 = 0, n_5522 = 0, n_4422 = 0, n_6622 = 0;
    if (n != N_CLOSE && n != N_BCC) return OTHER;
    find_bonds(b, near, n, bonds);
    for (int i = 0; i < n; ++i) {
        const int of_bond = signature(bonds, n, i);
        n_4211 += of_bond == 4211;
        n_4220 += of_bond == 4220;
        n_5522 += of_bond == 5522;
        n_4422 += of_bond == 4422;
        n_6622 += of_bond == 6622;
    }
    if (n == N_BCC) return n_4422 == 6 && n_6622 == 8 ? BCC : OTHER;
    return n_4211 == 12 ? FCC : n_4211 == 6 && n_4220 == 6 ? HCP : n_5522 == 12 ? ICOSAHEDRON : OTHER;
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const hs_atoms *atoms = compute->env->atoms;
    hs_nearest nearest = {0};
    bonding b = {.cutoff = *(const double *)compute->state};
    compute->env->view_pairs(compute->env, &b.pairs);
    const hs_status status = hs_nearest_find(&nearest, compute->env, b.cutoff, 0, err);
    if (status == HS_OK) {
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i) {
            int n;
            const hs_near *near = hs_nearest_of(&nearest, i, 0, &n);
            compute->atoms[i] = atoms->mask[i] & compute->mask ? crystal_of(&b, near, n) : UNKNOWN;
        }
    }
    hs_nearest_fini(&nearest);
    return status;
}

const hs_compute_style hs_compute_style_cna_atom = {
    .about = {.name = "cna/atom",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "crystal that each atom is part of, by common neighbor analysis",
              .details = "The value per atom is 1 in fcc, 2 in hcp, 3 in bcc, 4 in an icosahedron, 5 elsewhere, and 0 "
                         "outside of the group. Atoms closer than the cutoff (distance) are neighbors, of whatever "
                         "group; an atom has a crystal when it has 12 (bcc: 14) neighbors, and the neighbors that it "
                         "has in common with each are bonded as in that crystal; pairs that `neigh_modify exclude` "
                         "leaves out are no bonds. So the cutoff must lie between the "
                         "first and the second shell of neighbors, for bcc between the second and the third: with the "
                         "lattice constant a that is 0.854 a in fcc, 1.207 a in bcc, and (with the ideal axis ratio) "
                         "1.207 a in hcp. Thermal motion makes atoms unknown; minimise, or average places, before.",
              .reference = "H. Tsuzuki, P. S. Branicio, J. P. Rino, Comput. Phys. Commun. 177, 518 (2007), "
                           "doi:10.1016/j.cpc.2007.05.018",
              .example =
                  "compute crystal all cna/atom 1.43\nvariable fcc atom c_crystal==1\ncompute n all reduce sum v_fcc"},
    .state_size = sizeof(double),
    .create = create,
    .per_atom = per_atom,
};
