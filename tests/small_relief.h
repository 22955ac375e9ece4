/* small_relief.h: a .lmr made in code, the same on every machine: a sphere on a cube, six views from outside along the
 * axes and one in perspective. */
#ifndef SMALL_RELIEF_H
#define SMALL_RELIEF_H

#include <string.h>

#include <lambent/relief.h>

#include "../src/base/poly.h"
#include "../src/base/vec.h"

enum { SMALL_VIEWS = 7 };
#define SMALL_WORDS(side) (LMB_RELIEF_HEADER_WORDS + SMALL_VIEWS * LMB_RELIEF_VIEW_WORDS + 8 * 5 + 18 + \
                           SMALL_VIEWS * 3 * (side) * (side))

static inline lmb_view small_view(int i, int32_t side)
{
    static const float axis[SMALL_VIEWS][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0},
                                               {0, 0, 1}, {0, 0, -1}, {0.6f, 0.48f, 0.64f}};
    const lmb_vec3 up = i == 2 || i == 3 ? vec3(0, 0, 1) : vec3(0, 1, 0);
    lmb_view v = {.sample_x = 0};
    v.back = normalize3(vec3(axis[i][0], axis[i][1], axis[i][2]));
    v.right = normalize3(cross3(up, v.back));
    v.up = cross3(v.back, v.right);
    v.eye = mul3(v.back, 3.0f);
    v.half_width = v.half_height = i < 6 ? 1.125f : 0.375f;
    v.near_m = 1.5f;
    v.far_m = 4.5f;
    v.kind = i < 6 ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE;
    v.frame_width = v.frame_height = side;
    return v;
}

/* The sphere at the middle of a texel: m along the axis, 0 where there is none. */
static inline float small_depth(lmb_vec3 *at, const lmb_view *v, int32_t x, int32_t y)
{
    const float size = (float)v->frame_width;
    const float sx = ((float)(2 * x + 1) / size - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * y + 1) / size) * v->half_height;
    const lmb_vec3 across = add3(mul3(v->right, sx), mul3(v->up, sy));
    const int perspective = v->kind == LMB_PERSPECTIVE;
    const lmb_vec3 from = perspective ? v->eye : add3(v->eye, across),
                   ray = perspective ? normalize3(sub3(across, v->back)) : mul3(v->back, -1.0f);
    const float b = dot3(from, ray), c = 1.0f - (dot3(from, from) - b * b);
    if (c <= 0.0f) {
        return 0.0f;
    }
    *at = add3(from, mul3(ray, -b - sqrtf(c)));
    return -dot3(v->back, sub3(*at, v->eye));
}

static inline void small_bytes(uint8_t *p, uint32_t v, int count)
{
    for (int i = 0; i < count; ++i) {
        p[i] = (uint8_t)(v >> 8 * i & 255u);
    }
}

static inline void small_texel(uint8_t *texels, const lmb_view *v, int32_t format, int32_t x, int32_t y)
{
    const uint32_t count = (uint32_t)(v->frame_width * v->frame_height), i = (uint32_t)(y * v->frame_width + x);
    const float min = v->kind == LMB_PERSPECTIVE ? v->near_m / v->far_m : 0.0f;
    const int full = format == LMB_RELIEF_FULL;
    lmb_vec3 at;
    int16_t code[2];
    const float z = small_depth(&at, v, x, y);
    if (z == 0.0f) {
        return;
    }
    const float d = v->kind == LMB_PERSPECTIVE ? v->near_m / z : (v->far_m - z) / (v->far_m - v->near_m);
    const uint32_t depth = (uint32_t)((d - min) / (1.0f - min) * (full ? 16777215.0f : 65535.0f));
    const uint32_t red = (uint32_t)(127.5f + 120.0f * at.x), green = (uint32_t)(127.5f + 120.0f * at.y);
    lmb_octahedral_encode(code, at);
    if (full) {
        small_bytes(texels + 4 * i, depth, 4);
        small_bytes(texels + 4 * (count + i), red | green << 8 | 0xff400000u, 4);
        small_bytes(texels + 4 * (2 * count + i), (uint16_t)code[0] | (uint32_t)(uint16_t)code[1] << 16, 4);
    } else {
        small_bytes(texels + 4 * i, depth | red >> 3 << 16 | green >> 2 << 21 | 8u << 27, 4);
        small_bytes(texels + 4 * count + 2 * i,
                    (uint32_t)(code[0] / 258 & 255) | (uint32_t)(code[1] / 258 & 255) << 8, 2);
    }
}

