/* verb_relight.c: `lambent relight`: the light at a place of a world that was seen from another, and objects in it. */
#include "verb_relight.h"

#include <stdio.h>
#include <stdlib.h>

#include "picture.h"
#include "relight_draw.h"
#include "relight_light.h"

/* Planes as a picture. */
static int write_planes(const char *path, const float *planes, int32_t width, int32_t height, report *r)
{
    const size_t pixels = (size_t)width * (size_t)height;
    image out = {width, height, 3, malloc(3 * pixels * sizeof(float))};
    if (out.pixels == NULL) {
        return report_fail(r, "%s: out of memory", path);
    }
    for (size_t i = 0; i < 3 * pixels; ++i) {
        out.pixels[i] = planes[i % 3 * pixels + i / 3];
    }
    const int ok = picture_write(path, &out, picture_auto_exposure(&out), r);
    image_free(&out);
    return ok;
}

static int can_write(const relight_options *o, report *r)
{
    const char *const paths[] = {o->cube, o->map, o->path == NULL ? o->out : NULL};
    for (int i = 0; i < 3; ++i) {
        if (paths[i] != NULL && !file_can_write(paths[i], r)) {
            return 0;
        }
    }
    return 1;
}

/* Of the one place that was asked for; with an object, of its middle. */
static int write_light(relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    return relight_light_at(w, o, at, o->faces, r) &&
           (o->map == NULL || write_planes(o->map, w->map, RELIGHT_WIDTH, RELIGHT_HEIGHT, r)) &&
           (o->cube == NULL || write_planes(o->cube, w->cube, o->faces, 6 * o->faces, r));
}

static int relight(relight_light *w, relight_options *o, report *r)
{
    lmb_vec3 at = o->at[0];
    if (!can_write(o, r) || !relight_light_make(w, o, r) || (o->object != NULL && !relight_draw(&at, w, o, r))) {
        return 0;
    }
    return (o->cube == NULL && o->map == NULL) || write_light(w, o, at, r);
}

int verb_relight(int argc, char **argv)
{
    report r = {""};
    relight_options o;
    if (!relight_options_parse(&o, argc, argv, &r)) {
        return report_end(&r, "relight", 2);
    }
    if (o.help) {
        for (int i = 0; i < RELIGHT_USAGE_PARTS; ++i) {
            fputs(relight_usage[i], stdout);
        }
        return 0;
    }
    relight_light *w = calloc(1, sizeof *w);
    const int ok = w != NULL ? relight(w, &o, &r) : report_fail(&r, "out of memory");
    if (w != NULL) {
        relight_light_free(w);
        free(w);
    }
    return ok ? 0 : report_end(&r, "relight", 1);
}
