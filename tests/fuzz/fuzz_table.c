/* Tables that plots and reports read: logs, what fixes write, CSV; and the deck that a log repeats. */
#include "fuzz.h"
#include "io/figure.h"

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    hs_fuzz_enter();
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    hs_error err = {0};
    hs_table_file file;
    hs_deck_facts facts = {0};
    hs_figure figure = {0};
    const hs_plot_choice choice = {0};
    hs_fuzz_write("fuzz.txt", data, size);
    hs_status status = hs_table_file_read(&file, "fuzz.txt", &err);
    if (status == HS_OK) status = hs_deck_facts_read(&facts, "fuzz.txt", &err);
    if (status == HS_OK) status = hs_figure_add_file(&figure, &file, NULL, &choice, &facts, &err);
    hs_fuzz_judge(status, &err);
    hs_figure_fini(&figure);
    hs_deck_facts_fini(&facts);
    hs_table_file_fini(&file);
    return 0;
}
