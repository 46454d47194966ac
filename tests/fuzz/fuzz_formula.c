/* Formulas: read, and evaluated on eight atoms, as a number and per atom. */
#include "deck/formula.h"
#include "fuzz.h"

static hs_deck *deck;

static void finish(void) { hs_deck_destroy(&deck); }

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    static const char *const lines[] = {
        "lattice sc 1.0",
        "region b block 0 2 0 2 0 2",
        "create_box 2 b",
        "create_atoms 1 box",
        "mass * 1.0",
        "region s block INF INF INF INF INF 0.5",
        "group g region s",
        "variable a equal 1+v_b*step",
        "variable b equal 2",
        "compute k all ke",
        "compute p all ke/atom",
        "variable t atom x+id",
        "pair_style zero 1.0",
        "pair_coeff * *",
    };
    (void)argc;
    (void)argv;
    deck = hs_fuzz_deck(true);
    hs_fuzz_run(deck, lines, sizeof lines / sizeof lines[0]);
    return atexit(finish);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double value, values[8];
    hs_formula *formula = NULL;
    hs_error err = {0}, of_atoms = {0};
    char *text = malloc(size + 1);
    if (text == NULL) return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    hs_fuzz_judge(hs_formula_once(deck, text, &value, &err), &err);
    hs_status status = hs_formula_parse(&formula, text, HS_VALUE_ATOMS, &of_atoms);
    if (status == HS_OK) status = hs_formula_atoms(formula, deck, values, &of_atoms);
    hs_fuzz_judge(status, &of_atoms);
    hs_formula_destroy(&formula);
    free(text);
    return 0;
}
