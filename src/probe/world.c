/* world.c: the world's pictures -> coded texels and their levels, in the caller's memory. Layer 6.          [S1-S4] */
#include <string.h>

#include "../base/memory_check.h"
#include "../base/poly.h"
#include "../map/cube.h"
#include "world.h"

/* Radiance that is coded as 0 or 1, and log2 of 10. */
#define LOG_SHIFT 0.101f
#define LOG_MAX 99.899f
#define LOG2_10 3.32192809f

float lmb_world_encode(float c)
{
    c = c > 0.0f ? minf(c, LOG_MAX) : 0.0f;
    return clampf((lmb_log2(c + LOG_SHIFT) * (1.0f / LOG2_10) + 1.0f) * (1.0f / 3.0f), 0.0f, 1.0f);
}

float lmb_world_decode(float e)
{
    e = e > 0.0f ? minf(e, 1.0f) : 0.0f;
    return maxf(lmb_exp2((3.0f * e - 1.0f) * LOG2_10) - LOG_SHIFT, 0.0f);
}

/* --- sizes -------------------------------------------------------------------------------------------------------- */

static size_t texel_bytes(int32_t format) { return format == LMB_WORLD_LOG8 ? 4 : format == LMB_WORLD_LOG16 ? 8 : 16; }

static int is_valid(const lmb_world_pictures *p, int32_t format)
{
    return p != NULL && format >= LMB_WORLD_F32 && format <= LMB_WORLD_LOG8 && p->face_size >= 1 &&
           p->face_size <= 4096 &&
           (p->ground == NULL || (p->ground_width >= 1 && p->ground_width <= 8192 && p->ground_height >= 1 &&
                                  p->ground_height <= 8192));
}

/* The faces' levels from texel *end on, which moves behind them; returns how many. */
static int32_t set_cube(lmb_world_level out[LMB_WORLD_LEVELS], size_t *end, const lmb_world_pictures *p)
{
    int32_t count = 0;
    for (int32_t n = p->face_size; n >= 1 && count < LMB_WORLD_LEVELS; n /= 2) {
        const lmb_world_level level = {(uint32_t)*end, n, n};
        out[count++] = level;
        *end += 6 * (size_t)(n + 2) * (size_t)(n + 2);
    }
    return count;
}

/* The same of the ground's; 0 without one. */
static int32_t set_ground(lmb_world_level out[LMB_WORLD_LEVELS], size_t *end, const lmb_world_pictures *p)
{
    int32_t count = 0;
    for (int32_t x = p->ground_width, y = p->ground_height; p->ground != NULL && count < LMB_WORLD_LEVELS;) {
        const lmb_world_level level = {(uint32_t)*end, x, y};
        out[count++] = level;
        *end += (size_t)x * (size_t)y;
        if (x == 1 && y == 1) {
            break;
        }
        x = maxi(x / 2, 1);
        y = maxi(y / 2, 1);
    }
    return count;
}

size_t lmb_world_bytes(const lmb_world_pictures *pictures, int32_t format)
{
    lmb_world_level level[LMB_WORLD_LEVELS];
    size_t texels = 0;
    if (!is_valid(pictures, format)) {
        return 0;
    }
    set_cube(level, &texels, pictures);
    set_ground(level, &texels, pictures);
    return texels * texel_bytes(format);
}

/* --- texels ------------------------------------------------------------------------------------------------------- */

static int32_t code_of(float e, float steps) { return (int32_t)(e * steps + 0.5f); }

static void put(const lmb_world *w, size_t at, const float rgba[4])
{
    for (int c = 0; c < 4; ++c) {
        const float v = c < 3 && w->format != LMB_WORLD_F32 ? lmb_world_encode(rgba[c]) : rgba[c];
        switch (w->format) {
        case LMB_WORLD_LOG8: ((uint8_t *)w->texels)[4 * at + (size_t)c] = (uint8_t)code_of(v, 255.0f); break;
        case LMB_WORLD_LOG16: ((uint16_t *)w->texels)[4 * at + (size_t)c] = (uint16_t)code_of(v, 65535.0f); break;
        default: ((float *)w->texels)[4 * at + (size_t)c] = v; break;
        }
    }
}

