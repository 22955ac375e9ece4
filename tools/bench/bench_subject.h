/* bench_subject.h: subjects of a sweep: how a setting is drawn and timed, and the default settings. */
#ifndef BENCH_SUBJECT_H
#define BENCH_SUBJECT_H

#include "../common/options.h"
#include "../common/report.h"
#include "../picture/image.h"
#include "bench_results.h"

enum { BENCH_ARGS = 96, BENCH_WORDS = 512 };

/* A verb's command line. */
typedef struct bench_line {
    char *argv[BENCH_ARGS];
    int argc;
    char words[BENCH_WORDS]; /* storage for added words */
    size_t used;
    const option_table *table; /* NULL: words are not parsed as options */
} bench_line;

/* bench_line_put: adds a word. bench_line_add: adds the words of a text, separated by spaces. An option that may be
 * given once replaces the one on the line. They return 0 if there are too many words. bench_line_with: copies a line
 * and adds words; returns 0 with `r` set on failure. The copy borrows the words of the first line. */
int bench_line_put(bench_line *line, char *word);
int bench_line_add(bench_line *line, const char *text);
int bench_line_with(bench_line *out, const bench_line *line, const char *text, report *r);

/* bench_line_say: writes the command for a shell, starting with `lambent`. */
void bench_line_say(char *out, size_t size, const bench_line *line);

/* A setting, drawn and timed. Release it with bench_shot_free; you may take the picture first. */
typedef struct bench_shot {
    image picture;  /* linear light, 3 channels */
    float *surface; /* 3 floats per pixel; errors count if the third is over 0.5; NULL: everywhere */
    double stage_s[BENCH_STAGES], instructions, bytes, work;
    int threads;
} bench_shot;
void bench_shot_free(bench_shot *s);

/* How to measure a setting. */
typedef struct bench_way {
    int runs;  /* after a warm-up run; 0: not timed */
    int every; /* one band in this many; 0, 1: all */
} bench_way;

/* bench_repeat: calls `once` as often as `way` specifies (more often if it takes only milliseconds), or until
 * BENCH_ENOUGH_S have passed, and keeps the shortest time of each stage. Returns 1, or 0 with `r` set at the first
 * failure. */
#define BENCH_ENOUGH_S 3.0
typedef int (*bench_once)(void *user, double stage_s[BENCH_STAGES], report *r);
int bench_repeat(bench_shot *shot, const bench_way *way, bench_once once, void *user, report *r);

/* A setting to try: words to add to the given settings. */
enum { BENCH_OTHER = 1, /* not the truth's picture */
       BENCH_SAME = 2   /* must equal the first one's, byte for byte */ };
typedef struct bench_try {
    const char *option, *words;
    double weight; /* approximate time */
    int flags;
} bench_try;

/* A stage made exact by `words`. It is already exact if the line has no option `by` (NULL: never). */
typedef struct bench_exact {
    const char *stage, *words, *by;
} bench_exact;

typedef struct bench_subject {
    const char *verb;                 /* the words before the given ones */
    const char *size, *usual_size;    /* `--size %dx%d`, for the truth's size; the default size. NULL: none */
    const char *output;               /* words that complete a command line, after the given ones */
    const option_table *table;        /* the verb's options */
    const char *refused;              /* options that are refused here, with spaces around each */
    const char *const *stages;        /* to NULL */
    const char *work;
    const bench_try *tries;
    int try_count;
    int backends;                     /* 1: also try all backends that this processor has, after the others */
    const bench_exact *exact;         /* for the breakdown, in order; all together equal `truth`. NULL: none */
    int exact_count;
    const char *usage, *about, *examples;
    const char *truth_is;
    const char *hurry;                /* `--threads %d`, for runs that are not timed; NULL: no such option */
    void (*say)(char *out, size_t size, const bench_line *line); /* the commands of a setting; NULL: bench_line_say */
    /* check: is the command line valid? draw: returns 1, or 0 with `r` set and nothing allocated. truth: the same, with
     * the given settings made as exact as possible: `truth_is`. hash: of everything that the truth depends on; NULL: it
     * is not cached. */
    int (*check)(const bench_line *line, report *r);
    int (*draw)(bench_shot *out, const bench_line *line, const bench_way *way, report *r);
    int (*truth)(bench_shot *out, const bench_line *line, report *r);
    int (*hash)(uint64_t *out, const bench_line *line, report *r);
} bench_subject;

/* bench_line_hurry: uses all processors. */
int bench_line_hurry(bench_line *line, const bench_subject *subject);

/* bench_results_about: sets the names of the subject's stages and figures. */
void bench_results_about(bench_results *b, const bench_subject *s);

extern const bench_subject bench_render, bench_relight, bench_figures, bench_relief, bench_mixed;

#endif
