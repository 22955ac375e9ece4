/* relight_ground.c: the light that an object blocks from the ground, and the light it reflects there instead. */
#include "relight_ground.h"

#include <math.h>
#include <string.h>

#define FADE 0.2f /* of a map's half side: the width of the fade at the edges */

/* The ground's light: all of it; the part that the map shows no source of; the cosine-weighted solid angle of lights
 * that cast shadows, without peaks. */
typedef struct ground_sum {
    float all[3], unseen[3], angle;
} ground_sum;

/* Adds the loss along some runs of one light with solid angle `angle`, sr; `part` of it. */
static void darken_runs(ground_map *g, const far_light *l, float (*reflected)[3], float angle, const hidden_run *run,
                        uint32_t count, float part)
{
    for (uint32_t i = 0; i < count; ++i) {
        const float *there = reflected[run[i].region];
        float lost[3];
        for (int k = 0; k < 3; ++k) {
            lost[k] = part * l->to.y * (l->rgb[k] - there[k] * angle);
        }
        float (*left)[3] = &g->left[run[i].row * HIDDEN_SIDE];
        for (int32_t x = run[i].from; x <= run[i].to; ++x) {
            left[x][0] += lost[0];
            left[x][1] += lost[1];
            left[x][2] += lost[2];
            g->shut[run[i].row * HIDDEN_SIDE + (uint32_t)x] += part * l->to.y * angle;
        }
    }
}

/* 1, falling to 0 near the edge of a map; u and v are relative to the middle, in half sides. */
static float fade_of(float u, float v) { return fminf(fmaxf((1.0f - fmaxf(fabsf(u), fabsf(v))) / FADE, 0.0f), 1.0f); }

/* Light that the map shows no source of comes from unknown directions. It counts as blocked only if the object blocks
 * over half of the directions, which is below the object. There the direction does not matter. */
static float unseen_lost(const ground_sum *s, float shut, int k)
{
    return fminf(fmaxf(2.0f * shut / s->angle - 1.0f, 0.0f), 1.0f) * s->unseen[k];
}

/* Turns losses into shares left. The loss fades out at the edges of the map instead of ending abruptly. */
static void turn_to_left(ground_map *g, const ground_sum *s, int fades)
{
    for (int32_t i = 0; i < HIDDEN_SIDE * HIDDEN_SIDE; ++i) {
        const float u = (float)(2 * (i % HIDDEN_SIDE) + 1) / HIDDEN_SIDE - 1.0f,
                    v = (float)(2 * (i / HIDDEN_SIDE) + 1) / HIDDEN_SIDE - 1.0f;
        const float fade = fades ? fade_of(u, v) : 1.0f;
        for (int k = 0; k < 3; ++k) {
            const float lost = g->left[i][k] + unseen_lost(s, g->shut[i], k);
            g->left[i][k] = fmaxf(1.0f - fade * lost / s->all[k], 0.0f);
        }
    }
}

int ground_throw(peak_runs *p, int map, hidden *h, const far_lights *f, const relight_options *o)
{
    p->runs.count = 0;
    for (int32_t i = LMB_PROBE_TEXELS; i < f->count; ++i) {
        p->first[i - LMB_PROBE_TEXELS] = p->runs.count;
        for (int ray = 0; ray < HIDDEN_RAYS && f->light[i].to.y >= HIDDEN_LOWEST; ray += HIDDEN_RAYS - 1) { /* 0, 3 */
            if (!hidden_shadow(h, map, &p->runs, o, f->light[i].to, ray)) {
                return 0;
            }
        }
    }
    p->first[f->count - LMB_PROBE_TEXELS] = p->runs.count;
    return 1;
}

/* Takes light from above, but at least the light that the ground sends up at the same slopes, because it cannot reflect
 * more than it receives. */
