/* fuzz_stages.c: single stages and helpers with odd numbers: denormals, huge ones, infinities, NaN, -0, vectors of
 * length 0, flat and reversed triangles. The first byte picks the stage; the others are numbers for it.
 *
 * Checks the promises of the headers about results: ranges, bits outside the mask, bytes that stay unchanged, and that
 * all backends compute the same. For promises that hold only for ordinary numbers, `plain` is set. */
#include "../../tools/render/ladder.h"
#include "fuzz_pool.h"

#if FUZZ_CALLS

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

/* After the end, zeros follow. */
typedef struct source {
    const uint8_t *at, *end;
    int plain; /* all numbers so far are ordinary: at most 1e4 in size, and not between 0 and 1e-4 */
} source;

static uint8_t take(source *b) { return b->at < b->end ? *b->at++ : 0; }

static uint32_t word(source *b)
{
    uint32_t v = 0;
    for (int i = 0; i < 4; ++i) {
        v = v << 8 | take(b);
    }
    return v;
}

static float number(source *b)
{
    const uint8_t kind = take(b);
    uint32_t bits;
    float v = pool_float(kind);
    if (kind == 28) {
        bits = word(b);
        memcpy(&v, &bits, sizeof v);
    }
    b->plain &= v == 0.0f || (fabsf(v) <= 1e4f && fabsf(v) >= 1e-4f);
    return v;
}

static int32_t whole(source *b)
{
    const uint8_t kind = take(b);
    return kind == 255 ? (int32_t)word(b) : (int32_t)(uint32_t)(uint64_t)pool_whole(kind);
}

