/* main_bench.c: the main function of `lambent-bench`: speed against error, speed of this computer, hard cases. */
#include <stdio.h>
#include <string.h>

#include "../bench/bench_merge.h"
#include "../bench/verb_bench.h"
#include "program.h"

static int run(int argc, char **argv)
{
    return argc > 1 && strcmp(argv[1], "merge") == 0 ? bench_merge(argc - 1, argv + 1) : verb_bench(argc, argv);
}

static void print_usage(void)
{
    static char name[] = "lambent-bench", ask[] = "--help";
    char *argv[] = {name, ask, NULL};
    verb_bench(2, argv);
}

static const char *const texts[][PROGRAM_TEXT_WORDS] = {
    {NULL},          {"SCENE", NULL},  {"relight", NULL}, {"relief", NULL}, {"mix", NULL},         {"raster", NULL},
    {"draw", NULL},  {"gather", NULL}, {"threads", NULL}, {"hard", NULL},   {"--calibrate", NULL}, {"merge", NULL},
};

static void print_synopsis(void)
{
    for (size_t i = 1; i < sizeof texts / sizeof *texts; ++i) {
        printf("lambent-bench %s ...\n", texts[i][0]);
    }
}

static const program bench = {
    .name = "lambent-bench",
    .title = "measures the speed and errors of lambent on this computer",
    .run = run,
    .print_usage = print_usage,
    .print_synopsis = print_synopsis,
    .texts = texts,
    .text_count = sizeof texts / sizeof *texts,
};

int main(int argc, char **argv) { return program_main(&bench, argc, argv); }
