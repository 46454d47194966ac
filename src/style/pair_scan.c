#include "style/pair_scan.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/places.h"

/** Copies of the local atoms, with the fields that scans need. */
static hs_status copy_atoms(hs_pair_scan *scan, hs_env *env, const hs_places *places, hs_error *err)
{
    const hs_atoms *from = env->atoms;
    hs_atoms *to = &scan->atoms;
    const size_t n = (size_t)from->n_local;
    hs_pair_view view;
    env->view_pairs(env, &view);
    scan->excluded = view.excluded;
    scan->n_kernel_types = view.n_kernel_types;
    HS_TRY(hs_atoms_init(to, err));
    HS_TRY(hs_atoms_add_field(to, "scan_mask", (void **)&scan->mask, sizeof *scan->mask, true, err));
    HS_TRY(hs_atoms_add_field(to, "scan_id", (void **)&scan->id, sizeof *scan->id, true, err));
    if (from->radius != NULL)
        HS_TRY(hs_atoms_add_field(to, "scan_radius", (void **)&scan->radius, sizeof *scan->radius, true, err));
    HS_TRY(hs_atoms_set_types(to, from->n_types, err));
    HS_TRY(hs_atoms_reserve(to, from->n_local, 0, err));
    to->n_local = from->n_local;
    to->n_all = from->n_all;
    for (int axis = 0; axis < 3 && n > 0; ++axis) memcpy(to->x[axis], places->x[axis], n * sizeof(double));
    if (n > 0) memcpy(to->type, view.type != NULL ? view.type : from->type, n * sizeof *to->type);
    if (n > 0) memcpy(scan->mask, from->mask, n * sizeof *scan->mask);
    if (n > 0) memcpy(scan->id, from->id, n * sizeof *scan->id);
    if (n > 0 && scan->radius != NULL) memcpy(scan->radius, from->radius, n * sizeof *scan->radius);
    return HS_OK;
}

/** Places of the lists for all atoms, where they decide which pairs count. */
static hs_status take_listed(hs_pair_scan *scan, hs_env *env, hs_error *err)
{
    hs_atoms *atoms = &scan->atoms;
    hs_pair_view view;
    hs_status status = HS_OK;
    env->view_pairs(env, &view);
    if (!view.listed_only) return HS_OK;
    for (int axis = 0; axis < 3 && status == HS_OK; ++axis)
        status = hs_atoms_add_field(atoms, "scan_listed", (void **)&scan->x_listed[axis], sizeof(double), true, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    for (int axis = 0; axis < 3 && atoms->n_local > 0; ++axis)
        memcpy(scan->x_listed[axis], view.x_listed[axis], (size_t)atoms->n_local * sizeof(double));
    hs_halo_fit_box(&scan->halo, &view.box_listed);
    hs_halo_forward_positions(&scan->halo, atoms, scan->x_listed);
    return HS_OK;
}

/** Farthest that a local atom is outside of its rank's brick: it has not been exchanged since it moved. */
static double find_drift(const hs_env *env, const hs_places *places)
{
    const hs_atoms *atoms = env->atoms;
    double drift = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const int at = env->domain->at[axis];
        const double lo = hs_domain_plane(env->domain, places->box, axis, at),
                     hi = hs_domain_plane(env->domain, places->box, axis, at + 1);
        for (int i = 0; i < atoms->n_local; ++i) {
            const double x[3] = {places->x[0][i], places->x[1][i], places->x[2][i]},
                         place = hs_box_upright(places->box, x, axis);
            drift = fmax(drift, fmax(lo - place, place - hi));
        }
    }
    hs_parallel_max_double(env->parallel, &drift, 1);
    return drift;
}

/** Atoms that fly off ask for as many copies of the box as they have crossed. All ranks know the same drift. */
static hs_status check_drift(const hs_env *env, const hs_places *places, double drift, hs_error *err)
{
    enum { BOXES_MAX = 4 };
    double longest = 0.0;
    for (int axis = 0; axis < 3; ++axis) longest = fmax(longest, hs_box_length(places->box, axis));
    if (drift <= BOXES_MAX * longest) return HS_OK;
    return hs_fail(
        err, HS_ERROR_ATOMS,
        "at step %lld an atom is %g outside of its part of the box, which is %g long: it has flown off since lists "
        "were made. Usually atoms overlap or the timestep is too long; 'neigh_modify every 1 delay 0 check yes' "
        "makes lists in time",
        (long long)env->step, drift, longest);
}

