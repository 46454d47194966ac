#include "style/args.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

hs_args hs_args_from(const hs_args *args, int first, const char *command)
{
    if (first > args->n) first = args->n;
    return (hs_args){
        .command = command != NULL ? command : args->command, .n = args->n - first, .word = args->word + first};
}

static const char output_file[] = "<output-file>";

static bool has_variable(const char *word) { return strchr(word, '$') != NULL; }

static const hs_keyword *find_keyword(const hs_syntax *syntax, const char *word)
{
    if (syntax->keywords == NULL) return NULL;
    for (const hs_keyword *keyword = syntax->keywords; keyword->name != NULL; ++keyword) {
        const size_t n = strcspn(keyword->name, "<");
        const bool is_open = keyword->name[n] == '<';
        if (is_open ? strncmp(keyword->name, word, n) == 0 && word[n] != '\0' : strcmp(keyword->name, word) == 0)
            return keyword;
    }
    return NULL;
}

int hs_syntax_first_keyword(const hs_syntax *syntax, const hs_args *args)
{
    if (syntax->keywords == NULL) return args->n;
    int i = syntax->n_max >= 0 ? syntax->n_max : syntax->n_min;
    if (syntax->n_max > syntax->n_min || syntax->n_max < 0)
        for (i = syntax->n_min; i < args->n && (syntax->n_max < 0 || i < syntax->n_max); ++i)
            if (find_keyword(syntax, args->word[i]) != NULL) break;
    return i < args->n ? i : args->n;
}

/** Whether a word, number i of a usage, is an <output-file>, and not one of the words that may stand in its place
 *  (`<output-file>|none`). */
static bool is_output(const char *usage, int i, const char *word)
{
    for (; i > 0 && *usage != '\0'; --i) {
        usage += strcspn(usage, " ");
        usage += strspn(usage, " ");
    }
    const char *const end = usage + strcspn(usage, " ");
    const char *at = strstr(usage, output_file);
    if (at == NULL || at > end) return false;
    for (at += strlen(output_file); *at == '|'; at += strcspn(at, "| ")) {
        ++at;
        if (strlen(word) == strcspn(at, "| ") && strncmp(at, word, strlen(word)) == 0) return false;
    }
    return true;
}

int hs_syntax_next_output(const hs_syntax *syntax, const hs_args *args, int from)
{
    const int n_positional = hs_syntax_first_keyword(syntax, args);
    for (int i = from; i < args->n; ++i) {
        const hs_keyword *keyword = i > n_positional ? find_keyword(syntax, args->word[i - 1]) : NULL;
        if (i < n_positional ? is_output(syntax->usage, i, args->word[i])
                             : keyword != NULL && keyword->values != NULL && strcmp(keyword->values, output_file) == 0)
            return i;
    }
    return args->n;
}

static hs_status refuse_keyword(const hs_syntax *syntax, const hs_args *args, int i, hs_error *err)
{
    const char *names[64] = {NULL};
    size_t n = 0;
    for (const hs_keyword *keyword = syntax->keywords; keyword != NULL && keyword->name != NULL && n < 64; ++keyword)
        names[n++] = keyword->name;
    const char *nearest = hs_text_nearest(args->word[i], names, n);
    if (n == 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: unexpected word '%s'; expected: %s%s%s", args->command, args->word[i],
                       args->command, syntax->usage[0] != '\0' ? " " : "", syntax->usage);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: unknown keyword '%s'; did you mean '%s'?", args->command,
                       args->word[i], nearest);
    return hs_fail(err, HS_ERROR_INPUT, "%s: unknown keyword '%s'; expected: %s %s", args->command, args->word[i],
                   args->command, syntax->usage);
}

/** Whether word is one of the words of "yes|no"; lists with a "<" name values for people and allow anything. */
static bool is_listed(const char *list, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = list; at != NULL; at = strchr(at, '|'), at = at != NULL ? at + 1 : NULL)
        if (strncmp(at, word, n) == 0 && (at[n] == '|' || at[n] == '\0')) return true;
    return false;
}

static hs_status check_keyword(const hs_syntax *syntax, const hs_args *args, int *i, hs_error *err)
{
    const hs_keyword *keyword = find_keyword(syntax, args->word[*i]);
    if (keyword == NULL) return refuse_keyword(syntax, args, *i, err);
    if (keyword->n_values < 0 && *i + 1 < args->n) {
        for (*i += 2; *i < args->n && find_keyword(syntax, args->word[*i]) == NULL;) ++*i;
        return HS_OK;
    }
    if (keyword->n_values < 0 || *i + keyword->n_values >= args->n)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the keyword '%s' needs %s after it: %s", args->command, keyword->name,
                       keyword->n_values == 1 ? "a word" : "more words", keyword->values);
    const char *value = keyword->n_values == 1 ? args->word[*i + 1] : NULL;
    if (value != NULL && strchr(keyword->values, '<') == NULL && !has_variable(value) &&
        !is_listed(keyword->values, value))
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' after '%s' must be %s", args->command, value, keyword->name,
                       keyword->values);
    *i += keyword->n_values + 1;
    return HS_OK;
}

hs_status hs_syntax_check(const hs_syntax *syntax, const hs_args *args, bool has_variables, hs_error *err)
{
    /* A variable may expand to any number of words, so nothing after the first one has a certain place. */
    if (has_variables)
        for (int i = 0; i < args->n; ++i)
            if (has_variable(args->word[i])) return HS_OK;
    if (args->n < syntax->n_min)
        return hs_fail(err, HS_ERROR_INPUT, "%s: too few words (%d); expected: %s %s", args->command, args->n,
                       args->command, syntax->usage);
    int i = syntax->keywords != NULL ? hs_syntax_first_keyword(syntax, args)
            : syntax->n_max < 0      ? args->n
                                     : syntax->n_max;
    if (i > args->n) i = args->n;
    while (i < args->n)
        if (syntax->keywords == NULL)
            return refuse_keyword(syntax, args, i, err);
        else
            HS_TRY(check_keyword(syntax, args, &i, err));
    return HS_OK;
}

