/* Reflecting walls: an atom that has crossed one is mirrored back, and its velocity across it changes sign. */
#include "fix/wall.h"

typedef struct reflect_state {
    wall_state wall; /* first: wall.h takes the state as one */
    double unit[WALL_MAX];
} reflect_state;

static const hs_keyword keywords[] = {
    {"xlo", 1, "<place>", "lower wall across x"},
    {"xhi", 1, "<place>", "upper wall across x"},
    {"ylo", 1, "<place>", "lower wall across y"},
    {"yhi", 1, "<place>", "upper wall across y"},
    {"zlo", 1, "<place>", "lower wall across z"},
    {"zhi", 1, "<place>", "upper wall across z"},
    {"units", 1, "lattice|box", "units of places; default lattice"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    reflect_state *state = fix->state;
    bool is_lattice = true;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    for (int i = 0; i < args->n; i += 2) {
        if (strcmp(args->word[i], "units") == 0)
            is_lattice = strcmp(args->word[i + 1], "lattice") == 0;
        else
            HS_TRY(wall_read_face(fix, args, i, err));
    }
    if (state->wall.n == 0) return hs_arg_need(args, args->n, "a wall (xlo, xhi, ylo, yhi, zlo or zhi)", err);
    for (int k = 0; k < state->wall.n; ++k) {
        state->unit[k] = wall_unit(fix, &state->wall.face[k], is_lattice);
        state->wall.face[k].place *= state->unit[k];
    }
    return HS_OK;
}

static hs_status setup(hs_fix *fix, hs_error *err)
{
    reflect_state *state = fix->state;
    for (int k = 0; k < state->wall.n; ++k) HS_TRY(wall_place(fix, &state->wall.face[k], state->unit[k], err));
    return wall_check_inside(fix, err);
}

static void reflect(const hs_fix *fix, const wall_face *face)
{
    const hs_atoms *atoms = fix->env->atoms;
    double *restrict x = atoms->x[face->axis], *restrict v = atoms->v[face->axis];
    const double place = face->place;
    const uint32_t mask = fix->mask;
    const bool is_lower = face->end == 0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if ((is_lower ? x[i] >= place : x[i] <= place) || !(atoms->mask[i] & mask)) continue;
        x[i] = place + (place - x[i]);
        v[i] = -v[i];
    }
}

static hs_status post_integrate(hs_fix *fix, hs_error *err)
{
    reflect_state *state = fix->state;
    for (int k = 0; k < state->wall.n; ++k) {
        wall_face *face = &state->wall.face[k];
        HS_TRY(wall_place(fix, face, state->unit[k], err));
        HS_ON_THREADS(reflect(fix, face));
    }
    return HS_OK;
}

const hs_fix_style hs_fix_style_wall_reflect = {
    .about =
        {.name = "wall/reflect",
         .syntax = {.usage = "<face> <place> ... [units lattice|box]", .n_min = 0, .n_max = 0, .keywords = keywords},
         .summary = "flat walls that reflect",
         .details =
             "A face is xlo, xhi, ylo, yhi, zlo or zhi, its place a coordinate, `EDGE` (where the box's face is when "
             "the fix is defined) or an equal-style variable `v_name`; numbers and variables are in lattice spacings "
             "unless `units box` is said. After each drift an atom of the group beyond a wall is mirrored back inside, "
             "and its velocity across the wall changes sign. Walls must stand across directions that are not periodic; "
             "atoms that are outside at the beginning of a run are an error. A wall gives no energy and no "
             "virial.\n\nWith fixes of overdamped motion the mirror image is the right no-flux boundary.",
         .example = "fix box all wall/reflect xlo EDGE xhi EDGE"},
    .state_size = sizeof(reflect_state),
    .create = create,
    .destroy = wall_destroy,
    .keep_state = wall_keep_state,
    .setup = setup,
    .post_integrate = post_integrate,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
