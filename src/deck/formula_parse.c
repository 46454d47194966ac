/** From a formula's text to its nodes. */
#include <ctype.h>
#include <string.h>

#include "base/memory.h"
#include "deck/formula_nodes.h"
#include "sim/thermo.h"

/** Parentheses and signs within each other; deeper ones would only be an attack on the stack. */
enum { DEPTH_MAX = 200 };

typedef struct parser {
    hs_formula *formula;
    const char *at;
    hs_value_shape shape;
    int depth;
    hs_error *err;
} parser;

const char *const hs_formula_attributes[] = {"id", "mass", "type", "x",  "y",  "z", "vx",
                                             "vy", "vz",   "fx",   "fy", "fz", NULL};

/** Names of LAMMPS's functions that are refused, each followed by why; ended by NULL. */
static const char *const refused_functions[] = {
    "charge",
    "Halfshell's atoms carry no charge",
    "is_active",
    "it asks for settings of LAMMPS's own parts; is_defined(category,ID) and is_available(category,name) are supported",
    "extract_setting",
    "it asks for LAMMPS's internal settings",
    "label2type",
    "there are no type labels",
    NULL,
};

static const struct {
    const char *name;
    double value;
} constants[] = {
    {"PI", 3.14159265358979323846},
    {"version", 20210929.0},
    {"yes", 1.0},
    {"no", 0.0},
    {"true", 1.0},
    {"false", 0.0},
    {"on", 1.0},
    {"off", 0.0},
};

static hs_status parse_binary(parser *p, int precedence_min, int *node);

static void skip_blanks(parser *p)
{
    while (isspace((unsigned char)*p->at)) ++p->at;
}

/** Fail at the present place: "formula 'TEXT': WHAT at 'REST'". */
static hs_status fail_here(const parser *p, const char *what)
{
    if (*p->at == '\0')
        return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': %s, but the formula ends there", p->formula->text,
                       what);
    return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': %s at '%.40s'", p->formula->text, what, p->at);
}

static hs_status add_node(parser *p, const hs_node *node, int *index)
{
    hs_formula *formula = p->formula;
    HS_TRY(HS_EXTEND(formula->node, formula->n_nodes, formula->capacity, p->err));
    *index = formula->n_nodes++;
    formula->node[*index] = *node;
    return HS_OK;
}

/** A copy of the identifier (letters, digits, _) at the present place, which is passed. The caller frees it. */
static hs_status take_name(parser *p, char **name)
{
    size_t n = 0;
    while (isalnum((unsigned char)p->at[n]) || p->at[n] == '_') ++n;
    HS_TRY(HS_ALLOC(*name, n + 1, p->err));
    memcpy(*name, p->at, n);
    p->at += n;
    return HS_OK;
}

static hs_status parse_number(parser *p, int *node)
{
    const char *begin = p->at;
    size_t n = strspn(begin, "0123456789.");
    if (begin[n] == 'e' || begin[n] == 'E') {
        size_t n_sign = begin[n + 1] == '+' || begin[n + 1] == '-' ? 1 : 0;
        size_t n_digits = strspn(begin + n + 1 + n_sign, "0123456789");
        n += 1 + n_sign + n_digits;
    }
    char word[64] = "";
    hs_node number = {.kind = HS_NODE_NUMBER};
    if (n < sizeof word) memcpy(word, begin, n);
    if (!hs_text_to_double(word, &number.number)) return fail_here(p, "this is not a finite number:");
    p->at += n;
    return add_node(p, &number, node);
}

static hs_status expect(parser *p, char c, const char *what)
{
    skip_blanks(p);
    if (*p->at != c) return fail_here(p, what);
    ++p->at;
    return HS_OK;
}

/** The node of "[number]" or "[v_name]"; *p->at is '['. */
static hs_status parse_index(parser *p, int *node)
{
    ++p->at;
    skip_blanks(p);
    hs_node index = {.kind = HS_NODE_NUMBER};
    if (strncmp(p->at, "v_", 2) == 0) {
        p->at += 2;
        index.kind = HS_NODE_VARIABLE;
        HS_TRY(take_name(p, &index.text));
        hs_status status = add_node(p, &index, node);
        if (status != HS_OK) HS_FREE(index.text);
        HS_TRY(status);
    } else {
        size_t n = strspn(p->at, "0123456789");
        char word[20] = "";
        int64_t value = 0;
        if (n < sizeof word) memcpy(word, p->at, n);
        if (n == 0 || !hs_text_to_int64(word, &value) || value < 1)
            return fail_here(p, "expected an index from 1 on, or v_name, after '['");
        index.number = (double)value;
        p->at += n;
        HS_TRY(add_node(p, &index, node));
    }
    return expect(p, ']', "expected ']'");
}

