/* draw_one.c: draws one triangle that is clipped, large or has holes into a window. Layer 3.
 *
 * The corners are read and transformed again: few triangles come here, so a batch need not store them. */
#include "draw_one.h"

#include "../base/vertex.h"

#define SNAP_MAX 4194304.0f /* 24.8: LMB_MAX_FRAME px from the centre, the limit of setup.c */

static float row_point(const float row[4], lmb_vec3 p) { return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]; }

static lmb_clip_vertex transform(const lmb_draw_instance *d, lmb_vec3 p)
{
    const lmb_setup_job *job = &d->job;
    float x = row_point(job->row[0], p), y = row_point(job->row[1], p), w = row_point(job->row[2], p);
    lmb_clip_vertex v;
    v.x = x * job->scale_x;
    v.y = y * job->scale_y;
    v.z = job->orthographic ? (job->far_m - w) * job->depth_scale : job->near_m;
    v.w = job->orthographic ? 1.0f : w;
    v.code = lmb_clip_code(&v, &d->guard);
    return v;
}

/* If x or y was huge compared with w, a cut corner lies on the guard band only within binary32 precision. */
static int32_t to_24_8(float v) { return (int32_t)minf(maxf(floorf(v), -SNAP_MAX), SNAP_MAX); }

static lmb_screen_vertex snap(const lmb_draw_instance *d, const lmb_clip_vertex *v)
{
    lmb_screen_vertex s;
    float inverse = 1.0f / v->w;
    s.x_24_8 = to_24_8(v->x * inverse * d->job.snap_x + 0.5f);
    s.y_24_8 = to_24_8(0.5f - v->y * inverse * d->job.snap_y);
    s.d = v->z * inverse;
    return s;
}

static int fill_polygon(const lmb_fill_context *c, const lmb_draw_instance *d, const lmb_screen_vertex *corner, int n,
                        uint32_t id)
{
    int drawn = 0;
    for (int i = 2; i < n; ++i) {
        lmb_setup setup;
        if (lmb_setup_triangle(&setup, &corner[0], &corner[i - 1], &corner[i]) &&
            !(d->cull && setup.back != d->mirrored)) {
            if (d->masked) {
                lmb_fill_masked(c, &setup, id, LMB_MULTISAMPLE && d->blends);
            } else {
                fill_one(c, &setup, id);
            }
            drawn = 1;
        }
    }
    return drawn;
}

int lmb_one_corners(lmb_screen_vertex corner[LMB_CLIP_MAX], const lmb_draw_instance *d, uint32_t id)
{
    lmb_clip_vertex polygon[LMB_CLIP_MAX];
    uint32_t any = 0;
    int n = 3;
    for (uint32_t i = 0; i < 3; ++i) {
        polygon[i] = transform(d, mesh_position(d->mesh, mesh_index(d->mesh, 3 * (id - d->first_id) + i)));
        any |= polygon[i].code;
    }
    if (any) {
        n = lmb_clip_polygon(polygon, any, &d->guard);
    }
    for (int i = 0; i < n; ++i) {
        corner[i] = snap(d, &polygon[i]);
    }
    return n;
}

int lmb_draw_one(const lmb_fill_context *c, const lmb_draw_instance *d, uint32_t id)
{
    lmb_screen_vertex corner[LMB_CLIP_MAX];
    const int n = lmb_one_corners(corner, d, id);
    return fill_polygon(c, d, corner, n, id);
}
