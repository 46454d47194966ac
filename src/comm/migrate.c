#include "comm/migrate.h"

#include <math.h>

#include "base/memory.h"
#include "parallel/messages.h"

/** What goes to the bricks below (0) and above (1) along an axis, and what comes from them. */
typedef struct traffic {
    size_t record;       /**< bytes an atom */
    int32_t *leaver;     /**< owned: local atoms that leave, ascending */
    unsigned char *side; /**< owned: where each of them goes */
    int n_leavers, capacity;
    int64_t n_out[2], n_in[2];
    char *out[2], *in[2]; /**< owned: records */
} traffic;

static void fini_traffic(traffic *t)
{
    HS_FREE(t->leaver);
    HS_FREE(t->side);
    for (int side = 0; side < 2; ++side) {
        HS_FREE(t->out[side]);
        HS_FREE(t->in[side]);
    }
}

/** Ranks of the neighbor bricks along an axis; -1 beyond a face that is not periodic. Two bricks around a periodic axis
 *  are neighbors on both sides: one message is enough. */
static void find_partners(const hs_domain *domain, const hs_box *box, int axis, int partner[2])
{
    const int n = domain->n[axis];
    for (int side = 0; side < 2; ++side) {
        int at[3] = {domain->at[0], domain->at[1], domain->at[2]};
        at[axis] += side == 0 ? -1 : 1;
        const bool is_inside = at[axis] >= 0 && at[axis] < n;
        partner[side] = is_inside || box->periodic[axis] ? hs_domain_rank(domain, at) : -1;
    }
    if (partner[0] == partner[1]) partner[0] = -1;
}

/** Towards which neighbor a brick lies: the nearer way around a periodic axis. */
static int side_towards(const hs_domain *domain, const hs_box *box, int axis, int owner, const int partner[2])
{
    const int n = domain->n[axis], distance = owner - domain->at[axis];
    int side = distance > 0;
    if (box->periodic[axis] && 2 * (distance > 0 ? distance : -distance) > n) side = !side;
    return partner[side] < 0 ? !side : side;
}

/** Coordinate of an atom by which it belongs to a brick. */
static inline double coordinate_of(const hs_atoms *atoms, const hs_box *box, int axis, int i)
{
    if (!box->is_tilted) return atoms->x[axis][i];
    return hs_box_upright(box, (const double[3]){atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]}, axis);
}

static hs_status list_leavers(traffic *t, const hs_atoms *atoms, const hs_domain *domain, const hs_box *box, int axis,
                              const int partner[2], hs_error *err)
{
    const double lo = domain->at[axis] > 0 ? hs_domain_plane(domain, box, axis, domain->at[axis]) : -INFINITY;
    const double hi =
        domain->at[axis] < domain->n[axis] - 1 ? hs_domain_plane(domain, box, axis, domain->at[axis] + 1) : INFINITY;
    t->n_leavers = 0;
    for (int i = 0; i < atoms->n_local; ++i) {
        const double x = coordinate_of(atoms, box, axis, i);
        if (x >= lo && x < hi) continue;
        if (t->n_leavers == t->capacity) {
            const size_t capacity = (size_t)t->capacity * 2 + 256, n = (size_t)t->n_leavers;
            HS_TRY(HS_GROW(t->leaver, n, capacity, err));
            HS_TRY(HS_GROW(t->side, n, capacity, err));
            t->capacity = (int)capacity;
        }
        const int side = side_towards(domain, box, axis, hs_domain_owner(domain, box, axis, x), partner);
        t->leaver[t->n_leavers] = i;
        t->side[t->n_leavers++] = (unsigned char)side;
        ++t->n_out[side];
    }
    return HS_OK;
}

static hs_status pack(traffic *t, const hs_atoms *atoms, hs_error *err)
{
    char *next[2];
    for (int side = 0; side < 2; ++side) {
        HS_TRY(hs_memory_alloc((void **)&t->out[side], (size_t)t->n_out[side], t->record, err));
        next[side] = t->out[side];
    }
    for (int k = 0; k < t->n_leavers; ++k) {
        hs_atoms_pack(atoms, t->leaver[k], next[t->side[k]]);
        next[t->side[k]] += t->record;
    }
    return HS_OK;
}

