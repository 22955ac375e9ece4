/* test_relief_ornate.c: a relief of an ornate shape has no specks, of surface or of shadow. Requirements P7 P9 P12. */
#include "../test.h"

#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../tools/relief/relief_bake.h"
#include "../../tools/relief/relief_compare.h"
#include "../../tools/relief/relief_model.h"
#include "../baroque.h"

void test_relief_ornate(void);

enum { FINE = 96, SIMPLE = 1500, VIEWS = 26, TEXELS = 128, SIDE = 256, CAMERAS = 3 };

typedef struct ornate {
    triangle_mesh mesh, simple;
    relief_scene scene;
    relief_bake bake;
    file_bytes file;
    lmb_relief relief;
} ornate;

static void flatten(triangle_mesh *out, const triangle_mesh *in, report *r)
{
    lmb_mesh m = {.positions = in->positions, .indices = in->indices, .index_format = LMB_INDEX_U32,
                  .vertex_count = in->vertex_count, .triangle_count = in->triangle_count};
    lmb_material white = {.albedo = {0.7f, 0.7f, 0.7f}, .alpha = 1.0f, .roughness = 1.0f, .texture = -1};
    lmb_instance at = {.first_id = 1};
    const lmb_scene scene = {.meshes = &m, .materials = &white, .instances = &at, .mesh_count = 1,
                             .material_count = 1, .instance_count = 1};
    for (int i = 0; i < 4; ++i) {
        at.to_world.m[5 * i] = 1.0f;
    }
    CHECK(relief_flatten(out, &scene, r));
}

static ornate *ornate_make(int kind, uint32_t seed)
{
    report r = {""};
    ornate *o = calloc(1, sizeof *o);
    lmb_vec3 direction[VIEWS];
    simplify_facts facts;
    triangle_mesh bare = baroque(kind, seed, FINE);
    if (o == NULL) {
        abort();
    }
    flatten(&o->mesh, &bare, &r);
    triangle_mesh_free(&bare);
    CHECK(relief_scene_of(&o->scene, &o->mesh, &r));
    CHECK(simplify_mesh(&o->simple, &o->mesh, SIMPLE, SIMPLIFY_AROUND, &facts, &r));
    relief_directions(direction, VIEWS);
    o->bake.format = LMB_RELIEF_FULL;
    for (int i = 0; i < VIEWS; ++i) {
        const lmb_view v = relief_fit(&o->mesh, direction[i], TEXELS);
        CHECK(relief_add(&o->bake, &o->scene.scene, &v, &r));
    }
    CHECK_MSG(relief_encode(&o->file, &o->bake, &o->simple, &r) &&
              lmb_relief_open(&o->relief, o->file.data, o->file.size) == LMB_OK, "%s", r.text);
    return o;
}

static void ornate_free(ornate *o)
{
    triangle_mesh_free(&o->mesh);
    triangle_mesh_free(&o->simple);
    relief_scene_free(&o->scene);
    relief_bake_free(&o->bake);
    file_free(&o->file);
    free(o);
}

/* Means over pictures from all sides. */
static relief_figures compared(const ornate *o)
{
    static const lmb_light sun = {.direction = {-0.45f, -0.8f, -0.3968627f}, .intensity = {3.0f, 2.9f, 2.7f},
                                  .cos_inner = 1.0f, .cos_outer = 1.0f, .kind = LMB_LIGHT_DIRECTIONAL};
    const lmb_vec3 low = o->scene.scene.bounds_min, high = o->scene.scene.bounds_max,
                   middle = mul3(add3(low, high), 0.5f);
    const float across = length3(sub3(high, low));
    relief_figures mean;
    memset(&mean, 0, sizeof mean);
    for (int i = 0; i < CAMERAS; ++i) {
        static const float from[CAMERAS][3] = {{0.62f, 0.41f, 0.67f}, {-0.83f, 0.18f, 0.53f}, {0.31f, 0.77f, -0.56f}};
        const lmb_vec3 eye = add3(middle, mul3(vec3(from[i][0], from[i][1], from[i][2]), 1.3f * across));
        report r = {""};
        relief_shot shot;
        relief_frame truth, test;
        relief_figures f;
        memset(&shot, 0, sizeof shot);
        shot.kernels = picked_kernels();
        CHECK(lmb_view_look_at(&shot.view, eye, middle, vec3(0, 1, 0), 0.78f, SIDE, SIDE) == LMB_OK);
        shot.view.near_m = 0.1f * across;
        shot.view.far_m = 3.0f * across;
        shot.light = &sun;
        shot.shadow_map = 512;
        shot.ambient = 0.3f;
        shot.scene = &o->scene.scene;
        CHECK(relief_shoot(&truth, &shot, &r));
        shot.scene = NULL;
        shot.relief = &o->relief;
        CHECK(relief_shoot(&test, &shot, &r) && relief_measure(&f, &test, &truth, (double)across, &r));
        CHECK(test.stats.hits + test.stats.missed + test.stats.holes == test.stats.pixels);
        mean.psnr_db += f.psnr_db / CAMERAS;
        mean.lit += f.lit / CAMERAS;
        mean.isolated += f.isolated / CAMERAS;
        relief_frame_free(&truth);
        relief_frame_free(&test);
    }
    return mean;
}

void test_relief_ornate(void)
{
    for (int i = 0; i < BAROQUE_KINDS; ++i) {
        ornate *o = ornate_make(i, 3);
        const relief_figures f = compared(o);
        CHECK_MSG(f.isolated < 0.003 && f.psnr_db > 21.5 && f.lit > 0.925, "%d: isolated %.3f %%, %.1f dB, lit %.3f", i,
                  100.0 * f.isolated, f.psnr_db, f.lit);
        ornate_free(o);
    }
}
