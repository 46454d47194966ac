/* The command velocity. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "core/random.h"
#include "deck/by_id.h"
#include "deck/command.h"
#include "deck/velocity.h"

typedef enum { VELOCITY_CREATE, VELOCITY_SET, VELOCITY_SCALE, VELOCITY_RAMP, VELOCITY_ZERO } velocity_style;
static const char *const velocity_styles[] = {"create", "set", "scale", "ramp", "zero", NULL};
/** Words after the style's name, and what they are. */
static const int velocity_words[] = {2, 3, 1, 6, 1};
static const char *const velocity_usage[] = {
    "<T> <seed>", "<vx> <vy> <vz>", "<T>", "vx|vy|vz <vlo> <vhi> x|y|z <clo> <chi>", "linear|angular",
};

typedef enum { LOOP_ALL, LOOP_LOCAL, LOOP_GEOM } loop_kind;

static const hs_keyword velocity_keywords[] = {
    {"dist", 1, "uniform|gaussian", "create: distribution of the components (default uniform)"},
    {"mom", 1, "yes|no", "create: zero the momentum of the group (default yes)"},
    {"rot", 1, "yes|no", "create: zero the angular momentum of the group too (default no)"},
    {"sum", 1, "yes|no", "create, set, ramp: add to the present velocities instead of replacing them (default no)"},
    {"temp", 1, "<compute-ID>", "create, scale: compute that measures the temperature (default: of the group)"},
    {"bias", 1, "yes|no", "create, scale: leave the bias of the compute alone; only `no` is supported"},
    {"loop", 1, "all|local|geom", "create: what the random numbers of an atom belong to (default all)"},
    {"units", 1, "lattice|box",
     "set, ramp: velocities and coordinates in lattice spacings (default) or distance units"},
    {NULL, 0, NULL, NULL},
};

/** One velocity command. */
typedef struct velocity {
    hs_deck *deck;
    hs_sim *sim;
    hs_velocity_group group;
    velocity_style style;
    loop_kind loop;
    bool is_gaussian, zero_momentum, zero_rotation, is_sum, is_lattice_units;
    hs_compute *temperature; /**< NULL: temperature of the group */
} velocity;

static hs_status velocity_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int style;
    if (strchr(args->word[1], '$') != NULL) return HS_OK;
    HS_TRY(hs_arg_choice(args, 1, velocity_styles, &style, err));
    char usage[160];
    snprintf(usage, sizeof usage, "<group-ID> %s %s [keyword value ...]", velocity_styles[style],
             velocity_usage[style]);
    for (int i = 2 + velocity_words[style]; i < args->n; ++i)
        if (strcmp(args->word[i], "rigid") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "velocity: the keyword 'rigid' is not supported: there are no rigid bodies");
    const int n = 2 + velocity_words[style];
    const hs_syntax syntax = {usage, n, n, velocity_keywords};
    return hs_syntax_check(&syntax, args, has_variables, err);
}

static hs_status read_temperature_compute(velocity *vel, const char *id, hs_error *err)
{
    return hs_compute_get(&vel->sim->env, id, HS_TEMPERATURE, "velocity", &vel->temperature, err);
}

static hs_status read_keywords(velocity *vel, const hs_args *args, hs_error *err)
{
    static const char *const loops[] = {"all", "local", "geom", NULL};
    bool is_bias = false;
    int loop;
    for (int i = 2 + velocity_words[vel->style]; i < args->n; i += 2) {
        const char *keyword = args->word[i], *value = args->word[i + 1];
        if (strcmp(keyword, "dist") == 0) vel->is_gaussian = strcmp(value, "gaussian") == 0;
        if (strcmp(keyword, "mom") == 0) vel->zero_momentum = strcmp(value, "yes") == 0;
        if (strcmp(keyword, "rot") == 0) vel->zero_rotation = strcmp(value, "yes") == 0;
        if (strcmp(keyword, "sum") == 0) vel->is_sum = strcmp(value, "yes") == 0;
        if (strcmp(keyword, "bias") == 0) is_bias = strcmp(value, "yes") == 0;
        if (strcmp(keyword, "units") == 0) vel->is_lattice_units = strcmp(value, "lattice") == 0;
        if (strcmp(keyword, "temp") == 0) HS_TRY(read_temperature_compute(vel, value, err));
        if (strcmp(keyword, "loop") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, loops, &loop, err));
            vel->loop = (loop_kind)loop;
        }
    }
    if (!is_bias) return HS_OK;
    if (vel->temperature == NULL) return hs_fail(err, HS_ERROR_INPUT, "velocity: 'bias yes' needs 'temp <compute-ID>'");
    if (vel->temperature->style->bias == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "velocity: 'bias yes': %s has no velocity bias",
                       hs_compute_who(vel->temperature).text);
    return hs_fail(err, HS_ERROR_INPUT,
                   "velocity: 'bias yes' is not supported: velocities are drawn and scaled as they are, with the flow "
                   "that %s leaves out",
                   hs_compute_who(vel->temperature).text);
}

