/* gl_fragment.c: a pixel's colour if draw.h's own stages are not enough: textures of all kinds, texture environments,
 * two sides, colour sums, fog and stipples. Values are 0 .. 1 until the end. */
#include "gl_wide.h"

typedef struct fragment_texel {
    float v[4];
} fragment_texel;

/* --- texels ------------------------------------------------------------------------------------------------------- */

/* Texel (i, j, k), each -1 .. size: the border outside. */
static void fragment_fetch(float out[4], const gl_texture *t, const gl_image *m, int32_t i, int32_t j, int32_t k)
{
    const int32_t b = m->border, w = m->width + 2 * b,
                  h = m->height + (m->height > 1 || t->target != TARGET_1D ? 2 * b : 0);
    const int32_t bj = t->target == TARGET_1D ? 0 : b, bk = t->target == TARGET_3D ? b : 0;
    if (i < -b || j < -bj || k < -bk || i >= m->width + b || j >= m->height + bj || k >= m->depth + bk) {
        memcpy(out, t->border, 4 * sizeof *out);
        if (m->base == GL_LUMINANCE || m->base == GL_LUMINANCE_ALPHA || m->base == GL_INTENSITY) {
            out[1] = out[2] = out[0];
        }
        out[3] = m->base == GL_INTENSITY ? out[0] : m->base == GL_LUMINANCE || m->base == GL_RGB ? 1.0f : out[3];
        return;
    }
    const size_t at =
        ((size_t)(k + bk) * (size_t)(m->height + 2 * bj) + (size_t)(j + bj)) * (size_t)w + (size_t)(i + b);
    (void)h;
    if (m->base == GL_DEPTH_COMPONENT) {
        float d;
        memcpy(&d, m->texels + 4 * at, sizeof d);
        out[0] = out[1] = out[2] = d;
        out[3] = 1.0f;
        return;
    }
    const uint8_t *p = m->texels + 4 * at;
    for (int n = 0; n < 4; ++n) {
        out[n] = (float)p[n] * (1.0f / 255.0f);
    }
}

/* Converts a coordinate to texels of a side, before rounding down. */
static float fragment_place(float s, int32_t size, GLenum wrap)
{
    const float n = (float)size;
    if (!(s > -1e9f && s < 1e9f)) {
        s = 0.0f;
    }
    switch (wrap) {
    case GL_CLAMP: return clampf(s, 0.0f, 1.0f) * n;
    case GL_CLAMP_TO_EDGE: return clampf(s * n, 0.5f, n - 0.5f);
    case GL_CLAMP_TO_BORDER: return clampf(s * n, -0.5f, n + 0.5f);
    case GL_MIRRORED_REPEAT: {
        const float half = s * 0.5f, f = 2.0f * (half - floorf(half));
        return clampf((f > 1.0f ? 2.0f - f : f) * n, 0.5f, n - 0.5f);
    }
    default: return (s - floorf(s)) * n;
    }
}

static int32_t fragment_wrap(int32_t i, int32_t size, GLenum wrap)
{
    return wrap != GL_REPEAT ? i : i < 0 ? i + size : i >= size ? i - size : i;
}

static float fragment_compare(const gl_texture *t, float r, float d)
{
    switch (t->compare_func) {
    case GL_LEQUAL: return r <= d ? 1.0f : 0.0f;
    case GL_GEQUAL: return r >= d ? 1.0f : 0.0f;
    case GL_LESS: return r < d ? 1.0f : 0.0f;
    case GL_GREATER: return r > d ? 1.0f : 0.0f;
    case GL_EQUAL: return r == d ? 1.0f : 0.0f;
    case GL_NOTEQUAL: return r != d ? 1.0f : 0.0f;
    case GL_ALWAYS: return 1.0f;
    default: return 0.0f;
    }
}

static void fragment_add(float out[4], const gl_texture *t, const gl_image *m, int32_t i, int32_t j, int32_t k,
                         float share, float r)
{
    float v[4];
    if (share == 0.0f) {
        return;
    }
    fragment_fetch(v, t, m, i, j, k);
    if (m->base == GL_DEPTH_COMPONENT && t->compare_mode != GL_NONE) {
        v[0] = v[1] = v[2] = fragment_compare(t, r, v[0]);
    }
    for (int n = 0; n < 4; ++n) {
        out[n] += share * v[n];
    }
}

