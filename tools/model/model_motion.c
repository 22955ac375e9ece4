/* model_motion.c: poses the nodes of a model at a time: keys, interpolation, and world transforms. */
#include "model_motion.h"

#include <float.h>
#include <math.h>
#include <string.h>

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

static lmb_vec3 to_vec3(const double v[3])
{
    lmb_vec3 out;
    out.x = (float)v[0];
    out.y = (float)v[1];
    out.z = (float)v[2];
    return out;
}

/* Normalizes v; returns 0 if it has no length. */
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

/* Sets `out` perpendicular to v, which has unit length, using the axis that v is farthest from. */
static void square_to(double out[3], const double v[3])
{
    const double axis[3] = {fabs(v[0]) <= fabs(v[1]) && fabs(v[0]) <= fabs(v[2]),
                            fabs(v[1]) < fabs(v[0]) && fabs(v[1]) <= fabs(v[2]), 1};
    cross(out, axis, v);
    if (!normalize(out)) {
        out[0] = 1;
        out[1] = out[2] = 0;
    }
}

#define FLAT 1e-6 /* share of the longest column; a shorter column is rounding error of a scale of 0 */

/* Normalizes column c. Returns 0 if the column has no length. */
static int direction_of(double out[3], const double m[16], int c)
{
    double longest = 0;
    for (int i = 0; i < 12; i += 4)
        longest = fmax(longest, fmax(fabs(m[i]), fmax(fabs(m[i + 1]), fabs(m[i + 2]))));
    memcpy(out, m + 4 * c, 3 * sizeof *out);
    return fmax(fabs(out[0]), fmax(fabs(out[1]), fabs(out[2]))) > FLAT * longest && normalize(out);
}

/* Computes the axes of the camera from columns 1 and 2. Returns 0 if they define no axes. */
static int axes_of(double right[3], double up[3], double back[3], const double m[16])
{
    if (!direction_of(up, m, 1) || !direction_of(back, m, 2))
        return 0;
    cross(right, up, back);
    if (!normalize(right))
        return 0;
    cross(up, back, right);
    return 1;
}

/* Makes v perpendicular to `unit` and normalizes it. If nothing is left, chooses another perpendicular vector. */
static void make_square(double v[3], const double unit[3])
{
    const double along = v[0] * unit[0] + v[1] * unit[1] + v[2] * unit[2];
    for (int k = 0; k < 3; ++k)
        v[k] -= along * unit[k];
    if (!normalize(v))
        square_to(v, unit);
}

/* Makes the axes of a matrix orthonormal, even if columns have no length or are parallel. A missing column becomes
 * perpendicular to the other two, or otherwise the coordinate axis of that column. */
static void complete(double m[16])
{
    double axis[3][3], x[3];
    int has[3], i, k;
    for (i = 0; i < 3; ++i) {
        memcpy(axis[i], m + 4 * i, sizeof axis[i]);
        has[i] = normalize(axis[i]);
    }
    for (i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        if (has[i])
            continue;
        cross(axis[i], axis[a], axis[b]);
        if (!(has[a] && has[b] && normalize(axis[i])))
            for (k = 0; k < 3; ++k)
                axis[i][k] = k == i;
    }
    if (!has[2] && has[1])
        make_square(axis[2], axis[1]);
    make_square(axis[1], axis[2]);
    cross(x, axis[1], axis[2]);
    const int mirrored = x[0] * axis[0][0] + x[1] * axis[0][1] + x[2] * axis[0][2] < 0;
    for (k = 0; k < 3; ++k) {
        m[k] = mirrored ? -x[k] : x[k];
        m[4 + k] = axis[1][k];
        m[8 + k] = axis[2][k];
    }
}

/* Keeps mirroring. */
int model_compose_turn(double m[16], const model_local *l)
{
    model_local turn = *l;
    int i;
    for (i = 0; i < 3; ++i)
        turn.s[i] = l->s[i] < 0 ? -1 : 1;
    if (!model_compose(m, &turn))
        return 0;
    if (l->is_matrix)
        complete(m);
    return 1;
}

void model_multiply(double out[16], const double a[16], const double b[16])
{
    int row, column;
    for (column = 0; column < 4; ++column)
        for (row = 0; row < 4; ++row)
            out[4 * column + row] = a[row] * b[4 * column] + a[4 + row] * b[4 * column + 1] +
                                    a[8 + row] * b[4 * column + 2] + a[12 + row] * b[4 * column + 3];
}

