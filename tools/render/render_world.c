/* render_world.c: a sky or an environment map around a scene, and a ground below it. */
#include "render_world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "../picture/world_read.h"

enum { SKY_SIDE = 64, MAX_SIDE = 512, LIGHT_SIDE = 32 /* lights per side of a cube face */ };
enum { RIM = 64 /* corners of the ground */ };
#define TURBIDITY   3.0f           /* a clear day */
#define SKY_SCALE   0.025f         /* for a sun of 3 W/m2; together they light the ground neutrally */
#define MAX_TEXEL   65504.0f       /* of a half float */
#define REFLECTS    0.5f           /* albedo of the ground */
#define SKY_REACH   10.0f          /* radius of the ground over that of the scene: the rim is far away */
#define BELOW       5e-5f          /* of the radius: floors that has_floor misses still lie on top */
#define WORLD_REACH 4.0f           /* with an environment map the ground is only a small disc */
#define ONE_SUN     0.94f          /* cosine of 20 degrees: nearer suns of two worlds are one that moves */

void world_free(world *w)
{
    free(w->env_memory);
    free(w->lights);
    free(w->meshes);
    free(w->materials);
    free(w->instances);
    free(w->corners);
    memset(w, 0, sizeof *w);
}

static void *take(world *w, size_t bytes, report *r)
{
    void *p = malloc(bytes);
    w->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory for what lies around the scene; try --world none");
    }
    return p;
}

static int take_env(world *w, int32_t side, report *r)
{
    const size_t bytes = lmb_env_bytes(side);
    w->env_memory = take(w, bytes, r);
    return w->env_memory != NULL && lmb_env_init(&w->env, side, w->env_memory, bytes) == LMB_OK;
}

/* --- sky and pictures --------------------------------------------------------------------------------------------- */

int world_sky(world *w, report *r)
{
    static const lmb_light sun = {{0, 0, 0}, {0.45f, -0.8f, -0.3968627f}, {3.2f, 2.85f, 2.3f}, 1.0f, 1.0f,
                                  LMB_LIGHT_DIRECTIONAL, 0, 0};
    static const float black[3] = {0, 0, 0};
    const lmb_vec3 to_sun = {-sun.direction.x, -sun.direction.y, -sun.direction.z};
    w->sun = sun;
    w->has_sun = w->is_sky = 1;
    return take_env(w, SKY_SIDE, r) && lmb_env_sky(&w->env, to_sun, TURBIDITY, SKY_SCALE, black) == LMB_OK;
}

/* The mean of the source texels that a cube texel covers, or the one that contains it. */
static void mean_of(float rgb[3], const float *face, int32_t side, int32_t x, int32_t y, int32_t n)
{
    const int32_t x0 = x * side / n, y0 = y * side / n, x1 = (x + 1) * side / n, y1 = (y + 1) * side / n;
    const int32_t past_x = x1 > x0 ? x1 : x0 + 1, past_y = y1 > y0 ? y1 : y0 + 1;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int32_t j = y0; j < past_y; ++j) {
        for (int32_t i = x0; i < past_x; ++i) {
            for (int c = 0; c < 3; ++c) {
                sum[c] += (double)face[3 * ((size_t)j * (size_t)side + (size_t)i) + (size_t)c];
            }
        }
    }
    for (int c = 0; c < 3; ++c) {
        rgb[c] = (float)(sum[c] / ((double)(past_x - x0) * (double)(past_y - y0)));
    }
}

/* -1 .. 1: centre of texel i of n. */
static float centre_of(int32_t i, int32_t n) { return (float)(2 * i + 1 - n) / (float)n; }

/* Unit vector to texel (x, y) of a face of n x n, in GL order. */
static lmb_vec3 texel_direction(int32_t face, int32_t x, int32_t y, int32_t n)
{
    const float s = centre_of(x, n), t = centre_of(y, n), side = face % 2 == 0 ? 1.0f : -1.0f;
    return normalize3(face < 2   ? vec3(side, -t, -side * s)
                      : face < 4 ? vec3(s, side, side * t)
                                 : vec3(side * s, -t, side));
}

