/* lambent.c: the command line: finds the verb. */
#include <stdio.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../platform/host/host.h"
#include "verb_bench.h"
#include "verb_compare.h"
#include "verb_info.h"
#include "verb_mix.h"
#include "verb_plan.h"
#include "verb_relight.h"
#include "verb_relief.h"
#include "verb_render.h"

static const char usage[] =
    "usage: lambent VERB ...\n"
    "\n"
    "  render SCENE -o OUT      draw a scene (.gltf .glb .obj .ply, or the built-in `demo`) with bounced light\n"
    "  relight --world WORLD    the light at a place of a world that was seen from another, as a small cube map\n"
    "  relief bake|render       a complex model as a simple one that carries its surface\n"
    "  mix --frame PHOTO        a virtual object in one photo with depth\n"
    "  plan SCENE               what a picture takes and what it does without, why, work and memory\n"
    "  compare A B              error figures of a picture against a reference\n"
    "  info FILE                what is in a scene or a picture\n"
    "  bench SCENE              speed against error: what each setting costs and buys, as a table or an HTML page\n"
    "  bench raster             how fast this machine draws the fixed workload\n"
    "  bench gather             how fast groups light pixels, against what this machine can do\n"
    "  bench hard               what renderers get wrong, tried on this machine: a table of figures and bounds\n"
    "\n"
    "  lambent VERB --help      what a verb takes\n"
    "  lambent --version\n";

static const struct verb {
    const char *name;
    int (*run)(int argc, char **argv);
} verbs[] = {
    {"render", verb_render},   {"relight", verb_relight}, {"relief", verb_relief}, {"mix", verb_mix},
    {"plan", verb_plan},
    {"compare", verb_compare}, {"bench", verb_bench},     {"info", verb_info},
};

int main(int argc, char **argv)
{
    host_outlive_file_limit();
    if (lmb_build_check() != LMB_OK) {
        fputs("lambent: this build does not compute like others (contraction, fast math or flushed denormals): pixels "
              "would differ; build with the Makefile's flags\n", stderr);
        return 1;
    }
    for (size_t i = 0; argc >= 2 && i < sizeof verbs / sizeof *verbs; ++i) {
        if (strcmp(argv[1], verbs[i].name) == 0) {
            return verbs[i].run(argc - 1, argv + 1);
        }
    }
    if (argc >= 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "help") == 0 || strcmp(argv[1], "-h") == 0)) {
        fputs(usage, stdout);
        return 0;
    }
    if (argc >= 2 && strcmp(argv[1], "--version") == 0) {
        printf("lambent %d.%d.%d\n", LMB_VERSION / 10000, LMB_VERSION / 100 % 100, LMB_VERSION % 100);
        return 0;
    }
    if (argc >= 2) {
        fprintf(stderr, "lambent: there is no verb `%s`; lambent --help lists them\n", argv[1]);
    } else {
        fputs(usage, stderr);
    }
    return 2;
}
