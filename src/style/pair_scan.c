#include "style/pair_scan.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/wide.h"
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

/** Cells over all atoms, not many more than atoms, and wider than the range by more than coordinates are rounded: pairs are in one
 *  cell or in neighboring ones. The axis with the most cells comes first: see hs_pair_scan_visit. */
static void set_cells(hs_pair_scan *scan)
{
    const hs_atoms *atoms = &scan->atoms;
    const double n_max = cbrt(4.0 * (double)scan->n_all) + 1.0, edge = scan->range * (1.0 + 1e-9);
    int longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        double lo = DBL_MAX, hi = -DBL_MAX;
        for (int i = 0; i < scan->n_all; ++i) {
            lo = fmin(lo, atoms->x[axis][i]);
            hi = fmax(hi, atoms->x[axis][i]);
        }
        scan->lo[axis] = lo;
        scan->n_cells[axis] = 1;
        if (hi > lo) scan->n_cells[axis] = (int)fmax(1.0, fmin(floor((hi - lo) / edge), n_max));
        scan->inv_edge[axis] = hi > lo ? scan->n_cells[axis] / (hi - lo) : 0.0;
        if (scan->n_cells[axis] > scan->n_cells[longest]) longest = axis;
    }
    for (int k = 0; k < 3; ++k) scan->axis[k] = (longest + k) % 3;
}

static inline int cell_along(const hs_pair_scan *scan, int axis, double x)
{
    const int c = (int)((x - scan->lo[axis]) * scan->inv_edge[axis]);
    return c < 0 ? 0 : c >= scan->n_cells[axis] ? scan->n_cells[axis] - 1 : c;
}

/** Number of the cell at places a, b, c along scan->axis. */
static inline int64_t cell_number(const hs_pair_scan *scan, int a, int b, int c)
{
    return ((int64_t)a * scan->n_cells[scan->axis[1]] + b) * scan->n_cells[scan->axis[2]] + c;
}

