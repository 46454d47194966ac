#include "base/text.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

hs_status hs_text_reserve(hs_text *text, size_t n_more, hs_error *err)
{
    size_t needed = text->length + n_more + 1;
    if (needed <= text->capacity) return HS_OK;
    size_t capacity = needed < 64 ? 64 : needed * 2;
    HS_TRY(HS_GROW(text->data, text->length, capacity, err));
    text->capacity = capacity;
    return HS_OK;
}

hs_status hs_text_append(hs_text *text, const char *bytes, size_t n, hs_error *err)
{
    HS_TRY(hs_text_reserve(text, n, err));
    memcpy(text->data + text->length, bytes, n);
    text->length += n;
    text->data[text->length] = '\0';
    return HS_OK;
}

hs_status hs_text_printf(hs_text *text, hs_error *err, const char *fmt, ...)
{
    enum { USUAL = 64 };
    va_list args, again;
    HS_TRY(hs_text_reserve(text, USUAL, err));
    va_start(args, fmt);
    va_copy(again, args);
    const size_t room = text->capacity - text->length;
    const int n = vsnprintf(text->data + text->length, room, fmt, args);
    va_end(args);
    hs_status status = HS_OK;
    if (n < 0) {
        text->data[text->length] = '\0';
        status = hs_fail(err, HS_ERROR_RUN, "text could not be formatted with '%s'", fmt);
    } else if ((size_t)n >= room) {
        status = hs_text_reserve(text, (size_t)n, err);
        if (status == HS_OK)
            vsnprintf(text->data + text->length, (size_t)n + 1, fmt, again);
        else
            text->data[text->length] = '\0';
    }
    if (status == HS_OK) text->length += (size_t)n;
    va_end(again);
    return status;
}

void hs_text_clear(hs_text *text)
{
    text->length = 0;
    if (text->data != NULL) text->data[0] = '\0';
}

void hs_text_fini(hs_text *text)
{
    HS_FREE(text->data);
    text->length = text->capacity = 0;
}

const char *hs_text_get(const hs_text *text) { return text->data != NULL ? text->data : ""; }

bool hs_text_to_double(const char *word, double *value)
{
    /* strtod also takes "nan", "inf" and hexadecimal: only digits, signs, a point and an exponent are let through. */
    if (word[0] == '\0' || strspn(word, "+-.0123456789eE") != strlen(word)) return false;
    char *end;
    errno = 0;
    *value = strtod(word, &end);
    if (end == word || *end != '\0') return false;
    return isfinite(*value);
}

bool hs_text_to_int64(const char *word, int64_t *value)
{
    if (word[0] == '\0' || isspace((unsigned char)word[0])) return false;
    char *end;
    errno = 0;
    long long number = strtoll(word, &end, 10);
    if (end == word || *end != '\0' || errno == ERANGE) return false;
    *value = number;
    return true;
}

static int smaller(int a, int b) { return a < b ? a : b; }

/** Edit distance of two words, at most @p limit: letters replaced, inserted, deleted, or two neighbors swapped. Words
 *  longer than 63 bytes count as far away. */
static int edit_distance(const char *a, const char *b, int limit)
{
    enum { MAX = 64 };
    size_t n_a = strlen(a), n_b = strlen(b);
    if (n_a >= MAX || n_b >= MAX) return limit;
    int rows[3][MAX]; /* of the last two letters of a, and of the present one */
    for (size_t j = 0; j <= n_b; ++j) rows[0][j] = (int)j;
    for (size_t i = 1; i <= n_a; ++i) {
        int *row = rows[i % 3];
        const int *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = (int)i;
        for (size_t j = 1; j <= n_b; ++j) {
            const int letter_a = tolower((unsigned char)a[i - 1]), letter_b = tolower((unsigned char)b[j - 1]);
            row[j] = smaller(above[j - 1] + (letter_a != letter_b), smaller(row[j - 1], above[j]) + 1);
            if (i > 1 && j > 1 && letter_a == tolower((unsigned char)b[j - 2]) &&
                letter_b == tolower((unsigned char)a[i - 2]))
                row[j] = smaller(row[j], two_above[j - 2] + 1);
        }
    }
    return smaller(rows[n_a % 3][n_b], limit);
}

const char *hs_text_nearest(const char *word, const char *const *words, size_t n)
{
    const int n_letters = (int)strlen(word), limit = n_letters > 3 ? n_letters / 3 + 2 : 2;
    int best = limit;
    const char *nearest = NULL;
    for (size_t i = 0; i < n; ++i) {
        const int distance = edit_distance(word, words[i], limit);
        const bool is_likelier = nearest != NULL && nearest[0] != word[0] && words[i][0] == word[0];
        if (distance < best || (distance == best && is_likelier)) best = distance, nearest = words[i];
    }
    size_t longest = 0; /* of variants, such as nvt/uef, the style they vary */
    for (size_t i = 0; i < n && best == limit; ++i) {
        const size_t length = strlen(words[i]);
        if (length > longest && strncmp(word, words[i], length) == 0 && word[length] == '/')
            longest = length, nearest = words[i];
    }
    return nearest;
}

bool hs_text_is_style(const char *word, const char *name)
{
    static const char *const suffixes[] = {"", "/omp", "/opt", "/intel", "/gpu", "/kk", "/kk/device", "/kk/host"};
    const size_t n = strlen(name);
    if (strncmp(word, name, n) != 0) return false;
    for (size_t k = 0; k < sizeof suffixes / sizeof suffixes[0]; ++k)
        if (strcmp(word + n, suffixes[k]) == 0) return true;
    return false;
}

bool hs_text_glob(const char *pattern, const char *word)
{
    for (; *pattern != '\0'; ++pattern, ++word) {
        if (*pattern == '*') {
            do {
                if (hs_text_glob(pattern + 1, word)) return true;
            } while (*word++ != '\0');
            return false;
        }
        if (*word == '\0' || (*pattern != '?' && *pattern != *word)) return false;
    }
    return *word == '\0';
}
