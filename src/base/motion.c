/* motion.c: transforms of a .lmp's animations at a time: keys, interpolation, the path to the world. Layer 1. */
#include "motion.h"

#include <string.h>

#include "poly.h"
#include "vec.h"
#include "records.h"

#if LMB_PACK

enum { TRANSLATION, ROTATION, SCALE };
enum { STEP, LINEAR, CUBIC };
enum { N_TRANSLATION = 4, N_ROTATION = 7, N_SCALE = 11 }; /* words of a node's record */

#define MAX_LERP_COSINE 0.9995f /* cosine of half the rotation; above it, linear interpolation is as good */

/* --- between keys ------------------------------------------------------------------------------------------------- */

/* A decoded track record. */
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

/* glTF's cubic spline; the tangents are per second. */
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

/* Linear interpolation; rotations take the shorter way at constant speed. */
static void linear(float *out, const track *t, uint32_t key, float u)
{
    float a[4], b[4], from = 1.0f - u, to = u, dot = 0.0f;
    key_at(a, t, key);
    key_at(b, t, key + 1);
    for (int i = 0; t->size == 4 && i < 4; ++i) {
        dot += a[i] * b[i];
    }
    if (t->size == 4 && absf(dot) < MAX_LERP_COSINE) {
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
    uint32_t low = 0, past = t->keys; /* the last key at or before the time is in low .. past - 1, if there is one */
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

/* Returns 0 if the rotation has no length. */
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

static lmb_vec3 column(const lmb_mat4 *m, int c) { return vec3(m->m[4 * c], m->m[4 * c + 1], m->m[4 * c + 2]); }

/* Normalizes; returns 0 if the vector has no length. */
static int to_unit(lmb_vec3 *v)
{
    const float longest = largest3(*v);
    if (!(longest > 1e-30f && longest < 1e30f)) {
        return 0;
    }
    *v = normalize3(mul3(*v, 1.0f / longest));
    return 1;
}

#define MIN_COLUMN_SHARE 1e-6f /* of the longest column: a shorter column is a scale of 0 after rounding */

/* Normalizes column c; returns 0 if the column has no length. */
static int axis_direction(lmb_vec3 *out, const lmb_mat4 *m, int c)
{
    float longest = 0.0f, own = 0.0f;
    *out = column(m, c);
    for (int i = 0; i < 12; ++i) {
        longest = i % 4 != 3 ? maxf(longest, absf(m->m[i])) : longest;
        own = i % 4 != 3 && i / 4 == c ? maxf(own, absf(m->m[i])) : own;
    }
    return own > MIN_COLUMN_SHARE * longest && to_unit(out);
}

/* Normalizes the columns. A column without length becomes perpendicular to the others, or an axis. */
static void unscale(lmb_mat4 *inout)
{
    lmb_vec3 own[3];
    int has[3];
    for (int c = 0; c < 3; ++c) {
        own[c] = column(inout, c);
        has[c] = to_unit(&own[c]);
    }
    for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        lmb_vec3 v = has[c] ? own[c] : cross3(own[a], own[b]);
        if (!has[c] && !(has[a] && has[b] && to_unit(&v))) {
            v = vec3(c == 0 ? 1.0f : 0.0f, c == 1 ? 1.0f : 0.0f, c == 2 ? 1.0f : 0.0f);
        }
        inout->m[4 * c] = v.x;
        inout->m[4 * c + 1] = v.y;
        inout->m[4 * c + 2] = v.z;
    }
}

/* A node's transform to its parent, without scale if `turns`. */
static int local(lmb_mat4 *out, const lmb_pack *p, const uint32_t *node, float time_s, int turns)
{
    float v[3][4]; /* translation, rotation, scale */
    if (node[3] == 1) {
        lmb_pack_take_matrix(out, node + 4);
        if (turns) {
            unscale(out);
        }
        return 1;
    }
    memcpy(v[TRANSLATION], node + N_TRANSLATION, 3 * sizeof(float));
    memcpy(v[ROTATION], node + N_ROTATION, 4 * sizeof(float));
    memcpy(v[SCALE], node + N_SCALE, 3 * sizeof(float));
    for (uint32_t i = node[1]; i < node[1] + node[2]; ++i) {
        const track t = track_at(p, i);
        evaluate(v[lmb_pack_record(p, LMB_PACK_TRACKS, i)[0] & 255u], &t, time_s);
    }
    for (int k = 0; turns && k < 3; ++k) {
        v[SCALE][k] = v[SCALE][k] < 0.0f ? -1.0f : 1.0f;
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

/* A node's transform to the world, or only its rotations if `turns`. Returns 0 if a transform on the path is
 * invalid. */
static int node_to_world(lmb_mat4 *out, const lmb_pack *p, uint32_t node, float time_s, int turns)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_NODES, node);
    int all = local(out, p, w, time_s, turns);
    for (uint32_t n = w[0]; all && n != LMB_PACK_NONE; n = w[0]) {
        lmb_mat4 above;
        w = lmb_pack_record(p, LMB_PACK_NODES, n);
        all = local(&above, p, w, time_s, turns);
        if (all) {
            put_above(out, &above);
        }
    }
    for (int i = 0; all && i < 16; ++i) {
        all = absf(out->m[i]) <= FLT_MAX;
    }
    return all;
}

/* --- instances, lights, cameras ----------------------------------------------------------------------------------- */

/* The node that moves instance, light or camera i of a kind; LMB_PACK_NONE if there is none. */
static uint32_t moving_node_of(const lmb_pack *p, int kind, uint32_t i)
{
    const int word = kind == LMB_PACK_INSTANCES ? PACK_INSTANCE_NODE
                     : kind == LMB_PACK_LIGHTS  ? PACK_LIGHT_NODE
                                                : PACK_CAMERA_NODE;
    return lmb_pack_record(p, kind, i)[word];
}

static int has_record(const lmb_pack *p, int kind, uint32_t i)
{
    return p != NULL && p->data != NULL && i < p->count[kind];
}

lmb_status lmb_pack_place_instance(lmb_instance *inout, const lmb_pack *p, uint32_t i, float time_s)
{
    if (inout == NULL || !has_record(p, LMB_PACK_INSTANCES, i)) {
        return LMB_ERR_ARG;
    }
    const uint32_t node = moving_node_of(p, LMB_PACK_INSTANCES, i);
    lmb_mat4 to_world;
    if (node != LMB_PACK_NONE) {
        if (!node_to_world(&to_world, p, node, time_s, 0)) {
            return LMB_ERR_SCENE;
        }
        inout->to_world = to_world;
    }
    return LMB_OK;
}

/* A light points along the node's -Z. If a scale of 0 leaves no length there, the direction comes from the rotations. A
 * point light does not use a direction. */
lmb_status lmb_pack_place_light(lmb_light *inout, const lmb_pack *p, uint32_t i, float time_s)
{
    if (inout == NULL || !has_record(p, LMB_PACK_LIGHTS, i)) {
        return LMB_ERR_ARG;
    }
    const uint32_t node = moving_node_of(p, LMB_PACK_LIGHTS, i);
    lmb_mat4 world, turn;
    if (node == LMB_PACK_NONE) {
        return LMB_OK;
    }
    if (!node_to_world(&world, p, node, time_s, 0)) {
        return LMB_ERR_SCENE;
    }
    lmb_vec3 way;
    if (axis_direction(&way, &world, 2) ||
        (node_to_world(&turn, p, node, time_s, 1) && axis_direction(&way, &turn, 2))) {
        inout->direction = sub3(vec3(0.0f, 0.0f, 0.0f), way);
    } else if (inout->kind != LMB_LIGHT_POINT) {
        return LMB_ERR_SCENE;
    }
    inout->position = column(&world, 3);
    return LMB_OK;
}

/* Returns 0 if the matrix has no such axes. */
static int axes_of(lmb_vec3 *right, lmb_vec3 *up, lmb_vec3 *back, const lmb_mat4 *m)
{
    if (!axis_direction(back, m, 2) || !axis_direction(up, m, 1)) {
        return 0;
    }
    *right = cross3(*up, *back);
    if (!to_unit(right)) {
        return 0;
    }
    *up = normalize3(cross3(*back, *right));
    return 1;
}

/* Back points along the node's Z, and up as close to Y as possible; scale and mirroring are dropped. */
int lmb_pack_place_camera(lmb_view *inout, const lmb_pack *p, uint32_t i, float time_s)
{
    const uint32_t node = moving_node_of(p, LMB_PACK_CAMERAS, i);
    lmb_mat4 world, turn;
    lmb_vec3 right, up, back;
    if (node == LMB_PACK_NONE) {
        return 1;
    }
    if (!node_to_world(&world, p, node, time_s, 0) ||
        (!axes_of(&right, &up, &back, &world) &&
         !(node_to_world(&turn, p, node, time_s, 1) && axes_of(&right, &up, &back, &turn)))) {
        return 0;
    }
    inout->eye = column(&world, 3);
    inout->right = right;
    inout->up = up;
    inout->back = back;
    return 1;
}

#endif
