/* Columns of the sections Atoms and Velocities, which differ between atom styles. */

#include "core/atom_style.h"
#include "io/data_internal.h"

typedef struct column {
    const char *usage;
    int n_words;
} column;

static const column columns[] = {
    [HS_DATA_PLACE] = {"x y z", 3}, [HS_DATA_DIAMETER] = {"diameter", 1},  [HS_DATA_DENSITY] = {"density", 1},
    [HS_DATA_CHARGE] = {"q", 1},    [HS_DATA_DIPOLE] = {"mux muy muz", 3},
};

int hs_data_column_words(hs_data_column kind) { return columns[kind].n_words; }

static void append(hs_data_columns *layout, hs_data_column kind)
{
    layout->column[layout->n++] = kind;
    layout->n_words += columns[kind].n_words;
}

hs_data_columns hs_data_columns_of(const hs_atom_style *style)
{
    hs_data_columns layout = {.n_words = 2};
    if (style->is_hybrid || style->n_parts == 0) append(&layout, HS_DATA_PLACE);
    for (int k = 0; k < style->n_parts; ++k) {
        const bool has_place = !style->is_hybrid;
        if (style->part[k] == HS_ATOM_SPHERE) {
            append(&layout, HS_DATA_DIAMETER);
            append(&layout, HS_DATA_DENSITY);
        }
        if (style->part[k] == HS_ATOM_DIPOLE) append(&layout, HS_DATA_CHARGE);
        if (has_place) append(&layout, HS_DATA_PLACE);
        if (style->part[k] == HS_ATOM_DIPOLE) append(&layout, HS_DATA_DIPOLE);
    }
    return layout;
}

hs_status hs_data_refuse_columns(const hs_atom_style *style, int n_words, hs_error *err)
{
    const hs_data_columns layout = hs_data_columns_of(style);
    char name[HS_ATOM_STYLE_NAME_SIZE];
    hs_text usage = {0};
    hs_status status = hs_text_printf(&usage, err, "id type");
    for (int k = 0; k < layout.n && status == HS_OK; ++k)
        status = hs_text_printf(&usage, err, " %s", columns[layout.column[k]].usage);
    hs_atom_style_name(style, name);
    if (status == HS_OK)
        status = hs_fail(err, HS_ERROR_INPUT,
                         "a line of Atoms (style %s) is '%s' with three image flags or none; this one has %d words",
                         name, hs_text_get(&usage), n_words);
    hs_text_fini(&usage);
    return status;
}

hs_status hs_data_set_column(hs_atoms *atoms, int i, hs_data_column kind, const double *value, hs_error *err)
{
    switch (kind) {
    case HS_DATA_DIAMETER:
        if (!(value[0] >= 0.0)) return hs_fail(err, HS_ERROR_INPUT, "the diameter %g is below 0", value[0]);
        atoms->radius[i] = 0.5 * value[0];
        return HS_OK;
    case HS_DATA_DENSITY: /* the diameter stands before it */
        if (!(value[0] > 0.0)) return hs_fail(err, HS_ERROR_INPUT, "the density %g is not above 0", value[0]);
        atoms->rmass[i] = value[0] * hs_ball_volume(atoms->radius[i]);
        return HS_OK;
    case HS_DATA_CHARGE:
        if (value[0] == 0.0) return HS_OK;
        return hs_fail(err, HS_ERROR_INPUT, "the charge %g is not 0: there are no charges", value[0]);
    case HS_DATA_DIPOLE:
        hs_atom_set_dipole(atoms, i, value);
        return HS_OK;
    default:
        return HS_OK;
    }
}

int hs_data_get_column(const hs_atoms *atoms, int i, hs_data_column kind, const double place[3], double value[3])
{
    switch (kind) {
    case HS_DATA_DIAMETER:
        value[0] = 2.0 * atoms->radius[i];
        break;
    case HS_DATA_DENSITY:
        value[0] = atoms->rmass[i] / hs_ball_volume(atoms->radius[i]);
        break;
    case HS_DATA_CHARGE:
        value[0] = 0.0;
        break;
    case HS_DATA_DIPOLE:
        for (int axis = 0; axis < 3; ++axis) value[axis] = atoms->mu[axis][i];
        break;
    case HS_DATA_PLACE:
        for (int axis = 0; axis < 3; ++axis) value[axis] = place[axis];
        break;
    }
    return columns[kind].n_words;
}
