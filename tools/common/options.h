/* options.h: command lines by table. A verb's table says each option's name, kind of value, range, where the value goes
 * and what it is for: command lines are read by it, and the help is printed from it. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "../../platform/host/pool.h"
#include "report.h"

/* What kind of value, and what it is stored as. */
enum {
    OPTION_END,     /* of the rows */
    OPTION_TITLE,   /* no option: a heading of the help, `help` */
    OPTION_HELP,    /* --help and --version: the verb is not run */
    OPTION_VERSION,
    OPTION_QUIET,   /* int: 1. They exclude each other */
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
    OPTION_LIGHT,   /* lmb_light; its size to `sizes` */
    OPTION_BACKEND, /* const lmb_kernels * */
    OPTION_OWN      /* `parse` stores it */
};

/* A row's help, which a build may leave out where nobody can ask for it: it is a third of a page's text. */
#if defined(OPTIONS_WITHOUT_HELP)
#define HELP(text) ""
#else
#define HELP(text) (text)
#endif

typedef struct option_row {
    const char *name;    /* "--size"; without dashes: a word that is no option, in the order of the rows */
    const char *brief;   /* "-h", or NULL */
    const char *value;   /* what the help puts behind the name: "WxH"; NULL: by the kind */
    int kind;
    size_t at;           /* of the value, from the beginning of the verb's struct */
    size_t counts;       /* of an int32_t: how often it was given; 0: nobody asks */
    int32_t times;       /* how often it may be given, values one behind the other; 0: once */
    size_t size;         /* of each of those values; OPTION_NUMBERS: how many */
    size_t sizes;        /* of a float for each light: how wide it is; 0: it may have no size */
    size_t nones;        /* of an int for a light: 1 where the value is `none`; 0: no light is none */
    double low, high;
    const char *const *words; /* ends with NULL */
    const int32_t *values;    /* of the words; NULL: their places */
    int file;              /* of a text: OPTION_READS, OPTION_WRITES: it names a file; 0: it does not */
    int (*parse)(const char *text, void *at); /* 1, or 0 where the text is none */
    const char *expects;   /* what the value has to be; NULL: by kind and range */
    const char *help;    /* one text, folded where it is printed; a line break stays */
} option_row;

enum { OPTION_READS = 1, OPTION_WRITES };

enum { OPTION_PARTS = 10, OPTION_ROWS = 96 };

typedef struct option_table {
    const char *verb;     /* "relief bake" */
    const char *usage;    /* what follows `lambent `, a line each */
    const char *about;    /* paragraphs */
    const option_row *part[OPTION_PARTS]; /* rows up to OPTION_END; then NULL. OPTION_ROWS in all */
    const char *examples; /* lines as they are printed */
    const char *status;   /* what each exit status means; NULL: the usual three */
} option_table;

/* What a command line asks for. */
enum { OPTIONS_BAD, OPTIONS_RUN, OPTIONS_ASK_HELP, OPTIONS_ASK_VERSION };

/* options_parse: `out` is the verb's struct, set to what holds where an option is not given; argv[0] is the verb.
 * `--name value` or `--name=value`; behind `--` nothing is an option. OPTIONS_BAD: `r` says why. */
int options_parse(void *out, const option_table *t, int argc, char **argv, report *r);

/* options_files: before the work: can every file be written that is to be, is none of them one that is read, and no two
 * the same? `out` is what options_parse filled. 1, or 0 with `r` set. A second time, once models are read, it knows what
 * they have beside them. */
int options_files(const void *out, const option_table *t, report *r);

/* options_answer: what is to be done where OPTIONS_RUN was not the answer; returns the exit status. */
int options_answer(int asked, const option_table *t, const report *r);
int options_answer_to(FILE *out, FILE *err, int asked, const option_table *t, const report *r);

void options_help(FILE *out, const option_table *t);

/* options_man: the same as a part of a man page. options_form: which of both OPTIONS_ASK_HELP is answered with. */
void options_man(FILE *out, const option_table *t);
void options_form(int is_man);
void options_version(FILE *out);

