/* Sizes, numbers and places of chunks. */

#include "base/memory.h"
#include "style/per_chunk.h"

typedef enum { COUNT, ORIGINAL, COORD1, COORD2, COORD3 } chunk_property;
static const char *const properties[] = {"count", "id", "coord1", "coord2", "coord3", NULL};

typedef struct property_state {
    hs_per_chunk base; /**< first */
    int *property;     /**< owned [n]: chunk_property of each column */
    int n;
} property_state;

/** Whether the chunks, which may be others than when this was defined, have what column k shows. */
static bool have(const hs_chunks *chunks, int property)
{
    if (property == ORIGINAL) return chunks->is_compressed;
    return property < COORD1 || property - COORD1 < chunks->n_axes;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    property_state *state = compute->state;
    state->n = args->n - 1;
    HS_TRY(HS_ALLOC(state->property, (size_t)state->n, err));
    for (int k = 0; k < state->n; ++k) HS_TRY(hs_arg_choice(args, 1 + k, properties, &state->property[k], err));
    HS_TRY(hs_per_chunk_create(compute, args, state->n, state->n > 1, err));
    const hs_chunks *chunks = hs_chunks_of(state->base.chunk_atom);
    for (int k = 0; k < state->n; ++k)
        if (!have(chunks, state->property[k]))
            return hs_arg_refuse(args, 1 + k,
                                 state->property[k] == ORIGINAL
                                     ? "of use where chunks are not compressed: numbers are those of the rows"
                                     : "a coordinate that these chunks have",
                                 NULL, err);
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    HS_FREE(((property_state *)compute->state)->property);
    hs_per_chunk_destroy(compute);
}

static double one(const hs_compute *compute, int i, int64_t c, const void *context)
{
    (void)compute, (void)i, (void)c, (void)context;
    return 1.0;
}

static hs_status evaluate(hs_compute *compute, hs_error *err)
{
    const property_state *state = compute->state;
    HS_TRY(hs_per_chunk_begin(compute, err));
    const hs_chunks *chunks = hs_chunks_of(state->base.chunk_atom);
    for (int k = 0; k < state->n; ++k) {
        const int property = state->property[k];
        if (!have(chunks, property))
            return hs_fail(err, HS_ERROR_INPUT, "%s: the chunks of '%s' have no %s any more",
                           hs_compute_who(compute).text, state->base.chunk_id, properties[property]);
        if (property == COUNT) HS_TRY(hs_per_chunk_sum(compute, k, one, NULL, err));
        for (int64_t c = 0; c < state->base.n && property != COUNT; ++c)
            *hs_per_chunk_at(compute, c, k) = property == ORIGINAL
                                                  ? (double)chunks->original[c]
                                                  : chunks->place[c * chunks->n_axes + property - COORD1];
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_property_chunk = {
    .about = {.name = "property/chunk",
              .syntax = {.usage = "<chunk-ID> <count | id | coord1 | coord2 | coord3> ...", .n_min = 2, .n_max = -1},
              .summary = "sizes, numbers and places of chunks",
              .details =
                  "For each chunk of the compute chunk/atom: `count`, how many of its atoms are in the group; `id`, "
                  "its number before chunks were compressed; `coord1` to `coord3`, the coordinates of its middle "
                  "(distance, or fractions of the box with `units reduced`; shells: the radius first). One property "
                  "makes the vector `c_ID`, several the columns of the array `c_ID[*]`; rows are chunks.",
              .example = "compute c all cluster/atom 1.5\ncompute drops all chunk/atom c_c compress yes\ncompute size "
                         "all property/chunk drops count\nfix 1 all ave/histo 100 1 100 0 200 200 c_size mode vector "
                         "ave running file sizes.txt"},
    .state_size = sizeof(property_state),
    .create = create,
    .destroy = destroy,
    .init = hs_per_chunk_init,
    .vector = evaluate,
    .array = evaluate,
};
