/* dump image: pictures of the atoms. Every rank draws its own atoms; the pictures are merged by depth. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "io/dump_image.h"

static const hs_keyword keywords[] = {
    {"adiam", 1, "<diameter>", "diameter of all atoms, whatever the second word says"},
    {"atom", 1, "yes|no", "draw atoms (default yes)"},
    {"axes", 3, "<yes | no> <length> <diameter>", "draw x red, y green, z blue from the box's corner (default no)"},
    {"box", 2, "<yes | no> <diameter>", "draw the box's edges, thick as a part of the shortest (default yes 0.02)"},
    {"center", 4, "<s | d> <x> <y> <z>",
     "middle of the picture as fractions of the box; s: of the first picture's box, d: of each (default s 0.5 0.5 "
     "0.5)"},
    {"fsaa", 1, "yes|no", "smooth edges, by four samples a pixel (default yes)"},
    {"shiny", 1, "<factor>", "strength of highlights, from 0 to 1 (default 1)"},
    {"size", 2, "<width> <height>", "pixels (default 512 512)"},
    {"up", 3, "<x> <y> <z>", "direction that points upwards in the picture (default 0 0 1)"},
    {"view", 2, "<theta> <phi>", "direction from which one looks, degrees (default 60 30; in two dimensions 0 0)"},
    {"zoom", 1, "<factor>", "1 shows the whole box, 2 twice as large (default 1)"},
    {NULL, 0, NULL, NULL},
};

static hs_status parse_size(hs_dump_image *state, const hs_args *args, int i, hs_error *err)
{
    int64_t width, height;
    HS_TRY(hs_arg_int(args, i + 1, 1, HS_IMAGE_SIZE_MAX, &width, err));
    HS_TRY(hs_arg_int(args, i + 2, 1, HS_IMAGE_SIZE_MAX, &height, err));
    state->width = (int)width;
    state->height = (int)height;
    return HS_OK;
}

static hs_status parse_vector(const hs_args *args, int i, double vector[3], hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + axis, &vector[axis], err));
    return HS_OK;
}

static hs_status parse_keyword(hs_dump_image *state, const hs_args *args, int i, hs_error *err)
{
    static const char *const center_words[] = {"s", "d", NULL};
    const char *name = args->word[i];
    int choice;
    if (strcmp(name, "adiam") == 0) return hs_arg_positive(args, i + 1, &state->diameter, err);
    if (strcmp(name, "atom") == 0) return hs_arg_bool(args, i + 1, &state->has_atoms, err);
    if (strcmp(name, "fsaa") == 0) return hs_arg_bool(args, i + 1, &state->is_smooth, err);
    if (strcmp(name, "size") == 0) return parse_size(state, args, i, err);
    if (strcmp(name, "zoom") == 0) return hs_arg_positive(args, i + 1, &state->zoom, err);
    if (strcmp(name, "axes") == 0) {
        HS_TRY(hs_arg_bool(args, i + 1, &state->has_axes, err));
        HS_TRY(hs_arg_positive(args, i + 2, &state->axes[0], err));
        return hs_arg_positive(args, i + 3, &state->axes[1], err);
    }
    if (strcmp(name, "box") == 0) {
        HS_TRY(hs_arg_bool(args, i + 1, &state->has_box, err));
        return hs_arg_positive(args, i + 2, &state->box_diameter, err);
    }
    if (strcmp(name, "shiny") == 0) {
        HS_TRY(hs_arg_not_negative(args, i + 1, &state->shine, err));
        return state->shine <= 1.0 ? HS_OK : hs_arg_refuse(args, i + 1, "a factor from 0 to 1", NULL, err);
    }
    if (strcmp(name, "center") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, center_words, &choice, err));
        state->center_moves = choice == 1;
        return parse_vector(args, i + 2, state->center, err);
    }
    if (strcmp(name, "up") == 0) {
        HS_TRY(parse_vector(args, i + 1, state->up, err));
        const double length = fabs(state->up[0]) + fabs(state->up[1]) + fabs(state->up[2]);
        return length > 0.0 ? HS_OK : hs_fail(err, HS_ERROR_INPUT, "%s: up 0 0 0 is no direction", args->command);
    }
    HS_TRY(hs_arg_double(args, i + 1, &state->theta, err)); /* view */
    if (state->theta < 0.0 || state->theta > 180.0)
        return hs_arg_refuse(args, i + 1, "an angle from 0 to 180 degrees", NULL, err);
    return hs_arg_double(args, i + 2, &state->phi, err);
}

