/* draw_light.c: light at vertices by the formula of OpenGL 1.x. Layer 4.
 *
 * All in binary32, in one order, with powers from the library's own log2 and exp2: the same codes on every target. */
#include "draw_part.h"

#include <string.h>

#include "../base/poly.h"

#if LMB_DRAW && !LMB_DRAW_SMALL
/* A vertex in eye space. */
typedef struct light_place {
    lmb_vec3 at, normal, to_eye;
} light_place;

/* Light of one lamp at a vertex. */
typedef struct light_ray {
    lmb_vec3 to;    /* to the lamp, unit */
    float strength; /* attenuation by distance and cone */
} light_ray;

static float light_power(float base, float exponent)
{
    if (exponent == 0.0f) {
        return 1.0f;
    }
    return base > 0.0f ? lmb_exp2(exponent * lmb_log2(base)) : 0.0f;
}

static lmb_vec3 light_vec(const float v[3]) { return vec3(v[0], v[1], v[2]); }

static light_ray light_ray_to(const lmb_draw_lamp *lamp, lmb_vec3 at)
{
    light_ray ray = {normalize3(light_vec(lamp->position)), 1.0f};
    if (lamp->position[3] != 0.0f) {
        const lmb_vec3 way = sub3(mul3(light_vec(lamp->position), 1.0f / lamp->position[3]), at);
        const float d = length3(way), *k = lamp->attenuation;
        ray.to = normalize3(way);
        ray.strength = 1.0f / maxf(k[0] + k[1] * d + k[2] * (d * d), 1e-20f);
    }
    if (lamp->spot_cos > -1.0f) {
        const float cosine = -dot3(ray.to, normalize3(light_vec(lamp->spot_direction)));
        ray.strength *= cosine >= lamp->spot_cos ? light_power(maxf(cosine, 0.0f), lamp->spot_exponent) : 0.0f;
    }
    return ray;
}

/* Adds one light: diffuse part and highlights. */
static void light_add(float matt[3], float highlight[3], const lmb_draw_lamp *lamp, const lmb_draw_material *m,
                      const light_place *p)
{
    const light_ray ray = light_ray_to(lamp, p->at);
    const float facing = maxf(dot3(p->normal, ray.to), 0.0f);
    const float power =
        facing > 0.0f ? light_power(dot3(p->normal, normalize3(add3(ray.to, p->to_eye))), m->shininess) : 0.0f;
    for (int c = 0; c < 3; ++c) {
        matt[c] += ray.strength * (lamp->ambient[c] * m->ambient[c] + facing * (lamp->diffuse[c] * m->diffuse[c]));
        highlight[c] += ray.strength * (power * (lamp->specular[c] * m->specular[c]));
    }
}

static uint8_t light_code(float v) { return (uint8_t)(minf(maxf(v, 0.0f), 1.0f) * 255.0f + 0.5f); }

static void light_corner_side(uint8_t *colour, uint8_t *second, const lmb_draw_lighting *how,
                              const lmb_draw_material *m, const light_place *p)
{
    float matt[3], highlight[3] = {0.0f, 0.0f, 0.0f};
    for (int c = 0; c < 3; ++c) {
        matt[c] = m->emission[c] + m->ambient[c] * how->ambient[c];
    }
    for (uint32_t i = 0; i < how->count; ++i) {
        light_add(matt, highlight, &how->lamps[i], m, p);
    }
    for (int c = 0; c < 3; ++c) {
        colour[c] = light_code(second != NULL ? matt[c] : matt[c] + highlight[c]);
    }
    colour[3] = light_code(m->diffuse[3]);
    if (second != NULL) {
        second[0] = light_code(highlight[0]);
        second[1] = light_code(highlight[1]);
        second[2] = light_code(highlight[2]);
        second[3] = 0;
    }
}

/* Sets a side's material from the vertex colour. */
static void light_track(lmb_draw_material *inout, uint32_t tracks, const uint8_t colour[4])
{
    for (int c = 0; c < 3; ++c) {
        const float v = (float)colour[c] * (1.0f / 255.0f);
        inout->emission[c] = (tracks & LMB_DRAW_TRACK_EMISSION) != 0 ? v : inout->emission[c];
        inout->ambient[c] = (tracks & LMB_DRAW_TRACK_AMBIENT) != 0 ? v : inout->ambient[c];
        inout->diffuse[c] = (tracks & LMB_DRAW_TRACK_DIFFUSE) != 0 ? v : inout->diffuse[c];
        inout->specular[c] = (tracks & LMB_DRAW_TRACK_SPECULAR) != 0 ? v : inout->specular[c];
    }
    if ((tracks & LMB_DRAW_TRACK_DIFFUSE) != 0) {
        inout->diffuse[3] = (float)colour[3] * (1.0f / 255.0f);
    }
}

