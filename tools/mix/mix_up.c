/* mix_up.c: the up direction of a photo, and the plane that faces up. */
#include "mix_job.h"

#include <math.h>
#include <stddef.h>

#define LEVEL 0.90630779f  /* cosine of 25 degrees */
#define ACROSS 0.98480775f /* cosine of 10 degrees: maximum angle between a plane's normal and the pose's up */

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* A direction of the pose's world in camera space; without a pose, camera space is the world. */
static lmb_vec3 of_world(const mix_job *j, const float d[3])
{
    const double *p = j->frame.pose;
    lmb_vec3 out = {d[0], d[1], d[2]};
    if (j->frame.has_pose) {
        double to[3];
        for (int c = 0; c < 3; ++c) {
            to[c] = p[c] * (double)d[0] + p[4 + c] * (double)d[1] + p[8 + c] * (double)d[2];
        }
        out = (lmb_vec3){(float)to[0], (float)-to[1], (float)-to[2]};
    }
    const float length = sqrtf(dot(out, out));
    return (lmb_vec3){out.x / length, out.y / length, out.z / length};
}

static int is_across(const mix_job *j, lmb_vec3 up)
{
    for (int32_t i = 0; i < j->planes.count; ++i) {
        if (dot(j->planes.plane[i].normal, up) > ACROSS) {
            return 1;
        }
    }
    return 0;
}

/* Returns 0 if the planes must decide. */
static int told_up(lmb_vec3 *out, const mix_job *j)
{
    static const float axes[4][3] = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    if (j->o.up == MIX_UP_CAMERA) {
        *out = (lmb_vec3){0, 1, 0};
        return 1;
    }
    if (j->o.up != MIX_UP_FOUND) {
        *out = of_world(j, j->o.up == MIX_UP_POSE ? axes[0] : j->o.up_to);
        return 1;
    }
    /* Files of some data sets have +Y or +Z down, but few cameras are upside down. */
    for (int i = 0; i < 4 && j->frame.has_pose; ++i) {
        *out = of_world(j, axes[i]);
        if (out->y > (i & 1 ? 0.5f : -0.17f) && is_across(j, *out)) {
            return 1;
        }
    }
    return 0;
}

lmb_vec3 mix_up(const mix_job *j)
{
    lmb_vec3 up;
    return told_up(&up, j) ? up : lmb_planes_up(&j->planes);
}

int32_t mix_floor(const mix_job *j)
{
    lmb_vec3 up;
    int32_t best = -1;
    float max = 0.0f;
    if (!told_up(&up, j)) {
        return lmb_planes_floor(&j->planes);
    }
    for (int32_t i = 0; i < j->planes.count; ++i) {
        const lmb_flat *p = &j->planes.plane[i];
        const float size = (float)p->pixels * (dot(p->normal, up) - LEVEL);
        if (size > max) {
            max = size;
            best = i;
        }
    }
    return best;
}
