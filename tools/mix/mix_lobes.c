/* mix_lobes.c: objects that reflect as metals do, by a narrow cone along the mirror direction in the field with them;
 * and objects that emit light, by lights at their surface. [M20 M25] */
#include "mix_lobes.h"

#include "mix_world.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265f
#define MATT 0.08f /* reflectance of what is no metal, at most */

/* --- metals ------------------------------------------------------------------------------------------------------- */

/* Of what is no metal the weak lobe stays out, as in `render` without --glossy: mix has one way to draw it. */
void mix_lobes_read(mix_job *j)
{
    lmb_material *m = (lmb_material *)(uintptr_t)j->object.scene.materials;
    (void)model_make_glossy(&j->object);
    for (uint32_t i = 0; i < j->object.scene.material_count; ++i) {
        if (m[i].metal_map == 0 && fmaxf(m[i].specular[0], fmaxf(m[i].specular[1], m[i].specular[2])) <= MATT) {
            memset(m[i].specular, 0, sizeof m[i].specular);
        }
    }
}

/* A copy of the scene, whose materials may be changed; NULL without memory. */
static lmb_scene *copy_scene(lmb_material **materials, mix_job *j, report *r)
{
    lmb_scene *out = mix_take(j, sizeof *out, r);
    lmb_material *m = mix_take(j, j->scene.material_count * sizeof *m, r);
    if (out == NULL || m == NULL) {
        return NULL;
    }
    *out = j->scene;
    memcpy(m, j->scene.materials, j->scene.material_count * sizeof *m);
    out->materials = *materials = m;
    return out;
}

int mix_lobes_bounces(mix_job *j, report *r)
{
    lmb_material *m;
    lmb_scene *scene;
    j->bounces = &j->scene;
    if (!lmb_scene_is_glossy(&j->scene)) {
        return 1;
    }
    scene = copy_scene(&m, j, r);
    for (uint32_t i = 0; scene != NULL && i < scene->material_count; ++i) {
        for (int c = 0; c < 3; ++c) {
            m[i].albedo[c] = fminf(m[i].albedo[c] + m[i].specular[c], 1.0f);
        }
    }
    j->bounces = scene != NULL ? scene : j->bounces;
    return scene != NULL;
}

void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object)
{
    const int is_glossy = lmb_glossy_tile(&out->lobes, object, view, &j->scene);
    for (int32_t i = 0; i < j->light_count; ++i) {
        if (!is_glossy) {
            lmb_direct_tile(inout, j->o.kernels, object, view, &j->scene, &j->lights[i], &j->maps[i][1]);
            continue;
        }
        memset(&out->one, 0, sizeof out->one);
        lmb_direct_tile(&out->one, j->o.kernels, object, view, &j->scene, &j->lights[i], &j->maps[i][1]);
        lmb_glossy_direct(&out->lobes, j->o.kernels, object, &out->one, &j->lights[i]);
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            inout->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] += out->one.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
        }
    }
}

/* Of what comes from everywhere the lobe of pixel k reflects so much: lmb_compose_glossy takes as much from the rest. */
static float reflected(const lmb_glossy *lobes, int c, int k)
{
    const float low = fmaxf(1.0f - lobes->facing[k], 0.0f), smooth = fmaxf(1.0f - sqrtf(sqrtf(lobes->alpha2[k])), 0.0f),
                f0 = lobes->specular[c][k];
    return fminf(f0 + (1.0f - f0) * low * low * low * low * low * smooth * smooth * smooth, 1.0f);
}

/* The lobes of one roughness after the other, of those in `left`: most tiles have one. */
static uint64_t see_one(mix_lobes *s, const mix_job *j, const lmb_view *view, const lmb_tile *object, uint64_t left)
{
    const lmb_cone_trace trace = mix_trace(j, LMB_VOXEL_WITH);
    lmb_tile room;
    int first = 0;
    while ((left >> first & 1u) == 0) {
        ++first;
    }
    const float alpha2 = s->lobes.alpha2[first];
    if (lmb_cone_width_init(&s->width, trace.voxels, lmb_cone_tangent(sqrtf(sqrtf(alpha2)))) != LMB_OK ||
        lmb_cones_glossy(&s->seen, &trace, &s->width, mix_tile_there(&room, j, object),
                         mix_point_there(j, view->eye)) != LMB_OK) {
        return 0;
    }
    for (int k = first; k < LMB_TILE_PIXELS; ++k) {
        if ((left >> k & 1u) != 0 && fabsf(s->lobes.alpha2[k] - alpha2) <= 0.25f * alpha2) {
            for (int c = 0; c < 3; ++c) {
                s->lobes.rgb[c][k] += reflected(&s->lobes, c, k) * s->seen.rgb[c][k];
            }
            left &= ~((uint64_t)1 << k);
        }
    }
    return left;
}

void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view, const lmb_tile *object)
{
    for (uint64_t left = s->lobes.pixels; left != 0;) {
        left = see_one(s, j, view, object, left);
    }
    if (s->lobes.pixels != 0) {
        lmb_compose_glossy(inout, &s->lobes);
    }
    if (lmb_scene_emits(&j->scene)) {
        lmb_compose_emission(inout, &j->scene, view, object);
    }
}

/* --- lamps -------------------------------------------------------------------------------------------------------- */

/* First points of what emits, as if it reflected a light of pi W/m2 everywhere: their flux over `*peak` is what it
 * emits. */