/* The light points along -Z of the node. A point light ignores the direction, but the scene requires unit length. */
void model_place_light(lmb_light *out, const double world[16], const double turn[16])
{
    double way[3];
    int i;
    if (!direction_of(way, world, 2))
        memcpy(way, turn + 8, sizeof way);
    for (i = 0; i < 3; ++i)
        way[i] = -way[i];
    out->direction = to_vec3(way);
    out->position = to_vec3(world + 12);
}

/* Back is the node's Z, and up as near Y as possible; removes scale and mirroring. */
void model_place_camera(model_camera *out, const double world[16], const double turn[16])
{
    double right[3], up[3], back[3];
    if (!axes_of(right, up, back, world))
        axes_of(right, up, back, turn);
    out->eye = to_vec3(world + 12);
    out->right = to_vec3(right);
    out->up = to_vec3(up);
    out->back = to_vec3(back);
}

/* --- between keys ------------------------------------------------------------------------------------------------- */

static const float *value_at(const model_track *t, uint32_t key, int size)
{
    return t->between == MODEL_CUBIC ? t->value + (size_t)(3 * key + 1) * (size_t)size
                                     : t->value + (size_t)key * (size_t)size;
}

/* The cubic of glTF, with tangents per second. */
static void cubic(double *out, const model_track *t, uint32_t key, double u, double span, int size)
{
    const float *a = value_at(t, key, size), *b = value_at(t, key + 1, size), *from = a + size, *to = b - size;
    const double v = 1 - u;
    int i;
    for (i = 0; i < size; ++i)
        out[i] = v * v * (1 + 2 * u) * (double)a[i] + u * u * (1 + 2 * v) * (double)b[i] +
                 u * v * span * (v * (double)from[i] - u * (double)to[i]);
}

/* Interpolates rotations along the shorter arc with constant speed. */
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

/* The node's local transform, then that of the parent. Tracks are sorted by node. */
static int place(const struct model_motion *m, uint32_t node, uint32_t *track, double time_s)
{
    const uint32_t up = m->parent[node];
    model_local l = m->rest[node];
    double local[16], turn[16];
    int i;
    for (; *track < m->tracks && m->track[*track].node == node; ++*track) {
        const model_track *t = &m->track[*track];
        model_track_at(t->what == MODEL_ROTATION ? l.q : t->what == MODEL_SCALE ? l.s : l.t, t, time_s,
                 t->what == MODEL_ROTATION ? 4 : 3);
    }
    if (!model_compose(local, &l) || !model_compose_turn(turn, &l))
        return 0;
    if (up == MODEL_NONE) {
        memcpy(m->world[node], local, sizeof local);
        memcpy(m->turn[node], turn, sizeof turn);
    } else {
        model_multiply(m->world[node], m->world[up], local);
        model_multiply(m->turn[node], m->turn[up], turn);
    }
    for (i = 0; i < 16; ++i)
        if (!(fabs(m->world[node][i]) <= (double)FLT_MAX))
            return 0;
    return 1;
}

static int is_moved(const struct model_motion *m, uint32_t node) { return node != MODEL_NONE && m->moves[node]; }

/* The library poses a packed scene, as in a program that draws the file. */
static int pose_pack(lmb_instance *instances, lmb_light *lights, model_camera *cameras, const model *of, float time_s)
{
    uint32_t i;
    lmb_view v;
    for (i = 0; i < of->scene.instance_count; ++i)
        if (lmb_pack_place_instance(&instances[i], of->pack, i, time_s) != LMB_OK)
            return 0;
    for (i = 0; i < of->scene.light_count; ++i)
        if (lmb_pack_place_light(&lights[i], of->pack, i, time_s) != LMB_OK)
            return 0;
    for (i = 0; i < of->camera_count; ++i) {
        model_camera *c = &cameras[i];
        if (lmb_pack_view(&v, of->pack, &of->scene, i, time_s, 1, 1) != LMB_OK)
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
        if (is_moved(m, m->of_light[i]))
            model_place_light(&lights[i], m->world[m->of_light[i]], m->turn[m->of_light[i]]);
    for (i = 0; i < of->camera_count; ++i)
        if (is_moved(m, m->of_camera[i]))
            model_place_camera(&cameras[i], m->world[m->of_camera[i]], m->turn[m->of_camera[i]]);
    return 1;
}
