/* relief_stage.c: shared parts of the relief figures: models and their reliefs, bars, pictures. */
#include "relief_stage.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../src/base/vec.h"
#include "../../tools/picture/picture.h"
#include "../shared_file.h"

const statue statues[STATUES] = {{"rhino", "data/meshes/rhino_60k.ply", 3000},
                                 {"bunny", "data/meshes/stanford_bunny.obj", 2000},
                                 {"lucy", "data/meshes/lucy_100k.ply", 4000}};

void give_up(const report *r)
{
    printf("FAIL: %s\n", r->text);
    exit(1);
}

void bar(const char *name, const char *what, int holds)
{
    if (!holds) {
        printf("FAIL %s: %s\n", name, what);
        ++test_failed;
    }
}

void relief_show(const char *name, float *rgb, int32_t width, int32_t height, report *r)
{
    const char *folder = getenv("LMB_PICTURES");
    const image out = {width, height, 3, rgb};
    char path[600];
    if (folder != NULL) {
        snprintf(path, sizeof path, "%.300s/%.200s.png", folder, name);
        if (!picture_write(path, &out, 0.0f, PICTURE_CLIPPED, r)) {
            give_up(r);
        }
    }
}

/* Paints a wood grain on a model without colours. */
static void paint(triangle_mesh *m, float diagonal)
{
    for (uint32_t v = 0; v < m->vertex_count; ++v) {
        const float *p = m->positions + 3 * (size_t)v;
        const float k = 40.0f / diagonal, g = sinf(k * p[0]) * sinf(k * p[1]) * sinf(k * p[2]);
        m->colours[3 * (size_t)v] = 0.55f + 0.25f * g;
        m->colours[3 * (size_t)v + 1] = 0.45f + 0.2f * g;
        m->colours[3 * (size_t)v + 2] = 0.4f - 0.15f * g;
    }
}

static void take(subject *s, const lmb_scene *scene, report *r)
{
    const lmb_vec3 low = scene->bounds_min, high = scene->bounds_max;
    if (!relief_flatten(&s->mesh, scene, r)) {
        give_up(r);
    }
    s->middle = mul3(add3(low, high), 0.5f);
    s->diagonal = length3(sub3(high, low));
    paint(&s->mesh, s->diagonal);
    if (!relief_scene_of(&s->complex, &s->mesh, r)) {
        give_up(r);
    }
}

static void load(subject *s, const char *path, report *r)
{
    static model_notes notes;
    if (!model_load(&s->loaded, path, NULL, &notes, r)) {
        give_up(r);
    }
    take(s, &s->loaded.scene, r);
}

static void bake(subject *s, uint32_t triangles, report *r)
{
    lmb_vec3 direction[LMB_RELIEF_VIEWS];
    simplify_facts facts;
    const double since = host_cpu_seconds();
    int ok = simplify_mesh(&s->simple, &s->mesh, triangles, SIMPLIFY_AROUND, &facts, r);
    relief_directions(direction, RELIEF_VIEWS);
    s->bake.format = LMB_RELIEF_FULL;
    for (int32_t i = 0; i < RELIEF_VIEWS && ok; ++i) {
        const lmb_view v = relief_fit(&s->mesh, direction[i], RELIEF_TEXELS);
        ok = relief_add(&s->bake, &s->complex.scene, &v, r);
    }
    ok = ok && relief_cover(&s->coverage, &s->bake, &s->mesh, r) &&
         relief_encode(&s->file, &s->bake, &s->simple, r);
    s->bake_s = host_cpu_seconds() - since;
    if (!ok || lmb_relief_open(&s->relief, s->file.data, s->file.size) != LMB_OK) {
        report_fail(r, "no relief");
        give_up(r);
    }
}

subject *subject_make(const statue *of, report *r)
{
    char path[SHARED_PATH];
    subject *s = shared_file(path, of->file) ? calloc(1, sizeof *s) : NULL;
    if (s != NULL) {
        load(s, path, r);
        bake(s, of->triangles, r);
    }
    return s;
}

subject *subject_of(const triangle_mesh *mesh, uint32_t triangles, report *r)
{
    static const float white[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    lmb_mesh m = {.positions = mesh->positions, .indices = mesh->indices, .index_format = LMB_INDEX_U32,
                  .vertex_count = mesh->vertex_count, .triangle_count = mesh->triangle_count};
    lmb_material paint_of = {.alpha = 1.0f, .roughness = 1.0f, .texture = -1};
    lmb_instance at = {.first_id = 1};
    lmb_scene scene = {.meshes = &m, .materials = &paint_of, .instances = &at, .mesh_count = 1, .material_count = 1,
                       .instance_count = 1};
    subject *s = calloc(1, sizeof *s);
    if (s == NULL) {
        report_fail(r, "not enough memory");
        give_up(r);
    }
    memcpy(paint_of.albedo, white, sizeof paint_of.albedo);
    for (int i = 0; i < 4; ++i) {
        at.to_world.m[5 * i] = 1.0f;
    }
    lmb_scene_bounds(&scene.bounds_min, &scene.bounds_max, &scene);
    take(s, &scene, r);
    bake(s, triangles, r);
    return s;
}

void subject_free(subject *s)
{
    model_free(&s->loaded);
    triangle_mesh_free(&s->mesh);
    triangle_mesh_free(&s->simple);
    relief_scene_free(&s->complex);
    relief_bake_free(&s->bake);
    file_free(&s->file);
    free(s);
}

/* Directions on a golden-angle spiral, turned, so that they lie between the lattice
 * directions of the relief's views. */
lmb_view subject_camera(const subject *s, int i, int32_t side, lmb_light *sun)
{
    const double y = 1.0 - (2.0 * i + 1.0) / CAMERAS, a = 2.39996322972865332 * i + 0.3, ring = sqrt(1.0 - y * y);
    const lmb_vec3 d = vec3((float)(ring * cos(a)), (float)y, (float)(ring * sin(a)));
    lmb_view v = {.sample_x = 0};
    const float away = 1.32f * s->diagonal; /* 45 degrees contain the sphere around the model */
    if (lmb_view_look_at(&v, add3(s->middle, mul3(d, away)), s->middle, vec3(0.0f, 1.0f, 0.0f), 0.7853982f, side,
                         side) != LMB_OK) {
        exit(1);
    }
    v.near_m = 0.01f * away;
    v.far_m = 3.0f * away;
    memset(sun, 0, sizeof *sun);
    sun->kind = LMB_LIGHT_DIRECTIONAL;
    sun->direction = normalize3(mul3(add3(add3(mul3(v.back, 0.7f), mul3(v.up, 0.6f)), mul3(v.right, 0.5f)), -1.0f));
    sun->intensity[0] = sun->intensity[1] = sun->intensity[2] = 2.6f;
    sun->cos_inner = sun->cos_outer = 1.0f;
    return v;
}