static lmb_vec3 vector(source *b)
{
    const float x = number(b), y = number(b), z = number(b);
    return (lmb_vec3){x, y, z};
}

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static lmb_vec3 minus(lmb_vec3 a, lmb_vec3 b) { return (lmb_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static lmb_vec3 cross(lmb_vec3 a, lmb_vec3 b)
{
    return (lmb_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static int is_unit(lmb_vec3 v) { return fabsf(dot(v, v) - 1.0f) < 1e-4f; }
static int is_finite(float v) { return v - v == 0.0f; }
static int is_near(lmb_vec3 v) { return fabsf(v.x) < 1e5f && fabsf(v.y) < 1e5f && fabsf(v.z) < 1e5f; }
static int is_light(float v) { return is_finite(v) && v >= 0.0f; }

/* A vector of length 1, whatever the input. */
static lmb_vec3 unit(source *b)
{
    const lmb_vec3 v = vector(b);
    const float l = sqrtf(dot(v, v));
    return is_finite(l) && l > 1e-3f ? (lmb_vec3){v.x / l, v.y / l, v.z / l} : (lmb_vec3){0, 1, 0};
}

/* --- numbers, views, surfaces ------------------------------------------------------------------------------------- */

static void numbers(source *b)
{
    const float x = number(b), s = lmb_sin(x), c = lmb_cos(x), root = lmb_sqrt(x);
    const double in = fabsf(x) <= 64.0f ? (double)x : 0.0;
    fuzz_require(fabs((double)s - sin(in)) < 8.1e-8 && fabs((double)c - cos(in)) < 8.1e-8);
    fuzz_require(x > 0.0f ? root == sqrtf(x) : root == 0.0f);
}

static void look_at(source *b)
{
    const lmb_vec3 eye = vector(b), target = vector(b), up = vector(b);
    const float angle = number(b);
    const int32_t width = whole(b), height = whole(b);
    lmb_view v, before;
    memset(&before, 0x5a, sizeof before);
    v = before;
    if (lmb_view_look_at(&v, eye, target, up, angle, width, height) != LMB_OK) {
        fuzz_require(memcmp(&v, &before, sizeof v) == 0);
        return;
    }
    fuzz_require(is_unit(v.right) && is_unit(v.up) && is_unit(v.back));
    fuzz_require(fabsf(dot(v.right, v.up)) < 1e-4f && fabsf(dot(v.up, v.back)) < 1e-4f &&
                 fabsf(dot(v.back, v.right)) < 1e-4f);
    fuzz_require(width >= 1 && height >= 1 && width <= LMB_MAX_FRAME && height <= LMB_MAX_FRAME);
    fuzz_require(v.half_width > 1e-30f && v.half_height > 1e-30f && v.near_m > 1e-30f);
    fuzz_require(is_finite(v.half_width) && is_finite(v.half_height) && is_finite(dot(v.eye, v.eye)));
}

static void view_sample(source *b)
{
    const int32_t samples = whole(b), i = whole(b);
    lmb_view v;
    memset(&v, 0, sizeof v);
    const int good = (samples == 1 || samples == 4 || samples == 8 || samples == 16) && i >= 0 && i < samples;
    fuzz_require((lmb_view_sample(&v, samples, i) == LMB_OK) == good);
    fuzz_require(v.sample_x >= -128 && v.sample_x < 128 && v.sample_y >= -128 && v.sample_y < 128);
}

static void surfaces(source *b)
{
    const int32_t format = whole(b), width = whole(b), height = whole(b), levels = whole(b);
    const size_t bytes = lmb_surface_bytes(format, width, height), texels = lmb_texture_bytes(width, height, levels);
    const int32_t count = lmb_texture_level_count(width, height);
    lmb_surface s;
    fuzz_require(lmb_pixel_bytes(format) >= 0 && (bytes == 0 || lmb_pixel_bytes(format) > 0));
    fuzz_require(lmb_depth_bytes(width, height) == lmb_surface_bytes(LMB_DEPTH32F, width, height));
    fuzz_require(count >= 0 && count <= 32 && (texels == 0 || (levels >= 1 && levels <= count)));
    if (bytes > 0 && bytes <= 1 << 20) {
        void *memory = pool_block(bytes);
        fuzz_require(lmb_surface_init(&s, format, width, height, memory, bytes) == LMB_OK);
        fuzz_require(lmb_surface_init(&s, format, width, height, memory, bytes - 1) == LMB_ERR_CAPACITY);
        fuzz_require(lmb_surface_clear(&s) == LMB_OK && lmb_surface_diff(&s.width, &s.height, &s, &s) == 0);
        fuzz_require(lmb_surface_hash(&s) != 0);
    } else if (bytes == 0) {
        fuzz_require(lmb_surface_init(&s, format, width, height, pool_raw, SIZE_MAX) < LMB_OK);
    }
}

static void octahedral(source *b)
{
    const lmb_vec3 any = vector(b), n = unit(b);
    int16_t code[2] = {(int16_t)word(b), (int16_t)word(b)};
    fuzz_require(is_unit(lmb_octahedral_decode(code)));
    lmb_octahedral_encode(code, any);
    fuzz_require(is_unit(lmb_octahedral_decode(code)));
    lmb_octahedral_encode(code, n);
    const lmb_vec3 again = lmb_octahedral_decode(code), off = minus(again, n);
    fuzz_require(dot(off, off) < 4.5e-5f * 4.5e-5f);
}

static void small_helpers(source *b)
{
    const float x = number(b), y = number(b), albedo = lmb_real_albedo(x, y), tangent = lmb_cone_tangent(x);
    const int32_t side = lmb_probe_glossy_side(x), n = whole(b);
    const lmb_vec3 at = vector(b);
    const float noise = lmb_place_noise(at, y);
    fuzz_require(albedo >= LMB_ALBEDO_MIN && albedo <= LMB_ALBEDO_MAX);
    fuzz_require(tangent >= 0.0f && tangent <= 1.0f);
    fuzz_require(side == 0 || side == 8 || side == 16 || side == 64);
    fuzz_require(!b->plain || is_light(noise) || y < 0.0f);
    fuzz_require(lmb_why_name(n) && lmb_op_name(n) && lmb_plan_stage_name(n) && lmb_status_name((lmb_status)n));
    fuzz_require(is_light((float)lmb_plan_units(n)));
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static void disc(source *b)
{
    const lmb_vec3 at = vector(b), normal = unit(b), centre = vector(b), axis = unit(b);
    const float area = number(b), f = lmb_disc_factor(at, normal, centre, axis, area);
    const lmb_vec3 way = minus(centre, at);
    if (b->plain && area > 0.0f) {
        fuzz_require(f >= 0.0f && f <= 1.001f / area);
        fuzz_require(f == 0.0f || (dot(way, normal) > -1e-3f && dot(way, axis) < 1e-3f));
    }
}

static void polygons(source *b)
{
    const lmb_vec3 at = vector(b), normal = unit(b), axis = unit(b), centre = vector(b), u = vector(b), v = vector(b);
    const int corners = whole(b);
    const lmb_vec3 corner[8] = {centre, minus(centre, u), minus(minus(centre, u), v), minus(centre, v),
                                vector(b), vector(b), vector(b), vector(b)};
    const float quad = lmb_quad_factor(at, normal, normal, centre, axis, u, v),
                triangle = lmb_triangle_factor(at, normal, normal, corner, axis),
                all = lmb_polygon_factor(at, normal, normal, corner, corners, axis);
    const lmb_vec3 c = cross(u, v);
    const float area = sqrtf(dot(c, c));
    fuzz_require((corners >= 3 && corners <= 8) || all == 0.0f);
    if (b->plain && area > 1e-3f * (dot(u, u) + dot(v, v)) && fabsf(dot(axis, c)) > 0.999f * area) {
        fuzz_require(quad >= 0.0f && quad * 4.0f * area <= 1.01f);
        fuzz_require(triangle >= 0.0f && triangle * 0.5f * area <= 1.01f);
    }
}

enum { SIDE = 4 };

/* Every texel of a cube is a number of at least 0. */
static void check_env(const lmb_env *env)
{
    const size_t count = lmb_env_bytes(env->size) / sizeof *env->texels;
    for (size_t i = 0; i < count; ++i) {
        fuzz_require(env->texels[i] <= 0x7bffu);
    }
}

static void check_light(const lmb_light *l)
{
    fuzz_require(l->kind == LMB_LIGHT_DIRECTIONAL && is_unit(l->direction));
    fuzz_require(is_light(l->intensity[0]) && is_light(l->intensity[1]) && is_light(l->intensity[2]));
}

static void cube(source *b)
{
    lmb_env env, dim;
    lmb_light lights[6 * SIDE * SIDE];
    const size_t size = lmb_env_bytes(SIDE);
    float rgb[3] = {number(b), number(b), number(b)};
    fuzz_require(lmb_env_init(&env, SIDE, pool_block(size), size) == LMB_OK);
    fuzz_require(lmb_env_init(&dim, SIDE, pool_block(size), size) == LMB_OK);
    lmb_env_sky(&env, vector(b), number(b), number(b), rgb);
    for (int n = take(b) % 16; n > 0; --n) {
        const float texel[3] = {number(b), number(b), number(b)};
        lmb_env_set(&env, whole(b), whole(b), whole(b), texel);
    }
    check_env(&env);
    if (lmb_env_take_sun(&lights[0], &env)) {
        check_light(&lights[0]);
    }
    lmb_env_mips(&env);
    check_env(&env);
    lmb_env_dim(&dim, &env, rgb);
    check_env(&dim);
    const uint32_t cap = take(b), level = take(b),
                   count = lmb_env_lights(lights, cap < 96 ? cap : 96, &env, (int32_t)level - 2);
    fuzz_require(count <= (cap < 96 ? cap : 96));
    for (uint32_t i = 0; i < count; ++i) {
        check_light(&lights[i]);
    }
    const lmb_vec3 way = vector(b);
    lmb_env_sample(rgb, &env, way, number(b));
    fuzz_require(is_light(rgb[0]) && is_light(rgb[1]) && is_light(rgb[2]));
    lmb_env_irradiance(rgb, &env, way);
    fuzz_require(is_light(rgb[0]) && is_light(rgb[1]) && is_light(rgb[2]));
}

static void many_lights(source *b)
{
    lmb_many_lights many;
    lmb_light l[8];
    const lmb_vec3 low = vector(b), high = vector(b);
    const size_t size = lmb_many_lights_bytes(16);
    uint32_t sent = 0;
    if (lmb_many_lights_init(&many, 16, low, high, number(b), pool_block(size), size) != LMB_OK) {
        return;
    }
    for (; sent < 8; ++sent) {
        memset(&l[sent], 0, sizeof *l);
        l[sent].kind = take(b) % 4;
        l[sent].position = vector(b);
        l[sent].direction = take(b) & 1 ? vector(b) : unit(b);
        l[sent].intensity[0] = number(b);
        l[sent].cos_inner = number(b);
        l[sent].cos_outer = number(b);
        l[sent].range = number(b);
    }
    const lmb_status status = lmb_many_lights_add(&many, l, sent);
    fuzz_require(status == LMB_ERR_CAPACITY || (status == LMB_OK && many.lights + many.dropped == sent));
    fuzz_require(lmb_many_lights_build(&many) == LMB_OK && many.cell_count <= many.cell_cap);
}

/* --- pixels, on all backends -------------------------------------------------------------------------------------- */

enum { TRIANGLES = 6, WIDE = 16 };

typedef struct drawn {
    float corner[TRIANGLES * 9], uv[TRIANGLES * 6];
    uint32_t texel[16];
    lmb_texture texture;
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_light light;
    lmb_scene scene;
} drawn;

/* Makes triangles from the input, some with odd numbers. Returns 0 if lmb_scene_check refuses them. */
static int make(drawn *d, source *b)
{
    memset(d, 0, sizeof *d);
    for (int i = 0; i < TRIANGLES * 9; ++i) {
        d->corner[i] = number(b);
    }
    for (int i = 0; i < TRIANGLES * 6; ++i) {
        d->uv[i] = number(b);
    }
    for (int i = 0; i < 16; ++i) {
        d->texel[i] = (uint32_t)i * 0x17935713u;
    }
    d->texture = (lmb_texture){(const uint8_t *)d->texel, 4, 4, 1, take(b) % 3, take(b) % 3, take(b) % 3, 0};
    d->mesh.positions = d->corner;
    d->mesh.uvs = d->uv;
    d->mesh.vertex_count = 3 * TRIANGLES;
    d->mesh.triangle_count = TRIANGLES;
    d->material.albedo[0] = d->material.albedo[1] = 1.0f;
    d->material.alpha = 1.0f;
    d->material.flags = take(b) % 4;
    d->material.alpha_cutoff = 0.5f;
    d->instance.first_id = 1;
    for (int i = 0; i < 4; ++i) {
        d->instance.to_world.m[5 * i] = 1.0f;
    }
    d->light = (lmb_light){vector(b), unit(b), {1, number(b), 2}, 0.9f, 0.5f, take(b) % 3, 0, 0.0f};
    d->scene = (lmb_scene){.meshes = &d->mesh, .materials = &d->material, .textures = &d->texture,
                           .instances = &d->instance, .lights = &d->light, .mesh_count = 1, .material_count = 1,
                           .texture_count = 1, .instance_count = 1, .light_count = 1};
    lmb_scene_bounds(&d->scene.bounds_min, &d->scene.bounds_max, &d->scene);
    return lmb_scene_check(&d->scene) == LMB_OK;
}

static void same_floats(const void *first, const void *second, size_t bytes)
{
    const float *a = first, *b = second;
    for (size_t i = 0; i < bytes / sizeof *a; ++i) {
        fuzz_require(a[i] == b[i] || (a[i] != a[i] && b[i] != b[i]));
    }
}

/* Draws, resolves, lights and tests one tile; all backends must agree with the first. */
static void pixels(source *b)
{
    static drawn d;
    static lmb_tile tile[2];
    static lmb_irradiance lit[2];
    static uint32_t map_memory[6 * 32 * 32 * 2], depth[WIDE * WIDE], id[WIDE * WIDE];
    lmb_view v;
    lmb_target t = {.x0 = 0};
    lmb_shadow_map map;
    lmb_bvh bvh;
    lmb_hull hull;
    if (!make(&d, b) || lmb_view_look_at(&v, (lmb_vec3){0.1f, 0.2f, 4}, (lmb_vec3){0, 0, 0}, (lmb_vec3){0, 1, 0}, 1.0f,
                                         WIDE, WIDE) != LMB_OK) {
        return;
    }
    const lmb_vec3 at = vector(b), to = unit(b);
    const float noise = number(b);
    const uint64_t asked = (uint64_t)word(b) << 32 | word(b);
    const size_t bytes = lmb_bvh_bytes(TRIANGLES);
    uint64_t hidden[2] = {0, 0}, dark[2] = {0, 0};
    fuzz_require(lmb_bvh_init(&bvh, TRIANGLES, pool_block(bytes), bytes) == LMB_OK &&
                 lmb_bvh_build(&bvh, &d.scene) == LMB_OK);
    lmb_hull_find(&hull, &d.scene);
    const lmb_status fitted =
        lmb_shadow_map_init(&map, &d.light, &d.scene, 32, LMB_ID32, map_memory, sizeof map_memory);
    lmb_surface_init(&t.depth, LMB_DEPTH32F, WIDE, WIDE, depth, sizeof depth);
    lmb_surface_init(&t.id, LMB_ID32, WIDE, WIDE, id, sizeof id);
    for (int k = 0; lmb_kernels_at(k) != NULL; ++k) {
        const lmb_kernels *kernels = lmb_kernels_at(k);
        const int n = k > 0;
        lmb_traversal kept;
        memset(&kept, 0, sizeof kept);
        lmb_surface_clear(&t.depth);
        lmb_surface_clear(&t.id);
        fuzz_require(lmb_draw(&t, kernels, &v, &d.scene, 1, TRIANGLES, 0, NULL) == LMB_OK);
        fuzz_require(lmb_resolve_tile(&tile[n], kernels, &v, &d.scene, &t, 8, 0) == LMB_OK);
        memset(&lit[n], 0, sizeof lit[n]);
        if (fitted == LMB_OK) {
            lmb_shadow_map_clear(&map);
            const lmb_status shadowed = lmb_shadow_map_draw(&map, kernels, &d.scene, 1, TRIANGLES, NULL);
            fuzz_require(shadowed == LMB_OK || !is_near(d.light.position) || !is_near(d.scene.bounds_min) ||
                         !is_near(d.scene.bounds_max)); /* otherwise views may begin outside the world */
            fuzz_require(lmb_direct_tile(&lit[n], kernels, &tile[n], &v, &d.scene, &d.light, &map) == LMB_OK);
        }
        hidden[n] = lmb_occluded_tile(kernels, &kept, &bvh, &tile[n], asked, at, noise);
        memset(&kept, 0, sizeof kept);
        dark[n] = lmb_occluded_sun(kernels, &kept, &bvh, &tile[n], asked, to);
        fuzz_require((hidden[n] & ~asked) == 0 && (dark[n] & ~asked) == 0);
        fuzz_require((lmb_hull_pixels(&hull, &tile[n], asked) & ~asked) == 0);
        if (n > 0) {
            fuzz_require(hidden[0] == hidden[1] && dark[0] == dark[1] &&
                         memcmp(tile[0].id, tile[1].id, sizeof tile[0].id) == 0);
            same_floats(&tile[0], &tile[1], offsetof(lmb_tile, id));
            same_floats(&lit[0], &lit[1], sizeof lit[0]);
        }
    }
    for (int i = 0; i < 3 * LMB_TILE_PIXELS; ++i) {
        const int c = i / LMB_TILE_PIXELS, k = i % LMB_TILE_PIXELS;
        fuzz_require(tile[0].albedo[c][k] >= 0.0f && tile[0].albedo[c][k] <= 1.0f);
        fuzz_require(is_finite(tile[0].position[c][k]) && is_finite(tile[0].normal[c][k]));
        fuzz_require(is_light(lit[0].rgb[c][k]) || d.light.intensity[1] > 1e9f);
    }
    fuzz_require(hull.count >= 0 && hull.count <= LMB_HULL_PLANES && lmb_hull_holds(&hull, at) >> 1 == 0);
}

/* Stores any radiance in each format, on all backends; nothing outside the surface is written. */
static void store(source *b)
{
    static const uint8_t formats[] = {LMB_RGB32F, LMB_RGBA8, LMB_BGRA8, LMB_RGB565, LMB_RGB555, LMB_RGB565_BE};
    static lmb_radiance in;
    lmb_surface s;
    const int32_t x0 = whole(b), y0 = whole(b), x = whole(b), y = whole(b), format = formats[take(b) % COUNT(formats)];
    const float ev = number(b);
    const size_t bytes = lmb_surface_bytes(format, 13, 7);
    uint64_t hash = 0;
    for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
        in.rgb[0][i] = in.rgb[1][i ^ 7] = in.rgb[2][i ^ 63] = number(b);
    }
    fuzz_require(lmb_surface_init(&s, format, 13, 7, pool_block(bytes), bytes) == LMB_OK);
    for (int k = 0; lmb_kernels_at(k) != NULL; ++k) {
        lmb_surface_clear(&s);
        lmb_store_tile(&s, lmb_kernels_at(k), x0, y0, &in, x, y, ev);
        hash = k == 0 ? lmb_surface_hash(&s) : hash;
        fuzz_require(lmb_surface_hash(&s) == hash || format == LMB_RGB32F); /* NaN has many encodings */
    }
}

static void tile_noise(source *b)
{
    static lmb_tile t;
    memset(&t, 0, sizeof t);
    for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
        t.position[i % 3][i] = number(b);
        t.face[i % 2][i] = t.normal[i % 2][i] = 1.0f;
        t.depth[i] = take(b) & 1 ? number(b) : 1.0f;
        t.id[i] = t.depth[i] > 0.0f;
        t.hits += t.id[i] != 0;
    }
    const float most = lmb_tile_noise(&t, ~UINT64_C(0));
    fuzz_require(!b->plain || is_light(most));
    const int32_t width = whole(b), height = whole(b);
    const int good = width >= 1 && height >= 1 && width <= LMB_MAX_SIDE && height <= LMB_MAX_SIDE;
    fuzz_require((lmb_lattice_bytes(width, height) > 0) == good);
}

/* --- settings, probes, photos ------------------------------------------------------------------------------------- */

static void plan(source *b)
{
    ladder_facts f;
    ladder_choice c;
    ladder_settings s;
    ladder_budget budget = {(double)number(b), number(b), (uint64_t)pool_whole(take(b))};
    double *const n[] = {&f.triangles, &f.faces, &f.tiles, &f.lights, &f.bounces, &f.elements, &f.pairs, &f.segments};
    memset(&f, 0, sizeof f);
    for (int i = 0; i < COUNT(n); ++i) {
        *n[i] = (double)number(b);
    }
    f.wanted_map = whole(b);
    f.max = whole(b);
    f.convex = take(b) % 3;
    for (int i = 0; i < LADDER_RUNGS; ++i) {
        f.rung[i] = (ladder_rung){whole(b), number(b), number(b), number(b)};
    }
    const int32_t rung = whole(b);
    const uint64_t fixed = (uint64_t)pool_whole(take(b));
    ladder_at(&s, &f, rung);
    if (rung >= 0 && rung < LADDER_RUNGS && f.max >= LMB_TILE) {
        ladder_cost(&c, &f, rung, fixed);
    }
    if (ladder_choose(&c, &f, &budget, fixed)) {
        fuzz_require(c.rung >= 0 && c.rung < LADDER_RUNGS && (c.meets == 0 || c.meets == 1));
        fuzz_require(c.bytes - fixed < UINT64_C(1) << 63);
        fuzz_require(c.settings.shadow_map % 8 == 0 && (c.settings.tree & (c.settings.tree - 1)) == 0);
        fuzz_require(f.max < 64 || (c.settings.tree <= f.max && c.settings.shadow_map <= f.max));
    }
}

static void probe_cache(source *b)
{
    static lmb_probe_cache c;
    const lmb_probe_policy policy = {number(b), whole(b)};
    if (lmb_probe_cache_init(&c, whole(b), &policy) != LMB_OK) {
        return;
    }
    for (int i = 0; i < 12; ++i) {
        lmb_probe_answer a;
        const uint8_t what = take(b);
        const lmb_vec3 at = vector(b);
        if (what & 1) {
            fuzz_require(lmb_probe_cache_name(&c, at) < c.count);
        } else if (lmb_probe_cache_ask(&a, &c, what & 6u, at, what >> 7, (uint32_t)i) == LMB_OK) {
            fuzz_require(a.slot >= 0 && a.slot < c.count && is_finite(a.place.x) && (a.compute == 0 || a.compute == 1));
        }
    }
}

static void photo(source *b)
{
    lmb_pinhole p = {whole(b), whole(b), number(b), number(b), number(b), number(b)};
    const lmb_vec3 up = unit(b);
    const lmb_axes axes = lmb_axes_upright(up);
    lmb_view v;
    int32_t x0 = 0, y0 = 0;
    fuzz_require(is_unit(axes.right) && is_unit(axes.up) && is_unit(axes.back));
    lmb_pinhole_round(&p);
    lmb_cloud_ray(&p, number(b), number(b));
    if (lmb_photo_view(&v, &x0, &y0, &p, &axes) == LMB_OK) {
        fuzz_require(x0 % LMB_TILE == 0 && y0 % LMB_TILE == 0 && x0 >= 0 && y0 >= 0);
        fuzz_require(v.frame_width <= LMB_MAX_FRAME && v.half_width > 1e-30f && v.half_height > 1e-30f);
    }
}

/* --- the table ---------------------------------------------------------------------------------------------------- */

static void (*const stages[])(source *) = {numbers, look_at, view_sample, surfaces, octahedral, small_helpers,
                                          disc,    polygons, cube,       many_lights, pixels, store,
                                          tile_noise, plan, probe_cache, photo};

void fuzz_stages(const uint8_t *data, size_t size)
{
    source b = {data + (size > 0), data + size, 1};
    pool_begin();
    stages[size > 0 ? data[0] % COUNT(stages) : 0](&b);
    pool_end();
}

#else

void fuzz_stages(const uint8_t *data, size_t size) { (void)data, (void)size; }

#endif
