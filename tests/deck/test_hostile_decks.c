/* Decks that no one would write: random bytes, decks cut off, decks with bytes changed, words exchanged. Each must
 * end with an error or well, never with a crash; built with sanitizers this test looks for more than it can see
 * itself.
 *
 * Nothing is run or written (options.dry_run), and a timer stops decks that loop. HALFSHELL_HOSTILE_DECKS sets how
 * many decks of each kind are tried, HALFSHELL_HOSTILE_SEED where to start. */
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include "deck/deck.h"
#include "support/harness.h"

static volatile sig_atomic_t stop_requested;
static uint64_t state;

static uint64_t draw(uint64_t n)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (state >> 33) % n;
}

/** Decks to start from: all of the language, and every family of commands. */
static const char *const decks[] = {
    "variable a index 3 4 5 # comment\nlabel l\nprint \"a $a ${a} $(v_a*2:%.3f)\" screen no\nif \"$a > 3 && abc == "
    "abc\" then 'print "
    "\"big\"' elif \"$a == 3\" \"print three\" \"print more\" else \"print never\"\nnext a\njump SELF l\nprint done\n",
    "variable e equal sqrt(2)+atan2(1,v_x)^-2*!(1<2)||PI\nvariable x internal 2.5\nvariable f format e "
    "%10.4f\nvariable s string \"$x "
    "${e}\"\nvariable l loop 3 12 pad\nvariable g getenv HOME\nvariable t atom random(0,1,5)*x+gmask(all)\nprint "
    "\"\"\"$s ${f}\n${l}\"\"\"\n",
    "variable a equal v_b+c_thermo_temp[2]+f_1[3]\nvariable b equal "
    "stride2(0,900,77,100,450,33)+logfreq3(1,20,100)+stagger(100,10)\n"
    "print $(v_b+logfreq2(10,3,10)+random(0,1,77)+normal(0,1,3)+is_defined(group,all)+is_file(/tmp))\nprint ${a}\n",
    "units lj\natom_style atomic\nlattice fcc 0.8442\nregion box block 0 2 0 2 0 2\ncreate_box 2 box\ncreate_atoms 1 "
    "box\nmass * 1.0\n"
    "velocity all create 3.0 87287 loop geom\npair_style lj/cut 2.5\npair_coeff * * 1.0 1.0 2.5\nneighbor 0.3 "
    "bin\nneigh_modify every "
    "20 delay 0 check no\nfix 1 all nve\nthermo 50\nrun 10\nprint \"$(pe) $(x[3]) $(xcm(all,x)) $(bound(all,xmin)) "
    "$(c_thermo_press[2])\"\n",
    "units real\ndimension 2\nboundary p s p\nlattice hex 0.7 origin 0.1 0.2 0 orient x 1 0 0\nregion b block 0 3 0 3 "
    "-0.5 0.5\ncreate_box 1 b\n"
    "region c cylinder z 1 1 0.7 INF INF side out units box\nregion d union 2 b c\ncreate_atoms 1 region "
    "d\ncreate_atoms 1 single 1 "
    "1 0 units box\ngroup g region c\ngroup h subtract all g\nset group g type 1 x 0.5\nmass 1 2\nvelocity g set 1 0 "
    "NULL\npair_style wca\n",
    "region s sphere 0 0 0 2 side in\nregion p prism 0 1 0 1 0 1 0.1 0.2 0.3\nregion i intersect 2 s p\nregion q plane "
    "0 0 0 1 0 0\n"
    "atom_modify map array sort 0 0\nnewton on off\nprocessors 1 1 *\npackage omp 2\nsuffix omp\necho both\ninfo all "
    "out log\nclear\n",
    "region b block 0 3 0 3 0 3\ncreate_box 1 b\ncreate_atoms 1 random 5 4711 b\nmass 1 1\npair_style none\ncompute k "
    "all ke\ndump 1 all "
    "custom 10 out.dump id type x y z vx\ndump_modify 1 sort id format float %g pbc yes\nthermo_style custom step temp "
    "c_k v_r pe\n"
    "thermo_modify norm no lost warn format float %12.4g\nvariable r equal ramp(1,2)\nrun 4 every 2 \"print 'a "
    "$(step)'\" \"timestep 0.01\"\n"
    "reset_timestep 5\nrun 10 upto start 0 stop 20 pre no post no\nundump 1\nuncompute k\nquit 3\n",
    "pair_style lj/cut 2.5\nread_data a.data\nmass 1 1.0\npair_coeff 1 1 1 1\npair_modify shift yes mix arithmetic "
    "tail no\ncomm_modify mode "
    "single cutoff 3\ncomm_style brick\nneighbor_method nsq\ninclude in.inner\nwrite_data out.data\n",
};
enum { N_DECKS = sizeof decks / sizeof decks[0], DECK_WITH_ERRORS = 2, ROOM = 8192 };

