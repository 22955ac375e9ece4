/* room.h: shared by the examples: a scene of a floor, a back wall, a red wall and a block, lit by one spot
 * light, and the end of main.
 *
 * A scene is plain data and must not move: meshes and materials, instances that place a mesh in the world, lights.
 * Metres, +Y up. An instance's first_id counts triangles through the scene, from 1. */
#ifndef EXAMPLE_ROOM_H
#define EXAMPLE_ROOM_H

#include <lambent/lambent.h>

#include <stdio.h>
#include <string.h>

static const float white_corners[][3] = {
    {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1},                                     /* floor */
    {-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1},                                   /* back wall */
    {0.1f, 0, -0.5f}, {0.6f, 0, -0.5f}, {0.6f, 0, 0}, {0.1f, 0, 0},                     /* block, below */
    {0.1f, 0.7f, -0.5f}, {0.6f, 0.7f, -0.5f}, {0.6f, 0.7f, 0}, {0.1f, 0.7f, 0}};        /* block, above */
static const uint16_t white_indices[][3] = {
    {0, 1, 2},  {0, 2, 3},   {4, 5, 6},   {4, 6, 7},   {12, 13, 14}, {12, 14, 15}, {8, 9, 13},
    {8, 13, 12}, {9, 10, 14}, {9, 14, 13}, {10, 11, 15}, {10, 15, 14}, {11, 8, 12}, {11, 12, 15}};
static const float red_corners[][3] = {{-1, 0, -1}, {-1, 0, 1}, {-1, 2, 1}, {-1, 2, -1}};
static const uint16_t red_indices[][3] = {{0, 1, 2}, {0, 2, 3}};

static const lmb_vec3 room_eye = {0.9f, 1.1f, 2.6f}, room_middle = {-0.1f, 0.6f, -0.4f}, room_up = {0, 1, 0};

/* Fills in the arguments: two meshes, materials and instances, and a light. */
static inline lmb_scene room_scene(lmb_mesh mesh[2], lmb_material material[2], lmb_instance place[2], lmb_light *light)
{
    static const float colour[2][3] = {{0.8f, 0.8f, 0.8f}, {0.8f, 0.1f, 0.1f}};
    lmb_scene s;
    memset(&s, 0, sizeof s);
    memset(mesh, 0, 2 * sizeof *mesh);
    memset(material, 0, 2 * sizeof *material);
    memset(place, 0, 2 * sizeof *place);
    memset(light, 0, sizeof *light);
    for (uint32_t i = 0; i < 2; ++i) {
        mesh[i].positions = i == 0 ? (const void *)white_corners : red_corners;
        mesh[i].indices = i == 0 ? (const void *)white_indices : red_indices;
        mesh[i].vertex_count = i == 0 ? 16 : 4;
        mesh[i].triangle_count = i == 0 ? 14 : 2;
        mesh[i].index_format = LMB_INDEX_U16;
        memcpy(material[i].albedo, colour[i], sizeof colour[i]);
        material[i].alpha = 1.0f;
        material[i].texture = -1;
        material[i].flags = LMB_DOUBLE_SIDED;
        for (int d = 0; d < 4; ++d) {
            place[i].to_world.m[5 * d] = 1.0f;
        }
        place[i].mesh = place[i].material = i;
        place[i].first_id = i == 0 ? 1 : 15;
    }
    light->kind = LMB_LIGHT_SPOT;
    light->position.y = 2.5f;
    light->direction.y = -1.0f;
    light->intensity[0] = light->intensity[1] = light->intensity[2] = 12.0f;
    light->cos_inner = 0.9f;
    light->cos_outer = 0.8f;
    s.meshes = mesh, s.materials = material, s.instances = place, s.lights = light;
    s.mesh_count = s.material_count = s.instance_count = 2;
    s.light_count = 1;
    lmb_scene_bounds(&s.bounds_min, &s.bounds_max, &s);
    return s;
}

/* A frame's light depends on the capacities of the configuration (config.h), for example on the cuts of a tree. */
#ifdef LMB_CONFIG_TINY
#define BY_CONFIG(usual, tiny) (tiny)
#else
#define BY_CONFIG(usual, tiny) (usual)
#endif

/* Prints the last line of an example and returns the exit status: 0 if the result is as expected. */
static inline int ends_with(const char *what, uint64_t got, uint64_t expected)
{
    printf("%s: %08lx%08lx%s\n", what, (unsigned long)(got >> 32), (unsigned long)(got & 0xffffffffu),
           got == expected ? "" : ", which is not what was expected");
    return got != expected;
}

#endif