static hs_status set_defaults(hs_dump *dump, hs_error *err)
{
    static const hs_color cycle[] = {0xff0000, 0x008000, 0x0000ff, 0xffff00, 0x00ffff, 0x00ffff};
    hs_dump_image *state = dump->state;
    const int n_types = dump->env->atoms->n_types;
    const bool is_2d = dump->env->box->dimension == 2;
    state->table.delay = state->table.max_files = -1;
    state->table.is_unsorted = true; /* a picture knows no order */
    state->has_atoms = state->has_box = state->is_smooth = true;
    state->width = state->height = 512;
    state->theta = is_2d ? 0.0 : 60.0;
    state->phi = is_2d ? 0.0 : 30.0;
    state->up[2] = state->zoom = state->shine = 1.0;
    state->box_diameter = 0.02;
    state->box_color = 0xffff00;
    for (int axis = 0; axis < 3; ++axis) state->center[axis] = 0.5;
    HS_TRY(HS_ALLOC(state->type_color, (size_t)n_types + 1, err));
    HS_TRY(HS_ALLOC(state->type_diameter, (size_t)n_types + 1, err));
    for (int type = 1; type <= n_types; ++type) {
        state->type_color[type] = cycle[(type - 1) % 6];
        state->type_diameter[type] = 1.0;
    }
    return hs_color_map_init(&state->map, err);
}

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    if (strchr(file, '$') == NULL && !hs_image_is_known(file))
        return hs_fail(err, HS_ERROR_INPUT, "%s: the file name '%s' should end in .png or .ppm", args->command, file);
    for (int i = 0; i < 2; ++i)
        if (strcmp(args->word[i], "element") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: 'element' is not supported; use type, with dump_modify acolor and adiam",
                           args->command);
    const bool is_own = strcmp(args->word[0], "speed") == 0 || strcmp(args->word[0], "orientation") == 0;
    return hs_dump_check_words(args, is_own ? 1 : 0, is_own ? 1 : 2, err);
}

/** The two words before the keywords. */
static hs_status parse_looks(hs_dump *dump, const hs_args *args, hs_error *err)
{
    hs_dump_image *state = dump->state;
    const char *color = args->word[0], *diameter = args->word[1];
    const bool is_speed = strcmp(color, "speed") == 0, is_orientation = strcmp(color, "orientation") == 0;
    state->color_by = is_speed                     ? HS_LOOK_SPEED
                      : is_orientation             ? HS_LOOK_ORIENTATION
                      : strcmp(color, "type") == 0 ? HS_LOOK_TYPE
                                                   : HS_LOOK_VALUE;
    state->diameter_by = strcmp(diameter, "type") == 0 ? HS_LOOK_TYPE : HS_LOOK_VALUE;
    const char *const words[] = {is_speed || is_orientation ? "type" : color, diameter, "mux", "muy"};
    const hs_args columns = {.command = args->command, .n = is_orientation ? 4 : 2, .word = words};
    return hs_dump_set_columns(dump, &columns, err);
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    hs_dump_image *state = dump->state;
    HS_TRY(hs_syntax_check(&dump->style->about.syntax, args, false, err));
    HS_TRY(check(dump->file, args, err));
    HS_TRY(set_defaults(dump, err));
    HS_TRY(parse_looks(dump, args, err));
    for (int i = 2; i < args->n;) {
        const hs_keyword *keyword = keywords;
        while (strcmp(keyword->name, args->word[i]) != 0) ++keyword; /* the syntax check knows it */
        HS_TRY(parse_keyword(state, args, i, err));
        i += 1 + keyword->n_values;
    }
    return HS_OK;
}