/** Types, masks, ids and radii of the halo, and where its atoms come from. */
static hs_status fill_halo(hs_pair_scan *scan, hs_error *err)
{
    const hs_halo *halo = &scan->halo;
    hs_halo_forward_fields(halo, &scan->atoms);
    HS_TRY(HS_ALLOC(scan->source_of, (size_t)scan->atoms.n_halo, err));
    for (int k = 0; k < halo->n; ++k) scan->source_of[halo->slot[k]] = k < halo->in.n_self_atoms ? halo->source[k] : -1;
    return HS_OK;
}

/** Cells over all atoms, not smaller than the range, and not many more than atoms. */
static void set_cells(hs_pair_scan *scan)
{
    const hs_atoms *atoms = &scan->atoms;
    const double n_max = cbrt(4.0 * (double)scan->n_all) + 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        double lo = DBL_MAX, hi = -DBL_MAX;
        for (int i = 0; i < scan->n_all; ++i) {
            lo = fmin(lo, atoms->x[axis][i]);
            hi = fmax(hi, atoms->x[axis][i]);
        }
        scan->lo[axis] = lo;
        scan->n_cells[axis] = 1;
        if (hi > lo) scan->n_cells[axis] = (int)fmax(1.0, fmin(floor((hi - lo) / scan->range), n_max));
        scan->inv_edge[axis] = hi > lo ? scan->n_cells[axis] / (hi - lo) : 0.0;
    }
}

static inline int cell_along(const hs_pair_scan *scan, int axis, double x)
{
    const int c = (int)((x - scan->lo[axis]) * scan->inv_edge[axis]);
    return c < 0 ? 0 : c >= scan->n_cells[axis] ? scan->n_cells[axis] - 1 : c;
}

static inline int64_t cell_of(const hs_pair_scan *scan, int i)
{
    const hs_atoms *atoms = &scan->atoms;
    return ((int64_t)cell_along(scan, 0, atoms->x[0][i]) * scan->n_cells[1] + cell_along(scan, 1, atoms->x[1][i])) *
               scan->n_cells[2] +
           cell_along(scan, 2, atoms->x[2][i]);
}