/* One level. c: s, t, r. */
static void fragment_level(float out[4], const gl_texture *t, const gl_image *m, const float c[3], int linear, float r)
{
    const int dims = t->target == TARGET_1D ? 1 : t->target == TARGET_3D ? 3 : 2;
    const int32_t size[3] = {m->width, m->height, m->depth};
    int32_t at[3][2] = {{0, 0}, {0, 0}, {0, 0}};
    float share[3] = {0.0f, 0.0f, 0.0f};
    for (int d = 0; d < dims; ++d) {
        const GLenum wrap = t->target == TARGET_CUBE && t->wrap[d] == GL_REPEAT ? GL_CLAMP_TO_EDGE : t->wrap[d];
        const float u = fragment_place(c[d], size[d], wrap);
        if (linear) {
            const float low = floorf(u - 0.5f);
            at[d][0] = fragment_wrap((int32_t)low, size[d], wrap);
            at[d][1] = fragment_wrap((int32_t)low + 1, size[d], wrap);
            share[d] = u - 0.5f - low;
        } else {
            int32_t i = (int32_t)floorf(u);
            i = wrap == GL_CLAMP_TO_BORDER ? i : mini(i, size[d] - 1);
            at[d][0] = i;
        }
    }
    memset(out, 0, 4 * sizeof *out);
    if (!linear) {
        fragment_add(out, t, m, at[0][0], at[1][0], at[2][0], 1.0f, r);
        return;
    }
    for (int n = 0; n < 1 << dims; ++n) {
        const float w = ((n & 1) != 0 ? share[0] : 1.0f - share[0]) *
                        (dims < 2 ? 1.0f : (n & 2) != 0 ? share[1] : 1.0f - share[1]) *
                        (dims < 3 ? 1.0f : (n & 4) != 0 ? share[2] : 1.0f - share[2]);
        fragment_add(out, t, m, at[0][n & 1], at[1][n >> 1 & 1], at[2][n >> 2 & 1], w, r);
    }
}

/* --- which texels ------------------------------------------------------------------------------------------------- */

/* The face that a direction hits, and the coordinates in that face. */
static int fragment_cube_face(const float d[3])
{
    const float x = absf(d[0]), y = absf(d[1]), z = absf(d[2]);
    return x >= y && x >= z ? (d[0] >= 0.0f ? 0 : 1) : y >= z ? (d[1] >= 0.0f ? 2 : 3) : (d[2] >= 0.0f ? 4 : 5);
}

static void fragment_cube_place(float out[3], int face, const float d[3])
{
    static const int8_t axis[6][3] = {{0, -3, -2}, {0, 3, -2}, {1, 1, 3}, {1, 1, -3}, {2, 1, -2}, {2, -1, -2}};
    const int8_t *a = axis[face];
    const float major = absf(d[a[0]]), by = major > 0.0f ? 0.5f / major : 0.0f;
    const float s = a[1] < 0 ? -d[-a[1] - 1] : d[a[1] - 1], t = a[2] < 0 ? -d[-a[2] - 1] : d[a[2] - 1];
    out[0] = s * by + 0.5f;
    out[1] = t * by + 0.5f;
    out[2] = 0.0f;
}

/* A unit's coordinates at a pixel, and one pixel further in x and y. */
typedef struct fragment_coords {
    float at[3], x[3], y[3];
    float r; /* for shadows */
    int face;
} fragment_coords;

/* Coordinates of a texture; a rectangle's count texels. */
static void fragment_project(float out[3], const float v[4], const gl_texture *t)
{
    const float by = v[3] == 1.0f ? 1.0f : v[3] != 0.0f ? 1.0f / v[3] : 0.0f;
    for (int i = 0; i < 3; ++i) {
        out[i] = v[i] * by;
    }
    if (t != NULL && t->target == TARGET_RECT) {
        out[0] /= (float)t->image[0][0].width;
        out[1] /= (float)t->image[0][0].height;
    }
}