/** acolor <types> <colour>[/<colour>...]: the colours go round over the types. */
static hs_status modify_colors(hs_dump_image *state, const hs_args *args, int n_types, hs_error *err)
{
    int lo, hi, n = 0;
    HS_TRY(hs_arg_range(args, 1, n_types, &lo, &hi, err));
    char *list, *rest;
    HS_TRY(hs_memory_strdup(&list, args->word[2], err));
    hs_color *colors = NULL;
    hs_status status = HS_OK;
    rest = list;
    for (char *word = strsep(&rest, "/"); word != NULL && status == HS_OK; word = strsep(&rest, "/")) {
        const char *const words[] = {word};
        const hs_args one = {.command = args->command, .n = 1, .word = words};
        status = HS_GROW(colors, (size_t)n, (size_t)n + 1, err);
        if (status == HS_OK) status = hs_color_parse(&state->names, &one, 0, &colors[n++], err);
    }
    for (int type = lo; type <= hi && status == HS_OK; ++type) state->type_color[type] = colors[(type - lo) % n];
    HS_FREE(colors);
    HS_FREE(list);
    return status;
}

static hs_status modify_diameters(hs_dump_image *state, const hs_args *args, int n_types, hs_error *err)
{
    int lo, hi;
    double diameter;
    HS_TRY(hs_arg_range(args, 1, n_types, &lo, &hi, err));
    HS_TRY(hs_arg_positive(args, 2, &diameter, err));
    for (int type = lo; type <= hi; ++type) state->type_diameter[type] = diameter;
    return HS_OK;
}

static hs_status modify_names(hs_dump_image *state, const hs_args *args, hs_error *err)
{
    double part[3];
    HS_TRY(parse_vector(args, 2, part, err));
    for (int k = 0; k < 3; ++k)
        if (part[k] < 0.0 || part[k] > 1.0) return hs_arg_refuse(args, 2 + k, "a part from 0 to 1", NULL, err);
    return hs_color_names_add(&state->names, args->word[1], hs_color_of(part[0], part[1], part[2]), err);
}

static hs_status modify(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    static const char *const shared[] = {"delay", "every", "first", "maxfiles", "pad", "region", "thresh", NULL};
    hs_dump_image *state = dump->state;
    const int n_types = dump->env->atoms->n_types;
    const char *keyword = args->word[0];
    *n_used = 3;
    if (strcmp(keyword, "acolor") == 0) return modify_colors(state, args, n_types, err);
    if (strcmp(keyword, "adiam") == 0) return modify_diameters(state, args, n_types, err);
    if (strcmp(keyword, "amap") == 0) return hs_color_map_parse(&state->map, &state->names, args, n_used, err);
    *n_used = 2;
    if (strcmp(keyword, "backcolor") == 0) return hs_color_parse(&state->names, args, 1, &state->background, err);
    if (strcmp(keyword, "boxcolor") == 0) return hs_color_parse(&state->names, args, 1, &state->box_color, err);
    *n_used = 5;
    if (strcmp(keyword, "color") == 0) return modify_names(state, args, err);
    for (const char *const *name = shared; *name != NULL; ++name)
        if (strcmp(*name, keyword) == 0) return hs_dump_table_modify(dump, args, n_used, err);
    *n_used = 0;
    return HS_OK;
}

static void destroy(hs_dump *dump)
{
    hs_dump_image *state = dump->state;
    HS_FREE(state->type_color);
    HS_FREE(state->type_diameter);
    hs_color_names_fini(&state->names);
    hs_color_map_fini(&state->map);
    hs_dump_table_destroy(dump);
}

static hs_status init(hs_dump *dump, hs_error *err)
{
    hs_dump_image *state = dump->state;
    if (strchr(dump->file, '*') == NULL && !dump->is_single)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: every picture is a file of its own: the name '%s' needs a *, which becomes the step",
                       hs_dump_who(dump).text, dump->file);
    return hs_where_find(&state->table.where, dump->env, hs_dump_who(dump).text, err);
}

static hs_status write_picture(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    const hs_dump_image *state = dump->state;
    return writer != NULL ? hs_image_write(state->picture, dump->file, writer, err) : HS_OK;
}

