/* relight_way.c: light that follows a moving object. */
#include "relight_way.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

lmb_vec3 way_move(way *w, lmb_vec3 at, float radius)
{
    const lmb_vec3 d = {at.x - w->at.x, at.y - w->at.y, at.z - w->at.z};
    const float moved = w->has_begun ? sqrtf(d.x * d.x + d.y * d.y + d.z * d.z) : 0.0f;
    const int jumps = !w->has_begun || moved > radius;
    w->gone = jumps ? radius : w->gone + moved;
    w->ahead =
        jumps || moved == 0.0f ? (lmb_vec3){0.0f, 0.0f, 0.0f} : (lmb_vec3){d.x / moved, d.y / moved, d.z / moved};
    w->at = at;
    w->is_new = !w->has_begun || jumps;
    w->has_begun = 1;
    return w->ahead;
}

/* After a jump the new light is used at once. */
void way_turn(way *w, int32_t slot, int is_computed, float radius)
{
    const int turns = is_computed || slot != w->slot;
    w->slot = slot;
    if (turns && !w->is_new) {
        w->gone = 0.0f;
    }
    w->share = w->is_new || !(radius > 0.0f) ? 1.0f : fminf(w->gone / radius, 1.0f);
    w->is_new = turns;
}

static int take_cube(way_cube *c, const float *planes, size_t count, int32_t n)
{
    const size_t bytes = count * sizeof *planes;
    free(c->from);
    free(c->shown);
    free(c->texels);
    c->from = malloc(bytes);
    c->shown = malloc(bytes);
    c->texels = malloc(lmb_probe_cube_bytes(n));
    c->side = n;
    if (c->from == NULL || c->shown == NULL || c->texels == NULL) {
        return 0;
    }
    memcpy(c->from, planes, bytes);
    memcpy(c->shown, planes, bytes);
    return 1;
}

int way_show(lmb_probe_cube *out, float *step, way_cube *c, const way *w, const float *planes, int32_t n, report *r)
{
    const size_t count = 18 * (size_t)n * (size_t)n;
    if (c->side != n && !take_cube(c, planes, count, n)) {
        return report_fail(r, "out of memory");
    }
    if (w->is_new) {
        memcpy(c->from, c->shown, count * sizeof *c->from);
    }
    double apart = 0.0, all = 1e-30;
    for (size_t i = 0; i < count; ++i) {
        const float now = c->from[i] + w->share * (planes[i] - c->from[i]);
        const double d = (double)(now - c->shown[i]);
        apart += d * d;
        all += (double)now * (double)now;
        c->shown[i] = now;
    }
    *step = fmaxf(*step, (float)sqrt(apart / all));
    return lmb_probe_cube_init(out, c->shown, n, c->texels, lmb_probe_cube_bytes(n)) == LMB_OK ||
           report_fail(r, "out of memory");
}

static void cube_free(way_cube *c)
{
    free(c->from);
    free(c->shown);
    free(c->texels);
}

void way_free(way *w)
{
    cube_free(&w->irradiance);
    for (int i = 0; i < RELIGHT_GLOSSY_CUBES; ++i) {
        cube_free(&w->glossy[i]);
    }
}
