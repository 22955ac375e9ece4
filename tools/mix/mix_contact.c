/* mix_contact.c: makes the object touch the measured surface; reports nearby places if there is nothing to stand on. */
#include "mix_job.h"

#include <math.h>

/* Maximum bend of a plane by sensor error. A larger gap is a step next to the foot. */
#define MAX_BEND 0.05f

#define FACES_UP 0.90630779f /* cosine of 25 degrees */

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 times(lmb_vec3 v, float s)
{
    const lmb_vec3 out = {v.x * s, v.y * s, v.z * s};
    return out;
}

/* Unit normal, towards the camera, of the plane inverse = slope . (ray x, ray y, 1). */
static lmb_vec3 normal_of(const float slope[3])
{
    const lmb_vec3 n = {-slope[0], -slope[1], slope[2]};
    return times(n, 1.0f / sqrtf(dot(n, n)));
}

/* Moves a point so that the inverse distance grows by dq. */
static lmb_vec3 moved(lmb_vec3 p, float dq) { return times(p, 1.0f / (1.0f - p.z * dq)); }

void mix_lift_plane(mix_job *j, int32_t plane, float dq)
{
    lmb_flat *p = &j->planes.plane[plane];
    const size_t pixels = (size_t)j->frame.camera.width * (size_t)j->frame.camera.height;
    p->slope[2] += dq;
    p->normal = normal_of(p->slope);
    p->centre = moved(p->centre, dq);
    p->distance = -dot(p->normal, p->centre);
    for (size_t i = 0; i < pixels; ++i) {
        if (j->planes.label[i] == plane + 1) {
            j->cloud.inverse[i] = fmaxf(j->cloud.inverse[i] + dq, 0.0f);
            j->cloud.normal[i] = p->normal;
        }
    }
}

void mix_touch(mix_job *j, float gap_m)
{
    if (j->floor < 0 || !(fabsf(gap_m) <= MAX_BEND)) {
        return;
    }
    const float dq = 1.0f / (gap_m - j->anchor.z) + 1.0f / j->anchor.z;
    mix_lift_plane(j, j->floor, dq);
    j->anchor = moved(j->anchor, dq);
    j->up = j->hangs ? j->up : j->planes.plane[j->floor].normal;
}

/* Squared distance of a pixel from --at. Infinite if the plane there does not face up, or, if `whole`, if the object
 * would not be wholly in view. */
static float unfit(const mix_job *j, int32_t x, int32_t y, lmb_vec3 up, const mix_extent *e, int whole)
{
    const int32_t label = j->planes.label[y * j->frame.camera.width + x];
    const float i = (float)x - j->o.at_px[0], k = (float)y - j->o.at_px[1];
    lmb_vec3 at;
    if (label == 0 || dot(j->planes.plane[label - 1].normal, up) <= FACES_UP ||
        (whole && (!lmb_planes_anchor(&at, &j->planes, &j->frame.camera, label - 1, (float)x, (float)y) ||
                   !mix_is_in_view(j, &j->planes.plane[label - 1], at, e)))) {
        return INFINITY;
    }
    return i * i + k * k;
}

int mix_plane_near(int32_t at[2], const mix_job *j)
{
    const int32_t w = j->frame.camera.width, pixels = w * j->frame.camera.height;
    const lmb_vec3 up = mix_up(j);
    mix_extent e = mix_extent_of(j);
    float min = INFINITY;
    e.radius *= 1.4142136f; /* the corners of the box, for any rotation */
    for (int whole = 1; whole >= 0 && min == INFINITY; --whole) {
        for (int32_t i = 0; i < pixels; ++i) {
            const float far = unfit(j, i % w, i / w, up, &e, whole);
            if (far < min) {
                min = far;
                at[0] = i % w;
                at[1] = i / w;
            }
        }
    }
    return min < INFINITY;
}

int mix_fail_at(const mix_job *j, report *r)
{
    int32_t at[2] = {0, 0};
    const int x = (int)j->o.at_px[0], y = (int)j->o.at_px[1];
    return mix_plane_near(at, j)
               ? report_fail(
                     r, "--at %d,%d: neither a plane nor any depth there; the nearest pixel that would do is %d,%d", x,
                     y, (int)at[0], (int)at[1])
               : report_fail(r,
                             "--at %d,%d: neither a plane nor any depth there, and no plane faces up; lambent mix "
                             "--show planes shows them",
                             x, y);
}

int mix_fail_depth(const mix_job *j, report *r)
{
    const int32_t pixels = j->frame.camera.width * j->frame.camera.height;
    int32_t count = 0;
    float near = INFINITY, far = 0.0f;
    for (int32_t i = 0; i < pixels; ++i) {
        const float d = j->frame.depth[i];
        if (d > 0.0f && d < INFINITY) {
            near = fminf(near, d);
            far = fmaxf(far, d);
            ++count;
        }
    }
    return count > 0
               ? report_fail(r,
                             "no plane in the depth to stand on; %.3g %% of its pixels are measured, %.3g .. %.3g m "
                             "away: --depth-scale sets its unit, --at X,Y says where the object stands",
                             100.0 * (double)count / (double)pixels, (double)near, (double)far)
               : report_fail(r, "nothing to stand on: no pixel of the depth has a number over 0, so none is measured");
}
