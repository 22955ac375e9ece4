/* mix_place.c: the position of the virtual object, and the scene of it and the real surfaces. */
#include "mix_frames.h"
#include "mix_lobes.h"
#include "mix_world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- matrices: columns, as in the library ------------------------------------------------------------------------- */

static lmb_mat4 of_axes(lmb_vec3 x, lmb_vec3 y, lmb_vec3 z, lmb_vec3 at)
{
    const lmb_mat4 m = {{x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, at.x, at.y, at.z, 1}};
    return m;
}

static lmb_vec3 scaled(lmb_vec3 v, float s)
{
    const lmb_vec3 out = {v.x * s, v.y * s, v.z * s};
    return out;
}

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static int by_size(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static float median(float *values, size_t count)
{
    qsort(values, count, sizeof *values, by_size);
    return values[count / 2];
}

static const lmb_mat4 identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};

/* --- position ----------------------------------------------------------------------------------------------------- */

/* The measured depth at the pixels of the object's foot minus the plane's, along the camera's axis: the median, so that
 * noise averages out. */
float mix_gap(mix_job *j, report *r)
{
    const lmb_pinhole *c = &j->frame.camera;
    const lmb_vec3 n = j->hangs ? j->planes.plane[j->floor].normal : j->up;
    const float radius = mix_extent_of(j).radius * j->scale, slope = dot(j->anchor, n);
    const int reach = (int)fminf(fmaxf(radius * c->fx / -j->anchor.z, 4.0f), 200.0f);
    const int x0 = (int)floorf(c->cx - c->fx * j->anchor.x / j->anchor.z + 0.5f),
              y0 = (int)floorf(c->cy + c->fy * j->anchor.y / j->anchor.z + 0.5f);
    float *off = mix_take(j, (size_t)(2 * reach + 1) * (size_t)(2 * reach + 1) * sizeof *off, r);
    size_t count = 0;
    for (int y = y0 - reach; off != NULL && y <= y0 + reach; ++y) {
        for (int x = x0 - reach; x <= x0 + reach; ++x) {
            if (x < 0 || y < 0 || x >= c->width || y >= c->height || !(j->frame.depth[y * c->width + x] > 0.0f)) {
                continue;
            }
            const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
            const float at = slope / dot(ray, n);
            const lmb_vec3 p = scaled(ray, at), d = {p.x - j->anchor.x, p.y - j->anchor.y, p.z - j->anchor.z};
            if (dot(d, d) <= radius * radius || (x == x0 && y == y0)) {
                off[count++] = j->frame.depth[y * c->width + x] - at;
            }
        }
    }
    return count > 0 ? median(off, count) : NAN;
}

/* Upright in scene space, +Z towards the viewer, then turned. */
static lmb_mat4 upright(const mix_job *j, float scale)
{
    const lmb_vec3 at = lmb_axes_turn(&j->axes, j->anchor);
    const float viewer = hypotf(at.x, at.z) > 0.0f ? atan2f(-at.x, -at.z) : 0.0f;
    const float turn = j->o.turn_deg * 0.017453293f + viewer;
    const lmb_vec3 x = {cosf(turn) * scale, 0, -sinf(turn) * scale}, y = {0, scale, 0},
                   z = {sinf(turn) * scale, 0, cosf(turn) * scale};
    return of_axes(x, y, z, at);
}

/* Upright on a wall, +Z away from it, then turned about +Z. */
static lmb_mat4 hanging(const mix_job *j, float scale)
{
    const lmb_vec3 n = lmb_axes_turn(&j->axes, j->planes.plane[j->floor].normal);
    const float level = fmaxf(hypotf(n.x, n.z), 1e-6f), turn = j->o.turn_deg * 0.017453293f;
    const lmb_vec3 z = {n.x / level, 0, n.z / level}, across = {z.z, 0, -z.x};
    const float c = cosf(turn) * scale, s = sinf(turn) * scale;
    const lmb_vec3 x = {c * across.x, s, c * across.z}, y = {-s * across.x, c, -s * across.z};
    return of_axes(x, y, scaled(z, scale), lmb_axes_turn(&j->axes, j->anchor));
}

/* Puts the middle of the mesh's foot at the anchor; if it hangs, the middle of its back. */
lmb_mat4 mix_object_to_scene(mix_job *j)
{
    if (j->o.at == MIX_AT_WORLD) {
        return j->from_world;
    }
    const lmb_vec3 lo = j->object.scene.bounds_min, hi = j->object.scene.bounds_max;
    const lmb_mat4 stand = j->hangs ? hanging(j, j->scale) : upright(j, j->scale);
    lmb_mat4 foot = identity;
    foot.m[12] = -0.5f * (lo.x + hi.x);
    foot.m[13] = j->hangs ? -0.5f * (lo.y + hi.y) : -lo.y;
    foot.m[14] = j->hangs ? -lo.z : -0.5f * (lo.z + hi.z);
    return mix_product(&stand, &foot);
}

/* The floor's normal, or mix_up if there is no floor. */
static void set_up(mix_job *j)
{
    const int32_t floor = mix_floor(j);
    j->up = floor >= 0 ? j->planes.plane[floor].normal : mix_up(j);
}

int mix_place(mix_job *j, report *r)
{
    if (j->kept != NULL && j->kept->frames > 0 && j->o.object != NULL) {
        return mix_place_again(j, r);
    }
    j->floor = -1;
    set_up(j);
    if (j->o.object == NULL) {
        mix_turn_scene(j);
        j->placed = identity;
        return mix_put_object(j, r);
    }
    if (j->o.at == MIX_AT_CENTRE && j->planes.count == 0) {
        return mix_fail_depth(j, r);
    }
    if (!model_load_as(&j->object, j->o.object, &j->o.choice, &j->notes, r) ||
        !mix_stand(j, r)) {
        return 0;
    }
    if (j->o.at == MIX_AT_PIXEL && !(j->anchor.z < 0.0f)) {
        return mix_fail_at(j, r);
    }
    mix_lobes_read(j);
    for (int i = 0; i < 3 && j->floor >= 0; ++i) { /* most of the foot's pixels are nearer than the middle */
        mix_touch(j, mix_gap(j, r));
    }
    j->facing = j->floor >= 0 ? j->planes.plane[j->floor].normal : j->up;
    mix_turn_scene(j);
    j->gap_m = j->o.at == MIX_AT_WORLD ? NAN : mix_gap(j, r);
    j->placed = mix_object_to_scene(j);
    return mix_put_object(j, r);
}
