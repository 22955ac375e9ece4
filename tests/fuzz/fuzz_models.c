/* fuzz_models.c: the model readers: arbitrary bytes give a drawable scene, or one line and no scene. */
#include <stdlib.h>
#include <string.h>

#include "../../tools/common/io_json.h"
#include "../../tools/model/io_obj.h"
#include "../../tools/model/model_shape.h"
#include "fuzz.h"

#define FOLDER "tests/fuzz/neighbours/" /* a.bin, a.mtl and a.png, which a model may name */

enum { SIDE = 32, DRAWN = 2000 };

/* A checked scene can be drawn and resolved, whatever its vertices are. */
static void draw_scene(const lmb_scene *scene)
{
    static uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    const lmb_kernels *kernels = lmb_kernels_pick();
    lmb_vec3 lo = scene->bounds_min, hi = scene->bounds_max, up = {0, 1, 0};
    lmb_vec3 centre = {0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y), 0.5f * (lo.z + hi.z)};
    lmb_vec3 eye = {centre.x + (hi.x - lo.x) + 0.1f, centre.y + (hi.y - lo.y), centre.z + 2.0f * (hi.z - lo.z) + 1.0f};
    lmb_target target = {{0}, {0}, 0, 0};
    lmb_tile tile;
    lmb_view view;
    if (lmb_view_look_at(&view, eye, centre, up, 1.0f, SIDE, SIDE) != LMB_OK) {
        return;
    }
    view.near_m = 0.01f;
    memset(depth, 0, sizeof depth);
    memset(id, 0, sizeof id);
    fuzz_require(lmb_surface_init(&target.depth, LMB_DEPTH32F, SIDE, SIDE, depth, sizeof depth) == LMB_OK);
    fuzz_require(lmb_surface_init(&target.id, LMB_ID32, SIDE, SIDE, id, sizeof id) == LMB_OK);
    if (lmb_draw(&target, kernels, &view, scene, 1, DRAWN, LMB_CULL_BACK, NULL) != LMB_OK) {
        return;
    }
    for (int32_t i = 0; i < SIDE * SIDE / LMB_TILE_PIXELS; ++i) {
        int32_t x = i % (SIDE / LMB_TILE) * LMB_TILE, y = i / (SIDE / LMB_TILE) * LMB_TILE;
        fuzz_require(lmb_resolve_tile(&tile, kernels, &view, scene, &target, x, y) == LMB_OK);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            for (int c = 0; c < 3; ++c) {
                float v = tile.position[c][k], n = tile.normal[c][k], a = tile.albedo[c][k];
                fuzz_require(v - v == 0.0f && n >= -1.001f && n <= 1.001f && a >= 0.0f && a <= 1.001f);
            }
        }
    }
}

static void *copy_of(const void *data, size_t bytes)
{
    void *to = malloc(bytes + 1);
    fuzz_require(to != NULL);
    if (bytes > 0) {
        memcpy(to, data, bytes);
    }
    return to;
}

/* A motion has a pose at any time, or none; poses contain no NaN. */
static void pose_scene(const model *m)
{
    static const double times[] = {0.0, 0.4, 1e6};
    lmb_instance *instances = copy_of(m->scene.instances, m->scene.instance_count * sizeof *instances);
    lmb_light *lights = copy_of(m->scene.lights, m->scene.light_count * sizeof *lights);
    model_camera *cameras = copy_of(m->cameras, m->camera_count * sizeof *cameras);
    for (int t = 0; t < 3; ++t) {
        const int ok = model_pose(instances, lights, cameras, m, times[t]);
        if (ok) {
            model_pose_shapes(m, times[t]);
            draw_scene(&m->scene);
        }
        for (uint32_t i = 0; ok && i < m->scene.light_count; ++i) {
            const lmb_vec3 at = lights[i].position, along = lights[i].direction;
            fuzz_require(at.x - at.x == 0.0f && at.y - at.y == 0.0f && at.z - at.z == 0.0f);
            fuzz_require(along.x >= -1.001f && along.x <= 1.001f && along.y >= -1.001f && along.y <= 1.001f);
        }
    }
    free(instances);
    free(lights);
    free(cameras);
}

