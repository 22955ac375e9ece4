/* play_space.c: free space in a scene, tested by segments that any triangle may block. */
#include "play_space.h"

#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

int play_space_make(play_space *s, const lmb_scene *scene, const lmb_kernels *kernels, report *r)
{
    const uint32_t triangles = lmb_scene_triangles(scene);
    const size_t bytes = lmb_bvh_bytes(triangles);
    memset(s, 0, sizeof *s);
    s->kernels = kernels;
    s->traversal.bounded = 1;
    s->traversal.left = LMB_TRAVERSAL_FIRST;
    s->tile = calloc(1, sizeof *s->tile);
    s->memory = malloc(bytes > 0 ? bytes : 1);
    return (s->tile != NULL && s->memory != NULL && bytes > 0 &&
            lmb_bvh_init(&s->bvh, triangles, s->memory, bytes) == LMB_OK && lmb_bvh_build(&s->bvh, scene) == LMB_OK) ||
           report_fail(r, "not enough memory to see where there is room to move; give --path");
}

void play_space_free(play_space *s)
{
    free(s->tile);
    free(s->memory);
    memset(s, 0, sizeof *s);
}

int play_space_sees(play_space *s, lmb_vec3 from, const lmb_vec3 *place, int count)
{
    float noise = 0.0f;
    for (int i = 0; i < count; ++i) {
        s->tile->position[0][i] = place[i].x;
        s->tile->position[1][i] = place[i].y;
        s->tile->position[2][i] = place[i].z;
        s->tile->depth[i] = 1.0f;
        s->tile->id[i] = 1;
        noise = maxf(noise, lmb_place_noise(place[i], 0.0f));
    }
    s->tile->hits = count;
    const uint64_t pixels = count < 64 ? (UINT64_C(1) << count) - 1 : UINT64_MAX;
    noise += lmb_place_noise(from, 0.0f);
    return lmb_occluded_tile(s->kernels, &s->traversal, &s->bvh, s->tile, pixels, from, noise) == 0;
}

float play_space_reach(play_space *s, lmb_vec3 from, lmb_vec3 along, float far_m)
{
    float seen = 0.0f, blocked = far_m;
    for (int i = 0; i < 40 && blocked - seen > 1e-3f * blocked; ++i) {
        const float middle = 0.5f * (seen + blocked);
        const lmb_vec3 place = add3(from, mul3(along, middle));
        if (play_space_sees(s, from, &place, 1)) {
            seen = middle;
        } else {
            blocked = middle;
        }
    }
    return blocked;
}
