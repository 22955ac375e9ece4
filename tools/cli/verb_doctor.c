/* verb_doctor.c: `lambent doctor`: prints the build and its back ends, and checks that all draw the same bytes. */
#include "verb_doctor.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../common/options.h"
#include "../demo/demo_scene.h"
#include "build_flags.inc" /* BUILD_FLAGS, from the Makefile */

/* Hash of the built-in room, 96 x 72 in eight bits, with --quality draft. It changes when bounced light is changed
 * on purpose. */
#ifndef ROOM_HASH
#define ROOM_HASH UINT64_C(0xce8d9fb4c538158d)
#endif

enum { WIDTH = 96, HEIGHT = 72 };

typedef struct options {
    int is_quiet, is_verbose;
} options;

static const option_row rows[] = {
    OPTION_LOUDNESS(options, is_quiet, is_verbose, "print the flags that it was built with"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "doctor",
    .usage = "doctor [-q|-v]",
    .about = "Prints the version, the build and its back ends, and which of these draws here. Then draws a small "
             "picture with each, and checks that all have the same bytes as on every machine. If you report a bug, "
             "include this output.",
    .part = {rows},
    .examples = "  lambent doctor\n",
    .status = "exit status: 0 all is well, 1 something is not, 2 bad usage",
};

/* --- the picture -------------------------------------------------------------------------------------------------- */

static lmb_status draw_room(lmb_render *r, const lmb_frame_settings *s, void *block, size_t bytes)
{
    lmb_frame f;
    memset(r, 0, sizeof *r);
    const lmb_status status = lmb_frame_init(&f, s, block, bytes);
    return status == LMB_OK ? lmb_render_frame(r, &f) : status;
}

static int hash_room(uint64_t *hash, const lmb_kernels *kernels, report *r)
{
    static uint32_t picture[WIDTH * HEIGHT];
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.kernels = kernels;
    s.scene = demo_scene();
    s.view = demo_view(WIDTH, HEIGHT);
    s.quality = LMB_QUALITY_DRAFT;
    s.id_format = LMB_ID32;
    s.threads = 1;
    lmb_surface_init(&s.out, LMB_RGBA8, WIDTH, HEIGHT, picture, sizeof picture);
    const size_t bytes = lmb_frame_bytes(&s);
    void *block = malloc(bytes > 0 ? bytes : 1);
    lmb_render *render = malloc(sizeof *render);
    const int has_memory = block != NULL && render != NULL;
    const lmb_status status = has_memory ? draw_room(render, &s, block, bytes) : LMB_ERR_CAPACITY;
    *hash = lmb_surface_hash(&s.out);
    free(block);
    free(render);
    return status == LMB_OK || report_fail(r,
                                           has_memory ? "the built-in room cannot be drawn: %s"
                                                      : "not enough memory for the built-in room: %s",
                                           lmb_status_name(status));
}

/* --- output ------------------------------------------------------------------------------------------------------- */

#if defined(LMB_CONFIG_TINY)
#define CONFIGURATION "tiny"
#else
#define CONFIGURATION "default"
#endif

#if defined(__clang__)
#define COMPILER __VERSION__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "not known"
#endif

/* LINE: printf unless quiet. */
#define LINE(o, ...) ((o)->is_quiet ? 0 : printf(__VA_ARGS__))

static void tell_build(const options *o)
{
    char processor[128];
    host_processor(processor, sizeof processor);
    LINE(o, "lambent      %d.%d.%d, %s configuration\n", LMB_VERSION / 10000, LMB_VERSION / 100 % 100,
         LMB_VERSION % 100, CONFIGURATION);
    LINE(o, "compiler     %s\n", COMPILER);
    if (o->is_verbose) {
        LINE(o, "flags        %s\n", BUILD_FLAGS);
    }
    LINE(o, "processor    %s, threads: %d\n", processor[0] != '\0' ? processor : "not known", pool_processors());
}

static int check_arithmetic(const options *o, report *r)
{
    const int ok = lmb_build_check() == LMB_OK;
    LINE(o, "arithmetic   %s\n", ok ? "as it should be" : "WRONG: contraction, fast math or flushed denormals");
    return ok || report_fail(r, "this build does not compute like others; build with the Makefile's flags");
}

static int check_backend(const options *o, const char *name, report *r)
{
    const lmb_kernels *kernels = lmb_kernels_named(name);
    uint64_t hash = 0;
    if (kernels == NULL) {
        LINE(o, "%-12s not on this processor\n", name);
        return 1;
    }
    if (!hash_room(&hash, kernels, r)) {
        return 0;
    }
    LINE(o, "%-12s %s (%016" PRIx64 ")%s\n", name, hash == ROOM_HASH ? "exact" : "WRONG", hash,
         kernels == lmb_kernels_pick() ? ", draws where none is named" : "");
    return hash == ROOM_HASH || report_fail(r,
                                            "%s draws %016" PRIx64 " instead of %016" PRIx64 "; another compiler or "
                                            "-O level may do; please report it with what doctor -v says",
                                            name, hash, ROOM_HASH);
}

static int examine(const options *o, report *r)
{
    tell_build(o);
    int ok = check_arithmetic(o, r);
    const char *name;
    for (int32_t i = 0; (name = lmb_kernels_built(i)) != NULL; ++i) {
        ok = check_backend(o, name, r) && ok;
    }
    return ok;
}

int verb_doctor(int argc, char **argv)
{
    report r = {""};
    options o;
    memset(&o, 0, sizeof o);
    const int asked = options_parse(&o, &table, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    return examine(&o, &r) ? 0 : report_end(&r, "doctor", 1);
}