static float fragment_texels(const gl_image *m, const float a[3], const float b[3])
{
    const float x = (b[0] - a[0]) * (float)m->width, y = (b[1] - a[1]) * (float)m->height,
                z = (b[2] - a[2]) * (float)m->depth;
    return x * x + (m->height > 1 ? y * y : 0.0f) + (m->depth > 1 ? z * z : 0.0f);
}

static void fragment_sample(float out[4], const gl_context *c, const gl_texture *t, int unit, const fragment_coords *u)
{
    const gl_image *base = &t->image[u->face][t->base_level];
    const GLenum f = t->min_filter;
    const int mips = f != GL_NEAREST && f != GL_LINEAR;
    if (!mips && f == t->mag_filter) {
        fragment_level(out, t, base, u->at, f == GL_LINEAR, u->r);
        return;
    }
    const float square = maxf(fragment_texels(base, u->at, u->x), fragment_texels(base, u->at, u->y));
    float lambda = 0.5f * lmb_log2(square) + clampf(c->s.texture.unit[unit].lod_bias + t->lod_bias, -16.0f, 16.0f);
    lambda = minf(maxf(lambda, t->min_lod), t->max_lod);
    const float enough =
        t->mag_filter == GL_LINEAR && (f == GL_NEAREST_MIPMAP_NEAREST || f == GL_NEAREST_MIPMAP_LINEAR) ? 0.5f : 0.0f;
    if (lambda <= enough) {
        fragment_level(out, t, base, u->at, t->mag_filter == GL_LINEAR, u->r);
        return;
    }
    const int linear = f == GL_LINEAR || f == GL_LINEAR_MIPMAP_NEAREST || f == GL_LINEAR_MIPMAP_LINEAR;
    if (!mips) {
        fragment_level(out, t, base, u->at, linear, u->r);
        return;
    }
    const int32_t largest = maxi(maxi(base->width, base->height), base->depth);
    int32_t last = t->base_level;
    for (int32_t n = largest; n > 1; n /= 2) {
        ++last;
    }
    last = mini(mini(last, t->max_level), GL_LEVELS - 1);
    const float deepest = (float)(last - t->base_level);
    lambda = minf(lambda, deepest);
    if (f == GL_NEAREST_MIPMAP_NEAREST || f == GL_LINEAR_MIPMAP_NEAREST) {
        const int32_t n =
            t->base_level + (lambda <= 0.5f ? 0 : mini((int32_t)(lambda + 0.49999997f), last - t->base_level));
        fragment_level(out, t, &t->image[u->face][n], u->at, linear, u->r);
        return;
    }
    const int32_t n = (int32_t)lambda;
    const float share = lambda - (float)n;
    fragment_level(out, t, &t->image[u->face][t->base_level + n], u->at, linear, u->r);
    if (share > 0.0f && t->base_level + n < last) {
        float more[4];
        fragment_level(more, t, &t->image[u->face][t->base_level + n + 1], u->at, linear, u->r);
        for (int i = 0; i < 4; ++i) {
            out[i] += share * (more[i] - out[i]);
        }
    }
}

/* --- environments ------------------------------------------------------------------------------------------------- */

/* Adapts a unit's texel to the base format. */
static GLenum fragment_base(const gl_texture *t)
{
    const gl_image *m = &t->image[0][t->base_level];
    return m->base == GL_DEPTH_COMPONENT ? t->depth_mode : m->base;
}

static void fragment_spread(float v[4], GLenum depth_mode)
{
    const float d = v[0];
    v[0] = v[1] = v[2] = depth_mode == GL_ALPHA ? 0.0f : d;
    v[3] = depth_mode == GL_LUMINANCE ? 1.0f : d;
}

static void fragment_swizzle(float v[4], const GLenum order[4])
{
    float from[4];
    memcpy(from, v, sizeof from);
    for (int i = 0; i < 4; ++i) {
        v[i] = order[i] >= GL_RED ? from[order[i] - GL_RED] : order[i] == GL_ONE ? 1.0f : 0.0f;
    }
}

