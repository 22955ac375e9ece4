/* gl_light.c: lights, materials, the colours of lit vertices, and generated texture coordinates. */
#include "gl_context.h"

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)
#define CHECK(good, error) \
    if (!(good)) { gl_error(c, error); return; }

static void light_copy(float *out, const gl_word *w, int n)
{
    for (int i = 0; i < n; ++i) {
        out[i] = w[i].f;
    }
}

OP(light)
{
    const float v = w[2].f;
    CHECK(w[0].u >= GL_LIGHT0 && w[0].u < GL_LIGHT0 + GL_LIGHTS, GL_INVALID_ENUM)
    gl_light *l = &c->s.lighting.light[w[0].u - GL_LIGHT0];
    const float *m = c->modelview.m[c->modelview.top];
    switch (w[1].u) {
    case GL_AMBIENT: light_copy(l->ambient, w + 2, 4); break;
    case GL_DIFFUSE: light_copy(l->diffuse, w + 2, 4); break;
    case GL_SPECULAR: light_copy(l->specular, w + 2, 4); break;
    case GL_POSITION: {
        float at[4];
        light_copy(at, w + 2, 4);
        gl_matrix_point(l->position, m, at);
        break;
    }
    case GL_SPOT_DIRECTION:
        for (int i = 0; i < 3; ++i) {
            l->spot[i] = m[i] * w[2].f + m[4 + i] * w[3].f + m[8 + i] * w[4].f;
        }
        break;
    case GL_SPOT_EXPONENT:
        CHECK(v >= 0.0f && v <= 128.0f, GL_INVALID_VALUE)
        l->exponent = v;
        break;
    case GL_SPOT_CUTOFF:
        CHECK((v >= 0.0f && v <= 90.0f) || v == 180.0f, GL_INVALID_VALUE)
        l->cutoff = v;
        break;
    case GL_CONSTANT_ATTENUATION: case GL_LINEAR_ATTENUATION: case GL_QUADRATIC_ATTENUATION:
        CHECK(v >= 0.0f, GL_INVALID_VALUE)
        l->attenuation[w[1].u - GL_CONSTANT_ATTENUATION] = v;
        break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}

OP(light_model)
{
    switch (w[0].u) {
    case GL_LIGHT_MODEL_AMBIENT: light_copy(c->s.lighting.ambient, w + 1, 4); break;
    case GL_LIGHT_MODEL_LOCAL_VIEWER: c->s.lighting.local = w[1].f != 0.0f; break;
    case GL_LIGHT_MODEL_TWO_SIDE: c->s.lighting.two = w[1].f != 0.0f; break;
    case GL_LIGHT_MODEL_COLOR_CONTROL:
        CHECK(w[1].f == (float)GL_SINGLE_COLOR || w[1].f == (float)GL_SEPARATE_SPECULAR_COLOR, GL_INVALID_ENUM)
        c->s.lighting.separate = w[1].f == (float)GL_SEPARATE_SPECULAR_COLOR;
        break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}

/* The colours that the parameter name sets. */
static void light_set_material(gl_material *m, GLenum name, const float v[4])
{
    float *all[4] = {m->ambient, m->diffuse, m->specular, m->emission};
    const int bits = name == GL_AMBIENT               ? 1
                     : name == GL_DIFFUSE             ? 2
                     : name == GL_AMBIENT_AND_DIFFUSE ? 3
                     : name == GL_SPECULAR            ? 4
                     : name == GL_EMISSION            ? 8
                                                      : 0;
    for (int i = 0; i < 4; ++i) {
        if ((bits >> i & 1) != 0) {
            memcpy(all[i], v, 4 * sizeof *v);
        }
    }
}

/* glMaterial may come between glBegin and glEnd, so the batch is lit first. */
OP(material)
{
    const GLenum face = w[0].u;
    float v[4];
    CHECK(face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK, GL_INVALID_ENUM)
    light_copy(v, w + 2, 4);
    gl_make_vertices(c);
    for (int i = 0; i < 2; ++i) {
        gl_material *m = &c->s.lighting.material[i];
        if (face != GL_FRONT_AND_BACK && (face == GL_BACK) != i) {
            continue;
        }
        switch (w[1].u) {
        case GL_AMBIENT: case GL_DIFFUSE: case GL_SPECULAR: case GL_EMISSION: case GL_AMBIENT_AND_DIFFUSE:
            light_set_material(m, w[1].u, v);
            break;
        case GL_SHININESS:
            CHECK(v[0] >= 0.0f && v[0] <= 128.0f, GL_INVALID_VALUE)
            m->shininess = v[0];
            break;
        case GL_COLOR_INDEXES: memcpy(m->indexes, v, sizeof m->indexes); break;
        default: gl_error(c, GL_INVALID_ENUM); return;
        }
    }
}

/* Tracked colours of both sides take the current colour. */
static void light_track(gl_context *c, const float colour[4])
{
    for (int i = 0; i < 2; ++i) {
        const GLenum face = c->s.lighting.tracks_face;
        if (face == GL_FRONT_AND_BACK || (face == GL_BACK) == i) {
            light_set_material(&c->s.lighting.material[i], c->s.lighting.tracks, colour);
        }
    }
}

OP(colour_material)
{
    const GLenum face = w[0].u, mode = w[1].u;
    CHECK(face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK, GL_INVALID_ENUM)
    CHECK(mode == GL_AMBIENT || mode == GL_DIFFUSE || mode == GL_SPECULAR || mode == GL_EMISSION ||
              mode == GL_AMBIENT_AND_DIFFUSE, GL_INVALID_ENUM)
    c->s.lighting.tracks_face = face;
    c->s.lighting.tracks = mode;
    if (gl_is_on(c, CAP_COLOR_MATERIAL)) {
        light_track(c, c->s.current.v.colour);
    }
}

/* --- a vertex's colours ------------------------------------------------------------------------------------------- */

static float light_dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void light_normalise(float v[3])
{
    const float square = light_dot(v, v), by = square > 0.0f ? 1.0f / lmb_sqrt(square) : 0.0f;
    for (int i = 0; i < 3; ++i) {
        v[i] *= by;
    }
}

/* The eye-space normal. */
static void light_normal(const gl_context *c, const float in[3], float out[3])
{
    for (int r = 0; r < 3; ++r) {
        out[r] = light_dot(&c->normal_matrix[3 * r], in);
    }
    if (gl_is_on(c, CAP_NORMALIZE)) {
        light_normalise(out);
    } else if (gl_is_on(c, CAP_RESCALE)) {
        for (int r = 0; r < 3; ++r) {
            out[r] *= c->eye_scale;
        }
    }
}

/* Shared by both sides of a vertex: direction to the light, and attenuation. */
static float light_way(const gl_light *l, const float *eye, float to[3])
{
    float share = 1.0f;
    for (int i = 0; i < 3; ++i) {
        to[i] = l->position[3] != 0.0f ? l->position[i] / l->position[3] - eye[i] : l->position[i];
    }
    const float distance = lmb_sqrt(light_dot(to, to));
    light_normalise(to);
    if (l->position[3] != 0.0f) {
        share = 1.0f / (l->attenuation[0] + distance * (l->attenuation[1] + distance * l->attenuation[2]));
    }
    if (l->cutoff != 180.0f) {
        float spot[3] = {l->spot[0], l->spot[1], l->spot[2]};
        light_normalise(spot);
        const float cosine = -light_dot(spot, to);
        share *= cosine < lmb_cos(l->cutoff * (LMB_PI / 180.0f)) || cosine <= 0.0f ? 0.0f : gl_pow(cosine, l->exponent);
    }
    return share;
}

static void light_add(const gl_context *c, const gl_material *m, const gl_light *l, const float eye[4],
                      const float n[3], int seen, float colour[3], float second[3])
{
    float to[3], half[3];
    const float share = light_way(l, eye, to), facing = seen ? light_dot(n, to) : 0.0f;
    float highlight = 0.0f;
    if (share == 0.0f) {
        return;
    }
    if (facing > 0.0f) {
        float view[3] = {0.0f, 0.0f, 1.0f};
        if (c->s.lighting.local) {
            for (int i = 0; i < 3; ++i) {
                view[i] = -eye[i];
            }
            light_normalise(view);
        }
        for (int i = 0; i < 3; ++i) {
            half[i] = to[i] + view[i];
        }
        light_normalise(half);
        const float cosine = light_dot(n, half);
        highlight = cosine > 0.0f || m->shininess == 0.0f ? gl_pow(cosine, m->shininess) : 0.0f;
    }
    float *shiny = c->s.lighting.separate ? second : colour;
    for (int i = 0; i < 3; ++i) {
        colour[i] += share * (m->ambient[i] * l->ambient[i] + maxf(facing, 0.0f) * m->diffuse[i] * l->diffuse[i]);
        shiny[i] += share * highlight * m->specular[i] * l->specular[i];
    }
}

void gl_light_side(const gl_context *c, const gl_material *m, const float eye[4], const float n[3], uint32_t seen,
                   float colour[4], float second[3])
{
    for (int i = 0; i < 3; ++i) {
        colour[i] = m->emission[i] + m->ambient[i] * c->s.lighting.ambient[i];
        second[i] = 0.0f;
    }
    for (int i = 0; i < GL_LIGHTS; ++i) {
        if (gl_is_on(c, CAP_LIGHT + i)) {
            light_add(c, m, &c->s.lighting.light[i], eye, n, (int)(seen >> i & 1u), colour, second);
        }
    }
    colour[3] = m->diffuse[3];
}

void gl_light_receive(float inout[3], const gl_light *l, const float at[3], const float n[3])
{
    float to[3];
    const float share = light_way(l, at, to), facing = light_dot(n, to) * share * LMB_PI;
    for (int i = 0; i < 3 && facing > 0.0f && facing < 1e12f; ++i) {
        inout[i] += facing * maxf(l->diffuse[i], 0.0f);
    }
}

void gl_light_vertex(gl_context *c, const gl_vertex *v, gl_made *made)
{
    float n[3], eye[4] = {made->eye[0], made->eye[1], made->eye[2], 1.0f};
    if (gl_is_on(c, CAP_COLOR_MATERIAL)) {
        light_track(c, v->colour);
    }
    if (made->eye[3] != 1.0f && made->eye[3] != 0.0f) {
        for (int i = 0; i < 3; ++i) {
            eye[i] /= made->eye[3];
        }
    }
    light_normal(c, v->normal, n);
    if (gl_is_on(c, CAP_BOUNCED)) {
        memcpy(made->normal, n, sizeof n);
        memcpy(made->material, c->s.lighting.material, sizeof made->material);
    }
    gl_light_side(c, &c->s.lighting.material[0], eye, n, ~0u, made->colour[0], made->second[0]);
    if (c->s.lighting.two) {
        for (int i = 0; i < 3; ++i) {
            n[i] = -n[i];
        }
        gl_light_side(c, &c->s.lighting.material[1], eye, n, ~0u, made->colour[1], made->second[1]);
    }
    for (int s = 0; s < 2; ++s) {
        for (int i = 0; i < 4; ++i) {
            made->colour[s][i] = gl_unit_range(made->colour[s][i]);
        }
        for (int i = 0; i < 3; ++i) {
            made->second[s][i] = gl_unit_range(made->second[s][i]);
        }
    }
}

/* --- texture coordinates ------------------------------------------------------------------------------------------ */

OP(tex_gen)
{
    const int k = (int)(w[0].u - GL_S);
    CHECK(w[0].u >= GL_S && w[0].u <= GL_Q, GL_INVALID_ENUM)
    gl_gen *g = &c->s.texture.unit[c->s.texture.active].coordinate[k];
    const GLenum mode = (GLenum)gl_int(w[2].f);
    switch (w[1].u) {
    case GL_TEXTURE_GEN_MODE:
        CHECK(mode == GL_OBJECT_LINEAR || mode == GL_EYE_LINEAR || (mode == GL_SPHERE_MAP && k < 2) ||
                  ((mode == GL_REFLECTION_MAP || mode == GL_NORMAL_MAP) && k < 3), GL_INVALID_ENUM)
        g->mode = mode;
        break;
    case GL_OBJECT_PLANE: light_copy(g->object, w + 2, 4); break;
    case GL_EYE_PLANE: {
        float inverse[16];
        if (gl_matrix_invert(inverse, c->modelview.m[c->modelview.top])) {
            for (int i = 0; i < 4; ++i) {
                const float *col = &inverse[4 * i];
                g->eye[i] = w[2].f * col[0] + w[3].f * col[1] + w[4].f * col[2] + w[5].f * col[3];
            }
        }
        break;
    }
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}

static float light_dot4(const float a[4], const float b[4]) { return light_dot(a, b) + a[3] * b[3]; }

void gl_gen_vertex(gl_context *c, const float at[4], const gl_vertex *v, gl_made *made)
{
    for (int u = 0; u < GL_UNITS; ++u) {
        const gl_unit *unit = &c->s.texture.unit[u];
        float *t = made->tex[u];
        if (unit->on == 0 && c->render_mode == GL_RENDER) { /* not read */
            continue;
        }
        memcpy(t, v->tex[u], 4 * sizeof *t);
        if (unit->on == 0) {
            continue;
        }
        if (unit->gen != 0) {
            float n[3], r[3], eye[3] = {made->eye[0], made->eye[1], made->eye[2]};
            light_normal(c, v->normal, n);
            light_normalise(eye);
            const float twice = 2.0f * light_dot(n, eye);
            for (int i = 0; i < 3; ++i) {
                r[i] = eye[i] - n[i] * twice;
            }
            const float root = r[0] * r[0] + r[1] * r[1] + (r[2] + 1.0f) * (r[2] + 1.0f);
            const float m = root > 0.0f ? 0.5f / lmb_sqrt(root) : 0.0f;
            for (int k = 0; k < 4; ++k) {
                const gl_gen *g = &unit->coordinate[k];
                if ((unit->gen >> k & 1u) != 0) {
                    t[k] = g->mode == GL_OBJECT_LINEAR   ? light_dot4(g->object, at)
                           : g->mode == GL_EYE_LINEAR    ? light_dot4(g->eye, made->eye)
                           : g->mode == GL_SPHERE_MAP    ? r[k % 2] * m + 0.5f
                           : g->mode == GL_NORMAL_MAP    ? n[k % 3]
                                                         : r[k % 3];
                }
            }
        }
        const gl_matrices *s = &c->texture[u];
        float in[4];
        memcpy(in, t, sizeof in);
        gl_matrix_point(t, s->m[s->top], in);
    }
}
