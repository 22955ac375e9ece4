/* model_motion.c: poses a model's nodes at a time: keys, what lies between them, and the way to the world. */
#include "model_motion.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "../../src/pack/motion.h"

/* --- matrices ----------------------------------------------------------------------------------------------------- */

int model_compose(double m[16], const model_local *l)
{
    const double *q = l->q, d = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double x, y, z, w;
    int i;
    if (l->is_matrix) {
        memcpy(m, l->matrix, sizeof l->matrix);
        return 1;
    }
    if (!(d > 1e-12))
        return 0;
    x = q[0] / d, y = q[1] / d, z = q[2] / d, w = q[3] / d;
    m[0] = 1 - 2 * (y * y + z * z), m[1] = 2 * (x * y + z * w), m[2] = 2 * (x * z - y * w);
    m[4] = 2 * (x * y - z * w), m[5] = 1 - 2 * (x * x + z * z), m[6] = 2 * (y * z + x * w);
    m[8] = 2 * (x * z + y * w), m[9] = 2 * (y * z - x * w), m[10] = 1 - 2 * (x * x + y * y);
    for (i = 0; i < 3; ++i) {
        m[i] *= l->s[0];
        m[4 + i] *= l->s[1];
        m[8 + i] *= l->s[2];
        m[12 + i] = l->t[i];
    }
    m[3] = m[7] = m[11] = 0;
    m[15] = 1;
    return 1;
}

static void multiply(double out[16], const double a[16], const double b[16])
{
    int row, column;
    for (column = 0; column < 4; ++column)
        for (row = 0; row < 4; ++row)
            out[4 * column + row] = a[row] * b[4 * column] + a[4 + row] * b[4 * column + 1] +
                                    a[8 + row] * b[4 * column + 2] + a[12 + row] * b[4 * column + 3];
}

static lmb_vec3 to_vec3(const double v[3])
{
    lmb_vec3 out;
    out.x = (float)v[0];
    out.y = (float)v[1];
    out.z = (float)v[2];
    return out;
}

/* v to length 1; 0 where it has none. */
static int normalize(double v[3])
{
    const double d = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(d > 1e-30 && d < 1e30))
        return 0;
    v[0] /= d;
    v[1] /= d;
    v[2] /= d;
    return 1;
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* It points along the node's -Z. A point light has no use for a direction; the scene wants unit length. */
int model_place_light(lmb_light *out, const double world[16])
{
    double way[3] = {-world[8], -world[9], -world[10]};
    if (!normalize(way)) {
        if (out->kind != LMB_LIGHT_POINT)
            return 0;
        way[0] = way[1] = 0;
        way[2] = -1;
    }
    out->direction = to_vec3(way);
    out->position = to_vec3(world + 12);
    return 1;
}

/* Back along the node's Z, up as near its Y as that allows; scale and mirroring drop out. */
int model_place_camera(model_camera *out, const double world[16])
{
    double right[3], up[3], back[3];
    memcpy(up, world + 4, sizeof up);
    memcpy(back, world + 8, sizeof back);
    cross(right, up, back);
    if (!normalize(back) || !normalize(right))
        return 0;
    cross(up, back, right);
    out->eye = to_vec3(world + 12);
    out->right = to_vec3(right);
    out->up = to_vec3(up);
    out->back = to_vec3(back);
    return 1;
}

/* --- between keys ------------------------------------------------------------------------------------------------- */

static const float *value_at(const model_track *t, uint32_t key, int size)
{
    return t->between == MODEL_CUBIC ? t->value + (size_t)(3 * key + 1) * (size_t)size
                                     : t->value + (size_t)key * (size_t)size;
}

/* By glTF's cubic, whose tangents are by the second. */
static void cubic(double *out, const model_track *t, uint32_t key, double u, double span, int size)
{
    const float *a = value_at(t, key, size), *b = value_at(t, key + 1, size), *from = a + size, *to = b - size;
    const double v = 1 - u;
    int i;
    for (i = 0; i < size; ++i)
        out[i] = v * v * (1 + 2 * u) * (double)a[i] + u * u * (1 + 2 * v) * (double)b[i] +
                 u * v * span * (v * (double)from[i] - u * (double)to[i]);
}

/* Rotations by the shorter way round, evenly. */
static void spherical(double out[4], const float *a, const float *b, double u)
{
    double dot = 0, way, from = 1 - u, to = u;
    int i;
    for (i = 0; i < 4; ++i)
        dot += (double)a[i] * (double)b[i];
    way = dot < 0 ? -1 : 1;
    dot = fabs(dot);
    if (dot < 0.9995) {
        const double angle = acos(dot), per = 1 / sin(angle);
        from = sin((1 - u) * angle) * per;
        to = sin(u * angle) * per;
    }
    for (i = 0; i < 4; ++i)
        out[i] = from * (double)a[i] + way * to * (double)b[i];
}

