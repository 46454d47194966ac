/* Values of atoms that the deck makes up itself. */
#include <string.h>

#include "base/memory.h"
#include "io/data_file.h"
#include "style/custom_atom.h"
#include "style/fix.h"

typedef struct property {
    char *name;   /**< owned: "fix i_NAME" or "fix d_NAME" */
    void *values; /**< int32_t or double [n_local]; memory of the atoms */
} property;

typedef struct property_state {
    property *added; /**< owned [n]; stays in place, for the atoms point to values */
    int n;
} property_state;

static const hs_keyword keywords[] = {
    {"ghost", 1, "yes|no", "whether copies of atoms in the halo have the values, too; default no"},
    {NULL, 0, NULL, NULL},
};

static hs_status check_name(const hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    const char *word = args->word[i];
    if (strcmp(word, "mol") == 0 || strcmp(word, "q") == 0 || strcmp(word, "rmass") == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: '%s' is not supported: %s; a value of your own is i_<name> or d_<name>", args->command,
                       word,
                       word[0] == 'm'   ? "atoms belong to no molecules"
                       : word[0] == 'q' ? "atoms have no charge"
                                        : "masses of their own are what 'atom_style sphere' gives atoms");
    if (!hs_custom_atom_is_name(word))
        return hs_arg_refuse(args, i, "i_<name> or d_<name>, with letters, digits and underscores", NULL, err);
    HS_TRY(hs_name_check(args->command, "name", word, err));
    if (hs_custom_atom_find(fix->env->atoms, word[0], word + 2) == NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: atoms have '%s' already; unfix what has added it, or take another name",
                   args->command, word);
}

static hs_status add(hs_fix *fix, const char *name, bool goes_to_halo, hs_error *err)
{
    property_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    property *added = &state->added[state->n];
    HS_TRY(HS_ALLOC(added->name, strlen(name) + 5, err));
    ++state->n;
    strcat(strcpy(added->name, "fix "), name);
    HS_TRY(hs_atoms_add_field(atoms, added->name, &added->values, name[0] == 'i' ? sizeof(int32_t) : sizeof(double),
                              true, err));
    if (!goes_to_halo) hs_atoms_keep_from_halo(atoms, &added->values);
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    property_state *state = fix->state;
    bool goes_to_halo = false;
    const int n = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    for (int i = n; i < args->n; i += 2) HS_TRY(hs_arg_bool(args, i + 1, &goes_to_halo, err));
    HS_TRY(HS_ALLOC(state->added, (size_t)n, err));
    for (int i = 0; i < n; ++i) {
        HS_TRY(check_name(fix, args, i, err));
        HS_TRY(add(fix, args->word[i], goes_to_halo, err));
    }
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    property_state *state = fix->state;
    for (int k = 0; k < state->n; ++k) {
        if (state->added[k].values != NULL) hs_atoms_remove_field(fix->env->atoms, &state->added[k].values);
        HS_FREE(state->added[k].name);
    }
    HS_FREE(state->added);
}

/* ---- Data files ---- */

static const char *name_of(const property *p) { return p->name + strlen("fix "); }
static bool is_whole(const property *p) { return name_of(p)[0] == 'i'; }

static int n_values(const hs_fix *fix) { return ((const property_state *)fix->state)->n; }

static hs_status append_names(const hs_fix *fix, hs_text *text, hs_error *err)
{
    const property_state *state = fix->state;
    for (int k = 0; k < state->n; ++k)
        HS_TRY(hs_text_printf(text, err, "%s%s", k > 0 ? " " : "", name_of(&state->added[k])));
    return HS_OK;
}

static hs_status format(const hs_fix *fix, int i, hs_text *row, hs_error *err)
{
    const property_state *state = fix->state;
    char text[HS_SHORTEST_SIZE];
    for (int k = 0; k < state->n; ++k) {
        const property *p = &state->added[k];
        if (is_whole(p))
            HS_TRY(hs_text_printf(row, err, " %d", (int)((const int32_t *)p->values)[i]));
        else
            HS_TRY(hs_text_printf(row, err, " %s", hs_data_shortest(((const double *)p->values)[i], text)));
    }
    return HS_OK;
}

static hs_status parse(hs_fix *fix, int i, const char *const *word, hs_error *err)
{
    property_state *state = fix->state;
    for (int k = 0; k < state->n; ++k) {
        property *p = &state->added[k];
        int64_t whole;
        double real;
        if (is_whole(p)) {
            if (!hs_text_to_int64(word[k], &whole) || whole < INT32_MIN || whole > INT32_MAX)
                return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a whole number of 32 bits (%s)", word[k], name_of(p));
            if (i >= 0) ((int32_t *)p->values)[i] = (int32_t)whole;
        } else {
            if (!hs_text_to_double(word[k], &real))
                return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a finite number (%s)", word[k], name_of(p));
            if (i >= 0) ((double *)p->values)[i] = real;
        }
    }
    return HS_OK;
}

static const hs_fix_data data = {.n_values = n_values, .names = append_names, .format = format, .parse = parse};

const hs_fix_style hs_fix_style_property_atom = {
    .about =
        {.name = "property/atom",
         .syntax = {.usage = "i_<name>|d_<name> ... [ghost yes|no]", .n_min = 1, .n_max = -1, .keywords = keywords},
         .summary = "give atoms values of your own",
         .details = "Every atom gets the values named: `i_<name>` a whole number of 32 bits, `d_<name>` a real one, "
                    "both 0 at first. They stay with their atom wherever it goes, and are kept in checkpoints and "
                    "restart files; a fix with the same ID and words after `read_restart` gets them back. The group "
                    "does not matter: all atoms have them.\n\n"
                    "`set` gives values (`set group hot d_dose 1.5`, or from an atom-style variable), and `balance` "
                    "with `weight store`. Wherever a value per atom can be named, `i_<name>` and `d_<name>` can: in "
                    "dump custom, compute property/atom, compute reduce, fix ave/histo, fix ave/chunk and the formulas "
                    "of atom-style variables. With `ghost yes` the copies of atoms near the borders between ranks have "
                    "them as well; nothing that comes with Halfshell reads them there. `write_data` writes them into a "
                    "section with the fix's ID, from which `read_data ... fix ID NULL ID` reads them. LAMMPS's `mol`, "
                    "`q` and `rmass` are refused.",
         .example = "fix p all property/atom i_origin d_dose\nset region left i_origin 1\n"
                    "dump 1 all custom 100 traj.dump id x y z i_origin d_dose"},
    .state_size = sizeof(property_state),
    .create = create,
    .destroy = destroy,
    .needs_no_box = true,
    .data = &data,
};
