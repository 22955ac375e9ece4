/* transfer_air.c: light on moving objects, from points in the air around them. Layer 7.
 *
 * The eight grid points around a pixel have trilinear weights, times a factor that falls with the angle between the
 * face normal and the way to the point: behind the face a wall and another room may lie. Light comes from six sides; a
 * normal takes a share of each equal to the normal's squared component along that axis (McTaggart 2004, ambient
 * cube). */
#include "air.h"

#include <string.h>

#include "../base/vec.h"

#if LMB_TRANSFER

#define BEHIND_SHARE 0.02f /* this factor straight behind the face: it counts if no point is in front */

int lmb_transfer_moves(const lmb_transfer *t, uint32_t id)
{
    const uint32_t *range = t->section[LMB_TRANSFER_MOVING];
    uint32_t i = 0;
    while (i < t->count[LMB_TRANSFER_MOVING] && id >= range[2 * i + 1]) {
        ++i;
    }
    return id == LMB_TRANSFER_NONE || (i < t->count[LMB_TRANSFER_MOVING] && id >= range[2 * i]);
}

/* Grid points around a position along an axis, and the fraction from the first to the second. */
typedef struct along {
    uint32_t low, high;
    float share;
} along;

static along along_axis(const uint32_t *grid, int axis, float at)
{
    float low, per;
    along out;
    memcpy(&low, grid + axis, sizeof low);
    memcpy(&per, grid + 3, sizeof per);
    const uint32_t last = grid[4 + axis] - 1;
    const float place = clampf((at - low) * per, 0.0f, (float)last);
    out.low = (uint32_t)place;
    out.high = out.low < last ? out.low + 1 : last;
    out.share = place - (float)out.low;
    return out;
}

static float weight_before(const uint32_t *grid, const uint32_t place[3], lmb_vec3 at, lmb_vec3 face)
{
    float low[3], per;
    memcpy(low, grid, sizeof low);
    memcpy(&per, grid + 3, sizeof per);
    const float step = per > 0.0f ? 1.0f / per : 0.0f;
    const lmb_vec3 to = sub3(vec3(low[0] + (float)place[0] * step, low[1] + (float)place[1] * step,
                                  low[2] + (float)place[2] * step), at);
    const float length = length3(to), cosine = length > 0.0f ? dot3(to, face) / length : 1.0f;
    const float before = 0.5f * cosine + 0.5f;
    return before * before + BEHIND_SHARE;
}

/* Adds the light for a normal, from the six receivers starting at `first`. */
static void add_place(float sum[3], const lmb_transfer_light *light, uint32_t first, const float normal[3],
                      float weight)
{
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const float *received = light->receiver[first + 2 * axis + (normal[axis] < 0.0f)];
        const float share = weight * normal[axis] * normal[axis];
        for (int c = 0; c < 3; ++c) {
            sum[c] += share * received[c];
        }
    }
}

void lmb_transfer_air_pixel(lmb_irradiance *inout, const lmb_transfer_light *light, const lmb_transfer *t,
                        const lmb_tile *tile, int k)
{
    const uint32_t *grid = t->section[LMB_TRANSFER_GRID];
    const lmb_vec3 at = vec3(tile->position[0][k], tile->position[1][k], tile->position[2][k]),
                   face = vec3(tile->face[0][k], tile->face[1][k], tile->face[2][k]);
    const float normal[3] = {tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]};
    float sum[3] = {0.0f, 0.0f, 0.0f}, weights = 0.0f;
    if (t->count[LMB_TRANSFER_GRID] == 0) {
        return;
    }
    const along a[3] = {along_axis(grid, 0, at.x), along_axis(grid, 1, at.y), along_axis(grid, 2, at.z)};
    for (int i = 0; i < 8; ++i) {
        const uint32_t place[3] = {i & 1 ? a[0].high : a[0].low, i & 2 ? a[1].high : a[1].low,
                                   i & 4 ? a[2].high : a[2].low};
        const uint32_t first =
            t->section[LMB_TRANSFER_AIR][place[0] + (size_t)grid[4] * (place[1] + (size_t)grid[5] * place[2])];
        const float near = (i & 1 ? a[0].share : 1.0f - a[0].share) * (i & 2 ? a[1].share : 1.0f - a[1].share) *
                           (i & 4 ? a[2].share : 1.0f - a[2].share);
        if (first != LMB_TRANSFER_NONE && near > 0.0f) {
            const float weight = near * weight_before(grid, place, at, face);
            add_place(sum, light, first, normal, weight);
            weights += weight;
        }
    }
    for (int c = 0; c < 3 && weights > 0.0f; ++c) {
        inout->rgb[c][k] += maxf(sum[c] / weights, 0.0f);
    }
}

#endif
