/* light_distances.c: distances from a probe to the surfaces around it, and the weight of the probe for a place. */
#include "light_distances.h"

#include <math.h>

#include "../common/fvec.h"

enum { SIDE = LIGHT_DISTANCES_SIDE, RAYS = 3 }; /* RAYS x RAYS per texel */
#define SHIFT    0.2f  /* of the lattice's shortest step: the place is moved so far along its normal */
#define BEHIND   0.2f  /* weight of a probe straight behind the surface; 1.2: straight before it */
#define BLUR     0.02f /* of the mean: least deviation of inverse distances */
#define FAR_M    3e38f
#define UNSEEN    1e-4f /* weight of a probe that does not see the place, which counts if no probe does */
#define CRUSHED  0.2f  /* smaller weights fall with their third power */

/* The face of a direction, its place there, -1 .. 1, and the component along the face's axis. */
static int face_of(float at[2], float *along, lmb_vec3 way)
{
    const float v[3] = {way.x, way.y, way.z}, x = fabsf(way.x), y = fabsf(way.y), z = fabsf(way.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    *along = fabsf(v[axis]);
    at[0] = v[(axis + 1) % 3] / *along;
    at[1] = v[(axis + 2) % 3] / *along;
    return 2 * axis + (v[axis] < 0.0f);
}

/* Not of unit length: 1 along the face's axis. */
static lmb_vec3 way_of(int face, float u, float v)
{
    const float d = face % 2 ? -1.0f : 1.0f;
    return face / 2 == 0 ? vec3(d, u, v) : face / 2 == 1 ? vec3(v, d, u) : vec3(u, v, d);
}

void light_distances(float out[LIGHT_DISTANCES], ray_space *space, lmb_vec3 at, float nearest_m)
{
    for (int t = 0; t < 6 * SIDE * SIDE; ++t) {
        float sum = 0.0f, squares = 0.0f;
        for (int k = 0; k < RAYS * RAYS; ++k) {
            const float x = (float)(t % SIDE) + ((float)(k % RAYS) + 0.5f) / (float)RAYS,
                        y = (float)(t / SIDE % SIDE) + ((float)(k / RAYS) + 0.5f) / (float)RAYS;
            const lmb_vec3 way = way_of(t / (SIDE * SIDE), 2.0f * x / (float)SIDE - 1.0f,
                                        2.0f * y / (float)SIDE - 1.0f);
            const float length = length3(way);
            float far_m;
            const uint32_t hit = ray_nearest(&far_m, space, at, mul3(way, 1.0f / length), 0.0f, FAR_M);
            const float per = hit != 0 ? length / maxf(far_m, nearest_m) : 0.0f;
            sum += per;
            squares += per * per;
        }
        out[2 * t] = sum / (float)(RAYS * RAYS);
        out[2 * t + 1] = squares / (float)(RAYS * RAYS);
    }
}

/* Between texels of the face, and beyond their middles: exact for a plane, which is linear there. */
static float distance_at(float out[2], const float map[LIGHT_DISTANCES], lmb_vec3 way)
{
    float at[2], along;
    const int face = face_of(at, &along, way);
    const float x = (0.5f + 0.5f * at[0]) * (float)SIDE - 0.5f, y = (0.5f + 0.5f * at[1]) * (float)SIDE - 0.5f;
    const int i = (int)minf(maxf(x, 0.0f), (float)(SIDE - 2)), j = (int)minf(maxf(y, 0.0f), (float)(SIDE - 2));
    out[0] = out[1] = 0.0f;
    for (int k = 0; k < 4; ++k) {
        const float w = (k % 2 ? x - (float)i : 1.0f - x + (float)i) * (k / 2 ? y - (float)j : 1.0f - y + (float)j);
        const float *texel = map + 2 * ((face * SIDE + j + k / 2) * SIDE + i + k % 2);
        out[0] += w * texel[0];
        out[1] += w * texel[1];
    }
    return along;
}

float light_distances_weight(const float map[LIGHT_DISTANCES], lmb_vec3 probe, float step_m, lmb_vec3 at,
                             lmb_vec3 normal)
{
    const lmb_vec3 from = sub3(probe, at), shifted = sub3(add3(at, mul3(normal, SHIFT * step_m)), probe);
    const float far_m = length3(from);
    const float facing = far_m > 0.0f ? 0.5f + 0.5f * dot3(from, normal) / far_m : 1.0f;
    float seen = 1.0f, inverse[2];
    if (dot3(shifted, shifted) > 0.0f) {
        const float along = distance_at(inverse, map, shifted);
        const float over = inverse[0] - 1.0f / along, deviation = BLUR * inverse[0];
        const float variance = maxf(inverse[1] - inverse[0] * inverse[0], deviation * deviation);
        const float share = over > 0.0f ? variance / (variance + over * over) : 1.0f;
        seen = share * share * share;
    }
    const float w = maxf(seen * (facing * facing + BEHIND), UNSEEN);
    return w < CRUSHED ? w * w * w / (CRUSHED * CRUSHED) : w;
}