/* ---- create ---- */

static void draw(const velocity *vel, hs_park *park, double v[3])
{
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = vel->is_gaussian ? hs_park_gaussian(park) : hs_park_uniform(park) - 0.5;
}

/** Give atom i the velocity drawn for it: lighter atoms are faster. Three numbers are drawn in two dimensions too. */
static void assign(const velocity *vel, int i, const double drawn[3])
{
    hs_atoms *atoms = &vel->sim->atoms;
    const double factor = 1.0 / sqrt(hs_atom_mass(atoms, i));
    for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = drawn[axis] * factor;
    if (vel->sim->box.dimension == 2) atoms->v[2][i] = 0.0;
}

/** One generator, which draws for every ID from 1 to the number of atoms, whether the group holds it or not. */
static hs_status draw_by_id(const velocity *vel, int seed, hs_error *err)
{
    const hs_atoms *atoms = &vel->sim->atoms;
    int64_t max_id = hs_atoms_max_id(atoms);
    hs_parallel_max_int64(&vel->sim->parallel, &max_id, 1);
    if (max_id != atoms->n_all)
        return hs_fail(err, HS_ERROR_INPUT,
                       "velocity: 'loop all' needs the IDs 1 to %lld, but the highest is %lld; 'loop geom' does not",
                       (long long)atoms->n_all, (long long)max_id);
    hs_park park;
    hs_park_init(&park, seed);
    int next = 0;
    for (int64_t id = 1; id <= max_id; ++id) {
        double v[3];
        draw(vel, &park, v);
        if (next < vel->group.n && atoms->id[vel->group.member[next]] == id) assign(vel, vel->group.member[next++], v);
    }
    return HS_OK;
}

/** The generator of `loop local`, and the local atom that it comes to next. */
typedef struct member_draw {
    const velocity *vel;
    hs_park park;
    int next;
} member_draw;

static hs_status draw_for(void *context, int64_t id, hs_error *err)
{
    (void)err;
    member_draw *m = context;
    const velocity *vel = m->vel;
    double v[3];
    draw(vel, &m->park, v);
    if (m->next < vel->group.n && vel->sim->atoms.id[vel->group.member[m->next]] == id)
        assign(vel, vel->group.member[m->next++], v);
    return HS_OK;
}

/** One generator, which draws for the group's atoms only. */
static hs_status draw_by_member(const velocity *vel, int seed, int bit, hs_error *err)
{
    enum { N_WARM_UP = 100 };
    const hs_atoms *atoms = &vel->sim->atoms;
    unsigned char *selected = NULL;
    HS_TRY(HS_ALLOC(selected, (size_t)atoms->n_local, err));
    for (int i = 0; i < atoms->n_local; ++i) selected[i] = (atoms->mask[i] & hs_group_mask(bit)) != 0;
    member_draw m = {.vel = vel};
    hs_park_init(&m.park, seed);
    for (int k = 0; k < N_WARM_UP; ++k) (void)hs_park_uniform(&m.park);
    const hs_status status = hs_by_id_visit(vel->sim, selected, draw_for, &m, err);
    HS_FREE(selected);
    return status;
}

/** Every atom has a generator of its own, seeded from its place. */
static void draw_by_place(const velocity *vel, int seed)
{
    const hs_atoms *atoms = &vel->sim->atoms;
    for (int k = 0; k < vel->group.n; ++k) {
        const int i = vel->group.member[k];
        const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        hs_park park;
        double v[3];
        hs_park_reset_at(&park, seed, x);
        draw(vel, &park, v);
        assign(vel, i, v);
    }
}

static hs_status present_temperature(const velocity *vel, double *t, hs_error *err)
{
    if (vel->temperature == NULL) {
        *t = hs_velocity_temperature(&vel->group);
        return HS_OK;
    }
    hs_compute_invalidate(vel->temperature);
    if (vel->temperature->style->init != NULL) HS_TRY(vel->temperature->style->init(vel->temperature, err));
    return hs_compute_scalar(vel->temperature, t, err);
}

