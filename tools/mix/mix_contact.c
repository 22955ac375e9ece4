/* mix_contact.c: the object touches what was measured; and the nearest place where it would have a plane to stand on. */
#include "mix_job.h"

#include <math.h>

/* What sensors bend a plane by at most; more is a step that the foot stands beside. */
#define MAX_BEND 0.05f

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 times(lmb_vec3 v, float s)
{
    const lmb_vec3 out = {v.x * s, v.y * s, v.z * s};
    return out;
}

/* Unit, towards the camera, of inverse = slope . (ray x, ray y, 1). */
static lmb_vec3 normal_of(const float slope[3])
{
    const lmb_vec3 n = {-slope[0], -slope[1], slope[2]};
    return times(n, 1.0f / sqrtf(dot(n, n)));
}

/* A point's place when inverse distances grow by dq. */
static lmb_vec3 moved(lmb_vec3 p, float dq) { return times(p, 1.0f / (1.0f - p.z * dq)); }

void mix_touch(mix_job *j, float gap_m)
{
    lmb_flat *p = &j->planes.plane[j->floor >= 0 ? j->floor : 0];
    const size_t pixels = (size_t)j->frame.camera.width * (size_t)j->frame.camera.height;
    if (j->floor < 0 || !(fabsf(gap_m) <= MAX_BEND)) {
        return;
    }
    const float dq = 1.0f / (gap_m - j->anchor.z) + 1.0f / j->anchor.z;
    p->slope[2] += dq;
    p->normal = normal_of(p->slope);
    p->centre = moved(p->centre, dq);
    p->distance = -dot(p->normal, p->centre);
    j->anchor = moved(j->anchor, dq);
    j->up = j->hangs ? j->up : p->normal;
    for (size_t i = 0; i < pixels; ++i) {
        if (j->planes.label[i] == j->floor + 1) {
            j->cloud.inverse[i] = fmaxf(j->cloud.inverse[i] + dq, 0.0f);
            j->cloud.normal[i] = p->normal;
        }
    }
}

int mix_plane_near(int32_t at[2], const mix_job *j)
{
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height;
    const lmb_vec3 up = lmb_planes_up(&j->planes);
    float min = INFINITY;
    for (int32_t y = 0; y < h; ++y) {
        for (int32_t x = 0; x < w; ++x) {
            const int32_t label = j->planes.label[y * w + x];
            const float i = (float)x - j->o.at_px[0], k = (float)y - j->o.at_px[1], far = i * i + k * k;
            if (label > 0 && far < min && dot(j->planes.plane[label - 1].normal, up) > 0.9f) {
                min = far;
                at[0] = x;
                at[1] = y;
            }
        }
    }
    return min < INFINITY;
}
