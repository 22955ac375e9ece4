/* peak_light.c: visibility of a world's peaks from a point, and their light in a map. Layer 5. [S5-S8] */
#include "../base/poly.h"
#include "../base/vec.h"
#include "world.h"

#if LMB_PROBES

/* Clamps points outside the world to the inside, like the kernels. */
static lmb_vec3 stand_at(const lmb_world_job *job, lmb_vec3 at)
{
    if (job->shape == LMB_WORLD_BOX) {
        return max3(min3(at, job->reach_high), job->reach_low);
    }
    const lmb_vec3 d = sub3(at, job->middle);
    const float length = length3(d);
    return length > job->reach ? add3(job->middle, mul3(d, job->reach / length)) : at;
}

static lmb_vec3 box_from_centre(lmb_vec3 *normal, const lmb_world_job *job, lmb_vec3 to)
{
    const float axis[3] = {to.x, to.y, to.z};
    const lmb_vec3 low = sub3(job->low, job->centre), high = sub3(job->high, job->centre);
    const float room[3] = {to.x > 0.0f ? high.x : low.x, to.y > 0.0f ? high.y : low.y, to.z > 0.0f ? high.z : low.z};
    float far = 1e20f;
    *normal = to;
    for (int i = 0; i < 3; ++i) {
        if (absf(axis[i]) > 1e-5f && room[i] / axis[i] < far) {
            far = room[i] / axis[i];
            *normal = vec3(i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f);
        }
    }
    return mul3(to, far);
}

static lmb_vec3 shape_from_centre(lmb_vec3 *normal, const lmb_world_job *job, lmb_vec3 to)
{
    if (job->shape == LMB_WORLD_BOX) {
        return box_from_centre(normal, job, to);
    }
    const lmb_vec3 from = sub3(job->centre, job->middle);
    const float b = dot3(from, to), far = sqrtf(maxf(b * b - (dot3(from, from) - job->radius2), 0.0f)) - b;
    const lmb_vec3 met = mul3(to, far);
    *normal = normalize3(add3(from, met));
    return met;
}

/* Point of the far world along `to` from the cube's centre, relative to the centre, and the normal there, of either
 * sign. */
static lmb_vec3 far_from_centre(lmb_vec3 *normal, const lmb_world_job *job, lmb_vec3 to)
{
    const lmb_vec3 far = shape_from_centre(normal, job, to);
    const float high = job->centre.y - job->ground.y;
    if (!job->has_floor || to.y > -1e-5f || -far.y < high) {
        return far;
    }
    *normal = vec3(0.0f, 1.0f, 0.0f);
    return mul3(to, high / -to.y);
}

/* Share of light from distance `far` along `to` that the ground's picture lets through, at the nearest texel. */
static float past_ground(const lmb_world_job *job, const lmb_world *world, lmb_vec3 at, lmb_vec3 to, float far)
{
    const lmb_vec3 from = sub3(at, job->ground);
    if (job->ground_levels == 0 || to.y > -1e-5f || from.y < 1e-6f) {
        return 1.0f;
    }
    const float t = from.y / -to.y, x = (from.x + t * to.x) * job->ground_per_x * job->ground_columns[0],
                z = (from.z + t * to.z) * job->ground_per_z * job->ground_rows[0];
    if (!(x >= 0.0f && x < job->ground_columns[0] && z >= 0.0f && z < job->ground_rows[0]) ||
        (!job->blend && t > far)) {
        return 1.0f;
    }
    float rgba[4];
    lmb_world_texel(rgba, world, (size_t)job->ground_from + (size_t)z * (size_t)job->ground_columns[0] + (size_t)x);
    return 1.0f - (job->blend ? 0.5f : 1.0f) * rgba[3];
}

/* A patch of the far world has constant radiance, so the flux changes with the solid angle: cosine over squared
 * distance. */
float lmb_world_see_peak(lmb_vec3 *to, const lmb_world_job *job, const lmb_world *world, const lmb_world_peak *peak,
                         lmb_vec3 at)
{
    lmb_vec3 normal;
    const lmb_vec3 stand = stand_at(job, at), from = far_from_centre(&normal, job, peak->to),
                   way = sub3(from, sub3(stand, job->centre));
    const float near2 = dot3(from, from), far2 = maxf(dot3(way, way), 1e-12f), far = sqrtf(far2);
    *to = mul3(way, 1.0f / far);
    const float grows = near2 / far2 * (absf(dot3(normal, *to)) / maxf(absf(dot3(normal, peak->to)), 1e-4f));
    const float times = minf(grows, 2.0f * LMB_PI / maxf(peak->area, 1e-12f));
    return times * past_ground(job, world, stand, *to, far);
}

void lmb_world_add_peaks(float *map, const lmb_probe_table *table, const lmb_world_job *job, const lmb_world *world,
                         lmb_vec3 at)
{
    const int32_t w = table->width, h = table->height;
    for (int32_t i = 0; i < world->peaks; ++i) {
        lmb_vec3 d;
        const float times = lmb_world_see_peak(&d, job, world, &world->peak[i], at);
        const float turn = (lmb_atan2(d.x, -d.z) - table->start) * (1.0f / (2.0f * LMB_PI)) + 2.0f;
        const float u = (turn - floorf(turn)) * (float)w - 0.5f,
                    v = clampf(lmb_acos(d.y) * (1.0f / LMB_PI) * (float)h - 0.5f, 0.0f, (float)(h - 1));
        const float left = floorf(u), top = floorf(v), fx = u - left, fy = v - top;
        for (int k = 0; k < 4; ++k) {
            const int32_t x = ((int32_t)left + (k & 1) + w) % w, y = mini((int32_t)top + (k >> 1), h - 1);
            const float part = times * ((k & 1 ? fx : 1.0f - fx) * (k & 2 ? fy : 1.0f - fy)) / table->area[y];
            for (int c = 0; c < 3; ++c) {
                map[(c * h + y) * w + x] += part * world->peak[i].flux[c];
            }
        }
    }
}

#endif
