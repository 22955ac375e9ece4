/* lambent.c: the main function of `lambent`: selects the verb. */
#include <stdio.h>
#include <string.h>

#include "../common/options.h"
#include "../bake/verb_bake.h"
#include "../capture/verb_capture.h"
#include "verb_compare.h"
#include "verb_doctor.h"
#include "verb_info.h"
#include "verb_merge.h"
#include "../explain/verb_explain.h"
#include "../mix/verb_mix.h"
#include "../pack/verb_pack.h"
#include "program.h"
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
    {"merge", verb_merge, "merge SLICE... -o OUT", "join slices of a picture, of frames or of a bake"},
    {"capture", verb_capture, "capture SCENE --at X,Y,Z", "capture a place of a scene as a world for `relight`"},
    {"relight", verb_relight, "relight --world WORLD", "light at a place of a world, from a cube map taken elsewhere"},
    {"relief", verb_relief, "relief bake|render", "draw a complex model as a simple one with the detailed surface"},
    {"mix", verb_mix, "mix --frame PREFIX", "put a virtual object into a photo with depth"},
    {"explain", verb_explain, "explain SCENE --pixel X,Y",
     "print why a pixel has its light: surface, lights, occluders, senders"},
    {"plan", verb_plan, "plan SCENE", "list the stages of a render, with estimated work and memory"},
    {"compare", verb_compare, "compare A B", "measure the error of a picture against a reference"},
    {"info", verb_info, "info FILE", "list the contents of a scene or a picture"},
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
          "  lambent --version\n"
          "  lambent-bench --help      speed against error, speed of this computer, hard cases (make bench)\n\n"
          "examples\n"
          "  lambent render demo -o demo.png\n", stdout);
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
    if (strcmp(argv[1], "bench") == 0) {
        fputs("lambent: bench is the program lambent-bench: give it the same words; `make bench` builds it\n", stderr);
    } else if (meant != NULL) {
        report_print(stderr, "lambent: there is no verb `%s`; did you mean %s?\n", argv[1], meant);
    } else {
        report_print(stderr, "lambent: there is no verb `%s`; lambent --help lists them\n", argv[1]);
    }
    return 2;
}

/* All commands with a help text. */
static const char *const texts[][PROGRAM_TEXT_WORDS] = {
    {"render", NULL},     {"bake", NULL},        {"pack", NULL},        {"play", NULL},
    {"merge", NULL},      {"capture", NULL},     {"relight", NULL},     {"relief", NULL},
    {"relief", "bake"},   {"relief", "render"},  {"mix", NULL},         {"explain", NULL},
    {"plan", NULL},       {"compare", NULL},     {"info", NULL},        {"doctor", NULL},
};

static void print_synopsis(void)
{
    for (int i = 0; i < VERBS; ++i) {
        printf("lambent %s ...\n", verbs[i].usage);
    }
}

static const program lambent = {
    .name = "lambent",
    .title = "draws and converts scenes with bounced light",
    .has_verbs = 1,
    .run = run,
    .print_usage = print_usage,
    .print_synopsis = print_synopsis,
    .texts = texts,
    .text_count = sizeof texts / sizeof *texts,
};

int main(int argc, char **argv) { return program_main(&lambent, argc, argv); }
