/* demo_field.c: the built-in world, from formulas: a field with a red and a blue end under four floodlights. */
#include "demo_field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "demo_scene.h"

enum { FACE = 128, FINE = 4, GROUND_W = 384, GROUND_H = 256 }; /* FINE: samples each way in a texel */
enum { SPHERE_MESH = 2 };

#define FIELD_W 24.0 /* m, and the margin around it */
#define FIELD_D 16.0
#define RADIUS  30.0
#define HEIGHT  1.7  /* of the cube map's position, in the middle */

typedef struct colour {
    double v[3];
} colour;

static colour mix(colour a, colour b, double t)
{
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    for (int c = 0; c < 3; ++c) {
        a.v[c] += (b.v[c] - a.v[c]) * t;
    }
    return a;
}

/* 0 .. 1, of whole numbers. */
static double noise(uint32_t x, uint32_t y)
{
    uint32_t h = x * 374761393u + y * 668265263u;
    h = (h ^ h >> 13) * 1274126177u;
    return (double)((h ^ h >> 16) & 0xffffu) / 65535.0;
}

/* --- ground ------------------------------------------------------------------------------------------------------- */

/* Radiance at metres x, z from the middle; the stripes of the lawn, lines, a red and a blue end. */
static colour ground_at(double x, double z)
{
    const colour dark = {{0.05, 0.17, 0.04}}, light = {{0.10, 0.29, 0.06}}, line = {{0.85, 0.85, 0.8}},
                 track = {{0.38, 0.20, 0.11}}, red = {{1.15, 0.10, 0.06}}, blue = {{0.05, 0.22, 1.15}};
    const double ax = fabs(x), az = fabs(z), ring = sqrt(x * x + z * z);
    colour c = mix(dark, light, 0.5 + 4.0 * (fabs(x / 4.0 - floor(x / 4.0) - 0.5) - 0.25));
    c = x < -7.5 ? mix(c, red, (-7.5 - x) * 4.0) : x > 7.5 ? mix(c, blue, (x - 7.5) * 4.0) : c;
    if (ax > 10.6 || az > 6.8) {
        return track;
    }
    return ax > 10.5 || az > 6.7 || fabs(ring - 2.2) < 0.06 || ax < 0.06 ? line : c;
}

/* --- sky ---------------------------------------------------------------------------------------------------------- */

static const double towers[4][2] = {{35.0, 23.0}, {-35.0, 23.0}, {145.0, 23.0}, {-145.0, 23.0}}; /* degrees */

static int is_lamp(const double d[3])
{
    const double degree = 3.14159265358979 / 180.0;
    for (int i = 0; i < 4; ++i) {
        const double a = towers[i][0] * degree, e = towers[i][1] * degree;
        const double cosine = d[0] * sin(a) * cos(e) + d[1] * sin(e) - d[2] * cos(a) * cos(e);
        if (cosine > cos(2.4 * degree)) {
            return 1;
        }
    }
    return 0;
}

/* Stands with people up to 15 degrees, with a colour for each end, then dusk. */
static colour far_at(const double d[3])
{
    const colour lamp = {{60.0, 56.0, 48.0}}, low = {{0.75, 0.45, 0.35}}, high = {{0.10, 0.16, 0.34}},
                 crowd = {{0.16, 0.15, 0.17}}, red = {{0.75, 0.08, 0.05}}, blue = {{0.05, 0.16, 0.8}};
    const double elevation = asin(d[1]) * 57.2957795, azimuth = atan2(d[0], -d[2]) * 57.2957795;
    if (elevation > 15.0) {
        return is_lamp(d) ? lamp : mix(low, high, (elevation - 15.0) / 40.0);
    }
    const double seat =
        noise((uint32_t)(int32_t)floor(azimuth * 1.5 + 400.0), (uint32_t)(int32_t)floor(elevation + 90.0));
    colour c = mix(crowd, d[0] < 0.0 ? red : blue, (fabs(d[0]) - 0.55) * 5.0);
    for (int i = 0; i < 3; ++i) {
        c.v[i] *= 0.35 + 1.3 * seat;
    }
    return c;
}