/** c_ID, f_ID, v_name, i_name or d_name with indices; p->at is behind the prefix. */
static hs_status parse_reference(parser *p, char prefix, int *node)
{
    hs_node reference = {.kind = prefix == 'v'   ? HS_NODE_VARIABLE
                                 : prefix == 'c' ? HS_NODE_COMPUTE
                                 : prefix == 'f' ? HS_NODE_FIX
                                                 : HS_NODE_CUSTOM,
                         .attribute = prefix};
    HS_TRY(take_name(p, &reference.text));
    hs_status status = HS_OK;
    if (reference.text[0] == '\0') {
        p->at -= 2;
        status = fail_here(p, "expected an ID right after the underscore");
    }
    while (status == HS_OK && *p->at == '[' && reference.n_args < 2) {
        status = parse_index(p, &reference.arg[reference.n_args]);
        ++reference.n_args;
    }
    if (status == HS_OK && prefix == 'v' && reference.n_args > 1)
        status = hs_fail(
            p->err, HS_ERROR_INPUT,
            "formula '%.400s': v_%s has one index at most: v_%s[i] is an element of a vector, or the value of one "
            "atom",
            p->formula->text, reference.text, reference.text);
    if (status == HS_OK) status = add_node(p, &reference, node);
    if (status != HS_OK) HS_FREE(reference.text);
    return status;
}

static hs_status parse_call(parser *p, const hs_function *function, int *node)
{
    hs_node call = {.kind = HS_NODE_FUNCTION, .function = function};
    ++p->at;
    for (;;) {
        if (call.n_args == function->n_args)
            return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': too many arguments; expected: %s",
                           p->formula->text, function->usage);
        HS_TRY(parse_binary(p, 1, &call.arg[call.n_args++]));
        skip_blanks(p);
        if (*p->at != ',') break;
        ++p->at;
    }
    HS_TRY(expect(p, ')', "expected ')' or ','"));
    if (call.n_args < function->n_args)
        return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': too few arguments; expected: %s", p->formula->text,
                       function->usage);
    return add_node(p, &call, node);
}

/** Cut text at its commas into trimmed words. */
static hs_status cut_words(const parser *p, hs_node *node)
{
    const hs_word_function *function = node->words_of;
    for (char *at = node->text; at != NULL;) {
        char *next = strchr(at, ',');
        if (next != NULL) *next++ = '\0';
        while (isspace((unsigned char)*at)) ++at;
        for (size_t n = strlen(at); n > 0 && isspace((unsigned char)at[n - 1]);) at[--n] = '\0';
        if (*at == '\0' || node->n_words == function->n_max)
            return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': expected: %s", p->formula->text, function->usage);
        node->words[node->n_words++] = at;
        at = next;
    }
    if (node->n_words < function->n_min)
        return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': too few arguments; expected: %s", p->formula->text,
                       function->usage);
    return HS_OK;
}

static hs_status parse_word_call(parser *p, const hs_word_function *function, hs_node_kind kind, int *node)
{
    if (p->shape != HS_VALUE_ATOMS && function->value == NULL)
        return hs_fail(p->err, HS_ERROR_INPUT,
                       "formula '%.400s': %s has one value per atom: only atom-style variables may use it",
                       p->formula->text, function->usage);
    const char *end = strchr(p->at, ')');
    if (end == NULL) return fail_here(p, "a ')' is missing for the '('");
    hs_node call = {.kind = kind, .words_of = function};
    size_t n = (size_t)(end - p->at - 1);
    HS_TRY(HS_ALLOC(call.text, n + 1, p->err));
    memcpy(call.text, p->at + 1, n);
    p->at = end + 1;
    hs_status status = cut_words(p, &call);
    if (status == HS_OK) status = add_node(p, &call, node);
    if (status != HS_OK) HS_FREE(call.text);
    return status;
}

