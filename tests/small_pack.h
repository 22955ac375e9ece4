/* small_pack.h: a .lmp made by hand, the same on every machine: a floor with a palette and a panel in 16 bits, a lamp and a
 * camera; the panel and the lamp move. */
#ifndef SMALL_PACK_H
#define SMALL_PACK_H

#include <string.h>

#include <lambent/pack.h>

#include "../src/base/poly.h"

enum { SMALL_PACK_WORDS = 512 };

/* Words that are put one behind the other, and the parts that begin at them. */
typedef struct small_file {
    uint32_t *word, count, parts;
} small_file;

static inline uint32_t small_here(const small_file *f) { return 4 * f->count; }
static inline void small_word(small_file *f, uint32_t word) { f->word[f->count++] = word; }
static inline void small_float(small_file *f, float v) { small_word(f, float_bits(v)); }

static inline void small_floats(small_file *f, const float *v, int count)
{
    for (int i = 0; i < count; ++i) {
        small_float(f, v[i]);
    }
}

static inline void small_zeros(small_file *f, int count)
{
    for (int i = 0; i < count; ++i) {
        small_word(f, 0);
    }
}

/* Two numbers of 16 bits. */
static inline void small_pair(small_file *f, uint32_t a, uint32_t b)
{
    const uint16_t pair[2] = {(uint16_t)a, (uint16_t)b};
    memcpy(&f->word[f->count++], pair, sizeof pair);
}

static inline void small_four(small_file *f, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint8_t byte[4] = {(uint8_t)a, (uint8_t)b, (uint8_t)c, (uint8_t)d};
    memcpy(&f->word[f->count++], byte, sizeof byte);
}

/* A part from `begin` on. */
static inline void small_part(small_file *f, uint32_t kind, uint32_t begin)
{
    uint32_t *w = f->word + LMB_PACK_HEADER_WORDS + LMB_PACK_PART_WORDS * f->parts++;
    w[0] = kind;
    w[1] = begin;
    w[2] = small_here(f) - begin;
    w[3] = 0;
}

/* A square of two triangles: int16 places of 1/1000 m, 16-bit coordinates, no normals. Returns its streams' places. */
static inline void small_square(small_file *f, uint32_t at[3])
{
    at[0] = small_here(f);
    for (uint32_t i = 0; i < 4; ++i) {
        small_pair(f, i & 1 ? 1000u : 0xffffu - 999u, 0);
        small_pair(f, i & 2 ? 1000u : 0xffffu - 999u, 0);
    }
    at[1] = small_here(f);
    for (uint32_t i = 0; i < 4; ++i) {
        small_pair(f, i & 1 ? 65535 : 0, i & 2 ? 65535 : 0);
    }
}

static inline void small_mesh(small_file *f, const uint32_t at[3])
{
    small_word(f, 4);
    small_word(f, 2);
    small_word(f, LMB_POSITION_I16 | LMB_UV_U16 << 8 | LMB_INDEX_U16 << 16);
    small_word(f, at[0]);
    small_zeros(f, 2);
    small_word(f, at[1]);
    small_word(f, 0);
    small_word(f, at[2]);
    for (int i = 0; i < 3; ++i) {
        small_float(f, 0.001f);
    }
    small_zeros(f, 3);
    small_float(f, 2.0f);
    small_float(f, 2.0f);
    small_zeros(f, 3);
}

static inline void small_material(small_file *f, uint32_t texture)
{
    static const float albedo[5] = {0.9f, 0.8f, 0.7f, 1.0f, 0.5f};
    small_floats(f, albedo, 5);
    small_word(f, texture);
    small_word(f, LMB_DOUBLE_SIDED);
    small_zeros(f, 13);
}

/* Into SMALL_PACK_WORDS words; returns the file's bytes. What it has at time 0, 1 and 2 s: the panel at height 0.5, 0.5 +
 * 1 and 0.5 + 1, turned by 0, 90 and 90 degrees about +Y; the lamp at x 0, 1 and 1. */