static ground_sum sum_lights(const far_lights *f)
{
    ground_sum out = {.angle = 1e-30f};
    float from_above[3] = {1e-30f, 1e-30f, 1e-30f}, sent_up[3] = {0.0f, 0.0f, 0.0f};
    for (int32_t i = 0; i < f->count; ++i) {
        const far_light *l = &f->light[i];
        float *sum = l->to.y > 0.0f ? from_above : sent_up;
        for (int k = 0; k < 3 && fabsf(l->to.y) >= HIDDEN_LOWEST; ++k) {
            sum[k] += l->rgb[k] * fabsf(l->to.y);
        }
    }
    for (int32_t i = 0; i < LMB_PROBE_TEXELS && i < f->count; ++i) {
        out.angle += f->light[i].to.y >= HIDDEN_LOWEST ? f->angle[i] * f->light[i].to.y : 0.0f;
    }
    for (int k = 0; k < 3; ++k) {
        out.all[k] = fmaxf(from_above[k], sent_up[k]);
        out.unseen[k] = out.all[k] - from_above[k];
    }
    return out;
}

void ground_light(float out[3], const far_lights *f)
{
    const ground_sum sum = sum_lights(f);
    memcpy(out, sum.all, sizeof sum.all);
}

void ground_shade(ground_map *g, const hidden_map *m, const peak_runs *peaks, lmb_vec3 foot, const far_lights *f,
                  float (*reflected)[3])
{
    const ground_sum sum = sum_lights(f);
    g->x = foot.x + m->corner_x;
    g->z = foot.z + m->corner_z;
    g->per_x = (float)HIDDEN_SIDE / m->wide;
    g->per_z = (float)HIDDEN_SIDE / m->deep;
    memset(g->left, 0, sizeof g->left);
    memset(g->shut, 0, sizeof g->shut);
    for (int32_t i = 0; i < f->count; ++i) {
        const far_light *l = &f->light[i];
        const int is_peak = i >= LMB_PROBE_TEXELS;
        const uint32_t *first = is_peak ? &peaks->first[i - LMB_PROBE_TEXELS] : &m->first[i * HIDDEN_RAYS];
        const hidden_run *run = is_peak ? peaks->runs.run : m->runs.run;
        if (l->to.y < HIDDEN_LOWEST) {
            continue;
        }
        darken_runs(g, l, reflected, is_peak ? 0.0f : f->angle[i], run + first[0],
                    first[is_peak ? 1 : HIDDEN_RAYS] - first[0], is_peak || !m->fades ? 0.5f : 1.0f / HIDDEN_RAYS);
    }
    turn_to_left(g, &sum, m->fades);
}

/* Returns 0 outside the map. */
static int look_at(float out[3], float *fade, const ground_map *g, float x, float z)
{
    const float u = (x - g->x) * g->per_x - 0.5f, v = (z - g->z) * g->per_z - 0.5f;
    if (!(u >= 0.0f && v >= 0.0f && u < (float)(HIDDEN_SIDE - 1) && v < (float)(HIDDEN_SIDE - 1))) {
        return 0;
    }
    const int32_t ix = (int32_t)u, iz = (int32_t)v;
    const float fx = u - (float)ix, fz = v - (float)iz;
    const float (*p)[3] = &g->left[iz * HIDDEN_SIDE + ix];
    for (int k = 0; k < 3; ++k) {
        const float near = p[0][k] + fx * (p[1][k] - p[0][k]),
                    far = p[HIDDEN_SIDE][k] + fx * (p[HIDDEN_SIDE + 1][k] - p[HIDDEN_SIDE][k]);
        out[k] = near + fz * (far - near);
    }
    *fade = fade_of((2.0f * u + 1.0f) / HIDDEN_SIDE - 1.0f, (2.0f * v + 1.0f) / HIDDEN_SIDE - 1.0f);
    return 1;
}

void ground_left(float inout[3], const contact_ground *g, int maps, float x, float z)
{
    float wide[3], near[3], fade;
    if (!look_at(wide, &fade, &g->map[0], x, z)) {
        return;
    }
    const int is_near = maps > 1 && look_at(near, &fade, &g->map[1], x, z);
    for (int k = 0; k < 3; ++k) {
        inout[k] *= is_near ? wide[k] + fade * (near[k] - wide[k]) : wide[k];
    }
}
