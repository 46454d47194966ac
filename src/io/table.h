/** Tables of numbers in text files that runs leave behind: logs, what fixes write, CSV. For plots and reports. */
#ifndef HS_IO_TABLE_H
#define HS_IO_TABLE_H

#include <stdint.h>

#include "base/text.h"

/** One column: numbers, or words where a column has any (a method's name in a benchmark). */
typedef struct hs_table_column {
    char *name;    /**< owned */
    double *value; /**< owned [capacity]; NaN where the cell is no number */
    char **word;   /**< owned [capacity], each owned; NULL while every cell was a number */
} hs_table_column;

/** Rows of one run (of a log), of one step (of a file with blocks), or of a whole file. */
typedef struct hs_table {
    int64_t step; /**< of a block; else the number of the table in its file, from 1 */
    int n_columns;
    hs_table_column *column; /**< owned [n_columns] */
    int64_t n_rows, capacity;
} hs_table;

typedef enum {
    HS_TABLE_LOG,    /**< thermo output, one table for each run */
    HS_TABLE_SERIES, /**< a row a step: fix ave/time of scalars, fix vector, fix print with a title */
    HS_TABLE_BLOCKS, /**< a table a step: fix ave/chunk, ave/correlate, ave/histo, ave/time of vectors */
    HS_TABLE_CSV     /**< names in the first line, cells between commas, or between blanks */
} hs_table_kind;

typedef struct hs_table_file {
    hs_table_kind kind;
    char *path;  /**< owned; as given */
    char *about; /**< owned; first comment of the file, "" without one */
    hs_table *table;
    int n_tables; /**< at least 1 */
    hs_text text; /**< the file itself, cut into lines by zeros */
} hs_table_file;

/** Read a file, plain or compressed by gzip. An error, with the line, when it is none of the kinds above or holds no
 *  rows. The caller frees it with hs_table_file_fini, also after an error. */
HS_MUST_USE hs_status hs_table_file_read(hs_table_file *file, const char *path, hs_error *err);
void hs_table_file_fini(hs_table_file *file);

/** The text of a file, plain or compressed by gzip, at the end of @p text; an error when it is empty or no text. */
HS_MUST_USE hs_status hs_table_read_text(const char *path, hs_text *text, hs_error *err);

/** Index of the column of that name, -1 when there is none. */
int hs_table_find(const hs_table *table, const char *name);

/* Shared by the files io/table*.c */

/** The lines of a text that was cut at its newlines. */
typedef struct hs_table_lines {
    char *next, *end;
    long number; /**< of the present line, from 1 */
    bool is_cut; /**< the present line is the file's last and has no newline: the writer may have been stopped there */
} hs_table_lines;

/** The next line, NULL at the end; borrowed, and may be cut into words. */
char *hs_table_next_line(hs_table_lines *lines);
/** Cut a line at blanks. Words are borrowed; *words grows as needed and is freed by the caller. */
HS_MUST_USE hs_status hs_table_split(char *line, const char ***words, size_t *capacity, int *n, hs_error *err);
/** One more table with these columns at the end of the file. */
HS_MUST_USE hs_status hs_table_add(hs_table_file *file, const char *const *names, int n, int64_t step, hs_error *err);
/** One more row at the end of the file's last table, which has as many columns as there are words. */
HS_MUST_USE hs_status hs_table_add_row(hs_table_file *file, const char *const *words, hs_error *err);
/** Numbers as files have them: also nan and inf. */
bool hs_table_number(const char *word, double *value);

HS_MUST_USE hs_status hs_table_read_log(hs_table_file *file, hs_table_lines *lines, hs_error *err);
HS_MUST_USE hs_status hs_table_read_fix(hs_table_file *file, hs_table_lines *lines, hs_error *err);
HS_MUST_USE hs_status hs_table_read_csv(hs_table_file *file, hs_table_lines *lines, hs_error *err);

#endif
