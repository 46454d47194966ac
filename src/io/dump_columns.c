/* Values of atoms that dumps can write. */
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"

const char *const hs_dump_attributes[] = {
    "id", "type", "element", "mass", "proc", "procp1", "x",  "y",  "z",  "xs", "ys", "zs", "xu", "yu",
    "zu", "xsu",  "ysu",     "zsu",  "ix",   "iy",     "iz", "vx", "vy", "vz", "fx", "fy", "fz", NULL,
};

const char *hs_dump_check_word(const char *word)
{
    if (strchr(word, '$') != NULL || (strncmp(word, "v_", 2) == 0 && word[2] != '\0')) return NULL;
    for (int k = 0; k < HS_N_ATTRIBUTES; ++k)
        if (strcmp(hs_dump_attributes[k], word) == 0) return NULL;
    const char *nearest = hs_text_nearest(word, hs_dump_attributes, HS_N_ATTRIBUTES);
    return nearest != NULL ? nearest : "";
}

hs_status hs_dump_parse_column(const char *word, hs_dump_column *column, hs_error *err)
{
    memset(column, 0, sizeof *column);
    column->attribute = HS_ATTR_VARIABLE;
    for (int k = 0; k < HS_N_ATTRIBUTES; ++k)
        if (strcmp(hs_dump_attributes[k], word) == 0) column->attribute = (hs_attribute)k;
    if (column->attribute == HS_ATTR_VARIABLE && (strncmp(word, "v_", 2) != 0 || word[2] == '\0')) {
        if (strncmp(word, "c_", 2) == 0 || strncmp(word, "f_", 2) == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "'%s': no compute or fix of this version has values for each atom; an "
                           "atom-style variable may do: v_name",
                           word);
        if (strcmp(word, "mol") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "'mol' needs an atom style with molecules; atoms of style atomic have none");
        const char *nearest = hs_text_nearest(word, hs_dump_attributes, HS_N_ATTRIBUTES);
        return hs_fail(err, HS_ERROR_INPUT, "unknown attribute '%s'%s%s%s", word,
                       nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                       nearest != NULL ? "'?" : "");
    }
    return hs_memory_strdup(&column->name, word, err);
}

void hs_dump_fini_column(hs_dump_column *column)
{
    HS_FREE(column->name);
    HS_FREE(column->values);
    HS_FREE(column->user_format);
    HS_FREE(column->format);
}

bool hs_dump_is_int(const hs_dump_column *column)
{
    switch (column->attribute) {
    case HS_ATTR_ID:
    case HS_ATTR_TYPE:
    case HS_ATTR_PROC:
    case HS_ATTR_PROCP1:
    case HS_ATTR_IX:
    case HS_ATTR_IY:
    case HS_ATTR_IZ:
        return true;
    default:
        return false;
    }
}

/** Position along an axis and image, wrapped when dump_modify pbc asks for it. */
static double position(const hs_dump *dump, int axis, int i, int32_t *image)
{
    const hs_atoms *atoms = dump->env->atoms;
    *image = atoms->image[axis][i];
    if (!dump->wrap) return atoms->x[axis][i];
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    int32_t images[3] = {atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]};
    hs_box_wrap(dump->env->box, x, images);
    *image = images[axis];
    return x[axis];
}

double hs_dump_value(const hs_dump *dump, const hs_dump_column *column, int i)
{
    const hs_atoms *atoms = dump->env->atoms;
    const hs_box *box = dump->env->box;
    int32_t image;
    switch (column->attribute) {
    case HS_ATTR_VARIABLE:
        return column->values[i];
    case HS_ATTR_ID:
        return (double)atoms->id[i];
    case HS_ATTR_TYPE:
    case HS_ATTR_ELEMENT:
        return atoms->type[i];
    case HS_ATTR_MASS:
        return atoms->mass[atoms->type[i]];
    case HS_ATTR_PROC:
        return dump->env->parallel->rank;
    case HS_ATTR_PROCP1:
        return dump->env->parallel->rank + 1;
    default:
        break;
    }
    const int axis = (column->attribute - HS_ATTR_X) % 3;
    switch (column->attribute - axis) {
    case HS_ATTR_VX:
        return atoms->v[axis][i];
    case HS_ATTR_FX:
        return atoms->f[axis][i];
    default:
        break;
    }
    const double x = position(dump, axis, i, &image), length = hs_box_length(box, axis);
    switch (column->attribute - axis) {
    case HS_ATTR_X:
        return x;
    case HS_ATTR_XS:
        return (x - box->lo[axis]) * (1.0 / length);
    case HS_ATTR_XU:
        return x + image * length;
    case HS_ATTR_XSU:
        return (x - box->lo[axis]) * (1.0 / length) + image;
    default:
        return image;
    }
}
