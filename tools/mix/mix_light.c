/* mix_light.c: the light around a photo: environment (folded or a panorama), lights, and shadow maps. */
#include "mix_around.h"
#include "mix_frames.h"
#include "mix_sources.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/area_light.h"
#include "../picture/world_read.h"

enum { ENV_SIZE = 64, SUB = 4 };

static lmb_vec3 turned(const lmb_mat4 *t, lmb_vec3 d)
{
    const float *m = t->m;
    const lmb_vec3 out = {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                          m[2] * d.x + m[6] * d.y + m[10] * d.z};
    return out;
}

/* --- environment -------------------------------------------------------------------------------------------------- */

/* The direction of a texel, as defined in lambent/env.h. */
static lmb_vec3 direction_of(int32_t face, float s, float t)
{
    const lmb_vec3 all[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return all[face];
}

static void add_seen(float sum[3], const lmb_world_pictures *p, lmb_vec3 d)
{
    const float x = d.x < 0 ? -d.x : d.x, y = d.y < 0 ? -d.y : d.y, z = d.z < 0 ? -d.z : d.z;
    const int32_t axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2, n = p->face_size;
    const float far = axis == 0 ? x : axis == 1 ? y : z;
    const int32_t face = 2 * axis + (axis == 0 ? d.x < 0 : axis == 1 ? d.y < 0 : d.z < 0);
    const float s = (axis == 0 ? (d.x > 0 ? -d.z : d.z) : axis == 1 ? d.x : d.z > 0 ? d.x : -d.x) / far;
    const float t = (axis == 1 ? (d.y > 0 ? d.z : -d.z) : -d.y) / far;
    int32_t i = (int32_t)((s + 1.0f) * 0.5f * (float)n), k = (int32_t)((t + 1.0f) * 0.5f * (float)n);
    i = i < 0 ? 0 : i > n - 1 ? n - 1 : i;
    k = k < 0 ? 0 : k > n - 1 ? n - 1 : k;
    for (int c = 0; c < 3 && p->face[face] != NULL; ++c) {
        sum[c] += p->face[face][3 * ((size_t)k * (size_t)n + (size_t)i) + (size_t)c] * (1.0f / (SUB * SUB));
    }
}

/* Directions of a panorama are in world space. */
static void fill_env(const mix_job *j, const lmb_world_pictures *p)
{
    lmb_mat4 to_world = j->from_world; /* the rotation's inverse is its transpose */
    for (int i = 0; i < 9; ++i) {
        to_world.m[i / 3 * 4 + i % 3] = j->from_world.m[i % 3 * 4 + i / 3];
    }
    for (int32_t i = 0; i < 6 * ENV_SIZE * ENV_SIZE; ++i) {
        const int32_t face = i / (ENV_SIZE * ENV_SIZE), x = i % ENV_SIZE, y = i / ENV_SIZE % ENV_SIZE;
        float sum[3] = {0, 0, 0};
        for (int32_t k = 0; k < SUB * SUB; ++k) {
            const float s = (2.0f * (float)(SUB * x + k % SUB) + 1.0f) / (SUB * ENV_SIZE) - 1.0f,
                        t = (2.0f * (float)(SUB * y + k / SUB) + 1.0f) / (SUB * ENV_SIZE) - 1.0f;
            add_seen(sum, p, turned(&to_world, direction_of(face, s, t)));
        }
        lmb_env_set(&j->env[0], face, x, y, sum);
    }
    lmb_env_mips(&j->env[0]);
}

static int read_world(mix_job *j, report *r)
{
    lmb_world_pictures place;
    world_pictures own;
    memset(&place, 0, sizeof place);
    memset(&own, 0, sizeof own);
    const int ok = world_read_cube(&place, &own, j->o.world, r);
    if (ok) {
        fill_env(j, &place);
        world_tell_not_finite(&own, j->o.world, j->o.is_quiet);
    }
    world_pictures_free(&own);
    return ok;
}

/* Resamples an environment to other axes: `to_from` turns directions of `out` to those of `from`. */
static void turn_env(const lmb_env *out, const lmb_env *from, const lmb_mat4 *to_from)
{
    for (int32_t i = 0; i < 6 * ENV_SIZE * ENV_SIZE; ++i) {
        const int32_t face = i / (ENV_SIZE * ENV_SIZE), x = i % ENV_SIZE, y = i / ENV_SIZE % ENV_SIZE;
        const float s = (2.0f * (float)x + 1.0f) / ENV_SIZE - 1.0f, t = (2.0f * (float)y + 1.0f) / ENV_SIZE - 1.0f;
        float rgb[3];
        lmb_env_sample(rgb, from, turned(to_from, direction_of(face, s, t)), 0.0f);
        lmb_env_set(out, face, x, y, rgb);
    }
    lmb_env_mips(out);
}

static lmb_mat4 turned_back(const lmb_mat4 *t)
{
    lmb_mat4 out = *t;
    for (int i = 0; i < 9; ++i) {
        out.m[i / 3 * 4 + i % 3] = t->m[i % 3 * 4 + i / 3];
    }
    return out;
}

/* The direction of a guessed sun is in scene space; this stores it in world space. */
int mix_keep_light(mix_kept *k, const mix_job *j, report *r)
{
    const size_t bytes = lmb_env_bytes(ENV_SIZE);
    const lmb_mat4 back = turned_back(&j->from_world);
    k->env_memory = malloc(bytes);
    if (k->env_memory == NULL || lmb_env_init(&k->env, ENV_SIZE, k->env_memory, bytes) != LMB_OK) {
        return report_fail(r, "out of memory");
    }
    turn_env(&k->env, &j->env[0], &j->from_world);
    k->has_sun = j->o.light_count == 0 && j->light_count > j->lamp_count;
    k->sun = j->sun;
    k->sun.direction = turned(&back, k->sun.direction);
    k->sun_size = j->sun_size;
    k->softens = j->softens;
    return 1;
}

static int make_env(mix_job *j, report *r)
{
    const size_t bytes = lmb_env_bytes(ENV_SIZE);
    for (int i = 0; i < 2; ++i) {
        void *memory = mix_take(j, bytes, r);
        if (memory == NULL || lmb_env_init(&j->env[i], ENV_SIZE, memory, bytes) != LMB_OK) {
            return 0;
        }
    }
    if (j->kept != NULL && j->kept->frames > 0) {
        const lmb_mat4 back = turned_back(&j->from_world);
        turn_env(&j->env[0], &j->kept->env, &back);
        return 1;
    }
    return j->o.world != NULL ? read_world(j, r)
                              : lmb_env_fold(&j->env[0], j->frame.light.pixels, j->frame.light.width,
                                             j->frame.light.height, &j->axes) == LMB_OK;
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

static lmb_light placed(const mix_job *j, const lmb_light *from)
{
    lmb_light out = *from;
    out.direction = turned(&j->from_world, from->direction);
    out.position = turned(&j->from_world, from->position);
    out.position.x += j->from_world.m[12];
    out.position.y += j->from_world.m[13];
    out.position.z += j->from_world.m[14];
    return out;
}

/* Adds a light, given in world space. Samples of the area are chosen there: relative to scene axes, which turn with the
 * camera, they would move from frame to frame. */
static void add_light(mix_job *j, const lmb_light *light, float size, int32_t samples)
{
    lmb_light *to = j->lights + j->light_count;
    const int32_t count = size > 0.0f ? samples : 1;
    *to = *light;
    if (size > 0.0f) {
        area_light(to, samples, light, size);
    }
    for (int32_t i = 0; i < count; ++i) {
        to[i] = placed(j, &to[i]);
    }
    j->light_count += count;
}

static void place_lights(mix_job *j)
{
    for (int32_t i = 0; i < j->o.light_count; ++i) {
        add_light(j, &j->o.lights[i], j->o.light_size[i], j->is_shared ? MIX_LIGHT_FEW : MIX_LIGHT_SAMPLES);
    }
}

static void add_sun(mix_job *j)
{
    const lmb_mat4 world = turned_back(&j->from_world);
    lmb_light sun = j->sun;
    sun.direction = turned(&world, sun.direction);
    add_light(j, &sun, j->sun_size, MIX_SUN_SAMPLES);
}

static int take_lights(mix_job *j, report *r)
{
    size_t count = MIX_SUN_SAMPLES;
    for (int32_t i = 0; i < j->o.light_count; ++i) {
        count += j->o.light_size[i] > 0.0f ? MIX_LIGHT_SAMPLES : 1;
    }
    count += MIX_WAYS;
    j->lights = mix_take(j, count * sizeof *j->lights, r);
    j->maps = mix_take(j, count * sizeof *j->maps, r);
    return j->lights != NULL && j->maps != NULL;
}

/* If many lights make one shadow together, half the resolution is enough. */
static int32_t map_side(const mix_job *j)
{
    return j->light_count - j->lamp_count < MIX_SUN_SAMPLES || j->o.shadow_map < 16 ? j->o.shadow_map
                                                                                    : j->o.shadow_map / 2;
}

static int draw_map(const mix_job *j, const lmb_shadow_map *map, uint32_t first_id, uint32_t count)
{
    return count == 0 || lmb_shadow_map_draw(map, j->o.kernels, &j->scene, first_id, count, NULL) == LMB_OK;
}

static size_t map_bytes(const mix_job *j, int32_t light)
{
    return 2 * lmb_shadow_map_bytes(lmb_shadow_map_faces(&j->lights[light], &j->scene), map_side(j), LMB_ID32);
}

size_t mix_maps_bytes(const mix_job *j)
{
    size_t bytes = 0;
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        bytes += map_bytes(j, i);
    }
    return bytes;
}

typedef struct maps {
    mix_job *j;
    char *memory; /* of all maps */
    int failed[POOL_MAX]; /* by thread */
} maps;

static void draw_two(void *user, int i, int thread)
{
    maps *m = user;
    mix_job *j = m->j;
    const size_t bytes = map_bytes(j, i);
    const uint32_t real = j->real_triangles;
    char *memory = m->memory;
    for (int32_t k = 0; k < i; ++k) {
        memory += map_bytes(j, k);
    }
    int ok = lmb_two_maps(j->maps[i], &j->lights[i], &j->scene, map_side(j), memory, bytes) == LMB_OK &&
             lmb_shadow_map_clear(&j->maps[i][0]) == LMB_OK && draw_map(j, &j->maps[i][0], 1, real);
    memcpy(memory + bytes / 2, memory, bytes / 2); /* the other map: both contain the real surfaces */
    ok = ok && draw_map(j, &j->maps[i][1], real + 1, j->object_triangles);
    m->failed[thread] |= !ok;
}

static int draw_maps(mix_job *j, report *r)
{
    maps m = {j, NULL, {0}};
    m.memory = mix_take(j, mix_maps_bytes(j), r);
    if (m.memory == NULL) {
        return 0;
    }
    pool_run(pool_threads(j->o.threads), j->light_count, draw_two, &m);
    for (int i = 0; i < POOL_MAX; ++i) {
        if (m.failed[i]) {
            return report_fail(r, "--light: a shadow map cannot be drawn");
        }
    }
    return 1;
}

static int check_lights(mix_job *j, report *r)
{
    j->scene.lights = j->lights;
    j->scene.light_count = (uint32_t)j->light_count;
    return lmb_scene_check(&j->scene) == LMB_OK || report_fail(r, "--light: numbers are out of range");
}

/* Adds the object's own lights: emitted light, and given light that it reflects. */
static int add_own(mix_job *j, report *r)
{
    const int32_t told = j->light_count, own = mix_sources_find(j->lights + told, j, r);
    if (own < 0) {
        return 0;
    }
    j->lamp_count = own;
    j->light_count += own;
    return check_lights(j, r);
}

/* Is the environment folded from the photo? In a sequence only from the first one. */
static int is_folded(const mix_job *j) { return j->o.world == NULL && (j->kept == NULL || j->kept->frames == 0); }

static int has_lamps(const mix_job *j)
{
    int has_sun = 0;
    for (int32_t i = 0; i < j->o.light_count; ++i) {
        has_sun |= j->o.lights[i].kind == LMB_LIGHT_DIRECTIONAL;
    }
    return j->o.light_count > 0 && !has_sun;
}

int mix_light(mix_job *j, report *r)
{
    if (!make_env(j, r) || !take_lights(j, r)) {
        return 0;
    }
    if (j->o.light_count > 0) {
        place_lights(j);
    } else if ((j->object_triangles > 0 || j->is_shared) && !j->o.no_light) {
        j->sun_size = mix_guess_sun(&j->sun, &j->softens, j);
        if (j->sun_size < 0.0f) {
            return report_fail(r, "out of memory");
        }
        add_sun(j);
    }
    return check_lights(j, r) && draw_maps(j, r) && add_own(j, r) &&
           (!is_folded(j) || !has_lamps(j) || mix_around(j, r));
}