static const char data_file[] =
    "A data file\n\n2 atoms\n1 atom types\n\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n\nMasses\n\n1 1.0\n\nPairIJ Coeffs "
    "# lj/cut\n\n1 1 1.0 "
    "1.0\n\nAtoms # atomic\n\n1 1 0.5 0.5 0.5 0 0 0\n2 1 1.5 1.5 1.5 0 1 0\n\nVelocities\n\n1 0.1 0.2 0.3\n2 0 0 -1\n";

static const char *const words[] = {
    "$",
    "${",
    "$(",
    "}",
    ")",
    "&\n",
    "\"",
    "'",
    "\"\"\"",
    "#",
    "\n",
    "-1",
    "0",
    "1e999",
    "nan",
    "99999999999999999999",
    "*",
    "INF",
    "NULL",
    "all",
    "box",
    "v_a",
    "c_thermo_temp",
    "[",
    "]",
    "%s",
    "%n",
    "include in.bad",
    "jump SELF",
    "variable a equal v_a",
    "next a",
    "label l",
    "if 1 then \"if 1 then 'print a'\"",
    "clear",
    "\r",
    "\t",
    "\x01",
    "\xff",
    "2*1",
    "units",
    "one",
    "yes",
    "||",
    "(((((((",
};
enum { N_WORDS = sizeof words / sizeof words[0] };

static void on_alarm(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static void write_file(const char *name, const char *bytes, size_t n)
{
    FILE *stream = fopen(name, "wb");
    ck_assert_ptr_nonnull(stream);
    ck_assert_uint_eq(fwrite(bytes, 1, n, stream), n);
    fclose(stream);
}

/** Check and run a deck dry. Whatever it is, an error must have a text and a line, and the deck must let go of
 *  everything. */
static hs_error try_deck(const char *bytes, size_t n)
{
    const hs_options options = {.n_threads = 1, .dry_run = true};
    const struct itimerval second = {.it_value = {.tv_sec = 1}}, none = {.it_value = {.tv_sec = 0}};
    hs_error err = {0};
    hs_sink out = {0};
    hs_deck *deck = NULL;
    write_file("in.bad", bytes, n);
    ck_assert_hs_ok(hs_deck_create(&deck, &options, &out, &err), err);
    stop_requested = 0;
    deck->sim->stop_requested = &stop_requested;
    setitimer(ITIMER_REAL, &second, NULL);
    hs_status status = hs_deck_check(deck, "in.bad", &err);
    if (status == HS_OK) status = hs_deck_run(deck, "in.bad", &err);
    setitimer(ITIMER_REAL, &none, NULL);
    ck_assert_int_eq(status, err.status);
    if (status != HS_OK) {
        ck_assert_msg(err.text[0] != '\0' && err.file[0] != '\0', "no text or file: %s:%ld: %s", err.file, err.line,
                      err.text);
        for (const unsigned char *c = (const unsigned char *)err.text; *c != '\0'; ++c)
            ck_assert(*c >= ' ' && *c != 0x7f);
    }
    ck_assert_ptr_null(deck->source);
    hs_deck_destroy(&deck);
    return err;
}

static size_t cut(char *bytes, size_t n)
{
    (void)bytes;
    return draw(n + 1);
}

static size_t change(char *bytes, size_t n)
{
    for (uint64_t k = draw(6) + 1; k > 0 && n > 0; --k) bytes[draw(n)] = (char)draw(256);
    return n;
}

static size_t insert(char *bytes, size_t n)
{
    for (uint64_t k = draw(4) + 1; k > 0; --k) {
        const char *word = words[draw(N_WORDS)];
        const size_t length = strlen(word), at = draw(n + 1);
        if (n + length >= ROOM) return n;
        memmove(bytes + at + length, bytes + at, n - at);
        memcpy(bytes + at, word, length);
        n += length;
    }
    return n;
}

/** Begin and end of a random word. */
static void pick_word(const char *bytes, size_t n, size_t *begin, size_t *end)
{
    *begin = n > 0 ? draw(n) : 0;
    while (*begin > 0 && strchr(" \n", bytes[*begin - 1]) == NULL) --*begin;
    for (*end = *begin; *end < n && strchr(" \n", bytes[*end]) == NULL;) ++*end;
}

static size_t drop_words(char *bytes, size_t n)
{
    for (uint64_t k = draw(3) + 1; k > 0; --k) {
        size_t begin, end;
        pick_word(bytes, n, &begin, &end);
        memmove(bytes + begin, bytes + end, n - end);
        n -= end - begin;
    }
    return n;
}

static size_t replace_words(char *bytes, size_t n)
{
    for (uint64_t k = draw(3) + 1; k > 0; --k) {
        const char *word = words[draw(N_WORDS)];
        size_t begin, end, length = strlen(word);
        pick_word(bytes, n, &begin, &end);
        if (n + length >= ROOM) return n;
        memmove(bytes + begin + length, bytes + end, n - end);
        memcpy(bytes + begin, word, length);
        n = n - (end - begin) + length;
    }
    return n;
}

static size_t copy_word(char *bytes, size_t n)
{
    size_t from, from_end, to, to_end;
    char word[256];
    pick_word(bytes, n, &from, &from_end);
    pick_word(bytes, n, &to, &to_end);
    const size_t length = from_end - from < sizeof word ? from_end - from : sizeof word;
    if (n + length >= ROOM) return n;
    memcpy(word, bytes + from, length);
    memmove(bytes + to + length, bytes + to_end, n - to_end);
    memcpy(bytes + to, word, length);
    return n - (to_end - to) + length;
}

static int setting(const char *name, int otherwise)
{
    const char *value = getenv(name);
    return value != NULL ? atoi(value) : otherwise;
}

static void start(void)
{
    char folder[] = "/tmp/halfshell_hostile_XXXXXX";
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_int_eq(chdir(folder), 0);
    signal(SIGALRM, on_alarm);
    state = (uint64_t)setting("HALFSHELL_HOSTILE_SEED", 20211);
    write_file("in.inner", "print inner\n", 12);
    write_file("a.data", data_file, sizeof data_file - 1);
}

static void finish(void)
{
    char folder[256];
    static const char *const files[] = {"in.bad", "in.inner", "a.data"};
    ck_assert_ptr_nonnull(getcwd(folder, sizeof folder));
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) remove(files[i]);
    ck_assert_int_eq(chdir("/"), 0);
    /* a dry run writes nothing: the folder is empty */
    ck_assert_int_eq(rmdir(folder), 0);
}

