/* mix_inside.c: is all of the object in the picture? By its vertices. */
#include "mix_job.h"
#include "mix_turn.h"

/* How far a point of the scene is within two edges of the picture, m; 1 m ahead these are `across` and `down` off the axis. */
static lmb_mat4 edges(const lmb_axes *a, float sign, float across, float down)
{
    const lmb_vec3 x = a->right, y = a->up, z = a->back;
    const lmb_mat4 m = {{sign * x.x - across * z.x, -sign * y.x - down * z.x, 0, 0,
                         sign * x.y - across * z.y, -sign * y.y - down * z.y, 0, 0,
                         sign * x.z - across * z.z, -sign * y.z - down * z.z, 0, 0, 0, 0, 0, 1}};
    return m;
}

/* Its box would do only for an object that fills it: one that is turned does not. */
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

int mix_is_inside(const mix_job *j)
{
    const lmb_pinhole *c = &j->frame.camera;
    const lmb_mat4 low = edges(&j->axes, 1.0f, (c->cx + 0.5f) / c->fx, (c->cy + 0.5f) / c->fy),
                   high = edges(&j->axes, -1.0f, ((float)c->width - 0.5f - c->cx) / c->fx,
                                ((float)c->height - 0.5f - c->cy) / c->fy);
    return is_within(j, &low) && is_within(j, &high);
}