static inline int64_t cell_of(const hs_pair_scan *scan, int i)
{
    int place[3];
    for (int k = 0; k < 3; ++k) place[k] = cell_along(scan, scan->axis[k], scan->atoms.x[scan->axis[k]][i]);
    return cell_number(scan, place[0], place[1], place[2]);
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
    scan->isa = env->isa;
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
    hs_near_find find_near;
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

/** Pair of the atoms at two places, the one with the lower index first, which is local if one is. */
static inline void add_pair(filling *f, int place, int other)
{
    const hs_pair_scan *scan = f->scan;
    const int one = scan->index[place], two = scan->index[other], i = one < two ? one : two, j = one < two ? two : one;
    const double sign = one < two ? 1.0 : -1.0;
    hs_pair_batch *batch = &f->batch;
    if (i >= scan->atoms.n_local || is_excluded(scan, i, j)) return;
    const int n = batch->n++;
    batch->i[n] = i;
    batch->j[n] = j;
    for (int axis = 0; axis < 3; ++axis) batch->dx[axis][n] = sign * (scan->x[axis][other] - scan->x[axis][place]);
    batch->r2[n] =
        batch->dx[0][n] * batch->dx[0][n] + batch->dx[1][n] * batch->dx[1][n] + batch->dx[2][n] * batch->dx[2][n];
    if (batch->n == HS_PAIR_BATCH) flush(f);
}

/** The atom at a place of the sorted atoms against those at places begin to end - 1. */
static void meet_run(filling *f, int place, int begin, int end)
{
    enum { RUN = 128 };
    const hs_pair_scan *scan = f->scan;
    const double *const x[3] = {scan->x[0], scan->x[1], scan->x[2]}, at[3] = {x[0][place], x[1][place], x[2][place]};
    int32_t near[RUN + HS_NEAR_PAD];
    for (int first = begin; first < end; first += RUN) {
        const int last = first + RUN < end ? first + RUN : end;
        const int n = f->find_near(x, at, scan->range * scan->range, first, last, near);
        for (int k = 0; k < n; ++k) add_pair(f, place, near[k]);
    }
}

/** The atoms of cell c of column (a, b) against those behind them in it, in the next one, and in the columns behind: each pair is met
 *  once, from the atom whose place is lower. */
static void visit_cell(filling *f, int a, int b, int c)
{
    const hs_pair_scan *scan = f->scan;
    const int *n = scan->n_cells, *axis = scan->axis, next_b = b + 1 < n[axis[1]] ? b + 1 : b;
    const int lo = c > 0 ? c - 1 : c, hi = c + 1 < n[axis[2]] ? c + 1 : c, before_b = b > 0 ? b - 1 : b;
    const int32_t *start = scan->start;
    const int end = start[cell_number(scan, a, b, hi) + 1];
    for (int place = start[cell_number(scan, a, b, c)]; place < start[cell_number(scan, a, b, c) + 1]; ++place) {
        meet_run(f, place, place + 1, end);
        if (next_b > b)
            meet_run(f, place, start[cell_number(scan, a, next_b, lo)], start[cell_number(scan, a, next_b, hi) + 1]);
        for (int other = before_b; a + 1 < n[axis[0]] && other <= next_b; ++other)
            meet_run(f, place, start[cell_number(scan, a + 1, other, lo)],
                     start[cell_number(scan, a + 1, other, hi) + 1]);
    }
}

/** A thread's share: every second layer of cells, then those between, so that two layers that are visited at the same time have
 *  one between them at which one of them ends. */
static void visit_share(const hs_pair_scan *scan, hs_pair_visit visit, void *context)
{
    filling f = {.scan = scan,
                 .visit = visit,
                 .context = context,
                 .thread = hs_thread_number(),
                 .find_near = hs_isa_near(scan->isa)};
    const int *n = scan->n_cells, *axis = scan->axis;
    for (int first = 0; first < 2; ++first) {
#pragma omp for schedule(static, 1)
        for (int a = first; a < n[axis[0]]; a += 2) {
            for (int b = 0; b < n[axis[1]]; ++b)
                for (int c = 0; c < n[axis[2]]; ++c) visit_cell(&f, a, b, c);
            flush(&f);
        }
    }
}

void hs_pair_scan_visit(const hs_pair_scan *scan, hs_pair_visit visit, void *context)
{
    HS_ON_THREADS(visit_share(scan, visit, context));
}

void hs_pair_scan_reverse(hs_pair_scan *scan) { hs_halo_reverse(&scan->halo, &scan->atoms, false); }

/* Values are added as whole numbers of less than so many bits, which leaves room for 2^12 pairs of an atom. */
enum { VALUE_BITS = 51 };

/** Sums of shares on their way. */
typedef struct sum_of_shares {
    const hs_pair_sharing *of;
    double scale;   /**< values are multiples of 1 / scale; 0: not known yet, the largest one is wanted */
    double largest; /**< value of a pair */
    int64_t *sum;   /**< owned [n_all][of->n] */
} sum_of_shares;

/** Largest size of n values of some pairs; infinite if one is not a number. */
HS_WIDE static double largest_of(double (*values)[HS_PAIR_BATCH], int n, int n_pairs)
{
    double most[HS_PAIR_BATCH] = {0.0};
    for (int k = 0; k < n; ++k)
        for (int p = 0; p < n_pairs; ++p) {
            const double value = values[k][p], size = value == value ? fabs(value) : INFINITY;
            most[p] = size > most[p] ? size : most[p];
        }
    for (int half = HS_PAIR_BATCH / 2; half > 0; half /= 2)
        for (int p = 0; p < half; ++p) most[p] = most[p] > most[p + half] ? most[p] : most[p + half];
    return most[0];
}

/** values * scale as whole numbers, rounded: adding the magic number leaves them in the low bits of the double's pattern. */
HS_WIDE static void round_values(double (*values)[HS_PAIR_BATCH], int n, int n_pairs, double scale,
                                 int64_t (*rounded)[HS_PAIR_BATCH])
{
    const double magic = 0x1.8p52;
    for (int k = 0; k < n; ++k)
        for (int p = 0; p < n_pairs; ++p) {
            const double sum = values[k][p] * scale + magic;
            int64_t pattern;
            memcpy(&pattern, &sum, sizeof pattern);
            rounded[k][p] = pattern - INT64_C(0x4338000000000000);
        }
}

static void add_shares(void *context, int thread, const hs_pair_batch *batch)
{
    sum_of_shares *s = context;
    const int n = s->of->n, sign = s->of->is_odd ? -1 : 1;
    double values[HS_PAIR_VALUES_MAX][HS_PAIR_BATCH];
    int64_t rounded[HS_PAIR_VALUES_MAX][HS_PAIR_BATCH];
    (void)thread;
    s->of->share(s->of->context, batch, values);
    const double largest = largest_of(values, n, batch->n);
#pragma omp critical(hs_pair_scan_largest)
    s->largest = largest > s->largest ? largest : s->largest;
    if (s->scale == 0.0 || !(largest * s->scale < 0x1p51)) return;
    round_values(values, n, batch->n, s->scale, rounded);
    for (int p = 0; p < batch->n; ++p) {
        int64_t *one = s->sum + (size_t)batch->i[p] * (size_t)n, *two = s->sum + (size_t)batch->j[p] * (size_t)n;
        for (int k = 0; k < n; ++k) {
            one[k] += rounded[k][p];
            two[k] += sign * rounded[k][p];
        }
    }
}

/** Values [first, first + 3) of all atoms, with what halo atoms bring home; f holds whole numbers meanwhile. */
static void bring_home(hs_pair_scan *scan, const sum_of_shares *s, int first, double *sums)
{
    const size_t n_local = (size_t)scan->atoms.n_local, n = (size_t)s->of->n;
    const int n_now = s->of->n - first < 3 ? s->of->n - first : 3;
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < scan->n_all; ++i) {
            const int64_t sum = k < n_now ? s->sum[(size_t)i * n + (size_t)(first + k)] : 0;
            memcpy(&scan->atoms.f[k][i], &sum, sizeof sum);
        }
    hs_halo_reverse(&scan->halo, &scan->atoms, true);
    for (int k = 0; k < n_now; ++k)
        for (size_t i = 0; i < n_local; ++i) {
            int64_t sum;
            memcpy(&sum, &scan->atoms.f[k][i], sizeof sum);
            sums[(size_t)(first + k) * n_local + i] = (double)sum / s->scale;
        }
}

