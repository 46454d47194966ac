/** Variables whose values per atom are sets in a file: a count, then as many lines of an ID and a number. Between sets
 *  they belong to the atoms: a field that travels with them. */
#include <stdio.h>

#include "base/memory.h"
#include "deck/unwritten.h"
#include "deck/variables.h"
#include "io/id_map.h"

typedef struct hs_atomfile {
    hs_atoms *atoms; /**< borrowed */
    double *values;  /**< field of the atoms */
    char *field;     /**< owned; its name: by it checkpoints find the values */
    hs_lines lines;  /**< open from the first set on that this process reads */
    bool is_open;
    unsigned char *is_read; /**< owned [n_local] while a set is read: atoms that it has named */
} hs_atomfile;

const double *hs_variable_atom_values(const hs_variable *variable) { return variable->atom_file->values; }

void hs_atomfile_destroy(hs_atomfile **file)
{
    if (*file == NULL) return;
    if ((*file)->is_open) hs_lines_close(&(*file)->lines);
    if ((*file)->values != NULL) hs_atoms_remove_field((*file)->atoms, (void **)&(*file)->values);
    HS_FREE((*file)->field);
    HS_FREE((*file)->is_read);
    HS_FREE(*file);
}

static hs_status join_atoms(hs_variable *variable, hs_atoms *atoms, hs_error *err)
{
    hs_text name = {0};
    HS_TRY(HS_ALLOC(variable->atom_file, 1, err));
    hs_atomfile *file = variable->atom_file;
    file->atoms = atoms;
    hs_status status = hs_text_printf(&name, err, "variable %s", variable->name);
    if (status == HS_OK) status = hs_memory_strdup(&file->field, hs_text_get(&name), err);
    hs_text_fini(&name);
    if (status == HS_OK)
        status = hs_atoms_add_field(atoms, file->field, (void **)&file->values, sizeof *file->values, false, err);
    return status;
}

hs_status hs_variables_join_atoms(hs_variables *variables, hs_atoms *atoms, hs_error *err)
{
    for (int i = 0; i < variables->n; ++i) {
        hs_variable *variable = variables->variable[i];
        if (variable->style == HS_VARIABLE_ATOMFILE && variable->atom_file == NULL)
            HS_TRY(join_atoms(variable, atoms, err));
    }
    return HS_OK;
}

static hs_status refuse_line(const hs_lines *lines, const char *why, hs_error *err)
{
    return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: %s", lines->path, lines->number, why);
}

/** The line with the number of values; *n = -1 at the end of the file. */
static hs_status read_count(hs_lines *lines, int64_t *n, hs_error *err)
{
    *n = -1;
    HS_TRY(hs_lines_next_filled(lines, err));
    if (lines->at_end) return HS_OK;
    if (lines->n_words == 1 && hs_text_to_int64(lines->word[0], n) && *n >= 0) return HS_OK;
    return refuse_line(lines, "a set begins with a line that is the number of its values", err);
}

/** A line of the set. Every rank gets it; one of them may have the atom. */
static hs_status read_value(hs_atomfile *file, const hs_id_map *local, int64_t max_id, hs_error *err)
{
    hs_lines *lines = &file->lines;
    int64_t id;
    double value;
    HS_TRY(hs_lines_next_filled(lines, err));
    if (lines->at_end) return refuse_line(lines, "the file ends within a set: its first line counts more values", err);
    if (lines->n_words != 2 || !hs_text_to_int64(lines->word[0], &id) || !hs_text_to_double(lines->word[1], &value))
        return refuse_line(lines, "a line of a set is an atom's ID and a number", err);
    if (id < 1 || id > max_id)
        return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: the ID %lld is not one from 1 to %lld, the largest there is",
                       lines->path, lines->number, (long long)id, (long long)max_id);
    const int32_t *at = hs_id_map_find(local, id);
    if (at == NULL) return HS_OK; /* another rank's, or gone */
    if (file->is_read[*at]) HS_UNLESS_FAILED(err, refuse_line(lines, "the atom has a value in this set already", err));
    file->is_read[*at] = 1;
    file->values[*at] = value;
    return HS_OK;
}

static hs_status read_set(hs_atomfile *file, int64_t n, const hs_sim *sim, hs_error *err)
{
    const hs_atoms *atoms = file->atoms;
    hs_id_map local = {0};
    int64_t max_id = hs_atoms_max_id(atoms);
    hs_parallel_max_int64(&sim->parallel, &max_id, 1);
    HS_UNLESS_FAILED(err, HS_ALLOC(file->is_read, (size_t)atoms->n_local, err));
    for (int i = 0; i < atoms->n_local; ++i) {
        file->values[i] = 0.0; /* of atoms that are not in the set */
        HS_UNLESS_FAILED(err, hs_id_map_add(&local, atoms->id[i], i, err));
    }
    hs_status status = hs_parallel_agree(&sim->parallel, err);
    for (int64_t k = 0; k < n && status == HS_OK; ++k) status = read_value(file, &local, max_id, err);
    if (status == HS_OK) status = hs_parallel_agree(&sim->parallel, err); /* one rank may have seen an atom twice */
    hs_id_map_fini(&local);
    HS_FREE(file->is_read);
    return status;
}

/** Pass over the sets that were read before a checkpoint. */
static hs_status skip_sets(hs_lines *lines, int64_t n_sets, hs_error *err)
{
    for (int64_t set = 0; set < n_sets; ++set) {
        int64_t n;
        HS_TRY(read_count(lines, &n, err));
        for (int64_t k = 0; k < n && !lines->at_end; ++k) HS_TRY(hs_lines_next_filled(lines, err));
    }
    return HS_OK;
}

hs_status hs_variable_read_atoms(hs_variable *variable, hs_deck *deck, bool *is_there, hs_error *err)
{
    hs_atomfile *file = variable->atom_file;
    int64_t n;
    HS_TRY(hs_sim_need_box(deck->sim, "variable (atomfile)", err));
    if (!file->is_open) {
        HS_TRY(hs_unwritten_open(deck, &file->lines, variable->value[0], err));
        file->is_open = true;
        HS_TRY(skip_sets(&file->lines, variable->which, err));
    }
    HS_TRY(read_count(&file->lines, &n, err));
    *is_there = n >= 0;
    if (n < 0) return HS_OK;
    ++variable->which;
    hs_env_changed(&deck->sim->env); /* computes may remember what they made of the values */
    return read_set(file, n, deck->sim, err);
}
