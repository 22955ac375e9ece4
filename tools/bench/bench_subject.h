/* bench_subject.h: what can be swept: how one setting of it is drawn and timed, and what is tried by default. */
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
    char words[BENCH_WORDS]; /* those that were added */
    size_t used;
    const option_table *table; /* NULL: words are words */
} bench_line;

/* bench_line_put: a word. bench_line_add: the words of a text, with spaces between. An option that counts once takes
 * the place of what the line has of it. 0 where they are too many. bench_line_with: another line with them, or 0 with
 * `r` set; it borrows the first one's words. */
int bench_line_put(bench_line *line, char *word);
int bench_line_add(bench_line *line, const char *text);
int bench_line_with(bench_line *out, const bench_line *line, const char *text, report *r);

/* bench_line_say: as a shell takes it, behind `lambent`. */
void bench_line_say(char *out, size_t size, const bench_line *line);

/* A setting drawn and timed. bench_shot_free releases it. */
typedef struct bench_shot {
    image picture;  /* linear light, 3 channels */
    float *surface; /* 3 floats a pixel, the third over 0.5 where errors count; NULL: everywhere */
    double stage_s[BENCH_STAGES], instructions, bytes, work;
    int threads;
} bench_shot;
void bench_shot_free(bench_shot *s);

/* How a setting is to be measured. */
typedef struct bench_way {
    int runs;  /* after one that warms up; 0: none is timed */
    int every; /* one band in so many; 0, 1: all */
} bench_way;

/* bench_repeat: `once` as often as `way` says (what takes milliseconds more often), or until BENCH_ENOUGH_S have
 * passed, and of each stage the least time.
 * Returns what failed first: 1, or 0 with `r` set. */
#define BENCH_ENOUGH_S 3.0
typedef int (*bench_once)(void *user, double stage_s[BENCH_STAGES], report *r);
int bench_repeat(bench_shot *shot, const bench_way *way, bench_once once, void *user, report *r);

/* What is tried: words behind the settings at hand. */
enum { BENCH_OTHER = 1, /* another picture than the truth is of */
       BENCH_SAME = 2   /* must be the first one's, byte for byte */ };
typedef struct bench_try {
    const char *option, *words;
    double weight; /* about how long it takes */
    int flags;
} bench_try;

/* A stage made exact by `words`; it is already where nothing on the line is called `by` (NULL: never). */
typedef struct bench_exact {
    const char *stage, *words, *by;
} bench_exact;

typedef struct bench_subject {
    const char *verb;                 /* and what is said before anything that is given */
    const char *size, *usual_size;    /* `--size %dx%d`, for a truth's; where none is given. NULL: has none */
    const char *output;               /* words that a command line is not whole without, behind what is given */
    const option_table *table;        /* the verb's options */
    const char *refused;              /* options that make no sense here, with spaces around each */
    const char *const *stages;        /* to NULL */
    const char *work;
    const bench_try *tries;
    int try_count;
    int backends;                     /* 1: each that this processor has, behind the tries */
    const bench_exact *exact;         /* for the breakdown, in order; all of them: as `truth`. NULL: none */
    int exact_count;
    const char *usage, *about, *examples;
    const char *truth_is;
    const char *hurry;                /* `--threads %d`: for what is not timed; NULL: nothing helps */
    void (*say)(char *out, size_t size, const bench_line *line); /* the commands of a setting; NULL: bench_line_say */
    /* check: does the command line make sense? draw: 1, or 0 with `r` set and nothing allocated. truth: the same of the
     * settings at hand, as exact as can be: `truth_is`. hash: of all that it depends on; NULL: it is not kept. */
    int (*check)(const bench_line *line, report *r);
    int (*draw)(bench_shot *out, const bench_line *line, const bench_way *way, report *r);
    int (*truth)(bench_shot *out, const bench_line *line, report *r);
    int (*hash)(uint64_t *out, const bench_line *line, report *r);
} bench_subject;

/* bench_line_hurry: by all processors. */
int bench_line_hurry(bench_line *line, const bench_subject *subject);

/* bench_results_about: the names of the subject's stages, and those of figures. */
void bench_results_about(bench_results *b, const bench_subject *s);

extern const bench_subject bench_render, bench_relight, bench_figures, bench_relief, bench_mixed;

#endif