static inline size_t small_pack(uint32_t *words)
{
    static const float bounds[6] = {-1, 0, -1, 1, 2, 1};
    static const float floor_to[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    static const float panel_to[12] = {.5f, 0, 0, 0, .5f, 0, 0, 0, .5f, 0, .5f, 0};
    static const float lamp[11] = {0, 1.8f, .5f, 0, 0, -1, 9, 8, 7, 0, 0};
    static const float looks[12] = {0, 1, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const float looks_more[6] = {.5f, .4f, 1.25f, .1f, 0, .7610128f};
    static const float rest[10] = {0, .5f, 0, 0, 0, 0, 1, .5f, .5f, .5f};
    static const float lamp_rest[10] = {0, 1.8f, .5f, 0, 0, 0, 1, 1, 1, 1};
    static const float above[10] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
    static const float times[2] = {0, 1}, rises[6] = {0, 0, 0, 0, 1, 0};
    static const float turns[8] = {0, 0, 0, 1, 0, .70710678f, 0, .70710678f};
    static const float goes[18] = {0, 0, 0, 0, 1.8f, .5f, 1, 0, 0, 1, 0, 0, 1, 1.8f, .5f, 0, 0, 0};
    small_file f = {words, LMB_PACK_HEADER_WORDS + 13 * LMB_PACK_PART_WORDS, 0};
    uint32_t at[3], texels[2], keys[4], begin;
    memset(words, 0, SMALL_PACK_WORDS * sizeof *words);
    begin = small_here(&f);
    small_floats(&f, bounds, 6);
    small_zeros(&f, 14);
    small_part(&f, LMB_PACK_SCENE, begin);
    begin = small_here(&f);
    small_square(&f, at);
    small_part(&f, LMB_PACK_VERTICES, begin);
    at[2] = begin = small_here(&f);
    small_pair(&f, 0, 1);
    small_pair(&f, 2, 2);
    small_pair(&f, 1, 3);
    small_part(&f, LMB_PACK_INDICES, begin);
    begin = small_here(&f);
    small_mesh(&f, at);
    small_part(&f, LMB_PACK_MESHES, begin);
    texels[0] = begin = small_here(&f); /* 4 x 4, three levels, by a palette; 2 x 2, one level, in 16 bits */
    for (uint32_t i = 0; i < 16; ++i) {
        small_four(&f, 16 * i, 255 - 16 * i, 128, 255);
    }
    small_four(&f, 0x10, 0x32, 0x54, 0x76);
    small_four(&f, 0x98, 0xba, 0xdc, 0xfe);
    small_four(&f, 0x53, 0xb9, 0x07, 0);
    texels[1] = small_here(&f);
    small_pair(&f, 0xf800, 0x07e0);
    small_pair(&f, 0x001f, 0x8410);
    small_part(&f, LMB_PACK_TEXELS, begin);
    begin = small_here(&f);
    small_word(&f, texels[0]);
    small_word(&f, 4 | 4 << 16);
    small_word(&f, 3 | LMB_TEXELS_PALETTE4 << 8);
    small_word(&f, LMB_TRILINEAR);
    small_word(&f, texels[1]);
    small_word(&f, 2 | 2 << 16);
    small_word(&f, 1 | LMB_TEXELS_RGB565 << 8 | LMB_WRAP_MIRROR << 16);
    small_word(&f, LMB_BILINEAR);
    small_part(&f, LMB_PACK_TEXTURES, begin);
    begin = small_here(&f);
    small_material(&f, 0);
    small_material(&f, 1);
    small_part(&f, LMB_PACK_MATERIALS, begin);
    begin = small_here(&f);
    small_floats(&f, floor_to, 12);
    small_word(&f, 0);
    small_word(&f, 0);
    small_word(&f, LMB_PACK_NONE);
    small_word(&f, 0);
    small_floats(&f, panel_to, 12);
    small_word(&f, 0);
    small_word(&f, 1);
    small_word(&f, 1);
    small_word(&f, 0);
    small_part(&f, LMB_PACK_INSTANCES, begin);
    begin = small_here(&f);
    small_floats(&f, lamp, 11);
    small_word(&f, LMB_LIGHT_POINT);
    small_word(&f, 2);
    small_zeros(&f, 3);
    small_part(&f, LMB_PACK_LIGHTS, begin);
    begin = small_here(&f);
    small_floats(&f, looks, 12);
    small_word(&f, LMB_PERSPECTIVE);
    small_floats(&f, looks_more, 6);
    small_word(&f, LMB_PACK_NONE);
    small_part(&f, LMB_PACK_CAMERAS, begin);
    keys[0] = begin = small_here(&f);
    small_floats(&f, times, 2);
    keys[1] = small_here(&f);
    small_floats(&f, rises, 6);
    keys[2] = small_here(&f);
    small_floats(&f, turns, 8);
    keys[3] = small_here(&f);
    small_floats(&f, goes, 18);
    small_part(&f, LMB_PACK_KEYS, begin);
    begin = small_here(&f);
    small_word(&f, 0 | 1 << 8); /* the node above rises, the panel turns, the lamp goes by a cubic */
    small_word(&f, 2);
    small_word(&f, keys[0]);
    small_word(&f, keys[1]);
    small_word(&f, 1 | 1 << 8);
    small_word(&f, 2);
    small_word(&f, keys[0]);
    small_word(&f, keys[2]);
    small_word(&f, 0 | 2 << 8);
    small_word(&f, 2);
    small_word(&f, keys[0]);
    small_word(&f, keys[3]);
    small_part(&f, LMB_PACK_TRACKS, begin);
    begin = small_here(&f);
    for (uint32_t i = 0; i < 3; ++i) {
        small_word(&f, i == 1 ? 0 : LMB_PACK_NONE);
        small_word(&f, i);
        small_word(&f, 1);
        small_word(&f, 0);
        small_floats(&f, i == 0 ? above : i == 1 ? rest : lamp_rest, 10);
        small_zeros(&f, 2);
    }
    small_part(&f, LMB_PACK_NODES, begin);
    memcpy(words, "LMP", 3);
    ((uint8_t *)words)[3] = LMB_PACK_VERSION;
    words[1] = 0x01020304u;
    words[2] = small_here(&f);
    words[3] = f.parts;
    return small_here(&f);
}

#endif
