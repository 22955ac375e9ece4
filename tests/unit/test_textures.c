/* test_textures.c: layer 3: texture lookups against handmade values and double; a tile's attributes against exact
 * rays. */
#include <math.h>
#include <string.h>

#include <lambent/raster.h>

#include "../../src/raster/texture.h"
#include "../test.h"

void test_textures(void);

/* ---- lookups ---- */

static uint32_t texel_memory[64 * 64 * 2];
static lmb_texture texture;

static uint8_t *texels(void) { return (uint8_t *)texel_memory; }

static void set_texture(int32_t width, int32_t height, int32_t levels, int wrap_s, int wrap_t, int filter)
{
    texture.texels = texels();
    texture.width = (uint16_t)width;
    texture.height = (uint16_t)height;
    texture.levels = (uint8_t)levels;
    texture.wrap_s = (uint8_t)wrap_s;
    texture.wrap_t = (uint8_t)wrap_t;
    texture.filter = (uint8_t)filter;
}

static void put_texel(int at, int r, int g, int b, int a)
{
    uint8_t *p = texels() + 4 * at;
    p[0] = (uint8_t)r;
    p[1] = (uint8_t)g;
    p[2] = (uint8_t)b;
    p[3] = (uint8_t)a;
}

/* IEC 61966-2-1 */
static double linear_of(int code)
{
    double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double alpha_at(float u, float v, float lod)
{
    float out[4];
    lmb_texture_sample(out, &texture, u, v, lod);
    return (double)out[3];
}

/* A row of four texels with the alphas 0, 51, 102, 255: 0, 0.2, 0.4, 1. */
static void test_by_hand(void)
{
    const struct { /* not static: tcc rejects NAN as a constant */
        int wrap, filter;
        float u;
        double expected;
    } rows[] = {
        {LMB_WRAP_REPEAT, LMB_NEAREST, 0.0f, 0.0},    {LMB_WRAP_REPEAT, LMB_NEAREST, 0.2499f, 0.0},
        {LMB_WRAP_REPEAT, LMB_NEAREST, 0.25f, 0.2},   {LMB_WRAP_REPEAT, LMB_NEAREST, 0.999f, 1.0},
        {LMB_WRAP_REPEAT, LMB_NEAREST, 1.0f, 0.0},    {LMB_WRAP_REPEAT, LMB_NEAREST, -0.125f, 1.0},
        {LMB_WRAP_REPEAT, LMB_NEAREST, -7.3f, 0.4},   {LMB_WRAP_REPEAT, LMB_NEAREST, -1e-9f, 0.0},
        {LMB_WRAP_CLAMP, LMB_NEAREST, 1.0f, 1.0},     {LMB_WRAP_CLAMP, LMB_NEAREST, 9.0f, 1.0},
        {LMB_WRAP_CLAMP, LMB_NEAREST, -3.0f, 0.0},    {LMB_WRAP_MIRROR, LMB_NEAREST, 1.1f, 1.0},
        {LMB_WRAP_MIRROR, LMB_NEAREST, 1.3f, 0.4},    {LMB_WRAP_MIRROR, LMB_NEAREST, -0.3f, 0.2},
        {LMB_WRAP_MIRROR, LMB_NEAREST, 2.3f, 0.2},    {LMB_WRAP_MIRROR, LMB_NEAREST, -1.1f, 1.0},
        {LMB_WRAP_REPEAT, LMB_BILINEAR, 0.125f, 0.0}, {LMB_WRAP_REPEAT, LMB_BILINEAR, 0.25f, 0.1},
        {LMB_WRAP_REPEAT, LMB_BILINEAR, 0.75f, 0.7},  {LMB_WRAP_REPEAT, LMB_BILINEAR, 0.0f, 0.5},
        {LMB_WRAP_REPEAT, LMB_BILINEAR, 1.0f, 0.5},   {LMB_WRAP_REPEAT, LMB_BILINEAR, 5.4375f, 0.25},
        {LMB_WRAP_CLAMP, LMB_BILINEAR, 0.0f, 0.0},    {LMB_WRAP_CLAMP, LMB_BILINEAR, 1.0f, 1.0},
        {LMB_WRAP_CLAMP, LMB_BILINEAR, 0.75f, 0.7},   {LMB_WRAP_CLAMP, LMB_BILINEAR, 44.0f, 1.0},
        {LMB_WRAP_MIRROR, LMB_BILINEAR, 0.0f, 0.0},   {LMB_WRAP_MIRROR, LMB_BILINEAR, 1.0f, 1.0},
        {LMB_WRAP_MIRROR, LMB_BILINEAR, 1.25f, 0.7},  {LMB_WRAP_MIRROR, LMB_BILINEAR, 2.0f, 0.0},
        {LMB_WRAP_MIRROR, LMB_BILINEAR, -0.25f, 0.1}, {LMB_WRAP_REPEAT, LMB_NEAREST, NAN, 0.0},
        {LMB_WRAP_MIRROR, LMB_NEAREST, INFINITY, 0.0}, {LMB_WRAP_CLAMP, LMB_NEAREST, -INFINITY, 0.0},
    };
    static const int alpha[4] = {0, 51, 102, 255};
    for (int i = 0; i < 4; ++i) {
        put_texel(i, 0, 0, 0, alpha[i]);
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        double got;
        set_texture(4, 1, 1, rows[i].wrap, LMB_WRAP_REPEAT, rows[i].filter);
        got = alpha_at(rows[i].u, 0.5f, 0.0f);
        CHECK_MSG(fabs(got - rows[i].expected) < 1e-6, "row %d: along s %g, not %g", (int)i, got, rows[i].expected);
        set_texture(1, 4, 1, LMB_WRAP_REPEAT, rows[i].wrap, rows[i].filter);
        got = alpha_at(0.5f, rows[i].u, 0.0f);
        CHECK_MSG(fabs(got - rows[i].expected) < 1e-6, "row %d: along t %g, not %g", (int)i, got, rows[i].expected);
    }
}

/* Mathematical remainder, in another way than the library. */
static int wrapped(long long i, int size, int wrap)
{
    long long m = ((i % size) + size) % size;
    if (wrap == LMB_WRAP_CLAMP) {
        return (int)(i < 0 ? 0 : i >= size ? size - 1 : i);
    }
    if (wrap == LMB_WRAP_MIRROR) {
        long long period = ((i % (2 * size)) + 2 * size) % (2 * size);
        return (int)(period < size ? period : 2 * size - 1 - period);
    }
    return (int)m;
}

static double texel_value(int level, int x, int y, int channel)
{
    int width = texture.width, height = texture.height;
    const uint8_t *p = texels();
    for (int i = 0; i < level; ++i) {
        p += 4 * width * height;
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
    }
    p += 4 * (wrapped(y, height, texture.wrap_t) * width + wrapped(x, width, texture.wrap_s));
    return channel == 3 ? p[3] / 255.0 : linear_of(p[channel]);
}

static double level_value(int level, double u, double v, int channel)
{
    int width = texture.width >> level, height = texture.height >> level;
    double x = u * (width ? width : 1), y = v * (height ? height : 1);
    if (texture.filter == LMB_NEAREST) {
        return texel_value(level, (int)floor(x), (int)floor(y), channel);
    }
    double fx = x - 0.5 - floor(x - 0.5), fy = y - 0.5 - floor(y - 0.5);
    int ix = (int)floor(x - 0.5), iy = (int)floor(y - 0.5);
    double top = texel_value(level, ix, iy, channel) * (1 - fx) + texel_value(level, ix + 1, iy, channel) * fx;
    double low = texel_value(level, ix, iy + 1, channel) * (1 - fx) + texel_value(level, ix + 1, iy + 1, channel) * fx;
    return top * (1 - fy) + low * fy;
}

static double sample_value(double u, double v, double lod, int channel)
{
    if (texture.filter != LMB_TRILINEAR || lod <= 0 || texture.levels < 2) {
        return level_value(0, u, v, channel);
    }
    lod = fmin(lod, texture.levels - 1);
    int n = (int)lod;
    double part = lod - n;
    return level_value(n, u, v, channel) * (1 - part) + (part > 0 ? level_value(n + 1, u, v, channel) * part : 0);
}

/* Coordinates are multiples of 2^-10 off texel borders: exact in float and double. */
static float random_coordinate(test_rng *r, int nearest, int size)
{
    float u;
    do {
        u = (float)((int)(test_random(r) % 8192) - 4096) / 1024.0f;
    } while (nearest && fabsf(u * (float)size - floorf(u * (float)size + 0.5f)) < 0.01f);
    return u;
}

static void test_against_double(void)
{
    static const int sides[][2] = {{1, 1}, {2, 2}, {4, 8}, {16, 4}, {5, 3}, {31, 17}};
    test_rng r = {21};
    for (int i = 0; i < 64 * 64 * 2; ++i) {
        put_texel(i, test_random(&r) & 255, test_random(&r) & 255, test_random(&r) & 255, test_random(&r) & 255);
    }
    for (int variant = 0; variant < 6 * 27; ++variant) {
        const int *side = sides[variant / 27];
        int filter = variant / 9 % 3, levels = filter == LMB_TRILINEAR ? lmb_texture_level_count(side[0], side[1]) : 1;
        double worst = 0;
        int same = 0;
        set_texture(side[0], side[1], levels, variant % 3, variant / 3 % 3, filter);
        for (int n = 0; n < tries(40, 200); ++n) {
            float u = random_coordinate(&r, filter == LMB_NEAREST, side[0]);
            float v = random_coordinate(&r, filter == LMB_NEAREST, side[1]);
            float lod = test_uniform(&r, -1.0f, 7.0f), out[4];
            lmb_texture_sample(out, &texture, u, v, 0.0f);
            same += lmb_texture_alpha(&texture, u, v) == out[3];
            lmb_texture_sample(out, &texture, u, v, lod);
            for (int c = 0; c < 4; ++c) {
                worst = fmax(worst, fabs((double)out[c] - sample_value((double)u, (double)v, (double)lod, c)));
            }
        }
        CHECK_MSG(worst < 1e-5, "variant %d: %g", variant, worst);
        CHECK_MSG(same == tries(40, 200), "variant %d: %d alphas are those of samples with colours", variant, same);
    }
}

/* ---- a scene for resolve ---- */

enum { FRAME = 64 };

static struct resolve_stage {
    float positions[9], uvs[6];
    uint32_t colours[3];
    int16_t normals[6];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view;
    lmb_target target;
} st;
static uint32_t depth_memory[FRAME * FRAME], id_memory[FRAME * FRAME];
static lmb_tile tile;

static void set_scene(void)
{
    static const lmb_instance plain = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 0, 0, 1, 0};
    memset(&st, 0, sizeof st);
    st.mesh.positions = st.positions;
    st.mesh.vertex_count = 3;
    st.mesh.triangle_count = 1;
    st.material.albedo[0] = st.material.albedo[1] = st.material.albedo[2] = st.material.alpha = 1.0f;
    st.material.texture = -1;
    st.instance = plain;
    st.scene.meshes = &st.mesh;
    st.scene.materials = &st.material;
    st.scene.instances = &st.instance;
    st.scene.textures = &texture;
    st.scene.mesh_count = st.scene.material_count = st.scene.instance_count = st.scene.texture_count = 1;
}