static void fragment_classic(float c[4], const gl_unit *u, GLenum base, const float t[4])
{
    const int colours = base != GL_ALPHA,
              alphas = base == GL_ALPHA || base == GL_LUMINANCE_ALPHA || base == GL_RGBA || base == GL_INTENSITY;
    for (int i = 0; i < 3 && colours; ++i) {
        switch (u->mode) {
        case GL_REPLACE: c[i] = t[i]; break;
        case GL_DECAL:
            c[i] = base == GL_RGBA ? c[i] * (1.0f - t[3]) + t[i] * t[3] : base == GL_RGB ? t[i] : c[i];
            break;
        case GL_BLEND: c[i] = c[i] * (1.0f - t[i]) + u->colour[i] * t[i]; break;
        case GL_ADD: c[i] = minf(c[i] + t[i], 1.0f); break;
        default: c[i] *= t[i]; break;
        }
    }
    if (alphas && u->mode != GL_DECAL) {
        c[3] = u->mode == GL_REPLACE                          ? t[3]
               : base == GL_INTENSITY && u->mode == GL_BLEND ? c[3] * (1.0f - t[3]) + u->colour[3] * t[3]
               : base == GL_INTENSITY && u->mode == GL_ADD   ? minf(c[3] + t[3], 1.0f)
                                                             : c[3] * t[3];
    }
}

static void fragment_combine(float c[4], const gl_unit *u, const float primary[4], const float texels[GL_UNITS][4],
                             int unit)
{
    float arg[2][3][4], out[4];
    for (int half = 0; half < 2; ++half) {
        for (int n = 0; n < 3; ++n) {
            const GLenum from = u->source[half][n], how = u->operand[half][n];
            const float *v = from == GL_TEXTURE ? texels[unit]
                             : from >= GL_TEXTURE0 && from < GL_TEXTURE0 + GL_UNITS ? texels[from - GL_TEXTURE0]
                             : from == GL_CONSTANT ? u->colour : from == GL_PRIMARY_COLOR ? primary : c;
            for (int i = 0; i < 4; ++i) {
                const float x = how == GL_SRC_ALPHA || how == GL_ONE_MINUS_SRC_ALPHA ? v[3] : v[i];
                arg[half][n][i] = how == GL_ONE_MINUS_SRC_COLOR || how == GL_ONE_MINUS_SRC_ALPHA ? 1.0f - x : x;
            }
        }
    }
    const float dot =
        4.0f * ((arg[0][0][0] - 0.5f) * (arg[0][1][0] - 0.5f) + (arg[0][0][1] - 0.5f) * (arg[0][1][1] - 0.5f) +
                (arg[0][0][2] - 0.5f) * (arg[0][1][2] - 0.5f));
    for (int i = 0; i < 4; ++i) {
        const int half = i == 3;
        const float a = arg[half][0][i], b = arg[half][1][i], d = arg[half][2][i];
        float v;
        switch (u->combine[half]) {
        case GL_REPLACE: v = a; break;
        case GL_ADD: v = a + b; break;
        case GL_ADD_SIGNED: v = a + b - 0.5f; break;
        case GL_INTERPOLATE: v = a * d + b * (1.0f - d); break;
        case GL_SUBTRACT: v = a - b; break;
        case GL_DOT3_RGB: case GL_DOT3_RGBA: v = dot; break;
        default: v = a * b; break;
        }
        out[i] = u->combine[0] == GL_DOT3_RGBA && i == 3 ? gl_unit_range(dot * u->scale[0])
                                                         : gl_unit_range(v * u->scale[half]);
    }
    memcpy(c, out, sizeof out);
}

/* Applies all units to a colour. */
static void fragment_texture(float colour[4], const gl_context *c, const fragment_coords u[GL_UNITS])
{
    float texels[GL_UNITS][4], primary[4];
    memcpy(primary, colour, sizeof primary);
    for (int i = 0; i < GL_UNITS; ++i) {
        const gl_texture *t = gl_unit_is_on(c, i) ? gl_unit_texture(c, i) : NULL;
        texels[i][0] = texels[i][1] = texels[i][2] = 0.0f;
        texels[i][3] = 1.0f;
        if (t != NULL) {
            fragment_sample(texels[i], c, t, i, &u[i]);
            if (t->image[0][t->base_level].base == GL_DEPTH_COMPONENT) {
                fragment_spread(texels[i], t->depth_mode);
            } else if (t->image[0][t->base_level].base == GL_ALPHA) {
                texels[i][0] = texels[i][1] = texels[i][2] = 0.0f;
            }
            fragment_swizzle(texels[i], t->swizzle);
        }
    }
    for (int i = 0; i < GL_UNITS; ++i) {
        const gl_unit *unit = &c->s.texture.unit[i];
        if (!gl_unit_is_on(c, i)) {
            continue;
        }
        if (unit->mode == GL_COMBINE) {
            fragment_combine(colour, unit, primary, (const float(*)[4])texels, i);
        } else {
            fragment_classic(colour, unit, fragment_base(gl_unit_texture(c, i)), texels[i]);
        }
    }
}

