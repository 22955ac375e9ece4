/* mix_inside.c: is all of the object in the picture, and how large is it there?
 * Tests vertices, because the scene-aligned box of a rotated object is larger than the object. */
#include "mix_frames.h"
#include "mix_turn.h"

#include <math.h>

/* Distances of a scene point from two edges of the picture, m. At 1 m ahead the edges lie `across` and `down` off the
 * axis. */
static lmb_mat4 edges(const lmb_axes *a, float sign, float across, float down)
{
    const lmb_vec3 x = a->right, y = a->up, z = a->back;
    const lmb_mat4 m = {{sign * x.x - across * z.x, -sign * y.x - down * z.x, 0, 0,
                         sign * x.y - across * z.y, -sign * y.y - down * z.y, 0, 0,
                         sign * x.z - across * z.z, -sign * y.z - down * z.z, 0, 0, 0, 0, 0, 1}};
    return m;
}

/* Tests vertices: a box would do only for an object that fills it, which a rotated one does not. */
static int is_within(const mix_job *j, const lmb_mat4 *within)
{
    lmb_scene one = j->scene;
    one.instance_count = 1;
    for (uint32_t i = 1; i < j->scene.instance_count; ++i) {
        lmb_instance placed = j->scene.instances[i];
        lmb_vec3 low, high;
        placed.to_world = mix_product(within, &placed.to_world);
        one.instances = &placed;
        lmb_scene_bounds(&low, &high, &one);
        if (low.x < 0.0f || low.y < 0.0f) {
            return 0;
        }
    }
    return 1;
}

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* The area it covers in the picture, relative to the camera's axis. */
typedef struct covered {
    float low[2], high[2]; /* px */
    int reaches_behind;    /* behind the camera */
} covered;

static void add_corner(covered *box, const mix_job *j, lmb_vec3 p)
{
    const lmb_pinhole *c = &j->frame.camera;
    const float ahead = -dot(j->axes.back, p),
                at[2] = {c->fx * dot(j->axes.right, p) / ahead, c->fy * dot(j->axes.up, p) / ahead};
    box->reaches_behind |= !(ahead > 0.0f);
    for (int k = 0; k < 2; ++k) {
        box->low[k] = fminf(box->low[k], at[k]);
        box->high[k] = fmaxf(box->high[k], at[k]);
    }
}

/* The longer side of the covered area, px; infinite if it reaches behind the camera. */
static float side_px(const mix_job *j)
{
    covered box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
    for (uint32_t i = 0; i < j->object_triangles; ++i) {
        lmb_triangle t;
        if (lmb_triangle_fetch(&t, &j->scene, j->real_triangles + 1 + i)) {
            for (int k = 0; k < 3; ++k) {
                add_corner(&box, j, t.corner[k]);
            }
        }
    }
    return box.reaches_behind ? INFINITY : fmaxf(box.high[0] - box.low[0], box.high[1] - box.low[1]);
}

int mix_is_inside(mix_job *j)
{
    const lmb_pinhole *c = &j->frame.camera;
    const lmb_mat4 low = edges(&j->axes, 1.0f, (c->cx + 0.5f) / c->fx, (c->cy + 0.5f) / c->fy),
                   high = edges(&j->axes, -1.0f, ((float)c->width - 0.5f - c->cx) / c->fx,
                                ((float)c->height - 0.5f - c->cy) / c->fy);
    if (j->kept == NULL || j->kept->frames == 0) { /* print it once */
        j->seen_px = side_px(j);
    }
    return is_within(j, &low) && is_within(j, &high);
}
