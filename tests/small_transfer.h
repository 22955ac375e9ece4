/* small_transfer.h: a .lmt made by hand, the same on every machine: of a scene's first four triangles the floor (1, 2)
 * and the ceiling (3, 4) of small_room, each with its front alone. */
#ifndef SMALL_TRANSFER_H
#define SMALL_TRANSFER_H

#include <string.h>

#include <lambent/transfer.h>

#include "../src/base/poly.h"
#include "../src/base/vec.h"

/* The floor is halved: elements 0 and 1 are the halves of triangle 1, 2 is triangle 2, 3 all of the ceiling. Receivers
 * 0 .. 3 are the floor's corners, 4 lies between 0 and 1. The ceiling has clusters; the second one takes a fifth of the
 * first one's light. Each element is a coarse one too. */
enum { ROOM_TRIANGLES = 4, SMALL_ELEMENTS = 4, SMALL_NODES = 5, SMALL_RECEIVERS = 5, SMALL_CLUSTERS = 2 };
#define SMALL_TRANSFER_WORDS(triangles) (135 + 4 * (triangles))

#define SMALL_ONE      (1.0f / 32768.0f) /* scale: a weight of 32768 would be 1 */
#define SMALL_LINK(node, weight) ((uint32_t)(uint16_t)(int16_t)(weight) << 16 | (uint32_t)(node))
#define SMALL_LEAF(n)  (LMB_TRANSFER_LEAF | (uint32_t)(n))
#define SMALL_HALF(edge, first) ((uint32_t)(edge) << LMB_TRANSFER_EDGE_BIT | (uint32_t)(first))

typedef struct small_words {
    uint32_t *word;
    size_t count;
} small_words;

static inline void small_put(small_words *w, uint32_t head_word, const uint32_t *word, uint32_t count, uint32_t each)
{
    w->word[head_word] = count / each;
    memcpy(w->word + w->count, word, count * sizeof *word);
    w->count += count;
}

