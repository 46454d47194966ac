#include "deck/lexer.h"

#include <ctype.h>
#include <string.h>

#include "base/memory.h"

static const char blanks[] = " \t\n\v\f\r";

static int count_triple_quotes(const char *text)
{
    int n = 0;
    for (const char *at = strstr(text, "\"\"\""); at != NULL; at = strstr(at + 3, "\"\"\"")) ++n;
    return n;
}

/** Remove blanks at the end of the text, but nothing of its first n_kept bytes. */
static void trim(hs_text *line, size_t n_kept)
{
    while (line->length > n_kept && isspace((unsigned char)line->data[line->length - 1])) --line->length;
    if (line->data != NULL) line->data[line->length] = '\0';
}

hs_status hs_lexer_line(const char *data, size_t size, hs_cursor *cursor, hs_text *line, long *first, bool *found,
                        hs_error *err)
{
    hs_text_clear(line);
    *first = cursor->n_lines_read + 1;
    *found = false;
    size_t n_kept = 0; /* up to the last line break within triple quotes */
    /* Some editors begin each file with a mark of its encoding. */
    if (cursor->at == 0 && size >= 3 && memcmp(data, "\xEF\xBB\xBF", 3) == 0) cursor->at = 3;
    while (cursor->at < size) {
        *found = true;
        const char *begin = data + cursor->at;
        const char *end = memchr(begin, '\n', size - cursor->at);
        size_t n = end != NULL ? (size_t)(end - begin) : size - cursor->at;
        cursor->at += n + (end != NULL);
        ++cursor->n_lines_read;
        if (memchr(begin, '\0', n) != NULL)
            return hs_fail(err, HS_ERROR_INPUT, "line %ld holds a NUL byte: this is not the text of a deck",
                           cursor->n_lines_read);
        HS_TRY(hs_text_append(line, begin, n, err));
        trim(line, n_kept);
        if (line->length > n_kept && line->data[line->length - 1] == '&') {
            line->data[--line->length] = '\0';
            continue;
        }
        if (line->data == NULL || count_triple_quotes(line->data) % 2 == 0) return HS_OK;
        HS_TRY(hs_text_append(line, "\n", 1, err));
        n_kept = line->length;
    }
    if (*found && line->data != NULL && count_triple_quotes(line->data) % 2 != 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the triple quotes (\"\"\") opened here are not closed before the end of the file");
    return HS_OK;
}

size_t hs_lexer_quote(const char *at)
{
    if (*at == '"') return strncmp(at, "\"\"\"", 3) == 0 ? 3 : 1;
    return *at == '\'' ? 1 : 0;
}

const char *hs_lexer_quote_end(const char *text, char mark, size_t n_mark)
{
    return n_mark == 3 ? strstr(text, "\"\"\"") : strchr(text, mark);
}

void hs_lexer_strip_comment(char *line)
{
    for (char *at = line; *at != '\0'; ++at) {
        if (*at == '#') {
            *at = '\0';
            return;
        }
        size_t n_mark = hs_lexer_quote(at);
        if (n_mark == 0) continue;
        const char *end = hs_lexer_quote_end(at + n_mark, *at, n_mark);
        /* An open quotation is refused when the line is split; until then it hides everything after it. */
        if (end == NULL) return;
        at += (size_t)(end - at) + n_mark - 1;
    }
}

/** Signs that look like those of a keyboard and are none: what word processors, web pages and PDF files make of them. A deck
 *  with one outside of quotes is not what its reader sees. */
static hs_status refuse_lookalikes(const char *word, hs_error *err)
{
    static const struct {
        const char *bytes, *what;
    } lookalikes[] = {
        {"\xC2\xA0", "a blank that cannot be broken (U+00A0) is no blank"},
        {"\xE2\x80\xAF", "a narrow blank (U+202F) is no blank"},
        {"\xE2\x80\x89", "a thin blank (U+2009) is no blank"},
        {"\xE2\x80\x8B", "it holds a blank without width (U+200B)"},
        {"\xEF\xBB\xBF", "it holds a mark of byte order (U+FEFF)"},
        {"\xE2\x88\x92", "the sign of minus in print (U+2212) is not the keyboard's -"},
        {"\xE2\x80\x9C", "a quotation mark of print (U+201C) is not the keyboard's \""},
        {"\xE2\x80\x9D", "a quotation mark of print (U+201D) is not the keyboard's \""},
    };
    for (size_t k = 0; k < sizeof lookalikes / sizeof lookalikes[0]; ++k)
        if (strstr(word, lookalikes[k].bytes) != NULL)
            return hs_fail(err, HS_ERROR_INPUT, "'%.60s': %s; type it anew", word, lookalikes[k].what);
    return HS_OK;
}

/** Take the word at *at (not a blank); ends it with a NUL and moves *at behind it. */
static hs_status take_word(char **at, const char **word, bool *was_quoted, hs_error *err)
{
    size_t n_mark = hs_lexer_quote(*at);
    *was_quoted = n_mark > 0;
    if (n_mark == 0) {
        *word = *at;
        *at += strcspn(*at, blanks);
        if (**at != '\0') *(*at)++ = '\0';
        return refuse_lookalikes(*word, err);
    }
    const char *end = hs_lexer_quote_end(*at + n_mark, **at, n_mark);
    if (end == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "the quotation %.40s%s is not closed: a %.*s is missing", *at,
                       strlen(*at) > 40 ? "..." : "", (int)n_mark, *at);
    char *close = *at + (end - *at), *behind = close + n_mark;
    if (*behind != '\0' && strchr(blanks, *behind) == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "'%.20s' follows a closing quotation mark: a blank must stand between them",
                       behind);
    *word = *at + n_mark;
    *at = *behind != '\0' ? behind + 1 : behind;
    *close = '\0';
    return HS_OK;
}

hs_status hs_words_split(hs_words *words, const char *line, hs_error *err)
{
    /* At most every second byte begins a word. */
    size_t n_max = strlen(line) / 2 + 1;
    HS_TRY(hs_memory_strdup(&words->buffer, line, err));
    HS_TRY(HS_ALLOC(words->word, n_max, err));
    HS_TRY(HS_ALLOC(words->was_quoted, n_max, err));
    char *at = words->buffer;
    for (;;) {
        at += strspn(at, blanks);
        if (*at == '\0') return HS_OK;
        HS_TRY(take_word(&at, &words->word[words->n], &words->was_quoted[words->n], err));
        ++words->n;
    }
}

void hs_words_fini(hs_words *words)
{
    HS_FREE(words->buffer);
    HS_FREE(words->word);
    HS_FREE(words->was_quoted);
    words->n = 0;
}
