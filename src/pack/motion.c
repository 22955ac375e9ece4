/* motion.c: where a .lmp's animations put things at a time: keys, what lies between them, the way to the world. Layer 2. */
#include "motion.h"

#include <string.h>

#include "../base/poly.h"
#include "../base/vec.h"
#include "records.h"

#if LMB_PACK

enum { TRANSLATION, ROTATION, SCALE };
enum { STEP, LINEAR, CUBIC };
enum { N_TRANSLATION = 4, N_ROTATION = 7, N_SCALE = 11 }; /* words of a node's record */

#define STRAIGHT 0.9995f /* cosine of half the turn over which it is as good as a straight line */

/* --- between keys ------------------------------------------------------------------------------------------------- */

/* A track as its record has it. */
typedef struct track {
    const uint32_t *time, *value;
    uint32_t keys;
    int size, between;
} track;

static track track_at(const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_TRACKS, i);
    track t;
    t.time = p->data + w[2] / 4;
    t.value = p->data + w[3] / 4;
    t.keys = w[1];
    t.size = (w[0] & 255u) == ROTATION ? 4 : 3;
    t.between = (int)(w[0] >> 8);
    return t;
}

static void key_at(float *out, const track *t, uint32_t key)
{
    const size_t at = t->between == CUBIC ? 3 * (size_t)key + 1 : key;
    memcpy(out, t->value + at * (size_t)t->size, (size_t)t->size * sizeof *out);
}

/* By glTF's cubic, whose tangents are by the second. */
static void cubic(float *out, const track *t, uint32_t key, float u, float span)
{
    float a[4], b[4], from[4], to[4];
    const float v = 1.0f - u;
    key_at(a, t, key);
    key_at(b, t, key + 1);
    memcpy(from, t->value + (3 * (size_t)key + 2) * (size_t)t->size, (size_t)t->size * sizeof *from);
    memcpy(to, t->value + 3 * ((size_t)key + 1) * (size_t)t->size, (size_t)t->size * sizeof *to);
    for (int i = 0; i < t->size; ++i) {
        out[i] = v * v * (1.0f + 2.0f * u) * a[i] + u * u * (1.0f + 2.0f * v) * b[i] +
                 u * v * span * (v * from[i] - u * to[i]);
    }
}

/* Straight; rotations by the shorter way round, evenly. */
static void linear(float *out, const track *t, uint32_t key, float u)
{
    float a[4], b[4], from = 1.0f - u, to = u, dot = 0.0f;
    key_at(a, t, key);
    key_at(b, t, key + 1);
    for (int i = 0; t->size == 4 && i < 4; ++i) {
        dot += a[i] * b[i];
    }
    if (t->size == 4 && absf(dot) < STRAIGHT) {
        const float angle = lmb_acos(absf(dot)), per = 1.0f / lmb_sin(angle);
        from = lmb_sin((1.0f - u) * angle) * per;
        to = lmb_sin(u * angle) * per;
    }
    to = dot < 0.0f ? -to : to;
    for (int i = 0; i < t->size; ++i) {
        out[i] = from * a[i] + to * b[i];
    }
}

static void evaluate(float *out, const track *t, float time_s)
{
    uint32_t low = 0, past = t->keys; /* the last key at or before the time is in low .. past - 1, or there is none */
    while (past - low > 1) {
        const uint32_t middle = low + (past - low) / 2;
        if (lmb_pack_float(t->time + middle) <= time_s) {
            low = middle;
        } else {
            past = middle;
        }
    }
    const float begin = lmb_pack_float(t->time + low);
    if (low == t->keys - 1 || !(time_s > begin) || t->between == STEP) {
        key_at(out, t, low);
        return;
    }
    const float span = lmb_pack_float(t->time + low + 1) - begin, u = (time_s - begin) / span;
    if (t->between == CUBIC) {
        cubic(out, t, low, u, span);
    } else {
        linear(out, t, low, u);
    }
}

/* --- nodes -------------------------------------------------------------------------------------------------------- */

/* 0 where the rotation has no length. */
static int compose(lmb_mat4 *out, const float t[3], const float q[4], const float s[3])
{
    const float d = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(d > 1e-12f)) {
        return 0;
    }
    const float x = q[0] / d, y = q[1] / d, z = q[2] / d, w = q[3] / d;
    const float turn[9] = {1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y + z * w),        2.0f * (x * z - y * w),
                           2.0f * (x * y - z * w),        1.0f - 2.0f * (x * x + z * z), 2.0f * (y * z + x * w),
                           2.0f * (x * z + y * w),        2.0f * (y * z - x * w),        1.0f - 2.0f * (x * x + y * y)};
    for (int c = 0; c < 4; ++c) {
        for (int k = 0; k < 3; ++k) {
            out->m[4 * c + k] = c == 3 ? t[k] : turn[3 * c + k] * s[c];
        }
        out->m[4 * c + 3] = c == 3 ? 1.0f : 0.0f;
    }
    return 1;
}

