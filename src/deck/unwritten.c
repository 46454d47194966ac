#include "deck/unwritten.h"

#include <string.h>

#include "base/memory.h"
#include "io/files.h"

typedef struct hs_unwritten {
    char *name; /**< owned */
    hs_text text;
    struct hs_unwritten *next;
} hs_unwritten;

static hs_unwritten *find(const hs_deck *deck, const char *file)
{
    hs_unwritten *at = deck->unwritten;
    while (at != NULL && strcmp(at->name, file) != 0) at = at->next;
    return at;
}

hs_status hs_unwritten_add(hs_deck *deck, const char *file, const char *line, bool is_append, hs_error *err)
{
    hs_unwritten *entry = find(deck, file);
    if (entry == NULL && is_append && hs_file_is_readable(&deck->sim->parallel, file)) return HS_OK;
    if (entry == NULL) {
        HS_TRY(HS_ALLOC(entry, 1, err));
        entry->next = deck->unwritten;
        deck->unwritten = entry;
        HS_TRY(hs_memory_strdup(&entry->name, file, err));
    }
    if (!is_append) hs_text_clear(&entry->text);
    HS_TRY(hs_text_append(&entry->text, line, strlen(line), err));
    return hs_text_append(&entry->text, "\n", 1, err);
}

const hs_text *hs_unwritten_find(const hs_deck *deck, const char *file)
{
    const hs_unwritten *entry = find(deck, file);
    return entry != NULL ? &entry->text : NULL;
}

hs_status hs_unwritten_open(const hs_deck *deck, hs_lines *lines, const char *file, hs_error *err)
{
    const hs_text *text = hs_unwritten_find(deck, file);
    const hs_parallel *parallel = &deck->sim->parallel;
    return text != NULL ? hs_lines_open_text(lines, file, text, parallel, err)
                        : hs_lines_open(lines, file, parallel, err);
}

void hs_unwritten_fini(hs_deck *deck)
{
    for (hs_unwritten *at = deck->unwritten, *next; at != NULL; at = next) {
        next = at->next;
        HS_FREE(at->name);
        hs_text_fini(&at->text);
        HS_FREE(at);
    }
    deck->unwritten = NULL;
}
