/* bench_scene.c: the workload's meshes from files, cameras, quads and texture. */
#include "bench_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_bytes.h"

const bench_case bench_cases[] = {
    {"bunny-depth-1024", BENCH_BUNNY, BENCH_DEPTH, 1024, 1024, 0},
    {"bunny-depth-2048", BENCH_BUNNY, BENCH_DEPTH, 2048, 2048, 0},
    {"bunny-depth-1024-cull", BENCH_BUNNY, BENCH_DEPTH, 1024, 1024, 1},
    {"sponzaL-depth-1024", BENCH_SPONZA_LIGHT, BENCH_DEPTH, 1024, 1024, 0},
    {"sponzaL-depth-2048", BENCH_SPONZA_LIGHT, BENCH_DEPTH, 2048, 2048, 0},
    {"sponzaI-depth-1024", BENCH_SPONZA_INSIDE, BENCH_DEPTH, 1024, 1024, 0},
    {"sponzaI-depth-2048", BENCH_SPONZA_INSIDE, BENCH_DEPTH, 2048, 2048, 0},
    {"fill-depth-pass-1024", BENCH_FILL_PASS, BENCH_DEPTH, 1024, 1024, 0},
    {"fill-depth-fail-1024", BENCH_FILL_FAIL, BENCH_DEPTH, 1024, 1024, 0},
    {"bunny-gouraud-640x480", BENCH_BUNNY, BENCH_GOURAUD, 640, 480, 0},
    {"bunny-gouraud-1280x720", BENCH_BUNNY, BENCH_GOURAUD, 1280, 720, 0},
    {"sponzaI-gouraud-640x480", BENCH_SPONZA_INSIDE, BENCH_GOURAUD, 640, 480, 0},
    {"sponzaI-gouraud-1280x720", BENCH_SPONZA_INSIDE, BENCH_GOURAUD, 1280, 720, 0},
    {"fill-gouraud-1280x720", BENCH_FILL_PASS, BENCH_GOURAUD, 1280, 720, 0},
    {"bunny-tex-640x480", BENCH_BUNNY, BENCH_TEXTURED, 640, 480, 0},
    {"bunny-tex-1280x720", BENCH_BUNNY, BENCH_TEXTURED, 1280, 720, 0},
    {"sponzaI-tex-640x480", BENCH_SPONZA_INSIDE, BENCH_TEXTURED, 640, 480, 0},
    {"sponzaI-tex-1280x720", BENCH_SPONZA_INSIDE, BENCH_TEXTURED, 1280, 720, 0},
    {"fill-tex-1280x720", BENCH_FILL_PASS, BENCH_TEXTURED, 1280, 720, 0},
};
const int bench_case_count = sizeof bench_cases / sizeof *bench_cases;

enum { TEXELS = 256, LAYERS = 32 };

/* --- meshes ------------------------------------------------------------------------------------------------------- */

/* Bytes of a mesh file with these counts. */
static uint64_t mesh_bytes(uint64_t vertices, uint64_t triangles) { return 8 + 32 * vertices + 12 * triangles; }

/* Uses the file's arrays in place, so only little-endian machines can. */
static int load_mesh(bench_scene *s, const char *folder, const char *name, report *r)
{
    static const uint16_t one = 1;
    char path[1024];
    snprintf(path, sizeof path, "%.900s/%s.mesh", folder, name);
    if (*(const uint8_t *)&one != 1) {
        return report_fail(r, "%s: its numbers are little-endian, this machine's are not", path);
    }
    if (!file_read(&s->file, path, r)) {
        return 0;
    }
    const uint8_t *data = s->file.data;
    const uint64_t vertices = s->file.size >= 8 ? get_u32_le(data) : 0,
                   triangles = s->file.size >= 8 ? get_u32_le(data + 4) : 0;
    if (vertices == 0 || triangles == 0 || mesh_bytes(vertices, triangles) != s->file.size) {
        return report_fail(r, "%s: %u vertices and %u triangles are no mesh of %zu bytes; fetch it again", path,
                           (unsigned)vertices, (unsigned)triangles, s->file.size);
    }
    s->mesh.vertex_count = (uint32_t)vertices;
    s->mesh.triangle_count = (uint32_t)triangles;
    s->mesh.positions = data + 8;
    s->mesh.uvs = data + 8 + 24 * vertices;
    s->mesh.indices = data + 8 + 32 * vertices;
    return 1;
}

/* Colours from the normals, the same as for the other rasterizers. */
static int colour_mesh(bench_scene *s, report *r)
{
    const float *normals = (const float *)(const void *)(s->file.data + 8 + 12 * (size_t)s->mesh.vertex_count);
    uint8_t *colours = malloc(4 * (size_t)s->mesh.vertex_count);
    s->made = colours;
    if (colours == NULL) {
        return report_fail(r, "out of memory for %u colours", (unsigned)s->mesh.vertex_count);
    }
    for (size_t i = 0; i < s->mesh.vertex_count; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float code = 127.5f + 127.5f * normals[3 * i + c];
            colours[4 * i + c] = code > 0.0f ? code < 255.0f ? (uint8_t)code : 255 : 0;
        }
        colours[4 * i + 3] = 255;
    }
    s->mesh.colours = colours;
    return 1;
}

/* Quads over the whole picture, one behind the other. */
typedef struct quads {
    float positions[LAYERS][4][3], uvs[LAYERS][4][2];
    uint8_t colours[LAYERS][4][4];
    uint32_t indices[LAYERS][6];
} quads;