static hs_status refuse_name(const parser *p, const char *name, bool is_function)
{
    enum { MAX = 256 };
    const char *names[MAX];
    size_t n = 0;
    for (const hs_function *f = hs_math_functions; f->name != NULL && n < MAX; ++f) names[n++] = f->name;
    for (const hs_word_function *f = hs_group_functions; f->name != NULL && n < MAX; ++f) names[n++] = f->name;
    for (const hs_word_function *f = hs_special_functions; f->name != NULL && n < MAX; ++f) names[n++] = f->name;
    if (!is_function) {
        for (const hs_thermo_entry *e = hs_thermo_entries; e->name != NULL && n < MAX; ++e) names[n++] = e->name;
        for (int i = 0; hs_formula_attributes[i] != NULL && n < MAX; ++i) names[n++] = hs_formula_attributes[i];
        for (size_t i = 0; i < sizeof constants / sizeof constants[0] && n < MAX; ++i) names[n++] = constants[i].name;
    }
    const char *nearest = hs_text_nearest(name, names, n);
    const char *what = is_function ? "function" : "keyword, attribute or constant";
    if (nearest != NULL)
        return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': there is no %s '%.80s'; did you mean '%s'?",
                       p->formula->text, what, name, nearest);
    return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': there is no %s '%.80s'", p->formula->text, what, name);
}

static hs_status parse_function(parser *p, const char *name, int *node)
{
    for (const hs_function *f = hs_math_functions; f->name != NULL; ++f)
        if (strcmp(f->name, name) == 0) return parse_call(p, f, node);
    for (const hs_word_function *f = hs_group_functions; f->name != NULL; ++f)
        if (strcmp(f->name, name) == 0) return parse_word_call(p, f, HS_NODE_GROUP, node);
    for (const hs_word_function *f = hs_special_functions; f->name != NULL; ++f)
        if (strcmp(f->name, name) == 0) return parse_word_call(p, f, HS_NODE_SPECIAL, node);
    for (int i = 0; refused_functions[i] != NULL; i += 2)
        if (strcmp(refused_functions[i], name) == 0)
            return hs_fail(p->err, HS_ERROR_INPUT, "formula '%.400s': the function %s() is not supported: %s",
                           p->formula->text, name, refused_functions[i + 1]);
    return refuse_name(p, name, true);
}

static int find_attribute(const char *name)
{
    for (int i = 0; hs_formula_attributes[i] != NULL; ++i)
        if (strcmp(hs_formula_attributes[i], name) == 0) return i;
    return -1;
}

/** A name that is neither a function nor a reference: constant, thermo keyword, per-atom attribute, or x[ID]. */
static hs_status parse_plain_name(parser *p, char *name, int *node)
{
    hs_node plain = {.kind = HS_NODE_NUMBER, .attribute = find_attribute(name)};
    if (*p->at == '[') {
        if (plain.attribute < 0) return refuse_name(p, name, false);
        plain.kind = HS_NODE_ATOM_VALUE;
        plain.n_args = 1;
        HS_TRY(parse_index(p, &plain.arg[0]));
        return add_node(p, &plain, node);
    }
    for (size_t i = 0; i < sizeof constants / sizeof constants[0]; ++i)
        if (strcmp(constants[i].name, name) == 0) {
            plain.number = constants[i].value;
            return add_node(p, &plain, node);
        }
    if (plain.attribute >= 0 && p->shape == HS_VALUE_ATOMS) {
        plain.kind = HS_NODE_ATTRIBUTE;
        return add_node(p, &plain, node);
    }
    if (hs_thermo_find_entry(name) != NULL) {
        plain.kind = HS_NODE_KEYWORD;
        HS_TRY(hs_memory_strdup(&plain.text, name, p->err));
        hs_status status = add_node(p, &plain, node);
        if (status != HS_OK) HS_FREE(plain.text);
        return status;
    }
    if (plain.attribute >= 0)
        return hs_fail(p->err, HS_ERROR_INPUT,
                       "formula '%.400s': '%s' has one value per atom: only atom-style variables may use it (%s[ID] is "
                       "that of one atom)",
                       p->formula->text, name, name);
    return refuse_name(p, name, false);
}

static hs_status parse_name(parser *p, int *node)
{
    if (strchr("cCfFvid", p->at[0]) != NULL && p->at[1] == '_') {
        const char prefix = p->at[0];
        if (strchr("cfvid", prefix) == NULL)
            return fail_here(
                p, "per-atom and grid references of other LAMMPS versions are not supported; use c_ID, f_ID or v_name");
        p->at += 2;
        return parse_reference(p, prefix, node);
    }
    char *name = NULL;
    HS_TRY(take_name(p, &name));
    hs_status status = *p->at == '(' ? parse_function(p, name, node) : parse_plain_name(p, name, node);
    HS_FREE(name);
    return status;
}