static void fragment_fog(float colour[4], const gl_context *c, float z)
{
    float f;
    switch (c->s.fog.mode) {
    case GL_LINEAR:
        f = c->s.fog.end == c->s.fog.start ? (z < c->s.fog.end ? 1.0f : 0.0f)
                                           : (c->s.fog.end - z) / (c->s.fog.end - c->s.fog.start);
        break;
    case GL_EXP: f = lmb_exp2(-c->s.fog.density * z * 1.44269504f); break;
    default: f = lmb_exp2(-(c->s.fog.density * z) * (c->s.fog.density * z) * 1.44269504f); break;
    }
    f = gl_unit_range(f);
    for (int i = 0; i < 3; ++i) {
        colour[i] = f * colour[i] + (1.0f - f) * c->s.fog.colour[i];
    }
}

/* --- a pixel ------------------------------------------------------------------------------------------------------ */

static float fragment_mix(float a, float b, float d, const float share[2])
{
    return a + (share[0] * (b - a) + share[1] * (d - a));
}

static void fragment_coordinates(fragment_coords *out, const gl_texture *t, const gl_made *const m[3], int unit,
                                 const lmb_draw_fragment_at *f)
{
    const float *p = m[0]->tex[unit], *q = m[1]->tex[unit], *r = m[2]->tex[unit];
    float at[4], x[4], y[4];
    for (int i = 0; i < 4; ++i) {
        at[i] = fragment_mix(p[i], q[i], r[i], f->share);
        x[i] = at[i] + (f->by_x[0] * (q[i] - p[i]) + f->by_x[1] * (r[i] - p[i]));
        y[i] = at[i] + (f->by_y[0] * (q[i] - p[i]) + f->by_y[1] * (r[i] - p[i]));
    }
    out->face = 0;
    if (t->target == TARGET_CUBE) {
        out->face = fragment_cube_face(at);
        fragment_cube_place(out->at, out->face, at);
        fragment_cube_place(out->x, out->face, x);
        fragment_cube_place(out->y, out->face, y);
        out->r = gl_unit_range(at[3]);
        return;
    }
    fragment_project(out->at, at, t);
    fragment_project(out->x, x, t);
    fragment_project(out->y, y, t);
    out->r = gl_unit_range(out->at[2]);
}

/* Coordinates of a point sprite's pixel. */
static void fragment_sprite(fragment_coords *u, const gl_context *c, const gl_made *m, int32_t x, int32_t y)
{
    float at[3];
    gl_window_place(c, m->clip, at);
    const float px = floorf(m->size + 0.5f);
    u->at[0] = gl_unit_range(0.5f + ((float)x + 0.5f - at[0]) / px);
    u->at[1] = gl_unit_range(0.5f - ((float)y + 0.5f - at[1]) / px);
    if (c->s.point.origin == GL_LOWER_LEFT) {
        u->at[1] = 1.0f - u->at[1];
    }
    u->at[2] = u->r = 0.0f;
    memcpy(u->x, u->at, sizeof u->x);
    memcpy(u->y, u->at, sizeof u->y);
    u->x[0] += 1.0f / px;
    u->y[1] += 1.0f / px;
    u->face = 0;
}

/* Returns whether a stipple leaves the pixel out. */
static int fragment_is_out(const gl_context *c, int is_line, int is_area, int32_t x, int32_t y)
{
    if (is_area && gl_is_on(c, CAP_POLYGON_STIPPLE)) {
        return (c->s.stipple.bits[(y & 31) * 4 + (x & 31) / 8] >> (7 - (x & 7)) & 1) == 0;
    }
    if (is_line && gl_is_on(c, CAP_LINE_STIPPLE)) {
        const float along = absf((float)(c->line_steep ? y : x) + 0.5f - c->line_from[c->line_steep]);
        const int32_t n = c->stipple_at + (along < 1e6f ? (int32_t)along : 0);
        return (c->s.line.pattern >> (n / c->s.line.factor % 16) & 1u) == 0;
    }
    return 0;
}