/* Solid angle, sr. */
static float texel_angle(int32_t x, int32_t y, int32_t n)
{
    const float s = centre_of(x, n), t = centre_of(y, n), d2 = 1.0f + s * s + t * t;
    return 4.0f / ((float)n * (float)n * d2 * sqrtf(d2));
}

/* Moves radiance beyond the range of a half float to the sun. */
static void add_clipped(lmb_light *sun, const float rgb[3], lmb_vec3 d, float angle)
{
    float over = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float lost = fminf(rgb[c], 1e20f) - MAX_TEXEL;
        if (lost > 0.0f) {
            sun->intensity[c] += lost * angle;
            over += lost * angle;
        }
    }
    sun->direction.x -= over * d.x;
    sun->direction.y -= over * d.y;
    sun->direction.z -= over * d.z;
}

static float length_of(lmb_vec3 v) { return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z); }

/* Joins the sun found in the cube with the radiance that the cube cannot hold. */
static void join_suns(world *w, const lmb_light *clipped)
{
    lmb_light *sun = &w->sun;
    const float length = length_of(clipped->direction);
    const float own = w->has_sun ? sun->intensity[0] + sun->intensity[1] + sun->intensity[2] : 0.0f;
    if (!(length > 0.0f)) {
        return;
    }
    if (!w->has_sun) {
        memset(sun, 0, sizeof *sun);
        sun->kind = LMB_LIGHT_DIRECTIONAL;
        sun->cos_inner = sun->cos_outer = 1.0f;
        w->has_sun = 1;
    }
    lmb_vec3 d = {own * sun->direction.x + clipped->direction.x, own * sun->direction.y + clipped->direction.y,
                  own * sun->direction.z + clipped->direction.z};
    const float by = 1.0f / length_of(d);
    sun->direction.x = d.x * by;
    sun->direction.y = d.y * by;
    sun->direction.z = d.z * by;
    for (int c = 0; c < 3; ++c) {
        sun->intensity[c] += clipped->intensity[c];
    }
}

static void put_faces(world *w, lmb_light *clipped, const lmb_world_pictures *p)
{
    const int32_t n = w->env.size;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const int32_t face = i / (n * n), x = i % n, y = i / n % n;
        if (p->face[face] != NULL) {
            float rgb[3];
            mean_of(rgb, p->face[face], p->face_size, x, y, n);
            add_clipped(clipped, rgb, texel_direction(face, x, y, n), texel_angle(x, y, n));
            lmb_env_set(&w->env, face, x, y, rgb);
        }
    }
}

int world_read(world *w, const char *path, int is_quiet, report *r)
{
    lmb_world_pictures pictures;
    world_pictures own;
    memset(&pictures, 0, sizeof pictures);
    memset(&own, 0, sizeof own);
    int ok = world_read_cube(&pictures, &own, path, r);
    int32_t side = LIGHT_SIDE;
    while (ok && side < MAX_SIDE && 2 * side <= pictures.face_size) {
        side *= 2;
    }
    ok = ok && take_env(w, side, r);
    if (ok) {
        lmb_light clipped;
        memset(&clipped, 0, sizeof clipped);
        put_faces(w, &clipped, &pictures);
        w->has_sun = lmb_env_take_sun(&w->sun, &w->env);
        join_suns(w, &clipped);
    }
    world_tell_not_finite(&own, path, is_quiet);
    world_pictures_free(&own);
    return ok;
}

/* --- ground ------------------------------------------------------------------------------------------------------- */

/* Surfaces that face up, seen from above, m2: at the scene's base; total minus those that face down. */
typedef struct floors {
    double foot, net;
} floors;

