/* mix_lights.c: direct light on real surfaces, without and with the object. */
#include "mix_lights.h"

#include <math.h>
#include <string.h>

#include "mix_sources.h"

enum { FEW = 4 };

typedef struct sphere {
    lmb_vec3 at;
    float radius;
} sphere;

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 less(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 out = {a.x - b.x, a.y - b.y, a.z - b.z};
    return out;
}

void mix_lights_begin(mix_job *j) { mix_object_box(&j->box_low, &j->box_high, j); }

/* Bounding sphere of the tile's surface points; radius under 0: there are none. */
static sphere sphere_of(const lmb_tile *t)
{
    sphere s = {{0, 0, 0}, -1.0f};
    float n = 0.0f, far = -1.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (t->id[k] != 0) {
            s.at = (lmb_vec3){s.at.x + t->position[0][k], s.at.y + t->position[1][k], s.at.z + t->position[2][k]};
            n += 1.0f;
        }
    }
    s.at = (lmb_vec3){s.at.x / fmaxf(n, 1.0f), s.at.y / fmaxf(n, 1.0f), s.at.z / fmaxf(n, 1.0f)};
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 p = {t->position[0][k], t->position[1][k], t->position[2][k]}, off = less(p, s.at);
        far = t->id[k] != 0 ? fmaxf(far, dot(off, off)) : far;
    }
    s.radius = n > 0.0f ? sqrtf(far) : -1.0f;
    return s;
}

/* Clips the range *first .. *last of t to the part of the ray `from + t way` that lies between low and high on one
 * axis. */
static void cut(float *first, float *last, float from, float way, float low, float high)
{
    const float a = (low - from) / way, b = (high - from) / way;
    if (fabsf(way) > 1e-20f) {
        *first = fmaxf(*first, fminf(a, b));
        *last = fminf(*last, fmaxf(a, b));
    } else if (from < low || from > high) {
        *last = -1.0f;
    }
}

/* Can the object lie between any point of a sphere and a light? All rays to the light pass within the sphere's radius
 * of the ray from its centre, so they can only hit the object's box enlarged by the radius and by some shadow map
 * texels. */
static int may_shadow(const mix_job *j, const sphere *s, int32_t light)
{
    const lmb_light *l = &j->lights[light];
    const lmb_shadow_map *map = &j->maps[light][1];
    const int is_sun = l->kind == LMB_LIGHT_DIRECTIONAL;
    const lmb_vec3 zero = {0, 0, 0}, low = j->box_low, high = j->box_high,
                   middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)},
                   from_light = less(middle, l->position), side = less(high, low),
                   way = is_sun ? less(zero, l->direction) : less(l->position, s->at);
    const float away = is_sun ? 1.0f : sqrtf(dot(from_light, from_light)) + 0.5f * sqrtf(dot(side, side)),
                half = fmaxf(map->view[0].half_width, map->view[0].half_height),
                texel = 2.0f * half / (float)map->size * away, wide = s->radius + 4.0f * texel;
    float first = 0.0f, last = is_sun ? INFINITY : 1.0f;
    cut(&first, &last, s->at.x, way.x, low.x - wide, high.x + wide);
    cut(&first, &last, s->at.y, way.y, low.y - wide, high.y + wide);
    cut(&first, &last, s->at.z, way.z, low.z - wide, high.z + wide);
    return first <= last;
}

static void add(lmb_irradiance *inout, const lmb_irradiance *one, float times)
{
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        inout->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] +=
            times * one->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
    }
}

static uint64_t pixels_of(const lmb_tile *t)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out |= (uint64_t)(t->id[k] != 0) << k;
    }
    return out;
}

/* Evaluates each `step`th light at the pixels with unknown `direct`. */
static void ask_direct(mix_direct *direct, const mix_job *j, const lmb_view *view, const lmb_tile *real, int32_t told,
                       int32_t step)
{
    const uint64_t all = pixels_of(real), wanted = all & ~direct->known;
    lmb_tile some = *real;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        some.id[k] = wanted >> k & 1 ? real->id[k] : 0;
        for (int c = 0; c < 3 && (direct->known >> k & 1) == 0; ++c) {
            direct->light.rgb[c][k] = 0.0f;
        }
    }
    for (int32_t i = 0; i < told && wanted != 0; i += step) {
        lmb_irradiance one;
        memset(&one, 0, sizeof one);
        lmb_direct_tile(&one, j->o.kernels, &some, view, &j->scene, &j->lights[i], &j->maps[i][0]);
        add(&direct->light, &one, (float)step);
    }
    direct->known |= all;
}

/* Evaluates all lights without the object, and also with it if the shadow may fall on the tile. */
static void ask_both(lmb_irradiance *with, mix_direct *direct, const mix_job *j, const lmb_view *view,
                     const lmb_tile *real, const sphere *s, int32_t told)
{
    memset(direct, 0, sizeof *direct);
    for (int32_t i = 0; i < told; ++i) {
        const int both = may_shadow(j, s, i);
        for (int k = 0; k < 1 + both; ++k) {
            lmb_irradiance one;
            memset(&one, 0, sizeof one);
            lmb_direct_tile(&one, j->o.kernels, real, view, &j->scene, &j->lights[i], &j->maps[i][k]);
            if (k == 0) {
                add(&direct->light, &one, 1.0f);
            }
            if (k == both) {
                add(with, &one, 1.0f);
            }
        }
    }
    direct->known = pixels_of(real);
}

void mix_lights_tile(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                     const lmb_view *view, const lmb_tile *real)
{
    const sphere s = sphere_of(real);
    const int32_t told = j->light_count - j->lamp_count;
    int falls = 0;
    for (int32_t i = 0; !falls && i < told; ++i) {
        falls = may_shadow(j, &s, i);
    }
    if (!(s.radius >= 0.0f) || (!falls && j->lamp_count == 0 && memcmp(without, with, sizeof *with) == 0)) {
        return;
    }
    if (falls) {
        ask_both(with, direct, j, view, real, &s, told);
    } else {
        ask_direct(direct, j, view, real, told, mix_lights_step(j, FEW));
        add(with, &direct->light, 1.0f);
    }
    add(without, &direct->light, 1.0f);
    for (int32_t i = told; i < j->light_count; ++i) {
        mix_sources_tile(with, j, real, i, 1);
    }
}
