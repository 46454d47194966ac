#include "style/dump.h"

#include <string.h>

#include "base/memory.h"

hs_who hs_dump_who(const hs_dump *dump)
{
    hs_who who;
    snprintf(who.text, sizeof who.text, "dump '%.128s' (%.40s)", dump->id, dump->style->about.name);
    return who;
}

hs_status hs_dump_read_every(hs_dump *dump, const hs_args *args, hs_error *err)
{
    if (strncmp(args->word[1], "v_", 2) == 0) return hs_memory_replace(&dump->every_variable, args->word[1] + 2, err);
    HS_FREE(dump->every_variable);
    return hs_arg_int(args, 1, 1, INT64_MAX, &dump->every, err);
}