static void add_floor(floors *sum, const lmb_vec3 p[3], float foot)
{
    const double area = 0.5 * ((double)(p[1].z - p[0].z) * (double)(p[2].x - p[0].x) -
                               (double)(p[1].x - p[0].x) * (double)(p[2].z - p[0].z));
    const int is_foot = p[0].y <= foot && p[1].y <= foot && p[2].y <= foot;
    sum->net += area;
    sum->foot += is_foot && area > 0.0 ? area : 0.0;
}

/* Returns whether the scene has a floor, or is terrain. */
static int has_floor(const lmb_scene *s)
{
    const lmb_vec3 low = s->bounds_min, high = s->bounds_max;
    const double plan = (double)(high.x - low.x) * (double)(high.z - low.z);
    floors sum = {0.0, 0.0};
    for (uint32_t id = 1; id <= lmb_scene_triangles(s); ++id) {
        lmb_triangle triangle;
        if (lmb_triangle_fetch(&triangle, s, id)) {
            add_floor(&sum, triangle.corner, low.y + 0.02f * (high.y - low.y));
        }
    }
    return plan > 0.0 && (sum.foot >= 0.5 * plan || sum.net >= 0.5 * plan);
}

static void widen_bounds(lmb_scene *s, const float *corners)
{
    s->bounds_min.y = corners[1];
    for (int i = 0; i < 3 * RIM; ++i) {
        s->bounds_min.x = fminf(s->bounds_min.x, corners[3 * i]);
        s->bounds_max.x = fmaxf(s->bounds_max.x, corners[3 * i]);
        s->bounds_min.z = fminf(s->bounds_min.z, corners[3 * i + 2]);
        s->bounds_max.z = fmaxf(s->bounds_max.z, corners[3 * i + 2]);
    }
}

/* A triangle fan around the middle of the scene's base, facing up. */
static void set_disc(float *corners, const lmb_scene *s, float radius)
{
    const float x = 0.5f * (s->bounds_min.x + s->bounds_max.x), y = s->bounds_min.y - BELOW * radius,
                z = 0.5f * (s->bounds_min.z + s->bounds_max.z);
    for (int i = 0; i < RIM; ++i) {
        float *p = corners + 9 * i;
        for (int k = 0; k < 3; ++k) {
            /* Turns are multiples of 1/64 of a circle. */
            const float at = (float)(k == 0 ? 0 : i + k - 1) * (6.28318531f / RIM), reach = k == 0 ? 0.0f : radius;
            p[3 * k] = x + reach * lmb_sin(at);
            p[3 * k + 1] = y;
            p[3 * k + 2] = z + reach * lmb_cos(at);
        }
    }
}

/* Copies the scene's arrays with room for one more. */
static int widen(world *w, lmb_scene *s, report *r)
{
    w->meshes = take(w, (s->mesh_count + 1) * sizeof *w->meshes, r);
    w->materials = take(w, (s->material_count + 1) * sizeof *w->materials, r);
    w->instances = take(w, (s->instance_count + 1) * sizeof *w->instances, r);
    w->corners = take(w, 9 * RIM * sizeof *w->corners, r);
    if (w->meshes == NULL || w->materials == NULL || w->instances == NULL || w->corners == NULL) {
        return 0;
    }
    memcpy(w->meshes, s->meshes, s->mesh_count * sizeof *w->meshes);
    memcpy(w->materials, s->materials, s->material_count * sizeof *w->materials);
    memcpy(w->instances, s->instances, s->instance_count * sizeof *w->instances);
    s->meshes = w->meshes;
    s->materials = w->materials;
    s->instances = w->instances;
    return 1;
}

