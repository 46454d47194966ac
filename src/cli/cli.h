/** The command line: its options, and one function per subcommand. Nothing here exits: main.c does. */
#ifndef HS_CLI_CLI_H
#define HS_CLI_CLI_H

#include <signal.h>
#include <sys/types.h>

#include "deck/deck.h"

/** Subcommands, as bits: which of them know an option. */
enum {
    HS_CLI_RUN = 1,
    HS_CLI_CHECK = 2,
    HS_CLI_BENCH = 4,
    HS_CLI_HELP = 8,
    HS_CLI_PLOT = 16,
    HS_CLI_REPORT = 32,
    HS_CLI_RESUME = 64
};

/** One option. The table serves the parser, `halfshell --help`, the man page, the manual and shell completion. */
typedef struct hs_cli_option {
    const char *name;   /**< "-in" */
    const char *alias;  /**< LAMMPS's short form, or NULL */
    const char *values; /**< "FILE|none"; "" for an option without values */
    unsigned commands;  /**< subcommands that know it */
    const char *help;   /**< one line */
} hs_cli_option;

/** All options, ended by a NULL name. */
extern const hs_cli_option hs_cli_options[];

/** One subcommand. */
typedef struct hs_cli_command {
    const char *name;
    const char *usage; /**< words after the name */
    unsigned bit;
    const char *help; /**< one line */
} hs_cli_command;

/** All subcommands, ended by a NULL name. */
extern const hs_cli_command hs_cli_commands[];

/** What the program was started with. */
typedef struct hs_cli {
    int n;                                 /**< words after the subcommand */
    char **word;                           /**< borrowed */
    volatile sig_atomic_t *stop_requested; /**< set by the signal handlers of main.c */
    hs_parallel *parallel;                 /**< the ranks of this program */
} hs_cli;

enum { HS_CLI_RANK_COUNTS_MAX = 64 };
enum { HS_CLI_NO_EFFECT_MAX = 2 }; /* -suffix, -package */

/** What the options say. Words are borrowed from the command line. */
typedef struct hs_cli_settings {
    const char *deck; /**< NULL: none was given; "-": standard input */
    hs_options options;
    double walltime_s;        /**< -walltime: wall time after which to stop; 0: no limit */
    const char *log, *screen; /**< file, or "none"; NULL: the default */
    bool echo_screen, echo_log;
    int rank_counts[HS_CLI_RANK_COUNTS_MAX]; /**< check -ranks */
    int n_rank_counts;
    double speed;                                /**< check -speed: million atom-steps/s of a core */
    double latency_us, bandwidth;                /**< check -latency: of a message; -bandwidth: GB/s of a rank */
    const char *no_effect[HS_CLI_NO_EFFECT_MAX]; /**< LAMMPS options that were accepted and change nothing */
    const char *last_value; /**< last value of the last -var with several: it may have been meant as the deck */
    const char *last_variable;
} hs_cli_settings;

/** In a process that a launcher has started for a rank: make the rank, in a process of its own, and watch over it. False in the rank,
 *  and in all processes that are not watched. True in the watching process, when the rank has ended: it is to end with *exit_code, the
 *  rank's, or 2 after a message when the rank was killed. Before threads and MPI are started. @p argv is wiped in the watching process,
 *  which is none of those that people look for. */
bool hs_cli_watch_rank(char **argv, int *exit_code);
/** The process that watches over this one; 0: none does. */
pid_t hs_cli_watcher(void);

/** Read the words of `run` and `check`. */
HS_MUST_USE hs_status hs_cli_parse(const hs_cli *cli, unsigned command, hs_cli_settings *settings, hs_error *err);
/** Give the deck the variables of -var. The words must have passed hs_cli_parse. */
HS_MUST_USE hs_status hs_cli_set_variables(const hs_cli *cli, unsigned command, hs_deck *deck, hs_error *err);
/** Value of -reproducible. */
HS_MUST_USE hs_status hs_cli_parse_reproducible(const char *word, hs_options *options, hs_error *err);
/** Value of -precision. */
HS_MUST_USE hs_status hs_cli_parse_precision(const char *word, hs_options *options, hs_error *err);
/** Value of -isa: an instruction set that kernels exist for and this machine has. */
HS_MUST_USE hs_status hs_cli_parse_isa(const char *word, hs_options *options, hs_error *err);
/** Whether a word starts an option: a minus sign and a letter or a second one. "-" and "-1.5" are values. */
bool hs_cli_is_option(const char *word);
/** The option of that name or alias that @p command knows; else an error with the nearest. */
HS_MUST_USE hs_status hs_cli_find_option(const char *word, unsigned command, const hs_cli_option **option,
                                         hs_error *err);

/** What stops a run early (signals, -walltime) writes a checkpoint. */
void hs_cli_prepare_stop(const hs_cli *cli, const hs_cli_settings *settings, hs_deck *deck);
/** Flush what people were told; a full disk must not pass for a finished run. */
HS_MUST_USE hs_status hs_cli_flush(FILE *stream, const char *what, hs_error *err);

/* The subcommands. Errors are returned; *exit_code is set by the deck's `quit N`. */
HS_MUST_USE hs_status hs_cli_run(const hs_cli *cli, int *exit_code, hs_error *err);
HS_MUST_USE hs_status hs_cli_resume(const hs_cli *cli, int *exit_code, hs_error *err);
HS_MUST_USE hs_status hs_cli_check(const hs_cli *cli, hs_error *err);
HS_MUST_USE hs_status hs_cli_bench(const hs_cli *cli, hs_error *err);
/** `bench kernels`; called by hs_cli_bench. */
HS_MUST_USE hs_status hs_cli_bench_kernels(const hs_cli *cli, hs_error *err);
/** `bench neighbors`; called by hs_cli_bench. */
HS_MUST_USE hs_status hs_cli_bench_neighbors(const hs_cli *cli, hs_error *err);
/** `bench scaling`; called by hs_cli_bench. */
HS_MUST_USE hs_status hs_cli_bench_scaling(const hs_cli *cli, hs_error *err);
HS_MUST_USE hs_status hs_cli_plot(const hs_cli *cli, hs_error *err);
HS_MUST_USE hs_status hs_cli_report(const hs_cli *cli, hs_error *err);
HS_MUST_USE hs_status hs_cli_help(const hs_cli *cli, hs_error *err);

/** check -ranks: print what the system that the deck ends with would need on so many ranks. Nothing without -ranks. */
HS_MUST_USE hs_status hs_cli_predict_ranks(const hs_deck *deck, const hs_cli_settings *settings, hs_error *err);

/** The page of `halfshell --help`. */
void hs_cli_usage(FILE *stream);
/** The page of `halfshell SUBCOMMAND --help`. */
void hs_cli_usage_of(FILE *stream, const hs_cli_command *command);

#endif
