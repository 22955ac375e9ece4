/* mix_islands.c: specks of one plane's label inside another plane: noise that happens to lie on the first plane. */
#include "mix_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SPECK 2e-4f /* of the picture's pixels; at least LEAST */
enum { LEAST = 12 };

typedef struct islands {
    mix_job *j;
    int32_t *pixel; /* of the island */
    uint8_t *done;
    int32_t count, beside[LMB_MAX_PLANES + 1]; /* neighbour pixels, by label */
} islands;

/* Collects the connected pixels with the same label. */
static void collect(islands *s, int32_t from)
{
    const int32_t w = s->j->frame.camera.width, h = s->j->frame.camera.height;
    const uint8_t *label = s->j->planes.label, own = label[from];
    memset(s->beside, 0, sizeof s->beside);
    s->pixel[0] = from;
    s->done[from] = 1;
    s->count = 1;
    for (int32_t n = 0; n < s->count; ++n) {
        const int32_t at = s->pixel[n], x = at % w, y = at / w;
        const int32_t next[4] = {x > 0 ? at - 1 : -1, x + 1 < w ? at + 1 : -1, y > 0 ? at - w : -1,
                                 y + 1 < h ? at + w : -1};
        for (int i = 0; i < 4; ++i) {
            if (next[i] >= 0 && label[next[i]] != own) {
                ++s->beside[label[next[i]]];
            } else if (next[i] >= 0 && !s->done[next[i]]) {
                s->done[next[i]] = 1;
                s->pixel[s->count++] = next[i];
            }
        }
    }
}

/* If most neighbours lie on one other plane, each pixel moves to that plane if the depth is within noise, else it
 * becomes unlabelled with the measured depth. */
static void drop(islands *s)
{
    mix_job *j = s->j;
    const int32_t w = j->frame.camera.width, own = j->planes.label[s->pixel[0]];
    int32_t best = 0, all = 0;
    for (int32_t p = 0; p <= LMB_MAX_PLANES; ++p) {
        all += s->beside[p];
        best = p > 0 && p != own && s->beside[p] > s->beside[best] ? p : best;
    }
    for (int32_t i = 0; i < s->count && best > 0 && 2 * s->beside[best] > all; ++i) {
        const int32_t at = s->pixel[i];
        const lmb_flat *p = &j->planes.plane[best - 1];
        const lmb_vec3 ray = lmb_cloud_ray(&j->cloud.camera, (float)(at % w), (float)(at / w));
        const float d = j->frame.depth[at], measured = d > 0.0f ? 1.0f / d : 0.0f,
                    there = p->slope[0] * ray.x + p->slope[1] * ray.y + p->slope[2];
        const int is_there =
            !(measured > 0.0f) || fabsf(measured - there) <= 4.0f * lmb_cloud_sigma(&j->cloud, measured);
        j->planes.label[at] = (uint8_t)(is_there ? best : 0);
        j->cloud.inverse[at] = is_there ? there : measured;
        j->cloud.normal[at] = is_there ? p->normal : j->cloud.normal[at];
    }
}

int mix_drop_islands(mix_job *j, report *r)
{
    const int32_t pixels = j->frame.camera.width * j->frame.camera.height, speck = (int32_t)(SPECK * (float)pixels);
    islands s;
    memset(&s, 0, sizeof s);
    s.j = j;
    s.pixel = malloc((size_t)pixels * sizeof *s.pixel);
    s.done = calloc((size_t)pixels, 1);
    const int ok = s.pixel != NULL && s.done != NULL;
    for (int32_t i = 0; ok && i < pixels; ++i) {
        if (s.done[i] || j->planes.label[i] == 0) {
            continue;
        }
        collect(&s, i);
        if (s.count <= (speck > LEAST ? speck : LEAST)) {
            drop(&s);
        }
    }
    free(s.pixel);
    free(s.done);
    return ok || report_fail(r, "out of memory");
}