static void try_model(const char *path, const uint8_t *data, size_t size)
{
    report r = {{0}};
    model m;
    model_notes notes;
    if (model_read(&m, path, NULL, data, size, &notes, &r)) {
        fuzz_require(r.text[0] == '\0' && lmb_scene_check(&m.scene) == LMB_OK);
        draw_scene(&m.scene);
        if (m.motion != NULL) {
            pose_scene(&m);
        }
        model_make_glossy(&m);
        fuzz_require(lmb_scene_check(&m.scene) == LMB_OK);
        model_free(&m);
    } else {
        fuzz_require(m.blocks == NULL && m.scene.meshes == NULL);
        fuzz_failed(&r, FOLDER);
    }
}

void fuzz_gltf(const uint8_t *data, size_t size) { try_model(FOLDER "input.gltf", data, size); }

void fuzz_obj(const uint8_t *data, size_t size) { try_model(FOLDER "input.obj", data, size); }

void fuzz_ply(const uint8_t *data, size_t size) { try_model(FOLDER "input.ply", data, size); }

/* The place, text and value of every node can be read. */
void fuzz_json(const uint8_t *data, size_t size)
{
    json doc;
    report r = {{0}};
    char text[40];
    if (!json_parse(&doc, (const char *)data, size, "input", &r)) {
        fuzz_require(doc.nodes == NULL);
        fuzz_failed(&r, "input:");
        return;
    }
    for (uint32_t i = 0; i < doc.count; ++i) {
        report ignored = {{0}};
        double number;
        uint32_t whole;
        json_path(text, sizeof text, &doc, i);
        json_string(text, sizeof text, &doc, i);
        json_read_double(&number, &doc, i, &ignored);
        json_read_uint(&whole, &doc, i, &ignored);
        json_member(&doc, i, "a");
        fuzz_require(json_next(&doc, i) == JSON_NONE || json_next(&doc, i) > i);
    }
    json_free(&doc);
}

/* The cleanup at the end of model_read. */
static void free_build(model_build *b)
{
    for (uint32_t i = 0; i < b->neighbour_count; ++i) {
        free(b->neighbours[i].path);
        file_free(&b->neighbours[i].file);
    }
    free(b->neighbours);
    model_free(&b->scratch);
    model_free(b->out);
}

/* A library for two materials named by an OBJ file. */
void fuzz_mtl(const uint8_t *data, size_t size)
{
    static const slice words[3] = {{"", 0}, {"a", 1}, {"red paint", 9}};
    obj_material named[3];
    uint32_t slots[8] = {0}, slot;
    obj_names names = {named, slots, 3, 7, 1, 2};
    lmb_material materials[3];
    lmb_texture textures[3];
    model out;
    model_build b;
    model_notes notes;
    report r = {{0}};
    memset(&out, 0, sizeof out);
    memset(&b, 0, sizeof b);
    memset(materials, 0, sizeof materials);
    memset(textures, 0, sizeof textures);
    notes.count = 0;
    memset(named, 0, sizeof named);
    for (uint32_t i = 0; i < 3; ++i) {
        named[i].name = words[i];
        obj_find(&names, words[i], &slot);
        slots[slot] = i + 1;
    }
    b.out = &out;
    b.notes = &notes;
    b.r = &r;
    b.path = FOLDER "input.obj";
    b.budget = MODEL_BYTES_FREE + (uint64_t)size * MODEL_BYTES_PER_BYTE;
    b.materials = materials;
    b.textures = textures;
    if (mtl_read(&b, &names, text_open(data, size, "input"))) {
        fuzz_require(mtl_textures(&b, &names) && r.text[0] == '\0');
        mtl_tell_left_out(&b, &names);
    } else {
        fuzz_failed(&r, "input:");
    }
    for (int i = 0; i < 3; ++i) {
        for (int c = 0; c < 3; ++c) {
            fuzz_require(materials[i].albedo[c] >= 0.0f && materials[i].albedo[c] <= 1.0f);
            fuzz_require(materials[i].emission[c] >= 0.0f);
        }
    }
    free_build(&b);
}
