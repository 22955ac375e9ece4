/* snap.c: Frama-C's Eva proves for triangles that are clipped or large that no conversion of a corner to 24.8 leaves
 * its integer, and no clipped polygon its array.
 *
 * Covers any matrix, any view and any positions: numbers, infinities and NaN. snap.g covers the
 * conversions of small triangles. */
#include "any.h"

#include "../../src/raster/clip.c"
#include "../../src/raster/draw_one.c"

static lmb_draw_instance any_instance(void)
{
    lmb_draw_instance d;
    for (int i = 0; i < 12; ++i) {
        d.job.row[i / 4][i % 4] = any_float();
    }
    d.job.scale_x = any_float(), d.job.scale_y = any_float();
    d.job.snap_x = any_float(), d.job.snap_y = any_float();
    d.job.near_m = any_float(), d.job.far_m = any_float(), d.job.depth_scale = any_float();
    d.job.orthographic = any_between(0, 1);
    d.guard.x = any_float(), d.guard.y = any_float();
    return d;
}

/* A corner that may result from transform or clipping. */
static lmb_clip_vertex any_corner(const lmb_draw_instance *d)
{
    lmb_clip_vertex v = transform(d, vec3(any_float(), any_float(), any_float()));
    if (any_between(0, 1)) {
        v.x = any_float(), v.y = any_float(), v.z = any_float(), v.w = any_float();
        v.code = lmb_clip_code(&v, &d->guard);
    }
    return v;
}

int main(void)
{
    const lmb_draw_instance d = any_instance();
    const uint32_t plane = 1u << any_between(0, 4);
    lmb_clip_vertex polygon[LMB_CLIP_MAX];
    for (int i = 0; i < LMB_CLIP_MAX; ++i) {
        polygon[i] = any_corner(&d);
    }
    const lmb_screen_vertex v = snap(&d, &polygon[0]);
    /*@ assert -4194304 <= v.x_24_8 <= 4194304 && -4194304 <= v.y_24_8 <= 4194304; */
    const int n = cut_by_plane(polygon, any_between(3, LMB_CLIP_MAX), plane, &d.guard);
    /*@ assert 0 <= n <= LMB_CLIP_MAX; */
    return 0;
}