static void draw_scene(void)
{
    lmb_surface_init(&st.target.depth, LMB_DEPTH32F, FRAME, FRAME, depth_memory, sizeof depth_memory);
    lmb_surface_init(&st.target.id, LMB_ID32, FRAME, FRAME, id_memory, sizeof id_memory);
    lmb_surface_clear(&st.target.depth);
    lmb_surface_clear(&st.target.id);
    lmb_draw(&st.target, picked_kernels(), &st.view, &st.scene, 1, 1, 0, NULL);
}

static lmb_status resolve(int32_t x, int32_t y)
{
    return lmb_resolve_tile(&tile, picked_kernels(), &st.view, &st.scene, &st.target, x, y);
}

/* ---- attributes against rays in double ---- */

typedef struct point3 {
    double v[3];
} point3;

static point3 from_vec(lmb_vec3 a) { return (point3){{(double)a.x, (double)a.y, (double)a.z}}; }

/* a + s b */
static point3 along(point3 a, double s, point3 b)
{
    return (point3){{a.v[0] + s * b.v[0], a.v[1] + s * b.v[1], a.v[2] + s * b.v[2]}};
}

static double dot(point3 a, point3 b) { return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2]; }

static point3 cross(point3 a, point3 b)
{
    return (point3){{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2],
                     a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}

static point3 unit(point3 a) { return along((point3){{0, 0, 0}}, 1.0 / sqrt(dot(a, a)), a); }

static double distance(point3 a, point3 b) { return sqrt(dot(along(a, -1, b), along(a, -1, b))); }

static point3 column(int c)
{
    const float *m = st.instance.to_world.m + 4 * c;
    return (point3){{(double)m[0], (double)m[1], (double)m[2]}};
}

/* The exact values of one pixel. */
typedef struct truth {
    point3 corner[3], plane, face, position, normal;
    double b[3], w, facing;
} truth;

static void place_corners(truth *t)
{
    for (int k = 0; k < 3; ++k) {
        point3 p = column(3);
        for (int c = 0; c < 3; ++c) {
            p = along(p, (double)st.positions[3 * k + c], column(c));
        }
        t->corner[k] = p;
    }
    t->plane = unit(cross(along(t->corner[1], -1, t->corner[0]), along(t->corner[2], -1, t->corner[0])));
}

static void cast_ray(truth *t, int32_t x, int32_t y)
{
    const lmb_view *v = &st.view;
    const point3 zero = {{0, 0, 0}};
    double sx = ((x + 0.5) * 2 / FRAME - 1) * (double)v->half_width;
    double sy = (1 - (y + 0.5) * 2 / FRAME) * (double)v->half_height;
    point3 across = along(along(zero, sx, from_vec(v->right)), sy, from_vec(v->up)), origin = from_vec(v->eye);
    point3 ray = along(v->kind == LMB_PERSPECTIVE ? across : zero, -1, from_vec(v->back));
    origin = v->kind == LMB_PERSPECTIVE ? origin : along(origin, 1, across);
    double slope = dot(t->plane, ray), whole;
    t->w = dot(t->plane, along(t->corner[0], -1, origin)) / slope;
    t->position = along(origin, t->w, ray);
    t->facing = fabs(slope) / sqrt(dot(ray, ray));
    t->face = slope > 0 ? along(zero, -1, t->plane) : t->plane;
    whole = dot(t->plane, cross(along(t->corner[1], -1, t->corner[0]), along(t->corner[2], -1, t->corner[0])));
    for (int k = 0; k < 3; ++k) {
        const point3 *a = &t->corner[(k + 1) % 3], *b = &t->corner[(k + 2) % 3];
        t->b[k] = dot(t->plane, cross(along(*b, -1, *a), along(t->position, -1, *a))) / whole;
    }
}

/* Inverse transpose by cofactors, on the side of the face. */
static void mix_normals(truth *t)
{
    point3 sum = {{0, 0, 0}}, a = column(0), b = column(1), c = column(2);
    for (int k = 0; k < 3; ++k) {
        point3 n = from_vec(lmb_octahedral_decode(st.normals + 2 * k)), world = {{0, 0, 0}};
        world = along(world, n.v[0], cross(b, c));
        world = along(world, n.v[1], cross(c, a));
        world = along(world, n.v[2], cross(a, b));
        sum = along(sum, t->b[k], unit(world));
    }
    sum = unit(sum);
    t->normal = dot(sum, t->face) < 0 ? along((point3){{0, 0, 0}}, -1, sum) : sum;
}

typedef struct resolve_worst {
    double plane, ray, depth, uv, colour, face, normal;
    int pixels, failed;
} resolve_worst;

static point3 tile_point(float plane[3][LMB_TILE_PIXELS], int k)
{
    return (point3){{(double)plane[0][k], (double)plane[1][k], (double)plane[2][k]}};
}

static double mixed(const truth *t, double a, double b, double c) { return t->b[0] * a + t->b[1] * b + t->b[2] * c; }

static void judge_pixel(resolve_worst *worst, truth *t, int k)
{
    point3 p = tile_point(tile.position, k);
    double away = distance(p, from_vec(st.view.eye));
    mix_normals(t);
    worst->plane = fmax(worst->plane, fabs(dot(t->plane, along(p, -1, t->corner[0]))) / away);
    worst->ray = fmax(worst->ray, distance(p, t->position) / away);
    worst->depth = fmax(worst->depth, fabs((double)tile.depth[k] / t->w - 1));
    worst->face = fmax(worst->face, distance(tile_point(tile.face, k), t->face));
    worst->normal = fmax(worst->normal, distance(tile_point(tile.normal, k), t->normal));
    for (int c = 0; c < 2; ++c) {
        double uv = mixed(t, (double)st.uvs[c], (double)st.uvs[2 + c], (double)st.uvs[4 + c]);
        worst->uv = fmax(worst->uv, fabs((double)tile.uv[c][k] - uv));
    }
    for (int c = 0; c < 3; ++c) {
        const uint8_t *code = (const uint8_t *)st.colours;
        double colour = mixed(t, code[c], code[4 + c], code[8 + c]) / 255.0 * (double)st.material.albedo[c];
        worst->colour = fmax(worst->colour, fabs((double)tile.albedo[c][k] - colour));
    }
    ++worst->pixels;
}

/* Pixels inside the exact triangle; snapping may add others at the rim, with clamped attributes. */
static void judge_frame(resolve_worst *worst)
{
    truth t;
    place_corners(&t);
    for (int32_t at = 0; at < FRAME / 8 * (FRAME / 8); ++at) {
        int32_t x0 = at % 8 * 8, y0 = at / 8 * 8;
        worst->failed += resolve(x0, y0) != LMB_OK;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            cast_ray(&t, x0 + k % 8, y0 + k / 8);
            if (tile.id[k] && t.facing > 0.2 && t.b[0] > 0 && t.b[1] > 0 && t.b[2] > 0) {
                judge_pixel(worst, &t, k);
            }
        }
    }
}

