/* sphere_relief.h: a sphere of radius 1 and a relief of it, as tests draw them. */
#ifndef SPHERE_RELIEF_H
#define SPHERE_RELIEF_H

#include "world.h"

#include <stdlib.h>

#include "../tools/relief/relief_bake.h"
#include "../tools/relief/relief_draw.h"
#include "../tools/relief/relief_model.h"

enum { TEXELS = 64, FRAME = 128, STACKS = 48, SLICES = 96, VIEWS = 26, MAP = 256 };

/* Around a sphere of radius 1. */
static float cube_positions[24], cube_normals[24], cube_colours[24];
static uint32_t cube_indices[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

static inline triangle_mesh cube(float half)
{
    triangle_mesh m = {8, 12, cube_positions, cube_normals, cube_colours, cube_indices};
    for (int i = 0; i < 24; ++i) {
        cube_positions[i] = i / 3 >> i % 3 & 1 ? half : -half;
        cube_normals[i] = cube_positions[i] / (half * 1.7320508f);
        cube_colours[i] = 0.25f;
    }
    return m;
}

typedef struct stage {
    triangle_mesh sphere; /* of `world`, with smooth normals */
    relief_scene complex;
    relief_bake bake;
    file_bytes file;
    lmb_relief relief;
} stage;

/* Colours that differ all around. */
static inline void paint(triangle_mesh *m)
{
    for (uint32_t i = 0; i < 3 * m->vertex_count; ++i) {
        m->colours[i] = 0.5f + 0.4f * m->positions[i];
    }
}

/* On a cube; `triangles` over 0: on a simpler sphere of about so many. */
static inline stage *stage_make(int32_t format, uint32_t triangles)
{
    report r = {""};
    stage *s = calloc(1, sizeof *s);
    lmb_vec3 direction[VIEWS];
    const triangle_mesh box = cube(1.05f);
    triangle_mesh fewer = {0, 0, NULL, NULL, NULL, NULL};
    simplify_facts facts;
    if (s == NULL) {
        abort();
    }
    world_begin(1.0f, 1.0f, 1.0f);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    CHECK(relief_flatten(&s->sphere, &world.scene, &r));
    paint(&s->sphere);
    CHECK(relief_scene_of(&s->complex, &s->sphere, &r));
    relief_directions(direction, VIEWS);
    s->bake.format = format;
    for (int i = 0; i < VIEWS; ++i) {
        const lmb_view v = relief_fit(&s->sphere, direction[i], TEXELS);
        CHECK(relief_add(&s->bake, &s->complex.scene, &v, &r));
    }
    CHECK(triangles == 0 || simplify_mesh(&fewer, &s->sphere, triangles, SIMPLIFY_AROUND, &facts, &r));
    CHECK(relief_encode(&s->file, &s->bake, triangles > 0 ? &fewer : &box, &r));
    triangle_mesh_free(&fewer);
    CHECK_MSG(lmb_relief_open(&s->relief, s->file.data, s->file.size) == LMB_OK, "%s", r.text);
    return s;
}

static inline void stage_free(stage *s)
{
    triangle_mesh_free(&s->sphere);
    relief_scene_free(&s->complex);
    relief_bake_free(&s->bake);
    file_free(&s->file);
    free(s);
}

static inline relief_shot shot_of(const stage *s, const lmb_view *view)
{
    relief_shot shot;
    memset(&shot, 0, sizeof shot);
    shot.kernels = picked_kernels();
    shot.view = *view;
    shot.relief = &s->relief;
    return shot;
}

static inline relief_frame shoot(const relief_shot *shot)
{
    report r = {""};
    relief_frame f;
    CHECK_MSG(relief_shoot(&f, shot, &r), "%s", r.text);
    return f;
}

#endif
