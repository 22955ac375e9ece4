/* relight_worlds.c: a world seen from several places: nearer ones have larger weights. */
#include "relight_light.h"

#include <string.h>

#include "../common/frame_name.h"

/* A numbered world is one series, and needs pictures that follow each other. [S20 S28] */
static int check_series(const relight_options *o, report *r)
{
    int is_series = 0;
    for (int32_t i = 0; i < o->worlds; ++i) {
        is_series |= frame_digits(o->world[i]) > 0;
        if (is_series && o->worlds > 1) {
            return report_fail(r, "--world %s: numbered files are one world that changes; give no other", o->world[i]);
        }
    }
    if (is_series && o->path == NULL) {
        return report_fail(r, "--world %s: numbered files need the pictures of a --path", o->world[0]);
    }
    if (is_series && o->out != NULL && strcmp(o->out, o->world[0]) == 0) {
        return report_fail(r, "%s: both --world and -o; the pictures would join the world", o->out);
    }
    return is_series || o->world_every == 0 ||
           report_fail(r, "--world-every needs a numbered --world, as sky_%%03d.hdr");
}

int relight_worlds_check(const relight_options *o, report *r)
{
    if (!check_series(o, r)) {
        return 0;
    }
    for (int32_t i = 0; o->worlds > 1 && i < o->worlds; ++i) {
        if (strcmp(o->world[i], "demo") == 0) {
            return report_fail(r, "--world demo is the only one where it is given");
        }
    }
    return (o->worlds > 1 ? o->centres == o->worlds : o->centres <= 1) ||
           report_fail(r, "--world and --world-centre: %d and %d of them; give each world its centre", (int)o->worlds,
                       (int)o->centres);
}

static float distance2(lmb_vec3 a, lmb_vec3 b)
{
    const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

/* World i's weight at a place: inverse squared distance, normalized; all of it at the world's centre. */
static float share_of(const relight_options *o, int32_t i, lmb_vec3 at)
{
    float sum = 0.0f;
    for (int32_t k = 0; k < o->worlds; ++k) {
        sum += 1.0f / (distance2(o->centre[k], at) + 1e-12f);
    }
    return 1.0f / ((distance2(o->centre[i], at) + 1e-12f) * sum);
}

static void add_share(float *sum, const float *one, size_t count, int32_t i, float share)
{
    for (size_t k = 0; k < count; ++k) {
        sum[k] = (i > 0 ? sum[k] : 0.0f) + share * one[k];
    }
}

int relight_light_map(float *map, float *one, const lmb_probe_table *table, const relight_light *w,
                      const relight_options *o, lmb_vec3 at)
{
    const size_t numbers = 3 * (size_t)table->width * (size_t)table->height;
    int ok = 1;
    for (int32_t i = 0; ok && i < o->worlds; ++i) {
        float *into = o->worlds > 1 ? one : map;
        ok = lmb_probe_remap(into, o->kernels, &w->world[i], table, at, o->blend) == LMB_OK;
        if (ok && o->worlds > 1) {
            add_share(map, one, numbers, i, share_of(o, i, at));
        }
    }
    return ok;
}

int relight_light_see(relight_light *w, const relight_options *o, lmb_vec3 at)
{
    return relight_light_map(w->map, w->one, &w->table[0], w, o, at);
}

int relight_light_reflect(relight_light *w, const relight_options *o, float *planes, int32_t n, lmb_probe_rays *rays,
                          lmb_vec3 at, float roughness)
{
    int ok = 1;
    for (int32_t i = 0; ok && i < o->worlds; ++i) {
        const lmb_world_query query = {&w->world[i], 0.0f, o->blend};
        float *into = o->worlds > 1 ? w->cube : planes;
        ok = lmb_probe_reflect(into, n, o->kernels, rays, &query, at, roughness) == LMB_OK;
        if (ok && o->worlds > 1) {
            add_share(planes, w->cube, 18 * (size_t)n * (size_t)n, i, share_of(o, i, at));
        }
    }
    return ok;
}

const lmb_world *relight_light_nearest(const relight_light *w, const relight_options *o, lmb_vec3 at)
{
    int32_t nearest = 0;
    for (int32_t i = 1; i < o->worlds; ++i) {
        nearest = distance2(o->centre[i], at) < distance2(o->centre[nearest], at) ? i : nearest;
    }
    return &w->world[nearest];
}