/* options_find: the row that a word names, with its value or without; NULL where there is none. */
const option_row *options_find(const option_table *t, const char *word);

/* options_words: how many words of argv the option at hand takes: 2, or 1 where its value is in it or it has none. */
int options_words(const option_row *row, const char *word);

/* options_exclude: options that say one thing in two ways, as they store it in one place; quiet and verbose do, too. */
int options_exclude(const option_row *a, const option_row *b);

/* options_unknown: `r` says that there is no such option, and which one may be meant. Returns 0. */
int options_unknown(const option_table *const *tables, int count, const char *word, report *r);

/* options_nearest: the name that is most like the word; NULL where none is like it. Numbers are no names. `names` ends with NULL. */
const char *options_nearest(const char *const *names, const char *word);

/* options_distance: how many letters are to be changed, put in, left out or exchanged with the next one to make `a` of
 * `b`, which may each have 40; over 40 where they have more. */
int options_distance(const char *a, const char *b);

/* options_limit_by: sets the function that --time-limit calls. It returns 1, or 0 if no limit can be set. If it is not
 * set, the option is parsed but has no effect, for example in tests. */
void options_limit_by(int (*limit)(double seconds));

/* `parse` functions of the rows below. */
int options_time_limit(const char *text, void *at);
int options_only_here(const char *text, void *at);

/* Rows that several tables have. */
#define OPTION_TIME_LIMIT                                                                                   \
    {.name = "--time-limit", .value = "SECONDS", .kind = OPTION_OWN, .parse = options_time_limit,           \
     .expects = "seconds, over 0, at most 1e7",                                                             \
     .help = HELP("after this time, exit with status 1 and remove the files that this command has written")}
#define OPTION_ONLY_HERE                                                                                    \
    {.name = "--only-here", .kind = OPTION_FLAG, .parse = options_only_here,                                \
     .help = HELP("a file may only refer to files in or below its own folder, not by an absolute path, by .. or "   \
                  "by a link that leaves it; other files count as missing. Use it for files from strangers")}
#define OPTION_ASK                                                                                          \
    {.name = "--help", .brief = "-h", .kind = OPTION_HELP, .help = HELP("this text")},                            \
    {.name = "--version", .brief = "-V", .kind = OPTION_VERSION, .help = HELP("the version of lambent")}
#define OPTION_LOUDNESS(type, quiet, verbose, more)                                                         \
    OPTION_TIME_LIMIT,                                                                                      \
    {.name = "--quiet", .brief = "-q", .kind = OPTION_QUIET, .at = offsetof(type, quiet),                   \
     .help = HELP("say nothing but errors")},                                                                     \
    {.name = "--verbose", .brief = "-v", .kind = OPTION_VERBOSE, .at = offsetof(type, verbose), .help = HELP(more)}
#define OPTION_THREADS_ROW(type, threads, what)                                                             \
    {.name = "--threads", .value = "N", .kind = OPTION_INT, .at = offsetof(type, threads), .low = 1, .high = POOL_MAX, \
     .help = HELP(what " at once; it has the same bytes by any number (default: the processors)")}
#define OPTION_TONE_ROW(type, tone)                                                                         \
    {.name = "--tone", .kind = OPTION_WORD, .at = offsetof(type, tone), .words = option_tones,              \
     .help = HELP("how display formats show light over white: by a curve that keeps it apart (default), or clipped")}
#define OPTION_VERTEX_COLOURS_ROW(type, colours)                                                            \
    {.name = "--vertex-colours", .kind = OPTION_WORD, .at = offsetof(type, colours), .words = option_vertex_colours, \
     .help = HELP("vertex colours of OBJ and PLY: sRGB codes, as most programs write (default), or linear light")}
#define OPTION_BACKEND_ROW(type, kernels)                                                                   \
    {.name = "--backend", .value = "NAME", .kind = OPTION_BACKEND, .at = offsetof(type, kernels),           \
     .help = HELP("whose instructions draw: the same bytes by any (default: the fastest that this processor has)")}

#endif
