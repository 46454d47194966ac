/* The force kernel that counts the distances of its pairs, and the pass over a list that only counts: the histogram of
 * the plain sum over all pairs and images, and the forces of the kernel that does not count, bit for bit; in every
 * instruction set, in double and in fixed point, in two and three dimensions. */
#include "kernel/pair_system.h"

extern const hs_evaluator hs_evaluator_lj_cut;

static const double cutoff = 2.5;

static void begin_system(system_t *s, int dimension, const double length[3], const char *boundary)
{
    const double p[5] = {48.0, -24.0, 4.0, -4.0, 0.1};
    begin_box(s, &hs_evaluator_lj_cut, dimension, length, boundary, 1);
    set_row(s, 1, 1, cutoff, p);
    s->table.is_uniform = hs_pair_table_is_uniform(&s->table);
}

/** Places on a grid of 2^-20, as in reproducible runs: then distances to images are without rounding. */
static void round_places(system_t *s)
{
    for (int axis = 0; axis < 3; ++axis) {
        s->box.lo[axis] = ldexp(rint(ldexp(s->box.lo[axis], 20)), -20);
        s->box.hi[axis] = ldexp(rint(ldexp(s->box.hi[axis], 20)), -20);
        for (int i = 0; i < s->atoms.n_local; ++i)
            s->atoms.x[axis][i] = ldexp(rint(ldexp(s->atoms.x[axis][i], 20)), -20);
    }
}

/** One of each two ordered pairs of atom i with atom j and its images. */
static int64_t count_images(const system_t *s, int i, int j, const int m[3], int n_bins, int64_t *counts)
{
    int64_t n_pairs = 0;
    for (int a = -m[0]; a <= m[0]; ++a)
        for (int b = -m[1]; b <= m[1]; ++b)
            for (int c = -m[2]; c <= m[2]; ++c) {
                const int shift[3] = {a, b, c};
                double r2 = 0.0;
                for (int axis = 0; axis < 3; ++axis) {
                    const double d =
                        s->atoms.x[axis][i] - s->atoms.x[axis][j] - shift[axis] * hs_box_length(&s->box, axis);
                    r2 += d * d;
                }
                if ((i == j && a == 0 && b == 0 && c == 0) || !(r2 < cutoff * cutoff)) continue;
                ++counts[(int)(sqrt(r2) / (cutoff / n_bins))];
                ++n_pairs;
            }
    return n_pairs;
}

/** counts[n_bins]: pairs, each once. */
static int64_t count_plainly(const system_t *s, int n_bins, int64_t *counts)
{
    int m[3];
    int64_t n_pairs = 0;
    memset(counts, 0, (size_t)n_bins * sizeof *counts);
    for (int axis = 0; axis < 3; ++axis)
        m[axis] =
            s->box.periodic[axis] && axis < s->box.dimension ? (int)ceil(cutoff / hs_box_length(&s->box, axis)) : 0;
    for (int i = 0; i < s->atoms.n_local; ++i)
        for (int j = 0; j < s->atoms.n_local; ++j) n_pairs += count_images(s, i, j, m, n_bins, counts);
    for (int k = 0; k < n_bins; ++k) counts[k] /= 2;
    return n_pairs / 2;
}

/** @p right: pairs by distance; @p forces: of the plain sum. */
static void check(system_t *s, hs_isa isa, hs_precision precision, int n_bins, const int64_t *right,
                  const forces_t *forces, const char *what)
{
    counting_t counting = {.counter = {.r_max = cutoff, .n_bins = n_bins}};
    char name[160];
    snprintf(name, sizeof name, "%s, %s, %s, %d bins", what, hs_isa_names[isa], form_names[precision], n_bins);
    ck_assert_hs_ok(HS_ALLOC(counting.on_the_way, (size_t)n_bins, &err), err);
    ck_assert_hs_ok(HS_ALLOC(counting.anew, (size_t)n_bins, &err), err);
    forces_t counted = evaluate_counting(s, CLUSTER, isa, precision, false, &counting);
    forces_t plain = evaluate_with(s, CLUSTER, isa, precision, false);
    for (int k = 0; k < n_bins; ++k) {
        ck_assert_msg(counting.on_the_way[k] == right[k], "%s: with the forces %lld pairs in bin %d, not %lld", name,
                      (long long)counting.on_the_way[k], k, (long long)right[k]);
        ck_assert_msg(counting.anew[k] == right[k], "%s: by a pass of its own %lld pairs in bin %d, not %lld", name,
                      (long long)counting.anew[k], k, (long long)right[k]);
    }
    /* in floating point threads that take each other's work add in any order */
    const bool is_same = precision == HS_PRECISION_FIXED || hs_threads_get() == 1;
    for (int axis = 0; axis < 3 && is_same; ++axis)
        ck_assert_msg(s->atoms.n_local == 0 ||
                          memcmp(counted.f[axis], plain.f[axis], (size_t)s->atoms.n_local * sizeof *plain.f[axis]) == 0,
                      "%s: counting changes forces along %c", name, "xyz"[axis]);
    assert_same(&counted, forces, s->atoms.n_local, false, 1e-12, name);
    free_forces(&counted);
    free_forces(&plain);
    hs_pair_counter_fini(&counting.counter);
    HS_FREE(counting.on_the_way);
    HS_FREE(counting.anew);
}

