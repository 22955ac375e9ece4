/* relight_frames.c: whole frames: moving objects at eight places of the built-in world, with the world as background,
 * 640 x 480, one core. Includes each object's cubes by the cosine filter and for its lobe, ids, and all bands.
 *
 * Then the same without new cubes, as for objects at rest. The bar is a 60th of a second. */
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../tools/demo/demo_field.h"
#include "../test.h"
#include "relight_stage.h"

enum { FIGURES = 8, WIDE = 640, HIGH = 480, SHARP = 16, PARTS = 8 };
static const float figure_roughness = 0.4f;

typedef struct frames {
    relight_stage *stage;
    lmb_scene scene;
    lmb_instance instance[FIGURES * PARTS];
    lmb_material material[PARTS];
    lmb_vec3 place[FIGURES];
    lmb_probe probe[FIGURES];
    uint16_t probe_of[FIGURES * PARTS];
    float irradiance[FIGURES][4 * 6 * (SIDE + 2) * (SIDE + 2)], glossy[FIGURES][4 * 6 * (SHARP + 2) * (SHARP + 2)];
    float planes[3 * 6 * SHARP * SHARP];
    lmb_probe_rays rays;
    lmb_relight relight;
    lmb_relight_scratch scratch;
    float depth[WIDE * HIGH], picture[3 * WIDE * HIGH];
    uint32_t id[WIDE * HIGH];
    lmb_surface out;
    int rests;
} frames;

static void set_figures(frames *f)
{
    static const float at[FIGURES][2] = {{-9.8f, -2.5f}, {-8.4f, -0.2f}, {-3.7f, 2.4f}, {-0.9f, -4.5f},
                                         {0.5f, 4.1f}, {3.4f, 0.4f}, {8.2f, -0.8f}, {9.9f, -3.0f}};
    const lmb_scene *one = demo_field_figure();
    uint32_t id = 1;
    f->scene = *one;
    CHECK(one->instance_count <= PARTS && one->material_count <= PARTS);
    memcpy(f->material, one->materials, one->material_count * sizeof *f->material);
    for (uint32_t i = 0; i < one->material_count; ++i) {
        f->material[i].specular[0] = f->material[i].specular[1] = f->material[i].specular[2] = 0.04f;
        f->material[i].roughness = figure_roughness;
    }
    for (uint32_t i = 0; i < FIGURES * one->instance_count; ++i) {
        const uint32_t figure = i / one->instance_count;
        f->instance[i] = one->instances[i % one->instance_count];
        f->instance[i].to_world.m[12] += at[figure][0];
        f->instance[i].to_world.m[14] += at[figure][1];
        f->instance[i].first_id = id;
        f->probe_of[i] = (uint16_t)figure;
        f->place[figure] = vec3(at[figure][0], 0.9f, at[figure][1]);
        id += one->meshes[f->instance[i].mesh].triangle_count;
    }
    f->scene.instances = f->instance;
    f->scene.instance_count = FIGURES * one->instance_count;
    f->scene.materials = f->material;
    f->scene.light_count = 0;
    lmb_scene_bounds(&f->scene.bounds_min, &f->scene.bounds_max, &f->scene);
    CHECK(lmb_scene_check(&f->scene) == LMB_OK);
}

/* The view of `lambent relight --world demo --object demo`. */
static void set_frame(frames *f)
{
    lmb_relight *r = &f->relight;
    lmb_view *v = &r->view;
    const lmb_vec3 back = normalize3(vec3(0.0f, 1.4f, 8.4f));
    v->eye = vec3(0.0f, 2.3f, 8.4f);
    v->right = vec3(1.0f, 0.0f, 0.0f);
    v->up = cross3(back, v->right);
    v->back = back;
    v->half_height = 0.554309f; /* 58 degrees */
    v->half_width = v->half_height * (float)WIDE / (float)HIGH;
    v->near_m = 0.05f;
    v->far_m = 1000.0f;
    v->kind = LMB_PERSPECTIVE;
    v->frame_width = WIDE;
    v->frame_height = HIGH;
    lmb_surface_init(&r->eye.depth, LMB_DEPTH32F, WIDE, HIGH, f->depth, sizeof f->depth);
    lmb_surface_init(&r->eye.id, LMB_ID32, WIDE, HIGH, f->id, sizeof f->id);
    lmb_surface_init(&f->out, LMB_RGB32F, WIDE, HIGH, f->picture, sizeof f->picture);
    r->kernels = f->stage->kernels;
    r->scene = &f->scene;
    r->world = &f->stage->world;
    r->probes = f->probe;
    r->probe_of = f->probe_of;
    r->probe_count = FIGURES;
}

