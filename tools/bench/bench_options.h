/* bench_options.h: the command line of `lambent-bench SCENE`, and of relight, relief and mix. */
#ifndef BENCH_OPTIONS_H
#define BENCH_OPTIONS_H

#include "../common/slice_items.h"
#include "bench_subject.h"

enum { BENCH_SWEEPS = 4, BENCH_VALUES = 64 };

/* --sweep NAME=V,V,...: an option of the subject's verb. */
typedef struct bench_range {
    char name[40];                  /* with dashes */
    char text[BENCH_WORDS];         /* the values, each with a terminating 0 */
    const char *value[BENCH_VALUES];
    int count;
} bench_range;

typedef struct bench_options {
    const bench_subject *subject;
    const char *html, *csv, *json, *svg; /* NULL: not requested */
    const char *truth, *cache;     /* NULL: the subject's; the default folder */
    char *given[BENCH_ARGS];       /* the options for the subject, as given */
    int given_count;
    bench_range range[BENCH_SWEEPS];
    int ranges;
    int32_t runs, breakdown; /* breakdown: one band in this many; 0: none */
    int is_quiet, is_verbose;
    const char *out;      /* of -o; NULL: not given */
    char names[3][1024];  /* of the files for -o */
    slice slice;          /* count 0: all settings */
} bench_options;

/* bench_options_table: the table of the sweep's options. */
void bench_options_table(option_table *out, const bench_subject *subject);

/* bench_options_parse: like options_parse, but argv[0] is the subject, or the first word for it. */
int bench_options_parse(bench_options *out, const bench_subject *subject, int argc, char **argv, report *r);

/* bench_options_line: the subject's verb with the given options, at the size of `like`, or if you pass NULL, at the
 * default size. */
int bench_options_line(bench_line *out, const bench_options *o, const image *like, report *r);

#endif
