/** A list of names that grows. */
#ifndef HS_DECK_NAME_LIST_H
#define HS_DECK_NAME_LIST_H

#include "base/error.h"

typedef struct hs_name_list {
    char **name; /**< owned [n] */
    int n;
    size_t capacity;
} hs_name_list;

HS_MUST_USE hs_status hs_name_list_add(hs_name_list *list, const char *name, hs_error *err);
bool hs_name_list_has(const hs_name_list *list, const char *name);
void hs_name_list_fini(hs_name_list *list);

#endif
