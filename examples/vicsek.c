/* A flock: the model of Vicsek et al. (Phys. Rev. Lett. 75, 1226 (1995), doi:10.1103/PhysRevLett.75.1226), with the
 * neighbors from Halfshell's cell lists.
 *
 * Birds fly at constant speed in a periodic square. At every step each takes the mean direction of all birds closer
 * than 1 to it, itself among them, turned by a random angle. With little noise the flock aligns: the order parameter,
 * the length of the mean direction, goes to 1; with much noise it stays near 0.
 *
 *     vicsek [BIRDS [STEPS [NOISE]]]        prints: step, order parameter, mean number of neighbors
 *
 * Built with pkg-config (for a library in a place of its own, set PKG_CONFIG_PATH):
 *     cc -O2 vicsek.c -o vicsek $(pkg-config --cflags --libs halfshell) -lm
 * or with CMake: see CMakeLists.txt beside this file. */
#include <halfshell/cells.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Positions in single precision and inside of a structure: the list takes them as they are. */
typedef struct bird {
    float x, y;
    float direction;    /* radians */
    float sum_x, sum_y; /* of the directions around */
} bird;

static double uniform(void) { return rand() / (RAND_MAX + 1.0); }

static void add_direction(bird *to, const bird *from)
{
    to->sum_x += cosf(from->direction);
    to->sum_y += sinf(from->direction);
}

int main(int argc, char **argv)
{
    const int n = argc > 1 ? atoi(argv[1]) : 2000, n_steps = argc > 2 ? atoi(argv[2]) : 500;
    const double noise = argc > 3 ? atof(argv[3]) : 0.5, speed = 0.03, density = 4.0, pi = 3.14159265358979;
    if (n < 1 || n_steps < 0) {
        fprintf(stderr, "usage: vicsek [BIRDS [STEPS [NOISE]]]\n");
        return 1;
    }
    const double length = sqrt(n / density);
    const hs_cell_list_box box = {.dimension = 2, .hi = {length, length, 0.0}, .periodic = {1, 1, 0}};
    bird *birds = calloc((size_t)n, sizeof *birds);
    hs_cell_list *list = NULL;
    if (birds == NULL || hs_cell_list_create(&list, &box, 1.0, NULL) != HS_CODE_OK) {
        fprintf(stderr, "vicsek: %s\n", hs_cell_list_error(list));
        return 1;
    }
    for (int i = 0; i < n; ++i)
        birds[i] =
            (bird){(float)(length * uniform()), (float)(length * uniform()), (float)(2.0 * pi * uniform()), 0, 0};

    for (int step = 0; step <= n_steps; ++step) {
        /* 1. cells; 2. each pair of near birds, once; 3. turn and fly */
        if (hs_cell_list_build_float(list, n, &birds[0].x, &birds[0].y, NULL, sizeof *birds) != HS_CODE_OK) {
            fprintf(stderr, "vicsek: %s\n", hs_cell_list_error(list));
            return 1;
        }
        for (int i = 0; i < n; ++i) {
            birds[i].sum_x = birds[i].sum_y = 0.0f;
            add_direction(&birds[i], &birds[i]);
        }
        long long n_pairs = 0;
        hs_cell_pair pair;
        for (hs_cell_iterator at = hs_cell_list_pairs(list); hs_cell_iterator_next(&at, &pair); ++n_pairs) {
            add_direction(&birds[pair.i], &birds[pair.j]);
            add_direction(&birds[pair.j], &birds[pair.i]);
        }
        double order[2] = {0.0, 0.0};
        for (int i = 0; i < n; ++i) {
            bird *b = &birds[i];
            order[0] += cos(b->direction) / n;
            order[1] += sin(b->direction) / n;
            b->direction = (float)(atan2(b->sum_y, b->sum_x) + noise * (uniform() - 0.5));
            b->x += (float)(speed * cos(b->direction)); /* the list wraps them; here they may fly on */
            b->y += (float)(speed * sin(b->direction));
        }
        if (step % 50 == 0 || step == n_steps)
            printf("%6d %8.4f %8.2f\n", step, hypot(order[0], order[1]), 2.0 * (double)n_pairs / n);
    }
    hs_cell_list_destroy(&list);
    free(birds);
    return 0;
}