void lmb_world_texel(float out[4], const lmb_world *w, size_t at)
{
    for (int c = 0; c < 4; ++c) {
        const size_t i = 4 * at + (size_t)c;
        if (w->format == LMB_WORLD_F32) {
            out[c] = ((const float *)w->texels)[i];
        } else if (w->format == LMB_WORLD_LOG8) {
            const uint8_t code = ((const uint8_t *)w->texels)[i];
            out[c] = c < 3 ? w->log8[code] : (float)code * (1.0f / 255.0f);
        } else {
            const uint16_t code = ((const uint16_t *)w->texels)[i];
            out[c] = c < 3 ? maxf(w->log16[0][code >> 8] * w->log16[1][code & 255] - LOG_SHIFT, 0.0f)
                           : (float)code * (1.0f / 65535.0f);
        }
    }
}

/* What is darker than any light's reflection is dark: its products stay far from denormals. */
static float sane_radiance(float c) { return c > 1e-12f && c < 1e30f ? c : 0.0f; }

static size_t face_texel(const lmb_world_level *l, int32_t face, int32_t x, int32_t y)
{
    const size_t side = (size_t)l->width + 2;
    return l->at + ((size_t)face * side + (size_t)(y + 1)) * side + (size_t)(x + 1);
}

/* The mean of four texels, by alpha. */
static void mean4(float out[4], const lmb_world *w, const size_t at[4])
{
    float sum[4] = {0}, rgba[4];
    for (int i = 0; i < 4; ++i) {
        lmb_world_texel(rgba, w, at[i]);
        for (int c = 0; c < 3; ++c) {
            sum[c] += rgba[c] * rgba[3];
        }
        sum[3] += rgba[3];
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = sum[3] > 0.0f ? sum[c] / sum[3] : 0.0f;
    }
    out[3] = 0.25f * sum[3];
}

/* --- faces -------------------------------------------------------------------------------------------------------- */

static void take_faces(lmb_world *w, const lmb_world_pictures *p)
{
    const int32_t n = p->face_size;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const int32_t face = i / (n * n), x = i % n, y = i / n % n;
        float rgba[4] = {0};
        for (int c = 0; c < 3 && p->face[face] != NULL; ++c) {
            rgba[c] = sane_radiance(p->face[face][3 * (size_t)(y * n + x) + (size_t)c]);
            rgba[3] = 1.0f;
        }
        put(w, face_texel(&w->cube[0], face, x, y), rgba);
    }
}

static void halve_faces(lmb_world *w, const lmb_world_level *to, const lmb_world_level *from)
{
    const int32_t n = to->width;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const int32_t face = i / (n * n), x = 2 * (i % n), y = 2 * (i / n % n);
        const size_t at[4] = {face_texel(from, face, x, y), face_texel(from, face, x + 1, y),
                              face_texel(from, face, x, y + 1), face_texel(from, face, x + 1, y + 1)};
        float rgba[4];
        mean4(rgba, w, at);
        put(w, face_texel(to, face, x / 2, y / 2), rgba);
    }
}

/* A border's texel is the one that its own direction meets. */
static void set_border(lmb_world *w, const lmb_world_level *l)
{
    const int32_t n = l->width;
    for (int32_t i = 0; i < 6 * (n + 2) * (n + 2); ++i) {
        const int32_t face = i / ((n + 2) * (n + 2)), x = i % (n + 2) - 1, y = i / (n + 2) % (n + 2) - 1;
        if (x < 0 || y < 0 || x >= n || y >= n) {
            const cube_place p = cube_border(face, x, y, n);
            float rgba[4];
            lmb_world_texel(rgba, w, face_texel(l, p.face, p.x, p.y));
            put(w, face_texel(l, face, x, y), rgba);
        }
    }
}

/* --- ground ------------------------------------------------------------------------------------------------------- */