/* A node's way to its parent. */
static int local(lmb_mat4 *out, const lmb_pack *p, const uint32_t *node, float time_s)
{
    float v[3][4]; /* translation, rotation, scale */
    if (node[3] == 1) {
        lmb_pack_take_matrix(out, node + 4);
        return 1;
    }
    memcpy(v[TRANSLATION], node + N_TRANSLATION, 3 * sizeof(float));
    memcpy(v[ROTATION], node + N_ROTATION, 4 * sizeof(float));
    memcpy(v[SCALE], node + N_SCALE, 3 * sizeof(float));
    for (uint32_t i = node[1]; i < node[1] + node[2]; ++i) {
        const track t = track_at(p, i);
        evaluate(v[lmb_pack_record(p, LMB_PACK_TRACKS, i)[0] & 255u], &t, time_s);
    }
    return compose(out, v[TRANSLATION], v[ROTATION], v[SCALE]);
}

/* inout = a * inout. */
static void put_above(lmb_mat4 *inout, const lmb_mat4 *a)
{
    const lmb_mat4 b = *inout;
    for (int c = 0; c < 4; ++c) {
        for (int k = 0; k < 3; ++k) {
            inout->m[4 * c + k] = a->m[k] * b.m[4 * c] + a->m[4 + k] * b.m[4 * c + 1] + a->m[8 + k] * b.m[4 * c + 2] +
                                  (c == 3 ? a->m[12 + k] : 0.0f);
        }
    }
}

/* A node's way to the world: 0 where that leads nowhere. */
static int world_of(lmb_mat4 *out, const lmb_pack *p, uint32_t node, float time_s)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_NODES, node);
    int all = local(out, p, w, time_s);
    for (uint32_t n = w[0]; all && n != LMB_PACK_NONE; n = w[0]) {
        lmb_mat4 above;
        w = lmb_pack_record(p, LMB_PACK_NODES, n);
        all = local(&above, p, w, time_s);
        if (all) {
            put_above(out, &above);
        }
    }
    for (int i = 0; all && i < 16; ++i) {
        all = absf(out->m[i]) <= FLT_MAX;
    }
    return all;
}

/* --- what they move ----------------------------------------------------------------------------------------------- */

static lmb_vec3 column(const lmb_mat4 *m, int c) { return vec3(m->m[4 * c], m->m[4 * c + 1], m->m[4 * c + 2]); }

/* To unit length; 0 where it has none. */
static int to_unit(lmb_vec3 *v)
{
    const float longest = largest3(*v);
    if (!(longest > 1e-30f && longest < 1e30f)) {
        return 0;
    }
    *v = normalize3(mul3(*v, 1.0f / longest));
    return 1;
}

uint32_t lmb_pack_node_of(const lmb_pack *p, int kind, uint32_t i)
{
    const int word = kind == LMB_PACK_INSTANCES ? PACK_INSTANCE_NODE
                     : kind == LMB_PACK_LIGHTS  ? PACK_LIGHT_NODE
                                                : PACK_CAMERA_NODE;
    return lmb_pack_record(p, kind, i)[word];
}

int lmb_pack_place_instance(lmb_instance *inout, const lmb_pack *p, uint32_t i, float time_s)
{
    const uint32_t node = lmb_pack_node_of(p, LMB_PACK_INSTANCES, i);
    return node == LMB_PACK_NONE || world_of(&inout->to_world, p, node, time_s);
}

/* It points along the node's -Z; a point light has no use for a direction. */
int lmb_pack_place_light(lmb_light *inout, const lmb_pack *p, uint32_t i, float time_s)
{
    const uint32_t node = lmb_pack_node_of(p, LMB_PACK_LIGHTS, i);
    lmb_mat4 world;
    if (node == LMB_PACK_NONE) {
        return 1;
    }
    if (!world_of(&world, p, node, time_s)) {
        return 0;
    }
    lmb_vec3 way = sub3(vec3(0.0f, 0.0f, 0.0f), column(&world, 2));
    if (to_unit(&way)) {
        inout->direction = way;
    } else if (inout->kind != LMB_LIGHT_POINT) {
        return 0;
    }
    inout->position = column(&world, 3);
    return 1;
}

/* Back along the node's Z, up as near its Y as that allows; scale and mirroring drop out. */
int lmb_pack_place_camera(lmb_view *inout, const lmb_pack *p, uint32_t i, float time_s)
{
    const uint32_t node = lmb_pack_node_of(p, LMB_PACK_CAMERAS, i);
    lmb_mat4 world;
    if (node == LMB_PACK_NONE) {
        return 1;
    }
    if (!world_of(&world, p, node, time_s)) {
        return 0;
    }
    lmb_vec3 back = column(&world, 2), up = column(&world, 1);
    if (!to_unit(&back) || !to_unit(&up)) {
        return 0;
    }
    lmb_vec3 right = cross3(up, back);
    if (!to_unit(&right)) {
        return 0;
    }
    inout->eye = column(&world, 3);
    inout->back = back;
    inout->right = right;
    inout->up = normalize3(cross3(back, right));
    return 1;
}

#endif
