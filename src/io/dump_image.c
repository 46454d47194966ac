#include "io/dump_image.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/** Columns of the table, by place. */
enum { COLUMN_COLOR, COLUMN_DIAMETER, COLUMN_MU_X, COLUMN_MU_Y };

/** What an atom's colour goes by, where that is a number. */
static double color_value(const hs_dump *dump, int i)
{
    const hs_dump_image *state = dump->state;
    const hs_atoms *atoms = dump->env->atoms;
    const hs_dump_column *column = state->table.column;
    if (state->color_by == HS_LOOK_SPEED)
        return sqrt(atoms->v[0][i] * atoms->v[0][i] + atoms->v[1][i] * atoms->v[1][i] +
                    atoms->v[2][i] * atoms->v[2][i]);
    if (state->color_by == HS_LOOK_ORIENTATION)
        return atan2(hs_dump_value(dump, &column[COLUMN_MU_Y], i), hs_dump_value(dump, &column[COLUMN_MU_X], i));
    return hs_dump_value(dump, &column[COLUMN_COLOR], i);
}

void hs_dump_image_find_range(const hs_dump *dump, double range[2])
{
    const hs_dump_image *state = dump->state;
    range[0] = INFINITY;
    range[1] = -INFINITY;
    if (state->color_by != HS_LOOK_VALUE && state->color_by != HS_LOOK_SPEED) return;
    for (int k = 0; k < state->table.n_rows; ++k) {
        const double value = color_value(dump, state->table.order[k]);
        range[0] = fmin(range[0], value);
        range[1] = fmax(range[1], value);
    }
    hs_parallel_min_double(dump->env->parallel, &range[0], 1);
    hs_parallel_max_double(dump->env->parallel, &range[1], 1);
}

static hs_image_ball make_ball(const hs_dump *dump, int i, const double range[2])
{
    const hs_dump_image *state = dump->state;
    const hs_atoms *atoms = dump->env->atoms;
    double x[3], sample[3];
    int32_t images[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) x[axis] = atoms->x[axis][i];
    hs_box_wrap(dump->env->box, x, images);
    if (dump->env->box->dimension == 2) x[2] = 0.0;
    hs_image_project(&state->view, x, sample);
    const int type = atoms->type[i];
    double diameter = state->diameter;
    if (diameter == 0.0)
        diameter = state->diameter_by == HS_LOOK_TYPE ? state->type_diameter[type]
                                                      : hs_dump_value(dump, &state->table.column[COLUMN_DIAMETER], i);
    hs_color color = state->type_color[type];
    if (state->color_by == HS_LOOK_ORIENTATION) color = hs_color_of_hue(color_value(dump, i) / (2.0 * M_PI));
    if (state->color_by == HS_LOOK_VALUE || state->color_by == HS_LOOK_SPEED)
        color = hs_color_map_get(&state->map, color_value(dump, i), range[0], range[1]);
    return (hs_image_ball){
        .x = sample[0], .y = sample[1], .z = sample[2], .radius = 0.5 * diameter * state->view.scale, .color = color};
}

static hs_status draw_atoms(hs_dump *dump, hs_image *image, const double range[2], hs_error *err)
{
    const hs_dump_table *table = dump->state;
    hs_image_ball *ball;
    HS_TRY(HS_ALLOC(ball, (size_t)table->n_rows, err));
#pragma omp parallel for schedule(static)
    for (int k = 0; k < table->n_rows; ++k) ball[k] = make_ball(dump, table->order[k], range);
    hs_image_draw_balls(image, ball, table->n_rows);
    HS_FREE(ball);
    return HS_OK;
}

/** A stick between two points given as fractions of the box. */
static void draw_edge(const hs_dump *dump, hs_image *image, const double from[3], const double to[3], double diameter,
                      hs_color color)
{
    const hs_dump_image *state = dump->state;
    const hs_box *box = dump->env->box;
    double a[3] = {0.0, 0.0, 0.0}, b[3] = {0.0, 0.0, 0.0}, start[3], stop[3], shortest = INFINITY;
    hs_box_place(box, from, a);
    hs_box_place(box, to, b);
    for (int axis = 0; axis < box->dimension; ++axis) shortest = fmin(shortest, hs_box_length(box, axis));
    if (box->dimension == 2) a[2] = b[2] = 0.0;
    hs_image_project(&state->view, a, start);
    hs_image_project(&state->view, b, stop);
    hs_image_draw_stick(image, start, stop, 0.5 * diameter * shortest * state->view.scale, color);
}

static void draw_box(const hs_dump *dump, hs_image *image)
{
    const hs_dump_image *state = dump->state;
    const int dimension = dump->env->box->dimension;
    for (int axis = 0; axis < dimension; ++axis)
        for (int corner = 0; corner < 1 << dimension; ++corner) {
            double from[3] = {0.0, 0.0, 0.0}, to[3];
            if (corner >> axis & 1) continue; /* an edge begins at its lower end */
            for (int k = 0; k < dimension; ++k) from[k] = corner >> k & 1;
            memcpy(to, from, sizeof to);
            to[axis] = 1.0;
            draw_edge(dump, image, from, to, state->box_diameter, state->box_color);
        }
}

static void draw_axes(const hs_dump *dump, hs_image *image)
{
    static const hs_color colors[3] = {0xff0000, 0x00ff00, 0x0000ff};
    const hs_dump_image *state = dump->state;
    const double from[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < dump->env->box->dimension; ++axis) {
        double to[3] = {0.0, 0.0, 0.0};
        to[axis] = state->axes[0];
        draw_edge(dump, image, from, to, state->axes[1], colors[axis]);
    }
}

hs_status hs_dump_image_draw(hs_dump *dump, hs_image *image, const double range[2], hs_error *err)
{
    const hs_dump_image *state = dump->state;
    image->is_flat = dump->env->box->dimension == 2;
    image->shine = state->shine;
    if (state->has_atoms) HS_TRY(draw_atoms(dump, image, range, err));
    if (dump->env->parallel->rank != 0) return HS_OK;
    if (state->has_box) draw_box(dump, image);
    if (state->has_axes) draw_axes(dump, image);
    return HS_OK;
}