/* Into SMALL_TRANSFER_WORDS(triangles of the scene) words; the scene has at least four. Returns the file's bytes. */
static inline size_t small_transfer(uint32_t *words, const lmb_scene *scene)
{
    const uint32_t one = float_bits(SMALL_ONE), none = LMB_TRANSFER_NONE, all = lmb_scene_triangles(scene);
    const uint32_t pieces[] = {SMALL_HALF(0, 4), SMALL_LEAF(2), SMALL_LEAF(3), SMALL_LEAF(3), SMALL_LEAF(0),
                               SMALL_LEAF(1)};
    const uint32_t areas[] = {float_bits(1.0f), float_bits(1.0f), float_bits(2.0f), float_bits(4.0f)};
    const uint32_t divisions[] = {SMALL_HALF(0, 4), SMALL_LEAF(2), SMALL_LEAF(3), SMALL_LEAF(4), SMALL_LEAF(0),
                                  SMALL_LEAF(1)};
    const uint32_t corners[] = {0, 4, 2, 4, 1, 2, 0, 2, 3, 0, 0, 1, 0, 1, 1};
    const uint32_t receivers[] = {none, none, 0, 2, one, none, none, 2, 2, one, none, none, 4, 2, one,
                                  none, none, 6, 2, one, 0, 1, 8, 1, one};
    const uint32_t links[] = {SMALL_LINK(3, 16384), SMALL_LINK(2, 0),    SMALL_LINK(3, 8192),
                              SMALL_LINK(2, 1024),  SMALL_LINK(3, 4096), SMALL_LINK(2, 2048),
                              SMALL_LINK(3, 2048),  SMALL_LINK(2, 4096), SMALL_LINK(4, -2048)};
    const uint32_t blends[] = {0u | 1u << 16, 0u, 255u, 0u | 1u << 16, 0u, 55u | 200u << 8};
    const uint32_t clusters[] = {0, 0, 0, 0, 2, one, 0, 0, 51, 2, 1, one};
    const uint32_t cluster_links[] = {SMALL_LINK(0, 4096),  SMALL_LINK(-8192 & 0xffff, 0),
                                      SMALL_LINK(1, -4096), SMALL_LINK(-8192 & 0xffff, 512),
                                      SMALL_LINK(2, 0),     SMALL_LINK(-16384 & 0xffff, 0)};
    const uint32_t coarse[] = {0, 0, 1, one, 1, 1, 1, one, 2, 2, 1, one, 3, 3, 3, one};
    const uint32_t coarse_links[] = {SMALL_LINK(3, 8192), SMALL_LINK(3, 8192), SMALL_LINK(3, 8192),
                                     SMALL_LINK(0, 2048), SMALL_LINK(1, 2048), SMALL_LINK(2, 4096)};
    small_words w = {words, LMB_TRANSFER_HEADER_WORDS};
    memset(words, 0, LMB_TRANSFER_HEADER_WORDS * sizeof *words);
    memcpy(words, "LMT\3", 4);
    words[1] = 0x01020304u;
    lmb_transfer_fingerprint(words + 3, scene, NULL, 0);
    words[5] = 3;
    words[6] = all;
    for (uint32_t i = 0; i < 4 * all; ++i) {
        words[w.count++] = i < 16 && i % 2 == 0 ? i / 4 : none;
    }
    small_put(&w, 7, pieces, 6, 1);
    small_put(&w, 8, areas, 4, 1);
    small_put(&w, 9, divisions, 6, 1);
    small_put(&w, 10, corners, 15, LMB_TRANSFER_CORNER_WORDS);
    small_put(&w, 11, receivers, 25, LMB_TRANSFER_RECEIVER_WORDS);
    small_put(&w, 12, links, 9, 1);
    small_put(&w, 13, blends, 6, LMB_TRANSFER_BLEND_WORDS);
    small_put(&w, 14, clusters, 12, LMB_TRANSFER_CLUSTER_WORDS);
    small_put(&w, 15, cluster_links, 6, LMB_TRANSFER_CLUSTER_LINK_WORDS);
    small_put(&w, 16, coarse, 16, LMB_TRANSFER_COARSE_WORDS);
    small_put(&w, 17, coarse_links, 6, 1);
    words[2] = (uint32_t)(4 * w.count);
    return 4 * w.count;
}

/* The room: two squares of 2 m, 1 m apart, that face each other, and a spot between them that shines down. */
typedef struct small_room {
    float corners[ROOM_TRIANGLES][3][3];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_light light;
    lmb_scene scene;
} small_room;

static inline void small_room_make(small_room *r)
{
    static const float at[ROOM_TRIANGLES][3][3] = {
        {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}}, {{-1, 0, -1}, {1, 0, 1}, {1, 0, -1}},
        {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}}, {{-1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}};
    static const lmb_light spot = {{0, 0.75f, 0}, {0, -1, 0}, {2, 3, 5}, 0.9f, 0.7f, LMB_LIGHT_SPOT, 0, 0};
    memset(r, 0, sizeof *r);
    memcpy(r->corners, at, sizeof at);
    r->mesh.positions = &r->corners[0][0][0];
    r->mesh.triangle_count = ROOM_TRIANGLES;
    r->mesh.vertex_count = 3 * ROOM_TRIANGLES;
    for (int c = 0; c < 3; ++c) {
        r->material.albedo[c] = 0.5f;
    }
    r->material.alpha = 1.0f;
    r->material.texture = -1;
    for (int d = 0; d < 4; ++d) {
        r->instance.to_world.m[5 * d] = 1.0f;
    }
    r->instance.first_id = 1;
    r->light = spot;
    r->scene.meshes = &r->mesh;
    r->scene.materials = &r->material;
    r->scene.instances = &r->instance;
    r->scene.lights = &r->light;
    r->scene.mesh_count = r->scene.material_count = r->scene.instance_count = r->scene.light_count = 1;
    lmb_scene_bounds(&r->scene.bounds_min, &r->scene.bounds_max, &r->scene);
}

#endif
