/* Words of the deck that stand for values, c_ID[2*4] and the like. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "style/value.h"

static const char id_letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

bool hs_value_is_reference(const char *word)
{
    if (word[0] == '\0' || strchr("cfvid", word[0]) == NULL || word[1] != '_') return false;
    const size_t n_id = strspn(word + 2, id_letters);
    const char *rest = word + 2 + n_id;
    if (n_id == 0) return false;
    const int n_max = word[0] == 'v' ? 1 : strchr("cf", word[0]) != NULL ? 2 : 0;
    for (int k = 0; k < n_max && *rest == '['; ++k) {
        const size_t n_index = strspn(rest + 1, word[0] == 'v' ? "0123456789" : "0123456789*");
        if (n_index == 0 || rest[1 + n_index] != ']') return false;
        rest += n_index + 2;
    }
    return *rest == '\0';
}

/** One reference without a range from its text. */
static hs_status parse(hs_value *value, const hs_args *args, const char *word, hs_error *err)
{
    const size_t n_id = strspn(word + 2, id_letters);
    value->kind = word[0];
    HS_TRY(hs_memory_strdup(&value->word, word, err));
    HS_TRY(hs_memory_strdup(&value->id, word + 2, err));
    value->id[n_id] = '\0';
    for (const char *at = word + 2 + n_id; *at == '[';) {
        char number[24] = "";
        const size_t n = strspn(at + 1, "0123456789");
        int64_t index = 0;
        if (n < sizeof number) memcpy(number, at + 1, n);
        if (!hs_text_to_int64(number, &index) || index < 1)
            return hs_fail(err, HS_ERROR_INPUT, "%s: '%s': indices count from 1", args->command, word);
        value->index[value->n_indices++] = index;
        at += n + 2;
    }
    return HS_OK;
}

static hs_status add(hs_value **values, int *n, const hs_args *args, const char *word, hs_error *err)
{
    HS_TRY(HS_GROW(*values, (size_t)*n, (size_t)*n + 1, err));
    return parse(&(*values)[(*n)++], args, word, err);
}

/** The words that c_ID[2*4] (or c_ID[2*4][3]) stands for. */
static hs_status add_range(hs_value **values, int *n, hs_env *env, const hs_args *args, const char *word,
                           hs_value_shape shape, hs_error *err)
{
    const char *open = strchr(word, '['), *close = strchr(word, ']');
    if (strchr(close, '*') != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s': only the first index may be a range", args->command, word);
    hs_value whole = {.n_indices = strchr(close, '[') != NULL ? 2 : 1};
    hs_text text = {0};
    char *range = NULL;
    int lo = 0, hi = -1;
    whole.kind = word[0];
    HS_TRY(hs_memory_strdup(&whole.id, word + 2, err));
    whole.id[open - word - 2] = '\0';
    hs_status status = hs_memory_strdup(&range, open + 1, err);
    if (status == HS_OK) {
        range[close - open - 1] = '\0';
        const int limit = hs_value_limit(env, &whole, shape, 0);
        const char *range_word = range;
        const hs_args one = {.command = args->command, .n = 1, .word = &range_word};
        if (!hs_value_exists(env, &whole))
            status = hs_fail(err, HS_ERROR_INPUT, "%s: %s needs the %s '%s' to exist already", args->command, word,
                             whole.kind == 'c' ? "compute" : "fix", whole.id);
        else if (limit == 0) {
            whole.word = range;
            status = hs_fail(err, HS_ERROR_INPUT, "%s: %s: '%s' has nothing that the range could count", args->command,
                             word, whole.id);
        } else if (hs_arg_range(&one, 0, limit, &lo, &hi, err) != HS_OK) {
            hs_error_clear(err);
            status = hs_fail(err, HS_ERROR_INPUT, "%s: %s: the elements are 1 to %d", args->command, word, limit);
        }
    }
    for (int i = lo; i <= hi && status == HS_OK; ++i) {
        hs_text_clear(&text);
        status = hs_text_printf(&text, err, "%.*s[%d%s", (int)(open - word), word, i, close);
        if (status == HS_OK) status = add(values, n, args, hs_text_get(&text), err);
    }
    HS_FREE(whole.id);
    HS_FREE(range);
    hs_text_fini(&text);
    return status;
}

hs_status hs_values_read(hs_value **values, int *n, hs_env *env, const hs_args *args, int first, int n_words,
                         hs_value_shape shape, hs_error *err)
{
    *values = NULL;
    *n = 0;
    hs_status status = HS_OK;
    for (int i = first; i < first + n_words && status == HS_OK; ++i) {
        const char *word = args->word[i];
        if (!hs_value_is_reference(word))
            status = hs_arg_refuse(args, i, "a value: c_ID, c_ID[i], f_ID, f_ID[i], v_name or v_name[i]", NULL, err);
        else
            status = strchr(word, '*') != NULL ? add_range(values, n, env, args, word, shape, err)
                                               : add(values, n, args, word, err);
    }
    if (status != HS_OK) hs_values_destroy(values, *n);
    return status;
}

hs_status hs_values_create(hs_value **values, int *n, hs_env *env, const hs_args *args, int first, int n_words,
                           hs_value_shape shape, hs_error *err)
{
    HS_TRY(hs_values_read(values, n, env, args, first, n_words, shape, err));
    const hs_status status = hs_values_check(env, *values, *n, shape, args->command, err);
    if (status != HS_OK) hs_values_destroy(values, *n);
    return status;
}

hs_status hs_value_init(hs_value *value, hs_env *env, const hs_args *args, int i, hs_value_shape shape, hs_error *err)
{
    hs_value *one;
    int n;
    HS_TRY(hs_values_create(&one, &n, env, args, i, 1, shape, err));
    if (n != 1) {
        hs_values_destroy(&one, n);
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' stands for %d values, and one is needed", args->command,
                       args->word[i], n);
    }
    *value = one[0];
    HS_FREE(one);
    return HS_OK;
}
