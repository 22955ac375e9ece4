/* options.h: table-driven command lines. You list each option's name, value kind, range, destination and purpose in a
 * table of the verb; the table drives both the parser and the help. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "../../platform/host/pool.h"
#include "report.h"

/* Kinds of value, and the type that each is stored as. */
enum {
    OPTION_END,     /* of the rows */
    OPTION_TITLE,   /* no option: a heading of the help, in `help` */
    OPTION_HELP,    /* --help and --version: the verb does not run */
    OPTION_VERSION,
    OPTION_QUIET,   /* int: 1; mutually exclusive */
    OPTION_VERBOSE,
    OPTION_FLAG,    /* int: 1, without a value; or stored by `parse` */
    OPTION_TEXT,    /* const char *, not empty */
    OPTION_INT,     /* int32_t within low .. high */
    OPTION_POWER_OF_2,
    OPTION_MULTIPLE_OF_8,
    OPTION_NUMBER,  /* float within low .. high */
    OPTION_ABOVE,   /* float over low, at most high */
    OPTION_NUMBERS, /* `size` floats within low .. high, with commas between */
    OPTION_WORD,    /* int32_t: the value of one of `words` */
    OPTION_POINT,   /* lmb_vec3: X,Y,Z */
    OPTION_LIGHT,   /* lmb_light; stores the size at `sizes` */
    OPTION_BACKEND, /* const lmb_kernels * */
    OPTION_KEYS,    /* KEY=VALUE[,KEY=VALUE ...]: the rows `NAME KEY` of the same table store the values */
    OPTION_OWN      /* stored by `parse` */
};

/* The help text of a row. A build that cannot print help may omit it: it is a third of the web page's text. */
#if defined(OPTIONS_WITHOUT_HELP)
#define HELP(text) ""
#else
#define HELP(text) (text)
#endif

typedef struct option_row {
    const char *name; /* "--size"; "--group block": the key `block` of an OPTION_KEYS row `--group`; without dashes: a
                            positional argument, in the order of the rows */
    const char *brief;   /* "-h", or NULL */
    const char *value;   /* placeholder behind the name in the help: "WxH"; NULL: depends on the kind */
    int kind;
    size_t at;           /* offset of the value in the verb's struct */
    size_t counts;       /* offset of an int32_t: number of occurrences; 0: not counted */
    int32_t times;       /* most occurrences, values stored one after the other; 0: once */
    size_t size;         /* of each value; OPTION_NUMBERS: their number */
    size_t sizes;        /* offset of a float per light: the size; 0: no size allowed */
    size_t nones;        /* offset of an int for a light: 1 if the value is `none`; 0: `none` is not allowed */
    double low, high;
    const char *const *words; /* ends with NULL */
    const char *const *gone;  /* words of earlier versions, each followed by the replacement; ends with NULL */
    const int32_t *values;    /* of the words; NULL: their indices */
    int file;              /* OPTION_READS, OPTION_WRITES: the text names a file; 0: it does not */
    int (*parse)(const char *text, void *at); /* returns 1, or 0 if the text is invalid */
    const char *expects;   /* the expected value; NULL: from kind and range */
    const char *help;    /* wrapped when printed; keeps line breaks */
} option_row;

enum { OPTION_READS = 1, OPTION_WRITES };

enum { OPTION_PARTS = 12, OPTION_ROWS = 96 };

typedef struct option_table {
    const char *verb;     /* "relief bake" */
    const char *usage;    /* text after the program's name, one line each */
    const char *about;    /* paragraphs */
    const option_row *part[OPTION_PARTS]; /* rows up to OPTION_END; NULL after the last part. OPTION_ROWS in all */
    const char *examples; /* lines, printed unchanged */
    const char *status;   /* the meaning of each exit status; NULL: the usual three */
} option_table;

/* Results of options_parse. */
enum { OPTIONS_BAD, OPTIONS_RUN, OPTIONS_ASK_HELP, OPTIONS_ASK_VERSION };

/* options_parse: `out` is the verb's struct with defaults set; argv[0] is the verb. Accepts `--name value` and
 * `--name=value`; after `--` nothing is an option. OPTIONS_BAD: `r` has the reason. */
int options_parse(void *out, const option_table *t, int argc, char **argv, report *r);

/* options_files: call it before the work: checks that every output is writable, no output is also an input, and no
 * two outputs are the same. `out`: filled by options_parse. Returns 1, or 0 with `r` set. If you call it again after
 * models are read, it includes the files that these refer to. */
int options_files(const void *out, const option_table *t, report *r);

