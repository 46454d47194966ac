#include "deck/outputs.h"

#include <string.h>

#include "base/text.h"
#include "io/files.h"

int hs_outputs_next(const hs_command *command, const hs_args *args, int from)
{
    const int first_of_style = 3;
    if (strcmp(args->command, "fix") != 0) return hs_syntax_next_output(&command->about.syntax, args, from);
    if (args->n <= first_of_style) return args->n;
    const hs_args words = hs_args_from(args, first_of_style, NULL);
    const int after = from > first_of_style ? from - first_of_style : 0;
    for (size_t k = 0; hs_fix_styles[k] != NULL; ++k)
        if (hs_text_is_style(args->word[2], hs_fix_styles[k]->about.name))
            return first_of_style + hs_syntax_next_output(&hs_fix_styles[k]->about.syntax, &words, after);
    return args->n;
}

hs_status hs_outputs_note_folder(hs_deck *deck, const char *folder, hs_error *err)
{
    return hs_name_list_add(&deck->folders, folder, err);
}

/** The next part of a path, and its length: "./a//b" has the parts a and b. */
static const char *next_part(const char *at, size_t *n)
{
    for (;;) {
        at += strspn(at, "/");
        *n = strcspn(at, "/");
        if (*n != 1 || *at != '.') return at;
        ++at;
    }
}

/** Whether all folders of a file's name are on the way to, or are, a folder. */
static bool is_within(const char *file, const char *folder)
{
    if ((file[0] == '/') != (folder[0] == '/')) return false;
    for (const char *end = strrchr(file, '/'); end != NULL;) {
        size_t n, n_folder;
        file = next_part(file, &n);
        if (file >= end) return true;
        folder = next_part(folder, &n_folder);
        if (n != n_folder || memcmp(file, folder, n) != 0) return false;
        file += n;
        folder += n;
    }
    return false;
}

hs_status hs_outputs_check(hs_deck *deck, const char *who, const char *file, hs_error *err)
{
    for (int i = 0; i < deck->folders.n; ++i)
        if (strchr(deck->folders.name[i], '$') != NULL || is_within(file, deck->folders.name[i])) return HS_OK;
    return hs_file_check_place(&deck->sim->parallel, who, file, err);
}
