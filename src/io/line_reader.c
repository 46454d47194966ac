#include "io/line_reader.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

hs_status hs_lines_open(hs_lines *lines, const char *path, hs_error *err)
{
    struct stat info;
    memset(lines, 0, sizeof *lines);
    lines->path = path;
    if (stat(path, &info) != 0) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    if (S_ISDIR(info.st_mode)) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: it is a directory", path);
    lines->file = gzopen(path, "rb"); /* reads plain files too */
    if (lines->file == NULL) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    return HS_OK;
}

void hs_lines_close(hs_lines *lines)
{
    if (lines->file != NULL) gzclose(lines->file);
    hs_text_fini(&lines->text);
    memset(lines, 0, sizeof *lines);
}

static hs_status check_stream(const hs_lines *lines, hs_error *err)
{
    int code;
    const char *message = gzerror(lines->file, &code);
    if (code == Z_OK || code == Z_STREAM_END) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "'%s' is damaged or cut short: %s", lines->path,
                   code == Z_ERRNO ? strerror(errno) : message);
}

/** Bytes up to the end of the line into text; *has_line = false at the end of the file. */
static hs_status read_bytes(hs_lines *lines, bool *has_line, hs_error *err)
{
    char piece[4096];
    hs_text_clear(&lines->text);
    *has_line = false;
    while (gzgets(lines->file, piece, sizeof piece) != NULL) {
        *has_line = true;
        const size_t n = strlen(piece);
        if (n > 0) HS_TRY(hs_text_append(&lines->text, piece, n, err));
        if (n > 0 && piece[n - 1] == '\n') return HS_OK;
        if (n + 1 < sizeof piece && !gzeof(lines->file))
            return hs_fail(err, HS_ERROR_INPUT, "the line holds a zero byte: this is no text file");
        if (lines->text.length > HS_LINE_BYTES_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "the line is longer than %d bytes", HS_LINE_BYTES_MAX);
    }
    return check_stream(lines, err);
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