/* Radiance at the middle from direction d, of unit length. */
static colour world_at(const double d[3])
{
    const double t = d[1] < -1e-6 ? HEIGHT / -d[1] : 1e9, x = d[0] * t, z = d[2] * t;
    return fabs(x) <= 0.5 * FIELD_W && fabs(z) <= 0.5 * FIELD_D ? ground_at(x, z) : far_at(d);
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

/* Towards s, t of a face, -1 .. 1: probe.h. */
static void direction(double d[3], int face, double s, double t)
{
    const double to[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    const double length = sqrt(1.0 + s * s + t * t);
    for (int i = 0; i < 3; ++i) {
        d[i] = to[face][i] / length;
    }
}

static void paint_texel(float out[3], int face, int x, int y)
{
    double sum[3] = {0.0, 0.0, 0.0}, d[3];
    for (int i = 0; i < FINE * FINE; ++i) {
        const double s = 2.0 * (FINE * x + i % FINE + 0.5) / (FINE * FACE) - 1.0,
                     t = 2.0 * (FINE * y + i / FINE + 0.5) / (FINE * FACE) - 1.0;
        direction(d, face, s, t);
        const colour c = world_at(d);
        for (int k = 0; k < 3; ++k) {
            sum[k] += c.v[k] / (FINE * FINE);
        }
    }
    for (int k = 0; k < 3; ++k) {
        out[k] = (float)sum[k];
    }
}

static void paint_ground(float *out)
{
    for (int i = 0; i < GROUND_W * GROUND_H; ++i) {
        const colour c = ground_at(FIELD_W * ((i % GROUND_W + 0.5) / GROUND_W - 0.5),
                                   FIELD_D * ((i / GROUND_W + 0.5) / GROUND_H - 0.5));
        for (int k = 0; k < 3; ++k) {
            out[4 * i + k] = (float)c.v[k];
        }
        out[4 * i + 3] = 1.0f;
    }
}

int demo_field_pictures(lmb_world_pictures *out, world_pictures *own, report *r)
{
    const size_t texels = FACE * FACE;
    for (int face = 0; face < 6; ++face) {
        if ((own->face[face] = malloc(3 * texels * sizeof(float))) == NULL) {
            return report_fail(r, "out of memory");
        }
        for (size_t i = 0; i < texels; ++i) {
            paint_texel(own->face[face] + 3 * i, face, (int)i % FACE, (int)i / FACE);
        }
        out->face[face] = own->face[face];
    }
    if ((own->ground = malloc(4 * GROUND_W * GROUND_H * sizeof *own->ground)) == NULL) {
        return report_fail(r, "out of memory");
    }
    paint_ground(own->ground);
    out->face_size = FACE;
    out->ground = own->ground;
    out->ground_width = GROUND_W;
    out->ground_height = GROUND_H;
    return 1;
}

void demo_field_place(lmb_world_pictures *out, float ground_size[2])
{
    memset(out, 0, sizeof *out);
    out->centre.y = out->middle.y = (float)HEIGHT;
    out->radius = (float)RADIUS;
    ground_size[0] = (float)FIELD_W;
    ground_size[1] = (float)FIELD_D;
}

/* --- the figure --------------------------------------------------------------------------------------------------- */

static void set_ball(lmb_instance *out, const lmb_instance *unit, lmb_vec3 half, lmb_vec3 at)
{
    const float scale[3] = {half.x, half.y, half.z}, to[3] = {at.x, at.y, at.z};
    *out = *unit;
    for (int i = 0; i < 3; ++i) {
        out->to_world.m[5 * i] *= scale[i];
        out->to_world.m[12 + i] = out->to_world.m[12 + i] * scale[i] + to[i];
    }
}

const lmb_scene *demo_field_figure(void)
{
    static lmb_material skin, shirt;
    static lmb_material materials[2];
    static lmb_instance instances[2];
    static lmb_scene scene;
    lmb_instance unit = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 0, 0, 1, 0};
    lmb_vec3 low, high;
    scene.meshes = demo_scene()->meshes + SPHERE_MESH;
    scene.instances = &unit;
    scene.mesh_count = scene.instance_count = 1;
    lmb_scene_bounds(&low, &high, &scene);
    for (int i = 0; i < 3; ++i) { /* the ball's box becomes -1 .. 1 */
        const float a = i == 0 ? low.x : i == 1 ? low.y : low.z, b = i == 0 ? high.x : i == 1 ? high.y : high.z;
        unit.to_world.m[5 * i] = 2.0f / (b - a);
        unit.to_world.m[12 + i] = -(a + b) / (b - a);
    }
    skin.albedo[0] = 0.75f;
    skin.albedo[1] = 0.62f;
    skin.albedo[2] = 0.52f;
    skin.alpha = 1.0f;
    skin.texture = -1;
    shirt = skin;
    shirt.albedo[0] = shirt.albedo[1] = shirt.albedo[2] = 0.9f;
    materials[0] = skin;
    materials[1] = shirt;
    set_ball(&instances[0], &unit, (lmb_vec3){0.17f, 0.2f, 0.17f}, (lmb_vec3){0.0f, 1.6f, 0.0f});
    set_ball(&instances[1], &unit, (lmb_vec3){0.32f, 0.72f, 0.24f}, (lmb_vec3){0.0f, 0.72f, 0.0f});
    instances[1].material = 1;
    instances[1].first_id = 1 + scene.meshes[0].triangle_count;
    scene.materials = materials;
    scene.instances = instances;
    scene.material_count = scene.instance_count = 2;
    lmb_scene_bounds(&scene.bounds_min, &scene.bounds_max, &scene);
    return &scene;
}
