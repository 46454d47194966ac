/* Walls of a temperature that send atoms back with random velocities: diffusely, diffusely or like a mirror (Maxwell), or by the
 * kernel of Cercignani and Lampis.
 *
 * An atom that has crossed a wall goes back to the place and time of its collision, takes a new velocity u, and moves with it for the
 * rest of the step. With s = sqrt(kT/m), the wall's velocity taken off, n the normal component and t a tangential one:
 *     diffuse              u_n = s sqrt(-2 ln U)  (the flux of a gas at rest),   u_t = s G
 *     Cercignani, Lampis   u_n = | sqrt(1 - a_n) v_n + s sqrt(a_n) (G + i G') |,  u_t = (1 - a_t) v_t + s sqrt(a_t (2 - a_t)) G
 * U uniform in (0, 1), G normal.
 * Sources: J. C. Maxwell, Philos. Trans. R. Soc. London 170, 231 (1879), doi:10.1098/rstl.1879.0067; C. Cercignani, M. Lampis,
 * Transp. Theory Stat. Phys. 1, 101 (1971), doi:10.1080/00411457108231440; sampling: R. G. Lord, Phys. Fluids A 3, 706 (1991),
 * doi:10.1063/1.858076. */
#include <math.h>

#include "core/atom_style.h"
#include "fix/wall.h"

typedef enum { REFLECT_DIFFUSIVE, REFLECT_MAXWELL, REFLECT_CCL } reflect_model;

/** What a wall does to atoms. */
typedef struct wall_gas {
    double temperature;
    double velocity[3];      /**< of the wall, along itself, distance/time */
    double accommodation[3]; /**< maxwell: the first; ccl: by axis */
} wall_gas;

typedef struct stochastic_state {
    wall_state wall; /* first: wall.h takes the state as one */
    reflect_model model;
    wall_gas gas[WALL_MAX];
    hs_noise noise;
} stochastic_state;

static const hs_keyword keywords[] = {
    {"xlo", -1, "<place> <T> <vx> <vy> <vz> [accommodation ...]", "lower wall across x"},
    {"xhi", -1, "<place> <T> <vx> <vy> <vz> [accommodation ...]", "upper wall across x"},
    {"ylo", -1, "<place> <T> <vx> <vy> <vz> [accommodation ...]", "lower wall across y"},
    {"yhi", -1, "<place> <T> <vx> <vy> <vz> [accommodation ...]", "upper wall across y"},
    {"zlo", -1, "<place> <T> <vx> <vy> <vz> [accommodation ...]", "lower wall across z"},
    {"zhi", -1, "<place> <T> <vx> <vy> <vz> [accommodation ...]", "upper wall across z"},
    {"units", 1, "lattice|box", "units of places; default lattice"},
    {NULL, 0, NULL, NULL},
};

