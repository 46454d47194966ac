#include "io/user_format.h"

#include <ctype.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"

static const char *const kind_name[] = {"a whole number (%d)", "a floating-point number (%g, %f or %e)", "text (%s)"};
static const char *const kind_letters[] = {"di", "eEfFgGaA", "s"};

/** At most two digits of a width or precision; false when there are more. */
static bool skip_digits(const char **at)
{
    int n = 0;
    for (; isdigit((unsigned char)**at); ++*at) ++n;
    return n <= 2;
}

/** The conversion that begins at the % of @p at: its parts up to the length modifiers end at *flags_end, its letter
 *  is at *letter. False when it is malformed. */
static bool parse_conversion(const char *at, const char **flags_end, const char **letter)
{
    for (++at; *at != '\0' && strchr("-+ #0", *at) != NULL;) ++at;
    bool is_good = skip_digits(&at);
    if (*at == '.') {
        ++at;
        is_good = skip_digits(&at) && is_good;
    }
    *flags_end = at;
    while (*at == 'l' || *at == 'h') ++at;
    *letter = at;
    return is_good && isalpha((unsigned char)*at);
}

static hs_status append_conversion(hs_text *text, const char **at, hs_format_kind kind, const char *format,
                                   const char *what, hs_error *err)
{
    const char *flags_end, *letter;
    if (!parse_conversion(*at, &flags_end, &letter))
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: '%s' is not a format like %%8d or %%12.6g (width and precision may have two "
                       "digits)",
                       what, format);
    if (strchr(kind_letters[kind], *letter) == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is the wrong kind of format here; it must be one for %s", what,
                       format, kind_name[kind]);
    HS_TRY(hs_text_append(text, *at, (size_t)(flags_end - *at), err));
    if (kind == HS_FORMAT_INT) HS_TRY(hs_text_append(text, "ll", 2, err));
    *at = letter + 1;
    return hs_text_append(text, letter, 1, err);
}

static hs_status normalize(hs_text *text, const char *format, hs_format_kind kind, const char *what, hs_error *err)
{
    int n_conversions = 0;
    for (const char *at = format; *at != '\0';) {
        if (*at != '%' || at[1] == '%') {
            const size_t n = *at == '%' ? 2 : 1;
            if (iscntrl((unsigned char)*at) && *at != '\t')
                return hs_fail(err, HS_ERROR_INPUT, "%s: the format holds a control character", what);
            HS_TRY(hs_text_append(text, at, n, err));
            at += n;
            continue;
        }
        ++n_conversions;
        HS_TRY(append_conversion(text, &at, kind, format, what, err));
    }
    if (n_conversions != 1)
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must have one conversion for %s; it has %d", what, format,
                       kind_name[kind], n_conversions);
    return HS_OK;
}

hs_status hs_format_normalize(char **out, const char *format, hs_format_kind kind, const char *what, hs_error *err)
{
    hs_text text = {0};
    *out = NULL;
    hs_status status = normalize(&text, format, kind, what, err);
    if (status == HS_OK) status = hs_memory_strdup(out, hs_text_get(&text), err);
    hs_text_fini(&text);
    return status;
}

char hs_format_class(const char *format)
{
    for (const char *at = format; (at = strchr(at, '%')) != NULL;) {
        if (at[1] == '%') {
            at += 2;
            continue;
        }
        const char *flags_end, *letter;
        if (!parse_conversion(at, &flags_end, &letter)) return 0;
        for (int kind = HS_FORMAT_INT; kind <= HS_FORMAT_STRING; ++kind)
            if (strchr(kind_letters[kind], *letter) != NULL) return "dfs"[kind];
        return 0;
    }
    return 0;
}