static void check_system(int dimension, const double length[3], const char *boundary, int n, double least,
                         const char *what)
{
    static const int bins[] = {1, 7, 100, HS_HISTOGRAM_BINS_MAX};
    static const hs_precision precisions[] = {HS_PRECISION_DOUBLE, HS_PRECISION_FIXED};
    system_t s;
    int64_t right[HS_HISTOGRAM_BINS_MAX], n_pairs = 0;
    int n_runs = 0;
    begin_system(&s, dimension, length, boundary);
    add_random(&s, n, least, 77);
    round_places(&s);
    forces_t forces = sum_all_images(&s);
    for (size_t b = 0; b < sizeof bins / sizeof bins[0]; ++b) {
        n_pairs = count_plainly(&s, bins[b], right);
        for (int isa = 0; isa <= (int)hs_isa_best(); ++isa)
            for (int p = 0; p < 2; ++p) {
                hs_threads_set(1 + n_runs++ % 3);
                check(&s, (hs_isa)isa, precisions[p], bins[b], right, &forces, what);
            }
    }
    free_forces(&forces);
    ck_assert_msg(n < 50 || n_pairs > n, "%s: %lld pairs are too few for a test", what, (long long)n_pairs);
    end_system(&s);
}

START_TEST(liquid)
{
    check_system(3, (const double[]){9.0, 8.1, 7.7}, "ppp", 380, 0.8, "liquid");
    check_system(3, (const double[]){9.0, 8.1, 7.7}, "fpf", 380, 0.8, "liquid between walls");
}
END_TEST
/* More than the queue and a 16-bit counter hold: one bin gets 77,000 pairs. */
START_TEST(many_pairs) { check_system(3, (const double[]){7.5, 7.5, 7.5}, "ppp", 1000, 0.4, "many pairs"); }
END_TEST
START_TEST(disks)
{
    check_system(2, (const double[]){21.0, 17.0, 1.0}, "ppp", 250, 0.8, "disks");
    check_system(2, (const double[]){21.0, 17.0, 1.0}, "pfp", 250, 0.8, "disks between walls");
}
END_TEST
START_TEST(boxes_smaller_than_the_cutoff)
{
    check_system(3, (const double[]){1.3, 1.9, 2.3}, "ppp", 3, 0.8, "small box");
    check_system(2, (const double[]){2.1, 1.9, 1.0}, "ppp", 2, 0.8, "small plane");
}
END_TEST
START_TEST(few_atoms)
{
    check_system(3, (const double[]){5.0, 6.0, 7.0}, "ppp", 2, 0.8, "two atoms");
    check_system(3, (const double[]){5.0, 6.0, 7.0}, "ppp", 0, 0.8, "no atom");
}
END_TEST

/** What the counting kernel cannot do is refused: other ranges, energies, several types. */
START_TEST(refusals)
{
    system_t s;
    begin_system(&s, 3, (const double[]){5.0, 6.0, 7.0}, "ppp");
    hs_force_job job = {.evaluator = s.evaluator, .precision = HS_PRECISION_DOUBLE, .input = {.table = &s.table}};
    ck_assert(hs_force_can_count(&job, cutoff));
    ck_assert(!hs_force_can_count(&job, 2.4));
    job.with_energy = true;
    ck_assert(!hs_force_can_count(&job, cutoff));
    job.with_energy = false;
    job.precision = HS_PRECISION_MIXED;
    ck_assert(!hs_force_can_count(&job, cutoff));
    job.precision = HS_PRECISION_FIXED;
    s.table.is_uniform = false;
    ck_assert(!hs_force_can_count(&job, cutoff));
    end_system(&s);
}
END_TEST

HS_TEST_MAIN("kernels that count distances", liquid, many_pairs, disks, boxes_smaller_than_the_cutoff, few_atoms,
             refusals)
