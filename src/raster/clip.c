/* clip.c: a triangle in clip space against the near plane and the guard band. Layer 3.
 *
 * Sutherland-Hodgman. Two triangles that share an edge must cut it at the same bits in either direction, so the
 * intersection is always computed from the endpoint nearer to the plane, then from the smaller bit pattern. (From the
 * endpoint with the smaller outcode, an edge from 0.005 m to 10^6 m lost all precision of w at the near plane.) */
#include "clip.h"

#include <string.h>

static float plane_distance(const lmb_clip_vertex *v, uint32_t plane, const lmb_clip_guard *guard)
{
    switch (plane) {
    case CLIP_NEAR: return v->w - v->z; /* d = z / w <= 1 */
    case CLIP_LEFT: return guard->x * v->w + v->x;
    case CLIP_RIGHT: return guard->x * v->w - v->x;
    case CLIP_TOP: return guard->y * v->w - v->y;
    default: return guard->y * v->w + v->y;
    }
}

uint32_t lmb_clip_code(const lmb_clip_vertex *v, const lmb_clip_guard *guard)
{
    uint32_t code = 0;
    for (uint32_t plane = CLIP_NEAR; plane <= CLIP_BOTTOM; plane <<= 1) {
        code |= plane_distance(v, plane, guard) < 0.0f ? plane : 0;
    }
    return code;
}

static int bits_come_first(const lmb_clip_vertex *a, const lmb_clip_vertex *b)
{
    uint32_t p[4], q[4];
    memcpy(p, &a->x, sizeof p);
    memcpy(q, &b->x, sizeof q);
    for (int i = 0; i < 4; ++i) {
        if (p[i] != q[i]) {
            return p[i] < q[i];
        }
    }
    return 1;
}

static lmb_clip_vertex intersect(const lmb_clip_vertex *a, const lmb_clip_vertex *b, uint32_t plane,
                                 const lmb_clip_guard *guard)
{
    lmb_clip_vertex r;
    float da = plane_distance(a, plane, guard), db = plane_distance(b, plane, guard);
    if (absf(db) < absf(da) || (absf(db) == absf(da) && !bits_come_first(a, b))) {
        const lmb_clip_vertex *c = a;
        float d = da;
        a = b;
        b = c;
        da = db;
        db = d;
    }
    float t = da / (da - db); /* the signs differ, so da - db is not 0 */
    r.x = a->x + (b->x - a->x) * t;
    r.y = a->y + (b->y - a->y) * t;
    r.z = a->z + (b->z - a->z) * t;
    r.w = plane == CLIP_NEAR ? r.z : a->w + (b->w - a->w) * t; /* on the near plane, exactly */
    r.code = lmb_clip_code(&r, guard);
    return r;
}

static int cut_by_plane(lmb_clip_vertex *polygon, int n, uint32_t plane, const lmb_clip_guard *guard)
{
    lmb_clip_vertex out[LMB_CLIP_MAX + 1];
    int m = 0;
    for (int i = 0; i < n; ++i) {
        const lmb_clip_vertex *a = &polygon[i], *b = &polygon[i + 1 < n ? i + 1 : 0];
        int a_in = plane_distance(a, plane, guard) >= 0.0f, b_in = plane_distance(b, plane, guard) >= 0.0f;
        if (a_in && m < LMB_CLIP_MAX) {
            out[m++] = *a;
        }
        if (a_in != b_in && m < LMB_CLIP_MAX) {
            out[m++] = intersect(a, b, plane, guard);
        }
    }
    memcpy(polygon, out, (size_t)m * sizeof *out);
    return m;
}

int lmb_clip_polygon(lmb_clip_vertex polygon[LMB_CLIP_MAX], uint32_t planes, const lmb_clip_guard *guard)
{
    int n = 3;
    for (uint32_t plane = CLIP_NEAR; plane <= CLIP_BOTTOM && n >= 3; plane <<= 1) {
        /* Only planes that cut the triangle itself: a new corner lies between two old ones. */
        if (planes & plane) {
            n = cut_by_plane(polygon, n, plane, guard);
        }
    }
    return n >= 3 ? n : 0;
}