/** Draw, zero momentum and rotation, scale to the temperature. */
static hs_status create_velocities(const velocity *vel, double t_wanted, int seed, int bit, hs_error *err)
{
    double t;
    switch (vel->loop) {
    case LOOP_ALL:
        HS_TRY(draw_by_id(vel, seed, err));
        break;
    case LOOP_LOCAL:
        HS_TRY(draw_by_member(vel, seed, bit, err));
        break;
    case LOOP_GEOM:
        draw_by_place(vel, seed);
        break;
    }
    if (vel->zero_momentum) HS_TRY(hs_velocity_zero_momentum(&vel->group, err));
    if (vel->zero_rotation) HS_TRY(hs_velocity_zero_rotation(&vel->group, err));
    HS_TRY(present_temperature(vel, &t, err));
    return hs_velocity_rescale(&vel->group, t, t_wanted, err);
}

/** Keep the present velocities of the group in old (if not NULL), or add them back. */
static void copy_velocities(const velocity *vel, double *old, bool is_add)
{
    for (int k = 0; k < vel->group.n; ++k)
        for (int axis = 0; axis < 3; ++axis) {
            double *v = &vel->sim->atoms.v[axis][vel->group.member[k]];
            if (is_add)
                *v += old[3 * (size_t)k + (size_t)axis];
            else
                old[3 * (size_t)k + (size_t)axis] = *v;
        }
}

static hs_status velocity_create(const velocity *vel, const hs_args *args, int bit, hs_error *err)
{
    double t;
    int64_t seed;
    HS_TRY(hs_arg_not_negative(args, 2, &t, err));
    HS_TRY(hs_arg_int(args, 3, 1, INT32_MAX - 1, &seed, err));
    if (!vel->is_sum) return create_velocities(vel, t, (int)seed, bit, err);
    double *old = NULL;
    HS_TRY(HS_ALLOC(old, 3 * (size_t)vel->group.n, err));
    copy_velocities(vel, old, false);
    hs_status status = create_velocities(vel, t, (int)seed, bit, err);
    copy_velocities(vel, old, true);
    HS_FREE(old);
    return status;
}

/* ---- set, scale, ramp, zero ---- */

/** One component: a number in velocity units, or a variable (which is not scaled), or NULL. */
static hs_status set_component(const velocity *vel, const hs_args *args, int axis, hs_error *err)
{
    const char *word = args->word[2 + axis];
    if (strcmp(word, "NULL") == 0) return HS_OK;
    hs_atoms *atoms = &vel->sim->atoms;
    const bool is_variable = strncmp(word, "v_", 2) == 0;
    double number = 0.0, *values = NULL;
    if (!is_variable) HS_TRY(hs_arg_double(args, 2 + axis, &number, err));
    if (axis == 2 && vel->sim->box.dimension == 2 && (is_variable || number != 0.0))
        return hs_fail(err, HS_ERROR_INPUT, "velocity: vz must be 0 or NULL in two dimensions, not '%s'", word);
    if (vel->is_lattice_units) number = vel->sim->lattice.spacing[axis] * number;
    hs_status status = HS_OK;
    if (is_variable) {
        HS_TRY(HS_ALLOC(values, (size_t)atoms->n_local, err));
        status = vel->sim->env.variable_atoms(vel->deck, word + 2, values, err);
    }
    for (int k = 0; status == HS_OK && k < vel->group.n; ++k) {
        const int i = vel->group.member[k];
        const double value = is_variable ? values[i] : number;
        atoms->v[axis][i] = vel->is_sum ? atoms->v[axis][i] + value : value;
    }
    HS_FREE(values);
    return status;
}

static hs_status velocity_scale(const velocity *vel, const hs_args *args, hs_error *err)
{
    double t, t_wanted;
    HS_TRY(hs_arg_not_negative(args, 2, &t_wanted, err));
    HS_TRY(present_temperature(vel, &t, err));
    return hs_velocity_rescale(&vel->group, t, t_wanted, err);
}

static hs_status velocity_ramp(const velocity *vel, const hs_args *args, hs_error *err)
{
    static const char *const components[] = {"vx", "vy", "vz", NULL}, *const axes[] = {"x", "y", "z", NULL};
    int component, axis;
    double v[2], c[2];
    HS_TRY(hs_arg_choice(args, 2, components, &component, err));
    if (component == 2 && vel->sim->box.dimension == 2)
        return hs_fail(err, HS_ERROR_INPUT, "velocity: vz cannot be ramped in two dimensions");
    HS_TRY(hs_arg_choice(args, 5, axes, &axis, err));
    for (int end = 0; end < 2; ++end) {
        HS_TRY(hs_arg_double(args, 3 + end, &v[end], err));
        HS_TRY(hs_arg_double(args, 6 + end, &c[end], err));
        if (!vel->is_lattice_units) continue;
        v[end] = vel->sim->lattice.spacing[component] * v[end];
        c[end] = vel->sim->lattice.spacing[axis] * c[end];
    }
    if (c[0] == c[1])
        return hs_fail(err, HS_ERROR_INPUT, "velocity: the ramp begins and ends at the same coordinate, %s",
                       args->word[6]);
    hs_atoms *atoms = &vel->sim->atoms;
    for (int k = 0; k < vel->group.n; ++k) {
        const int i = vel->group.member[k];
        const double fraction = fmin(fmax((atoms->x[axis][i] - c[0]) / (c[1] - c[0]), 0.0), 1.0);
        const double ramp = v[0] + fraction * (v[1] - v[0]);
        atoms->v[component][i] = vel->is_sum ? atoms->v[component][i] + ramp : ramp;
    }
    return HS_OK;
}

