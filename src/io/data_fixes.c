/* Sections of data files that fixes write and read: a line for each atom, its id and the values of the fix. */
#include <string.h>

#include "io/data_internal.h"

const hs_data_section *hs_data_find_section(const hs_data_reader *reader, const char *name)
{
    for (int k = 0; k < reader->options->n_sections; ++k)
        if (strcmp(reader->options->section[k].name, name) == 0) return &reader->options->section[k];
    return NULL;
}

static hs_status read_row(hs_data_reader *reader, const hs_data_section *section, int number, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    const hs_fix_data *data = section->fix->style->data;
    const int n = data->n_values(section->fix);
    int64_t id;
    bool is_new;
    if (lines->n_words != 1 + n)
        return hs_fail(err, HS_ERROR_INPUT, "a line of section %s is an atom id and %d value%s; this one has %d words",
                       section->name, n, n == 1 ? "" : "s", lines->n_words);
    HS_TRY(hs_data_read_id(reader, lines->word[0], &id, err));
    const int i = hs_data_find_atom(reader, id, number, section->name, &is_new);
    return data->parse(section->fix, is_new ? i : -1, lines->word + 1, err);
}

hs_status hs_data_read_section(hs_data_reader *reader, const hs_data_section *section, hs_error *err)
{
    const int k = (int)(section - reader->options->section);
    if (!reader->has_atoms) return hs_fail(err, HS_ERROR_INPUT, "the section %s must come after Atoms", section->name);
    if (reader->has_section[k]) return hs_fail(err, HS_ERROR_INPUT, "there is a section %s already", section->name);
    reader->has_section[k] = true;
    for (int64_t line = 0; line < reader->n_atoms; ++line) {
        HS_TRY(hs_data_next_row(reader, section->name, line, reader->n_atoms, err));
        HS_TRY(read_row(reader, section, HS_DATA_VELOCITIES + 1 + k, err));
    }
    if (reader->late.status != HS_OK) *err = reader->late;
    return hs_parallel_agree(reader->env->parallel, err);
}

void hs_data_warn_of_missing(const hs_data_reader *reader)
{
    for (int k = 0; k < reader->options->n_sections; ++k)
        if (!reader->has_section[k])
            hs_warn(reader->env->out, "%s: there is no section '%s' for fix '%s'", reader->lines.path,
                    reader->options->section[k].name, reader->options->section[k].fix->id);
}
