/* plane.c: the plane of one triangle, and the intersection with a tile's rays. Layer 3. */
#include "plane.h"

#include "../base/vec.h"
#include "target.h"

#define LANE_ONE
#include "../lane/lane_scalar.h"
#include "../lane/lane.h"
#include "plane.inl"

void lmb_resolve_rays(lmb_rays *out, const lmb_view *v, int32_t x, int32_t y)
{
    const lmb_vec3 none = vec3(0.0f, 0.0f, 0.0f);
    float per_x = 2.0f * v->half_width / (float)v->frame_width, per_y = 2.0f * v->half_height / (float)v->frame_height;
    float sx = ((float)(256 * x + view_origin_x(v)) * (1.0f / 256.0f)) * per_x;
    float sy = ((float)-(256 * y + view_origin_y(v)) * (1.0f / 256.0f)) * per_y;
    lmb_vec3 first = add3(mul3(v->right, sx), mul3(v->up, sy));
    lmb_vec3 step_x = mul3(v->right, per_x), step_y = mul3(v->up, -per_y);
    int perspective = v->kind == LMB_PERSPECTIVE;
    out->eye = v->eye;
    out->back = v->back;
    out->near_m = v->near_m;
    out->perspective = perspective;
    out->origin = perspective ? none : first;
    out->ox = perspective ? none : step_x;
    out->oy = perspective ? none : step_y;
    out->direction = perspective ? sub3(first, v->back) : mul3(v->back, -1.0f);
    out->rx = perspective ? step_x : none;
    out->ry = perspective ? step_y : none;
}

static lmb_vec3 from_lanes(lane3 v)
{
    float x, y, z;
    lane_store(&x, v.x);
    lane_store(&y, v.y);
    lane_store(&z, v.z);
    return vec3(x, y, z);
}

void lmb_resolve_plane(lmb_plane *out, const lmb_vec3 corner[3], const lmb_rays *rays)
{
    const lane3 c[3] = {lane3_of(corner[0]), lane3_of(corner[1]), lane3_of(corner[2])};
    const plane_lanes p = plane_setup(c, rays);
    out->corner = from_lanes(p.corner);
    out->plane = from_lanes(p.plane);
    out->face = from_lanes(p.face);
    out->g1 = from_lanes(p.g1);
    out->g2 = from_lanes(p.g2);
    lane_store(&out->w_min, p.w_min);
    lane_store(&out->w_max, p.w_max);
}

void lmb_resolve_point(float *b1, float *b2, const lmb_plane *p, const lmb_rays *rays, float x, float y)
{
    plane_point(b1, b2, p, rays, x, y);
}
