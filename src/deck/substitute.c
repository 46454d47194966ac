#include "deck/substitute.h"

#include <ctype.h>
#include <string.h>

#include "base/memory.h"
#include "deck/lexer.h"
#include "deck/variables.h"

/** Longest line that replacing may make: variables that double one another would else fill the memory. */
enum {
    LENGTH_MAX = 1 << 20,
    SHOWN_MAX = 200 /**< replacements of one line that are echoed one by one */
};

const char *hs_dollar_find(const char *at)
{
    for (; *at != '\0'; ++at) {
        if (*at == '$') return at;
        size_t n_mark = hs_lexer_quote(at);
        if (n_mark == 0) continue;
        const char *end = hs_lexer_quote_end(at + n_mark, *at, n_mark);
        if (end == NULL) return NULL;
        at = end + n_mark - 1;
    }
    return NULL;
}

/** Length of the text up to the parenthesis that closes the one before it; -1 when there is none. */
static long find_close(const char *text)
{
    int depth = 1;
    for (const char *at = text; *at != '\0'; ++at) {
        if (*at == '(') ++depth;
        if (*at == ')' && --depth == 0) return at - text;
    }
    return -1;
}

hs_status hs_dollar_read(const char *at, hs_dollar *dollar, hs_error *err)
{
    *dollar = (hs_dollar){.kind = HS_DOLLAR_NAME, .length = 2, .inside = at + 1, .n_inside = 1};
    if (at[1] == '{') {
        const char *close = strchr(at, '}');
        if (close == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "'%.40s': the '}' that ends the variable's name is missing", at);
        dollar->inside = at + 2;
        dollar->n_inside = (size_t)(close - at - 2);
        dollar->length = dollar->n_inside + 3;
    } else if (at[1] == '(') {
        long n = find_close(at + 2);
        if (n < 0) return hs_fail(err, HS_ERROR_INPUT, "'%.40s': the ')' that ends the formula is missing", at);
        dollar->kind = HS_DOLLAR_FORMULA;
        dollar->inside = at + 2;
        dollar->n_inside = (size_t)n;
        dollar->length = dollar->n_inside + 3;
    } else if (!isalnum((unsigned char)at[1]) && at[1] != '_') {
        return hs_fail(err, HS_ERROR_INPUT, "'%.20s': after '$' a variable must follow: $x, ${name} or $(formula)", at);
    }
    if (memchr(dollar->inside, '$', dollar->n_inside) == NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "'%.*s': there cannot be a '$' within another; within $(...) write v_name",
                   (int)(dollar->length < 80 ? dollar->length : 80), at);
}

static hs_status copy_part(char **copy, const char *text, size_t n, hs_error *err)
{
    HS_TRY(HS_ALLOC(*copy, n + 1, err));
    memcpy(*copy, text, n);
    return HS_OK;
}

hs_status hs_dollar_formula(const hs_dollar *dollar, char **formula, char **format, hs_error *err)
{
    *format = NULL;
    HS_TRY(copy_part(formula, dollar->inside, dollar->n_inside, err));
    char *colon = strrchr(*formula, ':');
    const bool has_format = colon != NULL && colon[1] == '%';
    if (has_format) *colon = '\0';
    hs_status status = hs_memory_strdup(format, has_format ? colon + 1 : "%.20g", err);
    if (status == HS_OK && !hs_format_is_for_double(*format))
        status = hs_fail(err, HS_ERROR_INPUT,
                         "$(%s:%s): the format must hold one conversion for a number, such as %%10.4f, %%.3e "
                         "or %%.0f",
                         *formula, *format);
    if (status != HS_OK) {
        HS_FREE(*formula);
        HS_FREE(*format);
    }
    return status;
}

/** Append the value of one `$` expression. */
static hs_status append_value(hs_deck *deck, const hs_dollar *dollar, hs_text *out, hs_error *err)
{
    char *name = NULL, *format = NULL;
    if (dollar->kind == HS_DOLLAR_NAME) {
        hs_text value = {0};
        HS_TRY(copy_part(&name, dollar->inside, dollar->n_inside, err));
        hs_status status = hs_variables_text(deck, name, &value, err);
        if (status == HS_OK) status = hs_text_append(out, hs_text_get(&value), value.length, err);
        hs_text_fini(&value);
        HS_FREE(name);
        return status;
    }
    double value;
    HS_TRY(hs_dollar_formula(dollar, &name, &format, err));
    hs_status status = hs_formula_once(deck, name, &value, err);
    if (status == HS_OK) status = hs_text_printf(out, err, format, value);
    HS_FREE(name);
    HS_FREE(format);
    return status;
}

static void show(hs_deck *deck, const char *head, const char *rest)
{
    if (deck->echo_screen) hs_say_screen(deck->out, "%s%s\n", head, rest);
    if (deck->echo_log) hs_say_log(deck->out, "%s%s\n", head, rest);
}

hs_status hs_substitute(hs_deck *deck, hs_text *line, bool echo, hs_error *err)
{
    const char *at = hs_text_get(line), *dollar_at;
    if (hs_dollar_find(at) == NULL) return HS_OK;
    hs_text out = {0};
    hs_status status = HS_OK;
    int n_done = 0;
    /* Quotes are those of the line as it was read: a quotation mark within a value opens nothing. */
    while (status == HS_OK && (dollar_at = hs_dollar_find(at)) != NULL) {
        hs_dollar dollar;
        status = hs_text_append(&out, at, (size_t)(dollar_at - at), err);
        if (status == HS_OK) status = hs_dollar_read(dollar_at, &dollar, err);
        if (status == HS_OK) status = append_value(deck, &dollar, &out, err);
        if (status == HS_OK && out.length > LENGTH_MAX)
            status = hs_fail(err, HS_ERROR_INPUT, "with its variables replaced the line is longer than 1 MiB");
        if (status != HS_OK) break;
        at = dollar_at + dollar.length;
        if (echo && (++n_done < SHOWN_MAX || hs_dollar_find(at) == NULL)) show(deck, hs_text_get(&out), at);
    }
    if (status == HS_OK) status = hs_text_append(&out, at, strlen(at), err);
    hs_text_fini(line);
    *line = out;
    return status;
}