/** Scale at which no value below `largest` has more than VALUE_BITS bits. */
static double scale_for(double largest)
{
    int exponent = 0;
    frexp(largest, &exponent); /* smaller than 2^exponent */
    return ldexp(1.0, VALUE_BITS - exponent);
}

/** Add all up at the scale; s->largest becomes that of all ranks (collective). */
static void visit_shares(const hs_pair_scan *scan, const hs_env *env, sum_of_shares *s)
{
    s->largest = 0.0;
    hs_pair_scan_visit(scan, add_shares, s);
    hs_parallel_max_double(env->parallel, &s->largest, 1);
}

hs_status hs_pair_scan_share(hs_pair_scan *scan, const hs_env *env, const hs_pair_sharing *sharing, double *sums,
                             hs_error *err)
{
    sum_of_shares s = {.of = sharing, .scale = sharing->expected > 0.0 ? scale_for(sharing->expected) : 0.0};
    const size_t n_sums = (size_t)scan->n_all * (size_t)sharing->n;
    HS_UNLESS_FAILED(err, HS_ALLOC(s.sum, n_sums, err));
    hs_status status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) visit_shares(scan, env, &s);
    if (status == HS_OK && !isfinite(s.largest))
        status =
            hs_fail(err, HS_ERROR_RUN, "two atoms are in the same place, or so near that their energy is not finite");
    if (status == HS_OK && (s.scale == 0.0 || !(s.largest * s.scale < 0x1p51))) {
        s.scale = scale_for(s.largest);
        if (n_sums > 0) memset(s.sum, 0, n_sums * sizeof *s.sum);
        visit_shares(scan, env, &s);
    }
    for (int first = 0; first < sharing->n && status == HS_OK; first += 3) bring_home(scan, &s, first, sums);
    HS_FREE(s.sum);
    return status;
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
