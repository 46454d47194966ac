/** Inside of formulas, shared by the files formula_*.c only. */
#ifndef HS_DECK_FORMULA_NODES_H
#define HS_DECK_FORMULA_NODES_H

#include "deck/formula.h"

typedef enum {
    HS_NODE_NUMBER,
    HS_NODE_NEGATE,
    HS_NODE_NOT,
    HS_NODE_ADD,
    HS_NODE_SUBTRACT,
    HS_NODE_MULTIPLY,
    HS_NODE_DIVIDE,
    HS_NODE_MODULO,
    HS_NODE_POWER,
    HS_NODE_EQUAL,
    HS_NODE_NOT_EQUAL,
    HS_NODE_LESS,
    HS_NODE_LESS_EQUAL,
    HS_NODE_GREATER,
    HS_NODE_GREATER_EQUAL,
    HS_NODE_AND,
    HS_NODE_OR,
    HS_NODE_XOR,
    HS_NODE_FUNCTION,   /**< math function of the nodes arg[] */
    HS_NODE_VARIABLE,   /**< v_text */
    HS_NODE_COMPUTE,    /**< c_text with index nodes arg[0 .. n_args) */
    HS_NODE_FIX,        /**< f_text, the same */
    HS_NODE_CUSTOM,     /**< i_text or d_text, by attribute 'i' or 'd', the same */
    HS_NODE_KEYWORD,    /**< thermo keyword text */
    HS_NODE_ATTRIBUTE,  /**< per-atom attribute */
    HS_NODE_ATOM_VALUE, /**< attribute of the atom whose ID is arg[0] */
    HS_NODE_GROUP,      /**< group function of words[] */
    HS_NODE_SPECIAL     /**< special function of words[] */
} hs_node_kind;

enum { HS_FUNCTION_ARGS_MAX = 6 };

struct hs_function;
struct hs_word_function;

typedef struct hs_node {
    hs_node_kind kind;
    double number;
    int n_args;
    int arg[HS_FUNCTION_ARGS_MAX];           /**< nodes, all before this one */
    const struct hs_function *function;      /**< of HS_NODE_FUNCTION */
    const struct hs_word_function *words_of; /**< of HS_NODE_GROUP and HS_NODE_SPECIAL */
    int attribute;                           /**< index in hs_formula_attributes */
    char *text;                              /**< owned; ID, keyword, or the words of a function, separated by NULs */
    int n_words;
    const char *words[HS_FUNCTION_ARGS_MAX]; /**< point into text */
} hs_node;

/** Nodes stand in the order of evaluation: operands before what uses them, the result last. So nothing recurses. */
struct hs_formula {
    char *text;    /**< owned */
    hs_node *node; /**< owned [n_nodes] */
    int n_nodes;
    size_t capacity;
};

/** Value of a node: one number, or an array: one for every local atom, or a vector. */
typedef struct hs_formula_result {
    double number;
    double *array; /**< owned [n]; NULL: one number */
    int n;
} hs_formula_result;

/** A formula being evaluated. */
typedef struct hs_evaluation {
    const hs_formula *formula;
    hs_deck *deck;
    hs_value_shape shape;
    int length;                 /**< of arrays: number of local atoms, or length of the vector */
    hs_formula_result *results; /**< owned [n_nodes] */
} hs_evaluation;

/** Room for an array of n numbers as a node's value. */
HS_MUST_USE hs_status hs_formula_make_array(hs_formula_result *out, int n, hs_error *err);
/* Nodes that refer to something (formula_reference.c): HS_NODE_COMPUTE, _FIX, _CUSTOM; _VARIABLE; _ATOM_VALUE.
 * Collective. */
HS_MUST_USE hs_status hs_formula_eval_reference(const hs_evaluation *e, const hs_node *node, hs_formula_result *out,
                                                hs_error *err);
HS_MUST_USE hs_status hs_formula_eval_variable(const hs_evaluation *e, const hs_node *node, hs_formula_result *out,
                                               hs_error *err);
HS_MUST_USE hs_status hs_formula_eval_atom_value(const hs_evaluation *e, const hs_node *node, double *value,
                                                 hs_error *err);

/** What random numbers a function draws. */
typedef enum { HS_DRAWS_NOTHING, HS_DRAWS_UNIFORM, HS_DRAWS_NORMAL } hs_draw_kind;

/** Random numbers of one evaluation of an atom-style formula and of the atom-style variables that are part of it. */
typedef struct hs_atom_draws {
    hs_draw_kind *kind; /**< owned [n]: what the formula draws for each atom, in the order of evaluation */
    int n;
    size_t capacity;
    int next; /**< draw that comes next */
    /** Owned [n][n_local], made at the first draw; draw k of local atom i is number[k * n_local + i]. */
    double *number;
} hs_atom_draws;

/** Find out what a formula will draw. Not collective; the caller gives the draws to hs_atom_draws_fini. */
HS_MUST_USE hs_status hs_atom_draws_init(hs_atom_draws *draws, const hs_formula *formula, hs_deck *deck, hs_error *err);
void hs_atom_draws_fini(hs_atom_draws *draws);
/** The next draw's numbers: (*numbers)[n_local], borrowed until hs_atom_draws_fini. The first one draws all: for each
 *  atom in the order of IDs all its numbers. @p seed starts the deck's generator for atoms if nothing has.
 *  Collective. */
HS_MUST_USE hs_status hs_atom_draws_next(hs_atom_draws *draws, hs_deck *deck, double seed, const double **numbers,
                                         hs_error *err);
/** A seed of random() and normal(). */
HS_MUST_USE hs_status hs_random_seed(const struct hs_function *function, double value, int *seed, hs_error *err);

/** A call of a math function. */
typedef struct hs_call {
    const struct hs_function *function;
    const double *arg;
    hs_deck *deck;
    int64_t atom;        /**< ID of the atom in atom-style formulas, 0 in equal-style ones */
    int64_t draw;        /**< during runs: number of this evaluation among all with random numbers per atom */
    const double *drawn; /**< the random number of an element, or between runs of the atom; NULL: to be drawn */
} hs_call;

typedef struct hs_function {
    const char *name;
    int n_args;
    hs_status (*eval)(const hs_call *call, double *value, hs_error *err);
    hs_draw_kind draws;
    const char *usage, *help;
} hs_function;

/** Functions whose arguments are words, not formulas. */
typedef struct hs_word_function {
    const char *name;
    int n_min, n_max;
    /** NULL: per atom only. */
    hs_status (*value)(hs_deck *deck, const hs_node *node, double *value, hs_error *err);
    /** In atom-style formulas; NULL: one number there, too. */
    hs_status (*atoms)(hs_deck *deck, const hs_node *node, double *values, hs_error *err);
    const char *usage, *help;
} hs_word_function;

extern const hs_function hs_math_functions[];       /**< ended by a NULL name */
extern const hs_word_function hs_group_functions[]; /**< the same */
extern const hs_word_function hs_special_functions[];

/** Names of per-atom attributes, ended by NULL. */
extern const char *const hs_formula_attributes[];
/** Attribute of local atom i. */
double hs_formula_attribute(const hs_sim *sim, int attribute, int i);

/** A whole number given in a formula, cut off like LAMMPS does. @p what names it in the message. */
HS_MUST_USE hs_status hs_formula_whole(const char *what, double value, int64_t *whole, hs_error *err);

#endif