static hs_status parse_operand(parser *p, int *node)
{
    skip_blanks(p);
    if (++p->depth > DEPTH_MAX) return fail_here(p, "more than 200 parentheses or signs within each other");
    hs_status status;
    const char c = *p->at;
    if (isdigit((unsigned char)c) || c == '.') {
        status = parse_number(p, node);
    } else if (isalpha((unsigned char)c)) {
        status = parse_name(p, node);
    } else if (c == '(') {
        ++p->at;
        status = parse_binary(p, 1, node);
        if (status == HS_OK) status = expect(p, ')', "expected an operator or ')'");
    } else if (c == '-' || c == '!') {
        hs_node sign = {.kind = c == '-' ? HS_NODE_NEGATE : HS_NODE_NOT, .n_args = 1};
        ++p->at;
        status = parse_operand(p, &sign.arg[0]);
        if (status == HS_OK) status = add_node(p, &sign, node);
    } else if (c == '$') {
        status =
            fail_here(p, "'$' has no meaning within a formula (quotes keep it from being replaced); write v_name:");
    } else {
        status = fail_here(p, "expected a number, a name or '('");
    }
    --p->depth;
    return status;
}

/** The binary operator at the present place, its length and strength; 0 when there is none. */
static int find_operator(const char *at, hs_node_kind *kind, size_t *length)
{
    static const struct {
        const char *sign;
        hs_node_kind kind;
        int precedence;
    } table[] = {
        {"||", HS_NODE_OR, 1},
        {"|^", HS_NODE_XOR, 1},
        {"&&", HS_NODE_AND, 2},
        {"==", HS_NODE_EQUAL, 3},
        {"!=", HS_NODE_NOT_EQUAL, 3},
        {"<=", HS_NODE_LESS_EQUAL, 4},
        {">=", HS_NODE_GREATER_EQUAL, 4},
        {"<", HS_NODE_LESS, 4},
        {">", HS_NODE_GREATER, 4},
        {"+", HS_NODE_ADD, 5},
        {"-", HS_NODE_SUBTRACT, 5},
        {"*", HS_NODE_MULTIPLY, 6},
        {"/", HS_NODE_DIVIDE, 6},
        {"%", HS_NODE_MODULO, 6},
        {"^", HS_NODE_POWER, 7},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i) {
        *length = strlen(table[i].sign);
        if (strncmp(at, table[i].sign, *length) != 0) continue;
        *kind = table[i].kind;
        return table[i].precedence;
    }
    return 0;
}

static hs_status parse_binary(parser *p, int precedence_min, int *node)
{
    HS_TRY(parse_operand(p, node));
    for (;;) {
        skip_blanks(p);
        hs_node binary = {.n_args = 2};
        size_t length;
        const int precedence = find_operator(p->at, &binary.kind, &length);
        if (precedence == 0 || precedence < precedence_min) return HS_OK;
        p->at += length;
        binary.arg[0] = *node;
        HS_TRY(parse_binary(p, precedence + 1, &binary.arg[1]));
        HS_TRY(add_node(p, &binary, node));
    }
}

hs_status hs_formula_parse(hs_formula **formula, const char *text, hs_value_shape shape, hs_error *err)
{
    HS_TRY(HS_ALLOC(*formula, 1, err));
    hs_status status = hs_memory_strdup(&(*formula)->text, text, err);
    parser p = {.formula = *formula, .at = text, .shape = shape, .err = err};
    int node;
    if (status == HS_OK) status = parse_binary(&p, 1, &node);
    if (status == HS_OK && *p.at != '\0') status = fail_here(&p, "expected an operator");
    if (status != HS_OK) hs_formula_destroy(formula);
    return status;
}

void hs_formula_destroy(hs_formula **formula)
{
    if (*formula == NULL) return;
    for (int i = 0; i < (*formula)->n_nodes; ++i) HS_FREE((*formula)->node[i].text);
    HS_FREE((*formula)->node);
    HS_FREE((*formula)->text);
    HS_FREE(*formula);
}

const char *hs_formula_text(const hs_formula *formula) { return formula->text; }