/* No sliver: the smallest height is at least a third of the longest side. */
static int is_stout(void)
{
    truth t;
    double longest = 0, area;
    place_corners(&t);
    for (int k = 0; k < 3; ++k) {
        longest = fmax(longest, distance(t.corner[k], t.corner[(k + 1) % 3]));
    }
    point3 n = cross(along(t.corner[1], -1, t.corner[0]), along(t.corner[2], -1, t.corner[0]));
    area = sqrt(dot(n, n));
    return longest > 1.0 && area > longest * longest / 3;
}

static lmb_vec3 random_vec(test_rng *r, float reach)
{
    lmb_vec3 v;
    v.x = test_uniform(r, -reach, reach);
    v.y = test_uniform(r, -reach, reach);
    v.z = test_uniform(r, -reach, reach);
    return v;
}

static void random_scene(test_rng *r, int variant)
{
    lmb_vec3 eye = random_vec(r, 1), target = random_vec(r, 0.3f), up = {0, 1, 0};
    set_scene();
    for (int i = 0; i < 12; ++i) { /* non-uniform scales, shears, mirrors */
        if (i % 4 == 3) {
            continue;
        }
        st.instance.to_world.m[i] += test_uniform(r, -0.4f, 0.4f) * (variant & 4 ? 1.0f : 0.0f);
        st.instance.to_world.m[i] *= variant & 8 && i < 4 ? -1.0f : 1.0f;
    }
    do {
        for (int i = 0; i < 9; ++i) {
            st.positions[i] = test_uniform(r, -1.5f, 1.5f);
        }
    } while (!is_stout());
    for (int k = 0; k < 3; ++k) {
        lmb_vec3 n = random_vec(r, 0.3f);
        n.z += 1.0f;
        float size = sqrtf(n.x * n.x + n.y * n.y + n.z * n.z);
        n.x /= size;
        n.y /= size;
        n.z /= size;
        lmb_octahedral_encode(st.normals + 2 * k, n);
        st.uvs[2 * k] = test_uniform(r, 0, 1);
        st.uvs[2 * k + 1] = test_uniform(r, 0, 1);
        st.colours[k] = test_random(r);
    }
    for (int c = 0; c < 3; ++c) {
        st.material.albedo[c] = test_uniform(r, 0, 1);
    }
    eye.z += 4.0f;
    lmb_view_look_at(&st.view, eye, target, up, 0.8f, FRAME, FRAME);
    if (variant & 1) {
        st.view.kind = LMB_ORTHOGRAPHIC;
        st.view.half_width = st.view.half_height = 1.7f;
        st.view.far_m = 20.0f;
    }
    st.mesh.uvs = st.uvs;
    st.mesh.colours = (const uint8_t *)st.colours;
    st.mesh.normals = st.normals;
}