static void take_ground(lmb_world *w, const lmb_world_pictures *p)
{
    const size_t texels = (size_t)p->ground_width * (size_t)p->ground_height;
    for (size_t i = 0; i < texels; ++i) {
        const float *from = p->ground + 4 * i;
        const float rgba[4] = {sane_radiance(from[0]), sane_radiance(from[1]), sane_radiance(from[2]),
                               from[3] > 1e-5f ? minf(from[3], 1.0f) : 0.0f};
        put(w, w->ground[0].at + i, rgba);
    }
}

static void halve_ground(lmb_world *w, const lmb_world_level *to, const lmb_world_level *from)
{
    for (int32_t y = 0; y < to->height; ++y) {
        for (int32_t x = 0; x < to->width; ++x) {
            const int32_t x0 = mini(2 * x, from->width - 1), x1 = mini(2 * x + 1, from->width - 1);
            const size_t row0 = from->at + (size_t)mini(2 * y, from->height - 1) * (size_t)from->width,
                         row1 = from->at + (size_t)mini(2 * y + 1, from->height - 1) * (size_t)from->width;
            const size_t at[4] = {row0 + (size_t)x0, row0 + (size_t)x1, row1 + (size_t)x0, row1 + (size_t)x1};
            float rgba[4];
            mean4(rgba, w, at);
            put(w, to->at + (size_t)y * (size_t)to->width + (size_t)x, rgba);
        }
    }
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

static int is_inside(const lmb_world_pictures *p)
{
    const lmb_vec3 c = p->centre;
    if (!is_place(c) || !is_place(p->middle) || !is_place(p->low) || !is_place(p->high)) {
        return 0;
    }
    if (p->shape == LMB_WORLD_SPHERE) {
        return is_sane(p->radius) && p->radius > 0.0f && length3(sub3(c, p->middle)) < p->radius;
    }
    return p->shape == LMB_WORLD_BOX && c.x > p->low.x && c.y > p->low.y && c.z > p->low.z && c.x < p->high.x &&
           c.y < p->high.y && c.z < p->high.z;
}

static int ground_is_valid(const lmb_world_pictures *p)
{
    return p->ground == NULL || (is_sane(p->ground_x) && is_sane(p->ground_z) && is_sane(p->ground_y) &&
                                 is_sane(p->ground_width_m) && is_sane(p->ground_depth_m) &&
                                 p->ground_width_m > 0.0f && p->ground_depth_m > 0.0f);
}

static void set_codes(lmb_world *w)
{
    for (int i = 0; i < 256; ++i) {
        w->log8[i] = lmb_world_decode((float)i * (1.0f / 255.0f));
        w->log16[0][i] = lmb_exp2((3.0f * ((float)(256 * i) * (1.0f / 65535.0f)) - 1.0f) * LOG2_10);
        w->log16[1][i] = lmb_exp2(3.0f * ((float)i * (1.0f / 65535.0f)) * LOG2_10);
    }
}

lmb_status lmb_world_init(lmb_world *out, const lmb_world_pictures *pictures, int32_t format, void *memory,
                          size_t bytes)
{
    size_t end = 0;
    if (out == NULL || pictures == NULL) {
        return LMB_ERR_ARG;
    }
    if (format < LMB_WORLD_F32 || format > LMB_WORLD_LOG8) {
        return LMB_ERR_FORMAT;
    }
    if (!is_valid(pictures, format) || !is_inside(pictures) || !ground_is_valid(pictures)) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_world_bytes(pictures, format));
    if (status != LMB_OK) {
        return status;
    }
    out->texels = memory;
    out->format = format;
    out->pictures = *pictures;
    set_codes(out);
    out->cube_levels = set_cube(out->cube, &end, pictures);
    out->ground_levels = set_ground(out->ground, &end, pictures);
    take_faces(out, pictures);
    set_border(out, &out->cube[0]);
    for (int32_t i = 1; i < out->cube_levels; ++i) {
        halve_faces(out, &out->cube[i], &out->cube[i - 1]);
        set_border(out, &out->cube[i]);
    }
    for (int32_t i = 0; i < out->ground_levels; ++i) {
        if (i == 0) {
            take_ground(out, pictures);
        } else {
            halve_ground(out, &out->ground[i], &out->ground[i - 1]);
        }
    }
    return LMB_OK;
}
