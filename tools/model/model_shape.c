/* model_shape.c: computes the vertices of a shape at a time. Morph targets are applied before the skin, and the
 * transform of a skinned node is ignored (glTF 2.0, 3.7.2.2 and 3.7.3.3). */
#include "model_shape.h"

#include <math.h>
#include <string.h>

/* The weighted mean of the joint matrices of one vertex. */
typedef struct joint_mean {
    double m[16];
} joint_mean;

static void multiply(double out[16], const double a[16], const double b[16])
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            out[4 * column + row] = a[row] * b[4 * column] + a[4 + row] * b[4 * column + 1] +
                                    a[8 + row] * b[4 * column + 2] + a[12 + row] * b[4 * column + 3];
}

/* Returns the weighted mean of the joint matrices, or the first joint if the vertex has no weights. */
static joint_mean mean_of(const model_shape *s, const double (*matrix)[16], uint32_t vertex)
{
    const uint16_t *joint = s->joint + (size_t)vertex * s->influences;
    const float *weight = s->weight + (size_t)vertex * s->influences;
    joint_mean sum = {{0}};
    double total = 0;
    for (uint32_t i = 0; i < s->influences; ++i) {
        if (!(weight[i] > 0.0f && weight[i] < 1e30f))
            continue;
        total += (double)weight[i];
        for (int k = 0; k < 16; ++k)
            sum.m[k] += (double)weight[i] * matrix[joint[i]][k];
    }
    for (int k = 0; k < 16; ++k)
        sum.m[k] = total > 0 ? sum.m[k] / total : matrix[0][k];
    return sum;
}

/* Computes the cofactors of the upper 3 x 3 for normals, so that nonuniform scale is correct. */
static joint_mean cofactors(const joint_mean *a)
{
    joint_mean c = {{0}};
    for (int i = 0; i < 3; ++i) {
        const double *p = a->m + 4 * ((i + 1) % 3), *q = a->m + 4 * ((i + 2) % 3);
        c.m[4 * i] = p[1] * q[2] - p[2] * q[1];
        c.m[4 * i + 1] = p[2] * q[0] - p[0] * q[2];
        c.m[4 * i + 2] = p[0] * q[1] - p[1] * q[0];
    }
    return c;
}

static void add_targets(double inout[3], const model_shape *s, int stream, const double *weights, uint32_t vertex)
{
    for (uint32_t i = 0; i < s->targets; ++i) {
        const float *add = s->add[stream][i];
        for (int k = 0; k < 3 && add != NULL && weights[i] != 0; ++k)
            inout[k] += weights[i] * (double)add[3 * (size_t)vertex + (size_t)k];
    }
}

/* Multiplies by the upper 3 x 3 and adds `place` times the last column. */
static void turn(double v[3], const joint_mean *by, double place)
{
    const double x = v[0], y = v[1], z = v[2], *m = by->m;
    for (int k = 0; k < 3; ++k)
        v[k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k] * place;
}

static float to_float(double v) { return v > 3.4e38 ? (float)INFINITY : v < -3.4e38 ? -(float)INFINITY : (float)v; }

static void pose_position(model_shape *s, const double *weights, const joint_mean *joint, uint32_t vertex)
{
    const float *rest = s->rest_positions + 3 * (size_t)vertex;
    double v[3] = {(double)rest[0], (double)rest[1], (double)rest[2]};
    add_targets(v, s, SHAPE_POSITION, weights, vertex);
    if (joint != NULL)
        turn(v, joint, 1);
    for (int k = 0; k < 3; ++k)
        s->positions[3 * (size_t)vertex + (size_t)k] = to_float(v[k]);
}

/* Normalizes the vector; a vector without length stays as it was at rest. The last bit of the code is kept too. */
static void pose_vector(int16_t out[2], const int16_t rest[2], const model_shape *s, int stream, const double *weights,
                        const joint_mean *joint, uint32_t vertex)
{
    const lmb_vec3 from = lmb_octahedral_decode(rest);
    double v[3] = {(double)from.x, (double)from.y, (double)from.z}, length;
    add_targets(v, s, stream, weights, vertex);
    if (joint != NULL)
        turn(v, joint, 0);
    length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    out[0] = rest[0];
    out[1] = rest[1];
    if (length > 1e-30 && length < 1e30)
        lmb_octahedral_encode(out, (lmb_vec3){(float)(v[0] / length), (float)(v[1] / length), (float)(v[2] / length)});
    if (stream == SHAPE_TANGENT && ((out[0] ^ rest[0]) & 1) != 0)
        out[0] = (int16_t)(out[0] > 0 ? out[0] - 1 : out[0] + 1);
}

static void pose_vertex(model_shape *s, const double *weights, const double (*matrix)[16], uint32_t vertex)
{
    const size_t at = 2 * (size_t)vertex;
    joint_mean joint, normal, *by = NULL;
    if (s->joints > 0) {
        joint = mean_of(s, matrix, vertex);
        normal = cofactors(&joint);
        by = &joint;
    }
    pose_position(s, weights, by, vertex);
    if (s->normals != NULL)
        pose_vector(s->normals + at, s->rest_normals + at, s, SHAPE_NORMAL, weights, by != NULL ? &normal : NULL,
                    vertex);
    if (s->tangents != NULL)
        pose_vector(s->tangents + at, s->rest_tangents + at, s, SHAPE_TANGENT, weights, by, vertex);
}

void model_pose_shapes(const model *of, double time_s)
{
    const struct model_motion *m = of->motion;
    const uint32_t count = m != NULL && m->shapes != NULL ? m->shapes->count : 0;
    for (uint32_t i = 0; i < count; ++i) {
        model_shape *s = &m->shapes->shape[i];
        const double *weights = s->weights;
        if (s->track != NULL) {
            model_track_at(m->shapes->weights, s->track, time_s, (int)s->targets);
            weights = m->shapes->weights;
        }
        for (uint32_t k = 0; k < s->joints; ++k)
            multiply(m->shapes->matrices[k], m->world[s->joint_node[k]], s->bind[k]);
        for (uint32_t v = 0; v < s->vertices; ++v)
            pose_vertex(s, weights, (const double(*)[16])m->shapes->matrices, v);
    }
}