START_TEST(untouched_decks_are_good)
{
    start();
    for (int i = 0; i < N_DECKS; ++i) {
        const hs_error err = try_deck(decks[i], strlen(decks[i]));
        ck_assert_msg(err.status == HS_OK || i == DECK_WITH_ERRORS, "deck %d: %s:%ld: %s", i, err.file, err.line,
                      err.text);
    }
    finish();
}
END_TEST

START_TEST(changed_decks_do_not_crash)
{
    static size_t (*const changes[])(char *, size_t) = {cut, change, insert, drop_words, replace_words, copy_word};
    static char bytes[2 * ROOM];
    const int n_each = setting("HALFSHELL_HOSTILE_DECKS", 25);
    start();
    for (int k = 0; k < n_each; ++k)
        for (int i = 0; i < N_DECKS; ++i)
            for (size_t c = 0; c < sizeof changes / sizeof changes[0]; ++c) {
                size_t n = strlen(decks[i]);
                memcpy(bytes, decks[i], n);
                n = changes[c](bytes, n);
                (void)try_deck(bytes, n);
            }
    finish();
}
END_TEST

START_TEST(changed_data_files_do_not_crash)
{
    static size_t (*const changes[])(char *, size_t) = {cut, change, insert, drop_words, replace_words, copy_word};
    static char bytes[2 * ROOM];
    const int n_each = setting("HALFSHELL_HOSTILE_DECKS", 25);
    start();
    for (int k = 0; k < n_each; ++k)
        for (size_t c = 0; c < sizeof changes / sizeof changes[0]; ++c) {
            size_t n = sizeof data_file - 1;
            memcpy(bytes, data_file, n);
            n = changes[c](bytes, n);
            write_file("a.data", bytes, n);
            (void)try_deck(decks[N_DECKS - 1], strlen(decks[N_DECKS - 1]));
        }
    finish();
}
END_TEST

START_TEST(random_bytes_do_not_crash)
{
    static char bytes[ROOM];
    const int n_each = setting("HALFSHELL_HOSTILE_DECKS", 25);
    start();
    for (int k = 0; k < 4 * n_each; ++k) {
        const size_t n = draw(ROOM);
        for (size_t i = 0; i < n; ++i) bytes[i] = (char)draw(256);
        (void)try_deck(bytes, n);
    }
    finish();
}
END_TEST

HS_TEST_MAIN("hostile decks", untouched_decks_are_good, changed_decks_do_not_crash, changed_data_files_do_not_crash,
             random_bytes_do_not_crash)