static void put_disc(world *w, lmb_scene *s)
{
    lmb_mesh *mesh = &w->meshes[s->mesh_count];
    lmb_material *material = &w->materials[s->material_count];
    lmb_instance *instance = &w->instances[s->instance_count];
    memset(mesh, 0, sizeof *mesh);
    memset(material, 0, sizeof *material);
    memset(instance, 0, sizeof *instance);
    mesh->positions = w->corners;
    mesh->vertex_count = 3 * RIM;
    mesh->triangle_count = RIM;
    material->albedo[0] = material->albedo[1] = material->albedo[2] = REFLECTS;
    material->alpha = 1.0f;
    material->texture = -1;
    for (int i = 0; i < 4; ++i) {
        instance->to_world.m[5 * i] = 1.0f;
    }
    instance->mesh = s->mesh_count++;
    instance->material = s->material_count++;
    w->ground_id = instance->first_id = lmb_scene_triangles(s) + 1;
    ++s->instance_count;
}

/* Limits a map face of the sun to the scene itself; call it before the ground widens the bounds. */
static void set_core(lmb_scene *s)
{
    lmb_core *c = &s->core;
    const int is_all = c->faces <= 1 || memcmp(&c->wide_low, &s->bounds_min, sizeof c->wide_low) != 0 ||
                       memcmp(&c->wide_high, &s->bounds_max, sizeof c->wide_high) != 0;
    if (c->faces <= 1) {
        c->low = c->wide_low = s->bounds_min;
        c->high = c->wide_high = s->bounds_max;
        c->faces = 2;
    } else if (!is_all && c->faces < LMB_CORE_FACES) {
        ++c->faces;
    }
}

static int is_inside(lmb_vec3 p, const lmb_scene *s)
{
    return p.x > s->bounds_min.x && p.x < s->bounds_max.x && p.y > s->bounds_min.y && p.y < s->bounds_max.y &&
           p.z > s->bounds_min.z && p.z < s->bounds_max.z;
}

/* Returns whether the ground's height differs from the base as a float. Far from the origin it may not. */
static int lies_apart(const lmb_scene *s, float radius)
{
    const float y = s->bounds_min.y - BELOW * radius;
    return y < s->bounds_min.y;
}

/* Returns whether the ground lies within 2^20 m of the origin, so that it can be drawn. */
static int is_within(const lmb_scene *s, float reach)
{
    const float x = fmaxf(fabsf(s->bounds_min.x), fabsf(s->bounds_max.x)),
                z = fmaxf(fabsf(s->bounds_min.z), fabsf(s->bounds_max.z));
    return fmaxf(fmaxf(x, z), fabsf(s->bounds_min.y)) + reach < 1048576.0f;
}

int world_put_ground(world *w, lmb_scene *s, lmb_vec3 eye, report *r)
{
    const float wide = s->bounds_max.x - s->bounds_min.x, deep = s->bounds_max.z - s->bounds_min.z,
                high = s->bounds_max.y - s->bounds_min.y;
    const float radius = 0.5f * sqrtf(wide * wide + deep * deep + high * high);
    if (!(radius > 0.0f) || !is_within(s, radius * SKY_REACH) || lmb_scene_triangles(s) > UINT32_MAX / 2 ||
        is_inside(eye, s) || eye.y < s->bounds_min.y || !lies_apart(s, radius) || has_floor(s)) {
        return 1;
    }
    if (!widen(w, s, r)) {
        return 0;
    }
    set_core(s);
    set_disc(w->corners, s, radius * (w->is_sky ? SKY_REACH : WORLD_REACH));
    put_disc(w, s);
    w->has_ground = 1;
    widen_bounds(s, w->corners);
    return lmb_scene_check(s) == LMB_OK || report_fail(r, "no ground fits below the scene; try --ground none");
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

/* Drops lights that the ground hides from the whole scene. The scene is up to two radii high, and sees less deep
 * over the rim. */
static void leave_hidden(world *w)
{
    const float reach = w->is_sky ? SKY_REACH : WORLD_REACH, lowest = 2.0f / sqrtf(4.0f + reach * reach);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < w->count; ++i) {
        if (w->lights[i].direction.y < lowest) {
            w->lights[kept++] = w->lights[i];
        }
    }
    w->count = kept;
}