static hs_status write(hs_dump *dump, hs_error *err)
{
    hs_dump_image *state = dump->state;
    const hs_env *env = dump->env;
    hs_image image = {0};
    double range[2];
    if (env->step == dump->last_written || env->step < state->table.delay) return HS_OK;
    dump->last_written = env->step;
    hs_status status = hs_dump_select(dump, err);
    status = hs_parallel_agree(env->parallel, err);
    if (status != HS_OK) return status;
    hs_dump_image_find_range(dump, range);
    status = hs_image_init(&image, state->width, state->height, state->is_smooth ? 2 : 1, state->background, err);
    if (status == HS_OK && (state->center_moves || !state->has_view)) {
        state->view = hs_image_look(&image, env->box, state->theta, state->phi, state->up, state->center, state->zoom);
        state->has_view = true;
    }
    if (status == HS_OK) status = hs_dump_image_draw(dump, &image, range, err);
    status = hs_parallel_agree(env->parallel, err);
    if (status == HS_OK) hs_image_merge(&image, env->parallel);
    state->picture = &image;
    if (status == HS_OK) status = hs_dump_write_step_file(dump, write_picture, err);
    state->picture = NULL;
    hs_image_fini(&image);
    return status;
}

/** With `center s` later pictures have the view of the first, whatever becomes of the box. */
static hs_status keep_state(hs_dump *dump, hs_state *state, hs_error *err)
{
    static const char has_view[] = "has view";
    hs_dump_image *self = dump->state;
    hs_image_view *view = &self->view;
    HS_TRY(hs_dump_table_keep(dump, state, err));
    if (state->is_reading && hs_state_find(state, has_view) == NULL) return HS_OK;
    HS_TRY(hs_state_bool(state, has_view, &self->has_view, err));
    HS_TRY(hs_state_double(state, "view center", view->center, 3, err));
    HS_TRY(hs_state_double(state, "view axes", view->axis[0], 9, err));
    HS_TRY(hs_state_double(state, "view scale", &view->scale, 1, err));
    return hs_state_double(state, "view middle", view->middle, 2, err);
}

const hs_dump_style hs_dump_style_image = {
    .about =
        {.name = "image",
         .syntax = {.usage = "<color> <diameter> [keyword value ...]", .n_min = 2, .n_max = 2, .keywords = keywords},
         .summary = "pictures of the atoms, PNG or PPM",
         .details =
             "One picture a snapshot: the file's name needs a `*`, and ends in `.png` or `.ppm`. In three dimensions "
             "atoms are shaded balls, nearer ones hide those behind; in two they are discs with a darker rim.\n\n"
             "`<color>` is `type` (red, green, blue, yellow, aqua, cyan in turn; `dump_modify acolor`); `speed`; "
             "`orientation`, the direction of the dipole in the plane as a hue (red along x, green at 120 degrees, "
             "blue at 240); or anything that `dump custom` can write: an attribute such as `vx` or `z`, `c_ID`, "
             "`f_ID`, `v_name`. Numbers become colours by `dump_modify amap`. `<diameter>` is `type` (1 for each; "
             "`dump_modify adiam`) or a number of each atom, in distance units, such as `diameter`.\n\n"
             "Of dump_modify there are `acolor`, `adiam`, `amap`, `backcolor`, `boxcolor`, `color`, and `delay`, "
             "`every`, `first`, `maxfiles`, `pad`, `region`, `thresh`. `amap <lo> <hi> <style> <delta> <N> <entries>` "
             "is LAMMPS's: lo and hi are numbers, or min and max of what there is; the style is `c` (continuous; "
             "entries `<value> <colour>` from min to max), `d` (discrete; `<lo> <hi> <colour>`) or `s` (sequential; "
             "`<colour>` for bins of width delta, again and again), followed by `a` (values as they are) or `f` (as "
             "fractions of the range). A name may stand for all that: `amap <lo> <hi> viridis`, `coolwarm`, `gray`. "
             "Without amap numbers go from blue to red. `color <name> <red> <green> <blue>` makes a new name from "
             "parts from 0 to 1; the names there are at first are the 140 of the web.\n\n"
             "The picture is the same for any number of ranks and threads. What LAMMPS can draw beyond this (bonds, "
             "shadows, perspective, other file formats) is refused.",
         .example = "dump p all image 1000 melt.*.png speed type adiam 1.1 size 800 800 view 70 30 zoom 1.2\n"
                    "dump_modify p backcolor white boxcolor gray amap 0 4 viridis"},
    .state_size = sizeof(hs_dump_image),
    .check = check,
    .create = create,
    .modify = modify,
    .destroy = destroy,
    .keep_state = keep_state,
    .init = init,
    .write = write,
};
