/* Lines, comments, quotes and words, as LAMMPS's input script language has them. */
#include <stdio.h>
#include <string.h>

#include "deck/lexer.h"
#include "support/harness.h"

/** The logical lines of a text, each as "FIRST|line\n". */
static void read_all(const char *text, hs_text *all)
{
    hs_error err = {0};
    hs_cursor cursor = {0};
    hs_text line = {0};
    bool found = true;
    hs_text_clear(all);
    for (;;) {
        long first;
        ck_assert_hs_ok(hs_lexer_line(text, strlen(text), &cursor, &line, &first, &found, &err), err);
        if (!found) break;
        ck_assert_hs_ok(hs_text_printf(all, &err, "%ld|%s\n", first, hs_text_get(&line)), err);
    }
    hs_text_fini(&line);
}

static void check_lines(const char *text, const char *expected)
{
    hs_text all = {0};
    read_all(text, &all);
    ck_assert_str_eq(hs_text_get(&all), expected);
    hs_text_fini(&all);
}

START_TEST(lines_are_counted_and_trimmed_at_their_end)
{
    check_lines("", "");
    check_lines("run 1", "1|run 1\n");
    check_lines("a\n\n  b  \t\nc\r\n", "1|a\n2|\n3|  b\n4|c\n");
}
END_TEST

START_TEST(ampersand_joins_lines)
{
    check_lines("print &\n  a &  \n\tb\nc\n", "1|print   a \tb\n4|c\n");
    check_lines("a & b\n", "1|a & b\n");
    check_lines("a &", "1|a \n");
    check_lines("a &\n&\nb\n", "1|a b\n");
}
END_TEST

START_TEST(comment_ending_in_ampersand_swallows_the_next_line)
{
    /* so does LAMMPS, see the echo of its example in.melt */
    check_lines("#dump type &\n#\t axes\nrun 1\n", "1|#dump type #\t axes\n3|run 1\n");
}
END_TEST

START_TEST(triple_quotes_keep_line_breaks)
{
    check_lines("print \"\"\"a\nb\n\nc\"\"\"\nd\n", "1|print \"\"\"a\nb\n\nc\"\"\"\n5|d\n");
}
END_TEST

START_TEST(text_that_is_no_deck_is_refused)
{
    hs_error err = {0};
    hs_cursor cursor = {0};
    hs_text line = {0};
    bool found;
    long first;
    ck_assert_int_eq(hs_lexer_line("a\0b\n", 4, &cursor, &line, &first, &found, &err), HS_ERROR_INPUT);
    ck_assert_str_eq(err.text, "line 1 holds a NUL byte: this is not the text of a deck");
    hs_error_clear(&err);
    memset(&cursor, 0, sizeof cursor);
    ck_assert_int_eq(hs_lexer_line("\"\"\"\nb", 5, &cursor, &line, &first, &found, &err), HS_ERROR_INPUT);
    hs_text_fini(&line);
}
END_TEST

START_TEST(comments_end_lines_but_not_within_quotes)
{
    static const char *const cases[][2] = {
        {"a # b", "a "},
        {"# b", ""},
        {"a", "a"},
        {"print 'a # b' # c", "print 'a # b' "},
        {"print \"a # 'b\" # c", "print \"a # 'b\" "},
        {"print \"\"\"a \" # b\"\"\" # c", "print \"\"\"a \" # b\"\"\" "},
        {"it's # open", "it's # open"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        char line[64];
        snprintf(line, sizeof line, "%s", cases[i][0]);
        hs_lexer_strip_comment(line);
        ck_assert_str_eq(line, cases[i][1]);
    }
}
END_TEST

/** Words as "[a][b]"; an error's text instead of them. */
static void check_words(const char *line, const char *expected)
{
    hs_error err = {0}, ignored = {0};
    hs_words words = {0};
    hs_text all = {0};
    if (hs_words_split(&words, line, &err) == HS_OK)
        for (int i = 0; i < words.n; ++i)
            ck_assert_int_eq(hs_text_printf(&all, &ignored, "[%s]%s", words.word[i], words.was_quoted[i] ? "q" : ""),
                             HS_OK);
    ck_assert_str_eq(err.status == HS_OK ? hs_text_get(&all) : err.text, expected);
    hs_words_fini(&words);
    hs_text_fini(&all);
}

START_TEST(words_are_split_at_blanks_and_held_together_by_quotes)
{
    check_words("", "");
    check_words(" \t ", "");
    check_words("a", "[a]");
    check_words("  run\t10  upto ", "[run][10][upto]");
    check_words("print 'a b' \"c 'd' e\"", "[print][a b]q[c 'd' e]q");
    check_words("print \"\"\"a \"b\" c\"\"\" d", "[print][a \"b\" c]q[d]");
    check_words("a\"b c\"d", "[a\"b][c\"d]");
    check_words("''", "[]q");
}
END_TEST

START_TEST(unbalanced_quotes_are_refused)
{
    check_words("print 'a b", "the quotation 'a b is not closed: a ' is missing");
    check_words("print \"\"\"a\" b", "the quotation \"\"\"a\" b is not closed: a \"\"\" is missing");
    check_words("print 'a'b c", "'b c' follows a closing quotation mark: a blank must stand between them");
}
END_TEST

HS_TEST_MAIN("lexer", lines_are_counted_and_trimmed_at_their_end, ampersand_joins_lines,
             comment_ending_in_ampersand_swallows_the_next_line, triple_quotes_keep_line_breaks,
             text_that_is_no_deck_is_refused, comments_end_lines_but_not_within_quotes,
             words_are_split_at_blanks_and_held_together_by_quotes, unbalanced_quotes_are_refused)
