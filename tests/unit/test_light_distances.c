/* test_light_distances.c: tests that distances around a probe of `lambent bake --to probes` are right, and that they keep
 * light from passing through a wall. */
#include "../../tools/bake/light_distances.h"

#include <math.h>

#include "../world.h"

void test_light_distances(void);

/* Inverse distance along its face's axis of a wall, whose inverse distance is `per` along the unit vector n, in the middle
 * of texel t, by the definition in light_distances.h. */
static float inverse_at(int t, lmb_vec3 n, float per)
{
    const int side = LIGHT_DISTANCES_SIDE, face = t / (side * side), a = face / 2;
    float d[3], sum = 0.0f;
    d[a] = face % 2 ? -1.0f : 1.0f;
    d[(a + 1) % 3] = (float)(2 * (t % side) + 1) / (float)side - 1.0f;
    d[(a + 2) % 3] = (float)(2 * (t / side % side) + 1) / (float)side - 1.0f;
    sum = d[0] * n.x + d[1] * n.y + d[2] * n.z;
    return per * maxf(sum, 0.0f);
}

/* (x, y, z) turned so that +x becomes one of the six axes. */
static lmb_vec3 turned(int turn, float x, float y, float z)
{
    const float along = turn % 2 ? -x : x;
    return turn / 2 == 0 ? vec3(along, y, z) : turn / 2 == 1 ? vec3(z, along, y) : vec3(y, z, along);
}

/* A wall on the plane x = 0, turned, and a probe half a metre before it. */
static void test_wall(int turn)
{
    static float map[LIGHT_DISTANCES];
    const lmb_vec3 probe = turned(turn, -0.5f, 0.25f, -0.125f), out = turned(turn, -1, 0, 0), in = turned(turn, 1, 0, 0);
    report r = {""};
    ray_space space;
    world_begin(1, 1, 1);
    world_quad(vec3(0.0f, 0.0f, 0.0f), turned(turn, 0, 9, 0), turned(turn, 0, 0, 9));
    CHECK(world_end() == LMB_OK && ray_space_make(&space, &world.scene, &r));
    light_distances(map, &space, probe, 0.01f);
    for (int t = 0; t < LIGHT_DISTANCES / 2; ++t) {
        const float wanted = inverse_at(t, in, 2.0f), is = map[2 * t], square = map[2 * t + 1];
        CHECK_MSG(fabsf(is - wanted) < 1e-5f, "turn %d, texel %d: %g, not %g", turn, t, (double)is, (double)wanted);
        CHECK_MSG(square >= is * is * 0.99999f && square <= is * 2.00001f, "turn %d, texel %d: square %g of %g", turn, t,
                  (double)square, (double)is);
    }
    double front = 0.0, back = 0.0, near = 0.0, beyond = 0.0, faced = 0.0; /* sums of weights: on the faces, in the air */
    for (int k = 0; k < 49; ++k) {
        const float y = 0.25f * (float)(k % 7 - 3), z = 0.25f * (float)(k / 7 - 3);
        front += (double)light_distances_weight(map, probe, 1.0f, turned(turn, 0.0f, y, z), out);
        back += (double)light_distances_weight(map, probe, 1.0f, turned(turn, 0.01f, y, z), in);
        faced += (double)light_distances_weight(map, probe, 1.0f, turned(turn, -0.3f, y, z), out);
        near += (double)light_distances_weight(map, probe, 1.0f, turned(turn, -0.3f, y, z), in);
        beyond += (double)light_distances_weight(map, probe, 1.0f, turned(turn, 0.45f, y, z), out);
    }
    CHECK_MSG(front > 49 * 0.4 && near > 49 * 0.3, "turn %d: before the wall %g, %g", turn, front, near);
    CHECK_MSG(faced > 2.0 * near, "turn %d: towards the probe %g, away from it %g", turn, faced, near);
    CHECK_MSG(back < 0.03 * front && beyond < 0.15 * near, "turn %d: behind it %g of %g, %g of %g", turn, back, front,
              beyond, near);
    ray_space_free(&space);
}

void test_light_distances(void)
{
    for (int turn = 0; turn < 6; ++turn) {
        test_wall(turn);
    }
}
