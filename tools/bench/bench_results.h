/* bench_results.h: what a sweep found: settings with their time and error, the front of the best, and where the error
 * comes from. */
#ifndef BENCH_RESULTS_H
#define BENCH_RESULTS_H

#include <stddef.h>
#include <stdint.h>

enum { BENCH_STAGES = 9, BENCH_FIGURES = 8, BENCH_ROWS = 8, BENCH_BREAKDOWNS = 4, BENCH_NAME = 96,
       BENCH_COMMAND = 1024, BENCH_POINTS = 256 };

/* Three codes a pixel, rows from the top; the report owns them. */
typedef struct bench_picture {
    int32_t width, height;
    uint8_t *rgb; /* NULL: there is none */
} bench_picture;

/* One setting, measured. */
typedef struct bench_point {
    char option[32];         /* what it changes; points of one option stand together in tables */
    char name[BENCH_NAME];   /* the settings as they are told apart */
    char command[BENCH_COMMAND];
    char failure[160];       /* why it could not be measured; "" */
    double stage_s[BENCH_STAGES], time_s;
    double instructions;     /* 0: not counted */
    double bytes;
    double work;             /* the subject's own unit */
    double figure[BENCH_FIGURES]; /* [0]: the front's; NaN: this picture has none */
    int has_figures;         /* 0: a picture of something else, without a truth here */
    int threads;             /* over 1: time is what passed, not the processor's */
    int same;                /* as the first point's picture: 1 byte for byte, 0 not, -1 not asked */
    int on_front, is_knee;
    int number;              /* of the setting among all of the sweep; -1: not measured here */
    bench_picture picture, heat;
} bench_point;

/* A chain of settings, each with one stage more made exact, up to the truth. */
typedef struct bench_row {
    char stage[40], to[BENCH_NAME];
    double square; /* of the step: mean square over mean truth square */
} bench_row;

typedef struct bench_breakdown {
    char name[BENCH_NAME];
    bench_row row[BENCH_ROWS];
    int rows;
    double total, sum; /* squares: of the setting's error, and of the rows; their difference is the interaction */
} bench_breakdown;

typedef struct bench_results {
    char title[256];    /* what was measured */
    char truth[256];    /* against what */
    char computer[256];
    char how[256];      /* it was timed */
    const char *stage[BENCH_STAGES];    /* up to NULL */
    const char *figure[BENCH_FIGURES];  /* up to NULL */
    const char *figure_is[BENCH_FIGURES];
    const char *work;   /* its unit; NULL: none */
    int percent;        /* figure[0] is a share */
    bench_point *point;
    int count, cap;
    int settings;       /* of the whole sweep */
    uint64_t job;       /* of which these are a slice; 0: they are all */
    bench_breakdown breakdown[BENCH_BREAKDOWNS];
    int breakdowns;
    double breakdown_share; /* of the picture that the breakdowns looked at */
    bench_picture truth_picture;
    double seconds;     /* that all of it took */
} bench_results;

/* bench_results_add: a point that is zero but for `same`; NULL where memory is short or BENCH_POINTS are there. */
bench_point *bench_results_add(bench_results *b);
void bench_results_free(bench_results *b);

/* Numbers in few characters: "1.24 s", "83 ms", "67 MiB"; "3.1 %" or "0.031". */
void bench_say_time(char out[24], double s);
void bench_say_bytes(char out[24], double bytes);
void bench_say_figure(char out[24], const bench_results *b, int figure, double v);

#endif