/** Words of a face from @p i on; *next: the first word after them. */
static hs_status read_wall(hs_fix *fix, const hs_args *args, int i, int *next, hs_error *err)
{
    stochastic_state *state = fix->state;
    const int n_coefficients = state->model == REFLECT_DIFFUSIVE ? 0 : state->model == REFLECT_MAXWELL ? 1 : 3;
    HS_TRY(wall_read_face(fix, args, i, err));
    const wall_face *face = &state->wall.face[state->wall.n - 1];
    wall_gas *gas = &state->gas[state->wall.n - 1];
    *next = i + 6 + n_coefficients;
    if (face->variable != NULL) return hs_arg_refuse(args, i + 1, "EDGE or a number: these walls stand", NULL, err);
    HS_TRY(hs_arg_need(args, *next - 1,
                       n_coefficients == 0   ? "the place, temperature and velocity of the wall"
                       : n_coefficients == 1 ? "the place, temperature, velocity and accommodation of the wall"
                                             : "the place, temperature, velocity and three accommodations of the wall",
                       err));
    HS_TRY(hs_arg_not_negative(args, i + 2, &gas->temperature, err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + 3 + axis, &gas->velocity[axis], err));
    if (gas->velocity[face->axis] != 0.0)
        return hs_arg_refuse(args, i + 3 + face->axis, "0: a wall moves along itself only", NULL, err);
    for (int k = 0; k < n_coefficients; ++k) {
        HS_TRY(hs_arg_not_negative(args, i + 6 + k, &gas->accommodation[k], err));
        if (gas->accommodation[k] > 1.0) return hs_arg_refuse(args, i + 6 + k, "from 0 to 1", NULL, err);
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const models[] = {"diffusive", "maxwell", "ccl", "cll", NULL};
    stochastic_state *state = fix->state;
    bool is_lattice = true;
    int model;
    int64_t seed;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_choice(args, 0, models, &model, err));
    state->model = model < REFLECT_CCL ? (reflect_model)model : REFLECT_CCL;
    HS_TRY(hs_arg_int(args, 1, 1, INT32_MAX, &seed, err));
    HS_TRY(hs_fix_noise(fix, seed, &state->noise, err));
    for (int i = 2; i < args->n;) {
        if (strcmp(args->word[i], "units") == 0) {
            is_lattice = strcmp(args->word[i + 1], "lattice") == 0;
            i += 2;
        } else
            HS_TRY(read_wall(fix, args, i, &i, err));
    }
    if (state->wall.n == 0) return hs_arg_need(args, args->n, "a wall (xlo, xhi, ylo, yhi, zlo or zhi)", err);
    for (int k = 0; k < state->wall.n; ++k)
        state->wall.face[k].place *= wall_unit(fix, &state->wall.face[k], is_lattice);
    return HS_OK;
}

static hs_status setup(hs_fix *fix, hs_error *err)
{
    stochastic_state *state = fix->state;
    for (int k = 0; k < state->wall.n; ++k) HS_TRY(wall_place(fix, &state->wall.face[k], 1.0, err));
    return wall_check_inside(fix, err);
}

/** Random numbers of one collision: two uniform ones in (0, 1), and four normal ones. */
typedef struct chance {
    double uniform[2], normal[4];
} chance;

static chance draw(const stochastic_state *state, int64_t clock, int wall, int64_t id)
{
    chance c;
    uint32_t word[HS_NOISE_NUMBERS];
    hs_noise_words(state->noise, clock, 2 * wall, id, word);
    for (int k = 0; k < 2; ++k)
        c.uniform[k] = ((double)word[2 * k] * 0x1p-32 + (double)word[2 * k + 1] * 0x1p-64) + 0x1p-66;
    hs_noise_numbers(state->noise, HS_NOISE_GAUSSIAN, clock, 2 * wall + 1, id, c.normal);
    return c;
}

/** The velocity after a collision, from the one before it; both are relative to the wall. @p inwards: 1 at a lower wall, -1 at an
 *  upper one; @p speed: sqrt(kT/m). */
static void reflect(reflect_model model, const wall_gas *gas, int axis, double inwards, double speed, const chance *c,
                    double v[3])
{
    if (model == REFLECT_MAXWELL && c->uniform[1] >= gas->accommodation[0]) {
        v[axis] = -v[axis];
        return;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = model == REFLECT_CCL ? gas->accommodation[k] : 1.0;
        if (k == axis && model != REFLECT_CCL)
            v[k] = inwards * speed * sqrt(-2.0 * log(c->uniform[0]));
        else if (k == axis)
            v[k] =
                inwards * hypot(sqrt(1.0 - a) * v[k] + speed * sqrt(a) * c->normal[k], speed * sqrt(a) * c->normal[3]);
        else
            v[k] = (1.0 - a) * v[k] + speed * sqrt(a * (2.0 - a)) * c->normal[k];
    }
}

