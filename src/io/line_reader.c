#include "io/line_reader.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

#include "base/memory.h"

enum { CHUNK_BYTES = 1 << 20 };

static hs_status open_here(hs_lines *lines, hs_error *err)
{
    struct stat info;
    const char *path = lines->path;
    if (stat(path, &info) != 0) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    if (S_ISDIR(info.st_mode)) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: it is a directory", path);
    lines->file = gzopen(path, "rb"); /* reads plain files too */
    if (lines->file == NULL) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    return HS_OK;
}

hs_status hs_lines_open(hs_lines *lines, const char *path, const hs_parallel *parallel, hs_error *err)
{
    memset(lines, 0, sizeof *lines);
    lines->path = path;
    lines->parallel = parallel;
    HS_UNLESS_FAILED(err, HS_ALLOC(lines->chunk, CHUNK_BYTES, err));
    if (parallel->rank == 0) HS_UNLESS_FAILED(err, open_here(lines, err));
    if (hs_parallel_agree(parallel, err) != HS_OK) hs_lines_close(lines);
    return err->status;
}

hs_status hs_lines_open_text(hs_lines *lines, const char *path, const hs_text *text, const hs_parallel *parallel,
                             hs_error *err)
{
    *lines = (hs_lines){.path = path, .parallel = parallel, .is_whole = true, .n_chunk = text->length};
    HS_TRY(HS_ALLOC(lines->chunk, text->length + 1, err));
    if (text->length > 0) memcpy(lines->chunk, text->data, text->length);
    return HS_OK;
}

void hs_lines_close(hs_lines *lines)
{
    if (lines->file != NULL) gzclose(lines->file);
    HS_FREE(lines->chunk);
    hs_text_fini(&lines->text);
    memset(lines, 0, sizeof *lines);
}

static hs_status read_chunk(hs_lines *lines, int64_t *n, hs_error *err)
{
    int code;
    *n = gzread(lines->file, lines->chunk, CHUNK_BYTES);
    const char *message = gzerror(lines->file, &code);
    if (*n >= 0 && (code == Z_OK || code == Z_STREAM_END)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "'%s' is damaged or cut short: %s", lines->path,
                   code == Z_ERRNO ? strerror(errno) : message);
}

/** The next bytes of the file, for all ranks. */
static hs_status next_chunk(hs_lines *lines, hs_error *err)
{
    int64_t n = 0;
    lines->is_drained = lines->is_whole;
    if (lines->is_whole) return HS_OK;
    if (lines->parallel->rank == 0) HS_UNLESS_FAILED(err, read_chunk(lines, &n, err));
    HS_TRY(hs_parallel_agree(lines->parallel, err));
    hs_parallel_broadcast(lines->parallel, 0, &n, sizeof n);
    hs_parallel_broadcast(lines->parallel, 0, lines->chunk, (size_t)n);
    lines->n_chunk = (size_t)n;
    lines->chunk_at = 0;
    lines->is_drained = n == 0;
    return HS_OK;
}

/** Bytes up to the end of the line into text; *has_line = false at the end of the file. */
static hs_status read_bytes(hs_lines *lines, bool *has_line, hs_error *err)
{
    hs_text_clear(&lines->text);
    *has_line = false;
    for (;;) {
        if (lines->chunk_at == lines->n_chunk && !lines->is_drained) HS_TRY(next_chunk(lines, err));
        if (lines->is_drained) return HS_OK;
        const char *at = lines->chunk + lines->chunk_at;
        const size_t n_left = lines->n_chunk - lines->chunk_at;
        const char *end = memchr(at, '\n', n_left);
        const size_t n = end != NULL ? (size_t)(end - at) + 1 : n_left;
        *has_line = true;
        lines->chunk_at += n;
        if (memchr(at, '\0', n) != NULL)
            return hs_fail(err, HS_ERROR_INPUT, "the line holds a zero byte: this is no text file");
        HS_TRY(hs_text_append(&lines->text, at, n, err));
        if (end != NULL) return HS_OK;
        if (lines->text.length > HS_LINE_BYTES_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "the line is longer than %d bytes", HS_LINE_BYTES_MAX);
    }
}

static hs_status split(hs_lines *lines, hs_error *err)
{
    char *at = lines->text.data, *hash = at != NULL ? strchr(at, '#') : NULL;
    lines->n_words = 0;
    lines->comment[0] = '\0';
    if (hash != NULL) {
        *hash = '\0';
        const char *word = hash + 1 + strspn(hash + 1, " \t\r\n#");
        snprintf(lines->comment, sizeof lines->comment, "%.*s", (int)strcspn(word, " \t\r\n"), word);
    }
    for (char *c = at; c != NULL && *c != '\0'; ++c)
        if (iscntrl((unsigned char)*c) && strchr("\t\r\n\f", *c) == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "the line holds a control character: this is no text file");
    char *rest = NULL;
    for (char *word = at != NULL ? strtok_r(at, " \t\r\n\f", &rest) : NULL; word != NULL;
         word = strtok_r(NULL, " \t\r\n\f", &rest)) {
        if (lines->n_words == HS_LINE_WORDS_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "the line has more than %d words", HS_LINE_WORDS_MAX);
        lines->word[lines->n_words++] = word;
    }
    return HS_OK;
}

hs_status hs_lines_next(hs_lines *lines, hs_error *err)
{
    bool has_line;
    if (lines->is_held) {
        lines->is_held = false;
        return HS_OK;
    }
    lines->n_words = 0;
    if (lines->at_end) return HS_OK;
    ++lines->number;
    HS_TRY(read_bytes(lines, &has_line, err));
    if (has_line) return split(lines, err);
    lines->at_end = true;
    --lines->number;
    return HS_OK;
}

hs_status hs_lines_next_filled(hs_lines *lines, hs_error *err)
{
    do HS_TRY(hs_lines_next(lines, err));
    while (lines->n_words == 0 && !lines->at_end);
    return HS_OK;
}
