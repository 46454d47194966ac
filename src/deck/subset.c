#include "deck/subset.h"

#include "base/memory.h"
#include "deck/marsaglia.h"

/** A linked list of items through next[]; -1 is the end. */
typedef struct list {
    int64_t first, last, n;
} list;

static void append(list *to, int64_t *next, int64_t item)
{
    if (to->first < 0) to->first = item;
    if (to->last >= 0) next[to->last] = item;
    to->last = item;
    next[item] = -1;
    ++to->n;
}

/* Every round goes through those items that the round before left open, flips each with the probability that on average
   flips as many as are still missing or too many,
       and stops when the number is right. Since the rounds decide which random
   number belongs to which item, their order is part of the result. */
hs_status hs_subset_select(unsigned char *mark, int64_t n, int64_t n_wanted, int seed, hs_error *err)
{
    int64_t *next = NULL;
    HS_TRY(HS_ALLOC(next, (size_t)n, err));
    hs_marsaglia generator;
    hs_marsaglia_init(&generator, seed);
    list open[2] = {{-1, -1, 0}, {-1, -1, 0}}; /* not marked, marked */
    for (int64_t i = 0; i < n; ++i) {
        mark[i] = 0;
        append(&open[0], next, i);
    }
    for (int64_t n_marked = 0; n_marked != n_wanted;) {
        const int from = n_marked < n_wanted ? 0 : 1;
        const int64_t n_missing = from == 0 ? n_wanted - n_marked : n_marked - n_wanted;
        double chance = (double)n_missing / (double)open[from].n;
        if (chance < 0.01) chance = 0.01;
        if (chance > 0.99) chance = 0.99;
        list now[2] = {{-1, -1, 0}, {-1, -1, 0}};
        for (int64_t i = open[from].first, following; i >= 0; i = following) {
            following = next[i];
            if (hs_marsaglia_uniform(&generator) < chance) {
                mark[i] = from == 0;
                n_marked += from == 0 ? 1 : -1;
            }
            append(&now[mark[i]], next, i);
        }
        open[0] = now[0];
        open[1] = now[1];
    }
    HS_FREE(next);
    return HS_OK;
}
