#include "deck/source.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "deck/unwritten.h"

/** A deck is text for people: a larger file is something else. */
static const size_t size_max = (size_t)1 << 28;

const char *hs_source_name(const char *file)
{
    return file == NULL || strcmp(file, "-") == 0 ? "(standard input)" : file;
}

static hs_status read_stream(FILE *stream, const char *file, hs_text *text, hs_error *err)
{
    char part[8192];
    size_t n;
    while ((n = fread(part, 1, sizeof part, stream)) > 0) {
        HS_TRY(hs_text_append(text, part, n, err));
        if (text->length > size_max)
            return hs_fail(err, HS_ERROR_INPUT, "%s: larger than 256 MiB, so not a deck", file);
    }
    if (ferror(stream)) return hs_fail(err, HS_ERROR_INPUT, "%s: cannot be read: %s", file, strerror(errno));
    return HS_OK;
}

static hs_status read_here(const char *file, hs_text *text, hs_error *err)
{
    struct stat info;
    if (file == NULL || strcmp(file, "-") == 0) return read_stream(stdin, hs_source_name(file), text, err);
    if (stat(file, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISFIFO(info.st_mode) && !S_ISCHR(info.st_mode))
        return hs_fail(err, HS_ERROR_INPUT, "the file '%.400s' cannot be read: it is not a file of text", file);
    FILE *stream = fopen(file, "rb");
    if (stream == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "the file '%.400s' cannot be read: %s", file, strerror(errno));
    hs_status status = read_stream(stream, file, text, err);
    fclose(stream);
    return status;
}

/** Give rank 0's text to all ranks: a sum in which the others add nothing, eight bytes to a number. */
static hs_status share(const hs_parallel *parallel, hs_text *text, hs_error *err)
{
    enum { N = 1024 };
    int64_t size = parallel->rank == 0 ? (int64_t)text->length : 0, part[N];
    hs_parallel_sum_int64(parallel, &size, 1);
    for (int64_t at = 0; at < size; at += (int64_t)sizeof part) {
        const size_t n = size - at < (int64_t)sizeof part ? (size_t)(size - at) : sizeof part;
        memset(part, 0, sizeof part);
        if (parallel->rank == 0) memcpy(part, text->data + at, n);
        hs_parallel_sum_int64(parallel, part, N);
        if (parallel->rank != 0) HS_TRY(hs_text_append(text, (const char *)part, n, err));
    }
    return HS_OK;
}

/** Rank 0 reads, all ranks get the text. */
static hs_status read_shared(const hs_parallel *parallel, const char *file, hs_text *text, hs_error *err)
{
    if (parallel->rank == 0) {
        const hs_status status = read_here(file, text, err);
        (void)status; /* also in err, which the ranks agree on */
    }
    HS_TRY(hs_parallel_agree(parallel, err));
    return parallel->n_ranks > 1 ? share(parallel, text, err) : HS_OK;
}

/** A file that can be read once only, as bash makes for `<(...)`. Collective. */
static bool is_pipe(const hs_parallel *parallel, const char *file)
{
    struct stat info;
    int64_t answer = parallel->rank == 0 && stat(file, &info) == 0 && S_ISFIFO(info.st_mode);
    hs_parallel_sum_int64(parallel, &answer, 1);
    return answer != 0;
}

/** Read a pipe for the first time, and keep what came out for the second pass. */
static hs_status read_pipe(hs_deck *deck, const char *file, hs_text *text, hs_error *err)
{
    if (deck->pipe_name != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "the file '%.400s' is a pipe, and so was '%.400s': only one of them can be",
                       file, deck->pipe_name);
    HS_TRY(hs_memory_strdup(&deck->pipe_name, file, err));
    HS_TRY(read_shared(&deck->sim->parallel, file, text, err));
    return hs_text_append(&deck->pipe, hs_text_get(text), text->length, err);
}

hs_status hs_source_read(hs_deck *deck, const char *file, hs_text *text, hs_error *err)
{
    const hs_parallel *parallel = &deck->sim->parallel;
    const bool is_input = file == NULL || strcmp(file, "-") == 0;
    if (is_input && deck->input_is_read)
        return hs_text_append(text, hs_text_get(&deck->input), deck->input.length, err);
    if (!is_input && deck->pipe_name != NULL && strcmp(file, deck->pipe_name) == 0)
        return hs_text_append(text, hs_text_get(&deck->pipe), deck->pipe.length, err);
    const hs_text *unwritten = is_input ? NULL : hs_unwritten_find(deck, file);
    if (unwritten != NULL) return hs_text_append(text, hs_text_get(unwritten), unwritten->length, err);
    if (!is_input && is_pipe(parallel, file)) return read_pipe(deck, file, text, err);
    HS_TRY(read_shared(parallel, file, text, err));
    if (!is_input) return HS_OK;
    deck->input_is_read = true;
    return hs_text_append(&deck->input, hs_text_get(text), text->length, err);
}

static void destroy(hs_source *source)
{
    HS_FREE(source->name);
    HS_FREE(source->jump_name);
    hs_text_fini(&source->text);
    HS_FREE(source);
}

hs_status hs_source_push(hs_deck *deck, const char *file, hs_error *err)
{
    const int depth = deck->source != NULL ? deck->source->depth + 1 : 1;
    if (depth > HS_SOURCES_MAX)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "include: '%.400s' would be file number %d within one another (at most %d): does it include itself?", file,
            depth, HS_SOURCES_MAX);
    hs_source *source = NULL;
    HS_TRY(HS_ALLOC(source, 1, err));
    hs_status status = hs_memory_strdup(&source->name, hs_source_name(file), err);
    if (status == HS_OK) status = hs_source_read(deck, file, &source->text, err);
    if (status != HS_OK) {
        destroy(source);
        return status;
    }
    source->depth = depth;
    source->below = deck->source;
    deck->source = source;
    return HS_OK;
}

