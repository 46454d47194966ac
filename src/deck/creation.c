#include "deck/creation.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/random.h"
#include "deck/subset.h"
#include "deck/variables.h"

/** Where atoms may be. A lattice site on a periodic face, or its image on the opposite one, a hair to either side by
 *  rounding, must give exactly one atom: as in LAMMPS, the range is shifted down by a millionth of the box, and is that
 *  much smaller. */
static void set_bounds(hs_creation *c)
{
    const hs_box *box = &c->sim->box;
    for (int axis = 0; axis < 3; ++axis) {
        const double hair = hs_box_length(box, axis) * 1.0e-6;
        const bool is_lattice = c->style == HS_CREATE_BOX || c->style == HS_CREATE_REGION;
        c->lo[axis] = box->lo[axis];
        c->hi[axis] = box->hi[axis];
        if (!is_lattice || !box->periodic[axis]) continue;
        c->lo[axis] -= hair;
        c->hi[axis] -= 2.0 * hair;
    }
}

static bool is_within(const hs_creation *c, const double x[3])
{
    const hs_box *box = &c->sim->box;
    if (box->is_tilted) {
        for (int axis = 0; axis < 3; ++axis) {
            const double place = hs_box_upright(box, x, axis);
            if (!(place >= c->lo[axis] && place < c->hi[axis])) return false;
        }
        return true;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (!(x[axis] >= c->lo[axis] && x[axis] < c->hi[axis])) return false;
    return true;
}

/** Add an atom with the next ID. All ranks see all atoms, and each keeps those of its brick, so that IDs do not depend
 *  on the number of ranks. */
static hs_status add_atom(hs_creation *c, int type, const double x[3], hs_error *err)
{
    const int64_t id = c->next_id++;
    ++c->n_created;
    if (c->sim->parallel.n_ranks > 1 && !hs_domain_owns(&c->sim->domain, &c->sim->box, x)) return HS_OK;
    return hs_atoms_add(&c->sim->atoms, id, type, x, err);
}

/** Region and variable: may an atom be at x? */
static hs_status test_place(const hs_creation *c, const double x[3], bool *is_wanted, hs_error *err)
{
    *is_wanted = c->region == NULL || hs_region_contains(c->region, x);
    if (!*is_wanted || c->test == NULL) return HS_OK;
    for (int axis = 0; axis < 3; ++axis)
        if (c->coordinate[axis] != NULL)
            HS_TRY(hs_variables_set_internal(c->deck->variables, c->coordinate[axis], x[axis], err));
    double value;
    HS_TRY(c->sim->env.variable_value(c->deck, c->test, &value, err));
    *is_wanted = value != 0.0;
    return HS_OK;
}

static hs_status stop_if_asked(const hs_creation *c, hs_error *err)
{
    if (c->sim->stop_requested == NULL || !*c->sim->stop_requested) return HS_OK;
    return hs_fail(err, HS_INTERRUPTED, "stopped by a signal while atoms were created");
}

/** What encloses the places where atoms may be. */
static void enclose(const hs_creation *c, double lo[3], double hi[3])
{
    hs_box places = c->sim->box;
    memcpy(places.lo, c->lo, sizeof places.lo);
    memcpy(places.hi, c->hi, sizeof places.hi);
    hs_box_bounds(&places, lo, hi);
    for (int axis = 0; axis < 3 && places.is_tilted; ++axis) { /* a hair more, for the shift of the places */
        const double hair = 1e-5 * (hi[axis] - lo[axis]);
        lo[axis] -= hair;
        hi[axis] += hair;
    }
}

/** Go through the sites in LAMMPS's order: the third cell index slowest, then the second, the first, the basis.
 *  @param mark     create atoms where mark[number of the site] is not 0; NULL: everywhere
 *  @param n_sites  if not NULL: count sites, create nothing */
static hs_status visit_sites(hs_creation *c, const unsigned char *mark, int64_t *n_sites, hs_error *err)
{
    const hs_lattice *lattice = &c->sim->lattice;
    double from[3], to[3];
    double least[3], most[3];
    int lo[3], hi[3];
    int64_t n = 0;
    enclose(c, least, most);
    for (int axis = 0; axis < 3; ++axis) { /* no need to look where the region is not */
        const bool is_bounded = c->region != NULL && c->region->has_extent;
        from[axis] = is_bounded ? fmax(least[axis], c->region->extent[axis][0]) : least[axis];
        to[axis] = is_bounded ? fmin(most[axis], c->region->extent[axis][1]) : most[axis];
        if (from[axis] > to[axis]) to[axis] = from[axis];
    }
    HS_TRY(hs_lattice_range(lattice, from, to, lo, hi, err));
    for (int k = lo[2]; k <= hi[2]; ++k)
        for (int j = lo[1]; j <= hi[1]; ++j)
            for (int i = lo[0]; i <= hi[0]; ++i) {
                HS_TRY(stop_if_asked(c, err));
                for (int b = 0; b < lattice->n_basis; ++b) {
                    double x[3];
                    bool is_wanted;
                    hs_lattice_site(lattice, i, j, k, b, x);
                    if (!is_within(c, x)) continue;
                    HS_TRY(test_place(c, x, &is_wanted, err));
                    if (!is_wanted) continue;
                    const int64_t site = n++;
                    if (n_sites == NULL && (mark == NULL || mark[site])) HS_TRY(add_atom(c, c->basis_type[b], x, err));
                }
            }
    if (n_sites != NULL) *n_sites = n;
    return HS_OK;
}

/** A box that is to be filled as a whole tells beforehand whether its atoms find room. */
static hs_status check_room(const hs_creation *c, hs_error *err)
{
    const hs_box *box = &c->sim->box;
    if (c->region != NULL || c->test != NULL || c->ratio >= 0.0 || c->n_subset >= 0) return HS_OK;
    const double n_sites = hs_lattice_density(&c->sim->lattice, box->dimension) * hs_box_volume(box),
                 n_local = n_sites / c->sim->parallel.n_ranks;
    if (n_local < 1e18) return hs_atoms_check_room(&c->sim->atoms, (int64_t)n_local, 0, err);
    return hs_fail(err, HS_ERROR_INPUT, "create_atoms: the box has some %.0e lattice sites; is it in the right units?",
                   n_sites);
}

static hs_status create_on_lattice(hs_creation *c, hs_error *err)
{
    HS_TRY(check_room(c, err));
    if (c->ratio < 0.0 && c->n_subset < 0) return visit_sites(c, NULL, NULL, err);
    int64_t n_sites;
    HS_TRY(visit_sites(c, NULL, &n_sites, err));
    const int64_t n_wanted = c->n_subset >= 0 ? c->n_subset : (int64_t)(c->ratio * (double)n_sites);
    if (n_wanted > n_sites)
        return hs_fail(err, HS_ERROR_INPUT, "create_atoms: a subset of %lld sites is wanted, but there are only %lld",
                       (long long)n_wanted, (long long)n_sites);
    unsigned char *mark = NULL;
    HS_TRY(HS_ALLOC(mark, (size_t)n_sites, err));
    hs_status status = hs_subset_select(mark, n_sites, n_wanted, c->subset_seed, err);
    if (status == HS_OK) status = visit_sites(c, mark, NULL, err);
    HS_FREE(mark);
    return status;
}

static hs_status create_single(hs_creation *c, hs_error *err)
{
    const hs_box *box = &c->sim->box;
    double x[3];
    for (int axis = 0; axis < 3; ++axis)
        x[axis] = c->is_lattice_units ? c->place[axis] * c->sim->lattice.spacing[axis] : c->place[axis];
    if (c->remap) {
        int32_t image[3] = {0, 0, 0};
        for (int axis = 0; axis < 3; ++axis)
            if (box->periodic[axis] && !(x[axis] > box->lo[axis] - 1000.0 * hs_box_length(box, axis) &&
                                         x[axis] < box->hi[axis] + 1000.0 * hs_box_length(box, axis)))
                return hs_fail(err, HS_ERROR_INPUT, "create_atoms: the place %g along %c is more than 1000 boxes away",
                               x[axis], "xyz"[axis]);
        for (int n = 0; n < 1001; ++n) hs_box_wrap(box, x, image);
    }
    return is_within(c, x) ? add_atom(c, c->type, x, err) : HS_OK;
}

/** The part of the box where random atoms are drawn: a bounded region's extent cuts it. */
static hs_status random_range(const hs_creation *c, double lo[3], double hi[3], hs_error *err)
{
    hs_box_bounds(&c->sim->box, lo, hi);
    for (int axis = 0; axis < 3; ++axis) {
        if (c->region == NULL || !c->region->has_extent) continue;
        if (c->region->extent[axis][0] > lo[axis]) lo[axis] = c->region->extent[axis][0];
        if (c->region->extent[axis][1] < hi[axis]) hi[axis] = c->region->extent[axis][1];
        if (lo[axis] > hi[axis])
            return hs_fail(err, HS_ERROR_INPUT, "create_atoms: the region '%s' lies outside of the box along %c",
                           c->region->id, "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status create_random(hs_creation *c, hs_error *err)
{
    enum { N_WARM_UP = 30, N_TRIES = 50000000 };
    double lo[3], hi[3];
    hs_park park;
    HS_TRY(random_range(c, lo, hi, err));
    HS_TRY(hs_atoms_check_room(&c->sim->atoms, c->n_random / c->sim->parallel.n_ranks, 0, err));
    hs_park_init(&park, c->seed);
    for (int n = 0; n < N_WARM_UP; ++n) (void)hs_park_uniform(&park);
    for (int64_t n = 0; n < c->n_random; ++n) {
        HS_TRY(stop_if_asked(c, err));
        bool is_wanted = false;
        double x[3];
        for (int try = 0; !is_wanted; ++try) {
            if (try == N_TRIES)
                return hs_fail(err, HS_ERROR_INPUT,
                               "create_atoms: %d tries found no place for a random atom; does the region have a volume "
                               "inside of the box?",
                               N_TRIES);
            for (int axis = 0; axis < 3; ++axis) x[axis] = lo[axis] + hs_park_uniform(&park) * (hi[axis] - lo[axis]);
            if (c->sim->box.dimension == 2) x[2] = lo[2] + 0.5 * (hi[2] - lo[2]);
            /* what encloses a tilted box has places outside of it */
            if (!c->sim->box.is_tilted || is_within(c, x)) HS_TRY(test_place(c, x, &is_wanted, err));
        }
        if (is_within(c, x)) HS_TRY(add_atom(c, c->type, x, err));
    }
    return HS_OK;
}

hs_status hs_creation_run(hs_creation *c, hs_error *err)
{
    set_bounds(c);
    int64_t max_id = hs_atoms_max_id(&c->sim->atoms);
    hs_parallel_max_int64(&c->sim->parallel, &max_id, 1);
    c->next_id = max_id + 1;
    switch (c->style) {
    case HS_CREATE_SINGLE:
        return create_single(c, err);
    case HS_CREATE_RANDOM:
        return create_random(c, err);
    default:
        return create_on_lattice(c, err);
    }
}
