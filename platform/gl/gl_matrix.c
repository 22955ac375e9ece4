/* gl_matrix.c: stacks of matrices, and derived matrices. */
#include "gl_context.h"

void gl_matrix_times(float out[16], const float a[16], const float b[16])
{
    float m[16];
    for (int i = 0; i < 16; ++i) {
        const float *col = &b[i & ~3];
        m[i] = a[i & 3] * col[0] + a[(i & 3) + 4] * col[1] + a[(i & 3) + 8] * col[2] + a[(i & 3) + 12] * col[3];
    }
    memcpy(out, m, sizeof m);
}

void gl_matrix_point(float out[4], const float m[16], const float v[4])
{
    for (int i = 0; i < 4; ++i) {
        out[i] = m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2] + m[12 + i] * v[3];
    }
}

/* As gl_matrix_point, value by value. */
void gl_matrix_points(float (*out)[4], const float m[16], const float (*in)[4], int32_t count)
{
#ifdef __GNUC__
    typedef float four __attribute__((vector_size(16)));
    four c[4], v;
    memcpy(c, m, sizeof c);
    for (int32_t i = 0; i < count; ++i) {
        v = c[0] * in[i][0] + c[1] * in[i][1] + c[2] * in[i][2] + c[3] * in[i][3];
        memcpy(out[i], &v, sizeof v);
    }
#else
    for (int32_t i = 0; i < count; ++i) {
        gl_matrix_point(out[i], m, in[i]);
    }
#endif
}

/* Gaussian elimination with pivoting; returns 0 if there is no inverse. */
int gl_matrix_invert(float out[16], const float m[16])
{
    double a[4][8];
    for (int r = 0; r < 4; ++r) {
        for (int k = 0; k < 8; ++k) {
            a[r][k] = k < 4 ? (double)m[4 * k + r] : k - 4 == r ? 1.0 : 0.0;
        }
    }
    for (int k = 0; k < 4; ++k) {
        int best = k;
        for (int r = k + 1; r < 4; ++r) {
            best = a[r][k] * a[r][k] > a[best][k] * a[best][k] ? r : best;
        }
        if (!(a[best][k] != 0.0)) {
            return 0;
        }
        for (int i = 0; i < 8; ++i) {
            const double v = a[k][i];
            a[k][i] = a[best][i];
            a[best][i] = v;
        }
        const double by = 1.0 / a[k][k];
        for (int i = 0; i < 8; ++i) {
            a[k][i] *= by;
        }
        for (int r = 0; r < 4; ++r) {
            const double f = a[r][k];
            for (int i = 0; i < 8 && r != k; ++i) {
                a[r][i] -= f * a[k][i];
            }
        }
    }
    for (int i = 0; i < 16; ++i) {
        out[i] = (float)a[i & 3][4 + i / 4];
    }
    return 1;
}

static gl_matrices *matrix_stack(gl_context *c)
{
    return c->s.transform.mode == GL_MODELVIEW    ? &c->modelview
           : c->s.transform.mode == GL_PROJECTION ? &c->projection
                                                  : &c->texture[c->s.texture.active];
}

void gl_op_matrix_mode(gl_context *c, const gl_word *w)
{
    GL_FAIL(w[0].u < GL_MODELVIEW || w[0].u > GL_TEXTURE, GL_INVALID_ENUM, )
    c->s.transform.mode = w[0].u;
}

void gl_op_load_matrix(gl_context *c, const gl_word *w)
{
    gl_matrices *s = matrix_stack(c);
    memcpy(s->m[s->top], w, sizeof s->m[0]);
    c->matrices_dirty = 1;
}

void gl_op_mult_matrix(gl_context *c, const gl_word *w)
{
    gl_matrices *s = matrix_stack(c);
    float m[16];
    memcpy(m, w, sizeof m);
    gl_matrix_times(s->m[s->top], s->m[s->top], m);
    c->matrices_dirty = 1;
}

void gl_op_push_matrix(gl_context *c, const gl_word *w)
{
    gl_matrices *s = matrix_stack(c);
    (void)w;
    GL_FAIL(s->top + 1 >= s->limit, GL_STACK_OVERFLOW, )
    memcpy(s->m[s->top + 1], s->m[s->top], sizeof s->m[0]);
    ++s->top;
}

void gl_op_pop_matrix(gl_context *c, const gl_word *w)
{
    gl_matrices *s = matrix_stack(c);
    (void)w;
    GL_FAIL(s->top == 0, GL_STACK_UNDERFLOW, )
    --s->top;
    c->matrices_dirty = 1;
}

/* The inverse transpose of the upper left 3x3, and 1 / length of the inverse's third row. */
void gl_update_matrices(gl_context *c)
{
    float inverse[16];
    if (!c->matrices_dirty) {
        return;
    }
    const float *m = c->modelview.m[c->modelview.top];
    c->matrices_dirty = 0;
    gl_matrix_times(c->mvp, c->projection.m[c->projection.top], m);
    if (!gl_matrix_invert(inverse, m)) {
        memcpy(inverse, c->modelview.m[c->modelview.top], sizeof inverse);
    }
    for (int r = 0; r < 3; ++r) {
        for (int k = 0; k < 3; ++k) {
            c->normal_matrix[3 * r + k] = inverse[4 * r + k]; /* row r of the transpose: column r of the inverse */
        }
    }
    const float *n = &inverse[0];
    const float square = n[2] * n[2] + n[6] * n[6] + n[10] * n[10];
    c->eye_scale = square > 0.0f ? 1.0f / lmb_sqrt(square) : 1.0f;
}

/* Transforms the equation to eye space by the inverse of the model-view matrix. */
void gl_op_clip_plane(gl_context *c, const gl_word *w)
{
    float inverse[16];
    GL_FAIL(w[0].u < GL_CLIP_PLANE0 || w[0].u >= GL_CLIP_PLANE0 + GL_CLIP_PLANES, GL_INVALID_ENUM, )
    float *out = c->s.transform.plane[w[0].u - GL_CLIP_PLANE0];
    if (gl_matrix_invert(inverse, c->modelview.m[c->modelview.top])) {
        for (int i = 0; i < 4; ++i) {
            const float *col = &inverse[4 * i];
            out[i] = w[1].f * col[0] + w[2].f * col[1] + w[3].f * col[2] + w[4].f * col[3];
        }
    }
}