hs_status hs_source_push_text(hs_deck *deck, const char *name, const char *text, size_t at, long n_lines_read,
                              long line, hs_error *err)
{
    const int depth = deck->source != NULL ? deck->source->depth + 1 : 1;
    const size_t n = strlen(text);
    if (depth > HS_SOURCES_MAX || at > n) return hs_fail(err, HS_ERROR_INPUT, "the place in the deck is none");
    hs_source *source = NULL;
    HS_TRY(HS_ALLOC(source, 1, err));
    hs_status status = hs_memory_strdup(&source->name, name, err);
    if (status == HS_OK) status = hs_text_append(&source->text, text, n, err);
    if (status != HS_OK) {
        destroy(source);
        return status;
    }
    source->cursor = (hs_cursor){.at = at, .n_lines_read = n_lines_read};
    source->line = line;
    source->depth = depth;
    source->below = deck->source;
    deck->source = source;
    return HS_OK;
}

hs_status hs_source_jump(hs_deck *deck, const char *file, hs_error *err)
{
    hs_source *top = deck->source;
    HS_TRY(hs_memory_replace(&top->jump_name, top->name, err));
    top->jump_line = top->line;
    if (strcmp(file, "SELF") != 0) {
        hs_text text = {0};
        char *name = NULL;
        hs_status status = hs_source_read(deck, file, &text, err);
        if (status == HS_OK) status = hs_memory_strdup(&name, hs_source_name(file), err);
        if (status != HS_OK) {
            hs_text_fini(&text);
            return status;
        }
        hs_text_fini(&top->text);
        HS_FREE(top->name);
        top->text = text;
        top->name = name;
    }
    memset(&top->cursor, 0, sizeof top->cursor);
    return HS_OK;
}

void hs_source_pop(hs_deck *deck)
{
    hs_source *top = deck->source;
    if (top == NULL) return;
    deck->source = top->below;
    destroy(top);
}

bool hs_source_has_label(const char *data, size_t size, const char *label)
{
    hs_cursor cursor = {0};
    hs_text line = {0};
    hs_error ignored = {0};
    bool is_there = false, found = true;
    long first;
    while (!is_there && hs_lexer_line(data, size, &cursor, &line, &first, &found, &ignored) == HS_OK && found) {
        hs_words words = {0};
        if (line.data == NULL) continue;
        hs_lexer_strip_comment(line.data);
        if (hs_words_split(&words, line.data, &ignored) == HS_OK && words.n == 2 && strcmp(words.word[0], "label") == 0)
            /* a label that holds a variable may become any name */
            is_there = strcmp(words.word[1], label) == 0 || strchr(words.word[1], '$') != NULL;
        hs_words_fini(&words);
        hs_error_clear(&ignored);
    }
    hs_text_fini(&line);
    return is_there;
}