static void test_attributes(void)
{
    test_rng r = {22};
    resolve_worst worst;
    memset(&worst, 0, sizeof worst);
    for (int n = 0; n < tries(60, 400); ++n) {
        random_scene(&r, n);
        draw_scene();
        judge_frame(&worst);
    }
    CHECK_MSG(worst.plane < 1e-6, "off the plane by %g of the distance", worst.plane);
    CHECK_MSG(worst.ray < 5e-6, "off the ray's hit by %g of the distance", worst.ray); /* facing 0.2: 5 x the plane's */
    CHECK_MSG(worst.depth < 5e-6, "depth %g", worst.depth);
    CHECK_MSG(worst.uv < 1e-5, "uv %g", worst.uv);
    CHECK_MSG(worst.colour < 1e-5, "colour %g", worst.colour);
    CHECK_MSG(worst.face < 2e-6, "face normal %g", worst.face);
    CHECK_MSG(worst.normal < 1e-5, "normal %g", worst.normal);
    CHECK(worst.pixels > 15000 && worst.failed == 0);
}

/* Without streams: flat, white, (0, 0). Pixels without a surface stay empty. */
static void test_plain_attributes(void)
{
    test_rng r = {23};
    int wrong = 0, empty = 0;
    random_scene(&r, 0);
    st.mesh.uvs = NULL;
    st.mesh.colours = NULL;
    st.mesh.normals = NULL;
    draw_scene();
    for (int32_t at = 0; at < FRAME / 8 * (FRAME / 8); ++at) {
        int32_t hits = 0;
        resolve(at % 8 * 8, at / 8 * 8);
        CHECK(tile.x == at % 8 * 8 && tile.y == at / 8 * 8);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            hits += tile.id[k] == 1;
            empty += tile.id[k] == 0;
            for (int c = 0; c < 3; ++c) {
                wrong += tile.normal[c][k] != tile.face[c][k];
                wrong += fabsf(tile.albedo[c][k] - (tile.id[k] ? st.material.albedo[c] : 0.0f)) > 2.4e-7f;
                wrong += tile.id[k] == 0 && (tile.position[c][k] != 0 || tile.face[c][k] != 0);
            }
            wrong += tile.uv[0][k] != 0.0f || tile.uv[1][k] != 0.0f || (tile.depth[k] != 0.0f) != (tile.id[k] != 0);
        }
        wrong += tile.hits != hits;
    }
    CHECK_MSG(wrong == 0, "%d", wrong);
    CHECK(empty > 0 && empty < FRAME * FRAME);
}

