/** Parts of the page that `halfshell report` writes. Everything goes into one text, which the page's file gets
 *  whole. */
#ifndef HS_CLI_REPORT_H
#define HS_CLI_REPORT_H

#include "io/figure.h"

/** What a log says beside its thermo tables. */
typedef struct hs_log_summary {
    hs_text deck;     /**< its commands, as the deck had them */
    hs_text warnings; /**< a line each */
    hs_text facts;    /**< pairs of lines: what, value */
    hs_text timing;   /**< of the last run: the timing table */
} hs_log_summary;

HS_MUST_USE hs_status hs_log_summary_read(hs_log_summary *summary, const char *log, hs_error *err);
void hs_log_summary_fini(hs_log_summary *summary);

/* Pieces of HTML at the end of @p page */
/** Text with everything quoted that HTML gives a meaning. */
HS_MUST_USE hs_status hs_html_text(hs_text *page, const char *text, hs_error *err);
/** A figure as SVG that takes the page's colours and refers to nothing outside of itself; @p number keeps the names in
 *  it apart from those of other figures. One that cannot be drawn is a note with the reason, of which
 *  @p undrawn keeps the first. */
HS_MUST_USE hs_status hs_html_figure(hs_text *page, const hs_figure *figure, int number, const char *caption,
                                     hs_error *undrawn, hs_error *err);
/** A picture file, in the page itself. */
HS_MUST_USE hs_status hs_html_picture(hs_text *page, const char *path, const char *name, hs_error *err);
/** Head of the page with its style; and its end. */
HS_MUST_USE hs_status hs_html_begin(hs_text *page, const char *title, hs_error *err);
HS_MUST_USE hs_status hs_html_end(hs_text *page, hs_error *err);
/** Means of all columns of the runs of a log. */
HS_MUST_USE hs_status hs_html_means(hs_text *page, const hs_table_file *log, const hs_deck_facts *facts, hs_error *err);

#endif
