#include "deck/name_list.h"

#include <string.h>

#include "base/memory.h"

hs_status hs_name_list_add(hs_name_list *list, const char *name, hs_error *err)
{
    HS_TRY(HS_EXTEND(list->name, list->n, list->capacity, err));
    HS_TRY(hs_memory_strdup(&list->name[list->n], name, err));
    ++list->n;
    return HS_OK;
}

bool hs_name_list_has(const hs_name_list *list, const char *name)
{
    for (int i = 0; i < list->n; ++i)
        if (strcmp(list->name[i], name) == 0) return true;
    return false;
}

void hs_name_list_fini(hs_name_list *list)
{
    for (int i = 0; i < list->n; ++i) HS_FREE(list->name[i]);
    HS_FREE(list->name);
    list->n = 0;
    list->capacity = 0;
}
