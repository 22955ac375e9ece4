/* light_stream.c: a tree of lights, for a sky, or for scenes with more lights than shadow maps. */
#include "light_stream.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"

void light_stream_free(light_stream *m)
{
    free(m->tree_memory);
    memset(m, 0, sizeof *m);
}

/* The stream's bounds, known before it begins. */
typedef struct extent {
    lmb_vec3 low, high;
    double max; /* W/sr or W/m2, R + G + B */
    uint32_t places; /* lights that are not suns */
} extent;

static void widen(extent *e, const lmb_light *l)
{
    const lmb_vec3 p = l->position;
    e->max += (double)l->intensity[0] + (double)l->intensity[1] + (double)l->intensity[2];
    if (l->kind == LMB_LIGHT_DIRECTIONAL) {
        return;
    }
    if (e->places++ == 0) {
        e->low = e->high = p;
    }
    e->low = (lmb_vec3){fminf(e->low.x, p.x), fminf(e->low.y, p.y), fminf(e->low.z, p.z)};
    e->high = (lmb_vec3){fmaxf(e->high.x, p.x), fmaxf(e->high.y, p.y), fmaxf(e->high.z, p.z)};
}

static extent measure(const light_list lists[2])
{
    extent e;
    memset(&e, 0, sizeof e);
    for (int k = 0; k < 2; ++k) {
        for (uint32_t i = 0; i < lists[k].count; ++i) {
            widen(&e, &lists[k].lights[i]);
        }
    }
    return e;
}

static void *take(light_stream *m, size_t bytes, report *r)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    m->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory for the lights: %.0f MiB more wanted; try a smaller --many-lights",
                    (double)bytes / 1048576.0);
    }
    return p;
}

static int take_tree(light_stream *m, const light_list lists[2], uint32_t cells, report *r)
{
    const extent measured = measure(lists), *e = &measured;
    const double start = host_seconds();
    const size_t bytes = lmb_many_lights_bytes(cells);
    const float max = (float)fmin(fmax(e->max, 0x1p-59), 0x1p+59);
    m->tree_memory = take(m, bytes, r);
    if (m->tree_memory == NULL) {
        return 0;
    }
    lmb_status status = lmb_many_lights_init(&m->tree, cells, e->low, e->high, max, m->tree_memory, bytes);
    for (int k = 0; k < 2 && status == LMB_OK; ++k) {
        status = lists[k].count > 0 ? lmb_many_lights_add(&m->tree, lists[k].lights, lists[k].count) : LMB_OK;
    }
    m->stream_s = host_seconds() - start;
    status = status == LMB_OK ? lmb_many_lights_build(&m->tree) : status;
    m->build_s = host_seconds() - start - m->stream_s;
    return status == LMB_OK || report_fail(r, "the tree of %u lights: %s",
                                           (unsigned)(lists[0].count + lists[1].count), lmb_status_name(status));
}

int light_stream_take(light_stream *m, const light_list lists[2], uint32_t cells, report *r)
{
    memset(m, 0, sizeof *m);
    return take_tree(m, lists, cells, r);
}