static hs_status velocity_zero(const velocity *vel, const hs_args *args, hs_error *err)
{
    static const char *const kinds[] = {"linear", "angular", NULL};
    int kind;
    HS_TRY(hs_arg_choice(args, 2, kinds, &kind, err));
    return kind == 0 ? hs_velocity_zero_momentum(&vel->group, err) : hs_velocity_zero_rotation(&vel->group, err);
}

/* ---- the command ---- */

static hs_status carry_out(velocity *vel, const hs_args *args, int bit, hs_error *err)
{
    switch (vel->style) {
    case VELOCITY_CREATE:
        return velocity_create(vel, args, bit, err);
    case VELOCITY_SCALE:
        return velocity_scale(vel, args, err);
    case VELOCITY_RAMP:
        return velocity_ramp(vel, args, err);
    case VELOCITY_ZERO:
        return velocity_zero(vel, args, err);
    default:
        for (int axis = 0; axis < 3; ++axis) HS_TRY(set_component(vel, args, axis, err));
        return HS_OK;
    }
}

static hs_status velocity_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    int bit, style;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(velocity_check(args, false, err));
    if (sim->atoms.n_all == 0) return hs_fail(err, HS_ERROR_INPUT, "velocity: there are no atoms yet");
    HS_TRY(hs_sim_need_masses(sim, args->command, err));
    HS_TRY(hs_groups_get(&sim->groups, args->word[0], &bit, err));
    HS_TRY(hs_arg_choice(args, 1, velocity_styles, &style, err));
    velocity vel = {
        .deck = deck, .sim = sim, .style = (velocity_style)style, .zero_momentum = true, .is_lattice_units = true};
    HS_TRY(read_keywords(&vel, args, err));
    hs_status status = hs_velocity_group_init(&vel.group, sim, bit, err);
    if (status == HS_OK) status = carry_out(&vel, args, bit, err);
    hs_velocity_group_fini(&vel.group);
    hs_sim_atoms_changed(sim);
    return status;
}

const hs_command hs_commands_velocity[] = {
    {
        .about =
            {
                .name = "velocity",
                .syntax = {"<group-ID> create <T> <seed> | set <vx> <vy> <vz> | scale <T> | ramp vx|vy|vz <vlo> <vhi> "
                           "x|y|z <clo> <chi> | zero linear|angular [keyword value ...]",
                           3, -1, velocity_keywords},
                .summary = "Draw, set, scale, ramp or zero the velocities of a group",
                .details =
                    "`create` draws velocities at random, divides them by the square root of the mass, zeroes the "
                    "momentum (and with\n"
                    "`rot yes` the angular momentum about the center of mass), and scales to the temperature `T`, 0 or "
                    "more, counting\n"
                    "dim N - dim degrees of freedom. `loop all` draws for each ID in order, `loop local` for the "
                    "group's atoms by ID,\n"
                    "`loop geom` from the bits of each atom's position. The numbers are LAMMPS's on one rank (`loop "
                    "local`: before\n"
                    "the first run), whatever the number of ranks; `loop all` needs IDs 1 to N.\n\n"
                    "`set` gives all atoms one velocity; each component is a number in lattice spacings or distance "
                    "units per time, a\n"
                    "variable `v_name` (equal or atom style, not scaled by `units`), or `NULL` to leave it. `scale` "
                    "scales to the\n"
                    "temperature `T`. `ramp` interpolates one component linearly between two coordinates, and keeps it "
                    "constant\n"
                    "beyond. `zero linear` takes the mean velocity away, `zero angular` the rotation.\n\n"
                    "In two dimensions vz is 0. Every type must have a mass. LAMMPS's keyword `rigid` is refused.\n",
                .example =
                    "velocity all create 1.44 87287 loop geom\nvelocity left set 0.5 NULL NULL sum yes units box\n"
                    "velocity all ramp vx 0 2 y 0 10\nvelocity all zero angular",
            },
        .run = velocity_run,
        .check = velocity_check,
    },
    {.about = {.name = NULL}},
};