static int make_quads(bench_scene *s, int back_to_front, report *r)
{
    static const float corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    quads *q = malloc(sizeof *q);
    s->made = q;
    if (q == NULL) {
        return report_fail(r, "out of memory for the quads");
    }
    for (int l = 0; l < LAYERS; ++l) {
        const float t = ((float)l + 1.0f) / (LAYERS + 1.0f);
        for (int k = 0; k < 4; ++k) {
            const uint8_t rgba[4] = {(uint8_t)(k * 80), (uint8_t)(l * 7), (uint8_t)(255 - k * 80), 255};
            q->positions[l][k][0] = corner[k][0];
            q->positions[l][k][1] = corner[k][1];
            q->positions[l][k][2] = back_to_front ? 0.9f - 1.8f * t : -0.9f + 1.8f * t;
            q->uvs[l][k][0] = (corner[k][0] + 1.0f) * 2.0f;
            q->uvs[l][k][1] = (corner[k][1] + 1.0f) * 2.0f;
            memcpy(q->colours[l][k], rgba, sizeof rgba);
        }
        for (int k = 0; k < 6; ++k) {
            q->indices[l][k] = (uint32_t)(4 * l) + order[k];
        }
    }
    s->mesh.positions = q->positions;
    s->mesh.uvs = q->uvs;
    s->mesh.colours = &q->colours[0][0][0];
    s->mesh.indices = q->indices;
    s->mesh.vertex_count = 4 * LAYERS;
    s->mesh.triangle_count = 2 * LAYERS;
    return 1;
}

static void make_texture(bench_scene *s)
{
    static uint8_t texels[TEXELS * TEXELS * 4];
    for (int y = 0; y < TEXELS; ++y) {
        for (int x = 0; x < TEXELS; ++x) {
            uint8_t *p = texels + 4 * (y * TEXELS + x);
            const int check = ((x >> 4) ^ (y >> 4)) & 1;
            p[0] = (uint8_t)(check ? 220 : x);
            p[1] = (uint8_t)(check ? y : 90);
            p[2] = (uint8_t)(check ? 60 : x ^ y);
            p[3] = 255;
        }
    }
    s->texture.texels = texels;
    s->texture.width = s->texture.height = TEXELS;
    s->texture.levels = 1;
    s->scene.textures = &s->texture;
    s->scene.texture_count = 1;
    s->material.texture = 0;
}

/* --- cameras ------------------------------------------------------------------------------------------------------ */

typedef struct camera {
    lmb_vec3 eye, target, up;
    float fov_rad, near_m, far_m;
} camera;

static const camera cameras[] = {
    {{0.05f, 0.17f, 0.22f}, {-0.017f, 0.108f, 0.0f}, {0, 1, 0}, 0.70f, 0.05f, 1.0f},
    {{0.4f, -13.0f, 2.5f}, {0.4f, 10.0f, 4.0f}, {0, 0, 1}, 1.05f, 0.1f, 100.0f},
    {{9.0f, -7.0f, 42.0f}, {0.4f, -0.6f, 5.0f}, {0, 1, 0}, 1.05f, 5.0f, 100.0f},
};

static void set_view(lmb_view *v, const bench_case *c)
{
    if (c->scene <= BENCH_SPONZA_LIGHT) {
        const camera *k = &cameras[c->scene];
        lmb_view_look_at(v, k->eye, k->target, k->up, k->fov_rad, c->width, c->height);
        v->near_m = k->near_m;
        v->far_m = k->far_m;
        return;
    }
    /* The quads are in normalized picture coordinates, with z away from the viewer. */
    memset(v, 0, sizeof *v);
    v->kind = LMB_ORTHOGRAPHIC;
    v->right.x = v->up.y = v->half_width = v->half_height = 1.0f;
    v->back.z = -1.0f;
    v->eye.z = -2.0f;
    v->near_m = 1.0f;
    v->far_m = 3.0f;
    v->frame_width = c->width;
    v->frame_height = c->height;
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

static int set_mesh(bench_scene *s, const bench_case *c, const char *folder, report *r)
{
    if (c->scene >= BENCH_FILL_PASS) {
        return make_quads(s, c->scene == BENCH_FILL_PASS, r);
    }
    return load_mesh(s, folder, c->scene == BENCH_BUNNY ? "bunny" : "sponza", r) &&
           (c->look != BENCH_GOURAUD || colour_mesh(s, r));
}

int bench_scene_load(bench_scene *s, const bench_case *c, const char *folder, report *r)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    memset(s, 0, sizeof *s);
    if (!set_mesh(s, c, folder, r)) {
        bench_scene_free(s);
        return 0;
    }
    s->mesh.index_format = LMB_INDEX_U32;
    s->mesh.colours = c->look == BENCH_GOURAUD ? s->mesh.colours : NULL;
    s->mesh.uvs = c->look == BENCH_TEXTURED ? s->mesh.uvs : NULL;
    s->material.albedo[0] = s->material.albedo[1] = s->material.albedo[2] = s->material.alpha = 1.0f;
    s->material.texture = -1;
    s->material.flags = c->cull ? 0 : LMB_DOUBLE_SIDED;
    s->instance.to_world = unit;
    s->instance.first_id = 1;
    s->scene.meshes = &s->mesh;
    s->scene.materials = &s->material;
    s->scene.instances = &s->instance;
    s->scene.mesh_count = s->scene.material_count = s->scene.instance_count = 1;
    if (c->look == BENCH_TEXTURED) {
        make_texture(s);
    }
    lmb_scene_bounds(&s->scene.bounds_min, &s->scene.bounds_max, &s->scene);
    set_view(&s->view, c);
    return lmb_scene_check(&s->scene) == LMB_OK || report_fail(r, "%s: its scene is not valid", c->name);
}

void bench_scene_free(bench_scene *s)
{
    file_free(&s->file);
    free(s->made);
    s->made = NULL;
}
