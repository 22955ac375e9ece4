/* draw_cut.c: corners in clip space against the frustum, the guard band and the state's planes. Layer 4.
 *
 * As in src/raster/clip.c, two primitives that share an edge cut it at the same bits, because the intersection is
 * computed from the endpoint nearer to the plane, then from the smaller bit pattern. The picture's sides do not cut;
 * only a guard band far outside does. */
#include "draw_part.h"

#include <string.h>

#if LMB_DRAW
#define CUT_LEAST_W 1e-12f /* so that 1 / w and products with it are finite */

static float cut_distance(const lmb_draw_corner *c, int cut, const lmb_draw_pass *pass)
{
    const float *v = c->v, w = v[CORNER_W];
    switch (cut) {
    case DRAW_CUT_W:
        return w - CUT_LEAST_W;
    case DRAW_CUT_NEAR:
        return w - v[CORNER_Z];
    case DRAW_CUT_FAR:
        return v[CORNER_Z];
    case DRAW_CUT_LEFT:
        return pass->guard_x * w + v[CORNER_X];
    case DRAW_CUT_RIGHT:
        return pass->guard_x * w - v[CORNER_X];
    case DRAW_CUT_TOP:
        return pass->guard_y * w - v[CORNER_Y];
    case DRAW_CUT_BOTTOM:
        return pass->guard_y * w + v[CORNER_Y];
    default:
        return v[CORNER_PLANES + cut - DRAW_CUT_OWN];
    }
}

/* 1 if the state has this user plane. */
static int cut_is_on(int cut, const lmb_draw_pass *pass)
{
    return (pass->state->planes >> (cut - DRAW_CUT_OWN) & 1u) != 0;
}

/* One bit for each plane that the corner is outside of. */
static uint32_t cut_code(const lmb_draw_corner *c, const lmb_draw_pass *pass)
{
    uint32_t code = 0;
    for (int cut = 0; cut < DRAW_CUT_OWN; ++cut) {
        code |= (uint32_t)(cut_distance(c, cut, pass) < 0.0f) << cut;
    }
    for (int cut = DRAW_CUT_OWN; DRAW_FULL && pass->state->planes >> (cut - DRAW_CUT_OWN) != 0; ++cut) {
        code |= (uint32_t)(cut_is_on(cut, pass) && cut_distance(c, cut, pass) < 0.0f) << cut;
    }
    return code;
}

static int cut_comes_first(const lmb_draw_corner *a, const lmb_draw_corner *b)
{
    for (int i = 0; i < CORNER_VALUES; ++i) {
        uint32_t p, q;
        memcpy(&p, &a->v[i], sizeof p);
        memcpy(&q, &b->v[i], sizeof q);
        if (p != q) {
            return p < q;
        }
    }
    return 1;
}

/* Intersection of an edge with the plane; one end is inside. */
static void cut_edge(lmb_draw_corner *out, const lmb_draw_corner *a, const lmb_draw_corner *b, int cut,
                     const lmb_draw_pass *pass)
{
    float da = cut_distance(a, cut, pass), db = cut_distance(b, cut, pass);
    if (absf(db) < absf(da) || (absf(db) == absf(da) && !cut_comes_first(a, b))) {
        const lmb_draw_corner *c = a;
        const float d = da;
        a = b;
        b = c;
        da = db;
        db = d;
    }
    const float t = da / (da - db); /* the signs differ, so da - db is not 0 */
    for (int i = 0; i < CORNER_VALUES; ++i) {
        out->v[i] = a->v[i] + (b->v[i] - a->v[i]) * t;
    }
    if (cut == DRAW_CUT_NEAR) {
        out->v[CORNER_W] = out->v[CORNER_Z]; /* on the plane, exactly */
    } else if (cut == DRAW_CUT_FAR) {
        out->v[CORNER_Z] = 0.0f;
    } else if (cut >= DRAW_CUT_OWN) {
        out->v[CORNER_PLANES + cut - DRAW_CUT_OWN] = 0.0f;
    }
    out->v[CORNER_W] = maxf(out->v[CORNER_W], CUT_LEAST_W);
}

NOINLINE int cut_by(lmb_draw_corner *corner, int n, int cut, const lmb_draw_pass *pass)
{
    lmb_draw_corner out[DRAW_CORNERS];
    int m = 0;
    for (int i = 0; i < n; ++i) {
        const lmb_draw_corner *a = &corner[i], *b = &corner[i + 1 < n ? i + 1 : 0];
        const int a_in = cut_distance(a, cut, pass) >= 0.0f, b_in = cut_distance(b, cut, pass) >= 0.0f;
        if (a_in && m < DRAW_CORNERS) {
            out[m++] = *a;
        }
        if (a_in != b_in && m < DRAW_CORNERS) {
            cut_edge(&out[m++], a, b, cut, pass);
        }
    }
    for (int i = 0; i < m; ++i) {
        corner[i] = out[i];
    }
    return m;
}

int lmb_draw_cut_polygon(lmb_draw_corner corner[DRAW_CORNERS], const lmb_draw_pass *pass)
{
    uint32_t any = 0, all = ~0u;
    int n = 3;
    for (int i = 0; i < 3; ++i) {
        const uint32_t code = cut_code(&corner[i], pass);
        any |= code;
        all &= code;
    }
    if (all != 0) {
        return 0;
    }
    /* Only planes that cut the triangle itself: a new corner lies between two old ones. */
    for (int cut = 0; cut < DRAW_CUTS && n >= 3; ++cut) {
        if (any >> cut & 1u) {
            n = cut_by(corner, n, cut, pass);
        }
    }
    return n >= 3 ? n : 0;
}

int lmb_draw_cut_line(lmb_draw_corner corner[2], const lmb_draw_pass *pass)
{
    const uint32_t any = cut_code(&corner[0], pass) | cut_code(&corner[1], pass);
    for (int cut = 0; cut < DRAW_CUTS && any >> cut != 0; ++cut) {
        if ((any >> cut & 1u) == 0) {
            continue;
        }
        const int in[2] = {cut_distance(&corner[0], cut, pass) >= 0.0f, cut_distance(&corner[1], cut, pass) >= 0.0f};
        if (!in[0] && !in[1]) {
            return 0;
        }
        if (in[0] != in[1]) {
            lmb_draw_corner made;
            cut_edge(&made, &corner[0], &corner[1], cut, pass);
            corner[in[0] ? 1 : 0] = made;
        }
    }
    return 1;
}

int lmb_draw_is_out(const lmb_draw_corner *corner, const lmb_draw_pass *pass) { return cut_code(corner, pass) != 0; }
#endif