/* --- pixels by lanes ---------------------------------------------------------------------------------------------- */

/* Returns 1 if gl_wide.h has the kind of a unit: 2D textures of any filter and wrap. */
static int fragment_unit_is_wide(const gl_texture *t)
{
    const gl_image *m = &t->image[0][t->base_level];
    int plain = t->target == TARGET_2D && m->border == 0 && m->base != GL_DEPTH_COMPONENT;
    for (int i = 0; i < 4; ++i) {
        plain &= t->swizzle[i] == GL_RED + (GLenum)i;
    }
    return plain;
}

static int fragment_is_wide(const gl_context *c)
{
    int wide = c->wide != NULL;
    for (int i = 0; i < GL_UNITS && wide; ++i) {
        wide = !gl_unit_is_on(c, i) || fragment_unit_is_wide(gl_unit_texture(c, i));
    }
    return wide;
}

static gl_wide_value fragment_value_of(float a, float b, float d)
{
    const gl_wide_value v = {a, b - a, d - a};
    return v;
}

static int fragment_is_all(const gl_wide_value *v, float of)
{
    return v->at == of && v->more1 == 0.0f && v->more2 == 0.0f;
}

static void fragment_set_unit(gl_wide_unit *out, const gl_context *c, const gl_made *const m[3], int unit)
{
    const gl_texture *t = gl_unit_texture(c, unit);
    const float *p = m[0]->tex[unit], *q = m[1]->tex[unit], *r = m[2]->tex[unit];
    out->texture = t;
    out->number = unit;
    out->unit = &c->s.texture.unit[unit];
    out->base = fragment_base(t);
    out->s = fragment_value_of(p[0], q[0], r[0]);
    out->t = fragment_value_of(p[1], q[1], r[1]);
    out->q = fragment_value_of(p[3], q[3], r[3]);
    out->divides = !fragment_is_all(&out->q, 1.0f);
    out->has_levels = t->min_filter != t->mag_filter;
    out->bias = clampf(out->unit->lod_bias + t->lod_bias, -16.0f, 16.0f);
}

static void fragment_set_job(gl_wide_job *out, const gl_context *c, const gl_made *const m[3], int side)
{
    out->context = c;
    out->adds = 0;
    out->fogs = gl_is_on(c, CAP_FOG);
    for (int i = 0; i < 4; ++i) {
        out->colour[i] = fragment_value_of(m[0]->colour[side][i], m[1]->colour[side][i], m[2]->colour[side][i]);
    }
    for (int i = 0; i < 3; ++i) {
        out->second[i] = fragment_value_of(m[0]->second[side][i], m[1]->second[side][i], m[2]->second[side][i]);
        out->adds |= !fragment_is_all(&out->second[i], 0.0f);
    }
    out->fog = fragment_value_of(m[0]->fog, m[1]->fog, m[2]->fog);
    out->units = 0;
    out->combines = 0;
    for (int i = 0; i < GL_UNITS; ++i) {
        if (gl_unit_is_on(c, i)) {
            out->combines |= c->s.texture.unit[i].mode == GL_COMBINE;
            fragment_set_unit(&out->unit[out->units++], c, m, i);
        }
    }
}

/* Pixels of a primitive without stipples, point sprites and bounced light. */
static void fragment_wide(const gl_context *c, const lmb_draw_pixels_of *p, const gl_made *const m[3], int side,
                          uint8_t out[64][4])
{
    gl_wide_job job;
    int has_levels = 0;
    fragment_set_job(&job, c, m, side);
    for (int i = 0; i < job.units; ++i) {
        has_levels |= job.unit[i].has_levels;
    }
    lmb_draw_shares(job.share, p);
    if (has_levels) {
        lmb_draw_steps(job.by_x, job.by_y, p);
    }
    c->wide(out, &job, p->mask);
}