static inline void small_record(uint32_t *word, const lmb_view *v, uint32_t texels)
{
    const float f[16] = {v->eye.x, v->eye.y, v->eye.z, v->right.x, v->right.y, v->right.z, v->up.x, v->up.y, v->up.z,
                         v->back.x, v->back.y, v->back.z, v->half_width, v->half_height, v->near_m, v->far_m};
    for (int i = 0; i < 16; ++i) {
        word[i] = float_bits(f[i]);
    }
    word[16] = (uint32_t)v->kind;
    word[17] = (uint32_t)v->frame_width;
    word[18] = (uint32_t)v->frame_height;
    word[19] = texels;
}

/* The cube: 8 x (3 floats, normal, colour) and 36 indices of 16 bits. */
static inline void small_cube(uint32_t *at, uint32_t head[LMB_RELIEF_HEADER_WORDS], uint32_t offset)
{
    static const uint16_t index[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    for (int v = 0; v < 8; ++v) {
        const lmb_vec3 p = vec3(v & 1 ? 1.05f : -1.05f, v & 2 ? 1.05f : -1.05f, v & 4 ? 1.05f : -1.05f);
        int16_t code[2];
        at[3 * v] = float_bits(p.x);
        at[3 * v + 1] = float_bits(p.y);
        at[3 * v + 2] = float_bits(p.z);
        lmb_octahedral_encode(code, p);
        memcpy(at + 24 + v, code, 4);
        small_bytes((uint8_t *)(at + 32 + v), 0xff808080u, 4);
    }
    memcpy(at + 40, index, sizeof index);
    head[6] = 8;
    head[7] = 12;
    head[8] = offset;
    head[9] = offset + 96;
    head[10] = offset + 128;
    head[11] = offset + 160;
    head[12] = LMB_INDEX_U16;
}

/* Into SMALL_WORDS(side) words; side even. Returns the file's bytes. */
static inline size_t small_relief(uint32_t *words, int32_t format, int32_t side)
{
    const uint32_t texels = (uint32_t)(side * side), each = (format == LMB_RELIEF_FULL ? 12u : 6u) * texels;
    const uint32_t records = 4 * LMB_RELIEF_HEADER_WORDS, mesh = records + 4 * LMB_RELIEF_VIEW_WORDS * SMALL_VIEWS;
    const uint32_t first = mesh + 4 * (8 * 5 + 18), size = first + SMALL_VIEWS * each;
    uint32_t head[LMB_RELIEF_HEADER_WORDS] = {0, 0x01020304u, size, (uint32_t)format, SMALL_VIEWS, records};
    memset(words, 0, size);
    memcpy(head, "LMR\1", 4);
    small_cube(words + mesh / 4, head, mesh);
    memcpy(words, head, sizeof head);
    for (int i = 0; i < SMALL_VIEWS; ++i) {
        const lmb_view v = small_view(i, side);
        const uint32_t at = first + (uint32_t)i * each;
        small_record(words + records / 4 + i * LMB_RELIEF_VIEW_WORDS, &v, at);
        for (int32_t k = 0; k < side * side; ++k) {
            small_texel((uint8_t *)words + at, &v, format, k % side, k / side);
        }
    }
    return size;
}

#endif
