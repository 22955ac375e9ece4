/* torus.h: a torus of 578 triangles and the floor below it, made by public calls alone: the same bytes on every machine. */
#ifndef TORUS_H
#define TORUS_H

#include <lambent/lambent.h>
#include <string.h>

enum { TORUS_SIDES = 17, TORUS_VERTICES = TORUS_SIDES * TORUS_SIDES, TORUS_TRIANGLES = 2 * TORUS_VERTICES };

typedef struct torus {
    float positions[3 * TORUS_VERTICES], floor[12];
    uint16_t indices[3 * TORUS_TRIANGLES];
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance instance[2];
    lmb_light light;
    lmb_scene scene;
} torus;

static inline void torus_mesh(torus *t)
{
    const float turn = 6.28318531f / TORUS_SIDES;
    for (int i = 0; i < TORUS_SIDES; ++i) {
        const float c = lmb_cos((float)i * turn), s = lmb_sin((float)i * turn);
        for (int k = 0; k < TORUS_SIDES; ++k) {
            float *p = t->positions + 3 * (i * TORUS_SIDES + k);
            const float from_axis = 0.7f * lmb_cos((float)k * turn);
            const float r = 1.5f + from_axis, up = 0.49f - from_axis * from_axis;
            const float y = lmb_sqrt(up > 0.0f ? up : 0.0f);
            p[0] = r * c;
            p[1] = 0.8f + (2 * k < TORUS_SIDES ? y : -y);
            p[2] = r * s;
        }
    }
    for (int i = 0; i < TORUS_VERTICES; ++i) {
        const int ring = i / TORUS_SIDES, k = i % TORUS_SIDES, next = (ring + 1) % TORUS_SIDES * TORUS_SIDES,
                  up = (k + 1) % TORUS_SIDES, own = ring * TORUS_SIDES;
        uint16_t *to = t->indices + 6 * i;
        to[0] = (uint16_t)(own + k);
        to[1] = to[4] = (uint16_t)(own + up);
        to[2] = to[3] = (uint16_t)(next + k);
        to[5] = (uint16_t)(next + up);
    }
}

/* The whole scene, lit by a spot. */
static inline void torus_make(torus *t)
{
    static const float corners[12] = {-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4};
    static const uint16_t two[6] = {0, 1, 2, 0, 2, 3};
    memset(t, 0, sizeof *t);
    torus_mesh(t);
    memcpy(t->floor, corners, sizeof corners);
    for (int i = 0; i < 2; ++i) {
        t->mesh[i].positions = i == 0 ? t->positions : t->floor;
        t->mesh[i].indices = i == 0 ? t->indices : two;
        t->mesh[i].position_format = LMB_POSITION_F32;
        t->mesh[i].index_format = LMB_INDEX_U16;
        t->mesh[i].vertex_count = i == 0 ? TORUS_VERTICES : 4;
        t->mesh[i].triangle_count = i == 0 ? TORUS_TRIANGLES : 2;
        t->material[i].texture = -1;
        t->material[i].alpha = 1.0f;
        t->material[i].albedo[0] = i == 0 ? 0.8f : 0.6f;
        t->material[i].albedo[1] = i == 0 ? 0.3f : 0.6f;
        t->material[i].albedo[2] = i == 0 ? 0.2f : 0.7f;
        t->instance[i].mesh = t->instance[i].material = (uint32_t)i;
        t->instance[i].first_id = i == 0 ? 1 : 1 + TORUS_TRIANGLES;
        for (int k = 0; k < 4; ++k) {
            t->instance[i].to_world.m[5 * k] = 1.0f;
        }
    }
    t->light.kind = LMB_LIGHT_SPOT;
    t->light.position.x = 1.0f;
    t->light.position.y = 5.0f;
    t->light.position.z = 1.5f;
    const float length = lmb_sqrt(0.04f + 1.0f + 0.09f);
    t->light.direction.x = -0.2f / length;
    t->light.direction.y = -1.0f / length;
    t->light.direction.z = -0.3f / length;
    t->light.intensity[0] = t->light.intensity[1] = t->light.intensity[2] = 60.0f;
    t->light.cos_inner = 0.875f;
    t->light.cos_outer = 0.75f;
    t->scene.meshes = t->mesh;
    t->scene.materials = t->material;
    t->scene.instances = t->instance;
    t->scene.lights = &t->light;
    t->scene.mesh_count = t->scene.material_count = t->scene.instance_count = 2;
    t->scene.light_count = 1;
    lmb_scene_bounds(&t->scene.bounds_min, &t->scene.bounds_max, &t->scene);
}

#endif
