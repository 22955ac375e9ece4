/* lambent.c: the command line: selects the verb. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../../platform/host/limit.h"
#include "../common/io_file.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../bake/verb_bake.h"
#include "../bench/verb_bench.h"
#include "../capture/verb_capture.h"
#include "verb_compare.h"
#include "verb_doctor.h"
#include "verb_info.h"
#include "verb_merge.h"
#include "../explain/verb_explain.h"
#include "../mix/verb_mix.h"
#include "../pack/verb_pack.h"
#include "verb_plan.h"
#include "../play/verb_play.h"
#include "../relight/verb_relight.h"
#include "../relief/verb_relief.h"
#include "../render/verb_render.h"

static const struct verb {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *usage, *help; /* same number of lines in each */
} verbs[] = {
    {"render", verb_render, "render SCENE -o OUT",
     "draw a scene (.gltf .glb .obj .ply, or `demo`) with bounced light"},
    {"bake", verb_bake, "bake SCENE -o OUT.lmt", "precompute light transport of a static scene, for moving lights"},
    {"pack", verb_pack, "pack SCENE -o OUT.lmp|.c", "convert a scene to one file, or C array, for use in place"},
    {"play", verb_play, "play SCENE --frames N", "render an animation of lights, camera or objects, and its cost"},
    {"merge", verb_merge, "merge SLICE... -o OUT", "join slices of a picture, frames, a bake or a sweep"},
    {"capture", verb_capture, "capture SCENE --at X,Y,Z", "capture a place of a scene as a world for `relight`"},
    {"relight", verb_relight, "relight --world WORLD", "light at a place of a world, from a cube map taken elsewhere"},
    {"relief", verb_relief, "relief bake|render", "draw a complex model as a simple one with the detailed surface"},
    {"mix", verb_mix, "mix --frame PREFIX", "put a virtual object into a photo with depth"},
    {"explain", verb_explain, "explain SCENE --pixel X,Y",
     "print why a pixel has its light: surface, lights, occluders, senders"},
    {"plan", verb_plan, "plan SCENE", "list the stages of a render, with estimated work and memory"},
    {"compare", verb_compare, "compare A B", "measure the error of a picture against a reference"},
    {"info", verb_info, "info FILE", "list the contents of a scene or a picture"},
    {"bench", verb_bench, "bench SCENE", "measure speed against error for each setting"},
    {"bench", verb_bench, "bench raster|draw|gather|hard",
     "measure speed of drawing and lighting; test hard cases"},
    {"doctor", verb_doctor, "doctor", "check that this build and its back ends draw correctly"},
};
enum { VERBS = sizeof verbs / sizeof *verbs };

static void print_usage(void)
{
    fputs("usage: lambent VERB ...\n\n", stdout);
    for (int i = 0; i < VERBS; ++i) {
        printf("  %-25s %s\n", verbs[i].usage, verbs[i].help);
    }
    fputs("\n"
          "  lambent help VERB         options of a verb, same as lambent VERB --help\n"
          "  lambent help --man        all help as a man page\n"
          "  lambent --version\n\n"
          "examples\n"
          "  lambent render demo -o demo.png\n", stdout);
}

static int is_one_of(const char *word, const char *a, const char *b)
{
    return strcmp(word, a) == 0 || strcmp(word, b) == 0;
}

static int run(int argc, char **argv)
{
    int best = 3;
    const char *meant = NULL;
    if (argc < 2) {
        fputs("lambent: no verb given; lambent --help lists them\n", stderr);
        return 2;
    }
    for (int i = 0; i < VERBS; ++i) {
        const int far = options_distance(argv[1], verbs[i].name);
        if (far == 0) {
            return verbs[i].run(argc - 1, argv + 1);
        }
        meant = far < best ? verbs[i].name : meant;
        best = far < best ? far : best;
    }
    if (meant != NULL) {
        report_print(stderr, "lambent: there is no verb `%s`; did you mean %s?\n", argv[1], meant);
    } else {
        report_print(stderr, "lambent: there is no verb `%s`; lambent --help lists them\n", argv[1]);
    }
    return 2;
}

/* --- help --------------------------------------------------------------------------------------------------------- */

