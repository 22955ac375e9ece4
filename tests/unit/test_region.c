/* test_region.c: two triangles that face each other, half open to a world of radiance 1. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/relight/relight_region.h"
#include "../test.h"

void test_region(void);

enum { N = LMB_PROBE_SIDE, T = LMB_PROBE_TEXELS };

typedef struct pair {
    float direction[3 * T], position[18];
    lmb_mesh mesh;
    lmb_instance instance;
    hidden_part part;
    uint64_t blocked[T];
    lmb_vec3 at[6], normal[6];
    hidden h;
    far_lights lights;
    lmb_material material;
    lmb_texture texture;
    uint8_t texels[4 * 5], colours[4 * 6]; /* of two levels; of corners */
    float uv[2 * 6];
} pair;

/* The reduced cube's directions and their angles: probe.h. */
static void set_directions(pair *p)
{
    for (int i = 0; i < T; ++i) {
        const float s = (float)(2 * (i % N) + 1) / N - 1.0f, t = (float)(2 * (i / N % N) + 1) / N - 1.0f;
        const float to[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
        const float per = 1.0f / sqrtf(1.0f + s * s + t * t);
        for (int c = 0; c < 3; ++c) {
            p->direction[T * c + i] = to[i / (N * N)][c] * per;
        }
        p->lights.light[i].to = (lmb_vec3){p->direction[i], p->direction[T + i], p->direction[2 * T + i]};
        p->lights.angle[i] = 4.0f / (N * N) * per * per * per;
        for (int c = 0; c < 3; ++c) {
            p->lights.light[i].rgb[c] = p->lights.angle[i];
        }
    }
    p->lights.count = T;
}

/* The lower one faces up and sees the upper along x > 0; the upper faces down and sees the lower along x < 0. */
static void build(pair *p)
{
    static const float x[6] = {0, 0, 1, 0, 1, 0}, z[6] = {0, 1, 0, 0, 0, 1};
    memset(p, 0, sizeof *p);
    set_directions(p);
    for (int i = 0; i < 6; ++i) {
        p->at[i] = (lmb_vec3){x[i], i < 3 ? 0.0f : 1.0f, z[i]};
        p->normal[i] = (lmb_vec3){0, i < 3 ? 1.0f : -1.0f, 0};
    }
    for (int i = 0; i < T; ++i) {
        const int is_up = p->direction[T + i] > 0.0f, is_right = p->direction[i] > 0.0f;
        p->blocked[i] = is_up == is_right ? (is_up ? 7u : 56u) : 0u;
    }
    p->mesh.positions = p->position;
    p->mesh.vertex_count = 6;
    p->mesh.triangle_count = 2;
    p->mesh.index_format = LMB_INDEX_NONE;
    p->part.mesh = p->mesh;
    p->part.at = p->at;
    p->part.normal = p->normal;
    p->part.blocked = &p->blocked;
    p->h.part = &p->part;
    p->h.parts = 1;
    p->h.middle.y = 0.5f;
    p->h.radius = 1.0f;
    p->h.scene.meshes = &p->mesh;
    p->h.scene.mesh_count = 1;
    p->h.scene.instances = &p->instance;
    p->h.scene.instance_count = 1;
    p->material = (lmb_material){.albedo = {1.0f, 1.0f, 0.0f}, .texture = -1};
    p->h.scene.materials = &p->material;
    p->h.scene.material_count = 1;
    p->h.instances = &p->instance;
}

/* Each triangle covers half of the texture: white and black on one diagonal each. */
static void add_pattern(pair *p)
{
    for (int i = 0; i < 6; ++i) {
        p->uv[2 * i] = p->at[i].x;
        p->uv[2 * i + 1] = p->at[i].z;
    }
    for (int i = 0; i < 4; ++i) {
        memset(p->texels + 4 * i, i == 0 || i == 3 ? 255 : 0, 3);
        p->texels[4 * i + 3] = 255;
    }
    CHECK(lmb_texture_mips(p->texels, 2, 2, 2) == LMB_OK);
    p->texture = (lmb_texture){.texels = p->texels, .width = 2, .height = 2, .levels = 2, .filter = LMB_BILINEAR};
    p->h.scene.textures = &p->texture;
    p->h.scene.texture_count = 1;
    p->material.texture = 0;
    p->part.mesh.uvs = p->uv;
    p->part.mesh.uv_format = LMB_UV_F32;
}

static void no_ground(float left[3], const void *user, lmb_vec3 at, lmb_vec3 to)
{
    CHECK(to.y < 0.0f && at.y == 1.0f && user != NULL);
    left[0] = left[1] = left[2] = 0.0f;
}

/* A region's reflectance: the texel over the triangle, then also the colours of the corners. */
static void look_at_colours(pair *p)
{
    static const uint8_t red[6] = {255, 0, 51, 102, 102, 102};
    static const float want[2] = {0.5f, 0.5f * 0.4f};
    add_pattern(p);
    for (int pass = 0; pass < 2; ++pass) {
        regions r;
        memset(&r, 0, sizeof r);
        for (int i = 0; i < 6; ++i) {
            p->colours[4 * i] = red[i];
            memset(p->colours + 4 * i + 1, 255, 3);
        }
        p->part.mesh.colours = pass > 0 ? p->colours : NULL;
        CHECK(regions_make(&r, &p->h, p->direction));
        for (int i = 0; i < 2; ++i) {
            const float *albedo = r.region[r.of[i]].albedo;
            CHECK_MSG(fabsf(albedo[0] - want[pass]) < 0.003f && fabsf(albedo[1] - 0.5f) < 0.003f && albedo[2] == 0.0f,
                      "%g %g", (double)albedo[0], (double)albedo[1]);
        }
        regions_free(&r);
    }
}

/* Half of the light that each could reflect comes from the other: 1/2 + 1/4 + 1/8 after three rounds. */
void test_region(void)
{
    pair *p = malloc(sizeof *p);
    float light[REGIONS][3];
    regions r;
    memset(&r, 0, sizeof r);
    if (p == NULL) {
        ++test_failed;
        return;
    }
    build(p);
    CHECK(regions_make(&r, &p->h, p->direction));
    for (int i = 0; i < T; ++i) {
        const lmb_vec3 a = p->lights.light[i].to, b = p->lights.light[r.opposite[i]].to;
        CHECK(fabsf(a.x + b.x) + fabsf(a.y + b.y) + fabsf(a.z + b.z) < 1e-6f);
    }
    const int low = r.of[0], high = r.of[1];
    CHECK(low != high);
    CHECK(fabsf(r.region[low].area - 0.5f) < 1e-6f && r.region[high].middle.y == 1.0f);
    regions_light(light, &p->lights, &r, NULL, NULL, NULL);
    CHECK_MSG(fabsf(light[low][0] - 0.875f) < 0.015f && fabsf(light[high][1] - 0.875f) < 0.015f, "%g %g", (double)light[low][0],
              (double)light[high][1]);
    CHECK(light[low][2] == 0.0f);
    regions_light(light, &p->lights, &r, NULL, no_ground, p);
    CHECK_MSG(fabsf(light[low][0] - 0.625f) < 0.015f && fabsf(light[high][0] - 0.25f) < 0.015f, "%g %g", (double)light[low][0],
              (double)light[high][0]);
    regions_free(&r);
    look_at_colours(p);
    free(p);
}
