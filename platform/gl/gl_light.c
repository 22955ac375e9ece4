/* gl_light.c: lights, materials, the colours of lit vertices, and generated texture coordinates. */
#include "gl_four.h"

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

void gl_light_track(gl_context *c)
{
    if (gl_is_on(c, CAP_COLOR_MATERIAL)) {
        light_track(c, c->s.current.v.colour);
    }
}

OP(colour_material)
{
    const GLenum face = w[0].u, mode = w[1].u;
    CHECK(face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK, GL_INVALID_ENUM)
    CHECK(mode == GL_AMBIENT || mode == GL_DIFFUSE || mode == GL_SPECULAR || mode == GL_EMISSION ||
              mode == GL_AMBIENT_AND_DIFFUSE, GL_INVALID_ENUM)
    gl_light_track(c); /* the old ones stay */
    c->s.lighting.tracks_face = face;
    c->s.lighting.tracks = mode;
    gl_light_track(c);
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

/* --- colours of many vertices ------------------------------------------------------------------------------------- */

/* What the vertices share of a light. Far: the direction is the same for all vertices. */
typedef struct light_lamp {
    const gl_light *light;
    int is_far;
    float to[3], half[3]; /* the direction, of length 1, and that between light and viewer; near: to is the place */
    float share, spot[3], cosine;
} light_lamp;

/* Four vertices. */
typedef struct light_four {
    four eye[3], normal[3], ambient[3], diffuse[4], specular[3], emission[3], shininess, colour[3];
    int is_short; /* 1: no normal is longer than a unit, but for rounding */
} light_four;

static void light_set_lamp(light_lamp *out, const gl_light *l)
{
    const float nowhere[3] = {0.0f, 0.0f, 0.0f};
    out->light = l;
    out->is_far = !(l->position[3] != 0.0f);
    out->share = light_way(l, nowhere, out->to);
    for (int i = 0; i < 3; ++i) {
        out->half[i] = out->to[i] + (i == 2 ? 1.0f : 0.0f);
        out->spot[i] = l->spot[i];
        if (!out->is_far) {
            out->to[i] = l->position[i] / l->position[3];
        }
    }
    light_normalise(out->half);
    light_normalise(out->spot);
    out->cosine = lmb_cos(l->cutoff * (LMB_PI / 180.0f));
}

/* light_way */
static four light_four_way(const light_lamp *lamp, const four eye[3], four to[3])
{
    const gl_light *l = lamp->light;
    if (lamp->is_far) {
        for (int i = 0; i < 3; ++i) {
            to[i] = four_splat(lamp->to[i]);
        }
        return four_splat(lamp->share);
    }
    for (int i = 0; i < 3; ++i) {
        to[i] = lamp->to[i] - eye[i];
    }
    const four distance = four_normalise(to);
    four share = 1.0f / (l->attenuation[0] + distance * (l->attenuation[1] + distance * l->attenuation[2]));
    if (l->cutoff != 180.0f) {
        const four spot[3] = {four_splat(lamp->spot[0]), four_splat(lamp->spot[1]), four_splat(lamp->spot[2])};
        const four cosine = -four_dot(spot, to), zero = four_splat(0.0f);
        share *= FOUR_PICK((cosine < four_splat(lamp->cosine)) | (cosine <= zero), zero,
                           four_pow(cosine, four_splat(l->exponent)));
    }
    return share;
}

static four light_four_highlight(const gl_context *c, const light_lamp *lamp, const light_four *v, const four to[3],
                                 four facing)
{
    const four zero = four_splat(0.0f);
    four half[3];
    for (int i = 0; i < 3; ++i) {
        half[i] = four_splat(lamp->half[i]);
    }
    if (c->s.lighting.local) {
        for (int i = 0; i < 3; ++i) {
            half[i] = -v->eye[i];
        }
        four_normalise(half);
        for (int i = 0; i < 3; ++i) {
            half[i] = to[i] + half[i];
        }
        four_normalise(half);
    } else if (!lamp->is_far) {
        half[0] = to[0] + 0.0f;
        half[1] = to[1] + 0.0f;
        half[2] = to[2] + 1.0f;
        four_normalise(half);
    }
    const four cosine = four_dot(v->normal, half);
    const four highlight =
        FOUR_PICK((cosine > zero) | (v->shininess == zero), four_pow(cosine, v->shininess), zero);
    return FOUR_PICK(facing > zero, highlight, zero);
}

/* light_add */
static void light_four_add(const gl_context *c, const light_lamp *lamp, light_four *v)
{
    const gl_light *l = lamp->light;
    const four zero = four_splat(0.0f);
    four to[3];
    const four share = light_four_way(lamp, v->eye, to), facing = four_dot(v->normal, to),
               faced = FOUR_PICK(facing > zero, facing, zero);
    four_int dull = share <= four_splat(1e37f);
    for (int i = 0; i < 3; ++i) {
        dull &= v->specular[i] * l->specular[i] == zero;
    }
    const int is_shiny = !v->is_short || !four_all(dull); /* otherwise it is finite and has no colour */
    const four highlight = is_shiny ? light_four_highlight(c, lamp, v, to, facing) : zero;
    for (int i = 0; i < 3; ++i) {
        four sum = v->colour[i] + share * (v->ambient[i] * l->ambient[i] + faced * v->diffuse[i] * l->diffuse[i]);
        if (is_shiny) {
            sum += share * highlight * v->specular[i] * l->specular[i];
        }
        v->colour[i] = FOUR_PICK(share == zero, v->colour[i], sum);
    }
}

/* Sets the materials of four vertices. */
static void light_four_material(light_four *v, const gl_material *const m[FOUR])
{
    float of[14][FOUR];
    for (int k = 0; k < FOUR; ++k) {
        for (int i = 0; i < 3; ++i) {
            of[i][k] = m[k]->ambient[i];
            of[3 + i][k] = m[k]->specular[i];
            of[6 + i][k] = m[k]->emission[i];
        }
        for (int i = 0; i < 4; ++i) {
            of[9 + i][k] = m[k]->diffuse[i];
        }
        of[13][k] = m[k]->shininess;
    }
    for (int i = 0; i < 3; ++i) {
        v->ambient[i] = four_load(of[i]);
        v->specular[i] = four_load(of[3 + i]);
        v->emission[i] = four_load(of[6 + i]);
    }
    for (int i = 0; i < 4; ++i) {
        v->diffuse[i] = four_load(of[9 + i]);
    }
    v->shininess = four_load(of[13]);
}

/* Normals and places of vertices `at` with looks `look`; colours with GL_COLOR_MATERIAL. */
static void light_four_set(gl_context *c, light_four *v, const int32_t at[FOUR], const int32_t look[FOUR])
{
    float of[7][FOUR];
    for (int k = 0; k < FOUR; ++k) {
        for (int i = 0; i < 3; ++i) {
            of[i][k] = c->look[look[k]].normal[i];
        }
        for (int i = 0; i < 4; ++i) {
            of[3 + i][k] = c->eye_of[at[k]][i];
        }
    }
    const four in[3] = {four_load(of[0]), four_load(of[1]), four_load(of[2])}, w = four_load(of[6]);
    for (int i = 0; i < 3; ++i) {
        const float *m = &c->normal_matrix[3 * i];
        const four eye = four_load(of[3 + i]);
        v->normal[i] = m[0] * in[0] + m[1] * in[1] + m[2] * in[2];
        v->eye[i] = FOUR_PICK(w == four_splat(0.0f), eye, eye / w);
    }
    if (gl_is_on(c, CAP_NORMALIZE)) {
        four_normalise(v->normal);
    } else if (gl_is_on(c, CAP_RESCALE)) {
        for (int i = 0; i < 3; ++i) {
            v->normal[i] *= c->eye_scale;
        }
    }
    v->is_short = four_all(four_dot(v->normal, v->normal) <= four_splat(1.02f));
    if (gl_is_on(c, CAP_COLOR_MATERIAL)) {
        gl_material m[FOUR];
        const gl_material *all[FOUR];
        for (int k = 0; k < FOUR; ++k) {
            light_track(c, c->look[look[k]].colour);
            m[k] = c->s.lighting.material[0];
            all[k] = &m[k];
        }
        light_four_material(v, all);
    }
}

/* The codes of four vertices. */
static four_bits light_four_codes(gl_context *c, light_four *v, const light_lamp *lamp, int lamps)
{
    for (int i = 0; i < 3; ++i) {
        v->colour[i] = v->emission[i] + v->ambient[i] * c->s.lighting.ambient[i];
    }
    for (int i = 0; i < lamps; ++i) {
        light_four_add(c, &lamp[i], v);
    }
    four_bits codes = four_code(four_range(v->diffuse[3]), 3);
    for (int i = 0; i < 3; ++i) {
        codes |= four_code(four_range(v->colour[i]), i);
    }
    return codes;
}

void gl_light_codes(gl_context *c, int32_t from)
{
    const gl_material *all[FOUR];
    light_lamp lamp[GL_LIGHTS];
    light_four v;
    int lamps = 0, far = !c->s.lighting.local;
    for (int i = 0; i < GL_LIGHTS; ++i) {
        if (gl_is_on(c, CAP_LIGHT + i)) {
            light_set_lamp(&lamp[lamps], &c->s.lighting.light[i]);
            far &= lamp[lamps++].is_far;
        }
    }
    for (int i = 0; i < FOUR; ++i) {
        all[i] = &c->s.lighting.material[0];
    }
    gl_update_matrices(c);
    light_four_material(&v, all);
    int32_t k = 0;
    for (int32_t i = from; i < c->count;) {
        int32_t at[FOUR], look[FOUR], past[FOUR]; /* the codes of at[n] are those of all vertices before past[n] */
        int n = 0;
        for (; n < FOUR && i < c->count; ++n) {
            while (k + 1 < c->looks && c->look_from[k + 1] <= i) {
                ++k;
            }
            at[n] = i;
            look[n] = k;
            i = far ? (k + 1 < c->looks ? c->look_from[k + 1] : c->count) : i + 1;
            past[n] = i;
        }
        for (int m = n; m < FOUR; ++m) {
            at[m] = at[n - 1];
            look[m] = look[n - 1];
        }
        light_four_set(c, &v, at, look);
        uint8_t codes[FOUR][4];
        four_save_codes(codes, light_four_codes(c, &v, lamp, lamps), FOUR);
        for (int m = 0; m < n; ++m) {
            for (int32_t to = at[m]; to < past[m]; ++to) {
                memcpy(c->colour_of[to], codes[m], sizeof codes[m]);
            }
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