/* All commands with a help text. */
static const char *const pages[][2] = {
    {"render", NULL},     {"bake", NULL},        {"pack", NULL},        {"play", NULL},
    {"merge", NULL},       {"capture", NULL},
    {"relight", NULL},
    {"relief", NULL},     {"relief", "bake"},    {"relief", "render"},  {"mix", NULL},
    {"plan", NULL},       {"compare", NULL},     {"info", NULL},        {"bench", NULL},
    {"bench", "SCENE"},   {"bench", "relight"},  {"bench", "relief"},   {"bench", "mix"},
    {"bench", "raster"},  {"bench", "draw"},    {"bench", "gather"},   {"bench", "threads"},  {"bench", "hard"},
    {"bench", "--calibrate"}, {"doctor", NULL},
};

enum { HELP_WORDS = 4 };

/* Prints help for these words, like VERB ... --help. */
static int help(int count, char **words)
{
    static char name[] = "lambent", ask[] = "--help";
    char *argv[HELP_WORDS + 3] = {name};
    int argc = 1;
    for (; argc <= count && argc <= HELP_WORDS; ++argc) {
        argv[argc] = words[argc - 1];
    }
    argv[argc++] = ask;
    argv[argc] = NULL;
    return run(argc, argv);
}

static int print_man(void)
{
    int status = 0;
    options_form(1);
    printf(".TH LAMBENT 1 \"\" \"lambent %d.%d.%d\" \"User Commands\"\n.SH NAME\n"
           "lambent \\- draws, measures and converts scenes with bounced light\n.SH SYNOPSIS\n.nf\n",
           LMB_VERSION / 10000, LMB_VERSION / 100 % 100, LMB_VERSION % 100);
    for (int i = 0; i < VERBS; ++i) {
        printf("lambent %s ...\n", verbs[i].usage);
    }
    fputs(".fi\n", stdout);
    for (size_t i = 0; i < sizeof pages / sizeof *pages && status == 0; ++i) {
        char words[2][16];
        char *both[2] = {words[0], words[1]};
        snprintf(words[0], sizeof words[0], "%s", pages[i][0]);
        snprintf(words[1], sizeof words[1], "%s", pages[i][1] != NULL ? pages[i][1] : "");
        status = help(pages[i][1] != NULL ? 2 : 1, both);
    }
    return status;
}

/* `lambent help`, `lambent --help`, with or without the words of a verb. */
static int answer_help(int argc, char **argv)
{
    if (argc > 2 && strcmp(argv[2], "--man") == 0) {
        return print_man();
    }
    if (argc > 2 && argv[2][0] != '-' && strcmp(argv[2], "help") != 0) {
        return help(argc - 2, argv + 2);
    }
    print_usage();
    return 0;
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

/* In a signal handler, before the program ends. */
static void clean_up(void)
{
    file_drop_aside();
    progress_wipe();
}

static char over_line[128];

/* Called by the thread of --time-limit. It holds the limit, so no file is being written. */
static void end_over(void)
{
    file_drop_aside();
    file_drop_written();
    progress_wipe();
    limit_tell(over_line);
}

static const char *verb_name;

static int limit(double seconds)
{
    snprintf(over_line, sizeof over_line,
             "lambent %.16s: --time-limit %g: the time is over; what this command has written is removed\n", verb_name,
             seconds);
    file_keep_names();
    if (!limit_time(seconds, end_over)) {
        fprintf(stderr, "lambent %.16s: --time-limit: the system gives no thread that could keep it\n", verb_name);
        exit(1);
    }
    return 1;
}

static int start(int argc, char **argv)
{
    if (argc >= 2 && (is_one_of(argv[1], "--help", "-h") || strcmp(argv[1], "help") == 0)) {
        return answer_help(argc, argv);
    }
    if (argc >= 2 && is_one_of(argv[1], "--version", "-V")) {
        options_version(stdout);
        return 0;
    }
    if (lmb_build_check() != LMB_OK && (argc < 2 || strcmp(argv[1], "doctor") != 0)) {
        fputs("lambent: this build does not compute like others (contraction, fast math or flushed denormals): pixels "
              "would differ; build with the Makefile's flags; lambent doctor tells more\n", stderr);
        return 1;
    }
    return run(argc, argv);
}

/* Buffered output may still meet a full disk. */
int main(int argc, char **argv)
{
    report r = {""};
    host_take_streams();
    host_outlive_file_limit();
    host_end_cleanly(clean_up);
    verb_name = argc >= 2 ? argv[1] : "";
    options_limit_by(limit);
    const int status = start(argc, argv);
    limit_end();
    file_keep_end();
    return status != 0 || report_flush(&r) ? status : report_end(&r, argc >= 2 ? argv[1] : "", 1);
}
