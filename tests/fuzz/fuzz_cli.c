/* fuzz_cli.c: command lines: each line of the bytes is an argument; the first byte chooses the verb. */
#include <stdlib.h>
#include <string.h>

#include "../../tools/mix/mix_options.h"
#include "../../tools/relight/relight_options.h"
#include "../../tools/render/render_options.h"
#include "fuzz.h"

enum { ARGUMENTS = 64 };

typedef union options {
    render_options render;
    relight_options relight;
    mix_options mix;
} options;

/* Accepted values are within the ranges of the help. */
static void check_render(const render_options *o)
{
    fuzz_require(o->light_count <= RENDER_LIGHTS && o->threads >= 0 && o->shadow_map >= 0 && o->bounces >= 0);
    fuzz_require(o->view.width >= 0 && o->view.width <= LMB_MAX_SIDE && o->view.height <= LMB_MAX_SIDE);
    fuzz_require(o->error >= 0.0f && o->visibility >= 0.0f && o->stereo_m - o->stereo_m == 0.0f);
}

static int parse(options *out, int verb, int argc, char **argv, report *r)
{
    switch (verb) {
    case 0:
        return render_options_parse(&out->render, argc, argv, r);
    case 1:
        return relight_options_parse(&out->relight, argc, argv, r);
    default:
        return mix_options_parse(&out->mix, argc, argv, r);
    }
}

void fuzz_cli(const uint8_t *data, size_t size)
{
    static char name[] = "verb";
    static options out;
    char *argv[ARGUMENTS + 2] = {name}, *text;
    report r = {{0}};
    int argc = 1;
    if (size == 0 || (text = malloc(size)) == NULL) {
        return;
    }
    const int verb = data[0] % 3;
    memcpy(text, data + 1, size - 1);
    text[size - 1] = '\0';
    for (char *at = text; argc <= ARGUMENTS; ++at) {
        argv[argc++] = at;
        at = strchr(at, '\n');
        if (at == NULL) {
            break;
        }
        *at = '\0';
    }
    argv[argc] = NULL;
    const int asked = parse(&out, verb, argc, argv, &r);
    if (asked == OPTIONS_BAD) {
        fuzz_failed(&r, "");
    } else {
        fuzz_require(r.text[0] == '\0');
        if (verb == 0 && asked == OPTIONS_RUN) {
            check_render(&out.render);
        }
    }
    free(text);
}