/* Radiance of a wide open ground lit from above, W/(m2 sr). */
static void ground_radiance(float rgb[3], const world *w)
{
    for (int c = 0; c < 3; ++c) {
        double sum = w->has_sun ? (double)(-w->sun.direction.y * w->sun.intensity[c]) : 0.0;
        for (uint32_t i = 0; i < w->count; ++i) {
            sum += fmax(0.0, (double)(-w->lights[i].direction.y * w->lights[i].intensity[c]));
        }
        rgb[c] = (float)(sum * (double)REFLECTS / 3.14159265358979);
    }
}

/* Fills the lower half of a sky. */
static void put_land(world *w)
{
    float rgb[3];
    const int32_t n = w->env.size;
    ground_radiance(rgb, w);
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const int32_t face = i / (n * n), y = i / n % n;
        if (face == 3 || (face != 2 && y >= n / 2)) {
            lmb_env_set(&w->env, face, i % n, y, rgb);
        }
    }
    lmb_env_mips(&w->env);
}

static void list_lights(world *w)
{
    int32_t level = 0;
    while (w->env.size >> level > LIGHT_SIDE) {
        ++level;
    }
    lmb_env_mips(&w->env);
    w->count = lmb_env_lights(w->lights, 6 * LIGHT_SIDE * LIGHT_SIDE, &w->env, level);
}

int world_light(world *w, report *r)
{
    w->lights = take(w, 6 * LIGHT_SIDE * LIGHT_SIDE * sizeof *w->lights, r);
    if (w->lights == NULL) {
        return 0;
    }
    list_lights(w);
    if (w->is_sky) {
        put_land(w);
        list_lights(w);
    }
    if (w->has_ground) {
        leave_hidden(w);
    }
    return 1;
}

/* --- worlds that change ------------------------------------------------------------------------------------------- */

/* A half float of an environment: not negative, and finite. */
static float half_value(uint16_t code)
{
    const int exponent = code >> 10;
    return exponent > 0 ? ldexpf((float)(1024 + code % 1024), exponent - 25) : ldexpf((float)code, -24);
}

static void blend_texels(world *w, const world *a, const world *b, float share)
{
    const int32_t n = w->env.size;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        float rgb[3];
        for (size_t c = 0; c < 3; ++c) {
            const float from = half_value(a->env.texels[4 * (size_t)i + c]);
            rgb[c] = share > 0.0f ? from + share * (half_value(b->env.texels[4 * (size_t)i + c]) - from) : from;
        }
        lmb_env_set(&w->env, i / (n * n), i % n, i / n % n, rgb);
    }
}

static lmb_light dimmed(lmb_light l, float share)
{
    for (int c = 0; c < 3; ++c) {
        l.intensity[c] *= share;
    }
    return l;
}

static void blend_suns(world *w, const world *a, const world *b, float share)
{
    w->has_sun = w->has_fading = 0;
    if (a->has_sun) {
        w->sun = dimmed(a->sun, 1.0f - share);
        w->has_sun = 1;
    }
    if (share <= 0.0f || !b->has_sun) {
        return;
    }
    const lmb_light next = dimmed(b->sun, share);
    if (!w->has_sun) {
        w->sun = next;
        w->has_sun = 1;
    } else if (dot3(a->sun.direction, b->sun.direction) > ONE_SUN) {
        w->sun.direction =
            normalize3(add3(mul3(a->sun.direction, 1.0f - share), mul3(b->sun.direction, share)));
        for (int c = 0; c < 3; ++c) {
            w->sun.intensity[c] += next.intensity[c];
        }
    } else {
        w->fading = w->sun;
        w->sun = next;
        w->has_fading = 1;
    }
}

void world_blend(world *w, const world *a, const world *b, float share)
{
    blend_texels(w, a, b, share);
    blend_suns(w, a, b, share);
    list_lights(w);
    if (w->has_ground) {
        leave_hidden(w);
    }
}
