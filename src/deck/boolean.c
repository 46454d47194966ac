#include "deck/boolean.h"

#include <ctype.h>
#include <string.h>

#include "base/text.h"

enum { DEPTH_MAX = 200 };

/** A number, or a word of the text. */
typedef struct operand {
    bool is_word;
    double number;
    const char *word;
    size_t n_word;
} operand;

typedef struct parser {
    const char *text, *at;
    int depth;
    hs_error *err;
} parser;

typedef enum { OR, XOR, AND, EQUAL, NOT_EQUAL, LESS_EQUAL, GREATER_EQUAL, LESS, GREATER } operator;

static hs_status parse_binary(parser *p, int precedence_min, operand *value);

static void skip_blanks(parser *p)
{
    while (isspace((unsigned char)*p->at)) ++p->at;
}

static hs_status fail_here(const parser *p, const char *what)
{
    if (*p->at == '\0')
        return hs_fail(p->err, HS_ERROR_INPUT, "if: the condition '%.400s': %s, but it ends there", p->text, what);
    return hs_fail(p->err, HS_ERROR_INPUT, "if: the condition '%.400s': %s at '%.40s'", p->text, what, p->at);
}

static hs_status parse_number(parser *p, operand *value)
{
    size_t n = *p->at == '-' ? 1 : 0;
    n += strspn(p->at + n, "0123456789.");
    if (p->at[n] == 'e' || p->at[n] == 'E') {
        const size_t n_sign = p->at[n + 1] == '+' || p->at[n + 1] == '-' ? 1 : 0;
        n += 1 + n_sign + strspn(p->at + n + 1 + n_sign, "0123456789");
    }
    char word[64] = "";
    if (n < sizeof word) memcpy(word, p->at, n);
    if (!hs_text_to_double(word, &value->number)) return fail_here(p, "this is not a finite number:");
    p->at += n;
    return HS_OK;
}

static void take_word(parser *p, operand *value)
{
    value->is_word = true;
    value->word = p->at;
    while (isalnum((unsigned char)*p->at) || (*p->at != '\0' && strchr("_/.-", *p->at) != NULL)) ++p->at;
    value->n_word = (size_t)(p->at - value->word);
}

static hs_status parse_operand(parser *p, operand *value)
{
    hs_status status = HS_OK;
    *value = (operand){0};
    skip_blanks(p);
    if (++p->depth > DEPTH_MAX) return fail_here(p, "more than 200 parentheses or signs within each other");
    const char c = *p->at;
    if (isdigit((unsigned char)c) || c == '.' || c == '-') {
        status = parse_number(p, value);
    } else if (isalpha((unsigned char)c) || c == '_' || c == '/') {
        take_word(p, value);
    } else if (c == '(') {
        ++p->at;
        status = parse_binary(p, 1, value);
        skip_blanks(p);
        if (status == HS_OK && *p->at != ')') status = fail_here(p, "expected an operator or ')'");
        if (status == HS_OK) ++p->at;
    } else if (c == '!') {
        ++p->at;
        status = parse_operand(p, value);
        if (status == HS_OK && value->is_word) status = fail_here(p, "'!' needs a number after it, not a word");
        value->number = value->number == 0.0;
    } else {
        status = fail_here(p, "expected a number, a word or '('");
    }
    --p->depth;
    return status;
}

static int find_operator(const char *at, operator* found, size_t *length)
{
    static const struct {
        const char *sign;
        int precedence;
    } table[] = {
        [OR] = {"||", 1},        [XOR] = {"|^", 1},        [AND] = {"&&", 2},           [EQUAL] = {"==", 3},
        [NOT_EQUAL] = {"!=", 3}, [LESS_EQUAL] = {"<=", 4}, [GREATER_EQUAL] = {">=", 4}, [LESS] = {"<", 4},
        [GREATER] = {">", 4},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i) {
        *length = strlen(table[i].sign);
        if (strncmp(at, table[i].sign, *length) != 0) continue;
        *found = (operator)i;
        return table[i].precedence;
    }
    return 0;
}

static hs_status apply(const parser *p, operator kind, const operand *a, const operand *b, operand *value)
{
    if (a->is_word || b->is_word) {
        if (kind != EQUAL && kind != NOT_EQUAL)
            return hs_fail(p->err, HS_ERROR_INPUT,
                           "if: the condition '%.400s': words can only be compared with == and !=", p->text);
        if (a->is_word != b->is_word)
            return hs_fail(p->err, HS_ERROR_INPUT,
                           "if: the condition '%.400s': the word '%.*s' is compared with a number", p->text,
                           (int)(a->is_word ? a->n_word : b->n_word), a->is_word ? a->word : b->word);
        const bool same = a->n_word == b->n_word && memcmp(a->word, b->word, a->n_word) == 0;
        *value = (operand){.number = same == (kind == EQUAL)};
        return HS_OK;
    }
    const double x = a->number, y = b->number;
    bool holds = false;
    switch (kind) {
    case OR:
        holds = x != 0.0 || y != 0.0;
        break;
    case XOR:
        holds = (x != 0.0) != (y != 0.0);
        break;
    case AND:
        holds = x != 0.0 && y != 0.0;
        break;
    case EQUAL:
        holds = x == y;
        break;
    case NOT_EQUAL:
        holds = x != y;
        break;
    case LESS_EQUAL:
        holds = x <= y;
        break;
    case GREATER_EQUAL:
        holds = x >= y;
        break;
    case LESS:
        holds = x < y;
        break;
    case GREATER:
        holds = x > y;
        break;
    }
    *value = (operand){.number = holds};
    return HS_OK;
}

static hs_status parse_binary(parser *p, int precedence_min, operand *value)
{
    HS_TRY(parse_operand(p, value));
    for (;;) {
        skip_blanks(p);
        operator kind;
        size_t length;
        const int precedence = find_operator(p->at, &kind, &length);
        if (precedence == 0 || precedence < precedence_min) return HS_OK;
        p->at += length;
        operand right, left = *value;
        HS_TRY(parse_binary(p, precedence + 1, &right));
        HS_TRY(apply(p, kind, &left, &right, value));
    }
}

hs_status hs_boolean_eval(const char *text, bool *holds, hs_error *err)
{
    parser p = {.text = text, .at = text, .err = err};
    operand value;
    *holds = false;
    HS_TRY(parse_binary(&p, 1, &value));
    if (*p.at != '\0') return fail_here(&p, "expected an operator (== != < <= > >= && || |^); arithmetic needs $(...)");
    if (value.is_word)
        return hs_fail(err, HS_ERROR_INPUT, "if: the condition '%.400s' is a word: compare it with == or !=", text);
    *holds = value.number != 0.0;
    return HS_OK;
}