static void light_figure(frames *f, int i)
{
    const lmb_world_query query = {&f->stage->world, 0.0f, 0};
    relight_update(f->stage, COSINE, f->place[i], SIDE);
    CHECK(lmb_probe_cube_init(&f->probe[i].irradiance, f->stage->cube, SIDE, f->irradiance[i],
                              sizeof f->irradiance[i]) == LMB_OK);
    CHECK(lmb_probe_reflect(f->planes, SHARP, f->stage->kernels, &f->rays, &query, f->place[i], figure_roughness) ==
          LMB_OK);
    CHECK(lmb_probe_cube_init(&f->probe[i].glossy, f->planes, SHARP, f->glossy[i], sizeof f->glossy[i]) == LMB_OK);
}

static void frame(void *context)
{
    frames *f = context;
    lmb_relight *r = &f->relight;
    lmb_status status = LMB_OK;
    for (int i = 0; i < FIGURES && !f->rests; ++i) {
        light_figure(f, i);
    }
    lmb_surface_clear(&r->eye.depth);
    lmb_surface_clear(&r->eye.id);
    status = lmb_draw(&r->eye, r->kernels, &r->view, r->scene, 1, lmb_scene_triangles(r->scene), LMB_CULL_BACK, NULL);
    for (int32_t band = 0; band < HIGH / LMB_TILE && status == LMB_OK; ++band) {
        status = lmb_relight_band(r, &f->scratch, &f->out, band);
    }
    CHECK(status == LMB_OK);
}

static void tell(frames *f)
{
    const char *const names[2] = {lmb_kernels_name(f->stage->kernels), "avx2"};
    printf("Whole frames of 640 x 480, %d figures and the world behind them, one core, ms:\n\n"
           "| backend | all figures move | all rest |\n|---|---|---|\n", FIGURES);
    for (int i = 0; i < 2; ++i) {
        double seconds[2];
        const lmb_kernels *own = f->stage->kernels, *asked = lmb_kernels_named(names[i]);
        f->stage->kernels = f->relight.kernels = asked != NULL ? asked : own;
        for (f->rests = 0; f->rests < 2; ++f->rests) {
            seconds[f->rests] = relight_seconds(frame, f);
        }
        f->stage->kernels = f->relight.kernels = own;
        printf("| %s | %.1f | %.1f |\n", names[i], 1e3 * seconds[0], 1e3 * seconds[1]);
        CHECK_MSG(i > 0 || seconds[0] <= 1.0 / 60.0, "a frame takes %.1f ms", 1e3 * seconds[0]);
    }
    printf("\n");
}

void relight_tell_frames(relight_stage *s)
{
    static frames f;
    static world_pictures own;
    lmb_world_pictures pictures;
    float ground_size[2];
    report r = {""};
    memset(&f, 0, sizeof f);
    f.stage = s;
    demo_field_place(&pictures, ground_size);
    CHECK(demo_field_pictures(&pictures, &own, &r));
    pictures.ground_width_m = ground_size[0];
    pictures.ground_depth_m = ground_size[1];
    pictures.ground_x = -0.5f * ground_size[0];
    pictures.ground_z = -0.5f * ground_size[1];
    relight_set_world(s, &pictures, LMB_WORLD_F32);
    set_figures(&f);
    set_frame(&f);
    tell(&f);
    world_pictures_free(&own);
}
