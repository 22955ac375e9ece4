/* bench_results.h: the results of a sweep: settings with time and error, the front, and the error breakdowns. */
#ifndef BENCH_RESULTS_H
#define BENCH_RESULTS_H

#include <stddef.h>
#include <stdint.h>

enum { BENCH_STAGES = 9, BENCH_FIGURES = 8, BENCH_ROWS = 8, BENCH_BREAKDOWNS = 4, BENCH_NAME = 96,
       BENCH_COMMAND = 1024, BENCH_POINTS = 256 };

/* Three codes per pixel, rows from the top; the report owns them. */
typedef struct bench_picture {
    int32_t width, height;
    uint8_t *rgb; /* NULL: none */
} bench_picture;

/* One setting, measured. */
typedef struct bench_point {
    char option[32];         /* the option it changes; tables group points by option */
    char name[BENCH_NAME];   /* the settings that distinguish it */
    char command[BENCH_COMMAND];
    char failure[160];       /* why it could not be measured; "" */
    double stage_s[BENCH_STAGES], time_s;
    double instructions;     /* 0: not counted */
    double bytes;
    double work;             /* in the subject's unit */
    double figure[BENCH_FIGURES]; /* [0]: the front's; NaN: not available */
    int has_figures;         /* 0: another picture, without a truth here */
    int threads;             /* over 1: wall time, not processor time */
    int same;                /* the first point's picture: 1 byte for byte, 0 not, -1 not tested */
    int on_front, is_knee;
    int number;              /* of the setting in the whole sweep; -1: not measured here */
    bench_picture picture, heat;
} bench_point;

/* A chain of settings, each with one more stage made exact, up to the truth. */
typedef struct bench_row {
    char stage[40], to[BENCH_NAME];
    double square; /* of the step: mean square over mean truth square */
} bench_row;

typedef struct bench_breakdown {
    char name[BENCH_NAME];
    bench_row row[BENCH_ROWS];
    int rows;
    double total, sum; /* squares: of the setting's error, and of the rows; the difference is the interaction */
} bench_breakdown;

typedef struct bench_results {
    char title[256];    /* the subject */
    char truth[256];    /* the reference */
    char computer[256];
    char how[256];      /* how it was timed */
    const char *stage[BENCH_STAGES];    /* up to NULL */
    const char *figure[BENCH_FIGURES];  /* up to NULL */
    const char *figure_is[BENCH_FIGURES];
    const char *work;   /* the unit; NULL: none */
    int percent;        /* figure[0] is a share */
    bench_point *point;
    int count, cap;
    int settings;       /* of the whole sweep */
    uint64_t job;       /* hash of the sweep if these are a slice; 0: they are all */
    bench_breakdown breakdown[BENCH_BREAKDOWNS];
    int breakdowns;
    double breakdown_share; /* of the picture that the breakdowns use */
    bench_picture truth_picture;
    double seconds;     /* total time */
} bench_results;

/* bench_results_add: adds a point that is zero except for `same`; returns NULL if memory is short or there are
 * BENCH_POINTS. */
bench_point *bench_results_add(bench_results *b);
void bench_results_free(bench_results *b);

/* Numbers in few characters: "1.24 s", "83 ms", "67 MiB"; "3.1 %" or "0.031". */
void bench_say_time(char out[24], double s);
void bench_say_bytes(char out[24], double bytes);
void bench_say_figure(char out[24], const bench_results *b, int figure, double v);

#endif