static void linear(double *out, const model_track *t, uint32_t key, double u, int size)
{
    const float *a = value_at(t, key, size), *b = value_at(t, key + 1, size);
    int i;
    if (t->what == MODEL_ROTATION) {
        spherical(out, a, b, u);
        return;
    }
    for (i = 0; i < size; ++i)
        out[i] = (1 - u) * (double)a[i] + u * (double)b[i];
}

void model_track_at(double *out, const model_track *t, double time_s, int size)
{
    uint32_t low = 0, high = t->count - 1;
    const float *value;
    double span, u;
    int i;
    while (high - low > 1) { /* the last key at or before the time */
        const uint32_t middle = low + (high - low) / 2;
        if ((double)t->time[middle] <= time_s)
            low = middle;
        else
            high = middle;
    }
    low = (double)t->time[high] <= time_s ? high : low;
    value = value_at(t, low, size);
    if (low == t->count - 1 || time_s <= (double)t->time[low] || t->between == MODEL_STEP) {
        for (i = 0; i < size; ++i)
            out[i] = (double)value[i];
        return;
    }
    span = (double)t->time[low + 1] - (double)t->time[low];
    u = (time_s - (double)t->time[low]) / span;
    if (t->between == MODEL_CUBIC)
        cubic(out, t, low, u, span, size);
    else
        linear(out, t, low, u, size);
}

/* --- poses -------------------------------------------------------------------------------------------------------- */

/* The node's own way, then that of its parent. Tracks lie by their nodes. */
static int place(const struct model_motion *m, uint32_t node, uint32_t *track, double time_s)
{
    model_local l = m->rest[node];
    double local[16];
    int i;
    for (; *track < m->tracks && m->track[*track].node == node; ++*track) {
        const model_track *t = &m->track[*track];
        model_track_at(t->what == MODEL_ROTATION ? l.q : t->what == MODEL_SCALE ? l.s : l.t, t, time_s,
                 t->what == MODEL_ROTATION ? 4 : 3);
    }
    if (!model_compose(local, &l))
        return 0;
    if (m->parent[node] == MODEL_NONE)
        memcpy(m->world[node], local, sizeof local);
    else
        multiply(m->world[node], m->world[m->parent[node]], local);
    for (i = 0; i < 16; ++i)
        if (!(fabs(m->world[node][i]) <= (double)FLT_MAX))
            return 0;
    return 1;
}

static int is_moved(const struct model_motion *m, uint32_t node) { return node != MODEL_NONE && m->moves[node]; }

/* Of a packed scene, by the library: as a program has it that draws the file. */
static int pose_pack(lmb_instance *instances, lmb_light *lights, model_camera *cameras, const model *of, float time_s)
{
    uint32_t i;
    lmb_view v;
    memset(&v, 0, sizeof v);
    for (i = 0; i < of->scene.instance_count; ++i)
        if (!lmb_pack_place_instance(&instances[i], of->pack, i, time_s))
            return 0;
    for (i = 0; i < of->scene.light_count; ++i)
        if (!lmb_pack_place_light(&lights[i], of->pack, i, time_s))
            return 0;
    for (i = 0; i < of->camera_count; ++i) {
        model_camera *c = &cameras[i];
        v.eye = c->eye, v.right = c->right, v.up = c->up, v.back = c->back;
        if (!lmb_pack_place_camera(&v, of->pack, i, time_s))
            return 0;
        c->eye = v.eye, c->right = v.right, c->up = v.up, c->back = v.back;
    }
    return 1;
}

int model_pose(lmb_instance *instances, lmb_light *lights, model_camera *cameras, const model *of, double time_s)
{
    const struct model_motion *m = of->motion;
    uint32_t i, c, track = 0;
    if (of->pack)
        return pose_pack(instances, lights, cameras, of, (float)time_s);
    for (i = 0; i < m->nodes; ++i)
        if (!place(m, i, &track, time_s))
            return 0;
    for (i = 0; i < of->scene.instance_count; ++i)
        for (c = 0; c < 16 && is_moved(m, m->of_instance[i]); ++c)
            instances[i].to_world.m[c] = (float)m->world[m->of_instance[i]][c];
    for (i = 0; i < of->scene.light_count; ++i)
        if (is_moved(m, m->of_light[i]) && !model_place_light(&lights[i], m->world[m->of_light[i]]))
            return 0;
    for (i = 0; i < of->camera_count; ++i)
        if (is_moved(m, m->of_camera[i]) && !model_place_camera(&cameras[i], m->world[m->of_camera[i]]))
            return 0;
    return 1;
}