/** Send local atom i, which is beyond the wall, back. */
static void collide(const hs_fix *fix, int wall, int i)
{
    const stochastic_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    const wall_face *face = &state->wall.face[wall];
    const wall_gas *gas = &state->gas[wall];
    const int axis = face->axis, n_axes = env->box->dimension;
    const chance c = draw(state, hs_fix_clock(fix), wall, atoms->id[i]);
    const double speed = sqrt(env->units->boltz * gas->temperature / (hs_atom_mass(atoms, i) * env->units->mvv2e));
    /* time since the collision; an atom that something else has moved across has collided at this moment */
    const double rest = (atoms->x[axis][i] - face->place) / atoms->v[axis][i];
    const double left = rest > 0.0 && rest <= env->dt ? rest : 0.0;
    double v[3];
    for (int k = 0; k < 3; ++k) v[k] = atoms->v[k][i] - gas->velocity[k];
    reflect(state->model, gas, axis, face->end == 0 ? 1.0 : -1.0, speed, &c, v);
    for (int k = 0; k < n_axes; ++k) {
        v[k] += gas->velocity[k];
        atoms->x[k][i] = hs_moved(atoms->x[k][i], (v[k] - atoms->v[k][i]) * left, env->position_magic);
        atoms->v[k][i] = v[k];
    }
    const double x = atoms->x[axis][i];
    if (face->end == 0 ? x < face->place : x > face->place) atoms->x[axis][i] = face->place;
}

static void send_back(const hs_fix *fix, int wall)
{
    const wall_face *face = &((const stochastic_state *)fix->state)->wall.face[wall];
    const hs_atoms *atoms = fix->env->atoms;
    const double *x = atoms->x[face->axis], place = face->place;
    const bool is_lower = face->end == 0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if ((is_lower ? x[i] >= place : x[i] <= place) || !(atoms->mask[i] & fix->mask)) continue;
        collide(fix, wall, i);
    }
}

static hs_status post_integrate(hs_fix *fix, hs_error *err)
{
    stochastic_state *state = fix->state;
    for (int k = 0; k < state->wall.n; ++k) {
        HS_TRY(wall_place(fix, &state->wall.face[k], 1.0, err));
        HS_ON_THREADS(send_back(fix, k));
    }
    return HS_OK;
}

const hs_fix_style hs_fix_style_wall_reflect_stochastic = {
    .about =
        {.name = "wall/reflect/stochastic",
         .syntax = {.usage = "<diffusive|maxwell|ccl> <seed> <face> <place> <T> <vx> <vy> <vz> [accommodation ...] ... "
                             "[units lattice|box]",
                    .n_min = 2,
                    .n_max = 2,
                    .keywords = keywords},
         .summary = "flat walls with a temperature, which send atoms back with random velocities",
         .details =
             "A face is xlo, xhi, ylo, yhi, zlo or zhi, its place a coordinate (in lattice spacings unless `units box` "
             "is said) or `EDGE`, where the box's face is when the fix is defined; T is the temperature of the wall, "
             "(vx, vy, vz) its velocity, which must lie in its plane. An atom of the group that crosses a wall during "
             "a step is put back to the place and time of its collision and goes on with a new velocity:\n\n"
             "`diffusive`: as if it came out of a gas at rest with the wall, of temperature T. `maxwell`: with the "
             "probability given as accommodation (one number for each wall, from 0 to 1) diffusive, else like from a "
             "mirror. `ccl` (also `cll`): the kernel of Cercignani and Lampis, with three accommodations from 0 to 1 "
             "for x, y and z: that of the normal component's energy for the axis across the wall, those of the "
             "momentum along the others; 0 is a mirror, 1 diffusive.\n\n"
             "Walls must stand across directions that are not periodic; atoms that are outside at the beginning of a "
             "run are an error. The noise is Halfshell's own and depends on seed, step and atom only.",
         .reference = "C. Cercignani, M. Lampis, Transp. Theory Stat. Phys. 1, 101 (1971), "
                      "doi:10.1080/00411457108231440; R. G. Lord, Phys. Fluids A 3, 706 (1991), doi:10.1063/1.858076",
         .example = "fix w all wall/reflect/stochastic diffusive 4711 zlo EDGE 1.0 0.1 0 0 zhi EDGE 1.5 0 0 0\n"
                    "fix w all wall/reflect/stochastic maxwell 4711 ylo EDGE 1.0 0 0 0 0.8 yhi 10 1.0 0 0 0 0.8\n"
                    "fix w all wall/reflect/stochastic ccl 4711 xlo EDGE 1.0 0 0 0 0.9 0.8 0.8"},
    .state_size = sizeof(stochastic_state),
    .create = create,
    .destroy = wall_destroy,
    .keep_state = wall_keep_state,
    .setup = setup,
    .post_integrate = post_integrate,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
