/* lambent.c: the command line: finds the verb. */
#include <stdio.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../common/options.h"
#include "../bake/verb_bake.h"
#include "../bench/verb_bench.h"
#include "verb_compare.h"
#include "verb_info.h"
#include "../mix/verb_mix.h"
#include "verb_plan.h"
#include "../play/verb_play.h"
#include "../relight/verb_relight.h"
#include "../relief/verb_relief.h"
#include "../render/verb_render.h"

static const struct verb {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *usage, *help; /* lines, as many of each */
} verbs[] = {
    {"render", verb_render, "render SCENE -o OUT",
     "draw a scene (.gltf .glb .obj .ply, or `demo`) with bounced light"},
    {"bake", verb_bake, "bake SCENE -o OUT.lmt", "how light goes between a scene's surfaces, for lights that move"},
    {"play", verb_play, "play SCENE --frames N", "frames with moving light, camera or objects, and what they take"},
    {"relight", verb_relight, "relight --world WORLD", "light at a place of a world seen from another, as a cube map"},
    {"relief", verb_relief, "relief bake|render", "a complex model as a simple one that carries its surface"},
    {"mix", verb_mix, "mix --frame PHOTO", "a virtual object in one photo with depth"},
    {"plan", verb_plan, "plan SCENE", "what a picture takes and does without, why, work and memory"},
    {"compare", verb_compare, "compare A B", "error figures of a picture against a reference"},
    {"info", verb_info, "info FILE", "what is in a scene or a picture"},
    {"bench", verb_bench, "bench SCENE", "speed against error: what each setting costs and buys"},
    {"bench", verb_bench, "bench raster|gather|hard",
     "how fast this machine draws and lights; what renderers get wrong"},
};
enum { VERBS = sizeof verbs / sizeof *verbs };

static void print_usage(void)
{
    fputs("usage: lambent VERB ...\n\n", stdout);
    for (int i = 0; i < VERBS; ++i) {
        printf("  %-25s %s\n", verbs[i].usage, verbs[i].help);
    }
    fputs("\n"
          "  lambent VERB --help       what a verb takes\n"
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
    fprintf(stderr, meant != NULL ? "lambent: there is no verb `%s`; did you mean %s?\n"
                                  : "lambent: there is no verb `%s`; lambent --help lists them\n", argv[1], meant);
    return 2;
}

int main(int argc, char **argv)
{
    host_outlive_file_limit();
    if (lmb_build_check() != LMB_OK) {
        fputs("lambent: this build does not compute like others (contraction, fast math or flushed denormals): pixels "
              "would differ; build with the Makefile's flags\n", stderr);
        return 1;
    }
    if (argc >= 2 && (is_one_of(argv[1], "--help", "-h") || strcmp(argv[1], "help") == 0)) {
        print_usage();
        return 0;
    }
    if (argc >= 2 && is_one_of(argv[1], "--version", "-V")) {
        options_version(stdout);
        return 0;
    }
    return run(argc, argv);
}