hs_status hs_arg_need(const hs_args *args, int i, const char *what, hs_error *err)
{
    if (i < args->n) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s is missing", args->command, what);
}

hs_status hs_name_check(const char *command, const char *what, const char *name, hs_error *err)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    const size_t n = strlen(name);
    if (n == 0 || strspn(name, letters) != n)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the %s '%.80s' may have only letters, digits and underscores", command,
                       what, name);
    if (n <= HS_NAME_MAX) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the %s '%.40s...' has %zu letters; %d are allowed", command, what, name, n,
                   HS_NAME_MAX);
}

hs_status hs_arg_refuse(const hs_args *args, int i, const char *expected, const char *const *choices, hs_error *err)
{
    size_t n = 0;
    while (choices != NULL && choices[n] != NULL) ++n;
    const char *nearest = hs_text_nearest(args->word[i], choices, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not %s; did you mean '%s'?", args->command, args->word[i],
                       expected, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not %s", args->command, args->word[i], expected);
}

hs_status hs_arg_double(const hs_args *args, int i, double *value, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "a number", err));
    if (!hs_text_to_double(args->word[i], value)) return hs_arg_refuse(args, i, "a finite number", NULL, err);
    return HS_OK;
}

hs_status hs_arg_positive(const hs_args *args, int i, double *value, hs_error *err)
{
    HS_TRY(hs_arg_double(args, i, value, err));
    return *value > 0.0 ? HS_OK : hs_arg_refuse(args, i, "a number greater than 0", NULL, err);
}

hs_status hs_arg_not_negative(const hs_args *args, int i, double *value, hs_error *err)
{
    HS_TRY(hs_arg_double(args, i, value, err));
    return *value >= 0.0 ? HS_OK : hs_arg_refuse(args, i, "a number of 0 or more", NULL, err);
}

hs_status hs_arg_int(const hs_args *args, int i, int64_t min, int64_t max, int64_t *value, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "a whole number", err));
    char expected[96];
    if (max == INT64_MAX)
        snprintf(expected, sizeof expected, "a whole number of %lld or more", (long long)min);
    else
        snprintf(expected, sizeof expected, "a whole number from %lld to %lld", (long long)min, (long long)max);
    if (!hs_text_to_int64(args->word[i], value) || *value < min || *value > max)
        return hs_arg_refuse(args, i, expected, NULL, err);
    return HS_OK;
}

hs_status hs_arg_bool(const hs_args *args, int i, bool *value, hs_error *err)
{
    static const char *const words[] = {"yes", "no", "on", "off", "true", "false", NULL};
    HS_TRY(hs_arg_need(args, i, "yes or no", err));
    for (int k = 0; words[k] != NULL; ++k)
        if (strcmp(args->word[i], words[k]) == 0) {
            *value = k % 2 == 0;
            return HS_OK;
        }
    return hs_arg_refuse(args, i, "yes or no", words, err);
}

hs_status hs_arg_choice(const hs_args *args, int i, const char *const *choices, int *choice, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, choices[0], err));
    for (*choice = 0; choices[*choice] != NULL; ++*choice)
        if (strcmp(args->word[i], choices[*choice]) == 0) return HS_OK;
    hs_text expected = {0};
    hs_status status = hs_text_printf(&expected, err, "one of");
    for (int k = 0; choices[k] != NULL && status == HS_OK; ++k)
        status = hs_text_printf(&expected, err, "%s %s", k > 0 ? "," : "", choices[k]);
    if (status == HS_OK) status = hs_arg_refuse(args, i, hs_text_get(&expected), choices, err);
    hs_text_fini(&expected);
    return status;
}

hs_status hs_arg_type(const hs_args *args, int i, int n_types, int64_t *type, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "an atom type", err));
    if (!hs_text_to_int64(args->word[i], type)) return hs_arg_refuse(args, i, "an atom type", NULL, err);
    if (*type >= 1 && *type <= n_types) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no atom type %s; the box was made with %d", args->command,
                   args->word[i], n_types);
}

hs_status hs_arg_range(const hs_args *args, int i, int n_types, int *lo, int *hi, hs_error *err)
{
    HS_TRY(hs_arg_need(args, i, "an atom type", err));
    char first[32] = "", last[32] = "";
    const char *word = args->word[i], *star = strchr(word, '*');
    size_t n_first = star != NULL ? (size_t)(star - word) : strlen(word);
    bool is_well_formed = n_first < sizeof first && (star == NULL || strlen(star + 1) < sizeof last);
    if (is_well_formed) {
        memcpy(first, word, n_first);
        strcpy(last, star != NULL ? star + 1 : first);
    }
    int64_t from = 1, to = n_types;
    is_well_formed = is_well_formed && (first[0] != '\0' || star != NULL) &&
                     (first[0] == '\0' || hs_text_to_int64(first, &from)) &&
                     (last[0] == '\0' || hs_text_to_int64(last, &to));
    if (!is_well_formed) return hs_arg_refuse(args, i, "an atom type or range of types (n, *, n*, *n, m*n)", NULL, err);
    if (from < 1 || to > n_types || from > to)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the type range '%s' is not within the %d atom types of this system",
                       args->command, word, n_types);
    *lo = (int)from;
    *hi = (int)to;
    return HS_OK;
}