/** One message each way with every neighbor: `n` words of `size` bytes. */
static hs_status add_messages(hs_messages *messages, const int partner[2], char *const out[2], const int64_t n_out[2],
                              char *const in[2], const int64_t n_in[2], size_t size, hs_error *err)
{
    for (int side = 0; side < 2; ++side) {
        if (partner[side] < 0) continue;
        if (n_in[side] > 0) HS_TRY(hs_messages_receive(messages, partner[side], in[side], n_in[side], size, err));
        if (n_out[side] > 0) HS_TRY(hs_messages_send(messages, partner[side], out[side], n_out[side], size, err));
    }
    return HS_OK;
}

static hs_status make_room(traffic *t, hs_atoms *atoms, hs_error *err)
{
    const int64_t n = (int64_t)atoms->n_local - t->n_leavers + t->n_in[0] + t->n_in[1];
    for (int side = 0; side < 2; ++side)
        HS_TRY(hs_memory_alloc((void **)&t->in[side], (size_t)t->n_in[side], t->record, err));
    return n > atoms->capacity_local ? hs_atoms_reserve(atoms, n + n / 8 + 64, 0, err) : HS_OK;
}

/** Move the atoms beyond this brick one brick on along an axis (collective). */
static hs_status shift_along(hs_atoms *atoms, const hs_domain *domain, const hs_parallel *parallel, const hs_box *box,
                             int axis, hs_error *err)
{
    static const int64_t one[2] = {1, 1};
    traffic t = {.record = hs_atoms_record_size(atoms)};
    hs_messages messages = {0};
    int partner[2];
    find_partners(domain, box, axis, partner);
    char *const out[2] = {(char *)&t.n_out[0], (char *)&t.n_out[1]}, *const in[2] = {(char *)&t.n_in[0],
                                                                                     (char *)&t.n_in[1]};
    HS_UNLESS_FAILED(err, list_leavers(&t, atoms, domain, box, axis, partner, err));
    HS_UNLESS_FAILED(err, pack(&t, atoms, err));
    HS_UNLESS_FAILED(err, add_messages(&messages, partner, out, one, in, one, sizeof t.n_out[0], err));
    hs_status status = hs_messages_transfer(&messages, parallel, err);
    if (status == HS_OK) {
        HS_UNLESS_FAILED(err, make_room(&t, atoms, err));
        HS_UNLESS_FAILED(err, add_messages(&messages, partner, t.out, t.n_out, t.in, t.n_in, t.record, err));
        status = hs_messages_transfer(&messages, parallel, err);
    }
    if (status == HS_OK) {
        if (t.n_leavers > 0) hs_atoms_take_out(atoms, t.leaver, t.n_leavers);
        for (int side = 0; side < 2; ++side)
            for (int64_t k = 0; k < t.n_in[side]; ++k) hs_atoms_unpack(atoms, t.in[side] + (size_t)k * t.record);
    }
    hs_messages_fini(&messages);
    fini_traffic(&t);
    return status;
}

/** Whether atoms of any rank are not where they belong; an error when any rank holds one (collective). */
static hs_status find_misplaced(const hs_atoms *atoms, const hs_domain *domain, const hs_parallel *parallel,
                                const hs_box *box, bool *found, hs_error *err)
{
    int64_t n = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int k = domain->at[axis];
        const double lo = k > 0 ? hs_domain_plane(domain, box, axis, k) : -INFINITY;
        const double hi = k < domain->n[axis] - 1 ? hs_domain_plane(domain, box, axis, k + 1) : INFINITY;
        if (domain->n[axis] == 1) continue;
#pragma omp parallel for schedule(static) reduction(+ : n)
        for (int i = 0; i < atoms->n_local; ++i) {
            const double x = coordinate_of(atoms, box, axis, i);
            n += !(x >= lo && x < hi);
        }
    }
    int64_t counts[2] = {n, err->status != HS_OK};
    hs_parallel_sum_int64(parallel, counts, 2);
    *found = counts[0] > 0;
    return counts[1] > 0 ? hs_parallel_agree(parallel, err) : HS_OK;
}

hs_status hs_migrate(hs_atoms *atoms, const hs_domain *domain, const hs_parallel *parallel, const hs_box *box,
                     hs_error *err)
{
    if (domain->n_ranks == 1) return err->status;
    for (;;) {
        bool found;
        HS_TRY(find_misplaced(atoms, domain, parallel, box, &found, err));
        if (!found) return HS_OK;
        for (int axis = 0; axis < 3; ++axis)
            if (domain->n[axis] > 1) HS_TRY(shift_along(atoms, domain, parallel, box, axis, err));
    }
}