/* options_answer: prints the help, version or error if options_parse did not return OPTIONS_RUN; returns the exit
 * status. */
int options_answer(int asked, const option_table *t, const report *r);
int options_answer_to(FILE *out, FILE *err, int asked, const option_table *t, const report *r);

void options_help(FILE *out, const option_table *t);

/* options_man: prints the help as part of a man page. options_form: selects the form that OPTIONS_ASK_HELP prints. */
void options_man(FILE *out, const option_table *t);
void options_form(int is_man);
void options_version(FILE *out);

/* options_find: the row for a word, with or without `=value`; NULL if there is none. */
const option_row *options_find(const option_table *t, const char *word);

/* options_words: the number of argv words for an option: 2, or 1 if it contains the value or needs none. */
int options_words(const option_row *row, const char *word);

/* options_exclude: whether two options exclude each other, because they store to the same place; so do quiet and
 * verbose. */
int options_exclude(const option_row *a, const option_row *b);

/* options_unknown: reports an unknown option in `r`, with the most similar one. Returns 0. */
int options_unknown(const option_table *const *tables, int count, const char *word, report *r);

/* options_nearest: the name most similar to the word; NULL if none is similar. Numbers do not count as names.
 * `names` ends with NULL. */
const char *options_nearest(const char *const *names, const char *word);

/* options_distance: edit distance: letters to change, insert, delete or swap with the next to turn `a` into `b`.
 * Each may have 40 letters; over 40 if one has more. */
int options_distance(const char *a, const char *b);

/* options_limit_by: sets the function that --time-limit calls. It returns 1, or 0 if no limit can be set. If it is not
 * set, the option is parsed but has no effect, for example in tests. */
void options_limit_by(int (*limit)(double seconds));

/* `parse` functions of the rows below. */
int options_time_limit(const char *text, void *at);
int options_only_here(const char *text, void *at);

/* Rows shared by several tables. */
#define OPTION_TIME_LIMIT                                                                                   \
    {.name = "--time-limit", .value = "SECONDS", .kind = OPTION_OWN, .parse = options_time_limit,           \
     .expects = "seconds, over 0, at most 1e7",                                                             \
     .help = HELP("after this time, exit with status 1 and remove the files that this command has written")}
#define OPTION_ONLY_HERE                                                                                    \
    {.name = "--only-here", .kind = OPTION_FLAG, .parse = options_only_here,                                \
     .help = HELP("a file may only refer to files in or below its own folder, not by an absolute path, by .. or "   \
                  "by a link that leaves it; other files count as missing. A file that is itself such a link is " \
                  "refused. Use it for files from strangers")}
#define OPTION_ASK                                                                                          \
    {.name = "--help", .brief = "-h", .kind = OPTION_HELP, .help = HELP("print this text")},                      \
    {.name = "--version", .brief = "-V", .kind = OPTION_VERSION, .help = HELP("print the version of lambent")}
#define OPTION_LOUDNESS(type, quiet, verbose, more)                                                         \
    OPTION_TIME_LIMIT,                                                                                      \
    {.name = "--quiet", .brief = "-q", .kind = OPTION_QUIET, .at = offsetof(type, quiet),                   \
     .help = HELP("print only errors")},                                                                   \
    {.name = "--verbose", .brief = "-v", .kind = OPTION_VERBOSE, .at = offsetof(type, verbose), .help = HELP(more)}
#define OPTION_THREADS_ROW(type, threads, what)                                                             \
    {.name = "--threads", .value = "N", .kind = OPTION_INT, .at = offsetof(type, threads), .low = 1, .high = POOL_MAX, \
     .help = HELP("threads that " what "; the bytes are the same with any number (default: one per processor)")}
#define OPTION_TONE_ROW(type, tone)                                                                         \
    {.name = "--tone", .kind = OPTION_WORD, .at = offsetof(type, tone), .words = option_tones,              \
     .help = HELP("light over white in display formats: compressed by a curve (default), or clipped")}
#define OPTION_VERTEX_COLOURS_ROW(type, colours)                                                            \
    {.name = "--vertex-colours", .kind = OPTION_WORD, .at = offsetof(type, colours), .words = option_vertex_colours, \
     .help = HELP("vertex colours of OBJ and PLY: sRGB codes, as most programs write (default), or linear light")}
#define OPTION_BACKEND_ROW(type, kernels)                                                                   \
    {.name = "--backend", .value = "NAME", .kind = OPTION_BACKEND, .at = offsetof(type, kernels),           \
     .help = HELP("instruction set to draw with; all give the same bytes (default: the fastest of this processor)")}

#endif