/* lmb_resolve_albedo: the colours of lmb_resolve_tile, without the rest. */
static void test_albedo_only(void)
{
    static lmb_tile only;
    test_rng r = {25};
    for (int n = 0; n < 20; ++n) {
        random_scene(&r, n);
        draw_scene();
        for (int32_t at = 0; at < FRAME * FRAME; at += 8 * 8) {
            const int32_t x = at / 8 % FRAME, y = at / 8 / FRAME * 8;
            memset(&only, 0xa5, sizeof only);
            CHECK(resolve(x, y) == LMB_OK);
            CHECK(lmb_resolve_albedo(&only, picked_kernels(), &st.view, &st.scene, &st.target, x, y) == LMB_OK);
            CHECK(only.x == x && only.y == y && only.hits == tile.hits);
            CHECK(memcmp(only.albedo, tile.albedo, sizeof only.albedo) == 0 &&
                  memcmp(only.uv, tile.uv, sizeof only.uv) == 0 && memcmp(only.id, tile.id, sizeof only.id) == 0);
        }
    }
    CHECK(lmb_resolve_albedo(NULL, picked_kernels(), &st.view, &st.scene, &st.target, 0, 0) == LMB_ERR_ARG);
}

static void test_resolve_arguments(void)
{
    static lmb_tile before;
    test_rng r = {24};
    lmb_target no_ids;
    random_scene(&r, 0);
    draw_scene();
    memset(&tile, 0xa5, sizeof tile);
    before = tile;
    no_ids = st.target;
    no_ids.id.data = NULL;
    const lmb_kernels *k = picked_kernels();
    CHECK(lmb_resolve_tile(NULL, k, &st.view, &st.scene, &st.target, 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_resolve_tile(&tile, NULL, &st.view, &st.scene, &st.target, 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_resolve_tile(&tile, k, NULL, &st.scene, &st.target, 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_resolve_tile(&tile, k, &st.view, NULL, &st.target, 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_resolve_tile(&tile, k, &st.view, &st.scene, NULL, 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_resolve_tile(&tile, k, &st.view, &st.scene, &no_ids, 0, 0) == LMB_ERR_ARG);
    CHECK(resolve(4, 0) == LMB_ERR_ARG && resolve(0, 4) == LMB_ERR_ARG && resolve(-8, 0) == LMB_ERR_ARG);
    CHECK(resolve(FRAME, 0) == LMB_ERR_ARG && resolve(0, FRAME) == LMB_ERR_ARG);
    CHECK(memcmp(&tile, &before, sizeof tile) == 0);
    memset(id_memory, 0x7f, sizeof id_memory); /* ids of another scene */
    CHECK(resolve(0, 0) == LMB_OK && tile.hits == 0 && tile.id[0] == 0 && tile.depth[0] == 0.0f);
}

/* ---- levels of detail ---- */

/* Level n of a 64 x 64 image is one constant grey; alpha is not read. */
static const int level_code[7] = {0, 40, 80, 120, 160, 200, 240};

static void set_levels(void)
{
    int at = 0;
    for (int n = 0; n < 7; ++n) {
        for (int i = 0; i < (64 >> n) * (64 >> n); ++i) {
            put_texel(at++, level_code[n], level_code[n], level_code[n], 255);
        }
    }
    set_texture(64, 64, 7, LMB_WRAP_REPEAT, LMB_WRAP_REPEAT, LMB_TRILINEAR);
}

/* A triangle over the frame at 1 pixel per metre with `sx`, `sy` texels per pixel. */
static float grey_at(float sx, float sy)
{
    set_scene();
    set_levels();
    const float p[9] = {-100, -100, -3, 200, -100, -3, -100, 200, -3};
    memcpy(st.positions, p, sizeof p);
    for (int k = 0; k < 3; ++k) {
        st.uvs[2 * k] = p[3 * k] * sx / 64.0f;
        st.uvs[2 * k + 1] = -p[3 * k + 1] * sy / 64.0f;
    }
    st.mesh.uvs = st.uvs;
    st.material.texture = 0;
    st.view.right.x = st.view.up.y = st.view.back.z = 1.0f;
    st.view.kind = LMB_ORTHOGRAPHIC;
    st.view.half_width = st.view.half_height = FRAME / 2;
    st.view.near_m = 1.0f;
    st.view.far_m = 10.0f;
    st.view.frame_width = st.view.frame_height = FRAME;
    draw_scene();
    resolve(24, 32);
    return tile.albedo[1][27];
}

/* Level = log2 of texels per pixel, for the longer of the two steps. */
static double grey_of_level(double lod)
{
    lod = fmin(fmax(lod, 0), 6);
    int n = (int)lod;
    double next = n < 6 ? linear_of(level_code[n + 1]) : 0;
    return linear_of(level_code[n]) * (1 - (lod - n)) + next * (lod - n);
}

static void test_levels(void)
{
    static const float rate[][2] = {{1, 1}, {0.25f, 0.25f}, {2, 2}, {4, 4}, {3, 3}, {5.5f, 5.5f}, {32, 32}, {64, 64},
                                    {900, 900}, {8, 1}, {1, 8}, {2, 6}, {0.1f, 3}};
    for (size_t i = 0; i < sizeof rate / sizeof *rate; ++i) {
        double expected = grey_of_level(log2(fmax((double)rate[i][0], (double)rate[i][1])));
        double got = (double)grey_at(rate[i][0], rate[i][1]);
        CHECK_MSG(fabs(got - expected) < 1e-3, "%g x %g texels a pixel: %g, not %g", (double)rate[i][0],
                  (double)rate[i][1], got, expected);
    }
}

/* A receding floor: levels only increase with distance. */
static void test_levels_recede(void)
{
    static const float p[9] = {-300, -1, 0, 300, -1, 0, 0, -1, -300};
    float before = 2.0f;
    int levels = 0;
    grey_at(1, 1);
    memcpy(st.positions, p, sizeof p);
    for (int k = 0; k < 3; ++k) {
        st.uvs[2 * k] = p[3 * k] / 8.0f;
        st.uvs[2 * k + 1] = p[3 * k + 2] / 8.0f;
    }
    st.view.kind = LMB_PERSPECTIVE;
    st.view.half_width = st.view.half_height = 1.0f;
    draw_scene();
    for (int32_t y = 0; y < FRAME; ++y) { /* from the horizon downwards */
        resolve(32, y / 8 * 8);
        int k = y % 8 * 8 + 2;
        if (tile.id[k] && tile.depth[k] < 200.0f) {
            CHECK_MSG(tile.albedo[1][k] <= before + 1e-4f, "row %d", (int)y);
            levels += tile.albedo[1][k] < before;
            before = tile.albedo[1][k];
        }
    }
    CHECK_MSG(levels > 10 && before < 0.01f, "%d steps down to %g", levels, (double)before);
}

void test_textures(void)
{
    test_by_hand();
    test_against_double();
    test_attributes();
    test_plain_attributes();
    test_albedo_only();
    test_resolve_arguments();
    test_levels();
    test_levels_recede();
}
