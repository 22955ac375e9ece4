/* setup.c: three screen vertices -> edge functions and a depth plane. Layer 3.
 *
 * Ranges: the guard band keeps |x|, |y| < 2^22 (24.8 from the frame's centre, LMB_MAX_FRAME = 2^14 px), differences <
 * 2^23, products < 2^46: int64. Pixel centres all have the same fraction, so floor(E / 256) is exact and changes by
 * exactly ex per pixel. Over a tile that an edge crosses it stays under 2^27: int32.
 *
 * The depth plane is solved in binary64, in which the cross products of a 24-bit depth difference and a 23-bit distance
 * are exact, so slivers keep their slope. (In binary32 a 300:1 sliver's slope lost 9 bits.) No corner's depth is above
 * 1: the near plane leaves z <= w, and w times the rounded 1 / w rounds to 1 or less. */
#include "setup.h"

#include "../base/vec.h"

/* Points on the line are inside only for top and left edges: others subtract 1 from E. */
static int64_t fill_rule(int32_t ex, int32_t ey) { return ex > 0 || (ex == 0 && ey > 0) ? 0 : -1; }

static void set_setup_edge(lmb_setup *s, int i, const lmb_screen_vertex *from, const lmb_screen_vertex *to)
{
    s->ex[i] = from->y_24_8 - to->y_24_8;
    s->ey[i] = to->x_24_8 - from->x_24_8;
    s->e_origin[i] =
        -(int64_t)s->ex[i] * from->x_24_8 - (int64_t)s->ey[i] * from->y_24_8 + fill_rule(s->ex[i], s->ey[i]);
}

static void set_depth_plane(lmb_setup *s, const lmb_screen_vertex *a, const lmb_screen_vertex *b,
                            const lmb_screen_vertex *c, int64_t area)
{
    double bx = b->x_24_8 - a->x_24_8, by = b->y_24_8 - a->y_24_8, cx = c->x_24_8 - a->x_24_8,
           cy = c->y_24_8 - a->y_24_8;
    double bd = (double)b->d - (double)a->d, cd = (double)c->d - (double)a->d;
    double per_px = 256.0 / (double)area;
    s->d_x = (bd * cy - cd * by) * per_px;
    s->d_y = (cd * bx - bd * cx) * per_px;
    s->d_origin = (double)a->d - s->d_x * (a->x_24_8 * (1.0 / 256.0)) - s->d_y * (a->y_24_8 * (1.0 / 256.0));
    s->d_min = minf(a->d, minf(b->d, c->d));
    s->d_max = maxf(a->d, maxf(b->d, c->d));
}

int lmb_setup_triangle(lmb_setup *s, const lmb_screen_vertex *a, const lmb_screen_vertex *b,
                       const lmb_screen_vertex *c)
{
    int64_t area = setup_area(a, b, c);
    if (area == 0) {
        return 0;
    }
    s->back = area > 0;
    if (area < 0) {
        const lmb_screen_vertex *t = b;
        b = c;
        c = t;
        area = -area;
    }
    set_setup_edge(s, 0, a, b);
    set_setup_edge(s, 1, b, c);
    set_setup_edge(s, 2, c, a);
    set_depth_plane(s, a, b, c, area);
    s->x_min = mini(a->x_24_8, mini(b->x_24_8, c->x_24_8));
    s->x_max = maxi(a->x_24_8, maxi(b->x_24_8, c->x_24_8));
    s->y_min = mini(a->y_24_8, mini(b->y_24_8, c->y_24_8));
    s->y_max = maxi(a->y_24_8, maxi(b->y_24_8, c->y_24_8));
    return 1;
}