/* Columns of the inverse transpose of a matrix's upper left 3 x 3. */
typedef struct light_turn {
    lmb_vec3 x, y, z;
} light_turn;

static light_turn light_turn_of(const lmb_mat4 *t)
{
    const float *m = t->m;
    const lmb_vec3 x = vec3(m[0], m[1], m[2]), y = vec3(m[4], m[5], m[6]), z = vec3(m[8], m[9], m[10]);
    light_turn turn = {cross3(y, z), cross3(z, x), cross3(x, y)};
    const float volume = dot3(x, turn.x);
    const float by = absf(volume) > 1e-30f ? 1.0f / volume : 1.0f;
    turn.x = mul3(turn.x, by);
    turn.y = mul3(turn.y, by);
    turn.z = mul3(turn.z, by);
    return turn;
}

static light_place light_place_of(const lmb_draw_lighting *how, const light_turn *turn, const lmb_draw_vertices *v,
                                  const float *normals, uint32_t i)
{
    light_place p = {transform_point(&how->to_eye, lmb_draw_position(v, i)), {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}};
    if (normals != NULL) {
        const float *n = normals + 3 * (size_t)i;
        p.normal = add3(add3(mul3(turn->x, n[0]), mul3(turn->y, n[1])), mul3(turn->z, n[2]));
    }
    p.normal = how->is_raw != 0 ? p.normal : normalize3(p.normal);
    p.to_eye = how->is_local != 0 ? normalize3(mul3(p.at, -1.0f)) : p.to_eye;
    return p;
}

/* --- checks ------------------------------------------------------------------------------------------------------- */

static int light_are_finite(const float *v, int n)
{
    int good = 1;
    for (int i = 0; i < n; ++i) {
        good &= v[i] > -1e15f && v[i] < 1e15f;
    }
    return good;
}

static int light_is_lamp(const lmb_draw_lamp *l)
{
    const float *k = l->attenuation;
    return light_are_finite(l->position, 4) && light_are_finite(l->ambient, 3) && light_are_finite(l->diffuse, 3) &&
           light_are_finite(l->specular, 3) && light_are_finite(l->spot_direction, 3) && l->spot_exponent >= 0.0f &&
           l->spot_exponent <= 128.0f && l->spot_cos >= -1.0f && l->spot_cos <= 1.0f && light_are_finite(k, 3) &&
           k[0] >= 0.0f && k[1] >= 0.0f && k[2] >= 0.0f;
}

static int light_is_material(const lmb_draw_material *m)
{
    return light_are_finite(m->emission, 3) && light_are_finite(m->ambient, 3) && light_are_finite(m->diffuse, 4) &&
           light_are_finite(m->specular, 3) && m->shininess >= 0.0f && m->shininess <= 128.0f;
}

static lmb_status light_check(const lmb_draw_lit *out, const lmb_draw_lighting *how, const lmb_draw_vertices *v,
                              const float *normals)
{
    if (out == NULL || out->colours == NULL || how == NULL || v == NULL || how->count > LMB_DRAW_LAMPS ||
        (how->lamps == NULL && how->count > 0) || (out->back_seconds != NULL && out->back_colours == NULL) ||
        how->tracks > 15 || !light_is_material(&how->material[0]) || !light_is_material(&how->material[1]) ||
        !light_are_finite(how->ambient, 3) || !light_are_finite(how->to_eye.m, 16)) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = 0; i < how->count; ++i) {
        if (!light_is_lamp(&how->lamps[i])) {
            return LMB_ERR_ARG;
        }
    }
    const lmb_status status = lmb_draw_check_vertices(v);
    return status == LMB_OK && (uintptr_t)normals % sizeof *normals != 0 ? LMB_ERR_ALIGN : status;
}

lmb_status lmb_draw_light(const lmb_draw_lit *out, const lmb_draw_lighting *how, const lmb_draw_vertices *v,
                          const float *normals)
{
    static const uint8_t white[4] = {255, 255, 255, 255};
    const lmb_status status = light_check(out, how, v, normals);
    if (status != LMB_OK) {
        return status;
    }
    const light_turn turn = light_turn_of(&how->to_eye);
    for (uint32_t i = 0; i < v->count; ++i) {
        const size_t at = 4 * (size_t)i;
        uint8_t own[4];
        light_place p = light_place_of(how, &turn, v, normals, i);
        memcpy(own, v->colours != NULL ? v->colours + at : white, sizeof own);
        for (int back = 0; back < (out->back_colours != NULL ? 2 : 1); ++back) {
            uint8_t *colours = back ? out->back_colours : out->colours;
            uint8_t *seconds = back ? out->back_seconds : out->seconds;
            lmb_draw_material material = how->material[back];
            light_track(&material, how->tracks, own);
            light_corner_side(colours + at, seconds != NULL ? seconds + at : NULL, how, &material, &p);
            p.normal = mul3(p.normal, -1.0f);
        }
    }
    return LMB_OK;
}
#endif