/* --- the shader --------------------------------------------------------------------------------------------------- */

uint64_t gl_shade_pixels(void *user, const lmb_draw_pixels_of *p, uint8_t out[64][4])
{
    const gl_context *c = user;
    const gl_made *m[3] = {&c->made[p->vertex[0]], &c->made[p->vertex[1]], &c->made[p->vertex[2]]};
    const int is_point = m[0] == m[1], is_line = !is_point && m[0] == m[2], is_area = !is_point && !is_line;
    const int side =
        gl_is_on(c, CAP_LIGHTING) && c->s.lighting.two ? (is_area ? p->is_back : c->is_side && c->side) : 0;
    const int fogs = gl_is_on(c, CAP_FOG), sprites = is_point && gl_is_on(c, CAP_POINT_SPRITE);
    const int bounces = is_area && c->bounces;
    uint64_t kept = p->mask;
    if (!bounces && !sprites && !(is_line && gl_is_on(c, CAP_LINE_STIPPLE)) &&
        !(is_area && gl_is_on(c, CAP_POLYGON_STIPPLE)) && fragment_is_wide(c)) {
        fragment_wide(c, p, m, side, out);
        return kept;
    }
    fragment_coords u[GL_UNITS];
    float lit[64][4], second[64][3];
    if (bounces) {
        gl_bounce_pixels(c, p, m, side, lit, second);
    }
    for (uint64_t bits = p->mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const int32_t x = p->x + (k & 7), y = p->y + (k >> 3);
        lmb_draw_fragment_at f;
        float colour[4];
        if (fragment_is_out(c, is_line, is_area, x, y)) {
            kept &= ~((uint64_t)1 << k);
            continue;
        }
        lmb_draw_fragment(&f, p, k);
        for (int i = 0; i < 4; ++i) {
            colour[i] = bounces ? lit[k][i] : fragment_mix(m[0]->colour[side][i], m[1]->colour[side][i],
                                                           m[2]->colour[side][i], f.share);
        }
        for (int i = 0; i < GL_UNITS; ++i) {
            if (gl_unit_is_on(c, i)) {
                if (sprites && c->s.texture.unit[i].replaces) {
                    fragment_sprite(&u[i], c, m[0], x, y);
                } else {
                    fragment_coordinates(&u[i], gl_unit_texture(c, i), m, i, &f);
                }
            }
        }
        fragment_texture(colour, c, u);
        for (int i = 0; i < 3; ++i) {
            colour[i] += bounces ? second[k][i] : fragment_mix(m[0]->second[side][i], m[1]->second[side][i],
                                                               m[2]->second[side][i], f.share);
            colour[i] = gl_unit_range(colour[i]);
        }
        if (fogs) {
            fragment_fog(colour, c, fragment_mix(m[0]->fog, m[1]->fog, m[2]->fog, f.share));
        }
        for (int i = 0; i < 4; ++i) {
            out[k][i] = gl_code(colour[i]);
        }
    }
    return kept;
}

/* The colour of a bitmap's or an image's pixels: textures and fog at the raster position. */
void gl_shade_raster(const gl_context *c, float colour[4])
{
    fragment_coords u[GL_UNITS];
    for (int i = 0; i < GL_UNITS; ++i) {
        const float *t = c->s.current.raster_tex[i];
        const gl_texture *texture = gl_unit_is_on(c, i) ? gl_unit_texture(c, i) : NULL;
        u[i].face = 0;
        if (texture != NULL && texture->target == TARGET_CUBE) {
            u[i].face = fragment_cube_face(t);
            fragment_cube_place(u[i].at, u[i].face, t);
        } else {
            fragment_project(u[i].at, t, texture);
        }
        memcpy(u[i].x, u[i].at, sizeof u[i].x);
        memcpy(u[i].y, u[i].at, sizeof u[i].y);
        u[i].r = gl_unit_range(u[i].at[2]);
    }
    fragment_texture(colour, c, u);
    for (int i = 0; i < 3; ++i) {
        colour[i] = gl_unit_range(colour[i] + c->s.current.raster_second[i]);
    }
    if (gl_is_on(c, CAP_FOG)) {
        fragment_fog(colour, c, c->s.current.raster_distance);
    }
}