/** Counting sort of all atoms by cell. */
static hs_status sort_atoms(hs_pair_scan *scan, hs_error *err)
{
    const size_t n_cells = (size_t)scan->n_cells[0] * (size_t)scan->n_cells[1] * (size_t)scan->n_cells[2];
    const size_t n_all = (size_t)scan->n_all;
    HS_TRY(HS_ALLOC(scan->start, n_cells + 2, err));
    HS_TRY(HS_ALLOC(scan->index, n_all, err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(HS_ALLOC(scan->x[axis], n_all, err));
    int32_t *next = scan->start + 1; /* shifted by one: after the sort, start[c] is where cell c begins */
    for (int i = 0; i < scan->n_all; ++i) ++next[cell_of(scan, i) + 1];
    for (size_t c = 0; c < n_cells; ++c) next[c + 1] += next[c];
    for (int i = 0; i < scan->n_all; ++i) {
        const int place = next[cell_of(scan, i)]++;
        scan->index[place] = i;
        for (int axis = 0; axis < 3; ++axis) scan->x[axis][place] = scan->atoms.x[axis][i];
    }
    return HS_OK;
}

static hs_status begin(hs_pair_scan *scan, hs_env *env, hs_places places, double range, hs_error *err)
{
    scan->range = range;
    hs_status status = copy_atoms(scan, env, &places, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    const double drift = find_drift(env, &places);
    HS_TRY(check_drift(env, &places, drift, err));
    HS_TRY(hs_halo_build(&scan->halo, env->domain, env->parallel, places.box, &scan->atoms, range + 2.0 * drift, err));
    status = fill_halo(scan, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    scan->n_all = scan->atoms.n_local + scan->atoms.n_halo;
    set_cells(scan);
    status = sort_atoms(scan, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    return HS_OK;
}

hs_status hs_pair_scan_begin(hs_pair_scan *scan, hs_env *env, double range, hs_error *err)
{
    return begin(scan, env, hs_places_now(env), range, err);
}

hs_status hs_pair_scan_begin_at_forces(hs_pair_scan *scan, hs_env *env, double range, hs_error *err)
{
    HS_TRY(begin(scan, env, hs_places_of_forces(env), range, err));
    return take_listed(scan, env, err);
}

hs_status hs_pair_scan_begin_with_lists(hs_pair_scan *scan, hs_env *env, double range, hs_error *err)
{
    HS_TRY(begin(scan, env, hs_places_now(env), range, err));
    return take_listed(scan, env, err);
}

hs_status hs_pair_scan_begin_at_lists(hs_pair_scan *scan, hs_env *env, double range, hs_error *err)
{
    hs_pair_view view;
    env->view_pairs(env, &view);
    const hs_places places = {.x = {view.x_listed[0], view.x_listed[1], view.x_listed[2]}, .box = &view.box_listed};
    return begin(scan, env, places, range, err);
}

/** A batch that is being filled on one thread. */
typedef struct filling {
    const hs_pair_scan *scan;
    hs_pair_visit visit;
    void *context;
    int thread;
    hs_pair_batch batch;
} filling;

static void flush(filling *f)
{
    if (f->batch.n > 0) f->visit(f->context, f->thread, &f->batch);
    f->batch.n = 0;
}

static inline bool is_excluded(const hs_pair_scan *scan, int i, int j)
{
    return scan->excluded != NULL &&
           scan->excluded[(size_t)scan->atoms.type[i] * (size_t)scan->n_kernel_types + (size_t)scan->atoms.type[j]];
}

/** Atom i against a run of sorted atoms. Of two local atoms the one with the lower index meets the other. */
static inline void meet_run(filling *f, int i, const double x[3], int begin, int end)
{
    const hs_pair_scan *scan = f->scan;
    const double range2 = scan->range * scan->range;
    hs_pair_batch *batch = &f->batch;
    for (int k = begin; k < end; ++k) {
        const double dx = scan->x[0][k] - x[0], dy = scan->x[1][k] - x[1], dz = scan->x[2][k] - x[2];
        const double r2 = dx * dx + dy * dy + dz * dz;
        if (!(r2 < range2)) continue;
        const int j = scan->index[k];
        if (j <= i || is_excluded(scan, i, j)) continue; /* halo atoms have the higher indices */
        const int n = batch->n++;
        batch->i[n] = i;
        batch->j[n] = j;
        batch->dx[0][n] = dx;
        batch->dx[1][n] = dy;
        batch->dx[2][n] = dz;
        batch->r2[n] = r2;
        if (batch->n == HS_PAIR_BATCH) flush(f);
    }
}

static void visit_atom(filling *f, int i)
{
    const hs_pair_scan *scan = f->scan;
    const double x[3] = {scan->atoms.x[0][i], scan->atoms.x[1][i], scan->atoms.x[2][i]};
    int lo[3], hi[3];
    for (int axis = 0; axis < 3; ++axis) {
        /* one cell each way, more where cells had to be smaller than the range because of rounding */
        lo[axis] = cell_along(scan, axis, x[axis] - scan->range);
        hi[axis] = cell_along(scan, axis, x[axis] + scan->range);
    }
    for (int a = lo[0]; a <= hi[0]; ++a)
        for (int b = lo[1]; b <= hi[1]; ++b) {
            const int32_t *column = scan->start + ((int64_t)a * scan->n_cells[1] + b) * scan->n_cells[2];
            meet_run(f, i, x, column[lo[2]], column[hi[2] + 1]);
        }
}

void hs_pair_scan_visit(const hs_pair_scan *scan, hs_pair_visit visit, void *context)
{
#pragma omp parallel
    {
        filling f = {.scan = scan, .visit = visit, .context = context, .thread = hs_thread_number()};
#pragma omp for schedule(static)
        for (int i = 0; i < scan->atoms.n_local; ++i) visit_atom(&f, i);
        flush(&f);
    }
}

void hs_pair_scan_reverse(hs_pair_scan *scan) { hs_halo_reverse(&scan->halo, &scan->atoms, false); }

/** Numbers of pairs that the sums of one atom must hold without rounding. */
static const double pairs_max = 4096.0;

typedef struct sharing {
    hs_pair_scan *scan;
    hs_pair_share share;
    void *context;
    int n, first; /**< values of a pair; the first of the up to three that are summed now */
    double sign;  /**< of those of atom j */
    double scale; /**< values are rounded to multiples of 1 / scale, whose sums are exact in any order */
    double largest[3];
} sharing;

static void find_largest(void *context, int thread, const hs_pair_batch *batch)
{
    sharing *s = context;
    double values[HS_PAIR_VALUES_MAX][HS_PAIR_BATCH], largest = 0.0;
    (void)thread;
    s->share(s->context, batch, values);
    for (int k = 0; k < s->n; ++k)
        for (int p = 0; p < batch->n; ++p) largest = fmax(largest, fabs(values[k][p]));
#pragma omp critical(hs_pair_scan_largest)
    s->largest[0] = fmax(s->largest[0], largest);
}

static void add_values(void *context, int thread, const hs_pair_batch *batch)
{
    const sharing *s = context;
    double values[HS_PAIR_VALUES_MAX][HS_PAIR_BATCH];
    (void)thread;
    s->share(s->context, batch, values);
    for (int k = 0; k < 3 && s->first + k < s->n; ++k) {
        double *f = s->scan->atoms.f[k];
        for (int p = 0; p < batch->n; ++p) {
            const double rounded = rint(values[s->first + k][p] * s->scale);
#pragma omp atomic
            f[batch->i[p]] += rounded;
#pragma omp atomic
            f[batch->j[p]] += s->sign * rounded;
        }
    }
}

hs_status hs_pair_scan_share(hs_pair_scan *scan, const hs_env *env, int n, bool is_odd, hs_pair_share share,
                             void *context, double *sums, hs_error *err)
{
    sharing s = {.scan = scan, .share = share, .context = context, .n = n, .sign = is_odd ? -1.0 : 1.0};
    const int n_local = scan->atoms.n_local;
    hs_pair_scan_visit(scan, find_largest, &s);
    hs_parallel_max_double(env->parallel, s.largest, 1);
    if (!isfinite(s.largest[0]))
        return hs_fail(err, HS_ERROR_RUN,
                       "two atoms are in the same place, or so near that their energy is not finite");
    int exponent = 0;
    frexp(s.largest[0] * pairs_max, &exponent);
    s.scale = ldexp(1.0, 52 - exponent);
    for (s.first = 0; s.first < n; s.first += 3) {
        for (int k = 0; k < 3; ++k) memset(scan->atoms.f[k], 0, (size_t)scan->n_all * sizeof(double));
        hs_pair_scan_visit(scan, add_values, &s);
        hs_pair_scan_reverse(scan);
        for (int k = 0; k < 3 && s.first + k < n; ++k)
            for (int i = 0; i < n_local; ++i)
                sums[(size_t)(s.first + k) * (size_t)n_local + (size_t)i] = scan->atoms.f[k][i] / s.scale;
    }
    return HS_OK;
}

int hs_pair_scan_source(const hs_pair_scan *scan, int j)
{
    const int n_local = scan->atoms.n_local;
    if (j < n_local) return j;
    return scan->source_of[j - n_local];
}

void hs_pair_scan_end(hs_pair_scan *scan)
{
    hs_halo_fini(&scan->halo);
    if (scan->mask != NULL) hs_atoms_remove_field(&scan->atoms, (void **)&scan->mask);
    if (scan->id != NULL) hs_atoms_remove_field(&scan->atoms, (void **)&scan->id);
    if (scan->radius != NULL) hs_atoms_remove_field(&scan->atoms, (void **)&scan->radius);
    for (int axis = 0; axis < 3; ++axis)
        if (scan->x_listed[axis] != NULL) hs_atoms_remove_field(&scan->atoms, (void **)&scan->x_listed[axis]);
    hs_atoms_fini(&scan->atoms);
    HS_FREE(scan->start);
    HS_FREE(scan->index);
    HS_FREE(scan->source_of);
    for (int axis = 0; axis < 3; ++axis) HS_FREE(scan->x[axis]);
    memset(scan, 0, sizeof *scan);
}