static lmb_texel *emitted(size_t *count, float *peak, mix_job *j, report *r)
{
    enum { SIDE = 8, PARTS = 24 };
    lmb_material *m;
    lmb_env white;
    lmb_vec3 low, high;
    mix_object_box(&low, &high, j);
    const float size = fmaxf(fmaxf(high.x - low.x, high.y - low.y), high.z - low.z), one[3] = {1, 1, 1};
    const size_t bytes = lmb_env_bytes(SIDE);
    void *memory = mix_take(j, bytes, r);
    lmb_scene *scene = copy_scene(&m, j, r);
    if (memory == NULL || scene == NULL || lmb_env_init(&white, SIDE, memory, bytes) != LMB_OK) {
        return NULL;
    }
    for (int32_t i = 0; i < 6 * SIDE * SIDE; ++i) {
        lmb_env_set(&white, i / (SIDE * SIDE), i % SIDE, i / SIDE % SIDE, one);
    }
    lmb_env_mips(&white);
    *peak = 0.0f;
    for (uint32_t i = 0; i < 3 * scene->material_count; ++i) {
        *peak = fmaxf(*peak, m[i / 3].emission[i % 3]);
    }
    for (uint32_t i = 0; i < scene->material_count; ++i) {
        for (int c = 0; c < 3; ++c) {
            m[i].albedo[c] = m[i].emission[c] / *peak;
        }
        m[i].texture = (int32_t)m[i].emission_map - 1;
    }
    const float leaf = fmaxf(size / PARTS, 1e-6f);
    *count = lmb_around_points(NULL, 0, scene, j->real_triangles + 1, j->object_triangles, leaf, &white);
    lmb_texel *out = mix_take(j, *count * sizeof *out, r);
    if (out != NULL) {
        lmb_around_points(out, *count, scene, j->real_triangles + 1, j->object_triangles, leaf, &white);
    }
    return out;
}

/* Those that face about one way. */
typedef struct lamp {
    double flux[3], weight, at[3], normal[3], reach;
} lamp;

static double part(lmb_vec3 v, int i) { return (double)(i == 0 ? v.x : i == 1 ? v.y : v.z); }

static int way_of(lmb_vec3 n)
{
    const float x = fabsf(n.x), y = fabsf(n.y), z = fabsf(n.z);
    return x >= y && x >= z ? n.x < 0 : y >= z ? 2 + (n.y < 0) : 4 + (n.z < 0);
}

static void add_emitted(lamp *l, const lmb_texel *t)
{
    const double weight = (double)(t->flux[0] + t->flux[1] + t->flux[2]);
    l->weight += weight;
    for (int i = 0; i < 3; ++i) {
        l->flux[i] += (double)t->flux[i];
        l->at[i] += weight * part(t->position, i);
        l->normal[i] += weight * part(t->normal, i);
    }
}

/* How far the surface reaches beyond the middle of what emits, along its normal. */
static void add_reach(lamp *l, const lmb_texel *t)
{
    double out = 0.0;
    for (int i = 0; i < 3; ++i) {
        out += (part(t->position, i) - l->at[i]) * l->normal[i];
    }
    l->reach = fmax(l->reach, out);
}

static void finish_lamp(lamp *l)
{
    const double length = sqrt(l->normal[0] * l->normal[0] + l->normal[1] * l->normal[1] + l->normal[2] * l->normal[2]);
    for (int i = 0; i < 3; ++i) {
        l->at[i] /= l->weight;
        l->normal[i] /= fmax(length, 1e-30);
    }
}

/* A spot's fall-off over a half sphere is within a tenth of the cosine's, and sends as much in all. */
static void set_light(lmb_light *out, const lamp *l, float peak)
{
    const double lift = l->reach + 1e-4;
    memset(out, 0, sizeof *out);
    out->kind = LMB_LIGHT_SPOT;
    out->position = (lmb_vec3){(float)(l->at[0] + lift * l->normal[0]), (float)(l->at[1] + lift * l->normal[1]),
                               (float)(l->at[2] + lift * l->normal[2])};
    out->direction = (lmb_vec3){(float)l->normal[0], (float)l->normal[1], (float)l->normal[2]};
    out->cos_inner = 0.9999f;
    out->cos_outer = 0.01f;
    for (int c = 0; c < 3; ++c) {
        out->intensity[c] = (float)l->flux[c] * peak / PI;
    }
}

int32_t mix_lobes_lamps(lmb_light out[MIX_LAMPS], mix_job *j, report *r)
{
    lamp all[MIX_LAMPS];
    size_t count = 0;
    float peak = 0.0f;
    int32_t n = 0;
    if (j->object_triangles == 0 || !lmb_scene_emits(&j->scene)) {
        return 0;
    }
    const lmb_texel *t = emitted(&count, &peak, j, r);
    memset(all, 0, sizeof all);
    for (size_t i = 0; t != NULL && i < count; ++i) {
        add_emitted(&all[way_of(t[i].normal)], &t[i]);
    }
    for (int i = 0; i < MIX_LAMPS; ++i) {
        finish_lamp(&all[i]);
    }
    for (size_t i = 0; t != NULL && i < count; ++i) {
        if (t[i].flux[0] + t[i].flux[1] + t[i].flux[2] > 0.0f) {
            add_reach(&all[way_of(t[i].normal)], &t[i]);
        }
    }
    for (int i = 0; i < MIX_LAMPS; ++i) {
        if (all[i].weight > 0.0) {
            set_light(&out[n++], &all[i], peak);
        }
    }
    return t != NULL ? n : -1;
}
