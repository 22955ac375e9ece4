/* model_morph.c: mixes morph targets into positions, normals and tangents. */
#include "model_morph.h"

#include <math.h>

/* Rounds toward 0, because -32768 is not a valid code. */
void model_set_side(int16_t code[2], int negative)
{
    if ((code[0] & 1) == (negative != 0))
        code[0] = (int16_t)(code[0] > 0 ? code[0] - 1 : code[0] + 1);
}

int model_side_of(const int16_t code[2]) { return (code[0] & 1) == 0; }

/* Sums the offsets of all targets at a vertex. */
static void add_targets(double inout[3], const model_morph *m, int stream, const double *weights, uint32_t vertex)
{
    for (uint32_t i = 0; i < m->targets; ++i) {
        const float *add = m->add[stream][i];
        for (int k = 0; k < 3 && add != NULL && weights[i] != 0; ++k)
            inout[k] += weights[i] * (double)add[3 * (size_t)vertex + (size_t)k];
    }
}

static void pose_positions(float *out, const model_morph *m, const double *weights)
{
    for (uint32_t i = 0; i < m->vertices; ++i) {
        const float *p = m->positions + 3 * (size_t)i;
        double sum[3] = {(double)p[0], (double)p[1], (double)p[2]};
        add_targets(sum, m, MODEL_MORPH_POSITION, weights, i);
        for (size_t k = 0; k < 3; ++k)
            out[3 * (size_t)i + k] = fabs(sum[k]) < 3.4e38 ? (float)sum[k] : (float)INFINITY;
    }
}

static void pose_vector(int16_t out[2], const int16_t code[2], const model_morph *m, int stream, const double *weights,
                        uint32_t vertex)
{
    const lmb_vec3 from = lmb_octahedral_decode(code);
    double sum[3] = {(double)from.x, (double)from.y, (double)from.z}, length;
    const int side = model_side_of(code);
    add_targets(sum, m, stream, weights, vertex);
    length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    out[0] = code[0];
    out[1] = code[1];
    if (!(length > 1e-4 && length < 1e30))
        return;
    const lmb_vec3 unit = {(float)(sum[0] / length), (float)(sum[1] / length), (float)(sum[2] / length)};
    lmb_octahedral_encode(out, unit);
    if (stream == MODEL_MORPH_TANGENT)
        model_set_side(out, side);
}

void model_morph_pose(float *positions, int16_t *normals, int16_t *tangents, const model_morph *m,
                      const double *weights)
{
    if (positions != NULL)
        pose_positions(positions, m, weights);
    for (uint32_t i = 0; i < m->vertices; ++i) {
        const size_t at = 2 * (size_t)i;
        if (normals != NULL)
            pose_vector(normals + at, m->normals + at, m, MODEL_MORPH_NORMAL, weights, i);
        if (tangents != NULL)
            pose_vector(tangents + at, m->tangents + at, m, MODEL_MORPH_TANGENT, weights, i);
    }
}
